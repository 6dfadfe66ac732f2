"""Shells as patches: each is the image of a rectangle of two parameters x, y, given by three expressions that serve as chart and as nodes of meshes.

The base reaches over x from -1/2 to 1/2. A fold adds a flange at its right edge, a branch one or two webs at x = 0, both away from the obstacle.
All is symmetric about the plane Y = 0. Lengths are those of the case's own frame; `flange` and `web` point to the side -side."""

import math
import random

WIDTH = 0.6


class Patch:
    def __init__(self, name, x, y, expressions, shift=0.0):
        self.name, self.x, self.y, self.expressions, self.shift = name, x, y, expressions, shift
        self._code = [compile(e.replace("^", "**"), e, "eval") for e in expressions]

    def point(self, x, y):
        places = {"x": x, "y": y, "sin": math.sin, "cos": math.cos}
        return [eval(code, {"__builtins__": {}}, places) for code in self._code]

    def tangents(self, x, y, h=1e-5):
        one = [(a - b) / (2 * h) for a, b in zip(self.point(x + h, y), self.point(x - h, y))]
        two = [(a - b) / (2 * h) for a, b in zip(self.point(x, y + h), self.point(x, y - h))]
        return one, two


class Shell:
    """Patches, thickness, names of boundaries: dictionary from name to (patch, side), sides "left right bottom top"."""

    def __init__(self, row, seed, side):
        rng = random.Random(f"{seed}/shell")
        self.side, self.kind = side, row["surface"]
        self.is_tube = self.kind == "tube"
        self.radius = rng.uniform(0.15, 0.25) if self.is_tube else rng.uniform(1.2, 3.0)
        self.thickness = rng.choice([0.01, 0.02, 0.03])
        self.is_half = row["symmetry"] == "half"
        self.half_width = math.pi * self.radius if self.is_tube else WIDTH / 2
        self.low = 0.0 if self.is_half else -self.half_width
        self.along_y = rng.random() < 0.5  # an arch is curved along y
        self.expressions = self._base()
        cut = 0.0
        shift = 1.0 if row["join"] == "pieces" else 0.0
        self.patches = [self._patch("west", (-0.5, cut), self.expressions), self._patch("east", (cut, 0.5), self.expressions, shift)]
        angle, width = rng.uniform(0.5, 1.8), rng.uniform(0.15, 0.3) if not self.is_tube else 0.4 * self.radius
        if row["fold"] == "fold":
            self.patches.append(self._ruled("flange", 0.5, angle, width))
        if row["branch"] == "T":
            self.patches.append(self._ruled("web", 0.0, rng.uniform(1.2, 1.9), width))
        elif row["branch"] == "star":
            self.patches += [self._ruled("web", 0.0, 0.9, width), self._ruled("web2", 0.0, 2.2, width)]
        self.cells = (2, 3 if self.is_tube else 1) if self.is_half else (2, 6 if self.is_tube else 2)
        self._samples = []
        self.flange = row["fold"] == "fold"

    def _base(self):
        r, s = repr(self.radius), -self.side  # curved away from the obstacle
        if self.kind == "plate":
            return ["x", "y", "0*x"]
        if self.kind == "arch":
            return ["x", f"{r}*sin(y/{r})", f"{s}*{r}*(1-cos(y/{r}))"] if self.along_y else [f"{r}*sin(x/{r})", "y", f"{s}*{r}*(1-cos(x/{r}))"]
        if self.kind == "dome":
            return ["x", "y", f"{s}*(x^2+y^2)/(2*{r})"]
        if self.kind == "saddle":
            return ["x", "y", f"{s}*(y^2-x^2)/(2*{r})"]
        return ["x", f"{r}*sin(y/{r})", f"{r}*cos(y/{r})"]

    def _patch(self, name, x, expressions, shift=0.0):
        return Patch(name, x, (self.low, self.half_width), expressions, shift)

    def _ruled(self, name, at, angle, width):
        """A patch of straight lines that begin on the line x = at; its own x begins at 3.5 and counts the length."""
        edge = [e.replace("x", f"({at})") for e in self.expressions]
        c, s, away = repr(math.cos(angle)), math.sin(angle), -self.side
        if self.is_tube:
            s *= -1 if self.side > 0 else 1
            r = repr(self.radius)
            way = [c, f"{s}*sin(y/{r})", f"{s}*cos(y/{r})"]
        else:
            way = [c, "0", repr(away * s)]
        expressions = [f"{e}+(x-3.5)*{w}" for e, w in zip(edge, way)]
        return self._patch(name, (3.5, 3.5 + width), expressions)

    @property
    def base(self):
        return self.patches[:2]

    def base_point(self, x, y):
        return self.base[0].point(x, y)

    def normal(self, x, y):
        one, two = self.base[0].tangents(x, y)
        n = [one[1] * two[2] - one[2] * two[1], one[2] * two[0] - one[0] * two[2], one[0] * two[1] - one[1] * two[0]]
        length = math.sqrt(sum(v * v for v in n))
        return [v / length for v in n]

    def samples(self, count=13):
        """Points of all patches with their patch and parameters."""
        if not self._samples:
            for patch in self.patches:
                for i in range(count):
                    for j in range(count):
                        x = patch.x[0] + (patch.x[1] - patch.x[0]) * i / (count - 1)
                        y = patch.y[0] + (patch.y[1] - patch.y[0]) * j / (count - 1)
                        self._samples.append((patch, x, y, patch.point(x, y)))
        return self._samples

    def boundaries(self):
        """Names of the outer edges: of each, the patch, the side, and its names in a plane mesh of pieces."""
        result = {"start": [("west", "left")], "bottom": [("west", "bottom"), ("east", "bottom")], "top": [("west", "top"), ("east", "top")]}
        result["end"] = [("flange", "right")] if self.flange else [("east", "right")]
        for patch in self.patches[2:]:
            if patch.name != "flange":
                result[patch.name + "_end"] = [(patch.name, "right")]
            result["bottom"].append((patch.name, "bottom"))
            result["top"].append((patch.name, "top"))
        if self.is_tube and not self.is_half:
            del result["bottom"], result["top"]
        return result
