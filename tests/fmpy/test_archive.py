"""The zip archive of an FMU, by the rules of FMI 2.0 section 2.3."""

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
# Largest "version needed to extract" that FMI 2.0 allows; zip64 needs 45.
MOST_VERSION = 20
# Bits 0 and 6: encryption.
ENCRYPTED = 0b100_0001
ZIP64_FIELD = 0x0001
SYMBOLIC_LINK = 0o120000


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


def test_every_importer_can_read_it(entries):
    for entry in entries:
        assert entry.compress_type == zipfile.ZIP_DEFLATED, entry.filename
        assert entry.extract_version <= MOST_VERSION, entry.filename
        assert not entry.flag_bits & ENCRYPTED, entry.filename
        assert (entry.external_attr >> 16) & 0o170000 != SYMBOLIC_LINK, entry.filename
        assert "\\" not in entry.orig_filename
        fields = entry.extra
        while len(fields) >= 4:
            kind, size = int.from_bytes(fields[:2], "little"), int.from_bytes(fields[2:4], "little")
            assert kind != ZIP64_FIELD, entry.filename
            fields = fields[4 + size :]


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
