"""Changes of sections in a TOML text. The rest of the text stays as it is, with its comments. The library has read the text before,
so that it is valid TOML."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any, Sequence, Tuple, Union

from . import toml_text

Path = Tuple[Union[str, int], ...]  # ("load", 0, "pressure")

_BLANK = re.compile(r"(?:\s|#[^\n]*)*")
_NAME = re.compile(r"""[ \t]*("(?:[^"\\]|\\.)*"|'[^']*'|[\w-]+)[ \t]*(\.?)""")
_QUOTED = r'''"""(?:[^\\]|\\.)*?"""(?!")|\'\'\'.*?\'\'\'(?!\')|"(?:[^"\\\n]|\\.)*"|'[^'\n]*\''''
_SCALAR = re.compile(rf"{_QUOTED}|[^\s,\]}}#]+", re.S)


@dataclass
class _Part:
    """A header, a line with a key, or an entry of a list or table in brackets."""

    kind: str  # "header", "line", "entry"
    path: Path
    start: int
    end: int
    table: int = 0  # number of steps to the section of a line
    comma_before: int | None = None
    comma_after: int | None = None


class _Scanner:
    """Finds the parts of a text."""

    def __init__(self, text: str) -> None:
        self.text, self.at, self.parts = text, int(text.startswith("\ufeff")), []  # type: str, int, list[_Part]
        self._lengths: dict[Path, int] = {}  # of lists of sections

    def scan(self) -> list[_Part]:
        section: Path = ()
        while self._skip():
            start = self.at
            if self.text[start] == "[":
                section = self._header()
                self.parts.append(_Part("header", section, start, self.at))
            else:
                path = section + self._key()
                self._value(path)
                self.parts.append(_Part("line", path, start, self.at, len(section)))
        return sorted(self.parts, key=lambda part: (part.start, -part.end))

    def _skip(self) -> bool:
        """Goes on after spaces and comments. Returns whether there is more."""
        self.at = _BLANK.match(self.text, self.at).end()  # type: ignore[union-attr]
        return self.at < len(self.text)

    def _names(self) -> list[str]:
        names, goes_on = [], "."
        while goes_on:
            match: Any = _NAME.match(self.text, self.at)
            name, goes_on = match.groups()
            self.at = match.end()
            names.append(name[1:-1] if name[0] in "\"'" else name)
        return names

    def _header(self) -> Path:
        brackets = 2 if self.text.startswith("[[", self.at) else 1
        self.at += brackets
        path: Path = ()
        for name in self._names():
            path = self._last(path) + (name,)
        self.at += brackets
        if brackets == 2:
            self._lengths[path] = self._lengths.get(path, 0) + 1
        return self._last(path)

    def _last(self, path: Path) -> Path:
        """Returns the path of the last entry where the path is that of a list of sections."""
        return path + (self._lengths[path] - 1,) if path in self._lengths else path

    def _key(self) -> Path:
        names = self._names()
        self.at += 1  # the sign of equality
        self._skip()
        return tuple(names)

    def _value(self, path: Path) -> None:
        if self.text[self.at] in "[{":
            self._entries(path, "]" if self.text[self.at] == "[" else "}")
        else:
            self.at = _SCALAR.match(self.text, self.at).end()  # type: ignore[union-attr]

    def _entries(self, path: Path, close: str) -> None:
        number, comma = 0, None
        self.at += 1
        while self._skip() and self.text[self.at] != close:
            start = self.at
            whole = path + (self._key() if close == "}" else (number,))
            self._value(whole)
            part = _Part("entry", whole, start, self.at, comma_before=comma)
            self._skip()
            comma = self.at if self.text[self.at] == "," else None
            part.comma_after = comma
            self.parts.append(part)
            self.at += comma is not None
            number += 1
        self.at += 1


def is_section(text: str, path: Path) -> bool:
    """Whether a path is a section of the text, a list of sections, or has keys with dots."""
    below = _below(_Scanner(text).scan(), path)
    return any(part.kind == "header" or (part.kind == "line" and part.path != path) for part in below)


def removed(text: str, path: Path) -> str | None:
    """Returns the text without a path, or None where the text does not have it. Comments inside of it go, too."""
    spans = _spans(text, path)
    for start, end in reversed(spans):
        if re.search(r"(^|\n)[ \t\r]*\n$", text[:start]) or start == 0:  # one of two blank lines goes, too
            end += len(re.match(r"([ \t\r]*\n)?", text[end:])[0])  # type: ignore[index]
        text = text[:start] + text[end:]
    return text if spans else None


def changed(text: str, path: Path, value: Any, old: Any, functions: dict[str, Any]) -> str:
    """Returns the text with another section, or another list of sections. Entries of the list that are as in the old list keep
    their text."""
    if not isinstance(value, (list, tuple)) or not isinstance(old, list):
        return _replaced(text, path, value, functions)
    for i in reversed(range(len(old))):
        if i >= len(value):
            text = removed(text, path + (i,)) or text
        elif toml_text.value(value[i], functions) != toml_text.value(old[i]):
            text = _replaced(text, path + (i,), value[i], functions)
    new = value[len(old) :]
    if not new:
        return text
    end = _end_of_line(text, _below(_Scanner(text).scan(), path)[-1].end)
    before = text[:end] if text[:end].endswith("\n") else text[:end] + "\n"
    return before + "\n" + _block(path, new, functions) + text[end:]


def _replaced(text: str, path: Path, value: Any, functions: dict[str, Any]) -> str:
    first = _below(_Scanner(text).scan(), path)[0]
    if first.kind == "header":
        by = _block(path, value, functions)
    else:  # keys with dots
        by = f"{_name(path[first.table :])} = {toml_text.value(value, functions)}\n"
    (start, end), *others = _spans(text, path)
    for begin, stop in reversed(others):
        text = text[:begin] + text[stop:]
    return text[:start] + by + text[end:]


def _block(path: Path, value: Any, functions: dict[str, Any]) -> str:
    """Returns the lines of a section, of an entry of a list of sections, or of several entries."""
    given = [value] if isinstance(path[-1], int) else value
    return "\n\n".join(toml_text.sections(_name(path), given, functions)) + "\n"


def _name(path: Path) -> str:
    return ".".join(toml_text.key(name) for name in path if isinstance(name, str))


def _below(parts: Sequence[_Part], path: Path) -> list[_Part]:
    """Returns the outermost parts of a path."""
    found: list[_Part] = []
    for part in parts:
        if part.path[: len(path)] == path and not (found and part.start < found[-1].end):
            found.append(part)
    return found


def _spans(text: str, path: Path) -> list[tuple[int, int]]:
    """Returns the places of a path: (start, end). Lines are whole, and the comments between lines of one section belong to them."""
    parts = _Scanner(text).scan()
    below = _below(parts, path)
    if below and below[0].kind == "entry":
        return [_span_of_entry(text, part) for part in below]
    spans: list[tuple[int, int]] = []
    is_next = False  # whether the previous line belongs to the path
    for part in (part for part in parts if part.kind != "entry"):
        belongs = part.path[: len(path)] == path
        if belongs:
            start, end = text.rfind("\n", 0, part.start) + 1, _end_of_line(text, part.end)
            if is_next and part.kind == "line":
                start = spans.pop()[0]
            spans.append((start, end))
        is_next = belongs
    return spans


def _span_of_entry(text: str, part: _Part) -> tuple[int, int]:
    if part.comma_after is not None:
        return part.start, part.comma_after + 1 + len(re.match(r"[ \t]*", text[part.comma_after + 1 :])[0])  # type: ignore[index]
    return part.start if part.comma_before is None else part.comma_before, part.end


def _end_of_line(text: str, at: int) -> int:
    return text.find("\n", at) + 1 or len(text)
