"""Dimensions and hatched areas of DXF sheets as a drawing program has them: objects, not lines."""

import re

import ezdxf
import numpy as np
import pytest
from conftest import ROOT
from ezdxf.lldxf.encoding import decode_dxf_unicode
from reading import texts
from sample import sampled
from shapely.geometry import LineString, Polygon

DESIGNS = sorted(file.stem for file in (ROOT / "tests" / "designs").glob("*.toml"))
NUMBER = re.compile(r"-?\d+\.?\d*")


@pytest.fixture(scope="module")
def sheets(shipped):
    """Sheets of a design as they are read, by name."""

    def read(name):
        folder = shipped(name, "csv,dxf,sheet,step")
        return {file.name: ezdxf.readfile(file) for file in sorted(folder.glob("*-sheet*.dxf"))}

    return read


def stated(words):
    """The distance that words of a dimension state: their first number, or that after a sum."""
    (number, *_) = NUMBER.findall(words if "°" in words else words.rpartition("=")[2])
    return float(number), 0.5 * 10.0 ** -len(number.partition(".")[2])


@pytest.mark.parametrize("name", sampled(DESIGNS))
def test_every_dimension_measures_what_its_words_say(name, sheets):
    count = 0
    for file, document in sheets(name).items():
        audit = document.audit()
        assert not [*audit.errors, *audit.fixes], file
        for dimension in document.modelspace().query("DIMENSION"):
            style = document.dimstyles.get(dimension.dxf.dimstyle)
            measured = dimension.get_measurement() * style.dxf.dimlfac
            assert dimension.dxf.actual_measurement * style.dxf.dimlfac == pytest.approx(measured, abs=1e-9)
            value, digit = stated(dimension.dxf.text)
            assert measured == pytest.approx(value, abs=1.01 * digit), (file, dimension.dxf.text)
            shown = [e.dxf.text for e in dimension.virtual_entities() if e.dxftype() == "TEXT"]
            assert shown == [dimension.dxf.text]
            count += 1
    assert count


def test_a_hatched_area_is_filled_with_lines_between_its_contours(sheets):
    areas = [
        (document, hatch)
        for document in sheets("elliptic-pair-2018").values()
        for hatch in document.modelspace().query("HATCH")
    ]
    assert areas
    for _, hatch in areas:
        assert not hatch.dxf.solid_fill
        outer, *holes = sorted((Polygon(p) for p in boundaries(hatch)), key=lambda p: -p.area)
        for hole in holes:
            assert outer.contains(hole)
            outer = outer.difference(hole)
        lines = [LineString([a, b]) for a, b in hatch.render_pattern_lines()]
        assert all(outer.buffer(1e-2).covers(line) for line in lines)
        # Lines two millimetres apart fill their area.
        assert 2 * sum(line.length for line in lines) == pytest.approx(outer.area, rel=0.15)


def boundaries(hatch):
    """Corners of the contours of a hatched area, arcs flattened."""
    for path in ezdxf.path.from_hatch(hatch):
        yield np.array([(p.x, p.y) for p in path.flattening(1e-3)])


def test_an_old_release_has_the_same_dimensions_as_lines(run, tmp_path):
    design = ROOT / "tests" / "designs" / "elliptic-pair-2018.toml"
    words = {}
    for release in ("r12", "r2010"):
        run("export", design, "--to", tmp_path / release, "--format", "sheet", "--dxf", release, "--part", "driver")
        files = sorted((tmp_path / release).glob("driver-sheet*.dxf"))
        kinds = [e.dxftype() for file in files for e in ezdxf.readfile(file).modelspace()]
        assert ("DIMENSION" in kinds, "HATCH" in kinds) == (release == "r2010",) * 2
        words[release] = sorted(decode_dxf_unicode(text) for file in files for text in texts(file))
    assert words["r12"] == words["r2010"]
