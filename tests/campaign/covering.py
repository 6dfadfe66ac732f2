"""Rows of features that have every possible pair of values at least `times` times (a covering array of strength 2, made greedily:
Cohen, Dalal, Fredman, Patton, The AETG system, 1997)."""

import collections
import random

from features import CONSTRAINTS, FEATURES, all_pairs, forbidding, pairs_of

_ABOUT = {name: [c for c in CONSTRAINTS if name in c.values] for name in FEATURES}


def _fits(row, name, value):
    row[name] = value
    good = not any(c.forbids(row) for c in _ABOUT[name])
    del row[name]
    return good


def complete(start, rng, missing=None):
    """A row with the values of `start`, filled with values that have many missing pairs with those chosen before; None without one."""
    for _ in range(40):
        row = dict(start)
        names = [n for n in FEATURES if n not in row]
        rng.shuffle(names)
        for name in names:
            values = [v for v in FEATURES[name] if _fits(row, name, v)]
            if not values:
                break
            gain = [sum((missing or {}).get(_pair(name, v, other, row[other]), 0) > 0 for other in row) for v in values]
            best = max(gain)
            row[name] = rng.choice([v for v, g in zip(values, gain) if g == best])
        if len(row) == len(FEATURES) and not forbidding(row):
            return {name: row[name] for name in FEATURES}
    return None


_ORDER = {name: k for k, name in enumerate(FEATURES)}


def _pair(a, x, b, y):
    return ((a, x), (b, y)) if _ORDER[a] < _ORDER[b] else ((b, y), (a, x))


class Array:
    """Rows, and the pairs that no row can have although no constraint on two features forbids them."""

    def __init__(self, seed, times, candidates=4):
        rng = random.Random(f"array {seed}")
        possible, self.forbidden = all_pairs()
        self.missing = collections.Counter({pair: times for pair in possible})
        self.rows, self.impossible = [], []
        left = list(possible)
        while left:
            pair = max(left[:200], key=self.missing.__getitem__)
            rows = [complete(dict(pair), rng, self.missing) for _ in range(candidates)]
            rows = [row for row in rows if row]
            if rows:
                self._add(max(rows, key=lambda row: sum(self.missing[p] > 0 for p in pairs_of(row))))
            else:
                self.impossible.append(pair)
                self.missing[pair] = 0
            left = [p for p in left if self.missing[p] > 0]
            rng.shuffle(left)

    def _add(self, row):
        self.rows.append(row)
        for pair in pairs_of(row):
            if self.missing[pair] > 0:
                self.missing[pair] -= 1

    def covered(self, rows):
        """How often each possible pair is in the rows."""
        return collections.Counter(pair for row in rows for pair in pairs_of(row))
