"""The book: its reference is that of the schema, its pages and links are whole, what it quotes is there,
and what its tutorial shows comes out of the program."""

import csv
import importlib.util
import os
import re
import shutil
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

import pytest
from project import ROOT, package, xtask

BOOK = ROOT / "docs" / "book"
SOURCE = BOOK / "src"
TUTORIAL = SOURCE / "tutorial"
LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
CODE = re.compile(r"^```.*?^```|`[^`\n]+`", re.DOTALL | re.MULTILINE)


def read(path):
    return path.read_text(encoding="utf-8")


def module(name):
    """A script of the book."""
    spec = importlib.util.spec_from_file_location(name, BOOK / f"{name}.py")
    loaded = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(loaded)
    return loaded


def test_the_reference_is_that_of_the_schema():
    fresh = module("reference").written()
    committed = {path.name: read(path) for path in (SOURCE / "reference").glob("*.md")}
    assert committed == fresh, "not fresh: run python docs/book/reference.py"


def test_every_example_is_on_a_page():
    assert module("reference").strays() == []


def test_scenes_that_pages_quote_are_those_of_the_examples():
    reference = module("reference")
    stale = [page.name for page in SOURCE.glob("*.md") if reference.quoted(read(page)) != read(page)]
    assert stale == [], "not fresh: run python docs/book/reference.py"


def test_every_page_is_in_the_summary_once():
    listed = LINK.findall(read(SOURCE / "SUMMARY.md"))
    pages = [path.relative_to(SOURCE).as_posix() for path in SOURCE.rglob("*.md")]
    assert sorted(listed) == sorted(set(pages) - {"SUMMARY.md"})


def test_links_that_leave_the_book_lead_to_files():
    broken = []
    for page in SOURCE.rglob("*.md"):
        for target in LINK.findall(CODE.sub("", read(page))):
            file = target.split("#")[0]
            if file and ":" not in target and not (page.parent / file).exists():
                broken.append(f"{page.relative_to(SOURCE)}: {target}")
    assert not broken


class Page(HTMLParser):
    """What a page of the built book links to, loads, and can be linked at."""

    def __init__(self, text):
        super().__init__()
        self.anchors, self.links, self.loaded = set(), [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.anchors.add(values.get("id"))
        if tag == "a" and values.get("href"):
            self.links.append(values["href"])
        if tag in ("img", "script") and values.get("src"):
            self.loaded.append(values["src"])
        if tag == "link" and values.get("href"):
            self.loaded.append(values["href"])


@pytest.fixture(scope="session")
def built(tmp_path_factory):
    """Pages of the built book by path."""
    folder = Path(sys.executable).parent
    mdbook = shutil.which("mdbook", path=folder)
    if not mdbook:
        pytest.skip("no mdbook: its package is for Linux on x86-64")
    pytest.importorskip("latex2mathml")
    output = tmp_path_factory.mktemp("book")
    path = os.pathsep.join([str(folder), os.environ["PATH"]])
    result = subprocess.run(
        [mdbook, "build", BOOK, "-d", output],
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "PATH": path},
    )
    assert result.returncode == 0, result.stderr
    assert "WARN" not in result.stderr and "ERROR" not in result.stderr, result.stderr
    skipped = {"print.html", "toc.html", "404.html"}
    return {page: Page(read(page)) for page in output.rglob("*.html") if page.name not in skipped}


def test_links_and_anchors_of_the_built_book_lead_somewhere(built):
    broken = []
    for path, page in built.items():
        for target in [*page.links, *page.loaded]:
            address = urlsplit(target)
            if address.scheme in ("http", "https", "data", "mailto"):
                continue
            file = (path.parent / unquote(address.path)).resolve() if address.path else path
            known = built[file].anchors if file in built else None
            if not file.exists() or (address.fragment and known is not None and address.fragment not in known):
                broken.append(f"{path.name}: {target}")
    assert not broken


def test_the_built_book_loads_nothing_from_elsewhere(built):
    for path, page in built.items():
        assert not [target for target in page.loaded if urlsplit(target).scheme in ("http", "https")], path


def test_equations_are_drawn(built):
    for path in built:
        if path.parent.name == "theory":
            text = re.sub(r"<code.*?</code>|<script.*?</script>", "", read(path), flags=re.DOTALL)
            assert "$" not in text, path
            assert "\\mathbf" not in text and "\\frac" not in text, path


def test_messages_of_troubleshooting_are_those_of_the_source():
    # Literals of the source as the compiler sees them: a backslash at the end of a line goes on in the next.
    source = " ".join(re.sub(r"\\\n\s*", "", read(path)) for path in (ROOT / "src").rglob("*.rs"))
    missing = []
    for message in re.findall(r"^```text\n(.*?)\n```", read(SOURCE / "troubleshooting.md"), re.DOTALL | re.MULTILINE):
        # Long ones are broken into lines on the page.
        parts = re.split("…", " ".join(message.split()))
        missing += [part for part in parts if len(part) > 8 and part.strip(" ,:;") not in source]
    assert not missing


def test_figures_that_are_quoted_are_those_of_the_charts():
    charts = read(ROOT / "docs" / "charts" / "README.md")
    rows = [line.split("|")[3] for line in read(SOURCE / "charts.md").splitlines() if line.startswith("| ")]
    quoted = [figure for row in rows for figure in re.findall(r"`([^`]*\d[^`]*)`", row)]
    quoted += re.findall(r"`(\d[^`]*)`", read(SOURCE / "troubleshooting.md"))
    assert len(quoted) > 12
    assert [figure for figure in quoted if figure not in charts] == []


@pytest.fixture(scope="session")
def units(tmp_path_factory):
    """The files of the tutorial with its units beside them."""
    folder = tmp_path_factory.mktemp("tutorial")
    shutil.copytree(TUTORIAL / "files", folder, dirs_exist_ok=True)
    for name in ("pendulum", "crane"):
        package(folder / f"{name}.json", folder / f"{name}.fmu")
    xtask("example-fmus", "--output", folder / "partners")
    return folder


def printed(folder, *command):
    result = subprocess.run([sys.executable, *command], cwd=folder, capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stderr
    return result.stdout.splitlines()


def figures(text):
    return [float(word) for word in re.findall(r"(?<![\w.])-?\d+\.\d+(?:e-?\d+)?", text)]


def test_the_pendulum_runs_as_its_page_says(units):
    page = read(TUTORIAL / "pendulum.md")
    shown = figures(re.search(r"```text\n(1\.1 .*?)\n```", page)[1])
    assert figures(printed(units, "run.py")[-1]) == pytest.approx(shown, abs=1e-6)
    xtask("simulate", units / "pendulum.json", "--output", units / "swing.csv")
    with (units / "swing.csv").open(encoding="utf-8") as file:
        last = list(csv.DictReader(file))[-1]
    said = [float(number) for number in re.findall(r"position\[\d\]` = (-?[\d.]+) m", page)]
    assert [float(last[f"rod.tip.position[{axis}]"]) for axis in (1, 2)] == pytest.approx(said, abs=6e-5)


def test_the_crane_runs_as_its_page_says(units):
    rows = re.findall(r"^\| (0\.\d+ s|one scene) \|(.*)\|$", read(TUTORIAL / "crane.md"), re.MULTILINE)
    assert len(rows) == 4
    for step, cells in rows:
        if step == "one scene":
            xtask("simulate", units / "whole.json", "--stop-time", "2", "--step", "2", "--output", units / "whole.csv")
            with (units / "whole.csv").open(encoding="utf-8") as file:
                last = list(csv.DictReader(file))[-1]
            names = ("trolley.centre.position[1]", "trolley.centre.velocity[1]", "crate.centre.position[1]")
            found = [float(last[name]) for name in names]
        else:
            found = [float(line.split()[-1]) for line in printed(units, "couple.py", step.split()[0])]
        assert found == pytest.approx(figures(cells), abs=6e-6), step
