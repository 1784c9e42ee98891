from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy import float64
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True, eq=False)
class Edge:
    """A smooth side of a contour, from its first point to its last."""

    __module__ = "centrode"

    kind: Literal["line", "arc", "spline"]
    """A straight line, an arc of a circle, or a polynomial curve by its Bézier points."""
    points: NDArray[float64]
    """Both end points, or all control points of a spline, (N, 2), mm."""
    center: tuple[float, float] | None
    """Center of an arc, mm; None for other kinds."""
    sweep: float
    """Angle of an arc, rad, counter-clockwise positive; zero for other kinds."""

    @property
    def degree(self) -> int:
        """Degree of a spline; 1 for a line, and 2 for an arc, which is rational."""
        return 2 if self.kind == "arc" else len(self.points) - 1

    @property
    def knots(self) -> NDArray[float64]:
        """Knot vector of a spline, each end repeated as often as its order; empty for other kinds."""
        return np.repeat([0.0, 1.0], len(self.points)) if self.kind == "spline" else np.empty(0)


@dataclass(frozen=True, slots=True, eq=False)
class Opening:
    """A straight opening through a wall of a solid, from its outer contour to a hole."""

    __module__ = "centrode"

    corners: NDArray[float64]
    """Corners seen along z, (4, 2), mm, counter-clockwise: two on the outer contour, then two on the hole."""
    span: tuple[float, float]
    """Lower and upper end along z, mm."""


@dataclass(frozen=True, slots=True, eq=False)
class Solid:
    """A straight extrusion along z with exact edges, for CAD kernels."""

    __module__ = "centrode"

    contours: tuple[tuple[Edge, ...], ...]
    """Closed contours, the outer one first, then the holes; each has the material on its left."""
    bottom: float
    """Lower face, mm."""
    top: float
    """Upper face, mm."""
    opening: Opening | None
    """Opening through a wall; None if there is none."""
    volume: float
    """Volume, mm^3: by Green's theorem on the exact contours."""
