"""Outlines as other programs read them."""

import csv
import re
from functools import cache

import ezdxf
import numpy as np
from ezdxf import path
from shapely.geometry import Polygon

GEARS = ("driver", "driven")


def rows(file):
    """A CSV file: its numbers (and roles) by column."""
    with file.open(newline="") as lines:
        table = list(csv.reader(lines))
    header, *values = table
    columns = dict(zip(header, zip(*values, strict=True), strict=True))
    return {name: np.array(cells, dtype=str if name == "role" else float) for name, cells in columns.items()}


def plain(file):
    """All entities of a DXF's model space, those drawn for dimensions in their place."""
    for entity in ezdxf.readfile(file).modelspace():
        yield from entity.virtual_entities() if entity.dxftype() == "DIMENSION" else [entity]


def texts(file):
    """All words of a DXF, in the order drawn."""
    return [*read_texts(file, file.stat().st_mtime_ns)]


@cache
def read_texts(file, _written):
    """Words of a file as it was written at a time: sheets are looked at by many tests."""
    return [e.dxf.text for e in plain(file) if e.dxftype() == "TEXT"]


def contours(file, layer="profile"):
    """Closed contours of a DXF's layer as polygons, arcs flattened to 1e-5 mm."""
    entities = [e for e in ezdxf.readfile(file).modelspace() if layer in e.dxf.layer.lower()]
    assert entities, f"no entity on layer {layer}"
    return [polygon(entity) for entity in entities]


def polygon(entity):
    """A closed entity as a polygon; the reader's first and last point differ by rounding."""
    if entity.dxftype() == "CIRCLE":
        return Polygon([(p.x, p.y) for p in entity.flattening(1e-6)])
    points = np.array([(p.x, p.y) for p in path.make_path(entity).flattening(1e-5)])
    assert np.hypot(*(points[0] - points[-1])) < 1e-9
    return Polygon(points[:-1])


def outline(folder, gear):
    """The toothed contour of a gear's CSV."""
    table = rows(folder / f"{gear}.csv")
    return Polygon(np.column_stack([table["x_mm"], table["y_mm"]]))


def is_turned(product):
    """Whether it is a shaft or pin."""
    return re.fullmatch(r"pin(-.*)?|shaft-(?!body).*", product)


def is_mounted(product):
    """Whether it is a shaft or pin, a ring, sleeve, key or bearing on one, a screw, or a spacer between plates."""
    return is_turned(product) or re.match(r"(circlip|key|shim)-din-|deep-groove-|screw-|spacer|sleeve-", product)
