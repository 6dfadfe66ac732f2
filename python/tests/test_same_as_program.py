"""Every case of the gallery gives the same results.json in Python as on the command line, apart from times and memory."""

import json

import plastron
import pytest
from conftest import quiet
from program import SOURCE, plastron as command

CASES = sorted(file.parent.name for file in (SOURCE / "cases").glob("*/case.toml"))
# The default run takes these, which need less than a second each on the command line.
QUICK = {"clamped-saddle", "free-panel", "scordelis-lo", "thermostat", "tube-between-plates", "two-spans"}


def without_times(text):
    """The text of results.json without times and memory. Numbers keep the digits that are written there."""
    results = json.loads(text, parse_float=str, parse_int=str)
    del results["memory"]
    del results["linearity"]["seconds"]
    for level in results["levels"]:
        del level["seconds"]
    return json.dumps(results, indent=1).splitlines()


def test_there_are_cases():
    assert len(CASES) > 20 and set(CASES) >= QUICK


@pytest.mark.parametrize("name", [pytest.param(n, marks=[pytest.mark.slow] * (n not in QUICK)) for n in CASES])
def test_python_writes_the_results_of_the_command_line(name, tmp_path):
    file = SOURCE / "cases" / name / "case.toml"
    outcome = command("run", file, "--output", "program", "--quiet", directory=tmp_path, seconds=600)
    assert outcome.returncode == 0, outcome.stderr
    result = quiet(plastron.solve, plastron.Case.read(file), output=tmp_path / "python")
    written = (tmp_path / "python/results.json").read_text()
    assert without_times(written) == without_times((tmp_path / "program/results.json").read_text())
    assert result.to_dict() == json.loads(written)
    assert sorted(p.name for p in (tmp_path / "python").iterdir()) == sorted(p.name for p in (tmp_path / "program").iterdir())


def test_settings_are_those_of_the_command_line(tmp_path, strip_file):
    settings = ["shell.thickness=0.04", "load[0].force=[0.0, 0.0, -1e-05]", 'title="a \\"title\\""']
    words = [word for setting in settings for word in ("--set", setting)]
    outcome = command("run", strip_file, "--output", "program", "--quiet", *words, directory=tmp_path)
    assert outcome.returncode == 0, outcome.stderr
    case = plastron.Case.read(strip_file)
    case["shell.thickness"] = 0.04
    case["load[0].force"] = [0.0, 0.0, -1e-5]
    case["title"] = 'a "title"'
    quiet(plastron.solve, case, output=tmp_path / "python")
    files = [(tmp_path / folder / "results.json").read_text() for folder in ("python", "program")]
    assert without_times(files[0]) == without_times(files[1])
