"""The pages and examples of the package."""

import subprocess
import sys

import pytest
from program import SOURCE, environment


def run(*words, directory):
    outcome = subprocess.run([sys.executable, "-B", *map(str, words)], cwd=directory, env=environment(), capture_output=True, text=True)
    assert outcome.returncode == 0, outcome.stdout + outcome.stderr
    return outcome.stdout


def test_the_reference_is_what_the_docstrings_say(tmp_path):
    run(SOURCE / "python/tutorial/make-reference", "--check", directory=tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["thickness_for_pressure", "stiffness_from_force"])
def test_an_example_runs(name, tmp_path):
    assert run("-W", "ignore", SOURCE / f"python/examples/{name}.py", directory=tmp_path)
