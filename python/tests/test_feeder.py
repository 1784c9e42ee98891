import math

import centrode as ct
import numpy as np
import pytest


@pytest.fixture(scope="module")
def feeder():
    return ct.Feeder.from_toml(ct.template("feeder"))


def test_the_tip_goes_on_an_arc_of_half_a_circle_and_rests_at_both_ends(feeder):
    phi = np.linspace(0.0, 2.0 * np.pi, 721)
    tip, pivot = feeder.tip(phi), feeder.six_bar.pivot
    assert tip.shape == (721, 2)
    np.testing.assert_allclose(np.hypot(*(tip - pivot).T), feeder.six_bar.effector_length, rtol=1e-12)
    assert math.degrees(np.ptp(feeder.effector_angle(phi))) == pytest.approx(180, abs=0.01)
    feed, back = feeder.strokes
    np.testing.assert_allclose(feeder.tip_speed([0.0, feed, back, back + 0.1]), 0.0, atol=1e-6)
    assert feeder.dwell_angle == pytest.approx(2 * math.pi - back)
    assert feeder.feed_rate == pytest.approx(5 * 30 / 2.7)


def test_derivatives_are_those_of_the_angle(feeder):
    phi, step = np.linspace(0.1, 5.0, 50), 1e-6
    motion = feeder.effector_motion(phi)
    slope = (feeder.effector_angle(phi + step) - feeder.effector_angle(phi - step)) / (2 * step)
    np.testing.assert_allclose(motion[:, 1], slope, atol=1e-6)


def test_a_design_reads_back_and_bad_ones_say_where(feeder, tmp_path):
    again = ct.Feeder.from_toml(feeder.to_toml())
    assert again == feeder
    assert "Feeder" in repr(feeder)
    path = tmp_path / "feeder.toml"
    path.write_text(ct.template("feeder"))
    assert ct.load(path) == feeder
    with pytest.raises(ct.DesignError, match="nothing is left to dwell"):
        ct.Feeder.from_toml(ct.template("feeder").replace("driver_pitches = 40", "driver_pitches = 30"))


def test_check_and_files(feeder, tmp_path):
    report = feeder.check()
    assert report.ok
    assert report.values["gear_overlap_max"] < 3e-3
    paths = feeder.export(tmp_path, formats=["csv", "mjcf"])
    assert {"feeder.xml", "motion.csv"} <= {path.name for path in paths}


def test_pictures_are_drawn(feeder):
    pytest.importorskip("matplotlib").use("Agg")
    path, _, speed = np.ravel(ct.plot.feeder(feeder))
    assert path.lines
    assert speed.get_xlabel() == "time, s"
    assert ct.plot.pivots(feeder.six_bar, math.radians(170)).get_legend() is not None
