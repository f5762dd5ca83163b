"""Coupled systems as archives of SSP 1.0: `python tests/masters/ssp.py [FOLDER]` writes one for each system in
`systems/`, with the units it is made of.

Start values are bindings of parameters in the structure itself, which libcosim reads and FMPy does not. The communication
step is an annotation of the Open Simulation Platform: SSP 1.0 has no place for it."""

import sys
import zipfile
from pathlib import Path
from xml.etree import ElementTree
from xml.sax.saxutils import quoteattr

HERE = Path(__file__).resolve().parent
SPACES = {
    "ssd": "http://ssp-standard.org/SSP1/SystemStructureDescription",
    "ssc": "http://ssp-standard.org/SSP1/SystemStructureCommon",
    "ssv": "http://ssp-standard.org/SSP1/SystemStructureParameterValues",
    "osp": "http://opensimulationplatform.com/SSP/OSPAnnotations",
}


def split(path):
    """Unit and variable; a variable may have dots of its own."""
    return tuple(path.split(".", 1))


def structure(system, name="coupled"):
    """The text of `SystemStructure.ssd` for what a master is told."""
    connectors = {unit: dict.fromkeys(parameters(data), "parameter") for unit, data in system["units"].items()}
    for source, sink in system["connections"]:
        for path, kind in ((source, "output"), (sink, "input")):
            unit, variable = split(path)
            connectors[unit][variable] = kind
    for path in system["outputs"]:
        unit, variable = split(path)
        connectors[unit][variable] = "output"
    components = "".join(component(unit, kinds, system["units"][unit]["start"]) for unit, kinds in connectors.items())
    connections = "".join(
        "<ssd:Connection startElement={} startConnector={} endElement={} endConnector={}/>".format(
            *map(quoteattr, (*split(source), *split(sink)))
        )
        for source, sink in system["connections"]
    )
    spaces = " ".join(f'xmlns:{prefix}="{space}"' for prefix, space in SPACES.items())
    return (
        f'<?xml version="1.0" encoding="UTF-8"?>\n<ssd:SystemStructureDescription name={quoteattr(name)} version="1.0" {spaces}>'
        f'<ssd:System name="root"><ssd:Elements>{components}</ssd:Elements>'
        f"<ssd:Connections>{connections}</ssd:Connections></ssd:System>"
        f'<ssd:DefaultExperiment startTime="0.0" stopTime="{system["stop"]}"><ssd:Annotations>'
        '<ssc:Annotation type="com.opensimulationplatform"><osp:Algorithm>'
        f'<osp:FixedStepAlgorithm baseStepSize="{system["step"]}"/>'
        "</osp:Algorithm></ssc:Annotation></ssd:Annotations></ssd:DefaultExperiment>"
        "</ssd:SystemStructureDescription>\n"
    )


def parameters(data):
    """Which start values of a unit are parameters. One of an input has no connector: FMPy would set it to zero where
    nothing is connected to it."""
    with zipfile.ZipFile(data["fmu"]) as file:
        description = ElementTree.fromstring(file.read("modelDescription.xml"))
    known = {variable.get("name"): variable.get("causality") for variable in description.iter("ScalarVariable")}
    return [name for name in data["start"] if known[name] == "parameter"]


def component(unit, kinds, start):
    lines = "".join(
        f'<ssd:Connector name={quoteattr(name)} kind="{kind}"><ssc:Real/></ssd:Connector>' for name, kind in kinds.items()
    )
    values = "".join(
        f'<ssv:Parameter name={quoteattr(name)}><ssv:Real value="{value}"/></ssv:Parameter>' for name, value in start.items()
    )
    bindings = (
        "<ssd:ParameterBindings><ssd:ParameterBinding><ssd:ParameterValues>"
        f'<ssv:ParameterSet version="1.0" name="start"><ssv:Parameters>{values}</ssv:Parameters></ssv:ParameterSet>'
        "</ssd:ParameterValues></ssd:ParameterBinding></ssd:ParameterBindings>"
    )
    return (
        f'<ssd:Component name="{unit}" type="application/x-fmu-sharedlibrary" source="resources/{unit}.fmu">'
        f"<ssd:Connectors>{lines}</ssd:Connectors>{bindings if start else ''}</ssd:Component>"
    )


def archive(system, path, name="coupled"):
    """Writes an archive of the system and its units, and returns its path."""
    with zipfile.ZipFile(path, "w") as file:
        file.writestr("SystemStructure.ssd", structure(system, name))
        for unit, data in system["units"].items():
            file.write(data["fmu"], f"resources/{unit}.fmu")
    return path


if __name__ == "__main__":
    from tempfile import TemporaryDirectory

    from conftest import Systems

    output = Path(sys.argv[1] if len(sys.argv) > 1 else HERE.parents[1] / "target" / "ssp")
    output.mkdir(parents=True, exist_ok=True)
    with TemporaryDirectory() as folder:
        systems = Systems(Path(folder))
        for file in sorted((HERE / "systems").glob("*.json")):
            system = systems.resolved(file.stem)
            print(archive({**system, "step": system["steps"][-1]}, output / f"{file.stem}.ssp", file.stem))
