"""Design files, templates and schema from Python."""

import copy
import json
import math
import pickle

import centrode as ct
import numpy as np
import pytest

GOOD = """family = "gear-pair"
[pitch]
kind = "ellipse"
eccentricity = 0.25
module = 2.25
tooth_count = 23
[teeth]
backlash = 0.05
"""


def test_a_file_and_keywords_give_the_same_pair(design):
    loaded = ct.load(design)
    body = ct.Body(width=10, bore=12, keyway=ct.Keyway(width=4, depth=1.8))
    made = ct.GearPair(
        ct.pitch.ellipse(eccentricity=0.2679491924311227, module=2.25, tooth_count=23),
        phase="congruent",
        driver=body,
        driven=body,
        name=loaded.name,
        title=loaded.title,
    )
    assert made == loaded
    assert made.check().values == loaded.check().values
    assert made.files(tolerance=0.01) == ct.load(str(design)).files(tolerance=0.01)


def test_every_kind_of_pitch_curve_survives_its_design_file():
    x, y = 20 * np.cos(np.arange(9) * 0.7), 20 * np.sin(np.arange(9) * 0.7)
    for pitch in [
        ct.pitch.circle(radius=20),
        ct.pitch.eccentric_circle(eccentricity=0.1, radius=20),
        ct.pitch.ellipse(eccentricity=0.1, semi_major_axis=20),
        ct.pitch.lobed_ellipse(lobes=2, eccentricity=0.1, semi_major_axis=20),
        ct.pitch.limacon(mean_radius=20, amplitude=1, lobes=2),
        ct.pitch.bspline(x=x, y=y, plane="cartesian", degree=3),
        ct.pitch.bspline(radius=[20, 21, 20, 19], angle=[0, 1.5, 3, 4.5], degree=2, interpolate=True),
        ct.pitch.polar("20 + cos(phi)"),
        ct.pitch.polar([20.0, 21, 22, 21, 20, 20, 20]),
        ct.pitch.polar(mean=20, cos=[1, 0.5], sin=[0.1]),
        ct.pitch.from_transmission("phi - 0.1*sin(phi)", center_distance=40),
        ct.pitch.from_transmission(np.linspace(0, 2 * math.pi, 13), center_distance=40),
        ct.pitch.from_ratio("1 + 0.1*cos(phi)", center_distance=40),
        ct.pitch.from_ratio([1.0, 1.1, 1.0, 0.9, 1.0, 1.1, 1.0, 0.9], center_distance=40, interpolation="cubic"),
        ct.pitch.conjugate(ct.pitch.polar("20 + cos(phi)"), mean_ratio=(2, 1)),
    ]:
        ratio = pitch.implied_ratio or (1, 1)
        pair = ct.GearPair(pitch, tooth_count=20, mean_ratio=ratio)
        again = ct.GearPair.from_toml(pair.to_toml())
        assert again.driver.pitch_length == pytest.approx(pair.driver.pitch_length, rel=1e-14)
        assert again.to_toml() == pair.to_toml()


def test_a_curve_with_corners_is_pickled_though_it_carries_no_teeth():
    square = ct.pitch.bezier(
        x=[10, 0, -10, -10, -10, 0, 10, 10], y=[10, 10, 10, 0, -10, -10, -10, 0], plane="cartesian", degree=2
    )
    assert pickle.loads(pickle.dumps(square)) == square
    with pytest.raises(ct.GearPairError) as caught:
        ct.GearPair(square, tooth_count=20)
    assert caught.value.key == "pitch"


def test_pitch_and_body_survive_pickling(pair):
    things = [
        pair,
        pair.pitch,
        ct.Rack(pressure_angle=0.4),
        ct.Shaper(tooth_count=25),
        ct.Body(bore=12, keyway=ct.Keyway(width=4, depth=1.8), material="brass"),
        pair.driver.teeth,
        ct.GearPair(ct.pitch.circle(module=2, tooth_count=12)).check(),
    ]
    for thing in things:
        assert pickle.loads(pickle.dumps(thing)) == thing
        assert copy.deepcopy(thing) == thing
    assert copy.copy(pair) is pair
    contact = pair.contact(1)
    np.testing.assert_array_equal(pickle.loads(pickle.dumps(contact)).sliding, contact.sliding)


def test_errors_survive_pickling():
    with pytest.raises(ct.PitchError) as caught:
        ct.GearPair.from_toml(GOOD.replace("0.25\n", "1.5\n", 1))
    again = pickle.loads(pickle.dumps(caught.value))
    assert (type(again), str(again), again.key, again.line) == (
        ct.PitchError,
        str(caught.value),
        "pitch.eccentricity",
        4,
    )


@pytest.mark.parametrize(
    ("old", "new", "kind", "key", "line", "column"),
    [
        ("eccentricity = 0.25", "eccentricity = 1.0", ct.PitchError, "pitch.eccentricity", 4, 1),
        ("eccentricity = 0.25", "eccentricity = nan", ct.PitchError, "pitch.eccentricity", 4, 1),
        ("eccentricity", "eccentricty", ct.DesignError, "pitch.eccentricty", 4, 1),
        ("backlash = 0.05", "  backlash = -1", ct.DesignError, "teeth.backlash", 8, 3),
        ("backlash = 0.05", "phase = 'congruent'\nthickness_split = 0.4", ct.GearPairError, "teeth.phase", 8, 1),
        ("kind =", "kind", ct.DesignError, "", 3, 6),
        ("gear-pair", "cam", ct.DesignError, "family", 1, 1),
        ("tooth_count = 23", "tooth_count = 23.5", ct.DesignError, "pitch.tooth_count", 6, None),
    ],
)
def test_design_errors_say_where(tmp_path, old, new, kind, key, line, column):
    path = tmp_path / "pair.toml"
    path.write_text(GOOD.replace(old, new, 1))
    with pytest.raises(kind) as caught:
        ct.load(path)
    error = caught.value
    assert (error.key, error.line) == (key, line)
    assert column in (None, error.column)
    assert str(error).startswith(f"{path}: line {line}, column {error.column}: ")


def test_huge_binary_and_missing_files(tmp_path):
    path = tmp_path / "pair.toml"
    path.write_text("# " + "x" * 10_000_000)
    with pytest.raises(ct.DesignError, match="the limit for a design file is"):
        ct.load(path)
    path.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(ct.DesignError, match="UTF-8"):
        ct.load(path)
    with pytest.raises(FileNotFoundError):
        ct.load(tmp_path / "none.toml")
    with pytest.raises(IsADirectoryError):
        ct.load(tmp_path)


def test_the_template_is_a_good_pair_and_fits_the_schema():
    assert ct.GearPair.from_toml(ct.template("gear-pair")).check().ok
    schema = ct.schema()
    assert json.dumps(schema).count("eccentricity") >= 3
    assert "conjugate" in json.dumps(schema)
    with pytest.raises(ct.DesignError, match="family"):
        ct.template("cam")
