from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class ToothSide:
    """One side of a finished tooth; lengths in mm."""

    __module__ = "centrode"

    crossing: float
    """Arc length where the flank crosses the pitch curve."""
    tip_height: float
    """Height of the tip corner above the pitch curve."""
    tip_shortening: float
    """Required tip height minus actual tip height; positive if pitch curve or tool limit the flank."""
    form_depth: float
    """Depth below the pitch curve to which the straight flank of the tool cuts."""
    active_depth: float
    """Arc length of roll below the crossing to which the flank is required."""
    undercut: float
    """Length of required flank lost to undercut, in arc length of roll; zero for a sound tooth."""
    active: tuple[float, float] | None
    """Arc lengths of roll between which the flank is left; None if no flank is left."""
    fillet_radius: float
    """Minimum radius of curvature of the fillet."""


@dataclass(frozen=True, slots=True)
class Tooth:
    """A finished tooth; teeth are numbered in the order in which they mesh."""

    __module__ = "centrode"

    number: int
    """Number, from zero."""
    leading: ToothSide
    """Side whose flank comes first in the order of mesh."""
    trailing: ToothSide
    """Side whose flank comes last in the order of mesh."""
    tip_width: float
    """Width of the top land, mm; zero for a pointed or missing tooth."""
    cut_through: bool
    """True if undercut from both sides has cut off the tooth."""
