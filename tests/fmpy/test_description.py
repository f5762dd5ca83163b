"""What the model description says of the scene; whether it is a good one is asked in `test_checkers.py`."""

import json

import pytest
from conftest import all_scenes, place_of
from lxml import etree


@pytest.fixture(params=all_scenes(), ids=place_of)
def fmu(request, fmu_of):
    """The FMU of every scene of the project in turn."""
    return fmu_of(request.param)


@pytest.fixture
def xml(fmu):
    return etree.parse(fmu.folder / "modelDescription.xml").getroot()


def test_names_the_model_and_the_library(fmu, xml):
    scene = json.loads((fmu.folder / "resources" / "scene.json").read_text(encoding="utf-8"))
    assert xml.get("modelName") == scene["name"]
    assert xml.get("fmiVersion") == "2.0"
    (slave,) = xml.findall("CoSimulation")
    assert slave.get("modelIdentifier") == "flexbody"


def test_terminals_are_those_of_ports(fmu, xml):
    scene = json.loads((fmu.folder / "resources" / "scene.json").read_text(encoding="utf-8"))
    path = fmu.folder / "terminalsAndIcons" / "terminalsAndIcons.xml"
    if not scene["ports"]:
        assert not path.exists()
        return
    terminals = etree.parse(path).findall("Terminals/Terminal")
    assert [terminal.get("name") for terminal in terminals] == [port["name"] for port in scene["ports"]]
    causalities = {scalar.get("name"): scalar.get("causality") for scalar in xml.find("ModelVariables")}
    for terminal in terminals:
        members = terminal.findall("TerminalMemberVariable")
        assert members
        assert all(causalities[member.get("variableName")] in ("input", "output") for member in members)


def test_default_experiment_is_the_scenes(fmu, xml):
    scene = json.loads((fmu.folder / "resources" / "scene.json").read_text(encoding="utf-8"))
    experiment = xml.find("DefaultExperiment")
    if "experiment" in scene:
        assert float(experiment.get("stopTime")) == scene["experiment"]["stop_time"]
        assert float(experiment.get("stepSize")) == scene["experiment"]["step"]
    assert float(experiment.get("tolerance")) == scene["accuracy"]["relative_tolerance"]


def test_value_references_are_indices(xml):
    references = [int(scalar.get("valueReference")) for scalar in xml.find("ModelVariables")]
    assert references == list(range(len(references)))
