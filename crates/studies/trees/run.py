"""Runs open trees of rigid bodies in MuJoCo, Pinocchio and Exudyn: one JSON object of options a line in, one answer a line
out, in one warm process."""

import json
import sys

import exudyn_tree
import mujoco_tree
import pinocchio_tree
from tree import Tree

PROGRAMS = {"MuJoCo": mujoco_tree.run, "Pinocchio": pinocchio_tree.run, "Exudyn": exudyn_tree.run}


def answer_to(options):
    """A run, or one acceleration."""
    with open(options["scene"], encoding="utf-8") as file:
        tree = Tree(json.load(file), options["marker"])
    if "calls" not in options:
        return PROGRAMS[options["program"]](tree, options)
    asked = tree, options["angles"], options["rates"], options["calls"]
    if options["program"] == "MuJoCo":
        time, found = mujoco_tree.accelerate(*asked)
    else:
        time, found = pinocchio_tree.accelerate(*asked, options["folder"])
    return {"good": True, "cpu_time": time, "acceleration": found}


def main():
    exudyn_tree.exu.SetWriteToConsole(False)
    for line in sys.stdin:
        try:
            answer = answer_to(json.loads(line))
        except Exception as failure:
            answer = {"good": False, "failure": f"{type(failure).__name__}: {failure}"[:300]}
        print(json.dumps(answer), flush=True)


if __name__ == "__main__":
    main()
