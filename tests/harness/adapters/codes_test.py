"""Tests that the answers of another code through its adapter agree with trammel.

    codes_test.py TRAMMEL CODE ADAPTER...

The exit status is 77 if the code is not installed, or 1 if TRAMMEL_OTHER_CODES=required is set.
"""
import json
import os
import shutil
import subprocess
import sys
import tempfile

# case or case:variant, quantity, and its tolerance relative to the largest entry
CALCULIX = {
    "cantilever-tip-force": {"reaction_y_N:A": 1e-8, "bending_moment_N_m:AB.start": 1e-8},  # the restart file has all digits
    "portal-frame": {"displacement_x_m:B": 1e-8, "rotation_rad:C": 1e-8, "reaction_moment_N_m:A": 1e-8},
    "timoshenko-cantilever-tip-force": {"displacement_y_m:B": 1e-9},
    "exact-statics:welded-hinged-start": {"rotation_rad:P": 1e-8, "reaction_x_N:A3": 1e-7},  # P has no rotation without U1
    "frame-every-part": {"displacement_x_m:C": 1e-6, "axial_force_N:AC.start": 1e-6},  # springs at nodes that depend on other nodes
    "scene-soft-joints": {"displacement_x_m:P": 1e-4},  # springs on rotations, for which elements U1 are wrong
    "scene-thick-links": {"displacement_x_m:P": 1e-9},  # a plate may contract across its plane
    "manipulator-modes": {"frequency_Hz": 4e-4},  # triangles have inertia about their centroid; four elements per link in trammel
    "scene-thick-link-modes": {"frequency_Hz": 3e-3},  # shear-flexible strips with their mass in a core; four elements per link in trammel
    "exact-locked-welded-hinged": {"frequency_Hz": 2e-5},
    "tapered-cantilever": {"frequency_Hz": 3e-5},  # short elements lose three digits
    "beam-clamped-pinned": {"frequency_Hz": 2e-4},  # no rotary inertia; the mesh error of trammel is 6e-5
    "prestressed-pinned-pinned": {"frequency_Hz": 3e-4},
    "buckling-clamped-free": {"critical_force_N:tip": 1e-3},  # P / EA
    "macneal-harder-beam": {"displacement_y_m:C": 1e-6},
    "scene-struck-arm": {"displacement_y_m:B": 1e-3},
}
GETFEM = {
    "uniform-stress": {"stress_xx_Pa:C": 1e-13, "stress_xy_Pa:M": 1e-13},
    "cooks-membrane": {"displacement_y_m:M": 1e-8, "compliance_J": 1e-8},
    "macneal-harder-beam": {"displacement_y_m:C": 1e-7},
    "nafems-le1": {"stress_yy_Pa:D": 1e-6, "displacement_y_m:B": 1e-6},
    "pressurised-ring": {"displacement_x_m:A": 1e-8, "stress_yy_Pa:A": 1e-4},  # stresses of curved triangles are averaged at different points
    "nafems-fv32:three-node": {"frequency_Hz": 1e-10},
    "nafems-t33": {"frequency_Hz": 1e-8},
}
SIMBODY = {
    "iftomm-a01-pendulum": {"position_x_m:B": 1e-7},
    "iftomm-a03-andrews": {"angle_rad:beta": 1e-7, "angle_rad:Omega": 2e-7},
    "circle-kinematics": {"active_angle_rad:A1": 1e-12},
    "circle-inverse-dynamics:load": {"torque_N_m:A1": 1e-11, "torque_N_m:A3": 1e-11},
    "unequal-rigid-manipulator": {"torque_N_m:A2": 1e-11, "passive_acceleration_rad_per_s2:B3": 1e-11, "kinetic_energy_J": 1e-12},
    "unequal-rigid-manipulator:driven": {"motion_x_m": 1e-10, "motion_velocity_phi_rad_per_s": 1e-9},
}
STATSMODELS = {"grnn-example": {"prediction:1": 1e-14}, "grnn-example:duplicates": {"prediction:1": 1e-14, "prediction:2": 1e-14}}
CASES = {"calculix": CALCULIX, "getfem": GETFEM, "simbody": SIMBODY, "statsmodels": STATSMODELS}
CANNOT = {"calculix": "rotating-cantilever-hub-0", "getfem": "portal-frame", "simbody": "portal-frame", "statsmodels": "grnn-example:small"}


def imports(module):
    """Returns True if the system's interpreter, which runs the adapters, has the module."""
    return subprocess.run(["/usr/bin/python3", "-c", f"import {module}"], stderr=subprocess.DEVNULL, check=False).returncode == 0


THERE = {"calculix": lambda: shutil.which("ccx"), "getfem": lambda: imports("getfem"),
         "simbody": lambda: sys.argv[-1] != "none", "statsmodels": lambda: imports("statsmodels")}


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
        print(f"{code} is not installed: .ci/install lint")
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
