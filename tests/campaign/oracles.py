"""The same thing said in another way: each oracle makes a second case that must have the same answer, and says how near.

    same       the same discrete problem: equal to rounding
    iterated   the same discrete problem reached by another path: equal to the tolerances of iterations
    estimated  another discretisation: equal within the errors that both runs estimate
"""

import random

from cases import Case
from features import FEATURES, IN_SPACE, PLANE, RELAXED, forbidding

PLANAR = {"order 1", "order 2", "order 3", "order 4", "inp", "plane mesh", "rectangle"}


class Oracle:
    def __init__(self, name, kind, change):
        self.name, self.kind, self.change = name, kind, change

    def variants(self, case):
        """The second case (row and extra), or None where the oracle does not apply."""
        rng = random.Random(f"{case.key}/{self.name}")
        changed = self.change(case.row, rng)
        # Lifted bounds depend on the path on which they were lifted.
        if changed is None or self.kind == "iterated" and case.row["admissible"] == "yes":
            return None
        row = case.row | {k: v for k, v in changed.items() if k in FEATURES}
        extra = {k: v for k, v in changed.items() if k not in FEATURES}
        if forbidding(row) or (row == case.row and not extra):
            return None
        return row, extra


def other(feature, values=None, when=lambda row: True):
    """A change of a feature to one of its other values."""
    def change(row, rng):
        choice = [v for v in (values or FEATURES[feature]) if v != row[feature] and not forbidding(row | {feature: v})]
        return {feature: rng.choice(choice)} if when(row) and choice and (values is None or row[feature] in values) else None
    return change


def set_to(when, **values):
    return lambda row, rng: dict(values) if when(row) else None


def given(row):
    return row["mesh"] == "given"


def path_free(row):
    """Whether parts of steps cannot change the end: no finite rotations in contact, nothing that unloads or rolls."""
    return row["steps"] in ("none", "one", "three", "auto") and given(row) and row["motion"] in ("none", "press") and (
        row["model"] == "small" or row["obstacle"] == "none")


def regions_said_twice(row, rng):
    if not given(row) or row["source"] == "facets" or row["region"] == "two":
        return None
    return {"region": "said twice" if row["region"] == "one" else "one"}


def other_plane(row, rng):
    """Charts on a rectangle and on a plane mesh have the same cells; so have all files of plane shells."""
    if not given(row) or row["cells"] == "triangle" and "rectangle" in (row["source"],):
        return None
    if row["surface"] == "plate":
        choice = [s for s in PLANAR if s != row["source"]]
    else:
        choice = [s for s in PLANE if s != row["source"]] if row["source"] in PLANE else []
    if row["cells"] == "triangle":
        choice = [s for s in choice if s != "rectangle"]
    choice = [s for s in choice if not forbidding(row | {"source": s})]
    return {"source": rng.choice(sorted(choice))} if choice and row["source"] != "facets" and row["join"] == "none" else None


def other_surface(row, rng):
    """A curved shell as chart and as meshes of orders whose error is estimated."""
    if row["surface"] == "plate" or row["source"] not in PLANE | {"order 3", "order 4"} or row["join"] != "none":
        return None
    choice = [s for s in ("rectangle", "order 3", "order 4") if s != row["source"] and not forbidding(row | {"source": s})]
    if row["cells"] == "triangle":
        choice = [s for s in choice if s != "rectangle"]
    return {"source": rng.choice(choice)} if choice else None


def half_and_whole(row, rng):
    """Not with lifted bounds: they depend on the pieces in which cells are searched, which a plane of symmetry divides in another way."""
    if row["symmetry"] == "none" or not given(row) or row["admissible"] == "yes":
        return None
    if (row["source"] not in PLANE and row["surface"] != "plate") or row["source"] == "facets" or (row["cells"] == "triangle" and row["source"] == "rectangle"):
        return None
    return {"symmetry": "half" if row["symmetry"] == "whole" else "whole"}


def other_material(row, rng):
    if row["material"] not in ("isotropic", "lame"):
        return None
    # The penalty takes the modulus of the material and not that of its layers.
    same_law = rng.random() < 0.5 or row["formulation"] in RELAXED
    return {"material": "isotropic" if row["material"] == "lame" else "lame"} if same_law else {"layers": True}


def one_degree_more(row, rng):
    if row["degree"] == 1 or forbidding(row | {"degree": row["degree"] + 1}) and row["cells"] == "triangle":
        return {"refinements": 2} if given(row) and row["degree"] > 1 else None
    return {"raised": row["degree"] + 1} if given(row) else None


SHAPES = {"ball": "distance ball", "half_space": "large box", "box": "distance"}

ORACLES = [
    Oracle("verify", "same", set_to(lambda row: True, verify=True)),
    Oracle("units", "same", other("units")),
    Oracle("turned", "same", other("turned")),
    Oracle("ranks", "same", other("ranks")),
    Oracle("python", "same", set_to(lambda row: row["ranks"] == 1, by="python")),
    Oracle("face by name", "same", set_to(lambda row: row["face"] == "auto" and row["obstacle"] not in ("none",) and row["second"] != "opposite", face="named")),
    Oracle("far obstacle", "same", lambda row, rng: {"second": "far"} if row["obstacle"] != "none" and row["second"] == "none" else
           {"second": "none"} if row["second"] == "far" else None),
    Oracle("supports by components", "same", set_to(lambda row: row["support"] in ("clamped", "hinged") and row["source"] != "facets", supports="components")),
    Oracle("material", "same", other_material),
    Oracle("regions said twice", "same", regions_said_twice),
    Oracle("pieces", "same", lambda row, rng: {"join": "none"} if row["join"] == "pieces" and given(row) and row["fold"] == "none" else None),
    Oracle("mesh or chart", "same", other_plane),
    Oracle("half and whole", "same", half_and_whole),
    Oracle("one step", "iterated", set_to(lambda row: row["steps"] == "none", steps="one")),
    Oracle("parts", "iterated", lambda row, rng: {"steps": "six"} if path_free(row) and row["steps"] != "none" and row["control"] == "none" else None),
    Oracle("held obstacle", "iterated", set_to(lambda row: row["pressed"] == "force" and row["motion"] == "none" and row["steps"] in ("none", "one", "three")
                                               and row["face"] != "both" and given(row), fixed="translation")),
    Oracle("control or load", "iterated", set_to(lambda row: row["control"] == "control" and given(row), control="none", steps="three", factor="load_factor")),
    Oracle("shape", "iterated", set_to(lambda row: row["obstacle"] in ("ball", "half_space") and given(row) and row["motion"] in ("none", "press"), shape="other")),
    Oracle("degree", "estimated", one_degree_more),
    Oracle("refinement", "estimated", set_to(lambda row: given(row) and row["degree"] <= 3, finer=True)),
    Oracle("accuracy", "estimated", set_to(lambda row: row["mesh"] == "accuracy", accuracy=2e-3)),
    Oracle("accuracy or mesh", "estimated", other("mesh")),
    Oracle("cells", "estimated", other("cells", when=lambda row: row["source"] != "facets" and row["degree"] == 2)),
    Oracle("formulation", "estimated", other("formulation", when=lambda row: row["degree"] >= 2)),
    Oracle("chart or mesh", "estimated", other_surface),
    Oracle("small load", "limit", set_to(lambda row: row["model"] == "finite" and given(row) and row["control"] == "none" and row["load"] != "follower" and row["admissible"] == "no"
                                         and row["modes"] == "none", model="small", size="tiny")),
]
BY_NAME = {oracle.name: oracle for oracle in ORACLES}
