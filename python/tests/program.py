"""The programs that the tests start, and where things are."""

import os
import pathlib
import signal
import subprocess
import sys
import time

SOURCE = pathlib.Path(os.environ.get("PLASTRON_SOURCE") or pathlib.Path(__file__).resolve().parents[2])
PROGRAM = pathlib.Path(os.environ.get("PLASTRON_PROGRAM") or SOURCE / "build/release/apps/plastron/plastron")
_FROM_MPI = ("OMPI_COMM", "OMPI_UNIVERSE", "OMPI_MCA_ess", "OMPI_MCA_orte", "OMPI_MCA_pml", "OMPI_MCA_btl", "PMIX_", "PRTE_")


def environment():
    """The variables of this process without those of its own MPI job, which a program must not join."""
    own = {name: value for name, value in os.environ.items() if not name.startswith(_FROM_MPI)}
    settings = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "PYTHONDONTWRITEBYTECODE": "1"}
    return own | settings | {"OMPI_MCA_rmaps_base_oversubscribe": "1"}


def run(words, directory, seconds=120):
    """Runs a program in a folder, and ends it with all that it started when the time is over."""
    process = subprocess.Popen([str(word) for word in words], cwd=directory, env=environment(), stdin=subprocess.DEVNULL,
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True)
    try:
        output, errors = process.communicate(timeout=seconds)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGTERM)
        time.sleep(1)
        try:
            os.killpg(process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        output, errors = process.communicate()
        raise AssertionError(f"no end after {seconds} s: {' '.join(process.args)}\n{output}\n{errors}") from None
    return subprocess.CompletedProcess(process.args, process.returncode, output, errors)


def plastron(*words, directory, seconds=120):
    """Runs the command line program."""
    return run([PROGRAM, *words], directory, seconds)


def python(text, directory, ranks=None, seconds=120, module=()):
    """Runs a text of Python in a new process, on several ranks if asked, and returns what it prints."""
    script = pathlib.Path(directory) / "script.py"
    script.write_text(text, encoding="utf-8")
    launcher = ["mpirun", "-n", ranks] if ranks else []
    outcome = run([*launcher, sys.executable, *module, script], directory, seconds)
    assert outcome.returncode == 0, outcome.stdout + outcome.stderr
    return outcome.stdout


def words_of(text):
    """A text without its line breaks and indentation: the command line wraps lines at 120 columns."""
    return " ".join(text.split())
