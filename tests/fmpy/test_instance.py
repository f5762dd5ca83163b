"""The life of an instance: start values, steps, many at once."""

from concurrent.futures import ThreadPoolExecutor

import pytest
from fmpy import simulate_fmu
from fmpy.fmi1 import FMICallException
from instance import Instance

STEP = 0.05
STOP = 0.5
DISCARD, ERROR = 2, 3


def run(fmu, values=None):
    with Instance(fmu) as instance:
        return instance.initialize(values).run(STOP, STEP)


PARAMETERS = {
    "rod.youngs_modulus": 5.0e5,
    "rod.density": 5000.0,
    "rod.damping_time": 1.0e-3,
    "rod.area": 2.0e-3,
    "rod.second_moment": 2.0e-8,
    "rod.elements": 7,
    "gravity[1]": 1.0,
    "gravity[2]": -1.62,
    "relative_tolerance": 1.0e-3,
    "rod.tip.force[1]": 1.0,
    "rod.tip.force[2]": -1.0,
    "rod.middle.moment": 0.0,
}


def test_every_start_value_is_tried(swing):
    # What bounds the work of a step changes no result that is within it.
    assert set(PARAMETERS) == set(swing.names("parameter", "input")) - {"work_limit"}


def test_a_step_beyond_the_work_limit_is_discarded(swing):
    with Instance(swing) as instance:
        instance.initialize({"work_limit": 10.0})
        with pytest.raises(FMICallException) as failure:
            instance.run(STOP, STEP)
        assert failure.value.status == DISCARD
        assert "work_limit = 1e1" in instance.messages[-1]


@pytest.mark.parametrize("name", PARAMETERS)
def test_start_values_change_the_run(swing, name):
    assert run(swing, {name: PARAMETERS[name]}) != run(swing)


def test_parameters_may_be_set_during_initialization(swing):
    values = {"rod.elements": 7, "rod.youngs_modulus": 5.0e5}
    with Instance(swing) as instance:
        instance.slave.setupExperiment()
        instance.slave.enterInitializationMode()
        instance.set(values)
        instance.slave.exitInitializationMode()
        assert instance.run(STOP, STEP) == run(swing, values)


@pytest.mark.parametrize(
    "name", [name for name in PARAMETERS if "rod.tip" not in name and "rod.middle" not in name]
)
def test_parameters_may_not_be_set_afterwards(swing, instance, name):
    instance.initialize()
    with pytest.raises(FMICallException) as failure:
        instance.set({name: PARAMETERS[name]})
    assert failure.value.status == ERROR
    assert name in instance.messages[-1]


@pytest.mark.parametrize("name", ["rod.youngs_modulus", "rod.density", "rod.area", "rod.elements"])
def test_impossible_parameters_are_refused(instance, name):
    with pytest.raises(FMICallException) as failure:
        instance.initialize({name: -1})
    assert failure.value.status == ERROR
    assert name.split(".")[-1] in "\n".join(instance.messages)


def test_what_was_set_can_be_read(instance):
    values = {"rod.youngs_modulus": 5.0e5, "rod.tip.force[1]": 2.5}
    instance.initialize(values)
    assert instance.get(values) == list(values.values())
    elements = instance.fmu.variable("rod.elements").valueReference
    assert instance.slave.getInteger([elements]) == [4]


def test_plain_fmpy_gives_the_same_run(swing):
    values = {"rod.density": 5000.0, "rod.tip.force[2]": -1.0}
    result = simulate_fmu(
        str(swing.path), stop_time=STOP, output_interval=STEP, start_values=values, relative_tolerance=1.0e-5
    )
    names = swing.names("output")
    expected = run(swing, values)
    assert len(result) == len(expected) + 1
    for row, wanted in zip(result[1:], expected):
        assert [row[name] for name in names] == pytest.approx(wanted, rel=1e-6, abs=1e-6)


def test_time_can_be_read(instance):
    instance.initialize(start_time=2.0)
    assert instance.get(["time"]) == [2.0]
    instance.run(2.5, STEP, start_time=2.0)
    assert instance.get(["time"]) == [2.5]


def test_interleaved_instances_do_not_meet(swing):
    alone = run(swing)
    with Instance(swing, name="a") as a, Instance(swing, name="b") as b:
        a.initialize()
        b.initialize({"rod.elements": 6, "gravity[2]": -3.0})
        found = []
        for _ in zip(a.steps(STOP, STEP), b.steps(STOP, STEP), strict=True):
            found.append(a.outputs())
    assert found == alone


def test_instances_in_threads_do_not_meet(swing):
    alone = run(swing)
    # Loading a library changes the working directory in fmpy, so instances are made one by one
    # and stepped at once: from other threads than the one that made them.
    instances = [Instance(swing, name=f"thread {i}") for i in range(8)]
    try:
        with ThreadPoolExecutor(max_workers=8) as threads:
            runs = list(threads.map(lambda instance: instance.initialize().run(STOP, STEP), instances))
    finally:
        for instance in instances:
            instance.__exit__()
    assert all(found == alone for found in runs)


def test_one_step_agrees_with_many(swing):
    names = ["rod.tip.position[1]", "rod.tip.position[2]"]
    found = []
    for step in (STOP, STEP, STEP / 7.0):
        with Instance(swing) as instance:
            instance.initialize().run(STOP, step)
            found.append(instance.get(names))
    # The scene asks for 1e-5 of the length in each step.
    assert found[0] == pytest.approx(found[1], abs=1e-3)
    assert found[1] == pytest.approx(found[2], abs=1e-3)


def test_inputs_act_at_once_on_what_depends_on_them(instance):
    instance.initialize().run(STOP, STEP)
    position, acceleration = "rod.tip.position[2]", "rod.tip.acceleration[2]"
    before = instance.get([position, acceleration])
    instance.set({"rod.tip.force[2]": 5.0})
    after = instance.get([position, acceleration])
    assert after[0] == before[0]
    assert after[1] > before[1]


def test_a_step_past_the_stop_time_is_an_error(instance):
    instance.initialize(stop_time=STOP)
    instance.run(STOP, STEP)
    with pytest.raises(FMICallException) as failure:
        instance.slave.doStep(STOP, STEP)
    assert failure.value.status == ERROR
    assert "stop" in instance.messages[-1].lower()


def test_roundoff_in_the_stop_time_is_forgiven(instance):
    # Added up, three steps of 0.1 end past 0.3.
    instance.initialize(stop_time=0.3)
    time = 0.0
    for _ in range(3):
        instance.slave.doStep(time, 0.1)
        time += 0.1
    assert time > 0.3
    assert instance.get(["time"]) == pytest.approx([0.3])


@pytest.mark.parametrize("step", [0.0, -STEP, float("nan"), float("inf")])
def test_impossible_steps_are_refused(instance, step):
    instance.initialize()
    with pytest.raises(FMICallException) as failure:
        instance.slave.doStep(0.0, step)
    assert failure.value.status == ERROR
    assert instance.messages


def test_steps_before_initialization_are_refused(instance):
    with pytest.raises(FMICallException) as failure:
        instance.slave.doStep(0.0, STEP)
    assert failure.value.status == ERROR
    assert "fmi2DoStep" in instance.messages[-1]


def test_terminated_instances_still_answer(instance):
    expected = instance.initialize().run(STOP, STEP)[-1]
    instance.slave.terminate()
    assert instance.outputs() == expected
