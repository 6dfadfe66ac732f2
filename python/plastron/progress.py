"""Progress of a computation, on a terminal or in a notebook."""

from __future__ import annotations

import importlib.util
import json
import sys
from typing import Any


class Progress:
    """A bar of tqdm on a terminal and in a notebook, which shows the present part and counts finished meshes or instants. Elsewhere
    one line for each of these."""

    def __init__(self) -> None:
        self._bar: Any = None
        if _is_interactive():
            try:
                self._bar = bar(desc="mesh 0", unit=" done", mininterval=0.1)
            except ImportError:
                pass

    def phase(self, level: int, name: str) -> None:
        if self._bar is not None:
            self._bar.set_description_str(f"mesh {level}: {name}", refresh=False)
            self._bar.update(0)

    def iteration(self, level: int, text: str) -> None:
        if self._bar is not None:
            self._bar.set_postfix_str(f"{json.loads(text).get('active', 0)} nodes in contact", refresh=False)
            self._bar.update(0)

    def mesh(self, level: int, text: str) -> None:
        data = json.loads(text)
        self._done(f"mesh {level}: {data['unknowns']} unknowns, energy {data['energy']:.9g}, {data['active']} nodes in contact")

    def instant(self, text: str) -> None:
        data = json.loads(text)
        self._done(f"step {data['step']}, time {data['time']:g}: energy {data['energy']:.9g}")

    def _done(self, text: str) -> None:
        if self._bar is not None:
            self._bar.update(1)
        else:
            print(text, file=sys.stderr)

    def close(self) -> None:
        if self._bar is not None:
            self._bar.close()


def bar(**options: Any) -> Any:
    """Returns a bar of tqdm: a graphical one in a notebook with ipywidgets, else a line of text. tqdm.auto would warn in a notebook
    without ipywidgets."""
    if _is_notebook() and importlib.util.find_spec("ipywidgets") is not None:
        from tqdm.notebook import tqdm
    else:
        from tqdm.std import tqdm
    return tqdm(**options)


def _is_notebook() -> bool:
    return "ipykernel" in sys.modules


def _is_interactive() -> bool:
    return sys.stderr.isatty() or _is_notebook()
