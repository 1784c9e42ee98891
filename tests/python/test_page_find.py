"""Numbers of the design page's form found by words and explained; goals numbered; lines of the source."""

import pytest
from axe_playwright_python.sync_playwright import Axe
from page import ARMS, FEEDER, field, opened, settled, until
from playwright.sync_api import expect


def shown_keys(page):
    rows = page.locator("#form .field:visible label")
    return {name.removeprefix("field-") for name in rows.evaluate_all("all => all.map(one => one.htmlFor)")}


def test_numbers_are_found_by_the_words_of_their_names_and_their_help(browser, tmp_path):
    with opened(browser, tmp_path, ARMS) as (page, _):
        every = page.locator("#form .field").count()
        open_before = page.locator("#form details[open]").count()
        box = page.get_by_role("textbox", name="Find a number")
        box.fill("keyway WIDTH")
        keys = shown_keys(page)
        assert keys
        assert all("keyway" in key for key in keys)
        assert any(key.endswith(".width") for key in keys)
        expect(page.locator("#find-count")).to_contain_text(f"{len(keys)} of ")
        assert Axe().run(page).response["violations"] == []
        box.fill("no such number")
        assert shown_keys(page) == set()
        box.press("Escape")
        assert page.locator("#form .field:not([hidden])").count() == every
        assert page.locator("#form details[open]").count() == open_before


def test_essentials_are_what_the_file_says(browser, tmp_path):
    with opened(browser, tmp_path, FEEDER) as (page, _):
        every = shown_keys(page)
        page.get_by_role("checkbox", name="Essentials").check()
        few = shown_keys(page)
        assert few < every
        assert 2 * len(few) < page.locator("#form .field").count()
        assert page.locator("#form .field.written[hidden]").count() == 0
        # A number found while the rest is hidden can be changed.
        key = next(key for key in few if key.startswith("linkage") or key.startswith("lengths") or "crank" in key)
        value = float(field(page, key).input_value())
        field(page, key).fill(str(value + 1))
        field(page, key).press("Enter")
        settled(page)
        assert shown_keys(page) >= few


def test_f1_and_a_tap_on_the_name_tell_what_a_number_is(browser, tmp_path):
    with opened(browser, tmp_path, ARMS) as (page, _):
        box = field(page, "bend_deg")
        row = page.locator(".field").filter(has=box)
        words = row.locator("label").get_attribute("title")
        assert words
        box.press("F1")
        expect(row.locator(".hint")).to_contain_text(words)
        box.press("F1")
        expect(row.locator(".hint")).to_have_count(0)
        row.locator("label").click()
        expect(row.locator(".hint")).to_contain_text(words)
        # A drag of the name changes the number, and tells nothing.
        row.locator("label").click()
        spot = row.locator("label").bounding_box()
        before = box.input_value()
        page.mouse.move(spot["x"] + 5, spot["y"] + 8)
        page.mouse.down()
        page.mouse.move(spot["x"] + 45, spot["y"] + 8, steps=3)
        page.mouse.up()
        settled(page)
        assert box.input_value() != before
        expect(row.locator(".hint")).to_have_count(0)


def test_goals_are_numbered_once_with_the_number_of_the_paper_beside(browser, tmp_path):
    with opened(browser, tmp_path, FEEDER) as (page, _):
        heads = page.locator(".goal .head > span:first-child").all_text_contents()
        assert [head.split(".")[0] for head in heads] == [str(i + 1) for i in range(len(heads))]
        # The paper's fourth goal is one on each of four bars.
        assert [head.endswith("goal 4 of the paper") for head in heads].count(True) == 3


def test_the_source_has_the_numbers_of_its_lines(browser, tmp_path):
    with opened(browser, tmp_path, ARMS) as (page, copy):
        page.get_by_role("button", name="Source").click()
        numbers, area = page.locator(".line-numbers"), page.get_by_role("textbox", name="Design file")
        lines = len(copy.read_text().split("\n"))
        # From the top, with a number in sight next to every line that is.
        assert area.evaluate("box => [box.scrollTop, box.selectionStart, box.selectionEnd]") == [0, 0, 0]
        high = "box => box.clientHeight"
        assert numbers.evaluate(high) == pytest.approx(area.evaluate(high), abs=4)
        assert numbers.text_content().split("\n") == [str(i + 1) for i in range(lines)]
        area.press("Control+End")
        area.press_sequentially("\n\n")
        assert numbers.text_content().endswith(f"\n{lines + 2}")
        assert area.evaluate("box => box.scrollTop") > 0
        tops = "['.line-numbers', 'textarea'].map(name => document.querySelector(name).scrollTop)"
        until(page, f"new Set({tops}).size === 1")
        # A number stands next to its line: both have lines of one height.
        assert len({box.evaluate("box => getComputedStyle(box).lineHeight") for box in (numbers, area)}) == 1
        assert Axe().run(page).response["violations"] == []
