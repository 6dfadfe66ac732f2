"""Mesh files of a shell, written from its patches: Gmsh 2.2 of order 1 to 4, .inp with S8R or STRI65, .stl, and the plane mesh of a chart.

Gmsh numbers corners first, then the inside of the sides, then the inside of the cell in the same way."""

import math

SIDES = ["bottom", "right", "top", "left"]
LINE_TYPE = {1: 1, 2: 8, 3: 26, 4: 27}
QUADRILATERAL_TYPE = {1: 3, 2: 10, 3: 36, 4: 37}
TRIANGLE_TYPE = {1: 2, 2: 9, 3: 21, 4: 23}


def quadrilateral_places(p, a=0, b=None):
    """Places (i, j) of the nodes of a quadrilateral with p intervals, in Gmsh's order."""
    b = p if b is None else b
    if a > b:
        return []
    if a == b:
        return [(a, a)]
    inner = range(a + 1, b)
    ring = [(a, a), (b, a), (b, b), (a, b)]
    ring += [(i, a) for i in inner] + [(b, j) for j in inner] + [(i, b) for i in reversed(inner)] + [(a, j) for j in reversed(inner)]
    return ring + quadrilateral_places(p, a + 1, b - 1)


def triangle_places(p, a=0, n=None):
    """Places (i, j), i + j <= p, of the nodes of a triangle."""
    n = p if n is None else n
    if n == 0:
        return [(a, a)]
    if n < 0:
        return []
    inner = range(1, n)
    ring = [(a, a), (a + n, a), (a, a + n)]
    ring += [(a + i, a) for i in inner] + [(a + n - i, a + i) for i in inner] + [(a, a + n - i) for i in inner]
    return ring + triangle_places(p, a + 1, n - 3)


class MeshOf:
    """Nodes, cells by patch and sides by boundary of a shell, with p intervals along a side of a cell."""

    def __init__(self, shell, p, triangles, place, size, divided=1):
        self.p, self.nodes, self._known, self._place, self._tolerance = p, [], {}, place, size * 1e-7
        self.cells, self.sides, self.triangles = {}, {}, triangles
        names = {edge: name for name, edges in shell.boundaries().items() for edge in edges}
        for patch in shell.patches:
            self._add_patch(patch, divided * (shell.cells[0] if patch in shell.base else 1), divided * shell.cells[1], names)

    def _node(self, patch, x, y):
        point = self._place(patch, x, y)
        cell = [math.floor(c / self._tolerance + 0.5) for c in point]
        for shift in ((i, j, k) for i in (0, -1, 1) for j in (0, -1, 1) for k in (0, -1, 1)):
            number = self._known.get(tuple(c + s for c, s in zip(cell, shift)))
            if number is not None:
                return number
        self.nodes.append(point)
        self._known[tuple(cell)] = len(self.nodes)
        return len(self.nodes)

    def _add_patch(self, patch, nx, ny, names):
        p = self.p
        x = [patch.x[0] + (patch.x[1] - patch.x[0]) * i / (nx * p) for i in range(nx * p + 1)]
        y = [patch.y[0] + (patch.y[1] - patch.y[0]) * j / (ny * p) for j in range(ny * p + 1)]
        grid = [[self._node(patch, a, b) for b in y] for a in x]
        cells = self.cells.setdefault(patch.name, [])
        for i in range(nx):
            for j in range(ny):
                self._add_cell(cells, lambda a, b: grid[i * p + a][j * p + b], y[j * p] + y[(j + 1) * p] > 0)
        along = {"bottom": [g[0] for g in grid], "top": [g[-1] for g in grid], "left": grid[0], "right": grid[-1]}
        for side, nodes in along.items():
            name = names.get((patch.name, side)) or self.seam_name(patch.name, side)
            if name:
                self.sides.setdefault(name, []).extend(nodes[k:k + p + 1] for k in range(0, len(nodes) - 1, p))

    def seam_name(self, patch, side):
        """Names of the edges that joins connect, in plane meshes."""
        return None

    def _add_cell(self, cells, at, mirrored):
        p = self.p
        if not self.triangles:
            cells.append([at(i, j) for i, j in quadrilateral_places(p)])
        elif mirrored:  # the diagonals are symmetric about y = 0
            cells.append([at(i + j, j) for i, j in triangle_places(p)])
            cells.append([at(i, i + j) for i, j in triangle_places(p)])
        else:
            cells.append([at(i, j) for i, j in triangle_places(p)])
            cells.append([at(p - i, p - j) for i, j in triangle_places(p)])


class PlaneMesh(MeshOf):
    def seam_name(self, patch, side):
        return f"{patch}_{side}"


def gmsh_text(mesh, regions):
    """`regions`: from patch to the name of its region."""
    p = mesh.p
    surfaces = {name: k + 1 for k, name in enumerate(dict.fromkeys(regions.values()))}
    curves = {name: k + 101 for k, name in enumerate(mesh.sides)}
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(surfaces) + len(curves))]
    lines += [f'1 {k} "{name}"' for name, k in curves.items()] + [f'2 {k} "{name}"' for name, k in surfaces.items()]
    lines += ["$EndPhysicalNames", "$Nodes", str(len(mesh.nodes))]
    lines += [f"{k + 1} " + " ".join(repr(float(c)) for c in point) for k, point in enumerate(mesh.nodes)]
    elements = []
    for name, sides in mesh.sides.items():
        for nodes in sides:
            elements.append((LINE_TYPE[p], curves[name], [nodes[0], nodes[-1], *nodes[1:-1]]))
    kind = (TRIANGLE_TYPE if mesh.triangles else QUADRILATERAL_TYPE)[p]
    for number, (patch, cells) in enumerate(mesh.cells.items()):
        elements += [(kind, surfaces[regions[patch]], nodes) for nodes in cells]
    lines += ["$EndNodes", "$Elements", str(len(elements))]
    lines += [f"{k + 1} {kind} 2 {group} {group} " + " ".join(map(str, nodes)) for k, (kind, group, nodes) in enumerate(elements)]
    return "\n".join(lines + ["$EndElements", ""])


def inp_text(mesh, regions):
    """Cells of order 2 as S8R, which has no node in the middle, or STRI65."""
    sets, lines, number = {}, ["*NODE"], 0
    used = sorted({n for cells in mesh.cells.values() for nodes in cells for n in nodes[:6 if mesh.triangles else 8]})
    lines += [f"{n}, " + ", ".join(repr(float(c)) for c in mesh.nodes[n - 1]) for n in used]
    for patch, cells in mesh.cells.items():
        lines.append(f"*ELEMENT, TYPE={'STRI65' if mesh.triangles else 'S8R'}, ELSET={patch}")
        for nodes in cells:
            number += 1
            lines.append(f"{number}, " + ", ".join(str(n) for n in nodes[:6 if mesh.triangles else 8]))
        sets.setdefault(regions[patch], []).append(patch)
    for region, patches in sets.items():
        lines += [f"*ELSET, ELSET={region}", ", ".join(patches), f"*SHELL SECTION, ELSET={region}, MATERIAL=M", "1.0"]
    for name, sides in mesh.sides.items():
        lines.append(f"*NSET, NSET={name}")
        nodes = sorted({n for side in sides for n in side})
        lines += [", ".join(map(str, nodes[k:k + 8])) for k in range(0, len(nodes), 8)]
    return "\n".join(lines + [""])


def stl_text(triangles_by_solid):
    """ASCII .stl from lists of triangles (three points each)."""
    lines = []
    for name, triangles in triangles_by_solid.items():
        lines.append(f"solid {name}")
        for triangle in triangles:
            lines += ["facet normal 0 0 0", "outer loop"]
            lines += ["vertex " + " ".join(repr(float(c)) for c in point) for point in triangle] + ["endloop", "endfacet"]
        lines.append(f"endsolid {name}")
    return "\n".join(lines + [""])


def facets_text(mesh, regions):
    """The triangles of a mesh of order 1 as .stl."""
    solids = {}
    for patch, cells in mesh.cells.items():
        solids.setdefault(regions[patch], []).extend([mesh.nodes[n - 1] for n in nodes] for nodes in cells)
    return stl_text(solids)
