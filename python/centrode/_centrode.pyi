from typing import Literal, TypeAlias, final

from numpy import float64
from numpy.typing import ArrayLike, NDArray

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
    "bezier",
    "bspline",
    "circle",
    "eccentric_circle",
    "ellipse",
    "from_ratio",
    "from_transmission",
    "limacon",
    "lobed_ellipse",
    "polar",
]

_Interpolation: TypeAlias = Literal["cubic", "quintic", "trigonometric"]

__version__: str

class Error(Exception): ...
class DesignError(Error): ...
class PitchError(DesignError): ...
class GearPairError(DesignError): ...

@final
class Rack:
    def __new__(
        cls,
        *,
        pressure_angle: float | None = None,
        addendum_coefficient: float | None = None,
        dedendum_coefficient: float | None = None,
        tip_radius_coefficient: float | None = None,
        profile_shift_coefficient: float | None = None,
    ) -> Rack: ...

@final
class Shaper:
    def __new__(
        cls,
        *,
        tooth_count: int,
        pressure_angle: float | None = None,
        addendum_coefficient: float | None = None,
        dedendum_coefficient: float | None = None,
        tip_radius_coefficient: float | None = None,
        profile_shift_coefficient: float | None = None,
    ) -> Shaper: ...

@final
class Gear:
    @property
    def tooth_count(self) -> int: ...
    @property
    def pitch_length(self) -> float: ...
    @property
    def area(self) -> float: ...
    def outline(self, *, tolerance: float) -> NDArray[float64]: ...
    def pitch_curve(self, *, tolerance: float) -> NDArray[float64]: ...

@final
class GearPair:
    def __new__(
        cls,
        pitch: Pitch,
        *,
        mean_ratio: tuple[int, int] = ...,
        tooth_count: int | None = None,
        center_distance: float | None = None,
        tool: Rack | Shaper | None = None,
        addendum: Literal["full", "fitted"] = "full",
        phase: float | Literal["auto", "tooth", "space", "congruent"] | None = None,
        backlash: float = 0.0,
        backlash_angle: float | None = None,
        thickness_split: float = 0.5,
        least_tip_width_coefficient: float = 0.2,
        name: str = "gear-pair",
        title: str = "",
    ) -> GearPair: ...
    @property
    def name(self) -> str: ...
    @property
    def center_distance(self) -> float: ...
    @property
    def module(self) -> float: ...
    @property
    def mean_ratio(self) -> tuple[int, int]: ...
    @property
    def phase(self) -> float: ...
    @property
    def congruent(self) -> bool: ...
    @property
    def cycle(self) -> float: ...
    @property
    def driver(self) -> Gear: ...
    @property
    def driven(self) -> Gear: ...
    def driven_angle(self, phi: ArrayLike) -> NDArray[float64]: ...
    def ratio(self, phi: ArrayLike) -> NDArray[float64]: ...
    def ratio_slope(self, phi: ArrayLike) -> NDArray[float64]: ...

@final
class Pitch:
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

def circle(*, radius: float | None = None, module: float | None = None, tooth_count: int | None = None) -> Pitch: ...
def eccentric_circle(
    *,
    eccentricity: float,
    radius: float | None = None,
    module: float | None = None,
    tooth_count: int | None = None,
) -> Pitch: ...
def ellipse(
    *,
    eccentricity: float,
    semi_major_axis: float | None = None,
    module: float | None = None,
    tooth_count: int | None = None,
) -> Pitch: ...
def lobed_ellipse(
    *,
    lobes: int,
    eccentricity: float,
    semi_major_axis: float | None = None,
    module: float | None = None,
    tooth_count: int | None = None,
) -> Pitch: ...
def bspline(
    *,
    radius: ArrayLike | None = None,
    angle: ArrayLike | None = None,
    x: ArrayLike | None = None,
    y: ArrayLike | None = None,
    degree: int = 3,
    plane: Literal["polar", "cartesian"] = "polar",
    interpolate: bool = False,
    module: float | None = None,
    tooth_count: int | None = None,
) -> Pitch: ...
def bezier(
    *,
    radius: ArrayLike | None = None,
    angle: ArrayLike | None = None,
    x: ArrayLike | None = None,
    y: ArrayLike | None = None,
    degree: int = 3,
    plane: Literal["polar", "cartesian"] = "polar",
    module: float | None = None,
    tooth_count: int | None = None,
) -> Pitch: ...
def limacon(
    *,
    mean_radius: float,
    amplitude: float,
    lobes: int = 1,
    module: float | None = None,
    tooth_count: int | None = None,
) -> Pitch: ...
def polar(
    radius: str | ArrayLike | None = None,
    *,
    angle: ArrayLike | None = None,
    interpolation: _Interpolation | None = None,
    mean: float | None = None,
    cos: ArrayLike | None = None,
    sin: ArrayLike | None = None,
    module: float | None = None,
    tooth_count: int | None = None,
) -> Pitch: ...
def from_transmission(
    driven_angle: str | ArrayLike,
    *,
    interpolation: _Interpolation | None = None,
    center_distance: float | None = None,
    module: float | None = None,
    tooth_count: int | None = None,
) -> Pitch: ...
def from_ratio(
    ratio: str | ArrayLike,
    *,
    interpolation: _Interpolation | None = None,
    center_distance: float | None = None,
    module: float | None = None,
    tooth_count: int | None = None,
) -> Pitch: ...
