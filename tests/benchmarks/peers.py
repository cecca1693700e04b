#!/usr/bin/env python3
"""Compares the processor time of trammel with that of other programs that do the same work from start to end.

Arguments: the program, then rows (all by default). manipulator-4 and manipulator-64: eight modes and statics under 10 N, elements per link,
against CalculiX. grnn-631 and grnn-100000: queries of 379 samples, against numpy. pendulum-16: 1 s of a flexible pendulum in large motion
with 16 rods, against Simbody; mesh errors of both bobs are below 1e-6 m. instructions-4 and instructions-64: instructions of manipulator-4
and manipulator-64 by valgrind; work before the process of a computation starts counts once. Programs run alternately, ROUNDS times. The
ratio is the median of the ratios of the pairs, with the minimum and maximum. Answers are compared before times. The peers estimate no
discretization errors, so the program is called with --no-errors."""
import json
import math
import os
import pathlib
import re
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile

ROUNDS = 5
HERE = pathlib.Path(__file__).resolve().parent
ADAPTER = HERE.parent.parent / "harness" / "adapters" / "calculix.py"
NUMPY = """
import json, sys, numpy
grnn = json.load(open(sys.argv[1]))["analysis"]["grnn"]
X, Y = (numpy.array(grnn["samples"][key]) for key in ("inputs", "outputs"))
queries, width = numpy.array(grnn["queries"]), 2 * grnn["sigma"] ** 2
answer = numpy.empty((len(queries), Y.shape[1]))
for first in range(0, len(queries), 1000):
    x = queries[first:first + 1000]
    squared = (x ** 2).sum(1)[:, None] + (X ** 2).sum(1) - 2 * x @ X.T
    weights = numpy.exp((squared.min(1)[:, None] - squared) / width)
    answer[first:first + 1000] = (weights @ Y) / weights.sum(1)[:, None]
json.dump(answer.tolist(), open(sys.argv[2], "w"))
"""


def seconds(command, folder):
    """Returns the processor time of a command and its child processes [s]."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    subprocess.run(command, cwd=folder, env=environment, stdout=subprocess.DEVNULL, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def compare(row, ours, theirs, folder, difference):
    """Runs both programs alternately and prints the ratio of times and the `difference` of the answers."""
    pairs = [(seconds(ours, folder), sum(seconds(command, folder) for command in theirs)) for _ in range(ROUNDS)]
    ratios = sorted(a / b for a, b in pairs)
    a, b = (statistics.median(side) for side in zip(*pairs))
    print(f"{row}: {a:.3f} s against {b:.3f} s: ratio {statistics.median(ratios):.3f} ({ratios[0]:.3f} to {ratios[-1]:.3f}); "
          f"answers differ by {difference:.1e}", flush=True)


def write(folder, name, case):
    head = {"id": name, "title": name, "family": "benchmark", "labels": ["benchmark"]}
    (folder / f"{name}.json").write_text(json.dumps({**head, **case}))


def answer(program, folder, name):
    """Returns the run of a case: quantities with one entry, and the computed values of checks."""
    seconds([program, "run", f"{name}.json", "--out", "out"], folder)
    return json.loads((folder / "out" / "results.json").read_text())["runs"][0]


def grnn(program, folder, count):
    def inputs(t):
        return [2 * math.cos(t) + 0.3 * math.sin(2 * t), 1.5 * math.sin(t + 0.4), math.cos(t - 1) + 0.2 * math.cos(3 * t)]
    times = [2 * math.pi * k / 630 for k in range(379)]
    samples = {"inputs": [inputs(t) for t in times], "outputs": [[math.sin(t + k) for k in range(6)] for t in times]}
    queries = [inputs(2 * math.pi * k / count) for k in range(count)]
    for sigma in (0.3, 0.02):  # most samples contribute; only about twelve samples contribute
        peer = ["/usr/bin/python3", "-c", NUMPY, "grnn.json", "answer.json"]
        for name, some in (("grnn", queries), ("one", queries[count // 3:count // 3 + 1])):
            write(folder, name, {"analysis": {"grnn": {"sigma": sigma, "samples": samples, "queries": some}}})
        seconds(peer, folder)
        expected = json.loads((folder / "answer.json").read_text())[count // 3]
        found = answer(program, folder, "one")["quantities"]
        difference = max(abs(found[f"prediction:{j + 1}"][0] - value) for j, value in enumerate(expected))
        compare(f"grnn-{count}, sigma {sigma}", [program, "run", "--no-errors", "grnn.json", "--out", "out"], [peer], folder, difference)


def manipulator(folder, elements):
    for kind, analysis in (("modes", {"count": 8}), ("statics", {})):
        write(folder, kind, {"extends": "table-1", "analysis": {kind: analysis},
                             "model": {"manipulator": {"links": {"elements": elements}, "platform": {"kind": "rigid"}},
                                       **({"loads": {"P": {"node": "P", "force_N": [10, 0]}}} if kind == "statics" else {})}})
    return ["run", "--no-errors", "modes.json", "statics.json", "--jobs", "1", "--out", "out"]


def against_calculix(program, folder, elements):
    """Runs ccx without the adapter on its decks: plane-stress strips for modes, beam elements for statics."""
    words = manipulator(folder, elements)
    seen = {"quantity": "frequency_Hz", "role": "verification", "bound": {"at_least": 0, "why": "to be read"}}
    write(folder, "seen", {"extends": "modes.json", "checks": {str(k): {**seen, "index": k} for k in range(8)}})
    for case in ("seen", "statics"):
        (folder / case).mkdir()
        seconds([program, "export", f"{case}.json", "--out", f"{case}/case.json"], folder)
        seconds([sys.executable, str(ADAPTER), "case.json", "result.json"], folder / case)
    expected = json.loads((folder / "seen" / "result.json").read_text())["quantities"]["frequency_Hz"]["values"]
    found = [check["computed"] for check in answer(program, folder, "seen")["checks"]]
    runs = [["ccx", "seen/deck"], ["ccx", "statics/deck"]]
    difference = max(abs(a / b - 1) for a, b in zip(expected, found))
    compare(f"manipulator-{elements}", [program, *words], runs, folder, difference)


def pendulum(program, folder, rods):
    """Compares two elements of degree 3 with a chain of rigid rods. The mesh error is relative to a mesh of 6 elements."""
    seen = {"role": "verification", "bound": {"at_least": -2, "why": "to be read"}}
    strip = {"material": "steel", "rectangle": {"thickness_m": 0.002, "width_m": 0.02}}

    def bob(name, elements, steps):
        write(folder, name, {
            "model": {"materials": {"steel": {"E_Pa": 2e11, "rho_kg_m3": 7870, "nu": 0.3}}, "sections": {"strip": strip}, "elements": elements,
                      "nodes": {"O": [0, 0], "bob": [1, 0]}, "supports": {"O": ["x", "y"]}, "gravity_m_s2": [0, -9.81],
                      "members": {"rod": {"nodes": ["O", "bob"], "section": "strip", "beam": "euler-bernoulli", "axial": "inextensible"}},
                      "point_masses": {"bob": {"node": "bob", "mass_kg": 1}}},
            "analysis": {"large-motion": {"end_time_s": 1, "output_step_s": 0.05, "step_s": 0.05 / steps, "nodes": ["bob"],
                                          "integrator": "energy-momentum", "extrapolated": True}},
            "checks": {f"{axis}-{k}": {**seen, "quantity": f"position_{axis}_m:bob", "index": k} for k in range(21) for axis in "xy"}})
        values = [check["computed"] for check in answer(program, folder, name)["checks"]]
        return list(zip(values[::2], values[1::2]))

    def chain(accuracy):
        printed = subprocess.run([*simbody, accuracy], stdout=subprocess.PIPE, check=True, text=True).stdout
        return [tuple(map(float, line.split())) for line in printed.splitlines()]

    def apart(a, b):
        return max(math.dist(p, q) for p, q in zip(a, b, strict=True))
    simbody = [str(simbody_pendulum(program)), str(rods)]
    continuum, fine, fine_chain = bob("continuum", 6, 200), bob("fine", 2, 400), chain("1e-8")
    ours, theirs = apart(bob("pendulum", 2, 40), fine), apart(chain("1e-4"), fine_chain)
    print(f"pendulum-{rods}: error in time {ours:.1e} m against {theirs:.1e} m, of the mesh {apart(fine, continuum):.1e} m against {apart(fine_chain, continuum):.1e} m")
    compare(f"pendulum-{rods}", [program, "run", "--no-errors", "pendulum.json", "--out", "out"], [[*simbody, "1e-4"]], folder, apart(fine, fine_chain))


def simbody_pendulum(program):
    return pathlib.Path(program).parent.parent / "tests" / "simbody_pendulum"


def instructions(program, folder, elements):
    words = manipulator(folder, elements)
    for old in folder.glob("count.*"):
        old.unlink()
    seconds(["valgrind", "-q", "--tool=callgrind", f"--callgrind-out-file={folder}/count.%p", program, *words], folder)
    total = 0
    for number, file in enumerate(sorted(folder.glob("count.*"), key=lambda f: int(f.suffix[1:]))):
        printed = subprocess.run(["callgrind_annotate", "--inclusive=yes", "--threshold=100", str(file)], check=True,
                              stdout=subprocess.PIPE, text=True).stdout
        whole = r"PROGRAM TOTALS" if number == 0 else r"_Function_handler<std::__cxx11::basic_string<[^(]*\(\)"
        total += int(re.search(r"^ *([0-9,]+) .*" + whole, printed, re.M)[1].replace(",", ""))
    print(f"instructions, manipulator-{elements}: {total / 1e6:.1f} million")


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    rows = {f"{name}-{count}": (needs, run, count) for name, needs, run, counts in (
        ("manipulator", "ccx", against_calculix, (4, 64)), ("grnn", "/usr/bin/python3", grnn, (631, 100000)), ("pendulum", simbody_pendulum(program), pendulum, (16,)),
        ("instructions", "valgrind", instructions, (4, 64))) for count in counts}
    for row in sys.argv[2:] or rows:
        needs, run, count = rows[row]
        if not shutil.which(needs):
            print(f"{row}: no {needs} here")
            continue
        with tempfile.TemporaryDirectory() as folder:
            run(program, pathlib.Path(folder), count)


main()
