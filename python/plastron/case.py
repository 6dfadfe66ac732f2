"""Cases: what is to be computed."""

import json
import os
import pathlib
import re

from . import _case, toml_text
from .errors import CaseError

_PART = re.compile(r"^([^.\[\]]+)((?:\[\d+\])*)$")


class Finding:
    """One finding of an examination: ``severity`` is "error", "warning" or "note"."""

    def __init__(self, severity, text):
        self.severity = severity
        self.text = text

    def __repr__(self):
        return f"{self.severity}: {self.text}"

    def __eq__(self, other):
        return isinstance(other, Finding) and (self.severity, self.text) == (other.severity, other.text)


class Case:
    """A case: geometry, shell, supports, loads, obstacles, mesh.

    ``Case.read("case.toml")`` reads a file, ``Case.from_text`` a text, ``Case.from_dict`` a dictionary of the same form, and
    ``Case(shell={...}, geometry={...}, support=[{...}])`` takes the sections as keywords. Repeated sections are lists. The
    keys, their units and defaults are those of the case file: ``help(plastron.sections.Shell)``.

    ``case["shell.thickness"]`` is the value in force, also where it is a default. ``case["shell.thickness"] = 0.01`` replaces
    it; ``case["load[0].pressure"]`` is a key of the first [[load]]. Cases are checked at once: unknown keys and bad values
    raise CaseError, with the words of the command line.
    """

    def __init__(self, **sections):
        self._set(toml_text.document(sections), "case.toml", [])

    @classmethod
    def read(cls, path, settings=()):
        """Reads a case file. ``settings`` are texts such as "shell.thickness=0.01", as after --set."""
        path = pathlib.Path(path)
        try:
            text = path.read_bytes().decode("utf-8")
        except FileNotFoundError:
            raise CaseError(f"{path}: error: there is no such file\n") from None
        except (OSError, UnicodeDecodeError) as error:
            raise CaseError(f"{path}: error: the file cannot be read: {error}\n") from None
        return cls.from_text(text, path, settings)

    @classmethod
    def from_text(cls, text, file_name="case.toml", settings=()):
        """Reads a case from the text of a case file. Other files that it names are sought in the folder of ``file_name``."""
        case = cls.__new__(cls)
        case._set(text, os.fspath(file_name), list(settings))
        return case

    @classmethod
    def from_dict(cls, sections, folder="."):
        """Makes a case from a dictionary in the form of the case file. Files that it names are sought in ``folder``."""
        return cls.from_text(toml_text.document(sections), pathlib.Path(folder) / "case.toml")

    def _set(self, text, file_name, settings):
        effective, self._text, files = _case.read(text, file_name, settings)
        self._given, self._file_name, self._settings = text, file_name, settings
        self._effective = json.loads(effective)
        self._files = dict(files)

    @property
    def text(self):
        """The text of the case file, with the settings."""
        return self._text

    @property
    def file_name(self):
        """The name of the case file, or "case.toml" for a case that has none."""
        return self._file_name

    @property
    def title(self):
        """The title, or ""."""
        return self._effective.get("title", "")

    @property
    def settings(self):
        """The settings that replace keys of the text."""
        return tuple(self._settings)

    @property
    def files(self):
        """The files that the case names: name -> path."""
        return dict(self._files)

    def to_dict(self):
        """Returns all settings with their defaults, in the form of the case file."""
        return json.loads(json.dumps(self._effective))

    def __getitem__(self, key):
        value = self._effective
        for part in _parts(key):
            try:
                value = value[part]
            except (KeyError, IndexError, TypeError):
                raise KeyError(f"{key}: this case has no such key") from None
        return value

    def __setitem__(self, key, value):
        others = [s for s in self._settings if s.split("=", 1)[0].strip() != key]
        self._set(self._given, self._file_name, others + [f"{key}={toml_text.value(value)}"])

    def __contains__(self, key):
        try:
            self[key]
        except KeyError:
            return False
        return True

    def with_settings(self, settings):
        """Returns a copy with the values of a dictionary: key -> value."""
        copy = self.copy()
        for key, value in settings.items():
            copy[key] = value
        return copy

    def copy(self):
        """Returns a copy that can be changed by itself."""
        return self.from_text(self._given, self._file_name, self._settings)

    __copy__ = copy

    def __deepcopy__(self, memo):
        return self.copy()

    def __getstate__(self):
        return (self._given, self._file_name, self._settings)

    def __setstate__(self, state):
        self._set(*state)

    def check(self, comm="world"):
        """Examines the case without solving it, and returns the findings: errors, warnings and notes."""
        from . import _solver

        return [Finding(severity, text) for severity, text in _solver.check(self._native(), comm)]

    def solve(self, **options):
        """Solves the case; the options are those of plastron.solve()."""
        from .solving import solve

        return solve(self, **options)

    def _native(self):
        from . import _solver

        return _solver.CaseText(self._given, self._file_name, self._settings)

    def __repr__(self):
        settings = "".join(f", {s}" for s in self._settings)
        return f"<plastron.Case {self.title or self._file_name!r}{settings}>"


def _parts(key):
    """Returns the steps of a key: "load[0].pressure" -> ["load", 0, "pressure"]."""
    steps = []
    for part in key.split("."):
        match = _PART.match(part)
        if not match:
            raise KeyError(f"{key}: a key has the form shell.thickness or load[0].pressure")
        steps.append(match[1])
        steps += [int(n) for n in re.findall(r"\d+", match[2])]
    return steps
