#!/usr/bin/env python3
"""Solves random cases twice, in ways that must agree, and reports every pair that does not.

The second run of a case has another accuracy, another formulation, axes turned by a cyclic permutation, or other units. Two runs
agree if energy and reaction differ by no more than the accuracies that both runs promise. A run may refuse its case (exit code 2) or
say that it has no solution of the accuracy asked for (exit code 3): the text then says so, and the pair counts as told. What must not happen: numbers that differ,
a crash, a hang, an internal error, a reaction that pulls.

    random_cases.py PROGRAM [--count 3000] [--first 0] [--seed 1] [--jobs 1] [--keep DIR]

A case depends on seed and number alone: `--first 123 --count 1 --keep DIR` repeats one and keeps its files. Exit code 1 if a pair is wrong."""

import argparse
import collections
import concurrent.futures
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

LOOSE, FINE = 1e-2, 2e-3
SECONDS = 60  # for one run; `max_seconds` in the case asks for less


def norm(v):
    return math.sqrt(sum(x * x for x in v))


def log_uniform(rng, low, high):
    return math.exp(rng.uniform(math.log(low), math.log(high)))


# ---------------------------------------------------------------------------------------------------------------------------------
# Shells: a domain, a chart as expressions of x and y with lengths as constants, the same chart as a function, and the boundaries.

def plate(rng):
    return {}, ["x", "y", "0"], lambda x, y, c: (x, y, 0.0)


def barrel(rng):
    return ({"R": rng.uniform(0.7, 3)}, ["R*sin(x/R)", "y", "R*cos(x/R) - R"],
            lambda x, y, c: (c["R"] * math.sin(x / c["R"]), y, c["R"] * math.cos(x / c["R"]) - c["R"]))


def dome(rng):
    return ({"R": rng.uniform(1, 3)}, ["x", "y", "sqrt(R^2 - x^2 - y^2) - R"],
            lambda x, y, c: (x, y, math.sqrt(c["R"]**2 - x * x - y * y) - c["R"]))


def quadric(rng):
    return ({"R1": rng.choice([-1, 1]) * rng.uniform(1, 5), "R2": rng.choice([-1, 1]) * rng.uniform(1, 5)},
            ["x", "y", "x^2/(2*R1) + y^2/(2*R2)"],
            lambda x, y, c: (x, y, x * x / (2 * c["R1"]) + y * y / (2 * c["R2"])))


def wave(rng):
    return ({"A": rng.uniform(0.01, 0.04), "P": rng.uniform(0.5, 1.5)}, ["x", "y", "A*sin(2*pi*x/P)"],
            lambda x, y, c: (x, y, c["A"] * math.sin(2 * math.pi * x / c["P"])))


def make_shell(rng):
    chart = rng.choice([plate, barrel, dome, quadric, wave])
    constants, expressions, point = chart(rng)
    kind = rng.choice(["rectangle", "rectangle", "strip", "disk", "annulus", "polygon"])
    if kind == "disk":
        radius = rng.uniform(0.3, 0.6)
        inside = lambda: (lambda t, s: (s * math.cos(t), s * math.sin(t)))(rng.uniform(0, 6.28), radius * rng.uniform(0, 0.8))
        domain, boundaries, size = {"disk": {"radius": radius}}, ["rim"], radius
    elif kind == "annulus":
        outer = rng.uniform(0.4, 0.7)
        inner = outer * rng.uniform(0.2, 0.5)
        inside = lambda: (lambda t, s: (s * math.cos(t), s * math.sin(t)))(rng.uniform(0, 6.28), inner + (outer - inner) * rng.uniform(0.2, 0.8))
        domain, boundaries, size = {"annulus": {"inner": inner, "outer": outer}}, ["inner", "outer"], (outer - inner) / 2
    elif kind == "polygon":
        n = rng.randint(3, 6)
        start = rng.uniform(0, 6)
        corners = [[0.5 * math.cos(start + 2 * math.pi * (k + rng.uniform(-0.15, 0.15)) / n),
                    0.5 * math.sin(start + 2 * math.pi * (k + rng.uniform(-0.15, 0.15)) / n)] for k in range(n)]
        inside = lambda: (rng.uniform(-0.1, 0.1), rng.uniform(-0.1, 0.1))
        domain, boundaries, size = {"polygon": corners}, [f"edge{k + 1}" for k in range(n)], 0.4
    else:
        a = rng.uniform(0.6, 1.2)
        b = rng.uniform(0.1, 0.2) if kind == "strip" else rng.uniform(0.4, 1.0)
        inside = lambda: (a * rng.uniform(-0.35, 0.35), b * rng.uniform(-0.35, 0.35))
        domain = {"rectangle": {"from": [-a / 2, -b / 2], "to": [a / 2, b / 2]}}
        boundaries, size = ["left", "right", "bottom", "top"], (a if kind == "strip" else min(a, b)) / 2
    return {"constants": constants, "chart": expressions, "domain": domain, "boundaries": boundaries, "size": size}, point, inside


def frame(point, constants, x, y):
    """The mid-surface point and the unit normal a_3 at (x, y), by differences."""
    h = 1e-5
    p = point(x, y, constants)
    d1 = [(a - b) / (2 * h) for a, b in zip(point(x + h, y, constants), point(x - h, y, constants))]
    d2 = [(a - b) / (2 * h) for a, b in zip(point(x, y + h, constants), point(x, y - h, constants))]
    n = [d1[1] * d2[2] - d1[2] * d2[1], d1[2] * d2[0] - d1[0] * d2[2], d1[0] * d2[1] - d1[1] * d2[0]]
    length = math.sqrt(sum(v * v for v in n))
    t = math.sqrt(sum(v * v for v in d1))
    return p, [v / length for v in n], [v / t for v in d1]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def edge_points(shell):
    """Points of Omega along its boundaries."""
    (kind, data), = shell["domain"].items()
    circle = lambda r: [(r * math.cos(0.2 * k), r * math.sin(0.2 * k)) for k in range(32)]
    if kind == "disk":
        return circle(data["radius"])
    if kind == "annulus":
        return circle(data["inner"]) + circle(data["outer"])
    if kind == "rectangle":
        (x0, y0), (x1, y1) = data["from"], data["to"]
        corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
    else:
        corners = data
    return [tuple(a + (b - a) * k / 16 for a, b in zip(p, q)) for p, q in zip(corners, corners[1:] + corners[:1]) for k in range(16)]


def distance(body, X):
    """From a body, roughly where it has rounded corners."""
    (kind, data), = body.items()
    minus = lambda a, b: [x - y for x, y in zip(a, b)]
    dot = lambda a, b: sum(x * y for x, y in zip(a, b))
    if kind == "half_space":
        return dot(minus(X, data["point"]), data["normal"])
    if kind == "ball":
        return norm(minus(X, data["centre"])) - data["radius"]
    if kind == "box":
        a, b = data["axes"]
        d = minus(X, data["centre"])
        return max(abs(dot(d, v)) - s / 2 for v, s in zip([a, b, cross(a, b)], data["size"]))
    axis = data["axis"]
    d = minus(X, data.get("point") or data.get("centre") or data["apex"])
    along, across = dot(d, axis), math.sqrt(max(0.0, dot(d, d) - dot(d, axis)**2))
    if kind == "cylinder":
        return across - data["radius"]
    if kind == "torus":
        return math.hypot(across - data["radius"], along) - data["tube_radius"]
    return max(-along, across * math.cos(data["half_angle"]) - along * math.sin(data["half_angle"]))


def clears_edges(obstacle, shell, point, thickness):
    """Whether the body at its last position is away from the edges, which supports may fix."""
    way = obstacle.get("way", [0, 0, 0])
    for x, y in edge_points(shell):
        p, n, _ = frame(point, shell["constants"], x, y)
        for z in (-thickness / 2, 0, thickness / 2):
            if distance(obstacle["body"], [a + z * b - w for a, b, w in zip(p, n, way)]) < 0.05 * thickness:
                return False
    return True


def make_obstacle(rng, name, shell, point, inside, thickness):
    """An obstacle whose nearest point is `gap` away from a face at a random place; it comes nearer by `way` in steps if that is given."""
    x, y = inside()
    p, n, t = frame(point, shell["constants"], x, y)
    side = rng.choice([-1, 1])  # lower or upper face
    out = [side * v for v in n]  # from the shell to the obstacle
    moves = rng.random() < 0.35
    depth = thickness * log_uniform(rng, 0.02, 1.0)
    gap = thickness * rng.uniform(0.05, 1) if moves else -depth if rng.random() < 0.6 else thickness * rng.uniform(0, 0.3)
    top = [a + (thickness / 2 + gap) * b for a, b in zip(p, out)]
    back = lambda distance: [a + distance * b for a, b in zip(top, out)]
    shape = rng.choice(["half_space", "ball", "ball", "small ball", "cylinder", "small cylinder", "box", "thin box", "torus", "cone"])
    if shape == "half_space":
        body = {"half_space": {"point": top, "normal": [-v for v in out]}}
    elif shape in ("ball", "small ball"):
        r = log_uniform(rng, 0.1, 3) if shape == "ball" else thickness * log_uniform(rng, 0.2, 3)
        body = {"ball": {"centre": back(r), "radius": r}}
    elif shape in ("cylinder", "small cylinder"):
        r = log_uniform(rng, 0.1, 3) if shape == "cylinder" else thickness * log_uniform(rng, 0.2, 3)
        body = {"cylinder": {"point": back(r), "axis": t, "radius": r}}
    elif shape in ("box", "thin box"):
        size = [rng.uniform(0.05, 0.4), rng.uniform(0.05, 0.4), rng.uniform(0.1, 0.4) if shape == "box" else thickness * log_uniform(rng, 0.3, 3)]
        body = {"box": {"centre": back(size[2] / 2), "size": size, "axes": [t, cross(n, t)], "fillet": min(size) * rng.choice([0.0, 0.1, 0.4])}}
    elif shape == "torus":
        r = log_uniform(rng, 0.5, 8) * thickness
        body = {"torus": {"centre": back(r), "axis": n, "radius": r * rng.uniform(1.2, 6), "tube_radius": r}}
    else:
        h = rng.uniform(0.1, 0.4)
        body = {"cone": {"apex": back(0), "axis": out, "half_angle": rng.uniform(0.5, 1.4), "height": h, "fillet": h * rng.choice([0.05, 0.2])}}
    obstacle = {"name": name, "body": body, "out": out, "at": [x, y], "shape": shape, "gap": gap / thickness}
    half = {"ball": "radius", "cylinder": "radius", "torus": "tube_radius"}.get(next(iter(body)))
    half = body[next(iter(body))][half] if half else size[2] / 2 if "box" in body else math.inf
    if thickness / 2 + gap + half < 0:  # its middle is beyond the mid-surface: the other face is nearer
        obstacle["out"] = [-v for v in out]
    if moves:
        obstacle["way"] = [-(gap + depth) * v for v in out]
    return obstacle


def make_case(seed, number):
    rng = random.Random(f"{seed}/{number}")
    shell, point, inside = make_shell(rng)
    thickness = shell["size"] * log_uniform(rng, 0.01, 0.15)
    case = {"number": number, "shell": shell, "thickness": thickness, "nu": rng.choice([0.0, 0.3, 0.45])}
    edges = shell["boundaries"]
    chosen = edges if rng.random() < 0.5 else edges[:max(1, len(edges) // 2)]
    case["supports"] = [{"boundary": edge, "fix": rng.choice([["u", "r"], ["u", "r"], ["u"], ["u", "r.t"]]) if k else ["u", "r"]}
                        for k, edge in enumerate(chosen)]
    direction = rng.choice([-1, 1])
    stiffness = thickness**3 / shell["size"]**3  # of a bent plate: the deflection is then about s thicknesses
    case["loads"] = []
    if rng.random() < 0.8:
        s = rng.uniform(0.1, 4) * thickness / shell["size"] * stiffness
        kind = rng.choice(["force", "pressure", "wave"])
        if kind == "pressure":
            case["loads"].append({"pressure": direction * s})
        elif kind == "force":
            case["loads"].append({"force": [0, 0, direction * s]})
        else:
            case["loads"].append({"wave": direction * s, "length": shell["size"]})
    case["obstacles"] = []
    for _ in range(rng.choice([0, 1, 1, 1, 2])):
        for _ in range(20):
            obstacle = make_obstacle(rng, f"body{len(case['obstacles'])}", shell, point, inside, thickness)
            if clears_edges(obstacle, shell, point, thickness):
                case["obstacles"].append(obstacle)
                break
    if not case["loads"] and not case["obstacles"]:
        case["loads"].append({"force": [0, 0, stiffness * thickness]})
    case["parts"] = rng.choice([1, 2, 4]) if any("way" in o for o in case["obstacles"]) else 0
    case["pair"] = rng.choice(["accuracy", "accuracy", "penalised", "mixed", "classical", "turned", "units", "triangles"])
    case["scale"] = rng.choice([1e-6, 1e-3, 1e3, 1e6])
    return case


# ---------------------------------------------------------------------------------------------------------------------------------
# The case file of a case. A variant is: accuracy, formulation, turned or not, factor of lengths, cells.

def number_text(value):
    return repr(float(value))


def toml(value):
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{k} = {toml(v)}" for k, v in value.items()) + " }"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(toml(v) for v in value) + "]"
    if isinstance(value, bool):
        return "true" if value else "false"
    return json.dumps(value) if isinstance(value, str) else number_text(value)


LENGTHS = {"point", "centre", "radius", "tube_radius", "size", "apex", "height", "fillet", "inner", "outer", "from", "to", "polygon"}
DIRECTIONS = {"normal", "axis"}


def scaled(value, s):
    return [scaled(v, s) for v in value] if isinstance(value, list) else s * value


def case_text(case, accuracy, formulation="tangent", turned=False, s=1.0, cells=None):
    turn = (lambda v: [v[2], v[0], v[1]]) if turned else (lambda v: list(v))

    def body(shape):
        result = {}
        for key, value in shape.items():
            if key == "axes":
                value = [turn(v) for v in value]
            elif key in DIRECTIONS:
                value = turn(value)
            elif key in LENGTHS:
                value = scaled(value, s)
                if key in ("point", "centre", "apex"):
                    value = turn(value)
            result[key] = value
        return result

    shell = case["shell"]
    lines = ["[constants]"] + [f"{k} = {number_text(s * v)}" for k, v in shell["constants"].items()]
    lines += ["[shell]", "E = 1.0", f"nu = {case['nu']}", f"thickness = {number_text(s * case['thickness'])}", f'formulation = "{formulation}"']
    domain = {k: scaled(v, s) if isinstance(v, list) else {a: scaled(b, s) for a, b in v.items()} for k, v in shell["domain"].items()}
    lines += ["[geometry]", f"domain = {toml(domain)}", f"chart = {toml(turn(shell['chart']))}"]
    lines += ["[accuracy]", f"energy = {accuracy}", "max_seconds = 20", "max_unknowns = 150000"]
    if case["obstacles"]:
        lines.append(f"reaction = {accuracy}")
    if cells:
        lines += ["[mesh]", f'cells = "{cells}"']
    for support in case["supports"]:
        lines += ["[[support]]", f"boundary = {toml(support['boundary'])}", f"fix = {toml(support['fix'])}"]
    for load in case["loads"]:
        lines.append("[[load]]")
        if "pressure" in load:
            lines.append(f"pressure = {number_text(load['pressure'])}")
        elif "wave" in load:
            amount = f"{number_text(load['wave'])}*cos({number_text(3 / (load['length'] * s))}*x)"
            lines.append(f"force = {toml(turn([0.0, 0.0, amount]))}")
        else:
            lines.append(f"force = {toml(turn(load['force']))}")
    for obstacle in case["obstacles"]:
        (kind, shape), = obstacle["body"].items()
        lines += ["[[obstacle]]", f'name = "{obstacle["name"]}"', f"{kind} = {toml(body(shape))}"]
    if case["parts"]:
        lines += ["[[step]]", f"parts = {case['parts']}"]
        for obstacle in case["obstacles"]:
            if "way" in obstacle:
                lines += ["[[step.move]]", f'obstacle = "{obstacle["name"]}"', f"translate = {toml(turn(scaled(obstacle['way'], s)))}"]
    return "\n".join(lines) + "\n"


def variants(case):
    """The two texts of a pair, the accuracies that they promise, and the factor of lengths of the second."""
    pair, s = case["pair"], 1.0
    first, second, promised = case_text(case, LOOSE), None, (LOOSE, LOOSE)
    if pair == "accuracy":
        second, promised = case_text(case, FINE), (LOOSE, FINE)
    elif pair == "turned":
        second = case_text(case, LOOSE, turned=True)
    elif pair == "units":
        s = case["scale"]
        second = case_text(case, LOOSE, s=s)
    elif pair == "triangles":
        second = case_text(case, LOOSE, cells="triangle")
    else:
        second = case_text(case, LOOSE, formulation=pair)
    return [first, second], promised, s


# ---------------------------------------------------------------------------------------------------------------------------------
# Running and judging.

class Run:
    def __init__(self, program, text, folder):
        folder.mkdir(parents=True)
        (folder / "case.toml").write_text(text)
        try:
            done = subprocess.run([program, "run", "case.toml", "--output", "out", "--no-report"], cwd=folder, timeout=SECONDS,
                                  capture_output=True, text=True, stdin=subprocess.DEVNULL)
            self.code, self.text = done.returncode, done.stdout + done.stderr
        except subprocess.TimeoutExpired:
            self.code, self.text = "hang", ""
        (folder / "output.txt").write_text(self.text)
        file = folder / "out" / "results.json"
        self.results = json.loads(file.read_text()) if file.exists() else None

    def word(self):
        return self.results["status"] if self.results else f"exit {self.code}"

    def is_solved(self):
        return self.code == 0 and self.results is not None

    def is_told(self):
        return self.code in (2, 3)


def pulling(case, results):
    """Obstacles whose force on the shell points towards them. This is impossible for a nearly flat shell."""
    found = []
    for obstacle, result in zip(case["obstacles"], results["obstacles"]):
        force = result["reaction"]["force"]
        towards = sum(a * b for a, b in zip(force, obstacle["out"]))
        if towards > 0.2 * norm(force) and norm(force) > 0:
            found.append(f"{obstacle['name']} ({obstacle['shape']}) pulls")
    return found


def difference(case, runs, promised, s):
    """Differences that are larger than promised, in words."""
    a, b = (run.results for run in runs)
    found = []
    pairs = [("energy", a["energy"], b["energy"] / s**3)]
    if case["obstacles"]:
        scale = max(sum(norm(o["reaction"]["force"]) for o in a["obstacles"]), 0.0)
        one, two = norm(a["reaction"]["force"]), norm(b["reaction"]["force"]) / s**2
        if scale > 1.5 * one:  # a sum that cancels: each obstacle's own force
            pairs += [(f"force of {o['name']}", norm(o["reaction"]["force"]), norm(q["reaction"]["force"]) / s**2)
                      for o, q in zip(a["obstacles"], b["obstacles"])]
        else:
            pairs.append(("reaction", one, two))
    for name, x, y in pairs:
        allowed = sum(promised) * max(abs(x), abs(y))
        if not abs(x - y) <= allowed:
            found.append(f"{name} {x:.6g} and {y:.6g}, {abs(x - y) / max(abs(x), abs(y)):.2g} apart, {sum(promised):.2g} promised")
    return found


def judge(case, runs, promised, s):
    """A word and its explanation."""
    for run in runs:
        if run.code == "hang":
            return "hang", f"longer than {SECONDS} s"
        if run.code not in (0, 2, 3):
            return "crash", f"exit code {run.code}: {run.text[-200:]}"
        if run.code == 0 and run.results is None:
            return "crash", "no results.json"
    if case["pair"] != "turned":
        for run in runs:
            if run.is_solved() and (found := pulling(case, run.results)):
                return "pulls", "; ".join(found)
    if not all(run.is_solved() for run in runs):
        both = all(run.is_told() for run in runs)
        return ("told" if both else "told once"), " / ".join(run.word() for run in runs)
    found = difference(case, runs, promised, s)
    return ("differs", "; ".join(found)) if found else ("agrees", "")


WRONG = {"hang", "crash", "pulls", "differs"}


def pair_of_runs(program, seed, number, keep):
    case = make_case(seed, number)
    texts, promised, s = variants(case)
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(keep or scratch) / str(number)
        runs = [Run(program, text, folder / str(k)) for k, text in enumerate(texts)]
        word, detail = judge(case, runs, promised, s)
    shapes = "+".join(o["shape"] for o in case["obstacles"]) or "none"
    seconds = [sum(l["seconds"]["total"] for l in run.results["levels"]) if run.results else 0 for run in runs]
    return number, case["pair"], shapes, word, detail, seconds


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--count", type=int, default=3000)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--keep", help="a new folder in which the files of all runs stay")
    arguments = parser.parse_args()
    program = str(pathlib.Path(arguments.program).resolve())
    counts, by_pair = collections.Counter(), collections.Counter()
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        numbers = range(arguments.first, arguments.first + arguments.count)
        for number, pair, shapes, word, detail, seconds in pool.map(
                lambda k: pair_of_runs(program, arguments.seed, k, arguments.keep), numbers):
            counts[word] += 1
            by_pair[pair, word] += 1
            if word != "agrees" or max(seconds) > 10:
                print(f"{number} {pair} {shapes}: {word} {detail} ({seconds[0]:.1f} and {seconds[1]:.1f} s)", flush=True)
    for (pair, word), count in sorted(by_pair.items()):
        print(f"{pair:12} {word:10} {count}")
    print("total: " + ", ".join(f"{count} {word}" for word, count in sorted(counts.items())))
    return 1 if any(counts[word] for word in WRONG) else 0


if __name__ == "__main__":
    sys.exit(main())
