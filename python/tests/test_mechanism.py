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


@pytest.mark.parametrize("family", FAMILIES)
def test_parts_are_those_of_the_list_and_belong_to_links(family):
    machine = ct.Mechanism.from_toml(ct.template(family))
    files = machine.files(formats=["csv", "dxf"])
    listed = list(csv.DictReader(io.StringIO(files["parts.csv"].decode())))
    parts, frames = machine.parts(), machine.frames(0.0)
    assert len(parts) == len(listed) >= 2
    for part, row in zip(parts, listed, strict=True):
        assert isinstance(part, ct.Part)
        assert part.quantity == len(part.links) == float(row["quantity"])
        assert set(part.links) <= set(frames)
        assert (part.file, part.mass) == (row["files"], float(row["mass_kg"]) if row["mass_kg"] else None)
        assert not part.file or f"{part.file}.dxf" in files
    assert sum(part.mass or 0 for part in parts) > 0


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
        "N/mm²",
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
