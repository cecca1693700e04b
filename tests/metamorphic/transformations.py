"""Transformations of a plain case (`trammel export`). Each returns (case, law), or raises Skip with the reason."""

import copy
import math
import re

from laws import Law

KEYED = ("materials", "sections", "nodes", "members", "plates", "edges", "rigid_bodies", "point_masses", "springs",
         "pins", "sliders", "axial_springs", "loads", "follower_loads")
UNITS = {"m": (1, 0, 0), "m2": (2, 0, 0), "m3": (3, 0, 0), "m4": (4, 0, 0), "N": (1, 1, -2), "kg": (0, 1, 0), "s": (0, 0, 1),
         "s2": (0, 0, 2), "Hz": (0, 0, -1), "Pa": (-1, 1, -2), "J": (2, 1, -2), "W": (2, 1, -3), "rad": (0, 0, 0)}


class Skip(Exception):
    """The transformation does not apply to this case."""


def dimensions(name):
    """Returns the exponents of length, mass and time that the unit suffix of a name states."""
    name = name.split(":")[0].replace("rho_kg_m3", "rho_kg_per_m3").replace("_rad_s", "_rad_per_s")
    tokens, units = name.split("_") if "_" in name else [], []
    while tokens and (tokens[-1] in UNITS or tokens[-1] == "per"):
        units.insert(0, tokens.pop())
    sign, total = 1, [0, 0, 0]
    for unit in units:
        if unit == "per":
            sign = -1
        else:
            total = [t + sign * u for t, u in zip(total, UNITS[unit])]
    return total


def plane_only(case):
    """Returns model and analysis of a plane model of nodes or of a manipulator."""
    model = case.get("model", {})
    if "nodes" not in model and "manipulator" not in model:
        raise Skip("there is no model in the plane")
    return model, case["analysis"]


def nodes_only(case):
    if "nodes" not in case.get("model", {}) or "manipulator" in case["model"]:
        raise Skip("the model is a manipulator, whose parts and names are fixed")
    return case["model"], case["analysis"]


def axis_bound(model, analysis):
    """Returns True if the model has parts that lie along the world axes."""
    motions = list(model.get("supports", {}).values())
    motions += [m.get("restrained_motions", []) for m in model.get("members", {}).values()]
    uneven = any(len(set(s.get("stiffness_N_per_m", [0, 0]))) > 1 for s in model.get("springs", {}).values())
    driven = any(d.get("motion") in ("x", "y") for d in analysis_value(analysis, "drives", {}).values())
    return uneven or driven or any(("x" in m) != ("y" in m) for m in motions)


def analysis_value(analysis, key, default=None):
    return next(iter(analysis.values())).get(key, default)


VECTORS = ("force_N", "load_N_per_m", "offset_m", "traction_Pa", "gravity_m_s2", "velocity_m_per_s")
POINTS = ("arc_center_m", "center_m")


def move(case, point, vector, angle, mirrored=False):
    """Applies a motion of the plane to everything that has a position or a direction."""
    model, analysis = plane_only(case)
    sign = -1 if mirrored else 1

    def visit(value):
        for key, item in list(value.items()) if isinstance(value, dict) else []:
            if key in VECTORS:
                value[key] = vector(item)
            elif key in POINTS:
                value[key] = point(item)
            elif key == "direction_rad":
                value[key] = sign * item + angle
            elif key in ("moment_N_m", "speed_per_s", "travel", "rotation_rad_per_s", "initial_rad"):
                value[key] = sign * item
            elif key == "torque_N_m":
                value[key] = [sign * torque for torque in item]
            else:
                visit(item)
        for item in value if isinstance(value, list) else []:
            visit(item)

    if any("ellipse" in edge for edge in model.get("edges", {}).values()):
        raise Skip("an ellipse lies along the world axes")
    move_manipulator(case, point, sign, angle)
    if analysis_value(analysis, "drives") and (mirrored or axis_bound(model, analysis)):
        raise Skip("the drive acts along an axis")
    if isinstance(analysis_value(analysis, "initial_velocities"), dict):
        for value in analysis_value(analysis, "initial_velocities").values():
            x, y = vector([value.pop("x_m_per_s", 0), value.pop("y_m_per_s", 0)])
            value.update(x_m_per_s=x, y_m_per_s=y)
    rotating = analysis_value(analysis, "rotating") or analysis_value(analysis, "rotating_frame") or {}
    if rotating and ("center_m" not in rotating):
        rotating["center_m"] = [0, 0]
    if rotating and (mirrored or rotating.get("axis", "normal") != "normal"):
        raise Skip("the axis of rotation is bound to the plane")
    for name, place in model.get("nodes", {}).items():
        model["nodes"][name] = point(place)
    visit(model)
    visit(analysis)


def move_manipulator(case, point, sign, angle):
    """Applies a motion of the plane to the base, the pose and the path of a manipulator."""
    def move_pose(pose):
        pose["x_m"], pose["y_m"] = point([pose["x_m"], pose["y_m"]])
        pose["phi_rad"] = sign * pose["phi_rad"] + angle

    model = case["model"]
    if "manipulator" not in model:
        return
    manipulator, path = model["manipulator"], model.get("trajectory", {})
    if "circle" in path and (sign < 0 or angle != 0):
        raise Skip("a circle starts to the right of its center")
    manipulator["base_m"] = [point(corner) for corner in base_corners(manipulator)]
    if sign < 0:
        manipulator["platform"]["vertices_m"] = [[x, -y] for x, y in platform_corners(manipulator["platform"])]
        manipulator["working_mode"] = [-side for side in manipulator.get("working_mode", [-1] * 3)]
    if "pose" in model:
        move_pose(model["pose"])
    if "sensitivity-map" in case["analysis"] and (sign < 0 or angle != 0):
        raise Skip("the positions of the map lie along the world axes")
    for key in ("line", "rest_to_rest"):
        for end in ("from", "to") if key in path else ():
            move_pose(path[key][end])
    for knot in path.get("spline", {}).get("knots", ()):
        move_pose(knot)


def base_corners(manipulator):
    """Returns A1, A2, A3, and removes the keys that defined them."""
    if "base_m" in manipulator:
        return manipulator.pop("base_m")
    side = manipulator.pop("base_side_m")
    return [[0.0, 0.0], [side, 0.0], [side / 2, math.sqrt(3) / 2 * side]]


def platform_corners(platform):
    """Returns C1, C2, C3 from P, and removes the keys that defined them."""
    if "vertices_m" in platform:
        return platform.pop("vertices_m")
    radius = platform.pop("side_m") / math.sqrt(3)
    return [[radius * math.cos(math.radians(a)), radius * math.sin(math.radians(a))] for a in (210, 330, 90)]


def next_limb(text):
    """Returns a name of the manipulator's parts with the limbs 1, 2, 3 renamed to 2, 3, 1."""
    return re.sub(r"(?<![A-Za-z0-9])([ABC])([123])(?![A-Za-z0-9])", lambda m: m[1] + "231"[int(m[2]) - 1], text)


def relabel(case):
    """Renumbers the limbs of a manipulator cyclically."""
    model, _ = plane_only(case)
    if "manipulator" not in model:
        raise Skip("there is no manipulator")
    parameters = analysis_value(case["analysis"], "parameters", {})
    if any(p.get("property") == "base_side" for p in parameters.values()):
        raise Skip("the base grows about the first joint")
    manipulator = model["manipulator"]
    manipulator["base_m"] = base_corners(manipulator)
    manipulator["platform"]["vertices_m"] = platform_corners(manipulator["platform"])

    def last_first(value):
        return [value[2], value[0], value[1]]

    def visit(value):
        """Renames the limbs in all keys and values."""
        if isinstance(value, dict):
            return {next_limb(key): visit(item) for key, item in value.items()}
        if isinstance(value, list):
            return [visit(item) for item in value]
        return next_limb(value) if isinstance(value, str) else value

    for holder, keys in ((manipulator, ("base_m", "working_mode")), (manipulator["platform"], ("vertices_m",)),
                         (manipulator["joints"], ("active", "elbow", "platform")),
                         (manipulator["links"], ("proximal_length_m", "distal_length_m"))):
        for key in keys:
            if isinstance(holder.get(key), list):
                holder[key] = last_first(holder[key])
    for options in case["analysis"].values():
        if "torque_N_m" in options:
            options["torque_N_m"] = last_first(options["torque_N_m"])
    case["model"], case["analysis"] = visit(model), visit(case["analysis"])
    return case, Law(rename=lambda name: next_limb(name))


# Default values, as the schema defines them.
DEFAULTS = {
    "model": {"elements": 1},
    "member": {"ends": ["welded", "welded"], "end_inertia_kg_m2": [0, 0]},
    "point_mass": {"inertia_kg_m2": 0},
    "slider": {"keeps_angle": False},
    "circle": {"angular_speed_rad_s": 1, "phi_rad": 0},
    "spline": {"ends": "natural"},
    "statics": {"second_order": False},
    "modes": {"prestressed": False, "eigensolver": "automatic"},
    "buckling": {"count": 3, "eigensolver": "automatic"},
    "large-statics": {"switch_branch": False, "whole_path": False, "points": 2000},
    "large-motion": {"integrator": "generalized-alpha", "extrapolated": False, "steps": 100000000},
    "harmonic": {"points": 101},
    "transient": {"initial_state": "at-rest"},
    "elastodynamics": {"step_errors": False, "modal_superposition": False},
    "rotating": {"axis": "normal", "coriolis": True},
    "inverse-dynamics": {"bodies": False},
    "sensitivity": {"method": "energies", "differences": False},
    "grnn": {"surrogate": "network", "split": "first", "scaling": "none"},
}


def defaults(case):
    """Adds absent keys with their default values."""
    model, analysis = plane_only(case)
    kind, options = next(iter(analysis.items()))
    if kind not in DEFAULTS:
        raise Skip("the analysis has no optional keys")
    holders = [(kind, options), ("rotating", options.get("rotating"))]
    if "nodes" in model and "manipulator" not in model:
        holders += [("model", model)]
        holders += [("member", member) for member in model.get("members", {}).values()]
        holders += [("point_mass", mass) for mass in model.get("point_masses", {}).values()]
        holders += [("slider", slider) for slider in model.get("sliders", {}).values()]
    path = model.get("trajectory", {})
    holders += [(key, path.get(key)) for key in ("circle", "spline")]
    for name, holder in holders:
        for key, value in DEFAULTS[name].items() if holder is not None else ():
            if stated(name, holder, key, "effects" in case):
                holder.setdefault(key, copy.deepcopy(value))
    return case, Law()


def stated(name, holder, key, has_effects):
    """Returns True if a default may be written, because no other key forbids it."""
    if name == "large-motion" and key == "extrapolated":
        return "tolerance" not in holder and "track" not in holder
    if key == "initial_state":
        return "rotating_frame" not in holder
    if key in ("second_order", "prestressed", "coriolis"):
        return not has_effects  # the key "effects" states this value instead
    if name == "grnn":
        return holder.get("surrogate") != "spline" and (key != "split" or "train" in holder)
    return True


def rotate(case):
    """Rotates the plane: by 0.7 rad, or by a right angle if parts lie along the world axes."""
    model, analysis = plane_only(case)
    if "harmonic" in analysis:
        raise Skip("amplitudes of rotated components are not predictable")
    right = axis_bound(model, analysis)
    angle = math.pi / 2 if right else 0.7
    c, s = (0.0, 1.0) if right else (math.cos(angle), math.sin(angle))

    def turn(v):
        return [c * v[0] - s * v[1], s * v[0] + c * v[1]]

    if right:
        swap_axes(model)
    if analysis_value(analysis, "outputs"):
        raise Skip("the outputs name single components")
    move(case, turn, turn, angle)
    return case, Law(rotation=(c, s), offset={"angle": angle})


def swap_axes(model):
    swapped = {"x": "y", "y": "x"}
    for name, motions in model.get("supports", {}).items():
        model["supports"][name] = [swapped.get(m, m) for m in motions]
    for member in model.get("members", {}).values():
        if "restrained_motions" in member:
            member["restrained_motions"] = [swapped.get(m, m) for m in member["restrained_motions"]]
    for spring in model.get("springs", {}).values():
        if "stiffness_N_per_m" in spring:
            spring["stiffness_N_per_m"].reverse()


def translate(case):
    """Moves the model by an offset that binary numbers represent exactly."""
    move(case, lambda p: [p[0] + 0.75, p[1] - 0.375], lambda v: v, 0.0)
    return case, Law(offset={"x": 0.75, "y": -0.375})


def without_arcs(model):
    if any("arc_center_m" in member for member in model.get("members", {}).values()):
        raise Skip("an arc runs counterclockwise from start to end")


def mirror(case):
    """Mirrors the plane at the x axis."""
    model, _ = plane_only(case)
    without_arcs(model)
    if model.get("plates"):
        raise Skip("mirrored triangles run clockwise")
    move(case, lambda p: [p[0], -p[1]], lambda v: [v[0], -v[1]], 0.0, mirrored=True)
    return case, Law(mirrored=True)


def rename(case):
    """Gives every part a new name and stores the parts in the opposite order."""
    model, _ = nodes_only(case)
    old = {name for key in KEYED for name in model.get(key, {})}
    new = {name: f"{chr(122 - i % 26)}{i}_{re.sub('[^A-Za-z0-9]', '_', name)}" for i, name in enumerate(sorted(old))}

    def of_quantity(text):
        head, _, places = text.rpartition(":")
        whole = [name for name in sorted(old, key=len, reverse=True) if places == name or places.startswith(name + ".")]
        return f"{head}:{new[whole[0]]}{places[len(whole[0]):]}" if whole else text

    def visit(value):
        if isinstance(value, dict):
            return {key: visit(item) for key, item in value.items()}
        if isinstance(value, list):
            return [visit(item) for item in value]
        if isinstance(value, str) and ":" in value:
            return of_quantity(value)
        return new.get(value, value) if isinstance(value, str) else value

    if {"x", "y", "rotation", "normal", "welded", "hinged", "lumped"} & old:
        raise Skip("a name equals a word of the schema")
    for key in list(model):
        if key in KEYED + ("supports",):
            model[key] = {new[name]: visit(item) for name, item in reversed(model[key].items())}
    for kind, options in case["analysis"].items():
        case["analysis"][kind] = visit(options)
        for key in ("drives", "initial_velocities"):
            if key in options:
                case["analysis"][kind][key] = {new.get(n, n): visit(i) for n, i in options[key].items()}
    return case, Law(rename=of_quantity)


def reverse(case):
    """Swaps the ends of every member, with its releases and sections."""
    model, _ = nodes_only(case)
    if not model.get("members"):
        raise Skip("the model has no members")
    without_arcs(model)
    for member in model["members"].values():
        for key in ("nodes", "ends", "end_inertia_kg_m2"):
            if key in member:
                member[key].reverse()
        if "end_section" in member:
            member["section"], member["end_section"] = member["end_section"], member["section"]
    outputs = analysis_value(case["analysis"], "outputs")
    if outputs:
        outputs[:] = [other_end(o) for o in outputs]
    return case, Law(rename=other_end, reversed_members=True)


def other_end(name):
    swap = {".start": ".end", ".end": ".start"}
    return re.sub(r"\.(start|end)$", lambda m: swap[m[0]], name)


def split(case):
    """Splits every prismatic straight member with an even number of elements at its middle."""
    model, _ = nodes_only(case)
    pieces = {}
    for name, member in list(model.get("members", {}).items()):
        n = member.get("elements", 1)
        if n % 2 or set(member) & {"end_section", "arc_center_m", "restrained_motions", "end_inertia_kg_m2"}:
            continue
        (a, b), middle = member["nodes"], f"half_{name}".replace(".", "_")
        model["nodes"][middle] = [(p + q) / 2 for p, q in zip(model["nodes"][a], model["nodes"][b])]
        second = copy.deepcopy(member)
        ends = member.get("ends", ["welded", "welded"])
        member.update(nodes=[a, middle], elements=n // 2, ends=[ends[0], "welded"])
        second.update(nodes=[middle, b], elements=n // 2, ends=["welded", ends[1]])
        pieces[name] = f"second_{name}"
        model["members"][pieces[name]] = second
    if not pieces:
        raise Skip("no member is straight and prismatic with an even number of elements")
    def of_quantity(text):
        match = re.match(r"(.*):(.*)\.end$", text)
        return f"{match[1]}:{pieces[match[2]]}.end" if match and match[2] in pieces else text
    outputs = analysis_value(case["analysis"], "outputs")
    if outputs:
        outputs[:] = [of_quantity(o) for o in outputs]
    return case, Law(rename=of_quantity, ignore_extremes=set(pieces))


def rescale(base, power):
    """Returns a transformation that changes one unit by a power of two."""
    def scaled(case):
        def factor(key):
            return 2.0 ** (power * dimensions(key)[base])

        def visit(value, key):
            if isinstance(value, dict):  # a range of a quantity has the unit of its name, except its number of points
                return {k: visit(v, k if any(dimensions(k)) or not any(dimensions(key)) or k == "points" else key)
                        for k, v in value.items()}
            if isinstance(value, list):
                return [visit(item, key) for item in value]
            numeric = isinstance(value, (int, float)) and not isinstance(value, bool)
            return value * factor(key) if numeric and any(dimensions(key)) else value

        model, analysis = plane_only(case)
        if analysis_value(analysis, "drives") or analysis_value(analysis, "rotating_frame"):
            raise Skip("the unit of a law depends on its motion")
        model = {key: visit(value, "") for key, value in model.items() if key not in ("nodes", "gravity_m_s2")}
        if "nodes" in case["model"]:
            model["nodes"] = {k: [c * factor("at_m") for c in p] for k, p in case["model"]["nodes"].items()}
        if "gravity_m_s2" in case["model"]:
            model["gravity_m_s2"] = [g * factor("g_m_per_s2") for g in case["model"]["gravity_m_s2"]]
        case["model"], case["analysis"] = model, visit(analysis, "")
        in_torques = "grnn" in analysis and analysis_value(analysis, "scaling", "none") == "none"

        def of_quantity(name):  # without scaling, a network's sigma is in the unit of its inputs
            return factor("sigma_N_m" if in_torques and name in ("sigma", "grid_sigma") else name)

        for options in case["analysis"].values() if in_torques else ():
            for key in ("sigma", "spread"):
                if key in options:
                    options[key] *= factor("sigma_N_m")
            for key in ("from", "to"):
                if key in options.get("search", {}):
                    options["search"][key] *= factor("sigma_N_m")
        return case, Law(units=of_quantity)
    return scaled


def inert(case):
    """Adds a massless unloaded member at a node with a welded member, and a load of zero. No result may change."""
    model, analysis = nodes_only(case)
    for member in model.get("members", {}).values():
        for node, end in zip(member["nodes"], member.get("ends", ["welded"] * 2)):
            if end == "welded" and member.get("axial") != "rigid":
                break
        else:
            continue
        break
    else:
        raise Skip("no member is welded to a node")
    section = copy.deepcopy(model["sections"][member["section"]])
    material = dict(model["materials"][section["material"]], rho_kg_m3=0)
    length = math.dist(*(model["nodes"][n] for n in member["nodes"])) / 4
    x, y = model["nodes"][node]
    model["materials"]["massless"], model["sections"]["tail"] = material, dict(section, material="massless")
    model["nodes"]["tail_end"] = [x + 0.6 * length, y + 0.8 * length]
    tail = {key: member[key] for key in ("beam", "mass_matrix", "axial") if key in member}
    model["members"]["tail"] = dict(tail, nodes=[node, "tail_end"], section="tail", elements=1)
    if model.get("loads"):
        model["loads"]["nothing"] = {"node": "tail_end", "force_N": [0, 0]}
    return case, Law(inert=True)


def scale_loads(case):
    """Doubles every load of linear statics."""
    model, analysis = plane_only(case)
    if "statics" not in analysis or analysis["statics"].get("second_order") or "effects" in case:
        raise Skip("the analysis is not linear in the loads")

    multiply_loads(model, 2)
    return case, Law(loads=2.0)


def multiply_loads(value, factor):
    for key, item in value.items() if isinstance(value, dict) else []:
        if key in ("force_N", "load_N_per_m", "traction_Pa", "gravity_m_s2"):
            value[key] = [factor * f for f in item]
        elif key in ("moment_N_m", "normal_Pa"):
            value[key] = factor * item
        else:
            multiply_loads(item, factor)


ALL = {"rotate": rotate, "translate": translate, "mirror": mirror, "rename": rename, "reverse": reverse,
       "split": split, "length": rescale(0, -10), "mass": rescale(1, -10), "time": rescale(2, 7), "inert": inert,
       "loads": scale_loads, "defaults": defaults, "relabel": relabel}
