"""Pitch curves, each by the keys it has in a design file (angles in radians)."""

from ._centrode import (
    bezier,
    bspline,
    circle,
    eccentric_circle,
    ellipse,
    from_ratio,
    from_transmission,
    limacon,
    lobed_ellipse,
    polar,
)

__all__ = [
    "bezier",
    "bspline",
    "circle",
    "eccentric_circle",
    "ellipse",
    "from_ratio",
    "from_transmission",
    "limacon",
    "lobed_ellipse",
    "polar",
]
