from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Part:
    """A part that a shop makes or buys: a line of the parts list."""

    __module__ = "centrode"

    name: str
    """Name."""
    quantity: int
    """Number of pieces in a machine."""
    links: tuple[str, ...]
    """Links that the pieces belong to, as `Mechanism.frames` names them: one for each piece."""
    material: str
    """Material; empty where the design says nothing of it."""
    mass: float | None
    """Mass of one piece, kg; None where it is not known."""
    file: str
    """Name that its drawings, sheets and solids begin with; empty for a part without files."""
    remark: str
    """Remark."""

    def __str__(self) -> str:
        """Quantity, name and remark."""
        return f"{self.quantity} x {self.name}" + (f", {self.remark}" if self.remark else "")
