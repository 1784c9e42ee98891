"""The design page in a real browser: opened, read, and worked on with mouse and keys."""

import shutil
import time
from contextlib import contextmanager

from conftest import ROOT
from playwright.sync_api import expect
from studio import studio

# What is to be seen may take as long to come as what is to be pressed, below.
PATIENCE = 15_000
expect.set_options(timeout=PATIENCE)

# The shell without windows first: it takes half the time.
BROWSERS = ["chromium-headless-shell", "chromium", "chromium-browser", "google-chrome"]
CHROMIUM = next(filter(None, map(shutil.which, BROWSERS)), None)
FLAGS = [
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]
SHIPPED = sorted((ROOT / "tests" / "designs").glob("*.toml"))
POINTS = ROOT / "tests" / "designs" / "transplanter-pair-2021.toml"
ARMS = ROOT / "tests" / "designs" / "three-arm-2021.toml"
FEEDER = ROOT / "tests" / "designs" / "feeder-widened.toml"
SHAFT = ROOT / "tests" / "designs" / "spiral-shaft-2018.toml"
BOX = ROOT / "tests" / "designs" / "moving-box-2018.toml"
INDEX = ROOT / "tests" / "designs" / "index-table.toml"
CIRCLE = ROOT / "tests" / "designs" / "circular-pair.toml"


def settled(page, patience=30_000):
    """Waits until every change has been drawn, and its checks have been heard; `patience` (ms) is for each."""
    # Not by `expect`, which reads the whole page for its message at each try.
    page.locator("#findings h2").wait_for(state="attached", timeout=patience)
    # A change just made has marked nothing stale: it is on its way.
    page.locator("#verdict:not(.stale, [aria-busy=true])").wait_for(state="attached", timeout=patience)


def until(page, expression, arg=None, patience=PATIENCE):
    """Waits until an expression, or a function of `arg`, holds in the page; `patience` (ms).

    Asked again from here: what polls inside the page would have to evaluate text there, which the page forbids.
    """
    end = time.monotonic() + 1e-3 * patience
    while not page.evaluate(expression, arg):
        assert time.monotonic() < end, f"never came true: {expression}"
        page.wait_for_timeout(5)


@contextmanager
def shown(browser, url, script="", ready=settled, toured=True, size=(1440, 900), **options):
    """A page that may not complain on its console; a script runs before its own.

    Its user has seen the tour before, and has chosen to see all numbers.
    """
    context = browser.new_context(viewport=dict(zip(("width", "height"), size, strict=True)), **options)
    if toured:
        known = [("centrode-tour", "seen"), ("centrode-form", "all")]
        context.add_cookies(
            [{"name": name, "value": value, "domain": "127.0.0.1", "path": "/"} for name, value in known]
        )
    context.add_init_script(script)
    context.set_default_timeout(PATIENCE)
    page = context.new_page()
    complaints = []
    page.on(
        "console", lambda message: complaints.append(message.text) if message.type in ("error", "warning") else None
    )
    page.on("pageerror", lambda error: complaints.append(str(error)))
    page.goto(url)
    ready(page)
    yield page
    context.close()
    assert not complaints, complaints


@contextmanager
def opened(browser, folder, design, **options):
    """The page of a copy of a design, and the copy."""
    copy = folder / design.name
    copy.write_text(design.read_text())
    with studio(copy) as running, shown(browser, running.url, **options) as page:
        yield page, copy


# Answers of the solver come so many milliseconds late.
SLOW = """
const ask = window.fetch;
window.fetch = async (path, ...rest) => {
  const answer = await ask(path, ...rest);
  if (String(path).endsWith("solve")) await new Promise((resume) => setTimeout(resume, window.late ?? 0));
  return answer;
};
"""


def figures(page):
    """Every figure on the page, all digits, by its key in the report."""
    cells = page.locator("#figures td[data-key]")
    return dict(cells.evaluate_all("cells => cells.map(cell => [cell.dataset.key, cell.dataset.exact])"))


def drawing(page):
    """The drawing as an image."""
    return page.locator("#stage canvas").evaluate("canvas => canvas.toDataURL()")


def curves_of(snapshot):
    """Curves of a snapshot with their inputs: where one has none, they are those of the curve before."""
    curves, before = [], None
    for curve in snapshot["curves"]:
        before = curve["input"] or before
        curves.append({**curve, "input": before})
    return curves


def drag(page, handle, right, down):
    """Draws a point of the drawing aside, pixels."""
    box = handle.locator("circle").last.bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + right, y + down, steps=4)
    page.mouse.up()


def field(page, key):
    return page.locator(f'[id="field-{key}"]')
