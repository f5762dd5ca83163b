"""What the wheel is made of."""

import os
import re
import subprocess
import sys
import zipfile

import pytest
from conftest import NAME, ROOT

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
