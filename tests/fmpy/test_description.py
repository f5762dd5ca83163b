"""The model description: fmpy's validation, and the rules that no checker notices."""

import json
from pathlib import Path

import fmpy
import pytest
from conftest import all_scenes, place_of
from fmpy.validation import validate_fmu
from lxml import etree

BASE_UNITS = {"kg", "m", "s", "A", "K", "mol", "cd", "rad", "factor", "offset"}
FUNCTIONS = """
    GetTypesPlatform GetVersion SetDebugLogging Instantiate FreeInstance
    SetupExperiment EnterInitializationMode ExitInitializationMode Terminate Reset
    GetReal GetInteger GetBoolean GetString SetReal SetInteger SetBoolean SetString
    GetFMUstate SetFMUstate FreeFMUstate
    SerializedFMUstateSize SerializeFMUstate DeSerializeFMUstate
    GetDirectionalDerivative SetRealInputDerivatives GetRealOutputDerivatives
    DoStep CancelStep GetStatus GetRealStatus GetIntegerStatus GetBooleanStatus GetStringStatus
""".split()


@pytest.fixture(params=all_scenes(), ids=place_of)
def fmu(request, fmu_of):
    """The FMU of every scene of the project in turn."""
    return fmu_of(request.param)


@pytest.fixture
def xml(fmu):
    return etree.parse(fmu.folder / "modelDescription.xml").getroot()


@pytest.fixture
def scalars(xml):
    """Scalar variables with their typed elements, in order; the index is their place plus one."""
    return [(scalar, scalar[0]) for scalar in xml.find("ModelVariables")]


def test_fmpy_finds_nothing(fmu):
    assert validate_fmu(str(fmu.path)) == []


def test_every_function_is_exported(instance):
    missing = [name for name in FUNCTIONS if not hasattr(instance.slave.dll, f"fmi2{name}")]
    assert missing == []


def test_names_the_model_and_the_library(fmu, xml):
    scene = json.loads((fmu.folder / "resources" / "scene.json").read_text(encoding="utf-8"))
    assert xml.get("modelName") == scene["name"]
    assert xml.get("fmiVersion") == "2.0"
    (slave,) = xml.findall("CoSimulation")
    assert slave.get("modelIdentifier") == "flexbody"


def test_capabilities_are_consistent(xml):
    slave = xml.find("CoSimulation")
    for capability in (
        "canGetAndSetFMUstate",
        "canSerializeFMUstate",
        "canHandleVariableCommunicationStepSize",
        # The library has an allocator of its own.
        "canNotUseMemoryManagementFunctions",
    ):
        assert slave.get(capability) == "true", capability
    assert slave.get("canBeInstantiatedOnlyOncePerProcess", "false") == "false"


def test_derivatives_are_listed(xml, scalars):
    listed = {item.get("index") for item in xml.iterfind("ModelStructure/Derivatives/Unknown")}
    for index, (scalar, real) in enumerate(scalars, start=1):
        if real.get("derivative") is not None:
            assert str(index) in listed, scalar.get("name")


def test_terminals_are_those_of_ports(fmu, scalars):
    """FMI 2.0.4 takes the file, and its schema, from FMI 3.0."""
    scene = json.loads((fmu.folder / "resources" / "scene.json").read_text(encoding="utf-8"))
    path = fmu.folder / "terminalsAndIcons" / "terminalsAndIcons.xml"
    if not scene["ports"]:
        assert not path.exists()
        return
    found = etree.parse(path)
    schema = Path(fmpy.__file__).parent / "schema" / "fmi3" / "fmi3TerminalsAndIcons.xsd"
    etree.XMLSchema(etree.parse(schema)).assertValid(found)
    terminals = found.findall("Terminals/Terminal")
    assert [terminal.get("name") for terminal in terminals] == [port["name"] for port in scene["ports"]]
    causalities = {scalar.get("name"): scalar.get("causality") for scalar, _ in scalars}
    for terminal in terminals:
        members = terminal.findall("TerminalMemberVariable")
        names = [member.get("memberName") for member in members]
        assert len(set(names)) == len(names) > 0
        for member in members:
            assert causalities[member.get("variableName")] in ("input", "output")


def test_starts_lie_within_bounds(scalars):
    for scalar, typed in scalars:
        if typed.get("start") is not None:
            low = float(typed.get("min", "-inf"))
            high = float(typed.get("max", "inf"))
            assert low <= float(typed.get("start")) <= high, scalar.get("name")


def test_nominals_are_not_zero(scalars):
    for scalar, typed in scalars:
        assert float(typed.get("nominal", "1")) != 0.0, scalar.get("name")


def test_dependencies_are_ascending_and_not_on_themselves(xml, scalars):
    for unknown in xml.find("ModelStructure").iter("Unknown"):
        indices = [int(i) for i in unknown.get("dependencies", "").split()]
        assert indices == sorted(set(indices)), unknown.attrib
        assert int(unknown.get("index")) not in indices, unknown.attrib
        assert all(1 <= index <= len(scalars) for index in indices), unknown.attrib
        kinds = unknown.get("dependenciesKind")
        if kinds is not None:
            assert len(kinds.split()) == len(indices), unknown.attrib


def test_structure_is_complete(xml, scalars):
    def indices(path):
        return [int(item.get("index")) for item in xml.iterfind(f"ModelStructure/{path}/Unknown")]

    causalities = [scalar.get("causality") for scalar, _ in scalars]
    outputs = [i for i, causality in enumerate(causalities, start=1) if causality == "output"]
    calculated = [i for i, c in enumerate(causalities, start=1) if c == "calculatedParameter"]
    assert indices("Outputs") == outputs
    assert indices("InitialUnknowns") == sorted(outputs + calculated)


def test_starts_where_required_and_nowhere_else(scalars):
    for scalar, typed in scalars:
        settable = scalar.get("causality") in ("input", "parameter")
        assert (typed.get("start") is not None) == settable, scalar.get("name")
        if scalar.get("causality") == "input":
            assert scalar.get("initial") is None, scalar.get("name")


def test_value_references_are_indices(scalars):
    assert [int(scalar.get("valueReference")) for scalar, _ in scalars] == list(range(len(scalars)))


def test_units_are_declared_in_base_units(xml, scalars):
    units = {unit.get("name"): unit for unit in xml.iterfind("UnitDefinitions/Unit")}
    for scalar, typed in scalars:
        unit = typed.get("unit")
        assert unit is None or unit in units, scalar.get("name")
    for name, unit in units.items():
        (base,) = unit.findall("BaseUnit")
        assert set(base.attrib) <= BASE_UNITS, name


def test_default_experiment_is_the_scenes(fmu, xml):
    scene = json.loads((fmu.folder / "resources" / "scene.json").read_text(encoding="utf-8"))
    experiment = xml.find("DefaultExperiment")
    if "experiment" in scene:
        assert float(experiment.get("stopTime")) == scene["experiment"]["stop_time"]
        assert float(experiment.get("stepSize")) == scene["experiment"]["step"]
    assert float(experiment.get("tolerance")) == scene["accuracy"]["relative_tolerance"]
