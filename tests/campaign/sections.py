"""The sections of a case file, each a function of a case that returns its lines."""

from bodies import vector_text
from cases import E
from features import IN_SPACE, LAYERED
from frame import norm, number, plus, rotation, times


def quoted(names):
    return "[" + ", ".join(f'"{n}"' for n in names) + "]"


def head(case):
    lines = [f'title = "{case.key}"']
    if case.row["units"] == "mm":
        lines += ["[units]", 'length = "mm"', 'force = "N"']
    return lines


def materials(case):
    kind, frame = case.extra.get("material", case.row["material"]), case.frame
    if kind in ("isotropic", "lame"):
        return []
    stress = lambda v: number(v * frame.stress)
    axis = f"direction = {vector_text(frame.direction([1, 0, 0.7] if case.shell.is_tube else [0, 1, 0]))}"
    if kind == "isotropic layers":
        return ["[[material]]", 'name = "iso"', f"E = {stress(E)}", "nu = 0.3", "[[material]]", 'name = "m"', axis,
                'layers = [{ material = "iso", thickness = 1 }, { material = "iso", thickness = 2, angle = 20 }, { material = "iso", thickness = 1 }]']
    lines = ["[[material]]", f'name = "{"m" if kind == "orthotropic" else "ply"}"', f"E1 = {stress(2 * E)}", f"E2 = {stress(0.5 * E)}", "nu12 = 0.3",
             f"G12 = {stress(0.3 * E)}", f"G13 = {stress(0.3 * E)}", f"G23 = {stress(0.2 * E)}", axis]
    if kind == "orthotropic":
        return lines
    strain = 2.0 * case.e * case.amount if case.row["load"] == "strain" else 0.0
    tension = lambda angle, factor: f"angle = {angle}, strain = {vector_text([factor * strain, 0.5 * strain, 0])}"
    other = 90 if case.is_symmetric else 40
    layers = [(0, 1), (90, 1), (0, 1)] if kind == "cross-ply" else [(0, 1), (other, -1)]
    text = ", ".join(f'{{ material = "ply", thickness = 1, {tension(angle, factor)} }}' for angle, factor in layers)
    return lines + ["[[material]]", 'name = "m"', axis, f"layers = [{text}]"]


def _moduli(case, factor=1.0):
    kind, s = case.extra.get("material", case.row["material"]), case.frame.stress * factor
    if kind == "isotropic":
        return [f"E = {number(E * s)}", "nu = 0.3"]
    if kind == "lame":
        return [f"lambda = {number(E * 0.3 / (1.3 * 0.4) * s)}", f"mu = {number(E / 2.6 * s)}"]
    return ['material = "m"']


def _thickness(case, factor=1.0):
    long = number(case.e * factor * case.frame.length)
    return f'thickness = "{long}*(1 + 0.3*{case.frame.place(0)})"' if case.row["thickness"] == "tapered" else f"thickness = {long}"


def shell(case):
    row = case.row
    lines = ["[shell]", *_moduli(case), _thickness(case)]
    if case.extra.get("material") == "isotropic layers":
        lines.append("shear_correction = 1")  # that of one layer; several would have 5/6
    if row["load"] == "weight" or row["modes"] == "vibration":
        lines.append("density = 1.0")
    if row["formulation"] != "tangent":
        lines.append(f'formulation = "{row["formulation"]}"')
    if row["model"] == "finite":
        lines.append('rotations = "finite"')
    return lines


def regions(case):
    if case.row["region"] == "one":
        return []
    return ["[[region]]", 'name = "r_east"', _thickness(case, 1.4 if case.row["region"] == "two" else 1.0)]


def geometry(case):
    source, sh, frame = case.row["source"], case.shell, case.frame
    if source in IN_SPACE:
        name = {"inp": "shell.inp", "facets": "shell.stl"}.get(source, "shell.msh")
        lines = ["[geometry]", f'file = "{name}"']
        if not sh.is_tube or sh.is_half:
            lines.append(f"upper = {vector_text(frame.direction([0, 0, 1]))}")
        if source == "facets":
            lines.append(f"size = {number(case.facet_size)}")
        if source in ("order 1", "facets") and sh.kind != "plate":
            lines.append("smooth = 40")
        return lines
    lines = ["[geometry]"]
    if source == "plane mesh":
        charts = {case.region(p.name): _chart(case, p) for p in sh.patches}
        chart = next(iter(charts.values()))
        if any(c != chart for c in charts.values()):
            chart = "{ " + ", ".join(f"{name} = {c}" for name, c in charts.items()) + " }"
        return lines + ['domain = { mesh = "plane.msh" }', f"chart = {chart}"]
    more = f', breaks = [0], regions = {quoted(["r_west", "r_east"])}' if case.pieces else ""
    cells = f"[{2 * sh.cells[0]}, {sh.cells[1]}]"
    return lines + [f"domain = {{ rectangle = {{ from = [-0.5, {number(sh.low)}], to = [0.5, {number(sh.half_width)}], cells = {cells}{more} }} }}",
                    f"chart = {_chart(case, sh.patches[0])}"]


def _chart(case, patch):
    parts = [e.replace("x", f"(x - {number(patch.shift)})") if patch.shift else e for e in patch.expressions]
    rows = [" + ".join(f"{number(c * case.frame.length)}*({part})" for c, part in zip(row, parts) if c) for row in case.frame.matrix]
    return quoted(rows)


def imperfection(case):
    """In the parameters of a chart the shape has the period 1, which is the distance of its pieces."""
    kind = case.row["imperfection"]
    if kind == "none":
        return []
    x = case.frame.place(0) if case.row["source"] in IN_SPACE else "x"
    long = case.frame.length * 0.2 * case.amount
    shape = f"cos(6.283185307179586*{x})"
    if kind == "normal":
        return ["[[imperfection]]", f'normal = "{number(long)}*{shape}"']
    return ["[[imperfection]]", "displacement = " + quoted(f"{number(c * long)}*{shape}" for c in case.frame.direction([0, 0, 1]))]


def joins(case):
    if case.row["source"] not in ("rectangle", "plane mesh"):
        return []
    lines = []
    add = lambda a, b: lines.extend(["[[join]]", f"boundaries = {quoted([a, b])}"])
    if case.row["join"] == "pieces":
        add("west_right", "east_left")
    if case.row["fold"] == "fold":
        add("east_right", "flange_left")
    if case.shell.is_tube and not case.shell.is_half:
        if case.row["source"] == "rectangle":
            add("bottom", "top")
        else:
            for patch in case.shell.patches:
                add(f"{patch.name}_bottom", f"{patch.name}_top")
    return lines


def mesh(case):
    row, extra = case.row, case.extra
    degree = extra.get("degree", row["degree"])
    refinements = extra.get("refinements", 1 if row["degree"] <= 2 else 0)
    if row["mesh"] == "accuracy":
        wanted = extra.get("accuracy", 1e-2)
        lines = ["[accuracy]", f"energy = {wanted}", "max_unknowns = 20000"]
        if row["obstacle"] != "none":
            lines.append(f"reaction = {wanted}")
        layers = [] if row["cells"] == "triangle" or case.random("layers").random() < 0.3 else ["layers = false"]
        return lines + ["[mesh]", f"degree = {degree}", *_shape_of_cells(row), *layers]
    return ["[mesh]", f"degree = {degree}", f"refinements = {refinements}", *_shape_of_cells(row)]


def _shape_of_cells(row):
    """Files have their own cells, but facets are remeshed."""
    return [f'cells = "{row["cells"]}"'] if row["source"] in ("rectangle", "facets") or row["cells"] == "triangle" else []


def _support(case, name, fix, values=None):
    if case.extra.get("supports") == "components":
        split = {"u": ["u.n", "u.t", "u.a3"], "r": ["r.n", "r.t"]}
        fix = fix if values else [c for f in fix for c in split.get(f, [f])]
    lines = ["[[support]]", f"boundary = {quoted(case.boundary(name))}", f"fix = {quoted(fix)}"]
    return lines + ([f"values = {{ u = {values} }}"] if values else [])


def supports(case):
    row, lines = case.row, []
    kind = row["support"]
    hinge = ["u"] if row["formulation"] == "tangent" else ["u", "r.a3"]  # others see the gradient of r . a3 only
    if kind == "points":
        points = [([-0.5, -0.3], "xyz"), ([-0.5, 0.3], "xz"), ([0.0, -0.3], "z")]
        for place, components in points:
            X = case.shell.base_point(*place)
            at = vector_text(case.frame.point(X)) if row["source"] in IN_SPACE else f"[{number(place[0])}, {number(place[1])}]"
            lines += ["[[support]]", f"point = {at}", f"fix = {quoted([case.frame.component('u', 'xyz'.index(c)) for c in components])}"]
    else:
        lines += _support(case, "start", hinge if kind == "hinged" else ["u", "r"])
    if row["rigid"] == "none":
        if case.has_both_ends:
            lines += _support(case, "end", hinge if kind == "hinged" else ["u", "r"])
        if kind == "prescribed":
            lines += _support(case, "end", ["u"], vector_text(case.frame.vector(_prescribed(case), length=1)))
    if case.shell.is_half:
        lines += _support(case, "bottom", ["symmetry"])
        if case.shell.is_tube:
            lines += _support(case, "top", ["symmetry"])
    return lines


def _prescribed(case):
    rng = case.random("prescribed")
    d = case.amount
    return [0.02 * d * rng.uniform(-1, 1), 0.0 if case.is_symmetric else 0.1 * d * rng.uniform(-1, 1), case.side * d * rng.uniform(0.3, 1)]


def end_reference(case):
    patch = next((p for p in case.shell.patches if p.name == "flange"), case.shell.patches[1])
    X = patch.point(patch.x[1], 0.0)
    return [X[0], 0.0, X[2] - (case.shell.radius if case.shell.is_tube else 0.0)]


def rigid_bodies(case):
    row, frame = case.row, case.frame
    if row["rigid"] == "none":
        return []
    fix, values, half = [], "", 0.5 if case.shell.is_half else 1.0
    if row["support"] == "prescribed":
        fix, values = ["u"], f"values = {{ u = {vector_text(frame.vector(_prescribed(case), length=1))} }}"
    elif row["support"] == "hinged":
        fix = ["u"]
    if row["rigid"] == "hinge":
        fix = fix + ["theta"]
    elif case.shell.is_half:
        fix = fix + [frame.component("theta", 0), frame.component("theta", 2)]
    if case.shell.is_half and "u" not in fix:
        fix = fix + [frame.component("u", 1)]
    lines = ["[[rigid_body]]", 'name = "end"', f"boundary = {quoted(case.boundary('end'))}", f"reference = {vector_text(frame.point(end_reference(case)))}"]
    lines += [f"fix = {quoted(fix)}"] if fix else []
    lines += [values] if values else []
    lines += ["rotations = false"] if row["rigid"] == "hinge" else []
    if row["load"] == "edge" and "u" not in fix:
        lines.append(f"force = {vector_text(frame.vector(times(half * 0.2 * case.area_force(), case.load_direction()), force=1))}")
        if row["rigid"] != "hinge":
            lines.append(f"moment = {vector_text(frame.vector([0, half * 0.05 * case.area_force(), 0], force=1, length=1))}")
    return lines


def loads(case):
    kind, frame, q = case.row["load"], case.frame, case.area_force()
    direction = times(q, case.load_direction())
    if kind == "force":
        return ["[[load]]", f"force = {vector_text(frame.vector(direction, force=1, length=-2))}"]
    if kind in ("pressure", "follower"):
        law = f'"{number(frame.scalar(direction[2], 1, -2))}*(1 + 0.5*{frame.place(0)})"'
        return ["[[load]]", f"pressure = {law}"] + (["follows = true"] if kind == "follower" else [])
    if kind == "couple":
        # It does work on r, which lies in the plane of symmetry.
        return ["[[load]]", f"couple = {vector_text(frame.vector([0.3 * direction[2], 0, 0], force=1, length=-1))}"]
    if kind == "weight":
        g = frame.vector(times(1 / case.e, direction), force=1, length=-3)
        return ["[gravity]", f"acceleration = {vector_text(g)}"]
    if kind == "edge" and case.row["rigid"] == "none":
        line = vector_text(frame.vector(times(0.3, direction), force=1, length=-1))
        free = not case.has_both_ends and case.row["support"] != "prescribed"
        name = "end" if free else "top" if not case.shell.is_tube else None
        names = [name] if free or case.shell.is_half or not case.is_symmetric else ["bottom", "top"]
        return [line_ for n in names if n for line_ in ("[[load]]", f"boundary = {quoted(case.boundary(n))}", f"force = {line}")]
    return []


def obstacles(case):
    lines = []
    for name, body in case.bodies:
        lines += ["[[obstacle]]", f'name = "{name}"', *(body.other_text(case.frame) if name == "body" and "other_shape" in case.extra else body.text(case.frame, name))]
        case.files |= body.files(case.frame, name)
        if name == "body" and case.row["pressed"] == "force" and "fixed_at" not in case.extra:
            lines.append(f"force = {vector_text(pressing_force(case))}")
        face = case.extra.get("face", case.row["face"])
        if face == "named" and not (name == "other" and case.row["second"] == "far"):
            lines.append(f'face = "{case.face_of(body)}"')
        elif face == "both" and name == "body":
            lines.append('face = "both"')
    return lines


def pressing_force(case):
    body = case.bodies[0][1]
    half = 0.5 if case.shell.is_half else 1.0
    return case.frame.vector(times(-0.1 * half * case.area_force(), body.out), force=1)


def steps(case):
    row = case.row
    kind = case.extra.get("steps", row["steps"])
    if kind == "none":
        return []
    parts = {"one": "1", "three": "3", "auto": '"auto"', "back": "2", "six": "6"}[kind]
    lines = ["[[step]]", f"parts = {parts}"]
    if "factor" in case.extra:
        lines.append(f"loads = {number(case.extra['factor'])}")
    if row["control"] == "control":
        to = case.load_direction()[2] / abs(case.load_direction()[2]) * case.amount * 0.5
        up = vector_text(case.frame.direction([0, 0, 1]))
        lines.append(f'control = {{ probe = "p", direction = {up}, to = {number(to * case.frame.length)} }}')
        return lines + (_move(case, "press") if row["motion"] != "none" else [])
    if row["motion"] != "none":
        lines += _move(case, "press")
    if row["motion"] in ("slide", "turn"):
        lines += ["[[step]]", f"parts = {parts}", *_move(case, row["motion"])]
    if kind == "back":
        lines += ["[[step]]", "loads = 0.4", "parts = 2"]
    return lines


def _move(case, motion):
    body, frame = case.bodies[0][1], case.frame
    lines = ["[[step.move]]", 'obstacle = "body"']
    if motion == "press":
        return lines + ([f"force = 1.0"] if case.row["pressed"] == "force" else [f"translate = {vector_text(frame.vector(body.way, length=1))}"])
    if motion == "slide":  # along the tangent, so far that curvature changes the depth by less than the amount
        way = min(0.04, 0.5 * (case.shell.radius * case.amount)**0.5)
        return lines + [f"translate = {vector_text(frame.vector(times(way, body.axes[0]), length=1))}"]
    about = vector_text(frame.point(body.origin))
    return lines + [f"rotate = {{ axis = {vector_text(frame.direction(body.axes[1]))}, angle = {number(0.5 * case.amount)}, about = {about} }}"]


def probes(case):
    X = case.shell.base_point(0.31, 0.1 if case.is_symmetric else case.y0)  # in the half, too
    points = [[-0.45 + 0.9 * k / 8, case.y0 if case.y0 else 1e-3] for k in range(9)]
    through = ", ".join(vector_text(case.frame.point(case.shell.base_point(*p))) for p in points)
    return ["[[probe]]", 'name = "p"', f"at = {vector_text(case.frame.point(X))}", "[[line]]", 'name = "l"', f"through = [{through}]", "points = 25"]


def modes(case):
    kind = case.row["modes"]
    return [] if kind == "none" else ["[modes]", f"{kind} = 2"]


def contact(case):
    return ["[contact]", "admissible = true"] if case.row["admissible"] == "yes" else []


def output(case):
    """The comparison with finite rotations costs as much as the solution: a quarter of the cases has it."""
    return ["[output]", "report = false"] + ([] if case.random("check").random() < 0.25 else ["[model]", "check = false"])


SECTIONS = [head, materials, shell, regions, geometry, imperfection, joins, mesh, supports, rigid_bodies, loads, obstacles, steps, probes, modes, contact, output]
