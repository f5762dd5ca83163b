"""Pages of scenes in a browser: they load, move and say what was computed."""

import io
import json
import math
from time import monotonic, sleep

import pytest
from conftest import PATIENCE, ready_scenes
from PIL import Image, ImageChops
from project import xtask
from selenium.webdriver.common.by import By

# Boxes of what is written over the picture.
NAMES = """
return [...document.querySelectorAll('.names text')].filter((text) => getComputedStyle(text).display !== 'none').map((text) => {
  const { left, top, right, bottom } = text.getBoundingClientRect();
  return [text.textContent, left, top, right, bottom];
});
"""
SEEK = "flexbody.isPlaying = false; const { start, end } = flexbody.motion; flexbody.seek(start + arguments[0] * (end - start));"
# Every output that curves are drawn of, with its values and its line.
CURVES = """
return flexbody.curves.charts.flatMap((chart) => chart.lines.map((line) => ({
  name: line.name, values: chart.column(line.column), path: line.path.getAttribute('d'),
  ends: chart.column(line.column).map((value, row) => [chart.x(flexbody.motion.rowTimes[row]), chart.y(value)]),
})));
"""


def picture(browser):
    """The canvas and all that is drawn over it."""
    stage = browser.driver.find_element(By.CSS_SELECTOR, ".stage")
    return Image.open(io.BytesIO(stage.screenshot_as_png)).convert("RGB")


def differ(first, second):
    """How many pixels differ by more than smoothing does: two pictures of one frame differ by up to 40 where text stands on a line."""
    difference = ImageChops.difference(first, second).convert("L")
    return sum(difference.histogram()[64:])


def paused(browser, part):
    browser.run(SEEK, part)
    return picture(browser)


@pytest.mark.parametrize("name", ready_scenes())
def test_ready_scenes_move(browser, pages, name):
    browser.load(pages(name))
    start, later = paused(browser, 0.0), paused(browser, 0.37)
    assert len(start.getcolors(1 << 20)) > 50, "an empty picture"
    # A platform on its springs in equilibrium, and a crane that is not driven, stand still.
    if name not in {"stewart_platform", "crane_3d", "car_suspension", "boom", "robot_arm"}:
        assert differ(start, later) > 20
    assert differ(later, paused(browser, 0.37)) == 0
    names = browser.run(NAMES)
    assert names
    for k, (text, left, top, right, bottom) in enumerate(names):
        for other, *box in names[:k]:
            apart = right <= box[0] or box[2] <= left or bottom <= box[1] + 2 or box[3] <= top + 2
            assert apart, f"{text} covers {other}"
    assert browser.log() == []


def test_it_plays_by_itself_and_stops(browser, pages):
    browser.load(pages("pendulum"))
    time = "return flexbody.motion.time"
    browser.run("if (!flexbody.isPlaying) document.querySelector('.play').click()")
    first = browser.run(time)
    end = monotonic() + PATIENCE
    while browser.run(time) == first:
        assert monotonic() < end, "the picture stands still"
        sleep(0.02)
    browser.driver.find_element(By.CSS_SELECTOR, ".play").click()
    still = browser.run(time)
    picture(browser)
    assert browser.run(time) == still


@pytest.mark.parametrize("part", [0.0, 0.25, 0.8, 1.0])
def test_the_slider_lands_at_a_time(browser, pages, part):
    browser.load(pages("robot_cable"))
    wanted = 2.0 * part
    slide = "const s = document.querySelector('.time'); s.value = arguments[0]; s.dispatchEvent(new Event('input')); return flexbody.motion.time"
    assert browser.run(slide, wanted) == wanted
    assert browser.run("return flexbody.isPlaying") is False
    assert browser.run("return document.querySelector('.now').textContent") == f"{wanted:.2f} s"
    cursor = browser.run("const c = flexbody.curves.charts[0]; return [c.cursor.getAttribute('d'), c.x(arguments[0])]", wanted)
    assert float(cursor[0][1:].split(" ")[0]) == pytest.approx(cursor[1], abs=0.051)


@pytest.mark.parametrize("name, marker", [("pendulum", "rod.tip"), ("robot_cable", "hose.middle"), ("gyroscope", "rotor.centre")])
def test_the_curves_of_a_picked_marker_are_those_of_the_table(browser, pages, name, marker):
    _, table = pages.table(name)
    browser.load(pages(name))
    browser.run("flexbody.choose(undefined)")
    browser.run("document.querySelector(`[data-marker='${arguments[0]}']`).dispatchEvent(new MouseEvent('click'))", marker)
    curves = browser.run(CURVES)
    wanted = [column for column in table if column.startswith(f"{marker}.")]
    assert sorted(curve["name"] for curve in curves) == sorted(wanted) and wanted
    assert browser.run("return [...flexbody.motion.rowTimes]") == table["time"]
    for curve in curves:
        assert curve["values"] == table[curve["name"]]
        points = [[float(number) for number in pair.split(" ")] for pair in curve["path"][1:].split("L")]
        assert len(points) == len(curve["ends"])
        for point, end in zip(points, curve["ends"]):
            assert point == pytest.approx(end, abs=0.051)


@pytest.mark.parametrize("name", ["pendulum", "robot_cable", "robot_6_axis", "four_bar", "crane_3d", "wind_blade"])
def test_markers_are_drawn_where_outputs_say_that_they_are(browser, pages, name):
    """Bodies come from nodes in steps of a 65536th, outputs as they are: at frames both agree."""
    _, table = pages.table(name)
    browser.load(pages(name))
    script = """
    const { motion } = flexbody;
    return [...motion.times].map((time) => {
      motion.seek(time);
      return motion.markers.map((_, number) => motion.place(number).toArray());
    });
    """
    places = browser.run(script)
    markers = browser.run("return flexbody.motion.markers.map((marker) => marker.name)")
    times = browser.run("return [...flexbody.motion.times]")
    size = browser.run("return flexbody.size")
    compared = 0
    for frame, time in enumerate(times):
        row = table["time"].index(time)
        for number, marker in enumerate(markers):
            for axis in range(3):
                column = table.get(f"{marker}.position[{axis + 1}]")
                if column:
                    assert places[frame][number][axis] == pytest.approx(column[row], abs=3e-5 * size)
                    compared += 1
    assert compared > 50


def test_arrows_are_as_long_as_forces_are_large(browser, pages):
    """The force of a joint against its output; it is drawn from its marker."""
    _, table = pages.table("robot_cable")
    browser.load(pages("robot_cable"))
    script = """
    const { motion } = flexbody;
    const number = motion.actions.findIndex((action) => action.name === arguments[0]);
    return [...motion.times].map((time) => {
      motion.seek(time);
      const [{ at, vector }] = motion.vectors(number);
      return [time, at.toArray(), vector.toArray(), motion.place(motion.actions[number].marker).toArray()];
    });
    """
    columns = [table[f"clip_tool.reaction[{axis}]"] for axis in (1, 2, 3)]
    span = max(max(column) - min(column) for column in columns)
    for time, at, force, place in browser.run(script, "clip_tool"):
        row = table["time"].index(time)
        assert force == pytest.approx([column[row] for column in columns], abs=3e-5 * span)
        assert at == place
    browser.run(SEEK, 0.5)
    browser.run("document.querySelector('.shown .reactions').click()")
    drawn = browser.run("return flexbody.marks.arrows.map(({ parts }) => parts[0]?.strokes[0].path.getTotalLength() ?? 0)")
    assert max(drawn) > 30


def test_loads_are_drawn_as_they_are_at_their_time(browser, pages):
    browser.load(pages("helical_spring"))
    script = """
    const { motion } = flexbody;
    const number = motion.actions.findIndex((action) => action.name === "push");
    return [...motion.times].map((time) => {
      motion.seek(time);
      return [time, motion.vectors(number)[0].vector.toArray()];
    });
    """
    for time, force in browser.run(script):
        assert force == pytest.approx([0, 0.1 * math.sin(7 * time), -math.sin(10 * time)], abs=1e-4)


def test_pressure_is_drawn_along_the_normals_of_a_surface(browser, pages):
    """Arrows all over a tube, out of it and as long as the pressure is large."""
    browser.load(pages("cylinder_shell"))
    script = """
    const { motion } = flexbody;
    const number = motion.actions.findIndex((action) => action.name === "inside");
    motion.seek(motion.end);
    return motion.vectors(number).map(({ at, vector }) => [at.toArray(), vector.toArray()]);
    """
    arrows = browser.run(script)
    assert len(arrows) == 25
    for at, pressure in arrows:
        assert math.hypot(*pressure) == pytest.approx(5000, rel=1e-3)
        radius = math.hypot(at[1], at[2])
        assert (at[1] * pressure[1] + at[2] * pressure[2]) / radius == pytest.approx(5000, rel=0.02)


def test_a_browser_that_cannot_draw_says_so_and_shows_the_scene(blind_browser, pages):
    ready = "return document.querySelector('.fallback p').textContent.includes('WebGL')"
    blind_browser.load(pages("crane"), ready)
    assert blind_browser.driver.find_element(By.CSS_SELECTOR, ".fallback svg").is_displayed()
    assert [entry for entry in blind_browser.log() if entry["level"] == "SEVERE"] == []


def test_a_table_shows_its_markers_and_curves(browser, pages, tmp_path):
    path, table = pages.table("robot_cable")
    page = tmp_path / "table.html"
    xtask("view", path, "--output", page, "--no-open")
    browser.load(page)
    place = "flexbody.seek(arguments[0]); return flexbody.motion.place(0).toArray()"
    for row in (0, 77, 200):
        found = browser.run(place, table["time"][row])
        assert found == [table[f"hose.middle.position[{axis}]"][row] for axis in (1, 2, 3)]
    assert sorted(curve["name"] for curve in browser.run(CURVES)) == [f"hose.middle.position[{axis}]" for axis in (1, 2, 3)]
    assert browser.log() == []


def test_what_cannot_be_shown_is_refused(tmp_path):
    for name, text, message in [
        ("a.txt", "", "expected a file ending in .json, .fmu or .csv"),
        ("a.csv", "t,x\n0,1\n", "line 1: expected a first column `time`, found `t`"),
        ("b.csv", "time,x\n0,1\n1\n", "line 3: expected 2 numbers, found 1"),
        ("a.fmu", "no archive", "a.fmu"),
    ]:
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        with pytest.raises(AssertionError, match=message.replace("`", ".")):
            xtask("view", path, "--output", tmp_path / "page.html", "--no-open")
        assert not (tmp_path / "page.html").exists()


def test_the_page_holds_everything(pages):
    """No address but that of the language of drawings, and what the license of three.js names."""
    text = pages("crane").read_text(encoding="utf-8")
    header = json.loads(text.split('class="header">')[1].split("</script>")[0])
    assert header["name"] == "crane"
    assert "Permission is hereby granted" in text
    rest = text.replace("http://www.w3.org/2000/svg", "")
    assert "http://" not in rest and "https://" not in rest
