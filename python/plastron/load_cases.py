"""Load cases of a result, their envelopes, and sums of linear ones."""

from __future__ import annotations

import base64
import functools
import pathlib
import re
import zlib
from typing import Any, Callable, Mapping
from xml.etree import ElementTree

import numpy as np

from .errors import CaseError, ResultsError
from .result import Fields, Record, Result

_TYPES = {"Float32": "<f4", "Float64": "<f8", "Int32": "<i4", "Int64": "<i8", "UInt8": "u1"}

# What is linear in the loads, and what the loads do not change: numbers of a load case, keys of a probe, names of fields.
_LINEAR_NUMBERS = ("load_factor", "support_factor", "support_force", "factors")
_LINEAR_AT_PROBES = ("u", "r", "foundation", "N", "M", "Q", "stress_lower", "stress_middle", "stress_upper", "shear_stress",
                     "shear_stress_middle", "lambda")  # fmt: skip
_FIXED_AT_PROBES = ("x", "position", "frame", "thickness", "curvatures")
_LINEAR_FIELDS = re.compile(r"displacement|rotation|foundation|lambda|[NM]_\d\d|Q_\d|(shear_)?stress_\d.*")
_FIXED_FIELDS = ("x", "y", "reference position", "t1", "t2", "a3", "thickness", "kappa_1", "kappa_2")


class LoadCase(Record):
    """A load case, an envelope, or a sum of load cases: a Record with ``fields``."""

    def __init__(self, data: dict[str, Any], path: str, units: dict[str, str], read: Callable[[], Fields]) -> None:
        super().__init__(data, path, units)
        self._read = functools.cache(read)

    @property
    def fields(self) -> Fields:
        """The fields, from the .vtu files: with the cells of all ranks, and rounded to single precision unless the case has
        ``output.precision = "double"``. Raises ResultsError if the files have no fields. Collective."""
        return self._read()


def load_case(result: Result, place: int) -> LoadCase:
    """Returns the load case at this place of history."""

    def read() -> Fields:
        names = [name for name in result._file_names() if re.fullmatch(r"solution-\d+\.vtu", name)]
        if len(names) != len(result._data["history"]):
            raise ResultsError("a load case of this result has no fields, because its displacements are not finite")
        return result._fields_of(names[place])

    return LoadCase(result._data["history"][place], "history/*", result._units, read)


def envelope(result: Result, data: dict[str, Any]) -> LoadCase:
    """Returns the envelope with this record."""

    def read() -> Fields:
        name = f"envelope-{data['name']}.vtu"
        if name not in result._file_names():
            raise ResultsError(
                f"the envelope {data['name']!r} has no fields, because its cases have different meshes; write refinements in "
                "[mesh] in the place of [accuracy]"
            )
        return result._fields_of(name)

    return LoadCase(data, "envelopes/*", result._units, read)


def combine(result: Result, factors: Mapping[str, float]) -> LoadCase:
    """Returns the sum of load cases of a result, multiplied by factors: ``combine(result, {"weight": 1.35, "wind": 1.5})``.
    Nothing is solved again.

    The sum has what follows from a sum: factors, support_force, and the displacements, rotations, forces, moments and stresses of
    the probes. ``fields`` has the same, with principal values, and with von Mises stresses at the faces, in the middle and at the
    heights of [output].

    Raises CaseError where load cases do not add up: with obstacles, also those with a bed, and with finite rotations. There a
    combination is a [[case]] of its own. Raises KeyError for a name that is no load case. Collective.
    """
    cases = result.cases
    for name in factors:
        if name not in cases:
            raise KeyError(f"there is no load case {name!r}; there are: {', '.join(cases) or 'none'}")
    if not factors:
        raise ValueError("factors names no load case")
    reason = "finite rotations" if result.rotations == "finite" else "contact" if result._data["obstacles"] else ""
    if reason:
        raise CaseError(
            f"with {reason} load cases do not add up; give the combination a [[case]] with factors of its loads, and solve the case"
        )
    chosen, weights = [cases[name] for name in factors], [float(factor) for factor in factors.values()]
    records = [case._data for case in chosen]
    statuses = [record["status"] for record in records if record["status"] != "solved"] or ["solved"]
    data = {"step": " + ".join(f"{w:g} {name}" for name, w in zip(factors, weights)), "status": statuses[0]}
    data |= {name: _sum([record[name] for record in records], weights) for name in _LINEAR_NUMBERS}
    data["probes"] = {name: _probe([record["probes"][name] for record in records], weights) for name in records[0]["probes"]}
    return LoadCase(data, "history/*", result._units, lambda: _sum_of_fields([case.fields for case in chosen], weights))


def _sum(values: list[Any], weights: list[float]) -> Any:
    """Returns the sum of numbers, lists or dictionaries; None for values without a meaning."""
    if isinstance(values[0], dict):
        return {name: _sum([value[name] for value in values], weights) for name in values[0]}
    if isinstance(values[0], list):
        return [_sum(list(entries), weights) for entries in zip(*values)]
    return None if None in values else sum(w * value for w, value in zip(weights, values))


def _probe(values: list[dict[str, Any]], weights: list[float]) -> dict[str, Any]:
    fixed = {name: values[0][name] for name in _FIXED_AT_PROBES}
    return fixed | {name: _sum([value[name] for value in values], weights) for name in _LINEAR_AT_PROBES}


def _sum_of_fields(fields: list[Fields], weights: list[float]) -> Fields:
    first = fields[0]
    if any(not np.array_equal(f["reference position"], first["reference position"]) for f in fields):
        raise ResultsError("the load cases have different meshes; write refinements in [mesh] in the place of [accuracy]")
    sums: dict[str, Any] = {name: first[name] for name in _FIXED_FIELDS}
    sums |= {name: sum(w * f[name] for w, f in zip(weights, fields)) for name in first if _LINEAR_FIELDS.fullmatch(name)}
    for name in list(first):
        principal, mises = re.fullmatch(r"(N|M|stress)_I(_.*)?", name), re.fullmatch(r"von_mises_(.*)", name)
        if principal:
            kind, end = principal[1], principal[2] or ""
            a, b, c = (sums[f"{kind}_{axes}{end}"] for axes in (11, 22, 12))
            radius = np.hypot((a - b) / 2, c)
            sums[name], sums[f"{kind}_II{end}"] = (a + b) / 2 + radius, (a + b) / 2 - radius
        elif mises:
            a, b, c = (sums[f"stress_{axes}_{mises[1]}"] for axes in (11, 22, 12))
            shear = [sums.get(f"shear_stress_{axis}_{mises[1]}", 0) for axis in (1, 2)]  # none at the faces
            sums[name] = np.sqrt(a**2 - a * b + b**2 + 3 * (c**2 + shear[0] ** 2 + shear[1] ** 2))
    return Fields(
        {
            "points": sums["reference position"] + sums["displacement"],
            "cells": first.cells,
            "cell_type": first.cell_type,
            "point_arrays": [(name, first.units[name], array) for name, array in sums.items()],
            "cell_arrays": [],
        }
    )


def read_fields(path: pathlib.Path) -> Fields:
    """Returns the fields of a .vtu file of Plastron, with the cells of all ranks."""
    points, cells, types = [], [], []
    arrays: dict[str, dict[str, tuple[str, list[Any]]]] = {"PointData": {}, "CellData": {}}
    count = 0
    for piece in ElementTree.parse(path).iter("Piece"):
        parts = {part.tag: [(array.get("Name", ""), array) for array in part] for part in piece}
        topology = {name: _values(array) for name, array in parts["Cells"]}
        points.append(_values(parts["Points"][0][1]))
        cells.append(topology["connectivity"].reshape(len(topology["types"]), -1) + count)
        types.append(topology["types"])
        count += len(points[-1])
        for kind, found in arrays.items():
            for name, array in parts.get(kind, []):
                found.setdefault(name, (array.get("units", ""), []))[1].append(_values(array))
    native: dict[str, Any] = {"points": np.concatenate(points), "cells": np.concatenate(cells), "cell_type": int(types[0][0])}
    for key, kind in (("point_arrays", "PointData"), ("cell_arrays", "CellData")):
        native[key] = [(name, unit, np.concatenate(pieces)) for name, (unit, pieces) in arrays[kind].items()]
    return Fields(native)


def _values(array: ElementTree.Element) -> np.ndarray[Any, Any]:
    """Returns the values of an array: one block, packed, after four numbers of 8 bytes each (src/plastron/io/vtu_piece.cc)."""
    packed = base64.b64decode((array.text or "").strip()[44:])
    values = np.frombuffer(zlib.decompress(packed), _TYPES[array.get("type", "")])
    values = values.astype(float if values.dtype.kind == "f" else np.int64)
    components = int(array.get("NumberOfComponents", "1"))
    return values if components == 1 else values.reshape(-1, components)
