#!/usr/bin/env python3
"""Frame solver in plain Python, with ten optional faults, of which one can be active.

    trammel grade harness/adapters/wrong_solver.py -L frame
    trammel grade "harness/adapters/wrong_solver.py --fault moment-sign" -L frame

Statics and modes of frames: members with bending, shear and rotary inertia, hinged or sprung ends,
springs, point masses. README.md in the same folder lists the cases that detect each fault.
"""
import math
import sys

from trammel_adapter import Cannot, main

FAULTS = {
    "no-rotary-inertia": "the rotary inertia of sections is forgotten",
    "shear-doubled": "the shear coefficient is counted twice",
    "moment-sign": "bending moments have the wrong sign",
    "mass-coupling-halved": "the consistent mass matrix has half of its off-diagonal entries",
    "degrees": "rotations are in degrees but labeled as radians",
    "millimetres": "displacements are in millimeters but labeled as meters",
    "no-hinges": "hinges at the ends of members are ignored",
    "load-on-other-end": "a load on a node acts on the node before it in the file",
    "no-fixed-end-moments": "uniform loads lack their nodal moments",
    "angular-frequency": "angular frequencies are labeled as Hz",
}
FAULT = sys.argv[sys.argv.index("--fault") + 1] if "--fault" in sys.argv else None
if FAULT is not None and FAULT not in FAULTS:
    sys.exit("--fault: expected one of " + ", ".join(FAULTS))
STIFF = 1e12  # factor of the axial stiffness of an inextensible member
GAUSS = [(0.069431844202973712, 0.173927422568726929), (0.330009478207571868, 0.326072577431273071),
         (0.669990521792428132, 0.326072577431273071), (0.930568155797026288, 0.173927422568726929)]


def shear_ratio(m, L):
    kappa = m.kappa * (2 if FAULT == "shear-doubled" else 1)
    return 12 * m.E * m.I / (kappa * m.G * m.A * L * L) if m.beam in ("shear", "timoshenko") else 0.0


def stiffness(m, L):
    """Returns K of (u1 v1 r1 u2 v2 r2) in element axes: elongation, symmetric and antisymmetric bending."""
    k = (m.E * m.A * (STIFF if m.inextensible else 1) / L, m.E * m.I / L,
         3 * m.E * m.I / (L * (1 + shear_ratio(m, L))))
    B = ((-1, 0, 0, 1, 0, 0), (0, 0, -1, 0, 0, 1), (0, 2 / L, 1, 0, -2 / L, 1))
    return [[sum(k[d] * B[d][i] * B[d][j] for d in range(3)) for j in range(6)] for i in range(6)]


def mass(m, L):
    rotary = m.rho * m.I if m.beam in ("rayleigh", "timoshenko") else 0.0
    if FAULT == "no-rotary-inertia":
        rotary = 0.0
    if m.lumped:
        half = [m.rho * m.A * L / 2] * 2 + [rotary * L / 2]
        return [[(half + half)[i] if i == j else 0.0 for j in range(6)] for i in range(6)]
    M, f = [[0.0] * 6 for _ in range(6)], shear_ratio(m, L)
    for x, weight in GAUSS:
        g, h = 1 / (1 + f), f * (x - x * x) / 2
        v = (0, g * (1 - 3 * x**2 + 2 * x**3 + f * (1 - x)), g * L * (x - 2 * x**2 + x**3 + h),
             0, g * (3 * x**2 - 2 * x**3 + f * x), g * L * (x**3 - x**2 - h))
        r = (0, 6 * g * (x * x - x) / L, g * (1 - 4 * x + 3 * x**2 + f * (1 - x)),
             0, 6 * g * (x - x * x) / L, g * (3 * x**2 - 2 * x + f * x))
        u = (1 - x, 0, 0, x, 0, 0)
        for i in range(6):
            for j in range(6):
                M[i][j] += weight * L * (m.rho * m.A * (u[i] * u[j] + v[i] * v[j])
                                         + rotary * r[i] * r[j])
    if FAULT == "mass-coupling-halved":
        M = [[M[i][j] / (1 if i == j else 2) for j in range(6)] for i in range(6)]
    return M


def turned(K, c, s):
    """Returns T^T K T, which transforms K from element to world axes."""
    T = [[c, s, 0, 0, 0, 0], [-s, c, 0, 0, 0, 0], [0, 0, 1, 0, 0, 0],
         [0, 0, 0, c, s, 0], [0, 0, 0, -s, c, 0], [0, 0, 0, 0, 0, 1]]
    KT = [[sum(K[i][k] * T[k][j] for k in range(6)) for j in range(6)] for i in range(6)]
    return [[sum(T[k][i] * KT[k][j] for k in range(6)) for j in range(6)] for i in range(6)]


class Frame:
    """Frame elements and their dofs. Dofs of the case's nodes come last, for a small bandwidth."""

    def __init__(self, case, cut):
        self.case, self.names, self.elements, self.springs = case, {}, [], []
        at, self.count = case.model["nodes"], 0
        chains = [(m, m.elements if cut else 1) for m in case.members()]
        inner = [[self.new(3) for _ in range(n - 1)] for _, n in chains]
        self.names = {name: self.new(3) for name in at}
        for (m, n), nodes in zip(chains, inner):
            (xa, ya), (xb, yb) = at[m.nodes[0]], at[m.nodes[1]]
            length = math.hypot(xb - xa, yb - ya)
            if m.inextensible and xa != xb and ya != yb:
                raise Cannot("inextensible members must be along a world axis")
            way = [self.names[m.nodes[0]]] + nodes + [self.names[m.nodes[1]]]
            for e in range(n):
                dofs = way[e] + way[e + 1]
                if e == 0:
                    dofs[2] = self.end_rotation(m.ends[0], dofs[2])
                if e == n - 1:
                    dofs[5] = self.end_rotation(m.ends[1], dofs[5])
                self.elements.append((m, length / n, (xb - xa) / length, (yb - ya) / length, dofs))
        for spring in case.model.get("springs", {}).values():
            k = list(spring.get("stiffness_N_per_m", (0, 0)))
            k.append(spring.get("rotational_stiffness_N_m_per_rad", 0))
            ends = [self.names[name] for name in spring["nodes"]] + [[None] * 3]
            self.springs += list(zip(k, ends[0], ends[1]))
        self.fixed = {self.names[node][("x", "y", "rotation").index(motion)]
                      for node, motions in case.model.get("supports", {}).items()
                      for motion in motions}

    def new(self, n):
        self.count += n
        return list(range(self.count - n, self.count))

    def end_rotation(self, end, rotation):
        if end == "welded" or (FAULT == "no-hinges" and end == "hinged"):
            return rotation
        own = self.new(1)[0]
        if end != "hinged":
            self.springs.append((end, rotation, own))
        return own

    def assemble(self, element_matrix):
        """Returns a sparse matrix with one dictionary per row."""
        rows = [{} for _ in range(self.count)]
        for m, L, c, s, dofs in self.elements:
            K = turned(element_matrix(m, L), c, s)
            for i in range(6):
                for j in range(6):
                    rows[dofs[i]][dofs[j]] = rows[dofs[i]].get(dofs[j], 0.0) + K[i][j]
        return rows

    def matrices(self):
        K, M = self.assemble(stiffness), self.assemble(mass)
        for k, a, b in self.springs:
            for i, j, sign in ((a, a, 1), (b, b, 1), (a, b, -1), (b, a, -1)):
                if i is not None and j is not None:
                    K[i][j] = K[i].get(j, 0.0) + sign * k
        for point in self.case.model.get("point_masses", {}).values():
            if any(point.get("offset_m", ())):
                raise Cannot("point masses with an offset are not supported")
            for dof, value in zip(self.names[point["node"]], [point["mass_kg"]] * 2
                                  + [point.get("inertia_kg_m2", 0.0)]):
                M[dof][dof] = M[dof].get(dof, 0.0) + value
        # A node with hinged members only has no rotational stiffness, so its rotation is removed.
        free = [i for i in range(self.count)
                if i not in self.fixed and any(K[i].values())]
        return K, M, free


def pivots(K, free, M=None, shift=0.0):
    """Factorizes K - shift M = L D L^T in skyline form. Returns the rows of L, D, and the start of each row."""
    place = {dof: i for i, dof in enumerate(free)}
    L, D, first = [], [], []
    for i, dof in enumerate(free):
        entries = {place[j]: value for j, value in K[dof].items() if j in place and place[j] <= i}
        if shift:
            for j, value in M[dof].items():
                if j in place and place[j] <= i:
                    entries[place[j]] = entries.get(place[j], 0.0) - shift * value
        start = min(entries)
        row = [entries.get(j, 0.0) for j in range(start, i + 1)]
        for j in range(start, i):
            low = max(start, first[j])
            a, b = row[low - start:j - start], L[j][low - first[j]:j - first[j]]
            row[j - start] -= sum(x * y for x, y in zip(a, b))
        diagonal = row[-1]
        for j in range(start, i):
            scaled = row[j - start] / D[j]
            diagonal -= scaled * row[j - start]
            row[j - start] = scaled
        L.append(row)
        first.append(start)
        D.append(diagonal or 1e-300)
    return L, D, first


def solve_linear(K, free, load):
    """Solves K u = load by iterative refinement with exactly summed residuals, which recovers lost digits."""
    L, D, first = pivots(K, free)
    u = {dof: 0.0 for dof in free}
    for _ in range(4):
        x = [math.fsum([load[i]] + [-K[i][j] * u[j] for j in K[i] if j in u]) for i in free]
        for i in range(len(free)):
            x[i] -= sum(L[i][j - first[i]] * x[j] for j in range(first[i], i))
        x = [a / b for a, b in zip(x, D)]
        for i in reversed(range(len(free))):
            for j in range(first[i], i):
                x[j] -= L[i][j - first[i]] * x[i]
        for i, dof in enumerate(free):
            u[dof] += x[i]
    return u


def uniform_load(m, L, c, s):
    """Returns the nodal forces of a uniform load in world axes."""
    (qx, qy), couple = m.load, (c * m.load[1] - s * m.load[0]) * L * L / 12
    if FAULT == "no-fixed-end-moments":
        couple = 0.0
    return [qx * L / 2, qy * L / 2, couple, qx * L / 2, qy * L / 2, -couple]


def statics(case):
    frame = Frame(case, cut=False)  # one element per member is exact in statics
    K, _, free = frame.matrices()
    load = [0.0] * frame.count
    order = list(frame.names)
    for one in case.model.get("loads", {}).values():
        node = one["node"]
        if FAULT == "load-on-other-end":
            node = order[order.index(node) - 1]
        force = list(one.get("force_N", (0.0, 0.0))) + [one.get("moment_N_m", 0.0)]
        for dof, value in zip(frame.names[node], force):
            load[dof] += value
    for m, L, c, s, dofs in frame.elements:
        for dof, value in zip(dofs, uniform_load(m, L, c, s)):
            load[dof] += value
    u = solve_linear(K, free, load)
    at = lambda dof: u.get(dof, 0.0)
    found = {}
    for name, dofs in frame.names.items():
        length, angle = FAULT == "millimetres", FAULT == "degrees"
        found["displacement_x_m:" + name] = at(dofs[0]) * (1000 if length else 1)
        found["displacement_y_m:" + name] = at(dofs[1]) * (1000 if length else 1)
        found["rotation_rad:" + name] = at(dofs[2]) * (180 / math.pi if angle else 1)
        for key, dof in zip(("x_N", "y_N", "moment_N_m"), dofs):
            held = math.fsum([-load[dof]] + [K[dof][j] * at(j) for j in K[dof]])
            found["reaction_%s:%s" % (key, name)] = held if dof in frame.fixed else 0.0
    for m, L, c, s, dofs in frame.elements:
        d = [at(dof) for dof in dofs]
        d = [c * d[0] + s * d[1], c * d[1] - s * d[0], d[2],
             c * d[3] + s * d[4], c * d[4] - s * d[3], d[5]]
        f, k = uniform_load(m, L, c, s), stiffness(m, L)
        f = [c * f[0] + s * f[1], c * f[1] - s * f[0], f[2],
             c * f[3] + s * f[4], c * f[4] - s * f[3], f[5]]
        N = [math.fsum([-f[i]] + [k[i][j] * d[j] for j in range(6)]) for i in range(6)]
        bending = -1 if FAULT == "moment-sign" else 1
        for end, sign, i in ((".start", -1, 0), (".end", 1, 3)):
            found["axial_force_N:" + m.name + end] = sign * N[i]
            found["shear_force_N:" + m.name + end] = sign * N[i + 1]
            found["bending_moment_N_m:" + m.name + end] = sign * bending * N[i + 2]
    return found


def modes(case):
    """Computes natural frequencies by bisection: K - shift M has as many negative pivots as eigenvalues below the shift."""
    frame = Frame(case, cut=True)
    K, M, free = frame.matrices()
    counts = {0.0: 0}
    below = lambda shift: counts.setdefault(
        shift, sum(d < 0 for d in pivots(K, free, M, shift)[1]))
    count, top = case.options["count"], 1.0
    while below(top) < count:
        top *= 4
        if top > 1e30:
            raise Cannot("the model has fewer than %d modes" % count)
    found = []
    for mode in range(count):
        low = max(s for s, n in counts.items() if n <= mode)
        high = min(s for s, n in counts.items() if n > mode)
        while high - low > 1e-9 * high and high > 1e-6:
            middle = math.sqrt(low * high) if low > 0.01 * high else (low + high) / 2
            if below(middle) > mode:
                high = middle
            else:
                low = middle
        found.append(math.sqrt(high) / (1 if FAULT == "angular-frequency" else 2 * math.pi))
    return {"frequency_Hz": found}


def solve(case):
    case.require(("statics", "modes"), ("materials", "sections", "nodes", "members", "supports",
                                        "loads", "springs", "point_masses"),
                 ("count", "eigensolver"))
    found = statics(case) if case.kind == "statics" else modes(case)
    return {name: (unit, found[name]) for name, unit in case.asked.items() if name in found}


main(solve, name="wrong solver" + (", " + FAULT if FAULT else ""), version="1")
