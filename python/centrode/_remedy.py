from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

if TYPE_CHECKING:
    from ._centrode import GearPair


@dataclass(frozen=True, slots=True)
class PairRemedy:
    """Teeth that carry the motion of a pair by their flanks alone."""

    __module__ = "centrode"

    addendum: Literal["full", "fitted"]
    """Height of the teeth."""
    fit: tuple[Literal["thickness_split", "pressure_angle", "phase"], ...]
    """What was chosen next to it, and is written in the pair."""
    minimum_tooth_count: int
    """Tooth count of the driver at which they do, and with one step fewer do not; a greater one may fail again."""
    pair: GearPair
    """The pair with such teeth, as many as it had where those are enough."""
