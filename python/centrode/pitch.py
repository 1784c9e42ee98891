"""Pitch curves, each with its keys of a design file (angles in radians).

A curve with `module` and `tooth_count` has the length pi * module * tooth_count.
"""

from ._centrode import (
    bezier,
    bspline,
    circle,
    conjugate,
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
    "conjugate",
    "eccentric_circle",
    "ellipse",
    "from_ratio",
    "from_transmission",
    "limacon",
    "lobed_ellipse",
    "polar",
]
