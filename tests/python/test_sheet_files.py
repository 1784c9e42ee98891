"""Drawing sheets as other programs read and draw them."""

import io
import re
from collections import Counter

import ezdxf
import numpy as np
import pypdf
import pypdfium2
import pytest
import resvg_py
from ezdxf import units
from ezdxf.addons.drawing import Frontend, RenderContext
from ezdxf.addons.drawing.config import BackgroundPolicy, ColorPolicy, Configuration, LineweightPolicy
from ezdxf.addons.drawing.layout import Margins, Page, Settings, Units
from ezdxf.addons.drawing.svg import SVGBackend
from ezdxf.math import BoundingBox2d
from PIL import Image
from reading import rows
from scipy import ndimage

SUBJECTS = ("driver", "driven", "assembly")
SIZES = {"A4": (210, 297), "A3": (420, 297), "A2": (594, 420), "A1": (841, 594), "A0": (1189, 841)}
WIDTHS = {"OUTLINE": 50, "CUTTING_PLANE": 50, "FRAME": 70, "HATCH": 18}
PLACES = {"TEXT": "insert", "LINE": "start", "SOLID": "vtx0"}
DPMM = 4


def pages(exported, subject, ending):
    """The files of a subject's sheets in order."""
    found = sorted(exported.folder.glob(f"{subject}-sheet*.{ending}"))
    assert found
    return found


def millimetres(page):
    return tuple(round(float(side) * 25.4 / 72, 3) for side in (page.mediabox.width, page.mediabox.height))


def size_of(document):
    """The name of the sheet, as its title block has it."""
    texts = {e.dxf.text for e in document.modelspace().query("TEXT")}
    (name,) = texts & set(SIZES)
    return name


@pytest.mark.parametrize("subject", SUBJECTS)
@pytest.mark.parametrize("flavour", ["r2010", "r12"])
def test_the_audit_finds_nothing_in_either_release(exported, run, tmp_path, subject, flavour):
    run("export", exported.design, "--to", tmp_path, "--format", "sheet", "--dxf", flavour, "--part", subject)
    for file in sorted(tmp_path.glob("*.dxf")):
        document = ezdxf.readfile(file)
        audit = document.audit()
        assert not audit.errors, [error.message for error in audit.errors]
        assert not audit.fixes, [fix.message for fix in audit.fixes]
        assert document.header["$INSUNITS"] == units.MM
        assert document.dxfversion == {"r2010": "AC1024", "r12": "AC1009"}[flavour]
        assert "ISO3098" in document.styles
        assert {"CENTER", "PHANTOM"} <= {t.dxf.name.upper() for t in document.linetypes}


@pytest.mark.parametrize("subject", SUBJECTS)
def test_everything_lies_on_the_sheet_and_on_a_layer_of_its_width(exported, subject):
    for file in pages(exported, subject, "dxf"):
        document = ezdxf.readfile(file)
        width, height = SIZES[size_of(document)]
        layers = {layer.dxf.name for layer in document.layers}
        for entity in document.modelspace():
            assert entity.dxf.layer in layers
            assert entity.dxf.lineweight == WIDTHS.get(entity.dxf.layer, 25)
            place = PLACES.get(entity.dxftype())
            if place:
                point = entity.dxf.get(place)
                assert 0 <= point.x <= width
                assert 0 <= point.y <= height


def test_the_first_sheet_has_the_views_it_should(exported):
    document = ezdxf.readfile(pages(exported, "driver", "dxf")[0])
    space = document.modelspace()
    counts = Counter((e.dxftype(), e.dxf.layer) for e in space)
    closed = [e for e in space.query("LWPOLYLINE[layer=='OUTLINE']") if e.closed]
    values = exported.report()["values"]
    # The toothed contour has an arc or two for every part of every tooth.
    assert max(len(e) for e in closed) > 8 * values["driver_tooth_count"]
    # The section; its width, and the tooth's thickness, head and height.
    assert counts["HATCH", "HATCH"] >= 1
    assert counts["DIMENSION", "DIMENSION"] >= 4
    assert counts["SOLID", "DIMENSION"] >= 4
    words = {e.dxf.text for e in space.query("TEXT")}
    assert {"C-C", "Gear data", "Module", "Scale", "Driver gear"} <= words
    assert f"{int(values['driver_tooth_count'])}" in words


@pytest.mark.parametrize("gear", ["driver", "driven"])
def test_a_shop_finds_its_measures_on_the_sheet(exported, gear):
    text = "\n".join(page.extract_text() for page in pypdf.PdfReader(exported / f"{gear}.pdf").pages)
    points = rows(exported / f"{gear}.csv")
    radii = np.hypot(points["x_mm"], points["y_mm"])
    told = [float(size) for size in re.findall(r"R(\d+\.\d{3})", text)]
    told += [float(size) / 2 for size in re.findall(r"Ø(\d+\.\d{3})", text)]
    # To the last figure told and the distance of the points.
    for radius in (radii.max(), radii.min()):
        assert min(abs(radius - size) for size in told) < 2e-3
    pins = exported.folder.joinpath(f"{gear}-pins.csv").read_text().splitlines()
    header, first = pins[0].split(","), pins[1].split(",")
    row = dict(zip(header, first, strict=True))
    assert f"{float(row['axis_to_far_side_mm']):.4f}" in text
    assert "Backlash, as checked" in text
    assert "ISO 2768-mK" in text


@pytest.mark.parametrize("subject", SUBJECTS)
def test_pdf_pages_have_their_exact_size_and_carry_the_font(exported, subject):
    reader = pypdf.PdfReader(exported / f"{subject}.pdf")
    sheets = pages(exported, subject, "dxf")
    assert len(reader.pages) == len(sheets)
    for page, file in zip(reader.pages, sheets, strict=True):
        assert millimetres(page) == pytest.approx(SIZES[size_of(ezdxf.readfile(file))], abs=0.01)
        fonts = [font.get_object() for font in page["/Resources"]["/Font"].values()]
        assert fonts
        for font in fonts:
            inner = font["/DescendantFonts"][0].get_object()
            descriptor = inner["/FontDescriptor"].get_object()
            assert "CentrodeLettering" in inner["/BaseFont"]
            assert {"/FontFile2", "/FontFile3"} & set(descriptor)
        assert "Sheet" in page.extract_text()


def shrunk(image):
    # A line of 0.18 mm half way between two pixels of 0.25 mm covers 36 % of each: 163 of 255 is left.
    return np.asarray(image.convert("L")) < 170


def dxf_picture(file, width, height):
    document = ezdxf.readfile(file)
    configuration = Configuration(
        background_policy=BackgroundPolicy.WHITE,
        color_policy=ColorPolicy.BLACK,
        lineweight_policy=LineweightPolicy.ABSOLUTE,
    )
    backend = SVGBackend()
    Frontend(RenderContext(document), backend, config=configuration).draw_layout(document.modelspace())
    drawn = backend.get_string(
        Page(width, height, Units.mm, Margins.all(0)),
        settings=Settings(fit_page=False),
        render_box=BoundingBox2d([(0, 0), (width, height)]),
    )
    return svg_picture(drawn)


def svg_picture(drawn):
    png = resvg_py.svg_to_bytes(svg_string=drawn, dpi=25.4 * DPMM)
    return shrunk(Image.open(io.BytesIO(bytes(png))))


def pdf_picture(file, page):
    rendered = pypdfium2.PdfDocument(file)[page].render(scale=DPMM * 25.4 / 72)
    return shrunk(rendered.to_pil())


def share_near(ink, other, millimetres_off):
    """The share of one picture's ink that has ink of the other's near it."""
    rows, columns = (min(a, b) for a, b in zip(ink.shape, other.shape, strict=True))
    ink, other = ink[:rows, :columns], other[:rows, :columns]
    far = ndimage.distance_transform_edt(~other) > millimetres_off * DPMM
    return 1 - (ink & far).sum() / ink.sum()


@pytest.mark.parametrize("subject", SUBJECTS)
def test_dxf_svg_and_pdf_show_the_same(exported, subject):
    sheets = zip(pages(exported, subject, "dxf"), pages(exported, subject, "svg"), strict=True)
    for page, (dxf, svg) in enumerate(sheets):
        width, height = SIZES[size_of(ezdxf.readfile(dxf))]
        pdf = pdf_picture(exported / f"{subject}.pdf", page)
        assert pdf.shape == pytest.approx((height * DPMM, width * DPMM), abs=2)
        assert 0.01 < pdf.mean() < 0.15
        picture = svg_picture(svg.read_text())
        for a, b in [(pdf, picture), (picture, pdf)]:
            assert share_near(a, b, 0.5) > 0.995
        # The reader has another font at hand: letters differ within their line, lines do not.
        picture = dxf_picture(dxf, width, height)
        for a, b in [(pdf, picture), (picture, pdf)]:
            assert share_near(a, b, 1.2) > 0.99


def test_options_that_no_file_has_a_use_for_are_refused(exported, run, tmp_path):
    for options, word in [
        (("--format", "stl", "--sheet", "A3"), "--sheet"),
        (("--format", "dxf", "--projection", "third-angle"), "--projection"),
        (("--format", "stl", "--part", "assembly"), "--part assembly"),
        (("--format", "urdf", "--part", "driver"), "--part"),
    ]:
        told = run("export", exported.design, "--to", tmp_path / "none", *options, check=False)
        assert told.returncode == 2, told.stderr
        assert word in told.stderr
        assert not (tmp_path / "none").exists()


def test_parts_and_sizes_are_as_asked_for(exported, run, tmp_path):
    options = ("--format", "sheet,pdf", "--part", "driven", "--sheet", "A2", "--projection", "third-angle")
    run("export", exported.design, "--to", tmp_path, *options)
    assert {file.name.split("-")[0].split(".")[0] for file in tmp_path.glob("[!.]*")} == {"driven"}
    assert millimetres(pypdf.PdfReader(tmp_path / "driven.pdf").pages[0]) == pytest.approx(SIZES["A2"], abs=0.01)
    run("export", exported.design, "--to", tmp_path / "first", *options[:-1], "first-angle")
    assert (tmp_path / "first" / "driven.pdf").read_bytes() != (tmp_path / "driven.pdf").read_bytes()
