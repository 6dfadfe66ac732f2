"""From a row of features and a seed to the files of a case. Random numbers have names, so that a changed feature leaves the others as they are."""

import random

from bodies import Body, place, vector_text
from features import IN_SPACE, LAYERED
from frame import Frame, norm, number, plus, rotation, times, unit
from mesh_files import MeshOf, PlaneMesh, facets_text, gmsh_text, inp_text
from shells import WIDTH, Shell

E, SIZES = 1e7, {"tiny": 1e-5, "small": 0.1, "large": 0.8}
FLAT = {"half_space", "bowl"}


class Case:
    """`extra`: changes of the text that say the same thing in another way (variants.py): supports, obstacle, refinement, accuracy, far, ..."""

    def __init__(self, seed, number, row, **extra):
        self.key, self.number, self.row, self.extra = f"{seed}/{number}", number, row, extra
        self.frame = Frame(row["turned"], row["units"])
        self.side = 1 if row["surface"] == "tube" else self.random("side").choice([-1, 1])
        self.shell = Shell(row, self.key, self.side)
        self.e = self.shell.thickness
        self.amount = SIZES[row["size"]] * self.random("amount").uniform(0.4, 1.0) * self.e
        self.is_symmetric = row["symmetry"] != "none"
        self.has_both_ends = row["rigid"] == "none" and (row["support"] == "hinged" or (
            row["support"] == "clamped" and row["obstacle"] not in FLAT and self.random("ends").random() < 0.5))
        self.pieces = row["join"] == "pieces" or row["region"] != "one" or (row["source"] == "plane mesh" and row["fold"] == "fold")
        self.at_nodes = self.random("place").random() < 0.75  # meshes are coarse: bodies between their nodes are missed
        self.y0 = 0.0 if self.is_symmetric or self.at_nodes else self.random("y0").uniform(-0.2, 0.2) * (0.5 if self.shell.is_tube else WIDTH)
        self.files, self._bodies = {}, None

    @property
    def bodies(self):
        """Names and bodies of the obstacles, placed."""
        if self._bodies is None:
            self._bodies = self._obstacles()
        return self._bodies

    @property
    def facet_size(self):
        return self.frame.length * (0.4 * self.shell.radius if self.shell.is_tube else 0.25)

    def random(self, name):
        return random.Random(f"{self.key}/{name}")

    # ---- names ---------------------------------------------------------------------------------------------------------------

    def region(self, patch):
        if patch in ("west", "east"):
            return f"r_{patch}" if self.pieces else "r_base"
        return f"r_{patch}"

    def boundary(self, name):
        """The names in the case of an outer edge."""
        if self.row["source"] == "rectangle":
            return [{"start": "left", "end": "right"}.get(name, name)]
        return self.extra["curves"][name] if self.row["source"] == "facets" else [name]

    def boundaries_of(self, box):
        """The outer edges that have a side, or all sides on the base, in this box of two corners of the frame."""
        by_name, result = {patch.name: patch for patch in self.shell.patches}, []
        for name, edges in self.shell.boundaries().items():
            sides = [[self.frame.point(X) for X in side_points(by_name[patch], side)] for patch, side in edges]
            sides.append([X for points in sides[:2] for X in points])
            near = lambda points: max(abs(x - y) for x, y in zip(sum(box_of(points), []), sum(box, []))) < 0.01 * self.frame.length
            if any(near(points) for points in sides):
                result.append(name)
        return result

    # ---- obstacles -----------------------------------------------------------------------------------------------------------

    def _obstacles(self):
        if self.row["obstacle"] == "none":
            return []
        first = self._body("body", self.extra.get("shape", self.row["obstacle"]), self.side,
                           self.random("x0").choice([0.0, 0.25]) if self.at_nodes else self.random("x0").uniform(-0.25, 0.3), self.y0)
        bodies = [("body", first)]
        rng = self.random("second")
        if self.row["second"] in ("opposite", "beside"):
            side = self.side if self.row["second"] == "beside" else -self.side
            bodies.append(("other", self._body("other", "ball", side, -0.25 if self.at_nodes else rng.uniform(-0.3, -0.15), -self.y0)))
        elif self.row["second"] == "far":
            far = Body("half_space", rng, [0, 0, -100.0 * self.side], [[1, 0, 0], [0, -self.side, 0], [0, 0, -self.side]])
            bodies.append(("other", far))
        return bodies

    def _body(self, name, kind, side, x, y):
        normal = self.shell.normal(x, y)
        out = times(side, normal)
        tangent = unit(plus([1, 0, 0], times(-out[0], out)))
        across = [out[1] * tangent[2] - out[2] * tangent[1], out[2] * tangent[0] - out[0] * tangent[2], out[0] * tangent[1] - out[1] * tangent[0]]
        body = Body(kind, self.random("body of " + name), self.shell.base_point(x, y), [tangent, across, out])
        body.side = side
        if name == "other":
            body.r = 0.1
        elif not self.is_symmetric:
            body.turn(rotation([0, 0, 1], self.random("spin").uniform(-0.3, 0.3)))
        if kind in FLAT and not self.has_both_ends and self.row["rigid"] == "none" and self.row["support"] == "clamped":
            body.turn(rotation([0, 1, 0], 4 * self.amount))  # nearer at the free end
        self._place(body, name)
        return body

    def _place(self, body, name):
        """Where it begins: away if something brings it nearer, else inside the shell by a part of the amount; never at a support."""
        samples = [(X, self.thickness_at(patch, X) / 2) for patch, _, _, X in self.shell.samples()]
        approaches = name == "body" and (self.row["motion"] != "none" or self.row["pressed"] == "force")
        is_driven = body.kind in FLAT or approaches
        gap = (0.3 if is_driven else -0.5) * self.amount
        place(body, samples, gap, 1e-2 * self.amount)
        fixed = [(X, self.thickness_at(patch, X) / 2) for patch, x, y, X in self.shell.samples() if self._is_supported(patch, x)]
        short = 0.4 * self.amount - min(body.distance(X) - half for X, half in fixed)
        if short > 0:
            body.origin = plus(body.origin, body.out, short)
        body.way = times(-0.8 * self.amount if not short > 0 else -0.3 * self.amount, body.out)

    def thickness_at(self, patch, X):
        factor = 1.4 if self.row["region"] == "two" and patch.name == "east" else 1.0
        return self.e * factor * (1 + 0.3 * X[0] if self.row["thickness"] == "tapered" else 1.0)

    def _is_supported(self, patch, x):
        at_end = patch.name == ("flange" if self.shell.flange else "east") and x == patch.x[1]
        return (patch.name == "west" and x == patch.x[0]) or (at_end and (self.has_both_ends or self.row["support"] == "prescribed"
                                                                           or self.row["rigid"] != "none"))

    def face_of(self, body):
        return "upper" if body.side > 0 else "lower"

    # ---- amounts -------------------------------------------------------------------------------------------------------------

    def area_force(self):
        """A force per area that bends a clamped plate by about the amount."""
        return 3.0 * E * self.e**3 * self.amount

    def load_direction(self):
        rng = self.random("load direction")
        toward = self.side if self.row["obstacle"] in FLAT or rng.random() < 0.7 else -self.side
        z = toward * rng.uniform(0.7, 1.0)
        return [rng.uniform(-0.5, 0.5), 0.0 if self.is_symmetric else rng.uniform(-0.4, 0.4), z]

    # ---- the whole -----------------------------------------------------------------------------------------------------------

    def text(self):
        from sections import SECTIONS

        lines = []
        for section in SECTIONS:
            lines += section(self)
        return "\n".join(lines) + "\n"

    def all_files(self):
        """The texts of all files by name. The names of facets' curves come from `extra["curves"]`."""
        self.files = {}
        text = self.text()
        return {"case.toml": text, **self.mesh_files(), **self.files}

    def mesh_files(self):
        row, shell = self.row, self.shell
        source, triangles = row["source"], row["cells"] == "triangle"
        regions = {patch.name: self.region(patch.name) for patch in shell.patches}
        if source == "rectangle":
            return {}
        if source == "plane mesh":
            mesh = PlaneMesh(shell, 1, triangles, lambda patch, x, y: [x + patch.shift, y, 0.0], 1.0)
            return {"plane.msh": gmsh_text(mesh, regions)}
        in_space = lambda patch, x, y: self.frame.point(patch.point(x, y))
        if source == "facets":
            return {"shell.stl": facets_text(MeshOf(shell, 1, True, in_space, self.frame.length, divided=3), regions)}
        if source == "inp":
            return {"shell.inp": inp_text(MeshOf(shell, 2, triangles, in_space, self.frame.length), regions)}
        return {"shell.msh": gmsh_text(MeshOf(shell, int(source[-1]), triangles, in_space, self.frame.length), regions)}


def side_points(patch, side, steps=24):
    (a, b), (c, d) = patch.x, patch.y
    at = {"left": lambda t: (a, c + (d - c) * t), "right": lambda t: (b, c + (d - c) * t),
          "bottom": lambda t: (a + (b - a) * t, c), "top": lambda t: (a + (b - a) * t, d)}[side]
    return [patch.point(*at(k / steps)) for k in range(steps + 1)]


def box_of(points):
    return [[min(p[k] for p in points) for k in range(3)], [max(p[k] for p in points) for k in range(3)]]
