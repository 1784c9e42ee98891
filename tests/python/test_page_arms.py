"""Charts of every arm's tip on the page of the three-arm mechanism: place and velocity, by components."""

import math

from page import ARMS, opened
from playwright.sync_api import expect
from studio import studio

CHARTS = ["X of the tips", "Y of the tips", "Velocity of the tips, x", "Velocity of the tips, y"]


def test_arms_follow_each_other_and_velocity_is_the_slope_of_place():
    with studio(ARMS) as running:
        ask = {"text": ARMS.read_text(), "edits": [], "depth": "checks"}
        status, found = running.json("POST", "solve", ask)
        assert status == 200
    curves = {name: [one for one in found["curves"] if one["chart"] == name] for name in CHARTS}
    assert all([one["name"] for one in list_] == ["arm 1", "arm 2", "arm 3"] for list_ in curves.values())
    for list_ in curves.values():
        size = max(map(abs, list_[0]["value"]))
        for i, arm in enumerate(list_):
            # Chains repeat the first one, a third of a turn later each: samples are degrees.
            values = [arm["value"][(at + 120 * i) % 360] for at in range(360)]
            assert max(abs(a - b) for a, b in zip(values, list_[0]["value"], strict=False)) < 1e-9 * size
    slopes, speeds = [], []
    for place, velocity in zip(CHARTS[:2], CHARTS[2:], strict=True):
        value = curves[place][0]["value"]
        slopes += [(value[at + 1] - value[at - 1]) / 2 for at in range(1, 360)]
        speeds += curves[velocity][0]["value"][1:360]
    # The carrier turns evenly: one factor leads from all slopes to all speeds.
    factor = sum(a * b for a, b in zip(slopes, speeds, strict=True)) / sum(a * a for a in slopes)
    worst = max(abs(factor * a - b) for a, b in zip(slopes, speeds, strict=True))
    assert worst < 0.02 * max(map(abs, speeds))
    # The figure of the first arm's speed is that of both components.
    whole = next(one for one in found["curves"] if one["chart"] == "Speed of the tip")["value"]
    parts = zip(curves[CHARTS[2]][0]["value"], curves[CHARTS[3]][0]["value"], strict=True)
    assert max(abs(math.hypot(*pair) - speed) for pair, speed in zip(parts, whole, strict=True)) < 1e-6 * max(whole)


def test_the_page_charts_every_arm(browser, tmp_path):
    with opened(browser, tmp_path, ARMS) as (page, _):
        for name in CHARTS:
            chart = page.locator("#charts .chart").filter(has=page.get_by_text(name, exact=True))
            expect(chart.locator(".series output")).to_have_count(3)
            assert chart.locator(".series").first.text_content().startswith("arm 1 ")
