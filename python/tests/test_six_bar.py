"""The picking six-bar, held against a numeric solution of its constraints."""

import centrode as ct
import numpy as np
import pytest

PUBLISHED = {"crank": 77, "coupler": 147, "rocker": 127, "frame": 105}


def six_bar(pivot=(100, 67), **changes):
    return ct.SixBar(**{**PUBLISHED, "pivot": pivot, "effector_length": 200, **changes})


def constraints(phi, b, c):
    """What B and C lack of the lengths, squared."""
    a, d = np.zeros(2), np.array([105.0, 0.0])
    return [
        b[0] - 77 * np.cos(phi),
        b[1] - 77 * np.sin(phi),
        (c - b) @ (c - b) - 147**2,
        (c - d) @ (c - d) - 127**2,
        (b - a) @ (b - a) - 77**2,
    ]


@pytest.mark.parametrize(("branch", "side"), [("upper", 1), ("lower", -1)])
def test_positions_close_the_loop_on_the_branch_asked_for(branch, side):
    six = six_bar(pivot=(60, 20), branch=branch)
    phi = np.linspace(0, 2 * np.pi, 200)
    joints = six.position(phi)
    assert joints.shape == (200, 3, 2)
    for angle, (b, c, e) in zip(phi, joints, strict=True):
        assert np.abs(constraints(angle, b, c)).max() < 1e-10
        across = np.array([105.0, 0.0]) - b
        assert side * (across[0] * (c - b)[1] - across[1] * (c - b)[0]) > 0
        assert np.isclose(np.hypot(*(e - (60, 20))), 200)
    assert np.array_equal(six.effector_tip(phi), joints[:, 2])
    assert six.position(1.0).shape == (3, 2)


def test_the_effector_points_at_the_slider_without_jumps():
    six = six_bar()
    phi = np.linspace(-7, 20, 5000)
    angle = six.effector_angle(phi)
    way = six.position(phi)[:, 1] - (100, 67)
    assert np.allclose(np.exp(1j * angle), (way[:, 0] + 1j * way[:, 1]) / np.hypot(*way.T))
    assert np.abs(np.diff(angle)).max() < 0.1
    assert np.isclose(np.ptp(angle), six.swing, atol=1e-4)
    motion = six.effector_motion(phi)
    assert np.allclose(motion[:, 0], angle)
    assert np.allclose(np.gradient(angle, phi)[1:-1], motion[1:-1, 1], atol=1e-2)
    assert isinstance(six.effector_angle(1.0), float)


def test_published_figures():
    six = six_bar()
    dead = six.dead_centers
    assert np.allclose(np.degrees([dead.stretched, dead.folded]), [16.63192, 270.79515], atol=1e-5)
    assert np.allclose(dead.stretched_at, (214.628571, 64.113776))
    assert np.allclose(dead.folded_at, (-0.971429, 69.993259))
    assert np.isclose(np.degrees(six.rocker_swing), 116.235306)
    assert np.isclose(np.degrees(six.minimum_transmission_angle), 8.224332)
    assert np.isclose(np.degrees(six.slow_stroke), 254.163, atol=1e-3)
    turn = np.linspace(0, 2 * np.pi, 10001)
    assert np.isclose(six.transmission_angle(turn).min(), six.minimum_transmission_angle, atol=1e-7)


def test_the_sensitivity_is_the_derivative_of_the_swing():
    sensitivity = six_bar().swing_sensitivity
    step = 1e-4
    for name, length in PUBLISHED.items():
        change = six_bar(**{name: length + step}).swing - six_bar(**{name: length - step}).swing
        assert np.isclose(change / (2 * step), sensitivity[name], atol=1e-7)


@pytest.mark.parametrize("degrees", [60, 150, 180, 230])
def test_pivots_of_a_swing_give_it(degrees):
    places = six_bar().pivots(np.radians(degrees), 20)
    assert len(places) == 20
    for place in places:
        assert np.isclose(np.degrees(six_bar(pivot=tuple(place)).swing), degrees)


def test_no_pivot_sees_more_than_half_a_turn_and_half_the_rockers_swing():
    most = np.pi + six_bar().rocker_swing / 2
    assert len(six_bar().pivots(most - 1e-3, 5)) == 5
    assert six_bar().pivots(most + 1e-3, 5).shape == (0, 2)


def test_what_cannot_turn_is_refused():
    with pytest.raises(ct.LinkageError, match="double crank"):
        six_bar(frame=45)
    with pytest.raises(ct.LinkageError, match="path of the slider"):
        six_bar(pivot=(105, 127))
    with pytest.raises(ct.DesignError, match="crank is -1 mm") as error:
        six_bar(crank=-1)
    assert error.value.key == "crank"
    with pytest.raises(ct.DesignError, match="branch must be one of upper, lower"):
        six_bar(branch="left")
