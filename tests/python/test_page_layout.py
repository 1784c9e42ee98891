"""Room on the design page: tabs below the picture of a narrow window, borders in a wide one, one chart enlarged."""

import pytest
from axe_playwright_python.sync_playwright import Axe
from page import ARMS, CIRCLE, POINTS, drawing, field, opened, settled, shown
from playwright.sync_api import expect
from studio import studio


def scrolled(page, least):
    """Waits until the page has been scrolled so far, pixels."""
    for _ in range(100):
        if page.evaluate("scrollY") > least:
            return
        page.wait_for_timeout(50)
    raise AssertionError(f"scrolled by {page.evaluate('scrollY')}, not {least}")


PANES = {"Design": "#form", "Goals": "#verdict", "Curves": "#charts"}


@pytest.mark.parametrize("size", [(1024, 768), (390, 844), (844, 390)], ids=str)
def test_the_picture_of_a_narrow_window_stays_in_sight(browser, tmp_path, size):
    with opened(browser, tmp_path, ARMS, size=size) as (page, _):
        for tab, pane in PANES.items():
            page.get_by_role("tab", name=tab).click()
            for other in PANES.values():
                expect(page.locator(other)).to_be_visible(visible=other == pane)
            page.mouse.move(size[0] - 20, size[1] - 20)
            page.mouse.wheel(0, 4000)
            scrolled(page, 100)
            expect(page.locator("#stage")).to_be_in_viewport(ratio=0.99)
            assert page.evaluate("document.documentElement.scrollWidth") <= size[0]
            # The pane has room next to or below it.
            assert (
                page.locator(".picture").evaluate("box => box.clientHeight * box.clientWidth")
                < 0.75 * size[0] * size[1]
            )


def test_tabs_are_chosen_by_keys(browser, tmp_path):
    with opened(browser, tmp_path, CIRCLE, size=(390, 844)) as (page, _):
        goals = page.get_by_role("tab", name="Goals")
        goals.focus()
        page.keyboard.press("ArrowRight")
        expect(page.get_by_role("tab", name="Curves")).to_be_focused()
        expect(page.locator("#charts")).to_be_visible()
        page.keyboard.press("ArrowRight")
        expect(page.get_by_role("tab", name="Design")).to_have_attribute("aria-selected", "true")
        expect(page.locator("#form")).to_be_visible()


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("tab", PANES)
def test_every_tab_is_free_of_faults_that_axe_knows(browser, tmp_path, tab, scheme):
    with opened(browser, tmp_path, CIRCLE, size=(390, 844), color_scheme=scheme) as (page, _):
        page.get_by_role("tab", name=tab).click()
        assert Axe().run(page).response["violations"] == []


def finger(page, start, end):
    """Moves one finger over the page, as a hand does."""
    speaker = page.context.new_cdp_session(page)
    steps = 8
    for i in range(steps + 1):
        x, y = (a + (b - a) * i / steps for a, b in zip(start, end, strict=True))
        kind = "touchStart" if i == 0 else "touchMove"
        speaker.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [{"x": x, "y": y}]})
        page.wait_for_timeout(20)
    speaker.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})


def test_a_finger_on_the_picture_scrolls_the_page_and_on_a_point_drags_it(browser, tmp_path):
    with opened(browser, tmp_path, POINTS, size=(390, 844), has_touch=True) as (page, _):
        point = page.locator(".handle").first
        box = point.locator("circle").last.bounding_box()
        x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        before = point.get_attribute("aria-label")
        finger(page, (x, y), (x, y - 12))
        settled(page)
        expect(point).not_to_have_attribute("aria-label", before)
        assert page.evaluate("scrollY") == 0
        # The corner of the picture, where no point is.
        stage = page.locator("#stage").bounding_box()
        corner = stage["x"] + stage["width"] - 12, stage["y"] + stage["height"] - 40
        finger(page, corner, (corner[0], corner[1] - 200))
        scrolled(page, 50)


def test_borders_are_moved_by_hand_and_by_keys_and_stay(browser, tmp_path):
    copy = tmp_path / CIRCLE.name
    copy.write_text(CIRCLE.read_text())
    width = "pane => pane.getBoundingClientRect().width"
    with studio(copy) as running, shown(browser, running.url) as page:
        form, border = page.locator("#form"), page.get_by_role("separator", name="Width of the numbers")
        before = form.evaluate(width)
        box = border.bounding_box()
        page.mouse.move(box["x"] + 4, 400)
        page.mouse.down()
        page.mouse.move(box["x"] + 64, 400, steps=3)
        page.mouse.up()
        assert form.evaluate(width) == before + 60
        right, verdict = page.get_by_role("separator", name="Width of the report"), page.locator("#verdict")
        was = verdict.evaluate(width)
        right.focus()
        page.keyboard.press("ArrowLeft")
        assert verdict.evaluate(width) == was + 16
        assert int(right.get_attribute("aria-valuenow")) == was + 16
        page.keyboard.press("End")
        assert page.locator(".middle").evaluate(width) == 360
        page.keyboard.press("Home")
        assert verdict.evaluate(width) == 220
        assert Axe().run(page).response["violations"] == []
        page.reload()
        settled(page)
        assert (form.evaluate(width), verdict.evaluate(width)) == (before + 60, 220)
        border.dblclick()
        assert form.evaluate(width) == before


def test_a_window_that_was_narrow_has_its_panes_again_once_it_is_wide(browser, tmp_path):
    width = "pane => pane.getBoundingClientRect().width"
    with opened(browser, tmp_path, CIRCLE) as (page, _):
        panes = [page.locator("#form"), page.locator("#verdict")]
        before = [pane.evaluate(width) for pane in panes]
        page.set_viewport_size({"width": 390, "height": 800})
        page.get_by_role("tab", name="Design").click()
        page.set_viewport_size({"width": 1440, "height": 900})
        expect(page.locator("#tabs")).to_be_hidden()
        assert [pane.evaluate(width) for pane in panes] == before


def test_one_chart_is_enlarged_and_stays_so_over_edits(browser, tmp_path):
    with opened(browser, tmp_path, ARMS) as (page, _):
        names = page.locator("#charts .chart b").all_text_contents()
        chart = page.locator("#charts .chart").filter(has=page.get_by_text(names[1], exact=True))
        size = chart.locator("canvas").bounding_box()
        page.get_by_role("button", name=f"{names[1]} enlarged").click()
        large = chart.locator("canvas").bounding_box()
        assert large["height"] > 2.5 * size["height"]
        assert large["width"] > 1.8 * size["width"]
        field(page, "bend_deg").fill("-52")
        field(page, "bend_deg").press("Enter")
        settled(page)
        assert chart.locator("canvas").bounding_box()["height"] == large["height"]
        page.get_by_role("button", name=f"{names[1]} enlarged").click()
        assert chart.locator("canvas").bounding_box()["height"] == size["height"]


def test_the_shape_from_before_is_a_ghost_while_a_point_is_dragged(browser, tmp_path):
    with opened(browser, tmp_path, POINTS) as (page, _):
        plain = drawing(page)
        box = page.locator(".handle circle").last.bounding_box()
        x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        page.mouse.move(x, y)
        page.mouse.down()
        page.mouse.move(x + 25, y, steps=4)
        settled(page)
        dragged = drawing(page)
        page.mouse.up()
        settled(page)
        # The same design, without the ghost.
        after = drawing(page)
        assert len({plain, dragged, after}) == 3
        page.get_by_role("button", name="Undo").click()
        settled(page)
        assert drawing(page) == plain
