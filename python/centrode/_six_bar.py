from dataclasses import dataclass


@dataclass(frozen=True)
class DeadCenters:
    """Where crank and coupler lie in one line, and the rocker turns back."""

    __module__ = "centrode"

    stretched: float
    """Crank angle with crank and coupler stretched out, in [0, 2 pi), rad."""
    folded: float
    """Crank angle with the crank folded onto the coupler, in [0, 2 pi), rad."""
    stretched_at: tuple[float, float]
    """The slider, stretched out, mm."""
    folded_at: tuple[float, float]
    """The slider, folded, mm."""
