"""Example units with reference results in the form of FMI's cross-check: `python tests/fmpy/cross_check.py [FOLDER]`.

For each scene there is a folder with `<name>.fmu`, `<name>_ref.csv` (outputs at every communication point of the
default experiment, by the program without the FMU) and `<name>_ref.opt` (start, stop, step and tolerance). Inputs keep
their start values, so that no example needs a file of inputs."""

import json
import sys
from pathlib import Path

from project import ROOT, package, xtask

SCENES = ["pendulum", "slider_crank", "gyroscope", "helical_spring"]


def example(scene, folder):
    """Writes the files of one scene, and returns their folder."""
    name = scene.stem
    folder = folder / name
    folder.mkdir(parents=True, exist_ok=True)
    # The planned scene, so that program and unit have one mesh and one tolerance.
    planned = folder / "planned.json"
    xtask("plan", scene, "--output", planned)
    xtask("simulate", planned, "--output", folder / f"{name}_ref.csv")
    package(planned, folder / f"{name}.fmu")
    described = json.loads(planned.read_text(encoding="utf-8"))
    experiment = described["experiment"]
    options = {
        "StartTime": 0.0,
        "StopTime": experiment["stop_time"],
        "StepSize": experiment["step"],
        "RelTol": described["accuracy"]["relative_tolerance"],
    }
    text = "".join(f"{key}, {value}\n" for key, value in options.items())
    (folder / f"{name}_ref.opt").write_text(text, encoding="utf-8")
    planned.unlink()
    return folder


if __name__ == "__main__":
    output = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "target" / "cross_check"
    for chosen in SCENES:
        print(example(ROOT / "scenes" / f"{chosen}.json", output))
