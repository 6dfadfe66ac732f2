"""Solving, loading and verifying."""

from __future__ import annotations

import json
import pathlib
import shutil
import sys
import tempfile
import warnings
from typing import Any, Callable

from .case import Case, Path
from .errors import PlastronWarning, ResultsError
from .progress import Progress
from .result import Record, Result


def solve(
    case: Case,
    *,
    output: Path | None = None,
    report: bool = True,
    progress: bool = False,
    on_mesh: Callable[[int, Record], Any] | None = None,
    on_iteration: Callable[[int, Record], Any] | None = None,
    on_instant: Callable[[Record], Any] | None = None,
    comm: Any = "world",
    threads: int = 0,
    warn: bool = True,
) -> Result:
    """Solves a case and returns its Result.

    output: folder for the files that ``plastron run`` writes. Without it they are written when they are needed.
    report: whether report.html is one of them.
    progress: shows a line of progress (with tqdm a bar).
    on_mesh(number, record), on_iteration(number, record), on_instant(record): functions that follow the computation; the
        records have the entries of levels[], levels[].history[] and history[] of results.json. An exception ends it.
    comm: "world", "self", or a communicator of mpi4py. The function is collective on it.
    threads: largest number of threads; 0: by the amount of work. It counts only before the first computation.
    warn: whether warnings about the result are told as PlastronWarning. ``result.warnings`` has them in any case.

    Ctrl-C ends the computation after the present step: the result is that of the last finished mesh, with the status
    "interrupted". Raises CaseError for a case that cannot be solved, OutputError where files
    cannot be written, and KeyboardInterrupt where no mesh was finished.
    """
    from . import _solver

    if not isinstance(case, Case):
        raise TypeError(f"solve() takes a plastron.Case, not {type(case).__name__}; Case.read() reads a file")
    _solver.start_session(threads)
    is_first = _solver.rank(comm) == 0  # the others tell nothing
    bar = Progress() if progress and is_first else None
    told: set[str] = set()

    def tell(text: str) -> None:
        told.add(text)
        if warn and is_first:
            warnings.warn(text, PlastronWarning, stacklevel=_level_of_caller())

    followers = _solver.Followers(
        bar.phase if bar else None,
        _both(bar and bar.iteration, _with_record(on_iteration)),
        _both(bar and bar.mesh, _with_record(on_mesh)),
        _both(bar and bar.instant, _with_record(on_instant)),
        tell,
    )
    directory = pathlib.Path(output) if output is not None else pathlib.Path(tempfile.mkdtemp(prefix="plastron-"))
    try:
        native, interrupted, shared = _solver.solve(
            case._native(), str(directory), output is None, report, comm, followers
        )
        if interrupted and native.status == "interrupted" and not json.loads(native.results_json()).get("levels"):
            raise KeyboardInterrupt
    except BaseException:
        if output is None:
            shutil.rmtree(directory, ignore_errors=True)
        raise
    finally:
        if bar:
            bar.close()
    if pathlib.Path(shared) != directory:
        shutil.rmtree(directory, ignore_errors=True)  # the files are in the folder of the first rank
    directory = pathlib.Path(shared)
    data = _read_results(directory) if output is not None else json.loads(native.results_json())
    for text in data.get("warnings", []):
        if text not in told:
            tell(text)
    if native.status != "solved":
        tell(f"{native.status}: {native.status_text}")
    return Result(native, case, data, directory, output is None, comm)


def load(directory: Path, files: Path | None = None, comm: Any = "world") -> Result:
    """Loads written results. Their numbers are those of results.json. The solution is read, and verified on the way: a failure
    is a PlastronWarning. The cells may be in another order. Results of an interrupted run may have no solution that can be read: they have numbers only.
    ``files``: folder of the files that the case names, if they have moved."""
    from . import _solver

    folder = pathlib.Path(directory)
    data = _read_results(folder)
    native, failures = None, []
    try:
        native, verdict = _solver.load(str(folder), str(files or ""), comm)
        failures = verdict["failures"]
    except ResultsError as error:
        if data.get("status") == "solved":
            raise
        failures = [str(error)]
    for text in failures:
        warnings.warn(f"{folder}: {text}", PlastronWarning, stacklevel=2)
    stored = data["verification"]["case"]
    origin = pathlib.Path(stored["path"])
    text = (folder / stored["copy"]).read_text(encoding="utf-8")
    case = Case.from_text(text, pathlib.Path(files or origin.parent) / origin.name)
    return Result(native, case, data, folder, False, comm)


class Verification:
    """The judgement of ``plastron verify``. ``failures`` says in words what fails; ``rows`` are the rows of the certificate (row,
    value, limit, is_least, unit, holds), ``numbers`` the compared numbers (path, recomputed, claimed, tolerance, agrees)."""

    def __init__(self, verdict: dict[str, Any]) -> None:
        self.failures = list(verdict["failures"])
        self.rows = list(verdict["rows"])
        self.numbers = [
            (path, json.loads(recomputed), json.loads(claimed), tolerance, agrees)
            for path, recomputed, claimed, tolerance, agrees in verdict["numbers"]
        ]

    @property
    def has_passed(self) -> bool:
        return not self.failures

    def __bool__(self) -> bool:
        return self.has_passed

    def __repr__(self) -> str:
        return "PASSED" if self.has_passed else "FAILED: " + "; ".join(self.failures)


def verify(directory: Path, files: Path | None = None, comm: Any = "world") -> Verification:
    """Computes the certificate of written results again from the files, as ``plastron verify`` does, and compares them. Raises
    ResultsError where there is nothing to verify."""
    from . import _solver

    return Verification(_solver.verify(str(directory), str(files or ""), comm))


def _read_results(folder: pathlib.Path) -> dict[str, Any]:
    try:
        return dict(json.loads((folder / "results.json").read_text(encoding="utf-8")))
    except FileNotFoundError:
        raise ResultsError(f"{folder} has no results.json; give the folder that plastron wrote") from None
    except ValueError as error:
        raise ResultsError(f"{folder / 'results.json'} is no JSON: {error}") from None


def _level_of_caller() -> int:
    """Returns the stack level of the line outside of this package, for a function that warns."""
    level, frame = 1, sys._getframe(1)
    while frame.f_back is not None and frame.f_globals.get("__name__", "").startswith("plastron."):
        level, frame = level + 1, frame.f_back
    return level


def _with_record(function: Callable[..., Any] | None) -> Any:
    """Returns a function whose last argument is the text of a record; None for none."""
    if function is None:
        return None
    told = function

    def tell(*arguments: Any) -> None:
        told(*arguments[:-1], Record(json.loads(arguments[-1])))

    return tell


def _both(first: Any, second: Any) -> Any:
    functions = [f for f in (first, second) if f]
    if not functions:
        return None

    def call(*arguments: Any) -> None:
        for function in functions:
            function(*arguments)

    return call
