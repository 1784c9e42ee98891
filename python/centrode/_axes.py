from dataclasses import dataclass

from numpy import bool_, float64
from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class AxisMap:
    """Possible axes of a carrier on a grid. Arrays have a row for each y and a column for each x."""

    __module__ = "centrode"

    x: NDArray[float64]
    """x of each column, mm."""
    y: NDArray[float64]
    """y of each row, mm."""
    possible: NDArray[bool_]
    """Whether the axis is possible."""
    fault: tuple[tuple[str | None, ...], ...]
    """Reason why the axis is not possible, or None.

    "extremes", "circle", "on-axis", "winding", "carrier-turns-back", "arm-stops" or "too-far".
    """
    carrier: NDArray[float64]
    """Length of the carrier, mm. It and the following arrays are NaN where the axis is not possible."""
    arm: NDArray[float64]
    """Length of the arm, mm."""
    ratios: NDArray[float64]
    """Minimum and maximum ratio of the total law, along the last axis of the array."""
    minimum_radius: NDArray[float64]
    """Estimated minimum convex radius of the four pitch curves, split by powers, mm.

    Mostly within 5 % of the value for the gears as written; up to 40 % larger where the law has a narrow peak.
    For a path of more than 64 pieces, 64 of them are sampled.
    """
    shaft_distance: NDArray[float64]
    """Minimum distance of the tip from the axis, mm."""


@dataclass(frozen=True)
class SplitFigures:
    """Figures of the gears of a split: one pair that is used twice, or two pairs, the pair with the sun first."""

    __module__ = "centrode"

    name: str
    """Name of the split: "powers", "mildest" or "one-pair"."""
    minimum_radii: tuple[tuple[float, float], ...]
    """Minimum convex radii of driver and driven gear of each pair, mm; empty if the split is not possible."""
    convex: tuple[tuple[bool, bool], ...]
    """Whether driver and driven gear of each pair are convex everywhere."""
    tip_error: float
    """Maximum distance of the tip from the path, mm, with the laws as tables; NaN if the split is not possible."""
    refusal: str | None
    """Reason why this split is not possible; None if it is possible."""

    @property
    def minimum_radius(self) -> float:
        """Minimum of all these radii, mm; NaN if the split is not possible."""
        return min((radius for pair in self.minimum_radii for radius in pair), default=float("nan"))
