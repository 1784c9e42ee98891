"""Blanks of the cut list, held against the cutting drawings by a polygon library."""

import csv
import math
import re

import ezdxf
import numpy as np
import pypdfium2
import pytest
from conftest import ROOT
from ezdxf.math import bulge_to_arc
from reading import polygon
from sample import sampled
from shapely.geometry import Polygon

DESIGNS = sorted(file.stem for file in (ROOT / "tests" / "designs").glob("*.toml"))
PLATE = re.compile(r"plate ([\d.]+): ([\d.]+) x ([\d.]+)$")
ROUND = re.compile(r"round Ø([\d.]+) x ([\d.]+)$")


def contour(entity):
    """A closed polyline, points of its arcs on them: those of the reader's cubics lie outside."""
    corners = list(entity.get_points("xyb"))
    points = []
    for (x, y, bulge), (*end, _) in zip(corners, corners[1:] + corners[:1], strict=True):
        points.append((x, y))
        if not bulge:
            continue
        (cx, cy), _, _, radius = bulge_to_arc((x, y), end, bulge)
        first, sweep = math.atan2(y - cy, x - cx), 4 * math.atan(bulge)
        steps = math.ceil(abs(sweep) / 2e-3)
        turned = [first + sweep * i / steps for i in range(1, steps)]
        points += [(cx + radius * math.cos(angle), cy + radius * math.sin(angle)) for angle in turned]
    return Polygon(points)


def contours(file):
    """Closed contours of a cutting drawing."""
    entities = [e for e in ezdxf.readfile(file).modelspace() if "profile" in e.dxf.layer.lower()]
    return [contour(e) if e.dxftype() == "LWPOLYLINE" else polygon(e) for e in entities]


def rectangle(polygon):
    """Sides of the minimum rectangle around a polygon, the longer first."""
    corners = np.array(polygon.minimum_rotated_rectangle.exterior.coords)
    sides = np.linalg.norm(np.diff(corners, axis=0), axis=1)[:2]
    return sides.max(), sides.min()


@pytest.mark.parametrize("name", sampled(DESIGNS))
def test_blanks_are_the_least_that_the_contours_need(name, shipped):
    folder = shipped(name, "csv,dxf,sheet")
    with (folder / "parts.csv").open(newline="") as lines:
        rows = [row for row in csv.DictReader(lines) if row.get("blank") and row["files"] != "shaft"]
    for row in rows:
        drawing = folder / f"{row['files']}.dxf"
        if not drawing.is_file():
            continue
        # A gear's drawing shows its tip and pitch curves, too.
        outline = max(contours(drawing), key=lambda p: p.area)
        # Arcs of the intermittent gears are laid a micrometre to either side of the teeth, which the blank is for.
        hair = 2.1e-3 if row["files"].startswith("gear-") else 2e-6
        if plate := PLATE.match(row["blank"]):
            told = [float(side) for side in plate.groups()[1:]]
            needed = rectangle(outline)
        else:
            diameter, length = map(float, ROUND.match(row["blank"]).groups())
            points = np.array(outline.exterior.coords)
            sheets = folder.glob(f"{row['files']}-sheet*.svg")
            if any("Turned; contour" in sheet.read_text() for sheet in sheets):
                told, needed = [length, diameter], np.ptp(points, axis=0)
                for side, least in zip(told, needed, strict=True):
                    assert least - 1e-6 < side < least + 0.103, row
                continue
            told = [diameter]
            middle = (points.min(axis=0) + points.max(axis=0)) / 2
            about = np.linalg.norm(points - middle, axis=1)
            # A disc about its own middle, a gear about its bore.
            needed = [2 * (about if np.ptp(about) < 1e-2 else np.linalg.norm(points, axis=1)).max()]
        for side, least in zip(told, needed, strict=True):
            # Rounded up to a tenth.
            assert least - hair < side < least + 0.101, row


def test_the_book_of_sheets_has_the_cut_list(shipped):
    for name in ("feeder-2022", "three-arm-2021", "composed-three-arm"):
        folder = shipped(name, "pdf")
        book = pypdfium2.PdfDocument(folder / "sheets.pdf")
        words = "\n".join(page.get_textpage().get_text_bounded() for page in book)
        assert "Cut list" in words
        assert "plate " in words
