#!/usr/bin/env python3
"""Writes random scenes as case files, which `trammel effects` reads, and prints their names.

Each effect is between far below and far above the tolerance. Five of ten scenes are statics, and three are modes.
"""
import argparse
import contextlib
import json
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "metamorphic"))
import transformations  # noqa: E402

E, DENSITY, MASK = 7e10, 2700, 2**64 - 1
MATERIAL = {"E_Pa": E, "rho_kg_m3": DENSITY, "nu": 0.33}
CLAMPED = ["x", "y", "rotation"]
POINTS_NEAR, POINTS_OF_CIRCLE = 13, 33


class Draw:
    """Random numbers of the 64-bit Mersenne Twister (Nishimura 2000), which are the same on every machine."""

    def __init__(self, seed):
        self.state, self.next = [seed & MASK], 312
        for i in range(1, 312):
            self.state.append(6364136223846793005 * (self.state[-1] ^ self.state[-1] >> 62) + i & MASK)

    def bits(self):
        s = self.state
        for i in range(312) if self.next == 312 else ():
            x = s[i] & 0xFFFFFFFF80000000 | s[(i + 1) % 312] & 0x7FFFFFFF
            s[i] = s[(i + 156) % 312] ^ x >> 1 ^ (0xB5026F5AA96619E9 if x & 1 else 0)
        self.next = self.next % 312 + 1
        x = s[self.next - 1]
        x ^= x >> 29 & 0x5555555555555555
        x ^= x << 17 & 0x71D67FFFEDA60000
        x ^= x << 37 & 0xFFF7EEE000000000
        return x ^ x >> 43

    def uniform(self, low, high):
        return low + (high - low) * ((self.bits() >> 11) * 2.0**-53)

    def logarithmic(self, low, high):
        return math.exp(self.uniform(math.log(low), math.log(high)))

    def chance(self, probability):
        return self.uniform(0, 1) < probability

    def direction(self, size):
        angle = self.uniform(-math.pi, math.pi)
        return [size * math.cos(angle), size * math.sin(angle)]


def first_omega(thickness, length):
    return 3.516 * thickness / (length * length) * math.sqrt(E / (12 * DENSITY))


class Bar:
    """Link or member with random dimensions. Further random properties are relative to its bending stiffness E I."""

    def __init__(self, draw, length, thickness, width, is_link=False):
        """Draws the thickness relative to the length. The width of a member is relative to its thickness, that of a link to its length."""
        self.draw, self.length, self.thickness = draw, length, length * draw.logarithmic(*thickness)
        self.width = (length if is_link else self.thickness) * draw.logarithmic(*width)
        self.bending = E * self.width * math.pow(self.thickness, 3) / 12
        self.mass = DENSITY * self.thickness * self.width * length

    def joint(self, otherwise):
        """Returns a joint without a spring, or with a spring from soft to practically rigid."""
        if not self.draw.chance(0.4):
            return otherwise
        return {"spring_N_m_per_rad": self.bending / self.length * self.draw.logarithmic(1e-2, 1e6)}

    def load(self):
        """Returns a random force that rotates the end of the bar by 1e-5 to 0.3 rad [N]."""
        return self.draw.logarithmic(1e-5, 0.3) * self.bending / (self.length * self.length)


def manipulator_of(bar, elements, platform, joints):
    """Returns three equal limbs of Timoshenko links with a platform."""
    links = {"proximal_length_m": bar.length, "distal_length_m": bar.length, "thickness_m": bar.thickness,
             "width_m": bar.width, "beam": "timoshenko", "elements": elements}
    return {"base_side_m": 0.5, "links": links, "platform": platform, "material": MATERIAL, "joints": joints}


def at_platform(force):
    return {"P": {"node": "P", "force_N": force}}


def manipulator(modes, draw):
    bar = Bar(draw, draw.uniform(0.17, 0.25), (0.003, 0.3), (0.03, 0.3), is_link=True)
    soft = draw.chance(0.7)
    platform = {"kind": "triangles" if soft else "rigid", "side_m": draw.uniform(0.12, 0.22),
                "thickness_m": bar.width * draw.logarithmic(0.003, 3)}
    if soft:
        platform["refinements"] = 1
    platform["mass_kg"] = bar.mass * draw.logarithmic(1e-4, 1e4)
    joints = {"active": bar.joint("locked"), "elbow": bar.joint("welded"), "platform": "hinged"}
    model = {"manipulator": manipulator_of(bar, 4, platform, joints),
             "pose": {"x_m": draw.uniform(0.23, 0.27), "y_m": draw.uniform(0.125, 0.165), "phi_rad": draw.uniform(-0.2, 0.2)}}
    if not modes:
        model["loads"] = at_platform(draw.direction(bar.load()))
        if draw.chance(0.5):
            model["gravity_m_s2"] = draw.direction(draw.logarithmic(0.001, 10))
    return model


def member(start, end, joint=None):
    ends = {} if joint is None else {"ends": [joint, "welded"]}
    return {"nodes": [start, end], "section": "s", "beam": "timoshenko", **ends}


def frame(bar, elements, nodes, members, supports):
    """Returns members of one section, clamped at A."""
    section = {"material": "alloy", "rectangle": {"thickness_m": bar.thickness, "width_m": bar.width}}
    return {"materials": {"alloy": MATERIAL}, "sections": {"s": section}, "elements": elements, "nodes": nodes,
            "members": members, "supports": {"A": CLAMPED, **supports}}


def add_lump_and_loads(model, modes, node, mass, bar, draw):
    """Adds a lumped mass at a node and, in statics, a force at this node and gravity. `mass` is the mass of the frame [kg]."""
    if modes or draw.chance(0.5):
        model["point_masses"] = {"lump": {"node": node, "mass_kg": mass * draw.logarithmic(1e-4, 1e4)}}
    load = bar.load()
    if not modes:
        model["loads"] = {"force": {"node": node, "force_N": draw.direction(load)}}
        if draw.chance(0.5):
            model["gravity_m_s2"] = draw.direction(draw.logarithmic(1e-4, 1) * load / mass)
    return model


def beam(modes, draw):
    """Returns a cantilever or a beam that is clamped at both ends, with a lumped mass."""
    length = draw.logarithmic(0.2, 5)
    bar = Bar(draw, length, (0.002, 0.3), (0.5, 5))
    clamped, root = draw.chance(0.4), bar.joint("welded")
    nodes, members = {"A": [0, 0], "B": [length, 0]}, {"AB": member("A", "B", root)}
    if clamped:
        nodes["C"] = [length * draw.uniform(0.3, 0.7), 0]
        members = {"AC": member("A", "C", root), "CB": member("C", "B")}
    model = frame(bar, 8, nodes, members, {"B": CLAMPED} if clamped else {})
    return add_lump_and_loads(model, modes, "C" if clamped else "B", bar.mass, bar, draw)


def portal(modes, draw):
    height, span = draw.uniform(0.5, 2), draw.uniform(0.5, 3)
    bar = Bar(draw, height, (0.003, 0.2), (0.5, 3))
    members = {name: member(*name, bar.joint("welded")) for name in ("AB", "BC", "DC")}
    nodes = {"A": [0, 0], "B": [0, height], "C": [span, height], "D": [span, 0]}
    mass = DENSITY * bar.thickness * bar.width * (2 * height + span)
    return add_lump_and_loads(frame(bar, 4, nodes, members, {"D": CLAMPED}), modes, "B", mass, bar, draw)


def column(modes, draw):
    """Returns a column or a tie with a free or guided head, with up to 0.99 of its buckling load."""
    length = draw.logarithmic(0.2, 5)
    bar = Bar(draw, length, (0.002, 0.05), (0.5, 5))
    guided = draw.chance(0.3)
    buckling = math.pow(math.pi / (length if guided else 2 * length), 2) * bar.bending
    share = 1 - draw.logarithmic(0.01, 1)
    model = frame(bar, 8, {"A": [0, 0], "B": [length, 0]}, {"AB": member("A", "B")}, {"B": ["rotation"]} if guided else {})
    across = 0 if modes else draw.logarithmic(1e-5, 0.1) * bar.bending / (length * length)
    along = (-share if draw.chance(0.7) else share) * buckling
    model["loads"] = {"head": {"node": "B", "force_N": [along, across]}}
    return model


def near_singular(_, draw):
    """Returns a manipulator on a path to within 0.001 to 0.1 of a singularity: a stretched limb, or distal links that meet in P."""
    length = draw.uniform(0.18, 0.22)
    bar = Bar(draw, length, (0.004, 0.1), (0.05, 0.3), is_link=True)
    side, near = draw.uniform(0.15, 0.22), draw.logarithmic(1e-3, 0.1)
    arm, center = side / math.sqrt(3), 0.5 / math.sqrt(3)
    joints = {"active": bar.joint("locked"), "elbow": "welded" if draw.chance(0.5) else "hinged", "platform": "hinged"}
    model = {"manipulator": manipulator_of(bar, 4, {"kind": "rigid", "side_m": side, "thickness_m": bar.width}, joints)}
    nearest = int(draw.uniform(1, POINTS_NEAR - 1))

    def pose(from_base, phi):
        return {"x_m": from_base * math.cos(math.pi / 6), "y_m": from_base * math.sin(math.pi / 6), "phi_rad": phi}

    force = bar.load()
    model["loads"] = at_platform(draw.direction(force * draw.logarithmic(1e-3, 1)))
    if draw.chance(0.5):  # path outward along the first limb and back
        radius = (2 * length * (1 - near) + arm - center) / 2
        middle = pose(center + radius, 0)
        circle = {"center_m": [middle["x_m"], middle["y_m"]], "radius_m": radius, "points": POINTS_NEAR,
                  "step_s": 2 * math.pi / 12, "phi_rad": 0}
        return {**model, "trajectory": {"circle": circle}}
    out = arm + length
    singular = math.acos((center * center + out * out - length * length) / (2 * center * out))
    step, at = 0.25 / POINTS_NEAR, (1 if draw.chance(0.5) else -1) * singular + near
    line = {"from": pose(center, at - nearest * step), "to": pose(center, at + (POINTS_NEAR - 1 - nearest) * step),
            "duration_s": 1, "points": POINTS_NEAR, "step_s": 1.0 / (POINTS_NEAR - 1)}
    return {**model, "trajectory": {"line": line}}


def moving_manipulator(draw, scene):
    """Returns a manipulator that vibrates as it follows a circle, slow or fast, damped or not."""
    bar = Bar(draw, draw.uniform(0.18, 0.22), (0.004, 0.1), (0.05, 0.3), is_link=True)
    platform = {"kind": "triangles" if draw.chance(0.5) else "rigid", "side_m": 0.2,
                "thickness_m": bar.width * draw.logarithmic(0.003, 1)}
    platform["mass_kg"] = bar.mass * draw.logarithmic(0.1, 1e3)
    speed = draw.logarithmic(0.3, 60)
    step = 2 * math.pi / speed / (POINTS_OF_CIRCLE - 1)
    joints = {"active": bar.joint("locked"), "elbow": "welded" if draw.chance(0.5) else "hinged", "platform": "hinged"}
    circle = {"center_m": [0.25, 0.144], "radius_m": draw.logarithmic(0.002, 0.015), "points": POINTS_OF_CIRCLE,
              "step_s": step, "angular_speed_rad_s": speed, "phi_rad": 0}
    model = {"manipulator": manipulator_of(bar, 2, platform, joints), "trajectory": {"circle": circle}}
    if draw.chance(0.6):
        model["loads"] = at_platform(draw.direction(0.1 * bar.load()))
    if draw.chance(0.3):
        model["gravity_m_s2"] = [0, -draw.logarithmic(0.01, 10)]
    motion = {"scheme": {"generalized-alpha": {"spectral_radius": 0.8}}, "step_s": step / 16,
              "initial_state": "quasi-static" if draw.chance(0.75) else "at-rest"}
    if draw.chance(0.75):
        motion["damping"] = {"mass_per_s": draw.logarithmic(1e-3, 1), "stiffness_s": draw.logarithmic(1e-6, 3e-3)}
    scene["analysis"] = {"elastodynamics": motion}
    return model


def spinning_link(draw, scene):
    """Returns a link that spins about its root, with a lumped mass at its end."""
    length = draw.logarithmic(0.1, 1)
    bar = Bar(draw, length, (0.003, 0.2), (0.5, 10))
    hub, count = length * draw.uniform(0, 1), 1 if draw.chance(0.5) else 3
    rotating = {"angular_speed_rad_s": first_omega(bar.thickness, length) * draw.logarithmic(0.003, 0.6)}
    scene["analysis"] = {"modes": {"count": count, "rotating": rotating}}
    model = frame(bar, 8, {"A": [hub, 0], "B": [hub + length, 0]}, {"AB": member("A", "B", bar.joint("welded"))}, {})
    model["point_masses"] = {"lump": {"node": "B", "mass_kg": bar.mass * draw.logarithmic(0.01, 1e3)}}
    return model


def harmonic(draw, kind, model):
    """Returns the response to a harmonic force, from far below to above the first frequency of the beam or link alone."""
    if "manipulator" in model:
        links, node, place = model["manipulator"]["links"], "P", "A1-B1"
        length, thickness = links["proximal_length_m"], links["thickness_m"]
    else:
        node = "C" if "C" in model["nodes"] and kind != "portal" else "B"
        place = "AC" if node == "C" else "AB"
        length = model["nodes"]["B"][1 if kind == "portal" else 0]
        thickness = model["sections"]["s"]["rectangle"]["thickness_m"]
    omega = first_omega(thickness, length)
    highest = omega / (2 * math.pi) * draw.logarithmic(0.03, 3)
    model["loads"] = {"force": {"node": node, "force_N": draw.direction(1)}}
    response = {"from_Hz": 0.02 * highest, "to_Hz": highest, "points": 41,
                "outputs": [f"displacement_x_m:{node}", f"displacement_y_m:{node}", f"bending_moment_N_m:{place}.start",
                            f"stress_Pa:{place}"]}
    if draw.chance(0.7):
        response["damping"] = {"rayleigh": {"stiffness_s": 2 * draw.logarithmic(1e-4, 0.3) / omega}}
    return {"harmonic": response}


def random_scene(seed, n):
    """Returns scene n of a seed."""
    draw, turn = Draw((seed + 1) * 0x9E3779B97F4A7C15 + n), n % 10
    tolerance = 0.01 if draw.chance(0.5) else draw.logarithmic(1e-4, 0.1)
    scene = {"id": f"random-{seed}-{n}", "effects": {"auto": {"tolerance": tolerance}}}
    if turn == 9:
        spins = draw.chance(0.1)
        scene["title"] = "spinning link" if spins else "manipulator in motion"
        scene["model"] = (spinning_link if spins else moving_manipulator)(draw, scene)
        return scene
    modes, vibrates = turn >= 5, turn == 8
    share = draw.uniform(0, 0.65 if vibrates else 1)
    kinds = [(0.35, "manipulator", manipulator), (0.5, "beam", beam), (0.65, "portal", portal),
             (1 if modes else 0.8, "column", column), (1, "path near a singularity", near_singular)]
    _, kind, build = next(k for k in kinds if share < k[0])
    scene["title"] = kind + (", harmonic" if vibrates else ", modes" if modes else ", statics")
    model = scene["model"] = build(modes, draw)
    if vibrates:
        scene["analysis"] = harmonic(draw, kind, model)
    else:
        scene["analysis"] = {"modes": {"count": 1 if draw.chance(0.5) else 3}} if modes else {"statics": {}}
    return scene


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--scenes", type=int, nargs="+", default=range(100))
    parser.add_argument("--transform", help="name of a transformation of tests/metamorphic")
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    for n in options.scenes:
        path = options.folder / f"random-{options.seed}-{n}.json"
        scene = random_scene(options.seed, n)
        with contextlib.suppress(transformations.Skip):
            scene = transformations.ALL[options.transform](scene)[0] if options.transform else scene
        path.write_text(json.dumps(scene, indent=1) + "\n")
        print(path)


if __name__ == "__main__":
    main()
