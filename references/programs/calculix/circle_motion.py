#!/usr/bin/env python3
"""Motion of the flexible manipulator of Table 1 along the paper's circle by CalculiX, undamped: elbows and platform on hinges.

    circle_motion.py OUT SPEED...      writes calculix-motion-SPEED into OUT/references.json

Each value is the distance of P from the path, in x and y, at POINTS times.

The actuators turn as with rigid links, from rest to full speed within the time of half a lap, and then along the circle. Links are as in
planar_manipulator.py. A hinge is a node that the middles of two end faces share. The platform consists of three triangles of a material
STIFF times as stiff, because equations and rigid bodies fail for large rotations in ccx 2.20. The analysis is geometrically exact (NLGEOM)
with the trapezoidal rule.

*DYNAMIC of ccx 2.20 uses half of the mass of CPS8R, while modes use all of it. The tip of a single link whose fixed end turns lags by 6.126e-6 m,
but 12.243e-6 m is exact. With twice the density it lags by 12.241e-6 m (CPS8, which locks: 12.141e-6 m). Therefore links have twice their density
here. Initial velocities do not move plane elements; therefore the path starts from rest. At 1 rad/s Newton's iteration ends with "solution seems to
diverge", because the forces are too small for its criteria.
"""
import math
import sys

from planar_manipulator import DEFAULT, DEPTH, MATERIAL, Deck, E, geometry, run, store

STIFF, ALONG, STEPS = 1e3, 4, (400, 800)
RADIUS, CENTER = 0.01, (0.25, 0.144)
POINTS, DURATION = 10, 2.5  # number of output times; duration in half periods of the circle


def angle(u):
    """Angle of P on the circle at time u pi / speed: full speed after the time of half a lap (u = 1), a full turn at u = 2.5."""
    v = min(u, 1.0)
    return math.pi * (v**4 * (2.5 - 3 * v + v * v) + max(u - 1.0, 0.0))


def pose(angle):
    return CENTER[0] + RADIUS * math.cos(angle), CENTER[1] + RADIUS * math.sin(angle), 0.0


def places(angle):
    """Returns A, B, C of each limb if P is at this angle on the circle."""
    return list(zip(*geometry({**DEFAULT, "pose": pose(angle)})))


def build(along):
    """Returns the lines of the ccx input, nodes and offsets of the sections at A (feet), the node P, and for each node its link's ends."""
    deck, same, feet, corners, limbs = Deck(), {}, [], [], {}
    for i, (a, b, c) in enumerate(places(0.0)):
        before = len(deck.nodes)
        start, low = deck.link(a, b, along)
        limbs.update({n: (i, 0) for n in range(before + 1, len(deck.nodes) + 1)})
        before = len(deck.nodes)
        high, end = deck.link(b, c, along)
        limbs.update({n: (i, 1) for n in range(before + 1, len(deck.nodes) + 1)})
        same[high[DEPTH]] = low[DEPTH]
        corners.append(end[DEPTH])
        feet.append([(n, [p - q for p, q in zip(deck.nodes[n - 1], a)]) for n in start])
    p = deck.node(*pose(0.0)[:2])
    elements = [(kind, name, [same.get(n, n) for n in nodes]) for kind, name, nodes in deck.elements]
    between = {pair: deck.node(*((u + v) / 2 for u, v in zip(*(deck.nodes[n - 1] for n in pair))))
               for i in range(3) for pair in ((p, corners[i]), (corners[i], corners[(i + 1) % 3]))}
    for i in range(3):
        q, r = corners[i], corners[(i + 1) % 3]
        elements.append(("CPS6", "PLATFORM", [p, q, r, between[p, q], between[q, r], between[p, r]]))
    lines = deck.mesh(elements, same) + MATERIAL + ["*DENSITY", f"{2 * DEFAULT['rho']!r}", *deck.sections,
                        "*MATERIAL,NAME=STIFF", "*ELASTIC", f"{E * STIFF},0.", "*DENSITY", f"{DEFAULT['rho'] * DEFAULT['plate_thickness'] / DEFAULT['width']!r}", "*SOLID SECTION,ELSET=PLATFORM,MATERIAL=STIFF", f"{DEFAULT['width']!r}"]
    return lines, feet, p


def motion(speed, along, steps):
    """Returns the distance of P from its nominal position on the circle, in x and y, at POINTS times [m]."""
    lines, feet, p = build(along)
    end = DURATION * math.pi / speed
    first = places(0.0)
    table = [places(angle(DURATION * i / steps)) for i in range(steps + 1)]
    bounds = []
    for i, foot in enumerate(feet):
        a, b, _ = first[i]
        start = math.atan2(b[1] - a[1], b[0] - a[0])
        turns = [math.atan2(w[i][1][1] - a[1], w[i][1][0] - a[0]) - start for w in table]
        for node, (x, y) in foot:
            for dof, u in ((1, lambda t: x * (math.cos(t) - 1) - y * math.sin(t)), (2, lambda t: y * (math.cos(t) - 1) + x * math.sin(t))):
                lines += [f"*AMPLITUDE,NAME=A{node}-{dof}"] + [f"{end * k / steps:.12e},{u(t):.12e}" for k, t in enumerate(turns)]
                bounds += [f"*BOUNDARY,AMPLITUDE=A{node}-{dof}", f"{node},{dof},{dof},1."]
    rows = run(lines + ["*NSET,NSET=P", f"{p}", f"*STEP,NLGEOM,INC={2 * steps}", "*DYNAMIC,DIRECT,ALPHA=0.",
                        f"{end / steps:.14e},{end:.14e}", *bounds, f"*NODE PRINT,NSET=P,FREQUENCY={steps // POINTS}", "U", "*END STEP"])
    away = []
    for i, row in enumerate(rows, 1):
        there, start = pose(angle(DURATION * i / POINTS)), pose(0.0)
        away += [start[k] + row[1 + k] - there[k] for k in (0, 1)]
    return away


def main():
    folder = sys.argv[1]
    for speed in map(int, sys.argv[2:]):
        coarse, fine = (motion(speed, ALONG, steps) for steps in STEPS)
        size = max(map(abs, fine))
        change = max(abs(a - b) for a, b in zip(coarse, fine)) / size
        store(folder, f"calculix-motion-{speed}", f"Flexible 3-RRR along the circle at {speed} rad/s, from rest: distance of P from the path in x "
              f"and y at {POINTS} times, by CalculiX", "m", fine, math.ceil(1e5 * change) / 1e5,
              f"Elements CPS8R: {ALONG} along a link and {DEPTH} over its thickness, {STEPS[1]} time steps. The uncertainty is the largest change with "
              f"{STEPS[0]} steps, relative to the largest value. Actuators driven, hinges at elbows and platform, rigid platform, no damping.")
        print(speed, change, fine, flush=True)


if __name__ == "__main__":
    main()
