"""Results: numbers with units, fields as arrays, files."""

from __future__ import annotations

import html
import json
import pathlib
import shutil
import weakref
from typing import TYPE_CHECKING, Any, Dict, Iterable, Iterator

import numpy as np

from . import _case
from .errors import OutputError, PointError, ResultsError

if TYPE_CHECKING:
    from .case import Case, Path
    from .load_cases import LoadCase
    from .solving import Verification


class Record:
    """A part of results.json: its entries are attributes. ``unit_of(name)`` gives their units, ``to_dict()`` plain values.

    Lists of parts with names, such as the obstacles, are found by name or number: ``result.obstacles["table"].force``.
    Vectors are NumPy arrays, numbers without a meaning None. ``reaction`` parts have ``force`` and ``moment``, which are also
    attributes of the part itself.
    """

    def __init__(self, data: dict[str, Any], path: str = "", units: dict[str, str] | None = None) -> None:
        self._data, self._path, self._units = data, path, units or {}

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        data = self.__dict__["_data"]
        if name in data:
            return _wrapped(data[name], _joined(self._path, name), self._units)
        reaction = data.get("reaction")
        if isinstance(reaction, dict) and name in reaction:
            return self.reaction.__getattr__(name)
        raise AttributeError(f"there is no {name} in {self._path or 'the result'}; there are: {', '.join(data)}")

    def __getitem__(self, name: str) -> Any:
        try:
            return getattr(self, name)
        except AttributeError as error:
            raise KeyError(str(error)) from None

    def __contains__(self, name: str) -> bool:
        return name in self._data

    def __iter__(self) -> Iterator[str]:
        return iter(self._data)

    def __dir__(self) -> list[str]:
        return list(super().__dir__()) + [name for name in self._data if name.isidentifier()]

    def keys(self) -> Iterable[str]:
        return self._data.keys()

    def unit_of(self, name: str) -> str:
        """Returns the unit of an entry, or of an entry of its parts: ``unit_of("energy")``, ``unit_of("contact.area")``."""
        steps = _joined(self._path, name).replace(".", "/").split("/")
        for path, unit in self._units.items():
            known = path.split("/")
            if len(known) == len(steps) and all(k in ("*", s) for k, s in zip(known, steps)):
                return unit
        raise KeyError(f"{'.'.join(steps)} has no unit, or does not exist")

    def to_dict(self) -> dict[str, Any]:
        """Returns plain dictionaries, lists and numbers."""
        return dict(json.loads(json.dumps(self._data)))

    def __repr__(self) -> str:
        return "\n".join(f"{name}: {value!r}" for name, value in _lines(self._data))


class _NoContact(Record):
    """The contact of a case without obstacle: false, and its numbers are errors with words."""

    def __init__(self) -> None:
        super().__init__({}, "contact")

    def __bool__(self) -> bool:
        return False

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        raise AttributeError(f"contact has no {name}: the case has no obstacle")


class Records:
    """Parts of one kind. An index is a number, or the name of a part."""

    def __init__(self, data: list[dict[str, Any]], path: str, units: dict[str, str]) -> None:
        self._data, self._path, self._units = data, path, units

    def __len__(self) -> int:
        return len(self._data)

    def __getitem__(self, index: int | str) -> Record:
        if isinstance(index, str):
            names = [entry.get("name", entry.get("boundary")) for entry in self._data]
            if index not in names:
                raise KeyError(f"{index!r}: the names are {', '.join(map(str, names))}")
            index = names.index(index)
        if isinstance(index, slice):
            raise TypeError("an index is a number or a name")
        return Record(self._data[index], self._path + "/*", self._units)

    def __iter__(self) -> Iterator[Record]:
        return (self[i] for i in range(len(self)))

    def __repr__(self) -> str:
        return "\n\n".join(repr(record) for record in self)


def _add_short_names(arrays: dict[str, Any], units: dict[str, str]) -> None:
    """Adds u and r, the names of displacement and rotation in formulas, where they are no names of fields."""
    for name, short in (("displacement", "u"), ("rotation", "r")):
        if name in arrays and short not in arrays:
            arrays[short], units[short] = arrays[name], units[name]


class _Arrays(Dict[str, "np.ndarray[Any, Any]"]):
    """Arrays by name. An unknown name is answered with the known ones."""

    def __missing__(self, name: str) -> Any:
        raise KeyError(f"there is no field {name!r}; there are: {', '.join(self)}")


class Fields(_Arrays):
    """The fields at the points of the output mesh: name -> array, in double precision. ``units`` has their units.

    ``points`` (n x 3) are the places on the deformed mid-surface, ``cells`` (m x k) the points of each cell in VTK's order,
    ``cell_type`` VTK's number of their kind, ``of_cells`` the fields with one value for each cell. On several ranks these are
    the cells of this rank. Each cell has its own points, because resultants jump between cells. The arrays own their memory.
    """

    def __init__(self, native: Any) -> None:
        super().__init__({name: array for name, _, array in native["point_arrays"]})
        self.units = {name: unit for name, unit, _ in native["point_arrays"] + native["cell_arrays"]}
        self.of_cells = {name: array for name, _, array in native["cell_arrays"]}
        self.points, self.cells, self.cell_type = native["points"], native["cells"], native["cell_type"]
        _add_short_names(self, self.units)

    def under_full_names(self) -> dict[str, np.ndarray[Any, Any]]:
        """Returns the fields without the short names u and r."""
        return {name: array for name, array in self.items() if name not in ("u", "r")}


class Values(_Arrays):
    """Fields at chosen points: name -> array. ``units`` has their units."""

    def __init__(self, native: Any) -> None:
        super().__init__({name: array for name, _, array in native})
        self.units = {name: unit for name, unit, _ in native}
        _add_short_names(self, self.units)

    def to_dataframe(self) -> Any:
        """Returns a pandas.DataFrame: a row for each point, components of vectors as name_x, name_y, name_z."""
        import pandas

        columns = {}
        for name, array in self.items():
            if array.ndim == 1:
                columns[name] = array
            else:
                columns.update({f"{name}_{axis}": array[:, k] for k, axis in enumerate("xyz")})
        return pandas.DataFrame(columns)


class Result(Record):
    """A result. Numbers are attributes under the names of results.json: ``result.energy``, ``result.contact.area``,
    ``result.obstacles["table"].force``, ``result.certificate``, ``result.estimates``, ``result.probes.bottom.u``.

    ``status`` is "solved" if every limit is met; other words say what is missing (``status_text``). ``unit_of("energy")`` is the
    unit of a number. ``fields`` has all fields as arrays, ``at(points)`` their values elsewhere. A notebook shows a summary; ``view()``
    is the interactive view.
    """

    def __init__(self, native: Any, case: Case, data: dict[str, Any], directory: Path, owns_directory: bool, comm: Any = "world") -> None:
        super().__init__(data, "", data.get("units", {}))
        self._native, self._case, self._directory, self._comm = native, case.copy(), pathlib.Path(directory), comm
        self._is_complete = not owns_directory and (self._directory / "results.json").exists()
        self._fields: Fields | None = None
        self._read: dict[str, Fields] = {}
        if owns_directory and self._is_first():
            weakref.finalize(self, shutil.rmtree, self._directory, ignore_errors=True)

    @property
    def case(self) -> Case:
        """The case that was solved."""
        return self._case

    @property
    def status_text(self) -> str:
        """One or two sentences on how the computation ended."""
        return str(self._data["status_text"])

    @property
    def is_solved(self) -> bool:
        """Whether every limit is met."""
        return bool(self._data["status"] == "solved")

    def _solution(self) -> Any:
        if self._native is None:
            raise ResultsError("these results have no solution")
        return self._native

    @property
    def fields(self) -> Fields:
        """All fields of the last solution, as arrays (Fields)."""
        if self._fields is None:
            self._fields = Fields(self._solution().fields(1.0))
        return self._fields

    @property
    def cases(self) -> dict[str, LoadCase]:
        """The load cases by name: ``result.cases["wind"].probes.tip.u``, ``result.cases["wind"].fields["u"]``. Empty without
        [[case]]. Their numbers are those of history[] of results.json; plastron.combine() adds them up."""
        from .load_cases import load_case

        if not (self._data["settings"] or {}).get("case"):
            return {}
        return {entry["step"]: load_case(self, k) for k, entry in enumerate(self._data["history"])}

    def envelope(self, name: str) -> LoadCase:
        """Returns an [[envelope]]: ``numbers`` has for each path in history[] least, least_case, largest and largest_case:
        ``result.envelope("service").numbers["probes/tip/u/2"].least_case``. ``fields`` has the same node by node:
        ``fields["von_mises_largest"]``, and ``fields["von_mises_largest_case"]``, the place of the case in ``cases``, from 0. Its
        points are those of the undeformed mid-surface."""
        from .load_cases import envelope

        known = {data["name"]: data for data in self._data["envelopes"]}
        if name not in known:
            raise KeyError(f"there is no envelope {name!r}; there are: {', '.join(known) or 'none'}")
        return envelope(self, known[name])

    def _file_names(self) -> list[str]:
        return list(json.loads((self.directory / "results.json").read_text(encoding="utf-8"))["files"])

    def _fields_of(self, name: str) -> Fields:
        """Returns the fields of one of the result's .vtu files."""
        from .load_cases import read_fields

        if name not in self._read:
            self._read[name] = read_fields(self.directory / name)
        return self._read[name]

    def at(self, points: Any, heights: Iterable[float] = ()) -> Values:
        """Returns all fields at points: n x 2 parameters (x, y), or n x 3 places in space, of which the nearest points of the
        mid-surface count. ``heights``: z / e of further stresses. Raises PointError for a point outside of the domain. Collective."""
        points = np.atleast_2d(np.asarray(points, dtype=float))
        if points.ndim != 2 or points.shape[1] not in (2, 3):
            raise ValueError("points is an array of n x 2 parameters or n x 3 places in space")
        for point in points[~np.isfinite(points).all(axis=1)]:
            raise PointError(f"a point at ({', '.join(f'{x:g}' for x in point)}) is not finite")
        try:
            return Values(self._solution().values_at(points, [float(z) for z in heights]))
        except ValueError as error:  # the only one that is left
            raise PointError(str(error)) from None

    def along(self, start: Any, end: Any, points: int = 101, heights: Iterable[float] = ()) -> Values:
        """Returns all fields at equidistant points between two points, as ``at()`` does, and ``s``, the distance from the first one
        along the undeformed mid-surface, measured by chords."""
        start, end = np.asarray(start, dtype=float), np.asarray(end, dtype=float)
        t = np.linspace(0, 1, points)[:, None]
        values = self.at((1 - t) * start + t * end, heights)
        chords = np.linalg.norm(np.diff(values["reference position"], axis=0), axis=1)
        values["s"] = np.concatenate([[0.0], np.cumsum(chords)])
        values.units["s"] = values.units["reference position"]
        return values

    def row(self) -> dict[str, Any]:
        """Returns all numbers as a flat dictionary, with the column names of history.csv."""
        return {name: parsed(text) for name, text in _case.result_row(json.dumps(self._data))}

    def to_dataframe(self) -> Any:
        """Returns the instants of a case with steps as a pandas.DataFrame, or the numbers of the result in one row. Collective."""
        import pandas

        if self._data.get("history"):
            self._complete()
            return pandas.read_csv(self._directory / "history.csv")
        return pandas.DataFrame([self.row()])

    def to_meshio(self) -> Any:
        """Returns a meshio.Mesh of the deformed mid-surface, with all fields."""
        import meshio

        fields = self.fields
        kind = {69: "VTK_LAGRANGE_TRIANGLE", 70: "VTK_LAGRANGE_QUADRILATERAL"}[fields.cell_type]
        of_cells = {name: [array] for name, array in fields.of_cells.items()}
        return meshio.Mesh(fields.points, [(kind, fields.cells)], point_data=fields.under_full_names(), cell_data=of_cells)

    def to_pyvista(self) -> Any:
        """Returns a pyvista.UnstructuredGrid of the deformed mid-surface, with all fields."""
        import pyvista

        fields = self.fields
        count, size = fields.cells.shape
        cells = np.hstack([np.full((count, 1), size), fields.cells]).ravel()
        grid = pyvista.UnstructuredGrid(cells, np.full(count, fields.cell_type), fields.points)
        for name, array in fields.under_full_names().items():
            grid.point_data[name] = array
        for name, array in fields.of_cells.items():
            grid.cell_data[name] = array
        return grid

    @property
    def directory(self) -> pathlib.Path:
        """The folder with the result's files, which are those of the command line. Collective."""
        self._complete()
        return self._directory

    def save(self, directory: Path) -> pathlib.Path:
        """Writes the files that ``plastron run`` writes: results.json, report.html, .vtu, tables. Returns the folder. Collective."""
        from . import _solver

        self._complete()
        target = pathlib.Path(directory)
        try:
            if target.resolve() != self._directory.resolve() and self._is_first():
                self._copy_files(target)
        except OSError as error:
            raise OutputError(f"{target}: results cannot be written here: {error.strerror or error}") from error
        finally:
            _solver.barrier(self._comm)
        return target

    def _copy_files(self, target: pathlib.Path) -> None:
        from . import _solver

        target.mkdir(parents=True, exist_ok=True)
        names = self._file_names()
        for name in [name for name in names if name != "results.json"] + ["results.json"]:
            if (self._directory / name).exists():
                shutil.copy2(self._directory / name, target / name)
        for path in target.iterdir():
            is_optional = _solver.is_mode_name(path.name) or path.match("envelope-*.vtu")
            if is_optional and path.name not in names:  # of an earlier result
                path.unlink()

    def derivatives(self, keys: Iterable[str], step: float = 1e-3) -> dict[str, dict[str, tuple[float, float]]]:
        """Returns the derivatives of the numbers of the solution by numbers of the case: ``d =
        result.derivatives(["shell.thickness"])``, then ``d["shell.thickness"]["energy"]`` is (derivative, estimate of its error).
        Estimates, the comparison of models, stability and modes have none. Collective.

        The mesh and the nodes in contact are held. The tangent of the solution is factorised once. For each key it gives four
        solutions with values that differ by ``step`` and 2 ``step``, relative to the value of the key, in a few Newton steps.
        Their differences are extrapolated, and the estimate is the difference of both. A key costs about a sixth of what
        plastron.differences() takes.

        These are derivatives of the discrete solution. The estimate does not hold the error of the mesh, and with contact that is
        larger than the error of the numbers themselves: the edge of a contact zone moves with the case, and here it stays between
        the same nodes. On a bowl on a table of 1 700 to 103 000 unknowns, derivatives of force and energy scatter by 5 to 1 %.
        Contact areas change only with the mid-surface.

        Raises CaseError for results that are not solved, the mixed formulation, pressed obstacles, control, and keys of the domain
        and of rigid bodies; with small rotations also for curved obstacles and loaded results. plastron.differences() works there.
        """
        from . import _solver

        keys = list(keys)
        numbers = numbers_of(self._case, keys, step)
        changed = [self._case.with_settings({key: value})._native() for key, value in steps_of(keys, numbers, step)]
        texts = _solver.results_near(self._solution(), changed, self._comm)
        rows = [{name: parsed(text) for name, text in _case.result_row(results)} for results in texts]
        return derivatives_of(keys, numbers, rows, step)

    def verify(self) -> Verification:
        """Computes the certificate again from the files, and returns the Verification. Collective."""
        from .solving import verify

        return verify(self.directory, comm=self._comm)

    def view(self, height: int = 640) -> View:
        """Returns the interactive view of report.html, which a notebook shows. It adds the whole page to the notebook, often more
        than 1 MB. ``height``: of the view [pixels]. Collective."""
        path = self.directory / "report.html"
        if not path.exists():
            raise ResultsError("these results have no report.html; solve the case with report=True")
        return View(path, height)

    def _is_first(self) -> bool:
        from . import _solver

        return _solver.rank(self._comm) == 0

    def _complete(self) -> None:
        if not self._is_complete:
            self._solution().finish()
            self._is_complete = True

    def __repr__(self) -> str:
        return f"<plastron.Result of {self._case!r}: {self.status}>"

    def _repr_html_(self) -> str:
        """The summary in a notebook."""
        numbers = "".join(
            f"<tr><td>{html.escape(name)}</td><td>{value:.6g}</td><td>{html.escape(self.unit_of(name))}</td></tr>"
            for name, value in _summary(self._data)
        )
        return f"<p><b>{html.escape(self.title or 'Result')}</b>: {html.escape(self.status)}</p><table>{numbers}</table>"


class View:
    """The interactive view of a result in a notebook: the page report.html. ``path`` is its file, for a browser."""

    def __init__(self, path: pathlib.Path, height: int) -> None:
        self.path, self.height = path, height
        self._page = path.read_text(encoding="utf-8")  # the file goes with its result

    def __repr__(self) -> str:
        return f"<plastron.View of {self.path}>"

    def _repr_html_(self) -> str:
        page = html.escape(self._page, quote=True)
        return f'<iframe srcdoc="{page}" style="width:100%;height:{self.height}px;border:1px solid #ccc"></iframe>'


def numbers_of(case: Case, keys: Iterable[str], step: float) -> list[float]:
    """Returns the values of keys by which derivatives are taken."""
    if not 1e-8 <= step <= 0.4:
        raise ValueError(f"step is {step!r}; it is a part of the value of the key, 1e-8 to 0.4")
    values = []
    for key in keys:
        value = case[key]
        if isinstance(value, bool) or not isinstance(value, (int, float)) or value == 0:
            raise ValueError(f"{key} is {value!r}; derivatives are taken by numbers that are not 0")
        values.append(float(value))
    return values


def steps_of(keys: list[str], numbers: list[float], step: float) -> Iterator[tuple[str, float]]:
    """Returns the four values of each key that derivatives_of() needs."""
    for key, value in zip(keys, numbers):
        for k in (1, -1, 2, -2):
            yield key, value * (1 + k * step)


def derivatives_of(
    keys: list[str], numbers: list[float], rows: list[dict[str, Any]], step: float
) -> dict[str, dict[str, tuple[float, float]]]:
    """Returns the derivatives by each key and the estimates of their errors, from the rows of steps_of()."""
    result: dict[str, dict[str, tuple[float, float]]] = {}
    for i, (key, number) in enumerate(zip(keys, numbers)):
        h = number * step
        result[key] = {}
        for name, first in rows[4 * i].items():
            if name.startswith("certificate."):
                continue  # rounding errors
            values: list[Any] = [row.get(name) for row in rows[4 * i : 4 * i + 4]]
            if isinstance(first, float) and all(isinstance(v, float) for v in values):
                near, far = (values[0] - values[1]) / (2 * h), (values[2] - values[3]) / (4 * h)
                result[key][name] = ((4 * near - far) / 3, abs(near - far))
    return result


def _summary(data: dict[str, Any]) -> Iterator[tuple[str, float]]:
    """Returns the numbers of the summary: (path, value)."""
    paths = ["energy", "size.max_displacement", "contact.area", "contact.max_pressure", "stress.max_von_mises"]
    for path in paths:
        value: Any = data
        for part in path.split("."):
            value = value.get(part) if isinstance(value, dict) else None
        if isinstance(value, (int, float)):
            yield path, value


def _joined(path: str, name: str) -> str:
    return f"{path}/{name}" if path else name


def _wrapped(value: Any, path: str, units: dict[str, str]) -> Any:
    if value is None and path == "contact":
        return _NoContact()
    if isinstance(value, dict):
        return Record(value, path, units)
    if isinstance(value, list):
        if value and all(isinstance(entry, dict) for entry in value):
            return Records(value, path, units)
        if value and all(isinstance(entry, (int, float)) or entry is None for entry in value):
            return np.array([np.nan if entry is None else entry for entry in value])
    return value


def _lines(data: dict[str, Any], path: str = "") -> Iterator[tuple[str, Any]]:
    for name, value in data.items():
        if isinstance(value, dict):
            yield from _lines(value, _joined(path, name).replace("/", "."))
        elif isinstance(value, list) and value and isinstance(value[0], dict):
            yield _joined(path, name).replace("/", "."), f"{len(value)} parts"
        else:
            yield _joined(path, name).replace("/", "."), value


def parsed(text: str) -> Any:
    """Returns a cell of a table as a number, a truth value, None or a text."""
    if text == "":
        return None
    if text in ("true", "false"):
        return text == "true"
    kinds: list[Any] = [int, float]
    for kind in kinds:
        try:
            return kind(text)
        except ValueError:
            pass
    return text
