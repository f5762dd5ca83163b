"""The package from its sources, with the program and the libraries of the wheel."""

import json
import os
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

from project import package, xtask  # noqa: E402

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
def wheel(tmp_path_factory):
    """The wheel, as people install it."""
    folder = tmp_path_factory.mktemp("wheel")
    xtask("wheel", "--output", folder)
    (path,) = folder.glob("*.whl")
    return path


@pytest.fixture(scope="session")
def product(tmp_path_factory, wheel):
    """The folder `flexbody/product` of the wheel."""
    folder = tmp_path_factory.mktemp("product")
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(folder)
    product = folder / "flexbody" / "product"
    (product / NAME).chmod(0o755)
    return product


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
