"""Predicts how quantities change under a transformation of a case (a law), and compares predictions with results."""

import math
import re

ROUNDOFF = 1e-9  # relative to the model size; with a tolerance of 1e-5, displacements below 1e-14 of the size are round-off
TURNS = {"motion_phi_rad": "motion_m", "motion_velocity_phi_rad_per_s": "motion_velocity_m_per_s", "rotation_rad": "displacement_m", "end_rotation_rad": "displacement_m", "platform_rotation_rad": "displacement_m",
         "angular_velocity_rad_per_s": "velocity_m_per_s"}
UNCOUNTED = re.compile(  # work, round-off and positions of extrema, which no law of mechanics determines
    r"degrees_of_freedom|peak_frequency|estimated_correct_digits|.*residual|.*roundoff|.*steps?(_|$)|.*_drift|.*evaluations|"
    r"newton_|frequency_gap|.*_error|effect_|rejected|peak_time_s|.*_number|.*_difference|"
    r"result_|sample")
ODD_IN_MIRROR = re.compile(r"angle_ra|.*(_y_|rotation_|phi_|passive_|active_|elbow_sine|_moment_|bending_|shear_force|angular_velocity|torque|stress_xy|_angle)")
PLACE = re.compile("(?:(?:predicted_)?position|pose|center|motion|singular|boundary)_([xy])_m")
ANGLE = re.compile("(?:pose_phi|motion_phi|active_angle|passive_angle|predicted_(?:active_)?angle)_rad")
PEAK = re.compile(r"peak_.*_[xy]_")
ODD_IN_REVERSAL = re.compile(r"(peak_)?(bending_moment|bending_stress)_")


class Law:
    """Predicts the quantities of a transformed case from those of the original."""

    def __init__(self, rotation=None, mirrored=False, rename=None, reversed_members=False, units=None, inert=False,
                 loads=1.0, ignore_extremes=frozenset(), offset=None):
        self.rotation, self.mirrored, self.rename = rotation, mirrored, rename or (lambda name: name)
        self.reversed_members, self.units, self.inert, self.loads = reversed_members, units, inert, loads
        self.ignore_extremes, self.offset = ignore_extremes, offset or {}

    def expected(self, quantities):
        """Returns name -> values of the transformed case."""
        values = {}
        for name, series in quantities.items():
            if UNCOUNTED.match(name) or (self.ignore_extremes and name.split(":")[-1] in self.ignore_extremes):
                continue
            if self.rotation and PEAK.match(name):
                continue  # the peak of a rotated component does not follow from the peaks of the components
            if self.rotation and re.search("_(xx|yy|xy)_", name):
                values[name] = self.turned_stress(name, quantities)
            elif self.rotation and re.search("_[xy]_", name):
                values.update(self.turned(name, quantities))
            else:
                factor = self.factor(name)
                place = PLACE.match(name)
                shift = self.offset.get(place[1] if place else "angle" if ANGLE.match(name) else None, 0)
                values[self.rename(name)] = [factor * v + shift for v in series]
        return values

    def turned(self, name, quantities):
        """Returns both components of the rotated vector. If a reaction lacks one component, it is zero."""
        names = [re.sub("_[xy]_", f"_{axis}_", name, count=1) for axis in "xy"]
        zero = [0.0] * len(quantities[name])
        x, y = (quantities.get(n, zero) for n in names)
        c, s = self.rotation
        both = ([c * a - s * b for a, b in zip(x, y)], [s * a + c * b for a, b in zip(x, y)])
        return {n: v for n, v in zip(names, both) if set(names) <= set(quantities) or any(v)}

    def turned_stress(self, name, quantities):
        c, s = self.rotation
        weights = {"xx": (c * c, s * s, -2 * c * s), "yy": (s * s, c * c, 2 * c * s), "xy": (c * s, -c * s, c * c - s * s)}
        axes = re.search("_(xx|yy|xy)_", name)[1]
        parts = [quantities[name.replace(f"_{axes}_", f"_{other}_", 1)] for other in ("xx", "yy", "xy")]
        return [sum(w * v for w, v in zip(weights[axes], values)) for values in zip(*parts)]

    def factor(self, name):
        is_turn = re.search("sensitivity.*:orientation$", name)
        name = name.split(":")[0]
        factor = self.units(name) if self.units else 1.0
        if self.mirrored and (is_turn or ODD_IN_MIRROR.match(name)):
            factor = -factor
        if self.reversed_members and ODD_IN_REVERSAL.match(name):
            factor = -factor
        if self.loads != 1 and name.startswith("compliance_J"):
            factor *= self.loads ** 2
        elif self.loads != 1 and not re.match(r"mass_kg|inertia_|length_|pose_|time_s", name):
            factor *= self.loads
        return factor


def kind(name):
    """Returns the dimension of a quantity (force, moment, energy or stress), or its name without node and axis."""
    head = name.split(":")[0]
    unit = next((u for u in ("_N_m", "_N", "_J", "_Pa") if head.endswith(u)), None)
    return unit or re.sub(r"_([xy]|xx|yy|xy)(?=_|$)", "", head)


def scales(values, forces, size, stiffness):
    """Returns the largest magnitude of each kind of quantity in a case. The scale of moments is the scale of forces times
    the size of the model. The scale of forces includes the applied forces."""
    largest = {"_N": forces}
    for name, series in values.items():
        for value in series:
            if value is not None and math.isfinite(value):
                largest[kind(name)] = max(largest.get(kind(name), 0.0), abs(value))
    for head in ("displacement_m", "velocity_m_per_s", "motion_velocity_m_per_s"):  # round-off error of positions is 1e-16 of the size
        largest[head] = max(largest.get(head, 0.0), ROUNDOFF * size)
    for turn, length in TURNS.items():  # scale of rotations: largest displacement / model size
        largest[turn] = max(largest.get(turn, 0.0), largest.get(length, 0.0) / size)
    moved = largest.get("displacement_m", 0.0) / size
    largest["_N"] = max(largest["_N"], largest.get("_N_m", 0.0) / size, ROUNDOFF * moved * stiffness)
    largest["_N_m"] = max(largest.get("_N_m", 0.0), largest["_N"] * size)
    return largest


def forces_and_size(model):
    """Returns the largest applied force, the extent and the largest axial stiffness EA of a plain model."""
    places = list(model["nodes"].values()) if "nodes" in model else model["manipulator"].get("base_m") or [
        [0, 0], [model["manipulator"]["base_side_m"]] * 2]
    size = max(max(p[i] for p in places) - min(p[i] for p in places) for i in (0, 1)) or 1.0
    loads = [*model.get("loads", {}).values(), *model.get("follower_loads", {}).values()]
    forces = [abs(f) for load in loads for f in load.get("force_N", [])]
    lines = [abs(q) * size for m in model.get("members", {}).values() for q in m.get("load_N_per_m", [])]
    sections, materials = model.get("sections", {}), model.get("materials", {})
    areas = [s.get("area_m2", 0.0) * materials[s["material"]]["E_Pa"] for s in sections.values() if "material" in s]
    plates = [p["thickness_m"] * size * materials[p["material"]]["E_Pa"] for p in model.get("plates", {}).values()]
    return max(forces + lines, default=0.0), size, max(areas + plates, default=0.0)


def stated_roundoff(*runs):
    """Returns kind -> relative round-off error, the sum of the largest errors of the runs."""
    total = {}
    for run in runs:
        largest = {}
        for name, error in run.items():
            largest[kind(name)] = max(largest.get(kind(name), 0.0), error)
        for head, error in largest.items():
            total[head] = total.get(head, 0.0) + error
    return total


def differences(expected, obtained, tolerance, model, stated):
    """Returns (name, expected, obtained, error relative to the scale) for each quantity beyond the tolerance, and the
    largest error of the other quantities."""
    scale, found, largest_error = scales(expected, *forces_and_size(model)), [], 0.0
    for name, series in expected.items():
        other = obtained.get(name)
        if other is None or len(other) != len(series):
            found.append((name, f"{len(series)} values", "missing" if other is None else f"{len(other)} values", math.inf))
            continue
        largest = scale.get(kind(name), 0.0) or 1.0  # if all values are zero, the error is absolute
        turn = 2 * math.pi if ANGLE.match(name) else math.inf
        errors = [(abs(math.remainder(a - b, turn)) / largest, a, b) for a, b in zip(series, other)
                  if not (a == b or (a != a and b != b))]
        if errors:
            worst = max(errors, key=lambda e: math.inf if e[0] != e[0] else e[0])
            if not worst[0] <= tolerance + stated.get(kind(name), 0.0):
                found.append((name, worst[1], worst[2], worst[0]))
            else:
                largest_error = max(largest_error, worst[0])
    return found, largest_error
