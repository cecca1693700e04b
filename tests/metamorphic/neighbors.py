#!/usr/bin/env python3
"""Runs variations of inputs that once had wrong results: other numbers, angles, schemes and steps. Prints the obtained values, and
the exact values by closed forms. The exit status is 1 if a value is wrong."""

import json
import math
import pathlib
import re
import sys
import tempfile

from metamorphic import run_program
from store import read_run

STEEL = {"steel": {"E_Pa": 2e11, "rho_kg_m3": 7800, "nu": 0.3}}
BAR = {"b": {"material": "steel", "rectangle": {"thickness_m": 0.1, "width_m": 0.05}}}


def turned(point, angle):
    return [math.cos(angle) * point[0] - math.sin(angle) * point[1], math.sin(angle) * point[0] + math.cos(angle) * point[1]]


def cantilever(turn=0.0, **member):
    """Returns a cantilever of 2 m, rotated about its clamp A."""
    return {"materials": STEEL, "sections": BAR, "nodes": {"A": [0, 0], "B": turned([2, 0], turn)},
            "supports": {"A": ["x", "y", "rotation"]}, "members": {"AB": {"nodes": ["A", "B"], "section": "b", **member}}}


class Neighbor:
    """Input with a selected value and the exact value."""

    def __init__(self, kind, what, model, analysis, quantity, right, tolerance=1e-6, index=-1):
        self.kind, self.what, self.model, self.analysis = kind, what, model, analysis
        self.quantity, self.right, self.tolerance, self.index = quantity, right, tolerance, index

    def obtained(self, run, folder):
        """Returns the value, or the text of a warning, a reason or the status."""
        if self.quantity == "refusal":
            return run.get("refused", run["status"])
        if self.quantity == "warned number":
            return float(re.search(r" is ([0-9.e+-]+)", run.get("warnings", ["is nan"])[0])[1])
        if self.quantity == "warning":
            return "; ".join(run.get("warnings", [])) or "none"
        if run["status"] != "solved":
            return f"{run['status']}: {run.get('reason', '')}"
        return read_run(folder / "store" / run["stored"])[0][self.quantity][self.index]

    def agrees(self, value):
        if isinstance(self.right, str):
            return isinstance(value, str) and self.right in value
        size = abs(self.right) or 1.0
        return not isinstance(value, str) and abs(value - self.right) <= self.tolerance * size


def branches():
    """Yields four-bar linkages near a change point: they keep the branch in which they start."""
    for speed, step, crank, turn in ((6, 0.01, 0.5, 0.0), (6, 0.004, 0.5, 0.7), (3, 0.02, 0.499, -1.0), (-6, 0.01, 0.5, 2.0),
                                     (4, 0.01, 0.4995, 0.3), (9, 0.01, 0.4999, 1.2)):
        coupler, rocker, ground, start = 1.0, 0.5, 1.0, 1.0

        def place(angle):
            a = [crank * math.cos(angle), crank * math.sin(angle)]
            d = math.dist(a, [ground, 0])
            along = (d * d + coupler ** 2 - rocker ** 2) / (2 * d)
            side = math.sqrt(coupler ** 2 - along ** 2)
            e = [(ground - a[0]) / d, -a[1] / d]
            return a, [a[0] + along * e[0] - side * e[1], a[1] + along * e[1] + side * e[0]]

        (a, b), end = place(start), 1.0
        nodes = {"O": [0, 0], "A": a, "A2": a, "B": b, "B2": b, "C": [ground, 0]}
        mass = {n: {"node": n, "mass_kg": 1, "inertia_kg_m2": 0.1} for n in ("A", "A2", "B2")}
        model = {"nodes": {n: turned(p, turn) for n, p in nodes.items()}, "point_masses": mass,
                 "rigid_bodies": {"c": {"reference": "O", "nodes": ["A"]}, "k": {"reference": "A2", "nodes": ["B"]},
                                  "r": {"reference": "C", "nodes": ["B2"]}},
                 "pins": {"p": {"nodes": ["A", "A2"]}, "q": {"nodes": ["B", "B2"]}},
                 "supports": {"O": ["x", "y"], "C": ["x", "y"]}}
        drive = {"m": {"node": "O", "motion": "rotation", "law": {"constant_speed": {"speed_per_s": speed}}}}
        analysis = {"large-motion": {"end_time_s": end, "step_s": step, "output_step_s": 0.1, "drives": drive}}
        yield Neighbor("assembly branch", f"{speed} rad/s, step {step} s, crank {crank} m, turned {turn} rad", model, analysis,
                       "position_x_m:B", turned(place(start + speed * end)[1], turn)[0])


def torques():
    """Yields an arm that a drive rotates uniformly: the torque is m g L cos(w t)."""
    for mass, length, speed, step, turn in ((1, 1, 5, 0.01, 0), (3, 0.2, 5, 0.01, 0), (1, 1, 40, 0.001, 0.4),
                                            (0.01, 5, 1, 0.02, -0.9), (1, 1, -5, 0.005, 1.2)):
        model = {"nodes": {"O": [0, 0], "B": turned([length, 0], turn)}, "supports": {"O": ["x", "y"]},
                 "point_masses": {"b": {"node": "B", "mass_kg": mass}}, "gravity_m_s2": [0, -9.81],
                 "rigid_bodies": {"arm": {"reference": "O", "nodes": ["B"]}}}
        drive = {"mot": {"node": "O", "motion": "rotation", "law": {"constant_speed": {"speed_per_s": speed}}}}
        for scheme in ("energy-momentum", "generalized-alpha"):
            analysis = {"large-motion": {"end_time_s": 0.2, "step_s": step, "drives": drive, "integrator": scheme,
                                         "initial_velocities": {"O": {"rotation_rad_per_s": speed}}}}
            yield Neighbor("torque of energy-momentum", f"{scheme}, {mass} kg, {length} m, {speed} rad/s, step {step} s", model,
                           analysis, "drive_torque_N_m:mot", mass * 9.81 * length * math.cos(turn + 0.2 * speed),
                           1e-5 if scheme == "energy-momentum" else (speed * step) ** 2)


def stresses():
    """Yields a bar in tension without moment: the stress is force over area."""
    for turn in (0.0, 0.3, 0.7, -0.87, 1.3, math.pi / 2):
        model = {"materials": {"soft": {"E_Pa": 1e6, "rho_kg_m3": 1000, "nu": 0.3}},
                 "sections": {"s": {"material": "soft", "area_m2": 0.01, "second_moment_m4": 1e-5}},
                 "nodes": {"A": [0, 0], "B": turned([2, 0], turn)}, "supports": {"A": ["x", "y", "rotation"]},
                 "members": {"AB": {"nodes": ["A", "B"], "section": "s", "elements": 2}},
                 "loads": {"P": {"node": "B", "force_N": turned([0.05, 0], turn)}}}
        yield Neighbor("stress with a rounded moment", f"turned {turn:.3g} rad", model, {"statics": {}}, "stress_Pa:AB", 5.0)


def rests():
    """Yields drives that are at rest after their motion."""
    for step, radius, travel, inertia in ((1e-3, 0.9, 1, 0.1), (1e-4, 0.9, 1, 0.1), (1e-3, 0.0, 1, 0.1), (1e-3, 0.5, 1e-3, 1e-6),
                                          (2e-3, 1.0, -3, 40), (1e-3, 0.8, 1, 1e-9)):
        model = {"nodes": {"H": [0, 0]}, "supports": {"H": ["x", "y"]},
                 "point_masses": {"B": {"node": "H", "mass_kg": 1, "inertia_kg_m2": inertia}}}
        drive = {"d": {"node": "H", "motion": "rotation", "law": {"rest_to_rest": {"travel": travel, "duration_s": 0.5}}}}
        analysis = {"large-motion": {"end_time_s": 1.0, "step_s": step, "output_step_s": 0.1, "spectral_radius": radius,
                                     "drives": drive}}
        yield Neighbor("drive that comes to rest", f"step {step} s, spectral radius {radius}, {inertia} kg m2", model, analysis,
                       "rotation_rad:H", travel)


def small_models():
    """Yields a model of springs and masses in many sizes."""
    for size in (1.0, 0.3, 1e-2, 1e-3, 1e3, 1e5):
        length = 0.5 * size
        model = {"nodes": {"O": [0, 0], "D": [length, 0]}, "supports": {"O": ["x", "y"], "D": ["x"]},
                 "point_masses": {"D": {"node": "D", "mass_kg": 1.0}},
                 "sliders": {"d": {"node": "D", "rail": "O", "direction_rad": 0}},
                 "springs": {"O": {"nodes": ["O"], "rotational_stiffness_N_m_per_rad": 30.0 * size ** 2}}}
        right = math.sqrt(30 / 0.25) / (2 * math.pi)
        yield Neighbor("small models", f"size {size:g}", model, {"large-statics": {"vibration_modes": 1}}, "frequency_Hz", right)


def mechanisms():
    """Yields a free arm under a force: the model is singular, and the motion is named."""
    for turn, pull in ((0, 1), (0.4, 1), (1.1, 1e-6), (-2.2, 1e4), (3.0, -1)):
        model = {"materials": STEEL, "sections": BAR, "supports": {"P": ["x", "y", "rotation"]},
                 "nodes": {n: turned(p, turn) for n, p in {"P": [0, 0], "Q": [2, 0], "R": [2.3, 0.2]}.items()},
                 "members": {"PQ": {"nodes": ["P", "Q"], "section": "b", "elements": 2, "ends": ["welded", "hinged"]},
                             "QR": {"nodes": ["Q", "R"], "section": "b"}},
                 "loads": {"pull": {"node": "Q", "force_N": turned([pull, 0], turn)}}}
        yield Neighbor("mechanism in large statics", f"turned {turn} rad, {pull:g} N", model, {"large-statics": {}},
                       "status", "singular: free motion: rotation of node Q")


def tails():
    """Yields rigid arms with lumped ends: a massless tail does not change sqrt(k / (m L^2 / 3)) / 2 pi."""
    for spring, length, angle in ((0.05, 0.18, 0.29), (0.05, 2.0, 1.0), (5.0, 0.01, -2.0), (1e-3, 0.4, 3.0), (500.0, 0.3, 0.1)):
        mass = 1000 * 0.01 * 1.2
        stiff = {"E_Pa": 1e13, "rho_kg_m3": 1000, "nu": 0.3}
        section = {"area_m2": 0.01, "second_moment_m4": 1e-5}
        model = {"materials": {"m": stiff, "light": dict(stiff, rho_kg_m3=0)},
                 "sections": {"s": dict(section, material="m"), "t": dict(section, material="light")},
                 "nodes": {"O": [0, 0], "E": [1.2, 0], "T": [1.2 + length * math.cos(angle), length * math.sin(angle)]},
                 "springs": {"O": {"nodes": ["O"], "rotational_stiffness_N_m_per_rad": spring}}, "supports": {"O": ["x", "y"]},
                 "members": {"OE": {"nodes": ["O", "E"], "section": "s", "mass_matrix": "lumped", "axial": "inextensible"},
                             "ET": {"nodes": ["E", "T"], "section": "t"}},
                 "loads": {"O": {"node": "O", "force_N": [1, 0]}}}
        right = math.sqrt(spring / (mass * 1.2 ** 2 / 3)) / (2 * math.pi)
        rounding = sys.float_info.epsilon * 3 * 1e13 * 1e-5 / 1.2 / spring  # round-off of the arm stiffness relative to the spring stiffness
        yield Neighbor("massless tail", f"{spring:g} N m/rad, tail of {length} m at {angle} rad", model,
                       {"large-statics": {"vibration_modes": 1}}, "frequency_Hz", right, 1e-5 + 5 * rounding)


def reduced_members():
    """Yields a reduced cantilever under line loads at 0 Hz: the section force is q L at the clamp."""
    for axial, across, elements, modes, turn in ((40, -300, 8, 2, 0), (40, -300, 8, 0, 0.6), (-7, 1e3, 4, 1, -1.1), (1e4, 1, 16, 4, 2.5),
                                                 (0, 50, 2, 1, 0.2)):
        model = cantilever(turn, elements=elements, load_N_per_m=turned([axial, across], turn))
        analysis = {"harmonic": {"from_Hz": 0, "to_Hz": 1, "points": 2, "reduction": {"fixed_interface_modes": modes},
                                 "outputs": ["axial_force_N:AB.start", "shear_force_N:AB.start"]}}
        for output, load in (("axial_force_N:AB.start", axial), ("shear_force_N:AB.start", across)):
            yield Neighbor("reduced member under a load", f"{output}, {elements} elements, {modes} modes, turned {turn} rad", model,
                           analysis, output, 2.0 * abs(load), 1e-6, 0)


def free_arms():
    """Yields an arm without loads, which is neither stable nor unstable."""
    for turn, place, elements in ((0, 0, 4), (0.9, 0, 4), (-1.7, 3, 2), (0.3, -20, 4), (2.6, 0.7, 6)):
        nodes = {"A": [0.0, 0.0], "B": [0.5, 0.0], "C": [0.9, 0.3]}
        section = {"s": {"material": "steel", "rectangle": {"thickness_m": 0.02, "width_m": 0.02}}}
        model = {"materials": STEEL, "sections": section, "supports": {"A": ["x", "y", "rotation"]},
                 "nodes": {n: [c + place for c in turned(p, turn)] for n, p in nodes.items()},
                 "members": {"AB": {"nodes": ["A", "B"], "section": "s", "elements": elements},
                             "BC": {"nodes": ["B", "C"], "section": "s", "elements": elements, "ends": ["hinged", "welded"]}},
                 "loads": {"l": {"node": "B", "force_N": turned([1e-5, 0.0], turn)}}}
        what = f"turned {turn} rad, moved {place} m, {elements} elements"
        for quantity in ("unstable_directions", "frequency_Hz"):
            yield Neighbor("free part", f"{quantity}, {what}", model, {"large-statics": {"vibration_modes": 2}}, quantity, 0.0, 1e-9,
                           0)


def redundant():
    """Yields parallel cranks with a coupler: every crank after the second is redundant."""
    for cranks, turn, kind in ((3, 0.0, "large-motion"), (4, 0.5, "large-motion"), (3, -1.3, "large-statics"),
                               (5, 0.2, "large-statics"), (3, 0.8, "energy-momentum")):
        nodes, bodies, masses, pins, supports = {}, {}, {}, {}, {}
        for i in range(cranks):
            nodes |= {f"O{i}": [i, 0], f"K{i}": [i, 0.5], f"T{i}": [i, 0.5]}
            bodies[f"crank{i}"] = {"reference": f"O{i}", "nodes": [f"K{i}"]}
            masses[f"crank{i}"] = {"node": f"O{i}", "mass_kg": 1, "inertia_kg_m2": 0.2}
            pins[f"pin{i}"], supports[f"O{i}"] = {"nodes": [f"K{i}", f"T{i}"]}, ["x", "y"]
        bodies["coupler"] = {"reference": "T0", "nodes": [f"T{i}" for i in range(1, cranks)]}
        masses["coupler"] = {"node": "T1", "mass_kg": 3, "inertia_kg_m2": 0.1}
        model = {"nodes": {n: turned(p, turn) for n, p in nodes.items()}, "rigid_bodies": bodies, "point_masses": masses,
                 "pins": pins, "supports": supports}
        if kind == "large-statics":
            model["springs"] = {"s": {"nodes": ["O0"], "rotational_stiffness_N_m_per_rad": 10}}
            model["loads"] = {"push": {"node": "K0", "force_N": turned([1, 0], turn)}}
            analysis = {"large-statics": {}}
        else:
            model["follower_loads"] = {"push": {"node": "K0", "force_N": turned([4, 0], turn)}}
            analysis = {"large-motion": {"end_time_s": 0.1, "step_s": 0.01}}
            if kind == "energy-momentum":
                analysis["large-motion"]["integrator"] = kind
        yield Neighbor("redundant reactions", f"{cranks} cranks, turned {turn} rad, {kind}", model, analysis, "warning",
                       f"the number of redundant constraints is {cranks - 2}")


def coarse():
    """Yields meshes that are too coarse for the highest mode or for a taper."""
    tip = {"t": {"material": "steel", "rectangle": {"thickness_m": 0.01, "width_m": 0.05}}}
    for elements, modes, warned in ((1, 1, True), (1, 3, True), (2, 4, True), (16, 3, False), (32, 4, False)):
        yield Neighbor("coarse mesh", f"modes, {elements} elements, {modes} modes", cantilever(elements=elements),
                       {"modes": {"count": modes}}, "warning", "dimensionless wave number" if warned else "none")
    for elements, kind, warned in ((1, "statics", True), (2, "statics", True), (2, "buckling", True), (1, "modes", True),
                                   (64, "statics", False)):
        model = cantilever(end_section="t", elements=elements)
        model.update(sections=BAR | tip, loads={"p": {"node": "B", "force_N": [-1, 0]}})
        options = {"statics": {}, "buckling": {"count": 1}, "modes": {"count": 1}}[kind]
        yield Neighbor("coarse mesh", f"{kind} of a taper, {elements} elements", model, {kind: options}, "warning",
                       "ratio of stiffness at the ends of an element" if warned else "none")


def pulses():
    """Yields pulses and ramps of any duration: the velocity is the impulse over the mass."""
    for mass, force, times, factors in (
        (5, 10, [0, 0.3, 0.30000001, 0.30000002], [0, 0, 1e7, 0]),
        (2, 1, [0, 0.5, 0.5000001, 1], [0, 0, 1, 1]),
        (1, 3, [0, 0.1, 0.1 + 1e-10, 0.1 + 2e-10], [0, 0, 1e9, 0]),
        (0.1, 1, [0, 0.25, 0.25001, 0.5, 0.50001], [0, 0, 1, 1, 0]),
        (40, -2, [0, 0.999999, 1], [0, 0, 1e6]),
    ):
        impulse = sum(force * (f + g) / 2 * (b - a) for a, b, f, g in zip(times, times[1:], factors, factors[1:]))
        impulse += force * factors[-1] * (1 - times[-1])
        model = {
            "nodes": {"G": [0, 0], "H": [1, 0]},
            "supports": {"G": ["y"], "H": ["x", "y"]},
            "point_masses": {n: {"node": n, "mass_kg": m, "inertia_kg_m2": 1} for n, m in (("G", mass), ("H", 1))},
            "loads": {"l": {"node": "G", "force_N": [force, 0]}},
        }
        for step in (0.01, 0.003):
            analysis = {
                "large-motion": {"end_time_s": 1, "step_s": step, "load_history": {"time_s": times, "factor": factors}}
            }
            yield Neighbor(
                "short pulse", f"{times[1:]} s, step {step} s", model, analysis, "velocity_x_m_per_s:G", impulse / mass
            )


def bases():
    """Yields a uniform velocity of a cantilever: the modes have 0.6131, 0.1883, 0.0647, 0.0331 and 0.0200 of its energy."""
    held = 0.0
    for modes, share in enumerate((0.6131, 0.1883, 0.0647, 0.0331, 0.0200), 1):
        held += share
        turn = 0.4 * modes
        model = cantilever(turn, elements=128, axial="inextensible")
        analysis = {
            "transient": {
                "duration_s": 0.01,
                "step_s": 0.001,
                "method": "modal-superposition",
                "initial_state": {"velocity_m_per_s": turned([0, -1], turn)},
                "reduction": {"modes": modes},
                "outputs": ["velocity_y_m_per_s:B"],
            }
        }
        yield Neighbor(
            "velocity outside a basis",
            f"{modes} modes, turned {turn:.1f} rad",
            model,
            analysis,
            "warned number",
            math.sqrt(1 - held),
            0.04,
        )  # the clamped node has no velocity


def collisions():
    """Yields models with two parts of one name, which are refused."""
    arc = {"nodes": ["A", "B"], "section": "b", "arc_center_m": [0, 0], "elements": 3}
    straight = {"nodes": ["A", "B"], "section": "b"}
    nodes, held = {"A": [1, 0], "B": [0, 1], "C": [2, 1]}, {"A": ["x", "y", "rotation"]}
    for members, other in (
        ({"AB": arc, "AB.1": straight}, {}),
        ({"AB": arc, "AB.3": straight}, {}),
        ({"AB": straight, "AB.start": straight}, {}),
        ({"total": straight}, {}),
        ({"AB": dict(straight, elements=4, restrained_motions=["rotation"]), "AB.2": straight}, {}),
        ({"at-B": straight}, {"point_masses": {"m": {"node": "B", "mass_kg": 1}}}),
    ):
        model = {"materials": STEEL, "sections": BAR, "nodes": nodes, "members": members, "supports": held} | other
        yield Neighbor(
            "names that collide", ", ".join(members), model, {"statics": {}}, "refusal", "two parts have the name"
        )


def tensions():
    """Yields a column and a tie in large tension: the load factor is pi^2 EI / (4 L^2) over the force."""
    inertia, area = 0.05 * 0.1**3 / 12, 0.005
    for pull, push, length, turn in (
        (1e3, 1, 2, 0),
        (1e6, 1, 2, 0.5),
        (1e9, 1, 1, 1.3),
        (1e5, 1e3, 5, -0.8),
        (1e8, 1e-3, 2, 2.2),
    ):
        nodes = {"A": [0, 0], "B": [length, 0], "C": [0, 1], "D": [length, 1]}
        model = cantilever()
        model["nodes"] = {n: turned(p, turn) for n, p in nodes.items()}
        model["members"] = {pair: {"nodes": list(pair), "section": "b", "elements": 8} for pair in ("AB", "CD")}
        model["supports"]["C"] = model["supports"]["A"]
        loads = {"push": ("B", -push), "pull": ("D", pull)}
        model["loads"] = {name: {"node": node, "force_N": turned([force, 0], turn)} for name, (node, force) in loads.items()}
        yield Neighbor(
            "buckling with large tension",
            f"pull {pull:g} N, push {push:g} N, {length} m, turned {turn} rad",
            model,
            {"buckling": {"count": 1}},
            "load_factor",
            (math.pi / 2 / length) ** 2 * 2e11 * inertia / push,
            1e-5,
            0,
        )


KINDS = (pulses, bases, collisions, tensions, branches, torques, stresses, rests, small_models, mechanisms, tails, reduced_members, free_arms, redundant, coarse)


def main():
    neighbors = [n for kind in KINDS for n in kind()]
    missed = 0
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        files = []
        for i, neighbor in enumerate(neighbors):
            files.append(folder / f"n{i}.json")
            files[-1].write_text(json.dumps({"id": f"n{i}", "title": neighbor.kind, "model": neighbor.model,
                                             "analysis": neighbor.analysis}))
        refused = {f"n{i}": files[i] for i, n in enumerate(neighbors) if n.quantity == "refusal"}
        solved = [file for file in files if file not in refused.values()]
        answer = run_program(sys.argv[1], "run", *solved, "--out", folder / "out")
        if not (folder / "out" / "results.json").exists():
            print(answer.stderr)
            return 1
        runs = {r["case"]: r for r in json.loads((folder / "out" / "results.json").read_text())["runs"]}
        for name, file in refused.items():  # an invalid file stops the call for all cases
            answer = run_program(sys.argv[1], "run", file)
            message = answer.stderr.partition(": ")[2].strip()
            runs[name] = {"status": f"exit status {answer.returncode}", "refused": message}
        print("| kind | neighbor | obtained | right |\n|---|---|---|---|")
        for i, neighbor in enumerate(neighbors):
            value = neighbor.obtained(runs[f"n{i}"], folder / "out")
            shown = value[:60] if isinstance(value, str) else f"{value:.9g}"
            right = neighbor.right if isinstance(neighbor.right, str) else f"{neighbor.right:.9g}"
            missed += not neighbor.agrees(value)
            print(f"| {neighbor.kind} | {neighbor.what} | {shown} | {right} |{'' if neighbor.agrees(value) else ' MISSED'}")
    print(f"{len(neighbors)} neighbors, {missed} missed")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
