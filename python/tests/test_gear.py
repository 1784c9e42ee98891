"""Gears from Python: contours, samples, teeth, solids."""

import math

import centrode as ct
import numpy as np
import pytest


def area_of(points):
    x, y = points.T
    return 0.5 * np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))


def test_the_outline_is_a_counter_clockwise_ring_that_closes_in_on_the_exact_area(pair):
    before = math.inf
    for tolerance in (1e-1, 1e-2, 1e-3, 1e-5):
        points = pair.driver.outline(tolerance)
        assert np.any(points[0] != points[-1])
        error = abs(area_of(points) - pair.driver.area)
        assert error < min(300 * tolerance, before)
        before = error
    np.testing.assert_array_equal(pair.driver.outline(), pair.driver.outline(tolerance=1e-3))


def test_outlines_meet_the_independent_flank_points(pair, case):
    outline = pair.driver.outline(tolerance=1e-6)
    starts, ends = outline, np.roll(outline, -1, axis=0)
    along = ends - starts
    for point in np.array(case["flank"])[:, 5:7]:
        share = np.sum((point - starts) * along, axis=1) / np.sum(along**2, axis=1)
        foot = starts + np.clip(share, 0, 1)[:, None] * along
        assert np.hypot(*(foot - point).T).min() < 2e-6


def test_the_pitch_curve_is_the_ellipse(pair, case):
    x, y = pair.driver.pitch_curve(tolerance=1e-4).T
    k, a = case["eccentricity"], case["semi_major_axis"]
    radius, angle = np.hypot(x, y), np.arctan2(y, x)
    np.testing.assert_allclose(radius, a * (1 - k * k) / (1 - k * np.cos(angle)), rtol=1e-9)


def test_samples_carry_normal_curvature_role_and_tooth():
    gear = ct.GearPair(ct.pitch.circle(module=2, tooth_count=30)).driver
    samples = gear.samples(tolerance=1e-3)
    np.testing.assert_array_equal(samples["points"], gear.outline(tolerance=1e-3))
    np.testing.assert_allclose(np.hypot(*samples["normals"].T), 1, rtol=1e-12)
    assert {str(role) for role in samples["role"]} == {"tip", "flank", "fillet", "root"}
    assert set(samples["tooth"]) == set(range(30))
    tips = samples["role"] == "tip"
    np.testing.assert_allclose(np.hypot(*samples["points"][tips].T), 32, rtol=1e-9)
    np.testing.assert_allclose(samples["curvature"][tips], 1 / 32, rtol=1e-6)
    np.testing.assert_allclose(samples["points"][tips] / 32, samples["normals"][tips], atol=1e-6)


def test_teeth_are_records(pair):
    teeth = pair.driver.teeth
    assert [tooth.number for tooth in teeth] == list(range(23))
    assert all(not tooth.cut_through and tooth.leading.undercut == 0 for tooth in teeth)
    first = teeth[0].leading
    assert first.tip_height == pytest.approx(2.25)
    assert first.crossing == pytest.approx(-math.pi * 2.25 / 4, rel=1e-12)
    assert first.active[0] < first.crossing < first.active[1]


def test_undercut_shows_on_the_teeth():
    gear = ct.GearPair(ct.pitch.circle(module=2, tooth_count=12)).driver
    assert all(tooth.leading.undercut > 0 for tooth in gear.teeth)


def test_the_mesh_is_closed_and_has_the_solid_s_volume():
    body = ct.Body(width=8, bore=12, keyway=ct.Keyway(width=4, depth=1.8))
    gear = ct.GearPair(ct.pitch.ellipse(eccentricity=0.2, module=2, tooth_count=23), driver=body).driver
    assert gear.body == body
    vertices, faces = gear.mesh(tolerance=1e-3)
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    there = {tuple(edge) for edge in edges.tolist()}
    assert len(there) == len(edges)
    assert all((b, a) in there for a, b in there)
    corners = vertices[faces]
    volume = np.sum(np.linalg.det(corners)) / 6
    exact = 8 * (area_of(gear.outline(1e-5)) - area_of(gear.bore(1e-5)))
    assert volume == pytest.approx(exact, rel=1e-4)
    wide, _ = gear.mesh(width=20)
    assert np.ptp(wide[:, 2]) == 20


def test_a_gear_without_a_bore_has_none(pair):
    assert pair.driver.bore() is None


@pytest.mark.parametrize("tolerance", [0.0, -1, 1e-14, math.nan, math.inf])
@pytest.mark.parametrize("method", ["outline", "pitch_curve", "bore", "samples", "mesh"])
def test_a_tolerance_must_be_a_positive_length_no_finer_than_the_outline(pair, method, tolerance):
    with pytest.raises(ct.DesignError, match="tolerance") as caught:
        getattr(pair.driver, method)(tolerance)
    assert caught.value.key == "tolerance"


@pytest.mark.parametrize("width", [0, -1, math.nan])
def test_a_solid_must_have_a_width(pair, width):
    with pytest.raises(ct.DesignError, match="above its bottom"):
        pair.driver.mesh(width=width)


def test_gears_are_equal_where_their_pairs_are():
    pitch = ct.pitch.ellipse(eccentricity=0.25, module=2, tooth_count=23)
    pair = ct.GearPair(pitch)
    assert pair.driver == pair.driver == ct.GearPair(pitch).driver
    assert pair.driver != pair.driven
    assert pair.driver != ct.GearPair(pitch, backlash=0.1).driver


def test_what_is_free_is_chosen_so_that_the_flanks_carry_the_motion():
    law = ct.pitch.from_ratio("1 + 0.45*cos(2*phi)", module=2, tooth_count=24)
    written = ct.GearPair(law, addendum="fitted")
    chosen = ct.GearPair(law, fit=["addendum", "pressure_angle"])
    errors = [pair.check().values["transmission_error_max"] for pair in (written, chosen)]
    assert errors[0] > 1e-6
    assert errors[1] < 1e-9
    assert chosen.addendum == "fitted"
    assert chosen.fit == ["addendum", "pressure_angle"]
    assert chosen.tool.pressure_angle != written.tool.pressure_angle
    assert chosen.check().values["tool_pressure_angle"] == chosen.tool.pressure_angle
    # What is loaded again chooses again; what is settled has nothing to choose, and the same gears.
    again = ct.GearPair.from_toml(chosen.to_toml())
    assert again.tool == chosen.tool
    assert again.fit == chosen.fit
    settled = chosen.settled()
    assert settled.fit == []
    assert np.array_equal(settled.driver.outline(), chosen.driver.outline())
    with pytest.raises(ct.DesignError, match=r"teeth\.fit"):
        ct.GearPair(law, fit=["backlash"])
