"""The libraries in an FMU: they load on old systems, tell nothing of the machine that built them,
and compute elsewhere what they compute here."""

import os
import re
import shutil
import socket
import subprocess
import sys
import zipfile
from getpass import getuser
from pathlib import Path
from urllib.parse import quote

import numpy as np
import pytest
from conftest import SWING, place_of
from elftools.elf.elffile import ELFFile
from fmpy import platform
from instance import Fmu, Instance
from project import ROOT, package, xtask

SOURCES = Path(__file__).parent
# Communication steps on another platform.
STEPS = 10
on_linux = pytest.mark.skipif(not platform.startswith("linux"), reason="no ELF library here")
# Oldest glibc that the library may ask for.
GLIBC = (2, 17)
SYSTEM_LIBRARIES = {"libc.so.6", "libm.so.6", "libpthread.so.0", "libdl.so.2", "librt.so.1", "ld-linux-x86-64.so.2"}
# Paths that are the same on every machine: those of the system, and those compiled into Rust's standard library.
COMMON_PATHS = ("/rustc/", "/rust/deps/", "/proc/", "/sys/", "/dev/", "/etc/", "/usr/lib")
FUNCTIONS = {
    f"fmi2{name}"
    for name in (
        "GetTypesPlatform GetVersion SetDebugLogging Instantiate FreeInstance SetupExperiment "
        "EnterInitializationMode ExitInitializationMode Terminate Reset "
        "GetReal GetInteger GetBoolean GetString SetReal SetInteger SetBoolean SetString "
        "GetFMUstate SetFMUstate FreeFMUstate SerializedFMUstateSize SerializeFMUstate DeSerializeFMUstate "
        "GetDirectionalDerivative SetRealInputDerivatives GetRealOutputDerivatives DoStep CancelStep "
        "GetStatus GetRealStatus GetIntegerStatus GetBooleanStatus GetStringStatus"
    ).split()
}


@pytest.fixture(scope="module")
def library(swing):
    """The one library in an FMU for this machine."""
    (path,) = (swing.folder / "binaries").glob("*/*")
    return path


@pytest.fixture
def elf(library):
    with library.open("rb") as file:
        yield ELFFile(file)


@on_linux
def test_old_systems_can_load_it(elf):
    files = elf.get_section_by_name(".gnu.version_r").iter_versions()
    names = [version.name.partition("_") for _, versions in files for version in versions]
    assert {kind for kind, _, _ in names} == {"GLIBC"}
    assert max(tuple(map(int, version.split("."))) for _, _, version in names) <= GLIBC


@on_linux
def test_it_needs_the_system_alone(elf):
    tags = list(elf.get_section_by_name(".dynamic").iter_tags())
    assert {tag.needed for tag in tags if tag.entry.d_tag == "DT_NEEDED"} <= SYSTEM_LIBRARIES
    assert not [tag for tag in tags if tag.entry.d_tag in ("DT_RPATH", "DT_RUNPATH", "DT_TEXTREL")]


@on_linux
def test_it_offers_the_functions_of_the_standard_and_nothing_else(elf):
    symbols = elf.get_section_by_name(".dynsym").iter_symbols()
    offered = {symbol.name for symbol in symbols if symbol.name and symbol.entry.st_shndx != "SHN_UNDEF"}
    assert offered == FUNCTIONS


@on_linux
def test_nothing_is_left_for_a_debugger(elf):
    sections = {section.name for section in elf.iter_sections()}
    assert not [name for name in sections if name == ".symtab" or name.startswith(".debug")]


def test_it_does_not_tell_where_it_was_built(library):
    code = library.read_bytes()
    paths = {path.decode() for path in re.findall(rb"(?<![\w.<>:/*~-])/[\w.+@-]{2,}/[\w.+@/-]{4,}", code)}
    assert sorted(path for path in paths if not path.startswith(COMMON_PATHS)) == []
    assert not re.search(rb"[A-Z]:\\\\?[A-Za-z]", code)
    places = {str(place) for place in (ROOT, Path.home(), library.parents[3]) if len(place.parts) > 1}
    # Short names, and those that a program may hold for other reasons, say nothing.
    names = {name for name in (socket.gethostname(), getuser()) if len(name) > 5 and name != "localhost"}
    assert [text for text in places | names if text.encode() in code] == []


def test_merging_an_fmu_with_itself_changes_nothing(swing, tmp_path):
    merged = tmp_path / "merged.fmu"
    xtask("merge", swing.path, swing.path, "--output", merged)
    assert merged.read_bytes() == swing.path.read_bytes()


def test_merging_adds_platforms(swing, tmp_path):
    other, merged = tmp_path / "other.fmu", tmp_path / "merged.fmu"
    elsewhere = next(name for name in ("darwin64", "win64") if name != platform)
    with zipfile.ZipFile(swing.path) as archive, zipfile.ZipFile(other, "w") as copy:
        for name in archive.namelist():
            copy.writestr(name.replace(platform, elsewhere), archive.read(name))
    xtask("merge", swing.path, other, "--output", merged)
    with zipfile.ZipFile(swing.path) as archive, zipfile.ZipFile(merged) as joined:
        both = {name: archive.read(name) for name in archive.namelist()}
        both |= {name.replace(platform, elsewhere): content for name, content in both.items()}
        assert {name: joined.read(name) for name in joined.namelist()} == both


def test_merging_fmus_of_different_scenes_is_refused(swing, variant, tmp_path):
    other = variant(gravity=[0.0, -1.62])
    with pytest.raises(AssertionError, match="different: modelDescription.xml, .*resources/scene.json"):
        xtask("merge", swing.path, other.path, "--output", tmp_path / "merged.fmu")
    assert not (tmp_path / "merged.fmu").exists()


PRODUCTS = Path(sys.prefix).parent


def zig(folder, target, *arguments):
    """Compiles C in a folder with the compiler that comes with the linker of libraries."""
    cache = str(PRODUCTS / "linker" / "cache")
    environment = os.environ | {"ZIG_GLOBAL_CACHE_DIR": cache, "ZIG_LOCAL_CACHE_DIR": cache}
    python = PRODUCTS / "python-linker" / "bin" / "python"
    command = [python, "-m", "ziglang", "cc", "-target", target, "-O1", *arguments]
    subprocess.run(command, cwd=folder, env=environment, check=True)


class Wine:
    """Runs libraries for Windows."""

    platform = "win64"
    needs = "wine"
    resources = "file:///Z:"

    def __init__(self, folder):
        target = "x86_64-windows-gnu"
        zig(folder, target, "-o", "foreign.exe", SOURCES / "foreign.c")
        # Beside the program it is found first. Wine 8 has none, and no library of Rust loads there.
        name = "bcryptprimitives"
        zig(folder, target, "-shared", "-o", f"{name}.dll", SOURCES / f"{name}.c", "-ladvapi32")
        self.command = ["wine", folder / "foreign.exe"]
        self.environment = {"WINEPREFIX": str(folder / "prefix"), "WINEDEBUG": "-all"}


class Qemu:
    """Runs libraries for Linux on 64-bit ARM, with the system libraries of Debian's package libc6-arm64-cross."""

    platform = "aarch64-linux"
    needs = "qemu-aarch64"
    resources = "file://"

    def __init__(self, folder):
        zig(folder, "aarch64-linux-gnu.2.17", "-o", "foreign", SOURCES / "foreign.c", "-ldl")
        self.command = ["qemu-aarch64", "-L", "/usr/aarch64-linux-gnu", folder / "foreign"]
        self.environment = {}


@pytest.fixture(scope="module", params=[Wine, Qemu], ids=lambda kind: kind.platform)
def foreign(request, swing, tmp_path_factory):
    """What runs the libraries of another platform here."""
    kind = request.param
    if not shutil.which(kind.needs):
        pytest.skip(f"{kind.platform} not run: {kind.needs} is not installed")
    folder = tmp_path_factory.mktemp(kind.platform)
    try:
        package(SWING, folder / "first.fmu", "--platform", kind.platform)
    except AssertionError as error:
        if "rustup target add" in str(error):
            pytest.skip(f"{kind.platform} not run: {str(error).splitlines()[-1]}")
        raise
    return kind(folder)


def scenes():
    return [path for path in sorted((ROOT / "scenes").glob("*.json")) if not path.name.endswith(".schema.json")]


@pytest.mark.parametrize("scene", scenes(), ids=place_of)
def test_another_platform_computes_the_same(foreign, scene, fmu_of, tmp_path):
    """Ten communication steps of every scene; the GUID, derived there anew, is then the same as well."""
    here = fmu_of(scene)
    there = Fmu(package(scene, tmp_path / f"{scene.stem}.fmu", "--platform", foreign.platform), tmp_path / "extracted")
    assert there.description.guid == here.description.guid
    outputs = here.names("output")
    step = float(here.description.defaultExperiment.stepSize)
    with Instance(here) as instance:
        instance.initialize()
        expected = []
        for index in range(STEPS):
            instance.slave.doStep(index * step, step)
            expected.append(instance.get(outputs))
    (library,) = (there.folder / "binaries" / foreign.platform).iterdir()
    references = [str(here.variable(name).valueReference) for name in outputs]
    resources = foreign.resources + quote(str(there.folder / "resources"))
    arguments = [library, here.description.guid, resources, repr(step), str(STEPS), *references]
    environment = os.environ | foreign.environment
    result = subprocess.run([*foreign.command, *arguments], env=environment, capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stdout + result.stderr
    found = [[float(value) for value in line.split()] for line in result.stdout.splitlines()]
    np.testing.assert_allclose(found, expected, rtol=1e-6, atol=1e-6)
