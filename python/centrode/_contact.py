from dataclasses import dataclass

from numpy import float64, uint32
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True, eq=False)
class Contact:
    """The contact of a pair along its cycle, one value an input; made by `GearPair.contact`.

    Where nothing is near enough to drive, the mesh has come apart: errors and backlash are infinite.
    """

    __module__ = "centrode"

    input: NDArray[float64]
    """Driver angle, rad."""
    law: NDArray[float64]
    """Driven angle the pitch curves require, rad."""
    driven_angle: NDArray[float64]
    """Driven angle when the driver pushes it on, rad; infinite where nothing does."""
    reverse_driven_angle: NDArray[float64]
    """Driven angle when the driver pushes it back, rad."""
    transmission_error: NDArray[float64]
    """Driven angle when the driver pushes it on, less the law and the designed half backlash, rad."""
    reverse_transmission_error: NDArray[float64]
    """The same with the driver pushing it back."""
    backlash: NDArray[float64]
    """Turn of the driven gear between the flanks that push it on and back, the driver held, rad."""
    normal_backlash: NDArray[float64]
    """Backlash times the distance of the driven axis from the line of action, `r2 cos(alpha)` (ISO 21771), mm."""
    contacts: NDArray[uint32]
    """Pairs of teeth in contact when the driver pushes the driven gear on."""
    penetration: NDArray[float64]
    """Deepest penetration of the two outlines with the driven gear seated, mm."""
    clearance: NDArray[float64]
    """Minimum distance of a tip from a root, mm; infinite where none is near."""
    fillet_clearance: NDArray[float64]
    """Minimum distance of anything from a fillet, mm; infinite where nothing is near."""
    sliding: NDArray[float64]
    """Maximum sliding speed of the teeth in contact per driver speed, pushed forward, mm/rad."""

    def __len__(self) -> int:
        """Give the number of inputs."""
        return len(self.input)

    def __repr__(self) -> str:
        """Name the number of inputs; the arrays are long."""
        return f"Contact({len(self)} inputs)"
