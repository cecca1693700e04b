#!/usr/bin/env python3
"""Large-displacement statics of the manipulator of Table 1 (locked, welded, hinged) under 10 N at P, by CalculiX.

    large_displacement.py OUT      writes calculix-large-POSE-displacement into OUT/references.json

Links are as in planar_manipulator.py. Equations and rigid bodies fail for large rotations in ccx 2.20 (Newton's iteration diverges).
Therefore feet are fixed node by node, and elbows and platform are triangles of a material STIFF times as stiff that share nodes with
the links. The middles of both end faces are one node, and their outermost nodes keep their angle. A section may warp there, which
increases the displacement of P. The stored uncertainty is this increase, measured with the same mesh in linear statics.
"""
import math
import sys

from planar_manipulator import DEFAULT, DEPTH, MATERIAL, POSES, Deck, E, geometry, run, statics, store

STIFF = 1e3
ALONG = 16


def turns_left(nodes, triangle):
    (x0, y0), (x1, y1), (x2, y2) = (nodes[n - 1] for n in triangle)
    return (x1 - x0) * (y2 - y0) > (x2 - x0) * (y1 - y0)


def build(pose, flexible=False):
    """Returns the ccx input, the node P and the nodes of the sections at A1, A2, A3. A flexible platform is made as in Table 1."""
    base, elbows, corners = geometry({**DEFAULT, "pose": POSES[pose]})
    deck, joints, ends, feet, same = Deck(), [], [], [], {}
    for a, b, c in zip(base, elbows, corners):
        start, low = deck.link(a, b, ALONG)
        high, end = deck.link(b, c, ALONG)
        feet.append(start)
        for node in start:
            deck.rest += ["*BOUNDARY", f"{node},1,2"]
        same[high[DEPTH]] = low[DEPTH]
        for k in (0, -1):
            triangle = [low[DEPTH], low[k], high[k]]
            joints.append(triangle if turns_left(deck.nodes, triangle) else triangle[::-1])
        ends.append(end[DEPTH])
    p = deck.node(*POSES[pose][:2])
    platform = [[p, ends[i], ends[(i + 1) % 3]] for i in range(3)]
    elements = [(kind, name, [same.get(n, n) for n in nodes]) for kind, name, nodes in deck.elements] + [
        ("CPS3", name, t) for name, triangles in (("JOINTS", joints), ("PLATFORM", platform)) for t in triangles]
    plate, width = ((E, DEFAULT["nu"]), DEFAULT["plate_thickness"]) if flexible else ((E * STIFF, 0.0), DEFAULT["width"])
    return deck.mesh(elements) + deck.rest + MATERIAL + [
        *deck.sections, "*MATERIAL,NAME=STIFF", "*ELASTIC", f"{E * STIFF},0.", "*SOLID SECTION,ELSET=JOINTS,MATERIAL=STIFF", f"{DEFAULT['width']!r}",
        "*MATERIAL,NAME=PLATE", "*ELASTIC,TYPE=ENGINEERING CONSTANTS",  # no contraction normal to the plane, where ccx hinders it
        "{0},{0},{0},{1},0,0,{2:.12g},{2:.12g}".format(*plate, plate[0] / 2 / (1 + plate[1])), f"{plate[0] / 2 / (1 + plate[1]):.12g}",
        "*SOLID SECTION,ELSET=PLATFORM,MATERIAL=PLATE", f"{width!r}"], p, feet


def displacement(pose, large):
    """Returns ux, uy of P [m]."""
    lines, p, _ = build(pose)
    rows = run(lines + ["*NSET,NSET=P", f"{p}", "*STEP,NLGEOM,INC=1000" if large else "*STEP", "*STATIC", "0.1,1.", "*CLOAD", f"{p},1,10.",
                        "*NODE PRINT,NSET=P,FREQUENCY=1000", "U", "*END STEP"])
    return rows[-1][1:3]


def main():
    folder = sys.argv[1]
    for pose in POSES:
        linear, large, rigid = displacement(pose, False), displacement(pose, True), statics("locked-welded-hinged", pose, 24)
        change = math.ceil(1e5 * math.dist(linear, rigid[:2]) / math.hypot(*linear)) / 1e5
        store(folder, f"calculix-large-{pose}-displacement",
              f"3-RRR, actuators locked, elbows welded, platform joints hinged, pose {pose}: displacement x, y of P under 10 N "
              "along x, large-displacement theory, by CalculiX", "m", large, change,
              f"Elements CPS8R: {ALONG} along a link and {DEPTH} over its thickness. Elbows and platform are {STIFF:g} times as stiff as the links. "
              "The uncertainty is the relative change of the displacement of P with rigid joints in linear statics.")
        print(pose, change, linear, large, rigid, flush=True)


if __name__ == "__main__":
    main()
