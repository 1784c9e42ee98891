from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Part:
    """A part to make or buy: a line of the parts list."""

    __module__ = "centrode"

    name: str
    """Name."""
    quantity: int
    """Number of pieces in a machine."""
    links: tuple[str, ...]
    """Link of each piece, named as in `Mechanism.frames`."""
    material: str
    """Material; empty if the design gives none."""
    mass: float | None
    """Mass of one piece, kg; None if it is not known."""
    file: str
    """First part of the names of its drawings, sheets and solids; empty for a part without files."""
    remark: str
    """Remark."""

    def __str__(self) -> str:
        """Quantity, name and remark."""
        return f"{self.quantity} x {self.name}" + (f", {self.remark}" if self.remark else "")
