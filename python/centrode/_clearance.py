from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Clearance:
    """Minimum clearance of two arms over a whole turn of the carrier."""

    __module__ = "centrode"

    minimum: float
    """Minimum distance found, mm; negative if the arms overlap: the depth of penetration."""
    lower_bound: float
    """Proven lower bound of the clearance over the turn, mm."""
    input: float
    """Carrier angle at the minimum, rad."""
    arms: tuple[int, int]
    """The two arms."""
