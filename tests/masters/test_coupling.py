"""Schemes of masters against known limits and errors; the rollback master of the examples."""

import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from coupled import FIGURES, BeamAndMass, TwoMasses, mass_scene
from coupling import Scenes, Whole, curve
from schemes import Asking, Extrapolating, RollbackMaster, interface, largest_stable_step

EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "rollback_master.py"

FIRST = {"J": None, "GS": "two"}


@pytest.fixture(scope="session")
def masses(systems):
    return TwoMasses(systems.partners)


def end(master, step, output="one.position"):
    """Position of the first mass after a second."""
    for number in range(round(1.0 / step)):
        master.step(number * step, step)
    name, variable = output.split(".", 1)
    unit = master.interface.units[name]
    return unit.getReal([unit.numbers[variable]])[0]


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


def test_the_example_runs_as_it_says(masses):
    system = masses.system("FD")
    command = [sys.executable, str(EXAMPLE)]
    command += [f"{name}={unit['fmu']}" for name, unit in system["units"].items()]
    command += ["--connect", *("=".join(pair) for pair in system["connections"])]
    starts = [(name, *start) for name, unit in system["units"].items() for start in unit["start"].items()]
    command += ["--start", *(f"{name}.{variable}={value}" for name, variable, value in starts)]
    command += ["--step", "0.01", "--stop-time", "1", "--degree", "2"]
    result = subprocess.run(command, capture_output=True, text=True, check=False, timeout=60)
    assert result.returncode == 0, result.stderr
    header, *_, last = result.stdout.splitlines()
    assert header == "time,two.position,two.velocity,one.coupling_force"
    assert float(last.split(",")[1]) == pytest.approx(masses.exact(1.0)[2], abs=1e-4)
    assert len(EXAMPLE.read_text(encoding="utf-8").splitlines()) <= 150


@pytest.fixture(scope="session")
def packaged(systems):
    return Scenes(systems)


@pytest.mark.parametrize("way", ["FD", "DD", "FF"])
def test_ports_do_what_exact_units_do(systems, masses, packaged, way):
    scenes = TwoMasses(systems.partners, lambda *body: packaged(mass_scene, *body))
    for degree in (0, 2):
        found, expected = (
            end(Extrapolating(interface(system), degree), 0.02, system["outputs"][0])
            for system in (scenes.system(way), masses.system(way))
        )
        assert found == pytest.approx(expected, abs=1e-6)


def test_a_beam_and_a_mass_move_as_in_one_scene(systems, packaged):
    """The scene has its reference: modes in closed form."""
    stop = 0.4
    closed = BeamAndMass.closed_form(stop)
    undamped = Whole(systems, stop, is_damped=False)
    assert undamped(stop) == pytest.approx(closed[0], abs=1e-4 * undamped.size)
    both = BeamAndMass(systems.partners, lambda has_spring: packaged(BeamAndMass.beam_scene, has_spring))
    known, whole = both.system("FD"), Whole(systems, stop, is_damped=True)
    errors = [
        curve(lambda: RollbackMaster(interface(known), 2), step, stop, known["outputs"][0], whole)[0]
        for step in (0.005, 0.0025)
    ]
    assert errors[1] < 1e-3
    assert math.log2(errors[0] / errors[1]) == pytest.approx(3, abs=0.3)
