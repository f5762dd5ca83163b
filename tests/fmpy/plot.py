"""Draws a run: snapshots of the bodies, the path of their last marker, the energies.

usage: plot.py MODEL(.json|.fmu) RUN.csv PICTURE.png [--reference REFERENCE.csv]

Bodies are drawn as cubic Hermite curves through the markers whose position and angle are outputs.
The reference has columns t, x_tip and y_tip.
"""

import argparse
import csv
import json
import math
import zipfile

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize

SNAPSHOTS = 12
REFERENCE_STEP = 0.1
COLOURS = plt.get_cmap("viridis")
INK = "#2b2b2b"
# Distinct for every kind of colour vision (Okabe and Ito).
ENERGIES = {"kinetic": "#0072b2", "strain": "#d55e00", "gravity": "#009e73"}
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
}


def main():
    parser = argparse.ArgumentParser(description="Draws a run.")
    parser.add_argument("model", metavar="MODEL")
    parser.add_argument("run", metavar="RUN.csv")
    parser.add_argument("picture", metavar="PICTURE.png")
    parser.add_argument("--reference", metavar="REFERENCE.csv")
    arguments = parser.parse_args()
    reference = read_table(arguments.reference) if arguments.reference else None
    with plt.rc_context(STYLE):
        figure = draw(read_scene(arguments.model), read_table(arguments.run), reference)
        # Without the program's version in it, equal runs give equal pictures.
        figure.savefig(arguments.picture, dpi=160, metadata={"Software": None})


def read_scene(path):
    if path.endswith(".fmu"):
        with zipfile.ZipFile(path) as archive:
            return json.loads(archive.read("resources/scene.json"))
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def read_table(path):
    """Columns of a CSV file by name."""
    with open(path, newline="", encoding="utf-8") as file:
        names, *rows = csv.reader(file)
    columns = np.array(rows, dtype=float).reshape(-1, len(names)).T
    return dict(zip(names, columns))


def draw(scene, run, reference):
    """The panels for which the run has columns; all columns against time where there are none."""
    bodies = [Body(body, run) for body in scene["bodies"]]
    panels = []
    if any(len(body.places) > 1 for body in bodies):
        panels.append(lambda figure, axes: snapshots(figure, axes, run, bodies))
    if any(body.places for body in bodies):
        panels.append(lambda figure, axes: paths(figure, axes, run, bodies, reference))
    if all(f"energy.{kind}" in run for kind in ENERGIES):
        panels.append(lambda _, axes: energies(axes, run))
    panels = panels or [lambda _, axes: everything(axes, run)]
    figure, axes = plt.subplots(
        1, len(panels), figsize=(4.3 * len(panels), 4.0), layout="constrained", squeeze=False
    )
    figure.get_layout_engine().set(w_pad=0.12, h_pad=0.1)
    for panel, place in zip(panels, axes[0]):
        panel(figure, place)
    return figure


class Body:
    """A body's markers whose position is an output, in the order of the material."""

    def __init__(self, body, run):
        name = body["name"]
        self.length = shape_length(body["shape"])
        self.last = None
        self.places = []
        for marker, place in sorted(body.get("markers", {}).items(), key=lambda item: item[1]):
            columns = [f"{name}.{marker}.position[{axis}]" for axis in (1, 2)]
            if all(column in run for column in columns):
                angle = run.get(f"{name}.{marker}.angle")
                self.places.append((place, *(run[column] for column in columns), angle))
                self.last = f"{name}.{marker}"

    def curve(self, row):
        """Points on the deformed body at a communication point."""
        points = []
        for (s0, *start), (s1, *end) in zip(self.places, self.places[1:]):
            points.append(hermite(start, end, (s1 - s0) * self.length, row))
        return np.concatenate(points, axis=1)


def shape_length(shape):
    """Length of a body before it deforms."""
    ((_, form),) = shape.items()
    return form.get("length", math.dist(form["from"], form["to"]))


def hermite(start, end, length, row):
    """Points from marker to marker; a straight line where an angle is not known."""
    xi = np.linspace(0.0, 1.0, 24)
    r0, r1 = (np.array([[x[row]], [y[row]]]) for x, y, _ in (start, end))
    if start[2] is None or end[2] is None:
        return r0 + (r1 - r0) * xi
    t0, t1 = (length * np.array([[np.cos(angle[row])], [np.sin(angle[row])]]) for *_, angle in (start, end))
    return (
        r0 * (1 - 3 * xi**2 + 2 * xi**3)
        + t0 * (xi - 2 * xi**2 + xi**3)
        + r1 * (3 * xi**2 - 2 * xi**3)
        + t1 * (xi**3 - xi**2)
    )


def snapshots(figure, axes, run, bodies):
    time = run["time"]
    norm = Normalize(time[0], time[-1])
    rows = np.unique(np.linspace(0, len(time) - 1, SNAPSHOTS).round().astype(int))
    for row in rows:
        colour = COLOURS(norm(time[row]))
        for body in bodies:
            if len(body.places) < 2:
                continue
            axes.plot(*body.curve(row), color=colour, linewidth=2.4, solid_capstyle="round")
            x, y = ([place[axis][row] for place in body.places] for axis in (1, 2))
            axes.plot(
                x,
                y,
                linestyle="none",
                marker="o",
                markersize=2.2,
                color="white",
                markeredgecolor=colour,
                markeredgewidth=0.8,
            )
    axes.set_title("Deformed body")
    metres(axes)
    bar = figure.colorbar(plt.cm.ScalarMappable(norm, COLOURS), ax=axes, shrink=0.75, pad=0.03)
    bar.set_label("t [s]")
    bar.outline.set_visible(False)


def paths(_figure, axes, run, bodies, reference):
    time = run["time"]
    for body in bodies:
        if not body.places:
            continue
        _, x, y, _ = body.places[-1]
        points = np.stack([x, y], axis=1)
        line = LineCollection(
            np.stack([points[:-1], points[1:]], axis=1), cmap=COLOURS, linewidths=2.0, capstyle="round"
        )
        line.set_array(time[:-1])
        axes.add_collection(line)
        axes.plot(x[0], y[0], marker="o", markersize=4, color=COLOURS(0.0))
    axes.autoscale_view()
    if reference is not None:
        tenths = reference["t"] / REFERENCE_STEP
        shown = (abs(tenths - tenths.round()) < 1e-9) & (reference["t"] <= time[-1] + 1e-9)
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
        axes.legend(loc="upper center")
    axes.set_title("Path of " + ", ".join(body.last for body in bodies if body.last))
    metres(axes)


def energies(axes, run):
    time = run["time"]
    parts = {kind: run[f"energy.{kind}"] for kind in ENERGIES}
    for kind, values in parts.items():
        axes.plot(time, values, color=ENERGIES[kind], linewidth=1.6, label=kind)
    axes.plot(time, sum(parts.values()), color=INK, linewidth=1.6, linestyle=(0, (4, 1.5)), label="total")
    axes.set_title("Energy")
    axes.set_xlabel("t [s]")
    axes.set_ylabel("E [J]")
    axes.margins(x=0)
    axes.legend(loc="best")


def everything(axes, run):
    for name, values in run.items():
        if name != "time":
            axes.plot(run["time"], values, linewidth=1.4, label=name)
    axes.set_title("Outputs")
    axes.set_xlabel("t [s]")
    axes.margins(x=0)
    axes.legend(loc="best")


def metres(axes):
    axes.set_aspect("equal", adjustable="datalim")
    axes.margins(0.08)
    axes.set_xlabel("x [m]")
    axes.set_ylabel("y [m]")


if __name__ == "__main__":
    main()
