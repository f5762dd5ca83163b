"""Makes rods.json and references/*.csv for the chart `rods`: the converged answers of Exudyn's geometrically exact beam,
extrapolated in mesh and step, the points of its settings that no other tried point beats, and how far the two
programs are apart where shear and rotary inertia are divided away. `rods.py [CASE ...]`, some minutes each."""

import itertools
import json
import pathlib
import sys

import numpy as np

import run as peer
from sweep import ROOT, Sweep, dump

SETTINGS = pathlib.Path(__file__).parent / "rods.json"
# Meshes, steps between points, and what shear stiffness is multiplied with and rotary inertia divided by.
MESHES, STEPS, STIFFER = (32, 64, 128), 16, (1.0, 4.0, 16.0)
# The sweep: steps between points for implicit solvers, and their settings.
BETWEEN = (1, 2, 3, 4, 6, 8, 12, 16)
FAMILIES = [
    {"newton_tolerance": tolerance, "every_step": every_step, "nodes": nodes}
    for tolerance, every_step, nodes in itertools.product((1e-2, 1e-3), (False, True), ("parameters", "vectors"))
]
# What points of the frontier are tried with besides.
VARIED = {"rho": (0.5, 0.7, 1.0), "solver": ("newmark",), "newton": ("full",), "contractivity": (0.2, 0.8), "newton_tolerance": (1e-4,), "linear": ("dense",)}
# A run longer than this is the last of its family that is refined, s.
LONGEST = 3.0
EXPLICIT = ("rk4", "verlet")


def options(name, case, **more):
    """Options of a run."""
    keys = {key: case[key] for key in ("marker", "stop_time", "every", "shares") if key in case}
    return {**keys, "scene": str(ROOT / case["scene"]), **case.get("options", {}), **more}


def path(name, case, **more):
    """Places of the marker by time. Rounding bounds what Newton's method can reach."""
    for tolerance in (1e-7, 1e-6, 1e-5, 1e-4):
        answer = peer.run(options(name, case, newton_tolerance=tolerance, **more))
        if answer["good"]:
            return np.array(answer["path"])
    raise RuntimeError(f"{name}: expected a run to the end: {more}")


def extrapolated(name, case, stiffer):
    """The answer at no step and no element length, both of order 2, and what the last of each changed."""
    every = case["every"]
    meshes = [count * case.get("finer_mesh", 1) for count in MESHES]
    fine = STEPS * case.get("finer", 1)
    runs = [path(name, case, elements=count, step=every / fine, stiffer=stiffer) for count in meshes]
    first = [run + (run - coarse) / 3 for coarse, run in zip(runs, runs[1:])]
    mesh = first[1] + (first[1] - first[0]) / 15
    steps = [runs[1]] + [path(name, case, elements=meshes[1], step=every / (fine * k), stiffer=stiffer) for k in (2, 4)]
    once = [b + (b - a) / 3 for a, b in zip(steps, steps[1:])]
    result = mesh + once[1] - runs[1]
    changes = {"mesh": apart(first[1], first[0]) / case["length"], "step": apart(once[1], once[0]) / case["length"]}
    print(name, stiffer, changes, "raw mesh", apart(runs[2], runs[1]), "raw step", apart(steps[2], steps[1]), flush=True)
    return result, changes


def apart(a, b):
    """Largest distance."""
    return np.linalg.norm(a[:, 1:] - b[:, 1:], axis=1).max()


def refer(name, case):
    """Writes the converged answers."""
    case["references"] = []
    for stiffer in STIFFER:
        rows, changes = extrapolated(name, case, stiffer)
        file = f"crates/studies/exudyn/references/{name}_{stiffer:g}.csv"
        lines = ["t,x,y,z"] + [",".join(f"{value:.12g}" for value in row) for row in rows]
        (ROOT / file).write_text("\n".join(lines) + "\n", encoding="utf-8")
        digits = {key: float(f"{value:.2g}") for key, value in changes.items()}
        case["references"].append({"stiffer": stiffer, "file": file, **digits})
    case["reference"] = case["references"][0]["file"]


def sweep(name, case):
    """Runs the grid, then varies what is best."""
    tried = Sweep(name, case)
    for family, count in itertools.product(FAMILIES, case["meshes"]):
        for between in BETWEEN:
            if not try_one(tried, {"solver": "alpha", **family, "elements": count, "step": case["every"] / between}):
                break
    for solver, count in itertools.product(EXPLICIT, case["explicit_meshes"]):
        for between in case["explicit_steps"]:
            try_one(tried, {"solver": solver, "nodes": "vectors", "elements": count, "step": case["every"] / between})
    for _ in range(2):
        for _, _, choice in tried.frontier():
            if choice["solver"] in EXPLICIT:
                continue
            for key, value in ((key, value) for key, values in VARIED.items() for value in values):
                # Newmark's method would need the rates of what is driven.
                if key == "solver" and case.get("is_driven"):
                    continue
                if key != "linear" or choice["elements"] <= 16:
                    tried.run({**choice, key: value})
            for count in (round(choice["elements"] * factor) for factor in (0.85, 1.2)):
                tried.run({**choice, "elements": count})
    case["points"], case["runs"] = tried.kept(), len(tried.tried)


def try_one(tried, choice):
    """False where finer ones would take too long."""
    found = tried.run(choice)
    return not (found and found[1] > LONGEST)


def main():
    peer.exu.config.printToConsole = False
    cases = json.loads(SETTINGS.read_text(encoding="utf-8"))
    for name in sys.argv[1:] or list(cases):
        case = cases[name]
        refer(name, case)
        sweep(name, case)
        # Other cases may have been made meanwhile.
        cases = json.loads(SETTINGS.read_text(encoding="utf-8"))
        cases[name] = case
        SETTINGS.write_text(dump(cases), encoding="utf-8")
        for point in case["points"]:
            print(json.dumps(point), flush=True)


if __name__ == "__main__":
    main()
