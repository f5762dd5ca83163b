"""FMUs and references of coupled systems, each made once a session."""

import csv
import json
import shutil
import sys
from pathlib import Path

import pytest

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent / "fmpy"))

from project import package, xtask  # noqa: E402

# Of cables that leave their number of elements to the planner.
ELEMENTS = 8


class Systems:
    """Coupled systems by name, with their FMUs and what they must do."""

    def __init__(self, folder):
        self.folder = folder
        self.partners = folder / "partners"
        xtask("example-fmus", "--output", self.partners)
        self.fmus = {}
        self.ends = {}

    def read(self, name):
        return json.loads((HERE / "systems" / f"{name}.json").read_text(encoding="utf-8"))

    def scene(self, unit, change=None):
        """The scene of a unit, with some keys replaced, or left out where null replaces them."""
        scene = json.loads((HERE / "systems" / unit["scene"]).read_text(encoding="utf-8"))
        scene = {**scene, **unit.get("change", {}), **(change or {})}
        for body in scene["bodies"]:
            if body["element"] == "cable":
                # A unit and its reference have one mesh, whatever either would be planned with.
                body.setdefault("elements", ELEMENTS)
        return {key: value for key, value in scene.items() if value is not None}

    def write(self, name, scene):
        path = self.folder / f"{name}.json"
        path.write_text(json.dumps(scene), encoding="utf-8")
        for body in scene["bodies"]:
            if "file" in body:
                shutil.copy(HERE / "scenes" / body["file"], self.folder)
        return path

    def fmu(self, system, name, unit):
        """The FMU of a unit."""
        if "partner" in unit:
            return self.partners / f"{unit['partner']}.fmu"
        key = f"{system}_{name}"
        if key not in self.fmus:
            self.fmus[key] = package(self.write(key, self.scene(unit)), self.folder / f"{key}.fmu")
        return self.fmus[key]

    def resolved(self, name):
        """What a master is told, but for its step."""
        system = self.read(name)
        units = {
            unit: {"fmu": str(self.fmu(name, unit, data)), "start": data.get("start", {})}
            for unit, data in system["units"].items()
        }
        return {**system, "units": units}

    def end(self, name):
        """What the outputs must be at the end."""
        if name not in self.ends:
            self.ends[name] = self.reference(name, self.read(name))
        return self.ends[name]

    def reference(self, name, system):
        import references

        claim = dict(system["reference"])
        kind = claim.pop("kind")
        if kind != "scene":
            claim.pop("states", None)
            return list(getattr(references, kind)(**claim, stop=system["stop"]))
        # One scene that holds all units; an output keeps the name it has in its unit.
        whole = self.write(f"{name}_whole", self.scene(system["units"][claim["unit"]], claim["change"]))
        table = whole.with_suffix(".csv")
        xtask("simulate", whole, "--stop-time", system["stop"], "--step", system["stop"], "--output", table)
        with table.open(encoding="utf-8") as file:
            last = list(csv.DictReader(file))[-1]
        return [float(last[path.split(".", 1)[1]]) for path in system["outputs"]]


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items):
    """What is asked of one system goes to one process, which keeps its runs and its units."""
    for item in items:
        name = getattr(item, "callspec", None) and item.callspec.params.get("name")
        if name:
            item.add_marker(pytest.mark.xdist_group(name))


@pytest.fixture(scope="session")
def systems(tmp_path_factory):
    """Coupled systems."""
    return Systems(tmp_path_factory.mktemp("systems"))
