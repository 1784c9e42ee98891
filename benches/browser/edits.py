"""Edits on the design page in Chromium: milliseconds from the changed number to the redrawn picture, and to its goals.

    python benches/browser/edits.py [design.toml ...] [--edits 50]

Needs the program (cargo build --profile dist -p centrode, or CENTRODE_BIN), Chromium and playwright.
"""

import argparse
import os
import shutil
import statistics
import subprocess
import tempfile
from pathlib import Path

from playwright.sync_api import sync_playwright

ROOT = Path(__file__).resolve().parents[2]
BINARY = os.environ.get("CENTRODE_BIN", ROOT / "target" / "dist" / "centrode")
FLAGS = ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking"]
FIELDS = {
    "three-arm": "arm.tip_distance",
    "gear-pair": "teeth.backlash",
    "feeder": "linkage.coupler",
    "spiral-shaft": "groove.width",
    "moving-box": "shaft.groove.width",
}
"""A number that moves the whole picture, by family."""

WATCH = """() => {
  // Every drawing of the stage, and every answer of the program, as they happen.
  const stage = document.querySelector("#stage canvas").getContext("2d");
  const clear = stage.clearRect;
  stage.clearRect = function (...box) { window.drawn?.(); return clear.apply(this, box); };
  const ask = window.fetch;
  window.fetch = async (...request) => {
    const answer = await ask(...request);
    if (String(request[0]).endsWith("solve")) window.answered ??= performance.now();
    return answer;
  };
}"""
"""Told to the page before the first edit."""

EDIT = """(key) => new Promise((done) => {
  const field = document.getElementById(`field-${key}`);
  window.answered = undefined;
  const goals = document.getElementById("goals");
  const start = performance.now();
  window.drawn = () => {
    // Drawn by the new answer, not by anything else that moves.
    if (window.answered === undefined) return;
    window.drawn = undefined;
    // The frame in which it is painted has passed once a task queued in it runs.
    requestAnimationFrame(() => setTimeout(() => {
      const picture = performance.now() - start;
      const told = () => {
        if (goals.getAttribute("aria-busy") === "true") return;
        watch.disconnect();
        const last = goals.childElementCount ? performance.now() - start : null;
        done({ answer: window.answered - start, picture, goals: last });
      };
      const watch = new MutationObserver(told);
      watch.observe(goals, { attributes: true });
      told();
    }));
  };
  field.focus();
  field.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowUp", bubbles: true, cancelable: true }));
})"""
"""One step of a number by its arrow key."""


def family(design):
    """The word after family in a design file."""
    line = next(line for line in design.read_text().splitlines() if line.startswith("family"))
    return line.split('"')[1]


def measured(browser, design, edits):
    """Milliseconds of each edit until the answer has come, the picture is painted, and its goals are there."""
    with tempfile.TemporaryDirectory() as folder:
        copy = shutil.copy(design, folder)
        command = [BINARY, "studio", copy]
        server = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        try:
            page = browser.new_page(viewport={"width": 1440, "height": 900})
            page.goto(server.stdout.readline().strip())
            page.locator("#findings h2").wait_for()
            page.locator("#verdict:not(.stale)").wait_for()
            page.evaluate(WATCH)
            times = []
            for _ in range(edits):
                times.append(page.evaluate(EDIT, FIELDS[family(design)]))
                # The checks follow the picture; the next edit waits for them as a hand does.
                page.wait_for_timeout(300)
            page.close()
        finally:
            server.terminate()
            server.wait()
    return times


def main():
    """Prints a line for each design."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("designs", nargs="*", type=Path, default=[ROOT / "tests/designs/three-arm-2021.toml"])
    parser.add_argument("--edits", type=int, default=50, help="edits of each design (50)")
    options = parser.parse_args()
    chromium = next(filter(None, map(shutil.which, ["chromium-headless-shell", "chromium", "google-chrome"])), None)
    print(f"{'ms from edit to':28} {'answer':>8} {'picture':>8} {'95 %':>8} {'worst':>8} {'goals':>8}")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium, args=FLAGS)
        for design in options.designs:
            times = measured(browser, design, options.edits)
            answers, pictures = ([time[name] for time in times] for name in ("answer", "picture"))
            late = statistics.quantiles(pictures, n=20)[-1]
            figures = [statistics.median(answers), statistics.median(pictures), late, max(pictures)]
            goals = [time["goals"] for time in times if time["goals"] is not None]
            figures += [statistics.median(goals)] if goals else []
            print(f"{design.stem:28} " + " ".join(f"{figure:8.1f}" for figure in figures), flush=True)
        browser.close()


if __name__ == "__main__":
    main()
