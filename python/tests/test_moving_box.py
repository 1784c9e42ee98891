"""Moving boxes from Python."""

import math

import centrode as ct
import matplotlib as mpl
import numpy as np
import pytest
from matplotlib import pyplot

mpl.use("Agg")
WINDOW = math.pi / 3


@pytest.fixture(scope="module")
def geared():
    return ct.MovingBox(eccentricity=1 / (2 + math.sqrt(3)))


@pytest.fixture(scope="module")
def grooved():
    return ct.MovingBox(ct.SpiralShaft.for_moved_distance(2.05))


def test_the_published_eccentricity_moves_1_954217_mm_and_not_2_1(geared):
    assert geared.scheme == "elliptic-gear"
    assert geared.moved_in_window == pytest.approx(1.954217, abs=5e-7)
    assert geared.moved(-WINDOW / 2, WINDOW / 2) == pytest.approx(geared.moved_in_window)
    # By quadrature of the speed, from nothing but the shaft's turn.
    phi = np.linspace(-WINDOW / 2, WINDOW / 2, 20001)
    moved = np.trapezoid(geared.shaft_speed(phi), phi) * 20 / (2 * math.pi)
    assert moved == pytest.approx(geared.moved_in_window, abs=1e-8)


def test_schemes_are_told_by_what_is_given(grooved):
    assert grooved.scheme == "shaft"
    assert grooved.eccentricity is None
    assert grooved.gear_pair() is None
    both = ct.MovingBox(ct.SpiralShaft(amplitude=0.5), speed_ratio=1.5)
    assert both.scheme == "both"
    slow = ct.MovingBox(ct.SpiralShaft(amplitude=0.5)).moved_in_window
    assert both.moved_in_window < slow < 20 / 6


def test_the_gears_turn_the_shaft(geared):
    pair = geared.gear_pair()
    phi = np.linspace(0, 2 * math.pi, 50)
    # The pair is slowest half a turn from its own zero, or at it.
    shift = 0.0 if pair.ratio(0.0) < pair.ratio(math.pi) else math.pi
    np.testing.assert_allclose(geared.shaft_speed(phi), pair.ratio(shift - phi), atol=1e-9)


def test_motion_is_what_its_derivatives_say(geared):
    phi = np.linspace(1.0, geared.cycle - 1.0, 400)
    h = 1e-4
    for of, by in [("position", "velocity"), ("velocity", "acceleration"), ("acceleration", "jerk")]:
        f = getattr(geared, of)
        slope = (f(phi + h) - f(phi - h)) / (2 * h)
        np.testing.assert_allclose(slope, getattr(geared, by)(phi), atol=2e-4)
    assert geared.position(geared.cycle) == pytest.approx(0, abs=1e-9)


def test_the_schemes_stand_beside_a_plain_shaft(geared):
    tables = {table.name: table for table in geared.check().tables}
    moves = {name: row[0] for name, row in tables["schemes"].rows.items()}
    assert moves["plain shaft"] == pytest.approx(10 / 3)
    assert moves["as designed"] == moves["gears only"] == pytest.approx(1.954217, abs=5e-7)
    forces = tables["normal-forces"].rows["at 0 deg"]
    assert forces[0] == pytest.approx(forces[1])


def test_no_friction_leaves_force_times_lead_over_a_turn():
    machine = ct.MovingBox()
    force = machine.force(1.0, groove_friction=0.0)
    assert force.torque == pytest.approx(force.push * 20 / (2 * math.pi), rel=1e-12)


def test_design_files_read_back(geared, tmp_path):
    again = ct.MovingBox.from_toml(geared.to_toml())
    assert again == geared
    path = tmp_path / "box.toml"
    path.write_text(ct.template("moving-box"))
    assert ct.load(path).scheme == "elliptic-gear"


@pytest.mark.parametrize(
    ("keywords", "key"),
    [
        ({"eccentricity": 1.2}, "gears.eccentricity"),
        ({"eccentricity": 0.2, "speed_ratio": 3}, "gears.speed_ratio"),
        ({"moved_distance": 5}, "gears.moved_distance"),
        ({"scheme": "elliptic-gear"}, "gears.eccentricity"),
        ({"scheme": "belt"}, "scheme"),
        ({"scheme": "shaft", "speed_ratio": 3}, "gears"),
        ({"speed_ratio": 3, "tooth_count": -1}, "gears.tooth_count"),
    ],
)
def test_bad_input_names_its_key(keywords, key):
    with pytest.raises(ct.DesignError) as caught:
        ct.MovingBox(**keywords)
    assert caught.value.key == key


def test_files_hold_machine_and_gears(geared, tmp_path):
    names = set(geared.files(formats=["mjcf", "csv"], tolerance=0.05))
    assert {"machine.xml", "play_mujoco.py", "motion.csv", "motion.json", "gears-driver.stl", "shaft.stl"} <= names
    paths = geared.export(tmp_path, formats=["step"], tolerance=0.05)
    assert tmp_path / "shaft.step" in paths


def test_plots_show_the_slow_place(geared, grooved):
    ax = ct.plot.speed(geared, grooved)
    _, first, second = ax.lines
    for line, least in [(first, 0.577350), (second, 0.596829)]:
        speeds = line.get_ydata()
        assert speeds.min() == pytest.approx(least * 20 * 200 / 60, rel=1e-5)
        assert abs(line.get_xdata()[speeds.argmin()]) < 1e-9
    ax = ct.plot.moving(geared, grooved, turns=2)
    for line in ax.lines:
        assert line.get_ydata()[-1] == pytest.approx(40)
    with pytest.raises(ValueError, match="no machine"):
        ct.plot.moving()
    pyplot.close("all")
