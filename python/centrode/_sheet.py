from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Literal

from ._centrode import _write
from ._error import DesignError


def _ending(path: Path, known: tuple[str, ...]) -> str:
    """The ending of a path, one of those known."""
    ending = path.suffix.removeprefix(".").lower()
    if ending not in known:
        raise DesignError(f"path must end in one of {', '.join(known)}, not {ending!r}", "path")
    return ending


@dataclass(frozen=True, slots=True, repr=False)
class Sheets:
    """The drawing sheets of a gear or of an assembled pair, made by `Gear.sheet` and `GearPair.sheet`.

    >>> import centrode as ct
    >>> sheets = ct.GearPair(ct.pitch.circle(module=2, tooth_count=20)).driver.sheet(size="A3")
    >>> sheets.size, len(sheets) == len(sheets.svg)
    ('A3', True)
    >>> sheets.pdf[:5]
    b'%PDF-'
    """

    __module__ = "centrode"

    size: Literal["A4", "A3", "A2", "A1", "A0"]
    """Size of the sheets."""
    dxf: tuple[bytes, ...]
    """One DXF file per sheet, R2010, in millimetres of the paper."""
    svg: tuple[bytes, ...]
    """One SVG picture per sheet."""
    pdf: bytes
    """One PDF file with one page per sheet."""

    def write(self, path: str | PathLike[str]) -> list[Path]:
        """Write the sheets in the format of the ending of the path, .pdf, .dxf or .svg; return the paths.

        Several sheets give one PDF file, but one file per sheet in the other formats: name-1.dxf, name-2.dxf.
        """
        path = Path(path)
        files = {"pdf": (self.pdf,), "dxf": self.dxf, "svg": self.svg}
        pages = files[_ending(path, tuple(files))]
        if len(pages) == 1:
            return [_write(path, pages[0])]
        return [_write(path.with_stem(f"{path.stem}-{number}"), page) for number, page in enumerate(pages, 1)]

    def __len__(self) -> int:
        """Number of sheets."""
        return len(self.dxf)

    def __repr__(self) -> str:
        """Number and size."""
        return f"Sheets({len(self)} of {self.size})"


@dataclass(frozen=True, slots=True, repr=False)
class Drawing:
    """The cutting drawing of a gear: profile, bore and reference lines.

    >>> import centrode as ct
    >>> drawing = ct.GearPair(ct.pitch.circle(module=2, tooth_count=20)).driver.drawing()
    >>> b"LWPOLYLINE" in drawing.dxf
    True
    """

    __module__ = "centrode"

    dxf: bytes
    """DXF R2010: closed contours of lines and arcs."""
    svg: bytes
    """SVG picture of the same drawing."""

    def write(self, path: str | PathLike[str]) -> Path:
        """Write the drawing in the format of the ending of the path, .dxf or .svg; return the path."""
        path = Path(path)
        files = {"dxf": self.dxf, "svg": self.svg}
        return _write(path, files[_ending(path, tuple(files))])

    def __repr__(self) -> str:
        """Size of the file."""
        return f"Drawing({len(self.dxf)} bytes of DXF)"
