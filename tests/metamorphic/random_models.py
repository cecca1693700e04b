#!/usr/bin/env python3
"""Writes random frames and mechanisms as cases, runs them with another unit of length and at an angle
(`metamorphic.py --folder`), and compares statics with large statics under small loads."""
import argparse
import copy
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

from laws import differences
from metamorphic import solve
from transformations import multiply_loads

SECONDS = 60
LOAD_SHARE = 1e-5
LINEAR_TOLERANCE = 1e-3  # nonlinear terms are of the order of the load fraction times slenderness^2


def base_model(rng):
    """Returns a model with one material and two sections of random slenderness."""
    depth = rng.uniform(0.01, 0.06)
    rectangle = {"thickness_m": depth, "width_m": rng.uniform(0.01, 0.06)}
    end = {"thickness_m": depth * rng.uniform(0.5, 0.9), "width_m": rectangle["width_m"]}
    return {
        "materials": {"m": {"E_Pa": 10 ** rng.uniform(10, 11.3), "rho_kg_m3": rng.uniform(1000, 8000), "nu": 0.3}},
        "sections": {"s": {"material": "m", "rectangle": rectangle}, "e": {"material": "m", "rectangle": end}},
    }


def random_frame(rng):
    """Returns statics of a portal frame of several bays with joints, springs, a body and a slider."""
    model = base_model(rng)
    bays = rng.randint(1, 3)
    nodes, members = {}, {}
    for i in range(bays + 1):
        x = i * rng.uniform(0.9, 1.1)
        nodes[f"B{i}"] = [x, 0.0]
        nodes[f"T{i}"] = [x + rng.uniform(-0.2, 0.2), rng.uniform(0.7, 1.3)]
        members[f"C{i}"] = {"nodes": [f"B{i}", f"T{i}"]}
        if i:
            members[f"G{i}"] = {"nodes": [f"T{i - 1}", f"T{i}"]}
    joined = {rng.choice("CG") + str(i) for i in range(1, bays + 1)}  # a welded end remains at each node
    for name, member in members.items():
        member.update(section="s", elements=rng.randint(2, 3))
        if rng.random() < 0.3:
            member["end_section"] = "e"
        if name in joined and rng.random() < 0.6:
            joint = rng.choice(["hinged", {"spring_N_m_per_rad": 10 ** rng.uniform(2, 6)}])
            member["ends"] = ["welded", joint]
    supports = {f"B{i}": ["x", "y", "rotation"] for i in range(bays + 1)}
    last, top = f"B{bays}", f"T{bays}"
    if rng.random() < 0.5:
        nodes["R"] = [nodes[top][0] + 0.2, nodes[top][1] + 0.1]
        model["rigid_bodies"] = {"body": {"reference": top, "nodes": ["R"]}}
    if rng.random() < 0.4:
        del supports[last]
        model["sliders"] = {"foot": {"node": last, "direction_rad": rng.uniform(-0.5, 0.5)}}
    if rng.random() < 0.5:
        model["springs"] = {"k": {"nodes": ["T0"], "stiffness_N_per_m": [10 ** rng.uniform(2, 6)] * 2,
                                  "rotational_stiffness_N_m_per_rad": 10 ** rng.uniform(1, 5)}}
    if rng.random() < 0.5:
        model["point_masses"] = {"p": {"node": "T0", "mass_kg": 2.0, "inertia_kg_m2": 0.01,
                                       "offset_m": [rng.uniform(-0.2, 0.2), 0.1]}}
        model["gravity_m_s2"] = [0.0, -9.81]
    force = [rng.uniform(-100, 100), rng.uniform(-100, 100)]
    model["loads"] = {"f": {"node": top, "force_N": force, "moment_N_m": rng.uniform(-10, 10)}}
    model.update(nodes=nodes, members=members, supports=supports)
    return {"model": model, "analysis": {"statics": {}}}


def random_mechanism(rng):
    """Returns the motion of a chain of pinned rigid bodies with a drive, a spring or a slider."""
    model = base_model(rng)
    count = rng.randint(1, 3)
    nodes, bodies, pins, masses = {"O": [0.0, 0.0]}, {}, {}, {}
    at, joint = [0.0, 0.0], "O"
    for i in range(count):
        angle = rng.uniform(-1.2, 1.2)
        length = rng.uniform(0.2, 0.6)
        tip = [at[0] + length * math.cos(angle), at[1] + length * math.sin(angle)]
        nodes[f"A{i}"], nodes[f"E{i}"] = list(at), tip
        bodies[f"b{i}"] = {"reference": f"A{i}", "nodes": [f"E{i}"]}
        pins[f"p{i}"] = {"nodes": [joint, f"A{i}"]}
        masses[f"m{i}"] = {"node": f"E{i}", "mass_kg": rng.uniform(0.2, 2), "inertia_kg_m2": rng.uniform(0.001, 0.02),
                           "offset_m": [rng.uniform(-0.05, 0.05), 0.02]}
        at, joint = tip, f"E{i}"
    analysis = {"end_time_s": 0.05, "step_s": 0.001}
    if count > 1 and rng.random() < 0.5:
        model["sliders"] = {"rail": {"node": joint, "direction_rad": rng.uniform(-0.5, 0.5)}}
    else:
        model["springs"] = {"k": {"nodes": [joint], "stiffness_N_per_m": [10 ** rng.uniform(0, 3)] * 2}}
        model["loads"] = {"f": {"node": joint, "force_N": [rng.uniform(-5, 5), rng.uniform(-5, 5)]}}
        if rng.random() < 0.5:
            law = {"spin_up": {"speed_per_s": rng.uniform(0.5, 3), "duration_s": 0.03}}
            analysis["drives"] = {"motor": {"node": "A0", "motion": "rotation", "law": law}}
    model.update(nodes=nodes, rigid_bodies=bodies, pins=pins, point_masses=masses,
                 supports={"O": ["x", "y", "rotation"]}, gravity_m_s2=[0.0, -9.81])
    return {"model": model, "analysis": {"large-motion": analysis}}


def nonlinear_differences(program, folder, case):
    """Returns the differences between statics and large statics under small loads."""
    model = copy.deepcopy(case["model"])
    multiply_loads(model, LOAD_SHARE)
    linear, large = (solve(program, folder, {case["id"]: {**case, "model": model, "analysis": {analysis: {}}}}, SECONDS)[case["id"]]
                     for analysis in ("statics", "large-statics"))
    if linear["status"] != large["status"]:
        return [f"{case['id']}: statics {linear['status']}, large statics {large['status']}"]
    if linear["status"] != "solved":
        return []
    expected, obtained = ({name: values[-1:] for name, values in run["quantities"].items()
                           if name.startswith(("displacement_", "rotation_"))} for run in (linear, large))
    found, _ = differences(expected, obtained, LINEAR_TOLERANCE, case["model"], {})
    return [f"{case['id']}: {name} is {a} in statics, {b} in large statics" for name, a, b, _ in found]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program")
    parser.add_argument("--count", type=int, default=200, help="models of each kind")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("random"), help="folder of the cases")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    failures = []
    for number in range(options.count):
        for kind, build in (("frame", random_frame), ("mechanism", random_mechanism)):
            case = {"id": f"{kind}-{number}", "title": "Random model", "family": "random", **build(random.Random(f"{kind}-{number}"))}
            (options.out / f"{case['id']}.json").write_text(json.dumps(case, indent=1))
            if kind == "frame":
                with tempfile.TemporaryDirectory() as folder:
                    failures += nonlinear_differences(options.program, pathlib.Path(folder), case)
    print(*failures, f"{len(failures)} differences between statics and large statics", sep="\n", flush=True)
    metamorphic = [sys.executable, pathlib.Path(__file__).with_name("metamorphic.py"), options.program]
    twins = subprocess.run([*metamorphic, "--folder", options.out, "--transformations", "rotate", "length"], check=False)
    return 1 if failures or twins.returncode else 0


if __name__ == "__main__":
    raise SystemExit(main())
