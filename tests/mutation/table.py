#!/usr/bin/env python3
"""Writes the page's table of seeded faults by the family that detects them, from their expected outcomes.

With --check it writes nothing; the exit status is 1 if the table differs.
"""
import collections
import sys

import seeding
from seeding import KINDS, ROOT

sys.path.insert(0, str(ROOT / "tests/support"))
import page_section  # noqa: E402

HEADS = {"physical": "Physics", "coefficient": "Coefficients", "generic": "Generic", "judging": "Judging"}


def row_of(fault):
    """Returns the table row that counts a fault: its detecting family or suite, or the reason for no detection."""
    expected = fault["expected"]
    if isinstance(expected, str):
        return "Not detected: " + ("equivalent or unobservable" if expected.startswith("survives") else "open")
    folder, *suite = expected[0].split(".")
    return f"Tests of {folder}" if suite else folder.replace("-", " ").capitalize()


def table(faults):
    counts = collections.Counter((row_of(f), f["kind"]) for f in faults)
    order = sorted({name for name, _ in counts}, key=lambda n: (
        n.startswith("Not"), n.startswith("Tests"), -sum(counts[n, k] for k in KINDS), n))
    rows = [(name, [counts[name, k] for k in KINDS]) for name in order]
    rows.append(("Total", [sum(column) for column in zip(*(numbers for _, numbers in rows))]))
    yield '    <thead><tr><th scope="col">Detected by</th>'
    yield from (f'    <th scope="col">{HEADS[k]}</th>' for k in KINDS)
    yield "    </tr></thead>\n    <tbody>"
    for name, numbers in rows:
        cells = "".join(f"<td>{number or ''}</td>" for number in numbers)
        yield f'    <tr><th scope="row">{name}</th>{cells}</tr>'
    yield "    </tbody>"


def main():
    faults = seeding.load(sorted((ROOT / "tests/mutation/faults").glob("*.json")))
    noticed = sum(isinstance(f["expected"], list) for f in faults)
    missed = sum(row_of(f).endswith("open") for f in faults)
    silent = len(faults) - noticed - missed
    label = f"{noticed} faults are detected, {silent} are equivalent or unobservable, {missed} is open"
    bar = f'<span class="passes" style="flex-grow: {noticed}"></span><span style="flex-grow: {silent}"></span>'
    bar += f'<span class="fails" style="flex-grow: {missed}"></span>'
    return page_section.write(
        "detection", "Detection of seeded faults",
        f"Of {len(faults)} faults that were seeded into the program one at a time, {noticed} are detected."
        " Each counts for one family of cases that detects it, or for one suite of tests. Coefficients are changed by 1 %. Generic"
        " faults are drawn from all constants, operators, indices, conditions and terms of the solver.",
        "Faults by family", table(faults), figure=[f'  <div class="bar" role="img" aria-label="{label}">{bar}</div>'])


if __name__ == "__main__":
    sys.exit(main())
