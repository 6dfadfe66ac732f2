"""Reads the .vtu files of cases back with VTK, as ParaView does: every number is finite and has a unit; areas, energies, forces and volumes
that VTK's own cells integrate are those of results.json. Runs on any python3 that has vtk (Debian: python3-vtk9).

    python3 tests/cli/read_fields.py PROGRAM SOURCE_DIR WORK_DIR [CASE...]    # CASE or CASE:triangle; without: all of cases/
"""
import csv
import json
import math
import pathlib
import re
import subprocess
import sys

import vtk

# Points and weights of Gauss's rules on (0, 1), exact to degrees 7 and 3.
FOUR = ((0.06943184420297371, 0.17392742256872692), (0.33000947820757187, 0.32607257743127307),
        (0.6699905217924281, 0.32607257743127307), (0.9305681557970263, 0.17392742256872692))
TWO = ((0.21132486540518712, 0.5), (0.7886751345948129, 0.5))
# Dunavant's rule of degree 4 on the triangle (0,0), (1,0), (0,1).
TRIANGLE = [(a, b, w / 2) for w, c in ((0.223381589678011, 0.445948490915965), (0.109951743655322, 0.091576213509771))
            for a, b in ((c, c), (1 - 2 * c, c), (c, 1 - 2 * c))]
SQUARE = [(x, y, v * w) for x, v in FOUR for y, w in FOUR]
CUBE = [(x, y, z, u * v * w) for x, u in TWO for y, v in TWO for z, w in TWO]
PRISM = [(x, y, z, v * w) for x, y, v in TRIANGLE for z, w in TWO]
# Closed forms of cases: a sphere's cap, a part of a cylinder, a tube, plates.
AREAS = {"ball-on-dome": 2 * math.pi * (1 - math.cos(0.5)), "scordelis-lo": 25 * math.radians(40) * 25,
         "tube-under-pressure": 2 * math.pi, "two-spans": 0.1, "barrel-panel:triangle": 0.25}
STEP = 1e-5  # of differences; their error is of the order of its square


def read(path):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    assert grid.GetNumberOfCells() > 0, f"{path}: no cells"
    return grid


def arrays_of(grid):
    data = grid.GetPointData()
    return {data.GetArrayName(i): data.GetArray(i) for i in range(data.GetNumberOfArrays())}


def check_arrays(path, grid):
    """Every number of every field is finite, every field has a unit in the file."""
    units = dict(re.findall(r'<DataArray [^>]*?Name="([^"]+)"[^>]*? units="([^"]+)"', path.read_text()))
    arrays = arrays_of(grid)
    assert len(arrays) > 10, f"{path}: {len(arrays)} fields"
    for name, array in arrays.items():
        assert units.get(name), f"{path}: {name} has no unit"
        assert all(map(math.isfinite, memoryview(array).cast("B").cast("d"))), f"{path}: {name} is not finite"
    assert all(map(math.isfinite, memoryview(grid.GetPoints().GetData()).cast("B").cast("d")))
    return arrays


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def table_of(cell):
    """(weight, VTK's shape functions, their derivatives) at the points of a rule."""
    n, dimension = cell.GetNumberOfPoints(), cell.GetCellDimension()
    if dimension == 2:
        rule = [(x, y, 0, w) for x, y, w in (TRIANGLE if cell.GetNumberOfEdges() == 3 else SQUARE)]
    else:
        rule = PRISM if n == 6 else CUBE

    def shapes(place):
        values = [0.0] * n
        cell.InterpolateFunctions(place, values)
        return values

    table = []
    for *place, w in rule:
        slopes = []
        for k in range(dimension):
            before, after = ([x + side * STEP * (i == k) for i, x in enumerate(place)] for side in (-1, 1))
            slopes.append([(b - a) / (2 * STEP) for a, b in zip(shapes(before), shapes(after))])
        table.append((w, shapes(place), slopes))
    return table


def quadrature(grid, place):
    """(area or volume, [(point, share)]) at points of all cells, where the array `place` puts them."""
    tables, result = {}, []
    for c in range(grid.GetNumberOfCells()):
        cell = grid.GetCell(c)
        ids = [cell.GetPointId(i) for i in range(cell.GetNumberOfPoints())]
        key = (cell.GetCellType(), len(ids))
        if key not in tables:
            tables[key] = table_of(cell)
        at = [place.GetTuple3(i) for i in ids]
        for w, shares, slopes in tables[key]:
            t = [[sum(d * p[j] for d, p in zip(slope, at)) for j in range(3)] for slope in slopes]
            normal = cross(t[0], t[1])
            size = math.hypot(*normal) if len(t) == 2 else abs(sum(a * b for a, b in zip(normal, t[2])))
            result.append((w * size, list(zip(ids, shares))))
    return result


def has_faces_outwards(grid, place):
    """Whether VTK's faces of each cell, put where `place` has their corners, look away from the middle of the cell."""
    for c in range(grid.GetNumberOfCells()):
        cell = grid.GetCell(c)
        n = cell.GetNumberOfPoints()
        middle = [sum(place.GetTuple3(cell.GetPointId(i))[j] for i in range(n)) / n for j in range(3)]
        for f in range(cell.GetNumberOfFaces()):
            face = cell.GetFace(f)
            corners = [place.GetTuple3(face.GetPointId(i)) for i in range(face.GetNumberOfPoints())]
            a, b = ([q - p for p, q in zip(corners[0], corner)] for corner in (corners[1], corners[-1]))
            if sum(n * (p - m) for n, p, m in zip(cross(a, b), corners[0], middle)) <= 0:
                return False
    return True


def integral(points, array):
    return sum(size * sum(share * array.GetTuple1(i) for i, share in at) for size, at in points)


def close(what, found, wanted, tolerance, scale=0.0):
    assert abs(found - wanted) <= tolerance * max(abs(wanted), scale), f"{what}: {found:.9g}, wanted {wanted:.9g}"
    return abs(found - wanted) / max(abs(wanted), scale, 1e-300)


def run(program, case, out, *settings):
    command = [program, "run", case, "-q", "--no-report", "-o", out, "--set", 'output.precision="double"', "--set",
               'output.resultants="by-cell"', "--set", "output.solid=true", "--set", "output.layers=1", "--set",
               "output.heights=[0.25]"]
    for setting in settings:
        command += ["--set", setting]
    ended = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
    assert ended.returncode in (0, 3), f"{case}: {ended.stderr}"
    return json.loads((out / "results.json").read_text())


def check_case(program, name, source, work):
    """NAME, or NAME:triangle."""
    out = work / name
    triangles = ["mesh.cells=\"triangle\"", "mesh.degree=2"] if name.endswith(":triangle") else []
    case = source / "cases" / name.split(":")[0] / "case.toml"
    results = run(program, case, out, f"mesh.refinements={3 if triangles else 2}", "accuracy.max_unknowns=1", *triangles)
    shell, solid = read(out / "solution.vtu"), read(out / "solid.vtu")
    arrays = check_arrays(out / "solution.vtu", shell)
    inside = check_arrays(out / "solid.vtu", solid)
    for field in ("stress_11_at_0.25", "von_mises_at_0.25"):
        assert field in arrays, f"{name}: no {field}"
    points = quadrature(shell, arrays["reference position"])
    area = sum(size for size, _ in points)
    told = [close(f"{name}: area", area, AREAS.get(name, area), 1e-5)]
    for part, tolerance in (("membrane", 0.01), ("bending", 0.01), ("shear", 0.04)):
        energy = integral(points, arrays["energy_density_" + part])
        told.append(close(f"{name}: {part} energy", energy, results["energy_parts"][part], tolerance,
                          0.1 * results["energy"]))
    if results["contact"]:
        with open(out / "contact-forces.csv", encoding="utf-8") as file:
            carried = sum(float(row["eta"]) * float(row["area"]) for row in csv.DictReader(file))
        assert carried > 0, f"{name}: no contact"
        told.append(close(f"{name}: pressure", integral(points, arrays["eta"]), carried, 1e-3))
    sizes = quadrature(solid, inside["reference position"])
    assert has_faces_outwards(solid, inside["reference position"]), f"{name}: a cell of solid.vtu is inside out"
    told.append(close(f"{name}: volume", sum(size for size, _ in sizes), integral(points, arrays["thickness"]), 0.01))
    print(name, "area %.7g, errors of area, energies, pressure, volume:" % area,
          *("%.1e" % error for error in told), flush=True)


def main():
    program, source, work = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    names = sys.argv[4:] or sorted(path.parent.name for path in (source / "cases").glob("*/case.toml"))
    assert names, "no cases"
    for name in names:
        check_case(program, name, source, work)


main()
