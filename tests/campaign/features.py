"""The features of a case, and the pairs of values that no case can have, each with its reason.

A row gives every feature a value. `refused` pairs are answered by the program with words (the campaign tries them to see these words);
`empty` ones have no meaning."""

FEATURES = {
    "model": ["small", "finite"],
    "formulation": ["tangent", "penalised", "mixed", "classical"],
    "cells": ["quadrilateral", "triangle"],
    "degree": [1, 2, 3, 4],
    "source": ["rectangle", "plane mesh", "order 1", "order 2", "order 3", "order 4", "inp", "facets"],
    "surface": ["plate", "arch", "dome", "saddle", "tube"],
    "fold": ["none", "fold"],
    "branch": ["none", "T", "star"],
    "join": ["none", "pieces"],
    "rigid": ["none", "clamp", "hinge"],
    "region": ["one", "said twice", "two"],
    "thickness": ["constant", "tapered"],
    "material": ["isotropic", "lame", "orthotropic", "cross-ply", "coupled"],
    "support": ["clamped", "hinged", "prescribed", "points"],
    "load": ["none", "force", "pressure", "follower", "couple", "edge", "weight", "strain"],
    "obstacle": ["none", "half_space", "ball", "bowl", "cylinder", "box", "torus", "cone", "height_field", "distance", "surface"],
    "second": ["none", "far", "opposite", "beside"],
    "motion": ["none", "press", "slide", "turn"],
    "pressed": ["none", "force"],
    "face": ["auto", "named", "both"],
    "steps": ["none", "one", "three", "auto", "back"],
    "control": ["none", "control"],
    "mesh": ["given", "accuracy"],
    "units": ["SI", "mm", "tiny", "huge"],
    "symmetry": ["none", "whole", "half"],
    "ranks": [1, 2, 3],
    "size": ["tiny", "small", "large"],
    "turned": ["no", "cyclic", "general"],
    "imperfection": ["none", "normal", "displacement"],
    "modes": ["none", "buckling", "vibration"],
    "admissible": ["no", "yes"],
}

PLANE = {"rectangle", "plane mesh"}
IN_SPACE = set(FEATURES["source"]) - PLANE
ORDERS = {"order 1", "order 2", "order 3", "order 4"}
LAYERED = {"cross-ply", "coupled"}
RELAXED = {"penalised", "mixed"}  # r need not be tangent
# The value of each feature in the simplest case: the reduction of a failing case goes there.
SIMPLEST = {name: values[0] for name, values in FEATURES.items()} | {"degree": 2, "load": "force", "size": "small"}


class Constraint:
    """Values of two or three features that do not go together: each feature with the set of its values."""

    def __init__(self, reason, refused, **values):
        self.reason, self.refused = reason, refused
        self.values = {k: v if isinstance(v, (set, list, tuple)) else {v} for k, v in values.items()}

    def forbids(self, row):
        return all(name in row and row[name] in values for name, values in self.values.items())


def others(feature, *values):
    return set(FEATURES[feature]) - set(values)


def refused(reason, **values):
    return Constraint(reason, True, **values)


def empty(reason, **values):
    return Constraint(reason, False, **values)


CONSTRAINTS = [
    refused("finite rotations have the tangent formulation", model="finite", formulation=others("formulation", "tangent")),
    refused("triangles have degree 1 or 2", cells="triangle", degree={3, 4}),
    refused("the classical formulation needs one smooth chart", formulation="classical", source=others("source", "rectangle", "plane mesh")),
    refused("the classical formulation needs one smooth chart", formulation="classical", join="pieces"),
    refused("a pressure follows with finite rotations", model="small", load="follower"),
    refused("control needs finite rotations", model="small", control="control"),
    refused("a step with control moves no obstacle", control="control", motion=others("motion", "none")),
    refused("facets have no branches", source="facets", branch=others("branch", "none")),
    refused("accuracy does not work with control", mesh="accuracy", control="control"),
    refused("control has no pressing forces", pressed="force", control="control"),
    empty("half of a surface of facets is not half of a surface", source="order 1", symmetry="half", surface=others("surface", "plate")),
    refused("a force presses one face", pressed="force", face="both"),
    refused("normals differ at a fold", imperfection="normal", fold="fold"),
    refused("normals differ at a branch", imperfection="normal", branch=others("branch", "none")),
    empty("a fold of a chart is a join", source="rectangle", fold="fold"),
    empty("a fold of a chart is a join", source="plane mesh", fold="fold", join="none"),
    empty("pieces of a rectangle are regions", source="rectangle", join="pieces"),
    empty("equal nodes of a mesh in space are one node", source=IN_SPACE, join="pieces"),
    empty("a join has two edges", source=PLANE, branch=others("branch", "none")),
    empty("without obstacle", obstacle="none", second=others("second", "none")),
    empty("without obstacle", obstacle="none", motion=others("motion", "none")),
    empty("without obstacle", obstacle="none", pressed="force"),
    empty("without obstacle", obstacle="none", face=others("face", "auto")),
    empty("without obstacle", obstacle="none", admissible="yes"),
    empty("obstacles move in steps", motion=others("motion", "none"), steps="none"),
    empty("loads are controlled in steps", control="control", steps={"none", "back"}),
    empty("strains are not controlled", control="control", load="strain"),
    empty("nothing moves", load="none", obstacle="none", support=others("support", "prescribed")),
    empty("strains belong to layers", load="strain", material=others("material", *LAYERED)),
    empty("three points hold loads in equilibrium only", support="points", load=others("load", "none", "strain")),
    empty("three points hold loads in equilibrium only", support="points", obstacle=others("obstacle", "none")),
    empty("three points hold loads in equilibrium only", support="points", rigid=others("rigid", "none")),
    empty("components of a point are those of the axes", support="points", turned="general"),
    empty("the points are not symmetric", support="points", symmetry=others("symmetry", "none")),
    empty("the points are corners of a piece", support="points", surface="tube"),
    empty("the points are corners of a piece", support="points", source={"facets"}),
    empty("components of a body are those of the axes", rigid=others("rigid", "none"), symmetry="half", turned="general"),
    empty("the multiplier and the penalty vanish at an edge of symmetry, and not inside the whole", formulation=RELAXED, symmetry="half",
          surface=others("surface", "plate")),
    refused("no load to control", control="control", load="none"),
    empty("rounding cuts facets anew in each half", source="facets", symmetry="half"),
    empty("curves of turned facets have names by their place", source="facets", turned="general"),
]


def forbidding(row):
    """The first constraint that forbids a row or a part of one, or None."""
    return next((c for c in CONSTRAINTS if c.forbids(row)), None)


def pairs_of(row, names=None):
    """All pairs of values of a row."""
    items = [(n, row[n]) for n in (names or FEATURES)]
    return [(a, b) for k, a in enumerate(items) for b in items[k + 1:]]


def all_pairs():
    """The pairs that a case can have, and those that constraints forbid (each with its constraint)."""
    names = list(FEATURES)
    possible, forbidden = [], {}
    for k, a in enumerate(names):
        for b in names[k + 1:]:
            for x in FEATURES[a]:
                for y in FEATURES[b]:
                    constraint = forbidding({a: x, b: y})
                    if constraint:
                        forbidden[(a, x), (b, y)] = constraint
                    else:
                        possible.append(((a, x), (b, y)))
    return possible, forbidden
