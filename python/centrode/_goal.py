from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Goal:
    """A goal of a mechanism: a figure and its required range."""

    __module__ = "centrode"

    number: int
    """Number in its list, from one; 0 for an additional constraint of a search."""
    paper: int | None
    """Number in the source paper, if it differs; otherwise None."""
    name: str
    """Short stable name."""
    title: str
    """Short description."""
    value: float | None
    """Figure, in `unit`; None if it was not evaluated."""
    required: tuple[float | None, float | None]
    """Required minimum and maximum of the figure; None for no limit."""
    unit: str
    """"mm", "rad", or empty for a plain number."""
    scale: float
    """Miss at which the progress is one half, in `unit`."""
    margin: float | None
    """Distance of the figure from the nearest end of its range, in `unit`: positive inside, negative outside."""
    progress: float | None
    """1 if the goal is reached; it falls smoothly to 0 as the miss grows."""
    met: bool | None
    """Whether the goal is reached; None if it was not evaluated."""

    def __str__(self) -> str:
        """Number, title, figure and whether it is reached."""
        if self.value is None:
            return f"goal {self.number}: {self.title} not checked"
        figure = f"{self.value:.6g} {self.unit}".rstrip()
        return f"goal {self.number}: {self.title} {figure}, {'met' if self.met else 'missed'}"
