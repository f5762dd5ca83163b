"""What is wrong is refused, with a message that names the cause, and changes nothing."""

import json
import shutil
from ctypes import c_uint

import pytest
from fmpy.fmi1 import FMICallException
from instance import Instance, InstantiationError

STEP = 0.05
STOP = 0.3
ERROR = 3


@pytest.fixture
def copy(swing, tmp_path):
    """A copy of the extracted FMU to damage."""
    return shutil.copytree(swing.folder, tmp_path / "copy")


def refusal(swing, **arguments):
    """What the FMU logs when it does not instantiate."""
    with pytest.raises(InstantiationError) as failure:
        Instance(swing, **arguments)
    return str(failure.value)


def test_a_wrong_guid_is_refused(swing):
    message = refusal(swing, guid="{00000000-0000-0000-0000-000000000000}")
    assert "guid" in message.lower()


def test_missing_resources_are_refused(swing, copy):
    shutil.rmtree(copy / "resources")
    assert "scene.json" in refusal(swing, folder=copy)


def test_a_broken_scene_is_refused(swing, copy):
    (copy / "resources" / "scene.json").write_text("{", encoding="utf-8")
    assert "scene.json" in refusal(swing, folder=copy)


def test_a_scene_that_is_not_text_is_refused(swing, copy):
    (copy / "resources" / "scene.json").write_bytes(b"\xff\xfe\x00")
    assert "scene.json" in refusal(swing, folder=copy)


def change_scene(folder, change):
    path = folder / "resources" / "scene.json"
    scene = json.loads(path.read_text(encoding="utf-8"))
    change(scene)
    path.write_text(json.dumps(scene), encoding="utf-8")


def test_a_scene_that_does_not_match_the_description_is_refused(swing, copy):
    change_scene(copy, lambda scene: scene["outputs"].pop())
    message = refusal(swing, folder=copy)
    assert "guid" in message.lower() or "match" in message.lower()


def test_impossible_values_are_refused_with_their_place(swing, copy):
    change_scene(copy, lambda scene: scene["bodies"][0]["material"].update(density=-1.0))
    message = refusal(swing, folder=copy)
    assert "bodies[0].material.density" in message
    assert "-1" in message


def test_unknown_keys_are_refused_without_formatting_them(swing, copy):
    # A message is text, not a format, and # is doubled: it is an escape in FMI 2.0.
    change_scene(copy, lambda scene: scene.update({"50%s%n#r1#": 1}))
    assert "50%s%n##r1##" in refusal(swing, folder=copy)


def test_odd_folders_are_found(swing, tmp_path):
    folder = shutil.copytree(swing.folder, tmp_path / "a %25 b%s#c ü")
    with Instance(swing, folder=folder) as instance:
        instance.initialize().run(STOP, STEP)


@pytest.mark.parametrize("value", [float("nan"), float("inf"), -float("inf")])
def test_inputs_that_are_no_numbers_change_nothing(swing, instance, value):
    with Instance(swing) as other:
        expected = other.initialize().run(STOP, STEP)
    instance.initialize()
    state = instance.slave.serializeFMUstate(instance.slave.getFMUstate())
    with pytest.raises(FMICallException) as failure:
        instance.set({"rod.tip.force[1]": value})
    assert failure.value.status == ERROR
    assert "rod.tip.force[1]" in instance.messages[-1]
    assert instance.slave.serializeFMUstate(instance.slave.getFMUstate()) == state
    assert instance.run(STOP, STEP) == expected


def test_half_a_set_is_no_set(instance):
    instance.initialize()
    references = [instance.fmu.variable(f"rod.tip.force[{axis}]").valueReference for axis in (1, 2)]
    with pytest.raises(FMICallException):
        instance.slave.setReal(references, [7.0, float("nan")])
    assert instance.slave.getReal(references) == [0.0, 0.0]


def test_unknown_value_references_are_refused(instance):
    instance.initialize()
    for call in (
        lambda: instance.slave.getReal([9999]),
        lambda: instance.slave.setReal([9999], [0.0]),
        lambda: instance.slave.getInteger([9999]),
        lambda: instance.slave.getBoolean([0]),
        lambda: instance.slave.getString([0]),
    ):
        with pytest.raises(FMICallException) as failure:
            call()
        assert failure.value.status == ERROR
    assert "9999" in "\n".join(instance.messages)


def test_outputs_may_not_be_set(instance):
    instance.initialize()
    with pytest.raises(FMICallException) as failure:
        instance.set({"rod.tip.position[1]": 0.0})
    assert failure.value.status == ERROR
    assert "rod.tip.position[1]" in instance.messages[-1]


def test_null_pointers_are_refused(instance):
    instance.initialize()
    slave, reference = instance.slave, (c_uint * 1)(1)
    for call in (
        lambda: slave.fmi2GetReal(slave.component, None, 1, None),
        lambda: slave.fmi2GetReal(slave.component, reference, 1, None),
        lambda: slave.fmi2SetReal(slave.component, reference, 1, None),
        lambda: slave.fmi2GetFMUstate(slave.component, None),
        lambda: slave.fmi2SetFMUstate(slave.component, None),
        lambda: slave.fmi2DoStep(None, 0.0, STEP, 1),
    ):
        with pytest.raises(FMICallException) as failure:
            call()
        assert failure.value.status == ERROR


def test_logging_off_leaves_errors_alone(swing):
    # Section 2.1.5: loggingOn is about debug messages; section 2.1.3: the logger is called before fmi2Error is returned.
    with Instance(swing, logging=False) as instance:
        assert instance.messages == []
        with pytest.raises(FMICallException):
            instance.slave.doStep(0.0, STEP)
        assert len(instance.messages) == 1 and "fmi2DoStep" in instance.messages[0]


def test_a_refused_instance_gives_its_reason_even_so(swing):
    # Section 2.1.5: the logger is called when fmi2Instantiate returns NULL.
    assert "guid" in refusal(swing, logging=False, guid="wrong").lower()


def test_logging_can_be_switched(swing):
    with Instance(swing, logging=False) as instance:
        instance.slave.setDebugLogging(True, [])
        with pytest.raises(FMICallException):
            instance.slave.doStep(0.0, STEP)
        assert instance.messages
        instance.messages.clear()
        instance.slave.setDebugLogging(False, [])
        assert instance.messages == []
        with pytest.raises(FMICallException):
            instance.slave.doStep(0.0, STEP)
        assert len(instance.messages) == 1
        instance.messages.clear()
        instance.slave.setDebugLogging(True, ["logEvents"])
        with pytest.raises(FMICallException):
            instance.slave.doStep(0.0, STEP)
        assert instance.messages == []


def test_unknown_log_categories_are_warned_of(instance):
    instance.slave.setDebugLogging(True, ["gossip"])
    assert "gossip" in instance.messages[-1]


def test_the_instance_name_is_text_and_not_a_format(swing):
    with Instance(swing, name="100%s %n #1#") as instance:
        with pytest.raises(FMICallException):
            instance.slave.doStep(0.0, STEP)
        assert instance.messages


def test_an_empty_instance_name_is_refused(swing):
    assert "name" in refusal(swing, name="").lower()


def test_nothing_is_printed(swing, copy, capfd):
    with Instance(swing) as instance:
        instance.initialize().run(STOP, STEP)
        with pytest.raises(FMICallException):
            instance.slave.doStep(STOP, -STEP)
    shutil.rmtree(copy / "resources")
    refusal(swing, folder=copy)
    captured = capfd.readouterr()
    assert captured.out == ""
    assert captured.err == ""
