"""Charts: pictures and page are what the committed CSV files, the table of charts and the texts give, to the last character."""

import re
import sys

import pytest
from project import ROOT

sys.path.insert(0, str(ROOT / "xtask" / "charts"))
import draw

PAGE = (draw.DATA / "README.md").read_text(encoding="utf-8")
FRESH = "not fresh: run `cargo xtask chart --draw`"


@pytest.fixture(scope="module")
def drawn(tmp_path_factory):
    """A folder with all that is drawn anew."""
    folder = tmp_path_factory.mktemp("charts")
    draw.draw(draw.CHARTS, folder)
    return folder


def test_the_page_is_what_the_data_give(drawn):
    assert (drawn / "README.md").read_text(encoding="utf-8") == PAGE, FRESH


def test_every_placeholder_is_filled():
    assert not re.findall(r"{{|}}|{%|%}|\b(?:nan|None|Undefined)\b", PAGE)


def test_pictures_are_what_the_data_give(drawn):
    pictures = {path.name for path in drawn.glob("*.svg")}
    assert pictures == {path.name for path in draw.DATA.glob("*.svg")} == set(re.findall(r"\]\((\w+\.svg)\)", PAGE))
    assert [name for name in sorted(pictures) if (drawn / name).read_bytes() != (draw.DATA / name).read_bytes()] == [], FRESH


@pytest.mark.parametrize("name", draw.CHARTS)
def test_lines_are_told_apart(name):
    """By colour, mark or dashes, in every panel; and none is empty."""
    for panels in draw.Chart(name).pictures().values():
        for setting, lines in panels:
            looks = [(draw.pictures.look(line), line.get("dashed"), line.get("scattered")) for line, _ in lines]
            assert lines and len(set(looks)) == len(looks), setting["title"]


def test_what_is_listed_is_there():
    """Every CSV file is of a chart, every chart has a text, and every text a chart."""
    used = {setting.get("data", name) for name, chart in draw.CHARTS.items() for setting in [chart, *chart.get("panels", [])]}
    used |= {table.get("data") for chart in draw.CHARTS.values() for table in chart.get("tables", {}).values()}
    texts = {path.stem: path.read_text(encoding="utf-8") for path in draw.HERE.glob("*.md")}
    used |= {data for text in texts.values() for data in re.findall(r'csv\("(\w+)"\)', text)} | {"machine"}
    assert {path.stem for path in draw.DATA.glob("*.csv")} == used - {None}
    assert set(texts) == {*draw.CHARTS, "page", "README"}
