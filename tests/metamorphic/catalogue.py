"""Reads the catalogue's cases as documents, with separate documents for variants and levels of studies."""

import collections
import copy
import json

Computation = collections.namedtuple("Computation", "name case is_slow")
ONE_OF = ("analysis", "trajectory", "law", "method", "scheme")  # objects with exactly one key
LEVELS = 3  # levels of a study: the first, middle and last of its values


def merged(target, patch):
    """Returns a JSON merge patch applied (RFC 7396)."""
    if not isinstance(patch, dict):
        return copy.deepcopy(patch)
    result = dict(target) if isinstance(target, dict) else {}
    for key, value in patch.items():
        if value is None:
            result.pop(key, None)
        elif key in ONE_OF and isinstance(value, dict) and isinstance(result.get(key), dict) and not set(value) & set(result[key]):
            result[key] = merged(None, value)
        else:
            result[key] = merged(result.get(key), value)
    return result


def documents(folder):
    """Yields every case merged with the case that it extends."""
    cases = {}
    for path in sorted(folder.glob("**/*.json")):
        case = json.loads(path.read_text())
        if isinstance(case, dict) and "id" in case and path.stem == case["id"]:
            cases[path.name] = case
    for case in cases.values():
        whole = case
        while "extends" in whole:
            base = cases[whole["extends"]]
            whole = merged({key: value for key, value in base.items() if key != "abstract"},
                           {key: value for key, value in whole.items() if key != "extends"})
        if not case.get("abstract"):
            yield whole


def computations(folder):
    """Returns all computations of the catalogue, sorted by name."""
    found = []
    for case in documents(folder):
        for variant in ["base", *case.get("variants", {})]:
            document = merged(case, case["variants"][variant] if variant != "base" else {})
            if "analysis" not in document or next(iter(document["analysis"])) in ("options", "compare"):
                continue
            is_slow = "slow" in case.get("labels", [])
            bare = {"id": "", "title": case["title"], "description": "A transformed case.", "family": case["family"],
                    **{key: document[key] for key in ("model", "analysis", "effects") if key in document}}
            name = f"{case['id']}:{variant}"
            levels = study_levels(bare) if "study" in document["analysis"] else {"": bare}
            found += [Computation(name + level, one, is_slow) for level, one in levels.items()]
    return sorted(found)


def study_levels(case):
    """Returns level -> case of some values of a study."""
    study = case["analysis"]["study"]
    last = len(study.get("values", [0])) - 1
    levels = {}
    for i in sorted({round(last * k / (LEVELS - 1)) for k in range(LEVELS)}):
        level = copy.deepcopy(case)
        if "patches" in study:
            level = merged(level, study["patches"][i])
        for pointer in study.get("pointers", ()):
            *holders, key = [part.replace("~1", "/").replace("~0", "~") for part in pointer.split("/")[1:]]
            place = level
            for holder in holders:
                place = place[int(holder)] if isinstance(place, list) else place.setdefault(holder, {})
            place[int(key) if isinstance(place, list) else key] = study["values"][i]
        levels[f":{i}" if last > 0 else ""] = dict(level, analysis=level["analysis"]["study"]["analysis"])
    return levels
