"""What is in the archive of an FMU; the rules of the standard for it are in `package_rules.py`."""

import tomllib
import zipfile

import pytest
from conftest import SWING
from fmpy import platform
from project import ROOT, package

LICENSES = ["license.txt", "LICENSE-MIT", "LICENSE-APACHE", "crates.txt"]
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
        *(f"documentation/licenses/{name}" for name in LICENSES),
        next(name for name in names if name.startswith("documentation/licenses/rust-")),
        LIBRARY[platform],
    }


def test_licenses_of_all_that_is_linked_are_in_it(swing):
    folder = swing.folder / "documentation" / "licenses"
    for name in ("LICENSE-MIT", "LICENSE-APACHE"):
        assert (folder / name).read_text(encoding="utf-8") == (ROOT / name).read_text(encoding="utf-8")
    crates = (folder / "crates.txt").read_text(encoding="utf-8")
    lock = tomllib.loads((ROOT / "Cargo.lock").read_text(encoding="utf-8"))
    versions = {(package["name"], package["version"]) for package in lock["package"]}
    named = {tuple(line.split(":")[0].split(" ")) for line in crates.split("\n\n")[1].splitlines()}
    assert named <= versions
    assert {"nalgebra", "serde_json", "libc"} <= {name for name, _ in named}
    (rust,) = folder.glob("rust-*.html")
    assert "The Rust Standard Library" in rust.read_text(encoding="utf-8")
    page = (swing.folder / "documentation" / "index.html").read_text(encoding="utf-8")
    assert 'href="licenses/license.txt"' in page


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
