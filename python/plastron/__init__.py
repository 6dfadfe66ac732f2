"""Plastron: thin elastic shells pressed on rigid obstacles.

    import plastron
    case = plastron.Case.read("case.toml")
    case["shell.thickness"] = 0.01
    result = plastron.solve(case, progress=True)
    print(result.energy, result.unit_of("energy"))
"""

from ._case import version as __version__
from .case import Case, Finding
from .errors import CaseError, OutputError, PlastronError, PlastronWarning, PointError, ResultsError

_LAZY = {
    "Result": "result",
    "Record": "result",
    "solve": "solving",
    "load": "solving",
    "verify": "solving",
    "Verification": "solving",
    "LoadCase": "load_cases",
    "combine": "load_cases",
    "Function": "functions",
    "components": "functions",
    "sweep": "sweeping",
    "differences": "sweeping",
    "Table": "sweeping",
    "sections": "sections",
}

__all__ = ["Case", "CaseError", "Finding", "OutputError", "PlastronError", "PlastronWarning", "PointError", "ResultsError", *_LAZY]


def __getattr__(name):
    """Loads NumPy and the solver only when they are needed, so that the import is fast."""
    if name not in _LAZY:
        raise AttributeError(f"module 'plastron' has no attribute {name!r}")
    import importlib

    module = importlib.import_module("." + _LAZY[name], __name__)
    return module if _LAZY[name] == name else getattr(module, name)


def __dir__():
    return sorted(__all__)
