#!/usr/bin/python3
"""Probabilities of all interpretations ("readings") of Table 2, that is, of the models that its authors may have used, given a printed row.

    model_probabilities.py TRAMMEL OUT      writes table-2-models and table-2-models-planar into OUT/references.json
"""
# model_probabilities.json contains factors. Each combination of factors is a reading, and all readings have the same prior probability. The file
# also names the three-dimensional readings (table_2_readings.py). Evidence is a Gaussian integral (Kass and Raftery, J. Am. Stat. Assoc. 90,
# 1995) over cells of the unknowns, in which the logarithms of the frequencies are linear: thickness within its printed digits, mesh between one
# element a link and four, one stiffness of all sprung joints (its logarithm), and the pose, centered or on a circle. Frequencies in the plane
# are trammel's. A printed row may contain any choice of SIZE of a reading's CANDIDATES lowest frequencies.
import concurrent.futures
import itertools
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

from spatial_manipulator import store

HERE = pathlib.Path(__file__).resolve().parent
CANDIDATES, SIZE, ANGLES = 7, 6, 4  # SIZE of CANDIDATES frequencies are a row; angles in a third of the circle (symmetry)
TURNED, THICKNESS, NUMBERS = CANDIDATES, CANDIDATES + 1, CANDIDATES + 2  # indices of the first frequency at a turned pose, and of the thickness
CHOICES = np.array(list(itertools.combinations(range(CANDIDATES), SIZE)))
EVEN = 1 / math.sqrt(12)  # standard deviation of a uniform distribution of width 1
STEP = 0.01  # relative step of the thickness for finite differences
LISTED, CREDIBLE, NEGLIGIBLE = 8, 0.95, 1e-9


def merged(target, patch):
    if not isinstance(patch, dict):
        return patch
    target = dict(target) if isinstance(target, dict) else {}
    for key, value in patch.items():
        target[key] = merged(target.get(key), value)
    return {key: value for key, value in target.items() if value is not None}


def reference(name):
    families = (json.loads(path.read_text()) for path in (HERE.parent.parent / "values").glob("*/*.json"))
    return next({**family.get("common", {}), **family[name]} for family in families if name in family)


def half_unit(printed):
    return 0.5 * 10.0 ** -len(printed.partition(".")[2])


TABLE_1 = reference("table-1-link-thickness")
HALF_WIDTH, LOG_THICKNESS = half_unit(TABLE_1["printed"][0]) / TABLE_1["values"][0], math.log(TABLE_1["values"][0])


def log_frequencies(trammel, model):
    """Returns the logarithms of the lowest frequencies, a column for each pose."""
    case = {"id": "case", "title": "A reading of Table 2", "model": model, "analysis": {"modes": {"count": CANDIDATES + 3}}}
    with tempfile.TemporaryDirectory() as folder:
        given, answer = (os.path.join(folder, name) for name in ("case.json", "result.json"))
        pathlib.Path(given).write_text(json.dumps(case))
        done = subprocess.run([trammel, "solve", given, answer], capture_output=True, text=True, check=False)
        result = json.loads(pathlib.Path(answer).read_text()) if os.path.exists(answer) else {"status": "refused"}
    if result["status"] != "solved":
        raise RuntimeError((result.get("reason") or done.stderr.strip()).rpartition(" a meaning: ")[2])
    values = {name: quantity["values"] for name, quantity in result["quantities"].items()}
    modes = np.array([values[name] for k in range(CANDIDATES + 3) if (name := f"frequency_Hz:{k + 1}") in values])
    columns = [modes[int(rigid):int(rigid) + CANDIDATES, k] for k, rigid in enumerate(values["rigid_body_modes"])]
    return np.log([np.pad(column, (0, CANDIDATES - len(column)), constant_values=np.nan) for column in columns]).T


def node(trammel, model, inputs):
    """Returns logarithms of frequencies and thickness at the center and on the circle, and their changes with thickness and mesh."""
    links, pose, radius = model["manipulator"]["links"], inputs["pose"], inputs["circle_radius_m"]
    circle = {"center_m": [pose["x_m"], pose["y_m"]], "radius_m": radius, "points": 13, "step_s": math.pi / 6, "phi_rad": pose["phi_rad"]}
    turned = {**pose, "phi_rad": pose["phi_rad"] + inputs["turned_rad"]}
    line = {"from": pose, "to": turned, "duration_s": 1, "points": 2, "step_s": 1}

    def solve(path, patch):
        return log_frequencies(trammel, {"manipulator": merged(model["manipulator"], {"links": patch}), "trajectory": path})

    around, middle = solve({"circle": circle}, {})[:, :ANGLES], solve({"line": line}, {})
    thicker, coarse = (solve({"line": line}, patch)[:, 0] - middle[:, 0]
                       for patch in ({"thickness_m": links["thickness_m"] * (1 + STEP)}, {"elements": 1}))
    further = np.full((2, 1 + ANGLES), [[middle[0, 1]], [math.log(links["thickness_m"])]])
    numbers = np.vstack([np.hstack([middle[:, :1], around]), further])
    by_thickness = np.append(np.append(thicker, thicker[0]) / math.log(1 + STEP), 1)
    return numbers, by_thickness, np.nan_to_num(np.append(np.append(coarse, coarse[0]), 0))


class Reading:
    """Prediction of a reading in each cell of its unknowns: logarithms of numbers, and their derivatives times standard deviations."""

    def __init__(self, title, weights, numbers, spread, noise=0.0):
        self.title, self.weights, self.numbers, self.spread, self.noise = title, np.array(weights), np.array(numbers), np.array(spread), noise

    def gaussian(self, choices, variance):
        """Returns mean, spread and Cholesky factor of the covariance of the chosen numbers, and True where they are predicted.
        `variance` is the variance of the row."""
        mean, spread = self.numbers[:, choices], self.spread[:, choices]
        valid = np.isfinite(mean).all(-1)
        covariance = spread @ np.swapaxes(spread, -1, -2) + np.diag(variance + self.noise ** 2)
        return mean, spread, np.linalg.cholesky(np.where(valid[..., None, None], covariance, np.eye(SIZE))), valid


def planar_reading(title, nodes):
    cells = []
    spans = list(zip(nodes, nodes[1:])) or [(nodes[0], nodes[0])]
    for ((low, low_thickness, low_mesh), (high, high_thickness, high_mesh)), here in itertools.product(spans, range(1 + ANGLES)):
        there = 1 + here % ANGLES if here else 0
        at_low, at_high = ((ends[:, here] + ends[:, there]) / 2 for ends in (low, high))
        mesh = (low_mesh + high_mesh) / 2
        spread = [(low_thickness + high_thickness) * HALF_WIDTH, mesh, at_high - at_low,
                  (low[:, there] - low[:, here] + high[:, there] - high[:, here]) / 2]
        cells.append(((0.5 / ANGLES if here else 0.5) / len(spans), (at_low + at_high + mesh) / 2, EVEN * np.column_stack(spread)))
    return Reading(title, *zip(*cells))


def planar_readings(trammel, inputs):
    """Returns the readings of all combinations, and the combinations that the program refuses."""
    (low, high), points = inputs["stiffness_N_m_per_rad"]["between"], inputs["stiffness_N_m_per_rad"]["points"]

    def read(combination):
        model = inputs["model"]
        for _, patch in combination:
            model = merged(model, patch.get("model", {}))
        sprung = [key for key, joint in model["manipulator"]["joints"].items() if isinstance(joint, dict)]
        springs = [{"spring_N_m_per_rad": low * (high / low) ** (i / (points - 1))} for i in range(points if sprung else 1)]
        try:
            return [node(trammel, merged(model, {"manipulator": {"joints": dict.fromkeys(sprung, k)}}), inputs) for k in springs]
        except RuntimeError as reason:
            return str(reason)

    combinations = list(itertools.product(*(factor.items() for factor in inputs["factors"].values())))
    readings, excluded = [], {}
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for combination, nodes in zip(combinations, pool.map(read, combinations)):
            title = ", ".join(name for name, _ in combination)
            if isinstance(nodes, str):
                excluded.setdefault(nodes, {"reason": nodes, "first": title, "readings": 0})["readings"] += 1
            else:
                readings.append(planar_reading(title, nodes))
    return readings, list(excluded.values())


def stored_readings(stored):
    for title, names in stored["readings"].items():
        numbers, spread = np.full((len(names), NUMBERS), np.nan), np.zeros((len(names), NUMBERS, 1))
        for i, name in enumerate(names):
            values = reference(name)["values"][:CANDIDATES]
            numbers[i, :len(values)], numbers[i, THICKNESS] = np.log(values), LOG_THICKNESS
            spread[i, [*range(len(values)), THICKNESS]] = 2 * HALF_WIDTH * EVEN  # frequencies depend on the thickness as those of bending links
        yield Reading(title, [1 / len(names)] * len(names), numbers, spread, stored["noise"])


def entropy(probabilities):
    p = probabilities[probabilities > 0]
    return -float(np.sum(p * np.log2(p)))


def same_within_noise(leader, other, variance):
    """Returns True if the rows of two readings with the same cells differ by less than the noise."""
    if len(leader.weights) != len(other.weights) or leader.noise != other.noise:
        return False
    mean, _, factor, valid = leader.gaussian(np.arange(SIZE), variance)
    scaled = np.linalg.solve(factor, (other.numbers[:, :SIZE] - mean)[..., None])
    return bool(valid.all() and leader.weights @ (scaled ** 2).sum((1, 2)) < 1)


def classes_of(readings, probability, variance):
    classes = []
    for r in np.argsort(-probability, kind="stable"):
        joined = next((c for c in classes if same_within_noise(readings[c[0]], readings[r], variance)), None)
        if joined is None:
            classes.append(joined := [])
        joined.append(r)
    return sorted(classes, key=lambda c: -sum(probability[r] for r in c))


def table(readings, priors, name, discrepancy):
    """Returns the probabilities of the readings given one row."""
    printed = reference(name)
    x, digits = np.log(printed["values"]), np.array([half_unit(text) for text in printed["printed"]]) / printed["values"] * 2 * EVEN

    variance = digits ** 2 + discrepancy ** 2
    cells = []
    for r, reading in enumerate(readings):
        mean, spread, factor, valid = reading.gaussian(CHOICES, variance)
        scaled = np.linalg.solve(factor, (x - mean)[..., None])[..., 0]
        logs = np.log(np.diagonal(factor, axis1=-2, axis2=-1)).sum(-1)
        prior = np.log(priors[r] * reading.weights[:, None] / np.maximum(1, valid.sum(1, keepdims=True)))
        evidence = np.where(valid, prior - 0.5 * ((scaled ** 2).sum(-1) + SIZE * math.log(2 * math.pi)) - logs, -np.inf)
        cells += [(evidence[at], r, at[0], mean[at], spread[at], factor[at]) for at in np.ndindex(evidence.shape)]
    best = max(cell[0] for cell in cells)
    total = sum(math.exp(cell[0] - best) for cell in cells)
    cells = sorted(((math.exp(log - best) / total, *rest) for log, *rest in cells), key=lambda cell: -cell[0])
    probability = np.bincount([cell[1] for cell in cells], [cell[0] for cell in cells], len(readings))
    cells = [cell for cell in cells if cell[0] >= NEGLIGIBLE]
    classes = classes_of(readings, probability, variance)
    of_class = np.array([sum(probability[r] for r in c) for c in classes])
    owner = {r: k for k, c in enumerate(classes) for r in c}

    def gain(cell, right):
        return np.linalg.solve(cell[5].T, np.linalg.solve(cell[5], right))

    def bits(number, resolution):
        """Returns by how many bits measuring one more number with this relative standard deviation lowers the entropy of the classes."""
        terms = []
        for cell in cells:
            p, r, c, mean, spread, _ = cell
            value, own = readings[r].numbers[c, number], readings[r].spread[c, number]
            by_row = gain(cell, spread @ own)
            left = max(0.0, own @ own - by_row @ (spread @ own)) + resolution ** 2
            terms.append((owner[r], p, value + by_row @ (x - mean), math.sqrt(left)))
        owners, weight, mean, deviation = np.array([term for term in terms if math.isfinite(term[2])] or [(0, 1, 0, 1)]).T
        prior = np.bincount(owners.astype(int), weight, len(classes))
        low, high = (mean - 6 * deviation).min(), (mean + 6 * deviation).max()
        points = int(min(max((high - low) / (0.5 * deviation.min()), 64), 4000))
        density, at = np.zeros((len(classes), points + 1)), low + np.arange(points + 1) * (high - low) / points
        for k, w, m, d in zip(owners.astype(int), weight, mean, deviation):
            z = (at - m) / d
            density[k] += np.where(np.abs(z) < 8, w / d * np.exp(-z * z / 2), 0)
        total = density.sum(0)
        remaining = sum(t * entropy(column / t) for t, column in zip(total, density.T) if t > 0) / total.sum()
        return max(0.0, entropy(prior / prior.sum()) - remaining)

    leading = []
    for k, members in enumerate(classes[:LISTED]):
        cell = next((cell for cell in cells if owner[cell[1]] == k), None)
        if cell is None:
            break  # negligible probability
        values = np.exp(cell[3] + cell[4] @ (cell[4].T @ gain(cell, x - cell[3])))
        leading.append({"title": readings[members[0]].title, "readings": len(members), "probability": of_class[k], "values": list(values)})
    width = math.hypot(discrepancy, digits.max())
    further = {"the seventh frequency": bits(CANDIDATES - 1, width),
               "the first frequency with the platform turned": bits(TURNED, width),
               "two further digits of the links' thickness": bits(THICKNESS, digits.max())}
    return {"reference": name, "unit": printed["unit"], "discrepancy": discrepancy, "log_evidence": best + math.log(total),
            "entropy_bits": entropy(of_class), "printed": printed["values"], "readings": len(readings), "classes": len(classes),
            "credible_classes": int(np.searchsorted(np.cumsum(of_class), CREDIBLE)) + 1, "leading": leading,
            "further_numbers": {key: {"expected_information_bits": value} for key, value in sorted(further.items(), key=lambda item: -item[1])}}


def main():
    trammel, folder = sys.argv[1:]
    given = json.loads((HERE / "model_probabilities.json").read_text())
    for variant, patch in {"": {}, "-planar": given.pop("planar")}.items():
        inputs = merged(given, patch)
        readings, excluded = planar_readings(trammel, inputs)
        planar, others = len(readings), inputs.get("stored", {}).get("probability", 0)
        readings += stored_readings(inputs["stored"]) if others else []
        priors = [(1 - others) / planar] * planar + [others / max(1, len(readings) - planar)] * (len(readings) - planar)
        rows = [{"row": row, **table(readings, priors, name, s)} for row, name in inputs["rows"].items() for s in inputs["discrepancy"]]
        store(folder, f"table-2-models{variant}", inputs["title"], "1", [row["log_evidence"] for row in rows], 0.001,
              "Logarithms of the Bayesian evidence of each row of Table 2 for each model discrepancy. "
              "The key 'probabilities' contains the probabilities of the readings.", source="trammel", probabilities={"rows": rows, "excluded": excluded})


if __name__ == "__main__":
    main()
