"""FMUs for the tests, each packaged once a session by the project's own command. Every claim of every case is checked natively
(`tests/cases.rs`): here a few cases run through their FMUs, and with `cargo xtask test --all` all of them."""

import json
import os
from itertools import count
from pathlib import Path

import pytest
from instance import Fmu, Instance
from project import ROOT, package

SWING = Path(__file__).with_name("swing.json")
MECHANISM = Path(__file__).with_name("mechanism.json")
IS_WHOLE = "FLEXBODY_ALL" in os.environ
# Of every kind of body, of start, of events and of outputs one at least.
FEW = [
    "bead_on_rod", "catenary", "contact", "coupled_mass", "driven_orientation", "elastica", "heavy_top", "hoisted_mass", "jeffcott_rotor",
    "let_go", "planar_beam_statics", "rod_statics", "slider_crank_rigid", "switched_loads",
]  # fmt: skip


def pytest_collection_modifyitems(items):
    """Tests of one scene run in one process, which packages the scene once; the others go by their file."""
    for item in items:
        values = item.callspec.params.values() if hasattr(item, "callspec") else []
        paths = [value for value in values if isinstance(value, Path)]
        group = paths[0] if paths else item.path
        cases = ROOT / "tests" / "cases"
        if cases in group.parents and group.parent != cases:
            group = group.parent
        item.add_marker(pytest.mark.xdist_group(str(group)))


class Library:
    """FMUs by scene file."""

    def __init__(self, folder):
        self.folder = folder
        self.fmus = {}
        self.numbers = count()

    def __call__(self, scene):
        scene = Path(scene).resolve()
        if scene not in self.fmus:
            place = self.folder / str(next(self.numbers))
            place.mkdir()
            path = package(scene, place / f"{scene.stem}.fmu")
            self.fmus[scene] = Fmu(path, place / "extracted")
        return self.fmus[scene]


@pytest.fixture(scope="session")
def fmu_of(tmp_path_factory):
    """The FMU of a scene file."""
    return Library(tmp_path_factory.mktemp("fmus"))


@pytest.fixture(scope="session")
def swing(fmu_of):
    """A pendulum with every kind of input and output, coarse and therefore quick."""
    return fmu_of(SWING)


@pytest.fixture
def instance(swing):
    """An instance of the swing, not yet initialized."""
    with Instance(swing) as instance:
        yield instance


@pytest.fixture(scope="session")
def variant(edited):
    """The FMU of the swing with some keys of its scene replaced."""
    return lambda **changes: edited(SWING, lambda scene: scene.update(changes))


@pytest.fixture(scope="session")
def edited(tmp_path_factory, fmu_of):
    """The FMU of a scene that a function has changed."""

    def make(scene_file, change):
        scene = json.loads(scene_file.read_text(encoding="utf-8"))
        change(scene)
        path = tmp_path_factory.mktemp("scene") / scene_file.name
        path.write_text(json.dumps(scene), encoding="utf-8")
        return fmu_of(path)

    return make


def case_files():
    """Every case."""
    return sorted((ROOT / "tests" / "cases").glob("*/case.json"))


def meant_cases():
    """The cases that run through their FMUs."""
    return [path for path in case_files() if IS_WHOLE or path.parent.name in FEW]


def all_scenes():
    """Every ready scene, every scene that a case which is meant or a claim of it names, and those of these tests."""
    scenes = {path for path in (ROOT / "scenes").glob("*.json") if not path.name.endswith(".schema.json")}
    for path in meant_cases():
        case = json.loads(path.read_text(encoding="utf-8"))
        named = [case, *case["claims"]]
        scenes.update(path.parent.joinpath(item["scene"]).resolve() for item in named if "scene" in item)
        if any("scene" not in item for item in case["claims"]) and "scene" not in case:
            scenes.add(path.with_name("scene.json"))
    return [*sorted(scenes), SWING, MECHANISM]


def place_of(path):
    """A scene's place in the project, as the name of a test."""
    return "-".join(path.resolve().relative_to(ROOT).with_suffix("").parts)
