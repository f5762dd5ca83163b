"""Makes references/: the path of each scene's marker by Exudyn's finest runs, for the scenes of settings.json
that have no reference of their own, but slider_crank: its runs agree to 3e-5 of the length only.
`references.py [SCENE ...]`; takes some ten minutes.

Explicit scenes: RK4 within its stability limit, pins held by nodes of 1e11 kg. Others: generalized-alpha with two
steps, extrapolated, which takes away its error of second order."""

import json
import sys

import run as peer
from sweep import ROOT, SETTINGS

RUNS = {
    "steel_pendulum": [{"solver": "rk4", "heavy": 1e11, "elements": 24, "steps": 770_000}],
    "flying_spaghetti": [{"solver": "rk4", "elements": 128, "steps": 350_000}],
    "catenary": [{"solver": "rk4", "heavy": 1e11, "elements": 160, "steps": 23_972}],
    "spin_up": [{"elements": 24, "steps": 24_000}, {"elements": 24, "steps": 48_000}],
}


def path_of(case, choice):
    """Rows of time and place."""
    options = {key: case[key] for key in ("marker", "stop_time", "every", "shares") if key in case}
    options.update(case.get("options", {}))
    steps = choice["steps"]
    options.update(choice, scene=str(ROOT / case["scene"]), step=case["stop_time"] / steps)
    answer = peer.run(options)
    if not answer["good"]:
        raise RuntimeError(f"expected a run to the end, found one to {answer['path'][-1][0]} s: {choice}")
    return answer["path"]


def main():
    peer.exu.config.printToConsole = False
    cases = json.loads(SETTINGS.read_text(encoding="utf-8"))
    for name in sys.argv[1:] or RUNS:
        case = cases[name]
        paths = [path_of(case, choice) for choice in RUNS[name]]
        rows = paths[-1]
        if len(paths) == 2:
            rows = [[fine[0], *((4 * f - c) / 3 for c, f in zip(coarse[1:], fine[1:]))] for coarse, fine in zip(*paths)]
        lines = ["t,x_tip,y_tip"] + [",".join(f"{value:.15g}" for value in row) for row in rows]
        (ROOT / case["reference"]).write_text("\n".join(lines) + "\n", encoding="utf-8")
        print("wrote", case["reference"], flush=True)


if __name__ == "__main__":
    main()
