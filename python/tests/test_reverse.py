"""A machine made from a path: bars by closed forms, the machine held against the path itself."""

import threading
import time

import centrode as ct
import numpy as np
import pytest

DRAWN = np.array(
    [
        (0, 0),
        (60, 70),
        (150, 150),
        (230, 215),
        (262, 262),
        (235, 300),
        (170, 330),
        (100, 330),
        (40, 300),
        (-5, 250),
        (-30, 190),
        (-38, 130),
        (-30, 60),
    ],
    float,
)


def test_bars_are_half_the_sum_and_half_the_difference_of_the_extreme_distances():
    # An ellipse seen from a place on its long axis, outside: its distances are greatest and least at the vertices.
    t = np.linspace(0, 2 * np.pi, 400, endpoint=False)
    path = np.column_stack([50 * np.cos(t), 45 * np.sin(t)])
    made = ct.reverse(path, (120, 0))
    assert made.carrier == pytest.approx(50, abs=1e-7)
    assert made.arm == pytest.approx(120, abs=1e-7)
    assert made.shaft_distance == pytest.approx(70, abs=1e-7)


def test_the_law_grows_by_a_turn_within_its_ratios():
    made = ct.reverse(DRAWN, (260, 160), bend_deg=40)
    psi = np.linspace(0, 2 * np.pi, 2001)
    law = made.law(psi)
    assert law[-1] - law[0] == pytest.approx(2 * np.pi, abs=1e-12)
    slope = np.diff(law) / np.diff(psi)
    least, greatest = made.ratios
    assert least - 1e-6 <= slope.min() < least + 1e-3
    assert greatest - 1e-3 < slope.max() <= greatest + 1e-6


def test_the_map_has_figures_where_an_axis_is_possible_and_a_reason_elsewhere():
    made = ct.reverse(DRAWN, (260, 160))
    axes = made.axes
    assert axes.possible.any()
    assert not axes.possible.all()
    assert np.isfinite(axes.carrier[axes.possible]).all()
    assert np.isnan(axes.carrier[~axes.possible]).all()
    fault = np.array(axes.fault, dtype=object)
    assert all(f is None for f in fault[axes.possible])
    assert set(fault[~axes.possible]) <= {"extremes", "circle", "on-axis", "winding", "carrier-turns-back", "arm-stops"}
    # The axis chosen is milder than any of the grid.
    best = ct.reverse(DRAWN).ratios
    grid = np.maximum(-np.log(axes.least_ratio), np.log(axes.greatest_ratio))
    assert max(-np.log(best[0]), np.log(best[1])) <= np.nanmin(grid)


@pytest.mark.parametrize(
    ("path", "options", "error", "key"),
    [
        (DRAWN[:3], {}, ct.DesignError, "path"),
        (DRAWN.ravel(), {}, ct.DesignError, "path"),
        (np.where(DRAWN == 70, np.nan, DRAWN), {}, ct.DesignError, "path"),
        (DRAWN, {"axis": (60, 200)}, ct.MechanismError, "axis"),
        (DRAWN, {"axis": (float("nan"), 0)}, ct.MechanismError, "axis"),
        (DRAWN, {"split": "halves"}, ct.DesignError, "split"),
        (DRAWN, {"axis": (260, 160), "split": "one-pair", "bend_deg": -60}, ct.MechanismError, "split"),
        (DRAWN, {"axis": (260, 160), "bend_deg": 180}, ct.MechanismError, "split"),
        (DRAWN, {"arms": 0}, ct.DesignError, "arms"),
    ],
)
def test_what_cannot_be_made_is_an_error_of_its_key(path, options, error, key):
    with pytest.raises(error) as raised:
        ct.reverse(path, **options)
    assert raised.value.key == key


def test_other_threads_run_meanwhile():
    turns = []
    done = threading.Event()

    def count():
        while not done.is_set():
            turns.append(time.perf_counter())
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    try:
        start = time.perf_counter()
        ct.reverse(DRAWN)
        end = time.perf_counter()
    finally:
        done.set()
        thread.join()
    inside = [start, *(t for t in turns if start < t < end), end]
    assert max(np.diff(inside)) < 0.5 * (end - start)
