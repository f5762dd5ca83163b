"""Errors of a run by its reference, over the error wanted, and whether the program told."""

import csv
import json
import re
import subprocess
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

try:
    import resource
except ImportError:
    resource = None


# Seconds that planning may take.
BUDGET = 20


@dataclass
class Verdict:
    """What came of one output."""

    name: str
    wanted: float
    # True error over the error wanted; infinite where there is no answer.
    score: float
    # Who told: `run` (the run names the output), `mesh` (it names the body whose mesh is too coarse), `held` (it names
    # inputs that were held), `plan` and `held by plan` (only the plan does), or nobody.
    told: str
    note: str = ""


class Unsettled(Exception):
    """A reference that is not converged."""


def scale(case, name, right):
    """The largest change of an output over the run."""
    if name in case.drawn:
        return np.linalg.norm(right - case.drawn[name], axis=1).max()
    return np.linalg.norm(right, axis=1).max()


def references(case, times, levels=4):
    """The right values, of the first level that the one before confirms to a tenth of the error wanted."""
    coarse = case.right(times, 0)
    for level in range(1, levels):
        fine = case.right(times, level)
        worst = max((difference(case, name, coarse[name], fine[name]), name) for name in case.counted)
        if worst[0] <= 0.1 * case.wanted:
            return fine
        coarse = fine
    raise Unsettled(f"{worst[1]}: {worst[0]:.1e} between two references")


def remembered(case, times, path):
    """The right values, from a file of an earlier run of the same scene."""
    key = json.dumps([case.scene, case.inputs, list(times)])
    if path.exists():
        with np.load(path) as found:
            if str(found["key"]) == key:
                return {name: found[name] for name in found.files if name != "key"}
    right = references(case, times)
    np.savez(path, key=np.array(key), **right)
    return right


def difference(case, name, found, right):
    """Largest difference of two runs of an output over its largest change."""
    kept = slice(1, None) if name in case.dynamic and len(right) > 2 else slice(None)
    size = scale(case, name, right[kept])
    return np.linalg.norm(found[kept] - right[kept], axis=1).max() / size


def invoke(program, command, *arguments, seconds=60):
    """Runs the program for at most so much of a processor's time; gives its text, or None and why there is none."""
    text = [program, command, *map(str, arguments)]
    limit = (lambda: resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 1))) if resource else None
    try:
        # On a busy machine time of the clock says little.
        done = subprocess.run(text, capture_output=True, text=True, timeout=20 * seconds, preexec_fn=limit)
    except subprocess.TimeoutExpired:
        return None, f"more than {seconds} s"
    if done.returncode < 0:
        return None, f"ended by signal {-done.returncode}, after {seconds} s perhaps"
    if done.returncode:
        return None, (done.stderr.strip().splitlines() or ["no word"])[-1][:300]
    return done.stdout + done.stderr, ""


def children():
    """Seconds of a processor that programs have taken which this one has started."""
    if not resource:
        return time.perf_counter()
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def read(path):
    with open(path, newline="", encoding="utf-8") as file:
        names, *rows = list(csv.reader(file))
    return names, np.array(rows, float)


def columns(names, table, name):
    """The columns of an output."""
    places = [i for i, own in enumerate(names) if re.sub(r"\[\d+\]$", "", own) == name]
    if not places:
        raise ValueError(f"no output {name} among {names}")
    return table[:, places]


def save(case, folder):
    """Writes the files of a case."""
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "scene.json").write_text(json.dumps(case.scene, indent=1), encoding="utf-8")
    if case.inputs:
        lines = (",".join(str(part) for part in row) for row in case.inputs)
        (folder / "input.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
    return folder


def who_told(name, run, plan):
    """Who said that an output does not keep the error."""
    if re.search(re.escape(name) + r"(?!\w)", run):
        return "run"
    if re.search(r"(?i)\bmesh of \w+ does not", run):
        return "mesh"
    if re.search(r"(?i)inputs?\b.*\bheld\b|\bheld\b.*\binputs?\b", run):
        return "held"
    if re.search(re.escape(name) + r"(?!\w).*(does not settle|kept until)", plan):
        return "plan"
    return "held by plan" if "inputs held at their start values" in plan else "no"


def judge(case, folder, program, seconds=60):
    """Runs a case; gives a verdict for each output that counts, and how long the run took."""
    folder = save(case, folder)
    table = folder / "outputs.csv"
    table.unlink(missing_ok=True)
    budget = ["--budget", BUDGET]
    options = budget + (["--input", folder / "input.csv"] if case.inputs else [])
    started = children()
    text, trouble = invoke(program, "simulate", folder / "scene.json", "--output", table, *options, seconds=seconds)
    took = children() - started
    if text is None:
        return [Verdict(name, case.wanted, np.inf, "no answer", trouble) for name in case.counted], took
    names, rows = read(table)
    times = rows[:, 0]
    right = remembered(case, times, folder / "right.npz")
    verdicts, plan = [], None
    for name in case.counted:
        score = difference(case, name, columns(names, rows, name), right[name]) / case.wanted
        if score > 1 and plan is None:
            plan, trouble = invoke(program, "plan", folder / "scene.json", *budget, seconds=seconds)
            plan = plan or trouble
        verdicts.append(Verdict(name, case.wanted, score, who_told(name, text, plan or "")))
    return verdicts, took
