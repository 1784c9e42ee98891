"""Gear pairs from Python, against the published figures."""

import math

import centrode as ct
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st


def test_elliptic_pair_has_the_published_figures(pair, case):
    assert pair.center_distance == pytest.approx(case["center_distance"], rel=1e-13)
    assert round(pair.center_distance, 6) == 52.709221
    assert pair.driver.pitch_length == pytest.approx(case["perimeter"], rel=1e-13)
    assert pair.module == pytest.approx(case["module"], rel=1e-14)
    assert (pair.mean_ratio, pair.congruent) == ((1, 1), True)
    phi, driven = np.array(case["driven_angle"]).T
    np.testing.assert_allclose(pair.driven_angle(phi), driven, atol=1e-12)
    ratio = pair.ratio(np.linspace(0, 2 * math.pi, 1001))
    assert (round(ratio.min(), 6), round(ratio.max(), 6)) == (0.577350, 1.732051)


def test_a_number_gives_a_number_and_an_array_its_own_shape(pair):
    for phi in (0, 0.0, np.float32(0), np.array(0.0)):
        assert type(pair.ratio(phi)) is float
        assert pair.ratio(phi) == pytest.approx(math.sqrt(3), rel=1e-12)
    grid = np.linspace(0, 6, 12, dtype=np.float32).reshape(3, 4)
    for method in (pair.ratio, pair.driven_angle, pair.ratio_slope):
        assert method(grid).shape == (3, 4)
        np.testing.assert_array_equal(method(grid), method(grid.astype(float).tolist()))
        np.testing.assert_array_equal(method(grid[::2, ::-3]), method(grid)[::2, ::-3])
        assert method([]).shape == (0,)
    with pytest.raises(ct.DesignError, match="must be a finite number, not NaN"):
        pair.ratio(math.nan)


def test_the_ratio_and_its_slope_are_derivatives(pair):
    phi, step = np.linspace(0, 6, 100), 1e-6
    ratio = (pair.driven_angle(phi + step) - pair.driven_angle(phi - step)) / (2 * step)
    np.testing.assert_allclose(pair.ratio(phi), ratio, atol=1e-8)
    slope = (pair.ratio(phi + step) - pair.ratio(phi - step)) / (2 * step)
    np.testing.assert_allclose(pair.ratio_slope(phi), slope, atol=1e-8)


def test_pairs_of_other_ratios_tools_and_descriptions():
    pitch = ct.pitch.polar("1 + 0.08*cos(2*phi)", module=1.5, tooth_count=24)
    pair = ct.GearPair(pitch, mean_ratio=[2, 1], backlash=0.05)
    assert (pair.driver.tooth_count, pair.driven.tooth_count) == (24, 48)
    assert pair.driven_angle(2 * math.pi) == pytest.approx(math.pi, rel=1e-13)
    assert pair.cycle == pytest.approx(4 * math.pi)

    law = ct.pitch.from_transmission("phi - 0.08*sin(2*phi)", module=1.5, tooth_count=24)
    phi = np.linspace(0, 2 * math.pi, 30)
    rack = ct.Rack(pressure_angle=math.radians(25), tip_radius_coefficient=0.3)
    pair = ct.GearPair(law, tool=rack)
    np.testing.assert_allclose(pair.driven_angle(phi), phi - 0.08 * np.sin(2 * phi), atol=1e-11)
    assert pair.tool == rack

    cutter = ct.Shaper(tooth_count=np.int64(20))
    shaped = ct.GearPair(ct.pitch.circle(module=2, tooth_count=30), tool=cutter)
    assert (shaped.driver.tooth_count, shaped.tool) == (30, cutter)


@given(
    amplitude=st.floats(-0.2, 0.2), ratio=st.sampled_from([(1, 1), (2, 1), (1, 2), (3, 2)]), teeth=st.integers(9, 30)
)
@settings(max_examples=25, derandomize=True, deadline=None)
def test_the_conjugate_of_the_conjugate_is_the_original(amplitude, ratio, teeth):
    pitch = ct.pitch.polar(f"1 + ({amplitude!r})*cos(2*phi)", module=2, tooth_count=2 * teeth)
    pair = ct.GearPair(pitch, mean_ratio=ratio)
    back = ct.GearPair(pair.conjugate(), mean_ratio=ratio[::-1])
    assert back.driven.tooth_count == 2 * teeth
    assert back.center_distance == pytest.approx(pair.center_distance, rel=1e-12)
    phi = np.linspace(0, 6, 20)
    np.testing.assert_allclose(back.driven_angle(pair.driven_angle(phi)), phi, atol=1e-10)
    np.testing.assert_allclose(back.conjugate().points([0.0]), pitch.points([0.0]), rtol=1e-10, atol=1e-12)


@pytest.mark.parametrize(
    ("keywords", "kind", "key"),
    [
        ({"mean_ratio": (2, 4)}, ct.DesignError, "mean_ratio"),
        ({"mean_ratio": (0, 1)}, ct.DesignError, "mean_ratio"),
        ({"mean_ratio": (-1, 1)}, ct.DesignError, "mean_ratio"),
        ({"mean_ratio": (1, 5)}, ct.DesignError, "pitch.tooth_count"),
        ({"tooth_count": 24}, ct.DesignError, "tooth_count"),
        ({"tooth_count": 1 << 80}, ct.DesignError, "tooth_count"),
        ({"center_distance": 10.0}, ct.GearPairError, "center_distance"),
        ({"backlash": math.nan}, ct.DesignError, "teeth.backlash"),
        ({"backlash": 0.1, "backlash_angle": 0.1}, ct.DesignError, "teeth.backlash_angle_deg"),
        ({"thickness_split": -1}, ct.DesignError, "teeth.thickness_split"),
        ({"phase": "sideways"}, ct.DesignError, "teeth.phase"),
        ({"addendum": "half"}, ct.DesignError, "teeth.addendum"),
        ({"name": "../pair"}, ct.DesignError, "name"),
        ({"driver": ct.Body(bore=60)}, ct.GearPairError, "driver.bore"),
    ],
)
def test_what_cannot_exist_names_the_key(keywords, kind, key):
    with pytest.raises(kind) as caught:
        ct.GearPair(ct.pitch.ellipse(eccentricity=0.2, module=2, tooth_count=23), **keywords)
    assert caught.value.key == key
    assert (caught.value.line, caught.value.column) == (None, None)
    assert isinstance(caught.value, ValueError)


@pytest.mark.parametrize(
    "keywords",
    [{"tool": 3}, {"phase": []}, {"mean_ratio": 2}, {"tooth_count": 2.5}, {"backlash": "much"}, {"colour": 1}],
)
def test_wrong_kinds_of_argument_are_type_errors(keywords):
    with pytest.raises(TypeError):
        ct.GearPair(ct.pitch.circle(module=2, tooth_count=23), **keywords)


@pytest.mark.parametrize("phi", ["1", 1j, [1j], ["1"], [[1], [1, 2]], None, {}])
def test_angles_are_real_numbers(pair, phi):
    with pytest.raises((TypeError, ValueError)):
        pair.ratio(phi)


def test_repr_names_what_matters(pair):
    assert "ellipse" in repr(pair)
    assert "23:23 teeth" in repr(pair)
    assert repr(pair.driver).startswith("Gear(driver, 23 teeth")


def shifted(**keys):
    """Circular gears of the example of ISO 21771."""
    return ct.GearPair(ct.pitch.circle(module=3, tooth_count=12), mean_ratio=(2, 1), **keys)


def test_circular_gears_take_any_two_shifts_and_the_distance_follows():
    pair = shifted(driver_shift=0.6, driven_shift=0.36)
    assert (pair.driver.shift, pair.driven.shift) == (0.6, 0.36)
    assert pair.center_distance == pytest.approx(56.49987, abs=5e-6)
    assert math.degrees(pair.pressure_angle(1.0)) == pytest.approx(26.0886, abs=5e-5)
    assert pair.tip_shortening == pytest.approx(-0.12671, abs=5e-6)
    assert pair.check().values["contact_ratio_mean"] == pytest.approx(1.202, abs=5e-4)
    full = shifted(driver_shift=0.6, driven_shift=0.36, tip_shortening="none")
    assert [2 * gear.radii[1] for gear in (full.driver, full.driven)] == pytest.approx([45.6, 80.16], abs=1e-9)
    lower = shifted(tip_shortening=-0.1)
    assert lower.driver.radii[1] == pytest.approx(18 + 0.9 * 3, abs=1e-9)


def test_a_shift_follows_from_the_distance_and_its_mate():
    pair = shifted(driver_shift=0.6, center_distance=56.5)
    assert pair.driven.shift == pytest.approx(0.360056, abs=1e-6)
    assert ct.GearPair.from_toml(pair.to_toml()).driven.shift == pair.driven.shift


def test_shifts_are_opposite_unless_circular_gears_have_both():
    pitch = ct.pitch.ellipse(eccentricity=0.2, module=2, tooth_count=23)
    assert ct.GearPair(pitch, driven_shift=0.2).driver.shift == -0.2
    with pytest.raises(ct.GearPairError, match=r"driven\.shift = -0\.3"):
        ct.GearPair(pitch, driver_shift=0.3, driven_shift=0.2)
    with pytest.raises(ct.DesignError, match="clearance"):
        shifted(tip_shortening="some")


def test_each_gear_has_heights_and_a_tool_of_its_own(pair):
    pitch = ct.pitch.ellipse(eccentricity=0.25, module=2, tooth_count=24)
    plain = ct.GearPair(pitch, phase="tooth")
    shaper = ct.Shaper(tooth_count=20, tip_radius_coefficient=0.1)
    given = {"driver_addendum": 1.1, "driver_dedendum": 1.15, "driven_addendum": 0.9, "driven_tool": shaper}
    uneven = ct.GearPair(pitch, phase="tooth", **given)
    assert (uneven.driver.tool, uneven.driven.tool) == (ct.Rack(), shaper)
    tips = [[tooth.leading.tip_height for tooth in gear.teeth] for gear in (uneven.driver, uneven.driven)]
    np.testing.assert_allclose(tips, [[2.2] * 24, [1.8] * 24], atol=1e-9)
    assert uneven.driver.radii[0] > plain.driver.radii[0] + 0.15
    assert not uneven.congruent
    assert uneven.check().values["transmission_error_max"] < 1e-9
    with pytest.raises(ct.DesignError, match="both tools must have the same angle"):
        ct.GearPair(pitch, driven_tool=ct.Rack(pressure_angle=0.4))


def test_a_base_tangent_is_the_arc_of_the_base_circle_or_refused():
    pair = ct.GearPair(ct.pitch.circle(module=3, tooth_count=24), driver_shift=0.4, backlash=0.05)
    teeth, length = pair.driver.base_tangent()
    angle = math.radians(20)
    arc = math.pi * (teeth - 0.5) + 24 * (math.tan(angle) - angle) + 2 * 0.4 * math.tan(angle)
    assert teeth == 4
    assert abs(length - (3 * math.cos(angle) * arc - 0.025)) < 1e-12
    values = pair.check().values
    assert (values["driver_base_tangent_teeth"], values["driver_base_tangent"]) == (teeth, length)
    ellipse = ct.GearPair(ct.pitch.ellipse(eccentricity=0.2, module=2, tooth_count=23))
    with pytest.raises(ct.MechanismError, match="not a circle"):
        ellipse.driven.base_tangent()
    assert "driver_base_tangent" not in ellipse.check().values
