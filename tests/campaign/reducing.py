"""Makes a failing case small: one feature after the other takes its simplest value as long as the failure stays the same kind."""

from checking import Checker
from features import FEATURES, SIMPLEST, forbidding
from oracles import BY_NAME

# Big simplifications first.
ORDER = ["mesh", "ranks", "units", "turned", "second", "modes", "imperfection", "admissible", "motion", "pressed", "obstacle", "branch", "fold",
         "rigid", "region", "thickness", "material", "face", "symmetry", "steps", "join", "surface", "source", "cells", "degree", "formulation",
         "model", "load", "support", "control", "size"]


def simplest_with(row):
    """The features of a row that are not the simplest ones."""
    return {name: value for name, value in row.items() if value != SIMPLEST[name]}


def reduced(program, folder, seed, number, row, finding):
    """The smallest row found; the files of its last failing run stay in `folder`."""
    checker = Checker(program, folder, seed)
    oracles = [finding.oracle] if finding.oracle in BY_NAME else []

    def fails(candidate):
        found = checker.check(number, candidate, oracles)[0]
        return any((f.kind, f.oracle) == (finding.kind, finding.oracle) for f in found)

    changed = True
    while changed:
        changed = False
        for name in ORDER:
            for candidate in simpler(row, name):
                if not forbidding(candidate) and fails(candidate):
                    row, changed = candidate, True
                    break
    return row


def simpler(row, name):
    """Rows with a simpler value of a feature. Features of obstacles and steps go together."""
    if row[name] == SIMPLEST[name]:
        return []
    rows = [row | {name: SIMPLEST[name]}]
    if name == "obstacle":
        alone = {n: SIMPLEST[n] for n in ("obstacle", "second", "motion", "pressed", "face", "admissible")}
        rows = [row | alone] + ([row | {"obstacle": "half_space"}] if row["obstacle"] != "half_space" else [])
    if name == "steps" and row["steps"] not in ("one",):
        rows.append(row | {"steps": "one"})
    return rows


assert set(ORDER) == set(FEATURES)
