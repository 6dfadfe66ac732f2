"""Sweeps and derivatives."""

import concurrent.futures
import csv
import io
import re
import sys

import numpy as np
import plastron
import pytest
from conftest import STRIP, quiet
from program import plastron as command, python

THICKNESSES = [0.04, 0.05]
POINTS = [[0, 0, 0], [0, 0, 0.01]]
TWO = {"shell.thickness": THICKNESSES, "obstacle[0].half_space.point": POINTS}


def times(folder):
    """When the results of each case were written."""
    return {file.parent.name: file.stat().st_mtime_ns for file in folder.glob("*/results.json")}


class TestSweep:
    def test_all_combinations_are_solved_and_the_last_key_changes_fastest(self, case):
        table = plastron.sweep(case, TWO, workers=1)
        assert table["shell.thickness"] == [0.04, 0.04, 0.05, 0.05]
        assert table["obstacle[0].half_space.point"] == [[0, 0, 0], [0, 0, 0.01]] * 2
        assert table["status"] == ["solved"] * 4
        for i, (thickness, point) in enumerate((t, p) for t in THICKNESSES for p in POINTS):
            one = quiet(plastron.solve, case.with_settings({"shell.thickness": thickness, "obstacle[0].half_space.point": point}))
            assert table["energy"][i] == one.energy
            assert table.rows[i]["contact.area"] == one.contact.area

    def test_pairwise_values_belong_together(self, case):
        table = plastron.sweep(case, TWO, pairwise=True, workers=1)
        assert len(table) == 2
        assert table["shell.thickness"] == THICKNESSES
        assert table["obstacle[0].half_space.point"] == [[0, 0, 0], [0, 0, 0.01]]

    def test_pairwise_lists_of_different_lengths_are_an_error(self, case):
        with pytest.raises(ValueError):
            plastron.sweep(case, {"shell.thickness": [0.04, 0.05], "shell.E": [1]}, pairwise=True, workers=1)

    def test_values_may_be_arrays_and_iterators(self, case):
        array = plastron.sweep(case, {"shell.thickness": np.linspace(0.04, 0.05, 2)}, workers=1)
        iterator = plastron.sweep(case, {"shell.thickness": iter(THICKNESSES)}, workers=1)
        both = plastron.sweep(case, {"shell.thickness": (t for t in THICKNESSES), "shell.E": iter([1, 2])}, workers=1)
        assert array.to_csv() == iterator.to_csv()
        assert len(both) == 4

    def test_the_case_stays_as_it_was(self, case):
        plastron.sweep(case, {"shell.thickness": [0.04]}, workers=1)
        assert case["shell.thickness"] == 0.05 and case.settings == ()

    def test_only_a_case_is_swept(self):
        with pytest.raises(TypeError, match="takes a plastron.Case, not str"):
            plastron.sweep("case.toml", {"shell.thickness": [0.04]})

    def test_refused_cases_are_rows_with_the_reason(self, case):
        table = plastron.sweep(case, {"shell.thickness": [0.05, -1, "x - 0.5"]}, workers=1)
        assert table["status"] == ["solved", "refused", "refused"]
        assert table.rows[1]["error"].startswith("--set shell.thickness=-1: error: thickness is -1, out of range")
        assert "must be positive" in table.rows[2]["error"]
        assert table["energy"][0] > 0 and table["energy"][1:] == [None, None]
        assert table.columns[-1] == "error" and table["error"] == [None, *(row["error"] for row in table.rows[1:])]
        assert list(table.to_dataframe()["error"])[1] == table.rows[1]["error"]

    @pytest.mark.parametrize(
        "key, words",
        [
            ("shell.thicknes", 'unknown key "thicknes" in [shell]\n   allowed: E, nu, .*\n   did you mean "thickness"?'),
            ("shel.thickness", "unknown section [shel]"),
            ("load[0].forc", 'unknown key "forc" in [[load]]'),
            ("geometry.domain.dsk.radius", 'unknown key "dsk" in domain'),
            ("load[3].force", "load has 1 entry, counted from 0"),
            ("load.force", "load has several entries"),
            ("line[0].points", "the case has no line"),
            ("shell.E.x", "shell.E has no keys in the case"),
            ("accuracy.energie", 'there is no number "energie"'),
            ("a b", '"a b" is no key of a case file'),
        ],
    )
    def test_a_key_that_no_case_has_is_an_error_at_once(self, case, key, words, tmp_path):
        with pytest.raises(plastron.CaseError, match=re.escape(words).replace(re.escape(".*"), ".*")) as caught:
            plastron.sweep(case, {"shell.E": [1, -1], key: [0.01, 0.02]}, workers=1, directory=tmp_path / "out")
        assert str(caught.value).startswith(f"--set {key}=0.01: error: ") or "--set shell.E" in str(caught.value)
        assert not (tmp_path / "out").exists()

    @pytest.mark.parametrize(
        "key, value",
        [("shell.thickness", "thicknes"), ("obstacle[0].half_space", {"pont": [0, 0, 0]}), ("load", [{"forc": 1}]), ("load", 3),
         ("mesh.cells", "quad")],
    )
    def test_a_bad_value_of_a_good_key_is_a_row(self, case, key, value):
        assert plastron.sweep(case, {key: [value]}, workers=1)["status"] == ["refused"]

    def test_sections_may_be_swept(self, case):
        loads = [case["load"], case["load"] + [{"force": [0, 0, -1e-5]}]]
        table = plastron.sweep(case, {"load": loads, "load[0].force": [[0, 0, -1e-5]]}, workers=1)
        np.testing.assert_allclose(table["loads.force_z"], [-0.5e-5, -1e-5])

    def test_cases_that_do_not_converge_are_rows_with_their_status(self, case):
        table = plastron.sweep(case, {"solver.max_iterations": [1, 200]}, workers=1)
        assert table["status"] == ["iteration_limit", "solved"]

    def test_no_warnings_are_shown(self, case, recwarn):
        plastron.sweep(case, {"shell.thickness": THICKNESSES}, workers=1)
        assert len(recwarn) == 0


class TestTable:
    @pytest.fixture(scope="class")
    def table(self):
        return plastron.sweep(plastron.Case.from_text(STRIP), {"shell.thickness": THICKNESSES}, workers=1)

    def test_columns_are_lists_and_rows_dictionaries(self, table):
        assert len(table) == 2 and table.parameters == ["shell.thickness"]
        assert table.columns[:2] == ["shell.thickness", "status"] and table["error"] == [None, None]
        assert table["energy"] == [row["energy"] for row in table.rows]
        with pytest.raises(KeyError, match="'energie': there is no such column; the first are shell.thickness, status"):
            table["energie"]

    def test_it_becomes_a_table_of_pandas(self, table):
        frame = table.to_dataframe()
        assert list(frame["energy"]) == table["energy"] and list(frame.columns) == table.columns
        assert "<table" in table._repr_html_()

    def test_its_file_has_the_same_numbers(self, table, tmp_path):
        table.to_csv(tmp_path / "table.csv")
        assert (tmp_path / "table.csv").read_text(encoding="utf-8") == table.to_csv()
        rows = list(csv.DictReader(io.StringIO(table.to_csv())))
        assert [float(row["energy"]) for row in rows] == table["energy"]

    def test_texts_that_look_like_numbers_stay_texts(self, case):
        table = plastron.sweep(case, {"title": ["1e3", "nan", "1_0", "true", ""]}, workers=1)
        assert table["title"] == ["1e3", "nan", "1_0", "true", ""]


class TestFolders:
    def test_every_case_has_its_files(self, case, tmp_path):
        plastron.sweep(case, {"shell.thickness": THICKNESSES}, directory=tmp_path / "out", workers=1)
        assert sorted(p.name for p in (tmp_path / "out").iterdir()) == ["0001", "0002"]
        for i, thickness in enumerate(THICKNESSES):
            loaded = plastron.load(tmp_path / "out" / f"{i + 1:04}")
            assert loaded.case["shell.thickness"] == thickness
        assert not (tmp_path / "out/0001/report.html").exists()

    def test_reports_are_written_if_asked_for(self, case, tmp_path):
        plastron.sweep(case, {"shell.thickness": [0.05]}, directory=tmp_path, report=True, workers=1)
        assert (tmp_path / "0001/report.html").exists()

    def test_solved_cases_are_not_solved_again(self, case, tmp_path):
        first = plastron.sweep(case, TWO, directory=tmp_path, workers=1)
        before = times(tmp_path)
        assert plastron.sweep(case, TWO, directory=tmp_path, workers=1).to_csv() == first.to_csv()
        assert times(tmp_path) == before
        (tmp_path / "0002/results.json").unlink()
        (tmp_path / "0003/results.json").write_text("{")
        assert plastron.sweep(case, TWO, directory=tmp_path, workers=1).to_csv() == first.to_csv()
        assert [name for name, t in times(tmp_path).items() if t != before[name]] in (["0002", "0003"], ["0003", "0002"])

    @pytest.mark.parametrize("goes_on", ["python", "program"])
    def test_interrupted_cases_are_solved_again(self, strip_file, tmp_path, goes_on):
        case = plastron.Case.read(strip_file)
        first = plastron.sweep(case, {"shell.thickness": THICKNESSES}, directory=tmp_path / "out", workers=1)
        file = tmp_path / "out/0001/results.json"
        file.write_text(file.read_text().replace('"status": "solved"', '"status": "interrupted"', 1))
        if goes_on == "python":
            table = plastron.sweep(case, {"shell.thickness": THICKNESSES}, directory=tmp_path / "out", workers=1)
            assert table.to_csv() == first.to_csv()
        else:
            words = ["--set", "shell.thickness=0.04,0.05", "--output", "out", "--quiet"]
            assert command("sweep", strip_file, *words, directory=tmp_path).returncode == 0
            assert (tmp_path / "out/table.csv").read_text() == first.to_csv()

    def test_control_c_ends_a_sweep_in_this_process(self, tmp_path):
        text = STRIP.replace("refinements = 1", "refinements = 4").replace("degree = 2", "degree = 3")
        answer = python(
            f"""
import os, plastron, signal, threading
case = plastron.Case.from_text({text!r})
plastron.solve(case.with_settings({{"mesh.refinements": 0}}))
threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
try:
    print(plastron.sweep(case, {{"shell.E": [1, 2, 3, 4]}}, workers=1)["status"])
except KeyboardInterrupt:
    print("ended")
""",
            tmp_path,
        )
        assert answer == "ended\n"

    @pytest.mark.parametrize(
        "results", ["", "[]", '{"status": 3}', '{"status": "solved", "verification": {"case": {"sha256": 1, "files": [1]}}}']
    )
    def test_damaged_results_are_computed_anew(self, case, tmp_path, results):
        (tmp_path / "0001").mkdir()
        (tmp_path / "0001/results.json").write_text(results)
        table = plastron.sweep(case, {"shell.thickness": [0.04]}, directory=tmp_path, workers=1)
        assert table["status"] == ["solved"]

    @pytest.mark.parametrize("order", ["a_thread_first", "another_thread_solves"])
    def test_processes_start_whatever_threads_have_solved(self, order, tmp_path):
        text = STRIP.replace("refinements = 1", "refinements = 4").replace("degree = 2", "degree = 3")
        answer = python(
            f"""
import plastron, threading
case = plastron.Case.from_text({text!r})
thread = threading.Thread(target=case.solve)
thread.start()
if {order == "a_thread_first"}:
    thread.join()
    case.solve()
table = plastron.sweep(case.with_settings({{"mesh.refinements": 1}}), {{"shell.E": [1, 2, 3, 4]}}, workers=2)
print(set(table["status"]))
""",
            tmp_path,
            seconds=60,
        )
        assert answer == "{'solved'}\n"

    def test_another_case_is_solved_again(self, case, tmp_path):
        plastron.sweep(case, {"shell.thickness": THICKNESSES}, directory=tmp_path, workers=1)
        before = times(tmp_path)
        case["shell.E"] = 2
        table = plastron.sweep(case, {"shell.thickness": THICKNESSES}, directory=tmp_path, workers=1)
        assert all(times(tmp_path)[name] > before[name] for name in before)
        assert table["energy"][1] == quiet(plastron.solve, case.with_settings({"shell.thickness": 0.05})).energy

    def test_the_table_is_that_of_the_program_byte_by_byte(self, strip_file, tmp_path):
        words = ["--set", "shell.thickness=0.04,0.05", "--set", "obstacle[0].half_space.point=[0, 0, 0],[0, 0, 0.01]"]
        outcome = command("sweep", strip_file, *words, "--output", "out", "--table", "program.csv", "--quiet", directory=tmp_path)
        assert outcome.returncode == 0, outcome.stderr
        plastron.sweep(plastron.Case.read(strip_file), TWO, workers=1).to_csv(tmp_path / "python.csv")
        assert (tmp_path / "python.csv").read_bytes() == (tmp_path / "program.csv").read_bytes()

    def test_the_table_with_a_refused_case_is_that_of_the_program(self, strip_file, tmp_path):
        words = ["--set", 'support[0].fix=["u", "r"],["u.x"]', "--output", "out", "--quiet"]
        outcome = command("sweep", strip_file, *words, directory=tmp_path)
        assert outcome.returncode == 3
        table = plastron.sweep(plastron.Case.read(strip_file), {"support[0].fix": [["u", "r"], ["u.x"]]}, workers=1)
        assert table.to_csv() == (tmp_path / "out/table.csv").read_text()

    @pytest.mark.parametrize("jobs", [1, 2])
    def test_messages_of_a_member_stand_below_its_folder_and_its_values(self, strip_file, tmp_path, jobs):
        words = ["--set", 'support[0].fix=["u", "r"],["u.x"],["u.y"]', "--output", "out", "--jobs", jobs]
        told = command("sweep", strip_file, *words, directory=tmp_path).stderr
        parts = re.split(r"^(out/\d{4}) \((.*)\):$", told, flags=re.M)
        texts = {(folder, setting): text for folder, setting, text in zip(parts[1::3], parts[2::3], parts[3::3])}
        errors = {member for member, text in texts.items() if "error: " in text}
        assert errors == {("out/0002", 'support[0].fix=["u.x"]'), ("out/0003", 'support[0].fix=["u.y"]')}
        assert not parts[0].strip()

    def test_the_table_over_texts_is_that_of_the_program(self, strip_file, tmp_path):
        words = ["--set", 'shell.thickness="0.04 + 0.01*x",0.05', "--output", "out", "--quiet"]
        assert command("sweep", strip_file, *words, directory=tmp_path).returncode == 0
        table = plastron.sweep(plastron.Case.read(strip_file), {"shell.thickness": ["0.04 + 0.01*x", 0.05]}, workers=1)
        assert table.to_csv() == (tmp_path / "out/table.csv").read_text()

    def test_python_and_the_program_go_on_with_each_other(self, strip_file, tmp_path):
        words = ["sweep", strip_file, "--set", "shell.thickness=0.04,0.05", "--output", "out", "--quiet"]
        command(*words, directory=tmp_path)
        before = times(tmp_path / "out")
        table = plastron.sweep(plastron.Case.read(strip_file), {"shell.thickness": THICKNESSES}, directory=tmp_path / "out", workers=1)
        assert times(tmp_path / "out") == before and len(before) == 2
        assert table.to_csv() == (tmp_path / "out/table.csv").read_text()
        (tmp_path / "out/0001/results.json").unlink()
        plastron.sweep(plastron.Case.read(strip_file), {"shell.thickness": THICKNESSES}, directory=tmp_path / "out", workers=1)
        by_python = times(tmp_path / "out")
        command(*words, directory=tmp_path)
        assert times(tmp_path / "out") == by_python


class TestExecutors:
    @pytest.fixture(scope="class")
    def expected(self):
        return plastron.sweep(plastron.Case.from_text(STRIP), TWO, workers=1).to_csv()

    def test_processes_are_the_default(self, case, expected, monkeypatch):
        started = []

        class Pool(concurrent.futures.ProcessPoolExecutor):
            def __init__(self, workers):
                started.append(workers)
                super().__init__(workers)

        monkeypatch.setattr(concurrent.futures, "ProcessPoolExecutor", Pool)
        assert plastron.sweep(case, TWO, workers=2).to_csv() == expected
        assert started == [2]

    @pytest.mark.parametrize("kind", [concurrent.futures.ProcessPoolExecutor, concurrent.futures.ThreadPoolExecutor])
    def test_executors_of_the_standard_library(self, case, expected, kind):
        with kind(2) as executor:
            assert plastron.sweep(case, TWO, executor=executor).to_csv() == expected
            assert executor.submit(int, "3").result() == 3  # it is still usable

    def test_threads_show_no_warnings(self, case, recwarn):
        with concurrent.futures.ThreadPoolExecutor(4) as executor:
            plastron.sweep(case, {"shell.thickness": np.linspace(0.04, 0.05, 12)}, executor=executor)
        assert [w for w in recwarn if issubclass(w.category, plastron.PlastronWarning)] == []

    def test_processes_work_after_a_solution_in_this_process(self, case, expected):
        quiet(plastron.solve, case)
        assert plastron.sweep(case, TWO, workers=2).to_csv() == expected

    def test_refused_cases_come_back_from_processes(self, case):
        table = plastron.sweep(case, {"shell.thickness": [0.05, "x - 0.5", -1]}, workers=2)
        assert table["status"] == ["solved", "refused", "refused"]
        assert "must be positive" in table.rows[1]["error"]

    @pytest.mark.parametrize("processes", [False, True], ids=["threads", "processes"])
    def test_executors_of_dask(self, processes, expected, tmp_path):
        pytest.importorskip("distributed")
        answer = python(
            f"""
import distributed, plastron
if __name__ == "__main__":
    case = plastron.Case.from_text({STRIP!r})
    with distributed.Client(processes={processes}, n_workers=2, threads_per_worker=1, dashboard_address=None) as client:
        table = plastron.sweep(case, {TWO!r}, executor=client.get_executor())
    table.to_csv("table.csv")
""",
            tmp_path,
        )
        assert (tmp_path / "table.csv").read_text() == expected, answer

    @pytest.mark.parametrize("module", [("-m", "mpi4py.futures"), ()], ids=["under mpi4py.futures", "in one program"])
    def test_executors_of_mpi4py(self, expected, tmp_path, module):
        """Workers solve on themselves while the first rank waits for them."""
        pytest.importorskip("mpi4py")
        executor = "MPIPoolExecutor()" if module else "MPICommExecutor(MPI.COMM_WORLD, root=0)"
        python(
            f"""
from mpi4py import MPI
from mpi4py.futures import MPICommExecutor, MPIPoolExecutor
import plastron
if __name__ == "__main__":
    case = plastron.Case.from_text({STRIP!r})
    with {executor} as executor:
        if executor is not None:
            plastron.sweep(case, {TWO!r}, executor=executor).to_csv("table.csv")
""",
            tmp_path,
            ranks=3,
            seconds=10,
            module=module,
        )
        assert (tmp_path / "table.csv").read_text() == expected


FREE = STRIP.split("[[obstacle]]")[0]
MOVED = STRIP + """
[[step]]
loads = 0.5
[[step]]
loads = 1
move = [ { obstacle = "table", translate = [0, 0, 0.01] } ]
"""
BALL = STRIP.replace("half_space = { point = [0, 0, 0], normal = [0, 0, 1] }", "ball = { centre = [0.7, 0.2, -1], radius = 1 }")


def finite(text):
    return text.replace("nu = 0.3", 'nu = 0.3\nrotations = "finite"')


def test_a_sweep_solves_again_where_a_file_of_the_case_has_changed(tmp_path):
    mode = STRIP.split("[[obstacle]]")[0] + "\n[modes]\nbuckling = 1\n"
    mode = mode.replace("force = [0, 0, -2e-5]", 'boundary = "right"\nforce = [-1e-6, 0, 0]')
    (tmp_path / "case.toml").write_text(STRIP + '\n[[imperfection]]\nmode = "buckling_1.mode"\namplitude = 0.01\n')
    energies = []
    for thickness in (0.05, 0.04):
        first = plastron.Case.from_text(mode).with_settings({"shell.thickness": thickness, "mesh.degree": 3 if thickness == 0.04 else 2})
        quiet(first.solve, output=tmp_path / "modes", report=False)
        (tmp_path / "buckling_1.mode").write_bytes((tmp_path / "modes/buckling_1.mode").read_bytes())
        case = plastron.Case.read(tmp_path / "case.toml")
        table = plastron.sweep(case, {"shell.E": [1.0]}, workers=1, directory=tmp_path / "sweep")
        energies.append(table["energy"][0])
        assert energies[-1] == quiet(case.solve, report=False).energy
    assert energies[0] != energies[1]


class TestDifferences:
    def test_energy_without_contact_is_inverse_to_the_modulus(self):
        free = plastron.Case.from_text(FREE)
        energy = quiet(free.solve, report=False).energy
        value, error = plastron.differences(free, ["shell.E"], workers=1)["shell.E"]["energy"]
        assert value == pytest.approx(-energy / free["shell.E"], rel=1e-8)
        assert error < 1e-4 * abs(value)

    def test_a_key_that_is_no_number_is_refused(self, case):
        with pytest.raises(ValueError, match="numbers that are not 0"):
            plastron.differences(case, ["shell.formulation"])


def with_chart(text):
    """A case whose mid-surface has a constant."""
    return text.replace('["x", "y", 0.05]', '["x", "y", "0.03 + h + y^2/(2*R)"]') + "\n[constants]\nh = 0.02\nR = 3\n"


@pytest.mark.parametrize(
    "text",
    [
        pytest.param(STRIP, id="small"),
        pytest.param(finite(STRIP), id="finite"),
        pytest.param(finite(BALL), id="ball"),
        pytest.param(STRIP.replace("nu = 0.3", 'nu = 0.3\nformulation = "penalised"'), id="penalised"),
        pytest.param(STRIP.replace("nu = 0.3", 'nu = 0.3\nformulation = "classical"'), id="classical"),
        pytest.param(STRIP.replace("degree = 2", 'degree = 2\ncells = "triangle"'), id="triangles"),
        pytest.param(finite(MOVED), id="steps"),
    ],
)
def test_derivatives_with_held_contact_are_those_of_the_solutions(text):
    case = plastron.Case.from_text(with_chart(text))
    keys = ["shell.E", "shell.nu", "shell.thickness", "constants.h", "constants.R", "load[0].force[2]"]
    result = quiet(case.solve, report=False)
    held = result.derivatives(keys)
    solved = quiet(plastron.differences, case, keys, workers=1)
    for key in keys:
        for name in ["energy", "load_work", "reaction.force_z", "reaction.moment_y", "probes.tip.u_z", "probes.tip.M_11"]:
            value, error = held[key][name]
            other, other_error = solved[key][name]
            scale = abs(result.energy / case[key]) if name == "energy" else abs(other)
            assert value == pytest.approx(other, rel=1e-5, abs=1e-7 * scale + error + other_error), (key, name)


class TestDerivatives:
    def test_the_place_of_an_obstacle_changes_the_energy_by_its_force(self):
        """dE = F ds for a shell that only the table loads."""
        sloping = STRIP.replace("-2e-5", "0").replace('["x", "y", 0.05]', '["x", "y", "0.05 - 0.03*x"]')
        case = plastron.Case.from_text(sloping.replace("point = [0, 0, 0]", "point = [0, 0, 0.005]"))
        result = quiet(case.solve, report=False)
        value, _ = result.derivatives(["obstacle[0].half_space.point[2]"])["obstacle[0].half_space.point[2]"]["energy"]
        assert value == pytest.approx(result.obstacles["table"].force[2], rel=1e-7)

    @pytest.mark.parametrize(
        "change, words",
        [
            (("nu = 0.3", 'nu = 0.3\nformulation = "mixed"'), "mixed formulation"),
            (("half_space = { point = [0, 0, 0], normal = [0, 0, 1] }", "ball = { centre = [0.7, 0.2, -1], radius = 1 }"), "curved"),
        ],
    )
    def test_where_they_are_not_defined_one_sentence_says_so(self, change, words):
        result = quiet(plastron.Case.from_text(STRIP.replace(*change)).solve, report=False)
        with pytest.raises(plastron.CaseError, match=f"{words}.*; use differences"):
            result.derivatives(["shell.E"])

    @pytest.mark.parametrize("length", [1e-6, 1e6])
    def test_the_unit_of_length_does_not_matter(self, length):
        text = with_chart(STRIP.replace("thickness = 0.05", 'thickness = "0.05*s"'))
        relative = []
        for s in (1, length):
            scaled = text.replace("to = [1, 0.5]", 'to = ["s", "0.5*s"]').replace('["x", "y", "0.03 + h', '["x", "y", "0.03*s + h')
            scaled = scaled.replace("at = [1, 0.25]", 'at = ["s", "0.25*s"]').replace("h = 0.02\nR = 3", f"s = {s!r}\nh = {0.02 * s!r}\nR = {3 * s!r}")
            case = plastron.Case.from_text(scaled)
            result = quiet(case.solve, report=False)
            by = result.derivatives(["constants.h", "constants.R", "shell.E"])
            relative.append([by[key]["energy"][0] * case[key] / result.energy for key in by])
        assert relative[1] == pytest.approx(relative[0], rel=1e-6)

    @pytest.mark.parametrize("step", [0, 1e-20, 2])
    def test_a_step_without_sense_is_refused(self, case, step):
        with pytest.raises(ValueError, match="step is .*; it is a part of the value"):
            quiet(case.solve, report=False).derivatives(["shell.E"], step)
        with pytest.raises(ValueError, match="step is"):
            plastron.differences(case, ["shell.E"], step=step)

    def test_numbers_of_rigid_bodies_are_refused(self):
        body = STRIP + "\n[[rigid_body]]\nname = \"bar\"\nboundary = \"right\"\nreference = [1, 0.25, 0.05]\nforce = [0, 0, -1e-6]\n"
        result = quiet(plastron.Case.from_text(body).solve, report=False)
        assert result.derivatives(["shell.E"])["shell.E"]["energy"][0] != 0
        with pytest.raises(plastron.CaseError, match="by numbers of rigid bodies; use differences"):
            result.derivatives(["rigid_body[0].force[2]"])

    def test_the_domain_must_stay(self):
        case = plastron.Case.from_text(STRIP.split("[[probe]]")[0])
        with pytest.raises(plastron.CaseError, match="where the domain changes; use differences"):
            quiet(case.solve, report=False).derivatives(["geometry.domain.rectangle.to[0]"])

    def test_a_loaded_result_has_none(self, case, tmp_path):
        quiet(case.solve, report=False).save(tmp_path)
        with pytest.raises(plastron.CaseError, match="loaded; use differences"):
            plastron.load(tmp_path).derivatives(["shell.E"])


class TestValues:
    def test_a_list_of_values_is_needed(self, case):
        with pytest.raises(TypeError, match="takes a list of values"):
            plastron.sweep(case, {"shell.formulation": "tangent"})


LIMIT = 0.04


def surface(x, y):
    return x, y, 0.05 + 0.01 * x * y


class TestFunctionsInSweeps:
    def solved_by(self, case, **options):
        return plastron.sweep(case, {"shell.nu": [0.3, 0.2]}, **options)["energy"]

    def test_a_function_that_cannot_go_to_a_process_is_an_error_with_advice(self, case):
        case["shell.thickness"] = lambda x: 0.05 + 0 * x
        words = "the function .*<lambda> of the case cannot go to another process\n   define it with def at the top of a module .*workers=1"
        with pytest.raises(plastron.CaseError, match=words) as caught:
            self.solved_by(case, workers=2)
        assert caught.value.__suppress_context__
        with concurrent.futures.ProcessPoolExecutor(2) as executor:
            with pytest.raises(plastron.CaseError, match=words):
                self.solved_by(case, executor=executor)
        with concurrent.futures.ThreadPoolExecutor(2) as executor:
            alone = self.solved_by(case, workers=1)
            assert self.solved_by(case, executor=executor) == alone

    def test_components_go_to_processes(self, case):
        case["geometry.chart"] = plastron.components(surface)
        assert self.solved_by(case, workers=2) == self.solved_by(case, workers=1)

    def test_a_function_whose_global_has_changed_is_solved_again(self, case, tmp_path, monkeypatch):
        case["shell.thickness"] = lambda x: LIMIT + 0 * x
        first = plastron.sweep(case, {"shell.nu": [0.3]}, directory=tmp_path, workers=1)["energy"]
        monkeypatch.setattr(sys.modules[__name__], "LIMIT", 0.05)
        second = plastron.sweep(case, {"shell.nu": [0.3]}, directory=tmp_path, workers=1)["energy"]
        assert first != second

    def test_functions_with_different_arrays_are_different(self):
        made = [plastron.Function((lambda a: lambda x: a[0] + 0 * x)(a)) for a in (np.zeros(5000), np.ones(5000))]
        assert made[0] != made[1]
