"""Motion laws, followers, forks and motion segments for `DiscCam`, with the keys of a design file.

Cam angles are in radians. A lift of a slide is in millimetres, a swing of an arm in radians.
"""

from ._centrode import (
    Follower,
    Fork,
    Law,
    Segment,
    dwell,
    law,
    polynomial,
    return_,
    rise,
    swinging_flat,
    swinging_roller,
    transition,
    translating_flat,
    translating_roller,
)

__all__ = [
    "Follower",
    "Fork",
    "Law",
    "Segment",
    "dwell",
    "law",
    "polynomial",
    "return_",
    "rise",
    "swinging_flat",
    "swinging_roller",
    "transition",
    "translating_flat",
    "translating_roller",
]
