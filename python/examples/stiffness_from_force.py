"""An inverse problem: Young's modulus from a measured curve of force over displacement.

A flat stamp presses a leaf spring down. First they touch at the crown. Then the spring lies against the stamp in a zone that
grows, and becomes stiffer. Two numbers are sought: Young's modulus, and the reading of the machine at the first touch, which
no one knows exactly. least_squares() of SciPy finds those whose curve is nearest to the measured one.

The measured curve is made here, by the same program with known values, on a mesh twice as fine, with random errors of 0.05 N.
"""

import numpy as np
import plastron
from scipy.optimize import least_squares

TRUE_E, TRUE_TOUCH = 206e3, 0.3  # MPa, mm
NOISE = 0.05  # standard deviation of a measured force, N
PARTS, TRAVEL = 9, 9.0  # readings, last reading of the machine in mm


def spring(E, touch, cells=8):
    """The case: half of a strip of 20 mm, in mm, N and MPa. The readings of the machine are the motion of the stamp."""
    return plastron.Case(
        title="A leaf spring under a stamp",
        units={"length": "mm", "force": "N"},
        constants={"half": 100, "rise": 10, "e": 1, "width": 20},
        shell={"E": E, "nu": 0.3, "thickness": "e", "rotations": "finite"},
        geometry={
            "domain": {"rectangle": {"from": [0, 0], "to": ["half", "width"], "cells": [cells, 1]}},
            "chart": ["x", "y", "-e/2 - rise*(x/half)^2"],
        },
        mesh={"degree": 4, "refinements": 0},
        support=[
            {"boundary": "left", "fix": ["symmetry"]},
            {"boundary": "right", "fix": ["u.z"]},
            {"boundary": ["bottom", "top"], "fix": ["u.y", "r.y"]},  # plane strain: a strip of a wide spring
        ],
        obstacle=[{"name": "stamp", "half_space": {"point": [0, 0, touch], "normal": [0, 0, -1]}}],
        step=[{"name": "press", "parts": PARTS, "move": [{"obstacle": "stamp", "translate": [0, 0, -TRAVEL]}]}],
    )


def curve(E, touch, cells=8):
    """The force of the stamp on both halves [N] at each reading."""
    result = plastron.solve(spring(E, touch, cells), report=False)
    if not result.is_solved:
        raise RuntimeError(result.status_text)
    return np.array([-2 * instant.obstacles["stamp"].force[2] for instant in result.history])


def main():
    readings = TRAVEL * np.arange(1, PARTS + 1) / PARTS
    measured = curve(TRUE_E, TRUE_TOUCH, cells=16) + NOISE * np.random.default_rng(1).normal(size=PARTS)

    # The unknowns have about the same size. The step of the differences is much greater than the errors of the iteration.
    scale = np.array([200e3, 1.0])
    start = np.array([150e3, 0.0]) / scale
    evaluations = 0

    def residuals(unknowns):
        nonlocal evaluations
        evaluations += 1
        return (curve(*(unknowns * scale)) - measured) / NOISE

    fit = least_squares(residuals, start, diff_step=1e-3, x_scale=[1, 1], xtol=1e-6)
    E, touch = fit.x * scale
    E_error, touch_error = scale * np.sqrt(np.diag(np.linalg.inv(fit.jac.T @ fit.jac)))

    print("reading   measured    computed")
    for reading, force, computed in zip(readings, measured, measured + NOISE * fit.fun):
        print(f"{reading:4.1f} mm  {force:7.3f} N  {computed:8.3f} N")
    print(f"\nYoung's modulus  {E:.0f} +- {E_error:.0f} MPa, known {TRUE_E:.0f} MPa")
    print(f"first touch      {touch:.4f} +- {touch_error:.4f} mm, known {TRUE_TOUCH} mm")
    print(f"                 (one standard deviation, from the errors of {NOISE} N)")
    print(f"sum of squares   {2 * fit.cost:.1f} standard deviations^2 for {PARTS} readings and 2 unknowns")
    print(f"{evaluations} evaluations")


if __name__ == "__main__":
    main()
