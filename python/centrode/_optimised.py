from dataclasses import dataclass
from typing import TYPE_CHECKING, Generic, TypeVar

from ._goal import Goal

if TYPE_CHECKING:
    from . import Mechanism


M = TypeVar("M", bound="Mechanism", covariant=True)


@dataclass(frozen=True, slots=True)
class Optimised(Generic[M]):
    """Result of a search for a better design."""

    __module__ = "centrode"

    mechanism: M
    """The best mechanism found."""
    goals: tuple[Goal, ...]
    """Its goals, and, with number 0, the additional constraints."""
    steps: tuple[str, ...]
    """Steps of a guided search: the changed parameters, the goal and the gain; empty for another method."""
    evaluations: int
    """Number of points evaluated."""
    ended: str
    """Reason for the end: "target", "evaluations", "stopped" or "stuck"."""
    history: tuple[tuple[int, float, float], ...]
    """Evaluations, violation and objective of the best point after each generation or each guided step."""
    remark: str | None
    """Why there is no better result, or why the result means little; None if there is no remark."""

    @property
    def reached(self) -> bool:
        """Whether every goal is reached."""
        return all(goal.met for goal in self.goals)
