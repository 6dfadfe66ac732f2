"""Reads the .vtu files of cases back with VTK, as ParaView does: every number is finite and has a unit; areas, energies, forces and volumes
that VTK's own cells integrate are those of results.json. Runs on any python3 that has vtk (Debian: python3-vtk9).

    python3 tests/cli/read_fields.py PROGRAM SOURCE_DIR WORK_DIR [CASE...]    # without CASE: all of cases/
"""
import json
import math
import pathlib
import re
import subprocess
import sys

import vtk

# Points and weights of Gauss's rules on (0, 1).
RULES = {4: ((0.06943184420297371, 0.33000947820757187, 0.6699905217924281, 0.9305681557970263),
             (0.17392742256872692, 0.32607257743127307, 0.32607257743127307, 0.17392742256872692))}
# Of degree 4 on the triangle (0,0), (1,0), (0,1): Dunavant.
TRIANGLE = [(a, b, w / 2) for w, c in ((0.223381589678011, 0.445948490915965), (0.109951743655322, 0.091576213509771))
            for a, b in ((c, c), (1 - 2 * c, c), (c, 1 - 2 * c))]


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


def rule(cell):
    if cell.GetCellDimension() != 2:
        raise ValueError("not a surface")
    if cell.GetNumberOfEdges() == 3:
        return TRIANGLE
    points, weights = RULES[4]
    return [(x, y, v * w) for x, v in zip(points, weights) for y, w in zip(points, weights)]


def surface_points(grid, place):
    """(area, [(point, share)]) at quadrature points of all cells, on the surface that the array `place` gives; VTK interpolates."""
    tables = {}
    for c in range(grid.GetNumberOfCells()):
        cell = grid.GetCell(c)
        n = cell.GetNumberOfPoints()
        key = (cell.GetCellType(), n)
        if key not in tables:
            tables[key] = []
            for x, y, w in rule(cell):
                shares, derivatives = [0.0] * n, [0.0] * (2 * n)
                cell.InterpolateFunctions((x, y, 0), shares)
                cell.InterpolateDerivs((x, y, 0), derivatives)
                tables[key].append((w, shares, derivatives))
        ids = [cell.GetPointId(i) for i in range(n)]
        at = [place.GetTuple3(i) for i in ids]
        for w, shares, d in tables[key]:
            t = [[sum(d[k * n + i] * at[i][j] for i in range(n)) for j in range(3)] for k in range(2)]
            yield w * math.hypot(*cross(*t)), list(zip(ids, shares))


def integral(quadrature, array):
    return sum(area * sum(share * array.GetTuple1(i) for i, share in at) for area, at in quadrature)


def close(what, found, wanted, tolerance, scale=0.0):
    assert abs(found - wanted) <= tolerance * max(abs(wanted), scale), f"{what}: {found:.9g}, wanted {wanted:.9g}"
    return abs(found - wanted) / max(abs(wanted), scale, 1e-300)


def volume(solid):
    """Of the undeformed solid, by VTK."""
    points = vtk.vtkPoints()
    points.SetData(solid.GetPointData().GetArray("reference position"))
    solid.SetPoints(points)
    sizes = vtk.vtkCellSizeFilter()
    sizes.SetInputData(solid)
    sizes.Update()
    parts = sizes.GetOutput().GetCellData().GetArray("Volume")
    values = [parts.GetTuple1(i) for i in range(parts.GetNumberOfTuples())]
    assert min(values) > 0, "a cell of solid.vtu is inside out"
    return sum(values)


def run(program, case, out, *settings):
    command = [program, "run", case, "-q", "--no-report", "-o", out, "--set", 'output.precision="double"', "--set",
               'output.resultants="by-cell"', "--set", "output.solid=true", "--set", "output.heights=[0.25]"]
    for setting in settings:
        command += ["--set", setting]
    ended = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
    assert ended.returncode in (0, 3), f"{case}: {ended.stderr}"
    return json.loads((out / "results.json").read_text())


def check_case(program, case, work):
    out = work / case.parent.name
    results = run(program, case, out, "mesh.refinements=1")
    shell, solid = read(out / "solution.vtu"), read(out / "solid.vtu")
    arrays = check_arrays(out / "solution.vtu", shell)
    inside = check_arrays(out / "solid.vtu", solid)
    for name in ("stress_11_at_0.25", "von_mises_at_0.25"):
        assert name in arrays, f"{case}: no {name}"
    quadrature = list(surface_points(shell, arrays["reference position"]))
    area = sum(part for part, _ in quadrature)
    told = [f"area {area:.6g}"]
    for part in ("membrane", "bending", "shear"):
        energy = integral(quadrature, arrays["energy_density_" + part])
        told.append("%s %.1e" % (part, close(f"{case}: {part} energy", energy, results["energy_parts"][part], 0.02,
                                             0.1 * results["energy"])))
    if results["contact"]:
        pressed = integral(quadrature, arrays["eta"])
        carried = sum(math.hypot(*z["reaction"]["force"]) for o in results["obstacles"] for z in o["zones"])
        told.append(f"pressure {pressed:.6g} of {carried:.6g}")
    thick = integral(quadrature, arrays["thickness"])
    told.append("volume %.1e" % close(f"{case}: volume", volume(solid), thick, 0.03))
    print(case.parent.name, ", ".join(told), flush=True)


def main():
    program, source, work = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    names = sys.argv[4:] or sorted(path.parent.name for path in (source / "cases").glob("*/case.toml"))
    assert names, "no cases"
    for name in names:
        check_case(program, source / "cases" / name / "case.toml", work)


main()
