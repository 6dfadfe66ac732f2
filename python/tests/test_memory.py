"""Many computations in one process."""

import pytest
from conftest import STRIP
from program import python


@pytest.mark.slow
def test_three_hundred_solutions_and_failures_in_one_process_need_no_more_memory(tmp_path):
    """Between the hundredth and the last solution the process grows by less than 5 MB. One solution in five also makes fields,
    values and files; one case in five is refused, and one ends by an exception in a callback."""
    answer = python(
        f"""
import gc, plastron, warnings
warnings.simplefilter("ignore")

def resident():
    gc.collect()
    with open("/proc/self/status") as status:
        return next(int(line.split()[1]) for line in status if line.startswith("VmRSS")) / 1024

def fail(number, record):
    raise ZeroDivisionError

case = plastron.Case.from_text({STRIP!r})
energies, after = set(), {{}}
for i in range(1, 301):
    result = case.solve()
    energies.add(result.energy)
    if i % 5 == 0:
        result.at([[0.5, 0.2]]), result.fields["u"].sum(), result.directory
    refused = [(1, "support[0].fix", ["u.x"]), (2, "obstacle[0].half_space.point", [0, 0, 0.03]), (3, "shell.thickness", -1)]
    for wrong, key, value in refused:
        try:
            if i % 5 == wrong:
                case.with_settings({{key: value}}).solve()
                print("not refused")
        except plastron.CaseError:
            pass
    try:
        if i % 5 == 4:
            case.solve(on_mesh=fail)
            print("not ended")
    except ZeroDivisionError:
        pass
    if i in (100, 300):
        after[i] = resident()
print(len(energies), after[100], after[300] - after[100])
""",
        tmp_path,
    )
    number, _, growth = answer.split()
    assert int(number) == 1
    assert float(growth) < 5, answer
