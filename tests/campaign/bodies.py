"""Obstacles. A body stands in local axes: its origin is the point that touches first, z points away from the shell, the body is at z >= 0.
It knows its distance (positive outside) and its text in a case file."""

import math

from frame import apply, cross, dot, norm, number, plus, times, transposed
from mesh_files import stl_text


def polyhedron(radius, around=8, rings=5):
    """Corners and triangles (outward) of a ball of facets whose lowest corner is the origin."""
    corners = [[0.0, 0.0, 0.0]]
    for k in range(1, rings):
        a = math.pi * k / rings
        corners += [[radius * math.sin(a) * math.cos(2 * math.pi * j / around), radius * math.sin(a) * math.sin(2 * math.pi * j / around),
                     radius * (1 - math.cos(a))] for j in range(around)]
    corners.append([0.0, 0.0, 2 * radius])
    at = lambda k, j: 1 + (k - 1) * around + j % around
    triangles = [(0, at(1, j + 1), at(1, j)) for j in range(around)]
    for k in range(1, rings - 1):
        for j in range(around):
            triangles += [(at(k, j), at(k, j + 1), at(k + 1, j + 1)), (at(k, j), at(k + 1, j + 1), at(k + 1, j))]
    triangles += [(at(rings - 1, j), at(rings - 1, j + 1), len(corners) - 1) for j in range(around)]
    return corners, triangles


class Body:
    def __init__(self, kind, rng, origin, axes):
        self.kind, self.origin, self.axes = kind, list(origin), axes  # axes: rows e1, e2, out
        big = rng.uniform(0.1, 0.3)
        self.r = rng.uniform(1.5, 3.0) if kind == "bowl" else big
        self.size = [rng.uniform(0.1, 0.3), rng.uniform(0.1, 0.3), rng.uniform(0.1, 0.2)]
        self.fillet = rng.choice([0.0, 0.02])
        self.tube = rng.uniform(0.03, 0.08)
        self.half_angle = rng.uniform(0.7, 1.3)
        self.length = rng.choice([None, 0.3])
        self.planes = []

    @property
    def out(self):
        return self.axes[2]

    def local(self, X):
        return apply(self.axes, plus(X, self.origin, -1))

    def world(self, v):
        return plus(self.origin, apply(transposed(self.axes), v))

    def turn(self, matrix):
        """Rotates the axes about the origin of the body by a local rotation."""
        self.axes = [[dot(row, column) for column in zip(*self.axes)] for row in transposed(matrix)]

    def distance(self, X):
        p, r = self.local(X), self.r
        if self.kind == "half_space":
            return -p[2]
        if self.kind == "ball":
            return norm(plus(p, [0, 0, r], -1)) - r
        if self.kind == "bowl":
            return r - norm(plus(p, [0, 0, -r], -1))
        if self.kind == "cylinder":
            across = math.hypot(p[0], p[2] - r) - r
            return across if self.length is None else rounded(across, abs(p[1]) - self.length / 2)
        if self.kind == "box":
            return box_distance([abs(p[0]) - self.size[0] / 2, abs(p[1]) - self.size[1] / 2, abs(p[2] - self.size[2] / 2) - self.size[2] / 2])
        if self.kind == "torus":
            return math.hypot(math.hypot(p[0], p[1]) - r, p[2] - self.tube) - self.tube
        if self.kind == "cone":
            across = math.hypot(p[0], p[1])
            return max(across * math.cos(self.half_angle) - p[2] * math.sin(self.half_angle), p[2] - self.size[2])
        if self.kind == "height_field":
            h = (p[0]**2 + p[1]**2) / (2 * r)
            return (h - p[2]) / math.sqrt(1 + (p[0]**2 + p[1]**2) / r**2)
        if self.kind == "distance":
            a = [self.size[0], self.size[1], self.tube]
            q = [p[0], p[1], p[2] - a[2]]
            value, slope = sum((c / s)**2 for c, s in zip(q, a)) - 1, 2 * norm([c / s**2 for c, s in zip(q, a)])
            return value / slope if slope else -min(a)
        return max(dot(n, p) - c for n, c in self._planes())

    def _planes(self):
        if not self.planes:
            corners, triangles = polyhedron(self.r)
            self.planes = list({tuple(round(v, 9) for v in [*n, c]): (n, c) for n, c in (plane([corners[k] for k in t]) for t in triangles)}.values())
        return self.planes

    def files(self, frame, name):
        if self.kind != "surface":
            return {}
        corners, triangles = polyhedron(self.r)
        points = [frame.point(self.world(c)) for c in corners]
        return {f"{name}.stl": stl_text({"body": [[points[k] for k in t] for t in triangles]})}

    def text(self, frame, name):
        """The lines of the shape in a case file."""
        at = lambda v: vector_text(frame.point(self.world(v)))
        along = lambda k: vector_text(frame.direction(self.axes[k]))
        long = lambda v: number(frame.length * v)
        back = vector_text(frame.direction(times(-1, self.out)))
        if self.kind == "half_space":
            return [f"half_space = {{ point = {at([0, 0, 0])}, normal = {back} }}"]
        if self.kind == "ball":
            return [f"ball = {{ centre = {at([0, 0, self.r])}, radius = {long(self.r)} }}"]
        if self.kind == "bowl":
            return [f"ball = {{ centre = {at([0, 0, -self.r])}, radius = {long(self.r)}, inside = true }}"]
        if self.kind == "cylinder":
            more = "" if self.length is None else f", length = {long(self.length)}, fillet = {long(self.fillet)}"
            return [f"cylinder = {{ point = {at([0, 0, self.r])}, axis = {along(1)}, radius = {long(self.r)}{more} }}"]
        if self.kind == "box":
            size = "[" + ", ".join(long(s) for s in self.size) + "]"
            return [f"box = {{ centre = {at([0, 0, self.size[2] / 2])}, size = {size}, axes = [{along(0)}, {along(1)}], fillet = {long(self.fillet)} }}"]
        if self.kind == "torus":
            return [f"torus = {{ centre = {at([0, 0, self.tube])}, axis = {along(2)}, radius = {long(self.r)}, tube_radius = {long(self.tube)} }}"]
        if self.kind == "cone":
            return [f"cone = {{ apex = {at([0, 0, 0])}, axis = {along(2)}, half_angle = {number(self.half_angle)}, "
                    f"height = {long(self.size[2])}, fillet = {long(self.fillet)} }}"]
        if self.kind == "surface":
            return [f'surface = "{name}.stl"']
        return self._expression_text(frame)

    def other_text(self, frame):
        """The same body by a distance: a ball, a half space."""
        local = self._local_expressions(frame)
        if self.kind == "ball":
            r = number(self.r)
            return [f'distance = "sqrt({local[0]}^2 + {local[1]}^2 + ({local[2]} - {r})^2) - {r}"']
        return [f'distance = "0 - {local[2]}"']

    def _local_expressions(self, frame):
        return ["(" + " + ".join(f"{number(c)}*({frame.place(k)} - {number(o)})" for k, (c, o) in enumerate(zip(row, self.origin))) + ")"
                for row in self.axes]

    def _expression_text(self, frame):
        if self.kind == "height_field":
            axis, angle = axis_and_angle([frame.direction(v) for v in (self.axes[0], times(-1, self.axes[1]), times(-1, self.axes[2]))])
            return [f'height_field = "-(X^2 + Y^2)*{number(0.5 / (self.r * frame.length))}"',
                    f"rotate = {{ axis = {vector_text(axis)}, angle = {number(angle)} }}", f"translate = {vector_text(frame.point(self.origin))}"]
        local = self._local_expressions(frame)
        a = [self.size[0], self.size[1], self.tube]
        return [f'distance = "({local[0]}/{number(a[0])})^2 + ({local[1]}/{number(a[1])})^2 + (({local[2]} - {number(a[2])})/{number(a[2])})^2 - 1"']


def vector_text(v):
    return "[" + ", ".join(number(c) for c in v) + "]"


def rounded(a, b):
    return max(a, b) if max(a, b) <= 0 or min(a, b) <= 0 else math.hypot(a, b)


def box_distance(d):
    outside = norm([max(c, 0.0) for c in d])
    return outside if outside > 0 else max(d)


def plane(corners):
    """Unit normal and distance from the origin of the plane of three points."""
    n = cross(plus(corners[1], corners[0], -1), plus(corners[2], corners[0], -1))
    n = times(1 / norm(n), n)
    return n, dot(n, corners[0])


def axis_and_angle(columns):
    """Axis and angle of the rotation that takes the axes x, y, z to these three vectors (from the quaternion with the largest part)."""
    m = transposed(columns)
    trace = m[0][0] + m[1][1] + m[2][2]
    q = [1 + trace] + [1 + 2 * m[k][k] - trace for k in range(3)]
    k = max(range(4), key=q.__getitem__)
    skew = [m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]]
    if k == 0:
        w, v = q[0], skew
    else:
        i = k - 1
        w = skew[i]
        v = [q[k] if j == i else m[i][j] + m[j][i] for j in range(3)]
    return v if norm(v) > 0 else [0.0, 0.0, 1.0], 2 * math.atan2(norm(v), w)


def place(body, samples, gap, tolerance):
    """Moves the body along `out` until the least distance of the samples (points and half thicknesses) from it is `gap`. It comes from far away:
    a distance changes by no more than the way, so that it never goes too far."""
    body.origin = plus(body.origin, body.out, 0.3)
    for _ in range(100):
        apart = min(body.distance(X) - half for X, half in samples) - gap
        body.origin = plus(body.origin, body.out, -apart)
        if abs(apart) < tolerance:
            return
