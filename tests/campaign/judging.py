"""Compares two outcomes of the same case: numbers of both in the case's own frame, with scales for numbers that may vanish."""

from frame import norm, plus, times
from balances import text

# Equal to rounding: solutions of one discrete problem have residuals below 1e-9. Other paths end where iterations stop: nodes may miss an
# obstacle by a millionth of the thickness or of the largest displacement, and finite rotations balance to about as much.
SAME, ITERATED = 1e-6, 1e-4


def numbers(outcome):
    """Name -> (value in the case's own frame, kind). Kinds: energy, force, length, angle, pure."""
    case, r = outcome.case, outcome.results
    frame = case.frame
    force = lambda v: frame.back(v, force=1)
    found = {"energy": (frame.scalar(r["energy"], -1, -1), "energy"), "work of the loads": (frame.scalar(r["load_work"], -1, -1), "energy"),
             "force of the loads": (force(r["loads"]["force"]), "force"), "force of the supports": (force(r["support_reaction"]["force"]), "force")}
    for name, _ in case.bodies:  # the two faces of an obstacle are one
        total = [sum(c) for c in zip(*(force(o["reaction"]["force"]) for o in r["obstacles"] if o["name"].startswith(name)))]
        found[f"force of {name}"] = (total, "force")
    found["u at the probe"] = (frame.back(r["probes"]["p"]["u"], length=1), "length")
    found["r at the probe"] = (frame.back(r["probes"]["p"]["r"]), "angle")
    for body in r["rigid_bodies"]:
        found["u of the body"] = (frame.back(body["displacement"], length=1), "length")
    if case.row["control"] == "control" and r["history"]:
        found["load factor"] = (r["history"][-1]["load_factor"], "pure")
    for mode in r.get("modes", []):
        if mode["load_factor"] is not None:
            found[mode["name"]] = (mode["load_factor"], "pure")
    return found


def whole_of_half(found):
    """The numbers of the whole shell from those of the half at Y > 0. Its modes are only the symmetric ones of the whole."""
    result = {}
    for name, (value, kind) in found.items():
        if name.startswith("buckling"):
            continue
        if kind == "energy":
            value = 2 * value
        elif kind == "force":
            value = [2 * value[0], 0.0, 2 * value[2]]
        result[name] = (value, kind)
    return result


def scales(outcome):
    case, r = outcome.case, outcome.results
    found = numbers(outcome)
    twice = 2.0 if case.shell.is_half else 1.0
    forces = [case.frame.back(v["force"], force=1) for v in [r["loads"], r["reaction"], r["support_reaction"], *(s["reaction"] for s in r["supports"]),
                                                             *(o["reaction"] for o in r["obstacles"]), *(b["reaction"] for b in r["rigid_bodies"])]]
    f = twice * max(norm(v) for v in forces)
    u = case.frame.scalar(r["size"]["max_displacement"], length=-1)
    f = max(f, 1e-3 * twice * abs(found["energy"][0]) / u) if u else f  # initial strains alone: all forces are rounding
    e = max(abs(found["energy"][0]) * twice, 1e-6 * f * u)
    return {"energy": max(e, twice * abs(found["work of the loads"][0])), "force": f, "length": u, "angle": max(r["size"]["max_rotation"], u), "pure": None}


def errors(outcome):
    """Estimated errors of energy and reaction, relative to their scales; None if one is not known."""
    goals = {g["name"]: g for g in (outcome.results.get("estimates") or {}).get("goals", [])}
    result = {}
    for name in ("energy", "reaction"):
        goal = goals.get(name)
        if goal is None or goal["error"] is None:
            result[name] = None
        else:
            geometry = goal["geometry_error"] or 0.0
            result[name] = (abs(goal["error"]) + abs(goal["contact_edge"] or 0.0) + geometry) / max(abs(goal["value"]), 1e-300)
    return result


def compare(first, second, kind):
    """What differs, in words, and the largest relative difference."""
    if kind == "estimated":
        return compare_estimates(first, second)
    tolerance = SAME if kind == "same" else 1e-2 if kind == "limit" else ITERATED
    a, b = numbers(first), numbers(second)
    if first.case.shell.is_half != second.case.shell.is_half:
        a, b = (whole_of_half(n) if o.case.shell.is_half else n for n, o in ((a, first), (b, second)))
    scale = {k: v and max(v, w) for (k, v), w in zip(scales(first).items(), scales(second).values())}
    found, largest = [], 0.0
    for name, (value, sort) in a.items():
        if name not in b or (name.startswith("force of the supports") and first.case.shell.is_half != second.case.shell.is_half):
            continue
        apart = norm(plus(value, b[name][0], -1)) if isinstance(value, list) else abs(value - b[name][0])
        size = max(abs(value), abs(b[name][0])) if sort == "pure" else scale[sort]
        relative = apart / size if size else (0.0 if apart == 0 else 1.0)
        largest = max(largest, relative)
        if not relative <= tolerance:
            found.append(f"{name}: {text(value)} and {text(b[name][0])}, {relative:.2g} apart")
    return found, largest


def compare_estimates(first, second):
    """Energy and force of obstacles, within three times the errors that both runs estimate and the accuracies that they promise."""
    found, largest = [], 0.0
    a, b = numbers(first), numbers(second)
    one, two = errors(first), errors(second)
    scale = {k: max(v, w) if v is not None else None for (k, v), w in zip(scales(first).items(), scales(second).values())}
    names = [("energy", "energy")] + [(n, "reaction") for n in a if n.startswith("force of ") and n.split()[-1] in ("body", "other")]
    for name, goal in names:
        if one[goal] is None or two[goal] is None or max(one[goal], two[goal]) > 0.3:
            continue
        x, y = a[name][0], b[name][0]
        apart = norm(plus(x, y, -1)) if isinstance(x, list) else abs(x - y)
        size = max(norm(x), norm(y)) if isinstance(x, list) else max(abs(x), abs(y))
        allowed = 3 * (one[goal] + two[goal]) * size + 1e-4 * scale[a[name][1]]
        largest = max(largest, apart / allowed if allowed else 0.0)
        if not apart <= allowed:
            found.append(f"{name}: {text(x)} and {text(y)}, {apart / size:.2g} apart, estimated {one[goal]:.2g} and {two[goal]:.2g}")
    return found, largest
