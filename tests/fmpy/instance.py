"""One FMU and its instances, called through fmpy's plain FMI 2.0 interface."""

from ctypes import byref
from itertools import count
from pathlib import Path

from fmpy import calloc, extract, free, read_model_description
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import (
    FMU2Slave,
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
)
from fmpy.logging import addLoggerProxy


class Fmu:
    """An FMU, extracted to a folder."""

    def __init__(self, path, folder):
        self.path = Path(path)
        self.folder = Path(folder)
        extract(path, folder)
        self.description = read_model_description(path)
        self.variables = {v.name: v for v in self.description.modelVariables}
        # Runs that claims share, by what they were given.
        self.records = {}

    def variable(self, name):
        if name not in self.variables:
            known = ", ".join(self.variables)
            raise AssertionError(f"{self.path.name}: expected a variable, found {name!r}; there are {known}")
        return self.variables[name]

    def names(self, *causalities):
        """Names of the variables with one of these causalities."""
        return [name for name, v in self.variables.items() if v.causality in causalities]


# fmpy formats log messages in a library of its own that knows only one logger a process, the last
# one it was given. So all instances share one, and the environment tells them apart.
LIVING = {}
KEYS = count(1)


def log(environment, _name, _status, _category, message):
    LIVING[environment].messages.append(message.decode())


LOGGER = fmi2CallbackLoggerTYPE(log)


def callbacks(environment, memory):
    """Callbacks of one instance, with or without functions for memory."""
    functions = fmi2CallbackFunctions()
    functions.logger = LOGGER
    functions.componentEnvironment = environment
    if memory:
        functions.allocateMemory = fmi2CallbackAllocateMemoryTYPE(calloc)
        functions.freeMemory = fmi2CallbackFreeMemoryTYPE(free)
    addLoggerProxy(byref(functions))
    return functions


class Instance:
    """An instance that records what it logs; a context manager that frees it."""

    def __init__(
        self, fmu, *, name="instance", guid=None, folder=None, logging=True, memory=True, resources=True
    ):
        self.fmu = fmu
        self.messages = []
        self.key = next(KEYS)
        LIVING[self.key] = self
        self.slave = FMU2Slave(
            guid=guid or fmu.description.guid,
            unzipDirectory=str(folder or fmu.folder),
            modelIdentifier=fmu.description.coSimulation.modelIdentifier,
            instanceName=name,
        )
        if not resources:
            make = self.slave.fmi2Instantiate
            self.slave.fmi2Instantiate = lambda name, kind, guid, _, *rest: make(name, kind, guid, None, *rest)
        try:
            self.slave.instantiate(callbacks=callbacks(self.key, memory), loggingOn=logging)
        except Exception as error:
            self.slave.freeLibrary()
            del LIVING[self.key]
            raise InstantiationError("\n".join(self.messages)) from error

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.slave.freeInstance()
        del LIVING[self.key]

    def initialize(self, values=None, *, start_time=0.0, stop_time=None):
        """From instantiated to ready for steps: parameters before initialization, inputs during it."""
        values = dict(values or {})
        inputs = {n: values.pop(n) for n in list(values) if self.fmu.variable(n).causality == "input"}
        self.slave.setupExperiment(startTime=start_time, stopTime=stop_time)
        self.set(values)
        self.slave.enterInitializationMode()
        self.set(inputs)
        self.slave.exitInitializationMode()
        return self

    def set(self, values):
        for name, value in values.items():
            variable = self.fmu.variable(name)
            if variable.type == "Integer":
                if int(value) != value:
                    raise AssertionError(f"{name}: expected an integer, found {value}")
                self.slave.setInteger([variable.valueReference], [int(value)])
            else:
                self.slave.setReal([variable.valueReference], [value])

    def get(self, names):
        """Values of real variables, in order."""
        return self.slave.getReal([self.fmu.variable(name).valueReference for name in names])

    def outputs(self):
        return self.get(self.fmu.names("output"))

    def steps(self, stop_time, step, start_time=0.0):
        """Steps to `stop_time`, yielding each communication point after it is reached."""
        time, count = start_time, 0
        # The last communication point may be nearer than a step, but never by roundoff alone.
        while time < stop_time - 1e-9 * step:
            count += 1
            following = min(start_time + count * step, stop_time)
            if stop_time - following < 1e-9 * step:
                following = stop_time
            self.step(time, following - time)
            time = following
            yield time

    def step(self, time, step):
        try:
            self.slave.doStep(time, step)
        except FMICallException as error:
            error.add_note("\n".join(["the FMU logged:", *self.messages[-5:]]))
            raise

    def run(self, stop_time, step, start_time=0.0):
        """Outputs at every communication point after `start_time`."""
        return [self.outputs() for _ in self.steps(stop_time, step, start_time)]


class InstantiationError(Exception):
    """fmi2Instantiate returned NULL; the text is what the FMU logged."""
