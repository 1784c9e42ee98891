"""Keywords that are read into the table of a design: defaults as the signature has them, and none that is unknown."""

import inspect
import math

import centrode as ct
import pytest

CIRCLE = ct.pitch.circle(module=2, tooth_count=20)
RADII = [20, 21, 20, 19, 20, 21, 20, 19]
SQUARE = {"x": [10, -10, -10, 10], "y": [10, 10, -10, -10], "plane": "cartesian"}
CORNERS = {"x": [10, 0, -10, -10, -10, 0, 10, 10], "y": [10, 10, 10, 0, -10, -10, -10, 0], "plane": "cartesian"}
ARMS = {"carrier_start": 1.5, "bend": -0.9, "arm_mounting_angle": -0.5, "tip_distance": 145, "pusher_offset": 65}
SPANS = [ct.cam.rise(span=2, lift=9), ct.cam.dwell(span=1), ct.cam.return_(span=2 * math.pi - 3, lift=9)]

CALLS = [
    (ct.GearPair, [CIRCLE], {}),
    (ct.ThreeArm, [CIRCLE], ARMS),
    (ct.SpiralShaft, [], {}),
    (ct.SpiralShaft, [], {"moved_distance": 2.05}),
    (ct.SpiralShaft, [], {"rotated": True, "amplitude": 1.0}),
    (ct.MovingBox, [], {}),
    (ct.MovingBox, [], {"speed_ratio": 3}),
    (ct.DiscCam, [ct.cam.translating_roller(roller_radius=7), SPANS], {"base_radius": 40}),
    (ct.Body, [], {}),
    (ct.Keyway, [], {"width": 4, "depth": 1.8}),
    (ct.Rack, [], {}),
    (ct.Shaper, [], {"tooth_count": 20}),
    (ct.DrawingSpec, [], {}),
    (ct.cam.rise, [], {"span": 2, "lift": 9}),
    (ct.cam.return_, [], {"span": 2, "lift": 9}),
    (ct.cam.transition, [], {"span": 2, "lift": 9}),
    (ct.pitch.circle, [], {"radius": 20}),
    (ct.pitch.eccentric_circle, [], {"eccentricity": 0.2, "radius": 20}),
    (ct.pitch.ellipse, [], {"eccentricity": 0.2, "semi_major_axis": 20}),
    (ct.pitch.lobed_ellipse, [], {"lobes": 2, "eccentricity": 0.1, "semi_major_axis": 20}),
    (ct.pitch.bspline, [], SQUARE),
    (ct.pitch.bezier, [], {**CORNERS, "degree": 2}),
    (ct.pitch.limacon, [], {"mean_radius": 20, "amplitude": 2}),
    (ct.pitch.polar, [RADII], {}),
    (ct.pitch.from_transmission, ["phi/2 - 0.05*sin(2*phi)"], {"center_distance": 60}),
    (ct.pitch.from_ratio, ["1 - 0.16*cos(2*phi)"], {"center_distance": 60}),
    (ct.pitch.conjugate, [CIRCLE], {}),
]
each = pytest.mark.parametrize(("call", "given", "keywords"), CALLS, ids=lambda value: getattr(value, "__name__", ""))


@each
def test_the_defaults_are_those_of_the_signature(call, given, keywords):
    parameters = list(inspect.signature(call).parameters.values())[len(given) :]
    usual = {one.name: one.default for one in parameters if one.default is not one.empty}
    usual.pop("window", None)  # pi / 3: its last digit is another in the signature
    made, usual_made = call(*given, **keywords), call(*given, **{**usual, **keywords})
    if call is ct.DiscCam:
        assert made.files() == usual_made.files()
    else:
        assert made == usual_made


@each
def test_an_unknown_keyword_is_named(call, given, keywords):
    name = f"{call.__name__}.__new__" if isinstance(call, type) else call.__name__
    with pytest.raises(TypeError) as caught:
        call(*given, **keywords, colour=1)
    assert str(caught.value) == f"{name}() got an unexpected keyword argument 'colour'"


@each
def test_every_keyword_of_the_signature_is_looked_at(call, given, keywords):
    parameters = list(inspect.signature(call).parameters.values())[len(given) :]
    for name in [one.name for one in parameters if one.kind is one.KEYWORD_ONLY]:
        with pytest.raises(TypeError) as caught:
            call(*given, **{**keywords, name: object()})
        assert "unexpected" not in str(caught.value)


@pytest.mark.parametrize("value", [0.1, 1 / 3, math.radians(33.3), 5e-324, math.nextafter(0.5, 1)])
def test_angles_are_handed_on_to_the_last_digit(value):
    assert ct.Body(keyway_angle=value).keyway_angle == value
    assert ct.SpiralShaft(window=0.3, pick=value).pick == value
    assert ct.ThreeArm(CIRCLE, **ARMS, planet_reference=value).planet_reference == value
