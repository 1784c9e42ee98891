from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Goal:
    """What a mechanism is to reach: a figure and its required range."""

    __module__ = "centrode"

    number: int
    """Number in its list, from one; 0 for a constraint of a search next to the goals."""
    paper: int | None
    """Number in the paper that it is from, where that is another."""
    name: str
    """Short stable name."""
    title: str
    """The goal in a few words."""
    value: float | None
    """The figure, in `unit`; None if it was not evaluated."""
    required: tuple[float | None, float | None]
    """Minimum and maximum of the figure; None where it is open."""
    unit: str
    """"mm", "rad", or empty for a plain number."""
    scale: float
    """Size of a miss that leaves half the progress, in `unit`."""
    margin: float | None
    """Distance of the figure from the nearest end of its range: positive inside, negative outside."""
    progress: float | None
    """1 where the goal is reached, falling smoothly to 0 as the figure goes away from it."""
    met: bool | None
    """Whether it is reached; None if it was not evaluated."""

    def __str__(self) -> str:
        """Number, title, figure and whether it is reached."""
        if self.value is None:
            return f"goal {self.number}: {self.title} not checked"
        figure = f"{self.value:.6g} {self.unit}".rstrip()
        return f"goal {self.number}: {self.title} {figure}, {'met' if self.met else 'missed'}"
