"""Modes of the 3-RRR manipulator of Table 1 in space, by CalculiX: links and platform are solids (C3D20R).

modes(reading) writes a deck, runs ccx and returns natural frequencies [Hz] and a mark for modes in the plane. A reading is a dict of data
that the paper leaves open. DEFAULT contains Table 1, with all joints bonded. A joint is a rigid body of the end faces of the links and of
a square patch in a corner of the plate. A hinge consists of two such bodies that rotate relative to each other about z.
"""
import json
import math
import pathlib
import subprocess
import sys
import tempfile

DEFAULT = {
    "pose": (0.25, 0.5 / math.sqrt(12), 0.0),  # x, y of P [m], orientation [rad]
    "joints": "bbb bbb bbb",  # active, elbow and platform joint of each limb; b: bonded, h: hinge about z, t: free to tilt about x and y
    "thickness": 0.0015, "width": 0.03, "length": 0.2, "on_edge": True,  # links [m]; on edge: the width is along z
    "side": 0.2, "plate_thickness": 0.0015, "plate_level": 0.0,  # [m]; level: height of the mid-plane above that of the links
    "patch": 0.003,  # side of the square patch of the plate that is bonded to a joint [m]
    "E": 69e9, "rho": 2700.0, "nu": 0.33,
    "link_mass": None, "plate_mass": None,  # [kg]; None: from density
    "joint_masses": (0.0, 0.0),  # mass of each elbow, mass of each platform joint [kg]
}
MESH = {"along": 12, "across": 2, "plate": 6}  # elements along a link, over its width, and along half a side of the plate


def elbow(a, c, length):
    """Returns the elbow B of a limb on the clockwise side of A C (the working mode of the paper)."""
    dx, dy = c[0] - a[0], c[1] - a[1]
    angle = math.atan2(dy, dx) - math.acos(math.hypot(dx, dy) / (2 * length))
    return a[0] + length * math.cos(angle), a[1] + length * math.sin(angle)


def geometry(r):
    base = [(0.0, 0.0), (0.5, 0.0), (0.25, 0.5 * math.sqrt(0.75))]
    x, y, phi = r["pose"]
    radius = r["side"] / math.sqrt(3)
    corners = [(x + radius * math.cos(phi + math.radians(d)), y + radius * math.sin(phi + math.radians(d))) for d in (210, 330, 90)]
    return base, [elbow(a, c, r["length"]) for a, c in zip(base, corners)], corners


class Deck:
    def __init__(self):
        self.nodes, self.parts, self.elements, self.rest, self.sets = [], {}, [], [], 0

    def node(self, place, part=None):
        """Returns a new node, or the existing node of this part at this position."""
        key = (part, *(round(v, 9) for v in place))
        if part is not None and key in self.parts:
            return self.parts[key]
        self.nodes.append(place)
        if part is not None:
            self.parts[key] = len(self.nodes)
        return len(self.nodes)

    def block(self, name, part, counts, place):
        """Adds C3D20R elements on a grid with node positions place(i, j, k) at half steps. Returns a function from (i, j, k) to the node."""
        at = lambda i, j, k: self.node(place(i, j, k), part)
        bottom = [(0, 0), (2, 0), (2, 2), (0, 2)]
        middle = [(1, 0), (2, 1), (1, 2), (0, 1)]
        for i in range(0, 2 * counts[0], 2):
            for j in range(0, 2 * counts[1], 2):
                for k in range(0, 2 * counts[2], 2):
                    order = [(*p, 0) for p in bottom] + [(*p, 2) for p in bottom] + [(*p, 0) for p in middle] \
                        + [(*p, 2) for p in middle] + [(*p, 1) for p in bottom]
                    self.elements.append((name, [at(i + a, j + b, k + c) for a, b, c in order]))
        return at

    def rigid(self, nodes, place):
        """Adds a rigid body of these nodes. Returns the nodes of its displacement and of its rotation."""
        self.sets += 1
        reference, turn = self.node(place), self.node(place)
        self.rest += [f"*NSET,NSET=R{self.sets}", *(f"{n}," for n in sorted(set(nodes))),
                      f"*RIGID BODY,NSET=R{self.sets},REF NODE={reference},ROT NODE={turn}"]
        return reference, turn

    def same(self, a, b, dofs):
        for dof in dofs:
            self.rest += ["*EQUATION", "2", f"{a},{dof},1.,{b},{dof},-1."]

    def lines(self, count):
        lines = ["*NODE"] + [f"{i + 1},{x:.12g},{y:.12g},{z:.12g}" for i, (x, y, z) in enumerate(self.nodes)]
        for name in dict.fromkeys(name for name, _ in self.elements):
            lines.append(f"*ELEMENT,TYPE={'MASS' if name[0] == 'M' else 'C3D20R'},ELSET={name}")
            for number, (own, nodes) in enumerate(self.elements, 1):
                if own == name:
                    row = [str(v) for v in [number, *nodes]]
                    lines += [",".join(row[:16]) + ("," if len(row) > 16 else "")] + ([",".join(row[16:])] if len(row) > 16 else [])
        return lines + self.rest + ["*STEP", "*FREQUENCY", str(count), "*END STEP"]


def link(deck, name, r, mesh, p, q):
    """Adds a straight solid from p to q. Returns the nodes of its two end faces."""
    length = math.hypot(q[0] - p[0], q[1] - p[1])
    c, s = (q[0] - p[0]) / length, (q[1] - p[1]) / length
    depth, height = (r["thickness"], r["width"]) if r["on_edge"] else (r["width"], r["thickness"])
    across = (1, mesh["across"]) if r["on_edge"] else (mesh["across"], 1)

    def place(i, j, k):
        x, y, z = length * i / (2 * mesh["along"]), depth * (j / (2 * across[0]) - 0.5), height * (k / (2 * across[1]) - 0.5)
        return p[0] + c * x - s * y, p[1] + s * x + c * y, z
    first = len(deck.nodes)
    deck.block("LINK", name, (mesh["along"], *across), place)
    def face(end):
        return [n + 1 for n in range(first, len(deck.nodes))
                if abs((deck.nodes[n][0] - end[0]) * c + (deck.nodes[n][1] - end[1]) * s) < 1e-9]
    return face(p), face(q)


def plate(deck, r, mesh, corners):
    """Adds the plate as three quadrilaterals, each between P, two mid-sides and a corner. The cell in a corner has the size of the patch.
    The other cells shrink toward the corner, to about twice this size."""
    center, n, t = r["pose"][:2], mesh["plate"], r["plate_thickness"]
    share = r["patch"] / (r["side"] / 2)
    shrink = min(1.0, (2 * share)**(1 / n))  # ratio of sizes of successive cells
    ends = [sum(shrink**i for i in range(cells)) for cells in range(n + 1)]
    grid = [(1 - share) * (ends[i // 2] + ends[(i + 1) // 2]) / 2 / ends[n] for i in range(2 * n + 1)] + [1 - share / 2, 1.0]
    patches = []
    for i, corner in enumerate(corners):
        before, after = ([(corner[k] + corners[(i + step) % 3][k]) / 2 for k in (0, 1)] for step in (-1, 1))

        def place(a, b, k, before=before, after=after, corner=corner):
            s, u = grid[a], grid[b]
            x, y = ((1 - s) * (1 - u) * center[m] + s * (1 - u) * before[m] + s * u * corner[m] + (1 - s) * u * after[m] for m in (0, 1))
            return x, y, r["plate_level"] + t * (k / 2 - 0.5)
        at = deck.block("PLATE", "plate", (n + 1, n + 1, 1), place)
        cell = [(2 * n + a, 2 * n + b) for a in range(3) for b in range(3) if (a, b) != (1, 1)]
        patches.append([at(a, b, k) for a, b in cell for k in (0, 1, 2) if k != 1 or (a % 2 == 0 and b % 2 == 0)])
    return patches


def build(r, mesh):
    base, elbows, corners = geometry(r)
    deck = Deck()
    patches = plate(deck, r, mesh, corners)
    volume = r["length"] * r["thickness"] * r["width"]
    for i, kinds in enumerate(r["joints"].split()):
        start, low = link(deck, f"p{i}", r, mesh, base[i], elbows[i])
        high, top = link(deck, f"d{i}", r, mesh, elbows[i], corners[i])
        places = [(*p, 0.0) for p in (base[i], elbows[i], corners[i])]
        foot, turn = deck.rigid(start, places[0])
        held = {"b": "1,3", "h": "1,2", "t": "3,3"}[kinds[0]]
        deck.rest += ["*BOUNDARY", f"{foot},1,3", f"{turn},{held}"]
        for j, (one, other, kind) in enumerate([(low, high, kinds[1]), (patches[i], top, kinds[2])]):
            if kind == "b":
                a, _ = deck.rigid(one + other, places[1 + j])
            else:
                (a, b), (c, d) = deck.rigid(one, places[1 + j]), deck.rigid(other, places[1 + j])
                deck.same(c, a, (1, 2, 3))
                deck.same(d, b, {"h": (1, 2), "t": (3,)}[kind])
            if r["joint_masses"][j]:
                deck.elements.append((f"M{i}{j}", [a]))
                deck.rest += [f"*MASS,ELSET=M{i}{j}", f"{r['joint_masses'][j]!r}"]
    densities = {"LINK": r["link_mass"] / volume if r["link_mass"] else r["rho"],
                 "PLATE": r["plate_mass"] / (math.sqrt(0.1875) * r["side"]**2 * r["plate_thickness"]) if r["plate_mass"] else r["rho"]}
    for name, rho in densities.items():
        deck.rest += [f"*MATERIAL,NAME={name}", "*ELASTIC", f"{r['E']!r},{r['nu']!r}", "*DENSITY", f"{rho!r}",
                      f"*SOLID SECTION,ELSET={name},MATERIAL={name}"]
    return deck


def run(lines, totals=False):
    """Returns the rows of the .dat file that begin with an integer, and with `totals` also rows of three numbers."""
    with tempfile.TemporaryDirectory() as folder:
        pathlib.Path(folder, "deck.inp").write_text("\n".join(lines) + "\n", encoding="ascii")
        done = subprocess.run(["ccx", "deck"], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        if done.returncode or "*ERROR" in done.stdout:
            raise RuntimeError([line for line in done.stdout.splitlines() if "ERROR" in line][:1] or done.stdout[-300:])
        with open(pathlib.Path(folder, "deck.dat"), encoding="ascii") as file:
            rows = [line.split() for line in file]
    return [[float(cell) for cell in row] for row in rows
            if row and (row[0].isdigit() or totals and len(row) == 3 and row[0][-4:-2] in ("E+", "E-"))]


def store(folder, name, title, unit, values, change, notes, place="", source="calculix-2.20", **more):
    """Adds a reference to references.json in a folder, which is created if it is absent."""
    path = pathlib.Path(folder, "references.json")
    path.parent.mkdir(parents=True, exist_ok=True)
    family = json.loads(path.read_text()) if path.exists() else {}
    program = "/".join(["references/programs", *pathlib.Path(sys.argv[0]).resolve().parts[-2:]])
    family[name] = {"title": title, "kind": "code", "unit": unit, "values": values, "uncertainty": {"relative": change},
                    "source": source, "place": program + place, "notes": notes, **more}
    path.write_text(json.dumps(family, indent=2) + "\n")


def modes(reading, mesh=None, count=8):
    """Returns the natural frequency of each mode [Hz], and True for modes in the plane, as their effective masses show."""
    number = run(build({**DEFAULT, **reading}, {**MESH, **(mesh or {})}).lines(count))
    frequencies = [row[3] for row in number if len(row) == 5][:count]
    masses = [row[1:] for row in number if len(row) == 7][count:2 * count]  # the first block holds participation factors
    total = [max(sum(m[k] for m in masses), 1e-30) for k in range(6)]
    share = lambda m, motions: sum(m[k] / total[k] for k in motions)
    return [(f, share(m, (0, 1, 5)) > share(m, (2, 3, 4))) for f, m in zip(frequencies, masses)]
