"""Contact analysis and check from Python, and the same numbers as on the command line."""

import dataclasses
import json
import math
import os
import subprocess
from pathlib import Path

import centrode as ct
import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
BINARY = Path(os.environ.get("CENTRODE_BIN", ROOT / "target" / "debug" / "centrode"))


def test_the_published_pair_is_good(pair):
    report = pair.check()
    assert report.ok
    assert report.values["transmission_error_max"] < 1e-8
    assert report.values["center_distance"] == pair.center_distance
    assert report.values["ratio_max"] == pytest.approx(math.sqrt(3), rel=1e-9)
    assert "center_distance" in str(report)


def test_a_bad_pair_is_a_report_not_an_error():
    report = ct.GearPair(ct.pitch.circle(module=2, tooth_count=12)).check()
    undercut = next(f for f in report.findings if f.rule == "undercut")
    assert undercut.severity in ("note", "warning", "error")
    assert "driven.shift = 0.3" in undercut.remedy
    assert undercut.place.part in ("driver", "driven")
    assert undercut.message in str(report)
    assert report.ok == all(f.severity != "error" for f in report.findings)


def test_contact_runs_along_one_whole_cycle(pair):
    contact = pair.contact()
    # An even number: the second half is the mirror image of the first.
    assert len(contact) == 8 * 23 + 2
    assert contact.input[0] >= 0
    assert contact.input[-1] < 2 * math.pi
    assert np.all(np.diff(contact.input) > 0)
    for field in dataclasses.fields(contact):
        assert getattr(contact, field.name).shape == (len(contact),)
    np.testing.assert_allclose(contact.law, pair.driven_angle(contact.input), atol=1e-12)
    assert np.abs(contact.transmission_error).max() < 1e-8
    assert set(contact.contacts) <= {1, 2, 3}
    assert len(pair.contact(2)) == 2 * 23 + 2


def test_contact_at_given_inputs():
    pair = ct.GearPair(ct.pitch.circle(module=2, tooth_count=30), backlash=0.1)
    phi = np.linspace(0, 1, 7, dtype=np.float32)
    contact = pair.contact(inputs=phi)
    np.testing.assert_array_equal(contact.input, phi)
    np.testing.assert_allclose(contact.normal_backlash, 0.1, rtol=1e-4)


@pytest.mark.parametrize("per_pitch", [0, -1, 10_001, 1 << 40])
def test_samples_a_pitch_have_a_range(pair, per_pitch):
    with pytest.raises(ct.DesignError, match="per_pitch"):
        pair.contact(per_pitch)


@pytest.mark.skipif(not BINARY.exists(), reason="the command line is not built: cargo build -p centrode")
def test_the_command_line_gives_the_same_numbers(design):
    done = subprocess.run([BINARY, "check", design, "--json"], capture_output=True, text=True, check=False)
    told = json.loads(done.stdout)["values"]
    values = ct.load(design).check().values
    shared = told.keys() & values.keys()
    assert {"center_distance", "module"} <= shared
    assert {name: told[name] for name in shared} == {name: values[name] for name in shared}


def test_an_infinite_figure_is_infinite_in_python_and_the_string_that_float_reads_in_json():
    design = ROOT / "tests" / "designs" / "moving-box-2018.toml"
    values = ct.load(design).check().values
    assert values["contact_limit_rpm"] == math.inf
    printed = subprocess.run([BINARY, "check", design, "--json"], check=True, capture_output=True, text=True)
    assert {name: float(value) for name, value in json.loads(printed.stdout)["values"].items()} == dict(values)
