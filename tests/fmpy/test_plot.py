"""Pictures of runs: every ready scene is drawn, and what is drawn is what was computed."""

import json

import matplotlib.pyplot as plt
import numpy as np
import plot
import pytest
from conftest import IS_WHOLE, ROOT, place_of
from project import xtask

SCENES = sorted(path for path in (ROOT / "scenes").glob("*.json") if not path.name.endswith(".schema.json"))
# One of each kind of body and picture; of a release all.
DRAWN = {"bracket", "crane_3d", "cylinder_shell", "double_pendulum", "hoist", "pendulum", "stewart_platform", "wind_blade"}


@pytest.fixture(autouse=True)
def styled():
    with plt.rc_context(plot.STYLE):
        yield
    plt.close("all")


def columns(figure):
    """Every curve against time or of a path, by its label."""
    return {line.get_label(): line for axes in figure.axes for line in axes.lines if not line.get_label().startswith("_")}


def panels(figure):
    return {axes.get_title("left"): axes for axes in figure.axes if axes.get_title("left")}


def texts_inside(figure):
    """Whatever is written must be on the picture, and legends below their axes."""
    figure.canvas.draw()
    page = figure.bbox
    for axes in figure.axes:
        texts = [axes.title, axes.xaxis.label, axes.yaxis.label]
        for axis in (axes.xaxis, axes.yaxis):
            low, high = sorted(axis.get_view_interval())
            # Ticks outside the view are not drawn.
            texts += [tick.label1 for tick in axis.get_major_ticks() if low <= tick.get_loc() <= high]
        for text in texts:
            box = text.get_window_extent()
            if text.get_text() and text.get_visible() and box.width > 0:
                assert box.x0 >= 0 and box.y0 >= 0 and box.x1 <= page.x1 and box.y1 <= page.y1, text.get_text()
        if axes.get_legend():
            legend = axes.get_legend().get_window_extent()
            assert legend.y1 < axes.get_window_extent().y0
            assert legend.x0 >= 0 and legend.y0 >= 0 and legend.x1 <= page.x1
            assert legend.y1 <= axes.xaxis.label.get_window_extent().y0 + 1.0, "the legend hides the axis' name"


@pytest.mark.parametrize("scene", [s for s in SCENES if IS_WHOLE or s.stem in DRAWN], ids=place_of)
def test_ready_scenes_are_drawn(scene, tmp_path):
    table, picture = tmp_path / "run.csv", tmp_path / "run.png"
    xtask("simulate", scene, "--output", table, "--plot", picture)
    pixels = plt.imread(picture)
    assert min(pixels.shape[:2]) > 500
    assert len(np.unique(pixels[::3, ::3, :3].reshape(-1, 3), axis=0)) > 100, "an empty picture"

    run, shapes = plot.read_table(table), plot.Shapes(tmp_path / "run.shapes.jsonl")
    text = json.loads(scene.read_text(encoding="utf-8"))
    figure = plot.draw(text["name"], run, shapes)
    texts_inside(figure)
    found, curves = panels(figure), columns(figure)
    assert list(found)[:2] == ["Bodies", "Paths of markers, from the dot"]
    for axes in list(found.values())[:2]:
        names = {2: ("x [m]", "y [m]"), 3: ("right [m]", "up [m]")}[text["dimension"]]
        assert (axes.get_xlabel(), axes.get_ylabel()) == names
    kinds = {output["kind"] for output in text["outputs"]}
    for kind, title, unit in [
        ("reaction", "Reactions", "force [N]"),
        ("reaction_moment", "Reaction moments", "moment [N m]"),
        ("energy", "Energies", "energy [J]"),
    ]:
        assert (title in found) == (kind in kinds)
        if kind in kinds:
            assert found[title].get_xlabel() == "t [s]"
            assert found[title].get_ylabel() in {unit.replace("[", "[" + prefix) for prefix in ("", "m", "k", "M")}
    for kind in plot.HELD + plot.GONE:
        if f"energy.{kind}" in run:
            assert np.array_equal(curves[kind].get_ydata(), run[f"energy.{kind}"])
    total = sum(run[f"energy.{kind}"] for kind in plot.HELD if f"energy.{kind}" in run)
    assert np.array_equal(curves["total"].get_ydata(), total)
    for name, label in sum(plot.reactions(run), []):
        assert np.array_equal(curves[label].get_xdata(), run["time"])
        assert np.array_equal(curves[label].get_ydata(), run[name])
    check_markers(text, run, shapes, curves)


def test_space_is_seen_from_the_front_the_right_and_above():
    x, y, z = plot.seen(np.eye(3))
    assert x[0] == pytest.approx(y[0]) and x[1] == pytest.approx(-y[1]) and x[0] > 0 > x[1]
    assert z == pytest.approx([0.0, 1.0])
    # All axes are equally long, as far as angles of 120 degrees show.
    assert np.linalg.norm([x, y, z], axis=1) == pytest.approx([1.0, 1.0, 1.0])
    flat = np.array([[1.0, 2.0]])
    assert plot.seen(flat) is flat


def check_markers(scene, run, shapes, curves):
    """Every marker is drawn, where the outputs say that it is, and lies on its body."""
    wanted = {f"{body['name']}.{marker}" for body in scene["bodies"] for marker in body["markers"]}
    assert set(shapes.paths) == wanted
    assert {name for label in curves for name in label.split(" = ") if "." in name} == wanted
    times = [time for time, _ in shapes.snapshots]
    assert times[0] == run["time"][0] and times[-1] == run["time"][-1] and len(times) <= 13
    for label, line in curves.items():
        for name in label.split(" = "):
            if f"{name}.position[1]" not in run:
                continue
            axes = range(1, scene["dimension"] + 1)
            places = plot.seen(np.stack([run[f"{name}.position[{axis}]"] for axis in axes], axis=1))
            drawn = np.broadcast_to(line.get_xydata(), places.shape)
            assert np.abs(drawn - places).max() <= plot.STILL * shapes.size, name
    for number, body in enumerate(shapes.bodies):
        for time, outlines in shapes.snapshots:
            row = np.searchsorted(shapes.time, time)
            for marker in body["markers"]:
                place = shapes.paths[f"{body['name']}.{marker}"][row]
                assert distance(outlines[number], place) < 1e-3 * shapes.size, marker


def distance(points, place):
    """From a place to a polyline."""
    if len(points) == 1:
        return np.linalg.norm(place - points[0])
    start, end = points[:-1], points[1:]
    along = end - start
    length = np.maximum((along**2).sum(axis=1), 1e-300)
    part = np.clip(((place - start) * along).sum(axis=1) / length, 0.0, 1.0)
    return np.linalg.norm(start + part[:, None] * along - place, axis=1).min()


def shapes_of(tmp_path, paths, size=1.0):
    """One rigid body whose markers go along paths."""
    body = {"name": "body", "kind": "rigid", "markers": [f"m{i}" for i in range(len(paths))]}
    rows = [
        {"time": float(t), "markers": [list(p) for p in places], "outlines": [[[0.0, 0.0], [size, 0.0]]]}
        for t, places in enumerate(zip(*paths))
    ]
    file = tmp_path / "shapes.jsonl"
    file.write_text("\n".join(map(json.dumps, [{"bodies": [body]}, *rows])), encoding="utf-8")
    return plot.Shapes(file)


def test_roundoff_is_not_drawn_as_motion(tmp_path):
    noise = [[1e-12 * (-1) ** i, 0.3] for i in range(9)]
    shapes = shapes_of(tmp_path, [noise, [[0.1 * i, 0.0] for i in range(9)]])
    time = np.arange(9.0)
    flat = 5.0 + 1e-12 * (-1) ** time
    run = {"time": time, "pin.reaction[1]": flat, "pin.reaction[2]": flat, "energy.kinetic": flat, "energy.strain": flat}
    figure = plot.draw("", run, shapes)
    curves, found = columns(figure), panels(figure)
    assert len(curves["body.m0"].get_xdata()) == 1
    assert len(curves["body.m1"].get_xdata()) == 9
    for axes in (found["Reactions"], found["Energies"]):
        low, high = axes.get_ylim()
        assert high - low > 0.5


def test_markers_that_go_together_are_one_line(tmp_path):
    way = [[0.1 * i, 0.0] for i in range(5)]
    shapes = shapes_of(tmp_path, [way, way, [[0.0, 0.1 * i] for i in range(5)]])
    curves = columns(plot.draw("", {"time": np.arange(5.0)}, shapes))
    assert set(curves) == {"body.m0 = body.m1", "body.m2"}


@pytest.mark.parametrize("largest, unit, top", [(0.05, "mN", 50), (5.0, "N", 5), (700.0, "N", 700), (2e6, "MN", 2)])
def test_axes_are_in_units_of_their_size(largest, unit, top):
    run = {"time": np.arange(3.0), "pin.reaction[1]": np.array([0.0, 0.5 * largest, largest])}
    figure = plot.draw("", run, None)
    figure.canvas.draw()
    (axes,) = figure.axes
    assert axes.get_ylabel() == f"force [{unit}]"
    labels = [float(label.get_text().replace("\u2212", "-")) for label in axes.get_yticklabels()]
    places = axes.get_yticks()
    factor = top / largest
    assert labels == pytest.approx([factor * place for place in places])


def test_a_run_without_shapes_shows_its_outputs():
    run = {"time": np.arange(3.0), "a": np.array([1.0, 2.0, 4.0])}
    curves = columns(plot.draw("", run, None))
    assert np.array_equal(curves["a"].get_ydata(), run["a"])
