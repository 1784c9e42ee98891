"""Exports each design once through the command line; the tests read the files back with other readers."""

import json
import math
import os
import subprocess
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
BINARY = Path(os.environ.get("CENTRODE_BIN", ROOT / "target" / "debug" / "centrode"))
ECCENTRICITY = 1 / (2 + math.sqrt(3))

DESIGNS = {
    "elliptic": f"""
family = "gear-pair"
name = "elliptic"
[pitch]
kind = "ellipse"
eccentricity = {ECCENTRICITY!r}
module = 2.25
tooth_count = 23
[driver]
width = 12
bore = 12
keyway = {{ width = 4, depth = 1.8 }}
[driven]
width = 12
bore = 12
""",
    "two-to-one": """
family = "gear-pair"
name = "two-to-one"
mean_ratio = [2, 1]
[pitch]
kind = "polar"
expression = "1 + 0.08*cos(2*phi)"
module = 1.5
tooth_count = 24
[teeth]
backlash = 0.05
""",
    "circle": """
family = "gear-pair"
name = "circle"
[pitch]
kind = "circle"
module = 2.0
tooth_count = 20
""",
}


@dataclass
class Export:
    """A folder of exported files and their report."""

    name: str
    design: Path
    folder: Path

    def report(self):
        return json.loads((self.folder / "report.json").read_text())

    def __truediv__(self, name):
        return self.folder / name


def centrode(*arguments, check=True):
    """Runs the command; its output is text."""
    return subprocess.run([BINARY, *map(str, arguments)], check=check, capture_output=True, text=True, timeout=60)


@pytest.fixture(scope="session")
def run():
    return centrode


@pytest.fixture(scope="session")
def exports(tmp_path_factory):
    """Exports a design where it was not yet; pytest itself keeps one value of a fixture with parameters at a time."""

    @cache
    def export(name):
        folder = tmp_path_factory.mktemp(name)
        design = folder / "pair.toml"
        design.write_text(DESIGNS[name])
        centrode("export", design, "--to", folder / "out", "--tolerance", "0.001", "--format", "all")
        return Export(name, design, folder / "out")

    return export


def design_file(name, folder):
    """File of a shipped design; of a family's template one in a folder, written where it was not yet."""
    design = ROOT / "tests" / "designs" / f"{name}.toml"
    if not design.exists():
        design = folder / "new.toml"
        design.write_text(centrode("new", name).stdout)
    return design


@pytest.fixture(scope="module")
def shipped(tmp_path_factory):
    """Exports a shipped design, or the template of a family, in some formats where it was not yet."""

    @cache
    def export(name, formats):
        folder = tmp_path_factory.mktemp(name)
        design = design_file(name, folder)
        # A machine that does not do its job is written all the same.
        centrode("export", design, "--to", folder, "--format", formats, check=False)
        return folder

    return export


@pytest.fixture(scope="session", params=DESIGNS)
def exported(request, exports):
    return exports(request.param)


@pytest.fixture(scope="session")
def fine_meshes(tmp_path_factory):
    @cache
    def export(design):
        folder = tmp_path_factory.mktemp("fine")
        centrode("export", design, "--to", folder, "--format", "urdf,stl", "--tolerance", "3e-6")
        return folder

    return export


@pytest.fixture(scope="session")
def fine(exported, fine_meshes):
    """The URDF of a design next to meshes so fine that their volumes are those of the curves."""
    return fine_meshes(exported.design)


@pytest.fixture(scope="session")
def browser():
    """A Chromium without a window."""
    from page import CHROMIUM, FLAGS
    from playwright.sync_api import sync_playwright

    if CHROMIUM is None:
        pytest.skip("the page needs a browser: apt-get install chromium-headless-shell")
    with sync_playwright() as playwright:
        running = playwright.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        yield running
        running.close()


@pytest.fixture
def points(browser, tmp_path):
    """The page of the pair whose pitch curve has control points, and its file."""
    from page import POINTS, opened

    with opened(browser, tmp_path, POINTS) as both:
        yield both


@pytest.fixture
def arms(browser, tmp_path):
    """The page of the three-arm mechanism, which has goals, and its file."""
    from page import ARMS, opened

    with opened(browser, tmp_path, ARMS) as both:
        yield both
