#!/usr/bin/env python3
"""Runs cases of the catalogue, transformed, and compares the results with those that the law of each
transformation predicts. Exit status 1 if a difference is neither within tolerance nor in exceptions.json."""

import argparse
import collections
import copy
import json
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile
import time

from laws import differences
from store import read_run
from transformations import ALL, Skip

HERE = pathlib.Path(__file__).parent
# Relative to the scale of the kind of quantity. Round-off error grows with the condition number (to 1e-9 for modes
# of fine meshes); iterations (large motion, paths) stop at their own relative tolerances of up to 1e-6.
TOLERANCE = collections.defaultdict(lambda: 1e-5, statics=1e-7, modes=1e-6, buckling=1e-6, harmonic=1e-6, transient=1e-6)
SIGN_FREE = {"modes", "buckling"}  # shapes have no fixed sign and no fixed basis among repeated frequencies


def run_program(program, *arguments):
    return subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, check=False)


def listed(program, wanted):
    """Returns (case, variant) of the catalogue whose name CASE:VARIANT contains the expression."""
    cases = json.loads(run_program(program, "list", "--json").stdout)
    pairs = [(case["id"], variant) for case in cases for variant in case["variants"]]
    return [pair for pair in pairs if re.search(wanted, ":".join(pair))]


def export(program, folder, case, variant):
    """Returns the plain case; raises Skip with the reason if the program does not export it."""
    answer = run_program(program, "export", case, "--variant", variant, "--out", folder / "export.json")
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
        if len(cases) > 1:  # one bad file refuses the call
            return {n: r for name in cases for n, r in solve(program, folder, {name: cases[name]}, seconds).items()}
        lines = answer.stderr.strip().splitlines() or [""]
        return dict.fromkeys(cases, {"status": "refused", "reason": lines[-1]})
    results = {}
    for run in json.loads((out / "results.json").read_text())["runs"]:
        result = {"status": run["status"], "reason": run.get("reason", ""), "warnings": len(run.get("warnings", []))}
        if run["status"] == "solved":
            result["quantities"], result["effects"] = read_run(out / "store" / run["stored"])
        results[run["case"]] = result
    return results


def compare(analysis, law, before, after, model):
    """Returns lines that describe what differs from the law."""
    if before["status"] != after["status"]:
        return [f"status: {before['status']} -> {after['status']} {after['reason'][:200]}"]
    if before["status"] != "solved":
        return []
    lines = []
    if before["warnings"] != after["warnings"] and not law.inert and law.loads == 1:
        lines.append(f"warnings: {before['warnings']} -> {after['warnings']}")
    if before["effects"] != after["effects"] and not law.inert and law.loads == 1:
        lines.append("effects differ")
    expected, obtained = law.expected(before["quantities"]), after["quantities"]
    if analysis in SIGN_FREE:
        expected = {n: v for n, v in expected.items() if re.match(r"frequency|load_factor|critical|mass_kg|growth", n)}
    if analysis == "harmonic":  # amplitudes, without phase
        expected, obtained = ({n: [v and abs(v) for v in s] for n, s in q.items()} for q in (expected, obtained))
    found = sorted(differences(expected, obtained, TOLERANCE[analysis], model), key=lambda item: -item[3])
    lines += [f"{name}: expected {a}, obtained {b}, error {error:.1e} of the scale" for name, a, b, error in found[:3]]
    return lines


def reason_of_exception(exceptions, name, transformation, lines):
    """Returns why a difference is expected; each of its lines must be one that an exception names."""
    fitting = [e for e in exceptions if re.fullmatch(e["case"], name) and re.fullmatch(e["transformation"], transformation)]
    if all(any(re.search(e["line"], line) for e in fitting) for line in lines):
        return fitting[0]["why"]
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program")
    parser.add_argument("--seconds", type=float, help="stop after this time: a sample, drawn by the seed")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--cases", default="", help="regular expression of CASE:VARIANT")
    parser.add_argument("--transformations", nargs="*", default=list(ALL), choices=list(ALL))
    parser.add_argument("--limit", type=float, default=20, help="longest time of one run [s]")
    parser.add_argument("--keep", type=pathlib.Path, help="folder for transformed cases that differ")
    options = parser.parse_args()
    exceptions = json.loads((HERE / "exceptions.json").read_text())
    counts, skipped, failed = collections.defaultdict(collections.Counter), collections.Counter(), []
    start = time.monotonic()
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        order = sorted(listed(options.program, options.cases))
        random.Random(options.seed).shuffle(order)
        for case, variant in order:
            if options.seconds and time.monotonic() - start > options.seconds:
                break
            try:
                plain = export(options.program, folder, case, variant)
            except Skip as reason:
                skipped[str(reason)] += 1
                continue
            check_case(options, folder, f"{case}:{variant}", plain, exceptions, counts, skipped, failed)
    report(counts, skipped, failed)
    return 1 if failed or not counts else 0


def check_case(options, folder, name, case, exceptions, counts, skipped, failed):
    """Compares one case with its transformed twins."""
    plain, analysis = re.sub(r"[^A-Za-z0-9-]", "-", name).lower(), next(iter(case["analysis"]))
    begin = time.monotonic()
    before = solve(options.program, folder, {plain: case}, options.limit)[plain]
    if before["status"] in ("refused", "timeout") or time.monotonic() - begin > options.limit:
        skipped[f"all: the case itself is {before['status']} within the limit of time"] += 1
        return
    twins, laws = {}, {}
    for transformation in options.transformations:
        try:
            twins[f"{plain}-{transformation}"], laws[transformation] = ALL[transformation](copy.deepcopy(case))
        except Skip as reason:
            skipped[f"{transformation}: {reason}"] += 1
    results = solve(options.program, folder, twins, 4 * options.limit) if twins else {}
    for transformation, law in laws.items():
        twin = f"{plain}-{transformation}"
        changed, after = twins[twin], results[twin]
        lines = compare(analysis, law, before, after, changed["model"])
        outcome = "agree"
        if lines:
            outcome = "exception" if reason_of_exception(exceptions, name, transformation, lines) else "differ"
        counts[transformation][outcome] += 1
        if outcome == "differ":
            failed.append((name, transformation, analysis))
            print(f"{name} {transformation} ({analysis})", *lines, sep="\n    ", flush=True)
            if options.keep:
                options.keep.mkdir(parents=True, exist_ok=True)
                (options.keep / f"{twin}.json").write_text(json.dumps(dict(changed, id=twin), indent=1))


def report(counts, skipped, failed):
    print("transformation   agree  exceptions  unexplained")
    for name, count in counts.items():
        print(f"{name:15}{count['agree']:7}{count['exception']:12}{count['differ']:13}")
    for reason, number in sorted(skipped.items()):
        print(f"not admitted: {reason}: {number}")
    print(f"{len(failed)} unexplained differences")


if __name__ == "__main__":
    sys.exit(main())
