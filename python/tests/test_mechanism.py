"""What every machine can do, whatever its family."""

import csv
import io
import math
from pathlib import Path

import centrode as ct
import numpy as np
import pytest

SHIPPED = sorted((Path(__file__).resolve().parents[2] / "tests" / "designs").glob("*.toml"))
FAMILIES = ["gear-pair", "three-arm", "spiral-shaft", "moving-box", "feeder"]


@pytest.mark.parametrize("family", FAMILIES)
def test_motion_has_the_columns_and_numbers_of_the_table(family):
    machine = ct.Mechanism.from_toml(ct.template(family))
    assert isinstance(machine, ct.Mechanism)
    rows = list(csv.reader(io.StringIO(machine.files(formats=["csv"])["motion.csv"].decode())))
    table = np.array(rows[1:], dtype=float)
    motion = machine.motion(table[:, 0])
    assert list(motion) == rows[0]
    for index, (name, values) in enumerate(motion.items()):
        assert np.allclose(values, table[:, index], rtol=1e-9, atol=1e-9), name


@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.stem)
def test_every_figure_of_a_report_has_its_unit_and_no_other(path):
    report = ct.load(path).check()
    assert set(report.units) == set(report.values)
    assert set(report.units.values()) <= {
        "",
        "mm",
        "1/mm",
        "rad",
        "rad/s",
        "rad/s²",
        "mm/s",
        "m/s²",
        "N",
        "N·mm",
        "r/min",
        "1/min",
        "s",
        "pitches",
    }


def test_a_contact_is_asked_for_at_inputs_that_are_numbers():
    pair = ct.GearPair(ct.pitch.circle(module=2, tooth_count=20))
    for wrong in (math.nan, math.inf):
        with pytest.raises(ValueError, match="every input"):
            pair.contact(inputs=[0.0, wrong])
