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


def contours(contents):
    return [(entity.dxf.layer, exactly(entity)) for entity in opened(contents).modelspace()]


@pytest.mark.parametrize("kerf", [0.15, 1.0, 3.6])
@pytest.mark.parametrize("name", ["elliptic-pair-2018", "lobed-pair-2-1", "press"])
def test_a_kerf_moves_contours_as_polygons_do(name, kerf):
    design = next(design for design in DESIGNS if design.stem == name)
    machine = ct.load(design)
    plain = machine.files(formats=["dxf"], tolerance=1e-5)
    moved = machine.files(formats=["dxf"], tolerance=1e-5, kerf=kerf)
    notes = moved.pop("cutting.txt").decode()
    assert f"Width of the cut (kerf): {kerf:g} mm" in notes
    parts = [name for name in moved if moved[name] != plain[name]]
    assert parts
    for part in parts:
        assert part.removesuffix(".dxf") + ":" in notes
        for (layer, exact), (other, path) in zip(contours(plain[part]), contours(moved[part]), strict=True):
            sign = {"PROFILE": 1, "HOLE": -1}[layer]
            polygon = exact.buffer(sign * kerf / 2, quad_segs=400)
            # A cut that does not enter a gap leaves the pocket behind it.
            shell = Polygon(polygon.exterior) if polygon.geom_type == "Polygon" else polygon
            assert other == layer
            for one, band in [(path, shell), (shell, path)]:
                assert one.boundary.within(band.boundary.buffer(1e-4, quad_segs=1))
            assert {entity.dxftype() for entity in opened(moved[part]).modelspace()} <= {"LWPOLYLINE", "CIRCLE"}


def test_a_cut_wider_than_a_hole_is_refused():
    machine = ct.load(next(design for design in DESIGNS if design.stem == "elliptic-pair-2018"))
    with pytest.raises(ct.ExportError, match=r"a hole of .* of the driver cannot be cut with a kerf of 18 mm"):
        machine.files(formats=["dxf"], kerf=18)
    with pytest.raises(ct.DesignError, match="kerf"):
        machine.files(formats=["dxf"], kerf=-0.1)


def test_a_note_on_a_kerf_goes_with_the_files_of_the_next_export(tmp_path):
    pair = ct.GearPair(ct.pitch.circle(module=2, tooth_count=20), driver=ct.Body(bore=6))
    pair.export(tmp_path, formats="laser", kerf=0.2)
    assert (tmp_path / "cutting.txt").exists()
    pair.export(tmp_path, formats="laser", kerf=0)
    assert not (tmp_path / "cutting.txt").exists()
    # A file of that name from elsewhere is kept.
    (tmp_path / "cutting.txt").write_text("mine")
    pair.export(tmp_path, formats="laser")
    assert (tmp_path / "cutting.txt").read_text() == "mine"
    with pytest.raises(ct.ExportError, match="a hole of 6 mm of the driver"):
        pair.files(formats=["dxf"], kerf=6)
    found = ct.GearPair(ct.pitch.circle(module=2, tooth_count=20), driver=ct.Body(bore=6), kerf=6).check()
    assert "kerf-too-wide" in {finding.rule for finding in found.findings}


def test_the_check_of_a_kerf_meshes_what_the_cut_leaves():
    def pair(kerf):
        pitch = ct.pitch.ellipse(eccentricity=0.4, module=2, tooth_count=21)
        return ct.GearPair(pitch, addendum="fitted", backlash=0.1, kerf=kerf)

    assert "cut_backlash_min" not in pair(0).check().values
    fine = pair(1.0).check()
    assert fine.values["cut_backlash_min"] == fine.values["normal_backlash_min"]
    assert fine.values["cut_fillet_clearance_min"] == fine.values["fillet_clearance_min"]
    assert "uncut-corner" not in {finding.rule for finding in fine.findings}

    coarse = pair(2.5).check()
    found = {finding.rule: finding for finding in coarse.findings}
    # The fillets have a radius of 1.07 mm or more: here the cut has one of 1.25 mm.
    assert 0 < found["uncut-corner"].measured < 0.5
    lost = fine.values["fillet_clearance_min"] - coarse.values["cut_fillet_clearance_min"]
    assert 0 < lost <= found["uncut-corner"].measured + 1e-6
    assert ct.GearPair.from_toml(pair(2.5).to_toml()).check().values == coarse.values
    assert "tip-interference" in {finding.rule for finding in pair(3.0).check().findings}
