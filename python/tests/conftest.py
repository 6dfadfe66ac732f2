"""Cases and results that several tests use."""

import pathlib
import warnings

import plastron
import pytest

STRIP = """title = "A strip pressed on a table"

[shell]
E = 1.0
nu = 0.3
thickness = 0.05

[geometry]
domain = { rectangle = { from = [0, 0], to = [1, 0.5], cells = [4, 2] } }
chart = ["x", "y", 0.05]

[mesh]
degree = 2
refinements = 1

[[support]]
boundary = "left"
fix = ["u", "r"]

[[load]]
force = [0, 0, -2e-5]

[[obstacle]]
name = "table"
half_space = { point = [0, 0, 0], normal = [0, 0, 1] }

[[probe]]
name = "tip"
at = [1, 0.25]
"""

STEPS = """
[[step]]
name = "press"
parts = 3
loads = 1
"""


def quiet(function, *arguments, **options):
    """Calls a function without showing its warnings."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return function(*arguments, **options)


@pytest.fixture
def case():
    """A case of 765 unknowns: an edge of a cantilever strip meets a table."""
    return plastron.Case.from_text(STRIP)


@pytest.fixture
def strip_file(tmp_path):
    file = pathlib.Path(tmp_path) / "strip.toml"
    file.write_text(STRIP, encoding="utf-8")
    return file


@pytest.fixture(scope="module")
def result():
    """The solution of the strip. Its warning is that the shell stands on its edge."""
    return quiet(plastron.solve, plastron.Case.from_text(STRIP))


@pytest.fixture(scope="module")
def saved(result, tmp_path_factory):
    """A folder with the files of the result."""
    return result.save(tmp_path_factory.mktemp("saved") / "strip")
