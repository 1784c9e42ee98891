import centrode as ct
import numpy as np


def elliptic():
    return ct.GearPair(ct.pitch.ellipse(eccentricity=0.2679491924311227, module=2.25, tooth_count=23))


def test_every_pin_touches_both_flanks_and_nothing_else():
    shapely = __import__("shapely")
    pair = elliptic()
    for gear in (pair.driver, pair.driven):
        over = gear.over_pins()
        assert over.diameter == 3.75
        assert over.faults == (None,) * 23
        polygon = shapely.Polygon(gear.outline(tolerance=1e-6))
        for center, contacts in zip(over.center, over.contacts, strict=True):
            np.testing.assert_allclose(
                np.linalg.norm(contacts - center, axis=1), 0.5 * over.diameter, rtol=0, atol=1e-12
            )
            assert abs(polygon.distance(shapely.Point(center)) - 0.5 * over.diameter) < 2e-6


def test_measures_follow_from_the_centers():
    over = elliptic().driver.over_pins(diameter=4)
    np.testing.assert_allclose(over.radial, np.hypot(*over.center.T) + 2, rtol=0, atol=1e-12)
    apart = np.linalg.norm(over.center - over.center[over.partner], axis=1)
    np.testing.assert_allclose(over.across, apart + 4, rtol=0, atol=1e-12)


def test_a_space_that_cannot_be_measured_says_why():
    over = elliptic().driver.over_pins(diameter=0.5)
    assert all("too small" in fault for fault in over.faults)
    assert np.isnan(over.radial).all()
    assert np.isnan(over.center).all()
    assert (over.partner == -1).all()
    assert np.isnan(over.across).all()


def test_the_design_sets_the_pin():
    pair = ct.GearPair(ct.pitch.circle(module=2, tooth_count=20), pin_diameter=4)
    assert pair.driver.over_pins().diameter == 4
    assert "pin_diameter = 4.0" in pair.to_toml()
