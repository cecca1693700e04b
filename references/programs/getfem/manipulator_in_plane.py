#!/usr/bin/python3
"""Modes of the planar 3-RRR manipulator of Table 1 for all variants of its joints at three poses, and statics under 10 N at P, by GetFEM.
The platform is rigid, or (locked, welded, hinged) a soft plate of three triangles, linear or quadratic.

    manipulator_in_plane.py OUT      writes getfem-JOINTS-frequencies and -displacement into OUT/references.json, pose after pose

Links are rectangles in plane stress (FEM_QK) that contract sideways by Poisson's ratio. A joint has the mean displacement and the mean
rotation of the end section (the first moment of its displacement along the link). Sections are free to warp and to contract. GetFEM
assembles stiffness, mass and the weights of end sections; scipy solves the equations. Each value comes from two meshes. The stored
uncertainty is their difference, rounded up (at least 1e-8).
"""
import math
import os
import sys

import getfem
import numpy
import scipy.linalg
import scipy.sparse as sp
import scipy.sparse.linalg

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../calculix"))
from planar_manipulator import DEFAULT, POSES, SPRING, VARIANTS, geometry, store  # noqa: E402

MESHES = ((6, 4), (8, 5))  # elements along a link, and their degree
PLATE_E = 69e6  # [Pa], modulus of a platform that is a plate


def matrices(length, degree):
    """Returns K and M of one element, the positions of its unknowns, and the weights of the unknowns of one section."""
    mesh = getfem.Mesh("cartesian", [0, length], [-DEFAULT["thickness"] / 2, DEFAULT["thickness"] / 2])
    field, scalar = getfem.MeshFem(mesh, 2), getfem.MeshFem(mesh, 1)
    field.set_fem(getfem.Fem(f"FEM_QK(2,{degree})"))
    scalar.set_fem(getfem.Fem("FEM_QK(2,0)"))
    rule = getfem.MeshIm(mesh, getfem.Integ(f"IM_GAUSS_PARALLELEPIPED(2,{2 * degree + 1})"))
    faces = mesh.outer_faces()
    mesh.set_region(1, faces[:, mesh.normal_of_faces(faces)[0] < -0.5])
    E, nu, width = DEFAULT["E"], DEFAULT["nu"], DEFAULT["width"] * numpy.ones(1)
    K = getfem.asm_linear_elasticity(rule, field, scalar, E * nu / (1 - nu**2) * width, E / (2 * (1 + nu)) * width)
    M, weights = (getfem.asm_mass_matrix(rule, field, field, *region) for region in ((), (1,)))
    return K.full(), DEFAULT["rho"] * width[0] * M.full(), field.basic_dof_nodes(), weights.full()


def link(elements, degree):
    """Returns K and M of a link along x. The first six unknowns are ux, uy, rotation of its two ends.

    The unknowns of each section are mean displacement, mean rotation, and warping. Displacements of nodes would lose seven digits,
    because thin rectangles are much stiffer through the thickness than in bending."""
    length = DEFAULT["length"] / elements
    K, M, (x, z), weights = matrices(length, degree)
    columns = [numpy.where(abs(x - length * k / degree) < 1e-9)[0] for k in range(degree + 1)]
    first = columns[0][numpy.lexsort((columns[0] % 2, z[columns[0]]))]
    axial = first % 2 == 0
    body = numpy.column_stack([axial, ~axial, -z[first] * axial]).astype(float)
    section = numpy.hstack([body, scipy.linalg.null_space(body.T @ weights[first][:, first])])
    order = numpy.concatenate([c[numpy.lexsort((c % 2, z[c]))] for c in columns])
    basis = numpy.kron(numpy.eye(degree + 1), section)
    K, M = (basis.T @ A[order][:, order] @ basis for A in (K, M))
    n = section.shape[1]
    motions = numpy.zeros((K.shape[0], 3))  # rigid motions, for which the forces are exactly zero
    for k in range(degree + 1):
        motions[k * n:k * n + 3] = [[1, 0, 0], [0, 1, length * k / degree], [0, 0, 1]]
    strain = numpy.eye(len(K)) - motions @ numpy.linalg.pinv(motions)
    K = strain.T @ K @ strain
    size = n * (elements * degree + 1)
    whole = [sp.lil_matrix((size, size)) for _ in (K, M)]
    for total, A in zip(whole, (K, M)):
        for at in range(0, size - n, degree * n):
            total[at:at + len(A), at:at + len(A)] += A
    ends = [0, 1, 2, size - n, size - n + 1, size - n + 2]
    between = sorted(set(range(size)) - set(ends))
    return [A.tocsc()[[*ends, *between]][:, [*ends, *between]] for A in whole]


class Manipulator:
    """Returns K and M of the free unknowns. The first three are x, y and rotation of the platform."""

    def __init__(self, variant, pose, one, plate_degree=0):
        active, elbow, top = variant.split("-")
        x, y, _ = POSES[pose]
        base, elbows, corners = geometry({**DEFAULT, "pose": POSES[pose]})
        self.size, self.parts, self.unused, held = 3, [], [], []
        plate = self.plate(corners, (x, y), plate_degree) if plate_degree else self.body()
        for k, (a, b, c) in enumerate(zip(base, elbows, corners)):
            foot, low, turn = self.new(3), self.new(3), self.new(1)
            high = low if elbow == "welded" else low[:2] + self.new(1)
            corner = [{0: 1, 2: y - c[1]}, {1: 1, 2: c[0] - x}, {2 if top == "welded" else turn[0]: 1}]
            if plate_degree:
                corner[:2] = [{plate[2 * k]: 1}, {plate[2 * k + 1]: 1}]
            held += foot[:2 + (active == "locked")] + (turn if top == "welded" else [])
            self.link(one, a, b, [{n: 1} for n in foot + low])
            self.link(one, b, c, [{n: 1} for n in high] + corner)
            if active == "sprung":
                self.parts.append((sp.csc_matrix([[SPRING]]), sp.csc_matrix((1, 1)), [{foot[2]: 1}]))
        self.K, self.M = (sum(t.T @ part @ t for t, part in zip(map(self.follows, self.parts), matrices))
                          for matrices in list(zip(*self.parts))[:2])
        free = numpy.setdiff1d(numpy.arange(self.size), held + self.unused)
        self.K, self.M = (A.tocsc()[free][:, free] for A in (self.K, self.M))

    def body(self):
        mass = DEFAULT["rho"] * math.sqrt(3) / 4 * DEFAULT["side"]**2 * DEFAULT["plate_thickness"]
        self.parts.append((sp.csc_matrix((3, 3)), sp.diags([mass, mass, mass * DEFAULT["side"]**2 / 12]), [{n: 1} for n in range(3)]))

    def plate(self, corners, P, degree):
        """Adds three triangles around P in plane stress, softer than the links. Returns their unknowns at the corners."""
        mesh = getfem.Mesh("empty", 2)
        for k in range(3):
            mesh.add_convex(getfem.GeoTrans("GT_PK(2,1)"), numpy.array([corners[k], corners[(k + 1) % 3], P]).T)
        field = getfem.MeshFem(mesh, 2)
        field.set_fem(getfem.Fem(f"FEM_PK(2,{degree})"))
        scalar = getfem.MeshFem(mesh, 1)
        scalar.set_fem(getfem.Fem("FEM_PK(2,0)"))
        rule = getfem.MeshIm(mesh, getfem.Integ("IM_TRIANGLE(6)"))
        nu, one = DEFAULT["nu"], DEFAULT["plate_thickness"] * numpy.ones(3)
        K = getfem.asm_linear_elasticity(rule, field, scalar, PLATE_E * nu / (1 - nu**2) * one, PLATE_E / (2 * (1 + nu)) * one)
        M = DEFAULT["rho"] * DEFAULT["plate_thickness"] * getfem.asm_mass_matrix(rule, field).full()
        nodes = field.basic_dof_nodes()
        unknowns = self.new(nodes.shape[1])
        at = [int(numpy.where(abs(nodes - numpy.array([p]).T).max(0) < 1e-9)[0][0]) for p in (*corners, P)]
        self.unused = [2, *unknowns[at[3]:at[3] + 2]]  # P has the first two unknowns, and no rotation
        unknowns[at[3]:at[3] + 2] = [0, 1]
        self.parts.append((sp.csc_matrix(K.full()), sp.csc_matrix(M), [{n: 1} for n in unknowns]))
        return [unknowns[a + axis] for a in at[:3] for axis in (0, 1)]

    def new(self, count):
        self.size += count
        return list(range(self.size - count, self.size))

    def link(self, one, p, q, motions):
        """Adds a link. motions: ux, uy, rotation of both joints, each as {unknown: factor}."""
        c, s = (q[0] - p[0]) / math.dist(p, q), (q[1] - p[1]) / math.dist(p, q)
        own = []
        for x, y, turn in (motions[:3], motions[3:]):
            own += [add((c, x), (s, y)), add((-s, x), (c, y)), turn]
        self.parts.append((*one, own + [{n: 1} for n in self.new(one[0].shape[0] - 6)]))

    def follows(self, part):
        rows = part[2]
        entries = [(i, n, factor) for i, row in enumerate(rows) for n, factor in row.items()]
        i, n, factors = zip(*entries)
        return sp.csc_matrix((factors, (i, n)), (len(rows), self.size))

    def frequencies(self):
        """Returns eight elastic frequencies [Hz], and the number of rigid motions at 0 Hz."""
        squares = numpy.sort(sp.linalg.eigsh(self.K, 12, self.M, sigma=-100.0, return_eigenvectors=False, tol=1e-13))
        f = numpy.sqrt(numpy.maximum(squares, 0)) / (2 * numpy.pi)
        rigid = int((f < 0.1).sum())
        return list(f[rigid:rigid + 8]), rigid

    def displacement(self):
        """Returns ux, uy of P [m] under 10 N along x."""
        force = numpy.zeros(self.K.shape[0])
        force[0] = 10
        return list(sp.linalg.spsolve(self.K, force)[:2])


def add(*scaled):
    total = {}
    for factor, motion in scaled:
        for n, f in motion.items():
            total[n] = total.get(n, 0) + factor * f
    return total


def main():
    folder = sys.argv[1]
    links = [link(*mesh) for mesh in MESHES]
    mesh = ("Elements FEM_QK: {} elements of degree {} per link. With {} elements of degree {}, the values change by no more than the uncertainty. "
            "The values are in the order of the poses {}.").format(*MESHES[1], *MESHES[0], ", ".join(POSES))
    for variant, degree in [(v, 0) for v in VARIANTS] + [("locked-welded-hinged", 1), ("locked-welded-hinged", 2)]:
        coarse, fine = ([Manipulator(variant, pose, one, degree) for pose in POSES] for one in links)
        words = "3-RRR, actuators {}, elbows {}, platform joints {}, {}three poses: ".format(
            *variant.split("-"), ("", "platform of 69 MPa in three linear triangles, ", "platform of 69 MPa in three quadratic triangles, ")[degree])
        variant += ("", "-linear-plate", "-quadratic-plate")[degree]
        found = {"frequencies": (words + "modes 1 to 8 at each pose, by GetFEM", "Hz", [[f for m in ms for f in m.frequencies()[0]] for ms in (coarse, fine)])}
        if not variant.startswith("free"):
            found["displacement"] = (words + "displacement x, y of P under 10 N along x, by GetFEM", "m",
                                     [[u for m in ms for u in m.displacement()] for ms in (coarse, fine)])
        for kind, (title, unit, (a, b)) in found.items():
            step = len(b) // len(POSES)
            change = max(abs(u - v) / (abs(v) if unit == "Hz" else max(map(abs, b[i // step * step:][:step])))
                         for i, (u, v) in enumerate(zip(a, b)))
            change = math.ceil(1e8 * max(change, 1e-8)) / 1e8
            store(folder, f"getfem-{variant}-{kind}", title, unit, [float(f"{v:.12g}") for v in b], change, mesh, source="getfem-5.4.2")
            print(variant, kind, change, fine[0].frequencies()[1], flush=True)


if __name__ == "__main__":
    main()
