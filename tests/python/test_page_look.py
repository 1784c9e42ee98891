"""One gear from nearby, and the plane of a curve's points, on the design page."""

import math
from xml.etree import ElementTree

import pytest
from axe_playwright_python.sync_playwright import Axe
from page import ARMS, FEEDER, POINTS, SHAFT, drawing, field, opened, settled
from playwright.sync_api import expect
from sample import sampled

SVG = "{http://www.w3.org/2000/svg}"
# Maximum radius of sun and planets, mm: the driver of the same pair as a design of its own has it as a figure.
REACH = 57.955


def taken(page):
    """The picture as it is shown."""
    page.locator("#take-picture").click()
    with page.expect_download() as download:
        page.get_by_role("button", name="Take", exact=True).click()
    return ElementTree.parse(download.value.path()).getroot()


def place(page, name):
    """Where a link's axis is in the picture, as shares of its width and height, and its scale."""
    root = taken(page)
    link = next(group for group in root.iter(f"{SVG}g") if group.get("data-link") == name)
    x, y, scale = (
        float(link.get("transform").split(word)[1].split(")")[0].split()[k])
        for word, k in [("translate(", 0), ("translate(", 1), ("scale(", 0)]
    )
    return x / float(root.get("width")), y / float(root.get("height")), scale


@pytest.mark.parametrize("name", sampled(["sun", "planet 2"], of=["sun"]))
def test_a_gear_is_looked_at_and_followed(browser, tmp_path, name):
    with opened(browser, tmp_path, ARMS) as (page, _):
        look = page.get_by_role("combobox", name="Gears in view")
        gears = ["sun", *(f"{kind} {arm}" for kind in ("intermediate gear", "planet") for arm in (1, 2, 3))]
        assert look.locator("option").all_inner_texts() == ["All", *gears]
        whole = drawing(page)
        _, _, far = place(page, name)
        look.select_option(name)
        x, y, near = place(page, name)
        assert (x, y) == (pytest.approx(0.5), pytest.approx(0.5))
        assert near > 2 * far
        # As large as there is room for it.
        high = page.locator("#stage").bounding_box()["height"]
        assert high / 2.6 < near * REACH < high / 2
        page.locator("#scrub").focus()
        for _ in range(4):
            page.keyboard.press("PageUp")
        x, y, still = place(page, name)
        assert (x, y, still) == (pytest.approx(0.5), pytest.approx(0.5), near)
        # A change of the design keeps to the gear.
        field(page, "arm.tip_distance").press("ArrowUp")
        settled(page)
        assert place(page, name) == (pytest.approx(0.5), pytest.approx(0.5), near)
        assert Axe().run(page).response["violations"] == []
        page.locator("#mesh").click()
        expect(look).to_have_value("")
        look.select_option(name)
        expect(page.locator("#mesh")).to_have_attribute("aria-pressed", "false")
        page.locator("#undo").click()
        settled(page)
        page.locator("#scrub").evaluate("scrub => { scrub.value = 0; scrub.dispatchEvent(new Event('input')); }")
        look.select_option("")
        assert drawing(page) == whole


def test_a_picture_without_gears_offers_none(browser, tmp_path):
    with opened(browser, tmp_path, SHAFT) as (page, _):
        expect(page.locator("#look")).to_be_hidden()


def test_gears_of_the_feeder_are_looked_at_by_keys(browser, tmp_path):
    with opened(browser, tmp_path, FEEDER) as (page, _):
        before = drawing(page)
        page.locator("#look").focus()
        page.keyboard.press("ArrowDown")
        assert drawing(page) != before
        page.locator("#stage").focus()
        page.keyboard.press("0")
        expect(page.locator("#look")).to_have_value("")
        assert drawing(page) == before


def handles(page):
    """Middles of the points in the picture."""
    middle = "({ x, y, width }) => [x + width / 2, y + width / 2]"
    boxes = "all => all.map(({ firstChild }) => firstChild.getBoundingClientRect())"
    return page.locator("#stage .handle").evaluate_all(f"{boxes}.map({middle})")


def test_points_stay_where_they_are_in_the_other_plane(browser, tmp_path):
    with opened(browser, tmp_path, POINTS) as (page, _copy):
        first = float(field(page, "pitch.radius").input_value()), float(field(page, "pitch.angle_deg").input_value())
        before = handles(page)
        field(page, "pitch.plane").select_option("cartesian")
        settled(page)
        expect(page.locator(".remark .error")).to_have_count(0)
        x, y = (float(field(page, f"pitch.{name}").input_value()) for name in "xy")
        angle = math.radians(first[1])
        assert (x, y) == pytest.approx((first[0] * math.cos(angle), first[0] * math.sin(angle)), abs=1e-5)
        # The table of points is that of the new plane; the view fits a curve that is another between them.
        expect(page.locator(".points thead th")).to_have_text(["No.", "X mm", "Y mm"])
        assert len(handles(page)) == len(before)
        field(page, "pitch.plane").select_option("polar")
        settled(page)
        assert handles(page) == [pytest.approx(at, abs=0.1) for at in before]
        for _ in range(2):
            page.locator("#undo").click()
        settled(page)
        expect(page.locator("#save")).to_be_disabled()
