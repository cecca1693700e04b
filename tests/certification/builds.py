#!/usr/bin/env python3
"""Builds trammel with other compilers and options, runs the catalogue with each build, and compares the results with `trammel certify`.

The comparison includes other modes of rounding. Builds and results of the same sources in OUT are reused. A build takes about ten
minutes on two cores, all other work half an hour. --write replaces the page's section and result.json. The exit status is 1 if a
verdict differs or is missing, or if a run fails."""
import argparse
import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
RELEASE = ["-DCMAKE_BUILD_TYPE=Release", "-DTRAMMEL_TESTS=OFF"]
BUILDS = {
    "clang": ("Built by clang 14, -O3",
              ["-DCMAKE_CXX_COMPILER=clang++", "-DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON"]),
    "gcc-O2-fma": ("Built by gcc, -O2 with FMA",
                   ["-DCMAKE_CXX_FLAGS_RELEASE=-O2 -DNDEBUG -march=haswell -ffp-contract=fast"]),
    "gcc-O0": ("Built by gcc, -O0: cases of less than 0.1 s", ["-DCMAKE_CXX_FLAGS_RELEASE=-O0 -DNDEBUG"]),
}


def call(*command, **options):
    return subprocess.run([*map(str, command)], cwd=ROOT, check=True, **options)


def run(program, cases, out):
    """Returns the results of a build. Its checks may fail, because certify compares with the first build."""
    subprocess.run([program, "run", *cases, "--out", out, "--resume"], cwd=ROOT, stdout=subprocess.DEVNULL)
    return out


def build(name, out):
    call("cmake", "-S", ROOT, "-B", out / name, "-G", "Ninja", *RELEASE, *BUILDS[name][1])
    call("cmake", "--build", out / name, "--target", "trammel")
    return out / name / "harness/trammel"


def certify(program, cases, results):
    """Returns the output of certify for the cases: modes of rounding, and the builds with given results."""
    command = [program, "certify", *cases, "--json", "--results", *results.values()]
    found = json.loads(subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, text=True).stdout)
    titles = {str(path): BUILDS[name][0] for name, path in results.items()}
    for entry in found["configurations"] + found["flips"] + found["tight_tolerances"]:
        name = entry["configuration"]
        entry["configuration"] = titles.get(name, "Rounded " + name)
    for entry in found["configurations"]:
        entry["cases"] = len(cases)
    return found


def write(found, cases):
    commit = call("git", "rev-parse", "--short", "HEAD", capture_output=True, text=True).stdout.strip()
    kept = ("configuration", "cases", "checks", "median_digits")
    result = {"of": f"{len(cases)} cases of the catalogue, all that are not slow, by the program of commit {commit}",
              "tight_tolerances": len({one["check"] for one in found["tight_tolerances"]}),
              "configurations": [{**{key: entry[key] for key in kept}, "median_digits": round(entry["median_digits"], 2)}
                                 for entry in found["configurations"]],
              "flips": found["flips"]}
    folder = pathlib.Path(__file__).parent
    (folder / "result.json").write_text(json.dumps(result, indent=1) + "\n")
    call(sys.executable, folder / "page.py")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("program", type=pathlib.Path, help="the program with which the builds are compared")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "build/certification")
    parser.add_argument("--write", action="store_true")
    given = parser.parse_args()
    program, out = given.program.resolve(), given.out.resolve()
    listed = json.loads(call(program, "list", "--json", capture_output=True).stdout)
    cases = [case["id"] for case in listed if "slow" not in case["labels"]]
    own = json.loads((run(program, cases, out / "own") / "results.json").read_text())
    seconds = dict.fromkeys(cases, 0.0)
    for one in own["runs"]:
        seconds[one["case"]] += one.get("cost", {}).get("cpu_s", 0)
    cheap = [case for case in cases if seconds[case] < 0.1]
    results = {name: run(build(name, out), cheap if name == "gcc-O0" else cases, out / f"{name}-results")
               for name in BUILDS}
    found = certify(program, cases, {name: results[name] for name in ("clang", "gcc-O2-fma")})
    unoptimized = certify(program, cheap, {"gcc-O0": results["gcc-O0"]})
    for key, entries in found.items():
        entries += [one for one in unoptimized[key] if one["configuration"] == BUILDS["gcc-O0"][0]]
    if given.write:
        write(found, cases)
    print(json.dumps(found, indent=1))
    return 1 if found["flips"] else 0


if __name__ == "__main__":
    sys.exit(main())
