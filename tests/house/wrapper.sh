#!/bin/bash
# wrapper.sh TRAMMEL: tests the wrapper ./trammel with stubs of cmake and of the program.
set -eu
wrapper=$(readlink -f "$1")
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
export PATH="$root/bin:$PATH"
status=0 said=""

# Makes a checkout with the wrapper. Its stub of cmake is slow, and records simultaneous calls.
checkout() {
  rm -rf "${root:?}"/*
  mkdir -p "$root/source/.ci" "$root/bin"
  cd "$root"
  cp "$wrapper" source/trammel
  printf '#!/bin/sh\n' >source/.ci/install
  cat >bin/cmake <<'STUB'
#!/bin/sh
for word in "$@"; do case $before in -B | --build) folder=$word ;; esac; before=$word; done
[ ! -e "$folder/broken" ] || { echo "a new fault"; exit 1; }
mkdir "$folder/busy" || echo overlap >>"$folder/faults"
sleep 0.3
touch "$folder/build.ninja" "$folder/CMakeCache.txt"
mkdir -p "$folder/harness"
printf '#!/bin/sh\necho program "$@"\n' >"$folder/harness/trammel.part"
chmod +x "$folder/harness/trammel.part"
mv "$folder/harness/trammel.part" "$folder/harness/trammel"
rmdir "$folder/busy"
STUB
  chmod +x source/.ci/install bin/cmake
}
# Runs a command, and keeps its exit status and its output.
run() {
  status=0
  said=$("$@" 2>&1 </dev/null) || status=$?
}
fail() {
  printf 'wrapper.sh: %s (status %s): %s\n' "$1" "$status" "$said"
  exit 1
}
says() { [[ $said == *"$1"* ]] || fail "expected '$1'"; }
says_not() { [[ $said != *"$1"* ]] || fail "did not expect '$1'"; }
ends_with_status() { [ "$status" = "$1" ] || fail "expected status $1"; }

checkout # simultaneous calls build one after the other
run bash -c 'source/trammel list & a=$!; source/trammel describe & b=$!; wait $a && wait $b'
ends_with_status 0
says "program list"
says "program describe"
says "waiting for another call"
[ ! -e source/build/release/faults ] || fail "two calls built at the same time"

checkout # another build folder leaves the checkout unchanged
mkdir away
ln -s ../source/trammel away/trammel
run bash -c 'cd away; CDPATH=/usr TRAMMEL_BUILD=build ./trammel list'
says "program list"
[ ! -e source/build ] || fail "the checkout has a build folder"

checkout # the log of a former call is discarded, also by a call on a terminal, which writes no log
run source/trammel list
log=source/build/release/wrapper.log
echo "an old fault" >"$log"
run script -qec 'source/trammel list' /dev/null
[ ! -e "$log" ] || ! grep -q "an old fault" "$log" || fail "the old log remains"
echo "an old fault" >"$log"
touch source/build/release/broken
run source/trammel list
ends_with_status 3
says "a new fault"
says_not "an old fault"

checkout # an impossible build folder is refused in one line
for folder in /dev/null/x source/trammel; do
  run env TRAMMEL_BUILD="$folder" source/trammel list
  ends_with_status 3
  [ "$said" = "trammel: expected a writable folder: $folder" ] || fail "expected one line"
done
