import json
import math
import pickle
from pathlib import Path

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


def test_the_crank_holds_the_weight_of_the_links_and_of_what_is_carried(feeder):
    phi, step = np.linspace(0.1, 4.0, 40), 1e-6
    more = feeder.crank_torque(phi, moving=False, carried=2.0) - feeder.crank_torque(phi, moving=False)
    raised = (feeder.tip(phi + step) - feeder.tip(phi - step))[:, 1]
    turned = feeder.crank_angle(phi + step) - feeder.crank_angle(phi - step)
    np.testing.assert_allclose(more, 2.0 * 9.80665 * raised / turned, rtol=1e-5, atol=1e-2)
    forces = feeder.joint_forces(phi)
    assert forces.shape == (40, 7, 2)
    # Nothing else acts on slider and slot: the slot passes on a force square to the effector.
    angle = feeder.effector_angle(phi)
    along = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    assert np.abs((forces[:, 6] * along).sum(axis=1)).max() < 1e-9
    assert isinstance(feeder.crank_torque(1.0), float)
    # The mass carried in the design acts in the check, too.
    laden = ct.Feeder.from_toml(ct.template("feeder").replace("carried_mass = 0 ", "carried_mass = 2.0 "))
    np.testing.assert_array_equal(laden.crank_torque(phi), feeder.crank_torque(phi, carried=2.0))
    assert laden.check().values["crank_torque_still_max"] > 2 * feeder.check().values["crank_torque_still_max"]
    with pytest.raises(ct.MechanismError, match="mass"):
        feeder.crank_torque(1.0, carried=-1.0)


def test_a_design_reads_back_and_bad_ones_say_where(feeder, tmp_path):
    again = ct.Feeder.from_toml(feeder.to_toml())
    assert again == feeder
    assert "Feeder" in repr(feeder)
    path = tmp_path / "feeder.toml"
    path.write_text(ct.template("feeder"))
    assert ct.load(path) == feeder
    with pytest.raises(ct.DesignError, match="leaves no dwell"):
        ct.Feeder.from_toml(ct.template("feeder").replace("driver_pitches = 40", "driver_pitches = 30"))


def test_check_and_files(feeder, tmp_path):
    report = feeder.check()
    assert report.ok
    assert report.values["gear_penetration_max"] < 3e-3
    paths = feeder.export(tmp_path, formats=["csv", "mjcf"])
    assert {"machine.xml", "motion.csv"} <= {path.name for path in paths}


def test_pictures_are_drawn(feeder):
    pytest.importorskip("matplotlib").use("Agg")
    path, _, speed = np.ravel(ct.plot.feeder(feeder))
    assert path.lines
    assert speed.get_xlabel() == "time, s"
    assert ct.plot.pivots(feeder.six_bar, math.radians(170)).get_legend() is not None


def shipped(name):
    return ct.load(Path(__file__).parents[2] / "tests" / "designs" / f"{name}.toml")


def test_a_search_reaches_half_a_turn_and_tells_its_way(tmp_path):
    text = shipped("feeder-2022").to_toml().replace("transmission_angle_deg = 40", "transmission_angle_deg = 0")
    start = ct.Feeder.from_toml(text.replace("crank = 77.0\n", "crank = 78.5\n"))
    seen = []
    found = start.optimise("de", seed=4, progress=lambda *at: seen.append(at))
    assert found.reached
    assert (found.ended, found.remark) == ("target", None)
    assert abs(math.degrees(found.mechanism.six_bar.swing) - 180) < 1e-6
    assert found.mechanism.six_bar.pivot == start.six_bar.pivot
    assert found.history[: len(seen)] == tuple(seen)
    counts, violations, objectives = zip(*found.history, strict=True)
    assert counts[-1] == found.evaluations
    assert list(objectives) == sorted(objectives, reverse=True)
    assert set(violations) == {0.0}
    assert start.optimise("de", seed=4) == found
    assert pickle.loads(pickle.dumps(found)).history == found.history


def test_bounds_that_contradict_the_goal_are_told_and_widened():
    published = shipped("feeder-2022")
    found = published.optimise("de", evaluations=4000)
    assert not found.reached
    assert "12.312 deg" in found.remark
    widened, share = published.widened()
    assert share == pytest.approx(0.2244318, abs=1e-6)
    assert all(goal.met for goal in widened.check().goals)
    assert widened.six_bar == shipped("feeder-widened").six_bar
    with pytest.raises(ct.MechanismError, match="need not be widened"):
        widened.widened()


def test_the_template_is_the_widened_design(feeder):
    widened = shipped("feeder-widened")
    assert feeder.six_bar == widened.six_bar
    # Its bounds are rounded outwards, on which no figure depends.
    assert feeder.check().values == widened.check().values


def test_a_response_is_that_of_the_design_with_the_value(feeder):
    answers = feeder.response("crank", [59.0, 59.718])
    assert answers["swing"][1] == feeder.six_bar.swing
    assert answers["swing"][0] < answers["swing"][1]
    slope = (answers["swing"][1] - answers["swing"][0]) / 0.718
    assert slope == pytest.approx(feeder.six_bar.swing_sensitivity["crank"], rel=0.05)
    assert feeder.response("making.length_tolerance", [0.5])["swing_made_max"] > feeder.six_bar.swing + 0.01
    with pytest.raises(ct.DesignError):
        feeder.response("linkage.nothing", [1.0])


def test_the_history_of_searches_is_drawn(feeder, tmp_path):
    pytest.importorskip("matplotlib").use("Agg")
    found = shipped("feeder-2022").optimise("ga", evaluations=500)
    stored = tmp_path / "better.search.json"
    generations = [
        {"generation": 1, "evaluations": 40, "objective": 0.1, "violation": 0.5},
        {"generation": 2, "evaluations": 80, "objective": 0.01, "violation": 0.0},
        {"generation": 3, "evaluations": 120, "objective": 0.001, "violation": 0.0},
    ]
    stored.write_text(json.dumps({"variables": [], "evaluations": 9, "state": {"Global": {"history": generations}}}))
    ax = ct.plot.history(found, stored)
    assert ax.get_yscale() == "log"
    missed, *of_file = ax.lines
    assert len(missed.get_xdata()) == len(found.history)
    assert [list(line.get_ydata()) for line in of_file] == [[0.5], [0.01, 0.001]]
