#!/usr/bin/env python3
"""Large tip displacements of the Princeton beam under dead loads, as a solid, by CalculiX.

    princeton_beam.py OUT      writes calculix-princeton-AXIS and -AXIS-without-contraction into OUT/references.json

The elements are C3D20R. Every motion of the clamped face is fixed, the consistent loads of the bricks spread the load over the end
face, and the tip is the middle of that face. If Poisson's ratio is 0, the clamp does not prevent contraction. By default ccx ends
Newton's iteration at 0.5 % of the force, which leaves an error of 0.2 % in the soft direction. Here it ends at 1e-9.
"""
import math
import sys

from planar_manipulator import run, store

E, LENGTH = 71.7e9, 0.508
SECTIONS = {"stiff": (0.0123777, 0.0032024), "soft": (0.0032024, 0.0123777)}
LOADS = (8.896, 13.345)


def build(depth, width, nu, cells):
    """Returns the nodes of 20-node bricks on a grid of half cells; x is along the beam, y over the depth."""
    number, lines = {}, ["*NODE"]
    size = [(LENGTH, 2 * cells[0]), (depth, 2 * cells[1]), (width, 2 * cells[2])]

    def node(*at):
        if at not in number:
            number[at] = len(number) + 1
            x, y, z = (length * k / steps for (length, steps), k in zip(size, at))
            lines.append(f"{number[at]},{x:.12g},{y - depth / 2:.12g},{z - width / 2:.12g}")
        return number[at]

    corners = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)]
    edges = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
    places = corners + [tuple((a + b) // 2 for a, b in zip(corners[i], corners[j])) for i, j in edges]
    bricks = []
    for i in range(cells[0]):
        for j in range(cells[1]):
            for k in range(cells[2]):
                bricks.append([node(2 * i + x, 2 * j + y, 2 * k + z) for x, y, z in places])
    lines += ["*ELEMENT,TYPE=C3D20R,ELSET=ALL"]
    for n, nodes in enumerate(bricks, 1):
        text = list(map(str, [n, *nodes]))
        lines += [",".join(text[:11]) + ",", ",".join(text[11:])]
    clamp = [n for (i, _, _), n in number.items() if i == 0]
    # Consistent loads of a uniform traction on faces of eight nodes: -1/12 at corners, 1/3 at middles.
    share = {}
    for j in range(cells[1]):
        for k in range(cells[2]):
            for y in range(3):
                for z in range(3):
                    if (y, z) != (1, 1):
                        n = number[(2 * cells[0], 2 * j + y, 2 * k + z)]
                        share[n] = share.get(n, 0) + (1 / 3 if 1 in (y, z) else -1 / 12) / (cells[1] * cells[2])
    lines += ["*MATERIAL,NAME=M", "*ELASTIC", f"{E},{nu}", "*SOLID SECTION,ELSET=ALL,MATERIAL=M", "*BOUNDARY"]
    lines += [f"{n},1,3" for n in clamp]
    tip = number[(2 * cells[0], cells[1], cells[2])]
    return lines + ["*NSET,NSET=TIP", f"{tip}"], share


def tip(axis, nu, cells):
    """Returns ux, uy of the tip [m] under each load."""
    depth, width = SECTIONS[axis]
    lines, share = build(depth, width, nu, cells)
    values = []
    for load in LOADS:
        rows = run(lines + ["*STEP,NLGEOM,INC=1000", "*STATIC", "0.25,1.", "*CONTROLS,PARAMETERS=FIELD", "1e-9,1e-9", "*CLOAD", *(f"{n},2,{load * part!r}" for n, part in share.items()),
                            "*NODE PRINT,NSET=TIP,FREQUENCY=1000", "U", "*END STEP"])
        values += rows[-1][1:3]
    return values


def main():
    folder = sys.argv[1]
    for axis, meshes in {"stiff": ((40, 2, 2), (80, 4, 4)), "soft": ((40, 2, 4), (60, 2, 8))}.items():
        for name, nu, (coarse, fine) in (("", 0.31, meshes), ("-without-contraction", 0.0, ((20, 2, 2), (40, 2, 2)))):
            rough, values = tip(axis, nu, coarse), tip(axis, nu, fine)
            change = max(2e-6, *(abs(a / b - 1) for a, b in zip(rough[1::2], values[1::2])))
            store(folder, f"calculix-princeton-{axis}{name}", f"Princeton beam, bent about its {axis} axis, as a solid of Poisson's "
                  f"ratio {nu:g}: tip deflection by CalculiX", "m", values[1::2], math.ceil(change * 1e6) / 1e6,
                  f"Elements C3D20R: {fine[0]} along the beam, {fine[1]} over the depth, {fine[2]} over the width. With {coarse[0]} x {coarse[1]} x "
                  f"{coarse[2]} elements, the values change by the uncertainty.")


if __name__ == "__main__":
    main()
