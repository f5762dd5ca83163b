"""What a worker of a cluster does: one instance of a unit (FMU), reset from run to run."""

import json
import math
import shutil
import tempfile
import threading
import time
from ctypes import byref
from io import BytesIO
from itertools import pairwise
from pathlib import Path

from distributed import WorkerPlugin, get_worker
from fmpy import calloc, extract, free, read_model_description
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import (
    FMU2Slave,
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
    fmi2OK,
)
from fmpy.logging import addLoggerProxy

# Categories that say why a call failed.
CATEGORIES = ["logStatusError", "logStatusWarning"]
# Part of a step that is roundoff.
ROUNDOFF = 1e-9


class Failure(Exception):
    """A run that failed, with the reason that the unit gives."""


def communication_points(stop_time, step):
    """Times of a run, as `flexbody simulate` takes them: multiples, so that rounding does not add up."""
    steps = max(1, math.ceil(stop_time / step - ROUNDOFF))
    return [0.0] + [min(number * step, stop_time) for number in range(1, steps + 1)]


# Messages of the instance at work. The library that puts them together knows one logger a process.
MESSAGES = []


def _log(_environment, _instance, status, _category, message):
    if status > fmi2OK:
        MESSAGES.append(message.decode(errors="replace"))


LOGGER = fmi2CallbackLoggerTYPE(_log)


def _callbacks():
    functions = fmi2CallbackFunctions()
    functions.logger = LOGGER
    functions.allocateMemory = fmi2CallbackAllocateMemoryTYPE(calloc)
    functions.freeMemory = fmi2CallbackFreeMemoryTYPE(free)
    addLoggerProxy(byref(functions))
    return functions


class Unit:
    """An unpacked FMU and its one instance, made when it is first needed."""

    def __init__(self, fmu, folder):
        extract(fmu, unzipdir=str(folder))
        self.folder = folder
        self.description = read_model_description(str(folder))
        self.variables = {variable.name: variable for variable in self.description.modelVariables}
        self.slave = None
        # A worker may have several threads; the instance does one run at a time.
        self.lock = threading.Lock()

    def _instance(self):
        """An instance as new."""
        if self.slave is not None:
            try:
                self.slave.reset()
                return self.slave
            except FMICallException:
                # What cannot be reset must not be called any more: left as it is.
                self.slave = None
        slave = FMU2Slave(
            guid=self.description.guid,
            unzipDirectory=str(self.folder),
            modelIdentifier=self.description.coSimulation.modelIdentifier,
            instanceName=self.description.modelName,
        )
        self.callbacks = _callbacks()
        try:
            slave.instantiate(callbacks=self.callbacks, loggingOn=False)
        except BaseException:
            slave.freeLibrary()
            raise
        self.slave = slave
        slave.setDebugLogging(True, CATEGORIES)
        return slave

    def free(self):
        """Ends the instance."""
        slave, self.slave = self.slave, None
        if slave is not None:
            slave.freeInstance()

    def run(self, plan, values):
        """Times and outputs of one run, and what its steps gave reason to warn of."""
        with self.lock:
            MESSAGES.clear()
            try:
                return self._run(plan, values)
            except Exception as error:
                reason = "; ".join([*MESSAGES[-3:], *([] if MESSAGES else [str(error)])])
                raise Failure(reason) from error

    def _set(self, names_and_values):
        for name, value in names_and_values:
            variable = self.variables[name]
            if variable.type != "Integer":
                self.slave.setReal([variable.valueReference], [float(value)])
            elif int(value) == value:
                self.slave.setInteger([variable.valueReference], [int(value)])
            else:
                raise ValueError(f"{name}: expected an integer, found {value}")

    def _get(self, names):
        return self.slave.getReal([self.variables[name].valueReference for name in names])

    def _run(self, plan, values):
        slave = self._instance()
        slave.setupExperiment(startTime=0.0)
        self._set([*plan["fixed"].items(), *zip(plan["inputs"], values, strict=True)])
        slave.enterInitializationMode()
        slave.exitInitializationMode()
        MESSAGES.clear()
        times = communication_points(plan["stop_time"], plan["step"])
        rows, warnings = [self._get(plan["outputs"])], []
        for now, following in pairwise(times):
            slave.doStep(now, following - now)
            rows.append(self._get(plan["outputs"]))
            # Warnings of steps that were done are no reason of what fails later.
            warnings += MESSAGES
            MESSAGES.clear()
        return {"times": times, "values": rows, "warnings": warnings}


class UnitPlugin(WorkerPlugin):
    """Brings the FMU to every worker, also to those that come later; under a name that no other sweep has."""

    def __init__(self, name, content, plan):
        self.name = name
        self.content = content
        self.plan = plan

    def setup(self, worker):
        self.folder = Path(tempfile.mkdtemp(prefix="flexbody-", dir=worker.local_directory))
        self.unit = Unit(BytesIO(self.content), self.folder)
        # Unpacked, it takes memory no more.
        self.content = None

    def teardown(self, worker):
        self.unit.free()
        shutil.rmtree(self.folder, ignore_errors=True)


def result(number, outcome):
    """A line of JSON; floats are written as the shortest text that reads back to the same bits."""
    return json.dumps({"run": number, **outcome}, allow_nan=False)


def work(name, runs):
    """Some runs at a worker: the lines of their results, and how long they took, s."""
    plugin = get_worker().plugins[name]
    started = time.perf_counter()
    lines = [_line(plugin, run) for run in runs]
    return lines, time.perf_counter() - started


def _line(plugin, run):
    try:
        return result(run["run"], plugin.unit.run(plugin.plan, run["values"]))
    except Exception as error:
        return result(run["run"], {"error": str(error) or type(error).__name__})
