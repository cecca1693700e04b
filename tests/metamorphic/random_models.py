#!/usr/bin/env python3
"""Runs random frames and mechanisms in m, mm and km and at a random angle, and compares the results.

Usage: random_models.py TRAMMEL [--count N] [--out DIR]

Prints refusals and quantities that differ from their law, and writes them to DIR/REPORT.md.
"""
import argparse
import copy
import json
import math
import pathlib
import random
import subprocess

UNITS = {"m": 1.0, "mm": 1e3, "km": 1e-3}
LOAD_SHARE = 1e-5
TOLERANCE = 1e-5  # relative to the largest of the kind: Newton's and the digits of ill-conditioned frames
LINEAR_TOLERANCE = 1e-3  # large statics is nonlinear at order of the load's share times slenderness squared


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
    """Returns the motion of a chain of pinned rigid bodies: driven, sprung or on a slider."""
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


# Dimension of length in each key; mass and time keep their units.
LENGTH = {"nodes": 1, "thickness_m": 1, "width_m": 1, "offset_m": 1, "gravity_m_s2": 1, "force_N": 1,
          "moment_N_m": 2, "inertia_kg_m2": 2, "E_Pa": -1, "rho_kg_m3": -3, "spring_N_m_per_rad": 2,
          "rotational_stiffness_N_m_per_rad": 2}


def in_units(value, factor, power=0):
    """Returns a model with all lengths multiplied by a factor."""
    if isinstance(value, dict):
        return {k: in_units(v, factor, LENGTH.get(k, power)) for k, v in value.items()}
    if isinstance(value, list):
        return [in_units(v, factor, power) for v in value]
    return value * factor ** power if power and isinstance(value, (int, float)) else value


def rotated(model, angle):
    """Returns a model that is rotated about the origin."""
    c, s = math.cos(angle), math.sin(angle)

    def turn(v):
        return [c * v[0] - s * v[1], s * v[0] + c * v[1]]
    model = copy.deepcopy(model)
    model["nodes"] = {k: turn(v) for k, v in model["nodes"].items()}
    for part, key in (("loads", "force_N"), ("point_masses", "offset_m")):
        for entry in model.get(part, {}).values():
            entry[key] = turn(entry[key])
    for slider in model.get("sliders", {}).values():
        slider["direction_rad"] += angle
    if "gravity_m_s2" in model:
        model["gravity_m_s2"] = turn(model["gravity_m_s2"])
    return model


MOTIONS = ("position_x_m", "position_y_m", "rotation_rad", "velocity_x_m_per_s", "velocity_y_m_per_s",
           "angular_velocity_rad_per_s")


def run(trammel, case, path):
    """Returns status and quantities of a case."""
    case = {"id": path.stem, "title": "Random model", **case}
    if "large-motion" in case["analysis"]:  # results.json keeps time series in checks only
        names = [f"{q}:{n}" for n in case["model"]["nodes"] for q in MOTIONS] + ["reaction_x_N:O", "reaction_y_N:O"]
        bound = {"at_most": 1e300, "why": "the value is read, not judged"}
        case["checks"] = {f"c{i}": {"quantity": n, "role": "verification", "statistic": "last", "bound": bound}
                          for i, n in enumerate(names)}
    path.write_text(json.dumps(case, indent=1))
    out = path.parent / "out"
    done = subprocess.run([*trammel, "run", str(path), "-j", "1", "--json", "--out", str(out)], capture_output=True, text=True)
    try:
        document = json.loads(done.stdout)
        result = document["runs"][0]
    except (ValueError, KeyError, IndexError):
        return (done.stderr.strip() or done.stdout.strip())[-200:].replace(str(path), "FILE"), {}
    quantities = result.get("quantities", {})
    for check in result["checks"]:
        if "computed" in check:
            quantities[document["names"][check["quantity"]]] = [check["computed"]]
    return result["status"], quantities


# Power of length by the unit at the end of a quantity's name.
POWERS = {"_N_m": 2, "_J": 2, "_Pa": -1, "_m_per_s": 1, "_rad_per_s": 0, "_rad": 0, "_N": 1, "_m": 1}


def compare(base, other, factor, angle):
    """Returns the largest difference from the law, relative to the largest of the unit, and its name."""
    def unit_of(name):
        return next((u for u in POWERS if name.split(":")[0].endswith(u)), None)

    scale, worst = {}, (0.0, "")
    for name, values in base.items():
        if unit_of(name):
            scale[unit_of(name)] = max([scale.get(unit_of(name), 0.0), *map(abs, values)])
    c, s = math.cos(angle), math.sin(angle)
    for name, values in base.items():
        unit = unit_of(name)
        if not unit or "_y_" in name or "residual" in name or "smallest" in name:
            continue
        pairs = [(name, values, other.get(name))]
        partner = name.replace("_x_", "_y_")
        if partner != name and partner in base:
            x, y = other.get(name), other.get(partner)
            if x and y:
                pairs = [(name, values, [c * a + s * b for a, b in zip(x, y)]),
                         (partner, base[partner], [c * b - s * a for a, b in zip(x, y)])]
        for label, wanted, obtained in pairs:
            if obtained is None or len(obtained) != len(wanted):
                return math.inf, label + " is missing"
            for a, b in zip(wanted, obtained):
                size = abs(b / factor ** POWERS[unit] - a) / (scale[unit] or 1.0)
                worst = max(worst, (size, label))
    return worst


def with_small_load(case, analysis):
    """Returns the case with a share of its loads and weight."""
    case = copy.deepcopy(case)
    case["analysis"] = {analysis: {}}
    for load in case["model"]["loads"].values():
        load["force_N"] = [LOAD_SHARE * x for x in load["force_N"]]
        load["moment_N_m"] *= LOAD_SHARE
    if "gravity_m_s2" in case["model"]:
        case["model"]["gravity_m_s2"] = [LOAD_SHARE * x for x in case["model"]["gravity_m_s2"]]
    return case


def examine(trammel, kind, number, folder):
    """Returns the failures of one random model."""
    rng = random.Random(f"{kind}-{number}")
    case = {"frame": random_frame, "mechanism": random_mechanism}[kind](rng)
    angle = rng.uniform(0.1, 6.2)
    twins = {unit: (in_units(case["model"], f), f, 0.0) for unit, f in UNITS.items()}
    twins["rotated"] = (rotated(case["model"], angle), 1.0, angle)
    status, base, failures = "", {}, []
    for name, (model, factor, turn) in twins.items():
        path = folder / f"{kind}-{number}-{name}.json"
        got, quantities = run(trammel, {"model": model, "analysis": case["analysis"]}, path)
        if name == "m":
            status, base = got, quantities
        elif got != status:
            failures.append(f"{path.name}: status '{got}', in m '{status}'")
        elif got == "solved":
            size, label = compare(base, quantities, factor, turn)
            if not size < TOLERANCE:
                failures.append(f"{path.name}: {label} differs by {size:.2g}")
    if kind == "frame" and status == "solved":
        results = {a: run(trammel, with_small_load(case, a), folder / f"frame-{number}-{a}.json")
                   for a in ("statics", "large-statics")}
        (linear, first), (large, last) = results["statics"], results["large-statics"]
        moved = [{k: v[-1:] for k, v in q.items() if k.startswith(("displacement_", "rotation_"))} for q in (first, last)]
        size, label = compare({k: v for k, v in moved[0].items() if k in moved[1]}, moved[1], 1.0, 0.0)
        if linear != large or not moved[1] or not size < LINEAR_TOLERANCE:
            failures.append(f"frame-{number}-large-statics.json: '{large}', {label} differs by {size:.2g} from statics")
    return status, failures


def main():
    """Runs all models and writes the report after each of them."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("trammel", nargs="+", help="command of the program")
    parser.add_argument("--count", type=int, default=200, help="models of each kind")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("random"))
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    failures, statuses = [], {}
    for number in range(options.count):
        for kind in ("frame", "mechanism"):
            status, found = examine(options.trammel, kind, number, options.out)
            statuses[f"{kind}: {status}"] = statuses.get(f"{kind}: {status}", 0) + 1
            failures += found
            if found:
                print(*found, sep="\n", flush=True)
        lines = [f"{number + 1} models of each kind", *(f"{k}: {v}" for k, v in statuses.items()),
                 f"{len(failures)} failures", *failures]
        (options.out / "REPORT.md").write_text("\n".join(f"- {line}" for line in lines) + "\n")
    print(f"{len(failures)} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    raise SystemExit(main())
