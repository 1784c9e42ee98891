"""Non-circular gears: from the pitch curve to a proved gear pair, cutting files, solids and simulator models.

Lengths are in millimetres, angles in radians, counter-clockwise positive. If something cannot be made, `Error` is
raised.

>>> import centrode as ct
>>> pitch = ct.pitch.ellipse(eccentricity=0.25, module=2.25, tooth_count=23)
>>> pair = ct.GearPair(pitch, backlash=0.05)
>>> pair.check().ok
True
"""

from . import build123d, cadquery, cam, mujoco, pitch, plot
from ._axes import AxisMap, SplitFigures
from ._centrode import (
    Body,
    BoxDrive,
    DiscCam,
    DrawingSpec,
    Feeder,
    Gear,
    GearDrive,
    GearPair,
    Keyway,
    Machine,
    Mechanism,
    MovingBox,
    Pitch,
    Rack,
    Reversed,
    Shaper,
    SixBar,
    SpiralShaft,
    ThreeArm,
    __version__,
    gear_drive,
    reverse,
    reverse_poses,
    template,
)
from ._clearance import Clearance
from ._contact import Contact
from ._design import load, schema
from ._drawn import drawn_path
from ._error import (
    CamError,
    DesignError,
    Error,
    ExportError,
    GearPairError,
    InternalError,
    LinkageError,
    MechanismError,
    PitchError,
)
from ._forces import Forces
from ._goal import Goal
from ._link import Joint, Link, Mounted
from ._optimised import Optimised
from ._over_pins import OverPins
from ._part import Part
from ._remedy import PairRemedy
from ._report import Finding, FlankPlace, Place, Report, Table
from ._sheet import Drawing, Sheets
from ._six_bar import DeadCenters
from ._slider_force import SliderForce
from ._solid import Edge, Opening, Solid
from ._sweep import sweep
from ._tooth import Tooth, ToothSide

__all__ = [
    "AxisMap",
    "Body",
    "BoxDrive",
    "CamError",
    "Clearance",
    "Contact",
    "DeadCenters",
    "DesignError",
    "DiscCam",
    "Drawing",
    "DrawingSpec",
    "Edge",
    "Error",
    "ExportError",
    "Feeder",
    "Finding",
    "FlankPlace",
    "Forces",
    "Gear",
    "GearDrive",
    "GearPair",
    "GearPairError",
    "Goal",
    "InternalError",
    "Joint",
    "Keyway",
    "Link",
    "LinkageError",
    "Machine",
    "Mechanism",
    "MechanismError",
    "Mounted",
    "MovingBox",
    "Opening",
    "Optimised",
    "OverPins",
    "PairRemedy",
    "Part",
    "Pitch",
    "PitchError",
    "Place",
    "Rack",
    "Report",
    "Reversed",
    "Shaper",
    "Sheets",
    "SixBar",
    "SliderForce",
    "Solid",
    "SpiralShaft",
    "SplitFigures",
    "Table",
    "ThreeArm",
    "Tooth",
    "ToothSide",
    "__version__",
    "build123d",
    "cadquery",
    "cam",
    "drawn_path",
    "gear_drive",
    "load",
    "mujoco",
    "pitch",
    "plot",
    "reverse",
    "reverse_poses",
    "schema",
    "sweep",
    "template",
]
