#!/usr/bin/env python3
"""Statics of the manipulator of Table 1 under 10 N at P along the circle of the paper, by CalculiX.

    circle.py OUT      writes calculix-circle-* into OUT/references.json

Actuators are locked, elbows welded, platform joints hinged. The results at eight points are the displacement of P and the forces of the
ground on the links. A rigid platform has linear (planar_manipulator.py) and large-displacement results (large_displacement.py). A platform
of three triangles has large-displacement results. Their uncertainty is measured at each point. It is due to warping sections at the elbows.
"""
import math
import sys

import large_displacement
from planar_manipulator import DEFAULT, MESHES, POSES, run, statics, store

POINTS = 8
VARIANT = "locked-welded-hinged"


def poses():
    for i in range(POINTS):
        angle = 2 * math.pi * i / POINTS
        POSES[f"circle-{i}"] = (0.25 + 0.01 * math.cos(angle), 0.144 + 0.01 * math.sin(angle), 0.0)
        yield f"circle-{i}"


def response(pose, large, flexible):
    """Returns ux, uy of P [m] and the forces of the ground on A1, A2, A3 [N]."""
    lines, p, feet = large_displacement.build(pose, flexible)
    sets = [line for i, foot in enumerate(feet) for line in (f"*NSET,NSET=A{i}", *(f"{n}," for n in foot))]
    prints = [line for i in range(3) for line in (f"*NODE PRINT,NSET=A{i},FREQUENCY=1000,TOTALS=ONLY", "RF")]
    rows = run(lines + sets + ["*NSET,NSET=P", f"{p}", "*STEP,NLGEOM,INC=1000" if large else "*STEP", "*STATIC", "0.1,1.", "*CLOAD",
                               f"{p},1,10.", "*NODE PRINT,NSET=P,FREQUENCY=1000", "U", *prints, "*END STEP"], totals=True)
    forces = [row for row in rows if len(row) == 3]
    return [row for row in rows if len(row) == 4][-1][1:3], [v for row in forces[-3:] for v in row[:2]]


def main():
    folder = sys.argv[1]
    found, warp, change = {}, 0.0, 0.0
    for pose in poses():
        coarse, fine = (statics(VARIANT, pose, n)[:2] for n in MESHES)
        change = max(change, math.dist(coarse, fine) / math.hypot(*fine))
        linear = response(pose, False, False)
        warp = max(warp, math.dist(linear[0], fine) / math.hypot(*fine))
        for name, values in (("rigid", fine), ("rigid-forces", linear[1])):
            found.setdefault(name, []).extend(values)
        for name, flexible in (("large-rigid", False), ("large-flexible", True)):
            displacement, forces = response(pose, True, flexible)
            found.setdefault(name, []).extend(displacement)
            found.setdefault(name + "-forces", []).extend(forces)
            print(pose, name, displacement, forces, sum(forces[::2]), flush=True)
    warp, change = math.ceil(1e5 * warp) / 1e5, math.ceil(1e6 * max(change, 2e-6)) / 1e6
    for name, values in found.items():
        forces, kind = name.endswith("-forces"), "flexible" if "flexible" in name else "rigid"
        what = "forces of the ground on A1, A2, A3 in x and y" if forces else "displacement x, y of P"
        store(folder, f"calculix-circle-{name}", f"3-RRR, 10 N along x at P at {POINTS} points of the circle, "
              f"{kind} platform{', large displacement' * ('large' in name)}: {what}, by CalculiX", "N" if forces else "m", values, change if name == "rigid" else warp,
              "Actuators locked, elbows welded, platform joints hinged. The values are in the order of the points from the start of the circle. " +
              (f"{MESHES[1]} elements along a link." if name == "rigid" else
               "The uncertainty is the largest increase of the linear displacement due to warping of the sections at the elbows."))
    print("warp", warp, "mesh", change)


if __name__ == "__main__":
    main()
