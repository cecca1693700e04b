#!/usr/bin/env python3
"""Faults that need no thought: constants, operators, indices, conditions, dropped terms of the solver.

Finds every place for one, draws some by a seed, leaves out those that do not compile (numbers that the
compiler must know, among others) or lie in headers that others than the solver include, and writes them
as mutate.py reads them, with nothing expected.
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import random
import re

import seeding
from seeding import ROOT

# What stands at a place (its group), and why another does: the class of the fault.
PLACES = ((r"(?<![\w.])((?:\d+\.\d*|\d+)(?:e-?\d+)?)(?![\w.'])", "constant"),
          (r"(?<=\[)(\d+)(?=\])|(?<=[\w>]\()(\d)(?=[,)])", "index"),
          (r"(?<=[\w)\]] )([-+*/])(?=\s)", "operator"),
          (r"(?:[(\[{]|[,=?:] |return )(-)(?=[\w(])", "sign"),
          (r"(?<=\S )(<|>|<=|>=|==|!=|&&|\|\|)(?=\s)", "condition"),
          (r"\bif (\((?:[^()\n]|\((?:[^()\n]|\([^()\n]*\))*\))*\))", "condition"),
          (r"(?<=[\w)\]] )([-+])(?=\s)", "term"),
          (r"\n +([\w.\->:\[\]]+(?:\(.*\)|(?:\([\w, ]*\))? [-+*]?= .*);)(?=\n)", "term"))
HIDDEN = (r'//.*|"(?:\\.|[^"\n])*"|^ *#.*|\boperator\S+'
          r"|^.*\b(?:constexpr|template|static_assert|case|using|enum|concept)\b.*")
OPPOSITE = dict(zip("+ - * / < <= > >= == != && ||".split(), "- + / * <= < >= > != == false true".split()))


def replacement(old, why):
    if why == "constant":
        return f"2 * {old}" if re.search(r"[.e]", old) and float(old) else str(int(float(old)) + 1)
    if why == "index":
        return str(int(old) - 1) if int(old) else "1"
    if why == "term":
        return old + " 0 *" if old in "+-" else "(void)0;"
    if why == "sign":
        return ""
    return OPPOSITE.get(old, f"!{old}")


def is_elsewhere(text, begin, end):
    """Whether a text has another place, too."""
    return text.find(text[begin:end]) != begin or text.find(text[begin:end], begin + 1) >= 0


def places(file):
    """All faults of a file."""
    text = (ROOT / file).read_text()
    plain = re.sub(HIDDEN, lambda m: " " * len(m[0]), text, flags=re.MULTILINE)
    for pattern, why in PLACES:
        for match in re.finditer(pattern, plain):
            begin, end = match.span(match.lastindex)
            start, old = begin, text[begin:end]
            while is_elsewhere(text, start, end) or text[start].isspace():
                start -= 1
            before = text[start:begin]
            yield {"file": file, "before": before, "old": old, "new": replacement(old, why), "why": why,
                   "span": (begin, end)}


def apart(fault, others):
    """Whether the text of a fault lies beside, within or about each of the others."""
    (a, b), file = fault["span"], fault["file"]
    spans = [o["span"] for o in others if o["file"] == file]
    return all(b <= c or d <= a or (a, b) != (c, d) and (a <= c and d <= b or c <= a and b <= d)
               for c, d in spans)


def that_compile(build, faults, others):
    """@returns  faults without those in lines that the compiler speaks of"""
    names = None
    spoken = re.compile(rf"^{re.escape(str(build.tree))}/(\S+?):(\d+):(?:\d+:)? +(?:error:|required from)", re.MULTILINE)
    while True:
        touched = build.dependents(build.patch(seeding.number(others + faults)))
        names = names or sorted(touched & build.objects("harness/trammel"))
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            errors = pool.map(lambda name: build.compile(name, "-fsyntax-only"), names)
            said = {name: text for name, text in zip(names, errors) if text}
        if not said:
            return faults
        lines = {(file, int(line)) for text in said.values() for file, line in spoken.findall(text)}
        texts = {f["file"]: (ROOT / f["file"]).read_text() for f in faults}
        line_of = lambda f: texts[f["file"]].count("\n", 0, f["span"][0]) + 1
        lines |= {(file, line - 1) for file, line in lines}  # an operator at a line's end
        kept = [f for f in faults if (f["file"], line_of(f)) not in lines]
        print(f"{len(faults) - len(kept)} of {len(faults)} do not compile", flush=True)
        if len(kept) == len(faults):
            raise SystemExit("\n".join(said.values())[:20000])
        faults, names = kept, sorted(said)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, help="a ready build folder")
    parser.add_argument("out", type=pathlib.Path, help="a file of faults")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=300)
    given = parser.parse_args()
    sources = [f for f in (ROOT / "solver").rglob("*") if f.suffix in (".h", ".cpp")]
    files = sorted(str(f.relative_to(ROOT)) for f in sources)
    found = [fault for file in files for fault in places(file)]
    random.Random(given.seed).shuffle(found)
    listed = sorted((ROOT / "tests/mutation/faults").glob("*.json"))
    others = seeding.load([f for f in listed if f.name != given.out.name])
    build = seeding.Build(given.build.resolve(), given.build.resolve() / "mutation-generic", os.cpu_count())
    program = build.objects("harness/trammel")
    drawn, own = [], {f: all(o.startswith("solver/") for o in build.dependents({f}) & program) for f in files}
    for index, fault in enumerate(found):
        if len(drawn) < 3 * given.count // 2 and own[fault["file"]] and apart(fault, others + drawn):
            drawn.append({**fault, "id": f"generic-{index + 1}", "kind": "generic", "expected": []})
    kept = that_compile(build, drawn, others)[:given.count]
    print(f"{len(found)} places; {len(kept)} by seed {given.seed}, the last one drawn as {kept[-1]['id']}")
    keys = ("id", "file", "before", "old", "new", "why", "expected")
    lines = ",\n".join(" " + json.dumps({key: fault[key] for key in keys}) for fault in kept)
    given.out.write_text(f'{{"kind": "generic", "faults": [\n{lines}\n]}}\n')


if __name__ == "__main__":
    main()
