"""What other codes answer through their adapters agrees with trammel.

    codes_test.py TRAMMEL CODE ADAPTER...

77 where the code is not installed, or 1 where TRAMMEL_OTHER_CODES=required says that it has to be.
"""
import json
import os
import shutil
import subprocess
import sys
import tempfile

# case or case:variant, quantity, and how far it may be off, relative to its largest entry
CALCULIX = {
    "cantilever-tip-force": {"reaction_y_N:A": 1e-8, "bending_moment_N_m:AB.start": 1e-8},  # all digits, from the restart file
    "portal-frame": {"displacement_x_m:B": 1e-8, "rotation_rad:C": 1e-8, "reaction_moment_N_m:A": 1e-8},
    "timoshenko-cantilever-tip-force": {"displacement_y_m:B": 1e-9},
    "exact-statics:welded-hinged-start": {"rotation_rad:P": 1e-8, "reaction_x_N:A3": 1e-7},  # no U1 at P gives it a rotation
    "frame-every-part": {"displacement_x_m:C": 1e-6, "axial_force_N:AC.start": 1e-6},  # springs on nodes that others follow
    "scene-soft-joints": {"displacement_x_m:P": 1e-4},  # springs on rotations, which U1 gets wrong
    "scene-thick-links": {"displacement_x_m:P": 1e-9},  # a plate may contract out of its plane
    "manipulator-modes": {"frequency_Hz": 4e-4},  # triangles have inertia about their middle; four elements a link in trammel
    "beam-clamped-pinned": {"frequency_Hz": 2e-4},  # no rotary inertia; the mesh of trammel itself 6e-5
    "prestressed-pinned-pinned": {"frequency_Hz": 3e-4},
    "buckling-clamped-free": {"critical_force_N:tip": 1e-3},  # P / EA
    "macneal-harder-beam": {"displacement_y_m:C": 1e-6},
    "scene-struck-arm": {"displacement_y_m:B": 1e-3},
}
CASES = {"calculix": CALCULIX}
CANNOT = {"calculix": "rotating-cantilever-hub-0"}
THERE = {"calculix": lambda: shutil.which("ccx")}


def run(*words, codes=(0,)):
    done = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode not in codes:
        sys.exit(f"{' '.join(words)}: {done.returncode}\n{done.stdout}")


def export(trammel, name):
    case, _, variant = name.partition(":")
    run(trammel, "export", case, *(["--variant", variant] if variant else []), "--out", "case.json")


def values(file, name):
    with open(file, encoding="utf-8") as text:
        found = json.load(text)["quantities"][name]["values"]
    return found if isinstance(found, list) else [found]


def main():
    trammel, code, *adapter = sys.argv[1:]
    if not THERE[code]():
        print(f"{code} is not installed: .ci/install codes")
        sys.exit(1 if os.environ.get("TRAMMEL_OTHER_CODES") == "required" else 77)
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for case, quantities in CASES[code].items():
            export(trammel, case)
            run(trammel, "solve", "case.json", "own.json")
            run(*adapter, "case.json", "result.json")
            for name, tolerance in quantities.items():
                own, other = values("own.json", name), values("result.json", name)
                worst = max(abs(a - b) for a, b in zip(own, other)) / max(map(abs, own))
                print(f"{case} {name}: off by {worst:.1e}")
                if len(own) != len(other) or not worst <= tolerance:
                    sys.exit(f"{case} {name}: off by {worst:.1e}, more than {tolerance}")
        export(trammel, CANNOT[code])
        run(*adapter, "case.json", "result.json", codes=(4,))


if __name__ == "__main__":
    main()
