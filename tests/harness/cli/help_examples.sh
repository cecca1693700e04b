#!/bin/bash
# help_examples.sh PROGRAM quick|slow: runs the examples of 'trammel --help' in a temporary folder, in their order.
# Stand-ins: the documents' robot (my-robot.json, other.json, a.json, b.json), a tapered cantilever (my-case.json), its
# study (my-study.json), results of beam-cantilever, and adapters that call 'trammel solve'.
# Slow examples take more than 20 s.
set -eu
source=$(cd "$(dirname "$0")/../../.." && pwd)
program=$(readlink -f "$1") speed=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export HOME="$folder" PATH="$folder/bin:$PATH"
cd "$folder"
mkdir -p bin a b before after clang trammel-results
ln -s "$program" bin/trammel
printf '#!/bin/sh\nexec trammel solve "$1" "$2"\n' >my-adapter
printf '#!/bin/sh\necho "$1" >opened.txt\n' >bin/xdg-open
chmod +x my-adapter bin/xdg-open
printf 'import subprocess, sys\nsys.exit(subprocess.call(["trammel", "solve", *sys.argv[-2:]]))\n' >my_adapter.py
for name in my-robot other a b; do
  sed "s/\"my-robot\"/\"$name\"/" "$source/docs/example/my-robot.json" >"$name.json"
done
cat >my-case.json <<'END'
{"id": "my-case", "title": "Tapered cantilever", "model": {
  "materials": {"steel": {"E_Pa": 2e11, "rho_kg_m3": 7800, "nu": 0.3}},
  "sections": {"root": {"material": "steel", "rectangle": {"thickness_m": 0.1, "width_m": 0.05}},
               "tip": {"material": "steel", "rectangle": {"thickness_m": 0.05, "width_m": 0.05}}},
  "nodes": {"A": [0, 0], "B": [2, 0]},
  "members": {"AB": {"nodes": ["A", "B"], "section": "root", "end_section": "tip"}},
  "supports": {"A": ["x", "y", "rotation"]}, "loads": {"tip": {"node": "B", "force_N": [0, 100]}}},
 "analysis": {"statics": {}}}
END
cat >my-study.json <<'END'
{"id": "my-study", "family": "beams", "title": "Tapered cantilever, tip displacement", "case": "my-case.json",
 "quantities": {"displacement_y_m:B": {}},
 "reference_solution": {"title": "64 elements", "patch": {"model": {"elements": 64}}},
 "curves": {"mesh": {"title": "elements", "pointers": ["/model/elements"], "values": [2, 4, 8]}},
 "baseline": {"curve": "mesh", "value": 4}}
END
trammel run beam-cantilever --out before --history history.db >/dev/null
for other in after clang a b trammel-results; do cp -r before/. "$other"; done
trammel grade ./my-adapter beam-cantilever >/dev/null
cases_of_claims=$(sed -n 's/.*"case": "\([^"]*\)".*/\1/p' "$source/cases/paper/claims/varalakshmi-2017.json" | sort -u)

# 'trammel test' runs the complete catalogue.
left_out='^trammel (report|report --out report --jobs 4)$'
slow='^trammel (claims|merge .*|run manipulator-modes|run -L .*|run --label-any .*|compare manipulator-modes.*|cost|certify .*|effects -L .*)'
failed=0
while IFS= read -r example; do
  [[ $example =~ $left_out ]] && continue
  case $speed in
    quick) [[ $example =~ $slow ]] && continue ;;
    slow) [[ $example =~ $slow ]] || continue ;;
  esac
  begun=$(date +%s)
  if [ "$example" = "trammel claims trammel-results" ]; then
    # shellcheck disable=SC2086
    trammel run $cases_of_claims >/dev/null </dev/null || failed=1
  fi
  status=0
  bash -c "$example" >out.txt 2>err.txt </dev/null || status=$?
  if [[ $example == *--pdf* ]]; then
    sleep 1 # for xdg-open, which is not awaited
    if ! [[ $(head -c 4 trammel-results/summary.pdf) == %PDF && $(cat opened.txt) == */index.html ]]; then
      failed=1
      echo "no PDF, or no page opened: $example"
    fi
  fi
  # Status 1 of 'certify' reports verdicts that depend on rounding: hard-07-elements:elastica-3-fine toward zero.
  if [ $status -ne 0 ] && ! { [ $status -eq 1 ] && [[ $example == "trammel certify "* ]]; }; then
    failed=1
    echo "failed with status $status: $example: $(tail -n 3 err.txt)"
  fi
  echo "$(($(date +%s) - begun)) s: $example"
done < <(sed -n 's/^  \(trammel .*\)/\1/p' "$source/harness/cli/help.txt" | sed 's/   *[^ ].*$//; s/ *$//' |
  grep -v 'COMMAND\|CASE' | awk '!done[$0]++')
exit $failed
