from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from ._goal import Goal


@dataclass(frozen=True, slots=True)
class FlankPlace:
    """Side of a tooth, and from where on a finding holds there."""

    __module__ = "centrode"

    tooth: int
    """Tooth number, from zero."""
    side: Literal["leading", "trailing"]
    """The flank reached first, or last, in the order the teeth mesh."""
    radius: float | None
    """Distance from the gear's axis at which the flank ends, mm; None where no flank is left.

    Below it undercut has taken the flank, or above it no more can be cut."""


@dataclass(frozen=True, slots=True)
class Place:
    """Where in the mechanism and its cycle a finding was made."""

    __module__ = "centrode"

    part: str | None
    """Part, as named in the design."""
    teeth: tuple[int, ...]
    """Tooth numbers, from zero."""
    input: float | None
    """Input angle, rad."""
    flanks: tuple[FlankPlace, ...] = ()
    """Sides of these teeth, where the finding is about flanks."""


@dataclass(frozen=True, slots=True)
class Finding:
    """A way in which a mechanism is worse than it should be: measured, required, where."""

    __module__ = "centrode"

    rule: str
    """Short stable name of the rule."""
    severity: Literal["note", "warning", "error"]
    """How much it matters: an error means the part does not do its job."""
    message: str
    """One sentence for a person."""
    measured: float | None
    """The measured figure, in `unit`."""
    required: float | None
    """The figure it is held against, in `unit`."""
    unit: str
    """Unit of both figures, such as "mm" or "rad"; empty for a plain number."""
    remedy: str | None
    """What usually helps."""
    place: Place
    """Where it was found."""

    def __str__(self) -> str:
        """Severity and message."""
        return f"{self.severity}: {self.message}"


@dataclass(frozen=True, slots=True)
class Table:
    """Figures in rows and columns."""

    __module__ = "centrode"

    name: str
    """Short stable name."""
    title: str
    """What the figures are."""
    unit: str
    """Unit of every figure, such as "mm" or "rad"; empty for plain numbers."""
    columns: tuple[str, ...]
    """What each column is of."""
    rows: Mapping[str, tuple[float, ...]]
    """Figures of each row by its name."""


@dataclass(frozen=True, slots=True)
class Report:
    """All findings and figures of one mechanism; made by `check`."""

    __module__ = "centrode"

    ok: bool
    """True when no finding is an error."""
    findings: tuple[Finding, ...]
    """What is wrong or worth knowing, worst first."""
    values: Mapping[str, float]
    """Figures by name."""
    units: Mapping[str, str]
    """Unit of each figure, such as "mm" or "rad"; empty for a plain number."""
    goals: tuple[Goal, ...] = ()
    """What it is to reach, if its design says."""
    tables: tuple[Table, ...] = ()
    """Figures in rows and columns."""

    def __str__(self) -> str:
        """Every figure, every goal and every finding, a line each."""
        width = max(map(len, self.values), default=0)
        figures = [f"{name:{width}}  {value:.6g} {self.units[name]}".rstrip() for name, value in self.values.items()]
        return "\n".join([*figures, *map(str, self.goals), *map(str, self.findings)])
