#!/usr/bin/env python3
"""Cantilevers along x by the formulas of a handbook."""
from trammel_adapter import Cannot, main


def solve(case):
    case.require(kinds=("statics",),
                 parts=("materials", "sections", "nodes", "members", "supports", "loads"))
    members, loads = case.members(), list(case.model["loads"].values())
    if len(members) != 1 or len(loads) != 1 or any(members[0].load):
        raise Cannot("models with more than one member or load are not supported")
    m, load = members[0], loads[0]
    held, tip = m.nodes
    (xa, ya), (xb, yb) = case.model["nodes"][held], case.model["nodes"][tip]
    clamped = case.model.get("supports") == {held: ["x", "y", "rotation"]}
    if not clamped or load["node"] != tip or ya != yb or m.beam != "euler-bernoulli":
        raise Cannot("only slender cantilevers along x are supported")
    L, P, M0 = xb - xa, load.get("force_N", [0, 0])[1], load.get("moment_N_m", 0)
    found = {
        "displacement_y_m:" + tip: P * L**3 / (3 * m.E * m.I) + M0 * L**2 / (2 * m.E * m.I),
        "rotation_rad:" + tip: P * L**2 / (2 * m.E * m.I) + M0 * L / (m.E * m.I),
        "reaction_y_N:" + held: -P,
        "reaction_moment_N_m:" + held: -P * L - M0,
    }
    return {name: (unit, found[name]) for name, unit in case.asked.items() if name in found}


main(solve, name="handbook", version="1")
