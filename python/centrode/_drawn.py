from os import PathLike, fspath

from numpy import float64
from numpy.typing import NDArray

from ._centrode import _LARGEST_PATH, _drawn_path
from ._error import DesignError


def drawn_path(file: str | PathLike[str], *, within: float = 0.01) -> NDArray[float64]:
    """Read the one closed path of an SVG drawing, for `reverse`.

    The drawing tells its size at its root (width="210mm" viewBox="0 0 210 297"). Of 32, 64 and so on points evenly
    spread over the path's length the fewest are taken whose closed periodic cubic spline comes `within` this distance
    of the drawing, mm.

    Returns:
        Points, mm, an array (N, 2): x to the right and y up from the drawing's lower left corner.

    Raises:
        DesignError: The file is no such drawing, or its path is open or has a corner.
        OSError: The file cannot be read.
    """
    with open(file, "rb") as opened:
        contents = opened.read(_LARGEST_PATH)
    try:
        return _drawn_path(contents, within)
    except DesignError as error:
        error.args = (f"{fspath(file)}: {error}",)
        raise
