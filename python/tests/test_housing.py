"""Housings of flow meters and pumps."""

import io
from pathlib import Path

import centrode as ct
import ezdxf
import numpy as np
import pytest

METER = Path(__file__).parents[2] / "tests" / "designs" / "oval-flow-meter.toml"


def test_a_pump_of_round_gears_moves_the_volume_of_the_closed_form():
    pair = ct.GearPair(ct.pitch.circle(module=2, tooth_count=20), driver=ct.Body(width=15), housing_gap=0.1)
    # Tips at r + m: 2 pi w m^2 (z + 1), the narrower gear being 10 mm wide.
    values = pair.check().values
    assert values["volume_per_turn"] == pytest.approx(2 * np.pi * 10 * 4 * 21 / 1e3, rel=1e-9)
    assert values["driver_chamber_radius"] == pytest.approx(22.1, rel=1e-9)
    assert "volume_per_turn" not in ct.GearPair(ct.pitch.circle(module=2, tooth_count=20)).check().values


def test_the_volume_of_oval_gears_is_the_work_of_a_pressure_over_a_turn():
    meter = ct.load(METER)
    a, phi = meter.center_distance, np.linspace(0, 2 * np.pi, 2000, endpoint=False)
    ratio = meter.ratio(phi)
    driver = a * ratio / (1 + ratio)
    tips = [gear.radii[1] for gear in (meter.driver, meter.driven)]
    rate = 0.5 * 20 * ((tips[0] ** 2 - driver**2) + (tips[1] ** 2 - (a - driver) ** 2) * ratio)
    assert meter.check().values["volume_per_turn"] == pytest.approx(2 * np.pi * rate.mean() / 1e3, rel=1e-6)


def test_the_chamber_clears_the_tips_by_the_gap():
    meter = ct.load(METER)
    contents = meter.files(formats=["dxf"], parts=["housing"], tolerance=1e-4)["housing.dxf"]
    entities = [*ezdxf.read(io.StringIO(contents.decode(), newline=None)).modelspace()]
    assert sorted(entity.dxf.layer for entity in entities) == ["HOLE", "PROFILE"]
    (chamber,) = (entity for entity in entities if entity.dxf.layer == "HOLE")
    a = meter.center_distance
    radii = {0: meter.driver.radii[1] + 0.05, a: meter.driven.radii[1] + 0.05}
    vertices = [(complex(x, y), bulge) for x, y, bulge in chamber.get_points("xyb")]
    for (start, bulge), (end, _) in zip(vertices, vertices[1:] + vertices[:1], strict=True):
        center = (start + end) / 2 + 1j * (end - start) * (1 - bulge**2) / (4 * bulge)
        (radius,) = (radius for x, radius in radii.items() if abs(center - x) < 1e-6)
        assert abs(start - center) == pytest.approx(radius, abs=1e-6)
    solid = meter.solids(parts=["housing"])["housing"]
    assert solid.top - solid.bottom == pytest.approx(20.1)


def test_a_negative_gap_is_refused_by_its_key():
    with pytest.raises(ct.DesignError, match=r"housing\.gap"):
        ct.GearPair(ct.pitch.circle(module=2, tooth_count=20), housing_gap=-1)
