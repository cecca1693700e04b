#!/usr/bin/env python3
"""Runs transformed cases of the catalogue, such as rotated models. Compares the results with those predicted from the original case.
The exit status is 1 if a difference is neither within tolerance nor in exceptions.json."""

import argparse
import collections
import concurrent.futures
import copy
import json
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile

from laws import differences, stated_roundoff
from catalogue import computations
from store import read_run
from transformations import ALL, Skip

HERE = pathlib.Path(__file__).parent
CASES = HERE.parent.parent / "cases"
# Tolerances relative to the largest quantity of the same kind, in addition to the round-off error that the program estimates.
# With such an estimate, 1e-9 allows for cancellation in differences of quantities. Otherwise, the tolerance includes round-off
# error, which grows with the condition number and the number of steps. Searches for peaks and difference quotients have errors
# of 1e-7. Iterations of large motions and paths have errors of up to 1e-6 of small responses.
TOLERANCE = collections.defaultdict(lambda: 1e-5, statics=1e-9, modes=1e-9, buckling=1e-9, harmonic=1e-6, transient=1e-6)
SIGN_FREE = {"modes", "buckling"}  # shapes have no fixed sign and no fixed basis among repeated frequencies


def run_program(program, *arguments):
    return subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, check=False)


def export(program, folder, name, case):
    """Returns the plain case; raises Skip with the reason if the program does not export it."""
    (folder / f"{name}.json").write_text(json.dumps(dict(case, id=name)))
    answer = run_program(program, "export", folder / f"{name}.json", "--out", folder / "export.json")
    if answer.returncode:
        raise Skip("not exported: " + re.sub(r"^.*?: (/\S+: )?", "", answer.stderr.strip())[:50])
    plain = json.loads((folder / "export.json").read_text())
    plain.pop("export", None)
    return plain


def solve(program, folder, cases, seconds):
    """Returns name -> status, quantities, effects and number of warnings of each case."""
    files = []
    for name, case in cases.items():
        files.append(folder / f"{name}.json")
        files[-1].write_text(json.dumps(dict(case, id=name, timeout_s=seconds)))
    out = folder / "out"
    shutil.rmtree(out, ignore_errors=True)
    answer = run_program(program, "run", *files, "--jobs", 1, "--out", out)
    if not (out / "results.json").exists():
        if len(cases) > 1:  # an invalid file stops the call for all cases
            return {n: r for name in cases for n, r in solve(program, folder, {name: cases[name]}, seconds).items()}
        lines = answer.stderr.strip().splitlines() or [""]
        return dict.fromkeys(cases, {"status": "refused", "reason": lines[-1]})
    results = {}
    for run in json.loads((out / "results.json").read_text())["runs"]:
        result = {"status": run["status"], "reason": run.get("reason", ""), "warnings": len(run.get("warnings", []))}
        if run["status"] == "solved":
            result["quantities"], result["roundoff"], result["effects"] = read_run(out / "store" / run["stored"])
        results[run["case"]] = result
    return results


def compare(analysis, options, law, before, after, model):
    """Returns lines that describe differences from the predictions, and the largest difference relative to the scale."""
    if before["status"] != after["status"]:
        return [f"status: {before['status']} -> {after['status']} {after['reason'][:200]}"], 0.0
    if before["status"] != "solved":
        return [], 0.0
    lines = []
    if before["warnings"] != after["warnings"] and not law.inert and law.loads == 1:
        lines.append(f"warnings: {before['warnings']} -> {after['warnings']}")
    if before["effects"] != after["effects"] and not law.inert and law.loads == 1:
        lines.append("effects differ")
    expected, obtained = law.expected(before["quantities"]), after["quantities"]
    if analysis in SIGN_FREE:
        expected = {n: v for n, v in expected.items() if re.match(r"frequency|load_factor|critical|mass_kg|growth", n)}
    if options.get("whole_path"):  # step control selects the points of a path; only events and the end are predicted
        expected = {n: v if re.match(r"limit_|bifurcation_", n) else v[-1:] for n, v in expected.items()}
        obtained = {n: v if re.match(r"limit_|bifurcation_", n) else v[-1:] for n, v in obtained.items()}
    if analysis == "harmonic":  # amplitudes have no sign
        expected, obtained = ({n: [v and abs(v) for v in s] for n, s in q.items()} for q in (expected, obtained))
    stated = stated_roundoff(before["roundoff"], after["roundoff"])
    tolerance = TOLERANCE[analysis]
    if law.inert:  # additional coordinates change the time steps; each motion has the requested error
        tolerance = max(tolerance, options.get("error_control", {}).get("relative", 0.0))
    found, largest = differences(expected, obtained, tolerance, model, stated)
    found.sort(key=lambda item: -item[3])
    lines += [f"{name}: expected {a}, obtained {b}, error {error:.1e} of the scale" for name, a, b, error in found[:3]]
    return lines, largest


def reason_of_exception(exceptions, name, transformation, lines):
    """Returns the reason of an expected difference; an exception must name each of its lines."""
    fitting = [e for e in exceptions if re.fullmatch(e["case"], name) and re.fullmatch(e["transformation"], transformation)]
    if all(any(re.search(e["line"], line) for e in fitting) for line in lines):
        return fitting[0]["why"]
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program")
    parser.add_argument("--sample", type=int, help="number of computations, drawn by the seed, without slow cases")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--cases", default="", help="regular expression of CASE:VARIANT, CASE:VARIANT:LEVEL")
    parser.add_argument("--folder", type=pathlib.Path, default=CASES, help="folder of the cases")
    parser.add_argument("--transformations", nargs="*", default=list(ALL), choices=list(ALL))
    parser.add_argument("--limit", type=float, default=60, help="longest time of one run [s]")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="computations at a time")
    parser.add_argument("--keep", type=pathlib.Path, help="folder for transformed cases that differ")
    options = parser.parse_args()
    exceptions = json.loads((HERE / "exceptions.json").read_text())
    order = [c for c in computations(options.folder) if re.search(options.cases, c.name)]
    random.Random(options.seed).shuffle(order)
    if options.sample:
        order = [c for c in order if not c.is_slow][:options.sample]
    total = Findings()
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for found in pool.map(lambda c: check_case(options, c, exceptions), order):
            for line in found.lines:
                print(line, flush=True)
            total.add(found)
    total.report()
    return 1 if total.failed or not total.counts else 0


class Findings:
    """Results of the comparisons."""

    def __init__(self):
        self.counts, self.skipped = collections.defaultdict(collections.Counter), collections.Counter()
        self.worst, self.failed, self.lines = {}, 0, []

    def add(self, other):
        for name, count in other.counts.items():
            self.counts[name].update(count)
        self.skipped.update(other.skipped)
        self.failed += other.failed
        for key, value in other.worst.items():
            self.worst[key] = max(value, self.worst.get(key, (0.0, "")))

    def report(self):
        print("transformation   agree  exceptions  unexplained")
        for name, count in self.counts.items():
            print(f"{name:15}{count['agree']:7}{count['exception']:12}{count['differ']:13}")
        for reason, number in sorted(self.skipped.items()):
            print(f"not admitted: {reason}: {number}")
        for analysis, (error, where) in sorted(self.worst.items()):
            print(f"largest difference that agrees, {analysis}: {error:.1e} of the scale ({where})")
        print(f"{self.failed} unexplained differences")


def check_case(options, computation, exceptions):
    """Compares one computation with its transformations."""
    found = Findings()
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        name = re.sub(r"[^A-Za-z0-9-]", "-", computation.name).lower()
        case = computation.case
        try:
            if "manipulator" not in case.get("model", {}) and "effects" not in case:
                case = export(options.program, folder, name, case)
            compare_twins(options, folder, computation.name, name, case, exceptions, found)
        except Skip as reason:
            found.skipped[str(reason)] += 1
    return found


def compare_twins(options, folder, title, name, case, exceptions, found):
    analysis = next(iter(case["analysis"]))
    before = solve(options.program, folder, {name: case}, options.limit)[name]
    if before["status"] in ("refused", "timeout"):
        raise Skip(f"all: the case itself is {before['status']}: {before['reason'][:80]}")
    twins, laws = {}, {}
    for transformation in options.transformations:
        try:
            twins[f"{name}-{transformation}"], laws[transformation] = ALL[transformation](copy.deepcopy(case))
        except Skip as reason:
            found.skipped[f"{transformation}: {reason}"] += 1
    results = solve(options.program, folder, twins, 4 * options.limit) if twins else {}
    for transformation, law in laws.items():
        twin = f"{name}-{transformation}"
        changed, after = twins[twin], results[twin]
        lines, worst = compare(analysis, case["analysis"][analysis], law, before, after, changed["model"])
        outcome = "agree"
        if lines:
            outcome = "exception" if reason_of_exception(exceptions, title, transformation, lines) else "differ"
        else:
            found.worst[analysis] = max(found.worst.get(analysis, (0.0, "")), (worst, f"{title} {transformation}"))
        found.counts[transformation][outcome] += 1
        if outcome == "differ":
            found.failed += 1
            found.lines.append("\n    ".join([f"{title} {transformation} ({analysis})", *lines]))
            if options.keep:
                options.keep.mkdir(parents=True, exist_ok=True)
                (options.keep / f"{twin}.json").write_text(json.dumps(dict(changed, id=twin), indent=1))
                (options.keep / f"{name}.json").write_text(json.dumps(dict(case, id=name), indent=1))


if __name__ == "__main__":
    sys.exit(main())
