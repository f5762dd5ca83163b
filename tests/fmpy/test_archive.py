"""What is in the archive of an FMU; the rules of the standard for it are in `package_rules.py`."""

import zipfile

import pytest
from conftest import SWING
from fmpy import platform
from project import package

LIBRARY = {
    "linux64": "binaries/linux64/flexbody.so",
    "win64": "binaries/win64/flexbody.dll",
    "darwin64": "binaries/darwin64/flexbody.dylib",
}


@pytest.fixture
def entries(swing):
    with zipfile.ZipFile(swing.path) as archive:
        assert archive.testzip() is None
        return archive.infolist()


def test_holds_what_an_fmu_holds(entries):
    names = [entry.filename for entry in entries]
    assert names == sorted(names)
    assert set(names) == {
        "modelDescription.xml",
        "model.png",
        "resources/scene.json",
        "documentation/index.html",
        "documentation/scene.svg",
        LIBRARY[platform],
    }


def test_everything_is_deflated(entries):
    assert {entry.compress_type for entry in entries} == {zipfile.ZIP_DEFLATED}


def test_the_day_does_not_show(entries):
    assert {entry.date_time for entry in entries} == {(1980, 1, 1, 0, 0, 0)}


def test_packaging_twice_gives_the_same_bytes(swing, tmp_path):
    again = package(SWING, tmp_path / "again.fmu")
    assert again.read_bytes() == swing.path.read_bytes()


def test_the_icon_is_a_square_png(swing):
    header = (swing.folder / "model.png").read_bytes()[:24]
    assert header.startswith(b"\x89PNG\r\n\x1a\n")
    width, height = (int.from_bytes(header[at : at + 4], "big") for at in (16, 20))
    assert (width, height) == (256, 256)


def test_a_broken_scene_is_refused_with_its_place(tmp_path):
    scene = tmp_path / "broken.json"
    scene.write_text(SWING.read_text(encoding="utf-8").replace("5540.0", "-1.0"), encoding="utf-8")
    with pytest.raises(AssertionError, match=r"bodies\[0\]\.material\.density.*expected.*found -1"):
        package(scene, tmp_path / "broken.fmu")
    assert not (tmp_path / "broken.fmu").exists()
