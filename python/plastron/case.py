"""Cases."""

from __future__ import annotations

import json
import os
import pathlib
import re
from typing import TYPE_CHECKING, Any, Iterable, Mapping, Union

from . import _case, toml_edit, toml_text
from .errors import readable

if TYPE_CHECKING:
    from .result import Result

Path = Union[str, "os.PathLike[str]"]

_PART = re.compile(r'(?:"((?:[^"\\]|\\.)*)"|([^."\[\]]+))((?:\[\d+\])*)(?:\.|$)')


class Finding:
    """One finding of an examination: ``severity`` is "error", "warning" or "note"."""

    def __init__(self, severity: str, text: str) -> None:
        self.severity = severity
        self.text = text

    def __repr__(self) -> str:
        return f"{self.severity}: {self.text}"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Finding) and (self.severity, self.text) == (other.severity, other.text)


class Case:
    """A case: geometry, shell, supports, loads, obstacles, mesh.

    ``Case.read("case.toml")`` reads a file, ``Case.from_text`` a text, ``Case.from_dict`` a dictionary of the same form, and
    ``Case(shell={...}, geometry={...}, support=[{...}])`` takes the sections as keywords. Repeated sections are lists. The
    keys, their units and defaults are those of the case file: ``help(plastron.sections.Shell)``.

    ``case["shell.thickness"]`` is the value in force, also where it is a default. ``case["shell.thickness"] = 0.01`` replaces
    it; ``case["load[0].pressure"]`` is a key of the first [[load]]. Sections are dictionaries, and lists of them are lists:
    ``case["load"] += [{"pressure": 1}]`` adds a [[load]], ``del case["load[0]"]`` removes one, ``case["probe"] = [...]`` replaces
    all. Values are copies: ``case["load"].append(...)`` does not change the case. ``del case["accuracy"]`` removes a section or a
    key from the text, so that defaults are in force. Comments elsewhere in the text stay.

    Cases are checked at once: unknown keys and bad values raise CaseError, with the words of the command line, and leave the case
    as it was. Functions of Python may stand for expressions of x, y, X, Y, Z: see plastron.Function.
    """

    def __init__(self, **sections: Any) -> None:
        functions: dict[str, Any] = {}
        self._set(toml_text.document(sections, functions), "case.toml", [], functions)

    @classmethod
    def read(cls, path: Path, settings: Iterable[str] = ()) -> Case:
        """Reads a case file. ``settings`` are texts such as "shell.thickness=0.01", as after --set."""
        _case.check_file(os.fspath(path), list(settings))
        return cls.from_text(pathlib.Path(path).read_bytes().decode("utf-8"), path, settings)

    @classmethod
    def from_text(cls, text: str, file_name: Path = "case.toml", settings: Iterable[str] = ()) -> Case:
        """Reads a case from the text of a case file. Other files that it names are sought in the folder of ``file_name``."""
        case = cls.__new__(cls)
        case._set(text, os.fspath(file_name), list(settings))
        return case

    @classmethod
    def from_dict(cls, sections: Mapping[str, Any], folder: Path = ".") -> Case:
        """Makes a case from a dictionary in the form of the case file. Files that it names are sought in ``folder``."""
        functions: dict[str, Any] = {}
        text = toml_text.document(sections, functions)
        case = cls.__new__(cls)
        case._set(text, os.fspath(pathlib.Path(folder) / "case.toml"), [], functions)
        return case

    def _set(
        self,
        text: str,
        file_name: str,
        settings: list[str],
        functions: dict[str, Any] | None = None,
        directory: str | None = None,
    ) -> None:
        """``directory``: the working directory from which ``file_name`` is seen; the present one, if it is not given."""
        functions = functions or {}
        directory = _working_directory() if directory is None else directory
        if functions:
            from .functions import give

            give(functions)
        effective, self._text, files = _case.read(text, _from_here(directory, file_name), settings)
        self._directory = directory
        self._given, self._file_name, self._settings, self._functions = text, file_name, settings, functions
        self._effective = json.loads(effective)
        self._files = dict(files)

    @property
    def text(self) -> str:
        """The text of the case file, with the settings."""
        return self._text

    @property
    def file_name(self) -> str:
        """The name of the case file, or "case.toml" for a case that has none."""
        return self._file_name

    @property
    def title(self) -> str:
        """The title, or ""."""
        return str(self._effective.get("title", ""))

    @property
    def settings(self) -> tuple[str, ...]:
        """The settings that replace keys of the text. A change of sections makes them a part of the text."""
        return tuple(self._settings)

    @property
    def files(self) -> dict[str, str]:
        """The files that the case names: name -> path."""
        return {name: _from_here(self._directory, path) for name, path in self._files.items()}

    def to_dict(self) -> dict[str, Any]:
        """Returns all settings with their defaults, in the form of the case file."""
        return dict(json.loads(json.dumps(self._effective)))

    def __getitem__(self, key: str) -> Any:
        value: Any = self._effective
        steps = _parts(key)
        while steps:
            step = steps.pop(0)
            if steps and isinstance(value, dict) and step not in value:
                step = f"{step}.{steps.pop(0)}"  # components of values are keys with a point: "u.z"
            try:
                value = value[step]
            except (KeyError, IndexError, TypeError):
                raise KeyError(f"{key}: this case has no such key") from None
        return json.loads(json.dumps(value))  # a copy: changes in it would not be part of the case

    def __setitem__(self, key: str, value: Any) -> None:
        self.update({key: value})

    def __delitem__(self, key: str) -> None:
        text = toml_edit.removed(self._plain_text(), tuple(_parts(key)))
        if text is None:
            raise KeyError(f"{key}: the text of this case has no such key" + " (its value is a default)" * (key in self))
        self._set(text, self._file_name, [], self._functions, self._directory)

    def update(self, settings: Mapping[str, Any]) -> None:
        """Replaces several values at once: key -> value. They need to fit together only afterwards."""
        functions = dict(self._functions)
        text, kept = self._given, self._settings
        sections = {key: value for key, value in settings.items() if self._is_section(key, value)}
        if sections:
            text, kept = self._plain_text(), []
        for key, value in sections.items():
            text = toml_edit.changed(text, tuple(_parts(key)), value, self[key], functions)
        added = [f"{key}={toml_text.value(value, functions)}" for key, value in settings.items() if key not in sections]
        replaced = tuple(key + end for key in settings for end in "=.[")
        kept = [s for s in kept if not s.replace(" ", "").startswith(replaced)]
        self._set(text, self._file_name, kept + added, functions, self._directory)

    def _is_section(self, key: str, value: Any) -> bool:
        """Whether a value takes the place of sections of the text. Others are settings, as after --set."""
        is_empty = isinstance(value, (list, tuple)) and len(value) == 0
        try:
            return (is_empty or toml_text.is_section(value)) and toml_edit.is_section(self._text, tuple(_parts(key)))
        except KeyError:  # the library says what is wrong with the key
            return False

    def _plain_text(self) -> str:
        """Returns the text with the settings as a part of it, without the comment of each setting."""
        return self._text.split("\n", len(self._settings))[-1]

    def __contains__(self, key: str) -> bool:
        try:
            self[key]
        except KeyError:
            return False
        return True

    def with_settings(self, settings: Mapping[str, Any]) -> Case:
        """Returns a copy with the values of a dictionary: key -> value."""
        copy = self.copy()
        copy.update(settings)
        return copy

    def copy(self) -> Case:
        """Returns a copy that can be changed by itself."""
        copy = type(self).__new__(type(self))
        copy.__setstate__(self.__getstate__())
        return copy

    __copy__ = copy

    def __deepcopy__(self, memo: Any) -> Case:
        return self.copy()

    def __getstate__(self) -> Any:
        return (self._given, self._file_name, list(self._settings), dict(self._functions), self._directory)

    def __setstate__(self, state: Any) -> None:
        self._set(*state)

    def check(self, comm: Any = "world") -> list[Finding]:
        """Examines the case without solving it, and returns the findings: errors, warnings and notes."""
        from . import _solver

        return [Finding(severity, text) for severity, text in _solver.check(self._native(), comm)]

    def solve(self, **options: Any) -> Result:
        """Solves the case; the options are those of plastron.solve()."""
        from .solving import solve

        return solve(self, **options)

    def _native(self) -> Any:
        from . import _solver

        for function in self._functions.values():
            function._give(_solver)
        return _solver.CaseText(self._given, _from_here(self._directory, self._file_name), self._settings)

    def __repr__(self) -> str:
        settings = readable("".join(f", {s}" for s in self._settings))
        return f"<plastron.Case {self.title or self._file_name!r}{settings}>"


def _working_directory() -> str:
    """Returns "" where it was removed."""
    try:
        return os.getcwd()
    except FileNotFoundError:
        return ""


def _from_here(directory: str, path: str) -> str:
    """Returns a path that is seen from a directory as one from the present working directory."""
    return path if directory == _working_directory() else os.path.join(directory, path)


def _parts(key: str) -> list[Any]:
    """Returns the steps of a key: "load[0].pressure" -> ["load", 0, "pressure"]."""
    steps: list[Any] = []
    at = 0
    while at < len(key) or not steps:
        match = _PART.match(key, at)
        if not match:
            raise KeyError(f"{key}: a key has the form shell.thickness or load[0].pressure")
        steps.append(match[2] if match[1] is None else match[1])
        steps += [int(n) for n in re.findall(r"\d+", match[3])]
        at = match.end()
    return steps
