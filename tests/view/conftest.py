"""A browser for the tests, and pages of scenes, each made once a session."""

import csv
import json
import shutil
import sys
import time
from pathlib import Path

import pytest
from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent / "fmpy"))

from project import ROOT, xtask  # noqa: E402

BROWSERS = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable"]
# Elements where a scene leaves their number to the planner: pictures need no plan.
ELEMENTS = 6
# How long a page may take to load, s.
PATIENCE = 60
SWITCHES = [
    "--headless=new",
    "--no-sandbox",
    "--window-size=1280,760",
    # What draws without a graphics card.
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
]


class Browser:
    """A browser that shows one page after the other and knows what was logged meanwhile."""

    def __init__(self, *switches):
        browser = next(filter(None, map(shutil.which, BROWSERS)), None)
        driver = shutil.which("chromedriver")
        if not browser or not driver:
            pytest.skip("no browser: chromium and chromedriver are not installed (Debian: chromium, chromium-driver)")
        options = Options()
        options.binary_location = browser
        for switch in [*SWITCHES, *switches]:
            options.add_argument(switch)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        self.driver = webdriver.Chrome(options=options, service=Service(driver))

    def load(self, page, ready="return Boolean(window.flexbody)"):
        self.driver.get(page.as_uri())
        end = time.monotonic() + PATIENCE
        while not self.run(ready):
            assert time.monotonic() < end, f"{page} is not ready; log: {self.log()}"
            time.sleep(0.02)

    def run(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def log(self):
        return self.driver.get_log("browser")


@pytest.fixture(scope="session")
def browser():
    browser = Browser()
    yield browser
    browser.driver.quit()


@pytest.fixture(scope="session")
def blind_browser():
    """A browser that cannot draw in space."""
    browser = Browser("--disable-3d-apis")
    yield browser
    browser.driver.quit()


class Pages:
    """Pages by scene file."""

    def __init__(self, folder):
        self.folder = folder

    def scene(self, name):
        """A ready scene that needs no planner."""
        path = self.folder / f"{name}.json"
        if not path.exists():
            scene = json.loads((ROOT / "scenes" / f"{name}.json").read_text(encoding="utf-8"))
            for body in scene["bodies"]:
                if body["element"] == "reduced":
                    shutil.copy(ROOT / "scenes" / body["file"], self.folder)
                elif body["element"] not in ("rigid", "plate", "shell"):
                    body.setdefault("elements", ELEMENTS)
            scene["accuracy"] = {"relative_tolerance": 1e-4} | {key: value for key, value in scene.get("accuracy", {}).items() if key == "input_profiles"}
            path.write_text(json.dumps(scene), encoding="utf-8")
        return path

    def __call__(self, name):
        page = self.folder / f"{name}.html"
        if not page.exists():
            xtask("view", self.scene(name), "--output", page, "--no-open")
        return page

    def made(self, scene):
        """The page of a scene of a test."""
        path = self.folder / f"{scene['name']}.json"
        path.write_text(json.dumps(scene), encoding="utf-8")
        return self(scene["name"])

    def table(self, name, *options):
        """Outputs of the same scene as they are simulated."""
        path = self.folder / f"{name}.csv"
        if not path.exists():
            xtask("simulate", self.scene(name), "--output", path, *options)
        with path.open(encoding="utf-8") as file:
            names, *rows = csv.reader(file)
        return path, {name: [float(row[k]) for row in rows] for k, name in enumerate(names)}


@pytest.fixture(scope="session")
def pages(tmp_path_factory):
    return Pages(tmp_path_factory.mktemp("pages"))


def ready_scenes():
    files = sorted((ROOT / "scenes").glob("*.json"))
    return [path.stem for path in files if not path.name.endswith(".schema.json")]
