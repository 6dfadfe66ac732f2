"""Least weight: the smallest thickness of a deck plate at bounds on the contact force and on the von Mises stress.

A steel plate of 1.2 m spans between two supports and carries 6.5 kPa. In the middle, 9 mm below it, is a stop. A thin plate
lies on the stop, a thick plate does not reach it. Two numbers are bounded: the force on the stop for each metre of its length,
because its lining is soft, and the largest von Mises stress, because the load is repeated. The contact is a line. Therefore
the bound is on force per length: the pressure at the nodes of a line depends on the mesh.

The stress does not fall steadily with the thickness: a plate that just reaches the stop has more stress than a thinner one,
which the stop carries. A search that expects one root can return the wrong one. Therefore a sweep over thickness comes first,
and the root is sought where the sweep first changes from "too much" to "allowed".
"""

import warnings

import plastron
from scipy.optimize import brentq

LENGTH, WIDTH, GAP, LOAD = 1.2, 0.1, 0.009, 6500.0  # m, m, m, N/m^2
E, NU, DENSITY = 210e9, 0.3, 7850.0  # Pa, 1, kg/m^3
MOST_FORCE = 4000.0  # on the stop, N/m
MOST_STRESS = 50e6  # Pa

CASE = plastron.Case(
    title="A deck plate over a stop",
    constants={"e": 0.01, "length": LENGTH, "width": WIDTH, "gap": GAP, "radius": 0.02},
    shell={"E": E, "nu": NU, "thickness": "e"},
    geometry={
        "domain": {"rectangle": {"from": [0, 0], "to": ["length", "width"], "cells": [12, 1]}},
        "chart": ["x", "y", 0],
    },
    mesh={"degree": 4, "refinements": 0},
    support=[
        {"boundary": "left", "fix": ["u.x", "u.z"]},
        {"boundary": "right", "fix": ["u.z"]},
        {"boundary": ["bottom", "top"], "fix": ["u.y", "r.y"]},  # plane strain: a strip of a wide plate
    ],
    load=[{"force": [0, 0, -LOAD]}],
    obstacle=[
        {"name": "stop", "cylinder": {"point": ["length/2", 0, "-e/2 - gap - radius"], "axis": [0, 1, 0], "radius": "radius"}}
    ],
)


def use(force, stress):
    """The larger of both numbers over their bounds: at most 1 is allowed."""
    return max(force / WIDTH / MOST_FORCE, stress / MOST_STRESS)


def solved(e):
    # The program warns that the pressure of a line contact depends on the mesh. We use the force only.
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", plastron.PlastronWarning)
        return plastron.solve(CASE.with_settings({"constants.e": e}), report=False)


def excess(e):
    result = solved(e)
    return use(result.obstacles["stop"].force[2], result.stress.max_von_mises) - 1


def main():
    thicknesses = [0.004 + 0.001 * i for i in range(9)]
    table = plastron.sweep(CASE, {"constants.e": thicknesses}, workers=1)
    forces, stresses = table["obstacles.stop.reaction.force_z"], table["stress.max_von_mises"]
    uses = [use(force, stress) for force, stress in zip(forces, stresses)]
    print("thickness  force on the stop  von Mises stress")
    for e, force, stress, u in zip(thicknesses, forces, stresses, uses):
        print(f"{1e3 * e:6.1f} mm  {force / WIDTH:13.0f} N/m  {stress / 1e6:12.1f} MPa  {'allowed' if u <= 1 else 'too much'}")

    first = next(i for i in range(1, len(uses)) if uses[i - 1] > 1 >= uses[i])
    e = brentq(excess, thicknesses[first - 1], thicknesses[first], xtol=1e-7)
    result = solved(e)
    force = result.obstacles["stop"].force[2] / WIDTH
    print(f"\nsmallest thickness  {1e3 * e:.3f} mm, which weighs {DENSITY * e:.1f} kg/m^2")
    print(f"force on the stop   {force:.0f} N/m, at most {MOST_FORCE:.0f} N/m")
    print(f"von Mises stress    {result.stress.max_von_mises / 1e6:.1f} MPa, at most {MOST_STRESS / 1e6:.0f} MPa")

    # The theory of beams: force on the stop = 5/8 load length (1 - (e / e0)^3), where a plate of thickness e0 just touches.
    touching = (60 * LOAD * LENGTH**4 * (1 - NU**2) / (384 * E * GAP)) ** (1 / 3)
    by_hand = touching * (1 - MOST_FORCE / (5 / 8 * LOAD * LENGTH)) ** (1 / 3)
    print(f"theory of beams     {1e3 * by_hand:.3f} mm for this force")


if __name__ == "__main__":
    main()
