from dataclasses import dataclass
from typing import Literal

from numpy import float64, uint32
from numpy.typing import NDArray

from ._solid import Solid


@dataclass(frozen=True, slots=True)
class Joint:
    """How a link is carried by another one."""

    __module__ = "centrode"

    name: str
    """Name, as in the simulator models."""
    kind: Literal["fixed", "turning", "sliding"]
    """How it moves."""
    parent: str
    """Link that carries."""
    origin: tuple[float, float, float]
    """Position of the carried link's origin in the frame of the one that carries, where the coordinate is zero, mm."""
    turn: tuple[float, float, float]
    """Turn of the carried link's frame there about x, then y, then z of the one that carries, rad."""
    axis: tuple[float, float, float]
    """Unit vector of the axis, in the frame of the carried link."""
    range: tuple[float, float] | None
    """Minimum and maximum coordinate of a sliding joint, mm; None for the others."""


@dataclass(frozen=True, slots=True, eq=False)
class Mounted:
    """A shaft, pin, ring or key mounted on a link."""

    __module__ = "centrode"

    name: str
    """Name of its body; that of its files where it is made."""
    frame: NDArray[float64]
    """Its frame in that of the link, a (4, 4) matrix, mm."""
    solids: tuple[Solid, ...]
    """Straight extrusions of its body, in its own frame; empty for a turned part."""
    step: bytes | None
    """STEP file of a turned part, in its own frame; None for an extrusion."""


@dataclass(frozen=True, slots=True, eq=False)
class Link:
    """A rigid body of a machine, with the joint that carries it."""

    __module__ = "centrode"

    name: str
    """Name, as `Mechanism.frames` has it."""
    joint: Joint | None
    """The joint that carries it; None for a fixed link."""
    part: str
    """Part whose body it has, by the name of its files; empty where no single part is it."""
    solids: tuple[Solid, ...]
    """Straight extrusions of its body, in its frame; empty where there are none."""
    mesh: tuple[NDArray[float64], NDArray[uint32]] | None
    """Vertices and triangles of a body of plane faces that is no extrusion, as of `Gear.mesh`; None for others."""
    mounted: tuple[Mounted, ...]
    """Its shafts and pins with their rings and keys."""
