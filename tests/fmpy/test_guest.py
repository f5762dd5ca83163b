"""What is left behind in a process that loaded the library: nothing."""

import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
from fmpy import platform
from project import ROOT, package

COPIES = 200
# Growth of the process over the second half of its loads, kB: what the interpreter itself may take.
GROWTH = 1024

# A process of its own: what another test has loaded must not count.
GUEST = """
import shutil, sys
from pathlib import Path
sys.path.insert(0, sys.argv[1])
from instance import Fmu, Instance

fmu = Fmu(sys.argv[2], Path(sys.argv[3]) / "0")
for number in range(int(sys.argv[4])):
    folder = Path(sys.argv[3]) / f"copy{number}"
    shutil.copytree(fmu.folder, folder)
    with Instance(fmu, folder=folder) as instance:
        instance.initialize()
        instance.run(0.02, 0.01)
    shutil.rmtree(folder)
    if number % 20 == 19:
        maps = Path("/proc/self/maps").read_text()
        left = sum("copy" in line for line in maps.splitlines())
        pages = int(Path("/proc/self/statm").read_text().split()[1])
        print(number + 1, left, 4 * pages)
"""


@pytest.mark.skipif(not platform.startswith("linux"), reason="reads /proc")
@pytest.mark.parametrize("scene", ["tests/fmpy/swing.json", "tests/fmpy/mechanism.json"])
def test_copies_that_ran_are_unloaded(fmu_of, scene, tmp_path):
    fmu = fmu_of(ROOT / scene)
    command = [sys.executable, "-c", GUEST, str(Path(__file__).parent), fmu.path, tmp_path, str(COPIES)]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stderr
    rows = [tuple(map(int, line.split())) for line in result.stdout.splitlines()]
    assert rows[-1][0] == COPIES
    assert [left for _, left, _ in rows] == [0] * len(rows)
    assert rows[-1][2] - rows[len(rows) // 2][2] < GROWTH, rows


def test_terminals_can_be_left_out(tmp_path):
    boom = ROOT / "scenes" / "boom.json"
    whole, without = (package(boom, tmp_path / f"{name}.fmu", *options) for name, options in VARIANTS.items())
    with zipfile.ZipFile(whole) as first, zipfile.ZipFile(without) as second:
        gone = set(first.namelist()) - set(second.namelist())
        assert {name for name in gone if not name.endswith("/")} == {"terminalsAndIcons/terminalsAndIcons.xml"}
        for name in second.namelist():
            assert first.read(name) == second.read(name)


VARIANTS = {"whole": [], "without": ["--no-terminals"]}
