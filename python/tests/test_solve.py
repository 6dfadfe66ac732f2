"""Solving: numbers, statuses, callbacks, interruption, fields, values at points, files."""

import html
import importlib.util
import json
import shutil
import signal
import subprocess
import sys
import threading
import time
import types
import warnings

import meshio
import numpy as np
import pandas
import plastron
import pytest
from conftest import STEPS, STRIP, quiet
from program import SOURCE, environment, plastron as command, python

LONG = STRIP.replace("refinements = 1", "refinements = 5").replace("degree = 2", "degree = 3")


class TestNumbers:
    def test_numbers_are_attributes_under_the_names_of_the_file(self, result, saved):
        written = json.loads((saved / "results.json").read_text())
        assert result.energy == written["energy"] > 0
        assert result.contact.area == written["contact"]["area"] > 0
        assert result.estimates.goals["energy"].error == written["estimates"]["goals"][0]["error"]
        assert result.certificate.force_balance == written["certificate"]["force_balance"]
        assert result["energy"] == result.energy
        assert "energy" in result and "energie" not in result

    def test_forces_are_in_balance(self, result):
        assert isinstance(result.obstacles["table"].force, np.ndarray)
        total = result.loads.force + result.obstacles["table"].force + result.supports["left"].force
        np.testing.assert_allclose(total, 0, atol=1e-12 * 1e-5)
        np.testing.assert_allclose(result.loads.force, [0, 0, -2e-5 * 0.5])

    def test_parts_are_found_by_name_and_by_number(self, result):
        assert result.obstacles["table"].to_dict() == result.obstacles[0].to_dict()
        assert result.supports["left"].boundary == "left"
        assert [obstacle.name for obstacle in result.obstacles] == ["table"]
        assert len(result.levels) == 2 and result.levels[1].unknowns == 765
        np.testing.assert_allclose(result.probes.tip.u, [0, 0, -0.025], atol=1e-15)

    def test_a_part_of_another_name_is_an_error_with_the_names(self, result):
        with pytest.raises(KeyError, match="'chair': the names are table"):
            result.obstacles["chair"]
        with pytest.raises(AttributeError, match="there is no energie in the result; there are: title, status, .*energy"):
            result.energie
        with pytest.raises(AttributeError, match="there is no size in contact"):
            result.contact.size
        with pytest.raises(KeyError, match="there is no energie"):
            result["energie"]

    def test_a_case_without_obstacle_has_no_contact(self):
        result = quiet(plastron.Case.from_text(STRIP.split("[[obstacle]]")[0]).solve)
        assert not result.contact
        with pytest.raises(AttributeError, match="contact has no area: the case has no obstacle"):
            result.contact.area
        assert result.to_dict()["contact"] is None

    def test_every_number_has_its_unit(self, result):
        assert result.unit_of("energy") == "J"
        assert result.unit_of("contact.area") == "m^2"
        assert result.contact.unit_of("max_pressure") == "Pa"
        assert result.contact.edge.unit_of("force") == "N"
        assert result.obstacles["table"].unit_of("area") == "m^2"
        assert result.obstacles["table"].unit_of("reaction.force") == "N"
        assert result.probes.tip.unit_of("u") == "m"
        assert result.levels[0].unit_of("unknowns") == "1"
        assert result.levels[0].seconds.unit_of("total") == "s"
        with pytest.raises(KeyError, match="status has no unit"):
            result.unit_of("status")

    def test_the_unit_of_a_part_is_a_text(self, result):
        assert result.estimates.goals["energy"].unit == "J"
        assert result.linearity.quantities["energy"].unit == "J"
        assert (result.certificate_limits.min_gap_nodes.unit, result.certificate_limits.min_pressure.unit) == ("m", "Pa")

    def test_no_entry_of_a_part_has_the_name_of_a_method(self, result):
        def names(value):
            entries = value.values() if isinstance(value, dict) else value if isinstance(value, list) else []
            return set(value if isinstance(value, dict) else ()).union(*map(names, entries))

        methods = {name for name in dir(plastron.Record) if not name.startswith("__")}
        assert not names(result.to_dict()) & methods

    def test_units_have_the_names_that_the_case_gives(self, case):
        case["units.length"] = "mm"
        other = quiet(plastron.solve, case)
        assert other.unit_of("energy") == "mJ"
        assert other.fields.units["displacement"] == "mm"
        assert other.at([[0, 0]]).units["eta"] == "MPa"

    def test_numbers_without_a_meaning_are_none(self, result):
        assert result.stability.margin is None

    def test_plain_values_are_a_copy(self, result):
        result.to_dict()["energy"] = 0
        assert result.energy > 0

    def test_attributes_are_listed(self, result):
        assert {"energy", "contact", "fields"} <= set(dir(result))
        assert {"area", "unit_of"} <= set(dir(result.contact))

    def test_a_record_is_printed_with_its_numbers(self, result):
        assert f"area: {result.contact.area!r}" in repr(result.contact)
        assert "solved" in repr(result)

    def test_a_result_knows_its_case(self, result):
        assert result.case.to_dict() == plastron.Case.from_text(STRIP).to_dict()

    def test_a_case_that_changes_later_does_not_change_its_result(self, case):
        solved = quiet(plastron.solve, case)
        case["shell.thickness"] = 0.01
        assert solved.case["shell.thickness"] == 0.05
        assert solved.settings.shell.thickness == 0.05

    def test_numbers_are_a_row_and_a_table(self, result):
        row = result.row()
        assert (row["energy"], row["status"], row["contact.area"]) == (result.energy, "solved", result.contact.area)
        table = result.to_dataframe()
        assert len(table) == 1 and table.loc[0, "energy"] == result.energy

    def test_instants_are_a_table(self):
        table = quiet(plastron.solve, plastron.Case.from_text(STRIP + STEPS)).to_dataframe()
        assert isinstance(table, pandas.DataFrame)
        np.testing.assert_allclose(table["time"], [1 / 3, 2 / 3, 1])
        assert (np.diff(table["energy"]) > 0).all()

    def test_the_case_is_solved_by_its_own_method(self, case, result):
        assert quiet(case.solve).energy == result.energy


class TestStatus:
    def test_a_solved_case_says_so(self, result):
        assert result.status == "solved" and result.is_solved
        assert result.status_text.startswith("Solved")

    def test_warnings_are_warnings_of_python_and_part_of_the_result(self, case):
        with pytest.warns(plastron.PlastronWarning, match="the shell stands on its edge") as caught:
            solved = plastron.solve(case)
        assert [str(w.message) for w in caught] == list(solved.warnings)
        assert caught[0].filename == __file__

    def test_a_limit_of_iterations_is_a_status_and_a_warning(self, case):
        case["solver.max_iterations"] = 1
        with pytest.warns(plastron.PlastronWarning, match="iteration_limit: The active set still changed"):
            solved = plastron.solve(case)
        assert solved.status == "iteration_limit" and not solved.is_solved
        assert "The active set still changed" in solved.status_text
        assert np.isfinite(solved.fields["u"]).all()

    def test_an_impossible_case_is_refused_and_the_next_one_is_solved(self, case, result):
        for key, value, words in (
            ("obstacle[0].half_space.point", [0, 0, 0.03], "inside of the obstacle"),
            ("support[0].fix", ["u.x"], "the supports leave a rigid motion free"),
            ("load[0].force", ["1/x", 0, 0], "must be finite"),
        ):
            with pytest.raises(plastron.CaseError, match=words):
                plastron.solve(case.with_settings({key: value}))
            assert quiet(plastron.solve, case).energy == result.energy

    @pytest.mark.parametrize("given", [3, STRIP, None])
    def test_only_a_case_is_solved(self, given):
        with pytest.raises(TypeError, match=r"takes a plastron.Case, not .*Case.read\(\)"):
            plastron.solve(given)

    def test_a_wrong_communicator_is_refused(self, case):
        with pytest.raises(ValueError, match="world"):
            plastron.solve(case, comm="all")
        with pytest.raises(TypeError, match="mpi4py"):
            plastron.solve(case, comm=3)

    def test_progress_is_printed_line_by_line_where_there_is_no_terminal(self, case, capsys):
        solved = quiet(plastron.solve, case, progress=True)
        lines = capsys.readouterr().err.splitlines()
        assert lines == [f"mesh {i}: {level.unknowns} unknowns, energy {level.energy:.9g}, {level.active} nodes in contact"
                         for i, level in enumerate(solved.levels)]


class TestCallbacks:
    def test_each_mesh_is_told_with_its_record(self, case):
        told = []
        solved = quiet(plastron.solve, case, on_mesh=lambda number, record: told.append((number, record.energy, record.unknowns)))
        assert told == [(i, level.energy, level.unknowns) for i, level in enumerate(solved.levels)]

    def test_each_iteration_is_told_with_its_record(self, case):
        told = []
        solved = quiet(plastron.solve, case, on_iteration=lambda number, record: told.append((number, record.to_dict())))
        expected = [(i, entry.to_dict()) for i, level in enumerate(solved.levels) for entry in level.history]
        assert len(told) > 5 and [(number, record["active"]) for number, record in told] == [(i, e["active"]) for i, e in expected]

    def test_each_instant_is_told_with_its_record(self):
        told = []
        case = plastron.Case.from_text(STRIP + STEPS)
        solved = quiet(plastron.solve, case, on_instant=lambda record: told.append((record.step, record.time, record.energy)))
        assert told == [(entry.step, entry.time, entry.energy) for entry in solved.history]
        assert len(told) == 3

    @pytest.mark.parametrize("name", ["on_mesh", "on_iteration", "on_instant"])
    def test_an_exception_ends_the_computation_and_is_raised(self, name):
        calls = []

        def fail(*arguments):
            calls.append(arguments)
            raise ZeroDivisionError("mine")

        case = plastron.Case.from_text(STRIP + (STEPS if name == "on_instant" else ""))
        with pytest.raises(ZeroDivisionError, match="mine"):
            quiet(plastron.solve, case, **{name: fail})
        assert len(calls) == 1
        assert quiet(plastron.solve, case).status == "solved"

    def test_an_exception_ends_a_long_computation_early(self):
        finished = []

        def fail(number, record):
            finished.append(number)
            if number == 1:
                raise StopIteration

        with pytest.raises(StopIteration):
            quiet(plastron.solve, plastron.Case.from_text(LONG), on_mesh=fail)
        assert finished == [0, 1]

    def test_a_warning_made_an_error_is_raised(self, case):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            with pytest.raises(plastron.PlastronWarning, match="edge"):
                plastron.solve(case)

    def test_a_callback_may_not_start_another_computation(self, tmp_path):
        """The process must end, with any answer."""
        answer = python(
            f"""
import plastron, warnings
warnings.simplefilter("ignore")
case = plastron.Case.from_text({STRIP!r})
def inner(number, record):
    case.solve()
try:
    print(case.solve(on_mesh=inner).status)
except Exception as error:
    print(type(error).__name__)
""",
            tmp_path,
            seconds=10,
        )
        assert answer.strip()


class TestInterruption:
    script = f"""
import plastron, warnings
warnings.simplefilter("ignore")
result = plastron.solve(plastron.Case.from_text({LONG!r}), on_mesh=lambda number, record: print("mesh", number, flush=True))
print(result.status, len(result.levels), result.levels[len(result.levels) - 1].energy == result.energy, result.fields["u"].shape[0] > 0)
print(plastron.Case.from_text({STRIP!r}).solve().status)
"""

    def test_control_c_returns_the_last_finished_mesh(self, tmp_path):
        process = subprocess.Popen([sys.executable, "-c", self.script], cwd=tmp_path, env=environment(), stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        try:
            for number in range(3):
                assert process.stdout.readline() == f"mesh {number}\n"
            process.send_signal(signal.SIGINT)
            output, errors = process.communicate(timeout=60)
        finally:
            process.kill()
        lines = [line for line in output.splitlines() if not line.startswith("mesh")]
        assert errors == "" and process.returncode == 0
        status, levels, is_last, has_fields = lines[0].split()
        assert (status, is_last, has_fields) == ("interrupted", "True", "True")
        assert 3 <= int(levels) < 6
        assert lines[1] == "solved"

    def test_control_c_before_the_first_mesh_is_a_keyboard_interrupt(self, case):
        def press(number, record):
            signal.raise_signal(signal.SIGINT)

        with pytest.raises(KeyboardInterrupt):
            quiet(plastron.solve, case, on_iteration=press)
        assert quiet(plastron.solve, case).status == "solved"

    @pytest.mark.parametrize("name", ["on_mesh", "on_iteration", "on_instant"])
    def test_control_c_during_a_callback_returns_the_last_finished_mesh(self, name):
        """With a callback, or a bar, Ctrl-C often arrives while it runs."""

        def press(*arguments):
            if name != "on_iteration" or arguments[0] == 1:
                signal.raise_signal(signal.SIGINT)

        text = STRIP + STEPS if name == "on_instant" else LONG.replace("refinements = 5", "refinements = 2")
        try:
            solved = quiet(plastron.solve, plastron.Case.from_text(text), **{name: press})
        except KeyboardInterrupt:  # it would end pytest
            pytest.fail("the finished meshes are lost")
        assert solved.status == "interrupted"
        assert len(solved.history) == 1 if name == "on_instant" else 1 <= len(solved.levels) < 3
        assert np.isfinite(solved.fields["u"]).all()

    def test_other_threads_go_on_during_a_computation(self):
        stamps, is_over = [], threading.Event()

        def count():
            while not is_over.wait(0.002):
                stamps.append(time.perf_counter())

        thread = threading.Thread(target=count)
        start = time.perf_counter()
        thread.start()
        try:
            quiet(plastron.solve, plastron.Case.from_text(LONG).with_settings({"mesh.refinements": 4}))
        finally:
            end = time.perf_counter()
            is_over.set()
            thread.join()
        pauses = np.diff([start, *(t for t in stamps if t < end), end])
        assert end - start > 0.3
        assert np.max(pauses) < 0.2 * (end - start)

    def test_computations_of_several_threads_follow_each_other(self, result):
        energies = []
        case = plastron.Case.from_text(STRIP)
        threads = [threading.Thread(target=lambda: energies.append(case.solve().energy)) for _ in range(4)]
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
        assert energies == [result.energy] * 4

    def test_values_and_files_may_be_asked_for_while_another_thread_solves(self, tmp_path):
        answer = python(
            f"""
import plastron, threading, warnings
warnings.simplefilter("ignore")
case = plastron.Case.from_text({STRIP!r})
results = [case.solve() for _ in range(6)]
energies = []
thread = threading.Thread(target=lambda: energies.extend(case.solve().energy for _ in range(30)))
thread.start()
while thread.is_alive():
    values = [result.at([[1, 0.25], [0.5, 0.1]])["u"].tolist() for result in results[:4]]
    if results[4:]:
        results.pop().save("out")
thread.join()
print(set(energies) == {{results[0].energy}}, values.count(values[0]) == 4)
""",
            tmp_path,
        )
        assert answer == "True True\n"


class TestFields:
    def test_fields_are_arrays_with_units(self, result):
        fields = result.fields
        count = len(fields.points)
        assert fields.points.shape == (count, 3) and fields.points.dtype == float
        assert fields.cells.shape == (32, 9) and count == 32 * 9
        assert sorted(fields.cells.ravel()) == list(range(count))
        for name, array in fields.items():
            assert array.shape in ((count,), (count, 3)), name
            assert array.dtype == float
            assert fields.units[name], name
        assert fields["u"] is fields["displacement"] and fields.units["displacement"] == "m"
        assert fields.of_cells["error_indicator"].shape == (32,)

    def test_points_are_deformed(self, result):
        np.testing.assert_allclose(result.fields.points, result.fields["reference position"] + result.fields["u"], atol=1e-15)

    def test_fields_outlive_their_result(self, case):
        solved = quiet(plastron.solve, case)
        array, points, cell_values = solved.fields["u"], solved.fields.points, solved.fields.of_cells["error_indicator"]
        copies = [array.copy(), points.copy(), cell_values.copy()]
        del solved
        others = [quiet(plastron.solve, case) for _ in range(2)]
        for other in others:
            other.fields["u"][:] = 7
        for kept, expected in zip((array, points, cell_values), copies):
            np.testing.assert_array_equal(kept, expected)

    def test_changed_arrays_do_not_change_the_solution(self, case):
        solved = quiet(plastron.solve, case)
        before = solved.at([[0.5, 0.2]])["u"].copy()
        solved.fields["u"][:] = 0
        np.testing.assert_array_equal(solved.at([[0.5, 0.2]])["u"], before)

    def test_fields_are_those_of_the_vtu_file(self, result, saved):
        mesh = meshio.read(saved / "solution.vtu")
        fields = result.fields
        np.testing.assert_allclose(mesh.points, fields.points, rtol=1e-6, atol=1e-9)
        np.testing.assert_array_equal(mesh.cells[0].data, fields.cells)
        assert set(mesh.point_data) == set(fields) - {"u", "r"}
        for name, array in mesh.point_data.items():
            size = np.max(np.abs(fields[name]))
            np.testing.assert_allclose(array.reshape(fields[name].shape), fields[name], rtol=1e-6, atol=1e-7 * size, err_msg=name)
        np.testing.assert_allclose(mesh.cell_data["error_indicator"][0].ravel(), fields.of_cells["error_indicator"], rtol=1e-6)

    def test_double_precision_files_have_the_same_digits(self, case, tmp_path):
        case["output.precision"] = "double"
        solved = quiet(plastron.solve, case, output=tmp_path / "out")
        mesh = meshio.read(tmp_path / "out/solution.vtu")
        np.testing.assert_array_equal(mesh.point_data["displacement"], solved.fields["displacement"])
        np.testing.assert_array_equal(mesh.points, solved.fields.points)

    def test_heights_of_the_case_are_fields(self, case):
        case["output.heights"] = [0.25]
        solved = quiet(plastron.solve, case)
        assert any("0.25" in name for name in solved.fields)


class TestValues:
    def test_values_at_a_node_are_those_of_the_probe(self, result):
        values = result.at([[1, 0.25]])
        probe = result.probes.tip
        np.testing.assert_array_equal(values["u"], [probe.u])
        np.testing.assert_array_equal(values["displacement"], [probe.u])
        np.testing.assert_array_equal(values["r"], [probe.r])
        assert values["eta"][0] == probe.eta and values.units["eta"] == "Pa"
        np.testing.assert_array_equal([values["M_11"][0], values["M_22"][0], values["M_12"][0]], probe.M)

    def test_values_inside_of_a_cell_are_those_of_the_fields(self, result):
        """The points of the fields are the nodes; at(), asked at their parameters, gives the same numbers."""
        fields = result.fields
        chosen = np.arange(0, len(fields.points), 17)
        values = result.at(np.column_stack([fields["x"], fields["y"]])[chosen])
        for name in ("u", "r", "reference position", "thickness", "gap"):
            np.testing.assert_allclose(values[name], fields[name][chosen], atol=1e-14, err_msg=name)

    def test_places_in_space_are_projected_on_the_mid_surface(self, result):
        in_space = result.at([[0.3, 0.2, 0.05], [0.7, 0.4, 0.9]])
        of_parameters = result.at([[0.3, 0.2], [0.7, 0.4]])
        for name in of_parameters:
            np.testing.assert_allclose(in_space[name], of_parameters[name], rtol=1e-8, atol=1e-12, err_msg=name)

    def test_one_point_needs_no_list(self, result):
        np.testing.assert_array_equal(result.at([0.5, 0.2])["u"], result.at([[0.5, 0.2]])["u"])

    def test_no_points_give_no_values(self, result):
        assert result.at(np.empty((0, 2)))["u"].shape == (0, 3)

    def test_heights_give_further_stresses(self, result):
        plain = result.at([[0.2, 0.2]])
        values = result.at([[0.2, 0.2]], heights=[0.25])
        further = [name for name in values if name not in plain]
        assert further and all("0.25" in name for name in further)
        name = next(name for name in further if name.startswith("stress_11"))
        middle, upper = plain["stress_11_middle"][0], plain["stress_11_upper"][0]
        np.testing.assert_allclose(values[name][0], middle + 0.5 * (upper - middle), rtol=1e-9)

    def test_a_point_outside_of_the_domain_is_refused(self, result):
        with pytest.raises(plastron.PointError, match=r"\(5, 5\) lies outside of the domain"):
            result.at([[5, 5]])
        with pytest.raises(plastron.PointError, match="lies outside of the domain"):
            result.along([0, 0], [2, 0])
        assert issubclass(plastron.PointError, plastron.PlastronError) and issubclass(plastron.PointError, ValueError)

    @pytest.mark.parametrize("point", [[np.nan, 0], [0, 0, np.inf]])
    def test_a_point_that_is_not_finite_is_refused(self, result, point):
        with pytest.raises(plastron.PointError, match="is not finite"):
            result.at([[0.5, 0.2, 0][: len(point)], point])

    @pytest.mark.parametrize("points", [[1, 2, 3, 4], [[1]], [[[0, 0]]], 3])
    def test_other_shapes_are_refused(self, result, points):
        with pytest.raises(ValueError, match="n x 2 parameters or n x 3 places"):
            result.at(points)

    def test_values_along_a_line_are_those_at_its_points(self, result):
        along = result.along([0, 0.25], [1, 0.25], points=5)
        at = result.at([[0, 0.25], [0.25, 0.25], [0.5, 0.25], [0.75, 0.25], [1, 0.25]])
        for name in at:
            np.testing.assert_array_equal(along[name], at[name])
        places = at["reference position"]
        np.testing.assert_allclose(along["s"], np.cumsum([0, *np.linalg.norm(places[1:] - places[:-1], axis=1)]), rtol=1e-12)
        assert along.units["s"] == along.units["reference position"] and "s" not in at
        assert len(result.along([0, 0.25], [1, 0.25])["u"]) == 101
        assert any("0.25" in name for name in result.along([0, 0.25], [1, 0.25], 3, heights=[0.25]))

    def test_values_are_a_table(self, result):
        table = result.along([0, 0.25], [1, 0.25], 3).to_dataframe()
        assert len(table) == 3
        np.testing.assert_array_equal(table["displacement_z"], result.along([0, 0.25], [1, 0.25], 3)["u"][:, 2])
        assert "eta" in table

    def test_probes_of_the_program_have_the_same_values(self, result, tmp_path, strip_file):
        strip_file.write_text(STRIP + '\n[[probe]]\nname = "inside"\nat = [0.37, 0.11]\n')
        outcome = command("run", strip_file, "--output", "out", "--quiet", directory=tmp_path)
        assert outcome.returncode == 0
        probe = json.loads((tmp_path / "out/results.json").read_text())["probes"]["inside"]
        values = result.at([[0.37, 0.11]])
        np.testing.assert_array_equal(values["u"][0], probe["u"])
        assert values["gap"][0] == probe["gap"]
        np.testing.assert_array_equal([values["M_11"][0], values["M_22"][0], values["M_12"][0]], probe["M"])


class TestOtherPrograms:
    def test_a_mesh_of_meshio_has_all_fields(self, result, tmp_path):
        mesh = result.to_meshio()
        assert mesh.cells[0].type == "VTK_LAGRANGE_QUADRILATERAL"
        np.testing.assert_array_equal(mesh.point_data["displacement"], result.fields["u"])
        np.testing.assert_array_equal(mesh.cell_data["error_indicator"][0], result.fields.of_cells["error_indicator"])

    def test_a_mesh_of_meshio_can_be_written_and_read(self, result, tmp_path):
        result.to_meshio().write(tmp_path / "mesh.vtu")
        back = meshio.read(tmp_path / "mesh.vtu")
        np.testing.assert_array_equal(back.points, result.fields.points)
        np.testing.assert_array_equal(back.point_data["displacement"], result.fields["u"])

    def test_a_grid_of_pyvista_gets_points_cells_and_fields(self, result, monkeypatch):
        class UnstructuredGrid:
            def __init__(self, cells, kinds, points):
                self.cells, self.kinds, self.points, self.point_data, self.cell_data = cells, kinds, points, {}, {}

        module = types.ModuleType("pyvista")
        module.UnstructuredGrid = UnstructuredGrid
        monkeypatch.setitem(sys.modules, "pyvista", module)
        grid = result.to_pyvista()
        assert isinstance(grid, UnstructuredGrid)
        cells = np.asarray(grid.cells).reshape(32, 10)
        assert (cells[:, 0] == 9).all()
        np.testing.assert_array_equal(cells[:, 1:], result.fields.cells)
        assert np.issubdtype(cells.dtype, np.integer)
        assert list(grid.kinds) == [70] * 32
        np.testing.assert_array_equal(grid.points, result.fields.points)
        np.testing.assert_array_equal(grid.point_data["displacement"], result.fields["u"])
        assert grid.cell_data["error_indicator"].shape == (32,)


class TestFiles:
    def test_the_files_are_those_of_the_program(self, saved, tmp_path, strip_file):
        command("run", strip_file, "--output", "out", "--quiet", directory=tmp_path)
        assert sorted(p.name for p in saved.iterdir()) == sorted(p.name for p in (tmp_path / "out").iterdir())
        assert (saved / "solution.vtu").read_bytes() == (tmp_path / "out/solution.vtu").read_bytes()

    def test_a_folder_that_cannot_be_written_is_an_output_error(self, result):
        with pytest.raises(plastron.OutputError, match="/proc/no: results cannot be written here"):
            result.save("/proc/no")

    def test_an_unknown_field_is_answered_with_the_known_ones(self, result):
        for arrays in (result.fields, result.at([[0.5, 0.2]])):
            with pytest.raises(KeyError, match="there is no field 'mises'; there are: .*displacement"):
                arrays["mises"]

    def test_checksums_of_saved_files_are_right(self, saved):
        outcome = subprocess.run(["sha256sum", "--check", "--quiet", "SHA256SUMS"], cwd=saved, capture_output=True, text=True)
        assert outcome.returncode == 0, outcome.stdout + outcome.stderr

    def test_saved_results_are_loaded_with_the_same_numbers_and_fields(self, result, saved):
        loaded = plastron.load(saved)
        assert loaded.energy == result.energy and loaded.status == "solved"
        np.testing.assert_array_equal(loaded.obstacles["table"].force, result.obstacles["table"].force)
        np.testing.assert_allclose(loaded.fields["u"], result.fields["u"], atol=1e-15)
        np.testing.assert_allclose(loaded.at([[0.5, 0.2]])["u"], result.at([[0.5, 0.2]])["u"], atol=1e-15)
        assert loaded.case.to_dict() == result.case.to_dict()
        assert loaded.unit_of("energy") == "J"

    def test_modes_and_envelopes_of_earlier_results_do_not_stay_but_other_files_do(self, result, tmp_path):
        earlier = {"buckling_9.mode", "buckling_kept.mode", "envelope-all.vtu", "envelope-all.csv"}
        for name in earlier:
            (tmp_path / name).write_text("")
        result.save(tmp_path)
        assert {path.name for path in tmp_path.iterdir()} & earlier == {"buckling_kept.mode", "envelope-all.csv"}

    def test_loaded_results_can_be_saved_shown_and_verified(self, saved, tmp_path):
        loaded = plastron.load(str(saved))
        target = loaded.save(tmp_path / "again")
        assert sorted(p.name for p in target.iterdir()) == sorted(p.name for p in saved.iterdir())
        assert loaded.verify()
        assert "<iframe" in loaded.view()._repr_html_()

    def test_results_of_a_case_with_changed_keys_are_loaded_with_them(self, case, tmp_path):
        case["shell.thickness"] = 0.04
        solved = quiet(plastron.solve, case, output=tmp_path / "out")
        loaded = plastron.load(tmp_path / "out")
        assert loaded.case["shell.thickness"] == 0.04
        assert loaded.energy == solved.energy
        assert plastron.verify(tmp_path / "out")

    def test_a_result_is_verified(self, result):
        verification = result.verify()
        assert verification and verification.has_passed and repr(verification) == "PASSED"
        assert all(holds for *_, holds in verification.rows) and len(verification.rows) > 5
        paths = {path: (recomputed, claimed, agrees) for path, recomputed, claimed, _, agrees in verification.numbers}
        assert all(agrees for _, _, agrees in paths.values()) and len(paths) > 10
        assert any("energy" in path for path in paths)

    def test_the_rows_of_a_verification_have_the_units_of_the_case(self, case, tmp_path):
        case["units.length"] = "mm"
        result = quiet(plastron.solve, case, output=tmp_path / "out")
        verification = result.verify()
        units = {row: unit for row, _, _, _, unit, _ in verification.rows}
        assert (units["min_gap_nodes"], units["min_pressure"], units["complementarity"], units["force_balance"]) == ("mm", "MPa", "MPa mm", "1")
        assert all(units[row] == limit["unit"] for row, limit in result.certificate_limits.to_dict().items())

    def test_a_saved_result_passes_the_program(self, saved, tmp_path):
        outcome = command("verify", saved, directory=tmp_path)
        assert outcome.returncode == 0 and "PASSED" in outcome.stdout

    def test_changed_numbers_fail(self, result, tmp_path):
        folder = result.save(tmp_path / "changed")
        text = (folder / "results.json").read_text()
        (folder / "results.json").write_text(text.replace(f'"energy": {result.energy!r}', f'"energy": {1.01 * result.energy!r}', 1))
        verification = plastron.verify(folder)
        assert not verification and not verification.has_passed
        assert any("energy" in failure for failure in verification.failures)
        assert repr(verification).startswith("FAILED: ")
        with pytest.warns(plastron.PlastronWarning, match="energy"):
            plastron.load(folder)
        outcome = command("verify", folder, directory=tmp_path)
        assert outcome.returncode == 3
        for failure in verification.failures:
            assert " ".join(failure.split()) in " ".join((outcome.stdout + outcome.stderr).split())

    def test_what_is_no_result_is_an_error(self, tmp_path):
        (tmp_path / "empty").mkdir()
        (tmp_path / "broken").mkdir()
        (tmp_path / "broken/results.json").write_text("{")
        for name in ("missing", "empty", "broken"):
            with pytest.raises(plastron.ResultsError, match=name):
                plastron.load(tmp_path / name)
            with pytest.raises(plastron.ResultsError, match=name):
                plastron.verify(tmp_path / name)

    def test_an_output_folder_has_the_files_at_once(self, case, tmp_path):
        solved = quiet(plastron.solve, case, output=tmp_path / "deep/out")
        names = {p.name for p in (tmp_path / "deep/out").iterdir()}
        assert {"results.json", "report.html", "solution.vtu", "SHA256SUMS"} <= names
        assert solved.directory == tmp_path / "deep/out"
        assert solved.save(tmp_path / "deep/out") == tmp_path / "deep/out"
        del solved
        assert (tmp_path / "deep/out/results.json").exists()

    def test_without_a_report_there_is_none(self, case, tmp_path):
        solved = quiet(plastron.solve, case, output=tmp_path / "out", report=False)
        assert not (tmp_path / "out/report.html").exists()
        assert "<table>" in solved._repr_html_()
        with pytest.raises(plastron.ResultsError, match="no report.html; solve the case with report=True"):
            solved.view()

    def test_a_folder_that_cannot_be_written_is_an_error(self, case, tmp_path):
        (tmp_path / "file").write_text("mine")
        with pytest.raises(plastron.OutputError, match="file"):
            plastron.solve(case, output=tmp_path / "file")
        assert issubclass(plastron.OutputError, OSError)
        assert (tmp_path / "file").read_text() == "mine"

    def test_files_of_a_result_without_a_folder_go_with_it(self, case):
        solved = quiet(plastron.solve, case)
        folder = solved.directory
        assert (folder / "results.json").exists()
        del solved
        assert not folder.exists()

    def test_a_refused_case_leaves_no_folder(self, case, tmp_path, monkeypatch):
        monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
        case["support[0].fix"] = ["u.x"]
        with pytest.raises(plastron.CaseError):
            plastron.solve(case)
        assert list(tmp_path.iterdir()) == []


class TestNotebook:
    def test_the_summary_has_the_numbers_with_units(self, result):
        page = result._repr_html_()
        assert "A strip pressed on a table" in page and "solved" in page
        for name, value, unit in (
            ("energy", result.energy, "J"),
            ("max_displacement", result.size.max_displacement, "m"),
            ("contact.area", result.contact.area, "m^2"),
            ("stress.max_von_mises", result.stress.max_von_mises, "Pa"),
        ):
            assert f"{name}</td><td>{value:.6g}</td><td>{unit}</td>" in page, name

    def test_the_summary_is_small_and_writes_no_files(self, case):
        solved = quiet(plastron.solve, case)
        assert len(solved._repr_html_()) < 2000
        assert not (solved._directory / "results.json").exists()

    def test_the_view_is_the_report(self, case):
        solved = quiet(plastron.solve, case)
        view = solved.view(height=400)
        report = view.path.read_text(encoding="utf-8")
        assert view.path == solved.directory / "report.html" and "report.html" in repr(view)
        del solved
        page = view._repr_html_()  # also when the files are gone
        assert page.startswith('<iframe srcdoc="&lt;!doctype html&gt;') and "height:400px" in page
        assert html.unescape(page.split('"')[1]) == report

    @pytest.mark.skipif(importlib.util.find_spec("ipywidgets") is not None, reason="ipywidgets are installed")
    @pytest.mark.parametrize("call", ["plastron.solve(case, progress=True)", 'plastron.sweep(case, {"shell.E": [1, 2]}, progress=True, workers=1)'])
    def test_without_ipywidgets_a_bar_is_text_without_a_warning(self, call, tmp_path):
        pytest.importorskip("tqdm")
        answer = python(
            f"""
import io, sys, types, warnings
import plastron
sys.modules["ipykernel"] = types.ModuleType("ipykernel")
module = types.ModuleType("IPython")  # as in a kernel
module.get_ipython = lambda: types.SimpleNamespace(config={{"IPKernelApp": {{}}}})
sys.modules["IPython"] = module
sys.stderr = io.StringIO()
case = plastron.Case.from_text({STRIP!r})
with warnings.catch_warnings(record=True) as caught:
    warnings.simplefilter("always")
    {call}
assert all(w.category is plastron.PlastronWarning for w in caught), caught
print(repr(sys.stderr.getvalue()))
""",
            tmp_path,
        )
        assert "2 done" in answer or "2/2" in answer, answer

    def test_titles_are_quoted(self, case):
        case["title"] = "<script>alert(1)</script>"
        assert "<script>" not in quiet(plastron.solve, case)._repr_html_()


class TestImport:
    def test_the_import_is_fast_and_loads_no_solver(self, tmp_path):
        answer = python(
            """
import time
start = time.perf_counter()
import plastron
seconds = time.perf_counter() - start
libraries = ("libdeal", "libpetsc", "numpy")
maps = open("/proc/self/maps").read()
print(seconds, *(library in maps for library in libraries))
import plastron.result, plastron._solver
maps = open("/proc/self/maps").read()
print(*(library in maps for library in libraries))
""",
            tmp_path,
        ).split()
        assert float(answer[0]) < 0.3
        assert answer[1:4] == ["False"] * 3
        assert answer[4:] == ["True"] * 3  # so that the names are right

    def test_every_public_name_is_there(self):
        for name in plastron.__all__:
            assert getattr(plastron, name) is not None
        assert set(plastron.__all__) == set(dir(plastron))
        with pytest.raises(AttributeError, match="no attribute 'nothing'"):
            plastron.nothing

    def test_the_version_is_that_of_the_program(self, tmp_path):
        assert command("--version", directory=tmp_path).stdout.strip().endswith(plastron.__version__)


def test_results_on_a_mesh_from_a_file_are_loaded_again(tmp_path):
    shutil.copy(SOURCE / "tests/verification/meshes/distorted-square.msh", tmp_path / "square.msh")
    rectangle = "{ rectangle = { from = [0, 0], to = [1, 0.5], cells = [4, 2] } }"
    assert rectangle in STRIP
    text = STRIP.replace(rectangle, '{ mesh = "square.msh" }')
    result = quiet(plastron.Case.from_text(text, tmp_path / "case.toml").solve, output=tmp_path / "out")
    loaded = plastron.load(tmp_path / "out")
    assert loaded.energy == result.energy
    assert loaded.case.files == {"square.msh": str(tmp_path / "square.msh")}


def test_results_that_miss_a_limit_are_loaded_with_their_fields(tmp_path):
    plane = "half_space = { point = [0, 0, 0], normal = [0, 0, 1] }"
    assert plane in STRIP
    pin = "ball = { centre = [0.83, 0.27, 0.02], radius = 0.004 }"  # between the nodes, and inside of the face
    result = quiet(plastron.Case.from_text(STRIP.replace(plane, pin)).solve, output=tmp_path)
    assert result.status == "inaccurate"
    with pytest.warns(plastron.PlastronWarning, match='the status of these results is "inaccurate"'):
        loaded = plastron.load(tmp_path)
    assert np.array_equal(loaded.fields["u"], result.fields["u"])
