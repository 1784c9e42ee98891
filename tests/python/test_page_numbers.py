"""Numbers typed on the design page: worked out, and given in other units."""

import pytest
import tomllib
from page import field, settled
from playwright.sync_api import expect

WORKED = "([text, unit]) => import(new URL('numbers.js', location)).then(numbers => numbers.worked(text, unit))"


def test_a_number_is_worked_out_in_the_unit_of_its_field(points):
    page, _ = points
    for text, unit, value in [
        ("2*1.5", "", 3),
        ("(40+2)/3", "mm", 14),
        ("1/8 in", "mm", 3.175),
        ('1/8"', "mm", 3.175),
        ("1 in + 2 mm", "mm", 27.4),
        ("1 in + 2", "mm", 27.4),
        ("12 cm", "mm", 120),
        ("1,5*2", "mm", 3),
        ("0.1+0.2", "mm", 0.3),
        ("1e3/2", "mm", 500),
        ("-(3-5)", "mm", 2),
        ("-2*-3", "mm", 6),
        ("7-2-3", "mm", 2),
        ("8/4/2", "mm", 1),
        ("2+3*4", "mm", 14),
        ("pi/9 rad", "°", 20),
        ("2\u00d73", "", 6),
        ("2.5", "mm", 2.5),
    ]:
        assert page.evaluate(WORKED, [text, unit]) == value, text
    # An expression without a value stays as typed: the program reports its error.
    for text, unit in [
        ("2*", "mm"),
        ("(2", "mm"),
        ("2 3", "mm"),
        ("1/0", "mm"),
        ("1 in", "°"),
        ("1 rad", "mm"),
        ("3 in * 2 mm", "mm"),
        ("3 constructor", "mm"),
        ("auto", "mm"),
        ("alert(1)", "mm"),
        ("", "mm"),
    ]:
        assert page.evaluate(WORKED, [text, unit]) == text, text


@pytest.mark.parametrize(
    ("key", "text", "value"),
    [
        ("driver.bore", "3/8 in", "9.525"),
        ("tooth_count", "6*6+1", "37"),
        ("tooth_count", "4*9", "36"),
        ("pitch.radius-3", "2*24.5", "49"),
        ("pitch.radius-3", "48+0.5", "48.5"),
    ],
)
def test_a_field_shows_what_its_text_comes_to(points, key, text, value):
    page, design = points
    before = design.read_text()
    box = field(page, key)
    box.fill(text)
    box.press("Enter")
    expect(box).to_have_value(value)
    settled(page)
    expect(box).to_have_value(value)
    box.press("Tab")
    with page.expect_response("**/save"):
        page.keyboard.press("Control+s")
    assert text not in design.read_text()
    saved = tomllib.loads(design.read_text())
    for name in key.replace("-", ".").split("."):
        saved = saved[int(name) if name.isdigit() else name]
    assert saved == float(value)
    assert (design.read_text() == before) == (value in ("37", "49"))


def test_a_text_that_comes_to_nothing_is_told_at_its_field(points):
    page, design = points
    box = field(page, "driver.bore")
    box.fill("3/")
    box.press("Enter")
    expect(page.locator('[id="remark-driver.bore"]')).to_contain_text("error")
    expect(box).to_have_value("3/")
    assert "bore = 10" in design.read_text()
