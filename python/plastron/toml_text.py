"""TOML text of Python values. The standard library only reads TOML."""

from __future__ import annotations

import math
import numbers
from typing import Any, Mapping


def value(given: Any, functions: dict[str, Any] | None = None) -> str:
    """Returns a value in one line of TOML. Lists may be NumPy arrays; tables are inline. A function of Python is the text of its
    name, and becomes an entry of ``functions``."""
    if callable(given) and functions is not None:
        from .functions import as_function

        function = as_function(given)
        functions[function.name] = function
        return value(function.name)
    if isinstance(given, str):
        return '"' + "".join(_escaped(c) for c in given) + '"'
    if hasattr(given, "tolist"):  # arrays and numbers of NumPy
        return value(given.tolist(), functions)
    if isinstance(given, bool):
        return "true" if given else "false"
    if isinstance(given, numbers.Integral):
        return str(int(given))
    if isinstance(given, numbers.Real):
        number = float(given)
        return repr(number) if math.isfinite(number) else str(number)
    if isinstance(given, dict):
        return "{ " + ", ".join(f"{key(k)} = {value(v, functions)}" for k, v in given.items()) + " }" if given else "{}"
    if isinstance(given, (list, tuple)):
        return "[" + ", ".join(value(v, functions) for v in given) + "]"
    raise TypeError(f"a case has texts, numbers, lists and tables, not {type(given).__name__}: {given!r}")


def key(name: str) -> str:
    """Returns a key, in quotes where TOML wants them."""
    plain = name and all(c.isascii() and (c.isalnum() or c in "_-") for c in name)
    return name if plain else value(name)


def document(tables: Mapping[str, Any], functions: dict[str, Any] | None = None) -> str:
    """Returns the text of a file: values first, then a section for each table, and for each table of a list."""
    head = [f"{key(k)} = {value(v, functions)}" for k, v in tables.items() if not is_section(v)]
    parts = ["\n".join(head)] if head else []
    for name, given in tables.items():
        if is_section(given):
            parts += sections(key(name), given, functions)
    return "\n\n".join(parts) + "\n"


def sections(name: str, given: Any, functions: dict[str, Any] | None = None) -> list[str]:
    """Returns the text of a section, or of each section of a list. ``name`` is as it stands in brackets: "geometry.domain"."""
    header = f"[[{name}]]" if isinstance(given, (list, tuple)) else f"[{name}]"
    tables = given if isinstance(given, (list, tuple)) else [given]
    return ["\n".join([header, *(f"{key(k)} = {value(v, functions)}" for k, v in table.items())]) for table in tables]


def is_section(given: Any) -> bool:
    """Whether a value is written as a section, or as a list of sections."""
    return isinstance(given, dict) or (
        isinstance(given, (list, tuple)) and len(given) > 0 and all(isinstance(entry, dict) for entry in given)
    )


def _escaped(c: str) -> str:
    named = {'"': '\\"', "\\": "\\\\", "\n": "\\n", "\t": "\\t", "\r": "\\r"}
    if c in named:
        return named[c]
    if c.isprintable():
        return c
    return f"\\u{ord(c):04x}" if ord(c) < 0x10000 else f"\\U{ord(c):08x}"
