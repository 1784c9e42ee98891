"""Gears that drive a crank as goals of its output ask."""

import centrode as ct
import numpy as np
import pytest
from scipy.optimize import brentq

SLIDER = """
family = "machine"
frame.points = { O = [0, 0] }
bodies.crank = { on = "frame.O", law = { ratio = 1 }, points = { A = [30, 0] } }
dyads.ram = { type = "RRP", from = "crank.A", lengths = [120], line = "frame.O", line_deg = 0, side = "forward",
    bodies = ["rod", "ram"], joint = "B" }
goals.steady = { figure = "ram.travel", over = "deviation", within_deg = [30, 120], uniform = [110, 140],
    maximum = 1e-4 }
goals.rest = { figure = "ram.travel", over = "span", within_deg = [170, 210], maximum = 1.5 }
"""


@pytest.fixture(scope="module")
def drive():
    return ct.gear_drive(ct.Machine.from_toml(SLIDER), center_distance=130)


def ram(crank):
    return 30 * np.cos(crank) + np.sqrt(120**2 - (30 * np.sin(crank)) ** 2)


def test_the_law_is_that_of_a_slider_crank_solved_by_another_program(drive):
    for share in np.linspace(0, 1, 11):
        phi = np.radians(30 + 90 * share)
        place = 110 + 30 * share
        # On its way out: from the near end, half a turn before the far one.
        wanted = brentq(lambda crank, place=place: ram(crank) - place, np.pi, 2 * np.pi, xtol=1e-15)
        assert drive.law(phi) % (2 * np.pi) == pytest.approx(wanted, abs=1e-12)


def test_the_machine_driven_goes_steadily_and_rests(drive):
    machine = drive.machine()
    report = machine.check()
    assert report.ok
    assert [goal.met for goal in report.goals] == [True, True]
    steady = np.linspace(30, 120, 181)
    places = machine.body("ram", np.radians(steady))[:, 0]
    assert np.abs(places - np.interp(steady, [30, 120], [110, 140])).max() < 60e-6
    rests = machine.body("ram", np.radians(np.linspace(170, 210, 81)))[:, 0]
    assert rests.min() > 148.5 - 1e-6
    assert drive.miss < 1e-5
    assert 0 < drive.ratios[0] < 1 < drive.ratios[1]
    assert min(drive.minimum_radii) > 13


def test_what_is_asked_wrongly_is_refused(drive):
    machine = ct.Machine.from_toml(SLIDER)
    with pytest.raises(ct.DesignError, match="centre distance must be"):
        ct.gear_drive(machine, center_distance=-1)
    with pytest.raises(ct.DesignError, match=r"rod belongs to dyads\.ram"):
        ct.gear_drive(machine, "rod", center_distance=130)
    with pytest.raises(ct.MechanismError, match=r"goals\.rest"):
        ct.gear_drive(ct.Machine.from_toml(SLIDER.replace("maximum = 1.5", "maximum = 40")), center_distance=130)
    with pytest.raises(ct.MechanismError, match="no goal defines the output"):
        ct.gear_drive(ct.Machine.from_toml(SLIDER.split("goals.steady")[0]), center_distance=130)
