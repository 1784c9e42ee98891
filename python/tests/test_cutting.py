"""Cutting files as programs of cutting machines read them."""

import io
from pathlib import Path

import centrode as ct
import ezdxf
import numpy as np
import pytest
from shapely.geometry import Polygon

DESIGNS = sorted((Path(__file__).parents[2] / "tests" / "designs").glob("*.toml"))
TOLERANCE = 1e-3


def opened(contents):
    return ezdxf.read(io.StringIO(contents.decode(), newline=None))


def drawings(design, **options):
    """Cutting files of a design's parts: their entities, of layers that plot, and all of them."""
    machine = ct.load(design)
    for name, contents in machine.files(formats=["dxf"], tolerance=TOLERANCE, **options).items():
        document = opened(contents)
        entities = [*document.modelspace()]
        # Those of assemblies and the side view of a spiral shaft are not to be cut.
        whole = name in ("assembly.dxf", "gears.dxf", "shaft.dxf") or name.endswith("-assembly.dxf")
        if "PROFILE" in document.layers and not whole:
            plots = [entity for entity in entities if document.layers.get(entity.dxf.layer).dxf.plot]
            yield name, plots, entities


def parts(entities, read):
    """Area, length and box of each contour on its layer."""
    polygons = [(entity.dxf.layer, read(entity)) for entity in entities]
    return [(layer, p.area, p.length, p.bounds) for layer, p in polygons]


def exactly(entity):
    """An entity with its arcs in steps of 0.002 rad: 5e-5 mm at a radius of 100 mm."""
    if entity.dxftype() == "CIRCLE":
        return Polygon([(p.x, p.y) for p in entity.flattening(1e-5)])
    vertices = [(complex(x, y), bulge) for x, y, bulge in entity.get_points("xyb")]
    points = []
    for (start, bulge), (end, _) in zip(vertices, vertices[1:] + vertices[:1], strict=True):
        if bulge == 0:
            points.append(start)
            continue
        center = (start + end) / 2 + 1j * (end - start) * (1 - bulge**2) / (4 * bulge)
        turn = 4 * np.arctan(bulge)
        steps = np.arange(int(abs(turn) / 0.002) + 1) / (int(abs(turn) / 0.002) + 1)
        points.extend(center + (start - center) * np.exp(1j * turn * steps))
    return Polygon([(p.real, p.imag) for p in points])


def without_bulges(entity):
    """As read by a program that knows circles and straight lines alone."""
    if entity.dxftype() == "CIRCLE":
        return exactly(entity)
    corners = np.array([point[:2] for point in entity.get_points("xy")])
    assert len(corners) > 2, "nothing to cut"
    return Polygon(corners)


def same(found, expected):
    """Whether contours are equal within twice the tolerance."""
    assert len(found) == len(expected)
    for (layer, area, _, box), (other, exact, length, exact_box) in zip(found, expected, strict=True):
        assert layer == other
        assert area == pytest.approx(exact, abs=2 * TOLERANCE * length)
        assert box == pytest.approx(exact_box, abs=2 * TOLERANCE)


@pytest.mark.parametrize("design", DESIGNS, ids=lambda design: design.stem)
def test_every_reader_sees_the_same_parts(design):
    cut = {name: parts(all_of_it, exactly) for name, plots, all_of_it in drawings(design)}
    chords = drawings(design, dxf_curves="chords")
    full = drawings(design, layers="all")
    assert cut
    for contours in cut.values():
        assert {layer for layer, *_ in contours} <= {"PROFILE", "HOLE"}
        assert [layer for layer, *_ in contours].count("PROFILE") == 1
    for name, _, entities in chords:
        same(parts(entities, without_bulges), cut[name])
    for name, plots, _ in full:
        same(parts(plots, exactly), cut[name])


def test_round_holes_are_circles():
    machine = ct.load(next(design for design in DESIGNS if design.stem == "press"))
    frame = machine.files(formats="laser", parts=["frame"])["frame.dxf"]
    kinds = {entity.dxf.layer: entity.dxftype() for entity in opened(frame).modelspace()}
    assert kinds == {"PROFILE": "LWPOLYLINE", "HOLE": "CIRCLE"}
