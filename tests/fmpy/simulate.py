"""Simulates an FMU with plain fmpy and writes its outputs to a CSV file.

usage: simulate.py FMU --output FILE.csv [--stop-time T] [--step H] [--set name=value ...] [--input FILE.csv]

A file of inputs has a column `time` and one for every input that varies, named like it. Inputs follow straight lines
from row to row, by their first derivatives, and the FMU is stepped to every row; two rows of one time are a jump. Rates of
driven coordinates without a column are those of the lines.
"""

import argparse
import csv
import difflib
import math
import sys
import tempfile

from fmpy import read_model_description
from instance import Fmu, Instance
from tqdm import tqdm

# Keys of driven coordinates, their rates and accelerations.
RATES = [
    *((value, "velocity", "acceleration") for value in ("displacement", "position", "travel")),
    ("angle", "angular_velocity", "angular_acceleration"),
]
# Times that are nearer than this part of a step are one.
SAME_TIME = 1e-9


def main():
    arguments = parse_arguments()
    messages = []
    try:
        with tempfile.TemporaryDirectory() as folder:
            names, rows = simulate(arguments, folder, messages)
    except Refused as reason:
        sys.exit(f"error: {reason}")
    except Exception as error:
        # Whatever fails, the user reads what the FMU said, then fmpy's own words.
        sys.exit("\n".join(["error: the simulation failed", *messages[-5:], str(error)]))
    with open(arguments.output, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(names)
        writer.writerows(rows)


class Refused(Exception):
    """What the user wrote cannot be simulated."""


def simulate(arguments, folder, messages):
    """Names and values of the outputs at every communication point; what the FMU logs goes to `messages`."""
    description = read_model_description(arguments.fmu)
    experiment = description.defaultExperiment
    stop_time = arguments.stop_time or float(experiment.stopTime)
    step = arguments.step or float(experiment.stepSize)
    variables = {variable.name: variable for variable in description.modelVariables}
    starts = {settable(variables, name, f"--set {name}"): value for name, value in arguments.set}
    signals = Signals(arguments.input, variables, stop_time) if arguments.input else None
    for name in starts.keys() & (signals.names if signals else ()):
        raise Refused(f"--set {name}: {arguments.input} sets it already")

    fmu = Fmu(arguments.fmu, folder)
    with Instance(fmu, name=description.modelName) as instance:
        instance.messages = messages
        outputs = fmu.names("output")
        return ["time", *outputs], run(instance, outputs, (starts, signals), (step, stop_time))


def run(instance, outputs, given, experiment):
    """Values at every communication point."""
    starts, signals = given
    step, stop_time = experiment
    slave = instance.slave
    first = signals.first() if signals else {}
    instance.initialize({**starts, **first}, stop_time=stop_time)
    rows = [[0.0, *instance.get(outputs)]]
    # The last step is shorter where the stop time is no multiple, but not by rounding alone.
    steps = max(1, math.ceil(stop_time / step - SAME_TIME))
    time = 0.0
    bar = tqdm(
        total=stop_time,
        desc=instance.fmu.description.modelName,
        bar_format="{desc} {percentage:3.0f}% |{bar}| {n:.3g} of {total:.3g} s [{elapsed}<{remaining}]",
    )
    with bar:
        for number in range(1, steps + 1):
            end = min(number * step, stop_time)
            for stop in [*(signals.rows_between(time, end) if signals else ()), end]:
                if signals:
                    values, slopes = signals.at(time, SAME_TIME * step)
                    slave.setReal(signals.references, values)
                    slave.setReal(*signals.rates(slopes))
                    slave.setRealInputDerivatives(signals.references, [1] * len(slopes), slopes)
                slave.doStep(currentCommunicationPoint=time, communicationStepSize=stop - time)
                time = stop
            rows.append([time, *instance.get(outputs)])
            bar.update(time - bar.n)
    slave.terminate()
    return rows


def settable(variables, name, place):
    """The name, if it is that of a variable."""
    if name in variables:
        return name
    alike = difflib.get_close_matches(name, [n for n, v in variables.items() if v.causality in ("parameter", "input")])
    words = f"; did you mean {' or '.join(f'`{other}`' for other in alike)}?" if alike else ""
    raise Refused(f"{place}: no variable of this name{words}")


class Signals:
    """Inputs that vary in time."""

    def __init__(self, path, variables, stop_time):
        with open(path, newline="", encoding="utf-8-sig") as file:
            names, *rows = [[field.strip() for field in line] for line in csv.reader(file) if line] or [[""]]
        if names[0] != "time" or len(names) == 1:
            raise Refused(f"{path}, line 1: expected a column `time`, then inputs, found {', '.join(names)}")
        self.names = names[1:]
        for name in self.names:
            if variables[settable(variables, name, f"{path}: column {name}")].causality != "input":
                raise Refused(f"{path}: column {name}: expected an input, found another variable")
        if len(set(names)) < len(names):
            raise Refused(f"{path}, line 1: expected every input once")
        self.references = [variables[name].valueReference for name in self.names]
        # Places of columns and orders of what follows from them, by reference.
        self.implied = dict(self.unsaid(variables))
        self.times, self.rows = [], []
        for number, row in enumerate(rows, 2):
            self.add(f"{path}, line {number}", row)
        if not self.times or self.times[0] > SAME_TIME * stop_time or self.times[-1] < stop_time * (1 - SAME_TIME):
            found = f"{self.times[0]} s to {self.times[-1]} s" if self.times else "none"
            raise Refused(f"{path}: expected rows from 0 s to the stop time {stop_time} s, found {found}")

    def add(self, place, row):
        try:
            time, *values = map(float, row)
        except ValueError as error:
            raise Refused(f"{place}: expected numbers, found {', '.join(row)}") from error
        if not all(map(math.isfinite, (time, *values))) or len(values) != len(self.names):
            raise Refused(f"{place}: expected {len(self.names) + 1} finite numbers, found {', '.join(row)}")
        if self.times and time < self.times[-1]:
            raise Refused(f"{place}: expected a time of {self.times[-1]} s or later, found {time} s")
        if self.times[-2:] == [time, time]:
            raise Refused(f"{place}: expected two rows at most at {time} s, found a third")
        self.times.append(time)
        self.rows.append(values)

    def at(self, time, slack):
        """Values and slopes from a time on."""
        row = max(0, sum(t <= time + slack for t in self.times) - 1)
        after = min(row + 1, len(self.times) - 1)
        span = self.times[after] - self.times[row]
        slopes = [(b - a) / span if span > 0.0 else 0.0 for a, b in zip(self.rows[row], self.rows[after])]
        return [a + slope * (time - self.times[row]) for a, slope in zip(self.rows[row], slopes)], slopes

    def unsaid(self, variables):
        """Rates of driven coordinates that have no column: reference, name, nearest column below, order above it."""
        for name in self.names:
            for keys in RATES:
                chain = [name.replace(f".{keys[0]}", f".{key}") for key in keys]
                for order, rate in enumerate(chain):
                    if f".{keys[0]}" in name and rate in variables and rate not in self.names:
                        below = max(k for k in range(order) if chain[k] in self.names)
                        yield variables[rate].valueReference, (rate, self.names.index(chain[below]), order - below)

    def rates(self, slopes):
        """References and values of rates that have no column."""
        return list(self.implied), [slopes[place] if order == 1 else 0.0 for _, place, order in self.implied.values()]

    def first(self):
        """Values at the start, by name."""
        values, slopes = self.at(0.0, 0.0)
        rates = dict(zip((name for name, *_ in self.implied.values()), self.rates(slopes)[1]))
        return {**dict(zip(self.names, values)), **rates}

    def rows_between(self, start, end):
        """Times of rows inside a step."""
        slack = SAME_TIME * (end - start)
        return sorted({time for time in self.times if start + slack < time < end - slack})


def parse_arguments():
    parser = argparse.ArgumentParser(description="Simulates an FMU with fmpy.")
    parser.add_argument("fmu", metavar="FMU")
    parser.add_argument("--output", metavar="FILE.csv", required=True)
    parser.add_argument("--stop-time", type=positive, metavar="T")
    parser.add_argument("--step", type=positive, metavar="H")
    parser.add_argument("--set", type=assignment, action="append", default=[], metavar="name=value")
    parser.add_argument("--input", metavar="FILE.csv")
    return parser.parse_args()


def positive(text):
    value = float(text)
    if not 0.0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"expected a positive number, found {text}")
    return value


def assignment(text):
    name, separator, value = text.partition("=")
    if not separator:
        raise argparse.ArgumentTypeError(f"expected name=value, found {text}")
    return name.strip(), float(value)


if __name__ == "__main__":
    main()
