#!/usr/bin/env python3
"""Modes of the planar 3-RRR manipulator of Table 1 for all variants of its joints at three poses, and statics under 10 N at P, by CalculiX.

    planar_manipulator.py OUT      writes calculix-VARIANT-POSE-frequencies and -displacement into OUT/references.json

Links are in plane stress (CPS8R, two elements through the thickness). They shear, bend and have rotary inertia like a body of that
shape, but do not contract sideways. The reason is that ccx 2.20 makes a solid of a plane-stress element. Its shear out of the plane
hinders contraction if the width (30 mm) is not small compared with the thickness (1.5 mm). With Poisson's ratio 0.33 links would
bend as stiffly as in plane strain, 1 / (1 - nu^2). G is E / (2 (1 + 0.33)). The platform is rigid, with the masses of an equilateral
plate: a twelfth of it in each corner, the rest in P. Each value comes from two meshes. The stored uncertainty is their difference,
rounded up (at least 2e-6, because ccx prints seven digits).
"""
import math
import sys

from spatial_manipulator import DEFAULT, geometry, run, store

POSES = {"centroid": DEFAULT["pose"], "start": (0.26, 0.144, 0.0), "turned": (0.26, 0.144, math.radians(10))}
VARIANTS = [f"{a}-{e}-{p}" for a in ("locked", "sprung", "free") for e in ("welded", "hinged") for p in ("hinged", "welded")]
SPRING = 10.0  # stiffness of a sprung actuator [N m/rad]
MESHES = (24, 40)  # elements along a link
DEPTH = 2
E, G = DEFAULT["E"], DEFAULT["E"] / (2 * (1 + DEFAULT["nu"]))
MATERIAL = ["*MATERIAL,NAME=M", "*ELASTIC,TYPE=ENGINEERING CONSTANTS", f"{E},{E},{E},0,0,0,{G:.12g},{G:.12g}", f"{G:.12g}"]


class Deck:
    def __init__(self):
        self.nodes, self.elements, self.rest, self.sections, self.bodies = [], [], [], [], 0

    def node(self, x, y):
        self.nodes.append((x, y))
        return len(self.nodes)

    def link(self, p, q, n):
        """Adds a link of eight-node quadrilaterals from p to q. Returns the nodes of both end sections."""
        length, h = math.dist(p, q), DEFAULT["thickness"]
        c, s = (q[0] - p[0]) / length, (q[1] - p[1]) / length
        name = f"L{len(self.sections)}"
        self.sections += [f"*ORIENTATION,NAME={name}", f"{c:.12g},{s:.12g},0,{-s:.12g},{c:.12g},0",
                          f"*SOLID SECTION,ELSET={name},MATERIAL=M,ORIENTATION={name}", f"{DEFAULT['width']!r}"]
        rows = []
        for i in range(2 * n + 1):
            offsets = [h * (j / (2 * DEPTH) - 0.5) for j in range(0, 2 * DEPTH + 1, 1 if i % 2 == 0 else 2)]
            rows.append([self.node(p[0] + c * length * i / (2 * n) - s * z, p[1] + s * length * i / (2 * n) + c * z) for z in offsets])
        for i in range(0, 2 * n, 2):
            a, b, d = rows[i:i + 3]
            for j in range(DEPTH):
                self.elements.append(("CPS8R", name, [a[2 * j], d[2 * j], d[2 * j + 2], a[2 * j + 2],
                                                         b[j], d[2 * j + 1], b[j + 1], a[2 * j + 1]]))
        return rows[0], rows[-1]

    def rigid(self, nodes, place):
        """Adds a rigid body. Returns the nodes of its displacement and of its rotation."""
        self.bodies += 1
        reference, turn = self.node(*place), self.node(*place)
        self.rest += [f"*NSET,NSET=R{self.bodies}", *(f"{n}," for n in nodes),
                      f"*RIGID BODY,NSET=R{self.bodies},REF NODE={reference},ROT NODE={turn}", "*BOUNDARY", f"{turn},1,2"]
        return reference, turn

    def mesh(self, elements, unused=()):
        lines = ["*NODE,NSET=ALL"] + [f"{i + 1},{x:.12g},{y:.12g},0" for i, (x, y) in enumerate(self.nodes) if i + 1 not in unused]
        for number, (kind, name, nodes) in enumerate(elements, 1):
            lines += [f"*ELEMENT,TYPE={kind},ELSET={name}", ",".join(map(str, [number, *nodes]))]
        return lines

    def hinge(self, own, other):
        for dof in (1, 2):
            self.rest += ["*EQUATION", "2", f"{own},{dof},1.,{other},{dof},-1."]


def build(variant, pose, n):
    active, elbow, top = variant.split("-")
    r = {**DEFAULT, "pose": POSES[pose]}
    base, elbows, corners = geometry(r)
    deck = Deck()
    body = [deck.node(*c) for c in corners]
    feet, welded = [], []
    for a, b, c, corner in zip(base, elbows, corners, body):
        start, low = deck.link(a, b, n)
        high, end = deck.link(b, c, n)
        feet.append(deck.rigid(start, a))
        if elbow == "welded":
            deck.rigid(low + high, b)
        else:
            deck.hinge(deck.rigid(low, b)[0], deck.rigid(high, b)[0])
        if top == "welded":
            welded += end
        else:
            deck.hinge(deck.rigid(end, c)[0], corner)
    weights = [deck.node(*place) for place in [r["pose"][:2], *corners]]  # in ccx, a reference node of a rigid body cannot have a mass
    p, turn = deck.rigid(body + weights + welded, r["pose"][:2])
    mass = DEFAULT["rho"] * math.sqrt(3) / 4 * r["side"]**2 * r["plate_thickness"]
    for i, node in enumerate(weights):
        name, m = f"M{i}", mass / 12 if i else 0.75 * mass
        deck.elements.append(("MASS", name, [node]))
        deck.rest += [f"*MASS,ELSET={name}", f"{m!r}"]
    deck.rest += ["*BOUNDARY", f"{p},3"]
    for i, (foot, angle) in enumerate(feet):
        deck.rest += ["*BOUNDARY", f"{foot},1,2"]
        if active == "locked":
            deck.rest.append(f"{angle},3")
        elif active == "sprung":
            follower = deck.node(*base[i])  # extra node: ccx 2.20 fails with a spring on the rotation node of a rigid body
            deck.elements.append(("SPRING1", f"S{i}", [follower]))
            deck.rest += ["*BOUNDARY", f"{follower},2,3", "*EQUATION", "2", f"{follower},1,1.,{angle},3,-1.", f"*SPRING,ELSET=S{i}", "1", f"{SPRING!r}"]
    return deck.mesh(deck.elements) + deck.rest + MATERIAL + ["*DENSITY", f"{DEFAULT['rho']!r}", *deck.sections], p, turn


def frequencies(variant, pose, n):
    """Returns eight elastic frequencies [Hz], and the number of rigid motions at 0 Hz."""
    lines, _, _ = build(variant, pose, n)
    found = [row[3] for row in run(lines + ["*STEP", "*FREQUENCY", "11", "*END STEP"]) if len(row) == 5][:11]
    rigid = sum(f < 0.5 for f in found)
    return found[rigid:rigid + 8], rigid


def statics(variant, pose, n):
    """Returns ux, uy [m] and rotation [rad] of P under 10 N along x."""
    lines, p, turn = build(variant, pose, n)
    rows = run(lines + [f"*NSET,NSET=P", f"{p},{turn}", "*STEP", "*STATIC", "*CLOAD", f"{p},1,10.", "*NODE PRINT,NSET=P", "U", "*END STEP"])
    return rows[0][1:3] + [rows[1][3]]


def main():
    folder = sys.argv[1]
    for variant in VARIANTS:
        for pose in POSES:
            (coarse, _), (fine, rigid) = (frequencies(variant, pose, n) for n in MESHES)
            change = max(2e-6, max(abs(a / b - 1) for a, b in zip(coarse, fine)))
            change = math.ceil(change * 1e6) / 1e6
            notes = (f"Elements CPS8R: {MESHES[1]} along a link and {DEPTH} over its thickness. With {MESHES[0]} elements along a link, the values change by "
                     f"no more than the uncertainty. Rigid platform." + (f" {rigid} rigid motions at 0 Hz are omitted." if rigid else ""))
            words = variant.split("-")
            title = f"3-RRR, actuators {words[0]}, elbows {words[1]}, platform joints {words[2]}, pose {pose}: "
            store(folder, f"calculix-{variant}-{pose}-frequencies", title + "eight elastic frequencies by CalculiX", "Hz", fine, change, notes)
            print(variant, pose, rigid, change, *fine, flush=True)
            if rigid == 0 and words[0] != "free":
                a, b = (statics(variant, pose, n) for n in MESHES)
                change = math.ceil(max(2e-6, max(abs(u - v) for u, v in zip(a[:2], b[:2])) / max(map(abs, b[:2]))) * 1e6) / 1e6
                store(folder, f"calculix-{variant}-{pose}-displacement", title + "displacement x, y of P under 10 N along x, by CalculiX", "m",
                      b[:2], change, notes)
                print("   statics", change, b, flush=True)


if __name__ == "__main__":
    main()
