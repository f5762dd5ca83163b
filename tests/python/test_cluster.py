"""Sweeps on a cluster: nothing is lost, and every bit is that of a run in one process."""

import json
import os
import signal
import subprocess
import sys
from types import SimpleNamespace

import pytest
from flexbody import cluster
from flexbody._errors import Error
from flexbody._unit import Failure, Unit, communication_points
from instance import Fmu, Instance

PLAN = {
    "inputs": ["rod.density", "rod.tip.force[2]"],
    "outputs": ["rod.tip.position[1]", "rod.tip.position[2]", "energy.kinetic"],
    "stop_time": 0.52,
    "step": 0.05,
    "fixed": {"rod.elements": 3, "rod.tip.force[1]": 0.2},
}
# The run whose density the unit refuses.
REFUSED = 5


def values(run):
    return [-1.0 if run == REFUSED else 5000.0 + 1000 / (run + 3), -0.1 * run]


def lines(runs):
    yield json.dumps(PLAN)
    for run in runs:
        yield json.dumps({"run": run, "values": values(run)})


def expected(fmu, folder, runs):
    """The same by fmpy in this process, an instance a run."""
    unit = Fmu(fmu, folder)
    found = {}
    for run in runs:
        with Instance(unit, logging=False) as instance:
            instance.initialize({**PLAN["fixed"], **dict(zip(PLAN["inputs"], values(run), strict=True))})
            rows = [instance.get(PLAN["outputs"])]
            times = [0.0]
            for now in instance.steps(PLAN["stop_time"], PLAN["step"]):
                times.append(now)
                rows.append(instance.get(PLAN["outputs"]))
        found[run] = (times, rows)
    return found


def start(fmu, *, workers=3, scheduler="local"):
    command = [sys.executable, "-m", "flexbody.cluster", "--scheduler", scheduler, "--workers", str(workers), str(fmu)]
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    return subprocess.Popen(command, text=True, **pipes)


def checked(results, reference, count):
    """Every run is there once, with the bits of the reference; the one that is refused says why."""
    assert sorted(result["run"] for result in results) == list(range(count))
    for result in results:
        if result["run"] == REFUSED:
            assert result == {
                "run": REFUSED,
                "error": "fmi2SetReal: rod.density: expected a positive number (kg/m^3), found -1",
            }
        else:
            times, rows = reference[result["run"]]
            # Numbers equal, and none of them is not a number: the same bits.
            assert result["times"] == times and result["values"] == rows, result["run"]


def children(process):
    """Worker processes of a cluster, of whatever generation: those that run Dask's worker, not what watches over them."""
    commands, parents = {}, {}
    for entry in os.listdir("/proc"):
        try:
            with open(f"/proc/{entry}/stat", encoding="utf-8") as file:
                parent = int(file.read().rpartition(")")[2].split()[1])
            with open(f"/proc/{entry}/cmdline", encoding="utf-8") as file:
                commands[int(entry)] = file.read()
        except (OSError, ValueError):
            continue
        parents[int(entry)] = parent

    def descends(number):
        while number in parents and number != process.pid:
            number = parents[number]
        return number == process.pid

    return [number for number, command in commands.items() if "spawn_main" in command and descends(number)]


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="finds workers in /proc")
def test_a_killed_worker_loses_nothing(fmu, tmp_path):
    count = 120
    process = start(fmu)
    for line in lines(range(count)):
        process.stdin.write(line + "\n")
    process.stdin.close()
    results = []
    killed = []
    for line in process.stdout:
        results.append(json.loads(line))
        if len(results) == 10:
            workers = children(process)
            assert len(workers) == 3, workers
            killed = workers[:1]
            os.kill(killed[0], signal.SIGKILL)
    errors = process.stderr.read()
    assert process.wait() == 0, errors
    assert killed
    checked(results, expected(fmu, tmp_path, [run for run in range(count) if run != REFUSED]), count)


def test_after_a_failure_the_instance_is_as_new(fmu, tmp_path):
    unit = Unit(str(fmu), tmp_path / "unit")
    reference = expected(fmu, tmp_path / "reference", [0])[0]
    try:
        for fixed, reason in [
            ({"work_limit": 10.0}, "fmi2DoStep: .*work_limit"),
            ({"rod.elements": 2.5}, "^rod.elements: expected an integer, found 2.5$"),
            ({"rod.elements": -1}, "fmi2SetInteger: rod.elements"),
        ]:
            with pytest.raises(Failure, match=reason):
                unit.run({**PLAN, "fixed": fixed}, values(0))
            found = unit.run(PLAN, values(0))
            assert (found["times"], found["values"]) == reference
    finally:
        unit.free()


def test_runs_are_taken_only_as_there_is_room(fmu, tmp_path, monkeypatch):
    """A reader that hands in what it is asked for, on a cluster of others whose workers come by themselves."""
    from distributed import LocalCluster

    monkeypatch.setattr(cluster, "MOST", 4)
    count = 120
    taken = []
    done = []

    def handed_in():
        for number, line in enumerate(lines(range(count))):
            taken.append(number - len(done))
            yield line

    output = SimpleNamespace(write=lambda text: text.strip() and done.append(json.loads(text)), flush=lambda: None)
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as others:
        arguments = SimpleNamespace(scheduler=others.scheduler_address, workers=0, fmu=fmu)
        cluster.sweep(arguments, handed_in(), output)
    checked(done, expected(fmu, tmp_path, [run for run in range(count) if run != REFUSED]), count)
    # At work or waiting at two threads, read ahead, and one in the hand of either.
    assert max(taken) <= cluster.AHEAD * 2 * 4 + 4 + 2


def test_what_the_unit_lacks_is_said_before_anything_runs(fmu):
    for part, name in [("inputs", "rod.densty"), ("outputs", "rod.tip"), ("fixed", "x")]:
        plan = {**PLAN, part: {name: 1.0} if part == "fixed" else [name]}
        with pytest.raises(Error, match=f"{name}: .* has no variable of this name"):
            cluster.checked(plan, fmu)
    process = start(fmu)
    _, errors = process.communicate(json.dumps({**PLAN, "outputs": ["rod.tip"]}) + "\n")
    assert process.returncode == 1
    assert "rod.tip: " in errors and "Traceback" not in errors


def test_a_scheduler_that_is_not_there_is_an_error(fmu, monkeypatch):
    monkeypatch.setattr(cluster, "PATIENCE", 1)
    arguments = SimpleNamespace(scheduler="tcp://127.0.0.1:9", workers=0, fmu=fmu)
    with pytest.raises(OSError, match="127.0.0.1:9"):
        cluster.sweep(arguments, lines(range(2)), sys.stdout)


@pytest.mark.parametrize(
    ("stop_time", "step", "times"),
    [
        (1.0, 0.25, [0.0, 0.25, 0.5, 0.75, 1.0]),
        (0.3, 0.1, [0.0, 0.1, 0.2, 0.3]),
        (0.25, 0.1, [0.0, 0.1, 0.2, 0.25]),
        (0.05, 0.1, [0.0, 0.05]),
    ],
)
def test_communication_points_are_those_of_the_program(stop_time, step, times):
    assert communication_points(stop_time, step) == times
