"""Goals on the design page follow the pointer, and the status is that of the shown design."""

import json
import re
from contextlib import contextmanager, suppress

import pytest
from conftest import ROOT, centrode
from page import ARMS, drag, field, opened, settled, until
from playwright.sync_api import Error, expect
from sample import sampled

FEEDER = ROOT / "tests" / "designs" / "feeder-2022.toml"
HANDLES = [
    (ARMS, "point 2 of the pitch curve"),
    pytest.param(FEEDER, "end of the crank", marks=pytest.mark.campaign),
]


@contextmanager
def withheld(page, *depths):
    """Answers of these depths do not come before the end."""
    held = []
    path = re.compile("/solve$")

    def hold(route):
        if route.request.post_data_json["depth"] in depths:
            held.append(route)
        else:
            route.continue_()

    page.route(path, hold)
    yield held
    page.unroute(path, hold)
    for route in held:
        # The page may have given up waiting.
        with suppress(Error):
            route.continue_()


# However fast the computer, checks come after the picture.
SLOW_CHECKS = """
const ask = window.fetch;
window.fetch = async (path, options) => {
  if (/detail|checks/.test(options?.body ?? "")) await new Promise((resume) => setTimeout(resume, window.late ?? 100));
  return ask(path, options);
};
"""
EXACT = "[...document.querySelectorAll('.goal b')].map(goal => JSON.parse(goal.title || 'null'))"


def exact(page):
    """Every goal's figure, all digits."""
    return page.evaluate(EXACT)


def known(page):
    """Waits until the goals are those of the picture that is shown."""
    expect(page.locator("#goals")).to_have_attribute("aria-busy", "false")


@pytest.mark.parametrize(("design", "name"), HANDLES, ids=lambda value: getattr(value, "stem", ""))
def test_goals_move_with_a_point_that_is_held(browser, tmp_path, design, name):
    with opened(browser, tmp_path, design, script=SLOW_CHECKS) as (page, copy), withheld(page, "detail", "checks"):
        page.locator("#scrub").focus()
        for _ in range(8):
            page.keyboard.press("PageUp")
        box = page.get_by_role("button", name=name).locator("circle").last.bounding_box()
        x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        page.mouse.move(x, y)
        page.mouse.down()
        seen = [exact(page)]
        for step in range(1, 6):
            page.mouse.move(x, y + 2 * step)
            until(page, f"before => JSON.stringify({EXACT}) !== JSON.stringify(before)", arg=seen[-1])
            known(page)
            seen.append(exact(page))
            # The rest is told to be unknown.
            expect(page.locator("#findings h2")).to_have_text("○ Checking …")
            expect(page.locator("#findings .title")).to_contain_text("from the previous design: findings, figures")
        page.mouse.up()
        expect(page.locator("#file")).to_contain_text("not saved")
        page.keyboard.press("Control+s")
        expect(page.locator("#save")).to_be_disabled()
        known(page)
        report = json.loads(centrode("check", copy, "--json", check=False).stdout)
        assert exact(page) == [goal["value"] for goal in report["goals"]]


def test_a_key_that_is_held_is_followed_by_the_goals(browser, tmp_path):
    with opened(browser, tmp_path, FEEDER) as (page, _), withheld(page, "detail", "checks"):
        page.evaluate(
            """() => {
              window.told = new Set();
              const goals = document.querySelector("#goals");
              new MutationObserver(() => window.told.add(goals.innerText)).observe(goals, { childList: true });
            }"""
        )
        field(page, "linkage.crank").focus()
        # However long the picture of a step and its goals take: they wait for no checks.
        for steps in range(1, 5):
            page.keyboard.press("ArrowUp")
            until(page, "steps => window.told.size >= steps", arg=steps, patience=60_000)


def test_goals_of_another_state_are_told_to_be_that(browser, tmp_path):
    with opened(browser, tmp_path, ARMS) as (page, _):
        with withheld(page, "goals"):
            tip = field(page, "arm.tip_distance")
            tip.fill("146")
            tip.press("Enter")
            expect(page.locator("#goals")).to_have_attribute("aria-busy", "true")
            expect(page.locator("#findings .title")).to_contain_text(
                "from the previous design: goals, findings, figures"
            )
            expect(page.locator("#goals")).to_have_css("opacity", "0.55")
        known(page)
        settled(page)
        expect(page.locator("#verdict")).not_to_contain_text("of the design before")


@pytest.mark.parametrize(
    "design", sampled([ARMS, FEEDER], of=["feeder-2022", "feeder-widened"]), ids=lambda path: path.stem
)
def test_goals_are_there_before_the_checks_of_a_page_just_opened(browser, tmp_path, design):
    def ready(page):
        expect(page.locator("#goals h2")).to_have_text(re.compile(r"^Goals: \d+ of \d+ reached"))
        expect(page.locator("#findings h2")).to_have_text("○ Checking …")
        expect(page.locator("#figures")).to_be_empty()

    with opened(browser, tmp_path, design, script=f"window.late = 2000; {SLOW_CHECKS}", ready=ready) as (page, _):
        first = exact(page)
        settled(page)
        assert exact(page) == first
        expect(page.locator("#figures tbody tr").first).to_be_visible()


def test_the_share_of_long_checks_that_is_done_stands_beside_the_seconds(browser, tmp_path):
    with opened(browser, tmp_path, ARMS) as (page, _):
        told = {"share": 0}
        page.route("**/progress/*", lambda route: route.fulfill(json=told))
        with withheld(page, "detail", "checks"):
            tip = field(page, "arm.tip_distance")
            tip.fill("146")
            tip.press("Enter")
            # No share is shown before there is one.
            expect(page.locator("#working")).to_be_visible()
            expect(page.locator("#working-time")).to_have_text(re.compile(r"^\d+ s$"))
            for share, words in [(0.129, "12 %"), (0.789, "78 %")]:
                told["share"] = share
                expect(page.locator("#working-time")).to_have_text(re.compile(rf"^{words} done, \d+ s$"))
        settled(page)
        expect(page.locator("#working")).to_be_hidden()
        expect(page.locator("#working-time")).not_to_contain_text("done")


def test_an_error_leaves_nothing_of_the_design_before(browser, tmp_path):
    with opened(browser, tmp_path, FEEDER) as (page, _):
        crank = field(page, "linkage.crank")
        before = crank.input_value()
        crank.fill("900")
        crank.press("Enter")
        expect(page.locator("#findings h2")).to_have_text("✕ No mechanism")
        expect(page.locator("#goals")).to_be_empty()
        expect(page.locator("#figures")).to_be_empty()
        expect(page.locator("#findings")).to_contain_text("those of the last good design")
        # Another bad number, and the first again.
        for value, excess in [("901", 732), ("900", 731)]:
            crank.fill(value)
            crank.press("Enter")
            expect(page.locator("#findings .no-mechanism")).to_contain_text(f"it is -{excess} mm")
            expect(page.locator("#goals")).to_be_empty()
        crank.fill(before)
        crank.press("Enter")
        settled(page)
        expect(page.locator("#goals")).to_contain_text("reached")


def test_a_missed_goal_is_the_status(browser, tmp_path):
    with opened(browser, tmp_path, FEEDER) as (page, copy):
        expect(page.locator("#findings h2")).to_have_text("✕ Misses 1 goal")
        report = json.loads(centrode("check", copy, "--json", check=False).stdout)
        missed = [goal["title"] for goal in report["goals"] if (goal["margin"] or 0) < 0]
        assert page.locator(".goal.unmet").count() == len(missed) == 1


def test_a_drag_is_followed_whatever_its_speed(browser, tmp_path):
    with opened(browser, tmp_path, ARMS) as (page, _):
        before = exact(page)
        drag(page, page.get_by_role("button", name="point 2 of the pitch curve"), 3, 4)
        settled(page)
        assert exact(page) != before


# Records after each drawing whether the report is marked as that of the previous design.
MARKED = """
addEventListener("DOMContentLoaded", () => {
  const clear = CanvasRenderingContext2D.prototype.clearRect;
  window.marked = [];
  CanvasRenderingContext2D.prototype.clearRect = function (...box) {
    if (this.canvas.parentElement?.id === "stage") queueMicrotask(() => {
      window.marked.push(document.getElementById("verdict").classList.contains("stale"));
    });
    return clear.apply(this, box);
  };
  const verdict = document.getElementById("verdict");
  window.told = [];
  new MutationObserver(() => {
    window.told.push([verdict.classList.contains("stale"), document.getElementById("figures").textContent]);
  }).observe(verdict, { attributes: true, attributeFilter: ["class"] });
});
"""


def test_no_picture_stands_beside_the_report_of_another_design(browser, tmp_path):
    with opened(browser, tmp_path, ARMS, script=MARKED) as (page, _):
        page.evaluate("window.marked.length = window.told.length = 0")
        before = page.evaluate("document.getElementById('figures').textContent")
        field(page, "arm.tip_distance").press("ArrowUp")
        settled(page)
        marked, told = page.evaluate("[window.marked, window.told]")
        # From the first drawing of the new design until the results of its checks are shown.
        assert marked[0]
        assert told[-1][0] is False
        assert before not in [figures for is_stale, figures in told if not is_stale]
        assert marked == sorted(marked, reverse=True)


def test_a_goal_tells_its_margin(browser, tmp_path):
    with opened(browser, tmp_path, ARMS) as (page, _):
        told = 0
        for goal in page.locator(".goal").all():
            value = float(goal.locator(".head b").inner_text().split()[1])
            words = goal.locator(".detail").inner_text()
            ends = [float(word) for word in re.findall(r"-?\d+\.?\d*", words.split(";")[0])]
            above, below = value - ends[0], ends[-1] - value
            margin = min(above, below) if len(ends) == 2 else above if "at least" in words else below
            spare = re.search(r"; met, (\S+) .*to spare", words) or re.search(r"; missed by (\S+)", words)
            assert float(spare[1]) == pytest.approx(abs(margin), abs=2e-4)
            assert ("met," in words) == (margin >= 0)
            told += 1
        assert told == 9
