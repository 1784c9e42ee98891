"""The charts of the design page: what is written at their axes, and how their lines run."""

import csv
import json
import re
from itertools import pairwise
from xml.etree import ElementTree

import pytest
from axe_playwright_python.sync_playwright import Axe
from conftest import centrode
from page import ARMS, BOX, CIRCLE, FEEDER, POINTS, curves_of, field, opened, settled, shown
from playwright.sync_api import expect
from sample import looks
from studio import studio

# Every canvas keeps the words written on it, and the lines drawn, since it was last cleared.
WATCH = """
const canvas = CanvasRenderingContext2D.prototype;
const { clearRect, fillText, stroke } = canvas;
canvas.clearRect = function (...box) {
  this.canvas.words = [];
  this.canvas.lines = [];
  return clearRect.apply(this, box);
};
canvas.fillText = function (words, x, y) {
  this.canvas.words?.push({ words, x, y, side: this.textAlign });
  return fillText.call(this, words, x, y);
};
canvas.stroke = function (...path) {
  if (path[0]?.points) this.canvas.lines?.push(path[0].points);
  return stroke.apply(this, path);
};
for (const name of ["moveTo", "lineTo"]) {
  const own = Path2D.prototype[name];
  Path2D.prototype[name] = function (x, y) {
    (this.points ??= []).push([x, y]);
    return own.call(this, x, y);
  };
}
"""


def charts(page):
    """Every chart: its name, words and lines."""
    return page.locator("#charts .chart").evaluate_all(
        """all => all.map(chart => {
          const { words, lines } = chart.querySelector("canvas");
          return [chart.querySelector("b").textContent, words, lines];
        })"""
    )


def upright(words):
    """Numbers up the side, lowest first, and their heights in pixels."""
    side = [(-float(word["y"]), float(word["words"])) for word in words if word["side"] == "right"]
    return sorted(side)


@pytest.mark.parametrize("design", [POINTS, ARMS, FEEDER, BOX, CIRCLE], ids=lambda path: path.stem)
def test_the_numbers_of_an_axis_are_those_of_their_places(browser, tmp_path, design):
    with opened(browser, tmp_path, design, script=WATCH) as (page, _):
        page.wait_for_timeout(300)
        checked = 0
        for name, words, _ in charts(page):
            ticks = upright(words)
            if len(ticks) < 3:
                continue
            (low, first), (high, last) = ticks[0], ticks[-1]
            step = (last - first) / (len(ticks) - 1)
            for height, value in ticks:
                expected = first + (last - first) * (height - low) / (high - low)
                # A pixel of eighteen.
                assert abs(value - expected) < 0.1 * abs(step), (name, ticks)
            checked += 1
        assert checked >= 3


def test_an_axis_has_the_digits_of_its_step(points):
    page, _ = points
    labels = "list => import(new URL('axes.js', location)).then(axes => axes.labels(list))"
    for list_, words in [
        ([5, 2.5, 0, -2.5], ["5.0", "2.5", "0.0", "-2.5"]),
        ([0, 0.25, 0.5], ["0.00", "0.25", "0.50"]),
        ([0.1, 0.2, 0.30000000000000004], ["0.1", "0.2", "0.3"]),
        ([1000, 1500, 2000], ["1000", "1500", "2000"]),
        ([0, 2.5e-5, 5e-5], ["0", "2.5e-5", "5.0e-5"]),
        ([0, 250000, 500000], ["0", "2.5e+5", "5.0e+5"]),
        ([7.5], ["7.5"]),
        ([0], ["0"]),
        ([1, None, 2], ["1", None, "2"]),
    ]:
        assert page.evaluate(labels, list_) == words


@pytest.mark.parametrize("design", [POINTS, ARMS], ids=lambda path: path.stem)
def test_a_count_is_told_in_whole_numbers_and_drawn_in_steps(browser, tmp_path, design):
    with opened(browser, tmp_path, design, script=WATCH) as (page, _):
        page.wait_for_timeout(300)
        [(words, lines)] = [(words, lines) for name, words, lines in charts(page) if name == "Tooth pairs in contact"]
        assert upright(words)
        assert all("." not in word["words"] for word in words if word["side"] == "right")
        chart = page.locator("figure", has_text="Tooth pairs in contact")
        assert chart.locator("output").inner_text().isdigit()
        runs = [(a, b) for line in lines for a, b in pairwise(line)]
        assert len(runs) > 50
        assert all(a[0] == b[0] or a[1] == b[1] for a, b in runs)


def test_a_line_does_not_keep_to_whole_pixels(browser, tmp_path):
    with opened(browser, tmp_path, POINTS, script=WATCH) as (page, _):
        page.wait_for_timeout(300)
        for name, _, lines in charts(page):
            if name != "Tooth pairs in contact":
                heights = {y for line in lines for _, y in line}
                assert any(y % 1 for y in heights) or len(heights) == 1, name


def readouts(page):
    """What every chart reads."""
    return page.locator("#charts output").all_inner_texts()


def over(page, name):
    """The place of a chart's lines on the screen."""
    lines = page.locator("figure.chart", has=page.get_by_text(name, exact=True)).locator(".u-over")
    # The picture of a narrow window stays above.
    lines.evaluate("lines => lines.scrollIntoView({ block: 'end' })")
    return lines.bounding_box()


def test_a_pointer_over_one_chart_reads_them_all(points):
    page, _ = points
    before = readouts(page)
    box = over(page, "Ratio slope")
    page.mouse.move(box["x"] + 0.6 * box["width"], box["y"] + box["height"] / 2)
    expect(page.locator("#charts.hovered")).to_be_visible()
    told = page.locator("#charts .pointed span").all_inner_texts()
    assert len(told) == page.locator("#charts .chart").count()
    assert len(set(told)) == 1
    assert float(told[0].removesuffix("°")) == pytest.approx(216, abs=1)
    hovered = readouts(page)
    assert sum(a != b for a, b in zip(hovered, before, strict=True)) > 8
    expect(page.locator("#angle")).to_have_text("0.0°")
    # With the machine led there, they read what they did.
    page.mouse.down()
    page.mouse.up()
    expect(page.locator("#angle")).to_have_text(told[0])
    page.mouse.move(2, 2)
    expect(page.locator("#charts.hovered")).to_have_count(0)
    assert readouts(page) == hovered


def test_a_pointer_at_the_edge_reads_the_end_of_the_cycle(points):
    page, _ = points
    box = over(page, "Ratio slope")
    for share, least, greatest in [(0, 0, 1.5), (1, 358.5, 360)]:
        page.mouse.move(box["x"] + share * (box["width"] - 0.5) + 0.2, box["y"] + 20)
        page.wait_for_timeout(100)
        [angle] = set(page.locator("#charts .pointed span").all_inner_texts())
        # Within a pixel of the end, and not beyond it.
        assert least <= float(angle.removesuffix("°")) <= greatest


def curves(design):
    """Curves of a design by their charts, as its report has them."""
    out = design.with_suffix(".html")
    centrode("report", design, "-o", out, check=False)
    text = re.search(r'id="snapshot">(.*?)</script>', out.read_text(), re.DOTALL)[1]
    found = {}
    for curve in curves_of(json.loads(text)):
        found.setdefault(curve["chart"], []).append(curve)
    return found


def taken(page, folder, name, kind):
    """A chart as a file."""
    with page.expect_download() as download:
        page.get_by_role("button", name=f"{name} as {kind}", exact=True).click()
    path = folder / download.value.suggested_filename
    download.value.save_as(path)
    return path


def table(path):
    """Head and columns of a CSV file; a gap is none."""
    head, *rows = csv.reader(path.read_text().splitlines())
    return head, [[float(cell) if cell else None for cell in column] for column in zip(*rows, strict=True)]


@pytest.mark.parametrize("design", [POINTS, ARMS], ids=lambda path: path.stem)
def test_the_csv_of_a_chart_holds_every_point_of_its_lines(browser, tmp_path, design):
    copy = tmp_path / design.name
    copy.write_text(design.read_text())
    expected = curves(copy)
    with studio(copy) as running:
        # After ten downloads a browser asks its user.
        for some in (list(expected)[:8], list(expected)[8:]):
            with shown(browser, running.url) as page:
                assert page.locator("#charts .chart").count() == len(expected)
                for name in some:
                    same_numbers(taken(page, tmp_path, name, "CSV"), name, expected[name])


def same_numbers(path, name, own):
    """Holds the CSV file of a chart against its curves."""
    words = re.sub("[^a-z0-9]+", "-", name.lower())
    assert path.name.endswith(f"-{words}.csv")
    head, (inputs, *values) = table(path)
    unit = own[0]["unit"].replace("°", "deg")
    assert head == ["input deg", *(f"{curve['name'] or name} {unit}".strip() for curve in own)]
    assert inputs == pytest.approx([57.29577951308232 * x for x in own[0]["input"]], abs=1e-8)
    for column, curve in zip(values, own, strict=True):
        assert [x is None for x in column] == [x is None for x in curve["value"]]
        known = [(x, y) for x, y in zip(column, curve["value"], strict=True) if y is not None]
        assert [x for x, _ in known] == pytest.approx([y for _, y in known], rel=1e-11)


WAY = re.compile(r"([MLHV])(-?[\d.]+)(?: (-?[\d.]+))?")


@pytest.mark.parametrize("name", ["Pressure angle", "Tooth pairs in contact", "Ratio"])
def test_the_svg_of_a_chart_has_its_lines_at_their_ticks(points, tmp_path, name):
    page, _ = points
    root = ElementTree.parse(taken(page, tmp_path, name, "SVG")).getroot()
    space = "{http://www.w3.org/2000/svg}"
    words = [(text.attrib, text.text) for text in root.iter(f"{space}text")]
    across = [(float(a["x"]), float(w.removesuffix("°"))) for a, w in words if w.endswith("°") and a.get("y") == "298"]
    up = [(float(a["y"]) - 4, float(w)) for a, w in words if a.get("text-anchor") == "end" and a["x"] == "56"]
    assert len(across) >= 4
    assert len(up) >= 2

    def read(ticks, place):
        (p, a), (q, b) = ticks[0], ticks[-1]
        return a + (b - a) * (place - p) / (q - p)

    _, (inputs, *values) = table(taken(page, tmp_path, name, "CSV"))
    lines = [path for path in root.iter(f"{space}path") if "data-line" in path.attrib]
    assert len(lines) == len(values)
    for line, column in zip(lines, values, strict=True):
        x = y = None
        drawn = []
        steps = WAY.findall(line.attrib["d"])
        for word, first, second in steps:
            if word in "ML":
                x, y = float(first), float(second)
            elif word == "H":
                x = float(first)
                continue
            else:
                y = float(first)
            drawn.append((read(across, x), read(up, y)))
        assert {word for word, _, _ in steps} <= (set("MHV") if name == "Tooth pairs in contact" else set("ML"))
        reach = max(column) - min(column)
        assert [x for x, _ in drawn] == pytest.approx(inputs, abs=0.05)
        assert [y for _, y in drawn] == pytest.approx(column, abs=5e-3 * reach)


def test_a_pinned_design_is_in_the_files_too(points, tmp_path):
    page, _ = points
    page.locator("#pin").click()
    field(page, "pitch.radius-3").fill("48.5")
    field(page, "pitch.radius-3").press("Enter")
    expect(page.locator("#file")).to_contain_text("not saved")
    settled(page)
    head, (_, now, before) = table(taken(page, tmp_path, "Ratio", "CSV"))
    assert head == ["input deg", "Ratio", "pinned Ratio"]
    assert now != before
    lines = ElementTree.parse(taken(page, tmp_path, "Ratio", "SVG")).getroot().iter("{http://www.w3.org/2000/svg}path")
    assert [line.attrib["data-line"] for line in lines if "data-line" in line.attrib] == ["Ratio", "pinned Ratio"]


def test_a_report_has_the_charts_as_files(browser, tmp_path):
    out = tmp_path / "pair.html"
    centrode("report", POINTS, "-o", out, check=False)
    with shown(browser, out.as_uri(), offline=True) as page:
        button = page.get_by_role("button", name="Ratio as CSV", exact=True)
        with page.expect_download() as download:
            button.focus()
            page.keyboard.press("Enter")
        download.value.save_as(tmp_path / "ratio.csv")
        head, columns = table(tmp_path / "ratio.csv")
        assert head == ["input deg", "Ratio"]
        assert columns[0][-1] == pytest.approx(360)
        box = over(page, "Ratio slope")
        page.mouse.move(box["x"] + box["width"] / 2, box["y"] + 20)
        expect(page.locator("#charts .pointed span").first).to_have_text(re.compile(r"^1(79|80)\.\d°$"))


@pytest.mark.parametrize(("width", "scheme"), looks(1440, 1024, 390))
def test_charts_are_read_by_everybody(browser, tmp_path, width, scheme):
    with opened(browser, tmp_path, POINTS, color_scheme=scheme) as (page, _):
        page.set_viewport_size({"width": width, "height": 900})
        if width < 1060:
            page.get_by_role("tab", name="Curves").click()
        box = over(page, "Ratio slope")
        page.mouse.move(box["x"] + box["width"] / 2, box["y"] + 20)
        expect(page.locator("#charts.hovered")).to_be_visible()
        found = Axe().run(page).response["violations"]
        assert not [(rule["id"], [node["target"] for node in rule["nodes"]]) for rule in found]
        assert page.evaluate("document.documentElement.scrollWidth") <= width
