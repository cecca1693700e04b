"""Reads cases of `trammel export` and writes results for `trammel grade`. It has no dependencies.

    from trammel_adapter import main, Cannot

    def solve(case):
        if case.kind != "modes":
            raise Cannot("only modes")
        return {"frequency_Hz": ("Hz", [12.5, 31.0])}

    main(solve, name="my code", version="1.0")

README.md in the same folder describes the complete protocol.
"""
import json
import math
import sys
import time
from dataclasses import dataclass


KEYS_OF_MEMBERS = {"nodes", "section", "beam", "elements", "ends", "axial", "mass_matrix",
                   "load_N_per_m", "end_inertia_kg_m2"}


class Cannot(Exception):
    """Raised if the code does not support a case. This is not a failure. Its text is the reason."""


@dataclass
class Member:
    """A straight frame member of one section; ends are "welded", "hinged" or a spring [N m/rad]."""
    name: str
    nodes: tuple            # names of the first and the second node
    E: float                # Young's modulus [Pa]
    G: float                # shear modulus [Pa]
    rho: float              # density [kg/m^3]
    A: float                # area [m^2]
    I: float                # second moment [m^4]
    kappa: float            # shear coefficient
    half_depth: float       # distance of the outermost fiber from the axis [m]; None if absent
    beam: str               # "euler-bernoulli", "rayleigh", "shear" or "timoshenko"
    elements: int           # number of elements that the case requests
    ends: tuple
    inextensible: bool
    lumped: bool            # lumped mass matrix
    load: tuple             # uniform load per length, world axes [N/m]


class Case(dict):
    """A resolved case: the JSON object, with shortcuts for adapters."""
    element_order = None    # order of convergence of the requested quantities; solve() may set it

    @property
    def model(self):
        return self["model"]

    @property
    def kind(self):
        """"statics", "modes", "buckling", ..."""
        return next(iter(self["analysis"]))

    @property
    def options(self):
        return self["analysis"][self.kind]

    @property
    def asked(self):
        """Units of the requested quantities, by name."""
        return {one["name"]: one["unit"] for one in self["export"]["quantities"]}

    def require(self, kinds, parts, options=()):
        """Raises Cannot for an analysis, a part of the model or an option that is not listed.
        Options that are false and the choice of eigensolver are ignored."""
        if self.kind not in kinds:
            raise Cannot("analysis '%s' is not supported" % self.kind)
        for key in self.model:
            if key not in parts:
                raise Cannot("%s are not supported" % key)
        for key, value in self.options.items():
            if key not in options and key != "eigensolver" and value is not False:
                raise Cannot("option '%s' is not supported" % key)

    def members(self):
        """Returns all frame members with the properties of their sections."""
        found = []
        for name, member in self.model.get("members", {}).items():
            for key in member.keys() - KEYS_OF_MEMBERS:
                raise Cannot("'%s' of a member is not supported" % key)
            section = self.model["sections"][member["section"]]
            material = self.model["materials"][section["material"]]
            if any(member.get("end_inertia_kg_m2", ())):
                raise Cannot("inertia at the end of a member is not supported")
            ends = tuple(end if isinstance(end, str) else end["spring_N_m_per_rad"]
                         for end in member.get("ends", ("welded", "welded")))
            E, nu = material["E_Pa"], material.get("nu", 0.3)
            found.append(Member(
                name, tuple(member["nodes"]), E, E / (2 * (1 + nu)), material["rho_kg_m3"],
                section["area_m2"], section["second_moment_m4"],
                section.get("shear_coefficient", 5 / 6), section.get("half_depth_m"),
                member.get("beam", "euler-bernoulli"), member.get("elements", 1), ends,
                member.get("axial") == "inextensible", member.get("mass_matrix") == "lumped",
                tuple(member.get("load_N_per_m", (0.0, 0.0)))))
        return found


def _result(quantities, solver, seconds):
    checked = {}
    for key, (unit, values) in quantities.items():
        listed = [float(value) for value in (values if hasattr(values, "__len__") else [values])]
        if not all(map(math.isfinite, listed)):
            raise ValueError("%s is not finite: %r" % (key, listed[:8]))
        checked[key] = {"unit": unit, "values": listed}
    return {"status": "solved", "quantities": checked, "cost": {"seconds": seconds},
            "solver": solver}


def main(solve, name, version="", element_order=None, digits=None):
    """Runs `adapter CASE.json RESULT.json`.

    solve(Case) returns {name: (unit, number or numbers)} or raises Cannot. It may also return a
    complete result with a "status"."""
    with open(sys.argv[-2]) as file:
        case = Case(json.load(file))
    start, status = time.perf_counter(), 0
    solver = {"name": name, "version": version, "element_order": element_order, "digits": digits}
    try:
        found = solve(case)
        solver["element_order"] = case.element_order or element_order
        result = found if "status" in found else _result(
            found, solver, time.perf_counter() - start)
    except Cannot as reason:
        result, status = {"status": "cannot", "reason": str(reason), "solver": solver}, 4
    with open(sys.argv[-1], "w") as file:
        json.dump(result, file, allow_nan=False)
    sys.exit(status)
