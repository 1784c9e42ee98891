"""Gear pairs from Python, against the published figures."""

import math
from pathlib import Path

import centrode as ct
import numpy as np
import pytest
import tomllib

FIGURES = Path(__file__).resolve().parents[2] / "tests" / "published" / "data"


@pytest.fixture(scope="module")
def case():
    return tomllib.loads((FIGURES / "elliptic_pair.toml").read_text())["case"][0]


@pytest.fixture(scope="module")
def pair(case):
    pitch = ct.pitch.ellipse(eccentricity=case["eccentricity"], module=case["module"], tooth_count=case["tooth_count"])
    return ct.GearPair(pitch, phase="tooth")


def test_elliptic_pair_has_the_published_figures(pair, case):
    assert pair.center_distance == pytest.approx(case["center_distance"], rel=1e-13)
    assert pair.driver.pitch_length == pytest.approx(case["perimeter"], rel=1e-13)
    assert pair.module == pytest.approx(case["module"], rel=1e-14)
    assert (pair.mean_ratio, pair.congruent) == ((1, 1), True)
    phi, driven = np.array(case["driven_angle"]).T
    np.testing.assert_allclose(pair.driven_angle(phi), driven, atol=1e-12)


def test_ratio_takes_numbers_and_arrays_of_any_shape(pair):
    assert float(pair.ratio(0.0)) == pytest.approx(math.sqrt(3), rel=1e-12)
    assert float(pair.ratio(math.pi)) == pytest.approx(1 / math.sqrt(3), rel=1e-12)
    grid = np.linspace(0, 6, 12, dtype=np.float32).reshape(3, 4)
    assert pair.ratio(grid).shape == (3, 4)
    step = 1e-6
    slope = (pair.ratio(grid + step) - pair.ratio(grid - step)) / (2 * step)
    np.testing.assert_allclose(pair.ratio_slope(grid), slope, atol=0.3)
    fine = np.linspace(0, 6, 100)
    slope = (pair.ratio(fine + step) - pair.ratio(fine - step)) / (2 * step)
    np.testing.assert_allclose(pair.ratio_slope(fine), slope, atol=1e-8)


def test_outline_is_a_counter_clockwise_ring_that_closes_in_on_the_exact_area(pair):
    before = math.inf
    for tolerance in (1e-1, 1e-2, 1e-3):
        x, y = pair.driver.outline(tolerance=tolerance).T
        area = 0.5 * np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))
        error = abs(area - pair.driver.area)
        assert area > 0
        assert error < 300 * tolerance
        assert error < before
        before = error


def test_pairs_of_other_ratios_tools_and_descriptions():
    pitch = ct.pitch.polar("1 + 0.08*cos(2*phi)", module=1.5, tooth_count=24)
    pair = ct.GearPair(pitch, mean_ratio=(2, 1), backlash=0.05)
    assert (pair.driver.tooth_count, pair.driven.tooth_count) == (24, 48)
    assert float(pair.driven_angle(2 * math.pi)) == pytest.approx(math.pi, rel=1e-13)

    law = ct.pitch.from_transmission("phi - 0.08*sin(2*phi)", module=1.5, tooth_count=24)
    phi = np.linspace(0, 2 * math.pi, 30)
    rack = ct.Rack(pressure_angle=math.radians(25), tip_radius_coefficient=0.3)
    driven = ct.GearPair(law, tool=rack).driven_angle(phi)
    np.testing.assert_allclose(driven, phi - 0.08 * np.sin(2 * phi), atol=1e-11)

    shaped = ct.GearPair(ct.pitch.circle(module=2, tooth_count=30), tool=ct.Shaper(tooth_count=20))
    assert shaped.driver.tooth_count == 30


@pytest.mark.parametrize(
    ("keywords", "kind", "text"),
    [
        ({"mean_ratio": (2, 4)}, ct.DesignError, "mean_ratio"),
        ({"mean_ratio": (1, 5)}, ct.DesignError, "teeth"),
        ({"center_distance": 10.0}, ct.GearPairError, "center_distance"),
        ({"backlash": math.nan}, ct.DesignError, "backlash"),
        ({"phase": "sideways"}, ct.DesignError, "phase"),
        ({"addendum": "half"}, ct.DesignError, "addendum"),
        ({"tool": ct.Rack(pressure_angle=math.radians(80))}, ct.DesignError, "pressure_angle"),
    ],
)
def test_what_cannot_exist_names_the_key(keywords, kind, text):
    with pytest.raises(kind, match=text):
        ct.GearPair(ct.pitch.ellipse(eccentricity=0.2, module=2, tooth_count=23), **keywords)


def test_a_tolerance_must_be_positive(pair):
    with pytest.raises(ct.DesignError, match="tolerance"):
        pair.driver.outline(tolerance=0.0)
