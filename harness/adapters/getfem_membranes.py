#!/usr/bin/python3
"""Adapter for GetFEM 5.4 (the package python3-getfem): statics and modes of plates in plane stress with point masses.

Three-node triangles become FEM_PK(2,1). Six-node triangles become FEM_PK(2,2) on a quadratic geometry, including curved sides.
GetFEM assembles stiffness, mass and stresses, and scipy solves the equations. The stress at a node is the mean over its
triangles, weighted by area.
"""
import getfem
import numpy
import scipy.linalg
import scipy.sparse
import scipy.sparse.linalg

from trammel_adapter import Cannot, main

PARTS = ("materials", "nodes", "plates", "supports", "loads", "point_masses")
DENSE = 1500  # up to this number of unknowns, a dense solver computes all modes
ORDER = {3: [0, 1, 2], 6: [0, 3, 1, 5, 4, 2]}  # order of a triangle's nodes in GetFEM, as indices of the case's nodes


def sparse(matrix):
    starts, rows = matrix.csc_ind()
    return scipy.sparse.csc_matrix((matrix.csc_val(), rows, starts), matrix.size())


class Membrane:
    """Stiffness K and mass M over the dofs x, y of each node of the case, and the data for stresses."""

    def __init__(self, case):
        self.model = case.model
        self.index = {name: i for i, name in enumerate(self.model["nodes"])}
        size = 2 * len(self.index)
        self.K, self.M = (scipy.sparse.csc_matrix((size, size)) for _ in range(2))
        self.plates = [self.plate(p) for p in self.model["plates"].values()]
        for mass in self.model.get("point_masses", {}).values():
            if mass.get("inertia_kg_m2") or any(mass.get("offset_m", [])):
                raise Cannot("point masses with inertia or an offset are not supported")
            at = [2 * self.index[mass["node"]] + k for k in (0, 1)]
            self.M += scipy.sparse.csc_matrix(([mass["mass_kg"]] * 2, (at, at)), (size, size))
        taken = {(n, t) for n, directions in self.model.get("supports", {}).items() for t in directions}
        if any(n not in self.index or t == "rotation" for n, t in taken):
            raise Cannot("only supports of nodes along x and y are supported")
        held = {2 * self.index[n] + "xy".index(t) for n, t in taken}
        used = {2 * self.index[n] + k for p in self.model["plates"].values() for t in p["triangles"] for n in t for k in (0, 1)}
        self.free = numpy.array(sorted(used - held))

    def plate(self, plate):
        triangles = plate.get("triangles") or []
        sizes = {len(t) for t in triangles}
        if len(sizes) != 1:
            raise Cannot("plates without triangles, or with two types of triangles, are not supported")
        n = sizes.pop()
        degree = 1 if n == 3 else 2
        material = self.model["materials"][plate["material"]]
        E, nu, t = material["E_Pa"], material["nu"], plate["thickness_m"]
        mesh = getfem.Mesh("empty", 2)
        names = [[triangle[i] for i in ORDER[n]] for triangle in triangles]
        points = numpy.array([[self.model["nodes"][name] for name in order] for order in names])
        mesh.add_convex(getfem.GeoTrans(f"GT_PK(2,{degree})"), numpy.asfortranarray(points.transpose(2, 1, 0)))
        field = getfem.MeshFem(mesh, 2)
        field.set_fem(getfem.Fem(f"FEM_PK(2,{degree})"))
        rule = getfem.MeshIm(mesh, getfem.Integ(f"IM_TRIANGLE({2 * degree + 2})"))
        scalar = getfem.MeshFem(mesh, 1)
        scalar.set_fem(getfem.Fem("FEM_PK(2,0)"))
        one = numpy.ones(scalar.nbdof())
        place = numpy.zeros(field.nbdof(), dtype=int)  # index in the case for each dof of GetFEM
        for convex, order in enumerate(names):
            dofs = field.basic_dof_from_cvid(convex)[0]
            for i, name in enumerate(order):
                place[dofs[2 * i:2 * i + 2]] = 2 * self.index[name] + numpy.arange(2)
        mu, plane = E / (2 * (1 + nu)), E * nu / (1 - nu**2)  # second Lame parameter, and the first one for plane stress
        parts = [getfem.asm_linear_elasticity(rule, field, scalar, plane * t * one, mu * t * one),
                 getfem.asm_mass_matrix(rule, field, field)]
        spread = scipy.sparse.csc_matrix((numpy.ones(len(place)), (place, numpy.arange(len(place)))),
                                         (2 * len(self.index), len(place)))
        K, M = (spread @ sparse(part) @ spread.T for part in parts)
        self.K, self.M = self.K + K, self.M + material["rho_kg_m3"] * t * M
        return mesh, field, rule, names, place, (plane, mu)

    def displacement(self):
        f = numpy.zeros(2 * len(self.index))
        for load in self.model.get("loads", {}).values():
            if "node" not in load or load.get("moment_N_m"):
                raise Cannot("only forces on nodes are supported as loads")
            f[2 * self.index[load["node"]]:][:2] += load.get("force_N", [0, 0])
        u = numpy.zeros(len(f))
        u[self.free] = scipy.sparse.linalg.spsolve(self.K[self.free][:, self.free].tocsc(), f[self.free])
        return u, f

    def stresses(self, u):
        """Returns node -> (xx, yy, xy): stresses at the triangles' nodes, averaged by area."""
        total, weight = {}, {}
        for mesh, field, rule, names, place, (plane, mu) in self.plates:
            degree = 1 if len(names[0]) == 3 else 2
            corners = getfem.MeshFem(mesh, 1)
            corners.set_fem(getfem.Fem(f"FEM_PK_DISCONTINUOUS(2,{degree})"))
            gradient = getfem.compute_gradient(field, u[place], corners)
            areas = mesh.convex_area()
            for convex, order in enumerate(names):
                for dof, name in zip(corners.basic_dof_from_cvid(convex)[0], order):
                    (xx, xy), (yx, yy) = gradient[:, :, dof]
                    both = plane * (xx + yy)
                    stress = numpy.array([both + 2 * mu * xx, both + 2 * mu * yy, mu * (xy + yx)])
                    total[name] = total.get(name, 0) + areas[convex] * stress
                    weight[name] = weight.get(name, 0) + areas[convex]
        return {name: total[name] / weight[name] for name in total}


def statics(membrane):
    u, f = membrane.displacement()
    found = {"compliance_J": ("J", f @ u)}
    for name, i in membrane.index.items():
        found[f"displacement_x_m:{name}"], found[f"displacement_y_m:{name}"] = ("m", u[2 * i]), ("m", u[2 * i + 1])
    for name, stress in membrane.stresses(u).items():
        found.update({f"stress_{axes}_Pa:{name}": ("Pa", value) for axes, value in zip(("xx", "yy", "xy"), stress)})
    return found


def modes(membrane, count):
    K, M = (A[membrane.free][:, membrane.free] for A in (membrane.K, membrane.M))
    if len(membrane.free) <= DENSE:
        squares = scipy.linalg.eigh(K.toarray(), M.toarray(), eigvals_only=True)
    else:
        shift = -1e-6 * K.diagonal().sum() / M.diagonal().sum()
        squares = numpy.sort(scipy.sparse.linalg.eigsh(K.tocsc(), count + 3, M.tocsc(), sigma=shift, return_eigenvectors=False))
    found = numpy.sqrt(numpy.maximum(squares[:count], 0)) / (2 * numpy.pi)
    rigid = int((found < 1e-4 * found[-1]).sum())
    found[:rigid] = 0
    return {"frequency_Hz": ("Hz", list(found)), "rigid_body_modes": ("1", rigid)}


def solve(case):
    case.require(kinds=("statics", "modes"), parts=PARTS, options=("count", "reduction_basis"))
    if "plates" not in case.model:
        raise Cannot("models without plates are not supported")
    membrane = Membrane(case)
    if case.kind == "modes" and "plates" in case.model and all(len(p[3][0]) == 3 for p in membrane.plates):
        case.element_order = 2
    found = statics(membrane) if case.kind == "statics" else modes(membrane, case.options["count"])
    return {name: found[name] for name in case.asked if name in found}


if __name__ == "__main__":
    main(solve, name="GetFEM", version="5.4.2")
