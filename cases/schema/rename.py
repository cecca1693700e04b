#!/usr/bin/env python3
"""Rewrites files with names from before 0.1 in place, by renamed.json beside it: cases, cost studies,
claims and results. Nothing but names changes, not even a blank. Usage: rename.py FILE..."""

import json
import pathlib
import re
import sys

NAMES = json.loads(pathlib.Path(__file__).with_name("renamed.json").read_text())
TOKEN = re.compile(r'("(?:[^"\\]|\\.)*")(\s*:)?|[\[\]{}]')
OF_QUANTITIES = {"quantities", "keep"}  # their keys name quantities, and so do the texts of these:
QUANTITY = {"quantity", "against_quantity", "x", "y", "value", "parameter", "outputs", "plus"}


def lookup(table, path):
    """The entry of the longest pattern that the path ends with."""
    best = max((p for p in table if fits(p.split("/"), path)), key=lambda p: p.count("/"), default=None)
    return best and table[best]


def fits(pattern, path):
    if pattern[0] == "":
        return pattern[1:] == path
    return len(pattern) <= len(path) and all(p in ("*", k) for p, k in zip(pattern[::-1], path[::-1]))


def quantity(name):
    return ":".join(NAMES["quantities"].get(part, part) for part in name.split(":"))


def renamed_key(path):
    if len(path) > 1 and path[-2] in OF_QUANTITIES:
        return quantity(path[-1])
    return lookup(NAMES["keys"], path) or path[-1]


def renamed_value(path, text):
    if path[-1] in ("pointer", "pointers"):
        keys = text.split("/")
        return "/".join(keys[:1] + [renamed_key(keys[1 : i + 1]) for i in range(1, len(keys))])
    if path[-1] in QUANTITY or path[-2:] == ["entries", "name"]:
        return quantity(text)
    return (lookup(NAMES["values"], path) or {}).get(text, text)


def rewrite(text):
    outer, key = [], None  # keys of the containers around (None in arrays), the last key read

    def token(match):
        nonlocal key
        if match[0] in "[{":
            outer.append(key)
            key = None
        elif match[0] in "]}":
            outer.pop()
            key = None
        else:
            word = json.loads(match[1])
            key = word if match[2] else key
            path = [k for k in [*outer, key] if k is not None]
            new = renamed_key(path) if match[2] else renamed_value(path, word)
            if new != word:
                return json.dumps(new, ensure_ascii=False) + (match[2] or "")
        return match[0]

    return TOKEN.sub(token, text)


if __name__ == "__main__":
    for file in map(pathlib.Path, sys.argv[1:]):
        file.write_text(rewrite(file.read_text()))
