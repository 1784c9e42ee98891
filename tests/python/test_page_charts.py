"""The charts of the design page: what is written at their axes, and how their lines run."""

from itertools import pairwise

import pytest
from conftest import ROOT
from page import ARMS, BOX, FEEDER, POINTS, opened

CIRCLE = ROOT / "tests" / "designs" / "circular-pair.toml"

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
        [(words, lines)] = [(words, lines) for name, words, lines in charts(page) if name == "Contacts at once"]
        assert upright(words)
        assert all("." not in word["words"] for word in words if word["side"] == "right")
        chart = page.locator("figure", has_text="Contacts at once")
        assert chart.locator("output").inner_text().isdigit()
        runs = [(a, b) for line in lines for a, b in pairwise(line)]
        assert len(runs) > 50
        assert all(a[0] == b[0] or a[1] == b[1] for a, b in runs)


def test_a_line_does_not_keep_to_whole_pixels(browser, tmp_path):
    with opened(browser, tmp_path, POINTS, script=WATCH) as (page, _):
        page.wait_for_timeout(300)
        for name, _, lines in charts(page):
            if name != "Contacts at once":
                heights = {y for line in lines for _, y in line}
                assert any(y % 1 for y in heights) or len(heights) == 1, name
