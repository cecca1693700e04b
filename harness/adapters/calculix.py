#!/usr/bin/env python3
"""Adapter for CalculiX (ccx 2.20). It writes a case as a deck, runs ccx in the working folder and reads the .dat file.

In statics, an Euler-Bernoulli member without springs becomes one user element U1, which is exact at its nodes. U1 is
unsuitable for other members and analyses:
- ccx supports U1 in statics only.
- U1 with shear strain deflects less than U1 without shear strain, which is wrong.
- Springs on rotations of U1 have the wrong stiffness.

Other members become a strip of eight-node plane-stress elements. These are CPS8R, except in buckling, where CPS8R results in
twice the buckling load and CPS8 is used. The strip is orthotropic. It has E along the member, Poisson's ratio 0, and the shear
modulus of the case's beam theory. If the theory has no rotary inertia, the mass is in a thin core of the strip.

Plates become CPS3 and CPS6 elements whose material contracts only in the plane. Their mass matrix is consistent.
Joints and rigid bodies become linear constraint equations. Motion in time is a superposition of modes.

Section forces and reactions follow from displacements by the slope-deflection equations. In statics, displacements have all
digits, from the restart file. Otherwise they have the seven digits that ccx prints.

Two differences from beam theory remain. At an axial load N, the critical load is too low by the fraction (N / EA) (1 + E / G).
A strip that is rigid in shear has round-off errors that grow with slenderness (1e-5 at a length of 130 times the depth).
"""
import math
import os
import struct
import subprocess

from trammel_adapter import Cannot, main


SHEAR_RIGID = (8, 300, 1e5)  # G / E for beams without shear strain: minimum, maximum under axial loads, maximum otherwise
THIN, SLENDER = 3, 0.009  # thinning factor of inextensible strips, and largest depth / length without thinning
CORE, NO_ROTARY = 0.02, ("euler-bernoulli", "shear")  # core that carries the mass in modes: fraction of the depth, beam theories with a core
CORE_STIFFNESS = 1e-6  # stiffness of the core relative to the strip
STIFF = 1e5  # factor of the axial stiffness of an inextensible beam element U1
ALONG = {"CPS8R": 2, "CPS8": 4}  # number of elements of a strip for each element of the case, by element type
DIGITS = 7  # significant digits that ccx prints
MODES = 20  # number of modes for motion in time
MOTION = {"displacements": ("displacement_x_m", "displacement_y_m", "rotation_rad"),
          "velocities": ("velocity_x_m_per_s", "velocity_y_m_per_s", "angular_velocity_rad_per_s")}
JOINTS = ("welded", "hinged")
DOF = {"x": 0, "y": 1, "rotation": 2}


def card(*cells):
    """Returns a data line of the deck. ccx reads at most twenty characters of a number."""
    return ",".join(f"{cell:.12e}" if isinstance(cell, float) else str(cell) for cell in cells)


class Singular(Exception):
    """Raised if ccx reports a singular matrix, as for a mechanism."""


class Deck:
    """Lines of a ccx deck, with numbers for nodes, elements and sets."""

    def __init__(self):
        self.nodes, self.lines, self.end, self.elements, self.equations, self.supported = [], [], [], 0, {}, set()

    def node(self, x, y):
        self.nodes.append((x, y))
        return len(self.nodes)

    def element(self, kind, nodes, name):
        self.elements += 1
        self.lines += [f"*ELEMENT,TYPE={kind},ELSET={name}", card(self.elements, *nodes)]

    def follower(self, motions):
        """Returns a node whose first degrees of freedom equal the motions (node, dof). ccx 2.20 fails for masses and springs on nodes
        that other nodes depend on."""
        node = self.node(*self.nodes[motions[0][0] - 1])
        for dof, motion in enumerate(motions, 1):
            self.equation([(node, dof, 1.0), (*motion, -1.0)])
        self.fix(node, len(motions) + 1, 3)
        return node

    def mass(self, motions, value):
        if value:
            name = f"M{self.elements}"
            self.element("MASS", [self.follower(motions)], name)
            self.lines += [f"*MASS,ELSET={name}", card(float(value))]

    def spring(self, ends, value):
        """Adds a spring between two motions (node, dof), or between one motion and the ground."""
        if value:
            name = f"S{self.elements}"
            self.element(f"SPRING{len(ends)}", [self.follower([end]) for end in ends], name)
            self.lines += [f"*SPRING,ELSET={name}", card(*[1] * len(ends)), card(float(value))]

    def equation(self, terms):
        """Adds the equation: sum of factor * motion = 0. Dependent motions are replaced first. The equation is then solved for
        one of the remaining free motions. It is redundant if no free motion remains."""
        left = {}
        for node, dof, factor in terms:
            for motion, f in self.independent((node, dof)).items():
                left[motion] = left.get(motion, 0.0) + factor * f
        free = [m for m, f in left.items() if m not in self.supported and abs(f) > 1e-9]
        if free:
            first = free[0] if (free[0] == tuple(terms[0][:2])) else max(free, key=lambda m: abs(left[m]))
            self.equations[first] = [(m, -f / left[first]) for m, f in left.items() if m != first and f]

    def independent(self, motion):
        """Returns a motion as a combination of independent motions, because ccx does not resolve long chains of equations."""
        if motion not in self.equations:
            return {motion: 1.0}
        result = {}
        for other, factor in self.equations[motion]:
            for last, f in self.independent(other).items():
                result[last] = result.get(last, 0.0) + factor * f
        return result

    def same(self, ends):
        self.equation([(*ends[0], 1.0), (*ends[1], -1.0)])

    def fix(self, node, dof, last=None):
        self.lines += ["*BOUNDARY", f"{node},{dof},{last or dof}"]

    def run(self, step, name="deck"):
        ties = []
        for node, dof in self.equations:
            terms = [((node, dof), 1.0)] + [(m, -f) for m, f in self.independent((node, dof)).items() if f]
            ties += ["*EQUATION", str(len(terms)), *(card(*m, f) for m, f in terms)]
        head = ["*NODE,NSET=ALL"] + [card(i + 1, float(x), float(y), 0) for i, (x, y) in enumerate(self.nodes)]
        with open(name + ".inp", "w", encoding="ascii") as file:
            file.write("\n".join(head + self.lines + ties + self.end + step) + "\n")
        done = subprocess.run(["ccx", name], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        if done.returncode and os.path.exists("spooles.out"):
            with open("spooles.out", encoding="ascii", errors="replace") as file:
                if "singular" in file.read():
                    raise Singular
        errors = [line.strip() for line in done.stdout.splitlines() if "*ERROR" in line]
        if done.returncode or errors:
            raise RuntimeError(errors[0] if errors else f"ccx ended with {done.returncode}")
        with open(name + ".dat", encoding="ascii") as file:
            return file.read().splitlines()


def table(lines, title):
    """Returns the blocks of rows of numbers below lines with this title, each as {first number: other numbers}."""
    blocks = []
    for i, line in enumerate(lines):
        if title in line:
            rows = {}
            for row in lines[i + 1:]:
                cells = row.split()
                try:
                    rows[int(cells[0])] = [float(c) for c in cells[1:]]
                except (ValueError, IndexError):
                    if rows:
                        break
            blocks.append(rows)
    return blocks


def unrounded(name, u, nodes):
    """Returns the displacements u with all digits if a record of the restart file agrees with u, else u."""
    with open(name, "rb") as file:
        data = file.read()
    at, found = 0, {}
    while at < len(data):
        (length,) = struct.unpack_from("<i", data, at)
        for size in (4, 7):  # numbers per node in the restart file: one more than its degrees of freedom
            if not found and length % (8 * size) == 0 and length >= 8 * size * max(nodes):
                v = {n: struct.unpack_from(f"<{size - 1}d", data, at + 12 + 8 * size * (n - 1)) for n in nodes}
                if all(abs(a - b) <= 1e-6 * abs(a) for n in nodes for a, b in zip(u[n], v[n])):
                    found = v
        at += length + 8
    return {**u, **found}


def frd_stress(name):
    """Returns node -> sxx, syy, szz, sxy, ... from the last block of stresses of a .frd file."""
    stress, inside = {}, False
    with open(name, encoding="ascii") as file:
        for line in file:
            if line.startswith(" -4"):
                inside = "STRESS" in line
            elif inside and line.startswith(" -1"):
                stress[int(line[3:13])] = [float(line[i:i + 12]) for i in range(13, 85, 12)]
    return stress


def placed(member, model):
    """Adds length L, direction (dx, dy) and load per length, including the weight, to a member."""
    (x0, y0), (x1, y1) = (model["nodes"][n] for n in member.nodes)
    member.L = math.hypot(x1 - x0, y1 - y0)
    member.dx, member.dy = (x1 - x0) / member.L, (y1 - y0) / member.L
    member.sheared = member.beam in ("shear", "timoshenko")
    weight = [member.rho * member.A * g for g in model.get("gravity_m_s2", [0, 0])]
    member.load = [a + b for a, b in zip(member.load, weight)]
    return member


def nodal_loads(model):
    """Returns node -> [Fx, Fy, M] of forces, moments and the weight of point masses."""
    loads = {}
    for load in model.get("loads", {}).values():
        if "node" not in load:
            raise Cannot("tractions on edges are not supported")
        f = loads.setdefault(load["node"], [0.0, 0.0, 0.0])
        for i, value in enumerate([*load.get("force_N", [0, 0]), load.get("moment_N_m", 0)]):
            f[i] += value
    g = model.get("gravity_m_s2", [0, 0])
    for mass in model.get("point_masses", {}).values():
        x, y = mass.get("offset_m", [0, 0])
        f = loads.setdefault(mass["node"], [0.0, 0.0, 0.0])
        for i, value in enumerate([g[0], g[1], x * g[1] - y * g[0]]):
            f[i] += mass["mass_kg"] * value
    return loads


def material(name, E, G, rho, nu=0.0, share=1.0, across=1.0):
    """Returns a material that contracts only in its plane.

    Out of the plane, ccx enforces equal contraction of adjacent elements, which stiffens them.
    share: factor of the stiffness in the plane.
    across: additional stiffness factor through the depth, for a core that would otherwise press on the strip's middle.
    """
    return [f"*MATERIAL,NAME={name}", "*ELASTIC,TYPE=ENGINEERING CONSTANTS", card(E * share, E * share * across, E, nu, 0, 0, G * share, G), card(G),
            "*DENSITY", card(max(float(rho), 1e-9))]


def middle(row):
    return row[len(row) // 2]


def refuse(model, keys):
    for key in keys:
        if model.get(key):
            raise Cannot(f"{key} is not supported")


class Frame:
    """Nodes, joints, masses, supports and loads of a model. motions[name] holds the degrees of freedom (node, dof) for x, y and rotation.

    strips: element type of the members, or None for U1.
    loaded: true if axial forces change the stiffness. Inextensible members then stretch: a constraint would carry force without stress.
    """

    def __init__(self, case, strips, loaded=False, large=False, core=False):
        model = case.model
        self.model, self.deck, self.strips, self.loaded, self.large, self.core = model, Deck(), strips, loaded or large, large, core
        if large:
            refuse(model, ["rigid_bodies", "pins", "plates", "springs", "point_masses"])
        self.members = [placed(m, model) for m in case.members()]
        welded = {n for m in self.members for n, end in zip(m.nodes, m.ends) if end == "welded"}
        self.motions = {name: self.point(*p, name in welded) for name, p in model["nodes"].items()}
        for node, taken in model.get("supports", {}).items():
            if node not in self.motions:
                raise Cannot("supports of edges are not supported")
            self.deck.supported |= {self.motions[node][DOF[t]] for t in taken}
        for body in model.get("rigid_bodies", {}).values():
            place = model["nodes"][body["reference"]]
            for node in body["nodes"]:
                if node != body["reference"]:
                    arm = [a - b for a, b in zip(model["nodes"][node], place)]
                    self.tie(self.motions[node], self.motions[body["reference"]], arm)
        for pin in model.get("pins", {}).values():
            for first, second in list(zip(*(self.motions[n] for n in pin["nodes"])))[:2]:
                self.deck.same([first, second])
        for spring in model.get("springs", {}).values():
            ends = [self.motions[n] for n in spring["nodes"]]
            values = [*spring.get("stiffness_N_per_m", [0, 0]), spring.get("rotational_stiffness_N_m_per_rad", 0)]
            for i, value in enumerate(values):
                self.deck.spring([end[i] for end in ends], value)
        self.ends = {m.name: [self.end(m, i) for i in (0, 1)] for m in self.members}
        for m in self.members:
            (self.strip if strips else self.u1)(m)
        self.corners = {}
        for name, plate in model.get("plates", {}).items():
            self.plate(name, plate)
        for node, value in self.corners.items():
            self.deck.mass(self.motions[node][:2], value)
        for mass in model.get("point_masses", {}).values():
            motion = self.motions[mass["node"]]
            if any(mass.get("offset_m", [])):
                motion = self.point(*model["nodes"][mass["node"]])
                self.tie(motion, self.motions[mass["node"]], mass["offset_m"])
            self.deck.mass(motion[:2], mass["mass_kg"])
            self.deck.mass(motion[2:], mass.get("inertia_kg_m2", 0))
        for node, dof in sorted(self.deck.supported):
            self.deck.fix(node, dof)

    def plate(self, name, plate):
        """Adds the triangles of a plate. ccx integrates the mass of three-node triangles at their centroid, so that they have no
        inertia about it. Three quarters of this mass plus a twelfth of it in each corner equal the consistent mass."""
        if "triangles" not in plate:
            raise Cannot("plates without triangles are not supported")
        m, set_name = self.model["materials"][plate["material"]], f"P{self.deck.elements}"
        E, nu, rho = float(m["E_Pa"]), float(m["nu"]), float(m["rho_kg_m3"])
        share = 1.0
        for triangle in plate["triangles"]:
            self.deck.element(f"CPS{len(triangle)}", [self.motions[n][0][0] for n in triangle], set_name)
            if len(triangle) == 3 and self.core:
                (ax, ay), (bx, by), (cx, cy) = (self.model["nodes"][n] for n in triangle)
                twelfth, share = rho * plate["thickness_m"] * abs((bx - ax) * (cy - ay) - (cx - ax) * (by - ay)) / 24, 0.75
                for n in triangle:
                    self.corners[n] = self.corners.get(n, 0.0) + twelfth
        self.deck.end += material(set_name, E, E / (2 * (1 + nu)), rho * share, nu)
        self.deck.end += [f"*SOLID SECTION,ELSET={set_name},MATERIAL={set_name}", card(float(plate["thickness_m"]))]

    def point(self, x, y, welded=True):
        """Returns the motions of a point. If no U1 is welded to the point, a second node represents its rotation."""
        node = self.deck.node(x, y)
        if not self.strips:
            self.deck.fix(node, 3, 5 if welded else 3)
        if not self.strips and welded:
            return [(node, 1), (node, 2), (node, 6)]
        turn = self.deck.node(x, y)
        self.deck.fix(turn, 2, 3)
        return [(node, 1), (node, 2), (turn, 1)]

    def tie(self, slave, master, arm):
        """Ties the slave's motions to a rigid body that moves with the master. The arm (x, y) points from master to slave."""
        for motion, own, lever in zip(slave, master, (-arm[1], arm[0], 0.0)):
            self.deck.equation([(*motion, 1.0), (*own, -1.0), (*master[2], -lever)])

    def end(self, m, i):
        """Returns the motions of a member's end: the motions of its node, or separate motions at a hinge or spring."""
        motion = self.motions[m.nodes[i]]
        if m.ends[i] == "welded":
            return motion
        own = self.point(*self.model["nodes"][m.nodes[i]])
        for k in (0, 1):
            self.deck.same([own[k], motion[k]])
        if m.ends[i] != "hinged":
            self.deck.spring([own[2], motion[2]], m.ends[i])
        return own

    def u1(self, m):
        name = f"U{len(self.deck.lines)}"
        a, b = self.ends[m.name]
        self.deck.element("U1", [a[0][0], b[0][0]], name)
        area = m.A * (STIFF if m.inextensible else 1)
        self.deck.end += [f"*MATERIAL,NAME={name}", "*ELASTIC", card(m.E, m.E / (2 * m.G) - 1),
                          f"*BEAM SECTION,ELSET={name},MATERIAL={name},SECTION=GENERAL",
                          card(float(area), float(m.I), 0, float(m.I), 1e6), card(-m.dy, m.dx, 0)]

    def strip(self, m):
        deck, name = self.deck, f"E{len(self.deck.lines)}"
        if not m.I:
            raise Cannot("modes and buckling of members without bending stiffness are not supported")
        h = math.sqrt(12 * m.I / m.A)
        thinner = 1.0  # thinning keeps E I and mass, reduces rotary inertia; E A is irrelevant at constant length
        if m.inextensible and self.large:
            thinner = max(1.0, 300 * h / m.L)
        elif m.inextensible and m.beam in NO_ROTARY and self.strips == "CPS8R" and h > SLENDER * m.L:
            thinner = THIN
        h, E = h / thinner, m.E * thinner**2
        pieces = [o for o in self.members if o.name.split(".")[0] == m.name.split(".")[0]]  # pieces of a tapered member
        slender = h / sum(piece.L for piece in pieces)
        wanted = max(4 if len(pieces) < 8 else 1, m.elements * (1 if self.large else ALONG[self.strips]))
        n = 2 * max(1, min(wanted, round(4 * m.L / h)))  # shorter elements have larger round-off errors
        rigidity = min(max(SHEAR_RIGID[0], 2.6e8 * slender**4 if self.loaded else 1.9e7 * slender**3), SHEAR_RIGID[1 + (not self.loaded)])
        if m.inextensible and thinner == 1 and not self.loaded:
            rigidity = 1  # with large G, the constraints of constant length cause round-off errors
        x0, y0 = self.model["nodes"][m.nodes[0]]
        rows = []
        for i in range(n + 1):
            x, y = x0 + m.dx * m.L * i / n, y0 + m.dy * m.L * i / n
            rows.append([deck.node(x - m.dy * z, y + m.dx * z) for z in ([-h / 2, 0, h / 2] if i % 2 == 0 else [-h / 2, h / 2])])
        self.quads(rows, name)
        cored = self.core and m.beam in NO_ROTARY
        if cored:
            self.quads([self.core_row(row) for row in rows], name + "C")
        m.rows = rows
        for i, row in ((0, rows[0]), (1, rows[-1])):
            if self.large and self.ends[m.name][i][2] not in deck.supported:
                self.turning_end(m, i)
                row = [middle(row)]
            for node in row:
                arm = [a - b for a, b in zip(deck.nodes[node - 1], self.model["nodes"][m.nodes[i]])]
                self.tie([(node, 1), (node, 2)], self.ends[m.name][i], arm)
        if m.inextensible and not self.loaded:
            self.keep_length(m, [middle(row) for row in rows[2:-2:2]])
        G = m.G * m.kappa if m.sheared else E * rigidity
        heaviest = max((p["mass_kg"] for p in self.model.get("point_masses", {}).values()), default=0)
        mass = max(m.rho, 1e-6 * heaviest / (m.A * m.L) if self.core else 0)  # a massless member has modes that are too fast for ccx
        deck.end += [f"*ORIENTATION,NAME={name}", card(m.dx, m.dy, 0, -m.dy, m.dx, 0)]
        for part, share, rho in ((name, 1, 0 if cored else mass), (name + "C", CORE_STIFFNESS, mass / CORE))[:1 + cored]:
            deck.end += material(part, E, G, rho, share=share, across=100 if cored and slender > 0.05 else 1)
            deck.end += [f"*SOLID SECTION,ELSET={part},MATERIAL={part},ORIENTATION={name}", card(m.A / h)]

    def quads(self, rows, name):
        for a, b, c in zip(rows[::2], rows[1::2], rows[2::2]):
            self.deck.element(self.strips, [a[0], c[0], c[2], a[2], b[0], c[1], b[1], a[1]], name)

    def core_row(self, row):
        """Returns nodes of the core, which depend on those of the strip. Independent layers could warp and would shear more."""
        ends, nodes = [self.deck.nodes[n - 1] for n in (row[0], row[-1])], []
        for t in (-CORE, CORE):
            shares = [t * (t - 1) / 2, 1 - t * t, t * (t + 1) / 2] if len(row) == 3 else [(1 - t) / 2, (1 + t) / 2]
            nodes.append(self.deck.node(*((a * (1 - t) + b * (1 + t)) / 2 for a, b in zip(*ends))))
            for dof in (1, 2):
                self.deck.equation([(nodes[-1], dof, 1.0), *((n, dof, -share) for n, share in zip(row, shares))])
        return [nodes[0], *row[1:-1], nodes[1]]

    def turning_end(self, m, i):
        """Rejects moments at a rotating end. In large displacement, only the middle of the end is tied, as ccx constraints are linear."""
        node = m.nodes[i]
        others = [o for o in self.members if o is not m and node in o.nodes]
        if m.ends[i] != "hinged" and (others or nodal_loads(self.model).get(node, [0, 0, 0])[2]):
            raise Cannot("rotating welded joints, and moments on rotating ends, are not supported in large displacement")

    def keep_length(self, m, middle):
        """Constrains all points of a member to equal axial displacement."""
        start, end = self.ends[m.name]
        for motion in [[(node, 1), (node, 2)] for node in middle] + [end]:
            order = sorted([(0, m.dx), (1, m.dy)], key=lambda a: -abs(a[1]))
            self.deck.equation([(*motion[i], f) for i, f in order] + [(*start[i], -f) for i, f in order])

    def loads(self):
        """Returns *CLOAD lines: forces, weights, and nodal forces of distributed loads."""
        forces = [(self.motions[n][i], v) for n, f in nodal_loads(self.model).items() for i, v in enumerate(f)]
        for m in self.members:
            for i in (0, 1):
                if not self.strips:
                    turn = (-m.dy, m.dx)[i] * m.load[i] * m.L**2 / 12
                    for end, sign in zip(self.ends[m.name], (1, -1)):
                        forces += [(end[i], m.load[i] * m.L / 2), (end[2], sign * turn)]
                    continue
                for k, row in enumerate(m.rows):  # weights of Simpson's rule, for the middle node or the two nodes next to it
                    share = (1 if k in (0, len(m.rows) - 1) else 4 if k % 2 else 2) / (3 * (len(m.rows) - 1))
                    nodes = row[len(row) // 2 - 1:len(row) // 2 + 1] if len(row) % 2 == 0 else [middle(row)]
                    forces += [((node, i + 1), m.load[i] * m.L * share / len(nodes)) for node in nodes]
        return [card(node, dof, float(value)) for (node, dof), value in forces if value]


def statics(case, options):
    second = options.get("second_order", False)
    plain = all(m.beam not in ("shear", "timoshenko") and m.ends[0] in JOINTS and m.ends[1] in JOINTS for m in case.members())
    euler = "members" in case.model and plain and not second and not {"plates", "springs"} & case.model.keys()
    frame = Frame(case, None if euler else "CPS8R", loaded=second)
    if euler:
        frame.deck.lines.insert(0, "*USER ELEMENT,TYPE=U1,NODES=2,INTEGRATION POINTS=2,MAXDOF=6")
    out = frame.deck.run(["*STEP,NLGEOM" if second else "*STEP", "*STATIC", "*RESTART,WRITE,FREQUENCY=1",
                          "*CLOAD", *frame.loads(), "*NODE PRINT,NSET=ALL", "U",
                          *(["*EL FILE,OUTPUT=2D", "S"] if case.model.get("plates") else []), "*END STEP"])
    ends = [motions for pair in frame.ends.values() for motions in pair]
    u = unrounded("deck.rout", table(out, "displacements")[-1], {n for m in [*frame.motions.values(), *ends] for n, _ in m})
    value = lambda motion: u[motion[0]][motion[1] - 1]
    q = {f"{key}:{name}": ("rad" if k == 2 else "m", value(motion[k])) for name, motion in frame.motions.items()
         for k, key in enumerate(MOTION["displacements"])}
    if case.model.get("plates"):
        q["compliance_J"] = ("J", sum(f * value(frame.motions[n][k]) for n, forces in nodal_loads(case.model).items()
                                      for k, f in enumerate(forces) if f))
        stress = frd_stress("deck.frd")
        for name, motion in frame.motions.items():
            for k, axes in enumerate(("xx", "yy", None, "xy")):
                if axes and motion[0][0] in stress:
                    q[f"stress_{axes}_Pa:{name}"] = ("Pa", stress[motion[0][0]][k])
    if euler or not second and not any(m.inextensible for m in frame.members):
        q.update(section_forces(frame, value))
    return q


def section_forces(frame, value):
    """Returns forces, moments and stresses at members' ends, and reactions. value(motion) is the displacement computed by ccx."""
    model, q = frame.model, {}
    supports = model.get("supports", {})
    reaction = {n: [-f for f in nodal_loads(model).get(n, [0, 0, 0])] for n in supports}
    for m in frame.members:
        ends = [[value(motion) for motion in end] for end in frame.ends[m.name]]
        forces = end_forces(m, ends)
        for i, end in enumerate(("start", "end")):
            signed = [f if i else -f for f in forces[i]]
            for name, f in zip(("axial_force_N", "shear_force_N", "bending_moment_N_m"), signed):
                q[f"{name}:{m.name}.{end}"] = ("N m" if "moment" in name else "N", f)
            q[f"end_rotation_rad:{m.name}.{end}"] = ("rad", ends[i][2])
            if m.half_depth and m.I:
                q[f"bending_stress_Pa:{m.name}.{end}"] = ("Pa", signed[2] * m.half_depth / m.I)
            if m.nodes[i] in reaction:
                x, y, moment = forces[i]
                for k, f in enumerate((m.dx * x - m.dy * y, m.dy * x + m.dx * y, moment)):
                    reaction[m.nodes[i]][k] += f
        if m.half_depth and m.I and not any(m.load):
            q[f"stress_Pa:{m.name}"] = ("Pa", max(abs(f[0]) / m.A + abs(f[2]) * m.half_depth / m.I for f in forces))
    tied = {n for kind in ("rigid_bodies", "pins", "springs") for part in model.get(kind, {}).values() for n in part["nodes"]}
    for node in supports.keys() - tied:
        for t in supports[node]:
            name = {"x": "reaction_x_N", "y": "reaction_y_N", "rotation": "reaction_moment_N_m"}[t]
            q[f"{name}:{node}"] = ("N m" if t == "rotation" else "N", reaction[node][DOF[t]])
    return q


def large_statics(case, options):
    refuse(options, ["switch_branch", "whole_path", "drives"])
    frame = Frame(case, "CPS8R", large=True)
    steps = []
    for factor in options.get("load_factors", [1]):
        scaled = [line.rsplit(",", 1) for line in frame.loads()]
        steps += ["*STEP,NLGEOM,INC=1000", "*STATIC", "0.05,1.,1e-6,0.2", "*CLOAD",
                  *(f"{head},{float(value) * factor:.12e}" for head, value in scaled),
                  "*NODE PRINT,NSET=ALL,FREQUENCY=1000", "U", "*END STEP"]
    blocks = table(frame.deck.run(steps), "displacements")
    q = {}
    for name, motion in frame.motions.items():
        for key, k in (("displacement_x_m", 0), ("displacement_y_m", 1)):
            q[f"{key}:{name}"] = ("m", [u[motion[k][0]][motion[k][1] - 1] for u in blocks])
    for m in frame.members:
        for node, face in zip(m.nodes, (m.rows[0], m.rows[-1])):
            q[f"rotation_rad:{node}"] = ("rad", [turn_of(frame.deck.nodes, u, face[0], face[2]) for u in blocks])
    return q


def turn_of(nodes, u, a, b):
    """Returns the rotation of the line from node a to node b, within half a revolution."""
    x, y = nodes[b - 1][0] - nodes[a - 1][0], nodes[b - 1][1] - nodes[a - 1][1]
    dx, dy = x + u[b][0] - u[a][0], y + u[b][1] - u[a][1]
    return math.atan2(x * dy - y * dx, x * dx + y * dy)


def end_forces(m, ends):
    """Returns the forces on a member's two ends in its axes, by the slope-deflection equations from displacements of ccx."""
    L = m.L
    (u1, v1, t1), (u2, v2, t2) = [(m.dx * u + m.dy * v, m.dx * v - m.dy * u, t) for u, v, t in ends]
    phi = 12 * m.E * m.I / (m.kappa * m.G * m.A * L**2) if m.sheared else 0.0
    k = m.E * m.I / L**3 / (1 + phi)
    n = m.E * m.A / L * (STIFF if m.inextensible else 1) * (u2 - u1)
    shear = k * (12 * (v1 - v2) + 6 * L * (t1 + t2))
    moments = [k * (6 * L * (v1 - v2) + L**2 * ((4 + phi) * a + (2 - phi) * b)) for a, b in ((t1, t2), (t2, t1))]
    wx, wy = m.dx * m.load[0] + m.dy * m.load[1], m.dx * m.load[1] - m.dy * m.load[0]
    return [(-n - wx * L / 2, shear - wy * L / 2, moments[0] - wy * L**2 / 12),
            (n - wx * L / 2, -shear - wy * L / 2, moments[1] + wy * L**2 / 12)]


def modes(case, options):
    refuse(options, ["reduction", "rotating"])
    before = []
    loaded = options.get("prestressed", False)
    frame = Frame(case, "CPS8R", loaded, core=True)
    if loaded:
        before = ["*STEP,NLGEOM", "*STATIC", "*CLOAD", *frame.loads(), "*END STEP"]
    out = frame.deck.run([*before, "*STEP,PERTURBATION" if before else "*STEP", "*FREQUENCY", str(options["count"] + 3), "*END STEP"])
    squares = [row[0] for row in table(out, "E I G E N V A L U E   O U T P U T")[0].values()]
    f = [math.sqrt(max(s, 0)) / (2 * math.pi) for s in squares]
    if "members" not in case.model and frame.corners:
        case.element_order = 2  # six-node triangles have order 4, unless corners reduce it
    rigid = sum(value < 3e-3 * max(f[:options["count"]]) for value in f)
    return {"frequency_Hz": ("Hz", [0.0 if i < rigid else value for i, value in enumerate(f[:options["count"]])]),
            "rigid_body_modes": ("1", rigid)}


def buckling(case, options):
    if case.model.get("plates"):
        raise Cannot("buckling of plates is not supported")
    frame = Frame(case, "CPS8", loaded=True)
    count = options.get("count", 3)
    out = frame.deck.run(["*STEP", "*BUCKLE", str(count), "*CLOAD", *frame.loads(), "*END STEP"])
    factors = [row[0] for row in table(out, "B U C K L I N G   F A C T O R   O U T P U T")[0].values()]
    q = {"load_factor": ("1", factors)}
    for name, load in case.model.get("loads", {}).items():
        if "force_N" in load:
            q[f"critical_force_N:{name}"] = ("N", [f * math.hypot(*load["force_N"]) for f in factors])
    return q


def transient(case, options):
    """Computes motion in time by modal superposition, which is exact for a piecewise linear load. A mass on a spring is
    integrated by the trapezoidal rule."""
    refuse(options, ["rotating_frame", "error_control"])
    if options.get("initial_state", "at-rest") != "at-rest" or options.get("damping", {}).keys() - {"rayleigh"}:
        raise Cannot("this initial state or damping of a motion in time is not supported")
    frame, end = Frame(case, "CPS8R", core=True), options["duration_s"]
    samples = options.get("samples") or round(end / options["step_s"])
    inner = max(1, math.ceil(end / samples / options["step_s"] - 1e-6))
    history = options.get("load_history", {"time_s": [0], "factor": [1]})
    modal = "members" in case.model
    if not modal and len(set(history["time_s"])) < len(history["time_s"]):
        raise Cannot("jumps of a load on a mass on a spring are not supported")
    corners = [(t + 1e-9 * end * (i and t == history["time_s"][i - 1]), f) for i, (t, f) in enumerate(zip(*history.values()))]
    frame.deck.lines += ["*AMPLITUDE,NAME=H", *(card(float(t), float(f)) for t, f in corners + [(2 * end, corners[-1][1])])]
    wanted = {f"{head}:{name}": (title, motion[k]) for name, motion in frame.motions.items() for title, heads in MOTION.items()
              for k, head in enumerate(heads)}
    wanted = {name: where for name, where in wanted.items() if any(name in asked for asked in case.asked)}
    nodes = sorted({str(motion[0]) for _, motion in wanted.values()})
    if not nodes:
        raise Cannot("the requested quantities of a motion in time are not supported")
    rayleigh = options.get("damping", {}).get("rayleigh", {})
    damped = ["*MODAL DAMPING,RAYLEIGH", card(1, MODES, *(float(rayleigh.get(key, 0)) for key in ("mass_per_s", "stiffness_s")))]
    if rayleigh and not modal or any(any(m.load) for m in frame.members):
        raise Cannot("damped masses on springs, and distributed loads on moving members (ccx 2.20 applies only a part), are not supported")
    step = ["*MODAL DYNAMIC"] if modal else ["*DYNAMIC,DIRECT,ALPHA=0."]
    out = frame.deck.run([
        *(["*STEP", "*FREQUENCY,STORAGE=YES", str(MODES), "*END STEP"] if modal else []), f"*STEP,INC={samples * inner + 9}", *step,
        card(end / samples / inner, float(end)), *(damped if rayleigh else []), "*CLOAD,AMPLITUDE=H", *frame.loads(),
        "*NSET,NSET=ASKED", *(f"{node}," for node in nodes), f"*NODE PRINT,NSET=ASKED,FREQUENCY={inner}", "U,V", "*END STEP"])
    q, times = {}, [end * i / samples for i in range(samples + 1)]
    for name, (title, (node, dof)) in wanted.items():
        values = [0.0] + [rows[node][dof - 1] for rows in table(out, title)]
        if len(values) != samples + 1:
            raise RuntimeError(f"{len(values)} samples of {name}")
        unit = ("rad" if "rotation" in name or "angular" in name else "m") + ("/s" if title == "velocities" else "")
        largest, when = peak(times, values)
        q.update({name: (unit, values), "peak_" + name: (unit, largest), "peak_time_s:" + name: ("s", when)})
    return q


def peak(times, values):
    """Returns the peak value with its sign, and its time, by a parabola through the largest sample and its neighbors."""
    i = max(range(len(values)), key=lambda k: abs(values[k]))
    if i in (0, len(values) - 1):
        return values[i], times[i]
    a, b, c = values[i - 1:i + 2]
    shift = 0.5 * (a - c) / (a - 2 * b + c)
    return b - 0.25 * (a - c) * shift, times[i] + shift * (times[1] - times[0])


ANALYSES = {"statics": statics, "modes": modes, "buckling": buckling, "large-statics": large_statics, "transient": transient}


def solve(case):
    if case.kind not in ANALYSES:
        raise Cannot(f"analysis {case.kind} is not supported")
    refuse(case.model, ["sliders", "axial_springs", "follower_loads"])
    if case.model.get("plates"):
        refuse(case.model, ["gravity_m_s2"])
    try:
        found = ANALYSES[case.kind](case, case.options)
    except Singular:
        return {"status": "singular", "reason": "ccx reports a singular matrix"}
    return {name: found[name] for name in case.asked if name in found}


if __name__ == "__main__":
    main(solve, name="CalculiX", version="2.20", digits=DIGITS)
