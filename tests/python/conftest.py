"""The package from its sources, with a program and libraries laid out as in the wheel."""

import json
import os
import shutil
import sys
import zipfile
from pathlib import Path

import pytest

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
SOURCES = ROOT / "python" / "src"
sys.path[:0] = [str(SOURCES), str(HERE.parent / "fmpy")]
# Processes that tests start find the package too.
os.environ["PYTHONPATH"] = str(SOURCES)

from project import package  # noqa: E402

SWING = HERE.parent / "fmpy" / "swing.json"
NAME = "flexbody.exe" if os.name == "nt" else "flexbody"


@pytest.fixture(scope="session")
def swing():
    """The scene file of a pendulum, coarse and therefore quick."""
    return SWING


@pytest.fixture(scope="session")
def fmu(tmp_path_factory):
    """The FMU of the swing."""
    return package(SWING, tmp_path_factory.mktemp("fmu") / "swing.fmu")


@pytest.fixture(scope="session")
def product(tmp_path_factory, fmu):
    """A folder as `flexbody/product` in the wheel; what goes into every FMU is taken from one."""
    built = Path(os.environ.get("FLEXBODY_PROGRAM") or ROOT / "target" / "release" / NAME)
    assert built.is_file(), f"no program: {built} does not exist (cargo build --release, or FLEXBODY_PROGRAM)"
    folder = tmp_path_factory.mktemp("product")
    shutil.copy2(built, folder / NAME)
    with zipfile.ZipFile(fmu) as archive:
        for name in archive.namelist():
            if name.startswith(("binaries/", "documentation/licenses/")):
                archive.extract(name, folder / "fmu")
    return folder


@pytest.fixture
def program(product, monkeypatch):
    """The package finds the program of that folder."""
    monkeypatch.setenv("FLEXBODY_PROGRAM", str(product / NAME))
    return product / NAME


def scene_files():
    """Every scene in the repository."""
    found = [SWING, SWING.with_name("mechanism.json")]
    for path in [*(ROOT / "scenes").glob("*.json"), *(ROOT / "tests" / "cases").glob("*/*.json")]:
        if path.name != "case.json" and not path.name.endswith(".schema.json"):
            found.append(path)
    return sorted(found)


def read(path):
    return json.loads(path.read_text(encoding="utf-8"))
