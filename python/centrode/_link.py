from dataclasses import dataclass
from typing import Literal

from numpy import float64, uint32
from numpy.typing import NDArray

from ._solid import Solid


@dataclass(frozen=True, slots=True)
class Joint:
    """Joint between a link and the link that carries it."""

    __module__ = "centrode"

    name: str
    """Name, the same as in the simulator models."""
    kind: Literal["fixed", "turning", "sliding"]
    """Kind of motion."""
    parent: str
    """Name of the link that carries."""
    origin: tuple[float, float, float]
    """Origin of the carried link in the frame of the carrying link at the coordinate zero, mm."""
    turn: tuple[float, float, float]
    """Rotation of the carried link's frame at the coordinate zero about x, then y, then z of the carrying link, rad."""
    axis: tuple[float, float, float]
    """Unit vector of the axis, in the frame of the carried link."""
    range: tuple[float, float] | None
    """Minimum and maximum coordinate of a sliding joint, mm; None for other joints."""


@dataclass(frozen=True, slots=True, eq=False)
class Mounted:
    """A shaft, pin, ring or key mounted on a link."""

    __module__ = "centrode"

    name: str
    """Name of its body; for a part to be made, also the name of its files."""
    frame: NDArray[float64]
    """Its frame in the frame of the link, a (4, 4) matrix, mm."""
    solids: tuple[Solid, ...]
    """Straight extrusions of its body, in its own frame; empty for a turned part."""
    step: bytes | None
    """STEP file of a turned part, in its own frame; None for an extrusion."""


@dataclass(frozen=True, slots=True, eq=False)
class Link:
    """A rigid body of a machine, with the joint that carries it."""

    __module__ = "centrode"

    name: str
    """Name, as in `Mechanism.frames`."""
    joint: Joint | None
    """The joint that carries it; None for a fixed link."""
    part: str
    """Part that is its body, by the name of its files; empty if no single part is."""
    solids: tuple[Solid, ...]
    """Straight extrusions of its body, in its frame; empty if there are none."""
    mesh: tuple[NDArray[float64], NDArray[uint32]] | None
    """Vertices and triangles of a body with plane faces that is no extrusion, as in `Gear.mesh`; None for others."""
    mounted: tuple[Mounted, ...]
    """Its shafts and pins, with their rings and keys."""
