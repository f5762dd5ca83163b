"""From CalculiX to a unit: the files of the tutorial, run where CalculiX is installed."""

import re
import shutil
import subprocess
import sys

import pytest
from conftest import ROOT, package

FILES = ROOT / "docs" / "book" / "src" / "tutorial" / "files"
NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e-?\d+)?")
# Largest relative difference between the unit and CalculiX.
DIFFERENCE = 1e-4


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder where the commands of the tutorial have run, with what its scripts printed."""
    if not shutil.which("ccx"):
        pytest.skip("CalculiX is not installed (Debian: calculix-ccx)")
    folder = tmp_path_factory.mktemp("lever")
    for path in FILES.glob("lever*"):
        shutil.copy(path, folder)
    script(folder, "lever_deck.py")
    for job in ("free", "clamped", "loaded"):
        said = subprocess.run(["ccx", job], cwd=folder, capture_output=True, text=True, check=False)
        assert said.returncode == 0 and "Job finished" in said.stdout, said.stdout
    (folder / "reduced.txt").write_text(script(folder, "lever_reduce.py"), encoding="utf-8")
    package(folder / "lever.json", folder / "lever.fmu")
    (folder / "run.txt").write_text(script(folder, "lever_run.py"), encoding="utf-8")
    return folder


def script(folder, name):
    """Runs a script of the tutorial and returns what it prints."""
    done = subprocess.run([sys.executable, name], cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_the_unit_answers_what_calculix_does(folder):
    """Five frequencies of the clamped lever and its deflection under 1 N."""
    rows = [line.split() for line in (folder / "run.txt").read_text(encoding="utf-8").splitlines()[1:7]]
    assert [row[1] for row in rows] == ["Hz"] * 5 + ["mm"]
    for known, _, found, _, difference in rows:
        assert float(found) == pytest.approx(float(known), rel=DIFFERENCE)
        assert float(difference) < DIFFERENCE


def test_the_tutorial_shows_what_is_printed(folder):
    for printed, shown in [("reduced.txt", "lever_reduce.txt"), ("run.txt", "lever_run.txt")]:
        printed, shown = (
            (place / name).read_text(encoding="utf-8") for place, name in [(folder, printed), (FILES, shown)]
        )
        # Differences from CalculiX are those of its last digit.
        printed, shown = (re.sub(r"\S+e-\d+$", "", text, flags=re.MULTILINE) for text in (printed, shown))
        words = [NUMBER.sub("", text).split() for text in (printed, shown)]
        assert words[0] == words[1]
        found, expected = ([float(number) for number in NUMBER.findall(text)] for text in (printed, shown))
        assert found == pytest.approx(expected, rel=1e-4)
