#!/usr/bin/env python3
"""Tests of the campaign itself: the array has every pair, files and distances are right, and the oracles find faults that are planted.

    test_campaign.py PROGRAM"""

import json
import pathlib
import random
import shutil
import sys
import tempfile
import unittest

from balances import Checks
from bodies import Body, axis_and_angle
from cases import Case
from checking import Checker, of_run
from covering import Array
from features import FEATURES, SIMPLEST, all_pairs, forbidding
from frame import Frame, norm, plus, rotation, transposed
from judging import compare
from mesh_files import MeshOf, quadrilateral_places, triangle_places
from running import Program

PROGRAM = None
PRESSED = SIMPLEST | {"surface": "dome", "obstacle": "ball", "steps": "one", "motion": "press", "load": "none"}


class TheArray(unittest.TestCase):
    def test_every_pair_that_a_case_can_have_is_in_it(self):
        array = Array(5, 1)
        covered, impossible = array.covered(array.rows), set(array.impossible)
        possible, _ = all_pairs()
        self.assertGreater(len(possible), 5000)
        self.assertEqual([p for p in possible if covered[p] == 0 and p not in impossible], [])
        self.assertLess(len(impossible), len(possible) / 50)
        self.assertFalse(any(forbidding(row) for row in array.rows))


class TheFiles(unittest.TestCase):
    def test_nodes_of_a_cell_occur_once(self):
        for p in (1, 2, 3, 4):
            self.assertEqual(len(set(quadrilateral_places(p))), (p + 1)**2)
            self.assertEqual(len(set(triangle_places(p))), (p + 1) * (p + 2) // 2)

    def test_a_closed_tube_has_no_edge_along_its_axis(self):
        shell = Case(1, 0, SIMPLEST | {"surface": "tube", "source": "order 2"}).shell
        mesh = MeshOf(shell, 2, False, lambda patch, x, y: patch.point(x, y), 1.0)
        self.assertEqual(len(mesh.nodes), (4 * 2 + 1) * (6 * 2))

    def test_a_rotation_is_that_of_its_axis_and_angle(self):
        for k in range(20):
            rng = random.Random(k)
            wanted = rotation([rng.uniform(-1, 1) for _ in range(3)], rng.uniform(0, 3.1))
            found = rotation(*axis_and_angle(transposed(wanted)))
            self.assertLess(max(norm(plus(a, b, -1)) for a, b in zip(wanted, found)), 1e-12)

    def test_bodies_touch_where_they_are_placed(self):
        for kind in FEATURES["obstacle"][1:]:
            case = Case(1, 0, SIMPLEST | {"obstacle": kind, "surface": "dome"})
            body = case.bodies[0][1]
            least = min(body.distance(X) for _, _, _, X in case.shell.samples()) - case.e / 2
            self.assertLess(abs(least), 0.6 * case.amount, kind)
            self.assertGreater(body.distance(plus(body.origin, body.out, -0.05)), 0.02, kind)

    def test_a_case_depends_on_its_seed_alone(self):
        texts = [Case(3, 7, PRESSED).all_files() for _ in range(2)]
        self.assertEqual(texts[0], texts[1])
        self.assertNotEqual(texts[0], Case(4, 7, PRESSED).all_files())


class TheOracles(unittest.TestCase):
    """They are content with a right result, and find faults that are planted into its files."""

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp())
        cls.program = Program(PROGRAM)
        cls.checker = Checker(cls.program, cls.folder, 1)
        cls.base = cls.program.run(Case(1, 3, PRESSED), cls.folder / "base")
        cls.turned = cls.program.run(Case(1, 3, PRESSED | {"turned": "general", "units": "mm"}), cls.folder / "turned")

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def test_right_results_pass(self):
        self.assertEqual(of_run(self.base) + of_run(self.turned), [])
        self.assertEqual(Checks(self.base).all(), [])
        self.assertEqual(compare(self.base, self.turned, "same")[0], [])
        self.assertGreater(norm(self.base.results["reaction"]["force"]), 0.0)

    def planted(self, change):
        """The outcome with changed results."""
        copy = type(self.base)(self.base.case, self.base.folder, self.base.code, self.base.text)
        change(copy.results)
        return copy

    def test_a_changed_number_is_found(self):
        def lower_energy(r):
            r["energy"] *= 0.999

        def weaker_support(r):
            r["support_reaction"]["force"] = [0.999 * v for v in r["support_reaction"]["force"]]

        def pull(r):
            for o in (r["reaction"], r["obstacles"][0]["reaction"], r["obstacles"][0]["zones"][0]["reaction"]):
                o["force"] = [-v for v in o["force"]]

        for change in (lower_energy, weaker_support, pull):
            self.assertNotEqual(Checks(self.planted(change)).all(), [], change.__name__)

    def test_a_turned_result_that_is_not_turned_back_is_found(self):
        def turn(r):
            r["probes"]["p"]["u"] = r["probes"]["p"]["u"][1:] + r["probes"]["p"]["u"][:1]

        self.assertNotEqual(compare(self.planted(turn), self.turned, "same")[0], [])

    def test_a_changed_file_is_found_by_verify(self):
        copy = self.folder / "copy"
        shutil.copytree(self.base.folder, copy)
        file = copy / "out" / "results.json"
        results = json.loads(file.read_text())
        results["energy"] *= 1.001
        file.write_text(json.dumps(results))
        base = type(self.base)(self.base.case, copy, 0, "")
        self.assertEqual([f.kind for f in self.checker._verify(base)], ["verify"])


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main(verbosity=1)
