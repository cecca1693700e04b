#!/bin/bash
# completion.sh PROGRAM: tests the completions of every installed shell with a command, an option and a case.
set -eu
folder=$(cd "$(dirname "$0")/../../../harness/cli/completions" && pwd)
links=$(mktemp -d)
trap 'rm -rf "$links"' EXIT
ln -s "$(readlink -f "$1")" "$links/trammel"
export PATH="$links:$PATH" HOME="$links"
cd "$links"

by_bash() {
  bash -c 'source "$0/trammel.bash"; COMP_WORDS=(trammel "$@"); COMP_CWORD=$#; _trammel; echo "${COMPREPLY[@]}"' "$folder" "$@"
}
by_fish() { fish -c 'source $argv[1]/trammel.fish; complete -C "trammel $argv[2..]"' "$folder" "$@" | tr '\n' ' '; }
by_zsh() {
  zsh -fc 'compadd() { for one in "${@:2}"; do [[ $one == ${words[CURRENT]}* ]] && print -rn -- "$one "; done; true }
    _files() { }; words=(trammel "$@"); CURRENT=${#words}; source "$ZSH_ARGZERO/_trammel"' "$folder" "$@"
}
expect() { # expect SHELL ANSWER WORD...
  local shell=$1 answer=$2 found
  shift 2
  found=$("by_$shell" "$@")
  [ "${found% }" = "$answer" ] || { echo "$shell: expected '$answer' for 'trammel $*' (got '$found')"; exit 1; }
}
for shell in bash fish zsh; do
  command -v "$shell" >/dev/null || continue
  expect "$shell" "compare converge cost coverage" co
  expect "$shell" "--errors" run --er
  expect "$shell" "portal-frame" run portal
  echo "$shell: pass"
done
