"""Models of scenes: fresh, and JSON in and out."""

import json
import subprocess
import sys

import jsonschema
import numpy
import pytest
from conftest import ROOT, read, scene_files
from flexbody import scene as models
from flexbody.scene import (
    AngleMotion,
    AngularVelocityOutput,
    Cable,
    Circle,
    Experiment,
    ForceLoad,
    Line,
    Material,
    Orientation,
    Quaternion,
    ReactionOutput,
    Revolute,
    RigidBody,
    Scene,
    Section,
)
from pydantic import TypeAdapter, ValidationError


def rope(**changes):
    keys = {
        "name": "rope",
        "material": Material(density=1200, youngs_modulus=5e8),
        "section": Section(shape=Circle(radius=0.005)),
        "shape": Line(from_=[0, 0], to=[2, 0]),
    }
    return Cable(**{**keys, **changes})


def scene(**changes):
    return Scene(**{"name": "hung", "dimension": 2, "bodies": [rope()], **changes})


def test_the_committed_models_are_those_of_the_schema(tmp_path):
    made = tmp_path / "scene.py"
    command = [sys.executable, "-W", "ignore", ROOT / "python" / "generate_models.py", "--output", made]
    subprocess.run(command, check=True)
    committed = ROOT / "python" / "src" / "flexbody" / "scene.py"
    assert made.read_text(encoding="utf-8") == committed.read_text(encoding="utf-8"), (
        "not fresh: run python python/generate_models.py"
    )


def test_every_scene_in_the_repository_survives_being_read_and_written():
    files = scene_files()
    assert len(files) > 80
    for path in files:
        found = Scene.from_file(path)
        assert found.to_dict() == read(path), path
        assert json.loads(found.to_json()) == read(path), path
        assert Scene.from_json(found.to_json()) == found, path


def test_all_bits_of_numbers_survive():
    for value in [0.1 + 0.2, 5e-324, 1.7976931348623157e308, 1 / 3]:
        written = scene(experiment=Experiment(step=value, stop_time=1)).to_json()
        assert Scene.from_json(written).experiment.step == value


def test_what_was_not_said_is_not_written():
    assert scene().to_dict() == {
        "name": "hung",
        "dimension": 2,
        "bodies": [
            {
                "element": "cable",
                "name": "rope",
                "material": {"density": 1200, "youngs_modulus": 5e8},
                "section": {"shape": {"circle": {"radius": 0.005}}},
                "shape": {"line": {"from": [0, 0], "to": [2, 0]}},
            }
        ],
    }
    assert "gravity" not in scene(gravity=None).to_dict()
    assert scene(joints=[]).to_dict()["joints"] == []


def test_what_is_added_in_place_is_written():
    hung = scene()
    hung.joints.append(Revolute(name="hook", markers=["ground", "rope.top"]))
    hung.bodies[0].markers["top"] = 0.0
    hung.experiment.stop_time = 5.0
    written = hung.to_dict()
    assert written["joints"] == [{"name": "hook", "kind": "revolute", "markers": ["ground", "rope.top"]}]
    assert written["bodies"][0]["markers"] == {"top": 0.0}
    assert written["experiment"] == {"stop_time": 5.0, "step": 0.01}
    assert scene().joints == [] and "experiment" not in scene().to_dict()


def test_arrays_are_lists():
    line = Line(from_=numpy.zeros(2), to=numpy.array([2, 0]))
    assert line.to_dict() == {"line": {"from": [0, 0], "to": [2, 0]}}
    assert Material(density=numpy.float64(7800)).to_dict() == {"density": 7800}


def test_variants_are_told_apart():
    body = Scene(name="a", dimension=3, bodies=[{"element": "rigid", "name": "b", "position": [0, 0, 0]}]).bodies[0]
    assert type(body) is RigidBody
    orientation = TypeAdapter(Orientation).validate_python({"quaternion": [1, 0, 0, 0]})
    assert orientation == Quaternion(quaternion=[1, 0, 0, 0])
    assert AngularVelocityOutput(marker="b.c", axes="body").to_dict() == {
        "kind": "angular_velocity",
        "marker": "b.c",
        "axes": "body",
    }


def test_where_the_schema_is_means_nothing():
    found = Scene.from_json(json.dumps({"$schema": "scene.schema.json", **scene().to_dict()}))
    assert found.to_dict() == scene().to_dict()
    with pytest.raises(ValidationError):
        Material.from_json('{"$schema": "scene.schema.json", "density": 1}')


@pytest.mark.parametrize(
    ("change", "path", "message"),
    [
        (lambda s: s["bodies"][0].pop("material"), "$.bodies[0]", "'material' is a required property"),
        (lambda s: s["bodies"][0].update(elemnts=3), "$.bodies[0]", "('elemnts' was unexpected)"),
        (lambda s: s["bodies"][0].update(element="cabel"), "$.bodies[0].element", "'cabel' is not one of"),
        (lambda s: s["joints"][0].update(pitch=1), "$.joints[0]", "('pitch' was unexpected)"),
        (lambda s: s["joints"][0].update(kind="revolut"), "$.joints[0].kind", "'revolut' is not one of"),
        (lambda s: s["joints"][0].update(markers="a"), "$.joints[0].markers", "'a' is not of type 'array'"),
        (lambda s: s["outputs"][0].update(marker=1), "$.outputs[0].marker", "1 is not of type"),
        (lambda s: s["outputs"][0].update(joint="j"), "$.outputs[0]", "('marker' was unexpected)"),
    ],
)
def test_a_validator_tells_what_is_wrong_within_the_kind(change, path, message):
    schema = read(ROOT / "scenes" / "scene.schema.json")
    validator = jsonschema.Draft202012Validator(schema)
    right = scene(
        joints=[Revolute(name="j", markers=["ground", "rope.top"])], outputs=[{"kind": "angle", "marker": "rope.top"}]
    ).to_dict()
    assert not list(validator.iter_errors(right))
    change(right)
    found = jsonschema.exceptions.best_match(validator.iter_errors(right))
    assert (found.json_path, message in found.message) == (path, True), found.message


def test_names_are_those_of_the_field():
    for name in ["Rod", "Beam", "AutoBody", "Revolute", "OrientationJoint", "ForceInput", "JointLimitLoad", "MotionPort"]:
        assert issubclass(getattr(models, name), models.Part), name
    numbered = [name for name in vars(models) if name[-1].isdigit()]
    assert numbered == []


def test_fields_have_their_meaning():
    assert Material.model_fields["density"].description == "Density, kg/m^3."
    assert Cable.__doc__.strip().startswith("Flexible, of ANCF cables")


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        (lambda: Material(densiti=1), "densiti"),
        (lambda: Material(density=0), "greater than 0"),
        (lambda: Material(density=-1), "greater than 0"),
        (lambda: Material(density="7800"), "valid number"),
        (lambda: Material(density=float("nan")), "finite number"),
        (lambda: Experiment(step=0, stop_time=1), "greater than 0"),
        (lambda: scene(dimension=4), "less than or equal to 3"),
        (lambda: scene(dimension=2.0), "valid integer"),
        (lambda: rope(elements=-1), "greater than or equal to 0"),
        (lambda: rope(elements="many"), "auto"),
        (
            lambda: rope(shape={"from": [0, 0], "to": [1, 0]}),
            "expected one of the keys `line`, `arc`, `helix`, found `from`, `to`",
        ),
        (lambda: rope(shape=Line(from_=[0], to=[1, 0])), "at least 2 items"),
        (lambda: scene(bodies=[{"element": "cabel"}]), "'cable', 'rod', 'beam', 'auto', 'rigid'"),
        (lambda: Revolute(name="j", markers=["ground", "rope.top"], pitch=1), "pitch"),
        (lambda: ForceLoad(name="f", value=[0, 1]), "marker"),
        (lambda: AngleMotion(name="m", value=1), "expected `joint`, or `marker`, found none of them"),
        (lambda: AngleMotion(name="m", value=1, joint="j", marker="b.c"), "found `joint` and `marker`"),
        (lambda: ReactionOutput(motion="m", axes="body"), "found `axes` and `motion`"),
        (lambda: setattr(rope(), "elements", -1), "greater than or equal to 0"),
    ],
)
def test_what_the_schema_refuses_is_refused(wrong, message):
    with pytest.raises(ValidationError) as refused:
        wrong()
    assert message in str(refused.value)
