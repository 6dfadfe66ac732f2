#!/usr/bin/env python3
"""A campaign over pairs of features: random valid cases from a covering array, judged by oracles that need no reference.

    campaign.py PROGRAM [--times 3] [--count N] [--first K] [--seed 1] [--keep DIR] [--reduce] [--python INTERPRETER --package FOLDER]
    campaign.py PROGRAM --refusals            # tries pairs that the program must refuse with words
    campaign.py PROGRAM --only K --keep DIR   # repeats one case; its files stay in DIR

Every pair of values of the features (features.py) that a case can have is in at least `--times` cases. A case depends on seed and number
alone. Exit code 1 if something failed without a word: numbers that differ, balances, crashes, hangs, results that verify rejects."""

import argparse
import collections
import json
import pathlib
import random
import sys
import tempfile

from cases import Case
from checking import SILENT, Checker
from covering import Array
from features import CONSTRAINTS, FEATURES, SIMPLEST
from oracles import BY_NAME, ORACLES
from reducing import reduced, simplest_with
from running import Program


class Schedule:
    """Chooses oracles for a case, those first that have met its values least."""

    def __init__(self, each):
        self.met, self.each = collections.Counter(), each

    def choose(self, case):
        possible = [o for o in ORACLES if o.variants(case)]
        need = lambda o: sum(1.0 / (1 + self.met[o.name, n, v]) for n, v in case.row.items())
        chosen = sorted(possible, key=need, reverse=True)[:self.each]
        for o in chosen:
            self.met.update((o.name, n, v) for n, v in case.row.items())
        return [o.name for o in chosen]


def plan(arguments):
    """Number, row and oracles of each case; all pairs; those that no row can have."""
    array = Array(arguments.seed, arguments.times)
    schedule = Schedule(arguments.oracles)
    cases = [(k, row, schedule.choose(Case(arguments.seed, k, row, curves=collections.defaultdict(list)))) for k, row in enumerate(array.rows)]
    return array, cases


def campaign(arguments, program, folder):
    array, cases = plan(arguments)
    first, last = (arguments.only, arguments.only + 1) if arguments.only is not None else (arguments.first, arguments.first + arguments.count)
    counts, kinds, used, rows, failures = collections.Counter(), collections.Counter(), collections.Counter(), [], []
    for number, row, oracles in cases[first:last]:
        checker = Checker(program, folder / f"{number}", arguments.seed)
        findings, compared, base = checker.check(number, row, arguments.oracle or oracles)
        rows.append(row)
        used.update(compared)
        counts["agrees" if not findings else "fails" if any(f.kind in SILENT for f in findings) else "told"] += 1
        for finding in findings:
            kinds[finding.kind, finding.oracle] += 1
            print(f"{number} {finding.kind} {finding.oracle}: {finding.words}", flush=True)
        silent = [f for f in findings if f.kind in SILENT]
        if silent and arguments.reduce:
            small = reduced(program, folder / f"{number}-reduced", arguments.seed, number, row, silent[0])
            print(f"   reduced: {json.dumps(simplest_with(small))}", flush=True)
        failures += silent
    report(array, rows, counts, kinds, used, program)
    return 1 if failures else 0


def report(array, rows, counts, kinds, used, program):
    covered = array.covered(rows)
    times = min((covered[p] for p in array.missing if p not in set(array.impossible)), default=0)
    print(f"{len(FEATURES)} features, {len(array.missing) - len(array.impossible)} pairs, each in at least {times} of {len(rows)} cases; "
          f"{sum(covered[p] > 0 for p in array.missing)} in one or more; {len(array.forbidden)} pairs are refused or empty, {len(array.impossible)} follow from these")
    print("cases: " + ", ".join(f"{n} {word}" for word, n in sorted(counts.items())) + f"; {program.runs} runs in {program.time:.0f} s")
    print("compared: " + ", ".join(f"{name} {n}" for name, n in sorted(used.items())))
    for (kind, oracle), n in sorted(kinds.items()):
        print(f"{kind:10} {oracle:24} {n}")


def refusals(arguments, program, folder):
    """Tries each constraint that the program must refuse, and shows its words. A run that ends in another way is a failure."""
    wrong = 0
    for k, constraint in enumerate(c for c in CONSTRAINTS if c.refused):
        row = simplest_row(constraint, random.Random(f"{arguments.seed}/{k}"))
        outcome = program.run(Case(arguments.seed, k, row), folder / f"{k}")
        words = " ".join(outcome.text.split())
        words = words[max(words.find("error:"), 0):]
        good = outcome.code == 2 and "error" in words
        wrong += not good
        print(f"{'refused' if good else 'NOT REFUSED'}: {constraint.reason}: {words[:200]}")
    return 1 if wrong else 0


def simplest_row(constraint, rng):
    """A row that this constraint forbids and no other with another reason, with simple values elsewhere."""
    others = [c for c in CONSTRAINTS if c.reason != constraint.reason]
    fits = lambda row: not any(c.forbids(row) for c in others)
    for _ in range(1000):
        row = {name: rng.choice(sorted(values, key=str)) for name, values in constraint.values.items()}
        names = [n for n in FEATURES if n not in row]
        rng.shuffle(names)
        for name in names:
            values = [v for v in [SIMPLEST[name], *FEATURES[name]] if fits(row | {name: v})]
            if values:
                row[name] = values[0]
        if len(row) == len(FEATURES) and fits(row):
            return row
    raise ValueError(f"no row for: {constraint.reason}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--times", type=int, default=3, help="how often each pair occurs")
    parser.add_argument("--oracles", type=int, default=3, help="oracles for each case")
    parser.add_argument("--oracle", action="append", choices=sorted(BY_NAME), help="these oracles instead")
    parser.add_argument("--count", type=int, default=1 << 30)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--only", type=int)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=int, default=90, help="limit of one run")
    parser.add_argument("--keep", help="a new folder in which the files of all runs stay")
    parser.add_argument("--reduce", action="store_true", help="reduce each failing case to a small one")
    parser.add_argument("--refusals", action="store_true")
    parser.add_argument("--python", help="an interpreter for the oracle of Python")
    parser.add_argument("--package", help="the folder that holds the package plastron")
    arguments = parser.parse_args()
    program = Program(arguments.program, arguments.python, arguments.package, arguments.seconds)
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(arguments.keep or scratch).resolve()
        return (refusals if arguments.refusals else campaign)(arguments, program, folder)


if __name__ == "__main__":
    sys.exit(main())
