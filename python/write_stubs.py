"""Writes sections.pyi: the types of plastron.sections, from the declarations of the case file.

    write_stubs.py FOLDER_OF_THE_PACKAGE FILE
"""

import keyword
import pathlib
import sys

TYPES = {
    "true or false": "bool",
    "a name in quotes or": "Union[str, Sequence[str]]",
    "a name in quotes": "str",
    "a word in quotes or false": "Union[str, bool]",
    "a word in quotes": "str",
    "text in quotes": "str",
    "a list of texts": "Sequence[str]",
    "a whole number": "Union[int, str]",
}


def type_of(kind):
    for words, name in TYPES.items():
        if kind.startswith(words):
            return name
    if kind.startswith("a list of tables"):
        return "Sequence[Mapping[str, Any]]"
    if kind.startswith("a list"):
        return "Value"
    if kind.startswith("a table"):
        return "Mapping[str, Any]"
    return "Value"


def text_of(all_declarations, class_name):
    lines = [
        '"""The sections of the case file. Written by write_stubs.py from the declarations of the case file."""',
        "from typing import Any, Callable, Dict, Mapping, Sequence, Union",
        "",
        "import numpy as np",
        "",
        "Value = Union[float, int, str, bool, Sequence[Any], Mapping[str, Any], Callable[..., Any], np.ndarray[Any, Any]]",
        "",
    ]
    for path, meaning, keys in all_declarations:
        if not path:
            continue
        name = class_name(path)
        lines += [f"class {name}(Dict[str, Any]):", f'    """[{path}]: {_plain(meaning)}"""', "    path: str"]
        lines.append("    def __init__(self, *," if keys else "    def __init__(self, **values: Value) -> None: ...")
        for key, kind, unit, default, allowed, text, required in keys:
            if keyword.iskeyword(key):
                continue
            facts = [f for f in (f"[{unit}]" if unit else "", allowed, f"default {default}" if default else "") if f]
            lines.append(f"        {key}: {type_of(kind)} = ...,  # {_plain(text)} {'; '.join(facts)}".rstrip())
        if keys:
            lines.append("        **others: Value) -> None: ...")
        lines.append("")
    return "\n".join(lines)


def _plain(text):
    return " ".join(text.split()).replace("\\", "/").replace('"', "'")


def main():
    folder, file = sys.argv[1:]
    sys.path.insert(0, folder)
    from plastron import _case, sections

    pathlib.Path(file).write_text(text_of(_case.declarations(), sections.class_name), encoding="utf-8")


if __name__ == "__main__":
    main()
