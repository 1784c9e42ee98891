from collections.abc import Sequence
from os import PathLike
from pathlib import Path
from typing import Any, ClassVar, Literal, SupportsFloat, SupportsIndex, TypeAlias, final, overload

from numpy import float64, uint32
from numpy.typing import ArrayLike, NDArray

from ._contact import Contact
from ._over_pins import OverPins
from ._report import Report
from ._tooth import Tooth

__all__ = [
    "_LARGEST_DESIGN",
    "Body",
    "DrawingSpec",
    "Gear",
    "GearPair",
    "Keyway",
    "Pitch",
    "Rack",
    "Shaper",
    "__version__",
    "_load",
    "_pitch_from_toml",
    "_schema",
    "bezier",
    "bspline",
    "circle",
    "conjugate",
    "eccentric_circle",
    "ellipse",
    "from_ratio",
    "from_transmission",
    "limacon",
    "lobed_ellipse",
    "polar",
    "template",
]

_Count: TypeAlias = SupportsIndex
_Ratio: TypeAlias = Sequence[_Count]
_Real: TypeAlias = float | SupportsFloat
_Plane: TypeAlias = Literal["polar", "cartesian"]
_Interpolation: TypeAlias = Literal["cubic", "quintic", "trigonometric"]
_Phase: TypeAlias = _Real | Literal["auto", "tooth", "space", "congruent"]
_Format: TypeAlias = Literal["dxf", "svg", "stl", "step", "3mf", "csv", "urdf", "mjcf"]
_SheetSize: TypeAlias = Literal["A4", "A3", "A2", "A1", "A0"]
_Projection: TypeAlias = Literal["first-angle", "third-angle"]
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
