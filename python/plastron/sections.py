"""The sections of the case file, made from its declarations: Shell(thickness=0.01, ...) is a dictionary with these keys.

``Case(shell=Shell(E=1, nu=0.3, thickness=0.01), support=[Support(boundary="rim", fix=["u", "r"])])``. Every class shows its
keys with units, ranges and defaults in ``help()``. The names are those of the case file: ``obstacle.ball`` is ObstacleBall.
"""

import inspect
import keyword

from . import _case


def class_name(path):
    """Returns the name of the class of a section: obstacle.ball -> ObstacleBall."""
    return "".join(word.capitalize() for word in path.replace(".", "_").split("_"))


def _make(path, meaning, keys):
    def __init__(self, **values):
        unknown = [name for name in values if keys and name not in names]
        if unknown:
            raise TypeError(f"{self.__class__.__name__} has no key {unknown[0]!r}; its keys are {', '.join(names)}")
        dict.__init__(self, {name: value for name, value in values.items() if value is not None})

    names = [key[0] for key in keys]
    lines = [f"[{path}]: {meaning}", ""]
    for name, kind, unit, default, allowed, text, required in keys:
        facts = [kind] + [f"unit {unit}"] * bool(unit) + [allowed] * bool(allowed)
        facts.append("required" if required else f"default {default}" if default else "optional")
        lines += [f"{name}: {text}", f"    {'; '.join(facts)}"]
    usable = [name for name in names if name.isidentifier() and not keyword.iskeyword(name)]
    __init__.__signature__ = inspect.Signature(
        [inspect.Parameter("self", inspect.Parameter.POSITIONAL_OR_KEYWORD)]
        + [inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=None) for name in usable]
    )
    name = class_name(path)
    return type(name, (dict,), {"__init__": __init__, "__doc__": "\n".join(lines), "__module__": __name__, "path": path})


for _path, _meaning, _keys in _case.declarations():
    if _path:
        globals()[class_name(_path)] = _make(_path, _meaning, _keys)

__all__ = sorted(name for name in globals() if name[0].isupper())
