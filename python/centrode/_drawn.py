from os import PathLike, fspath

from numpy import float64
from numpy.typing import NDArray

from ._centrode import _LARGEST_PATH, _drawn_path
from ._error import DesignError


def drawn_path(file: str | PathLike[str], *, within: float = 0.01) -> NDArray[float64]:
    """Read the one closed path of an SVG drawing, for `reverse`.

    The root of the drawing must state its size (width="210mm" viewBox="0 0 210 297"). The points are evenly spaced
    along the path. Their number is the smallest of 32, 64 and so on for which the closed periodic cubic spline is
    `within` this distance of the drawing, mm.

    Returns:
        Points, mm, an array (N, 2): x to the right and y up from the lower left corner of the drawing.

    Raises:
        DesignError: The file is not such a drawing, or its path is open or has a corner.
        OSError: The file cannot be read.
    """
    with open(file, "rb") as opened:
        contents = opened.read(_LARGEST_PATH)
    try:
        return _drawn_path(contents, within)
    except DesignError as error:
        error.args = (f"{fspath(file)}: {error}",)
        raise
