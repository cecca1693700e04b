"""Reads faults as data and makes a build that contains all of them behind switches.

A fault replaces a text that occurs exactly once in a source. All faults are written into a copy of the sources.
Only the affected objects are compiled again and linked with the rest of a ready build.
"""
import concurrent.futures
import json
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
OPTIONAL = {"before", "type", "quick", "smallest_error"}
KINDS = ("physical", "judging", "coefficient", "generic")
KEYS = {"id", "file", "old", "new", "why", "expected"} | OPTIONAL
FOLDERS = ("solver", "harness", "references", "reports", "tests")


def number(faults):
    """Numbers the faults and locates their source texts. A changed source text or a duplicate fault is an error."""
    same = {}
    for index, fault in enumerate(faults):
        text = (ROOT / fault["file"]).read_text()
        before = fault.get("before", "")
        place = before + fault["old"]
        if text.count(place) != 1 or fault["old"] == fault.get("new"):
            sys.exit(f"{fault['id']}: expected a text that occurs once in {fault['file']} (got "
                     f"{text.count(place)}), and another in its place: {place!r}")
        begin = text.index(place) + len(before)
        fault.update(number=index, span=(begin, begin + len(fault["old"])))
        change = fault["file"], fault["span"], "".join(fault.get("new", "1 %").split())
        if same.setdefault(change, fault["id"]) != fault["id"]:
            sys.exit(f"{fault['id']}: the same as {same[change]}")
    return faults


def load(files):
    """Returns the faults of some files."""
    faults = []
    for file in files:
        data = json.loads(file.read_text())
        if set(data) != {"kind", "faults"} or data["kind"] not in KINDS:
            sys.exit(f"{file}: expected 'kind', one of {KINDS}, and 'faults'")
        needed = KEYS - OPTIONAL - ({"new"} if data["kind"] == "coefficient" else set())
        for fault in data["faults"]:
            if not needed <= set(fault) <= KEYS:
                sys.exit(f"{file}: expected the keys {sorted(needed)} (got {sorted(fault)})")
            faults.append({**fault, "kind": data["kind"]})
    ids = [fault["id"] for fault in faults]
    if len(set(ids)) < len(ids):
        sys.exit(f"duplicate ids: {sorted({i for i in ids if ids.count(i) > 1})}")
    return number(faults)


# Text inserted after an operator that a fault may change. Its precedence is the same or the highest (->*).
OPERATORS = {**dict.fromkeys("+-", "Factor{{{number}, {size}}} *"),
             **dict.fromkeys("*/", "Reciprocal{{{number}}} ->*"),
             **dict.fromkeys(("<", ">", "<=", ">=", "==", "!="), "Compared{{{number}}} {old}"),
             "&&": "fault({number}) == 0 &&", "||": "fault({number}) ||"}


def switched(fault, old):
    """Returns the text with its switch; `old` is the text with the inner switches."""
    number, name = fault["number"], fault.get("type", "")
    if fault["old"] in OPERATORS:
        here = OPERATORS[fault["old"]]
        size = 0 if fault["new"].endswith("0 *") else -1
        if not fault["new"]:  # the fault is a changed sign of the following operand
            return f"::trammel::Factor{{{number}, 1, -1}} *"
        return f"{old} ::trammel::" + here.format(number=number, size=size, old=fault["old"])
    if fault.get("kind") == "coefficient":
        return f"::trammel::scaled({number}, {name}({old}))"
    if fault["old"].endswith(";"):
        return f"{{ if (::trammel::fault({number})) {{ {fault['new']} }} else {{ {old} }} }}"
    return f"(::trammel::fault({number}) ? {name}({fault['new']}) : {name}({old}))"


def patched(text, faults, begin=0, end=None):
    """Returns the text with its faults, which are separate or nested."""
    out, at, end = "", begin, len(text) if end is None else end
    rest = sorted(faults, key=lambda f: (f["span"][0], -f["span"][1]))
    while rest:
        outer, low, high = rest[0], *rest[0]["span"]
        inner = [f for f in rest[1:] if f["span"][0] < high]
        rest = [f for f in rest[1:] if f["span"][0] >= high]
        if any(f["span"][1] > high for f in inner):
            sys.exit(f"{outer['id']}: its text overlaps the text of {[f['id'] for f in inner]}")
        out += text[at:low] + switched(outer, patched(text, inner, low, high))
        at = high
    return out + text[at:end]


class Build:
    """Links targets that contain the faults, from a ready build folder."""

    def __init__(self, folder, out, jobs):
        self.folder, self.out, self.jobs = folder, out, jobs
        self.tree = out / "tree"
        listed = json.loads(self.said("ninja", "-t", "compdb"))
        self.rule = {entry["output"]: entry for entry in listed}
        # Link commands name an archive with its folder, but compdb lists it without.
        self.rule.update({self.archive_of(e["command"]): e for e in listed if " ar qc " in e["command"]
                          or "/ar qc " in e["command"]})

    @staticmethod
    def archive_of(command):
        return re.search(r"ar qc (\S+)", command).group(1)

    def said(self, *command):
        return subprocess.run(command, cwd=self.folder, check=True, capture_output=True, text=True).stdout

    def dependents(self, files):
        """Returns the objects that depend on the files."""
        wanted, found, current = {str(ROOT / file) for file in files}, set(), None
        for line in self.said("ninja", "-t", "deps").splitlines():
            if line and not line.startswith(" "):
                current = line.split(":")[0]
            elif line.strip() in wanted:
                found.add(current)
        return found

    def objects(self, target):
        words = self.rule[target]["command"].split()
        archives = [w for w in words if w.endswith(".a") and w in self.rule and w != target]
        return {w for w in words if w.endswith(".o")}.union(*(self.objects(a) for a in archives))

    def compile(self, name):
        """Compiles an object from the copy of the sources. @returns  errors"""
        entry, made = self.rule[name], self.out / "objects" / name
        made.parent.mkdir(parents=True, exist_ok=True)
        source = pathlib.Path(entry["file"])
        if source.is_relative_to(self.folder):  # unity build: a source that includes others
            copy = made.with_suffix(".cpp")
            copy.write_text(source.read_text().replace(f'"{ROOT}/', f'"{self.tree}/'))
        else:
            copy = self.tree / source.relative_to(ROOT)
        command = entry["command"].replace(f"-I{ROOT} ", f"-I{self.tree} ").replace(f" -c {source}", "")
        command = re.sub(r" -M[DTF]( \S+\.o(\.d)?)?", "", command).replace(f"-o {name}", f"-o {made}")
        command = command.replace(" -O3 ", " -O1 ")  # half the time; a comparison confirms the same bits
        command += f" -w -include {self.tree}/tests/mutation/fault.h -c {copy}"
        done = subprocess.run(command, shell=True, cwd=self.folder, capture_output=True, text=True)
        return done.stderr if done.returncode != 0 else ""

    def patch(self, faults):
        """Copies the sources and inserts the faults."""
        shutil.rmtree(self.tree, ignore_errors=True)
        for folder in FOLDERS:
            shutil.copytree(ROOT / folder, self.tree / folder, symlinks=True)
        texts = {f["file"]: (ROOT / f["file"]).read_text() for f in faults}
        for file, text in texts.items():
            (self.tree / file).write_text(patched(text, [f for f in faults if f["file"] == file]))
        return set(texts)

    def run(self, faults, targets):
        """@returns  target -> program"""
        touched = self.dependents(self.patch(faults)) & set().union(*(self.objects(t) for t in targets))
        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            errors = [e for e in pool.map(self.compile, sorted(touched)) if e]
        if errors:
            sys.exit("\n".join(line for e in errors for line in e.splitlines() if " error: " in line))
        return {target: self.link(target, touched) for target in targets}

    def link(self, target, touched):
        program = self.out / "bin" / pathlib.Path(target).name
        program.parent.mkdir(exist_ok=True)
        words = []
        for word in self.rule[target]["command"].split():
            ours = touched & self.objects(word) if word.endswith(".a") and word in self.rule else ()
            if ours:
                copy = self.out / pathlib.Path(word).name
                shutil.copy(self.folder / word, copy)
                subprocess.run(["ar", "r", copy, *(self.out / "objects" / o for o in ours)], check=True)
                word = str(copy)
            words.append(str(self.out / "objects" / word) if word in touched else word)
        command = " ".join(words).replace(f"-o {target}", f"-o {program}")
        subprocess.run(command, shell=True, cwd=self.folder, check=True)
        return program
