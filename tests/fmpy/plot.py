"""Draws a run: snapshots of the bodies, the paths of all markers, reactions, energies.

usage: plot.py RUN.csv PICTURE.png [--shapes SHAPES.jsonl] [--title TITLE] [--reference REFERENCE.csv]

RUN.csv holds outputs at communication points. SHAPES.jsonl is what `flexbody simulate --shapes` writes: where the
markers are at every communication point, and points along the bodies at some. The reference, an independent solution
to draw beside the paths, has columns t, x_tip and y_tip.
"""

import argparse
import csv
import json
import math

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import Normalize
from matplotlib.ticker import FuncFormatter, MaxNLocator

REFERENCE_STEP = 0.1
# What moves or changes by less than this part of its scale stands still: no roundoff is drawn as motion.
STILL = 1e-6
COLOURS = plt.get_cmap("viridis")
INK = "#2b2b2b"
# Distinct for every kind of colour vision (Okabe and Ito).
CYCLE = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8c6d31", "#5f5f5f"]
# Energies that a system holds; their sum is its total.
HELD = ["kinetic", "strain", "gravity", "spring"]
GONE = ["input", "dissipated"]
PANEL = (4.6, 4.4)
STYLE = {
    "font.size": 9,
    "font.family": "DejaVu Sans",
    "axes.edgecolor": "#9a9a9a",
    "axes.labelcolor": INK,
    "axes.titlesize": 10.5,
    "axes.titlelocation": "left",
    "axes.titlepad": 10,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#e8e8e8",
    "grid.linewidth": 0.7,
    "text.color": INK,
    "xtick.color": "#6a6a6a",
    "ytick.color": "#6a6a6a",
    "xtick.labelcolor": INK,
    "ytick.labelcolor": INK,
    "legend.frameon": False,
    "legend.fontsize": 8,
}


def main():
    parser = argparse.ArgumentParser(description="Draws a run.")
    parser.add_argument("run", metavar="RUN.csv")
    parser.add_argument("picture", metavar="PICTURE.png")
    parser.add_argument("--shapes", metavar="SHAPES.jsonl")
    parser.add_argument("--title", metavar="TITLE", default="")
    parser.add_argument("--reference", metavar="REFERENCE.csv")
    arguments = parser.parse_args()
    reference = read_table(arguments.reference) if arguments.reference else None
    shapes = Shapes(arguments.shapes) if arguments.shapes else None
    with plt.rc_context(STYLE):
        figure = draw(arguments.title, read_table(arguments.run), shapes, reference)
        # Without the program's version in it, equal runs give equal pictures.
        figure.savefig(arguments.picture, dpi=160, metadata={"Software": None})


def read_table(path):
    """Columns of a CSV file by name."""
    with open(path, newline="", encoding="utf-8") as file:
        names, *rows = csv.reader(file)
    columns = np.array(rows, dtype=float).reshape(-1, len(names)).T
    return dict(zip(names, columns))


def seen(points):
    """Points of the plane as they are; points of space from the front, the right and above (isometric)."""
    if points.shape[-1] != 3:
        return points
    x, y, z = np.moveaxis(points, -1, 0)
    return np.stack([(x + y) * math.sqrt(0.75), 0.5 * (y - x) + z], axis=-1)


class Shapes:
    """Where bodies and their markers were."""

    def __init__(self, path):
        with open(path, encoding="utf-8") as file:
            header, *rows = map(json.loads, file)
        self.bodies = header["bodies"]
        self.time = np.array([row["time"] for row in rows])
        count = len([marker for body in self.bodies for marker in body["markers"]])
        places = np.array([row["markers"] for row in rows], dtype=float).reshape(len(rows), count, -1)
        # What the axes of the pictures are.
        self.axes = ("right", "up") if places.shape[-1] == 3 else ("x", "y")
        places = seen(places)
        names = [f"{body['name']}.{marker}" for body in self.bodies for marker in body["markers"]]
        self.paths = {name: places[:, index] for index, name in enumerate(names)}
        # Time, and points along every body.
        self.snapshots = [
            (row["time"], [seen(np.array(points)) for points in row["outlines"]]) for row in rows if "outlines" in row
        ]
        everything = np.concatenate([places.reshape(-1, 2), *(o for _, outlines in self.snapshots for o in outlines)])
        self.size = float(np.linalg.norm(np.ptp(everything, axis=0))) or 1.0


def draw(title, run, shapes, reference=None):
    """The panels for which there is something to draw; all columns against time where there are none."""
    panels = []
    if shapes:
        panels.append(lambda figure, axes: bodies(figure, axes, shapes))
        panels.append(lambda _, axes: paths(axes, shapes, reference))
    forces, moments = reactions(run)
    held = {kind: run[f"energy.{kind}"] for kind in HELD if f"energy.{kind}" in run}
    energy = max((float(np.ptp(values)) for values in held.values()), default=0.0)
    if forces:
        panels.append(lambda _, axes: curves(axes, run, forces, ("Reactions", "force", "N"), energy))
    if moments:
        panels.append(lambda _, axes: curves(axes, run, moments, ("Reaction moments", "moment", "N m"), energy))
    if held:
        panels.append(lambda _, axes: energies(axes, run, held))
    panels = panels or [lambda _, axes: everything(axes, run)]
    columns = {1: 1, 2: 2, 4: 2}.get(len(panels), 3)
    rows = math.ceil(len(panels) / columns)
    figure, axes = plt.subplots(
        rows, columns, figsize=(PANEL[0] * columns, PANEL[1] * rows), layout="constrained", squeeze=False
    )
    figure.get_layout_engine().set(w_pad=0.12, h_pad=0.12)
    if title:
        figure.suptitle(title, fontsize=12, x=0.01, horizontalalignment="left")
    places = axes.flatten()
    for panel, place in zip(panels, places):
        panel(figure, place)
    for place in places[len(panels) :]:
        place.remove()
    return figure


def bodies(figure, axes, shapes):
    """Every body at some times: cables as they bend, rigid bodies from their centre of mass to their markers."""
    times = [time for time, _ in shapes.snapshots]
    norm = Normalize(times[0], times[-1])
    for time, outlines in shapes.snapshots:
        colour = COLOURS(norm(time))
        for body, points in zip(shapes.bodies, outlines):
            if body["kind"] == "cable":
                axes.plot(*points.T, color=colour, linewidth=2.0, solid_capstyle="round")
                continue
            for end in points[1:]:
                axes.plot(*np.array([points[0], end]).T, color=colour, linewidth=4.5, alpha=0.55, solid_capstyle="round")
            axes.plot(*points[0], marker="s", markersize=4.5, color=colour, markeredgecolor="white", markeredgewidth=0.6)
    axes.set_title("Bodies")
    metres(axes, shapes)
    bar = figure.colorbar(plt.cm.ScalarMappable(norm, COLOURS), ax=axes, shrink=0.75, pad=0.03)
    bar.set_label("t [s]")
    bar.outline.set_visible(False)


def paths(axes, shapes, reference):
    """The way of every marker; a dot where one stands still, one line where markers go together."""
    for number, (names, points) in enumerate(together(shapes)):
        style = {"color": CYCLE[number % len(CYCLE)], "label": " = ".join(names)}
        if np.linalg.norm(np.ptp(points, axis=0)) < STILL * shapes.size:
            axes.plot(*points[0], linestyle="none", marker="o", markersize=5, **style)
            continue
        dashes = ["-", (0, (4, 1.5)), (0, (1, 1))][number // len(CYCLE) % 3]
        axes.plot(*points.T, linewidth=1.4, linestyle=dashes, marker="o", markersize=4, markevery=[0], **style)
    if reference is not None:
        tenths = reference["t"] / REFERENCE_STEP
        shown = (abs(tenths - tenths.round()) < 1e-9) & (reference["t"] <= shapes.time[-1] + 1e-9)
        axes.plot(
            reference["x_tip"][shown],
            reference["y_tip"][shown],
            linestyle="none",
            marker="o",
            markersize=6.5,
            markerfacecolor="none",
            markeredgecolor=INK,
            markeredgewidth=1.1,
            label="independent reference",
        )
    axes.set_title("Paths of markers, from the dot")
    metres(axes, shapes)
    legend(axes)


def together(shapes):
    """Markers by their paths: names of those that go together, and the points."""
    found = []
    for name, points in shapes.paths.items():
        for names, others in found:
            if np.abs(points - others).max() < STILL * shapes.size:
                names.append(name)
                break
        else:
            found.append(([name], points))
    return found


def reactions(run):
    """Columns of forces and of moments: name, label."""
    return [
        [
            (name, name.removesuffix(key + end) + (of + axis if axis else ""))
            for name in run
            for end, axis in {"": "", "[1]": "x", "[2]": "y", "[3]": "z"}.items()
            if name.endswith(key + end)
        ]
        for key, of in ((".reaction", " "), (".reaction_moment", " about "))
    ]


def curves(axes, run, columns, words, energy):
    """Columns against time; the components of one vector have one colour."""
    title, what, unit = words
    colours = {}
    for name, label in columns:
        colour = colours.setdefault(name.split(".")[0], CYCLE[len(colours) % len(CYCLE)])
        dashes = {"[2]": (0, (4, 1.5)), "[3]": (0, (1, 1))}.get(name[-3:], "-")
        axes.plot(run["time"], run[name], color=colour, linewidth=1.4, linestyle=dashes, label=label)
    against_time(axes, (title, what, unit), [run[name] for name, _ in columns], energy * 1e-9)
    legend(axes)


def energies(axes, run, held):
    """Energies that the system holds, their sum, and what came in or was lost."""
    time = run["time"]
    gone = {kind: run[f"energy.{kind}"] for kind in GONE if f"energy.{kind}" in run}
    for number, (kind, values) in enumerate((held | gone).items()):
        axes.plot(time, values, color=CYCLE[number], linewidth=1.4, label=kind)
    total = sum(held.values())
    axes.plot(time, total, color=INK, linewidth=1.6, linestyle=(0, (4, 1.5)), label="total")
    against_time(axes, ("Energies", "energy", "J"), [*held.values(), *gone.values(), total], 0.0)
    legend(axes)


def everything(axes, run):
    names = [name for name in run if name != "time"]
    for number, name in enumerate(names):
        axes.plot(run["time"], run[name], color=CYCLE[number % len(CYCLE)], linewidth=1.4, label=name)
    against_time(axes, ("Outputs", "", ""), [run[name] for name in names], 0.0)
    if names:
        legend(axes)


def against_time(axes, words, values, floor):
    """Axes of curves in time; wide enough that roundoff stays a straight line."""
    title, what, unit = words
    axes.set_title(title)
    axes.set_xlabel("t [s]")
    axes.margins(x=0)
    axes.xaxis.set_major_locator(MaxNLocator(6))
    low, high = (float(f(values)) if values else 0.0 for f in (np.min, np.max))
    scale = max(abs(low), abs(high), floor)
    if high - low <= STILL * scale:
        half = 0.1 * scale or 1.0
        axes.set_ylim(0.5 * (low + high) - half, 0.5 * (low + high) + half)
    label = f"{what} [{prefixed(axes.yaxis, scale, unit)}]" if unit else what
    axes.set_ylabel(label)


def prefixed(axis, scale, unit):
    """The unit with a prefix for numbers of a scale; the axis is labelled in it."""
    power = math.floor((math.log10(scale) + 0.1) / 3.0) if scale > 0.0 else 0
    power = min(max(power, -4), 4)
    if power:
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value / 1000.0**power:g}"))
    return f"{['', 'k', 'M', 'G', 'T', 'p', 'n', 'µ', 'm'][power]}{unit}"


def metres(axes, shapes):
    axes.set_aspect("equal", adjustable="datalim")
    axes.margins(0.08)
    usual = 0.1 <= shapes.size < 1e4
    for axis, what in zip((axes.xaxis, axes.yaxis), shapes.axes):
        axis.set_major_locator(MaxNLocator(6))
        axis.set_label_text(f"{what} [{prefixed(axis, 1.0 if usual else shapes.size, 'm')}]")


def legend(axes):
    """Below the axes, where it hides no curve."""
    labels = axes.get_legend_handles_labels()[1]
    longest = max(map(len, labels))
    columns = max(1, min(len(labels), 52 // (longest + 7)))
    # As far below as the name of the axis is high, however high the axes are.
    place = {"loc": "upper center", "bbox_to_anchor": (0.5, 0.0), "borderaxespad": 4.6}
    axes.legend(**place, ncols=columns, handlelength=2.4, columnspacing=1.2)


if __name__ == "__main__":
    main()
