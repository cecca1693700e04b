#!/usr/bin/env python3
"""Writes the page's section about rounding from result.json: what `trammel certify --json` said of the
cases that it names.

With --check it writes nothing, and exit status 1 says that the page has another section.
"""
import json
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "support"))
import page_section  # noqa: E402
HEADS = ("Rounded", "Checks", "Verdicts that differ", "Digits, median")


def row(entry, flips):
    differ = sum(flip["configuration"] == entry["configuration"] for flip in flips)
    cells = (entry["checks"], differ, f'{entry["median_digits"]:.1f}')
    return f'    <tr><th scope="row">{entry["configuration"].capitalize()}</th>{"".join(f"<td>{c}</td>" for c in cells)}</tr>'


def main():
    result = json.loads((HERE / "result.json").read_text())
    flips = result["flips"]
    heads = "".join(f'<th scope="col">{head}</th>' for head in HEADS)
    return page_section.write(
        "certification", "Digits under other rounding",
        f"{result['of']}, with the solver rounding one way throughout: verdicts that differ, and digits of judged"
        " numbers that agree, from those rounded to the nearest.",
        "Verdicts and digits by way of rounding",
        [f"    <thead><tr>{heads}</tr></thead>", "    <tbody>",
         *(row(entry, flips) for entry in result["configurations"]), "    </tbody>"],
        ["  <ul>",
         *(f'    <li>{f["check"]}, rounded {f["configuration"]}: {f["to"]} instead of {f["from"]}</li>' for f in flips),
         "  </ul>"])


if __name__ == "__main__":
    sys.exit(main())
