"""The hardest shipped pair through tooth contact alone: a simulator agrees with the contact analysis."""

import importlib.util
from pathlib import Path
from types import SimpleNamespace

import centrode as ct
import numpy as np
import pytest

DESIGN = Path(__file__).resolve().parents[2] / "tests" / "designs" / "transplanter-pair-2021.toml"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("transplanter")
    ct.load(DESIGN).export(folder, formats=["mjcf"])
    return folder


def turned(folder, sense):
    """Driver angles of one turn, and how far the driven gear is off the law, rad."""
    spec = importlib.util.spec_from_file_location("play_mujoco", folder / "play_mujoco.py")
    script = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(script)
    how = SimpleNamespace(contact=True, drive=False, backward=sense < 0, speed=2.0, load=0.01)
    played = script.Machine(how)
    travel, off = [], []
    while abs(played.data.time) < 1.05 * np.pi:
        played.advance()
        travel.append(played.travelled)
        off.append(played.off()["driven_joint"])
    before = len(travel) // 20
    return np.array(travel[before::4]), np.array(off[before::4])


@pytest.mark.parametrize("sense", [1, -1])
def test_concave_teeth_carry_the_driven_gear_where_the_analysis_says(folder, sense):
    pair = ct.load(DESIGN)
    travel, off = turned(folder, sense)
    contact = pair.contact(inputs=travel)
    pushed = contact.transmission_error if sense > 0 else contact.reverse_transmission_error
    angle = (pair.pressure_angle if sense > 0 else pair.reverse_pressure_angle)(travel)
    # Half of the backlash along the normal, as rotation of the driven gear.
    half = pair.backlash / 2 / (pair.center_distance / (1 + pair.ratio(travel)) * np.cos(angle))
    error = np.degrees(np.abs(off - (pushed - sense * half)))
    # Where tooth edges drive, as the check reports, the gear is thrown: it has settled after a twentieth of a turn.
    lost = travel[np.abs(pushed) > 1e-4]
    since = sense * (travel[:, None] - lost)
    sound = np.all((since < -0.01) | (since > 0.35), axis=1)
    assert np.mean(sound) > 0.75
    assert error[sound].max() < 0.02
    assert np.median(error) < 0.002
