"""State get, set and serialization: the continuation has the same bits, foreign bytes are refused."""

import json
import subprocess
import sys
from pathlib import Path

import pytest
from fmpy.fmi1 import FMICallException
from instance import Instance

STEP = 0.05
SAVED = 0.3
STOP = 0.8
START = {"rod.tip.force[2]": 3.0, "rod.elements": 6, "rod.youngs_modulus": 6.0e5}


@pytest.fixture
def saved(instance):
    """An instance that saved its state at 0.3 s, the state, and how it went on."""
    instance.initialize(START)
    instance.run(SAVED, STEP)
    state = instance.slave.getFMUstate()
    return instance, state, go_on(instance)


def go_on(instance):
    """The run from the saved state, with an input that jumps."""
    instance.set({"rod.middle.moment": -0.2})
    return instance.run(STOP, STEP, SAVED)


def test_rollback_reproduces_every_bit(saved):
    instance, state, expected = saved
    for _ in range(2):
        instance.slave.setFMUstate(state)
        assert go_on(instance) == expected


def test_taking_the_state_changes_nothing(swing, saved):
    _, _, expected = saved
    with Instance(swing) as other:
        other.initialize(START)
        other.run(SAVED, STEP)
        assert go_on(other) == expected


def test_serialization_reproduces_every_bit(saved):
    instance, state, expected = saved
    blob = instance.slave.serializeFMUstate(state)
    assert blob == instance.slave.serializeFMUstate(state)
    instance.slave.freeFMUstate(state)
    instance.slave.setFMUstate(instance.slave.deSerializeFMUstate(blob))
    assert go_on(instance) == expected


def test_an_instance_not_initialized_takes_a_state(swing, saved):
    instance, state, expected = saved
    blob = instance.slave.serializeFMUstate(state)
    with Instance(swing) as other:
        other.slave.setFMUstate(other.slave.deSerializeFMUstate(blob))
        assert go_on(other) == expected


def test_another_process_reproduces_every_bit(swing, saved, tmp_path):
    instance, state, expected = saved
    blob = tmp_path / "state"
    blob.write_bytes(instance.slave.serializeFMUstate(state))
    script = Path(__file__).with_name("resume.py")
    command = [sys.executable, script, swing.path, blob, str(SAVED), str(STOP), str(STEP)]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stderr
    # The process does not touch the inputs, so neither does the run to compare with.
    instance.slave.setFMUstate(state)
    uninterrupted = instance.run(STOP, STEP, SAVED)
    assert json.loads(result.stdout) == uninterrupted
    assert uninterrupted != expected


def test_the_state_before_initialization_can_be_restored(instance):
    state = instance.slave.getFMUstate()
    expected = instance.initialize(START).run(SAVED, STEP)
    instance.slave.setFMUstate(state)
    assert instance.initialize(START).run(SAVED, STEP) == expected


def test_reset_gives_the_same_run(instance):
    expected = instance.initialize(START).run(SAVED, STEP)
    instance.slave.reset()
    assert instance.initialize(START).run(SAVED, STEP) == expected


def test_reset_restores_start_values(swing, instance):
    instance.initialize(START).run(SAVED, STEP)
    instance.slave.reset()
    with Instance(swing) as fresh:
        assert instance.initialize().run(SAVED, STEP) == fresh.initialize().run(SAVED, STEP)


def refused(instance, blob):
    """Whether a serialized state is refused with an error and a word about it."""
    known = len(instance.messages)
    try:
        instance.slave.deSerializeFMUstate(blob)
    except FMICallException as error:
        return error.status == 3 and len(instance.messages) > known
    return False


def test_damaged_states_are_refused(saved):
    instance, state, expected = saved
    blob = instance.slave.serializeFMUstate(state)
    instance.slave.setFMUstate(state)
    for at in range(0, len(blob), max(1, len(blob) // 200)):
        damaged = bytearray(blob)
        damaged[at] ^= 0x10
        assert refused(instance, bytes(damaged)), f"byte {at} of {len(blob)}"
    for length in (0, 1, 8, len(blob) // 2, len(blob) - 1):
        assert refused(instance, blob[:length]), f"first {length} bytes"
    assert refused(instance, blob + b"\0"), "one byte too many"
    instance.slave.setFMUstate(state)
    assert go_on(instance) == expected


def test_states_of_another_scene_are_refused(instance, variant):
    foreign = variant(gravity=[0.0, -1.62])
    with Instance(foreign) as other:
        other.initialize()
        blob = other.slave.serializeFMUstate(other.slave.getFMUstate())
    assert refused(instance.initialize(), blob)


def test_freeing_nothing_is_fine(instance):
    state = instance.slave.getFMUstate()
    instance.slave.freeFMUstate(state)
    instance.slave.fmi2FreeFMUstate(instance.slave.component, None)
