"""Another family on the design page: what it keeps, and what brings the old one back."""

import pytest
import tomllib
from axe_playwright_python.sync_playwright import Axe
from conftest import centrode
from page import CIRCLE, SHAFT, field, figures, opened, settled
from playwright.sync_api import expect


def switched(page, word):
    """Has the page show the design as one of another family."""
    field(page, "family").select_option(word)
    expect(field(page, "family")).to_have_value(word)
    settled(page)


@pytest.mark.parametrize("word", ["three-arm", "spiral-shaft", "moving-box", "feeder", "machine"])
def test_a_pair_becomes_a_design_of_every_family_and_comes_back(browser, tmp_path, word):
    with opened(browser, tmp_path, CIRCLE) as (page, copy):
        before, text = figures(page), copy.read_text()
        switched(page, word)
        expect(field(page, "name")).to_have_value("circular-pair")
        expect(page.locator("#findings .error", has_text="missing")).to_have_count(0)
        expect(page.locator("#form [aria-invalid=true]")).to_have_count(0)
        # Figures of a check come when it is done.
        for _ in range(100):
            if figures(page) != before:
                break
            page.wait_for_timeout(100)
        assert figures(page) != before
        page.keyboard.press("Control+s")
        expect(page.locator("#save")).to_be_disabled()
        design = tomllib.loads(copy.read_text())
        assert (design["family"], design["name"]) == (word, "circular-pair")
        assert centrode("check", copy, check=False).returncode in (0, 1)
        page.locator("#undo").click()
        expect(field(page, "family")).to_have_value("gear-pair")
        settled(page)
        assert figures(page) == before
        page.keyboard.press("Control+s")
        expect(page.locator("#save")).to_be_disabled()
        assert copy.read_text() == text


def test_a_shaft_within_a_box_keeps_its_numbers(browser, tmp_path):
    with opened(browser, tmp_path, SHAFT) as (page, copy):
        shaft = tomllib.loads(copy.read_text())
        switched(page, "moving-box")
        expect(field(page, "shaft.lead")).to_have_value(str(shaft["lead"]))
        expect(field(page, "shaft.groove.width")).to_have_value(str(shaft["groove"]["width"]))
        expect(field(page, "shaft.slider.length")).to_have_value(str(shaft["slider"]["length"]))


def test_optimising_is_offered_by_every_family(browser, tmp_path):
    with opened(browser, tmp_path, CIRCLE) as (page, _):
        expect(page.locator("#optimise")).to_be_enabled()
        switched(page, "feeder")
        expect(page.locator("#optimise")).to_be_enabled()
        assert not Axe().run(page).response["violations"]
