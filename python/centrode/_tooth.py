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
    """How much lower the tip corner is than requested: pitch curve or tool allow no more flank."""
    form_depth: float
    """Depth below the pitch curve that the tool's straight flank reaches."""
    active_depth: float
    """Arc length of roll below the crossing down to which the flank is needed."""
    undercut: float
    """Length of needed flank lost to undercut, in arc length of roll; zero for a sound tooth."""
    active: tuple[float, float] | None
    """Arc lengths of roll between which flank is left; None when nothing is."""
    fillet_radius: float
    """Minimum radius of curvature of the fillet."""


@dataclass(frozen=True, slots=True)
class Tooth:
    """A finished tooth; numbered in the order the teeth mesh."""

    __module__ = "centrode"

    number: int
    """From zero."""
    leading: ToothSide
    """Side with the flank reached first."""
    trailing: ToothSide
    """Side with the flank reached last."""
    tip_width: float
    """Width of the top land, mm; zero for a pointed or missing tooth."""
    cut_through: bool
    """True when undercut from both sides has cut the tooth off."""
