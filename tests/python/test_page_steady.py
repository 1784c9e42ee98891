"""What the design page holds on to as it is worked with, and what it does when it is not."""

import pytest
from page import ARMS, CIRCLE, FEEDER, POINTS, field, opened, settled, shown
from playwright.sync_api import expect
from sample import sampled
from studio import rests, studio


def counted(session):
    """Bytes of the page's objects, and the number of its nodes, after a collection."""
    session.send("HeapProfiler.collectGarbage")
    return session.send("Runtime.getHeapUsage")["usedSize"], session.send("Memory.getDOMCounters")["nodes"]


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

        edit(20)
        [heap, nodes] = edit(20)
        [later, more] = edit(30)
        assert more <= nodes + 200, (nodes, more)
        assert later < heap + 30 * 20_000, (heap, later)


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


@pytest.mark.parametrize(
    "design", sampled(NUMBERS, of=["three-arm-2021", "circular-pair"]), ids=lambda design: design.stem
)
def test_a_page_at_rest_asks_for_nothing(browser, tmp_path, design):
    copy = tmp_path / design.name
    copy.write_bytes(design.read_bytes())
    with studio(copy) as running, shown(browser, running.url, script=COUNTED) as page:
        session = page.context.new_cdp_session(page)
        session.send("Performance.enable")

        def drawn():
            metrics = {metric["name"]: metric["value"] for metric in session.send("Performance.getMetrics")["metrics"]}
            return metrics["LayoutCount"], metrics["RecalcStyleCount"]

        def done():
            return page.evaluate("JSON.stringify(window.done)")

        # What is out of sight is drawn after the checks.
        before = None
        while done() != before:
            before = done()
            page.wait_for_timeout(1000)
        assert page.evaluate("window.done")["fetch"] > 0
        page.evaluate("window.done = {}")
        requests = []
        page.on("request", lambda request: requests.append(request.url))
        before = drawn()
        page.wait_for_timeout(3000)
        assert (page.evaluate("window.done"), requests) == ({}, [])
        assert drawn() == before
        # The file is looked at for changes: a hundredth of a second may end in that time.
        rests(running.process)
        # And it is counted what it does.
        field(page, NUMBERS[design]).press("ArrowUp")
        expect(page.locator("#undo")).to_be_enabled()
        settled(page)
        assert page.evaluate("window.done")["fetch"] > 0
