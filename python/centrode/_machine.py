"""Data of machines for the adapters: parts by name, links with bodies, and coordinates of joints in a pose."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from ._centrode import DiscCam, Gear, Mechanism
from ._error import DesignError, Error
from ._part import Part

if TYPE_CHECKING:
    from numpy import float64
    from numpy.typing import NDArray

    from ._link import Joint, Link
    from ._solid import Solid

WHOLE = "assembly"
"""Name of the file of the whole machine."""

LEAST = 1e-6
"""Shortest edge that CAD kernels accept, mm: they treat points nearer than a tenth of it as one point."""

COLORS = ("#3b6ea5", "#c98a2b", "#5b8c5a", "#8c5a7a", "#6b7a8f", "#a5523b", "#3f8f8b", "#9a8b3f")
"""Colors of links, one after the other."""


def machine(of: Any) -> Mechanism:
    """Return the machine; raise an error for any other object."""
    if not isinstance(of, Mechanism):
        raise TypeError(f"must be a machine, such as a GearPair or the result of load, not {type(of).__name__}")
    return of


def angle(phi: float) -> float:
    """Return the input as a float; raise an error if it is not finite."""
    if not math.isfinite(phi):
        raise DesignError(f"phi must be a finite number, not {phi}", "phi")
    return float(phi)


def shortest(tolerance: float) -> float:
    """Return the tolerance; raise an error if it is too fine for CAD kernels."""
    if not tolerance >= LEAST or math.isinf(tolerance):
        raise DesignError(
            f"tolerance must be at least {LEAST:g} mm, because CAD kernels accept no shorter edges, not {tolerance:g}",
            "tolerance",
        )
    return float(tolerance)


def body(of: Gear | DiscCam | Mechanism, name: str | Part | None, tolerance: float) -> tuple[str, Solid | bytes]:
    """Return the label of a part with its exact edges, or with its STEP file if it is not a straight extrusion."""
    least = shortest(tolerance)
    if isinstance(of, Gear):
        return of.member, of.solid(least)
    if isinstance(of, DiscCam):
        return of.name, of.solid(least)
    if not isinstance(of, Mechanism):
        raise TypeError(f"must be a gear, a disc cam or a machine, not {type(of).__name__}")
    wanted = name.file if isinstance(name, Part) else name
    if wanted and wanted != WHOLE:
        try:
            for label, solid in of.solids(parts=[wanted], tolerance=least).items():
                return label, solid
            for file, contents in of.files(formats=["step"], parts=[wanted]).items():
                return file.removesuffix(".step"), contents
        except Error:
            # Its own message would not name the parts with a solid.
            pass
    files = (file.removesuffix(".step") for file in of.files(formats=["step"]))
    known = ", ".join(file for file in files if file != WHOLE)
    what = "omitted" if wanted is None else repr(wanted)
    raise DesignError(f"name must be a part with a solid, one of {known}, not {what}", "name")


def start(joint: Joint) -> NDArray[float64]:
    """Frame of a carried link in that of the link that carries it, where the coordinate is zero."""
    x, y, z = (_rotation(axis, angle) for axis, angle in zip(np.eye(3), joint.turn, strict=True))
    frame = np.eye(4)
    frame[:3, :3] = z @ y @ x
    frame[:3, 3] = joint.origin
    return frame


def starts(links: tuple[Link, ...]) -> dict[str, NDArray[float64]]:
    """Frames of all links in that of the first where every coordinate is zero."""
    frames: dict[str, NDArray[float64]] = {}
    for link in links:
        frames[link.name] = np.eye(4) if link.joint is None else frames[link.joint.parent] @ start(link.joint)
    return frames


def coordinate(joint: Joint, frames: dict[str, NDArray[float64]], child: str) -> float:
    """Coordinate of a joint in a pose: rad within half a turn, or mm; zero of one that does not move."""
    axis = np.array(joint.axis)
    moved = np.linalg.inv(frames[joint.parent] @ start(joint)) @ frames[child]
    if joint.kind == "turning":
        spin = moved[[2, 0, 1], [1, 2, 0]] - moved[[1, 2, 0], [2, 0, 1]]
        return math.atan2(axis @ spin, np.trace(moved[:3, :3]) - 1.0)
    return float(axis @ moved[:3, 3]) if joint.kind == "sliding" else 0.0


def _rotation(axis: NDArray[float64], angle: float) -> NDArray[float64]:
    """Turn about an axis, by Rodrigues' formula."""
    x, y, z = axis
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    turned: NDArray[float64] = np.eye(3) + math.sin(angle) * cross + (1.0 - math.cos(angle)) * (cross @ cross)
    return turned
