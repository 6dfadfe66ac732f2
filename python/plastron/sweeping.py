"""Many cases that differ in some values."""

from __future__ import annotations

import concurrent.futures
import contextlib
import itertools
import json
import os
import pathlib
import pickle
from typing import Any, Iterable, Iterator, Mapping

from . import _case, toml_text
from .case import Case, Path
from .errors import CaseError
from .progress import bar as progress_bar
from .result import derivatives_of, numbers_of, parsed, steps_of

REFUSED = "refused"


class Table:
    """The rows of a sweep. ``table["energy"]`` is a column as a list, ``table.rows`` has a dictionary for each case: the values
    of the parameters, then the numbers of the result under the names of history.csv. ``status`` is "refused" for a case that
    cannot be solved, and the last column, ``error``, has the reason; it is None elsewhere."""

    def __init__(
        self,
        given: list[dict[str, Any]],
        parameters: Iterable[str],
        texts: list[dict[str, str]],
        errors: Iterable[str | None],
    ) -> None:
        self.parameters = list(parameters)
        self._texts = texts
        self.rows = [{name: parsed(text) for name, text in row.items()} | values for row, values in zip(texts, given)]
        for row, error in zip(self.rows, errors):
            row["error"] = error

    def __len__(self) -> int:
        return len(self.rows)

    def __getitem__(self, column: str) -> list[Any]:
        if column not in self.columns:
            raise KeyError(f"{column!r}: there is no such column; the first are {', '.join(self.columns[:12])}")
        return [row.get(column) for row in self.rows]

    @property
    def columns(self) -> list[str]:
        """The names of the columns: parameters, status, numbers, error."""
        return [*self._columns_of_file(), "error"]

    def _columns_of_file(self) -> list[str]:
        names = list(self.parameters)
        for row in self._texts:
            names += [name for name in row if name not in names]
        return names

    def to_dataframe(self) -> Any:
        import pandas

        return pandas.DataFrame([{name: row.get(name) for name in self.columns} for row in self.rows])

    def to_csv(self, path: Path | None = None) -> str | None:
        """Writes the table as ``plastron sweep`` does, without the column ``error``, or returns its text without a path."""
        names = self._columns_of_file()
        lines = [names] + [[row.get(name, "") for name in names] for row in self._texts]
        text = "".join(",".join(_case.csv_cell(cell) for cell in line) + "\n" for line in lines)
        if path is None:
            return text
        pathlib.Path(path).write_text(text, encoding="utf-8")
        return None

    def __repr__(self) -> str:
        return f"<plastron.Table: {len(self)} cases over {', '.join(self.parameters)}>"

    def _repr_html_(self) -> str:
        return str(self.to_dataframe()._repr_html_())


def sweep(
    case: Case,
    parameters: Mapping[str, Iterable[Any]],
    *,
    pairwise: bool = False,
    executor: Any = None,
    workers: int | None = None,
    directory: Path | None = None,
    report: bool = False,
    progress: bool = False,
) -> Table:
    """Solves a case for all combinations of values, and returns a Table.

    parameters: a dictionary key -> values, such as ``{"shell.thickness": [0.01, 0.02], "load[0].pressure": [1, 2]}``. The last
        key changes fastest. With ``pairwise`` the first values belong together, the second ones, and so on.
    executor: any executor in the form of concurrent.futures; without one, as many processes as there are cores (``workers``).
        0 or 1 workers solve the cases in this process.
    directory: folder in which each case has a folder 0001, 0002, ... with its files. A case that is solved there already is not
        solved again, so that an interrupted sweep goes on; cases with functions of Python are always solved. ``plastron sweep``
        uses the same folders.
    report: whether each of these has a report.html.
    progress: shows the number of finished cases.

    Cases that cannot be solved are rows with the status "refused". A key that the case does not have, and cannot get, raises
    CaseError.
    """
    for key, values in parameters.items():
        if isinstance(values, (str, bytes)) or not hasattr(values, "__iter__"):
            raise TypeError(f"{key}: a sweep takes a list of values, not {values!r}")
    lists = [list(values) for values in parameters.values()]
    if pairwise and len({len(values) for values in lists}) > 1:
        raise ValueError(f"with pairwise all parameters have as many values: {[len(values) for values in lists]}")
    settings = [dict(zip(parameters, values)) for values in (zip(*lists) if pairwise else itertools.product(*lists))]
    members = _members(case, settings)
    errors = [member for _, member in members if isinstance(member, CaseError)]
    if errors and len(errors) == len(members) and any(key not in case for key in parameters):
        raise errors[0]
    return _solve_members(members, list(parameters), executor, workers, directory, report, progress)


def differences(
    case: Case,
    keys: Iterable[str],
    *,
    step: float = 1e-3,
    executor: Any = None,
    workers: int | None = None,
) -> dict[str, dict[str, tuple[float, float]]]:
    """Returns the derivatives of all numbers of a result by numbers of the case, from differences: ``d = differences(case,
    ["shell.thickness"])``, then ``d["shell.thickness"]["energy"]`` is (derivative, estimate of its error).

    Central differences with ``step`` and 2 ``step``, relative to the value of the key, and their extrapolation: four solutions
    for each key. The estimate is the difference of both; it does not hold the error of the mesh. It is large where the contact
    zone changes between few nodes, and where [accuracy] takes another mesh for another value: give [mesh] refinements for smooth
    numbers. A step of some per cent averages over the nodes that the edge of a contact zone passes. Result.derivatives() holds
    the mesh and the contact instead, and costs less.
    """
    keys = list(keys)
    numbers = numbers_of(case, keys, step)
    settings = [{key: value} for key, value in steps_of(keys, numbers, step)]
    table = _solve_members(_members(case, settings), [], executor, workers, None, False, False)
    for row in table.rows:
        if row["status"] == REFUSED:
            raise CaseError(row["error"])
    return derivatives_of(keys, numbers, table.rows, step)


def _members(case: Case, all_settings: Iterable[dict[str, Any]]) -> list[tuple[dict[str, Any], Any]]:
    if not isinstance(case, Case):
        raise TypeError(f"sweep() takes a plastron.Case, not {type(case).__name__}; Case.read() reads a file")
    members: list[tuple[dict[str, Any], Any]] = []
    for settings in all_settings:
        try:
            members.append((settings, case.with_settings(settings)))
        except CaseError as error:
            members.append((settings, error))
    return members


def _solve_members(
    members: list[tuple[dict[str, Any], Any]],
    names: list[str],
    executor: Any,
    workers: int | None,
    directory: Path | None,
    report: bool,
    progress: bool,
) -> Table:
    folders = [os.path.join(directory, f"{i + 1:04}") if directory else None for i in range(len(members))]
    outcomes: list[tuple[Any, str | None]] = [(None, None)] * len(members)
    waiting = []
    for i, (_, member) in enumerate(members):
        if isinstance(member, CaseError):
            outcomes[i] = (None, str(member))
            continue
        finished = _results_in(folders[i], member)
        if finished:
            outcomes[i] = (_row(finished), None)
        else:
            waiting.append(i)
    bar = progress_bar(total=len(members), initial=len(members) - len(waiting), unit=" cases") if progress else None
    if executor is None and (len(waiting) < 2 or (workers is not None and workers < 2)):
        for i in waiting:
            outcomes[i] = _solve_one(members[i][1].__getstate__(), folders[i], report)
            if bar:
                bar.update(1)
    else:
        _refuse_functions_for_processes(members, executor)
        owned = None
        if executor is None:
            owned = executor = concurrent.futures.ProcessPoolExecutor(min(workers or _cores(), len(waiting)))
        try:
            with _between_computations(executor):
                futures = {
                    executor.submit(_solve_one, members[i][1].__getstate__(), folders[i], report): i for i in waiting
                }
            for future in concurrent.futures.as_completed(futures):
                outcomes[futures[future]] = future.result()
                if bar:
                    bar.update(1)
        finally:
            if owned:
                owned.shutdown(cancel_futures=True)
    if bar:
        bar.close()
    texts = []
    for (settings, _), (row, _) in zip(members, outcomes):
        texts.append({name: _text(settings[name]) for name in names} | (row or {"status": REFUSED}))
    return Table([settings for settings, _ in members], names, texts, [error for _, error in outcomes])


@contextlib.contextmanager
def _between_computations(executor: Any) -> Iterator[None]:
    """Waits until no thread computes, if the executor copies this process in the block."""
    if not isinstance(executor, concurrent.futures.ProcessPoolExecutor):
        yield
        return
    from . import _solver

    _solver.begin_fork()
    try:
        yield
    finally:
        _solver.end_fork()


def _refuse_functions_for_processes(members: list[tuple[dict[str, Any], Any]], executor: Any) -> None:
    """Raises CaseError for functions that pickle cannot send: lambdas, and functions within functions. An executor may never
    return from them. Executors of threads and Dask's do not use pickle."""
    uses_pickle = executor is None or isinstance(executor, concurrent.futures.ProcessPoolExecutor)
    if not uses_pickle and not type(executor).__module__.startswith("mpi4py."):
        return
    for function in (f for _, member in members if isinstance(member, Case) for f in member._functions.values()):
        try:
            pickle.dumps(function)
        except (pickle.PicklingError, AttributeError, TypeError):
            raise CaseError(
                f"error: the function {getattr(function.f, '__qualname__', function.f)} of the case cannot go to another process\n"
                "   define it with def at the top of a module or of a cell, or solve in this process: workers=1, or "
                "executor=concurrent.futures.ThreadPoolExecutor()\n"
            ) from None


def _solve_one(state: Any, folder: str | None, report: bool) -> tuple[dict[str, str] | None, str | None]:
    """Solves a case in a process of an executor: returns (row, None), or (None, error)."""
    from .solving import solve

    case = Case.__new__(Case)
    try:
        case.__setstate__(state)
        result = solve(case, output=folder, report=report, comm="self", threads=1, warn=False)
        if result.status == "interrupted":
            raise KeyboardInterrupt
        return _row(result._data), None
    except CaseError as error:
        return None, str(error)


def _row(results: dict[str, Any]) -> dict[str, str]:
    return dict(_case.result_row(json.dumps(results)))


def _results_in(folder: str | None, case: Case) -> dict[str, Any] | None:
    """Returns the results of the same case in a folder, or None."""
    if folder is None or case._functions:  # what a function computes cannot be told from its text
        return None
    results = _case.finished_results(folder, case.text, list(case.files.items()))
    return None if results is None else dict(json.loads(results))


def _text(value: Any) -> str:
    return value if isinstance(value, str) else str(toml_text.value(value, {})).strip('"')


def _cores() -> int:
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
