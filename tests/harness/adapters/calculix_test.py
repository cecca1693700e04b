"""What CalculiX answers through its adapter agrees with trammel. calculix_test.py TRAMMEL ADAPTER; 77: no ccx here."""
import json
import os
import shutil
import subprocess
import sys
import tempfile

# quantity and how far it may be off, relative to its largest entry: digits that ccx prints; rotary inertia in modes of
# Euler-Bernoulli beams; the strip's shear and mesh in buckling
CASES = {
    "portal-frame": {"displacement_x_m:B": 1e-6, "rotation_rad:C": 1e-6, "reaction_moment_N_m:A": 1e-5},
    "timoshenko-cantilever-tip-force": {"displacement_y_m:B": 1e-6},
    "beam-clamped-pinned": {"frequency_Hz": 3e-4},
    "prestressed-pinned-pinned": {"frequency_Hz": 3e-3},
    "buckling-clamped-free": {"critical_force_N:tip": 1e-3},
    "scene-soft-joints": {"displacement_x_m:P": 1e-4},  # springs on rotations, which U1 gets wrong
    "macneal-harder-beam": {"displacement_y_m:C": 1e-3},
}


def run(*words, codes=(0,)):
    done = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode not in codes:
        sys.exit(f"{' '.join(words)}: {done.returncode}\n{done.stdout}")


def values(file, name):
    with open(file, encoding="utf-8") as text:
        found = json.load(text)["quantities"][name]["values"]
    return found if isinstance(found, list) else [found]


def main():
    trammel, adapter = map(os.path.abspath, sys.argv[1:3])
    if not shutil.which("ccx"):
        sys.exit(77)
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for case, quantities in CASES.items():
            run(trammel, "export", case, "--out", "case.json")
            run(trammel, "solve", "case.json", "own.json")
            run(sys.executable, adapter, "case.json", "result.json")
            for name, tolerance in quantities.items():
                own, other = values("own.json", name), values("result.json", name)
                worst = max(abs(a - b) for a, b in zip(own, other)) / max(map(abs, own))
                print(f"{case} {name}: off by {worst:.1e}")
                if len(own) != len(other) or worst > tolerance:
                    sys.exit(f"{case} {name}: off by {worst:.1e}, more than {tolerance}")
        run(trammel, "export", "rotating-cantilever-hub-0", "--out", "case.json")
        run(sys.executable, adapter, "case.json", "result.json", codes=(4,))


if __name__ == "__main__":
    main()
