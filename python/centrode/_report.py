from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from ._goal import Goal


@dataclass(frozen=True, slots=True)
class FlankPlace:
    """Side of a tooth, and the radius at which its flank ends."""

    __module__ = "centrode"

    tooth: int
    """Tooth number, from zero."""
    side: Literal["leading", "trailing"]
    """The flank that comes first ("leading") or last ("trailing") in the order in which the teeth mesh."""
    radius: float | None
    """Distance from the gear's axis at which the flank ends, mm; None if no flank is left.

    Below it the flank is lost by undercut, or above it no flank can be cut."""


@dataclass(frozen=True, slots=True)
class Place:
    """Position of a finding in the mechanism and its cycle."""

    __module__ = "centrode"

    part: str | None
    """Part, as named in the design."""
    teeth: tuple[int, ...]
    """Tooth numbers, from zero."""
    input: float | None
    """Input angle, rad."""
    flanks: tuple[FlankPlace, ...] = ()
    """Sides of these teeth, if the finding is about flanks."""


@dataclass(frozen=True, slots=True)
class Finding:
    """A problem of a mechanism, with measured and required figure and its position."""

    __module__ = "centrode"

    rule: str
    """Short stable name of the rule."""
    severity: Literal["note", "warning", "error"]
    """Severity; an error means that the part does not fulfil its function."""
    message: str
    """Description in one sentence."""
    measured: float | None
    """Measured figure, in `unit`."""
    required: float | None
    """Required figure, in `unit`."""
    unit: str
    """Unit of both figures, such as "mm" or "rad"; empty for a plain number."""
    remedy: str | None
    """Usual remedy."""
    place: Place
    """Position."""

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
    """Description of the figures."""
    unit: str
    """Unit of every figure, such as "mm" or "rad"; empty for plain numbers."""
    columns: tuple[str, ...]
    """Heading of each column."""
    rows: Mapping[str, tuple[float, ...]]
    """Figures of each row, by the name of the row."""


@dataclass(frozen=True, slots=True)
class Report:
    """All findings and figures of one mechanism; made by `check`."""

    __module__ = "centrode"

    ok: bool
    """True if no finding is an error."""
    findings: tuple[Finding, ...]
    """Findings, the most severe first."""
    values: Mapping[str, float]
    """Figures by name."""
    units: Mapping[str, str]
    """Unit of each figure, such as "mm" or "rad"; empty for a plain number."""
    given: Mapping[str, bool] = field(default_factory=dict)
    """True for a figure that the design gives, False for one that it may give but leaves to the program."""
    goals: tuple[Goal, ...] = ()
    """Goals, if the design has any."""
    tables: tuple[Table, ...] = ()
    """Figures in rows and columns."""

    def __str__(self) -> str:
        """Every figure, goal and finding, one per line."""
        width = max(map(len, self.values), default=0)
        figures = [f"{name:{width}}  {value:.6g} {self.units[name]}".rstrip() for name, value in self.values.items()]
        return "\n".join([*figures, *map(str, self.goals), *map(str, self.findings)])
