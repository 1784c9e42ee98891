from dataclasses import dataclass

from numpy import float64, int64
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True, eq=False)
class OverPins:
    """A measuring pin laid into every space of a gear; space k lies after tooth k in the order the teeth mesh.

    Where a space cannot be measured with this pin its numbers are NaN, its partner -1, and its fault says why.
    """

    __module__ = "centrode"

    diameter: float
    """Diameter of the pin, mm."""
    center: NDArray[float64]
    """Centers of the pins in the gear's own frame, (N, 2), mm."""
    contacts: NDArray[float64]
    """Where each pin touches the two flanks, (N, 2, 2), mm."""
    radial: NDArray[float64]
    """Measure from the gear's axis to the far side of each pin, (N,), mm."""
    partner: NDArray[int64]
    """The space whose pin lies most nearly opposite, (N,)."""
    across: NDArray[float64]
    """Measure over the pin and its partner, (N,), mm."""
    faults: tuple[str | None, ...]
    """Why a space cannot be measured; None where it can."""
