#!/usr/bin/env python3
"""Do verdicts and digits depend on compiler, optimization or rounding? Builds trammel in other ways, runs
the catalogue with each, and lets `trammel certify` put them beside ways of rounding.

Without optimization only the cases that take less than a second are run. What exists in OUT is not
built or run again; builds take some ten minutes each on two cores, the rest an hour. Exit status 1
where a verdict differs, is missing, or a run ends otherwise.
"""
import argparse
import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
RELEASE = ["-DCMAKE_BUILD_TYPE=Release", "-DTRAMMEL_TESTS=OFF"]
BUILDS = {
    "gcc-O2-fma": ["-DCMAKE_CXX_FLAGS_RELEASE=-O2 -DNDEBUG -march=haswell -ffp-contract=fast"],
    "clang": ["-DCMAKE_CXX_COMPILER=clang++", "-DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON"],
    "gcc-O0": ["-DCMAKE_CXX_FLAGS_RELEASE=-O0 -DNDEBUG"],
}


def call(*command, **options):
    return subprocess.run([*map(str, command)], cwd=ROOT, check=True, **options)


def run(program, cases, out):
    """The results of a build, whose checks may fail: certify judges by the first."""
    if not (out / "results.json").exists():
        subprocess.run([program, "run", *cases, "--out", out], cwd=ROOT, stdout=subprocess.DEVNULL)
    return out


def build(name, out):
    call("cmake", "-S", ROOT, "-B", out / name, "-G", "Ninja", *RELEASE, *BUILDS[name])
    call("cmake", "--build", out / name, "--target", "trammel")
    return out / name / "harness/trammel"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("program", type=pathlib.Path, help="trammel, of which the others are to differ")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "build/certification")
    parser.add_argument("--json", action="store_true")
    given = parser.parse_args()
    program, out = given.program.resolve(), given.out.resolve()
    listed = json.loads(call(program, "list", "--json", capture_output=True).stdout)
    cases = [case["id"] for case in listed if "slow" not in case["labels"]]
    own = json.loads((run(program, cases, out / "own") / "results.json").read_text())
    seconds = dict.fromkeys(cases, 0.0)
    for one in own["runs"]:
        seconds[one["case"]] += one.get("cost", {}).get("cpu_s", 0)
    cheap = [case for case in cases if seconds[case] < 1]
    results = {name: run(build(name, out), cheap if name == "gcc-O0" else cases, out / f"{name}-results")
               for name in BUILDS}
    status = 0
    for chosen, names in ((cases, ["gcc-O2-fma", "clang"]), (cheap, ["gcc-O0"])):
        command = [program, "certify", *chosen, "--results", *(results[name] for name in names)]
        status |= subprocess.run([*command, *(["--json"] if given.json else [])], cwd=ROOT).returncode
    return status


if __name__ == "__main__":
    sys.exit(main())
