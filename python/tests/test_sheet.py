import os

import centrode as ct
import pytest


@pytest.fixture(scope="module")
def pair():
    pitch = ct.pitch.ellipse(eccentricity=0.2, module=2, tooth_count=23)
    return ct.GearPair(pitch, backlash=0.05, driver=ct.Body(bore=10))


def test_the_sheets_are_those_of_the_files(pair):
    files = pair.files(formats=["sheet", "pdf"])
    for name, sheets in [("driver", pair.driver.sheet()), ("driven", pair.driven.sheet()), ("assembly", pair.sheet())]:
        assert sheets.pdf == files[f"{name}.pdf"]
        assert len(sheets) == len(sheets.dxf) == len(sheets.svg)
        page = "" if len(sheets) == 1 else "-1"
        assert sheets.dxf[0] == files[f"{name}-sheet{page}.dxf"]
        assert sheets.svg[0] == files[f"{name}-sheet{page}.svg"]


def test_size_and_projection_are_as_asked_for(pair):
    sheet = pair.driver.sheet(size="A2", projection="third-angle")
    assert sheet.size == "A2"
    assert sheet.pdf != pair.driver.sheet("A2").pdf
    with pytest.raises(ValueError, match="A4"):
        pair.driver.sheet(size="A9")
    with pytest.raises(ValueError, match="third-angle"):
        pair.driver.sheet(projection="sideways")


def test_sheets_are_written_by_the_ending_of_the_path(pair, tmp_path):
    sheets = pair.driver.sheet("A3")
    assert len(sheets) > 1
    (pdf,) = sheets.write(tmp_path / "a.pdf")
    assert pdf.read_bytes() == sheets.pdf
    dxf = sheets.write(tmp_path / "a.dxf")
    assert [path.name for path in dxf] == [f"a-{n + 1}.dxf" for n in range(len(sheets))]
    assert [path.read_bytes() for path in dxf] == list(sheets.dxf)
    with pytest.raises(ct.DesignError, match="pdf, dxf, svg"):
        sheets.write(tmp_path / "a.png")
    assert len(os.listdir(tmp_path)) == 1 + len(sheets)


def test_the_cutting_drawing_is_that_of_the_files(pair, tmp_path):
    drawing = pair.driven.drawing(tolerance=0.01)
    files = pair.files(formats=["dxf"], tolerance=0.01)
    assert drawing.dxf == files["driven.dxf"]
    assert drawing.svg.startswith(b"<svg")
    assert drawing.write(tmp_path / "g.svg").read_bytes() == drawing.svg


def test_a_gear_too_large_for_its_sheet_is_refused():
    giant = ct.GearPair(ct.pitch.circle(module=2e5, tooth_count=40))
    with pytest.raises(ct.ExportError, match="A4"):
        giant.driver.sheet("A4", tolerance=100)
