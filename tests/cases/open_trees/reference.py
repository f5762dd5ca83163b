"""Writes chain.csv and arm.csv by Pinocchio 4.1.0, and prints how far MuJoCo 4.0.0 is from them (needs what crates/studies/exudyn/requirements.txt
lists, and g++): both in joint angles, one by articulated bodies, the other by a factored inertia matrix, with Runge-Kutta steps of 1/16000 s.
"""

import json
import math
import pathlib
import sys
import tempfile

HERE = pathlib.Path(__file__).parent
sys.path.insert(0, str(HERE.parents[2] / "crates" / "studies" / "trees"))

import run  # noqa: E402

EVERY, STEPS = 0.05, 800


def path(scene, marker, program, steps):
    options = {"scene": HERE / scene, "marker": marker, "program": program, "method": "rk4", "model": "", "step": EVERY / steps}
    options |= {"stop_time": 1.0, "every": EVERY, "folder": tempfile.gettempdir()}
    answer = run.answer_to(options)
    return answer["path"]


def apart(a, b):
    return max(map(math.dist, a, b))


for name, scene, marker in [("chain", "scene.json", "link7.end"), ("arm", "arm.json", "tool.out")]:
    found = path(scene, marker, "Pinocchio", STEPS)
    print(name, "steps doubled", apart(path(scene, marker, "Pinocchio", STEPS // 2), found), end=", ")
    print("MuJoCo", apart(path(scene, marker, "MuJoCo", STEPS), found))
    lines = ["t,x,y,z"] + [f"{EVERY * (k + 1):.12g}," + ",".join(f"{x:.13g}" for x in row) for k, row in enumerate(found)]
    (HERE / f"{name}.csv").write_text("\n".join(lines) + "\n")
