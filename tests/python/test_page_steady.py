"""What the design page holds on to as it is worked with, and what it does when it is not."""

import os
from pathlib import Path

import pytest
from page import ARMS, CIRCLE, FEEDER, POINTS, field, opened, settled
from playwright.sync_api import expect


def counted(session):
    """Bytes of the page's objects, and the number of its nodes, after a collection."""
    session.send("HeapProfiler.collectGarbage")
    return session.send("Runtime.getHeapUsage")["usedSize"], session.send("Memory.getDOMCounters")["nodes"]


def ticks(file):
    """Processor ticks so far of the program that serves the page of a file."""
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            if os.fsencode(file) in (folder / "cmdline").read_bytes().split(b"\0"):
                fields = (folder / "stat").read_text().rpartition(")")[2].split()
                return int(fields[11]) + int(fields[12])
        except OSError:
            continue
    raise AssertionError("no program")


def test_edits_leave_nothing_behind(browser, tmp_path):
    with opened(browser, tmp_path, POINTS) as (page, _):
        session = page.context.new_cdp_session(page)
        number = field(page, "teeth.backlash")

        def edit(times):
            for step in range(times):
                number.press("ArrowDown" if step % 2 else "ArrowUp")
                if step % 10 == 9:
                    settled(page)
            # History holds texts, each of some kilobytes.
            return counted(session)

        edit(40)
        [heap, nodes] = edit(20)
        [later, more] = edit(60)
        assert more <= nodes + 200, (nodes, more)
        assert later < heap + 60 * 20_000, (heap, later)


# Frames asked for, timers set and run, and requests made by the page from now on, by what does them.
COUNTED = """
window.done = {};
const count = (name) => { window.done[name] = (window.done[name] ?? 0) + 1; };
for (const name of ["requestAnimationFrame", "requestIdleCallback", "setTimeout", "setInterval"]) {
  const own = window[name];
  window[name] = (job, ...rest) => {
    count(name);
    return own.call(window, (...given) => { count(`${name} run`); job(...given); }, ...rest);
  };
}
const ask = window.fetch;
window.fetch = (...request) => { count("fetch"); return ask(...request); };
"""


NUMBERS = {ARMS: "arm.tip_distance", CIRCLE: "teeth.backlash", FEEDER: "linkage.coupler"}


@pytest.mark.parametrize("design", list(NUMBERS), ids=lambda design: design.stem)
def test_a_page_at_rest_asks_for_nothing(browser, tmp_path, design):
    with opened(browser, tmp_path, design, script=COUNTED) as (page, copy):
        session = page.context.new_cdp_session(page)
        session.send("Performance.enable")

        def busy():
            metrics = session.send("Performance.getMetrics")["metrics"]
            return next(metric["value"] for metric in metrics if metric["name"] == "TaskDuration")

        requests = []
        page.on("request", lambda request: requests.append(request.url))
        # What is out of sight is drawn in the first second after the checks.
        page.wait_for_timeout(1500)
        assert page.evaluate("window.done")["fetch"] > 0
        page.evaluate("window.done = {}")
        del requests[:]
        before, own = busy(), ticks(copy)
        page.wait_for_timeout(3000)
        took, spent = busy() - before, ticks(copy) - own
        assert (page.evaluate("window.done"), requests) == ({}, [])
        assert took < 0.03, f"{took} s of 3"
        # The file is looked at for changes: a hundredth of a second may end in that time.
        assert spent <= 1, f"{spent} ticks"
        # And it is counted what it does.
        field(page, NUMBERS[design]).press("ArrowUp")
        expect(page.locator("#undo")).to_be_enabled()
        settled(page)
        assert page.evaluate("window.done")["fetch"] > 0
