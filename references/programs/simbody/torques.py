#!/usr/bin/env python3
"""Torques of the rigid manipulator of Table 1 along the paper's circle by Simbody 3.7, at 1, 10 and 50 rad/s.

    torques.py SIMBODY_ADAPTER OUT      writes simbody-circle-torques-SPEED into OUT/references.json

This program derives bodies, joints and path from the dimensions of the paper, in the format that tests/benchmarks/simbody_adapter.cpp reads.
"""
import json
import math
import os
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../calculix"))
from spatial_manipulator import DEFAULT, geometry, store  # noqa: E402

POINTS, SPEEDS, RADIUS, CENTER = 8, (1, 10, 50), 0.01, (0.25, 0.144)


def body(a, b, mass):
    length = math.dist(a, b)
    return {"mass_kg": mass, "inertia_kg_m2": mass * length**2 / 12, "center_m": [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2],
            "angle_rad": math.atan2(b[1] - a[1], b[0] - a[0])}


def mechanism(speed):
    path = {"time_s": [], "pose_m_rad": [], "velocity_per_s": [], "acceleration_per_s2": []}
    for i in range(POINTS):
        angle = 2 * math.pi * i / POINTS
        c, s = RADIUS * math.cos(angle), RADIUS * math.sin(angle)
        path["time_s"].append(angle / speed)
        path["pose_m_rad"].append([CENTER[0] + c, CENTER[1] + s, 0.0])
        path["velocity_per_s"].append([-speed * s, speed * c, 0.0])
        path["acceleration_per_s2"].append([-speed**2 * c, -speed**2 * s, 0.0])
    base, elbows, corners = geometry({**DEFAULT, "pose": path["pose_m_rad"][0]})
    link = DEFAULT["rho"] * DEFAULT["length"] * DEFAULT["width"] * DEFAULT["thickness"]
    plate = DEFAULT["rho"] * math.sqrt(3) / 4 * DEFAULT["side"]**2 * DEFAULT["plate_thickness"]
    bodies, joints = {}, {}
    for n, a, b, c in zip("123", base, elbows, corners):
        bodies[f"A{n}-B{n}"], bodies[f"B{n}-C{n}"] = body(a, b, link), body(b, c, link)
        joints.update({name + n: {"position_m": list(p)} for name, p in (("A", a), ("B", b), ("C", c))})
    bodies["platform"] = {"mass_kg": plate, "inertia_kg_m2": plate * DEFAULT["side"]**2 / 12,
                          "center_m": path["pose_m_rad"][0][:2], "angle_rad": 0.0}
    return {"bodies": bodies, "joints": joints, "path": path}


def torques(adapter, speed):
    names = [f"torque_N_m:A{i}" for i in (1, 2, 3)]
    case = {"model": {}, "analysis": {"inverse-dynamics": {}},
            "export": {"mechanism": mechanism(speed), "quantities": [{"name": name, "unit": "N m"} for name in names]}}
    with tempfile.TemporaryDirectory() as folder:
        given, answer = (os.path.join(folder, name) for name in ("case.json", "result.json"))
        with open(given, "w", encoding="ascii") as file:
            json.dump(case, file)
        subprocess.run([adapter, given, answer], check=True)
        with open(answer, encoding="ascii") as file:
            found = json.load(file)["quantities"]
    return [found[name]["values"][i] for i in range(POINTS) for name in names]


def main():
    adapter, folder = sys.argv[1:]
    for speed in SPEEDS:
        name = f"simbody-circle-torques-{speed}"
        store(folder, name, f"Rigid 3-RRR along the circle at {speed} rad/s: torques of A1, A2, A3 at {POINTS} points, by Simbody", "N m",
              torques(adapter, speed), 1e-12, "Seven rigid bodies, nine pin joints. Simbody's findMotionForces computes the forces for prescribed "
              "accelerations. Positions and velocities are projected on the constraints to 1e-13.", source="simbody-3.7")


if __name__ == "__main__":
    main()
