from collections.abc import Sequence
from os import PathLike
from pathlib import Path
from typing import Any, ClassVar, Literal, SupportsFloat, SupportsIndex, TypeAlias, final, overload

from numpy import float64, uint32
from numpy.typing import ArrayLike, NDArray

from ._contact import Contact
from ._over_pins import OverPins
from ._report import Report
from ._six_bar import DeadCenters
from ._slider_force import SliderForce
from ._tooth import Tooth

__all__ = [
    "_LARGEST_DESIGN",
    "Body",
    "DiscCam",
    "Drawing",
    "DrawingSpec",
    "Follower",
    "Gear",
    "GearPair",
    "Keyway",
    "Law",
    "Pitch",
    "Rack",
    "Segment",
    "Shaper",
    "Sheets",
    "SixBar",
    "SpiralShaft",
    "__version__",
    "_load",
    "_pitch_from_toml",
    "_schema",
    "bezier",
    "bspline",
    "circle",
    "conjugate",
    "dwell",
    "eccentric_circle",
    "ellipse",
    "from_ratio",
    "from_transmission",
    "law",
    "limacon",
    "lobed_ellipse",
    "polar",
    "polynomial",
    "return_",
    "rise",
    "swinging_flat",
    "swinging_roller",
    "template",
    "transition",
    "translating_flat",
    "translating_roller",
]

_Count: TypeAlias = SupportsIndex
_Ratio: TypeAlias = Sequence[_Count]
_Real: TypeAlias = float | SupportsFloat
_Plane: TypeAlias = Literal["polar", "cartesian"]
_Interpolation: TypeAlias = Literal["cubic", "quintic", "trigonometric"]
_Phase: TypeAlias = _Real | Literal["auto", "tooth", "space", "congruent"]
_Format: TypeAlias = Literal["dxf", "svg", "sheet", "pdf", "stl", "step", "3mf", "csv", "urdf", "mjcf"]
_MotionLaw: TypeAlias = Literal[
    "constant-velocity",
    "parabolic",
    "harmonic",
    "cycloidal",
    "modified-sine",
    "modified-trapezoid",
    "polynomial-345",
    "polynomial-4567",
]
_SheetSize: TypeAlias = Literal["A4", "A3", "A2", "A1", "A0"]
_Projection: TypeAlias = Literal["first-angle", "third-angle"]
_CamFormat: TypeAlias = Literal["dxf", "svg", "stl", "step", "3mf", "csv"]
_Turn: TypeAlias = Literal["counter-clockwise", "clockwise"]
_LawName: TypeAlias = Literal[
    "constant-velocity",
    "parabolic",
    "harmonic",
    "cycloidal",
    "modified-sine",
    "modified-trapezoid",
    "polynomial-345",
    "polynomial-4567",
]
_DxfVersion: TypeAlias = Literal["R2010", "R12"]
_DxfCurves: TypeAlias = Literal["arcs", "splines"]

__version__: str
_LARGEST_DESIGN: int

@final
class Rack:
    __hash__: ClassVar[None]  # type: ignore[assignment]
    def __new__(
        cls,
        *,
        pressure_angle: _Real | None = None,
        addendum_coefficient: _Real | None = None,
        dedendum_coefficient: _Real | None = None,
        tip_radius_coefficient: _Real | None = None,
        profile_shift_coefficient: _Real | None = None,
    ) -> Rack: ...
    @property
    def pressure_angle(self) -> float: ...
    @property
    def addendum_coefficient(self) -> float: ...
    @property
    def dedendum_coefficient(self) -> float: ...
    @property
    def tip_radius_coefficient(self) -> float: ...
    @property
    def profile_shift_coefficient(self) -> float: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...
    def __getnewargs_ex__(self) -> tuple[tuple[()], dict[str, Any]]: ...

@final
class Shaper:
    __hash__: ClassVar[None]  # type: ignore[assignment]
    def __new__(
        cls,
        *,
        tooth_count: _Count,
        pressure_angle: _Real | None = None,
        addendum_coefficient: _Real | None = None,
        dedendum_coefficient: _Real | None = None,
        tip_radius_coefficient: _Real | None = None,
        profile_shift_coefficient: _Real | None = None,
    ) -> Shaper: ...
    @property
    def tooth_count(self) -> int: ...
    @property
    def pressure_angle(self) -> float: ...
    @property
    def addendum_coefficient(self) -> float: ...
    @property
    def dedendum_coefficient(self) -> float: ...
    @property
    def tip_radius_coefficient(self) -> float: ...
    @property
    def profile_shift_coefficient(self) -> float: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...
    def __getnewargs_ex__(self) -> tuple[tuple[()], dict[str, Any]]: ...

@final
class Keyway:
    __hash__: ClassVar[None]  # type: ignore[assignment]
    def __new__(cls, *, width: _Real, depth: _Real) -> Keyway: ...
    @property
    def width(self) -> float: ...
    @property
    def depth(self) -> float: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...
    def __getnewargs_ex__(self) -> tuple[tuple[()], dict[str, Any]]: ...

@final
class Body:
    __hash__: ClassVar[None]  # type: ignore[assignment]
    def __new__(
        cls,
        *,
        width: _Real | None = None,
        bore: _Real | None = None,
        keyway: Keyway | None = None,
        density: _Real | None = None,
        material: str | None = None,
        bore_fit: str | None = None,
        heat_treatment: str = "",
        accuracy: str = "",
    ) -> Body: ...
    @property
    def width(self) -> float: ...
    @property
    def bore(self) -> float: ...
    @property
    def keyway(self) -> Keyway | None: ...
    @property
    def density(self) -> float: ...
    @property
    def material(self) -> str: ...
    @property
    def bore_fit(self) -> str: ...
    @property
    def heat_treatment(self) -> str: ...
    @property
    def accuracy(self) -> str: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...
    def __getnewargs_ex__(self) -> tuple[tuple[()], dict[str, Any]]: ...

@final
class DrawingSpec:
    __hash__: ClassVar[None]  # type: ignore[assignment]
    def __new__(
        cls,
        *,
        number: str = "",
        revision: str = "",
        date: str = "",
        owner: str = "",
        drawn_by: str = "",
        approved_by: str = "",
        sheet: _SheetSize | None = None,
        projection: _Projection = "first-angle",
        general_tolerance: str | None = None,
        edges: str | None = None,
    ) -> DrawingSpec: ...
    @property
    def number(self) -> str: ...
    @property
    def revision(self) -> str: ...
    @property
    def date(self) -> str: ...
    @property
    def owner(self) -> str: ...
    @property
    def drawn_by(self) -> str: ...
    @property
    def approved_by(self) -> str: ...
    @property
    def sheet(self) -> _SheetSize | None: ...
    @property
    def projection(self) -> _Projection: ...
    @property
    def general_tolerance(self) -> str: ...
    @property
    def edges(self) -> str: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...
    def __getnewargs_ex__(self) -> tuple[tuple[()], dict[str, Any]]: ...

@final
class Law:
    __hash__: ClassVar[None]  # type: ignore[assignment]
    @property
    def name(self) -> str: ...
    def at(self, x: ArrayLike) -> NDArray[float64]: ...
    @property
    def characteristic_values(self) -> dict[str, float]: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...

@final
class Segment:
    __hash__: ClassVar[None]  # type: ignore[assignment]
    @property
    def span(self) -> float: ...
    @property
    def change(self) -> float: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...

@final
class Follower:
    __hash__: ClassVar[None]  # type: ignore[assignment]
    @property
    def swings(self) -> bool: ...
    @property
    def roller_radius(self) -> float | None: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...

@final
class DiscCam:
    def __new__(
        cls,
        follower: Follower,
        segments: Sequence[Segment],
        *,
        base_radius: _Real,
        rotation: _Turn = "counter-clockwise",
        start: _Real = 0.0,
        body: Body | None = None,
        name: str = "cam",
        title: str = "",
    ) -> DiscCam: ...
    @property
    def name(self) -> str: ...
    @property
    def base_radius(self) -> float: ...
    @property
    def start_angle(self) -> float: ...
    @property
    def radii(self) -> tuple[float, float]: ...
    def motion(self, theta: ArrayLike) -> NDArray[float64]: ...
    def points(self, theta: ArrayLike) -> NDArray[float64]: ...
    def normals(self, theta: ArrayLike) -> NDArray[float64]: ...
    def roller(self, theta: ArrayLike) -> NDArray[float64]: ...
    def pressure_angle(self, theta: ArrayLike) -> NDArray[float64]: ...
    def curvature(self, theta: ArrayLike) -> NDArray[float64]: ...
    def pitch_curvature(self, theta: ArrayLike) -> NDArray[float64]: ...
    def profile(self, tolerance: _Real = 1e-3) -> NDArray[float64]: ...
    def pitch_curve(self, tolerance: _Real = 1e-3) -> NDArray[float64] | None: ...
    @property
    def undercut(self) -> list[tuple[float, float]]: ...
    @property
    def peaks(self) -> dict[str, tuple[float, float]]: ...
    @property
    def limits(self) -> dict[str, tuple[float, float]]: ...
    def least_base_radius(self, *, rise: _Real, fall: _Real | None = None) -> float | None: ...
    def files(
        self,
        *,
        formats: Sequence[_CamFormat] | None = None,
        tolerance: _Real = 1e-3,
    ) -> dict[str, bytes]: ...

@final
class Gear:
    @property
    def member(self) -> Literal["driver", "driven"]: ...
    @property
    def tooth_count(self) -> int: ...
    @property
    def pitch_length(self) -> float: ...
    @property
    def area(self) -> float: ...
    @property
    def radii(self) -> tuple[float, float]: ...
    @property
    def body(self) -> Body: ...
    @property
    def teeth(self) -> tuple[Tooth, ...]: ...
    def over_pins(self, diameter: _Real | None = None) -> OverPins: ...
    def outline(self, tolerance: _Real = 1e-3) -> NDArray[float64]: ...
    def pitch_curve(self, tolerance: _Real = 1e-3) -> NDArray[float64]: ...
    def bore(self, tolerance: _Real = 1e-3) -> NDArray[float64] | None: ...
    def samples(self, tolerance: _Real = 1e-3) -> dict[str, NDArray[Any]]: ...
    def mesh(self, tolerance: _Real = 1e-3, width: _Real | None = None) -> tuple[NDArray[float64], NDArray[uint32]]: ...
    def step(self, path: str | PathLike[str]) -> Path: ...
    def stl(self, path: str | PathLike[str], tolerance: _Real = 1e-3) -> Path: ...
    def threemf(self, path: str | PathLike[str], tolerance: _Real = 1e-3) -> Path: ...
    def drawing(self, tolerance: _Real = 1e-3) -> Drawing: ...
    def sheet(
        self,
        size: _SheetSize | None = None,
        *,
        projection: _Projection | None = None,
        tolerance: _Real = 1e-3,
    ) -> Sheets: ...

@final
class Drawing:
    @property
    def dxf(self) -> bytes: ...
    @property
    def svg(self) -> bytes: ...
    def write(self, path: str | PathLike[str]) -> Path: ...

@final
class Sheets:
    @property
    def size(self) -> _SheetSize: ...
    @property
    def dxf(self) -> tuple[bytes, ...]: ...
    @property
    def svg(self) -> tuple[bytes, ...]: ...
    @property
    def pdf(self) -> bytes: ...
    def write(self, path: str | PathLike[str]) -> list[Path]: ...
    def __len__(self) -> int: ...

@final
class SpiralShaft:
    __hash__: ClassVar[None]  # type: ignore[assignment]
    def __new__(
        cls,
        *,
        lead: _Real = 20.0,
        holes: _Count = 14,
        radius: _Real = 15.0,
        amplitude: _Real = 0.0,
        harmonic: _Count = 1,
        phase: _Real = 0.0,
        rotated: bool = False,
        speed: ArrayLike | None = None,
        expression: str | None = None,
        window: _Real = 1.0471975511965976,
        pick: _Real = 0.0,
        pot_width: _Real = 18.0,
        reversal_angle: _Real | None = None,
        reversal_law: _MotionLaw = "harmonic",
        return_offset: _Real = 0.0,
        groove_width: _Real = 10.0,
        groove_depth: _Real = 4.0,
        slider_length: _Real | None = None,
        slider_clearance: _Real | None = None,
        speed_rpm: _Real = 200.0,
        mass: _Real = 10.0,
        groove_friction: _Real = 0.1,
        rail_friction: _Real = 0.15,
        name: str = "spiral-shaft",
        title: str = "",
    ) -> SpiralShaft: ...
    @staticmethod
    def for_moved_distance(
        moved_distance: _Real,
        *,
        window: _Real = 1.0471975511965976,
        lead: _Real = 20.0,
        holes: _Count = 14,
        radius: _Real = 15.0,
        harmonic: _Count = 1,
        pick: _Real = 0.0,
        pot_width: _Real = 18.0,
        reversal_angle: _Real | None = None,
        reversal_law: _MotionLaw = "harmonic",
        return_offset: _Real = 0.0,
        groove_width: _Real = 10.0,
        groove_depth: _Real = 4.0,
        slider_length: _Real | None = None,
        slider_clearance: _Real | None = None,
        speed_rpm: _Real = 200.0,
        mass: _Real = 10.0,
        groove_friction: _Real = 0.1,
        rail_friction: _Real = 0.15,
        name: str = "spiral-shaft",
        title: str = "",
    ) -> SpiralShaft: ...
    def __eq__(self, value: object, /) -> bool: ...
    def __ne__(self, value: object, /) -> bool: ...
    @property
    def name(self) -> str: ...
    @property
    def title(self) -> str: ...
    @property
    def lead(self) -> float: ...
    @property
    def amplitude(self) -> float | None: ...
    @property
    def cycle(self) -> float: ...
    @property
    def speed_ratio(self) -> tuple[float, float]: ...
    @property
    def moved_in_window(self) -> float: ...
    @overload
    def position(self, theta: _Real) -> float: ...
    @overload
    def position(self, theta: ArrayLike) -> float | NDArray[float64]: ...
    @overload
    def velocity(self, theta: _Real) -> float: ...
    @overload
    def velocity(self, theta: ArrayLike) -> float | NDArray[float64]: ...
    @overload
    def acceleration(self, theta: _Real) -> float: ...
    @overload
    def acceleration(self, theta: ArrayLike) -> float | NDArray[float64]: ...
    @overload
    def jerk(self, theta: _Real) -> float: ...
    @overload
    def jerk(self, theta: ArrayLike) -> float | NDArray[float64]: ...
    @overload
    def lead_angle(self, theta: _Real) -> float: ...
    @overload
    def lead_angle(self, theta: ArrayLike) -> float | NDArray[float64]: ...
    @overload
    def curvature(self, theta: _Real) -> float: ...
    @overload
    def curvature(self, theta: ArrayLike) -> float | NDArray[float64]: ...
    def moved(self, start: _Real, stop: _Real) -> float: ...
    def developed(self, tolerance: _Real = 1e-3) -> dict[str, NDArray[float64]]: ...
    def force(
        self,
        theta: ArrayLike,
        *,
        speed_rpm: _Real | None = None,
        mass: _Real | None = None,
        groove_friction: _Real | None = None,
        rail_friction: _Real | None = None,
    ) -> SliderForce: ...
    def crossings(self) -> NDArray[float64]: ...
    def mesh(self, tolerance: _Real = 1e-2) -> tuple[NDArray[float64], NDArray[uint32]]: ...
    def check(self) -> Report: ...
    def files(
        self,
        *,
        formats: Sequence[_Format] | None = None,
        tolerance: _Real = 1e-2,
        dxf_version: _DxfVersion = "R2010",
        dxf_curves: _DxfCurves = "arcs",
    ) -> dict[str, bytes]: ...
    def export(
        self,
        directory: str | PathLike[str],
        *,
        formats: Sequence[_Format] | None = None,
        tolerance: _Real = 1e-2,
        dxf_version: _DxfVersion = "R2010",
        dxf_curves: _DxfCurves = "arcs",
    ) -> list[Path]: ...

@final
class GearPair:
    __hash__: ClassVar[None]  # type: ignore[assignment]
    def __new__(
        cls,
        pitch: Pitch,
        *,
        mean_ratio: _Ratio = (1, 1),
        tooth_count: _Count | None = None,
        center_distance: _Real | None = None,
        tool: Rack | Shaper | None = None,
        addendum: Literal["full", "fitted"] = "full",
        phase: _Phase = "auto",
        backlash: _Real = 0.0,
        backlash_angle: _Real | None = None,
        thickness_split: _Real = 0.5,
        least_tip_width_coefficient: _Real = 0.2,
        pin_diameter: _Real | None = None,
        driver: Body | None = None,
        driven: Body | None = None,
        drawing: DrawingSpec | None = None,
        name: str = "gear-pair",
        title: str = "",
    ) -> GearPair: ...
    @staticmethod
    def from_toml(text: str) -> GearPair: ...
    def to_toml(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def title(self) -> str: ...
    @property
    def pitch(self) -> Pitch: ...
    @property
    def tool(self) -> Rack | Shaper: ...
    @property
    def drawing(self) -> DrawingSpec: ...
    @property
    def addendum(self) -> Literal["full", "fitted"]: ...
    @property
    def center_distance(self) -> float: ...
    @property
    def module(self) -> float: ...
    @property
    def mean_ratio(self) -> tuple[int, int]: ...
    @property
    def phase(self) -> float: ...
    @property
    def backlash(self) -> float: ...
    @property
    def congruent(self) -> bool: ...
    @property
    def cycle(self) -> float: ...
    @property
    def driver(self) -> Gear: ...
    @property
    def driven(self) -> Gear: ...
    @overload
    def driven_angle(self, phi: _Real) -> float: ...
    @overload
    def driven_angle(self, phi: ArrayLike) -> NDArray[float64]: ...
    @overload
    def ratio(self, phi: _Real) -> float: ...
    @overload
    def ratio(self, phi: ArrayLike) -> NDArray[float64]: ...
    @overload
    def ratio_slope(self, phi: _Real) -> float: ...
    @overload
    def ratio_slope(self, phi: ArrayLike) -> NDArray[float64]: ...
    @overload
    def driver_curvature(self, phi: _Real) -> float: ...
    @overload
    def driver_curvature(self, phi: ArrayLike) -> NDArray[float64]: ...
    @overload
    def driven_curvature(self, phi: _Real) -> float: ...
    @overload
    def driven_curvature(self, phi: ArrayLike) -> NDArray[float64]: ...
    @overload
    def pressure_angle(self, phi: _Real) -> float: ...
    @overload
    def pressure_angle(self, phi: ArrayLike) -> NDArray[float64]: ...
    @overload
    def reverse_pressure_angle(self, phi: _Real) -> float: ...
    @overload
    def reverse_pressure_angle(self, phi: ArrayLike) -> NDArray[float64]: ...
    def conjugate(self) -> Pitch: ...
    def contact(self, per_pitch: _Count = 8, *, inputs: ArrayLike | None = None) -> Contact: ...
    def check(self) -> Report: ...
    def sheet(
        self,
        size: _SheetSize | None = None,
        *,
        projection: _Projection | None = None,
        tolerance: _Real = 1e-3,
    ) -> Sheets: ...
    def files(
        self,
        *,
        formats: Sequence[_Format] | None = None,
        tolerance: _Real = 1e-3,
        dxf_version: _DxfVersion = "R2010",
        dxf_curves: _DxfCurves = "arcs",
    ) -> dict[str, bytes]: ...
    def export(
        self,
        directory: str | PathLike[str],
        *,
        formats: Sequence[_Format] | None = None,
        tolerance: _Real = 1e-3,
        dxf_version: _DxfVersion = "R2010",
        dxf_curves: _DxfCurves = "arcs",
    ) -> list[Path]: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...
    def __copy__(self) -> GearPair: ...
    def __deepcopy__(self, _memo: Any) -> GearPair: ...
    def __reduce__(self) -> tuple[Any, ...]: ...

@final
class Pitch:
    __hash__: ClassVar[None]  # type: ignore[assignment]
    @property
    def definition(self) -> str: ...
    @property
    def module(self) -> float | None: ...
    @property
    def tooth_count(self) -> int | None: ...
    @property
    def implied_ratio(self) -> tuple[int, int] | None: ...
    @property
    def period(self) -> float: ...
    def points(self, parameters: ArrayLike) -> NDArray[float64]: ...
    def curvature(self, parameters: ArrayLike) -> NDArray[float64]: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...
    def __copy__(self) -> Pitch: ...
    def __deepcopy__(self, _memo: Any) -> Pitch: ...
    def __reduce__(self) -> tuple[Any, ...]: ...

def circle(*, radius: _Real | None = None, module: _Real | None = None, tooth_count: _Count | None = None) -> Pitch: ...
def eccentric_circle(
    *,
    eccentricity: _Real,
    radius: _Real | None = None,
    module: _Real | None = None,
    tooth_count: _Count | None = None,
) -> Pitch: ...
def ellipse(
    *,
    eccentricity: _Real,
    semi_major_axis: _Real | None = None,
    module: _Real | None = None,
    tooth_count: _Count | None = None,
) -> Pitch: ...
def lobed_ellipse(
    *,
    lobes: _Count,
    eccentricity: _Real,
    semi_major_axis: _Real | None = None,
    module: _Real | None = None,
    tooth_count: _Count | None = None,
) -> Pitch: ...
def bspline(
    *,
    radius: ArrayLike | None = None,
    angle: ArrayLike | None = None,
    x: ArrayLike | None = None,
    y: ArrayLike | None = None,
    degree: _Count = 3,
    plane: _Plane = "polar",
    interpolate: bool = False,
    module: _Real | None = None,
    tooth_count: _Count | None = None,
) -> Pitch: ...
def bezier(
    *,
    radius: ArrayLike | None = None,
    angle: ArrayLike | None = None,
    x: ArrayLike | None = None,
    y: ArrayLike | None = None,
    degree: _Count = 3,
    plane: _Plane = "polar",
    module: _Real | None = None,
    tooth_count: _Count | None = None,
) -> Pitch: ...
def limacon(
    *,
    mean_radius: _Real,
    amplitude: _Real,
    lobes: _Count = 1,
    module: _Real | None = None,
    tooth_count: _Count | None = None,
) -> Pitch: ...
def polar(
    radius: str | ArrayLike | None = None,
    *,
    angle: ArrayLike | None = None,
    interpolation: _Interpolation | None = None,
    mean: _Real | None = None,
    cos: ArrayLike | None = None,
    sin: ArrayLike | None = None,
    module: _Real | None = None,
    tooth_count: _Count | None = None,
) -> Pitch: ...
def from_transmission(
    driven_angle: str | ArrayLike,
    *,
    interpolation: _Interpolation | None = None,
    center_distance: _Real | None = None,
    module: _Real | None = None,
    tooth_count: _Count | None = None,
) -> Pitch: ...
def from_ratio(
    ratio: str | ArrayLike,
    *,
    interpolation: _Interpolation | None = None,
    center_distance: _Real | None = None,
    module: _Real | None = None,
    tooth_count: _Count | None = None,
) -> Pitch: ...
def conjugate(
    of: Pitch,
    *,
    mean_ratio: _Ratio = (1, 1),
    module: _Real | None = None,
    tooth_count: _Count | None = None,
) -> Pitch: ...
def template(family: str = "gear-pair") -> str: ...
def _load(contents: bytes) -> GearPair: ...
def _pitch_from_toml(text: str) -> Pitch: ...
def _schema() -> str: ...
def law(name: _LawName, /) -> Law: ...
def polynomial(*, start: ArrayLike | None = None, end: ArrayLike | None = None) -> Law: ...
def rise(
    *, span: _Real, lift: _Real | None = None, swing: _Real | None = None, law: Law | _LawName | None = None
) -> Segment: ...
def return_(
    *, span: _Real, lift: _Real | None = None, swing: _Real | None = None, law: Law | _LawName | None = None
) -> Segment: ...
def dwell(*, span: _Real) -> Segment: ...
def transition(
    *,
    span: _Real,
    lift: _Real | None = None,
    swing: _Real | None = None,
    start_velocity: _Real = 0.0,
    start_acceleration: _Real = 0.0,
    end_velocity: _Real = 0.0,
    end_acceleration: _Real = 0.0,
) -> Segment: ...
def translating_roller(*, roller_radius: _Real, offset: _Real = 0.0) -> Follower: ...
def translating_flat() -> Follower: ...
def swinging_roller(
    *, roller_radius: _Real, center_distance: _Real, arm_length: _Real, lifts: _Turn = "counter-clockwise"
) -> Follower: ...
def swinging_flat(
    *, center_distance: _Real, face_offset: _Real = 0.0, lifts: _Turn = "counter-clockwise"
) -> Follower: ...

@final
class SixBar:
    __hash__: ClassVar[None]  # type: ignore[assignment]
    def __new__(
        cls,
        *,
        crank: _Real,
        coupler: _Real,
        rocker: _Real,
        frame: _Real,
        pivot: tuple[_Real, _Real],
        effector_length: _Real,
        branch: str = "upper",
    ) -> SixBar: ...
    def position(self, phi: ArrayLike) -> NDArray[float64]: ...
    @overload
    def effector_angle(self, phi: _Real) -> float: ...
    @overload
    def effector_angle(self, phi: ArrayLike) -> NDArray[float64]: ...
    def effector_motion(self, phi: ArrayLike) -> NDArray[float64]: ...
    def effector_tip(self, phi: ArrayLike) -> NDArray[float64]: ...
    @overload
    def transmission_angle(self, phi: _Real) -> float: ...
    @overload
    def transmission_angle(self, phi: ArrayLike) -> NDArray[float64]: ...
    @property
    def swing(self) -> float: ...
    @property
    def least_transmission_angle(self) -> float: ...
    @property
    def rocker_swing(self) -> float: ...
    @property
    def quick_return(self) -> float: ...
    @property
    def slow_stroke(self) -> float: ...
    @property
    def dead_centers(self) -> DeadCenters: ...
    @property
    def swing_sensitivity(self) -> dict[str, float]: ...
    def pivots(self, swing: _Real, count: SupportsIndex = 100) -> NDArray[float64]: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...
