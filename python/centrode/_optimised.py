from dataclasses import dataclass
from typing import TYPE_CHECKING

from ._goal import Goal

if TYPE_CHECKING:
    from . import ThreeArm


@dataclass(frozen=True, slots=True)
class Optimised:
    """What a search for a better design has come to."""

    __module__ = "centrode"

    mechanism: "ThreeArm"
    """The best found."""
    goals: tuple[Goal, ...]
    """Its goals, and with number 0 whatever else was kept."""
    steps: tuple[str, ...]
    """What a guided search moved, for which goal, and why; empty for another."""
    evaluations: int
    """Points looked at."""
    ended: str
    """"target", "evaluations", "stopped" or "stuck"."""

    @property
    def reached(self) -> bool:
        """Whether every goal is reached."""
        return all(goal.met for goal in self.goals)
