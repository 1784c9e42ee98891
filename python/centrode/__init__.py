"""Non-circular gears: pitch curve to proved pair, cutting file, solid and simulator model.

Lengths are millimetres, angles radians, counter-clockwise positive.
"""

from . import pitch
from ._centrode import DesignError, Error, Pitch, PitchError, __version__

__all__ = ["DesignError", "Error", "Pitch", "PitchError", "__version__", "pitch"]
