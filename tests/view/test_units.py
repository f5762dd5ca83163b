"""The page inside an FMU: its default experiment moves, within bounds."""

import zipfile

import pytest
from project import package, xtask
from test_pages import CURVES, NAMES, differ, paused

# Of a page in the plane and in space, bytes.
BUDGET = {"crane": 300_000, "pendulum": 300_000, "robot_cable": 700_000, "stewart_platform": 700_000}
PAGE = "documentation/index.html"


def page_of(fmu, folder):
    with zipfile.ZipFile(fmu) as archive:
        return archive.extract(PAGE, folder)


@pytest.fixture(scope="module")
def unit(pages, tmp_path_factory):
    def make(name, animation=True):
        folder = tmp_path_factory.mktemp(name)
        fmu = package(pages.scene(name), folder / f"{name}.fmu", animation=animation)
        return fmu, folder / page_of(fmu, folder)

    return make


@pytest.mark.parametrize("name", BUDGET)
def test_the_default_experiment_moves_in_an_fmu(browser, pages, unit, name):
    _, page = unit(name)
    motion = page.read_text(encoding="utf-8").split("<!-- motion begins -->")[1].split("<!-- motion ends -->")[0]
    assert len(motion.encode()) < BUDGET[name]
    browser.load(page)
    start = paused(browser, 0.0)
    later = paused(browser, 0.6)
    assert differ(start, later) > 20 or name == "stewart_platform"
    assert browser.run(NAMES)
    assert browser.log() == []
    _, table = pages.table(name)
    rows = [table["time"].index(time) for time in browser.run("return [...flexbody.motion.rowTimes]")]
    assert rows[0] == 0 and rows[-1] == len(table["time"]) - 1 and len(rows) > 24
    if name == "crane":
        # What the scene says of its input while it is planned moves it here; the table is of one that stands.
        return
    for curve in browser.run(CURVES):
        assert curve["values"] == [table[curve["name"]][row] for row in rows]


def test_the_same_scene_gives_the_same_bytes_and_none_where_it_is_not_wanted(unit):
    (first, _), (second, _) = unit("robot_cable"), unit("robot_cable")
    assert first.read_bytes() == second.read_bytes()
    still, page = unit("robot_cable", animation=False)
    text = page.read_text(encoding="utf-8")
    assert "flexbody-view" not in text.split("</style>")[1] and "<script" not in text
    with zipfile.ZipFile(first) as whole, zipfile.ZipFile(still) as less:
        assert whole.namelist() == less.namelist()
        assert [name for name in whole.namelist() if whole.read(name) != less.read(name)] == [PAGE]


def test_an_fmu_is_shown_like_its_scene(pages, unit, tmp_path):
    fmu, _ = unit("robot_cable", animation=False)
    page = tmp_path / "page.html"
    xtask("view", fmu, "--output", page, "--no-open")
    assert page.read_bytes() == pages("robot_cable").read_bytes()
