"""Keys and gestures of the design page, and its tour."""

import pytest
from axe_playwright_python.sync_playwright import Axe
from conftest import centrode
from page import FEEDER, POINTS, field, opened, settled, shown
from playwright.sync_api import expect
from sample import looks
from studio import studio


def clean(page):
    found = Axe().run(page).response["violations"]
    assert not [(rule["id"], [node["target"] for node in rule["nodes"]]) for rule in found]


def test_a_question_mark_lists_keys_but_can_be_typed(points):
    page, _ = points
    page.locator("#stage").focus()
    page.keyboard.press("?")
    dialog = page.locator("#dialog")
    expect(dialog).to_contain_text("Keys and gestures")
    clean(page)
    page.keyboard.press("Escape")
    expect(dialog).to_be_hidden()
    field(page, "teeth.backlash").focus()
    page.keyboard.press("?")
    expect(dialog).to_be_hidden()
    page.locator("#keys").click()
    expect(dialog).to_be_visible()


def test_keys_of_the_list_do_what_it_says(points):
    page, _ = points
    page.locator("#keys").click()
    told = page.locator(".keys th").all_inner_texts()
    page.keyboard.press("Escape")
    assert {"Ctrl+Z, Ctrl+Shift+Z", "Space", "Page up, Page down"} <= {words.split(", or")[0] for words in told}
    page.locator("#scrub").focus()
    page.keyboard.press("PageUp")
    page.keyboard.press("ArrowRight")
    expect(page.locator("#angle")).to_have_text("11.0°")
    page.locator("#stage").focus()
    page.keyboard.press("Space")
    expect(page.locator("#play")).to_have_text("Pause")
    page.keyboard.press("Space")
    handles = page.locator(".handle").count()
    page.get_by_role("button", name="point 1 of the pitch curve").focus()
    page.keyboard.press("Insert")
    expect(page.locator(".handle")).to_have_count(handles + 1)
    page.keyboard.press("Control+z")
    expect(page.locator(".handle")).to_have_count(handles)


@pytest.mark.parametrize(("width", "scheme"), looks(1440, 390))
def test_the_tour_has_six_steps_and_comes_once(browser, tmp_path, width, scheme):
    copy = tmp_path / FEEDER.name
    copy.write_text(FEEDER.read_text())
    with (
        studio(copy) as running,
        studio(copy) as again,
        shown(browser, running.url, toured=False, size=(width, 800), color_scheme=scheme) as page,
    ):
        card = page.locator("#tour")
        places = set()
        for step in range(1, 7):
            expect(card.locator("h2")).to_contain_text(f"{step} of 6")
            expect(page.locator(".toured")).to_have_count(1)
            expect(page.locator(".toured")).to_be_in_viewport()
            expect(card).to_be_in_viewport(ratio=1)
            places.add(card.locator("h2").inner_text())
            clean(page)
            page.keyboard.press("Enter")
        assert len(places) == 6
        expect(card).to_have_count(0)
        expect(page.locator(".toured")).to_have_count(0)
        page.reload()
        settled(page)
        expect(card).to_have_count(0)
        # Another run of the program has another port.
        page.goto(again.url)
        settled(page)
        expect(card).to_have_count(0)
        page.locator("#keys").click()
        page.get_by_role("button", name="Take the tour").click()
        expect(card).to_be_visible()


def test_the_tour_is_skipped_and_goes_back(browser, tmp_path):
    with opened(browser, tmp_path, POINTS, toured=False) as (page, _):
        card = page.locator("#tour")
        card.get_by_role("button", name="Next").click()
        expect(card.locator("h2")).to_contain_text("2 of 6")
        card.get_by_role("button", name="Back").click()
        expect(card.locator("h2")).to_contain_text("1 of 6")
        # The page is worked with meanwhile.
        field(page, "teeth.backlash").fill("0.06")
        field(page, "teeth.backlash").press("Enter")
        expect(page.locator("#file")).to_contain_text("not saved")
        card.get_by_role("button", name="Next").focus()
        page.keyboard.press("Escape")
        expect(card).to_have_count(0)
        page.reload()
        settled(page)
        expect(card).to_have_count(0)


def test_a_report_has_no_tour(browser, tmp_path):
    out = tmp_path / "pair.html"
    centrode("report", POINTS, "-o", out, check=False)
    with shown(browser, out.as_uri(), toured=False, offline=True) as page:
        expect(page.locator("#tour")).to_have_count(0)
        expect(page.locator("#keys")).to_be_hidden()
