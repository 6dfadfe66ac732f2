"""A frame in which a case is written: a rotation of space and the units of length and force. Vectors are lists of three numbers;
numbers are lengths 1, forces 1 in the case's own frame. The same case in two frames is the same mechanics."""

import math

UNITS = {"SI": (1.0, 1.0), "mm": (1e3, 1.0), "tiny": (1e-6, 1e-3), "huge": (1e6, 1e4)}


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def norm(v):
    return math.sqrt(dot(v, v))


def plus(a, b, factor=1.0):
    return [x + factor * y for x, y in zip(a, b)]


def times(factor, v):
    return [factor * x for x in v]


def unit(v):
    return times(1 / norm(v), v)


def rotation(axis, angle):
    """The matrix of the rotation about an axis."""
    n, c, s = unit(axis), math.cos(angle), math.sin(angle)
    crossed = [[0, -n[2], n[1]], [n[2], 0, -n[0]], [-n[1], n[0], 0]]
    return [[c * (i == j) + (1 - c) * n[i] * n[j] + s * crossed[i][j] for j in range(3)] for i in range(3)]


def apply(matrix, v):
    return [dot(row, v) for row in matrix]


def transposed(matrix):
    return [list(column) for column in zip(*matrix)]


TURNS = {"no": ([0, 0, 1], 0.0), "cyclic": ([1, 1, 1], 2 * math.pi / 3), "general": ([0.3, -0.7, 0.5], 0.9)}


class Frame:
    def __init__(self, turned="no", units="SI"):
        self.axis, self.angle = TURNS[turned]
        self.turned = turned
        matrix = rotation(self.axis, self.angle)
        self.matrix = [[float(round(x)) for x in row] for row in matrix] if turned != "general" else matrix
        self.length, self.force = UNITS[units]
        self.stress = self.force / self.length**2

    def direction(self, v):
        return apply(self.matrix, v)

    def point(self, v):
        return times(self.length, self.direction(v))

    def vector(self, v, force=0, length=0):
        """A vector with the dimension force^force length^length."""
        return times(self.force**force * self.length**length, self.direction(v))

    def back(self, v, force=0, length=0):
        """The opposite of vector()."""
        return apply(transposed(self.matrix), times(self.force**-force * self.length**-length, v))

    def scalar(self, value, force=0, length=0):
        return value * self.force**force * self.length**length

    def place(self, k):
        """The coordinate k of the case's own frame as an expression of X, Y, Z."""
        column = [row[k] / self.length for row in self.matrix]
        return "(" + " + ".join(f"{number(c)}*{name}" for c, name in zip(column, "XYZ") if c) + ")"

    def component(self, kind, k):
        """The name u.x, u.y or u.z (r, theta) of a component of the case's own frame; not in general frames."""
        return kind + "." + "xyz"[max(range(3), key=lambda j: abs(self.matrix[j][k]))]


def number(value):
    return repr(float(value))
