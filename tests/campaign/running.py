"""Runs of the program: a case in a folder, its exit code, its text and its results in the case's own frame."""

import csv
import json
import os
import pathlib
import re
import resource
import signal
import subprocess

FROM_MPI = ("OMPI_COMM", "OMPI_UNIVERSE", "OMPI_MCA_ess", "OMPI_MCA_orte", "OMPI_MCA_pml", "OMPI_MCA_btl", "PMIX_", "PRTE_")
PYTHON_RUN = """
import sys, warnings, plastron
warnings.simplefilter("ignore")
try:
    result = plastron.solve(plastron.Case.read("case.toml"), output="out")
except plastron.CaseError as error:
    print(error)
    sys.exit(2)
sys.exit(0 if result.status == "solved" else 3)
"""


def environment(more=()):
    own = {name: value for name, value in os.environ.items() if not name.startswith(FROM_MPI)}
    return own | {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1",
                  "OMPI_MCA_mpi_yield_when_idle": "1", "PYTHONDONTWRITEBYTECODE": "1"} | dict(more)


class Program:
    """`python`: an interpreter that has the package plastron, or None. `seconds`: limit of one run in CPU time, which a busy machine does not change."""

    def __init__(self, path, python=None, package=None, seconds=60):
        self.path, self.python, self.package, self.seconds = str(pathlib.Path(path).resolve()), python, package, seconds
        self.runs = self.time = 0

    def call(self, words, folder):
        """Exit code ("hang" after the time limit) and text."""
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        limit = lambda: resource.setrlimit(resource.RLIMIT_CPU, (self.seconds, self.seconds + 5))
        process = subprocess.Popen([str(w) for w in words], cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                   text=True, start_new_session=True, preexec_fn=limit,
                                   env=environment({"PYTHONPATH": self.package} if self.package else {}))
        try:
            text, _ = process.communicate(timeout=20 * self.seconds)
            code = "hang" if process.returncode in (-signal.SIGXCPU, -signal.SIGKILL, 128 + signal.SIGXCPU) else process.returncode
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            text, code = process.communicate()[0], "hang"
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.runs += 1
        self.time += after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        return code, text

    def run(self, case, folder, by="program"):
        """Writes the files of a case, runs it, and returns what came out."""
        folder = pathlib.Path(folder)
        folder.mkdir(parents=True)
        if case.row["source"] == "facets" and "curves" not in case.extra:
            case.extra["curves"], text = self._curves(case, folder)
            if not {"start", "end"} <= set(case.extra["curves"]):
                return Outcome(case, folder, 2, text)
        for name, text in case.all_files().items():
            (folder / name).write_text(text)
        if by == "python":
            words = [self.python, "-c", PYTHON_RUN]
        else:
            words = [self.path, "run", "case.toml", "--output", "out", "--no-report", "--threads", "1"]
            if case.row["ranks"] > 1:
                words = ["mpirun", "-n", case.row["ranks"], *words]
        code, text = self.call(words, folder)
        return Outcome(case, folder, code, text)

    def _curves(self, case, folder):
        """The curves of facets that are each boundary, from the tables of `plastron parts`, and its text."""
        (folder / "shell.stl").write_text(case.mesh_files()["shell.stl"])
        code, text = self.call([self.path, "parts", "shell.stl", "--size", str(case.facet_size), "--smooth", "40"], folder)
        number = r"(-?[0-9.e+-]+)"
        point = rf"\({number}, {number}, {number}\)"
        curves = {}
        for name, *corners in re.findall(rf"(edge \d+) +\S+ +\S+ +\d+ border +{point}, {point}", " ".join(text.split())):
            corners = [float(v) for v in corners]
            for boundary in case.boundaries_of([corners[:3], corners[3:]]):
                curves.setdefault(boundary, []).append(name)
        return curves, text


class Outcome:
    def __init__(self, case, folder, code, text):
        self.case, self.folder, self.code, self.text = case, folder, code, text
        file = folder / "out" / "results.json"
        self.results = json.loads(file.read_text()) if file.exists() else None

    @property
    def is_solved(self):
        return self.code == 0 and self.results is not None

    @property
    def word(self):
        return self.results["status"] if self.results else f"exit {self.code}"

    def table(self, name):
        """Rows of a .csv file as dictionaries of numbers; the names without units."""
        file = self.folder / "out" / name
        if not file.exists():
            return []
        with file.open() as stream:
            rows = list(csv.reader(stream))
        names = [n.split(" [")[0] for n in rows[0]]
        return [dict(zip(names, (float(v) if v else None for v in row))) for row in rows[1:]]
