"""Masters with fixed steps that never go back, and their largest stable step."""

import sys
from pathlib import Path

import numpy as np
from fmpy.fmi1 import FMICallException

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "examples"))

from rollback_master import Interface, RollbackMaster, ready  # noqa: E402

__all__ = ["Asking", "Extrapolating", "RollbackMaster", "interface", "largest_stable_step"]


def interface(system):
    """The units of a system, ready for their first step."""
    units = {name: ready(unit["fmu"], unit["start"]) for name, unit in system["units"].items()}
    return Interface(units, system["connections"])


class Asking:
    """Jacobi's scheme; how inputs go on is what derivatives of outputs say, up to a degree."""

    def __init__(self, interface, degree):
        self.interface, self.degree = interface, degree
        self.inputs = interface.settle()

    def step(self, time, step):
        move(self.interface, self.inputs, *slopes(self.interface, self.degree))
        for unit in self.interface.units.values():
            unit.doStep(time, step)
        self.inputs = self.interface.settle()


class Extrapolating:
    """Jacobi's scheme, or that of Gauss and Seidel with a unit that goes `first`; inputs go on as
    polynomials of a degree through the last communication points. Units that do not go first have
    them through the coming point instead of the earliest."""

    def __init__(self, interface, degree, first=None, past=()):
        self.interface, self.degree, self.first = interface, degree, first
        self.points = [interface.settle(), *past]
        self.slopes = slopes(interface, degree)

    def step(self, time, step):
        units = self.interface.units
        if len(self.points) == 1:
            # Nothing is known of the time before the start but what derivatives make of it.
            now, (first, second) = self.points[0], self.slopes
            self.points += [now - k * step * first + (k * step) ** 2 / 2 * second for k in (1, 2)]
        move(self.interface, *extrapolation(self.points, step, self.degree))
        if self.first is not None:
            units[self.first].doStep(time, step)
            move(self.interface, *interpolation(self.interface.get(), self.points, step, self.degree))
        for name, unit in units.items():
            if name != self.first:
                unit.doStep(time, step)
        self.points = [self.interface.settle(), *self.points[:2]]


def slopes(interface, degree):
    """First and second derivatives of inputs now, zero above a degree."""
    return [interface.settle(order) if order <= degree else np.zeros(interface.size) for order in (1, 2)]


def move(interface, *values):
    """Sets inputs and their derivatives for the next step."""
    for order, derivatives in enumerate(values):
        interface.set(derivatives, order)


def extrapolation(points, step, degree):
    """Value and derivatives at the last point of the polynomial through it and those before."""
    now, before, earliest = points
    return [
        (now, 0 * now, 0 * now),
        (now, (now - before) / step, 0 * now),
        (now, (3 * now - 4 * before + earliest) / (2 * step), (now - 2 * before + earliest) / step**2),
    ][degree]


def interpolation(coming, points, step, degree):
    """The same of the polynomial through the coming point too, instead of the earliest."""
    now, before, _ = points
    return [
        (coming, 0 * now, 0 * now),
        (now, (coming - now) / step, 0 * now),
        (now, (coming - before) / (2 * step), (coming - 2 * now + before) / step**2),
    ][degree]


def largest_stable_step(make, output, lowest, highest, count=600, least=0.0, precision=0.002):
    """Where stability first ends, going up: nothing if nowhere, zero if the lowest step is not stable.

    `make` gives a master that is ready for its first step. A run has `count` steps, or more if it
    would be shorter than `least`, s."""

    def stable(step):
        return is_stable(make(), step, output, max(count, round(least / step)))

    if not stable(lowest):
        return 0.0
    low, high = lowest, 1.15 * lowest
    while stable(high):
        if high >= highest:
            return None
        low, high = high, min(1.15 * high, highest)
    while high > low * (1 + precision):
        middle = (low * high) ** 0.5
        low, high = (middle, high) if stable(middle) else (low, middle)
    return (low * high) ** 0.5


def is_stable(master, step, output, count):
    """Whether an output of a unit swings no further in the last quarter of a run than in the second."""
    name, variable = output.split(".", 1)
    unit = master.interface.units[name]
    quarters = [0.0] * 4
    try:
        for number in range(count):
            master.step(number * step, step)
            size = abs(unit.getReal([unit.numbers[variable]])[0])
            quarters[4 * number // count] = max(quarters[4 * number // count], size)
            if not size < 1e3:
                return False
    except (FMICallException, RuntimeError):
        # A unit or the master could not follow any more.
        return False
    finally:
        for unit in master.interface.units.values():
            unit.freeInstance()
    return quarters[3] <= quarters[1]
