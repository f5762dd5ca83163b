"""Simulates an FMU with plain fmpy and writes its outputs to a CSV file.

usage: simulate.py FMU --output FILE.csv [--stop-time T] [--step H] [--set name=value ...]
"""

import argparse
import csv
import sys

from fmpy import read_model_description, simulate_fmu
from fmpy.fmi2 import fmi2OK
from tqdm import tqdm


def main():
    arguments = parse_arguments()
    messages = []
    try:
        result = simulate(arguments, messages)
    except Exception as error:
        # Whatever fails, the user reads what the FMU said, then fmpy's own words.
        sys.exit("\n".join(["error: the simulation failed", *messages[-5:], str(error)]))
    with open(arguments.output, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(result.dtype.names)
        writer.writerows(row.item() for row in result)


def simulate(arguments, messages):
    """The outputs at every communication point; what the FMU logs goes to `messages`."""
    description = read_model_description(arguments.fmu)
    experiment = description.defaultExperiment
    stop_time = arguments.stop_time or float(experiment.stopTime)
    bar = tqdm(
        total=stop_time,
        desc=description.modelName,
        bar_format="{desc} {percentage:3.0f}% |{bar}| {n:.3g} of {total:.3g} s [{elapsed}<{remaining}]",
    )

    def advance(time, _recorder):
        bar.update(time - bar.n)
        return True

    def log(_environment, _name, status, _category, text):
        if status != fmi2OK:
            messages.append(text.decode())

    with bar:
        return simulate_fmu(
            arguments.fmu,
            start_time=0.0,
            stop_time=stop_time,
            output_interval=arguments.step or float(experiment.stepSize),
            start_values=dict(arguments.set),
            debug_logging=True,
            logger=log,
            step_finished=advance,
        )


def parse_arguments():
    parser = argparse.ArgumentParser(description="Simulates an FMU with fmpy.")
    parser.add_argument("fmu", metavar="FMU")
    parser.add_argument("--output", metavar="FILE.csv", required=True)
    parser.add_argument("--stop-time", type=positive, metavar="T")
    parser.add_argument("--step", type=positive, metavar="H")
    parser.add_argument("--set", type=assignment, action="append", default=[], metavar="name=value")
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
    return name, float(value)


if __name__ == "__main__":
    main()
