from dataclasses import dataclass

from numpy import float64, uint32
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True, eq=False)
class Contact:
    """The contact of a pair over its cycle, one value per input; made by `GearPair.contact`.

    Errors and backlash are infinite where the gears have lost contact.
    """

    __module__ = "centrode"

    input: NDArray[float64]
    """Driver angle, rad."""
    law: NDArray[float64]
    """Driven angle required by the pitch curves, rad."""
    driven_angle: NDArray[float64]
    """Driven angle when the driver pushes forward, rad; infinite without contact."""
    reverse_driven_angle: NDArray[float64]
    """Driven angle when the driver pushes back, rad."""
    transmission_error: NDArray[float64]
    """Transmission error when the driver pushes forward: driven angle minus law and designed half backlash, rad."""
    reverse_transmission_error: NDArray[float64]
    """Transmission error when the driver pushes back, rad."""
    backlash: NDArray[float64]
    """Angle by which the driven gear can turn between its flanks with the driver fixed, rad."""
    normal_backlash: NDArray[float64]
    """Backlash times the distance of the driven axis from the line of action, `r2 cos(alpha)` (ISO 21771), mm."""
    contacts: NDArray[uint32]
    """Number of tooth pairs in contact when the driver pushes forward."""
    penetration: NDArray[float64]
    """Maximum penetration of the two outlines with the driven gear in contact, mm."""
    clearance: NDArray[float64]
    """Minimum distance of a tip from a root, mm; infinite if none is near."""
    fillet_clearance: NDArray[float64]
    """Minimum distance of the mating gear from a fillet, mm; infinite if none is near."""
    sliding: NDArray[float64]
    """Maximum sliding speed per driver speed of the teeth in contact when the driver pushes forward, mm/rad."""

    def __len__(self) -> int:
        """Number of inputs."""
        return len(self.input)

    def __repr__(self) -> str:
        """Number of inputs, without the arrays."""
        return f"Contact({len(self)} inputs)"
