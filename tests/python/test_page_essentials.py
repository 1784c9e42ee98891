"""The form of the design page: essential numbers first, and no number of a table that is not in the file."""

import pytest
import tomllib
from axe_playwright_python.sync_playwright import Axe
from conftest import ROOT, design_file
from page import ARMS, BOX, SHAFT, field, opened, settled
from playwright.sync_api import expect

JANSEN = ROOT / "tests" / "designs" / "jansen-leg.toml"
FAMILIES = {
    "gear-pair": "pitch.eccentricity",
    "three-arm": "arm.tip_distance",
    "spiral-shaft": "lead",
    "moving-box": "gears.speed_ratio",
    "feeder": "linkage.crank",
    "machine": "dyads.knee.lengths",
}


def fresh(page):
    """The page as at a first visit: all numbers have not been chosen before."""
    page.context.clear_cookies(name="centrode-form")
    page.reload()
    settled(page)


@pytest.mark.parametrize("family", FAMILIES)
def test_three_to_six_numbers_of_each_family_come_first(browser, tmp_path, family):
    with opened(browser, tmp_path, design_file(family, tmp_path / "..")) as (page, _):
        fresh(page)
        expect(page.locator("#essentials")).to_be_checked()
        rows = page.locator("#form .first .field")
        assert 3 <= rows.count() <= 6
        assert page.locator("#form .find + .first").count() == 1
        one = page.locator("#form .first").locator(f'[id="field-{FAMILIES[family]}"]')
        value = float(one.input_value())
        one.focus()
        page.keyboard.press("ArrowUp")
        settled(page)
        assert float(one.input_value()) > value
        expect(page.locator("#undo")).to_be_enabled()
        assert Axe().run(page).response["violations"] == []


def test_all_numbers_stay_chosen_at_the_next_visit(browser, tmp_path):
    with opened(browser, tmp_path, BOX) as (page, _):
        fresh(page)
        few = page.locator("#form .field:visible").count()
        page.get_by_role("checkbox", name="Essentials").uncheck()
        expect(page.locator("#form .first")).to_have_count(0)
        every = page.locator("#form .field:visible").count()
        assert every > 2 * few
        page.reload()
        settled(page)
        expect(page.locator("#essentials")).not_to_be_checked()
        assert page.locator("#form .field:visible").count() == every


def test_a_table_that_is_not_in_the_file_has_no_numbers_and_is_added_by_a_click(browser, tmp_path):
    with opened(browser, tmp_path, ARMS) as (page, design):
        before = design.read_text()
        assert field(page, "intermediate.keyway.width").count() == 0
        page.locator('[id="add-intermediate.keyway"]').click()
        settled(page)
        expect(field(page, "intermediate.keyway.width")).to_be_visible()
        page.keyboard.press("Control+s")
        expect(page.locator("#save")).to_be_disabled()
        keyway = tomllib.loads(design.read_text())["intermediate"]["keyway"]
        assert set(keyway) == {"width", "depth"}
        assert field(page, "intermediate.keyway.width").input_value() == str(keyway["width"])
        # One step leads back.
        page.keyboard.press("Control+z")
        settled(page)
        expect(field(page, "intermediate.keyway.width")).to_have_count(0)
        page.keyboard.press("Control+s")
        expect(page.locator("#save")).to_be_disabled()
        assert design.read_text() == before


def test_a_body_shows_no_law_that_does_nothing(browser, tmp_path):
    with opened(browser, tmp_path, JANSEN) as (page, design):
        before = design.read_text()
        assert page.locator('#form [id^="field-bodies.thigh.law"]').count() == 0
        assert field(page, "bodies.crank.law.ratio").count() == 1
        law = page.locator('[id="add-bodies.thigh.law"]')
        expect(law).to_have_text("+ Law")
        page.locator('#form details[data-key="bodies.thigh"] summary').click()
        law.press("Enter")
        expect(page.locator("#notices")).to_contain_text("thigh.on: is needed for a body with a law")
        page.locator("#find").fill("law")
        expect(law).to_be_visible()
        page.locator("#find").fill("no such number")
        expect(law).to_be_hidden()
        assert design.read_text() == before
        expect(page.locator("#undo")).to_be_disabled()


@pytest.mark.parametrize("design", [SHAFT, ARMS], ids=lambda design: design.stem)
def test_optimise_is_never_grey_without_its_reason_in_sight(browser, tmp_path, design):
    with opened(browser, tmp_path, design) as (page, _):
        optimise, reason = page.locator("#optimise"), page.locator("#unsearched")
        assert reason.is_visible() == optimise.is_disabled()
        if optimise.is_disabled():
            expect(reason).to_have_text(f"Optimise is not possible: {optimise.get_attribute('title')}")


def test_the_bar_of_a_missed_goal_shows_where_the_goal_is_met(browser, tmp_path):
    with opened(browser, tmp_path, ARMS) as (page, _):
        expect(page.locator(".goal.unmet .target")).to_have_count(page.locator(".goal.unmet").count())
        expect(page.locator(".goal.met .target")).to_have_count(0)
        end = "one => one.parentElement.getBoundingClientRect().right - one.getBoundingClientRect().right"
        assert abs(page.locator(".goal.unmet .target").first.evaluate(end)) < 1


def test_the_picture_of_a_wide_window_stays_while_the_charts_scroll(browser, tmp_path):
    with opened(browser, tmp_path, ARMS) as (page, _):
        page.locator(".middle").evaluate("pane => pane.scrollTo(0, pane.scrollHeight)")
        expect(page.locator(".chart").first).not_to_be_in_viewport()
        expect(page.locator("#stage")).to_be_in_viewport(ratio=0.99)
        expect(page.locator(".chart").last).to_be_in_viewport()
