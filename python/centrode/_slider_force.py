from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True, eq=False)
class SliderForce:
    """Forces on the slider of a spiral shaft; each a number or an array, as the shaft angles were given."""

    __module__ = "centrode"

    normal: float | NDArray[np.float64]
    """Normal force of the groove's wall, N."""
    transverse: float | NDArray[np.float64]
    """Force round the shaft that the sleeve takes, N; positive where it resists the shaft."""
    torque: float | NDArray[np.float64]
    """Torque on the shaft, N mm; positive where the shaft drives."""
    push: float | NDArray[np.float64]
    """Push the groove gives the box along its path, N; negative where it holds the box back."""
