#!/usr/bin/env python3
"""Runs the program with system faults: memory, disk, signals, gnuplot, clock and environment.

Each call must end with a line and the correct exit status. Results of a former call must stay unchanged or be replaced completely.
Prints a table; the exit status is 1 if a call fails these tests."""
import argparse
import ctypes
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile

CANNOT = 125  # exit status if this machine does not permit the fault
CASE = {
    "id": "own", "title": "A cantilever",
    "model": {
        "materials": {"steel": {"E_Pa": 2e11, "rho_kg_m3": 7800, "nu": 0.3}},
        "sections": {"bar": {"material": "steel", "rectangle": {"thickness_m": 0.1, "width_m": 0.05}}},
        "nodes": {"A": [0, 0], "B": [2, 0]},
        "members": {"AB": {"nodes": ["A", "B"], "section": "bar"}},
        "supports": {"A": ["x", "y", "rotation"]},
        "loads": {"tip": {"node": "B", "force_N": [0, 100]}}},
    "analysis": {"statics": {}},
    "variants": {"v": {"title": "V", "model": {"elements": 2}}},
}


class Bench:
    """A command with a case, and the folder of its earlier results, which must not be damaged."""

    def __init__(self, folder, command, program, library):
        self.folder, self.command, self.program, self.library = folder / command, command, program, library
        self.out = self.folder / "out"
        self.folder.mkdir()
        (self.folder / "own.json").write_text(json.dumps(CASE))
        status, said = self.call()
        if status != 0:
            sys.exit("the case itself does not run: " + said)
        self.files = self.written()

    def call(self, fault=None, environment=None, before=None, out=None):
        """Returns the exit status as a shell does, or -1 after four minutes, and standard error."""
        surroundings = {**os.environ, **(environment or {})}
        surroundings = {name: value for name, value in surroundings.items() if value is not None}
        if fault:
            surroundings.update(TRAMMEL_FAULT=fault, LD_PRELOAD=self.library)
        words = [self.program, self.command, str(self.folder / "own.json"), "--jobs", "2", "--out",
                 str(out or self.out)]
        if self.command == "report":
            words.append("--fresh")  # computes again instead of reusing stored runs
        try:
            done = subprocess.run(words, env=surroundings, preexec_fn=before, timeout=240,
                                  stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                  stderr=subprocess.PIPE)
        except subprocess.TimeoutExpired as late:
            return -1, (late.stderr or b"").decode(errors="replace")
        status = done.returncode if done.returncode >= 0 else 128 - done.returncode
        return status, done.stderr.decode(errors="replace")

    def written(self):
        return {str(file.relative_to(self.out)) for file in self.out.rglob("*")
                if file.is_file() and file.suffix != ".cbor" and ".part-" not in file.name}

    def damage(self):
        """Returns a description of the damage to the results, or an empty text."""
        try:
            if len(json.loads((self.out / "results.json").read_text())["runs"]) != 2:
                return "results.json has lost runs"
        except (OSError, ValueError) as error:
            return f"results.json: {error}"
        for file, end in (("junit.xml", "</testsuites>"), ("index.html", "</html>")):
            if file in self.files and not (self.out / file).read_text().endswith(end + "\n"):
                return file + " is cut"
        lost = self.files - self.written()
        return f"{lost} lost" if lost else ""


class Faults:
    def __init__(self):
        self.rows = {}

    def check(self, what, bench, expected=(0, 2), **how):
        row = self.rows.setdefault(f"{bench.command}: {what}", [0, 0, 0, 0, 0])
        status, said = bench.call(**how)
        row[0] += 1
        if status == CANNOT:
            row[3] += 1
            return
        wrong = ""
        if status not in expected:
            wrong = f"exit status {status}"
        elif status == 2 and not said.strip():
            wrong = "no line"
        wrong = wrong or bench.damage()
        row[1 if status == 0 else 2] += 1
        if wrong:
            row[4] += 1
            print(f"{bench.command}: {what} {how.get('fault') or ''}: {wrong}: {said[-300:].strip()}")

    def print_table(self):
        print(f"{'fault':34}{'calls':>7}{'status 0':>10}{'refused':>9}{'not here':>10}{'wrong':>7}")
        for what, row in self.rows.items():
            print(f"{what:34}{row[0]:7}{row[1]:10}{row[2]:9}{row[3]:10}{row[4]:7}")
        return any(row[4] for row in self.rows.values())


def steps(count, last):
    """Returns numbers from 1 to `last` in geometric steps."""
    return sorted({round(last ** (i / max(1, count - 1))) for i in range(count)})


def fail_memory_and_disk(faults, bench, count):
    numbers = re.findall(r"counted (\d+) calls, (\d+) bytes", bench.call(fault="count:0")[1])
    for kind, last in zip(("memory", "disk"), map(int, numbers[-1])):
        for n in steps(count, last):
            faults.check(kind + " fails", bench, (2,) if n == 1 else (0, 2), fault=f"{kind}:{n}")


def send_signals(faults, bench):
    for stage in ("read", "compute", "result") + (("draw",) if bench.command == "report" else ()):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
            faults.check("signal at " + stage, bench, (128 + number,), fault=f"{stage}:{number}")
            faults.check("call after a signal", bench, (0,))


def mount(folder, flags, options):
    """Mounts a small disk that only the calling process can see."""
    library = ctypes.CDLL(None, use_errno=True)
    new_mounts, new_user, private = 0x20000, 0x10000000, 0x44000
    alone = library.unshare(new_mounts) == 0 or library.unshare(new_mounts | new_user) == 0
    if not alone or library.mount(b"none", b"/", None, private, None) != 0 or \
            library.mount(b"small", str(folder).encode(), b"tmpfs", flags, options) != 0:
        os._exit(CANNOT)


def change_surroundings(faults, bench):
    empty, own = bench.folder / "empty", bench.folder / "bin"
    for folder in (empty, own):
        folder.mkdir()
    faults.check("no gnuplot", bench, (2,), environment={"PATH": str(empty)})
    # Shortens the time limit that the program gives to gnuplot (timeout -k 5 SECONDS gnuplot -d).
    (own / "timeout").write_text('#!/bin/sh\nshift 3\nexec /usr/bin/timeout -k 1 2 "$@"\n')
    (own / "timeout").chmod(0o755)
    for what, script in (("gives up", "exit 1"), ("hangs", "exec sleep 1000")):
        (own / "gnuplot").write_text("#!/bin/sh\n" + script + "\n")
        (own / "gnuplot").chmod(0o755)
        path = {"PATH": f"{own}:{os.environ['PATH']}"}
        faults.check("gnuplot " + what, bench, (2,), environment=path)
    for what, names in (("no HOME", {"HOME": None}), ("no TMPDIR", {"TMPDIR": str(empty / "none")}),
                        ("C locale", {"LC_ALL": "C"}), ("Latin 1", {"LC_ALL": "de_DE.ISO-8859-1"}),
                        ("comma decimals", {"LC_ALL": "de_DE.UTF-8"})):
        before = None
        if "de_DE" in names.get("LC_ALL", ""):
            names["LOCPATH"] = locale_folder(bench.folder, names["LC_ALL"])
            if not (bench.folder / names["LC_ALL"]).exists():
                before = lambda: os._exit(CANNOT)
        faults.check(what, bench, (0,), environment=names, before=before)
    faults.check("clock steps back", bench, (0,), fault="clock:0")
    disk = bench.folder / "disk"
    disk.mkdir()
    for what, flags, options in (("full", 0, b"size=16k"), ("full", 0, b"size=48k"), ("read-only", 1, b"")):
        faults.check(what + " file system", bench, (2,), out=disk / "out",
                     before=lambda flags=flags, options=options: mount(disk, flags, options))
    faults.check("full standard output", bench, (2,),
                 before=lambda: os.dup2(os.open("/dev/full", os.O_WRONLY), 1))


def locale_folder(folder, name):
    """Returns a folder with a rare locale, which is built if the locale sources are installed."""
    subprocess.run(["localedef", "-i", "de_DE", "-f", name.split(".")[1], str(folder / name)],
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
    return str(folder)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program")
    parser.add_argument("library", help="to be loaded before the C library (inject.cpp)")
    parser.add_argument("--count", type=int, default=20, help="values of n where memory or disk fails")
    words = parser.parse_args()
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # background processes of a shell ignore SIGINT by default
    faults = Faults()
    with tempfile.TemporaryDirectory(prefix="trammel-faults-") as folder:
        for command in ("run", "report"):
            bench = Bench(pathlib.Path(folder), command, words.program, words.library)
            many = words.count if command == "run" else max(2, words.count // 4)
            fail_memory_and_disk(faults, bench, many)
            send_signals(faults, bench)
        change_surroundings(faults, bench)
    return faults.print_table()


if __name__ == "__main__":
    sys.exit(main())
