"""Draws `docs/moving.svg`, a picture that moves, from a run of `scenes/flying_spaghetti.json`: `python docs/moving.py`.

A program that does not animate shows the first shape among those that follow."""

import csv
import json
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "tests" / "fmpy"))

from project import ROOT, xtask  # noqa: E402

POINTS, FRAMES, STEP = 33, 90, 0.05
# Pixels per metre, around a margin; a second of the run takes this many to watch.
SCALE, MARGIN, SLOWNESS = 40, 16, 1.6
GHOSTS = 10


def shapes():
    """Points along the rod at every frame, by a scene with more markers and the planned mesh."""
    with TemporaryDirectory() as folder:
        folder = Path(folder)
        planned = folder / "planned.json"
        xtask("plan", ROOT / "scenes" / "flying_spaghetti.json", "--output", planned)
        scene = json.loads(planned.read_text(encoding="utf-8"))
        names = [f"m{number}" for number in range(POINTS)]
        scene["bodies"][0]["markers"] |= {name: number / (POINTS - 1) for number, name in enumerate(names)}
        scene["outputs"] = [{"kind": "position", "marker": f"rod.{name}"} for name in names]
        scene["accuracy"].pop("of", None)
        more, table = folder / "more.json", folder / "run.csv"
        more.write_text(json.dumps(scene), encoding="utf-8")
        xtask("simulate", more, "--step", STEP, "--stop-time", STEP * (FRAMES - 1), "--output", table)
        with table.open(encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
    return [[tuple(float(row[f"rod.{name}.position[{axis}]"]) for axis in (1, 2)) for name in names] for row in rows]


def drawn(frames):
    """The picture as SVG."""
    left, right = (choose(x for frame in frames for x, _ in frame) for choose in (min, max))
    low, high = (choose(y for frame in frames for _, y in frame) for choose in (min, max))
    width, height = (round(SCALE * size + 2 * MARGIN) for size in (right - left, high - low))

    def line(frame):
        pixels = ((MARGIN + SCALE * (x - left), MARGIN + SCALE * (high - y)) for x, y in frame)
        return " ".join(f"{x:.1f},{y:.1f}" for x, y in pixels)

    lines = list(map(line, frames))
    ghosts = "".join(f'<polyline points="{shape}"/>' for shape in lines[::GHOSTS])
    duration = SLOWNESS * STEP * (len(frames) - 1)
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}">'
        "<title>A free rod, pushed and twisted at one end for 2.5 s (Simo and Vu-Quoc 1986)</title>"
        f'<rect width="{width}" height="{height}" fill="#fff"/>'
        f'<g fill="none" stroke="#b9c6dc" stroke-width="1.5" stroke-linejoin="round">{ghosts}</g>'
        f'<polyline points="{lines[0]}" fill="none" stroke="#2f5fa5" stroke-width="4" stroke-linejoin="round" stroke-linecap="round">'
        f'<animate attributeName="points" dur="{duration:.2f}s" repeatCount="indefinite" values="{";".join(lines)}"/>'
        "</polyline></svg>\n"
    )


if __name__ == "__main__":
    (HERE / "moving.svg").write_text(drawn(shapes()), encoding="utf-8")
