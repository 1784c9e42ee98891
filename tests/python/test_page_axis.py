"""The axis of the charts of the design page: limits across it, zoom along it, its units, and the picture as PNG."""

import json
import re
import struct
from xml.etree import ElementTree

import pytest
from axe_playwright_python.sync_playwright import Axe
from conftest import ROOT, centrode
from page import ARMS, CIRCLE, field, opened, settled, shown
from playwright.sync_api import expect

FEEDER = ROOT / "tests" / "designs" / "feeder-2022.toml"
COMPOSED = ROOT / "tests" / "designs" / "composed-feeder.toml"


def chart(page, name):
    return page.locator("figure.chart", has=page.get_by_text(name, exact=True))


def taken(page, name, kind):
    """A chart as a file."""
    with page.expect_download() as download:
        chart(page, name).get_by_role("button", name=f"{name} as {kind}").click()
    return download.value.path().read_bytes()


def limits(svg):
    """Values at which lines go across, in the order of the file."""
    return [float(path.get("data-limit")) for path in ElementTree.fromstring(svg).iter() if path.get("data-limit")]


@pytest.mark.parametrize(
    ("design", "name", "wanted", "goal"),
    [
        (FEEDER, "Angle of coupler and rocker", [40, 140], "transmission-angle"),
        (COMPOSED, "Minimum transmission angle", [40], "transmission"),
        (ARMS, "Clearance of the arms", [0], "arm-clearance"),
    ],
    ids=lambda value: getattr(value, "stem", ""),
)
def test_what_a_goal_wants_is_a_line_across_its_figure(browser, tmp_path, design, name, wanted, goal):
    with opened(browser, tmp_path, design) as (page, copy):
        report = json.loads(centrode("check", copy, "--json", check=False).stdout)
        [own] = [one for one in report["goals"] if one["name"] == goal]
        least = own["required"][0] * (57.29577951308232 if own["unit"] == "rad" else 1)
        assert least == pytest.approx(wanted[0])
        expect(chart(page, name).locator(".series-limit")).to_contain_text(f"at least {wanted[0]}")
        near = limits(taken(page, name, "SVG"))
        assert near == pytest.approx([value for value in wanted if value in near or name != "Clearance of the arms"])
        others = page.locator(".chart .series-limit:visible").count()
        assert others == 1


def test_a_limit_goes_with_the_goal_that_sets_it(browser, tmp_path):
    with opened(browser, tmp_path, COMPOSED) as (page, copy):
        expect(page.locator(".series-limit:visible")).to_have_count(1)
        text = copy.read_text()
        assert "minimum = 40" in text
        page.locator("#source").click()
        page.get_by_role("textbox", name="Design file").fill(text.replace("minimum = 40", "minimum = 12.5"))
        page.get_by_role("button", name="Apply").click()
        expect(page.locator(".series-limit:visible")).to_have_text("at least 12.5")
        assert limits(taken(page, "Minimum transmission angle", "SVG")) == [12.5]


def along(page, name, first, last):
    """Draws a stretch of a chart's axis, shares of its length."""
    axis = chart(page, name).locator(".u-axis").first
    axis.scroll_into_view_if_needed()
    box = axis.bounding_box()
    y = box["y"] + box["height"] / 2
    page.mouse.move(box["x"] + first * box["width"], y)
    page.mouse.down()
    page.mouse.move(box["x"] + last * box["width"], y, steps=5)
    page.mouse.up()


def ticks(page, name):
    """The words along the axis of a chart, as its SVG has them."""
    words = ElementTree.fromstring(taken(page, name, "SVG")).iter("{http://www.w3.org/2000/svg}text")
    return [text.text for text in words if text.get("text-anchor") == "middle"]


def ends(page):
    """First and last input that is shown, read by the pointer at both ends of a chart."""
    found = []
    lines = page.locator("#charts .u-over").first
    lines.scroll_into_view_if_needed()
    box = lines.bounding_box()
    for x in (box["x"] + 0.5, box["x"] + box["width"] - 0.5):
        page.mouse.move(x, box["y"] + 20)
        # Charts follow the pointer in the next frame.
        page.evaluate("() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
        found.append(page.locator("#charts .pointed span").first.inner_text())
    page.mouse.move(5, 5)
    return found


def test_a_drag_along_the_axis_zooms_all_charts_and_a_double_click_ends_it(browser, tmp_path):
    with opened(browser, tmp_path, FEEDER) as (page, _):
        angle = page.locator("#angle").inner_text()
        whole = ends(page)
        along(page, "Speed of the tip", 0.25, 0.5)
        first, last = (float(words.rstrip("°")) for words in ends(page))
        assert (first, last) == pytest.approx((90, 180), abs=2)
        for name in ("Speed of the tip", "Turn of the crank"):
            shown_ticks = [float(words.rstrip("°")) for words in ticks(page, name)[:-1]]
            assert len(shown_ticks) >= 3
            assert first - 1 < shown_ticks[0]
            assert shown_ticks[-1] < last + 1
        # The machine stays where it is, and an edit leaves the stretch.
        assert page.locator("#angle").inner_text() == angle
        field(page, "linkage.crank").focus()
        page.keyboard.press("ArrowUp")
        settled(page)
        assert [float(words.rstrip("°")) for words in ends(page)] == [first, last]
        chart(page, "Speed of the tip").locator(".u-axis").first.dblclick()
        assert ends(page) == whole
        expect(page.locator("#zoomed")).to_be_hidden()


def test_the_axis_is_zoomed_by_keys(browser, tmp_path):
    with opened(browser, tmp_path, FEEDER) as (page, _):
        page.locator("#closer-in").focus()
        page.keyboard.press("Enter")
        assert [float(words.rstrip("°")) for words in ends(page)] == pytest.approx([72, 288], abs=2)
        page.locator("#later").focus()
        page.keyboard.press("Enter")
        assert [float(words.rstrip("°")) for words in ends(page)] == pytest.approx([115.2, 331.2], abs=2)
        found = Axe().run(page).response["violations"]
        assert not [(rule["id"], [node["target"] for node in rule["nodes"]]) for rule in found]
        page.locator("#whole-cycle").focus()
        page.keyboard.press("Enter")
        expect(page.locator("#zoomed")).to_be_hidden()


def test_the_axis_tells_degrees_turns_and_seconds(browser, tmp_path):
    with opened(browser, tmp_path, FEEDER) as (page, copy):
        rate = re.search(r"([\d.]+) cycles per minute", centrode("check", copy, check=False).stdout)
        cycle = 60 / float(rate[1])
        assert float(ends(page)[1].rstrip("°")) == pytest.approx(360, abs=2)
        page.locator("#axis").select_option("turns")
        assert float(ends(page)[1].removesuffix(" turns")) == pytest.approx(1, abs=5e-3)
        assert {"0.0", "1.0"} <= set(ticks(page, "Speed of the tip"))
        page.locator("#axis").select_option("seconds")
        assert float(ends(page)[1].removesuffix(" s")) == pytest.approx(cycle, rel=5e-3)
        assert ticks(page, "Speed of the tip")[-1] == "Input, seconds"


def test_without_a_speed_of_its_own_seconds_are_those_of_playing(browser, tmp_path):
    with opened(browser, tmp_path, CIRCLE) as (page, _):
        turns = float(ends(page)[1].rstrip("°")) / 360
        page.locator("#axis").select_option("seconds")
        for speed in (15, 60):
            page.locator("#speed").select_option(str(speed))
            assert float(ends(page)[1].removesuffix(" s")) == pytest.approx(turns * 60 / speed, rel=5e-3)
            last = float(ticks(page, "Ratio")[-2])
            assert turns * 60 / speed / 2 < last <= turns * 60 / speed * 1.01


def test_a_chart_is_taken_as_png(browser, tmp_path):
    out = tmp_path / "feeder.html"
    centrode("report", FEEDER, "-o", out, check=False)
    with shown(browser, out.as_uri(), offline=True) as page:
        image = taken(page, "Angle of coupler and rocker", "PNG")
        assert image.startswith(b"\x89PNG\r\n\x1a\n")
        assert struct.unpack(">II", image[16:24]) == (1920, 960)
        (tmp_path / "chart.png").write_bytes(image)
        # The line of the goal is in it, and the ground is white.
        colours = page.evaluate(
            """async (bytes) => {
              const bitmap = await createImageBitmap(new Blob([new Uint8Array(bytes)], { type: "image/png" }));
              const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
              context.drawImage(bitmap, 0, 0);
              const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
              const found = {};
              for (let i = 0; i < data.length; i += 4) {
                const colour = `${data[i]},${data[i + 1]},${data[i + 2]}`;
                found[colour] = (found[colour] ?? 0) + 1;
              }
              return found;
            }""",
            list(image),
        )
        assert colours["255,255,255"] > 1_000_000
        assert colours["125,82,0"] > 1_000
