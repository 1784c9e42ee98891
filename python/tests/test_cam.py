"""Cams from Python: laws as arrays, profiles, limits, files."""

import math

import centrode as ct
import numpy as np
import pytest


def cam(follower=None, stroke=None, drop=1.2, **keywords):
    follower = follower or ct.cam.translating_roller(roller_radius=7, offset=3)
    stroke = stroke or ({"swing": 0.2} if follower.swings else {"lift": 9})
    segments = [
        ct.cam.rise(span=2.4, law="modified-sine", **stroke),
        ct.cam.dwell(span=1.0),
        ct.cam.return_(span=drop, law=ct.cam.law("polynomial-4567"), **stroke),
        ct.cam.dwell(span=2 * math.pi - 3.4 - drop),
    ]
    return ct.DiscCam(follower, segments, **{"base_radius": 40, **keywords})


@pytest.mark.parametrize(
    ("name", "velocity", "acceleration", "jerk"),
    [
        ("cycloidal", 2, 2 * math.pi, 4 * math.pi**2),
        ("modified-sine", 1.7596, 5.5280, 69.4664),
        ("modified-trapezoid", 2, 4.8881, 61.4258),
        ("polynomial-345", 1.875, 5.7735, 60),
        ("polynomial-4567", 2.1875, 7.5132, 52.5),
        ("harmonic", math.pi / 2, math.pi**2 / 2, math.inf),
    ],
)
def test_laws_have_their_characteristic_values(name, velocity, acceleration, jerk):
    law = ct.cam.law(name)
    peaks = law.characteristic_values
    found = [peaks["velocity"], peaks["acceleration"], peaks["jerk"]]
    np.testing.assert_allclose(found, [velocity, acceleration, jerk], rtol=1e-5)
    assert (peaks["acceleration_jump"] > 0) == (jerk == math.inf)
    assert peaks["acceleration_inside"] == peaks["acceleration"]
    assert peaks["velocity_jump"] == 0
    x = np.linspace(0, 1, 4001)
    s, v, a, _ = law.at(x).T
    np.testing.assert_allclose(np.gradient(s, x)[1:-1], v[1:-1], atol=1e-5)
    np.testing.assert_allclose(np.gradient(v, x)[1:-1], a[1:-1], atol=2e-2)
    assert (s[0], s[-1]) == (0, 1)
    assert law == ct.cam.law(name) != ct.cam.polynomial(end=[1])


def test_a_jump_at_rest_or_inside_makes_the_next_derivative_infinite():
    peaks = {name: ct.cam.law(name).characteristic_values for name in ["constant-velocity", "parabolic", "harmonic"]}
    jumps = {name: (of["velocity_jump"], of["acceleration_jump"]) for name, of in peaks.items()}
    assert jumps == {"constant-velocity": (1, 0), "parabolic": (0, 8), "harmonic": (0, pytest.approx(math.pi**2 / 2))}
    assert [of["acceleration"] for of in peaks.values()] == [math.inf, 4, pytest.approx(math.pi**2 / 2)]
    assert [of["jerk"] for of in peaks.values()] == [math.inf] * 3
    assert [of["jerk_inside"] for of in peaks.values()] == [0, 0, pytest.approx(math.pi**3 / 2)]


@pytest.mark.parametrize("rotation", ["counter-clockwise", "clockwise"])
def test_the_roller_touches_the_profile_everywhere(rotation):
    follower = ct.cam.swinging_roller(roller_radius=6, center_distance=70, arm_length=60, lifts="clockwise")
    sound = cam(follower, rotation=rotation)
    theta = np.linspace(0, 2 * math.pi, 200)
    profile = sound.profile(1e-6)
    distance = np.linalg.norm(sound.roller(theta)[:, None] - profile[None], axis=2).min(axis=1)
    # Corners of the polygon lie apart, so the nearest is a little farther than the profile.
    assert distance.min() > 6 - 1e-6
    assert distance.max() < 6 + 5e-3
    offset = sound.roller(theta) - sound.points(theta)
    np.testing.assert_allclose(offset, 6 * sound.normals(theta), atol=1e-12)
    k, pitch = sound.curvature(theta), sound.pitch_curvature(theta)
    np.testing.assert_allclose(k, pitch / (1 - 6 * pitch), rtol=1e-12)
    assert sound.undercut == []
    assert sound.limits["regularity"][1] > 0
    assert abs(sound.pressure_angle(theta)).max() < math.pi / 2


def test_motion_repeats_and_peaks_are_in_it():
    sound = cam()
    theta = np.linspace(0, 2 * math.pi, 5000)
    motion = sound.motion(theta)
    np.testing.assert_allclose(sound.motion(theta + 2 * math.pi), motion, atol=1e-9)
    for column, name in enumerate(["lift", "velocity", "acceleration"]):
        theta_peak, value = sound.peaks[name]
        assert value == pytest.approx(abs(motion[:, column]).max(), rel=1e-4)
        assert abs(sound.motion([theta_peak])[0, column]) == pytest.approx(value)
    assert motion.shape == (5000, 4)
    assert sound.motion([]).shape == (0, 4)


def test_a_flat_face_has_no_roller():
    flat = cam(ct.cam.translating_flat(), {"lift": 4}, drop=2)
    assert flat.pitch_curve() is None
    assert np.isnan(flat.roller([1.0])).all()
    assert "largest_roller" not in flat.limits
    np.testing.assert_allclose(flat.pressure_angle(np.arange(6)), 0, atol=1e-15)


def test_a_quick_drop_undercuts_and_says_where():
    quick = cam(ct.cam.translating_roller(roller_radius=9), drop=0.2)
    ((start, end),) = quick.undercut
    assert start < quick.limits["regularity"][0] < end
    assert quick.limits["regularity"][1] <= 0
    assert quick.limits["minimum_radius"][1] <= 0


def test_the_least_base_radius_meets_the_limit():
    radius = cam().minimum_base_radius(rise=0.4)
    assert cam(base_radius=radius).limits["rise_pressure_angle"][1] == pytest.approx(0.4, rel=1e-9)


def test_files_are_named_after_the_cam_and_repeat():
    files = cam(name="drop", body=ct.Body(bore=12)).files(formats="all")
    assert sorted(files) == [
        "drop-assembly.dxf",
        "drop-assembly.svg",
        "drop.3mf",
        "drop.csv",
        "drop.dxf",
        "drop.step",
        "drop.stl",
        "drop.svg",
    ]
    assert files == cam(name="drop", body=ct.Body(bore=12)).files(formats="all")
    assert list(cam().files(formats=["csv"])) == ["cam.csv"]


@pytest.mark.parametrize(
    ("make", "key"),
    [
        (lambda: cam(base_radius=0), "base_radius"),
        (lambda: cam(rotation="left"), "rotation"),
        (lambda: cam(drop=9), "motion.segments.2.span_deg"),
        (lambda: cam(stroke={"lift": -1}), "motion.segments.0.lift"),
        (lambda: cam(stroke={"swing": 1}), "motion"),
        (lambda: cam(stroke={"lift": math.nan}), "motion.segments.0.lift"),
        (lambda: cam(body=ct.Body(bore=90)), "body.bore"),
        (lambda: cam(ct.cam.translating_roller(roller_radius=1, offset=60)), "follower.offset"),
        (lambda: ct.cam.translating_roller(roller_radius=-1), "roller_radius"),
        (lambda: ct.cam.law("sudden"), "law.kind"),
        (lambda: ct.DiscCam(ct.cam.translating_flat(), [ct.cam.dwell(span=1)], base_radius=9), "motion.segments"),
        (lambda: cam().files(formats=["dwg"]), "formats"),
        (lambda: cam().profile(0), "tolerance"),
    ],
)
def test_bad_values_name_their_key(make, key):
    with pytest.raises(ct.DesignError) as caught:
        make()
    assert caught.value.key == key


def test_a_cam_alone_is_no_machine():
    with pytest.raises(ct.ExportError, match="urdf"):
        cam().files(formats=["urdf"])


FORK = {"roller_radius": 5, "center_distance": 52, "arm_length": 45, "lever_length": 40, "lever_start": -0.15}


@pytest.mark.parametrize("joint", ["pin-on-rod", "pin-on-fork"])
@pytest.mark.parametrize("lifts", ["counter-clockwise", "clockwise"])
def test_a_fork_moves_its_rod_as_its_cam_is_made_for(joint, lifts):
    fork = ct.cam.Fork(joint=joint, lifts=lifts, **FORK)
    segments = [
        ct.cam.rise(span=2.4, law="modified-sine", lift=9),
        ct.cam.dwell(span=1.0),
        ct.cam.return_(span=1.2, lift=9),
        ct.cam.dwell(span=2 * math.pi - 4.6),
    ]
    cam = fork.cam(segments, base_radius=22, body=ct.Body(width=5, bore=8))
    theta = np.linspace(0, 2 * math.pi, 100)
    rod = fork.retraction(cam.motion(theta)[:, 0])
    slide = ct.DiscCam(ct.cam.translating_roller(roller_radius=5), segments, base_radius=40)
    np.testing.assert_allclose(rod, slide.motion(theta)[:, 0], atol=1e-9)
    # By hand, from the law of the joint.
    law = np.tan if joint == "pin-on-rod" else np.sin
    np.testing.assert_allclose(rod, 40 * (law(cam.motion(theta)[:, 0] - 0.15) - law(-0.15)), atol=1e-9)
    np.testing.assert_allclose(fork.swing(rod), cam.motion(theta)[:, 0], atol=1e-12)
    distance = np.linalg.norm(cam.roller(theta), axis=1)
    assert distance[0] == pytest.approx(22 + 5)
    assert (fork.joint, fork.lifts, fork.lever_length) == (joint, lifts, 40)
    assert fork == ct.cam.Fork(joint=joint, lifts=lifts, **FORK)


def test_forks_that_cannot_be_are_refused():
    with pytest.raises(ct.DesignError, match="length") as error:
        ct.cam.Fork(**{**FORK, "lever_length": 0})
    assert error.value.key == "rod.length"
    with pytest.raises(ct.DesignError, match="joint"):
        ct.cam.Fork(joint="rivet", **FORK)
    fork = ct.cam.Fork(joint="pin-on-fork", **FORK)
    far = [ct.cam.rise(span=3, lift=47), ct.cam.return_(span=2 * math.pi - 3, lift=47)]
    with pytest.raises(ct.CamError):
        fork.cam(far, base_radius=22)
    turning = [ct.cam.rise(span=3, swing=0.2), ct.cam.return_(span=2 * math.pi - 3, swing=0.2)]
    with pytest.raises(ct.DesignError, match="must have lift, not swing"):
        fork.cam(turning, base_radius=22)
    assert math.isnan(fork.swing(50.0))
