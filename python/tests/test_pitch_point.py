"""Curvature and pressure angle along both pitch curves."""

import centrode as ct
import numpy as np

K = 1 / (2 + 3**0.5)


def test_the_curvatures_of_the_2018_pair_are_those_of_one_ellipse():
    pair = ct.GearPair(ct.pitch.ellipse(eccentricity=K, module=2.25, tooth_count=23))
    phi = np.linspace(0, 2 * np.pi, 1001)
    driver, driven = pair.driver_curvature(phi), pair.driven_curvature(phi)
    assert np.isclose(1 / driver.max(), 24.46243, atol=1e-5)
    # Congruent curves: the driven gear shows the driver's far side.
    assert np.allclose(np.sort(driver)[[0, -1]], np.sort(driven)[[0, -1]])
    assert (driver > 0).all()
    assert (driven > 0).all()


def test_pressure_angles_differ_by_the_inclination_of_the_pitch_curve():
    pair = ct.GearPair(ct.pitch.ellipse(eccentricity=K, module=2.25, tooth_count=23))
    phi = np.linspace(0, 2 * np.pi, 101)
    # tan mu = r'/r of the focal ellipse.
    mu = np.arctan(-K * np.sin(phi) / (1 - K * np.cos(phi)))
    alpha = np.radians(20)
    assert np.allclose(pair.pressure_angle(phi), np.abs(alpha - mu), atol=1e-12)
    assert np.allclose(pair.reverse_pressure_angle(phi), np.abs(alpha + mu), atol=1e-12)
