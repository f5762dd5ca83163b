"""Scenes of questions that others asked, whose answers were wrong: `reports/`, judged as scenes of the fuzz are."""

import json
import shutil
from pathlib import Path

import numpy as np
from judge import BUDGET, Verdict, columns, invoke, read, who_told

FOLDER = Path(__file__).parent / "reports"


def named():
    """All of them: name, error wanted, right values and where those are from."""
    return json.loads((FOLDER / "reports.json").read_text(encoding="utf-8"))


def off(rows, drawn, right):
    """How far an output is off, relative to its largest change."""
    if "largest" in right:
        return abs(np.abs(rows[1:]).max() / right["largest"] - 1)
    if "above" in right:
        return 0.0 if np.abs(rows).max() > right["above"] else np.inf
    if "at_end" in right:
        return np.linalg.norm(rows[-1] - right["at_end"]) / np.linalg.norm(right["at_end"])
    last = np.array(right["last"])
    return np.linalg.norm(rows[-1] - last) / np.linalg.norm(last - drawn)


def drawn_at(scene, name):
    """Where a marker of a straight line is drawn."""
    body, marker = name.split(".")[:2]
    (own,) = (own for own in scene["bodies"] if own["name"] == body)
    start, end = (np.array(own["shape"]["line"][key], float) for key in ("from", "to"))
    return start + own["markers"][marker] * (end - start)


def judge_named(report, folder, program, seconds=60):
    """Verdicts for the outputs of a report."""
    folder = Path(shutil.copytree(FOLDER / report["name"], folder, dirs_exist_ok=True))
    scene_file, inputs, table = folder / "scene.json", folder / "input.csv", folder / "outputs.csv"
    options = ["--budget", BUDGET, *report.get("options", []), *(["--input", inputs] if inputs.exists() else [])]
    text, trouble = invoke(program, "simulate", scene_file, "--output", table, *options, seconds=seconds)
    if text is None:
        return [Verdict(name, report["wanted"], np.inf, "no answer", trouble) for name in report["right"]]
    names, rows = read(table)
    scene = json.loads(scene_file.read_text(encoding="utf-8"))
    verdicts = []
    for name, right in report["right"].items():
        drawn = drawn_at(scene, name) if "last" in right else None
        score = off(columns(names, rows, name), drawn, right) / report["wanted"]
        verdicts.append(Verdict(name, report["wanted"], score, who_told(name, text, "")))
    return verdicts
