"""Pitch curves from Python: the words of the design file, radians, array-likes."""

import math
import pickle
from functools import partial

import centrode as ct
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

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
        (lambda: ct.pitch.circle(module=1, tooth_count=-1), "tooth_count"),
        (lambda: ct.pitch.polar([20, -1, 20, 20, 20, 20, 20]), "radius"),
        (lambda: ct.pitch.polar("20 + x"), "expression"),
        (lambda: ct.pitch.polar("1/(phi-phi)"), "expression"),
        (lambda: ct.pitch.polar([20] * 9, interpolation="linear"), "interpolation"),
        (lambda: ct.pitch.from_transmission("phi*1.2345678", center_distance=40), "driven"),
        (lambda: ct.pitch.bspline(radius=[20, 20, 20, 20], angle=[0, 2, 1, 3]), "angle_deg"),
        (lambda: ct.pitch.conjugate(ct.pitch.polar("20 + cos(phi)"), mean_ratio=(1, 2)), "mean ratio"),
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
    with pytest.raises(TypeError, match="real numbers"):
        ct.pitch.polar(np.array([20 + 1j] * 9))
    with pytest.raises(ValueError, match="dimensions"):
        ct.pitch.polar([[20, 21], [22, 23]])


def test_curvature_is_that_of_the_curve():
    pitch = ct.pitch.ellipse(eccentricity=0.5, semi_major_axis=20)
    ends = pitch.curvature([0.0, math.pi])
    np.testing.assert_allclose(ends, 20 / (20**2 * 0.75), rtol=1e-12)


@given(eccentricity=st.floats(0, 0.9), module=st.floats(0.1, 100), teeth=st.integers(3, 500))
@settings(max_examples=30, derandomize=True, deadline=None)
def test_module_and_tooth_count_set_the_length(eccentricity, module, teeth):
    pitch = ct.pitch.ellipse(eccentricity=eccentricity, module=module, tooth_count=teeth)
    phi = np.linspace(0, 2 * math.pi, 4097)
    step = np.diff(pitch.points(phi), axis=0)
    length = np.hypot(*step.T).sum()
    assert length == pytest.approx(math.pi * module * teeth, rel=1e-5)


@pytest.mark.parametrize(
    "make",
    [
        ct.pitch.circle,
        partial(ct.pitch.eccentric_circle, eccentricity=0.2),
        partial(ct.pitch.ellipse, eccentricity=0.2),
        partial(ct.pitch.lobed_ellipse, lobes=2, eccentricity=0.2),
        partial(ct.pitch.bspline, radius=[20, 22, 20, 22], angle=[0, 1.5, 3, 4.5]),
        partial(ct.pitch.bezier, radius=[20, 22, 20, 22], angle=[0, 1.5, 3, 4.5], degree=1),
        partial(ct.pitch.limacon, mean_radius=20, amplitude=3),
        partial(ct.pitch.polar, "1 + 0.1*cos(2*phi)"),
        partial(ct.pitch.from_transmission, "phi - 0.08*sin(2*phi)"),
        partial(ct.pitch.from_ratio, "1 - 0.16*cos(2*phi)"),
        partial(ct.pitch.conjugate, ct.pitch.circle(radius=20)),
    ],
)
def test_a_diametral_pitch_sets_the_module(make):
    pitch = make(diametral_pitch=16, tooth_count=40)
    assert pitch.module == 25.4 / 16
    np.testing.assert_array_equal(pitch.points([0.0]), make(module=1.5875, tooth_count=40).points([0.0]))
    assert pickle.loads(pickle.dumps(pitch)).module == pitch.module
    for wrong in ({"module": 2, "diametral_pitch": 16}, {"diametral_pitch": 0}, {"diametral_pitch": -16}):
        with pytest.raises(ct.DesignError) as error:
            make(tooth_count=40, **wrong)
        assert error.value.key == "pitch.diametral_pitch"


@pytest.mark.parametrize("ask", ["points", "curvature"])
def test_a_parameter_that_is_no_number_is_refused(ask):
    with pytest.raises(ct.DesignError, match="every parameter must be a finite number, not NaN"):
        getattr(ct.pitch.circle(radius=10), ask)([0.0, float("nan")])
