"""Load cases of a result: their fields, envelopes, and sums."""

import numpy as np
import plastron
import pytest
from conftest import STRIP, quiet

CASES = """
[gravity]
name = "weight"
acceleration = [0, 0, -1e-4]

[output]
precision = "double"
heights = [0.25]

[[case]]
name = "weight"
factors = { weight = 1 }

[[case]]
name = "wind"
factors = { wind = 1 }

[[case]]
name = "both"
factors = { weight = 1.35, wind = -1.5 }

[[envelope]]
name = "service"
cases = ["wind", "weight"]
"""
PRESSED = STRIP.replace("thickness = 0.05", "thickness = 0.05\ndensity = 1.0").replace("force = ", 'name = "wind"\nforce = ') + CASES
LIFTED = PRESSED.replace('chart = ["x", "y", 0.05]', 'chart = ["x", "y", "0.1 * x^2 + 0.05 * y^2"]')
FREE = LIFTED[: LIFTED.index("[[obstacle]]")] + LIFTED[LIFTED.index("[[probe]]") :]
FACTORS = {"weight": 1.35, "wind": -1.5}


@pytest.fixture(scope="module")
def free():
    """Three load cases without contact. The third one is a sum of the others."""
    return quiet(plastron.solve, plastron.Case.from_text(FREE))


@pytest.fixture(scope="module")
def loaded(free, tmp_path_factory):
    return quiet(plastron.load, free.save(tmp_path_factory.mktemp("saved")))


def close(found, wanted):
    np.testing.assert_allclose(found, wanted, rtol=0, atol=1e-8 * np.abs(wanted).max())


class TestCases:
    def test_a_load_case_has_its_numbers_and_their_units(self, free):
        assert list(free.cases) == ["weight", "wind", "both"]
        assert free.cases["wind"].energy == free.history[1].energy != free.energy
        assert free.cases["wind"].unit_of("energy") == "J" and free.cases["wind"].probes.tip.unit_of("u") == "m"

    def test_the_fields_of_the_last_load_case_are_those_of_the_result(self, free):
        last = free.cases["both"].fields
        assert last.units == free.fields.units and last.cell_type == free.fields.cell_type
        for name in free.fields:
            np.testing.assert_array_equal(last[name], free.fields[name])
        np.testing.assert_array_equal(last.points, free.fields.points)
        np.testing.assert_array_equal(last.cells, free.fields.cells)

    def test_loaded_results_have_them_too(self, free, loaded):
        for name, case in free.cases.items():
            np.testing.assert_array_equal(loaded.cases[name].fields["u"], case.fields["u"])
        close(plastron.combine(loaded, FACTORS).fields["u"], free.cases["both"].fields["u"])

    def test_other_results_have_none(self, result):
        assert result.cases == {}
        with pytest.raises(KeyError, match="no load case 'wind'; there are: none"):
            plastron.combine(result, {"wind": 1})
        with pytest.raises(KeyError, match="no envelope 'service'; there are: none"):
            result.envelope("service")

    def test_combinations_of_a_case_with_contact_are_load_cases(self):
        case = plastron.Case.from_text(PRESSED)
        combinations = {"wind": {"wind": 1.35, "weight": 0}, "both": {"wind": 1, "weight": 0.1}}
        pressed = quiet(plastron.solve, case.with_settings(
            {"case": [{"name": name, "factors": factors} for name, factors in combinations.items()], "envelope": []}))  # fmt: skip
        alone = quiet(plastron.solve, case.with_settings({"case": [{"factors": combinations["wind"]}], "envelope": []}))
        np.testing.assert_allclose(pressed.cases["wind"].energy, alone.energy, rtol=1e-6)
        assert list(pressed.to_dataframe()["step"]) == list(combinations)


class TestSums:
    def test_a_sum_is_the_load_case_with_the_summed_loads(self, free):
        found, wanted = plastron.combine(free, FACTORS), free.cases["both"]
        assert found.status == "solved" and found.factors.to_dict() == wanted.factors.to_dict()
        close(found.support_force, wanted.support_force)
        for name in ("u", "r", "N", "M", "Q", "stress_lower", "stress_middle", "stress_upper", "shear_stress", "position"):
            close(found.probes.tip[name], wanted.probes.tip[name])
        assert found.probes.tip["lambda"] is None and found.unit_of("support_force") == "N"

    def test_its_fields_are_those_of_this_load_case(self, free):
        found, wanted = plastron.combine(free, FACTORS).fields, free.cases["both"].fields
        for name, array in found.items():
            close(array, wanted[name])
            assert found.units[name] == wanted.units[name]
        close(found.points, wanted.points)
        for name in ("N_II", "M_I", "stress_I_at_0.25", "von_mises_lower", "von_mises_middle", "von_mises_at_0.25"):
            assert np.abs(found[name]).max() > 0

    def test_what_is_no_sum_is_left_out(self, free):
        found = plastron.combine(free, FACTORS)
        assert "energy" not in found and "von_mises" not in found.probes.tip
        with pytest.raises(AttributeError, match="there is no energy in history"):
            print(found.energy)
        with pytest.raises(KeyError, match="no field 'von_mises'"):
            print(found.fields["von_mises"])

    def test_unknown_names_and_no_names_are_refused(self, free):
        with pytest.raises(KeyError, match="no load case 'snow'; there are: weight, wind, both"):
            plastron.combine(free, {"snow": 1})
        with pytest.raises(ValueError, match="names no load case"):
            plastron.combine(free, {})

    @pytest.mark.parametrize(
        "text, reason",
        [
            (PRESSED, "contact"),
            (PRESSED.replace('name = "table"', 'name = "table"\nbed = 1e-3'), "contact"),
            (FREE.replace("nu = 0.3", 'nu = 0.3\nrotations = "finite"'), "finite rotations"),
        ],
        ids=["contact", "bed", "finite rotations"],
    )
    def test_load_cases_that_do_not_add_up_are_refused(self, text, reason):
        result = quiet(plastron.solve, plastron.Case.from_text(text))
        with pytest.raises(plastron.CaseError, match=rf"with {reason} load cases do not add up; give the combination a \[\[case\]\]"):
            plastron.combine(result, FACTORS)


class TestEnvelopes:
    def test_numbers_have_the_case_that_has_them(self, free):
        envelope = free.envelope("service")
        deflections = {name: free.cases[name].probes.tip.u[2] for name in ("wind", "weight")}
        found = envelope.numbers["probes/tip/u/2"]
        assert (found.least, found.largest) == (min(deflections.values()), max(deflections.values()))
        assert deflections[found.least_case] == found.least and envelope.cases == ["wind", "weight"]

    def test_fields_have_the_case_node_by_node(self, free):
        envelope = free.envelope("service")
        fields = [free.cases[name].fields for name in envelope.cases]
        np.testing.assert_array_equal(envelope.fields.points, fields[0]["reference position"])
        for name in ("displacement", "von_mises", "M_11", "stress_12_at_0.25"):
            both = np.array([each[name] for each in fields])
            for end, extreme in (("least", both.min(0)), ("largest", both.max(0))):
                np.testing.assert_array_equal(envelope.fields[f"{name}_{end}"], extreme)
                place = envelope.fields[f"{name}_{end}_case"]
                assert place.dtype.kind == "i" and set(np.unique(place)) <= {0, 1}
                np.testing.assert_array_equal(np.take_along_axis(both, place[None], 0)[0], extreme)
            assert envelope.fields.units[f"{name}_least"] == free.fields.units[name]

    def test_without_a_file_it_has_no_fields(self, free):
        """As for cases of different meshes (tests/io/output_test.cc)."""
        with pytest.raises(plastron.ResultsError, match="has no fields, because its cases have different meshes"):
            print(plastron.load_cases.envelope(free, {**free.envelope("service").to_dict(), "name": "other"}).fields)
