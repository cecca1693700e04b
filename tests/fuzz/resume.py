#!/usr/bin/env python3
"""Runs cases without interruption, and again with ten kills at random times, each followed by a call with --resume.

Arguments: the program, then words for `run`, such as -L beam (the catalogue without slow cases by default). Prints the number of runs
that each call found in the store. The exit status is 1 if the two results.json differ in more than times and date, or if a stored
computation is lost."""
import json
import pathlib
import random
import re
import signal
import subprocess
import sys
import tempfile
import time

KILLS = 10


def call(program, words, out, kill_after=None, number=None):
    process = subprocess.Popen([program, "run", *words, "--resume", "--out", str(out)],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        process.wait(kill_after)
    except subprocess.TimeoutExpired:
        process.send_signal(number)
        process.wait()
    status = process.returncode
    return status if status >= 0 else 128 - status


def numbers(out):
    """Returns the results without times, date and cases that measure times; the number of runs; and the cases that measure times."""
    results = json.loads((out / "results.json").read_text())
    results["environment"].pop("date")
    results["environment"].pop("stored_runs", None)
    timed = {run["case"] for run in results["runs"] if run.get("timings")}
    results["runs"] = [run for run in results["runs"] if run["case"] not in timed]
    for run in results["runs"]:
        run["cost"] = run["cost"].get("counters")
    return results, len(results["runs"]), sorted(timed)


def same_series(program, first, second):
    """Compares two results with the program itself, which also reads the store."""
    said = subprocess.run([program, "compare", str(first / "results.json"), str(second / "results.json")],
                          stdout=subprocess.PIPE, text=True, check=True).stdout
    print(said.splitlines()[-1])
    return ", 0 differ" in said


def catalogue(program):
    said = subprocess.run([program, "list", "--json"], stdout=subprocess.PIPE, check=True).stdout
    return [case["id"] for case in json.loads(said) if "slow" not in case["labels"]]


def main():
    program, words = sys.argv[1], sys.argv[2:]
    words = words or catalogue(program)
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # background processes of a shell ignore SIGINT by default
    chance = random.Random(1)
    with tempfile.TemporaryDirectory(prefix="trammel-resume-") as folder:
        whole, out = pathlib.Path(folder, "whole"), pathlib.Path(folder, "out")
        begin = time.monotonic()
        print("uninterrupted: exit status", call(program, words, whole))
        takes = time.monotonic() - begin
        kept = set()
        for i in range(KILLS):
            number = (signal.SIGKILL, signal.SIGINT)[i % 2]
            after = takes / KILLS * chance.uniform(0.5, 1.2)
            status = call(program, words, out, after, number)
            now = {file.name for file in (out / "store").glob("*.cbor") if ".judged" not in file.name}
            print(f"{number.name} after {after:.1f} s: exit status {status}, {len(now)} runs kept", flush=True)
            if kept - now:
                sys.exit("a computation that was kept is lost")
            kept = now
        begin = time.monotonic()
        print(f"resumed: exit status {call(program, words, out)}, {time.monotonic() - begin:.1f} s of {takes:.1f} s")
        (first, count, timed), (second, _, _) = numbers(whole), numbers(out)
        print(f"{count} runs compared bit for bit; left out, as they measure times: {timed}")
        equal = first == second and same_series(program, whole, out)
        print("equal" if equal else "different")
        return 0 if equal else 1


if __name__ == "__main__":
    sys.exit(main())
