from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ._slider_force import SliderForce


@dataclass(frozen=True, slots=True, eq=False)
class Forces:
    """Forces of a machine at inputs.

    Values are numbers, or arrays of the shape of the inputs; for forces the last axis has the components. Components
    are along the axes of the first link: x and y for a planar machine, x, y and z for a machine in space.

    Joints have their own names, such as "crank_joint"; meshes are named after their two links, such as
    "driver-driven". In a `Machine`, a joint is named after the body that it carries, and a mesh after the body that it
    moves, as in the design: "crank", "wheel".
    """

    __module__ = "centrode"

    input: float | NDArray[np.float64]
    """Torque required at the input, N mm; positive if the input drives."""
    drives: dict[str, float | NDArray[np.float64]]
    """Torque (N mm) or force (N) of the drive of each joint; zero if teeth, a pin or a roller move it."""
    joints: dict[str, NDArray[np.float64]]
    """Force on the link that a joint carries, N, without the driving force of a slide."""
    closures: dict[str, NDArray[np.float64]]
    """Force on the second link of a pin that closes a loop, N; named after both links, such as "coupler-rocker"."""
    contacts: dict[str, NDArray[np.float64]]
    """Force on the second link of a contact, N: on the roller of a cam, or on the pin in a slot."""
    meshes: dict[str, float | NDArray[np.float64]]
    """Force along the normal of the flanks, N; positive if it turns the driven gear counter-clockwise."""
    guides: dict[str, SliderForce]
    """Forces of a groove on its slider, by the joint of the moved link."""
    undetermined: tuple[str, ...]
    """Joints and meshes whose force is statically undetermined: only its work is known."""
