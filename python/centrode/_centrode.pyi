from typing import Literal, final

from numpy import float64
from numpy.typing import ArrayLike, NDArray

__all__ = [
    "DesignError",
    "Error",
    "Pitch",
    "PitchError",
    "__version__",
    "bezier",
    "bspline",
    "circle",
    "eccentric_circle",
    "ellipse",
    "lobed_ellipse",
]

__version__: str

class Error(Exception): ...
class DesignError(Error): ...
class PitchError(DesignError): ...

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
