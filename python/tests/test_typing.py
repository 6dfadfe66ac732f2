"""Types: mypy on a program that uses the package."""

import pathlib
import sys

import plastron
import pytest
from program import run

pytest.importorskip("mypy")
PACKAGE = pathlib.Path(plastron.__file__).parent
pytestmark = pytest.mark.skipif(not (PACKAGE / "py.typed").exists(), reason="the package has no types yet")

SAMPLE = """
from typing import Any, Dict
import numpy as np
import plastron

case: plastron.Case = plastron.Case.read("case.toml", ["shell.thickness=0.01"])
case["shell.thickness"] = np.float64(0.01)
made = plastron.Case(
    shell=plastron.sections.Shell(E=1, nu=0.3, thickness="0.01*x"),
    support=[plastron.sections.Support(boundary="rim", fix=["u", "r"])],
)
findings: list[plastron.Finding] = made.check()
texts: list[str] = [finding.severity + finding.text for finding in findings]


def told(number: int, record: plastron.Record) -> None:
    print(number, record.energy)


result: plastron.Result = plastron.solve(case, progress=True, on_mesh=told, comm="self", output="out")
solved: bool = result.is_solved
unit: str = result.unit_of("energy")
u: "np.ndarray[Any, Any]" = result.fields["u"]
v: "np.ndarray[Any, Any]" = result.at([[0, 0]], heights=[0.25])["u"]
row: Dict[str, Any] = result.row()
folder = result.save("out") / "results.json"
verified: bool = plastron.verify("out").has_passed
loaded: plastron.Result = plastron.load(folder.parent)
table: plastron.Table = plastron.sweep(case, {"shell.thickness": [0.01, 0.02]}, workers=2)
wind: plastron.LoadCase = result.cases["wind"]
total: "np.ndarray[Any, Any]" = plastron.combine(result, {"weight": 1.35, "wind": 1.5}).fields["u"]
places: list[str] = result.envelope("service").cases
chart: list[plastron.Function] = plastron.components(lambda x, y: (x, y, x * y))
try:
    case.solve()
except plastron.CaseError as error:
    lines: list[int] = [mistake["line"] for mistake in error.mistakes]
"""

MISTAKES = [
    ("plastron.solve(3)", "arg-type"),
    ('plastron.solve(plastron.Case(), comunicator="self")', "call-arg"),
    ("number: int = plastron.Case().title", "assignment"),
    ("plastron.nothing", "attr-defined"),
    ("plastron.Case.read(3)", "arg-type"),
    ("plastron.sections.Shell(1)", "call-arg|misc"),
    ("plastron.sections.Nothing()", "attr-defined"),
    ("plastron.solve(plastron.Case(), on_mesh=lambda number: None)", "arg-type|misc"),
]


def mypy(directory, *words):
    options = ["--strict", "--ignore-missing-imports", "--cache-dir", directory / "cache", "--no-error-summary"]
    return run(["env", f"MYPYPATH={PACKAGE.parent}", sys.executable, "-m", "mypy", *options, *words], directory)


def test_a_program_that_uses_the_package_is_accepted(tmp_path):
    (tmp_path / "sample.py").write_text(SAMPLE)
    outcome = mypy(tmp_path, "sample.py")
    assert outcome.returncode == 0, outcome.stdout + outcome.stderr


@pytest.mark.slow
def test_mistakes_are_found(tmp_path):
    (tmp_path / "sample.py").write_text("import plastron\n" + "".join(f"{line}\n" for line, _ in MISTAKES))
    lines = mypy(tmp_path, "--show-error-codes", "sample.py").stdout.splitlines()
    for i, (line, codes) in enumerate(MISTAKES):
        found = [message for message in lines if message.startswith(f"sample.py:{i + 2}: error")]
        assert any(f"[{code}]" in message for message in found for code in codes.split("|")), f"{line}: {found}"


@pytest.mark.slow
def test_the_package_itself_is_typed(tmp_path):
    outcome = mypy(tmp_path, "-p", "plastron")
    assert outcome.returncode == 0, outcome.stdout + outcome.stderr
