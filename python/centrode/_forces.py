from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ._slider_force import SliderForce


@dataclass(frozen=True, slots=True, eq=False)
class Forces:
    """Forces of a machine at inputs: numbers or arrays of the shape of the inputs, forces with their components last.

    Components are along the axes of the first link: x and y for a machine in a plane, x, y and z for one in space.
    Joints have names of their own, as "crank_joint", and meshes those of their two links, as "driver-driven"; of a
    `Machine`, joints are named after the bodies that they carry and meshes after those that they move, as in its
    design: "crank", "wheel".
    """

    __module__ = "centrode"

    input: float | NDArray[np.float64]
    """Torque the input needs, N mm; positive where it drives."""
    drives: dict[str, float | NDArray[np.float64]]
    """Torque (N mm) or force (N) of what moves each joint; zero where teeth, a pin or a roller do."""
    joints: dict[str, NDArray[np.float64]]
    """Force on the link that a joint carries, N, without the drive of a slide."""
    closures: dict[str, NDArray[np.float64]]
    """Force on the second link of a pin that closes a loop, N; by the two links, as "coupler-rocker"."""
    contacts: dict[str, NDArray[np.float64]]
    """Force on the second link of a contact, N: on the roller of a cam, the pin in a slot."""
    meshes: dict[str, float | NDArray[np.float64]]
    """Force along the flanks' normal, N; positive where it turns the driven one counter-clockwise."""
    guides: dict[str, SliderForce]
    """Forces of a groove on what it moves, by that joint."""
    undetermined: tuple[str, ...]
    """Joints and meshes that pass a force with only its work known."""
