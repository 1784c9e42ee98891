"""Pitch curves by formulas with bumps and steps far narrower than a tooth, next to sums of values at even places."""

import centrode as ct
import numpy as np
import pytest

MODULE, TEETH, PLACES = 2, 30, 1 << 17
FORMULAS = [
    "1 + 0.0001*exp(-700*(1 - cos(5*phi)))",
    "1 + 0.001*exp(-1500*(1 - cos(5*phi)))",
    "1 + 0.01*exp(-100*(1 - cos(3*phi - 1)))",
    "1 + 0.01*exp(-60*(1 - cos(9*phi - 1)))",
    "1 + 0.01*cos(11*phi - 1)**60",
    "1 + 0.01/(1 + 900*sin(4*phi)**2)",
    "1 + 0.002*tanh(300*sin(7*phi))",
    "1/(1 + 0.001*tanh(1000*cos(2*phi)))",
    "1 + 0.01/(1 + exp(300*(cos(4*phi - 1) - 0.99)))",
]


def series(values):
    """Coefficients of a Fourier series with their orders: what is smooth and repeats it tells to the last digit."""
    return np.fft.rfft(values), np.arange(PLACES // 2 + 1)


@pytest.mark.parametrize("formula", FORMULAS)
def test_lengths_angles_and_curvatures_are_those_of_the_formula(formula):
    pitch = ct.pitch.polar(formula, module=MODULE, tooth_count=TEETH)
    pair = ct.GearPair(pitch, mean_ratio=(1, 1), addendum="fitted", backlash=0.05)
    phi = np.arange(PLACES) * 2 * np.pi / PLACES
    names = {name: getattr(np, name) for name in ("sin", "cos", "exp", "tanh")}
    radius = eval(formula, {"phi": phi, **names})
    found, order = series(radius)
    slope, bend = (np.fft.irfft(found * (1j * order) ** k, PLACES) for k in (1, 2))

    length = 2 * np.pi * np.mean(np.hypot(radius, slope))
    scale = np.pi * MODULE * TEETH / length
    rolls = scale * radius / (pair.center_distance - scale * radius)
    found, order = series(rolls)
    swing = np.fft.irfft(np.r_[0, found[1:] / (1j * order[1:])], PLACES)
    driven = np.mean(rolls) * phi + swing - swing[0]
    some = slice(None, None, PLACES // 1024)
    np.testing.assert_allclose(pair.driven_angle(phi[some]), driven[some], rtol=0, atol=3e-14)
    np.testing.assert_allclose(np.mean(rolls), 1, rtol=1e-13)

    curvature = (radius**2 + 2 * slope**2 - radius * bend) / np.hypot(radius, slope) ** 3 / scale
    figures = pair.check().values
    least, greatest = figures["driver_curvature_min"], figures["driver_curvature_max"]
    # The second derivative of a series has the rounding of its highest orders; an extreme lies between two places.
    size = np.abs(curvature).max()
    assert -1e-6 * size <= curvature.min() - least <= 1e-2 * size
    assert -1e-6 * size <= greatest - curvature.max() <= 1e-2 * size
