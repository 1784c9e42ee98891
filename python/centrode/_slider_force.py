from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True, eq=False)
class SliderForce:
    """Forces on the slider of a spiral shaft; each is a number or an array, like the given shaft angles."""

    __module__ = "centrode"

    normal: float | NDArray[np.float64]
    """Normal force of the wall of the groove, N."""
    transverse: float | NDArray[np.float64]
    """Circumferential force taken by the sleeve, N; positive if it resists the rotation of the shaft."""
    torque: float | NDArray[np.float64]
    """Torque on the shaft, N mm; positive if the shaft drives."""
    push: float | NDArray[np.float64]
    """Force of the groove on the box along its path, N; negative if the groove brakes the box."""
