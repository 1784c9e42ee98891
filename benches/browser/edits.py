"""Edits on the design page in Chromium: milliseconds from the changed number to picture, goals and checks.

    python benches/browser/edits.py [design.toml ...] [--edits 50]
    python benches/browser/edits.py --steady 2000 [design.toml ...]

Without designs, every shipped one. Needs the program (cargo build --profile dist -p centrode, or CENTRODE_BIN),
Chromium and playwright. `--steady` makes so many edits, as fast as they are answered, and prints memory along the way
and what page and program do at rest.
"""

import argparse
import os
import shutil
import statistics
import subprocess
import tempfile
import time
from contextlib import contextmanager
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
    "composed-box": "bodies.box.law.traverse.lead",
    "composed-feeder": "dyads.four-bar.lengths",
    "composed-three-arm": "bodies.arm.turned_deg",
    "index-table": "cams.still.base_radius",
    "jansen-leg": "dyads.knee.lengths",
    "peaucellier-cell": "dyads.lower.lengths",
    "press": "dyads.ram.lengths",
    "two-arm": "bodies.arm-1.turned_deg",
    "two-stage": "bodies.arm.turned_deg",
}
"""A number that moves the whole picture, by family, of family machine by design."""

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

EDIT = """([key, way]) => new Promise((done) => {
  const field = document.getElementById(`field-${key}`);
  window.answered = undefined;
  const [goals, verdict] = ["goals", "verdict"].map((id) => document.getElementById(id));
  const start = performance.now();
  const busy = (place) => place.getAttribute("aria-busy") === "true";
  window.drawn = () => {
    // Drawn by the new answer, not by anything else that moves.
    if (window.answered === undefined) return;
    window.drawn = undefined;
    // The frame in which it is painted has passed once a task queued in it runs.
    requestAnimationFrame(() => setTimeout(() => {
      const times = { answer: window.answered - start, picture: performance.now() - start, goals: null };
      const told = () => {
        if (goals.childElementCount && !busy(goals)) times.goals ??= performance.now() - start;
        if (busy(verdict) || verdict.classList.contains("stale")) return;
        watch.disconnect();
        done({ ...times, checks: performance.now() - start });
      };
      const watch = new MutationObserver(told);
      for (const place of [goals, verdict]) watch.observe(place, { attributes: true });
      told();
    }));
  };
  field.focus();
  field.dispatchEvent(new KeyboardEvent("keydown", { key: way, bubbles: true, cancelable: true }));
})"""
"""One step of a number by its arrow key."""


def key_of(design):
    """The number that is changed in a design."""
    line = next(line for line in design.read_text().splitlines() if line.startswith("family"))
    return FIELDS.get(design.stem) or FIELDS[line.split('"')[1]]


@contextmanager
def opened(browser, design):
    """The page of a copy of a design once its checks are heard, its program, and the milliseconds that took."""
    with tempfile.TemporaryDirectory() as folder:
        copy = shutil.copy(design, folder)
        start = time.monotonic()
        command = [BINARY, "studio", copy]
        server = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        try:
            page = browser.new_page(viewport={"width": 1440, "height": 900})
            url = server.stdout.readline().strip()
            known = [("centrode-tour", "seen"), ("centrode-form", "all")]
            page.context.add_cookies([{"name": name, "value": value, "url": url} for name, value in known])
            page.goto(url)
            page.locator("#findings h2").wait_for()
            page.locator("#verdict:not(.stale, [aria-busy=true])").wait_for()
            first = 1e3 * (time.monotonic() - start)
            page.evaluate(WATCH)
            yield page, server, first
            page.close()
        finally:
            server.terminate()
            server.wait()


def edited(page, key, number):
    """Milliseconds of one edit: a step up, or the next time down."""
    return page.evaluate(EDIT, [key, "ArrowDown" if number % 2 else "ArrowUp"])


def measure(browser, design, edits):
    """Prints a line of medians."""
    with opened(browser, design) as (page, _, first):
        times = []
        # The first of all settles the browser: it is not counted.
        for number in range(edits + 1):
            times.append(edited(page, key_of(design), number))
            page.wait_for_timeout(100)
    of = {name: [time[name] for time in times[1:] if time[name] is not None] for name in times[0]}
    pictures = of["picture"]
    figures = [of["answer"], pictures, [statistics.quantiles(pictures, n=20)[-1]], of["goals"], of["checks"], [first]]
    words = [f"{statistics.median(figure):8.0f}" if figure else f"{'-':>8}" for figure in figures]
    print(f"{design.stem:28} " + " ".join(words), flush=True)


def resident(process):
    """Memory of a process, MB."""
    lines = Path(f"/proc/{process.pid}/status").read_text().splitlines()
    return int(next(line for line in lines if line.startswith("VmRSS")).split()[1]) / 1024


def processor(process):
    """Processor seconds a process has taken so far."""
    user, system = Path(f"/proc/{process.pid}/stat").read_text().rpartition(")")[2].split()[11:13]
    return (int(user) + int(system)) / os.sysconf("SC_CLK_TCK")


def counted(session):
    """Megabytes of the page's objects, and the number of its nodes, after a collection."""
    session.send("HeapProfiler.collectGarbage")
    heap = session.send("Runtime.getHeapUsage")["usedSize"] / 2**20
    return heap, session.send("Memory.getDOMCounters")["nodes"]


def busy(session):
    """Seconds in which the page has done anything so far."""
    metrics = session.send("Performance.getMetrics")["metrics"]
    return next(metric["value"] for metric in metrics if metric["name"] == "TaskDuration")


def steady(browser, design, edits, rest):
    """Prints memory along many edits, and what is done in some seconds of rest."""
    with opened(browser, design) as (page, server, _):
        session = page.context.new_cdp_session(page)
        session.send("Performance.enable")
        print(f"{design.stem}: {'edits':>8} {'page MB':>8} {'nodes':>8} {'program MB':>10}", flush=True)
        for number in range(edits + 1):
            if number % max(1, edits // 10) == 0:
                heap, nodes = counted(session)
                print(
                    f"{'':{len(design.stem) + 1}} {number:8} {heap:8.1f} {nodes:8} {resident(server):10.1f}", flush=True
                )
            if number < edits:
                edited(page, key_of(design), number)
        page.wait_for_timeout(2000)
        before = processor(server), busy(session)
        page.wait_for_timeout(1000 * rest)
        took = processor(server) - before[0], busy(session) - before[1]
        print(f"in {rest:g} s of rest: program {took[0]:.2f} s of processor, page {took[1]:.3f} s", flush=True)


def main():
    """Prints a line for each design."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("designs", nargs="*", type=Path, help="design files (every shipped one)")
    parser.add_argument("--edits", type=int, default=50, help="edits of each design (50)")
    parser.add_argument("--steady", type=int, metavar="N", help="memory over so many edits instead of times")
    parser.add_argument("--rest", type=float, default=10, help="seconds of rest after them (10)")
    options = parser.parse_args()
    designs = options.designs or sorted((ROOT / "tests" / "designs").glob("*.toml"))
    chromium = next(filter(None, map(shutil.which, ["chromium-headless-shell", "chromium", "google-chrome"])), None)
    if not options.steady:
        heads = ["answer", "picture", "95 %", "goals", "checks", "first"]
        print(f"{'ms from edit to':28} " + " ".join(f"{head:>8}" for head in heads))
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium, args=FLAGS)
        for design in designs:
            if options.steady:
                steady(browser, design, options.steady, options.rest)
            else:
                measure(browser, design, options.edits)
        browser.close()


if __name__ == "__main__":
    main()
