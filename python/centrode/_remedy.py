from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

if TYPE_CHECKING:
    from ._centrode import GearPair


@dataclass(frozen=True, slots=True)
class PairRemedy:
    """Teeth whose flanks alone transmit the motion of a pair."""

    __module__ = "centrode"

    addendum: Literal["full", "fitted"]
    """Height of the teeth."""
    fit: tuple[Literal["thickness_split", "pressure_angle", "phase"], ...]
    """Other optimised parameters; the pair contains their values."""
    minimum_tooth_count: int
    """Tooth count of the driver with which they do, but with one step less do not; a larger count may fail again."""
    pair: GearPair
    """The pair with such teeth; it has its original tooth count if that is enough."""
