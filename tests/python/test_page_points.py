"""Points of B-spline pitch curves on the design page: a table, its keys, pasting, and numbered handles."""

import cmath
import math

import pytest
import tomllib
from axe_playwright_python.sync_playwright import Axe
from conftest import ROOT, centrode
from page import ARMS, POINTS, drawing, field, opened, settled, shown
from playwright.sync_api import expect
from sample import looks

PLANE = ROOT / "tests" / "designs" / "quintic-pair.toml"
RADII = tomllib.loads(POINTS.read_text())["pitch"]["radius"]
ANGLES = tomllib.loads(POINTS.read_text())["pitch"]["angle_deg"]


def rows(page):
    """The points of the table."""
    cells = page.locator(".points tbody input").evaluate_all("all => all.map(input => Number(input.value))")
    return list(zip(cells[::2], cells[1::2], strict=True))


def counted(page, count):
    expect(page.locator(".points tbody tr")).to_have_count(count, timeout=30_000)
    # Fitted teeth are cut anew for every change: on a busy computer that takes seconds.
    expect(page.locator(".handle .number")).to_have_text([str(i + 1) for i in range(count)], timeout=30_000)


def saved(page, design):
    """The pitch curve of the file, once it is saved."""
    page.keyboard.press("Control+s")
    expect(page.locator("#file")).not_to_contain_text("not saved")
    return tomllib.loads(design.read_text())["pitch"]


def point(page, number):
    return page.get_by_role("button", name=f"point {number} of the pitch curve")


def paste(page, cell, text):
    """Pastes into a cell by the keyboard."""
    page.evaluate("text => navigator.clipboard.writeText(text)", text)
    cell.focus()
    page.keyboard.press("Control+v")


@pytest.fixture
def table(browser, tmp_path):
    with opened(browser, tmp_path, POINTS, permissions=["clipboard-read", "clipboard-write"]) as both:
        yield both


def test_a_point_is_added_and_deleted_by_the_buttons_of_its_row(table):
    page, design = table
    before = drawing(page)
    counted(page, len(RADII))
    page.get_by_role("button", name="Add a point after point 3", exact=True).click()
    counted(page, len(RADII) + 1)
    expect(field(page, "pitch.radius-3")).to_be_focused()
    assert rows(page)[2:5] == [(50, 76), (49.5, 90.5), (49, 105)]
    settled(page)
    assert drawing(page) != before
    page.get_by_role("button", name="Delete point 1", exact=True).click()
    counted(page, len(RADII))
    expect(page.get_by_role("button", name="Delete point 1", exact=True)).to_be_focused()
    pitch = saved(page, design)
    assert pitch["radius"] == [28, 50, 49.5, *RADII[3:]]
    assert pitch["angle_deg"] == [45, 76, 90.5, *ANGLES[3:]]
    page.locator("#undo").click()
    counted(page, len(RADII) + 1)
    page.locator("#undo").click()
    counted(page, len(RADII))
    assert rows(page) == list(zip(RADII, ANGLES, strict=True))


def test_every_point_is_edited_by_keyboard(table):
    page, design = table
    field(page, "pitch.radius-11").focus()
    page.keyboard.press("Insert")
    counted(page, len(RADII) + 1)
    # Between the last and the first, a turn on.
    expect(field(page, "pitch.radius-12")).to_be_focused()
    page.keyboard.press("Control+a")
    page.keyboard.type("23")
    page.keyboard.press("Tab")
    expect(field(page, "pitch.angle_deg-12")).to_be_focused()
    expect(field(page, "pitch.angle_deg-12")).to_have_value("362.5")
    page.keyboard.press("ArrowUp")
    page.keyboard.press("Shift+Tab")
    page.keyboard.press("Control+Delete")
    counted(page, len(RADII))
    expect(field(page, "pitch.radius-11")).to_be_focused()
    page.keyboard.press("Insert")
    page.keyboard.press("Insert")
    counted(page, len(RADII) + 2)
    pitch = saved(page, design)
    assert pitch["radius"][: len(RADII)] == RADII
    assert pitch["angle_deg"] == sorted(pitch["angle_deg"])


def test_handles_are_numbered_and_counted_by_keys(table):
    page, _ = table
    handle = point(page, 3)
    expect(handle.locator(".where")).to_be_hidden()
    handle.focus()
    expect(handle.locator(".where")).to_be_visible()
    expect(handle.locator(".where")).to_have_text("3: radius 50 mm, angle 76°")
    page.keyboard.press("ArrowLeft")
    expect(handle.locator(".where")).not_to_have_text("3: radius 50 mm, angle 76°")
    expect(field(page, "pitch.radius-2")).not_to_have_value("50")
    moved = rows(page)[2]
    expect(handle.locator(".where")).to_have_text(f"3: radius {moved[0]:g} mm, angle {moved[1]:g}°")
    page.keyboard.press("Insert")
    counted(page, len(RADII) + 1)
    expect(point(page, 4)).to_be_focused()
    page.keyboard.press("Delete")
    counted(page, len(RADII))
    expect(point(page, 4)).to_be_focused()
    point(page, len(RADII)).focus()
    page.keyboard.press("Backspace")
    counted(page, len(RADII) - 1)
    expect(point(page, len(RADII) - 1)).to_be_focused()
    assert rows(page)[3:] == list(zip(RADII, ANGLES, strict=True))[3:-1]


def middle(handle):
    """Where a point of the drawing is on the screen."""
    box = handle.locator("circle").last.bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


@pytest.mark.parametrize("design", [POINTS, PLANE], ids=lambda path: path.stem)
@pytest.mark.parametrize("before", [1, 5, -1], ids=["early", "late", "between the last and the first"])
def test_a_point_is_added_where_the_line_between_two_is_clicked_twice(browser, tmp_path, design, before):
    with opened(browser, tmp_path, design) as (page, _):
        own = rows(page)
        number = before if before > 0 else len(own)
        (x, y), (u, v) = middle(point(page, number)), middle(point(page, number % len(own) + 1))
        page.mouse.dblclick(x + 0.4 * (u - x), y + 0.4 * (v - y))
        counted(page, len(own) + 1)
        made = point(page, number + 1)
        expect(made).to_be_focused()
        assert rows(page)[:number] == own[:number]
        assert rows(page)[number + 1 :] == own[number:]
        if design == PLANE:
            ways = [complex(*rows(page)[(number + k) % len(rows(page))]) for k in (-1, 0, 1)]
        else:
            angles = [angle for _, angle in rows(page)]
            assert angles == sorted(angles)
            assert angles[-1] < angles[0] + 360
            near = [rows(page)[(number + k) % len(angles)] for k in (-1, 0, 1)]
            ways = [cmath.rect(radius, math.radians(angle)) for radius, angle in near]
        # Where it was clicked, to the digits that can be seen.
        assert abs(ways[1] - (0.6 * ways[0] + 0.4 * ways[2])) < 1


def test_a_double_click_off_the_curve_fits_the_view(table):
    page, _ = table
    fitted = drawing(page)
    page.locator("#closer").click()
    assert drawing(page) != fitted
    box = page.locator("#stage").bounding_box()
    page.mouse.dblclick(box["x"] + box["width"] - 60, box["y"] + 60)
    assert drawing(page) == fitted
    counted(page, len(RADII))


def test_three_points_are_the_fewest(browser, tmp_path):
    design = tmp_path / "few" / "pair.toml"
    design.parent.mkdir()
    design.write_text(POINTS.read_text().replace(str(RADII), "[40, 41, 40.5]").replace(str(ANGLES), "[0, 120, 240]"))
    with opened(browser, tmp_path, design) as (page, _):
        counted(page, 3)
        expect(page.get_by_role("button", name="Delete point 1", exact=True)).to_be_disabled()
        point(page, 1).focus()
        page.keyboard.press("Delete")
        page.wait_for_timeout(300)
        counted(page, 3)


@pytest.mark.parametrize(
    ("text", "start", "expected"),
    [
        ("30\t100\n31\t110", "pitch.radius-3", [(30, 100), (31, 110)]),
        ("Radius\tAngle\r\n30,5\t100\r\n31\t110,25\r\n", "pitch.radius-3", [(30.5, 100), (31, 110.25)]),
        ("30\n31\n", "pitch.radius-3", [(30, 105), (31, 132)]),
        ("101\n131\n", "pitch.angle_deg-3", [(49, 101), (58, 131)]),
        ("30; 100\n31; 110", "pitch.radius-3", [(30, 100), (31, 110)]),
        ("30.5,100\n31,110.5", "pitch.radius-3", [(30.5, 100), (31, 110.5)]),
        ("30 100", "pitch.radius-3", [(30, 100), (58, 132)]),
    ],
    ids=["tabs", "a head and decimal commas", "one column", "the second column", "semicolons", "commas", "one row"],
)
def test_cells_of_a_spreadsheet_are_pasted(table, text, start, expected):
    page, design = table
    paste(page, field(page, start), text)
    expect(page.locator("#file")).to_contain_text("not saved")
    expect(field(page, start)).to_be_focused()
    pitch = saved(page, design)
    points = list(zip(pitch["radius"], pitch["angle_deg"], strict=True))
    own = list(zip(RADII, ANGLES, strict=True))
    assert points == own[:3] + expected + own[5:]


def test_pasted_points_beyond_the_last_are_added_and_one_number_is_text(table):
    page, _ = table
    paste(page, field(page, "pitch.radius-11"), "25\t340\n22\t350\n21.5\t358")
    counted(page, len(RADII) + 2)
    assert rows(page)[-3:] == [(25, 340), (22, 350), (21.5, 358)]
    cell = field(page, "pitch.radius-2")
    cell.focus()
    page.keyboard.press("Control+a")
    paste(page, cell, "51")
    expect(cell).to_have_value("51")
    counted(page, len(RADII) + 2)


@pytest.mark.parametrize(
    ("text", "start", "reason"),
    [
        ("30\t100\n31\tabout", "pitch.radius-3", "line 2: about is no number"),
        ("30\t100\n31\t\t2", "pitch.radius-3", "line 2: a number is missing"),
        ("30\t100\n31\t110", "pitch.angle_deg-3", "line 1: more numbers than columns"),
        ("30\n31", "pitch.radius-11", "line 2: a new point needs two numbers"),
    ],
    ids=["a word", "a gap", "too wide", "half a point"],
)
def test_what_does_not_fit_is_told_and_changes_nothing(table, text, start, reason):
    page, _ = table
    paste(page, field(page, start), text)
    expect(page.locator('[id="remark-pitch.radius"]')).to_contain_text(reason)
    assert rows(page) == list(zip(RADII, ANGLES, strict=True))
    expect(page.locator("#undo")).to_be_disabled()


def test_all_points_are_taken_as_text(table):
    page, design = table
    page.get_by_role("button", name="As text").click()
    text = page.get_by_role("textbox", name="Points, one a line")
    expect(text).to_be_focused()
    expect(text).to_have_value("\n".join(f"{r}\t{a}" for r, a in zip(RADII, ANGLES, strict=True)))
    apply = page.locator("#dialog").get_by_role("button", name="Apply")
    for wrong, reason in [
        ("1 2\n3", "line 2: a point has two numbers"),
        ("1 2\n3 4", "at least 3"),
        ("1 2\n\nx 4\n3 4", "line 3: x is no number"),
        ("", "at least 3"),
    ]:
        text.fill(wrong)
        apply.click()
        expect(page.locator("#dialog [role=status]")).to_contain_text(reason)
    text.fill("\n".join(f"40\t{angle}" for angle in range(0, 360, 40)))
    apply.click()
    counted(page, 9)
    expect(page.get_by_role("button", name="As text")).to_be_focused()
    pitch = saved(page, design)
    assert pitch["radius"] == [40] * 9
    assert pitch["angle_deg"] == list(range(0, 360, 40))


def test_points_of_the_plane_are_added_as_far_out_as_their_neighbours(browser, tmp_path):
    with opened(browser, tmp_path, PLANE) as (page, _):
        counted(page, 7)
        page.get_by_role("button", name="Add a point after point 7", exact=True).click()
        counted(page, 8)
        (x, y), (u, v), (first_x, first_y) = rows(page)[-2:] + rows(page)[:1]
        reach = (abs(complex(x, y)) + abs(complex(first_x, first_y))) / 2
        assert abs(complex(u, v)) == pytest.approx(reach, abs=2e-3)
        turn = complex(u, v) / complex(x, y), complex(first_x, first_y) / complex(u, v)
        assert turn[0].imag * turn[1].real == pytest.approx(turn[1].imag * turn[0].real, abs=2e-3)
        expect(field(page, "pitch.x-7")).to_be_focused()


def test_the_arms_have_the_table_too_and_a_report_shows_it_fixed(browser, tmp_path):
    with opened(browser, tmp_path, ARMS) as (page, _):
        count = len(rows(page))
        page.get_by_role("button", name="Delete point 2", exact=True).click()
        counted(page, count - 1)
    out = tmp_path / "pair.html"
    centrode("report", POINTS, "-o", out, check=False)
    with shown(browser, out.as_uri(), offline=True) as page:
        assert rows(page) == list(zip(RADII, ANGLES, strict=True))
        expect(page.locator(".points button")).to_have_count(0)
        expect(field(page, "pitch.radius")).to_be_disabled()


@pytest.mark.parametrize(("width", "scheme"), looks(1440, 1024, 390))
def test_points_are_for_everybody(browser, tmp_path, width, scheme):
    with opened(browser, tmp_path, POINTS, color_scheme=scheme) as (page, _):
        page.set_viewport_size({"width": width, "height": 900})
        if width < 1060:
            page.get_by_role("tab", name="Design").click()
        for dialog in (False, True):
            if dialog:
                page.get_by_role("button", name="As text").click()
            found = Axe().run(page).response["violations"]
            assert not [(rule["id"], [node["target"] for node in rule["nodes"]]) for rule in found]
            assert page.evaluate("document.documentElement.scrollWidth") <= width
