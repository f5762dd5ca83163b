"""What an engineer reads off a page: names, axes, units, supports, forces, stresses, enlarged deflections."""

import math

import pytest
from test_pages import NAMES, SEEK, paused
from selenium.webdriver.common.by import By

# Charts with the texts beside their value axis, of their legend, and their lines.
CHARTS = """
return flexbody.curves.charts.map((chart) => ({
  range: chart.range,
  ticks: [...chart.svg.querySelectorAll('text[text-anchor=end]')].map((text) => text.textContent),
  legend: chart.legend.textContent,
  base: chart.svg.querySelector('.base').textContent,
  lines: chart.lines.map((line) => ({ name: line.name, path: line.path.getAttribute('d'), constant: line.constant ?? null })),
}));
"""
# Texts of charts that go over the edge.
CUT = """
return flexbody.curves.charts.flatMap(({ svg }) => {
  const { left, right } = svg.getBoundingClientRect();
  const isCut = (box) => box.left < left || box.right > right;
  return [...svg.querySelectorAll('text')].filter((text) => isCut(text.getBoundingClientRect())).map((text) => text.textContent);
});
"""
TITLES = "return [...document.querySelectorAll('.curves .title')].map((title) => title.textContent)"
CHOOSE = "const c = document.querySelector(arguments[0]); c.value = arguments[1]; c.dispatchEvent(new Event(arguments[2]))"
# Paths of the symbol of a part of the scene.
STROKES = """
const number = flexbody.motion.marks.findIndex(({ name }) => name === arguments[0]);
return flexbody.marks.symbols[number].strokes.map(({ path }) => path.getAttribute('d'));
"""
# A load at the tip of a bar, N; its length, width and height, m; its Young's modulus, Pa.
PUSH, LENGTH, WIDTH, HEIGHT, MODULUS = 40.0, 2.0, 0.04, 0.06, 2e11


def bar(dimension):
    """A bar clamped at its root in equilibrium with a load across its tip."""
    vector = [0.0] * (dimension - 1)
    return {
        "name": f"bar_{dimension}",
        "dimension": dimension,
        "gravity": [0.0] * dimension,
        "bodies": [
            {
                "name": "bar",
                "element": "rod" if dimension == 3 else "cable",
                "elements": 6,
                "material": {"youngs_modulus": MODULUS, "density": 7800.0} | ({"shear_modulus": 8e10} if dimension == 3 else {}),
                "section": {"shape": {"rectangle": {"width": WIDTH, "height": HEIGHT}}},
                "shape": {"line": {"from": [0.0, *vector], "to": [LENGTH, *vector]}},
                "markers": {"root": 0.0, "tip": 1.0},
            }
        ],
        "joints": [{"name": "wall", "kind": "weld", "markers": ["ground", "bar.root"]}],
        "loads": [{"name": "push", "kind": "force", "marker": "bar.tip", "value": [*vector, -PUSH]}],
        "outputs": [{"kind": "position", "marker": "bar.tip"}, {"kind": "velocity", "marker": "bar.tip"}],
        "initial": "static_equilibrium",
        "experiment": {"stop_time": 0.1, "step": 0.05},
    }


def wheel(name, x, y=0.0):
    return {"name": name, "element": "rigid", "mass": 1.0, "inertia": 0.1, "position": [x, y], "markers": {"centre": [0.0, 0.0]}}


def gears():
    """Two wheels in mesh, one on the ground at a spring beside them, and an input that nothing moves."""
    pin = {"kind": "revolute"}
    return {
        "name": "gears",
        "dimension": 2,
        "bodies": [wheel("first", 0.0), wheel("second", 3.0), wheel("third", 0.0, 2.0)],
        "joints": [
            {"name": "left", "markers": ["ground", "first.centre"], **pin},
            {"name": "right", "markers": ["ground", "second.centre"], **pin},
        ],
        "gears": [{"name": "mesh", "joints": ["left", "right"], "ratio": -2.0}],
        "loads": [
            {"name": "spring", "kind": "spring_damper", "markers": ["ground", "third.centre"], "point": [2.0, 2.0], "stiffness": 3.0},
        ],
        "inputs": [{"kind": "force", "marker": "third.centre", "start": [0.5, 0.0]}],
        "outputs": [{"kind": "angle", "joint": "left"}],
        "experiment": {"stop_time": 1.0, "step": 0.1},
    }


def test_markers_bear_the_name_of_their_body(browser, pages):
    browser.load(pages("four_bar"))
    browser.run(SEEK, 0.37)
    written = {name for name, *_ in browser.run(NAMES)}
    assert {"coupler.middle", "crank.root", "rocker.root"} <= written


def test_components_that_differ_in_size_have_axes_of_their_own(browser, pages):
    browser.load(pages("boom"))
    browser.run("flexbody.choose('hook')")
    charts = browser.run(CHARTS)
    position = [chart for chart in charts if chart["lines"][0]["name"].startswith("hook.position")]
    assert [[line["name"] for line in chart["lines"]] for chart in position] == [["hook.position[1]"], ["hook.position[2]"]]
    for chart in charts:
        low, high = chart["range"]
        for line in chart["lines"]:
            heights = [float(pair.split(" ")[1]) for pair in line["path"][1:].split("L")]
            assert max(heights) - min(heights) > 8, f"{line['name']} is flat between {low} and {high}"
    assert "x " in position[0]["legend"] and "y " in position[1]["legend"]


def test_roundoff_is_drawn_as_constant(browser, pages):
    """A platform in equilibrium: velocities are roundoff of those of a platform that falls."""
    browser.load(pages("stewart_platform"))
    browser.run("flexbody.choose('platform.centre')")
    lines = [line for chart in browser.run(CHARTS) for line in chart["lines"]]
    velocities = [line for line in lines if ".velocity" in line["name"]]
    assert [line["constant"] for line in velocities] == [0, 0, 0]
    for line in velocities:
        assert len({pair.split(" ")[1] for pair in line["path"][1:].split("L")}) == 1
    assert "e\u2212" not in "".join(chart["legend"] + "".join(chart["ticks"]) for chart in browser.run(CHARTS))
    assert "x 0 constant" in "".join(chart["legend"] for chart in browser.run(CHARTS))


@pytest.mark.parametrize("name", ["cable_net", "boom", "propeller_shaft", "wind_blade", "car_suspension"])
def test_values_at_an_axis_differ_and_have_room(browser, pages, name):
    browser.load(pages(name))
    for chart in browser.run(CHARTS):
        assert len(set(chart["ticks"])) == len(chart["ticks"]) > 1
    assert browser.run(CUT) == []


def test_values_far_from_zero_are_written_less_a_common_one(browser, pages):
    browser.load(pages.made(bar(2) | {"name": "far"}))
    browser.run("""
    const { table, outputs } = flexbody.motion;
    const column = outputs.findIndex(({ name }) => name === 'bar.tip.position[1]');
    for (let row = 0; row < table.rows; row += 1) table.values[row * table.width + column] = 1234.567 + 1e-4 * row;
    flexbody.choose('bar.tip');
    """)
    chart = next(chart for chart in browser.run(CHARTS) if chart["lines"][0]["name"] == "bar.tip.position[1]")
    base = float(chart["base"].removesuffix(" +"))
    low, high = chart["range"]
    values = [base + float(tick.replace("\u2212", "-")) for tick in chart["ticks"]]
    assert all(low <= value <= high for value in values) and len(values) > 1
    assert browser.run(CUT) == []


# States of a page: names alone, with sizes of reactions, coloured, with deflections enlarged.
REACTIONS = "const box = document.querySelector('.shown .reactions'); if (box && box.checked !== arguments[0]) box.click();"
COVERED = """
const stage = document.querySelector('.stage').getBoundingClientRect();
const texts = [...document.querySelectorAll('.stage text')].filter((text) => text.textContent && text.getClientRects().length);
const boxes = texts.map((text) => text.getBoundingClientRect());
const found = [];
texts.forEach((text, k) => {
  const { left, top, right, bottom } = boxes[k];
  if (left < stage.left || right > stage.right || top < stage.top || bottom > stage.bottom) found.push(`${text.textContent} is cut off`);
  boxes.slice(0, k).forEach((box, other) => {
    const isApart = right <= box.left || box.right <= left || bottom <= box.top + 2 || box.bottom <= top + 2;
    if (!isApart) found.push(`${text.textContent} covers ${texts[other].textContent}`);
  });
});
if (document.documentElement.scrollWidth > innerWidth) found.push('the page is wider than its window');
return found;
"""


@pytest.mark.parametrize("name", ["kite_tether", "cable_net", "robot_cable", "crane"])
@pytest.mark.parametrize("window", [(1400, 900), (420, 800)])
def test_no_text_covers_another(browser, pages, name, window):
    """Names, sizes of reactions, axes and scales, in wide and narrow windows."""
    size = {"width": window[0], "height": window[1], "deviceScaleFactor": 1, "mobile": False}
    browser.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
    try:
        browser.load(pages(name))
        for quantity in ("", "axial force"):
            browser.run(CHOOSE, "select.paint", quantity, "change")
            for shown in (False, True):
                browser.run(REACTIONS, shown)
                for part in (0.0, 0.43):
                    paused(browser, part)
                    assert browser.run(COVERED) == []
        assert browser.run(CUT) == []
    finally:
        browser.driver.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})


def test_units_are_written_as_in_print(browser, pages):
    browser.load(pages("boom"))
    assert "acceleration [m/s²]" in browser.run(TITLES)
    browser.load(pages("propeller_shaft"))
    assert "torque [N·m]" in browser.run(TITLES)


def test_the_page_tells_inputs_that_nothing_moves(browser, pages):
    browser.load(pages.made(gears()))
    assert "Inputs held: third.centre.force = (0.5, 0) N" in browser.run("return document.querySelector('header p').textContent")
    browser.load(pages("crane"))
    assert "Inputs" not in browser.run("return document.querySelector('header p').textContent")


def test_springs_stand_on_the_ground(browser, pages):
    browser.load(pages.made(gears()))
    feet = browser.run(STROKES, "spring")
    x, y = browser.run("return flexbody.project(flexbody.motion.endOf(flexbody.motion.marks.find(({ name }) => name === 'spring').ends[0]))")
    foot = next(path for path in feet if path.endswith("Z"))
    assert [float(number) for number in foot[1:].split("L")[0].split(" ")] == pytest.approx([x, y], abs=0.051)


def test_wheels_of_a_gear_have_its_ratio(browser, pages):
    browser.load(pages.made(gears()))
    circles = [path[1:] for path in browser.run(STROKES, "mesh")]
    across = []
    for circle in circles:
        columns = [float(pair.split(" ")[0]) for pair in circle.rstrip("Z").split("L")]
        across.append(max(columns) - min(columns))
    distance = browser.run("const [a, b] = [0, 1].map((k) => flexbody.project(flexbody.motion.place(k))); return b[0] - a[0]")
    # The second turns twice as fast, and they touch.
    assert across == pytest.approx([4 / 3 * distance, 2 / 3 * distance], abs=0.2)


def test_numbers_stand_at_reactions(browser, pages):
    browser.load(pages.made(bar(2)))
    browser.run("document.querySelector('.shown .reactions').click()")
    written = browser.run("return flexbody.marks.values.filter(Boolean).map((value) => value.label.textContent)")
    assert written == ["40\u2009N", f"{PUSH * LENGTH:.0f}\u2009N·m"]
    browser.run("document.querySelector('.shown .reactions').click()")
    assert not browser.driver.find_element(By.CSS_SELECTOR, ".reactions text").is_displayed()


@pytest.mark.parametrize("dimension", [2, 3])
def test_bodies_are_coloured_by_what_acts_in_them(browser, pages, dimension):
    browser.load(pages.made(bar(dimension)))
    plain = paused(browser, 0.0)
    moment = PUSH * LENGTH
    for name, most in [("bending moment", moment), ("largest normal stress", moment / (WIDTH * HEIGHT**2 / 6))]:
        browser.run(CHOOSE, "select.paint", name, "change")
        assert browser.run("return flexbody.paint.most") == pytest.approx(most, rel=2e-3)
        # It falls in proportion to the distance from the tip.
        middle = browser.run("return flexbody.paint.value(flexbody.motion.bodies[0], 2, 1)")
        assert middle == pytest.approx(most / 2, rel=2e-3)
        assert paused(browser, 0.0).tobytes() != plain.tobytes()
        assert name in browser.driver.find_element(By.CSS_SELECTOR, "svg.scale").text
    browser.run(CHOOSE, "select.paint", "", "change")
    assert paused(browser, 0.0).tobytes() == plain.tobytes()


def test_surfaces_are_coloured_by_their_stress(browser, pages):
    """The bracket bends between its bolts and its load: it has most stress at the bend."""
    browser.load(pages("bracket"))
    plain = paused(browser, 0.5)
    browser.run(CHOOSE, "select.paint", "von Mises stress", "change")
    painted = paused(browser, 0.5)
    assert painted.tobytes() != plain.tobytes()
    values = """
    const body = flexbody.motion.bodies.find((body) => body.strains);
    return Array.from({ length: body.skin.points.length / 3 }, (_, point) => body.vonMises(point));
    """
    found, most = browser.run(values), browser.run("return flexbody.paint.most")
    assert 0.2 * most < max(found) <= 1.001 * most
    assert min(found) < 0.1 * max(found)
    assert "von Mises stress [Pa]" in browser.driver.find_element(By.CSS_SELECTOR, "svg.scale").text
    browser.run(CHOOSE, "select.paint", "", "change")
    assert paused(browser, 0.5).tobytes() == plain.tobytes()


@pytest.mark.parametrize("dimension", [2, 3])
def test_deflections_can_be_enlarged(browser, pages, dimension):
    browser.load(pages.made(bar(dimension)))
    place = "return flexbody.motion.place(1).toArray()"
    places = [browser.run(place)]
    for choice, factor in [("5", 50), ("0", 1)]:
        browser.run(CHOOSE, "input.factor", choice, "input")
        assert f"{factor}×" in browser.driver.find_element(By.CSS_SELECTOR, ".of-factor").text
        places.append(browser.run(place))
    straight, axis = [LENGTH, 0.0, 0.0], dimension - 1
    deflection = PUSH * LENGTH**3 / (3 * MODULUS * WIDTH * HEIGHT**3 / 12)
    assert straight[axis] - places[0][axis] == pytest.approx(deflection, rel=2e-3)
    assert straight[axis] - places[1][axis] == pytest.approx(50 * deflection, rel=2e-3)
    assert places[2] == places[0]


def test_motions_of_whole_bodies_are_not_enlarged(browser, pages):
    """A crank that goes round keeps its length, and joints of stiff bodies stay closed."""
    browser.load(pages("four_bar"))
    browser.run(SEEK, 0.43)
    place = "const { motion } = flexbody; return arguments[0].map((name) => motion.place(motion.markers.findIndex((m) => m.name === name)).toArray())"
    names = ["crank.root", "crank.pin", "coupler.first"]
    before = browser.run(place, names)
    browser.run(CHOOSE, "input.factor", "3", "input")
    assert browser.run("return flexbody.motion.factor") == 10
    root, pin, coupler = browser.run(place, names)
    length = math.dist(before[0], before[1])
    assert math.dist(root, pin) == pytest.approx(length, rel=0.02)
    assert math.dist(pin, before[1]) < 0.05 * length
    assert math.dist(pin, coupler) < 0.05 * length
    browser.run(CHOOSE, "input.factor", "0", "input")
    assert browser.run(place, names) == before


def test_knots_stay_closed_where_deflections_are_enlarged(browser, pages):
    """Cables of a net that fit only deformed."""
    browser.load(pages("cable_net"))
    browser.run(SEEK, 0.43)
    gaps = """
    const { motion, size } = flexbody;
    return motion.marks.map(({ ends: [first, second] }) => motion.endOf(first).distanceTo(motion.endOf(second)) / size);
    """
    for choice in ("0", "4"):
        browser.run(CHOOSE, "input.factor", choice, "input")
        assert max(browser.run(gaps)) < 1e-3
    assert browser.run("return flexbody.motion.factor") == 20


def test_a_scale_of_colours_lies_over_no_body(browser, pages):
    """In a narrow window, where a kite is near the upper edge."""
    size = {"width": 420, "height": 800, "deviceScaleFactor": 1, "mobile": False}
    browser.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
    try:
        browser.load(pages("kite_tether"))
        browser.run(CHOOSE, "select.paint", "axial force", "change")
        lowest = browser.run("return Math.max(...[...document.querySelectorAll('svg.scale text')].map((text) => Number(text.getAttribute('y'))))")
        for part in (0.0, 0.43, 1.0):
            browser.run(SEEK, part)
            assert min(y for _, y in browser.run("return flexbody.marks.points")) > lowest
    finally:
        browser.driver.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})


def test_what_is_zero_all_along_is_no_colour(browser, pages):
    """A rope without bending stiffness has no moment."""
    browser.load(pages("hoist"))
    offered = browser.run("return [...document.querySelector('select.paint').options].map((option) => option.value)")
    assert "bending moment" not in offered and "axial force" in offered


def test_lines_show_how_sections_stand(browser, pages):
    """Of what can twist: not of cables."""
    edges = "return flexbody.surfaces.map((surface) => Boolean(surface.edges?.visible))"
    browser.load(pages("propeller_shaft"))
    assert any(browser.run(edges))
    browser.load(pages("kite_tether"))
    assert not any(browser.run(edges))


def test_beds_are_lighter_than_bodies(browser, pages):
    browser.load(pages("mooring_line"))
    bodies, beds = browser.run("""
    const light = (object) => object.material.color.r + object.material.color.g + object.material.color.b;
    const lines = flexbody.beds.flatMap((bed) => bed.object.children);
    return [flexbody.surfaces.map((surface) => light(surface.object)), lines.map(light)];
    """)
    assert beds and min(beds) > 2 * max(bodies)
    assert "sea_bed" in {name for name, *_ in browser.run(NAMES)}


def test_surfaces_of_contacts_move_with_their_body(browser, pages):
    browser.load(pages("belt_drive"))
    script = """
    const shown = (time) => {
      flexbody.seek(time);
      const { body, object } = flexbody.beds[1];
      return [body.name, object.quaternion.angleTo(body.stance(0)), object.position.distanceTo(body.vector(0, 0)), object.rotation.z];
    };
    return [shown(0), shown(0.2)];
    """
    (name, *_, first), (_, turned, moved, last) = browser.run(script)
    assert name == "fan_pulley"
    assert max(turned, moved) < 1e-6
    assert abs(last - first) > 0.5


def test_a_body_without_a_shape_is_as_large_as_its_inertia(browser, pages):
    ball = {"name": "ball", "element": "rigid", "mass": 2.0, "inertia": [0.8 * 0.09] * 3, "position": [0.0, 0.0, 0.0]}
    scene = {"name": "ball", "dimension": 3, "gravity": [0.0, 0.0, 0.0], "bodies": [ball], "experiment": {"stop_time": 0.1, "step": 0.1}}
    browser.load(pages.made(scene))
    script = "const { geometry } = flexbody.surfaces[0].object.children[0]; geometry.computeBoundingBox(); return geometry.boundingBox.max.toArray()"
    # Of a ball 2/5 m r^2.
    assert browser.run(script) == pytest.approx([0.3] * 3, rel=1e-3)
    assert math.isfinite(browser.run("return flexbody.size"))
    # It stands for an inertia, and hides nothing.
    assert browser.run("return flexbody.surfaces[0].object.children[0].material.opacity") < 0.5


def test_a_measured_body_may_have_a_shape_to_draw(browser, pages):
    part = {"name": "part", "element": "rigid", "mass": 2.0, "inertia": [0.3, 0.4, 0.5], "shape": {"box": {"size": [0.4, 0.2, 0.6]}}, "position": [0.0, 0.0, 0.0]}
    scene = {"name": "part", "dimension": 3, "gravity": [0.0, 0.0, 0.0], "bodies": [part], "experiment": {"stop_time": 0.1, "step": 0.1}}
    browser.load(pages.made(scene))
    script = "const { geometry } = flexbody.surfaces[0].object.children[0]; geometry.computeBoundingBox(); return geometry.boundingBox.max.toArray()"
    assert browser.run(script) == pytest.approx([0.2, 0.1, 0.3])
