"""`cargo xtask simulate`: experiments, inputs that vary in time, and what is refused, alike for scenes and FMUs."""

import math

import numpy as np
import plot
import pytest
from conftest import ROOT
from project import xtask

# A mass on a rail, pushed: its way is an integral of the force.
SCENE = """{"name": "sled", "dimension": 2, "gravity": [0.0, 0.0],
  "bodies": [{"name": "sled", "element": "rigid", "mass": 2.0, "inertia": 0.0, "position": [0.0, 0.0],
              "markers": {"hook": [0.0, 0.0]}}],
  "joints": [{"name": "rail", "kind": "point_on_line", "markers": ["ground", "sled.hook"], "direction": [1.0, 0.0]}],
  "inputs": [{"kind": "force", "marker": "sled.hook"}],
  "outputs": [{"kind": "position", "marker": "sled.hook"}, {"kind": "velocity", "marker": "sled.hook"}],
  "accuracy": {"relative_tolerance": 1e-8},
  "experiment": {"stop_time": 2.0, "step": 0.25}}"""
# Up along a line, a jump between communication points, then down.
FORCE = "time,sled.hook.force[1]\n0,0\n0.6,3.0\n0.6,-1.0\n2,-2.4\n"


def velocity(time):
    """Integral of the force over the mass."""
    if time <= 0.6:
        return 2.5 * time**2 / 2.0
    late = time - 0.6
    return (2.5 * 0.36 - late - 0.5 * late**2) / 2.0


def position(time):
    if time <= 0.6:
        return 2.5 * time**3 / 6.0
    late = time - 0.6
    return 2.5 * 0.216 / 6.0 + velocity(0.6) * late - late**2 / 4.0 - late**3 / 12.0


@pytest.fixture(scope="module")
def sled(tmp_path_factory):
    """The scene and its FMU."""
    folder = tmp_path_factory.mktemp("sled")
    scene = folder / "sled.json"
    scene.write_text(SCENE, encoding="utf-8")
    xtask("package", scene, "--output", folder / "sled.fmu")
    return {"json": scene, "fmu": folder / "sled.fmu"}


@pytest.mark.parametrize("kind", ["json", "fmu"])
def test_inputs_follow_their_table(sled, kind, tmp_path):
    table, output = tmp_path / "force.csv", tmp_path / "run.csv"
    table.write_text(FORCE, encoding="utf-8")
    xtask("simulate", sled[kind], "--input", table, "--output", output)
    run = plot.read_table(output)
    # Stop time and step are those of the experiment.
    assert run["time"] == pytest.approx(np.linspace(0.0, 2.0, 9))
    for time, x, v in zip(run["time"], run["sled.hook.position[1]"], run["sled.hook.velocity[1]"]):
        assert x == pytest.approx(position(time), abs=1e-7)
        assert v == pytest.approx(velocity(time), abs=1e-7)


@pytest.mark.parametrize("kind", ["json", "fmu"])
def test_stop_time_and_step_can_be_given(sled, kind, tmp_path):
    output = tmp_path / "run.csv"
    xtask("simulate", sled[kind], "--stop-time", "0.25", "--step", "0.1", "--output", output, "--set", "sled.hook.force[1]=4")
    run = plot.read_table(output)
    assert run["time"] == pytest.approx([0.0, 0.1, 0.2, 0.25])
    assert run["sled.hook.velocity[1]"] == pytest.approx(2.0 * run["time"], abs=1e-9)


WRONG = {
    "nearest": ("time,sled.hook.fource[1]\n0,0\n2,0\n", "sled.hook.fource.1.*did you mean.*sled.hook.force.1"),
    "no time": ("t,sled.hook.force[1]\n0,0\n2,0\n", "line 1: expected a .*column `time`"),
    "no input": ("time\n0\n2\n", "line 1: expected a .*column"),
    "output": ("time,sled.hook.position[1]\n0,0\n2,0\n", "expected an input, found another variable"),
    "twice": ("time,sled.hook.force[1],sled.hook.force[1]\n0,0,0\n2,0,0\n", "every input once"),
    "text": ("time,sled.hook.force[1]\n0,0\n2,x\n", "line 3: expected .*number.* found .*x"),
    "short": ("time,sled.hook.force[1]\n0,0\n2\n", "line 3: expected 2 .*numbers, found"),
    "not finite": ("time,sled.hook.force[1]\n0,nan\n2,0\n", "line 2: expected .*finite number.*nan"),
    "back": ("time,sled.hook.force[1]\n0,0\n1,0\n0.5,0\n2,0\n", "line 4: expected a time of 1.* s or later, found 0.5 s"),
    "third": ("time,sled.hook.force[1]\n0,0\n1,0\n1,1\n1,2\n2,0\n", "line 5: expected two rows at most at 1.* s"),
    "late": ("time,sled.hook.force[1]\n0.5,0\n2,0\n", "from 0 s to the stop time 2.* s, found 0.5 s to 2.* s"),
    "early": ("time,sled.hook.force[1]\n0,0\n1.5,0\n", "from 0 s to the stop time 2.* s, found 0.* s to 1.5 s"),
    "empty": ("", "line 1: expected a .*column `time`"),
    "no rows": ("time,sled.hook.force[1]\n", "expected .*row"),
}


@pytest.mark.parametrize("kind", ["json", "fmu"])
@pytest.mark.parametrize("text, message", WRONG.values(), ids=WRONG)
def test_wrong_tables_are_refused(sled, kind, text, message, tmp_path):
    table = tmp_path / "force.csv"
    table.write_text(text, encoding="utf-8")
    with pytest.raises(AssertionError, match=message):
        xtask("simulate", sled[kind], "--input", table, "--output", tmp_path / "run.csv")


@pytest.mark.parametrize("kind", ["json", "fmu"])
def test_names_that_are_not_there_get_the_nearest(sled, kind, tmp_path):
    for given, expected in [("sled.mas=1", "sled.mass"), ("sled.hook.force=1", r"sled.hook.force\[1\]")]:
        with pytest.raises(AssertionError, match=f"did you mean .*`{expected}`"):
            xtask("simulate", sled[kind], "--set", given, "--output", tmp_path / "run.csv")
    with pytest.raises(AssertionError, match="no variable of this name\n"):
        xtask("simulate", sled[kind], "--set", "xyz=1", "--output", tmp_path / "run.csv")
    table = tmp_path / "force.csv"
    table.write_text(FORCE, encoding="utf-8")
    with pytest.raises(AssertionError, match="sets it already"):
        xtask("simulate", sled[kind], "--input", table, "--set", "sled.hook.force[1]=1", "--output", tmp_path / "run.csv")


def test_a_run_of_an_fmu_is_drawn_with_its_bodies(sled, tmp_path):
    xtask("simulate", sled["fmu"], "--output", tmp_path / "run.csv", "--plot", tmp_path / "run.png", "--set", "sled.hook.force[1]=1")
    shapes, run = plot.Shapes(tmp_path / "run.shapes.jsonl"), plot.read_table(tmp_path / "run.csv")
    assert shapes.paths["sled.hook"][:, 0] == pytest.approx(run["sled.hook.position[1]"], abs=1e-9)
    assert (tmp_path / "run.png").stat().st_size > 10_000


def test_motions_follow_their_table(tmp_path):
    """A crane's trolley: way, speed and acceleration of one motion, given together."""
    names = [f"travel.{quantity}" for quantity in ("displacement", "velocity", "acceleration")]
    rows = [[t, 0.5 * t**2, t, 1.0] for t in np.linspace(0.0, 1.0, 11)]
    table = tmp_path / "drive.csv"
    lines = [",".join(["time", *names]), *(",".join(map(str, row)) for row in rows)]
    table.write_text("\n".join(lines), encoding="utf-8")
    scene = ROOT / "scenes" / "crane.json"
    xtask("simulate", scene, "--input", table, "--output", tmp_path / "run.csv", "--stop-time", "1", "--step", "0.1")
    run = plot.read_table(tmp_path / "run.csv")
    assert run["trolley.centre.position[1]"] == pytest.approx(0.5 * run["time"] ** 2, abs=1e-9)
    assert all(map(math.isfinite, run["travel.reaction[1]"]))
