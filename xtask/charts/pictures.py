"""Pictures: panels of lines side by side, as charts.toml describes them. Colours are those of Okabe and Ito, told apart
with any colour vision; marks tell lines apart without colour."""

import io
import math
import re

import matplotlib
from matplotlib import ticker
from matplotlib.figure import Figure

COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"]
OPEN = {"markerfacecolor": "none"}
MARKS = {
    "ring": {"marker": "o", "markersize": 6.5, **OPEN},
    "dot": {"marker": "o", "markersize": 5},
    "triangle": {"marker": "^", "markersize": 6},
    "square": {"marker": "s", "markersize": 6, **OPEN},
    "cross": {"marker": "x", "markersize": 6},
}
# The same bytes from the same data; texts stay texts.
STYLE = {
    "svg.hashsalt": "charts",
    "svg.fonttype": "none",
    "font.sans-serif": ["DejaVu Sans", "Verdana"],
    "font.size": 10,
    "axes.titlesize": 12,
    "axes.labelsize": 11,
    "axes.grid": True,
    "grid.color": "#dddddd",
    "lines.linewidth": 1.6,
    "legend.frameon": False,
}
# Size of axes, and of a line of a legend, inches. At most three panels stand side by side.
WIDE, NARROW, HEIGHT, ROW = 6.2, 4.9, 4.4, 0.21


def tick(value, _=None):
    """A number beside an axis."""
    if value == 0 or 1e-2 <= value < 1e5:
        return f"{value:.6g}"
    digit, exponent = f"{value:.0e}".split("e")
    ten = "10" + str(int(exponent)).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
    return ten if digit == "1" else f"{digit}·{ten}"


def look(line):
    """Colour and mark of a line, which may be given by their numbers."""
    mark = line["mark"]
    return COLOURS[line["colour"] % len(COLOURS)], mark if mark in MARKS else list(MARKS)[mark % len(MARKS)]


def scale(axis, setting, values):
    """Logarithmic, with ticks of its own if the setting has them; linear from zero if it has a step."""
    axis.set_label_text(setting["label"])
    if "step" in setting:
        axis.set_major_locator(ticker.MultipleLocator(setting["step"]))
        return
    getattr(axis.axes, f"set_{axis.axis_name}scale")("log")
    decades = math.log10(max(values) / min(values))
    locator = ticker.LogLocator(subs=(1, 2, 5) if decades < 1.8 else (1,), numticks=10)
    axis.set_major_locator(ticker.FixedLocator(setting["ticks"]) if "ticks" in setting else locator)
    crowded = "ticks" in setting or decades > 4
    axis.set_minor_locator(ticker.NullLocator() if crowded else ticker.LogLocator(subs="all", numticks=20))
    axis.set_major_formatter(tick)
    axis.set_minor_formatter(ticker.NullFormatter())


def panel(axes, setting, lines):
    """Draws lines, each a pair of its description and its points."""
    axes.set_title(setting["title"])
    for line, points in lines:
        dashes = "none" if line.get("scattered") else "--" if line.get("dashed") else "-"
        colour, mark = look(line)
        # Of a curve through many points a few marks are enough.
        every = 1 if "scattered" in line else math.ceil(len(points) / 25)
        strong = {"linewidth": 3.2, "zorder": 3} if line.get("strong") else {}
        axes.plot(*zip(*points), color=colour, linestyle=dashes, label=line["name"], markevery=every, **MARKS[mark], **strong)
    for guide in setting.get("guides", []):
        (x, y), end = guide["from"], guide["to"]
        axes.plot([x, end], [y, y * (end / x) ** guide["power"]], "--", color="#777777", linewidth=1, label=guide["name"])
    for number, axis in enumerate((axes.xaxis, axes.yaxis)):
        scale(axis, setting["xy"[number]], [point[number] for _, points in lines for point in points])


def drawing(panels):
    """Panels, each a pair of its description and its lines, with one legend where the same line looks the same in all."""
    columns = len(panels) if len(panels) < 4 else 2
    rows, width = math.ceil(len(panels) / columns), WIDE if columns < 3 else NARROW
    looks = {(line["name"], (look(line), bool(line.get("dashed")))) for _, lines in panels for line, _ in lines}
    shared = len(looks) == len({name for name, _ in looks}) == len({seen for _, seen in looks})
    figure = Figure(layout="constrained")
    handles, entries = {}, 0
    for axes, (setting, lines) in zip(figure.subplots(rows, columns, squeeze=False).flat, panels):
        panel(axes, setting, lines)
        own = dict(zip(*reversed(axes.get_legend_handles_labels())))
        handles, entries = {**handles, **own}, max(entries, len(own))
        if not shared:
            across, legends = 2 if columns < 3 else 1, rows
            axes.legend(loc="upper left", bbox_to_anchor=(-0.1, -0.13), ncols=across, borderaxespad=0, columnspacing=1.2)
    if shared:
        across, legends, entries = 3 if columns < 3 else 4, 1, len(handles)
        figure.legend(handles.values(), handles.keys(), loc="outside lower left", ncols=across, columnspacing=1.2)
    figure.set_size_inches(columns * width, rows * HEIGHT + legends * ROW * math.ceil(entries / across))
    return figure


def picture(path, panels):
    """Draws panels into an SVG file, numbers with two decimals."""
    text = io.StringIO()
    with matplotlib.rc_context(STYLE):
        drawing(panels).savefig(text, format="svg", metadata={"Date": None, "Creator": None})
    # Names of marks and clip paths follow from the last bits of numbers, which machines round otherwise.
    numbers = {}
    named = re.sub(r"\b[mp][0-9a-f]{10}\b", lambda name: f"{name[0][0]}{numbers.setdefault(name[0], len(numbers))}", text.getvalue())
    path.write_text(re.sub(r"(\d\.\d\d)\d+", r"\1", named), encoding="utf-8", newline="\n")
