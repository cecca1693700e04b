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
        "certification", "Digits under other rounding and in other builds",
        f"{result['of']}: the solver rounding one way throughout, or built another way. Verdicts that differ, and digits of"
        " judged numbers that agree, from those of gcc -O3 rounded to the nearest. Of"
        f" {result['tight_tolerances']} checks the tolerance is less than ten times the largest difference seen; bounds are not counted.",
        "Verdicts and digits by configuration",
        [f"    <thead><tr>{heads}</tr></thead>", "    <tbody>",
         *(row(entry, flips) for entry in result["configurations"]), "    </tbody>"],
        ["  <ul>", *(f'    <li>{f["check"]} ({f["configuration"]}): {f["to"]} instead of {f["from"]}</li>' for f in flips),
         "  </ul>"] if flips else ["  <p>No verdict differs.</p>"])


if __name__ == "__main__":
    sys.exit(main())
