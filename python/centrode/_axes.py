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
    """Reason or None: "extremes", "circle", "on-axis", "winding", "carrier-turns-back", "arm-stops", "too-far"."""
    carrier: NDArray[float64]
    """Length of the carrier, mm; NaN where the axis is not possible, as in the arrays that follow."""
    arm: NDArray[float64]
    """Length of the arm, mm."""
    ratios: NDArray[float64]
    """Minimum and maximum ratio of the total law along the last axis of the array."""
    minimum_radius: NDArray[float64]
    """Minimum convex radius of the four pitch curves by powers, mm, mostly within 5 % of the gears as they are written.

    Up to 40 % more where the law has a narrow peak. Of a path of more than 64 pieces 64 are sampled.
    """
    shaft_distance: NDArray[float64]
    """Minimum distance of the tip from the axis, mm."""


@dataclass(frozen=True)
class SplitFigures:
    """Figures of the gears of a split: a pair that occurs twice, or two pairs, the sun's first."""

    __module__ = "centrode"

    name: str
    """Word for the split: "powers", "mildest" or "one-pair"."""
    minimum_radii: tuple[tuple[float, float], ...]
    """Minimum convex radii of driver and driven gear of each pair, mm; none where there is no split."""
    convex: tuple[tuple[bool, bool], ...]
    """Whether driver and driven gear of each pair are convex all round."""
    tip_error: float
    """Maximum distance of the tip from the path, mm, with laws in tables; NaN where there is no split."""
    refusal: str | None
    """Why the motion cannot be split so; None where it can."""

    @property
    def minimum_radius(self) -> float:
        """The minimum of all minimum radii, mm; NaN where there is no split."""
        return min((radius for pair in self.minimum_radii for radius in pair), default=float("nan"))
