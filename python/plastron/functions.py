"""Functions of Python in cases, for what no expression says: thickness, loads, charts, obstacles."""

from __future__ import annotations

import inspect
import sys
import traceback
import uuid
import weakref
from typing import Any, Callable, Iterable

import numpy as np

from . import _case
from .errors import CaseError, FunctionError

_NAMES = ("x", "y", "X", "Y", "Z")
# Pairs of coordinates of the second derivatives, in the order of the library.
_PAIRS_OF_PARAMETERS = ((0, 0), (0, 1), (1, 1))
_PAIRS_OF_SPACE = ((2, 2), (2, 3), (2, 4), (3, 3), (3, 4), (4, 4))
# A central difference of order 6: steps and their weights.
_DIFFERENCE = ((1, 3 / 4), (2, -3 / 20), (3, 1 / 60), (-1, -3 / 4), (-2, 3 / 20), (-3, -1 / 60))
_COMPARED_PLACES = 200  # at so many places given derivatives are compared with differences


def _directions(arguments: list[int], number: int) -> tuple[int, ...]:
    """Returns the coordinates by which derivative `number` of the library differentiates."""
    in_space = max(arguments) > 1
    first = [(k,) for k in ((2, 3, 4) if in_space else (0, 1))]
    all_of_them: list[tuple[int, ...]] = [(), *first, *(_PAIRS_OF_SPACE if in_space else _PAIRS_OF_PARAMETERS)]
    return all_of_them[number]


def _number_of(arguments: list[int], axis: int) -> int:
    """Returns the number of the first derivative along a coordinate."""
    return axis - 1 if max(arguments) > 1 else axis + 1


def _number_of_pair(pair: tuple[int, int]) -> int:
    """Returns the number of the second derivative by two coordinates, in the order of the library."""
    return 4 + _PAIRS_OF_SPACE.index(pair) if pair in _PAIRS_OF_SPACE else 3 + _PAIRS_OF_PARAMETERS.index(pair)


def _by(arguments: list[int], number: int) -> str:
    """"by x and y" """
    return "by " + " and ".join(_NAMES[axis] for axis in _directions(arguments, number))


def _count(places: Any) -> str:
    return f"{len(places)} place" + "s" * (len(places) != 1)


class _Stencil:
    """Places around a place, in steps, and the weights of the values there for each derivative. With complex steps,
    ``directions`` are those of the imaginary part, which gives one derivative exactly; else None. The sums are divided by the
    step to the power of ``orders``."""

    def __init__(self, arguments: list[int], numbers: Iterable[int], is_complex: bool) -> None:
        points: dict[Any, int] = {}
        rows: list[Any] = []
        values: list[bool] = []
        for number in numbers:
            axes = _directions(arguments, number)
            terms: dict[Any, float] = {} if any(axis not in arguments for axis in axes) else {((0.0,) * len(_NAMES), None): 1.0}
            differences = axes
            if is_complex and axes:
                terms = {(offset, axes[0]): weight for (offset, _), weight in terms.items()}
                differences = axes[1:]
            for axis in differences:
                terms = _difference_of(terms, axis)
            rows.append(({points.setdefault(point, len(points)): weight for point, weight in terms.items()}, len(differences)))
            values.append(not axes)
        self.is_value = np.array(values)
        self.offsets = np.array([offset for offset, _ in points])
        self.directions = np.array([[axis == k for k in range(len(_NAMES))] for _, axis in points], float) if is_complex else None
        self.weights = np.zeros((len(rows), len(points)))
        for i, (weights, _) in enumerate(rows):
            self.weights[i, list(weights)] = list(weights.values())
        self.orders = np.array([order for _, order in rows])


def _difference_of(terms: dict[Any, float], axis: int) -> dict[Any, float]:
    """Returns the terms of the difference along a coordinate: (offset, direction) -> weight."""
    result: dict[Any, float] = {}
    for (offset, direction), weight in terms.items():
        for steps, factor in _DIFFERENCE:
            moved = (*offset[:axis], offset[axis] + steps, *offset[axis + 1 :])
            result[moved, direction] = result.get((moved, direction), 0.0) + weight * factor
    return result


class Function:
    """A function of Python in a case: ``case["shell.thickness"] = Function(lambda x, y: 0.01 + 0.002 * np.cos(x))``.

    f: takes arrays and returns an array, or one number that holds at all places. Its arguments are some of x, y (parameters
        of the domain), X, Y, Z (places in space), in any order; X is the array of the X coordinates.
    gradient: a function with the same arguments that returns the list of the first derivatives, in the order of the
        arguments. Needed by charts, heights and distances only. Without it they come from the complex step
        f(x + i h) / h, which has no rounding but needs a function that takes complex numbers (no abs, max, comparison);
        ``step`` then is not used. Where the function cannot take them, differences of order 6 with ``step`` are taken.
    second: likewise the second derivatives: xx, xy, yy or XX, XY, XZ, YY, YZ, ZZ, those of the arguments that there are.
        Without it differences of order 6 of the first derivatives are taken; their error is about (step / scale)^6 of the
        function, plus rounding.
        Given derivatives are compared with differences at 200 places of the first calls; wrong ones raise CaseError.
    scale: a length over which the function changes much [the unit of its arguments]; default: the range of the places at which
        it was called so far, which holds the shell. Give it for a shell that is small and far from the origin.
    step: step of these differences; default 1e-3 ``scale``.

    A plain function is taken as Function(f). Files of such a case name the function but do not contain it, so that
    ``plastron verify`` cannot read them; Result.verify() in the same process can.
    """

    def __init__(
        self,
        f: Callable[..., Any],
        gradient: Callable[..., Any] | None = None,
        second: Callable[..., Any] | None = None,
        step: float | None = None,
        scale: float | None = None,
    ) -> None:
        self.f, self.gradient, self.second, self.step, self.scale = f, gradient, second, step, scale
        self.arguments = _arguments(f)
        self._takes_complex: bool | None = None
        self._compared_places = 0
        self._wrong: str | None = None  # what is wrong with the given derivatives
        self._lowest, self._highest = np.full(len(_NAMES), np.inf), np.full(len(_NAMES), -np.inf)
        self._stencils: dict[Any, _Stencil] = {}
        self._known_to: set[str] = set()
        self.name = f"python_{_identifier(f)}_{uuid.uuid4().hex}"  # no two functions may be taken for one

    def __call__(self, *arguments: Any) -> Any:
        return self.f(*arguments)

    def evaluate(self, places: Any, first: int, count: int) -> Any:
        """Returns the derivatives first, ..., first + count - 1 at places, as the library numbers them."""
        self._lowest = np.minimum(self._lowest, places.min(axis=0))
        self._highest = np.maximum(self._highest, places.max(axis=0))
        if first == 0 and count == 1:
            return self._values(self.f, places)
        if self.gradient is not None:
            self._compare(places)
            return np.array([self._with_gradient(places, number) for number in range(first, first + count)])
        return self._by_stencil(places, range(first, first + count))

    def _values(self, f: Callable[..., Any], places: Any, kind: type = float) -> Any:
        def values_at(places: Any) -> Any:
            given = f(*[places[:, k] for k in self.arguments])
            if given is None:
                raise FunctionError("returns None; does it end without a return?")
            return np.asarray(given, dtype=kind)

        value: Any = values_at(places)
        if value.ndim == 0:
            if not self._is_constant(values_at, places, value):
                raise FunctionError(
                    f"returns one number for {_count(places)}, and another number for others; its arguments are arrays of "
                    "coordinates, and it returns an array with a value for each place, or one constant"
                )
            return np.full(len(places), value)
        if value.shape != (len(places),):
            raise FunctionError(f"returns an array of shape {value.shape} for {_count(places)}")
        return value

    def _is_constant(self, values_at: Callable[..., Any], places: Any, value: Any) -> bool:
        """Whether a single number does not depend on the places. A function that is written for one place returns its value there."""
        beside = places[:1] + 0.1 * (self._highest - self._lowest + np.abs(places[0]) + (len(places) == 1))
        others = [places[:1], places[-1:], np.vstack([beside, places[:1]])]
        try:
            found = [values_at(other) for other in others[(len(places) == 1) * 2 :]]
        except Exception:  # not defined beside the places
            found = []
        return all(np.array_equal(other, value, equal_nan=True) for other in found)

    def _part(self, f: Callable[..., Any], step: float | None = None) -> Function:
        """Returns a function of the same arguments and places without given derivatives."""
        part = Function(self.f, step=step or self.step, scale=self.scale)
        part.f = f
        part._lowest, part._highest = self._lowest, self._highest
        return part

    def _compare(self, places: Any) -> None:
        """Compares given derivatives with differences of what they are derivatives of. Where two steps give different
        differences, the function is not smooth enough to judge."""
        if self._wrong:  # a caller may have tried other places after the first error
            raise FunctionError(self._wrong)
        in_space = max(self.arguments) > 1
        if self._compared_places >= _COMPARED_PLACES or any((axis > 1) != in_space for axis in self.arguments):
            return
        left = _COMPARED_PLACES - self._compared_places
        places = places[:: max(1, len(places) // left)][:left]  # spread over all places of the call
        numbers = [_number_of(self.arguments, axis) for axis in self.arguments]
        self._compare_with(self.f, places, numbers, "gradient")
        if self.second is not None:
            for i, axis in enumerate(self.arguments):
                axes = [(min(axis, other), max(axis, other)) for other in self.arguments]
                # The second derivative by `axis` and each other one is that of the entry of the gradient for `axis`.
                self._compare_with(_entry(self.gradient, i), places, numbers, "second", [_number_of_pair(pair) for pair in axes])
        self._compared_places += len(places)  # places of an interrupted comparison do not count

    def _compare_with(self, f: Callable[..., Any], places: Any, numbers: list[int], what: str, given_numbers: Any = None) -> None:
        try:
            step = self.step or 1e-3 * self._length()
            with np.errstate(all="ignore"):
                fine, coarse = (self._part(f, s)._by_stencil(places, numbers) for s in (step / 2, step))
                values = self._values(f, places)
        except Exception:  # the function cannot be evaluated beside these places
            return
        given = np.array([self._with_gradient(places, number) for number in (given_numbers or numbers)])
        size = np.max(np.abs(fine), initial=0) + 1e-8 * np.max(np.abs(values), initial=0) / self._length()
        wrong = (np.abs(fine - coarse) <= 1e-5 * size) & ~(np.abs(given - fine) <= 1e-3 * size)
        if wrong.any():
            k, i = np.argwhere(wrong)[0]
            place = ", ".join(f"{_NAMES[axis]} = {places[i, axis]:.6g}" for axis in self.arguments)
            self._wrong = (
                f"has a wrong derivative: `{what}` gives {given[k, i]:.6g} {_by(self.arguments, (given_numbers or numbers)[k])} "
                f"at {place}, and differences give {fine[k, i]:.6g}; correct it, or leave it out"
            )
            raise FunctionError(self._wrong)

    def _by_stencil(self, places: Any, numbers: Iterable[int], is_complex: bool | None = None) -> Any:
        """Values and derivatives from one call of f, at all places of a stencil. ``is_complex``: whether the step is complex; if it is
        not given, the function is tried."""
        stencil = self._stencil(tuple(numbers), self._is_analytic(places) if is_complex is None else is_complex)
        scale = self._length()
        step = self.step or 1e-3 * scale
        moved = (places[None, :, :] + stencil.offsets[:, None, :] * step).reshape(-1, len(_NAMES))
        if stencil.directions is None:
            values = self._values(self.f, moved).reshape(len(stencil.offsets), -1)
            return (stencil.weights @ values) / step ** stencil.orders[:, None]
        h = 1e-30 * scale
        moved = moved + 1j * h * np.repeat(stencil.directions, len(places), axis=0)
        values = self._values(self.f, moved, complex).reshape(len(stencil.offsets), -1)
        sums = np.where(stencil.is_value[:, None], stencil.weights @ values.real, stencil.weights @ (values.imag / h))
        return sums / step ** stencil.orders[:, None]

    def _length(self) -> float:
        """The scale: as given, or the range of the places so far, or the distance of a single place from the origin."""
        if self.scale is not None:
            return self.scale
        low, high = self._lowest[self.arguments], self._highest[self.arguments]
        length = float(np.max(high - low)) or float(np.max(np.abs(high)))
        if length == 0:
            raise ValueError("differences at the origin alone need a scale: Function(f, scale=...)")
        return length

    def _stencil(self, numbers: tuple[int, ...], is_complex: bool) -> _Stencil:
        known = self._stencils.get((numbers, is_complex))
        if known is None:
            known = self._stencils[numbers, is_complex] = _Stencil(self.arguments, numbers, is_complex)
        return known

    def _with_gradient(self, places: Any, number: int) -> Any:
        axes = _directions(self.arguments, number)
        if any(axis not in self.arguments for axis in axes):
            return np.zeros(len(places))
        if not axes:
            return self._values(self.f, places)
        first = self.arguments.index(axes[0])
        if len(axes) == 1:
            return self._values(_entry(self.gradient, first), places)
        if self.second is not None:
            known = sorted(self.arguments)
            pairs = [(i, j) for n, i in enumerate(known) for j in known[n:]]
            return self._values(_entry(self.second, pairs.index((axes[0], axes[1]))), places)
        return self._part(_entry(self.gradient, first))._by_stencil(places, [_number_of(self.arguments, axes[1])])[0]

    def _is_analytic(self, places: Any) -> bool:
        """Whether the function takes complex numbers, found out at its first call: the complex step must agree with differences."""
        if self._takes_complex is None:
            first = tuple(_number_of(self.arguments, axis) for axis in self.arguments)
            exact = None
            try:
                with np.errstate(all="raise"):
                    exact = self._by_stencil(places, first, is_complex=True)
            except Exception:  # any failure means that the function does not take complex numbers
                pass
            agrees = False
            if exact is not None:
                values, differences = self._values(self.f, places), self._by_stencil(places, first, is_complex=False)
                size = np.max(np.abs(differences)) + np.max(np.abs(values)) / self._length()
                agrees = bool(np.all(np.abs(exact - differences) <= 1e-5 * size))
            self._takes_complex = agrees  # at the end: Ctrl-C in f leaves the question open
        return self._takes_complex

    def _give(self, module: Any) -> None:
        """Makes the function known to a module as long as it lives."""
        if module.__name__ in self._known_to:
            return
        function = weakref.ref(self)
        depends = [k in self.arguments for k in range(len(_NAMES))]
        module.give_function(self.name, depends, lambda *arguments: function()._answer(*arguments))  # type: ignore[union-attr]
        self._known_to.add(module.__name__)
        weakref.finalize(self, module.forget_function, self.name)

    def _answer(self, *arguments: Any) -> Any:
        """As evaluate(). Errors are FunctionErrors in the words of a message."""
        name = _title(self.f)
        try:
            return self.evaluate(*arguments)
        except FunctionError as error:
            raise FunctionError(f"{name} {error}") from None
        except Exception as error:
            own_file = _code(self.f).co_filename if _code(self.f) else None
            lines = [frame.lineno for frame in traceback.extract_tb(error.__traceback__) if frame.filename == own_file]
            place = f" ({own_file}, line {lines[-1]})" if lines else ""
            words = " ".join(str(error).split())
            raise FunctionError(f"{name} failed: {type(error).__name__}: {words}{place}") from error

    def __getstate__(self) -> dict[str, Any]:
        return self.__dict__ | {"_known_to": set()}  # another process has modules of its own

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Function) and self.name == other.name

    def __hash__(self) -> int:
        return hash(self.name)


def _entry(f: Any, number: int) -> Callable[..., Any]:
    """Returns the function of one of the arrays that f returns."""
    return lambda *arguments: f(*arguments)[number]


def components(f: Callable[..., Any], **options: Any) -> list[Function]:
    """Returns three Functions of one that returns three arrays: ``chart = components(lambda x, y: (x, y, x**2 - y**2))``. The
    options are those of Function, without gradient and second."""
    return [Function(_Component(f, k), **options) for k in range(3)]


class _Component:
    """One of the arrays that a function returns. Unlike a function within a function it can go to another process."""

    def __init__(self, f: Callable[..., Any], number: int) -> None:
        self._f, self._number = f, number
        self.__name__, self.__qualname__ = f"{_identifier(f)}_{number}", getattr(f, "__qualname__", str(f))

    @property
    def __signature__(self) -> inspect.Signature:
        return inspect.signature(self._f)

    def __call__(self, *arguments: Any) -> Any:
        return self._f(*arguments)[self._number]


def as_function(given: Any) -> Function:
    """Returns a Function for a Function or a plain function."""
    return given if isinstance(given, Function) else Function(given)


def give(functions: dict[str, Function]) -> None:
    """Makes functions known to the modules that read cases."""
    for function in functions.values():
        function._give(_case)
        solver = sys.modules.get("plastron._solver")
        if solver is not None:
            function._give(solver)


def _arguments(f: Callable[..., Any]) -> list[int]:
    names = [p.name for p in inspect.signature(f).parameters.values() if p.default is p.empty]
    wrong = [name for name in names if name not in _NAMES]
    if wrong or not names:
        raise CaseError(f"error: a function in a case takes some of x, y, X, Y, Z, not {', '.join(wrong) or 'nothing'}\n")
    return [_NAMES.index(name) for name in names]


def _identifier(f: Any) -> str:
    name = getattr(f, "__name__", type(f).__name__)
    return "".join(c if c.isalnum() and c.isascii() else "_" for c in name).strip("_") or "function"


def _code(f: Any) -> Any:
    return getattr(f, "__code__", None)


def _title(f: Any) -> str:
    """The function in messages: its name, or its place."""
    code = _code(f)
    if code is not None and code.co_name == "<lambda>":
        return f"the function in line {code.co_firstlineno} of {code.co_filename}"
    return f'the function "{_identifier(f)}"'
