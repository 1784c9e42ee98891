"""Goals and ways of points at several values of one number, from any field of the design page."""

import re

import pytest
from page import ARMS, CIRCLE, FEEDER, field, opened, settled
from playwright.sync_api import expect

# How many points of a canvas are not bare.
INKED = """canvas => {
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  return data.filter((value, i) => i % 4 === 3 && value).length;
}"""


def answered(page, rows):
    """Waits for the list of values."""
    expect(page.locator(".ways-list li")).to_have_count(rows, timeout=60_000)
    return page.locator(".ways-list li")


@pytest.mark.parametrize(
    ("design", "key"),
    [(ARMS, "arm.tip_distance"), (FEEDER, "linkage.coupler"), (CIRCLE, "pitch.module")],
    ids=lambda value: getattr(value, "stem", ""),
)
def test_a_field_opens_it_and_a_value_is_taken_as_one_step(browser, tmp_path, design, key):
    with opened(browser, tmp_path, design) as (page, copy):
        box = field(page, key)
        before = box.input_value()
        box.focus()
        page.keyboard.press("F4")
        expect(page.locator("#response-key")).to_have_value(key)
        page.locator("#response-from").press("Enter")
        # Five values, of which one is that of the design as it is.
        rows = answered(page, 5)
        expect(rows.first).to_contain_text("the design as it is")
        assert page.locator(".ways canvas").evaluate(INKED) > 300
        last = rows.last.get_by_role("button")
        value = re.match(r"[\d.]+", last.locator("b").inner_text())[0]
        assert value == page.locator("#response-to").input_value()
        last.click()
        expect(page.locator("#dialog")).to_be_hidden()
        expect(box).to_have_value(value)
        settled(page)
        page.locator("#undo").click()
        expect(box).to_have_value(before)
        settled(page)
        assert copy.read_text() == design.read_text()


def test_a_count_answers_in_whole_numbers(browser, tmp_path):
    with opened(browser, tmp_path, CIRCLE) as (page, _):
        field(page, "pitch.tooth_count").focus()
        page.keyboard.press("F4")
        ends = page.locator("#response-from, #response-to").evaluate_all("ends => ends.map(({ value }) => value)")
        assert ends == ["22", "26"]
        page.locator("#response-from").press("Enter")
        # At this ratio the driven gear has no whole number of teeth next to an odd one, and the page reports this.
        names = [re.match(r"\s*(\d+)", row.inner_text())[1] for row in answered(page, 5).all()]
        assert names == ["24", "22", "23", "25", "26"]


def test_a_way_that_is_pointed_at_lies_in_front(browser, tmp_path):
    with opened(browser, tmp_path, FEEDER) as (page, _):
        # A pointer finds the button next to the field.
        row = page.locator(".field", has=field(page, "linkage.crank"))
        row.hover()
        row.get_by_role("button", name="Response to Crank").click()
        page.locator("#response-from").press("Enter")
        rows = answered(page, 5)
        canvas = page.locator(".ways canvas")
        drawn = canvas.evaluate("canvas => canvas.toDataURL()")
        rows.nth(3).get_by_role("button").hover()
        assert canvas.evaluate("canvas => canvas.toDataURL()") != drawn
        page.mouse.move(0, 0)
        assert canvas.evaluate("canvas => canvas.toDataURL()") == drawn
        expect(rows.nth(1)).to_contain_text(re.compile(r"\d+ of \d+ goals reached"))


def test_a_value_without_a_machine_says_why_and_cannot_be_taken(browser, tmp_path):
    with opened(browser, tmp_path, FEEDER) as (page, _):
        field(page, "linkage.crank").focus()
        page.keyboard.press("F4")
        page.locator("#response-to").fill("400")
        page.locator("#response-to").press("Enter")
        rows = answered(page, 6)
        expect(rows.last).to_contain_text("400 mm: ")
        expect(rows.last).to_have_class("error")
        assert rows.last.get_by_role("button").count() == 0
        page.get_by_role("button", name="Close", exact=True).click()
        expect(page.locator("#undo")).to_be_disabled()
