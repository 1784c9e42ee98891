"""Pitch curves that reach into each other away from the point at which they roll, next to polygons."""

import centrode as ct
import numpy as np
import pytest
import shapely
from shapely import affinity

DESIGN = """family = "gear-pair"
[pitch]
kind = "ratio"
expression = "{}"
module = 1
tooth_count = 60
[teeth]
addendum = "fitted"
"""
LAWS = {
    "1 + 0.563*cos(5*phi) + 0.179*cos(phi + 4.94)": True,
    "1 + 0.554*cos(6*phi)": True,
    "1 + 0.539*cos(5*phi) + 0.118*cos(2*phi + 6.04)": True,
    "1 + 0.515*cos(5*phi) + 0.038*cos(3*phi + 3.69)": False,
    "1 + 0.3*cos(5*phi)": False,
    "1 + 0.4*cos(phi)": False,
}


def overlaps(pair):
    """Maximum area that the pitch curves share, and radial depth of a driven curve's point in the driver's."""
    a, cycle = pair.center_distance, np.linspace(0, 2 * np.pi, 2000, endpoint=False)
    ratio = np.asarray(pair.ratio(cycle))
    radius, driven = a * ratio / (1 + ratio), np.asarray(pair.driven_angle(cycle))
    one = shapely.Polygon(np.c_[radius * np.cos(cycle), radius * np.sin(cycle)])
    points = np.c_[(radius - a) * np.cos(driven), (a - radius) * np.sin(driven)]
    two = shapely.Polygon(points)
    areas, depths = [], []
    for phi, psi in zip(cycle[::5], driven[::5], strict=True):
        turned = affinity.rotate(one, -phi, origin=(0, 0), use_radians=True)
        placed = affinity.translate(affinity.rotate(two, psi, origin=(0, 0), use_radians=True), a, 0)
        areas.append(turned.intersection(placed).area)
        x = points[:, 0] * np.cos(psi) - points[:, 1] * np.sin(psi) + a
        y = points[:, 0] * np.sin(psi) + points[:, 1] * np.cos(psi)
        here = np.interp(phi + np.arctan2(y, x), cycle, radius, period=2 * np.pi)
        depths.append((here - np.hypot(x, y)).max())
    return max(areas), max(depths)


@pytest.mark.parametrize(("law", "overlap"), LAWS.items())
def test_curves_that_reach_into_each_other_are_told_and_no_others(law, overlap):
    pair = ct.GearPair.from_toml(DESIGN.format(law))
    found = [finding for finding in pair.check().findings if finding.rule == "pitch-curves-overlap"]
    area, depth = overlaps(pair)
    assert (area > 1e-3) == overlap
    assert bool(found) == overlap
    if overlap:
        assert found[0].measured == pytest.approx(depth, rel=2e-3)
        # Sampled depths do not reach beyond the true maximum.
        assert found[0].measured > depth - 1e-4
        assert not pair.remedies()
