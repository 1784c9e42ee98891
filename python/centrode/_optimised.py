from dataclasses import dataclass
from typing import TYPE_CHECKING, Generic, TypeVar

from ._goal import Goal

if TYPE_CHECKING:
    from . import Mechanism


M = TypeVar("M", bound="Mechanism", covariant=True)


@dataclass(frozen=True, slots=True)
class Optimised(Generic[M]):
    """What a search for a better design has come to."""

    __module__ = "centrode"

    mechanism: M
    """The best found."""
    goals: tuple[Goal, ...]
    """Its goals, and with number 0 the other limits."""
    steps: tuple[str, ...]
    """What a guided search moved, for which goal, and why; empty for another."""
    evaluations: int
    """Points evaluated."""
    ended: str
    """"target", "evaluations", "stopped" or "stuck"."""
    history: tuple[tuple[int, float, float], ...]
    """Evaluations, violation and objective of the best after each generation, or after each guided step."""
    remark: str | None
    """Why no better one can be had, or why it says little; None where there is nothing to say."""

    @property
    def reached(self) -> bool:
        """Whether every goal is reached."""
        return all(goal.met for goal in self.goals)
