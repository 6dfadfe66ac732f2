"""Several ranks with communicators of mpi4py."""

import json

import plastron
import pytest
from conftest import STEPS, STRIP, quiet
from program import PROGRAM, plastron as command, python, run

pytest.importorskip("mpi4py")


@pytest.mark.parametrize("steps", ["", STEPS], ids=["one load", "steps"])
def test_three_ranks_give_the_energy_of_one_to_twelve_digits(tmp_path, steps):
    text = STRIP + steps
    alone = quiet(plastron.solve, plastron.Case.from_text(text))
    answer = python(
        f"""
from mpi4py import MPI
import json, plastron, warnings
warnings.simplefilter("ignore")
comm = MPI.COMM_WORLD
result = plastron.solve(plastron.Case.from_text({text!r}), comm=comm, output="out")
values = result.at([[1, 0.25], [0.1, 0.3]])["u"].tolist()
cells = comm.allgather(len(result.fields.cells))
all_of_it = comm.gather((result.energy, result.ranks, result.status, values))
if comm.rank == 0:
    print(json.dumps([all_of_it, cells]))
""",
        tmp_path,
        ranks=3,
    )
    ranks, cells = json.loads(answer)
    assert len(ranks) == 3 and all(rank == ranks[0] for rank in ranks)
    energy, count, status, values = ranks[0]
    assert (count, status) == (3, "solved")
    assert energy == pytest.approx(alone.energy, rel=5e-12, abs=0)
    assert sum(cells) == len(alone.fields.cells) and min(cells) > 0
    for value, expected in zip(values, alone.at([[1, 0.25], [0.1, 0.3]])["u"]):
        assert value == pytest.approx(expected, rel=1e-9, abs=1e-14)
    assert command("verify", "out", directory=tmp_path).returncode == 0


def test_a_process_alone_makes_no_folder_for_mpi(tmp_path):
    """Processes that share a folder remove it while another one starts."""
    answer = python(
        f"""
import os
os.environ["TMPDIR"] = "/dev/null/none"
import plastron
print(plastron.solve(plastron.Case.from_text({STRIP!r}), output="out", warn=False).status)
""",
        tmp_path,
    )
    assert answer == "solved\n"


def test_derivatives_on_two_ranks_are_those_of_one(tmp_path):
    keys = ["shell.E", "shell.thickness", "load[0].force[2]"]
    alone = quiet(plastron.Case.from_text(STRIP).solve, report=False).derivatives(keys)
    answer = python(
        f"""
import json, plastron, warnings
warnings.simplefilter("ignore")
result = plastron.solve(plastron.Case.from_text({STRIP!r}), report=False)
by = result.derivatives({keys!r})
if result._is_first():
    print(json.dumps({{key: [by[key]["energy"], by[key]["reaction.force_z"]] for key in by}}))
""",
        tmp_path,
        ranks=2,
    )
    for key, values in json.loads(answer).items():
        for (value, error), name in zip(values, ["energy", "reaction.force_z"]):
            expected, other = alone[key][name]
            assert value == pytest.approx(expected, rel=1e-8, abs=10 * (error + other))


@pytest.mark.slow
def test_the_program_on_three_ranks_has_the_same_numbers(tmp_path, strip_file):
    """Sums over ranks differ in the last digits from run to run, also in the program."""
    outcome = run(["mpirun", "-n", 3, PROGRAM, "run", strip_file, "--output", "program", "--quiet"], tmp_path)
    assert outcome.returncode == 0, outcome.stderr
    answer = python(
        f"""
from mpi4py import MPI
import json, plastron, warnings
warnings.simplefilter("ignore")
result = plastron.solve(plastron.Case.read({str(strip_file)!r}), comm=MPI.COMM_WORLD)
if MPI.COMM_WORLD.rank == 0:
    print(json.dumps(result.to_dict()))
""",
        tmp_path,
        ranks=3,
    )
    here, there = json.loads(answer), json.loads((tmp_path / "program/results.json").read_text())
    assert list(here) == list(there) and here["settings"] == there["settings"] and here["ranks"] == there["ranks"] == 3
    assert [level["active"] for level in here["levels"]] == [level["active"] for level in there["levels"]]
    assert here["warnings"] == there["warnings"]
    for path in (["energy"], ["contact", "area"], ["reaction", "force"], ["stress", "max_von_mises"], ["probes", "tip", "u"]):
        ours, theirs = here, there
        for name in path:
            ours, theirs = ours[name], theirs[name]
        assert ours == pytest.approx(theirs, rel=1e-9, abs=1e-16), path


def test_files_are_written_and_verified_on_all_ranks_without_an_output_folder(tmp_path):
    answer = python(
        f"""
from mpi4py import MPI
import plastron, warnings
warnings.simplefilter("ignore")
world = MPI.COMM_WORLD
result = plastron.solve(plastron.Case.from_text({STRIP!r}), comm=world)
outcome = []
for action in (lambda: result.directory, lambda: result.verify(), lambda: result.save("out"), lambda: "iframe" in result.view()._repr_html_()):
    try:
        outcome.append(str(action()))
    except Exception as error:
        outcome.append(type(error).__name__ + ": " + str(error))
    world.Barrier()
everything = world.gather(outcome)
if world.rank == 0:
    print(everything)
""",
        tmp_path,
        ranks=2,
        seconds=10,
    )
    first, second = eval(answer)
    assert first[1:] == ["PASSED", "out", "True"]
    assert second == first
    assert command("verify", "out", directory=tmp_path).returncode == 0


def test_a_result_is_verified_on_its_own_communicator(tmp_path):
    answer = python(
        f"""
from mpi4py import MPI
import plastron, warnings
warnings.simplefilter("ignore")
world = MPI.COMM_WORLD
part = world.Split(world.rank, 0)
result = plastron.solve(plastron.Case.from_text({STRIP!r}), comm=part)
if world.rank == 0:
    print(result.verify())
world.Barrier()
""",
        tmp_path,
        ranks=2,
        seconds=10,
    )
    assert answer == "PASSED\n"


def test_parts_of_a_split_communicator_solve_different_cases_at_the_same_time(tmp_path, case):
    answer = python(
        f"""
from mpi4py import MPI
import plastron, warnings
warnings.simplefilter("ignore")
world = MPI.COMM_WORLD
colour = 0 if world.rank < 2 else 1
part = world.Split(colour, world.rank)
case = plastron.Case.from_text({STRIP!r})
case["shell.thickness"] = [0.04, 0.05][colour]
for repetition in range(1 + 2 * colour):  # the parts do not compute in step
    result = plastron.solve(case, comm=part, output=f"out{{colour}}")
verified = plastron.verify(f"out{{colour}}", comm=part)
everything = world.gather((colour, result.ranks, result.energy, bool(verified)))
if world.rank == 0:
    print(everything)
""",
        tmp_path,
        ranks=3,
    )
    ranks = eval(answer)
    assert [rank[:2] for rank in ranks] == [(0, 2), (0, 2), (1, 1)]
    assert all(rank[3] for rank in ranks)
    for colour, thickness in enumerate((0.04, 0.05)):
        expected = quiet(plastron.solve, case.with_settings({"shell.thickness": thickness})).energy
        assert [rank[2] for rank in ranks if rank[0] == colour] == pytest.approx([expected] * (2 - colour), rel=5e-12, abs=0)


def test_one_rank_solves_alone_while_the_others_do_something_else(tmp_path, result):
    answer = python(
        f"""
from mpi4py import MPI
import plastron, warnings
warnings.simplefilter("ignore")
if MPI.COMM_WORLD.rank == 0:
    print(plastron.solve(plastron.Case.from_text({STRIP!r}), comm="self").energy)
""",
        tmp_path,
        ranks=2,
        seconds=10,
    )
    assert float(answer) == result.energy


def test_a_refused_case_is_refused_on_all_ranks_and_the_next_is_solved(tmp_path):
    answer = python(
        f"""
from mpi4py import MPI
import plastron, warnings
warnings.simplefilter("ignore")
world = MPI.COMM_WORLD
case = plastron.Case.from_text({STRIP!r})
try:
    plastron.solve(case.with_settings({{"support[0].fix": ["u.x"]}}), comm=world)
    text = ""
except plastron.CaseError as error:
    text = str(error)
everything = world.gather((text, plastron.solve(case, comm=world).status))
if world.rank == 0:
    print(everything)
""",
        tmp_path,
        ranks=2,
    )
    ranks = eval(answer)
    assert all("rigid motion" in text and status == "solved" for text, status in ranks)


def test_an_exception_in_a_callback_of_one_rank_ends_the_computation_on_all(tmp_path):
    answer = python(
        f"""
from mpi4py import MPI
import plastron, warnings
warnings.simplefilter("ignore")
world = MPI.COMM_WORLD
def fail(number, record):
    if world.rank == 1:
        raise ZeroDivisionError
try:
    outcome = plastron.solve(plastron.Case.from_text({STRIP!r}), comm=world, on_mesh=fail).status
except Exception as error:
    outcome = type(error).__name__
everything = world.gather(outcome)
if world.rank == 0:
    print(everything)
""",
        tmp_path,
        ranks=2,
        seconds=20,
    )
    assert eval(answer)[1] == "ZeroDivisionError"


def test_mpi4py_works_after_a_solution_and_before_it(tmp_path):
    for order in ("before", "after"):
        answer = python(
            f"""
import plastron, warnings
warnings.simplefilter("ignore")
if {order == "before"}:
    from mpi4py import MPI
plastron.solve(plastron.Case.from_text({STRIP!r}))
from mpi4py import MPI
print(MPI.COMM_WORLD.allreduce(1))
""",
            tmp_path,
        )
        assert answer == "1\n"
