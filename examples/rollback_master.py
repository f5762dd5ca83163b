"""A master that repeats every communication step until the units agree at its end.

Inputs move on straight lines between communication points, with `--degree 2` on parabolas through
the point before. Where they end is found by Newton's method: a trial step, the gap between outputs
and inputs at its end, back to the saved state. The matrix starts as the interface Jacobian of
fmi2GetDirectionalDerivative; Broyden's updates add what a whole step does.

    python rollback_master.py beam=beam.fmu load=mass.fmu --start load.coupling_stiffness=200 \\
        --connect "beam.beam.tip.position[2]=load.other_position" \\
                  "beam.beam.tip.velocity[2]=load.other_velocity" \\
                  "load.coupling_force=beam.beam.tip.force[2]" --step 0.01 --stop-time 1
"""

import argparse
import tempfile
from functools import cache

import numpy as np
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

MOST_ATTEMPTS = 40
TOLERANCE = 1e-9  # of a gap at the end of a step, relative to the largest value so far


opened = cache(lambda fmu: (read_model_description(fmu), extract(fmu, tempfile.mkdtemp())))


def ready(fmu, start):
    """An instance that is ready for its first step."""
    model, folder = opened(fmu)
    binary = model.coSimulation.modelIdentifier
    unit = FMU2Slave(guid=model.guid, unzipDirectory=folder, modelIdentifier=binary, instanceName="unit")
    unit.numbers = {v.name: v.valueReference for v in model.modelVariables}
    unit.instantiate()
    unit.setupExperiment(startTime=0.0)
    unit.setReal([unit.numbers[name] for name in start], list(start.values()))
    unit.enterInitializationMode()
    unit.exitInitializationMode()
    return unit


class Interface:
    """Units by name, and the values that go from outputs to inputs: `(unit.output, unit.input)` each."""

    def __init__(self, units, connections):
        self.units, self.size = units, len(connections)
        self.outputs, self.inputs = {}, {}  # places of a unit's values, and their value references
        self.jacobian = -np.eye(self.size)  # of the gaps between outputs and inputs at this point
        for name, unit in units.items():
            for side, found in enumerate((self.outputs, self.inputs)):
                ends = [(place, *ends[side].split(".", 1)) for place, ends in enumerate(connections)]
                own = [(place, unit.numbers[variable]) for place, owner, variable in ends if owner == name]
                found[name] = [place for place, _ in own], [reference for _, reference in own]
            for column, by in zip(*self.inputs[name]):
                rows, of = self.outputs[name]
                self.jacobian[rows, column] += unit.getDirectionalDerivative(of, [by], [1.0])

    def set(self, values, order=0):
        """Sets inputs, or for the next step their derivatives."""
        for name, unit in self.units.items():
            places, of = self.inputs[name]
            own = list(values[places])
            unit.setRealInputDerivatives(of, [order] * len(of), own) if order else unit.setReal(of, own)

    def get(self, order=0):
        """Outputs, or their derivatives."""
        values = np.empty(self.size)
        for name, unit in self.units.items():
            places, of = self.outputs[name]
            values[places] = unit.getRealOutputDerivatives(of, [order] * len(of)) if order else unit.getReal(of)
        return values

    def settle(self, order=0):
        """Inputs, or their derivatives, that agree with outputs at this communication point."""
        values = self.get(order)
        for _ in range(MOST_ATTEMPTS):
            self.set(values, order)
            gap = self.get(order) - values
            if np.all(np.abs(gap) <= 1e-11 * (1 + np.abs(values))):
                return values
            values = values - np.linalg.solve(self.jacobian, gap)
        raise RuntimeError(f"outputs and inputs do not agree: {gap} apart")


class RollbackMaster:
    """Steps units so that they agree at every communication point."""

    def __init__(self, interface, degree=1):
        self.interface, self.degree = interface, degree
        self.inputs, self.before, self.attempts = interface.settle(), None, 0
        self.jacobian, self.scale = interface.jacobian, np.full(interface.size, 1e-12)

    def attempt(self, time, step, states, end):
        """The gap between outputs and inputs after a step whose inputs end at `end`."""
        bend = 0 * end if self.degree == 1 or self.before is None else end - 2 * self.inputs + self.before
        for name, unit in self.interface.units.items():
            unit.setFMUstate(states[name])
        self.interface.set(self.inputs)
        self.interface.set((end - self.inputs - bend / 2) / step, order=1)
        self.interface.set(bend / step**2, order=2)
        for unit in self.interface.units.values():
            unit.doStep(time, step)
        self.interface.set(end)
        self.attempts += 1
        return self.interface.get() - end

    def step(self, time, step):
        """One communication step, as long as the one before where inputs move on parabolas."""
        states = {name: unit.getFMUstate() for name, unit in self.interface.units.items()}
        end = self.inputs if self.before is None else 2 * self.inputs - self.before
        gap = self.attempt(time, step, states, end)
        for _ in range(MOST_ATTEMPTS):
            self.scale = np.maximum(self.scale, np.abs(end))
            if np.all(np.abs(gap) <= TOLERANCE * self.scale):
                break
            change = -np.linalg.solve(self.jacobian, gap)
            end = end + change
            gap = self.attempt(time, step, states, end)
            weighed = change / self.scale**2
            self.jacobian = self.jacobian + np.outer(gap, weighed) / (weighed @ change)
        else:
            raise RuntimeError(f"outputs and inputs do not agree at time {time + step}: {gap} apart")
        self.before, self.inputs = self.inputs, end
        for name, unit in self.interface.units.items():
            unit.freeFMUstate(states[name])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("units", nargs="+", metavar="name=FILE.fmu")
    parser.add_argument("--connect", nargs="+", required=True, metavar="unit.output=unit.input")
    parser.add_argument("--start", nargs="+", default=[], metavar="unit.variable=value")
    parser.add_argument("--step", type=float, required=True, help="communication step, s")
    parser.add_argument("--stop-time", type=float, required=True, help="s")
    parser.add_argument("--degree", type=int, choices=(1, 2), default=1, help="lines or parabolas")
    options = parser.parse_args()
    starts = [(*path.split(".", 1), float(value)) for path, value in (text.split("=") for text in options.start)]
    files = dict(text.split("=", 1) for text in options.units)
    units = {name: ready(fmu, {v: value for unit, v, value in starts if unit == name}) for name, fmu in files.items()}
    connections = [text.split("=") for text in options.connect]
    master = RollbackMaster(Interface(units, connections), options.degree)
    print("time", *(source for source, _ in connections), sep=",")
    for number in range(round(options.stop_time / options.step)):
        master.step(number * options.step, options.step)
        print((number + 1) * options.step, *master.inputs, sep=",")


if __name__ == "__main__":
    main()
