"""Outlines as other programs read them."""

import csv

import ezdxf
import numpy as np
from ezdxf import path
from shapely.geometry import Polygon

GEARS = ("driver", "driven")


def rows(file):
    """A CSV file: its header and its numbers by column."""
    with file.open(newline="") as lines:
        table = [row for row in csv.reader(lines) if row and not row[0].startswith("#")]
    header, *values = table
    return {name: np.array(column, dtype=float) for name, column in zip(header, zip(*values, strict=True), strict=True)}


def column(table, *starts):
    """The column whose name starts with one of the words (units may follow)."""
    found = [name for name in table if name.split("_mm")[0].split("_rad")[0] in starts or name in starts]
    assert found, f"none of {starts} in {list(table)}"
    return table[found[0]]


def contours(file, layer="profile"):
    """Closed contours of a DXF's layer as polygons, arcs flattened to 1e-5 mm."""
    entities = [e for e in ezdxf.readfile(file).modelspace() if layer in e.dxf.layer.lower()]
    assert entities, f"no entity on layer {layer}"
    return [Polygon([(p.x, p.y) for p in path.make_path(entity).flattening(1e-5)]) for entity in entities]


def outline(folder, gear):
    """The toothed contour of a gear's CSV."""
    table = rows(folder / f"{gear}.csv")
    return Polygon(np.column_stack([column(table, "x"), column(table, "y")]))
