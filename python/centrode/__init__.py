"""Non-circular gears: pitch curve to proved pair, cutting file, solid and simulator model.

Lengths are millimetres, angles radians, counter-clockwise positive.
"""

from . import pitch
from ._centrode import (
    DesignError,
    Error,
    Gear,
    GearPair,
    GearPairError,
    Pitch,
    PitchError,
    Rack,
    Shaper,
    __version__,
)

__all__ = [
    "DesignError",
    "Error",
    "Gear",
    "GearPair",
    "GearPairError",
    "Pitch",
    "PitchError",
    "Rack",
    "Shaper",
    "__version__",
    "pitch",
]
