"""Functions of Python in cases, compared with expressions that say the same."""

import gc
import inspect
import json
import signal

import conftest
import numpy as np
import plastron
import pytest
from conftest import quiet

# Functions are called at many places, so that the mesh is small.
STRIP = conftest.STRIP.replace("refinements = 1", "refinements = 0")
THICKNESS = "0.04 + 0.01*x*x + 0.005*sin(y)"
DOME = STRIP.replace('chart = ["x", "y", 0.05]', 'chart = ["x", "y", "0.05 + 0.1*sin(2*x)*cos(y) + 0.1*x^3"]')


def thickness(x, y):
    return 0.04 + 0.01 * x * x + 0.005 * np.sin(y)


def dome(x, y):
    return 0.05 + 0.1 * np.sin(2 * x) * np.cos(y) + 0.1 * x**3


def dome_gradient(x, y):
    return [0.2 * np.cos(2 * x) * np.cos(y) + 0.3 * x**2, -0.1 * np.sin(2 * x) * np.sin(y)]


def dome_second(x, y):
    xx = -0.4 * np.sin(2 * x) * np.cos(y) + 0.6 * x
    return [xx, -0.2 * np.cos(2 * x) * np.sin(y), -0.1 * np.sin(2 * x) * np.cos(y)]


def dome_that_is_not_analytic(x, y):
    return 0.05 + 0.1 * np.sin(2 * x) * np.cos(y) + 0.1 * abs(x) ** 3


def dome_in_the_other_order(y, x):
    return dome(x, y)


SWAPPED = plastron.Function(
    dome_in_the_other_order, lambda y, x: dome_gradient(x, y)[::-1], lambda y, x: dome_second(x, y)
)


@pytest.fixture
def case():
    return plastron.Case.from_text(STRIP)


def energy(case):
    return quiet(plastron.solve, case).energy


class TestValues:
    def test_a_thickness_gives_the_energy_of_its_expression(self, case):
        expected = energy(case.with_settings({"shell.thickness": THICKNESS}))
        assert energy(case.with_settings({"shell.thickness": thickness})) == pytest.approx(expected, rel=1e-12, abs=0)
        assert energy(case.with_settings({"shell.thickness": plastron.Function(thickness)})) == pytest.approx(expected, rel=1e-12, abs=0)

    def test_a_load_gives_the_energy_of_its_expression(self, case):
        expected = energy(case.with_settings({"load[0].force": [0, 0, "-2e-5*(1 + x*y)"]}))
        given = case.with_settings({"load[0].force": [0, 0, lambda x, y: -2e-5 * (1 + x * y)]})
        assert energy(given) == pytest.approx(expected, rel=1e-12, abs=0)

    def test_a_number_holds_everywhere(self, case):
        assert energy(case.with_settings({"shell.thickness": lambda x: 0.05})) == pytest.approx(energy(case), rel=1e-12, abs=0)

    @pytest.mark.slow
    def test_functions_stand_in_dictionaries(self, case):
        sections = case.to_dict() | {"shell": {"E": 1, "nu": 0.3, "thickness": thickness}}
        assert energy(plastron.Case.from_dict(sections)) == energy(case.with_settings({"shell.thickness": thickness}))


class TestDerivatives:
    @pytest.mark.parametrize(
        "function, digits",
        [
            (plastron.Function(dome, dome_gradient, dome_second), 1e-11),
            pytest.param(plastron.Function(dome, dome_gradient), 1e-8, marks=pytest.mark.slow),
            pytest.param(plastron.Function(dome), 1e-8, marks=pytest.mark.slow),
            (plastron.Function(dome_that_is_not_analytic), 1e-6),
            pytest.param(plastron.Function(dome_in_the_other_order), 1e-8, marks=pytest.mark.slow),
            pytest.param(SWAPPED, 1e-11, marks=pytest.mark.slow),
        ],
        ids=["both given", "gradient given", "complex step", "differences", "arguments swapped", "swapped and given"],
    )
    def test_a_chart_gives_the_energy_of_its_expression(self, function, digits):
        flat = plastron.Case.from_text(STRIP)
        expected = energy(plastron.Case.from_text(DOME))
        assert energy(flat.with_settings({"geometry.chart": ["x", "y", function]})) == pytest.approx(expected, rel=digits, abs=0)

    @pytest.mark.slow
    def test_components_make_a_chart_of_one_function(self):
        chart = plastron.components(lambda x, y: (x, y, dome(x, y)))
        case = plastron.Case.from_text(STRIP).with_settings({"geometry.chart": chart})
        assert energy(case) == pytest.approx(energy(plastron.Case.from_text(DOME)), rel=1e-8, abs=0)

    @pytest.mark.parametrize("wrong", ["zero", "a factor", "a sign", "the other order", "in one corner", "second", "second order"])
    def test_wrong_derivatives_are_refused(self, wrong):
        def gradient(x, y):
            at_x, at_y = dome_gradient(x, y)
            changed = {"zero": [0 * x, 0 * y], "a factor": [1.1 * at_x, at_y], "a sign": [at_x, -at_y], "the other order": [at_y, at_x]}
            return changed.get(wrong, [at_x + (wrong == "in one corner") * (x > 0.7) * (y < 0.2), at_y])

        def second(x, y):
            xx, xy, yy = dome_second(x, y)
            return {"second": [xx, xy + 0.02, yy], "second order": [yy, xy, xx]}.get(wrong, [xx, xy, yy])

        function = plastron.Function(dome, gradient, second)
        with pytest.raises(plastron.CaseError, match='function "dome" has a wrong derivative: `' + ("second" if "second" in wrong else "gradient")):
            quiet(plastron.solve, plastron.Case.from_text(STRIP).with_settings({"geometry.chart": ["x", "y", function]}))

    @pytest.mark.parametrize("length", [1e-6, 1, 1e6])
    def test_right_derivatives_are_not_refused(self, length):
        """Also where the function has a kink, is noisy, is nearly constant, or is not defined beside its places."""
        rng = np.random.default_rng(1)
        places = np.zeros((50, 5))
        places[:, :2] = rng.uniform(0.0, 1, (50, 2)) * length
        places[0, 0] = 0
        functions = {
            "kink": (lambda x, y: abs(x - 0.5 * length), lambda x, y: [np.sign(x - 0.5 * length), 0 * y]),
            "noise": (lambda x, y: np.float32(x * y), lambda x, y: [y, x]),
            "constant": (lambda x, y: 3 + 1e-6 * x / length, lambda x, y: [1e-6 / length + 0 * x, 0 * x]),
            "root": (lambda x, y: np.sqrt(x / length), lambda x, y: [0.5 / np.sqrt(np.maximum(x * length, 1e-300)), 0 * x]),
        }
        for f, gradient in functions.values():
            plastron.Function(f, gradient).evaluate(places, 0, 3)

    @pytest.mark.slow
    @pytest.mark.parametrize(
        "obstacle, key, function",
        [
            ('height_field = { expression = "0.01*sin(3*X)*Y" }', "height_field.expression", lambda X, Y: 0.01 * np.sin(3 * X) * Y),
            ('distance = "Z - 0.01*X"', "distance", lambda X, Z: Z - 0.01 * X),
        ],
        ids=["height", "distance"],
    )
    def test_an_obstacle_gives_the_energy_of_its_expression(self, obstacle, key, function):
        text = STRIP.replace("half_space = { point = [0, 0, 0], normal = [0, 0, 1] }", obstacle)
        case = plastron.Case.from_text(text)
        assert energy(case.with_settings({f"obstacle[0].{key}": function})) == pytest.approx(energy(case), rel=1e-7, abs=0)


    def test_a_distance_is_called_for_many_points_together(self):
        sizes = []

        def distance(X, Z):
            sizes.append(len(X))
            return Z - 0.01 * np.sin(3 * X)

        text = STRIP.replace("half_space = { point = [0, 0, 0], normal = [0, 0, 1] }", 'distance = "Z - 0.01*sin(3*X)"')
        case = plastron.Case.from_text(text)
        assert energy(case.with_settings({"obstacle[0].distance": distance})) == pytest.approx(energy(case), rel=1e-7, abs=0)
        assert np.mean(sizes) > 300 and len(sizes) < 3000


class TestMistakes:
    def test_other_arguments_are_refused(self, case):
        for wrong, words in ((lambda u, v: u, "not u, v"), (lambda: 1, "not nothing")):
            with pytest.raises(plastron.CaseError, match=f"takes some of x, y, X, Y, Z, {words}"):
                case["shell.thickness"] = wrong

    def test_an_exception_of_a_function_is_a_case_error_with_its_words(self, case):
        def broken(x, y):
            raise ZeroDivisionError("mine")

        with pytest.raises(plastron.CaseError, match=r'the function "broken" failed: ZeroDivisionError: mine \(.*test_functions.py, line \d+\)\n$'):
            quiet(plastron.solve, case.with_settings({"shell.thickness": broken}))
        assert energy(case) > 0

    @pytest.mark.parametrize("wrong", [lambda x: x[:1] + 1, lambda x: np.ones((2, 2)), lambda x: "text", lambda x: None])
    def test_other_shapes_are_refused(self, case, wrong):
        with pytest.raises(plastron.CaseError, match="failed|returns|thickness"):
            quiet(plastron.solve, case.with_settings({"shell.thickness": wrong}))

    @pytest.mark.parametrize(
        "wrong", [lambda X: X[..., 0] * 0.1 + 0.03, lambda x: 0.04 + 0.01 * np.max(x), lambda x, y: 0.04 + 0.01 * np.linalg.norm([x, y])]
    )
    def test_one_number_that_depends_on_the_places_is_refused(self, case, wrong):
        with pytest.raises(plastron.CaseError, match="returns one number for .* places, and another number"):
            quiet(plastron.solve, case.with_settings({"shell.thickness": wrong}))

    def test_one_number_of_a_distance_is_refused(self, case):
        case["obstacle"] = [{"distance": lambda X, Z: 0.01 * X[0] + Z[0]}]
        with pytest.raises(plastron.CaseError, match="test_functions.py returns one number for"):
            quiet(plastron.solve, case)

    def test_a_distance_without_a_gradient_is_named_as_a_function(self, case):
        case["obstacle"] = [{"name": "die", "distance": lambda X: 2.6 + 0 * X}]
        with pytest.raises(plastron.CaseError, match='the function "lambda" is 2.6 and has a zero gradient') as error:
            quiet(plastron.solve, case)
        assert "expression the function" not in str(error.value)

    def test_none_is_refused(self, case):
        with pytest.raises(plastron.CaseError, match="returns None"):
            quiet(plastron.solve, case.with_settings({"shell.thickness": lambda x: None}))

    def test_a_case_with_a_function_shows_its_name(self, case):
        shown = repr(case.with_settings({"shell.thickness": thickness}))
        assert 'the function "thickness"' in shown and "python_" not in shown

    def test_values_without_a_meaning_are_refused(self, case):
        with pytest.raises(plastron.CaseError, match="thickness"):
            quiet(plastron.solve, case.with_settings({"shell.thickness": lambda x: 0 * x - 1}))


HALF_SPACE = "half_space = { point = [0, 0, 0], normal = [0, 0, 1] }"
AT_DISTANCE = STRIP.replace(HALF_SPACE, 'distance = "Z"')
AT_HEIGHT = STRIP.replace(HALF_SPACE, 'height_field = { expression = "0" }')
LOADED = STRIP.replace("force = [0, 0, -2e-5]", "force = [0, 0, -2e-5]\npressure = 0\ncouple = [0, 0, 0]")


def parabola(x, y):
    return 0.05 + 0.1 * x**2 * y


def parabola_gradient(x, y):
    return [0.2 * x * y, 0.1 * x**2]


def parabola_second(x, y):
    return [0.2 * y, 0.2 * x, 0 * x]


def slope(X, Z):
    return Z - 0.01 * X


def slope_gradient(X, Z):
    return [-0.01 + 0 * X, 1 + 0 * Z]


# Every key of a case that takes a function, and every function that a Function takes: (text, key, function to interrupt, value of the key).
INTERRUPTED = {
    "thickness": (STRIP, "shell.thickness", thickness, lambda f: f),
    "thickness of space": (STRIP, "shell.thickness", lambda X: 0.05 + 0.01 * X, lambda f: f),
    "chart": (STRIP, "geometry.chart", parabola, lambda f: ["x", "y", f]),
    "gradient": (STRIP, "geometry.chart", parabola_gradient, lambda f: ["x", "y", plastron.Function(parabola, f)]),
    "second": (STRIP, "geometry.chart", parabola_second, lambda f: ["x", "y", plastron.Function(parabola, parabola_gradient, f)]),
    "components": (STRIP, "geometry.chart", lambda x, y: (x, y, parabola(x, y)), lambda f: plastron.components(f)),
    "force": (LOADED, "load[0].force", lambda x, y: -2e-5 * (1 + x * y), lambda f: [0, 0, f]),
    "pressure": (LOADED, "load[0].pressure", lambda X, Y: 1e-6 * X * Y, lambda f: f),
    "couple": (LOADED, "load[0].couple", lambda x: 1e-7 * x, lambda f: [0, f, 0]),
    "support": (STRIP, "support[0].values", lambda y: -0.001 * y, lambda f: {"u.z": f}),
    "distance": (AT_DISTANCE, "obstacle[0].distance", slope, lambda f: f),
    "gradient of a distance": (AT_DISTANCE, "obstacle[0].distance", slope_gradient, lambda f: plastron.Function(slope, f)),
    "height": (AT_HEIGHT, "obstacle[0].height_field.expression", lambda X, Y: 0.01 * np.sin(3 * X) * Y, lambda f: f),
}


class Interrupted:
    """A function in which Ctrl-C is pressed at one of its calls, or from `self.is_pressed` on."""

    def __init__(self, f, call=None):
        self.f, self.call, self.calls, self.is_pressed = f, call, 0, False
        self.__name__, self.__signature__ = "interrupted", inspect.signature(f)

    def __call__(self, *arguments):
        self.calls += 1
        if self.calls == self.call or self.is_pressed:
            signal.raise_signal(signal.SIGINT)
        return self.f(*arguments)


CHEAP = ("pressure", "couple", "support", "distance", "gradient of a distance")


class TestInterruption:
    @pytest.mark.parametrize("name", [name if name in CHEAP else pytest.param(name, marks=pytest.mark.slow) for name in INTERRUPTED])
    def test_ctrl_c_in_a_function_is_a_keyboard_interrupt_at_any_call(self, name):
        text, key, f, value = INTERRUPTED[name]
        case = plastron.Case.from_text(text)
        before = quiet(case.check)
        counter = Interrupted(f)
        quiet(case.with_settings({key: value(counter)}).check)
        rng = np.random.default_rng(len(name))
        calls = [1, rng.integers(1, min(20, counter.calls), endpoint=True), rng.integers(1, counter.calls, endpoint=True)]
        for work, call in [*((plastron.Case.check, call) for call in calls), *((plastron.solve, call) for call in calls[:2])]:
            function = Interrupted(f, call)
            try:
                quiet(work, case.with_settings({key: value(function)}))
            except KeyboardInterrupt:
                assert function.calls >= call
            else:
                pytest.fail(f"Ctrl-C in call {call} of {work.__name__} was lost")
        assert quiet(case.check) == before

    @pytest.mark.parametrize("name", ["thickness", "distance"])
    def test_ctrl_c_while_files_are_written_leaves_the_result_as_it_was(self, name, tmp_path):
        text, key, f, value = INTERRUPTED[name]
        function = Interrupted(f)
        solved = quiet(plastron.solve, plastron.Case.from_text(text).with_settings({key: value(function)}))
        function.is_pressed = True
        with pytest.raises(KeyboardInterrupt):
            solved.save(tmp_path / "interrupted")
        function.is_pressed = False
        saved = solved.save(tmp_path / "saved")
        results = json.loads((saved / "results.json").read_text())
        assert sorted(results["files"]) == sorted({path.name for path in saved.iterdir()} - {"results.json"})
        assert solved.verify()

    @pytest.mark.parametrize("call", [1, 2, 3])
    def test_ctrl_c_while_derivatives_are_tried_leaves_the_function_as_it_was(self, call):
        """The function has a wrong complex derivative. The comparison with differences, which finds this, is interrupted."""
        places = np.random.default_rng(call).uniform(-1, 1, (30, 5))
        expected = plastron.Function(dome_that_is_not_analytic).evaluate(places, 0, 6)
        function = plastron.Function(Interrupted(dome_that_is_not_analytic, call))
        with pytest.raises(KeyboardInterrupt):
            function.evaluate(places, 0, 6)
        assert np.array_equal(function.evaluate(places, 0, 6), expected)

    def test_ctrl_c_while_given_derivatives_are_compared_leaves_them_to_be_compared(self):
        places = np.random.default_rng(1).uniform(0, 1, (30, 5))
        function = plastron.Function(Interrupted(dome, 1), lambda x, y: [0 * x, 0 * y])
        with pytest.raises(KeyboardInterrupt):
            function.evaluate(places, 0, 3)
        with pytest.raises(plastron.errors.FunctionError, match="has a wrong derivative"):
            function.evaluate(places, 0, 3)


class TestFiles:
    def test_the_result_is_verified_in_this_process(self, case, tmp_path):
        solved = quiet(plastron.solve, case.with_settings({"shell.thickness": thickness}), output=tmp_path / "out")
        assert solved.verify()
        assert plastron.load(tmp_path / "out").energy == solved.energy

    @pytest.mark.slow
    def test_functions_of_a_module_go_to_other_processes(self, case):
        alone = plastron.sweep(case.with_settings({"shell.thickness": thickness}), {"shell.E": [1, 2]}, workers=1)
        together = plastron.sweep(case.with_settings({"shell.thickness": thickness}), {"shell.E": [1, 2]}, workers=2)
        assert alone.to_csv() == together.to_csv() and alone["status"] == ["solved"] * 2

    def test_functions_with_other_numbers_are_different(self, case):
        def linear(slope):
            return lambda x: 0.04 + slope * x

        table = plastron.sweep(case, {"shell.thickness": [linear(0.005), linear(0.01)]}, workers=1)
        expected = [energy(case.with_settings({"shell.thickness": f"0.04 + {slope}*x"})) for slope in (0.005, 0.01)]
        assert table["energy"] == pytest.approx(expected, rel=1e-12, abs=0)


@pytest.mark.parametrize("length", [1e-6, 1e6])
def test_derivatives_fit_to_any_unit_of_length(length):
    places = np.zeros((16, 5))
    places[:, 0], places[:, 1] = np.linspace(-0.5, 0.5, 16) * length, 0.1 * length
    x, y = places[:, 0] / length, places[:, 1] / length
    bowl = plastron.Function(lambda x, y: length * (1 - np.sqrt(1 - (x / length) ** 2 - (y / length) ** 2)))
    root = np.sqrt(1 - x**2 - y**2)
    found = bowl.evaluate(places, 0, 6)
    assert found[1] == pytest.approx(x / root, rel=1e-12, abs=1e-14)
    assert found[3] * length == pytest.approx((1 - y**2) / root**3, rel=1e-9)
    assert found[4] * length == pytest.approx(x * y / root**3, rel=1e-9, abs=1e-11)


def test_differences_at_the_origin_alone_need_a_scale():
    origin = np.zeros((1, 5))
    with pytest.raises(ValueError, match="need a scale"):
        plastron.Function(lambda x: abs(x) ** 3).evaluate(origin, 0, 3)
    assert plastron.Function(lambda x: x**2, scale=2.0).evaluate(origin, 3, 1)[0] == pytest.approx(2, rel=1e-9)


def test_a_function_is_forgotten_with_its_last_owner(strip_file):
    function = plastron.Function(lambda x: 0.04 + 0 * x)
    case = plastron.Case.read(strip_file)
    case["shell.thickness"] = function
    text = case.text
    plastron.Case.from_text(text)  # its name is known
    del case, function
    gc.collect()
    with pytest.raises(plastron.CaseError, match="unknown name"):
        plastron.Case.from_text(text)
