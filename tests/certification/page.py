#!/usr/bin/env python3
"""Writes the page's section about rounding from result.json: what `trammel certify --json` said of the
cases that it names.

With --check it writes nothing, and exit status 1 says that the page has another section.
"""
import json
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
PAGE = HERE.parent.parent / "reports/templates/certification.mustache"
HEADS = ("Rounded", "Checks", "Verdicts that differ", "Digits, median")


def row(entry, flips):
    differ = sum(flip["configuration"] == entry["configuration"] for flip in flips)
    cells = (entry["checks"], differ, f'{entry["median_digits"]:.1f}')
    return f'    <tr><th scope="row">{entry["configuration"].capitalize()}</th>{"".join(f"<td>{c}</td>" for c in cells)}</tr>'


def main():
    result = json.loads((HERE / "result.json").read_text())
    flips = result["flips"]
    heads = "".join(f'<th scope="col">{head}</th>' for head in HEADS)
    text = "\n".join([
        '{{#certification}}<section id="certification">', "  <h2>Digits under other rounding</h2>",
        f"  <p>{result['of']}, with the solver rounding one way throughout: verdicts that differ, and digits of judged"
        " numbers that agree, from those rounded to the nearest.</p>", "  <details>",
        "  <summary>Verdicts and digits by way of rounding</summary>",
        '  <div class="scroll" role="region" aria-label="Verdicts and digits by way of rounding" tabindex="0">',
        '  <table class="results-table">', f"    <thead><tr>{heads}</tr></thead>", "    <tbody>",
        *(row(entry, flips) for entry in result["configurations"]), "    </tbody>", "  </table>", "  </div>", "  <ul>",
        *(f'    <li>{f["check"]}, rounded {f["configuration"]}: {f["to"]} instead of {f["from"]}</li>' for f in flips),
        "  </ul>", "  </details>", "</section>{{/certification}}", ""])
    if "--check" in sys.argv[1:]:
        return PAGE.read_text() != text
    PAGE.write_text(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
