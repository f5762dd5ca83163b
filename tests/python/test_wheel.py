"""What the wheel is made of, and that it works where it is installed."""

import json
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import venv
import zipfile

import fmpy
import fmpy.validation
import pytest
from conftest import NAME, ROOT, read

PROJECT = ROOT / "python"


def build(folder, **environment):
    command = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", folder]
    environment = {**os.environ, **environment}
    return subprocess.run(command, cwd=PROJECT, env=environment, capture_output=True, text=True, check=False)


def test_the_wheel_holds_what_is_compiled(product, tmp_path):
    made = build(tmp_path, FLEXBODY_WHEEL_PRODUCT=str(product), FLEXBODY_WHEEL_PLATFORM="manylinux_2_17_x86_64")
    assert made.returncode == 0, made.stdout + made.stderr
    (wheel,) = tmp_path.glob("*.whl")
    assert re.fullmatch(r"flexbody-[0-9.]+-py3-none-manylinux_2_17_x86_64\.whl", wheel.name)
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
        program = archive.getinfo(f"flexbody/product/{NAME}")
        metadata = archive.read(next(name for name in names if name.endswith("/WHEEL"))).decode()
        points = archive.read(next(name for name in names if name.endswith("/entry_points.txt"))).decode()
    assert program.external_attr >> 16 & 0o111, "the program is not executable"
    assert "Root-Is-Purelib: false" in metadata
    assert "flexbody = flexbody.__main__:main" in points
    for path in product.rglob("*"):
        if path.is_file():
            assert f"flexbody/product/{path.relative_to(product).as_posix()}" in names
    assert {"flexbody/scene.py", "flexbody/cluster.py", "flexbody/py.typed"} <= set(names)


def test_the_wheel_is_for_this_platform_and_holds_licenses(wheel):
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
    (library,) = [name for name in names if name.startswith("flexbody/product/fmu/binaries/")]
    assert library.split("/")[-2] == fmpy.platform
    for part in ["", "fmu/"]:
        assert f"flexbody/product/{part}documentation/licenses/license.txt" in names


@pytest.mark.skipif(fmpy.platform != "linux64", reason="the tag is that of Linux on x86-64")
def test_the_wheel_runs_on_the_systems_that_its_tag_names(wheel):
    """The program and the library ask for nothing newer, and for no library beside the system's."""
    tag = wheel.stem.rpartition("-")[2]
    assert tag == "manylinux_2_17_x86_64"
    command = [sys.executable, "-m", "auditwheel", "show", wheel]
    told = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    assert f'consistent with the following platform tag: "{tag}"' in " ".join(told.split()), told


class Installed:
    """An environment of its own with the wheel, and no other program within reach."""

    def __init__(self, folder, wheel):
        venv.create(folder, with_pip=True)
        self.programs = folder / ("Scripts" if os.name == "nt" else "bin")
        kept = ("SYSTEMROOT", "TEMP", "TMP")
        self.environment = {name: os.environ[name] for name in kept if name in os.environ}
        self.environment |= {"PATH": str(self.programs), "HOME": str(folder)}
        # What the wheel depends on is there already, at the versions that are pinned.
        (site,) = folder.glob("**/site-packages")
        pinned = sysconfig.get_path("purelib")
        (site / "pinned.pth").write_text(f"{pinned}\n", encoding="utf-8")
        self.run("python", "-m", "pip", "install", "--no-index", "--disable-pip-version-check", wheel)

    def run(self, name, *arguments, **options):
        """Runs one of its programs and returns what that prints."""
        command = [shutil.which(name, path=self.environment["PATH"]), *arguments]
        result = subprocess.run(command, env=self.environment, capture_output=True, text=True, check=False, **options)
        assert result.returncode == 0, result.stdout + result.stderr
        return result.stdout


@pytest.fixture(scope="module")
def installed(wheel, tmp_path_factory):
    return Installed(tmp_path_factory.mktemp("installed"), wheel)


def test_installed_it_needs_no_compiler(installed, swing, tmp_path):
    for tool in ["cargo", "rustc", "cc", "ld"]:
        assert not shutil.which(tool, path=installed.environment["PATH"])

    def flexbody(*arguments):
        return installed.run("flexbody", *arguments, cwd=tmp_path)

    scene = tmp_path / "scene.json"
    scene.write_bytes(swing.read_bytes())
    flexbody("package", "scene.json", "--output", "made.fmu")
    assert not fmpy.validation.validate_fmu(str(tmp_path / "made.fmu"))
    flexbody("simulate", "scene.json", "--output", "scene.csv", "--stop-time", "0.5")
    flexbody("simulate", "made.fmu", "--output", "made.csv", "--stop-time", "0.5")
    assert (tmp_path / "made.csv").read_bytes() == (tmp_path / "scene.csv").read_bytes()
    names, *_, last = (tmp_path / "made.csv").read_text(encoding="utf-8").splitlines()
    end = dict(zip(names.split(","), map(float, last.split(",")), strict=True))
    there = fmpy.simulate_fmu(str(tmp_path / "made.fmu"), stop_time=0.5)[-1]
    for name in there.dtype.names:
        assert there[name] == pytest.approx(end[name], rel=1e-9, abs=1e-9), name
    flexbody("merge", "made.fmu", "made.fmu", "--output", "merged.fmu")
    assert (tmp_path / "merged.fmu").read_bytes() == (tmp_path / "made.fmu").read_bytes()
    flexbody("view", "made.fmu", "--output", "made.html", "--no-open")
    assert (tmp_path / "made.html").read_text(encoding="utf-8").startswith("<!DOCTYPE html>")
    flexbody("sweep", "scene.json", "--vary", "rod.density=5000:6000:3", "--output", "sweep.parquet")
    assert (tmp_path / "sweep.parquet").stat().st_size > 0
    assert json.loads(flexbody("schema")) == read(ROOT / "scenes" / "scene.schema.json")
    assert flexbody("plan", "scene.json").startswith("nothing to plan")


def test_installed_it_writes_scenes(installed, swing, tmp_path):
    code = """
import flexbody
from flexbody.scene import Scene
scene = Scene.from_file(r"{swing}")
print(flexbody.package(scene, "written.fmu", animation=False))
"""
    assert installed.run("python", "-c", code.format(swing=swing), cwd=tmp_path).strip() == "written.fmu"
    assert not fmpy.validation.validate_fmu(str(tmp_path / "written.fmu"))


@pytest.mark.parametrize(
    ("lacking", "message"),
    [
        (NAME, "expected the program flexbody in"),
        ("fmu", "expected libraries for FMUs in"),
        (None, "FLEXBODY_WHEEL_PLATFORM"),
    ],
)
def test_a_wheel_that_would_lack_something_is_refused(product, tmp_path, lacking, message):
    part = tmp_path / "part"
    part.mkdir()
    for path in product.iterdir():
        if path.name != lacking:
            (part / path.name).symlink_to(path)
    platform = {"FLEXBODY_WHEEL_PLATFORM": "linux_x86_64"} if lacking else {}
    made = build(tmp_path / "wheel", FLEXBODY_WHEEL_PRODUCT=str(part), **platform)
    assert made.returncode != 0 and message in made.stdout + made.stderr


def test_the_version_is_that_of_the_program():
    def version(path):
        return re.search(r'^version = "(.*?)"', path.read_text(encoding="utf-8"), re.MULTILINE)[1]

    assert version(PROJECT / "pyproject.toml") == version(ROOT / "Cargo.toml")
