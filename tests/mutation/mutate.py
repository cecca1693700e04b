#!/usr/bin/env python3
"""Determines the seeded faults that the catalogue detects. One build contains all faults (seeding.py); one is active at a time.

The environment names the active fault, and a mapped file records the faults that a case reaches. A first pass records the reached faults and
the time of each case. Then each fault is active in the cases that reach it: expected families first, cheap cases first. The search ends
when a gate breaks by the exit status, a crash, or ten times the usual time. OUT/table.json contains the outcomes.

The exit status is 1 if an outcome differs from the expected one."""
import argparse
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time

import seeding
from seeding import KINDS, ROOT

sys.path.append(str(ROOT / "tests/metamorphic"))
from store import uncompressed


def call(command, out, limit, **environment):
    """Returns the exit status (None after the limit), the seconds, and hashes of the stored runs."""
    begun = time.monotonic()
    process = subprocess.Popen([*map(str, command)], env={**os.environ, **environment}, cwd=ROOT,
                               stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL, start_new_session=True)
    try:
        status = process.wait(limit)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        status = None
    seconds = time.monotonic() - begun
    # Times, numbers of repetitions and hashes are not compared.
    number, count = rb"(\xfb.{8}|\xfa.{4}|\xf6)", rb"(\x1a.{4}|\x19..|\x18.|[\0-\x17])"
    times = re.compile(rb"(wall_s|cpu_s)" + number + rb"|evaluation_s" + number + rb"kevaluations" + count +
                       rb"|[0-9a-f]{8}-[0-9a-f-]{27}", re.DOTALL)
    stored = [uncompressed(file.read_bytes()) for file in pathlib.Path(out).glob("store/*.cbor")]
    return status, seconds, {hashlib.sha256(times.sub(b"", text)).hexdigest() for text in stored}


def failing_cases(out):
    """Returns the cases with a failed gate by the results of a call, or None without results."""
    file = pathlib.Path(out) / "results.json"
    if not file.exists():
        return None
    runs = json.loads(file.read_text())["runs"]
    holds = ("pass", "recorded", "not-given")
    return {run["case"] for run in runs if any(check["verdict"] not in holds for check in run["checks"])}


class Probe:
    """Probe: a case of the catalogue, or a suite of tests, that may detect faults."""

    def __init__(self, name, group, command):
        self.name, self.group, self.command = name, group, command
        self.seconds, self.reached, self.recorded = 0.0, set(), set()
        self.is_case = command[1] == "run"

    def record_baseline(self, faults):
        """Records the time without faults, the stored runs, and the faults that the probe reaches."""
        with tempfile.NamedTemporaryFile() as log:
            log.write(bytes(4096))
            log.flush()
            status, self.seconds, self.recorded, _ = run([self], 600, TRAMMEL_FAULT_LOG=log.name)
            marks = pathlib.Path(log.name).read_bytes()
        if status != 0:
            sys.exit(f"{self.name} fails without an active fault (exit status {status})")
        self.reached = {f["id"] for f in faults if marks[f["number"]]}
        return self


def run(probes, limit, **environment):
    """Runs cases in one call, or one suite. Returns the result of `call` and the cases with a failed gate."""
    command = list(probes[0].command)
    with tempfile.TemporaryDirectory(prefix="mutation-") as out:
        if probes[0].is_case:
            command += [p.name for p in probes[1:]] + ["--jobs", "1", "--out", out]
        return *call(command, out, limit, **environment), failing_cases(out)


def find_detecting_probe(fault, probes, **environment):
    """Returns the probe that detects the fault, the symptom, and True if a stored run differs."""
    limit = 2 + 10 * sum(p.seconds for p in probes)
    status, _, recorded, failing = run(probes, limit, TRAMMEL_FAULT_NUMBER=str(fault["number"]), **environment)
    if status == 0:
        return None, "", recorded != set().union(*(p.recorded for p in probes))
    how = "time" if status is None else f"exit {status}"
    if len(probes) == 1:
        return probes[0], how, True
    # Without a named case, the call ended early, or only the bands of separate cases are too narrow.
    found = ((p, how, True) for p in probes if p.name in (failing or ()))
    alone = (find_detecting_probe(fault, [p], **environment) for p in (probes if failing is None else ()))
    return next(found, None) or next((f for f in alone if f[0]), (None, "", True))


def chunks(probes, expected=()):
    """Yields cases in groups of growing size, and suites one by one, with expected suites first."""
    suites = [p for p in probes if not p.is_case]
    yield from ([p] for p in suites if p.group in expected)
    cases, size = [p for p in probes if p.is_case], 4
    while cases:
        yield cases[:size]
        cases, size = cases[size:], 3 * size
    yield from ([p] for p in suites if p.group not in expected)


def cases_of(program, chosen):
    """Returns the cases of the catalogue with their families."""
    listed = subprocess.run([program, "list"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    names = [line.split()[0] for line in listed.splitlines() if re.match(r"[a-z0-9-]+ {2,}", line)]
    families = {}
    for file in (ROOT / "cases").rglob("*.json"):
        families[file.stem] = json.loads(file.read_text()).get("family", file.parent.name)
    return [Probe(name, families[name], [program, "run", name]) for name in names if name in families
            and (not chosen or re.fullmatch(chosen, name))]


def suites_of(program, folder, chosen):
    """Returns the suites of a test program that are not slow. Switches allocate memory, so tests of allocations are excluded."""
    files = [f for f in (ROOT / "tests" / folder).rglob("*_test.cpp")
             if "slow" not in f.read_text().splitlines()[0]]
    suites = [(f"{folder}.{f.stem[:-5]}", f"--run_test={f.stem[:-5]}") for f in files]
    return [Probe(name, name, [program, word, "--run_test=!@allocations"]) for name, word in suites
            if not chosen or re.fullmatch(chosen, name)]


def find_outcome(fault, probes, cap):
    """Returns the outcome of a fault: noticed by a probe, unnoticed, unchanged results, or not reached."""
    expected = fault["expected"] if isinstance(fault["expected"], list) else []
    near = sorted((p for p in probes if fault["id"] in p.reached),
                  key=lambda p: (p.seconds > cap, p.group not in expected, p.seconds))
    changed = False
    for chunk in chunks(near, expected):
        probe, how, differs = find_detecting_probe(fault, chunk)
        if probe:
            return {"outcome": "noticed", "by": probe.group, "probe": probe.name, "how": how}
        changed = changed or differs
    outcome = "unnoticed" if changed else "unchanged" if near else "not reached"
    return {"outcome": outcome, "probes": len(near)}


def smallest_error(fault, probes, cap):
    """Returns the smallest power of ten of a relative error that the cases below the cap detect."""
    near = sorted((p for p in probes if fault["id"] in p.reached and p.seconds <= cap and p.is_case),
                  key=lambda p: p.seconds)
    best = None
    for exponent in range(-1, -13, -1):
        found = (find_detecting_probe(fault, chunk, TRAMMEL_FAULT_ERROR=f"1e{exponent}")[0] for chunk in chunks(near))
        by = next((probe for probe in found if probe), None)
        if by is None:
            break
        best, near = exponent, [by] + [p for p in near if p is not by]
    return {"outcome": "noticed" if best else "unnoticed" if near else "not reached",
            "smallest_error": best and 10.0**best}


def as_expected(fault, found):
    """Returns True if the outcome is the expected one, or if an error of the expected size or less is detected."""
    if "smallest_error" in found:
        return (found["smallest_error"] or 1) <= 1.001 * fault.get("smallest_error", 1)
    if isinstance(fault["expected"], str):
        return found["outcome"] != "noticed" or fault["expected"].startswith("open: ")
    return found["outcome"] == "noticed" and found["by"] in fault["expected"]


def check_bits(build, probes):
    """Checks that the program without an active fault computes the same bits as the program without switches."""
    for probe in sorted(probes, key=lambda p: p.seconds)[::8]:
        plain = Probe(probe.name, probe.group, [build / "harness/trammel", *probe.command[1:]])
        if run([plain], 600)[2] != probe.recorded:
            sys.exit(f"{probe.name}: the inactive switches change the results")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, help="a ready build folder")
    parser.add_argument("faults", nargs="*", type=pathlib.Path, help="files of faults; all by default")
    parser.add_argument("--out", type=pathlib.Path, help="BUILD/mutation by default")
    parser.add_argument("--ids", help="activate only faults whose id matches this")
    parser.add_argument("--quick", action="store_true", help="only faults that are marked as quick")
    parser.add_argument("--cases", help="only cases and suites whose name matches this")
    parser.add_argument("--tests", nargs="*", default=[], help="folders of tests that may also detect faults")
    parser.add_argument("--cap", type=float, default=5, help="time in seconds; cases that take longer run last [5]")
    parser.add_argument("--below-cap", action="store_true", help="omit the cases that take longer than the cap")
    parser.add_argument("--smallest-errors", action="store_true", help="determine the smallest detected error of each coefficient")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    given = parser.parse_args()
    build, out = given.build.resolve(), (given.out or given.build / "mutation").resolve()
    faults = seeding.load(given.faults or sorted((ROOT / "tests/mutation/faults").glob("*.json")))
    if given.quick:
        faults = seeding.number([f for f in faults if f.get("quick")])
    targets = ["harness/trammel", *(f"tests/test_{folder}" for folder in given.tests)]
    programs = seeding.Build(build, out, given.jobs).run(faults, targets)
    os.environ["TRAMMEL_PROGRAM"] = str(programs["harness/trammel"])  # the program that tests start
    probes = cases_of(programs["harness/trammel"], given.cases)
    for folder in given.tests:
        probes += suites_of(programs[f"tests/test_{folder}"], folder, given.cases)
    table = {}
    with concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:
        probes = list(pool.map(lambda p: p.record_baseline(faults), probes))
        probes = [p for p in probes if not given.below_cap or p.seconds <= given.cap]
        check_bits(build, [p for p in probes if p.is_case])
        chosen = [f for f in faults if not given.ids or re.search(given.ids, f["id"])]
        seek = smallest_error if given.smallest_errors else find_outcome
        found = [pool.submit(seek, fault, probes, given.cap) for fault in chosen]
        for fault, future in zip(chosen, found):
            entry = table[fault["id"]] = {"kind": fault["kind"], **future.result()}
            entry["as_expected"] = as_expected(fault, entry)
            if entry["outcome"] != "noticed" or not entry["as_expected"]:
                print(f"{fault['id']}: {entry}", flush=True)
            (out / "table.json").write_text(json.dumps(table, indent=1) + "\n")
    for kind in KINDS:
        of_kind = [entry["outcome"] for entry in table.values() if entry["kind"] == kind]
        counts = ", ".join(f"{of_kind.count(o)} {o}" for o in sorted(set(of_kind)))
        print(f"{kind}: {len(of_kind)} faults: {counts}" if of_kind else f"{kind}: none")
    return any(not entry["as_expected"] for entry in table.values())


if __name__ == "__main__":
    sys.exit(main())
