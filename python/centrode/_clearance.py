from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Clearance:
    """How close two arms come over a whole turn of the carrier."""

    __module__ = "centrode"

    minimum: float
    """Minimum distance found, mm; negative where they overlap: how deep one lies in the other."""
    lower_bound: float
    """The clearance is proven to be nowhere smaller, mm."""
    input: float
    """Carrier turn of the minimum, rad."""
    arms: tuple[int, int]
    """The two arms."""
