#!/usr/bin/env python3
"""Motion of the flexible, undamped manipulator of Table 1 (hinged elbows) under the torques of rigid links, by CalculiX.

    forward_dynamics.py OUT      writes calculix-forward-dynamics into OUT/references.json

Each value is the distance of P from the path, in x and y, at POINTS times.

The manipulator of circle_motion.py moves along a straight line from rest to rest, by 10 u^3 - 15 u^4 + 6 u^5. The simulation continues for
half of that time. The feet of the links turn freely about their middles, each under the torque of rigid links. Two forces on the edges of
the foot along the link apply that torque. Their directions are first those of rigid links, then those that were computed (a foot bent by
0.03 rad would lose 4e-4 of its torque). The torques follow from virtual work, with virtual displacements and accelerations from finite
differences of positions.
"""
import math
import sys

from circle_motion import build
from planar_manipulator import DEFAULT, DEPTH, geometry, run, store

START, END, DURATION = (0.26, 0.144, 0.0), (0.235, 0.16, 0.1), 0.1  # start and end pose [m, rad], time between them [s]
WATCHED, POINTS = 0.15, 10  # simulated time [s], number of output times
MESHES = ((4, 800), (8, 1600))  # elements along a link, steps
TURN, TICK = 1e-5, 1e-4  # steps of the finite differences: virtual displacements [m, rad], time [s]


def pose(t):
    u = min(max(t / DURATION, 0.0), 1.0)
    return tuple(a + (b - a) * u**3 * (10 - 15 * u + 6 * u * u) for a, b in zip(START, END))


def bodies(at):
    """Returns (x, y, angle) of the centers of the six links and of the platform at a pose."""
    links = [pair for limb in zip(*geometry({**DEFAULT, "pose": at})) for pair in zip(limb, limb[1:])]
    return [((p[0] + q[0]) / 2, (p[1] + q[1]) / 2, math.atan2(q[1] - p[1], q[0] - p[0])) for p, q in links] + [at]


def inertias():
    """Returns (mass, moment of inertia about the center) of the six links and of the platform."""
    link = DEFAULT["rho"] * DEFAULT["width"] * DEFAULT["thickness"]
    plate = DEFAULT["rho"] * math.sqrt(3) / 4 * DEFAULT["side"]**2 * DEFAULT["plate_thickness"]
    limb = [math.dist(*pair) for at in [geometry({**DEFAULT, "pose": START})] for i in range(3)
            for pair in ((at[0][i], at[1][i]), (at[1][i], at[2][i]))]
    return [(link * length, link * length**3 / 12) for length in limb] + [(plate, plate * DEFAULT["side"]**2 / 12)]


def solved(matrix, right):
    """Solves three linear equations by Cramer's rule."""
    def det(m):
        return sum(m[0][i] * (m[1][(i + 1) % 3] * m[2][(i + 2) % 3] - m[1][(i + 2) % 3] * m[2][(i + 1) % 3]) for i in range(3))
    return [det([[right[r] if c == k else matrix[r][c] for c in range(3)] for r in range(3)]) / det(matrix) for k in range(3)]


def torques(t):
    """Returns the torques of the three actuators on rigid links [N m]."""
    at = pose(t)
    before, now, after = (bodies(pose(t + s * TICK)) for s in (-1, 0, 1))
    second = [[(a - 2 * b + c) / TICK**2 for a, b, c in zip(*body)] for body in zip(before, now, after)]
    rows, work = [], []
    for k in range(3):
        less, more = (bodies([x + s * TURN * (i == k) for i, x in enumerate(at)]) for s in (-1, 1))
        virtual = [[(b - a) / (2 * TURN) for a, b in zip(*body)] for body in zip(less, more)]
        rows.append([virtual[2 * i][2] for i in range(3)])
        work.append(sum(m * (a[0] * d[0] + a[1] * d[1]) + J * a[2] * d[2] for (m, J), a, d in zip(inertias(), second, virtual)))
    return solved(rows, work)


def motion(along, steps, angles=None):
    """Returns the distance of P from the line at POINTS times [m], and the link angles at A at each step. Default angles: those of rigid links."""
    lines, feet, p = build(along)
    times = [WATCHED * i / steps for i in range(steps + 1)]
    table = [(t, bodies(pose(t)), torques(t)) for t in times]
    angles = angles or [[links[2 * i][2] for i in range(3)] for _, links, _ in table]
    start, loads, edges = [links[2 * i][2] for links in (table[0][1],) for i in range(3)], [], []
    for i, foot in enumerate(feet):
        lines += ["*BOUNDARY", f"{foot[DEPTH][0]},1,2"]
        for (node, _), sign in ((foot[0], 1), (foot[-1], -1)):
            edges.append(node)
            for dof, along_link in ((1, math.cos), (2, math.sin)):
                lines.append(f"*AMPLITUDE,NAME=F{node}-{dof}")
                lines += [f"{t:.12e},{sign * torque[i] / DEFAULT['thickness'] * along_link(angle[i]):.12e}"
                          for (t, _, torque), angle in zip(table, angles)]
                loads += [f"*CLOAD,AMPLITUDE=F{node}-{dof}", f"{node},{dof},1."]
    rows = run(lines + ["*NSET,NSET=SHOWN", *(f"{n}," for n in [*edges, p]), f"*STEP,NLGEOM,INC={2 * steps}", "*DYNAMIC,DIRECT,ALPHA=0.",
                        f"{WATCHED / steps:.14e},{WATCHED:.14e}", *loads, "*NODE PRINT,NSET=SHOWN", "U", "*END STEP"])
    moved = [{int(row[0]): row[1:3] for row in rows[k:k + len(edges) + 1]} for k in range(0, len(rows), len(edges) + 1)]
    found = [start]
    for step in moved:
        turned = []
        for i, foot in enumerate(feet):
            (low, a), (high, b) = foot[0], foot[-1]
            face = [b[k] - a[k] + step[high][k] - step[low][k] for k in (0, 1)]
            turned.append(math.atan2(-face[0], face[1]))
        found.append(turned)
    away = [START[k] + moved[steps * i // POINTS - 1][p][k] - pose(WATCHED * i / POINTS)[k] for i in range(1, POINTS + 1) for k in (0, 1)]
    return away, found


def main():
    folder = sys.argv[1]
    coarse, fine = (motion(*mesh, motion(*mesh)[1])[0] for mesh in MESHES)
    change = max(abs(a - b) for a, b in zip(coarse, fine)) / max(map(abs, fine))
    store(folder, "calculix-forward-dynamics", "Flexible 3-RRR under the torques of rigid links from rest to rest: distance of P from the line in "
          f"x and y at {POINTS} times, by CalculiX", "m", fine, math.ceil(1e5 * change) / 1e5,
          f"Elements CPS8R: {MESHES[1][0]} along a link and {DEPTH} over its thickness, {MESHES[1][1]} time steps. The uncertainty is the largest change "
          f"with {MESHES[0][0]} elements and {MESHES[0][1]} steps, relative to the largest value. Hinges at elbows and platform, rigid platform, no damping.")
    print(change, fine, flush=True)


if __name__ == "__main__":
    main()
