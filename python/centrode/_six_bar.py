from dataclasses import dataclass


@dataclass(frozen=True)
class DeadCenters:
    """Dead centres: crank and coupler are in one line, and the rocker turns back."""

    __module__ = "centrode"

    stretched: float
    """Crank angle with crank and coupler stretched, in [0, 2 pi), rad."""
    folded: float
    """Crank angle with the crank folded onto the coupler, in [0, 2 pi), rad."""
    stretched_at: tuple[float, float]
    """Position of the slider when stretched, mm."""
    folded_at: tuple[float, float]
    """Position of the slider when folded, mm."""
