from dataclasses import dataclass

from numpy import bool_, float64
from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class AxisMap:
    """Possible axes of a carrier over a grid; arrays have a row for each y and a column for each x."""

    __module__ = "centrode"

    x: NDArray[float64]
    """Columns, mm."""
    y: NDArray[float64]
    """Rows, mm."""
    possible: NDArray[bool_]
    """Whether the axis is possible."""
    fault: tuple[tuple[str | None, ...], ...]
    """Why not: "extremes", "circle", "on-axis", "winding", "carrier-turns-back" or "arm-stops"; None where it is."""
    carrier: NDArray[float64]
    """Length of the carrier, mm; NaN where the axis is not possible, as in the arrays that follow."""
    arm: NDArray[float64]
    """Length of the arm, mm."""
    least_ratio: NDArray[float64]
    """Least ratio of the total law."""
    greatest_ratio: NDArray[float64]
    """Greatest ratio."""
    shaft_distance: NDArray[float64]
    """Least distance of the tip from the axis, mm."""
