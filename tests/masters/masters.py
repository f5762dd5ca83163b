"""Runs a system of coupled FMUs in one master and prints its outputs at the end, as JSON:
`python masters.py MASTER < SYSTEM.json`. Each run is a process of its own: a master's library
takes only itself along when it falls.

A system names its `units` (an `fmu` and `start` values), `connections` from an output to an input,
both `unit.variable`, `outputs`, `step` and `stop` in s, and for ECCO its power `bonds`, each two
connections that carry power between two units, and the `energy_tolerance` in J of a step."""

import ctypes
import json
import os
import shutil
import stat
import sys
import sysconfig
import tempfile
from pathlib import Path

from ssp import archive, split

NANOSECONDS = 10**9


def starts(system):
    """Unit, variable and value of all start values."""
    for unit, data in system["units"].items():
        for name, value in data["start"].items():
            yield unit, name, value


def fmpy_ssp(system, folder):
    """FMPy's SSP master: Jacobi, fixed step; inputs are zero in the first step."""
    from fmpy.ssp.simulation import simulate_ssp

    parameters = [Parameter(f"{unit}.{name}", value) for unit, name, value in starts(system)]
    rows = simulate_ssp(
        str(archive(system, folder / "coupled.ssp")),
        stop_time=system["stop"] - 0.5 * system["step"],
        step_size=system["step"],
        parameter_set=ParameterSet(parameters),
    )
    return [rows[path][-1] for path in system["outputs"]]


class Parameter:
    """What FMPy reads from a parameter."""

    def __init__(self, name, value):
        self.name, self.value = name, value


class ParameterSet:
    """What FMPy reads from a set of parameters."""

    def __init__(self, parameters):
        self.parameters = parameters


def libcosimpy_fixed(system, folder):
    """Open Simulation Platform, fixed step: Jacobi."""
    return at_end(system, libcosimpy(system, None))


def libcosimpy_ecco(system, folder):
    """Open Simulation Platform, ECCO: steps chosen by the power that bonds lose."""
    return at_end(system, libcosimpy(system, ecco(system)))


def libcosimpy_ssp(system, folder):
    """Open Simulation Platform, fixed step, with all that it is told in an archive of SSP."""
    from libcosimpy._internal import get_last_error_message
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
    from libcosimpy.CosimObserver import CosimObserver

    log_output_level(CosimLogLevel.WARNING)
    execution = CosimExecution.from_ssp_file(ssp_path=str(archive(system, folder / "coupled.ssp")))
    observer = CosimObserver.create_last_value()
    if not (execution.add_observer(observer) and execution.simulate_until(round(system["stop"] * NANOSECONDS))):
        raise RuntimeError(get_last_error_message())
    slaves = {info.name.decode(): info.index for info in execution.slave_infos()}
    values = []
    for unit, name in map(split, system["outputs"]):
        known = {variable.name.decode(): variable.reference for variable in execution.slave_variables(slaves[unit])}
        values.append(observer.last_real_values(slaves[unit], [known[name]])[0])
    return values


def ecco(system):
    """ECCO with a tenth of the greatest step to begin with."""
    from libcosimpy.CosimAlgorithm import CosimAlgorithm, EccoParams

    step = system["step"]
    parameters = EccoParams(
        safety_factor=0.8,
        step_size=step / 10,
        min_step_size=step / 100,
        max_step_size=step,
        min_change_rate=0.2,
        max_change_rate=1.5,
        abs_tolerance=system["energy_tolerance"],
        rel_tolerance=system["energy_tolerance"],
        p_gain=0.2,
        i_gain=0.15,
    )
    return CosimAlgorithm.create_ecco_algorithm(parameters)


def libcosimpy(system, algorithm):
    """Times, s, and values of every output, after every step."""
    from libcosimpy._internal import get_last_error_message
    from libcosimpy.CosimEnums import CosimVariableType
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
    from libcosimpy.CosimObserver import CosimObserver
    from libcosimpy.CosimSlave import CosimLocalSlave

    def succeed(done):
        if not done:
            raise RuntimeError(get_last_error_message())

    log_output_level(CosimLogLevel.WARNING)
    if algorithm is None:
        execution = CosimExecution.from_step_size(step_size=round(system["step"] * NANOSECONDS))
    else:
        execution = CosimExecution.from_algorithm(algorithm)
    # The library does not keep what Python lets go.
    slaves = {unit: CosimLocalSlave(data["fmu"], instance_name=unit) for unit, data in system["units"].items()}
    numbers = {unit: execution.add_local_slave(slave) for unit, slave in slaves.items()}
    succeed(min(numbers.values()) >= 0)
    references = {}
    for unit, number in numbers.items():
        for known in execution.slave_variables(number):
            references[unit, known.name.decode()] = known.reference

    def variable(path):
        unit, name = split(path)
        return numbers[unit], references[unit, name]

    for unit, name, value in starts(system):
        succeed(execution.real_initial_value(*variable(f"{unit}.{name}"), value))
    for source, sink in system["connections"]:
        succeed(execution.connect_real_variables(*variable(source), *variable(sink)) >= 0)
    observer = CosimObserver.create_time_series(buffer_size=100000)
    succeed(execution.add_observer(observer))
    watched = set(system["outputs"])
    if algorithm is not None:
        for (out_a, in_b), (out_b, in_a) in system["bonds"]:
            (a, out_a_reference), (_, in_a_reference) = variable(out_a), variable(in_a)
            (b, out_b_reference), (_, in_b_reference) = variable(out_b), variable(in_b)
            bond = (a, out_a_reference, in_a_reference, b, out_b_reference, in_b_reference)
            succeed(algorithm.add_power_bond(*bond) >= 0)
            # ECCO reads them as they are observed.
            watched |= {out_a, in_b, out_b, in_a}
    for path in watched:
        succeed(observer.start_time_series(*variable(path), CosimVariableType.REAL))
    succeed(execution.simulate_until(round(system["stop"] * NANOSECONDS)))
    series = []
    for path in system["outputs"]:
        times, steps, values = observer.time_series_real_samples(*variable(path), 1, 100000)
        count = max(index for index, step in enumerate(steps) if step) + 1
        series.append(([time / NANOSECONDS for time in times[:count]], values[:count]))
    return series


def at_end(system, series):
    """Values at the end: ECCO's last step may go beyond it."""
    return [value_at(system["stop"], times, values) for times, values in series]


def value_at(end, times, values):
    for index in range(1, len(times)):
        if times[index] >= end - 1 / NANOSECONDS:
            before, after = times[index - 1], times[index]
            share = (end - before) / (after - before)
            return values[index - 1] + share * (values[index] - values[index - 1])
    raise RuntimeError(f"expected samples until {end} s, found them until {times[-1]} s")


def ecospy_local(system, folder):
    """Ecos, all units in this process: Jacobi in parallel, fixed step."""
    return ecos(system, "")


def ecospy_proxy(system, folder):
    """Ecos with a process per unit."""
    return ecos(system, "proxyfmu://localhost?file=")


def ecos(system, scheme):
    prepare_ecos()
    from ecospy import EcosLib, EcosSimulation, EcosSimulationStructure

    EcosLib.set_log_level("warn")
    with EcosSimulationStructure() as coupled:
        for unit, data in system["units"].items():
            coupled.add_model(unit, scheme + data["fmu"])
        for source, sink in system["connections"]:
            coupled.make_real_connection("::".join(split(source)), "::".join(split(sink)))
        coupled.add_parameter_set("start", {f"{unit}::{name}": value for unit, name, value in starts(system)})
        with EcosSimulation(structure=coupled, step_size=system["step"]) as simulation:
            if not simulation.init(parameter_set="start"):
                raise RuntimeError(EcosLib.get_last_error())
            simulation.step(round(system["stop"] / system["step"]))
            values = [simulation.get_real("::".join(split(path))) for path in system["outputs"]]
            simulation.terminate()
    return values


def prepare_ecos():
    """Its library wants one of Intel's that lies beside it in no search path, and its programs come
    from the wheel without leave to run."""
    tbb = Path(sysconfig.get_paths()["data"]) / "lib" / "libtbb.so.12"
    if tbb.exists():
        ctypes.CDLL(str(tbb), mode=ctypes.RTLD_GLOBAL)
    for program in (Path(sysconfig.get_paths()["purelib"]) / "ecospy" / "binaries").glob("*"):
        program.chmod(program.stat().st_mode | stat.S_IXUSR)


def container_sequential(system, folder):
    """FMU Manipulation Toolbox: the system as one FMU whose units step one after the other."""
    return container(system, folder, sequential=True)


def container_threaded(system, folder):
    """The same with a thread per unit."""
    return container(system, folder, mt=True)


def container(system, folder, **options):
    from fmpy import simulate_fmu
    from fmu_manipulation_toolbox.assembly import Assembly

    for unit, data in system["units"].items():
        shutil.copy(data["fmu"], folder / f"{unit}.fmu")
    file = lambda path: [f"{split(path)[0]}.fmu", split(path)[1]]
    # A linked output is in the container already, under its own name.
    names = [f"output{number}" for number in range(len(system["outputs"]))]
    description = {
        "name": "coupled.fmu",
        "fmu": [f"{unit}.fmu" for unit in system["units"]],
        "link": [[*file(source), *file(sink)] for source, sink in system["connections"]],
        "output": [[*file(path), name] for path, name in zip(system["outputs"], names)],
        "start": [[f"{unit}.fmu", name, value] for unit, name, value in starts(system)],
        "step_size": system["step"],
        "auto_link": False,
        "auto_input": False,
        "auto_output": False,
        **options,
    }
    (folder / "coupled.json").write_text(json.dumps(description), encoding="utf-8")
    Assembly("coupled.json", fmu_directory=folder).make_fmu()
    result = simulate_fmu(
        str(folder / "coupled.fmu"),
        stop_time=system["stop"],
        step_size=system["step"],
        output_interval=system["step"],
        output=names,
    )
    return [float(result[name][-1]) for name in names]


def fmpy_lines(system, folder):
    """fmpy's plain calls, Jacobi, fixed step: inputs go on along lines, as first derivatives of outputs say."""
    return asking(system, 1)


def fmpy_parabolas(system, folder):
    """The same along parabolas, by first and second derivatives."""
    return asking(system, 2)


def asking(system, degree):
    from schemes import Asking, interface

    master = Asking(interface(system), degree)
    for number in range(round(system["stop"] / system["step"])):
        master.step(number * system["step"], system["step"])
    units = master.interface.units
    ends = map(split, system["outputs"])
    return [units[unit].getReal([units[unit].numbers[name]])[0] for unit, name in ends]


MASTERS = {
    master.__name__: master
    for master in (
        fmpy_lines,
        fmpy_parabolas,
        fmpy_ssp,
        libcosimpy_fixed,
        libcosimpy_ssp,
        libcosimpy_ecco,
        ecospy_local,
        ecospy_proxy,
        container_sequential,
        container_threaded,
    )
}

if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        # Masters print what they please; the answer alone goes where it was asked for.
        answer = os.dup(1)
        os.dup2(2, 1)
        values = MASTERS[sys.argv[1]](json.load(sys.stdin), Path(folder))
        os.write(answer, json.dumps(values).encode())
