"""Every capability that the model description states is true: exercised on the FMU of every ready scene.

Derivatives are held against differences, which the interface gives by saving, changing and restoring.
"""

import json
import math
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import IS_WHOLE, ROOT, all_scenes, place_of
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import fmi2CallbackAllocateMemoryTYPE, fmi2CallbackFreeMemoryTYPE, fmi2StepFinishedTYPE
from instance import Instance, callbacks
from lxml import etree

FLAGS = {
    "needsExecutionTool": "false",
    "canHandleVariableCommunicationStepSize": "true",
    "canInterpolateInputs": "true",
    "maxOutputDerivativeOrder": "2",
    "canRunAsynchronuously": "false",
    "canBeInstantiatedOnlyOncePerProcess": "false",
    "canNotUseMemoryManagementFunctions": "true",
    "canGetAndSetFMUstate": "true",
    "canSerializeFMUstate": "true",
    "providesDirectionalDerivative": "true",
}
# Tight, so that what the integrator leaves out stays below what is looked for.
TOLERANCE = 1e-11
# Communication steps to a state in motion.
STEPS = 5
# Most elements of a body here: vibrations of finer meshes are too quick for differences.
COARSE = 8
ERROR = 3
LOADS = {"N", "N.m", "N/m"}


# Their meshes take most of the time of all scenes at this tolerance: they are for releases.
FINE = () if IS_WHOLE else ("cylinder_shell", "solar_array", "unfolding_mast")


def ready(path):
    return path.parent in (ROOT / "scenes", Path(__file__).parent) and path.stem not in FINE


@pytest.fixture(scope="module", params=[path for path in all_scenes() if ready(path)], ids=place_of)
def fmu(request, fmu_of):
    return fmu_of(request.param)


@pytest.fixture
def moving(fmu):
    """An instance in motion under inputs that have left their start values, and its time and step."""
    with Instance(fmu) as instance:
        instance.slave.setDebugLogging(False, [])
        yield instance, *started(instance, STEPS)


def started(instance, steps, step=None):
    """Initializes and steps; the time then, and the step."""
    step = step or 0.2 * float(instance.fmu.description.defaultExperiment.stepSize)
    for name in instance.fmu.names("parameter"):
        if name.endswith(".elements"):
            instance.set({name: min(COARSE, int(instance.fmu.variable(name).start))})
    instance.initialize({"relative_tolerance": TOLERANCE})
    advance(instance, range(steps), step)
    return steps * step, step


def advance(instance, numbers, step):
    """Makes communication steps, by their numbers."""
    for number in numbers:
        instance.set({name: value + pushed(name, value) for name, value in starts(instance.fmu).items()})
        instance.step(number * step, step)


def starts(fmu):
    return {name: float(fmu.variable(name).start) for name in fmu.names("input")}


def pushed(name, start):
    """A small change of an input: a hundredth of it, or of one; what a motion drives keeps its way."""
    return 0.01 * max(1.0, abs(start)) if "force" in name or "moment" in name or "torque" in name else 0.0


def reach(fmu, name, load):
    """How far an input is changed for a difference: outputs are linear in loads, and in nothing else for sure."""
    return load if fmu.variable(name).unit in LOADS else 1e-4


def references(fmu, names):
    return [fmu.variable(name).valueReference for name in names]


def dependencies(fmu):
    """What the model description says: names of inputs by output."""
    names = list(fmu.variables)
    root = etree.parse(fmu.folder / "modelDescription.xml").getroot()
    listed = root.iterfind("ModelStructure/Outputs/Unknown")
    return {
        names[int(unknown.get("index")) - 1]: {names[int(i) - 1] for i in unknown.get("dependencies").split()}
        for unknown in listed
    }


def changes(instance, name, change):
    """How all outputs change with an input at this communication point: a central difference."""
    (value,) = instance.get([name])
    ends = []
    for end in (value + change, value - change):
        state = instance.slave.getFMUstate()
        instance.set({name: end})
        ends.append(instance.outputs())
        instance.slave.setFMUstate(state)
        instance.slave.freeFMUstate(state)
    return [(after - before) / (2.0 * change) for after, before in zip(*ends)]


@pytest.mark.parametrize("flag", FLAGS)
def test_the_flags_are_stated(fmu, flag):
    slave = etree.parse(fmu.folder / "modelDescription.xml").find("CoSimulation")
    assert slave.get(flag) == FLAGS[flag]


def test_dependencies_are_the_truth(fmu):
    """An output reacts at once to what it is said to depend on, somewhere, and to nothing else, anywhere."""
    said, outputs = dependencies(fmu), fmu.names("output")
    reacting = {name: set() for name in outputs}
    with Instance(fmu) as instance:
        (_, step), done = started(instance, 0), 0
        for steps in (0, 1, STEPS, 4 * STEPS):
            advance(instance, range(done, steps), step)
            done = steps
            for name in fmu.names("input"):
                # Far away along a chain a reaction is below the last digit of a difference.
                exact = instance.slave.getDirectionalDerivative(
                    references(fmu, outputs), references(fmu, [name]), [1.0]
                )
                for output, change, by in zip(outputs, changes(instance, name, reach(fmu, name, 1e3)), exact):
                    if change != 0.0 or by != 0.0:
                        reacting[output].add(name)
    for output in outputs:
        assert reacting[output] <= said[output], output
        # A component of a reaction, or the axis of a cable, may be perpendicular to all that acts on it here.
        perpendicular = ".reaction[" in output or ".reaction_moment[" in output or output.endswith(".axial_force")
        # A latch that is open exerts nothing.
        is_open = output.endswith((".latch_force", ".latch_torque"))
        assert reacting[output] or not said[output] or perpendicular or is_open, output


def test_directional_derivatives_are_those_of_differences(moving):
    instance, _, _ = moving
    fmu, before = instance.fmu, instance.outputs()
    outputs, inputs = fmu.names("output"), fmu.names("input")
    unknowns, columns = references(fmu, outputs), {}
    for name in inputs:
        change = reach(fmu, name, 0.1 * max(1.0, abs(starts(fmu)[name])))
        differences = changes(instance, name, change)
        found = instance.slave.getDirectionalDerivative(unknowns, references(fmu, [name]), [1.0])
        columns[name] = found
        for output, value, now, wanted in zip(outputs, found, before, differences):
            allowed = 1e-6 * abs(wanted) + 1e-11 * max(1.0, abs(now)) / change
            assert abs(value - wanted) <= allowed, f"{output} by {name}: {value} is not {wanted}"
    if inputs:
        # Along several inputs at once, the sum; nothing was disturbed.
        seeds = [1.0 + number for number in range(len(inputs))]
        found = instance.slave.getDirectionalDerivative(unknowns, references(fmu, inputs), seeds)
        for number, value in enumerate(found):
            parts = [seed * columns[name][number] for seed, name in zip(seeds, inputs)]
            assert value == pytest.approx(sum(parts), rel=1e-9, abs=1e-12 * sum(map(abs, parts)) + 1e-300)
    assert instance.outputs() == before


def courses(instance, time, near, count):
    """Outputs at points of time around `time`, `near` apart, the middle one at `time`.

    Inputs that change by roundoff end a step at every point: within a step that leads beyond them points are as accurate as
    the tolerance says, of which second differences make much.
    """
    rows, inputs = [], instance.fmu.names("input")
    held = dict(zip(inputs, instance.get(inputs)))
    for number in range(count):
        at = time + (number - count // 2) * near
        if number > 0:
            instance.set({name: math.nextafter(value, value + number % 2) for name, value in held.items()})
            instance.step(at - near, near)
        rows.append(instance.outputs())
    return rows


def differences(rows, near):
    """First and second derivative at the middle of five rows, of fourth order."""
    first = [(a - 8 * b + 8 * d - e) / (12 * near) for a, b, _, d, e in zip(*rows)]
    second = [(-a + 16 * b - 30 * c + 16 * d - e) / (12 * near**2) for a, b, c, d, e in zip(*rows)]
    return first, second


def test_output_derivatives_are_those_of_differences(moving):
    instance, time, step = moving
    fmu, outputs = instance.fmu, instance.fmu.names("output")
    state = instance.slave.getFMUstate()
    told = {}
    for near in (0.02 * step, 0.01 * step, 0.005 * step):
        instance.slave.setFMUstate(state)
        rows = courses(instance, time + 2 * near, near, 5)
        told[near] = differences(rows, near)
    # Rounding of one component of a vector is in the others too.
    vectors = [name.split("[")[0] for name in outputs]
    sizes = [max(map(abs, column)) for column in zip(*rows)]
    sizes = [max(size for size, other in zip(sizes, vectors) if other == vector) for vector in vectors]
    coarse, fine, finer = told.values()
    instance.slave.setFMUstate(state)
    near = 0.01 * step
    for number in range(2):
        instance.step(time + number * near, near)
    checked = 0
    for order in (1, 2):
        found = instance.slave.getRealOutputDerivatives(references(fmu, outputs), [order] * len(outputs))
        for number, name in enumerate(outputs):
            value, wanted = found[number], fine[order - 1][number]
            apart = max(abs(wanted - other[order - 1][number]) for other in (coarse, finer))
            # Only where differences agree they are a measure: a stiff part may be too quick for them.
            if apart <= 5e-3 * abs(wanted):
                roundoff = 8 * sys.float_info.epsilon * sizes[number] / near**order
                allowed = 10.0 * apart + 1e-6 * abs(wanted) + roundoff + 1e-9
                assert abs(value - wanted) <= allowed, f"{order} {name}"
                checked += 1
    assert checked > 0


def test_derivatives_of_positions_are_velocities(moving):
    instance, time, step = moving
    fmu, outputs = instance.fmu, instance.fmu.names("output")
    pairs = {"position": ("velocity", "acceleration"), "angle": ("angular_velocity", None)}
    for name in outputs:
        for key, others in pairs.items():
            for order, other in enumerate(others, start=1):
                rate = name.replace(f".{key}", f".{other}")
                if rate != name and rate in outputs:
                    (found,) = instance.slave.getRealOutputDerivatives(references(fmu, [name]), [order])
                    assert found == pytest.approx(instance.get([rate])[0], rel=1e-9, abs=1e-12)
    found = instance.slave.getRealOutputDerivatives(references(fmu, outputs), [3] * len(outputs))
    assert found == [0.0] * len(outputs)


def test_inputs_move_in_a_step_as_their_derivatives_say(moving):
    """A step with derivatives is the limit of many short ones with the input held at its middle values."""
    instance, time, step = moving
    fmu = instance.fmu
    inputs = [name for name in fmu.names("input") if fmu.variable(name).unit in LOADS]
    if not inputs:
        return
    size = [max(1.0, abs(starts(fmu)[name])) for name in inputs]
    before, state = instance.get(inputs), instance.slave.getFMUstate()

    def at(now):
        share = now / step
        return {n: v + s * (0.3 * share - 0.4 * share**2) for n, v, s in zip(inputs, before, size)}

    def held(count):
        instance.slave.setFMUstate(state)
        near = step / count
        for number in range(count):
            instance.set(at((number + 0.5) * near))
            instance.step(time + number * near, near)
        instance.set(at(step))
        return instance.outputs()

    def led():
        instance.slave.setFMUstate(state)
        instance.set(at(0.0))
        vr = references(fmu, inputs)
        instance.slave.setRealInputDerivatives(vr, [1] * len(vr), [0.3 * s / step for s in size])
        instance.slave.setRealInputDerivatives(vr, [2] * len(vr), [-0.8 * s / step**2 for s in size])
        instance.step(time, step)
        instance.set(at(step))
        return instance.outputs()

    alone, coarse, fine, found = held(1), held(16), held(32), led()
    improved = 0
    for name, start, rough, limit, value in zip(fmu.names("output"), alone, coarse, fine, found):
        allowed = 0.02 * abs(start - limit) + 5.0 * abs(limit - rough) + 1e-7 * max(1e-3, abs(limit))
        assert abs(value - limit) <= allowed, name
        improved += abs(value - limit) < 0.01 * abs(start - limit)
    assert improved > 0
    # The derivatives belong to that step: in the next one the input is held.
    after = instance.slave.getFMUstate()
    instance.step(time + step, step)
    expected = instance.outputs()
    instance.slave.setFMUstate(after)
    vr = references(fmu, inputs)
    instance.slave.setRealInputDerivatives(vr, [1] * len(vr), [0.0] * len(vr))
    instance.step(time + step, step)
    assert instance.outputs() == expected


def test_steps_may_vary(fmu):
    found = []
    names = [n for n in fmu.names("output") if fmu.variable(n).unit in ("m", "rad") and "residual" not in n]
    for shares in ([1.0] * 6, [0.5, 1.0, 0.25, 2.0, 0.01, 1.24, 1.0]):
        with Instance(fmu) as instance:
            _, step = started(instance, 0)
            time = 0.0
            for share in shares:
                instance.step(time, share * step)
                time += share * step
            found.append(instance.get(["time", *names]))
    assert found[0][0] == pytest.approx(found[1][0], rel=1e-15)
    assert found[0] == pytest.approx(found[1], rel=1e-6, abs=1e-7)


def test_memory_is_the_librarys_own(swing, monkeypatch):
    """The master's functions for memory and for the end of a step in the background are never called."""
    called = []

    def counting(environment, _memory):
        functions = callbacks(environment, False)
        functions.allocateMemory = fmi2CallbackAllocateMemoryTYPE(lambda *_: called.append("allocateMemory"))
        functions.freeMemory = fmi2CallbackFreeMemoryTYPE(lambda *_: called.append("freeMemory"))
        functions.stepFinished = fmi2StepFinishedTYPE(lambda *_: called.append("stepFinished"))
        return functions

    monkeypatch.setattr("instance.callbacks", counting)
    with Instance(swing) as instance:
        instance.initialize().run(0.2, 0.05)
        blob = instance.slave.serializeFMUstate(instance.slave.getFMUstate())
        instance.slave.setFMUstate(instance.slave.deSerializeFMUstate(blob))
        # No step is ever in progress: there is nothing to cancel.
        with pytest.raises(FMICallException) as failure:
            instance.slave.cancelStep()
        assert failure.value.status == ERROR
    assert called == []


def test_no_tool_is_needed(swing, tmp_path):
    """A process with no environment, in an empty folder, simulates."""
    with Instance(swing) as instance:
        instance.initialize().run(0.2, 0.05)
        state = instance.slave.getFMUstate()
        (tmp_path / "state").write_bytes(instance.slave.serializeFMUstate(state))
        expected = instance.run(0.4, 0.05, 0.2)
    script = Path(__file__).with_name("resume.py")
    command = [sys.executable, script, swing.path, tmp_path / "state", "0.2", "0.4", "0.05"]
    result = subprocess.run(command, cwd=tmp_path, env={}, capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stderr
    assert json.loads(result.stdout) == expected
