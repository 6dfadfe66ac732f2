"""Errors and warnings of Plastron."""

from __future__ import annotations

import re
from typing import Any, Iterable


def readable(text: str) -> str:
    """Returns a text of the library with the names that functions of Python have for the user."""
    return re.sub(r'(the distance expression )?"?\bpython_(\w+?)_[0-9a-f]{32}\b"?', r'the function "\2"', text)


class PlastronError(Exception):
    """Base class of all errors of this package."""


class CaseError(PlastronError, ValueError):
    """A case that cannot be solved, in the words of the command line.

    ``mistakes`` lists the mistakes of the text, each with ``file``, ``line``, ``column``, ``what``, ``allowed`` and
    ``advice``. It is empty for mistakes that only the examination or the solution finds.
    """

    def __init__(self, text: str, mistakes: Iterable[dict[str, Any]] = ()) -> None:
        super().__init__(readable(text))
        self.mistakes = list(mistakes)


class FunctionError(PlastronError):
    """A function of Python in a case that fails, or that returns what it must not. The case then has a CaseError."""


class ResultsError(PlastronError):
    """Written results that cannot be read, or parts that a result does not have."""


class PointError(PlastronError, ValueError):
    """A point at which a result has no values: outside of the domain, or not finite."""


class OutputError(PlastronError, OSError):
    """Results cannot be written."""


class PlastronWarning(UserWarning):
    """A warning about a result: the model, the mesh, or a status other than "solved"."""
