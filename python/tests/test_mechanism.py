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


def test_links_have_the_shafts_pins_rings_and_keys_mounted_on_them():
    (design,) = (file for file in SHIPPED if file.stem == "feeder-2022")
    feeder = ct.load(design)
    links = {link.name: link for link in feeder.links()}
    words = [body.name for body in links["crank"].mounted]
    counts = {word: words.count(word) for word in words}
    assert counts == {
        "pin-b": 1,
        "shaft-a": 1,
        "circlip-din-471-10x1": 2,
        "circlip-din-471-16x1": 4,
        "key-din-6885-1-a-5x5x14": 1,
        "key-din-6880-b-5x5x8": 1,
    }
    for body in links["crank"].mounted:
        # A turned part as STEP, an extrusion by its edges.
        assert (body.step is None) == bool(body.solids)
        assert body.step is None or b"MANIFOLD_SOLID_BREP" in body.step
        turn = body.frame[:3, :3]
        np.testing.assert_allclose(turn @ turn.T, np.eye(3), atol=1e-12)
        assert np.linalg.det(turn) == pytest.approx(1.0)
    (pin,) = (body for body in links["crank"].mounted if body.name == "pin-b")
    # B is 77 mm from the shaft.
    assert np.hypot(*pin.frame[:2, 3]) == pytest.approx(77.0)
    assert all(link.mounted == () for link in feeder.links(bodies=False))
    assert ct.GearPair(ct.pitch.circle(module=2, tooth_count=20)).links()[1].mounted == ()
