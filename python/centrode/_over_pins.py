from dataclasses import dataclass

from numpy import float64, int64
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True, eq=False)
class OverPins:
    """Measurement of a gear with a pin in every space; space k is after tooth k in the order in which the teeth mesh.

    If a space cannot be measured with this pin, its numbers are NaN, its partner is -1, and its fault is the reason.
    """

    __module__ = "centrode"

    diameter: float
    """Diameter of the pin, mm."""
    center: NDArray[float64]
    """Centers of the pins in the gear's own frame, (N, 2), mm."""
    contacts: NDArray[float64]
    """Contact points of each pin with the two flanks, (N, 2, 2), mm."""
    radial: NDArray[float64]
    """Distance from the gear's axis to the far side of each pin, (N,), mm."""
    partner: NDArray[int64]
    """Space whose pin is most nearly opposite, (N,)."""
    across: NDArray[float64]
    """Measurement over the pin and its partner, (N,), mm."""
    faults: tuple[str | None, ...]
    """Reason why a space cannot be measured; None if it can."""
