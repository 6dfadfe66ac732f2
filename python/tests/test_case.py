"""Cases: reading, keys and values, refusals, copies."""

import copy
import pickle
import re
import tomllib
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import plastron
import pytest
from conftest import STRIP, quiet
from plastron import toml_edit, toml_text
from program import PROGRAM, SOURCE, plastron as command, words_of

WRONG_TEXTS = sorted((SOURCE / "tests/config/wrong").glob("*.toml"))
WRONG_MODELS = sorted((SOURCE / "tests/cli/wrong").glob("*.toml"))


def refusal(function, *arguments, **options):
    with pytest.raises(plastron.CaseError) as caught:
        function(*arguments, **options)
    return str(caught.value)


class TestReading:
    def test_a_file_a_text_a_dictionary_and_keywords_give_the_same_case(self, strip_file):
        from_file = plastron.Case.read(strip_file)
        sections = tomllib.loads(STRIP)
        for other in (plastron.Case.from_text(STRIP), plastron.Case.from_dict(sections), plastron.Case(**sections)):
            assert other.to_dict() == from_file.to_dict()

    def test_settings_replace_keys_as_after_set(self, strip_file):
        read = plastron.Case.read(str(strip_file), ["shell.thickness=0.01", "load[0].force=[0, 0, -1]"])
        assert (read["shell.thickness"], read["load[0].force"]) == (0.01, [0, 0, -1])
        assert read.settings == ("shell.thickness=0.01", "load[0].force=[0, 0, -1]")

    def test_the_text_of_the_case_contains_the_settings(self, case):
        case["shell.thickness"] = 0.01
        assert tomllib.loads(case.text)["shell"]["thickness"] == 0.01

    def test_all_effective_settings_make_the_same_case_again(self, case):
        assert plastron.Case.from_dict(case.to_dict()).to_dict() == case.to_dict()

    def test_the_dictionary_is_a_copy(self, case):
        case.to_dict()["shell"]["thickness"] = 1
        assert case["shell.thickness"] == 0.05

    def test_files_are_sought_beside_the_case_file_and_in_the_given_folder(self, tmp_path):
        (tmp_path / "raster.asc").write_text("ncols 2\nnrows 2\nxllcorner -9\nyllcorner -9\ncellsize 18\n0 0\n0 0\n")
        sections = tomllib.loads(STRIP)
        sections["obstacle"] = [{"height_field": {"file": "raster.asc"}}]
        case = plastron.Case.from_dict(sections, folder=tmp_path)
        assert [str(path) for path in case.files.values()] == [str(tmp_path / "raster.asc")]
        assert "raster.asc" in refusal(plastron.Case.from_dict, sections)

    def test_files_are_found_from_another_working_directory(self, tmp_path, monkeypatch):
        (tmp_path / "raster.asc").write_text("ncols 2\nnrows 2\nxllcorner -9\nyllcorner -9\ncellsize 18\n0 0\n0 0\n")
        (tmp_path / "case.toml").write_text(STRIP + '[[obstacle]]\nheight_field = { file = "raster.asc" }\n')
        monkeypatch.chdir(tmp_path)
        case = plastron.Case.read("case.toml")
        assert case.files == {"raster.asc": "raster.asc"} and case.file_name == "case.toml"
        sent = pickle.dumps(case)
        monkeypatch.chdir("/")
        case["shell.E"] = 2
        for same in (case, case.with_settings({"shell.nu": 0.2}), pickle.loads(pickle.dumps(case)), pickle.loads(sent)):
            assert same.files == {"raster.asc": str(tmp_path / "raster.asc")} and same.file_name == "case.toml"
            assert not [finding for finding in same.check() if finding.severity == "error"]

    def test_title_and_file_name_are_known(self, strip_file):
        read = plastron.Case.read(strip_file)
        assert (read.title, read.file_name) == ("A strip pressed on a table", str(strip_file))
        assert "A strip pressed on a table" in repr(read)


class TestKeys:
    @pytest.mark.parametrize(
        "key, value",
        [
            ("shell.E", 1),
            ("shell.stabilisation", 1),  # these three are defaults
            ("mesh.tying", True),
            ("shell.formulation", "tangent"),
            ("load[0].force", [0, 0, -2e-5]),
            ("load[0].force[2]", -2e-5),
            ("geometry.domain.rectangle.cells", [4, 2]),
            ("obstacle[0].name", "table"),
        ],
    )
    def test_a_key_gives_the_value_in_force(self, case, key, value):
        assert case[key] == value
        assert key in case

    @pytest.mark.parametrize("key", ["shell.thicknes", "load[1].force", "shell.E.x", "support[0].thickness", "no[-1]", ""])
    def test_a_key_that_the_case_does_not_have_is_a_key_error(self, case, key):
        with pytest.raises(KeyError, match=re.escape(key)):
            case[key]
        assert key not in case

    @pytest.mark.parametrize(
        "key, value, expected",
        [
            ("shell.thickness", 0.01, 0.01),
            ("shell.thickness", "0.01 + 0.01*x", "0.01 + 0.01*x"),
            ("shell.thickness", np.float64(0.02), 0.02),
            ("shell.thickness", np.float32(0.5), 0.5),
            ("shell.thickness", np.array(0.03), 0.03),
            ("mesh.refinements", np.int64(3), 3),
            ("mesh.tying", np.bool_(False), False),
            ("mesh.tying", False, False),
            ("load[0].force", (0, 1, 2.5), [0, 1, 2.5]),
            ("load[0].force", np.array([0, 0, -1]), [0, 0, -1]),
            ("load[0].force", [0, "x", np.float64(1)], [0, "x", 1]),
            ("obstacle[0].half_space", {"point": np.zeros(3), "normal": [0, 0, 2]}, {"point": [0, 0, 0], "normal": [0, 0, 2]}),
            ("geometry.domain.rectangle.to", [2, 1], [2, 1]),
            ("geometry.chart", ["x", "y", "x*y"], ["x", "y", "x*y"]),
            ("title", 'a "quoted" \\ title = 1 # none', 'a "quoted" \\ title = 1 # none'),
            ("title", "'single' and '''three'''", "'single' and '''three'''"),
            ("title", "käse ☃ 😀", "käse ☃ 😀"),
            ("probe[0].name", "a=b", "a=b"),
            ("constants.q", 3, 3),
        ],
    )
    def test_a_value_replaces_another(self, case, key, value, expected):
        case[key] = value
        assert case[key] == expected

    def test_a_key_with_quotes_can_be_set_and_read(self, case):
        case['accuracy."probe.tip.u.z"'] = 0.01
        assert case.to_dict()["accuracy"]["probe.tip.u.z"] == 0.01
        assert case['accuracy."probe.tip.u.z"'] == 0.01

    def test_components_of_values_are_read_as_they_are_set(self, case):
        case["support[0].values.u.z"] = 0.01
        assert case["support[0].values.u.z"] == case['support[0].values."u.z"'] == 0.01
        case["support[0].values"] = {"u.z": 0.02}
        assert case["support[0].values.u.z"] == 0.02
        assert "values gives u.z twice" in refusal(case.__setitem__, "support[0].values.u.z", 0.03)

    def test_the_last_value_of_a_key_counts(self, case):
        case["shell.thickness"] = 0.01
        case["shell.E"] = 2
        case["shell.thickness"] = 0.02
        assert case["shell.thickness"] == 0.02
        assert sorted(case.settings) == ["shell.E=2", "shell.thickness=0.02"]

    def test_a_refused_value_leaves_the_case_as_it_was(self, case):
        refusal(case.__setitem__, "shell.thickness", -1)
        assert case["shell.thickness"] == 0.05
        assert case.settings == ()

    @pytest.mark.parametrize("value", [None, object(), {1, 2}, 1j])
    def test_a_value_that_a_case_cannot_have_is_a_type_error(self, case, value):
        with pytest.raises(TypeError, match="a case has texts, numbers, lists and tables"):
            case["shell.thickness"] = value

    def test_with_settings_changes_a_copy(self, case):
        other = case.with_settings({"shell.thickness": 0.01, "shell.E": 2})
        assert (other["shell.thickness"], other["shell.E"], case["shell.thickness"]) == (0.01, 2, 0.05)


WITH_COMMENTS = STRIP.replace("[[load]]\n", "# the weight\n[[load]]\n# a pressure [N/m^2]\n").replace("-2e-5]", "-2e-5]  # downwards\n# end")
PRESSURE = {"pressure": 1e-5}


def parts_of(value, path=()):
    """All paths below a value: (path of the owner, last step)."""
    steps = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for step, entry in steps:
        yield path, step
        yield from parts_of(entry, (*path, step))


def without_empty(value):
    if isinstance(value, dict):
        return {key: entry for key, entry in ((k, without_empty(v)) for k, v in value.items()) if entry not in ({}, [])}
    return [without_empty(entry) for entry in value] if isinstance(value, list) else value


class TestChangedSections:
    @pytest.fixture
    def commented(self):
        return plastron.Case.from_text(WITH_COMMENTS)

    def test_a_list_of_sections_is_extended(self, case):
        before = case["load"]
        case["load"] += [PRESSURE]
        assert case["load"][:1] == before and case["load[1].pressure"] == 1e-5
        case["load"] += [PRESSURE, PRESSURE]
        assert len(case["load"]) == 4
        assert plastron.Case.from_text(case.text).to_dict() == case.to_dict()

    def test_entries_that_stay_keep_their_text(self, commented):
        commented["load"] += [PRESSURE]
        assert WITH_COMMENTS.replace("downwards\n", "downwards\n\n[[load]]\npressure = 1e-05\n") == commented.text

    def test_a_list_of_sections_is_replaced_and_the_comments_around_it_stay(self, commented):
        commented["load"] = [PRESSURE]
        assert [load["pressure"] for load in commented["load"]] == [1e-5]
        assert "# the weight\n[[load]]\npressure = 1e-05\n# end\n" in commented.text
        commented["load"] = [PRESSURE, {"force": np.array([0, 0, -1])}]
        commented["load"] = commented["load"][1:]
        assert [load["force"] for load in commented["load"]] == [[0, 0, -1]]

    def test_an_entry_is_replaced(self, case):
        case["load"] += [PRESSURE]
        case["load[0]"] = plastron.sections.Load(force=[0, 0, -1])
        assert (case["load[0].force"], case["load[1].pressure"]) == ([0, 0, -1], 1e-5)

    def test_an_entry_is_removed_and_the_others_move_up(self, commented):
        commented["load"] += [PRESSURE, {"pressure": 2}]
        commented["load[1].pressure"] = 3
        del commented["load[0]"]
        assert [load["pressure"] for load in commented["load"]] == [3, 2]
        assert "# the weight" in commented.text and "# end" in commented.text and "downwards" not in commented.text
        del commented["load"]
        assert commented["load"] == []

    @pytest.mark.parametrize("value", [[], ()])
    def test_an_empty_list_removes_all(self, case, value):
        case["probe"] = value
        assert case["probe"] == []

    def test_sections_that_are_not_in_the_text_are_added(self, case):
        case["step"] += [{"parts": 3, "loads": 1}]
        case["step"] += [{"name": "more", "loads": 2}]
        case["step[1].move"] = [{"obstacle": "table", "translate": [0, 0, 0.01]}]
        case["obstacle"] += [{"name": "wall", "half_space": {"point": [2, 0, 0], "normal": [-1, 0, 0]}}]
        case["step[1].move"] += [{"obstacle": "wall", "translate": [0.02, 0, 0]}]
        case["model.check"] = False
        case["output"] = {"precision": "double"}
        assert [step["name"] for step in case["step"][1:]] == ["more"]
        assert [move["obstacle"] for move in case["step[1].move"]] == ["table", "wall"]
        assert (case["model.check"], case["output.precision"]) == (False, "double")
        del case["step[1].move[0]"]
        assert [move["obstacle"] for move in case["step[1].move"]] == ["wall"]
        case["step[0].parts"] = 5
        case["step"] = [{"parts": 2}]
        assert case["step[0].parts"] == 2

    def test_a_section_is_replaced_and_removed(self, case):
        case["mesh"] = {"degree": 3}
        without = plastron.Case.from_text(STRIP.replace("refinements = 1", ""))
        assert (case["mesh.degree"], case["mesh.refinements"]) == (3, without["mesh.refinements"])
        del case["mesh"]
        case["accuracy"] = {"energy": 1e-2}
        assert case["accuracy.energy"] == 1e-2
        case["accuracy.reaction"] = 2e-3
        del case["accuracy"]
        assert "accuracy" not in case.text and case["accuracy"] == plastron.Case.from_text(case.text)["accuracy"]

    def test_a_key_is_removed_and_its_default_is_in_force(self, case):
        default = plastron.Case.from_text(STRIP.replace("refinements = 1", ""))["mesh.refinements"]
        case["mesh.refinements"] = 2
        del case["mesh.refinements"]
        assert case["mesh.refinements"] == default not in (1, 2)

    def test_settings_become_a_part_of_the_text(self, case):
        case["shell.E"] = 2
        case["load"] += [PRESSURE]
        assert (case["shell.E"], case.settings) == (2, ())
        assert "# --set" not in case.text

    def test_sections_are_replaced_together_with_other_values(self, case):
        case.update({"mesh.cells": "triangle", "mesh.degree": 2, "load": [PRESSURE], "probe": []})
        assert (case["mesh.cells"], case["load[0].pressure"], case["probe"]) == ("triangle", 1e-5, [])
        other = case.with_settings({"load": [{"pressure": 2}]})
        assert (other["load[0].pressure"], case["load[0].pressure"]) == (2, 1e-5)

    def test_functions_stay_and_are_added(self, case):
        case["load"] = [{"pressure": lambda x: 1e-5 * x}]
        case["load"] += [{"pressure": lambda x, y: 1e-5 * y}]
        del case["probe"]
        names = [load["pressure"] for load in case["load"]]
        assert all(name.startswith("python_") for name in names) and len(set(names)) == 2
        assert not [finding for finding in case.check() if finding.severity == "error"]

    def test_a_case_with_changed_sections_is_solved_and_verified(self, case, tmp_path):
        case["load"] += [{"pressure": -1e-6}]
        del case["mesh.refinements"]
        result = quiet(plastron.solve, case, output=tmp_path / "out")
        assert result.loads.force[2] < -1e-5 and plastron.verify(tmp_path / "out")
        assert plastron.load(tmp_path / "out").case.to_dict() == case.to_dict()

    @pytest.mark.parametrize("key", ["load[1]", "nothing", "shell.thicknes", "shell.formulation", "accuracy", "x["])
    def test_what_the_text_does_not_have_cannot_be_removed(self, case, key):
        with pytest.raises(KeyError, match=re.escape(key)):
            del case[key]
        assert case.text == STRIP

    @pytest.mark.parametrize(
        "key, value, words",
        [
            ("load", [{"pressure": 1, "forc": 1}],
             ['unknown key "forc" in [[load]]', "allowed: name, boundary", 'did you mean "force"?']),
            ("probe[0]", {"name": "a"}, ['[[probe]] has no "at"']),
            ("load", {"pressure": 1}, ["[load] is a repeated section"]),
            ("probe[1]", {"name": "a", "at": [0, 0]}, ["probe has 1 entry, counted from 0"]),
            ("nonsense", [{"a": 1}], ["unknown section [nonsense]"]),
        ],
    )
    def test_bad_sections_are_refused_and_the_case_stays(self, case, key, value, words):
        text = refusal(case.__setitem__, key, value)
        assert all(word in text for word in words), text
        assert (case.text, case.settings) == (STRIP, ())

    def test_what_the_case_needs_cannot_be_removed(self, case):
        assert '[geometry] has no "domain"' in refusal(case.__delitem__, "geometry.domain")
        assert case.text == STRIP

    def test_every_part_of_every_case_can_be_removed_from_its_text(self):
        """The text without a part has the same values as the dictionary without it."""
        files = sorted((SOURCE / "cases").glob("*/case.toml"))
        for file in files:
            text = file.read_text(encoding="utf-8")
            for owner, step in parts_of(tomllib.loads(text)):
                expected = tomllib.loads(text)
                place = expected
                for name in owner:
                    place = place[name]
                del place[step]
                shorter = toml_edit.removed(text, (*owner, step))
                assert without_empty(tomllib.loads(shorter)) == without_empty(expected), (file, owner, step)

    @pytest.mark.parametrize(
        "text, path, expected",
        [
            ("a.b = 1\na.c = 2\nd = 3\n", ("a",), "d = 3\n"),
            ("a = 1 # x\r\nb = 2", ("b",), "a = 1 # x\r\n"),
            ('"a.b" = """x\n# "" [c]\n"""""\nc = [ # d\n  1, # e\n  2, # f\n]\n', ("a.b",), "c = [ # d\n  1, # e\n  2, # f\n]\n"),
            ("c = [ # d\n  1, # e\n  2, # f\n]\n", ("c", 1), "c = [ # d\n  1, # e\n  # f\n]\n"),
            ("c = {a = '{', b = [[1, 2], [3]]}", ("c", "b", 0), "c = {a = '{', b = [[3]]}"),
            ("c = {a = '{', b = [[1, 2], [3]]}", ("c", "b"), "c = {a = '{'}"),
            ("[[s]]\n[[s.m]]\na = 1\n[[s]]\n[[s.m]]\na = 2\n[[s.m]]\na = 3\n", ("s", 1, "m", 0),
             "[[s]]\n[[s.m]]\na = 1\n[[s]]\n[[s.m]]\na = 3\n"),
            ("[[s]]\n[[s.m]]\na = 1\n[[s]]\n[[s.m]]\na = 2\n", ("s", 0), "[[s]]\n[[s.m]]\na = 2\n"),
            ("\ufeffa = 1\nb = 2\n", ("b",), "\ufeffa = 1\n"),
            ("# top\n\n[a]\nb = 1\n\n# c\n[c]\n", ("a",), "# top\n\n# c\n[c]\n"),
        ],
    )
    def test_a_part_is_removed_from_a_text(self, text, path, expected):
        assert toml_edit.removed(text, path) == expected

    def test_keys_with_dots_are_replaced(self):
        text = "geometry.domain.disk.radius = 1\ngeometry.chart = [1]\n"
        changed = toml_edit.changed(text, ("geometry", "domain"), {"disk": {}}, {}, {})
        assert changed == "geometry.domain = { disk = {} }\ngeometry.chart = [1]\n"


class TestCopies:
    @pytest.mark.parametrize("copied", [plastron.Case.copy, copy.copy, copy.deepcopy, lambda c: pickle.loads(pickle.dumps(c))],
                             ids=["copy", "copy.copy", "copy.deepcopy", "pickle"])
    def test_a_copy_is_equal_and_changes_by_itself(self, case, copied):
        case["shell.E"] = 2
        other = copied(case)
        assert (other.text, other.to_dict(), other.settings) == (case.text, case.to_dict(), case.settings)
        other["shell.thickness"] = 0.01
        assert case["shell.thickness"] == 0.05
        assert other["shell.E"] == 2


class TestRefusals:
    @pytest.mark.parametrize(
        "setting",
        ["shell.thicknes=0.1", "shell.thickness=-1", "shell.thickness=true", "shell.thickness=nan", "shell.thickness=inf",
         'shell.thickness="q"', "shell=1", "load[3].force=[0, 0, 1]", "load[0].force=[0, 0]", "mesh.degree=2.5",
         "nothing=1", "mesh.degree=12", 'support[0].fix=["w"]'],
    )
    def test_a_bad_setting_has_the_text_of_the_command_line(self, case, strip_file, setting):
        key, value = setting.split("=", 1)
        text = refusal(case.__setitem__, key, tomllib.loads("v=" + value)["v"])
        outcome = command("check", strip_file, "--set", setting, directory=strip_file.parent)
        assert outcome.returncode == 2
        assert words_of(text) == words_of(outcome.stderr)

    def test_mistakes_are_data(self):
        with pytest.raises(plastron.CaseError) as caught:
            plastron.Case.from_text(STRIP.replace("thickness", "thicknes"), "my.toml")
        one = next(mistake for mistake in caught.value.mistakes if "unknown key" in mistake["what"])
        assert (one["file"], one["line"], one["column"]) == ("my.toml", 6, 1)
        assert one["what"] == 'unknown key "thicknes" in [shell]'
        assert "thickness" in one["allowed"].split(", ")
        assert one["advice"] == 'did you mean "thickness"?'

    @pytest.mark.parametrize("content", [None, b"", b" \n\t\n", b'title = "caf\xe9"\n', b"a = 1\0\n", b"a = [1\n"],
                             ids=["missing", "empty", "blank", "not UTF-8", "a zero byte", "no TOML"])
    def test_an_unreadable_file_has_the_text_of_the_command_line(self, tmp_path, content):
        file = tmp_path / "file.toml"
        if content is not None:
            file.write_bytes(content)
        text = refusal(plastron.Case.read, file)
        outcome = command("check", file, directory=tmp_path)
        assert words_of(text).replace("\N{REPLACEMENT CHARACTER}", "?") == words_of(outcome.stderr)

    def test_a_folder_has_the_text_of_the_command_line(self, tmp_path):
        assert words_of(refusal(plastron.Case.read, tmp_path)) == words_of(command("check", tmp_path, directory=tmp_path).stderr)

    def test_a_case_error_is_a_value_error_of_this_package(self):
        assert issubclass(plastron.CaseError, ValueError) and issubclass(plastron.CaseError, plastron.PlastronError)

    def test_a_case_error_can_go_to_another_process(self):
        with pytest.raises(plastron.CaseError) as caught:
            plastron.Case.from_text("titel = 1\n")
        other = pickle.loads(pickle.dumps(caught.value))
        assert (str(other), other.mistakes) == (str(caught.value), caught.value.mistakes)


def some_are_slow(files, step):
    """All files; the default run takes every step-th of them, because the program starts for each."""
    return [pytest.param(file, id=file.stem, marks=[pytest.mark.slow] * (i % step != 0)) for i, file in enumerate(files)]


@pytest.fixture(scope="module")
def answers(request, tmp_path_factory):
    """What the command line prints about the wrong cases of this run: file -> outcome. Two at a time."""
    directory = tmp_path_factory.mktemp("answers")
    files = [item.callspec.params["wrong"] for item in request.session.items if "wrong" in getattr(item, "fixturenames", [])]
    with ThreadPoolExecutor(2) as pool:
        return dict(zip(files, pool.map(lambda file: command("check", file, directory=directory), files)))


class TestWrongCases:
    def test_there_are_wrong_cases(self):
        assert len(WRONG_TEXTS) > 200 and len(WRONG_MODELS) > 40 and PROGRAM.exists()

    @pytest.mark.parametrize("wrong", some_are_slow(WRONG_TEXTS, 12))
    def test_a_wrong_text_is_refused_in_the_words_of_the_command_line(self, wrong, answers):
        text = refusal(plastron.Case.read, wrong)
        assert answers[wrong].returncode == 2
        assert words_of(text) == words_of(answers[wrong].stderr)

    @pytest.mark.parametrize("wrong", some_are_slow(WRONG_MODELS, 8))
    def test_a_wrong_model_is_refused_in_the_words_of_the_command_line(self, wrong, answers):
        text = refusal(plastron.solve, plastron.Case.read(wrong))
        assert answers[wrong].returncode == 2
        assert words_of(text) == words_of(answers[wrong].stderr)


class TestExamination:
    def printed(self, findings, file):
        """Findings in the form of the command line: notes on its output, the others among its errors."""
        notes = [f"  {f.text}" for f in findings if f.severity == "note"]
        others = [f"{file}: {f.severity}: {f.text}" for f in findings if f.severity != "note"]
        return words_of("\n".join(notes)), words_of("\n".join(others))

    @pytest.mark.parametrize("name", ["strip", "bowl-on-table", "tube-between-plates", "thermostat", "free-panel"])
    def test_the_findings_are_those_that_the_command_line_prints(self, strip_file, name):
        file = strip_file if name == "strip" else SOURCE / "cases" / name / "case.toml"
        findings = plastron.Case.read(file).check()
        outcome = command("check", file, directory=strip_file.parent)
        notes, others = self.printed(findings, file)
        output = words_of(outcome.stdout.split("\n", 1)[1])
        assert notes and output == notes + " ready to run"
        assert words_of(outcome.stderr) == others

    def test_errors_are_findings_and_not_raised(self, case):
        case["support[0].fix"] = ["u.x"]
        errors = [finding for finding in case.check() if finding.severity == "error"]
        assert errors and "rigid motion" in errors[0].text
        assert repr(errors[0]) == f"error: {errors[0].text}"
        assert errors[0] == plastron.Finding("error", errors[0].text) != plastron.Finding("note", errors[0].text)


class TestSections:
    def test_every_section_of_the_declarations_is_a_class(self):
        from plastron import _case

        paths = {path for path, _, _ in _case.declarations() if path}
        assert paths == {getattr(plastron.sections, name).path for name in plastron.sections.__all__}
        assert len(paths) > 30

    def test_the_documentation_of_every_key_has_its_unit_and_range(self):
        from plastron import _case

        for path, meaning, keys in _case.declarations():
            if not path:
                continue
            section = next(s for s in map(plastron.sections.__dict__.get, plastron.sections.__all__) if s.path == path)
            assert f"[{path}]" in section.__doc__ and meaning in section.__doc__
            for name, _, unit, default, allowed, text, required in keys:
                place = section.__doc__.index(f"\n{name}: {text}")
                line = section.__doc__[place:].split(f"{name}: {text}\n", 1)[1].splitlines()[0]
                for fact in (f"unit {unit}" if unit else "", allowed, "required" if required else default):
                    assert fact in line, f"{path}.{name}"

    def test_units_are_those_of_the_case_file(self):
        assert re.search(r"^E: .*\n    .*unit Pa; E > 0", plastron.sections.Shell.__doc__, re.M)
        assert re.search(r"^radius: .*\n    .*unit m; .*required", plastron.sections.ObstacleBall.__doc__, re.M)

    def test_sections_make_a_case(self, case):
        s = plastron.sections
        other = plastron.Case(
            title="A strip pressed on a table",
            shell=s.Shell(E=1, nu=0.3, thickness=0.05),
            geometry=s.Geometry(domain={"rectangle": {"from": [0, 0], "to": [1, 0.5], "cells": [4, 2]}}, chart=["x", "y", 0.05]),
            mesh=s.Mesh(degree=2, refinements=1),
            support=[s.Support(boundary="left", fix=["u", "r"])],
            load=[s.Load(force=[0, 0, -2e-5])],
            obstacle=[s.Obstacle(name="table", half_space=s.ObstacleHalfSpace(point=[0, 0, 0], normal=[0, 0, 1]))],
            probe=[s.Probe(name="tip", at=[1, 0.25])],
        )
        assert other.to_dict() == case.to_dict()

    def test_a_section_refuses_unknown_keys(self):
        with pytest.raises(TypeError, match="Shell has no key 'thicknes'; its keys are E, nu"):
            plastron.sections.Shell(thicknes=1)

    def test_a_section_accepts_free_names_where_the_case_file_does(self):
        assert plastron.sections.Constants(R=1, e="R/2") == {"R": 1, "e": "R/2"}


STRANGE = ["", "a'b", '"', "\\", "\\\\n", "\n", "\r\n", "\t", "\b\f", "\x00", "\x01", "\x1f", "\x7f", "\x80", "\x85", "\xa0", "\u2028",
           "\ufeff", "é", "☃", "😀", "\U000e0001", "#", "= 1", "'''", '"""', "]", "}", "${x}", " lead and trail "]


class TestToml:
    @pytest.mark.parametrize("text", STRANGE, ids=ascii)
    def test_a_text_comes_back(self, text):
        assert tomllib.loads("a = " + toml_text.value(text)) == {"a": text}

    @pytest.mark.parametrize("text", STRANGE, ids=ascii)
    def test_a_key_comes_back(self, text):
        assert tomllib.loads(toml_text.key(text) + " = 1") == {text: 1}

    @pytest.mark.parametrize("text", STRANGE, ids=ascii)
    def test_a_text_comes_back_from_a_case(self, text):
        from_dictionary = plastron.Case.from_dict(tomllib.loads(STRIP) | {"title": text})
        assert from_dictionary.title == text
        assert plastron.Case.from_text(STRIP).with_settings({"title": text}).title == text

    @pytest.mark.parametrize("number", [0, -1, 2**53 + 1, 0.1, 1e300, 5e-324, 1e22, 123456789.123456789, -0.0, True, False])
    def test_a_number_comes_back_to_the_last_digit(self, number):
        back = tomllib.loads("a = " + toml_text.value(number))["a"]
        assert (back, type(back)) == (number, type(number))

    @pytest.mark.parametrize("number", [float("inf"), float("-inf")])
    def test_infinity_comes_back(self, number):
        assert tomllib.loads("a = " + toml_text.value(number)) == {"a": number}

    @pytest.mark.parametrize(
        "document",
        [
            {"title": "x", "t": {"a": 1, "b": {"c": [1, 2.5, "z"]}}},
            {"list": [{"a": 1}, {"b": {"c": []}}], "last": 2},
            {"empty": [], "nothing": {}, "a b": {"c.d": 1, "": 2}},
            {"mixed": [1, {"a": 1}], "deep": [[[1], []], [{"x": [{"y": 1}]}]]},
            {"regions": [{}, {"name": "a"}]},
        ],
    )
    def test_a_document_comes_back(self, document):
        assert tomllib.loads(toml_text.document(document)) == document

    def test_arrays_are_lists(self):
        document = {"a": np.arange(3), "b": np.eye(2), "c": np.float32(0.5), "d": [np.int8(1)]}
        assert tomllib.loads(toml_text.document(document)) == {"a": [0, 1, 2], "b": [[1, 0], [0, 1]], "c": 0.5, "d": [1]}

    def test_every_case_of_the_gallery_comes_back(self):
        files = sorted((SOURCE / "cases").glob("*/case.toml"))
        assert len(files) > 20
        for file in files:
            sections = tomllib.loads(file.read_text(encoding="utf-8"))
            assert tomllib.loads(toml_text.document(sections)) == sections
            read = plastron.Case.read(file)
            assert plastron.Case.from_dict(sections, file.parent).to_dict() == read.to_dict()
            assert plastron.Case.from_dict(read.to_dict(), file.parent).to_dict() == read.to_dict()


def test_values_that_fit_only_together_are_replaced_at_once(strip_file):
    case = plastron.Case.read(strip_file)
    case["mesh.degree"] = 4
    with pytest.raises(plastron.CaseError):
        case["mesh.cells"] = "triangle"
    changed = case.with_settings({"mesh.cells": "triangle", "mesh.degree": 2})
    assert (changed["mesh.cells"], changed["mesh.degree"]) == ("triangle", 2)
    case.update({"mesh.cells": "triangle", "mesh.degree": 2})
    assert case["mesh.degree"] == 2
