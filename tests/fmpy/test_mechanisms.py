"""Scenes with many bodies: driven inputs, states of every scene, and what cannot be built or goes wrong."""

import json
import math
import re

import pytest
from conftest import FEW, MECHANISM, ROOT, all_scenes, place_of
from fmpy.fmi1 import FMICallException
from instance import Instance
from plot import read_table
from project import xtask

CASES = ROOT / "tests" / "cases"
DISCARD, ERROR = 2, 3
LAST_SUCCESSFUL_TIME = 2
# Communication steps before and after a state is saved.
STEPS = 3


def shipped():
    return [path for path in all_scenes() if path.parent == ROOT / "scenes"]


def experiment(fmu):
    experiment = fmu.description.defaultExperiment
    return float(experiment.stopTime), float(experiment.stepSize)


@pytest.mark.parametrize("path", shipped(), ids=place_of)
def test_shipped_scenes_run_to_their_stop_time(path, fmu_of):
    fmu = fmu_of(path)
    with Instance(fmu) as instance:
        instance.slave.setDebugLogging(True, ["logStatusWarning", "logStatusError"])
        instance.messages.clear()
        instance.initialize()
        rows = [instance.outputs(), *instance.run(*experiment(fmu))]
        # What the tolerance does not hold is told, once an output, and shapes that nothing is read of; nothing else is.
        doubtful = r"\S+: errors of the steps may be \S+ of its largest change, \S+ is wanted; .*"
        is_partly_read = "of" in (json.loads(path.read_text()).get("accuracy") or {})
        doubtful = re.compile(f"{doubtful}|resolution: .*" if is_partly_read else doubtful)
        assert [message for message in instance.messages if not doubtful.fullmatch(message)] == []
        assert len(set(instance.messages)) == len(instance.messages)
    assert all(math.isfinite(value) for row in rows for value in row)


def few():
    """Scenes of the few cases that run through their FMUs in every run of the tests."""
    return [path for path in all_scenes() if path.parent.parent == CASES and path.parent.name in FEW]


@pytest.mark.parametrize("path", [*shipped(), *few()], ids=place_of)
def test_an_fmu_answers_what_the_program_does(path, fmu_of, tmp_path):
    """The planned scene that the FMU holds, simulated by the program: the same numbers, but for roundoff of the times of points."""
    fmu = fmu_of(path)
    table = tmp_path / "native.csv"
    xtask("simulate", fmu.folder / "resources" / "scene.json", "--output", table)
    native = read_table(table)
    stop, step = experiment(fmu)
    with Instance(fmu) as instance:
        instance.initialize()
        rows = [instance.outputs(), *instance.run(stop, step)]
    names = fmu.names("output")
    assert names == [name for name in native if name != "time"]
    assert len(rows) == len(native["time"])
    for name, column in zip(names, zip(*rows)):
        size = max(abs(value) for value in native[name])
        assert list(column) == pytest.approx(list(native[name]), rel=0, abs=1e-12 * max(size, 1)), name


def go_on(instance, first, step):
    """Steps during which every input moves a little."""
    starts = {name: float(v.start) for name, v in instance.fmu.variables.items() if v.causality == "input"}
    rows = []
    for number in range(first, first + STEPS):
        instance.set({name: start + 1e-3 * (number + 1) for name, start in starts.items()})
        rows += instance.run((number + 1) * step, step, number * step)
    return rows


@pytest.mark.parametrize("path", all_scenes(), ids=place_of)
def test_every_scene_goes_on_from_a_state_with_the_same_bits(path, fmu_of):
    fmu = fmu_of(path)
    _, step = experiment(fmu)
    with Instance(fmu) as instance, Instance(fmu) as other:
        before = go_on(instance.initialize(), 0, step)
        state = instance.slave.getFMUstate()
        expected = go_on(instance, STEPS, step)
        assert all(math.isfinite(value) for row in before + expected for value in row)
        instance.slave.setFMUstate(state)
        assert go_on(instance, STEPS, step) == expected
        blob = instance.slave.serializeFMUstate(state)
        other.slave.setFMUstate(other.slave.deSerializeFMUstate(blob))
        assert other.outputs() == before[-1]
        assert go_on(other, STEPS, step) == expected


def drive(time):
    """A smooth way with its first two derivatives."""
    return [0.2 * (1.0 - math.cos(3.0 * time)), 0.6 * math.sin(3.0 * time), 1.8 * math.cos(3.0 * time)]


@pytest.mark.parametrize("derivatives", [0, 1, 2])
def test_motion_inputs_move_smoothly(edited, derivatives):
    fmu = edited(MECHANISM, lambda scene: scene["motions"][0].update(value={"input": derivatives}))
    inputs = ["feed.displacement", "feed.velocity", "feed.acceleration"][: derivatives + 1]
    motion = ["cart.centre.velocity[1]", "arm.root.velocity[1]", "shoulder.angular_velocity"]
    step = 0.02
    with Instance(fmu) as instance:
        instance.initialize(dict(zip(inputs, drive(0.0))))
        most = 0.0
        before = instance.get(motion)
        for number in range(50):
            time = number * step
            # A value alone is the one to reach; with derivatives they are those of now.
            given = drive(time) if derivatives else drive(time + step)
            instance.set(dict(zip(inputs, given)))
            assert instance.get(motion) == before, "an input that jumps moves nothing at once"
            instance.step(time, step)
            after = instance.get(motion)
            most = max(most, abs(after[0] - before[0]))
            before = after
            wanted = sum(step**k / math.factorial(k) * given[k] for k in range(derivatives + 1))
            cart, arm = instance.get(["cart.centre.position[1]", "arm.root.position[1]"])
            assert cart == pytest.approx(wanted, abs=1e-12)
            assert arm == pytest.approx(cart, abs=1e-12)
        assert instance.get(["feed.displacement"])[0] == given[0]
        assert before[0] == pytest.approx(drive(50 * step)[1], abs=0.05)
    # The largest acceleration of the drive is 1.8 m/s^2.
    assert most < 1.5 * 1.8 * step


def test_inputs_of_springs_and_hinges_work(edited):
    fmu = edited(MECHANISM, lambda scene: None)
    energies = ["energy.kinetic", "energy.strain", "energy.gravity", "energy.spring", "energy.dissipated"]
    names = [name for name in energies if name in fmu.variables]
    assert "energy.spring" in names
    with Instance(fmu) as instance:
        instance.initialize()
        start = math.fsum(instance.get(names))
        for number in range(50):
            instance.set({"hoist.rest_length": 0.9 - 0.002 * number, "shoulder.torque": 0.1 * number})
            instance.step(number * 0.02, 0.02)
        gained = math.fsum(instance.get(names)) - start
        (work,) = instance.get(["energy.input"])
        assert abs(work) > 0.1
        assert gained == pytest.approx(work, abs=1e-3)


LOOP = ("pivot", "crank_pin", "rocker_pin", "rocker_pivot")


def test_a_loop_that_cannot_close_names_its_joints(edited):
    def part(scene):
        (far,) = [joint for joint in scene["joints"] if joint["name"] == "rocker_pivot"]
        far["point"] = [5.0, 0.0]

    with pytest.raises(AssertionError) as failure:
        edited(ROOT / "scenes" / "four_bar.json", part)
    message = str(failure.value)
    assert "fit together" in message
    assert all(name in message for name in LOOP)


def test_a_loop_that_an_input_opens_names_its_joints(edited):
    def drive(scene):
        scene["motions"] = [{"name": "drag", "kind": "position", "marker": "rocker.pin", "value": {"input": 0}}]
        # Nothing is left to plan.
        scene["bodies"][1]["elements"] = 4
        scene["accuracy"] = {}

    with Instance(edited(ROOT / "scenes" / "four_bar.json", drive)) as instance:
        with pytest.raises(FMICallException) as failure:
            instance.initialize({"drag.position[1]": 5.0, "drag.position[2]": 0.0})
        message = "\n".join(instance.messages)
    assert failure.value.status == ERROR
    assert "fit together" in message
    assert all(name in message for name in (*LOOP, "drag"))


def test_a_motion_of_what_is_held_is_refused_with_its_place(edited):
    def hold(scene):
        motion = {"name": "push", "kind": "position", "marker": "crank.pin", "value": ["t", 0.0]}
        scene["motions"].append(motion)

    with pytest.raises(AssertionError) as failure:
        edited(ROOT / "scenes" / "slider_crank.json", hold)
    assert "motions[1]: expected a motion of what joints and other motions leave free" in str(failure.value)


def test_a_ring_that_runs_off_its_rope_stops_there(edited):
    fmu = edited(CASES / "ring_on_rope" / "coasting.json", lambda scene: None)
    step = 0.05
    with Instance(fmu) as instance:
        instance.initialize()
        time, state = 0.0, None
        with pytest.raises(FMICallException) as failure:
            for number in range(1000):
                state = instance.slave.getFMUstate()
                instance.step(number * step, step)
                time = (number + 1) * step
        assert failure.value.status == DISCARD
        assert "sliding" in instance.messages[-1]
        assert "left its cable" in instance.messages[-1]
        last = instance.slave.getRealStatus(LAST_SUCCESSFUL_TIME)
        assert time <= last < 1.7 / 1.5 + 1e-9, "the bar ends 1.7 m on, at 1.5 m/s"
        now, travel = instance.get(["time", "sliding.travel"])
        assert now == last
        assert travel <= 2.0 + 1e-9
        # From the state before, shorter steps lead nearer to the end.
        instance.slave.setFMUstate(state)
        if last > time:
            instance.step(time, 0.5 * (last - time))
        assert all(math.isfinite(value) for value in instance.outputs())


def test_a_joint_that_repeats_another_is_reported_and_runs(edited):
    def repeat(scene):
        (pivot,) = [joint for joint in scene["joints"] if joint["name"] == "pivot"]
        scene["joints"].append({**pivot, "name": "again"})

    fmu = edited(ROOT / "scenes" / "double_pendulum.json", repeat)
    with Instance(fmu) as instance:
        instance.initialize()
        reports = [message for message in instance.messages if "again" in message]
        assert len(reports) == 1
        rows = instance.run(0.2, 0.02)
        assert all(math.isfinite(value) for row in rows for value in row)
        reactions = instance.get(["pivot.reaction[1]", "pivot.reaction[2]"])
    with Instance(edited(ROOT / "scenes" / "double_pendulum.json", lambda scene: None)) as instance:
        instance.initialize()
        expected = instance.run(0.2, 0.02)
        assert rows[-1] == pytest.approx(expected[-1], rel=1e-6, abs=1e-6)
        assert instance.get(["pivot.reaction[1]", "pivot.reaction[2]"]) == pytest.approx(reactions, rel=1e-6)
