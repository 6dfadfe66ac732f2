"""What the files of one run must satisfy by themselves: sums, work, signs of contact forces, distances to the obstacles. No second run is needed."""

import math

from bodies import Body
from cases import E
from features import RELAXED
from frame import dot, norm, plus, times

# Gauss's rule of six points on [-1, 1].
GAUSS = [(sign * x, w) for x, w in ((0.9324695142031521, 0.1713244923791704), (0.6612093864662645, 0.3607615730481386), (0.2386191860831969, 0.467913934572691))
         for sign in (-1, 1)]


def area_integral(shell, function):
    """The integral over the shell of function(patch, point, unit normal), a vector."""
    total = [0.0, 0.0, 0.0]
    for patch in shell.patches:
        rows = 4 if shell.is_tube else 1
        hx, hy = (patch.x[1] - patch.x[0]) / 2, (patch.y[1] - patch.y[0]) / (2 * rows)
        for k in range(rows):
            for a, wa in GAUSS:
                for b, wb in GAUSS:
                    x, y = patch.x[0] + hx * (1 + a), patch.y[0] + hy * (1 + b + 2 * k)
                    one, two = patch.tangents(x, y)
                    n = [one[1] * two[2] - one[2] * two[1], one[2] * two[0] - one[0] * two[2], one[0] * two[1] - one[1] * two[0]]
                    value = function(patch, patch.point(x, y), times(1 / norm(n), n))
                    total = plus(total, value, norm(n) * wa * wb * hx * hy)
    return total


def load_force(case):
    """The resultant of the loads on the surface, in the case's own frame; None where it is not known beforehand."""
    kind, q = case.row["load"], case.area_force()
    direction = times(q, case.load_direction())
    if kind == "force":
        return area_integral(case.shell, lambda patch, X, n: direction)
    if kind == "pressure":
        if len(case.shell.patches) > 2:  # the normals of flanges and webs depend on the program's choice
            return None
        return area_integral(case.shell, lambda patch, X, n: times(direction[2] * (1 + 0.5 * X[0]), n))
    if kind == "weight":
        return area_integral(case.shell, lambda patch, X, n: times(case.thickness_at(patch, X) / case.e, direction))
    if kind == "strain" and case.row["formulation"] == "classical":  # covariant components strain a little under a translation
        return None
    return [0.0, 0.0, 0.0] if kind in ("none", "couple", "strain") else None


class Checks:
    """Collects what is wrong with an outcome, in words."""

    def __init__(self, outcome):
        self.outcome, self.case, self.results = outcome, outcome.case, outcome.results
        self.found = []
        frame, r = self.case.frame, self.results
        self.force = lambda v: frame.back(v, force=1)
        self.scale = max(norm(self.force(v["force"])) for v in [r["loads"], r["reaction"], r["support_reaction"],
                                                                *(s["reaction"] for s in r["supports"]), *(o["reaction"] for o in r["obstacles"])])
        # Of forces that vanish, as those of initial strains on a shell that is free to follow: a part of what is summed.
        self.rounding = max(1e-17 * E * self.case.e, 1e-9 * norm(self.force([r["loads"]["sum_of_norms"], 0.0, 0.0])))

    def near(self, what, a, b, tolerance, scale):
        apart = norm(plus(a, b, -1)) if isinstance(a, list) else abs(a - b)
        if not apart <= tolerance * scale + (self.rounding if isinstance(a, list) else 0.0):
            self.found.append(f"{what}: {text(a)} and {text(b)}, {apart / scale if scale else math.inf:.2g} apart")

    def all(self):
        self.sums()
        self.loads()
        self.work()
        for k, (name, body) in enumerate(self.case.bodies):
            self.contact(k, name, body)
        return self.found

    def sums(self):
        r, zero, s = self.results, [0.0, 0.0, 0.0], self.scale
        total = lambda entries: [sum(c) for c in zip(zero, *(self.force(e) for e in entries))]
        sides = [r[k] for k in ("loads", "reaction", "support_reaction")]
        loose, size = 1e-5, s
        if self.case.row["formulation"] == "classical":  # covariant components hold translations as well as the mesh does
            loose, size = 0.05, self.case.frame.scalar(sum(side["sum_of_norms"] for side in sides), -1)
        self.near("forces balance", total(side["force"] for side in sides), zero, loose, size)
        self.near("obstacles add up", total(o["reaction"]["force"] for o in r["obstacles"]), self.force(r["reaction"]["force"]), 1e-9, s)
        for o in r["obstacles"]:
            self.near("zones add up", total(z["reaction"]["force"] for z in o["zones"]), self.force(o["reaction"]["force"]), 1e-9, s)
        if self.case.bodies:
            rows = self.outcome.table("contact-forces.csv")
            self.near("nodal forces add up", total([row["F_X"], row["F_Y"], row["F_Z"]] for row in rows), self.force(r["reaction"]["force"]), 1e-8, s)
        self.near("parts of the energy", sum(r["energy_parts"].values()), r["energy"], 1e-6, abs(r["energy"]) + 1e-300)

    def loads(self):
        expected, case = load_force(self.case), self.case
        factor = self.results["history"][-1]["load_factor"] if self.results["history"] else 1.0
        exact = case.shell.kind == "plate" or case.row["source"] in ("rectangle", "plane mesh")
        if expected is None or case.row["rigid"] != "none" or (case.row["load"] == "edge"):
            return
        if not exact and case.row["source"] not in ("order 3", "order 4"):
            return
        tolerance = 1e-5 if exact and case.row["imperfection"] == "none" else 2e-3
        self.near("sum of the loads", self.force(self.results["loads"]["force"]), times(factor, expected), tolerance, norm(expected) * abs(factor) + 1e-9 * self.scale)

    def work(self):
        """Clapeyron: a linear shell without contact and prescribed values stores half of the work of its loads."""
        row, r = self.case.row, self.results
        if row["model"] == "small" and not self.case.bodies and row["support"] != "prescribed" and row["load"] != "strain":
            # The rest is stored in the penalty or the stabilisation of r . a3.
            tolerance = 1e-2 if row["formulation"] in RELAXED else 1e-4
            self.near("half of the work", r["energy"], r["load_work"] / 2, tolerance, abs(r["energy"]) + 1e-300)

    def contact(self, k, name, body):
        results = [o for o in self.results["obstacles"] if o["name"].startswith(name)]
        if self.case.row["motion"] == "turn" and name == "body":
            return
        frame = self.case.frame
        moved = frame.back(results[0]["translation"], length=1)
        at = Body.__new__(Body)
        at.__dict__ = dict(body.__dict__, origin=plus(body.origin, moved))
        total = [sum(c) for c in zip(*(self.force(o["reaction"]["force"]) for o in results))]
        size = norm(total)
        if body.kind not in ("torus", "surface", "distance", "height_field") and size > 1e-6 * self.scale:
            if dot(total, body.out) > 0.05 * size:
                self.found.append(f"{name} ({body.kind}) pulls: force {text(total)} along {text(body.out)}")
        if name == "body" and self.case.row["pressed"] == "force" and self.case.row["face"] != "both":
            wanted = 0.1 * (0.5 if self.case.shell.is_half else 1.0) * self.case.area_force()
            self.near("pressing force", dot(total, body.out), -wanted, 1e-4, max(wanted, 1e-9 * self.scale))
        self.depth(at, name)

    def depth(self, body, name):
        """No face point of the line is deeper in the obstacle than the results say."""
        if body.kind in ("height_field", "distance", "surface", "cone"):
            return
        frame, contact = self.case.frame, self.results["contact"]
        said = frame.scalar(max(0.0, contact["max_penetration_between_nodes"] or 0.0, -(contact["min_gap"] or 0.0)), length=-1)
        worst = 0.0
        for row in self.outcome.table("line-l.csv"):
            for face in ("lower", "upper"):
                X = [row[f"{face} face {c}"] for c in "XYZ"]
                if None not in X:
                    worst = min(worst, body.distance(frame.back(X, length=1)))
        allowed = 1.5 * said + 0.02 * self.case.amount + 1e-3 * self.case.e
        if -worst > allowed:
            self.found.append(f"a face is {-worst / self.case.e:.3g} e deep in {name} ({body.kind}), the results say {said / self.case.e:.3g} e")


def text(value):
    return "(" + ", ".join(f"{v:.6g}" for v in value) + ")" if isinstance(value, list) else f"{value:.8g}"
