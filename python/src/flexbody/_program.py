"""The program `flexbody`: where it is, and scenes handed to it."""

import csv
import os
import shutil
import subprocess
import sys
import tempfile
import warnings
from contextlib import contextmanager
from pathlib import Path

from flexbody._errors import Error

# What the program prints before everything that it says.
PREFIX = "flexbody: "
# Lines of progress begin with this.
PROGRESS = "... "
NAME = "flexbody.exe" if os.name == "nt" else "flexbody"
PRODUCT = Path(__file__).parent / "product"
# Names the program where it does not lie in the package.
PROGRAM = "FLEXBODY_PROGRAM"
# Tells the program which Python has this package.
PYTHON = "FLEXBODY_PYTHON"


class FlexbodyWarning(UserWarning):
    """What the program notes about a scene that it accepts."""


class Columns(dict):
    """Outputs by name, each a list of values at the communication points; `time` is the first."""


def program():
    """Path of the program: that of this package, else what FLEXBODY_PROGRAM names, else what is on PATH."""
    own = PRODUCT / NAME
    if own.is_file():
        return own
    named = os.environ.get(PROGRAM)
    if named:
        if not Path(named).is_file():
            raise Error(f"{PROGRAM}: {named} does not exist")
        return Path(named)
    found = _on_path()
    if found:
        return found
    raise Error(f"the program `flexbody` is neither in {PRODUCT} nor named by {PROGRAM} nor on PATH")


def _on_path():
    """The program on PATH; the command that this package installs is not it, but starts it."""
    own = Path(sys.executable).parent
    folders = os.environ.get("PATH", "").split(os.pathsep)
    others = [folder for folder in folders if folder and Path(folder).absolute() != own]
    found = shutil.which(NAME, path=os.pathsep.join(others))
    return Path(found) if found else None


def environment():
    """The environment that the program runs in."""
    return {**os.environ, PYTHON: sys.executable}


def run(*arguments, cwd=None):
    """Runs the program and returns what it prints; raises Error with its own message."""
    result = subprocess.run(
        [program(), *map(str, arguments)],
        cwd=cwd,
        env=environment(),
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        encoding="utf-8",
        errors="replace",
    )
    said = "\n".join(line for line in result.stderr.strip().splitlines() if not line.startswith(PROGRESS))
    if result.returncode != 0:
        raise Error(said.removeprefix(PREFIX) or f"the program ended with {result.returncode}")
    for line in said.splitlines():
        if line.startswith(PREFIX):
            warnings.warn(line.removeprefix(PREFIX), FlexbodyWarning, stacklevel=3)
    return result.stdout


@contextmanager
def _placed(scene):
    """A scene as a file: its folder and its name there, so that messages name the file alone."""
    if isinstance(scene, str | os.PathLike):
        path = Path(scene).absolute()
        yield path.parent, path.name
        return
    with tempfile.TemporaryDirectory(prefix="flexbody-") as folder:
        name = f"{scene.name}.json" if scene.name.replace("_", "").replace("-", "").isalnum() else "scene.json"
        scene.to_file(Path(folder) / name)
        _copy_files(scene, Path(folder).resolve())
        yield Path(folder), name


def _copy_files(scene, folder):
    """Puts the files that a scene names, which lie in the current folder, beside it; the program tells which are missing or misnamed."""
    for body in scene.bodies:
        name = getattr(body, "file", None)
        if name is None:
            continue
        target = (folder / name).resolve()
        if folder in target.parents and Path(name).is_file():
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(name, target)


def _beside(scene, extension):
    """Where results go if it is not said: the current folder."""
    stem = Path(scene).stem if isinstance(scene, str | os.PathLike) else scene.name
    return Path(stem + extension)


def package(scene, output=None, *, animation=True):
    """Makes an FMU of a scene.

    scene: a `flexbody.scene.Scene` or the path of a scene file.
    output: path of the FMU; `<name>.fmu` in the current folder if it is not given.
    animation: whether the page in the FMU shows the default experiment in motion.

    Returns the path of the FMU.
    """
    output = Path(output) if output is not None else _beside(scene, ".fmu")
    with _placed(scene) as (folder, name):
        still = [] if animation else ["--no-animation"]
        run("package", name, "--output", output.absolute(), *still, cwd=folder)
    return output


def simulate(scene, *, stop_time=None, step=None, values=None, input=None):
    """Simulates a scene and returns its outputs.

    scene: a `flexbody.scene.Scene` or the path of a scene file.
    stop_time, step: where the run ends and the time between communication points, s; those of the scene's experiment
        if they are not given.
    values: values of parameters and inputs by name, such as `{"rod.density": 7800.0}`.
    input: inputs that vary in time: the path of a CSV file with a column `time` and one for every input, or such
        columns by name.

    Returns a `Columns`: `time` and the outputs by name, each a list of floats.
    """
    with _placed(scene) as (folder, name), tempfile.TemporaryDirectory(prefix="flexbody-") as results:
        table = Path(results) / "outputs.csv"
        arguments = ["simulate", name, "--output", table]
        for option, value in [("--stop-time", stop_time), ("--step", step)]:
            if value is not None:
                arguments += [option, repr(float(value))]
        for variable, value in (values or {}).items():
            arguments += [
                "--set",
                f"{variable}={value!r}" if isinstance(value, int) else f"{variable}={float(value)!r}",
            ]
        if input is not None:
            arguments += ["--input", _table(input, Path(results) / "inputs.csv")]
        run(*arguments, cwd=folder)
        return read_columns(table)


def _table(columns, path):
    """Columns as a CSV file, if they are not in one already."""
    if isinstance(columns, str | os.PathLike):
        return Path(columns).absolute()
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(columns)
        writer.writerows(zip(*([float(value) for value in column] for column in columns.values()), strict=True))
    return path


def read_columns(path):
    """Outputs as `flexbody simulate` writes them: CSV with names in the first row."""
    with Path(path).open(encoding="utf-8", newline="") as file:
        names, *rows = csv.reader(file)
    return Columns({name: [float(row[index]) for row in rows] for index, name in enumerate(names)})


def view(scene, output=None, *, open=True):
    """Shows something in motion: writes a page of HTML and opens it in the browser.

    scene: a `flexbody.scene.Scene`, or the path of a scene file, of an FMU or of a CSV file of outputs.
    output: path of the page; `<name>.html` in the current folder if it is not given.
    open: whether the browser opens it.

    Returns the path of the page.
    """
    output = Path(output) if output is not None else _beside(scene, ".html")
    with _placed(scene) as (folder, name):
        shut = [] if open else ["--no-open"]
        run("view", name, "--output", output.absolute(), *shut, cwd=folder)
    return output
