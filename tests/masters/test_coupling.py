"""Schemes of masters against known limits and errors; the rollback master of the examples."""

import math
import subprocess
import sys

import numpy as np
import pytest
from coupled import FIGURES, BeamAndMass, TwoMasses
from schemes import Asking, Extrapolating, RollbackMaster, interface, largest_stable_step

FIRST = {"J": None, "GS": "two"}


@pytest.fixture(scope="session")
def masses(systems):
    return TwoMasses(systems.partners)


def end(master, step, stop=1.0):
    """Position of the first mass at the end."""
    for number in range(round(stop / step)):
        master.step(number * step, step)
    unit = master.interface.units["one"]
    return unit.getReal([unit.numbers["position"]])[0]


@pytest.mark.parametrize("time, expected", [(row[0], row[1:]) for row in FIGURES["response"]["rows"]])
def test_the_reference_is_that_of_the_figures(masses, time, expected):
    assert masses.exact(time) == pytest.approx(expected, abs=1e-14)


@pytest.mark.parametrize("way, degree, errors", [(row[0], row[1], row[2:]) for row in FIGURES["errors"]["rows"]])
def test_jacobi_makes_the_errors_of_the_figures(masses, way, degree, errors):
    for step, expected in zip([0.01, 0.005, 0.0025], errors, strict=True):
        past = [masses.inputs(way, -step), masses.inputs(way, -2 * step)]
        master = Extrapolating(interface(masses.system(way)), degree, past=past)
        found = abs(end(master, step) - masses.exact(1.0)[0])
        assert found == pytest.approx(expected, rel=1e-8, abs=1e-13)


@pytest.mark.parametrize("way, scheme, degree", [("FD", "J", 0), ("DD", "J", 2), ("FD", "GS", 1), ("FF", "J", 1)])
def test_steps_are_stable_as_far_as_the_figures_say(masses, way, scheme, degree):
    """All rows are on the chart `coupling`."""
    rows = {tuple(row[:3]): row[3] for row in FIGURES["limits"]["rows"]}
    figure = rows[way, scheme, degree]
    system = masses.system(way)
    found = largest_stable_step(
        lambda: Extrapolating(interface(system), degree, FIRST[scheme]),
        "one.position",
        0.8 * figure,
        1.5 * figure,
        count=300,
        precision=0.01,
    )
    assert found == pytest.approx(figure, rel=0.03)


@pytest.mark.parametrize("way", ["FD", "DD", "FF"])
@pytest.mark.parametrize(
    "make, order",
    [
        (lambda i: Asking(i, 1), 2),
        (lambda i: Asking(i, 2), 3),
        (lambda i: RollbackMaster(i, 1), 2),
        (lambda i: RollbackMaster(i, 2), 3),
    ],
    ids=["asking-1", "asking-2", "rollback-1", "rollback-2"],
)
def test_errors_fall_with_the_order(masses, way, make, order):
    errors = [abs(end(make(interface(masses.system(way))), step) - masses.exact(1.0)[0]) for step in (0.01, 0.005)]
    assert math.log2(errors[0] / errors[1]) == pytest.approx(order, abs=0.2)


def test_rollback_agrees_at_every_point_with_steps_where_others_are_unstable(masses):
    step = 0.15
    known = interface(masses.system("FD"))
    master = RollbackMaster(known)
    for number in range(40):
        master.step(number * step, step)
        assert np.abs(known.get() - master.inputs).max() < 1e-6
    assert np.abs(master.inputs).max() < 1.0
    assert master.attempts < 6 * 40
