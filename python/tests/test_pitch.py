"""Pitch curves from Python: the words of the design file, radians, array-likes."""

import math

import centrode as ct
import numpy as np
import pytest

RADIUS = [21, 28, 50, 49, 58, 47, 18, 12, 28, 60, 48, 24]
ANGLE = np.radians([20, 45, 76, 105, 132, 165, 195, 225, 255, 285, 316, 345])


def test_ellipse_has_the_published_radii():
    pitch = ct.pitch.ellipse(eccentricity=1 / (2 + math.sqrt(3)), module=2.25, tooth_count=23)
    radius = np.hypot(*pitch.points([0.0, math.pi]).T)
    np.testing.assert_allclose(radius, [33.416306947848576, 19.292913811663537], rtol=1e-13)
    assert (pitch.module, pitch.tooth_count, pitch.period) == (2.25, 23, 2 * math.pi)
    assert "ellipse" in repr(pitch)


@pytest.mark.parametrize("make", [list, np.array, tuple, lambda r: np.float32(r), lambda r: np.repeat(r, 2)[::2]])
def test_lists_and_arrays_of_any_kind_give_the_same_curve(make):
    pitch = ct.pitch.bspline(radius=make(RADIUS), angle=ANGLE, degree=2, plane="polar")
    same = ct.pitch.bspline(radius=RADIUS, angle=list(ANGLE), degree=2)
    t = np.linspace(0, pitch.period, 50)
    np.testing.assert_array_equal(pitch.points(t), same.points(t))
    assert pitch.module is None


def test_points_close_after_a_period_and_may_be_none():
    pitch = ct.pitch.lobed_ellipse(lobes=3, eccentricity=0.1, module=2, tooth_count=30)
    ends = pitch.points([0, pitch.period])
    np.testing.assert_allclose(ends[0], ends[1], atol=1e-12)
    assert pitch.points([]).shape == (0, 2)


@pytest.mark.parametrize(
    ("make", "key"),
    [
        (lambda: ct.pitch.ellipse(eccentricity=1.0, module=1, tooth_count=20), "eccentricity"),
        (lambda: ct.pitch.ellipse(eccentricity=math.nan, module=1, tooth_count=20), "eccentricity"),
        (lambda: ct.pitch.circle(module=0, tooth_count=20), "module"),
        (lambda: ct.pitch.circle(module=1, tooth_count=2), "tooth_count"),
        (lambda: ct.pitch.circle(), "size"),
        (lambda: ct.pitch.bspline(radius=[1, 2], angle=[0, 1, 2]), "radius"),
        (lambda: ct.pitch.bspline(x=[1, 2, 3], y=[1, 2, 3], plane="sphere"), "plane"),
    ],
)
def test_what_cannot_exist_is_a_design_error_naming_the_key(make, key):
    with pytest.raises(ct.DesignError, match=key) as caught:
        make()
    assert isinstance(caught.value, ct.Error)


def test_wrong_kinds_of_argument_are_type_errors():
    with pytest.raises(TypeError):
        ct.pitch.ellipse(0.2)
    with pytest.raises(TypeError):
        ct.pitch.circle(module="two", tooth_count=20)
