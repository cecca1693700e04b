#!/usr/bin/env python3
"""Writes the page's section about rounding and builds from result.json, the output of `trammel certify --json`.

With --check it writes nothing; the exit status is 1 if the section differs.
"""
import json
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "support"))
import page_section  # noqa: E402
HEADS = ("Configuration", "Cases", "Checks", "Verdicts that differ", "Digits, median")


def row(entry, flips):
    differ = sum(flip["configuration"] == entry["configuration"] for flip in flips)
    cells = (entry["cases"], entry["checks"], differ, f'{entry["median_digits"]:.1f}')
    return f'    <tr><th scope="row">{entry["configuration"]}</th>{"".join(f"<td>{c}</td>" for c in cells)}</tr>'


def main():
    result = json.loads((HERE / "result.json").read_text())
    flips = result["flips"]
    heads = "".join(f'<th scope="col">{head}</th>' for head in HEADS)
    return page_section.write(
        "certification", "Digits with other rounding modes and other builds",
        f"{result['of']}. The solver uses a directed rounding mode or a different build. The table lists the verdicts that differ"
        " from those of gcc -O3 with rounding to nearest, and the digits of judged numbers that agree."
        f" {result['tight_tolerances']} checks, bounds not counted, have a tolerance of less than ten times the largest difference.",
        "Verdicts and digits by configuration",
        [f"    <thead><tr>{heads}</tr></thead>", "    <tbody>",
         *(row(entry, flips) for entry in result["configurations"]), "    </tbody>"],
        ["  <ul>", *(f'    <li>{f["check"]} ({f["configuration"]}): {f["to"]} instead of {f["from"]}</li>' for f in flips),
         "  </ul>"] if flips else ["  <p>No verdict differs.</p>"])


if __name__ == "__main__":
    sys.exit(main())
