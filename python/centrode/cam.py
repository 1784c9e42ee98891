"""Motion laws, followers, forks and segments of motion for `DiscCam`, by the keys they have in a design file.

Angles are radians of cam angle; a lift is millimetres of a slide, a swing radians of an arm.
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
