"""Parts of every shipped design, made again from their sheets alone and held against their solids."""

import csv
import ctypes
import math
import re
from collections import Counter
from functools import cache
from itertools import groupby, pairwise

import ezdxf
import numpy as np
import pypdfium2
import pytest
import reading
import shapely
import tomllib
from conftest import ROOT, design_file
from OCP.Bnd import Bnd_Box
from OCP.BRepAdaptor import BRepAdaptor_Curve, BRepAdaptor_Surface
from OCP.BRepBndLib import BRepBndLib
from OCP.BRepGProp import BRepGProp
from OCP.GeomAbs import GeomAbs_Cylinder
from OCP.GProp import GProp_GProps
from OCP.IFSelect import IFSelect_RetDone
from OCP.STEPControl import STEPControl_Reader
from OCP.TopAbs import TopAbs_EDGE, TopAbs_FACE
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS
from reading import texts
from sample import sampled
from shapely import STRtree
from shapely.affinity import rotate, translate
from shapely.geometry import Point, Polygon, box

TEMPLATES = ("gear-pair", "three-arm", "spiral-shaft", "moving-box", "feeder", "machine")
DESIGNS = sorted(path.stem for path in (ROOT / "tests" / "designs").glob("*.toml"))
# Families whose parts are plates, gears and cams alone.
FLAT = ("feeder", "machine", "three-arm")
NUMBER = r"-?[\d.]+"
HOLE = re.compile(rf"^(?:[^:]+: )?Ø({NUMBER})(?: (\S+))?")
# Threads, with the drills of ISO 2306.
THREAD = re.compile(rf"^(?:[^:]+: )?M({NUMBER})-6H (through|\u00d7 ({NUMBER}) from both faces)$")
DRILLS = {1.6: 1.25, 2: 1.6, 2.5: 2.05, 3: 2.5, 4: 3.3, 5: 4.2, 6: 5, 8: 6.8, 10: 8.5, 12: 10.2}
PLACE = re.compile(rf"^at ({NUMBER}), ({NUMBER})")
KEYWAY = re.compile(rf"^keyway ({NUMBER})")
KEYED = re.compile(rf"^Ø \+ depth ({NUMBER}) \(\+0\.100 / 0\), at {NUMBER}°(?: ±{NUMBER}°)?$")
# A length, or a diameter of a round plate with the class of a shaft.
SIZE = re.compile(rf"^Ø?({NUMBER})(?: [a-z]+\d+ \(.*\))?$")
ENDS = re.compile(rf"^R({NUMBER}) about ({NUMBER}), ({NUMBER}) and ({NUMBER}), ({NUMBER})$")


@pytest.fixture(scope="module")
def exported(shipped):
    """Folder of the files of a shipped design, or of the template of a family, written once."""
    return lambda name: shipped(name, "csv,dxf,sheet,step")


def parts(folder):
    """Rows of the parts list that have files."""
    with (folder / "parts.csv").open(newline="") as lines:
        return [row for row in csv.DictReader(lines) if row["files"]]


def words(folder, part):
    """Texts of a part's sheets, in the order drawn."""
    files = sorted(folder.glob(f"{part}-sheet*.dxf"))
    return [text for file in files for text in texts(file)]


def family(name):
    if name in TEMPLATES:
        return name
    return tomllib.loads((ROOT / "tests" / "designs" / f"{name}.toml").read_text())["family"]


def is_composed(name):
    return family(name) == "machine"


def is_whole(name):
    """Whether pins and shafts are designed: of composed machines those with hardware in full."""
    path = ROOT / "tests" / "designs" / f"{name}.toml"
    return not is_composed(name) or (path.exists() and 'hardware = "full"' in path.read_text())


@pytest.mark.parametrize("name", sampled([*DESIGNS, *TEMPLATES]))
def test_every_made_part_has_a_drawing_a_solid_a_sheet_a_material_and_a_mass(name, exported):
    folder = exported(name)
    with (folder / "parts.csv").open(newline="") as lines:
        listed = list(csv.DictReader(lines))
    made = [row for row in listed if row["supply"] == "made"]
    assert made
    for row in made:
        part = row["files"]
        assert (folder / f"{part}.dxf").exists(), row
        assert (folder / f"{part}.step").exists(), row
        assert list(folder.glob(f"{part}-sheet*.dxf")), row
        assert row["material"], row
        assert row["blank"], row
        assert float(row["mass_kg"]) > 0, row
    for row in listed:
        if row["supply"] == "bought":
            # Named by the number of its standard.
            assert re.search(r"\b(ISO|DIN) \d+", row["part"]), row
        if row["supply"] != "made":
            assert row["files"] == "", row


# All parts without a sheet and a standard, with the reason: the design defines no more of them than the remark.
GIVEN = {
    "Shaft of the (driver|driven) gear": "its length is that of bearings that the design does not define",
    "Box with its rail": "the design gives its mass alone",
    "Stand": "it stands on what is around the machine",
    "Sleeve of a cam": "how it is fixed to the front plate is open",
    "Hub of an arm": "how it is fixed to the front cover is open",
    "Seat of a clamp": "how it holds the flakes and is fixed in the wall is open",
    "Bracket of .+": "it stands on what is around the shaft that goes through",
    "frame|Foot|(Shaft|Drive|Guide|Spring|Joint) of .+|Pin( \\d+)? through .+": "hardware is listed only",
    "(Sleeve|Cam roller) .+": "hardware is listed only",
}
# What each must fit: a shaft or a bore by size and class, or how far apart what it holds lies.
FITTED = re.compile(r"Ø[\d.]+ [a-zA-Z]+\d+|two flakes [\d.]+ apart")
# What a machine lists without its fit: tables of the arrangement have it.
LISTED = re.compile(r"frame|Foot|(Drive|Guide|Spring|Joint) of .+|(Sleeve|Cam roller) .+")


@pytest.mark.parametrize("name", sampled([*DESIGNS, *TEMPLATES]))
def test_parts_that_are_neither_made_nor_bought_are_few_and_tell_what_they_must_fit(name, exported):
    with (exported(name) / "parts.csv").open(newline="") as lines:
        given = [row for row in csv.DictReader(lines) if row["supply"] == "given"]
    for row in given:
        assert [part for part in GIVEN if re.fullmatch(part, row["part"])], row
        assert FITTED.search(row["remark"]) or (is_composed(name) and LISTED.fullmatch(row["part"])), row
        assert row["blank"] == "", row
        assert (row["mass_kg"] == "") == (row["part"] != "Box with its rail"), row


@pytest.mark.parametrize("name", sampled(name for name in [*DESIGNS, *TEMPLATES] if family(name) == "gear-pair"))
def test_a_gear_on_a_given_shaft_tells_its_size_class_and_keyway(name, exported):
    folder = exported(name)
    with (folder / "parts.csv").open(newline="") as lines:
        listed = list(csv.DictReader(lines))
    gears = [row for row in listed if row["files"]]
    assert len(gears) == 2
    for gear in gears:
        (shaft,) = [row for row in listed if row["part"] == f"Shaft of the {gear['links']} gear"]
        size = FITTED.search(shaft["remark"])[0]
        text = " ".join(words(folder, gear["files"]))
        assert f"To sit on a shaft {size} " in text
        keys = [row for row in listed if row["part"].startswith("Key ")]
        assert bool(re.search(r"with a keyway \d+ N9 \(", text)) == bool(keys)


@pytest.mark.parametrize(
    "name", sampled(name for name in [*DESIGNS, *TEMPLATES] if family(name) in FLAT and is_whole(name))
)
def test_every_part_that_is_made_or_bought_has_its_number_in_a_view_or_section(name, exported):
    folder = exported(name)
    with (folder / "parts.csv").open(newline="") as lines:
        listed = [row for row in csv.DictReader(lines) if row["supply"] != "given"]
    told = words(folder, "assembly")
    numbers = Counter(number for text in told for number in text.split(", "))
    for row in listed:
        # Its lines in the parts list and in the cut list are not enough.
        tables = 1 + ("Cut list" in told and row["blank"] != "")
        assert numbers[row["item"]] > tables, row


def named_files(folder):
    """Files that any sheet of a folder names, with the sheet."""
    for sheet in sorted(folder.glob("*-sheet*.dxf")):
        for text in texts(sheet):
            for file in re.findall(r"[\w-]+\.(?:dxf|step|csv|ngc)\b", text):
                yield sheet.name, file


@pytest.mark.parametrize("name", sampled([*DESIGNS, *TEMPLATES]))
def test_every_file_named_on_a_sheet_exists(name, exported):
    folder = exported(name)
    named = list(named_files(folder))
    assert named
    assert [(sheet, file) for sheet, file in named if not (folder / file).exists()] == []


@pytest.mark.parametrize("name", ["elliptic-pair-2018", "spiral-shaft-2018", "three-arm-2021", "feeder-2022"])
def test_sheets_alone_bring_the_points_they_name_and_tell_their_rows_and_columns(name, shipped):
    folder = shipped(name, "sheet")
    told = 0
    for sheet in sorted(folder.glob("*-sheet*.dxf")):
        words = texts(sheet)
        for at in (i for i, text in enumerate(words) if text == "Rows"):
            told += 1
            file, rows = words[at - 1], int(words[at + 1])
            header, *points = (folder / file).read_text().splitlines()
            assert len(points) == rows
            assert words[at + 2] == "Columns"
            columns = "".join(words[at + 3 :]).replace(" ", "")
            assert columns.startswith(header), (sheet.name, columns)
    assert told


def contours(texts):
    """Contours of the table on a sheet, each a list of corners with the radius and centre of the side after them."""
    found = {}
    for start in (i for i, text in enumerate(texts) if text == "radius to the next"):
        rest = iter(text for text in texts[start + 1 :] if text != "about")
        for text in rest:
            kind, x = (text, next(rest)) if text in ("outside", "opening") else ("outside", text)
            if not re.fullmatch(r"-?\d+\.\d{3}", x):
                break
            y, rounding = next(rest), next(rest)
            center = None if rounding == "line" else tuple(float(x) for x in next(rest).split(", "))
            found.setdefault(kind, []).append((float(x), float(y), rounding, center))
    return found


def polygon(corners):
    """A contour with its arcs as many short chords; which side is inside is told by the order of its corners."""
    turns = sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(corners, corners[1:] + corners[:1], strict=True))
    points = []
    for (x0, y0, rounding, center), (x1, y1, *_) in zip(corners, corners[1:] + corners[:1], strict=True):
        points.append((x0, y0))
        if center is None:
            continue
        radius, *notes = rounding.split(", ")
        cx, cy = center
        sense = math.copysign(1.0, turns) * (-1 if "concave" in notes else 1)
        first, last = (math.atan2(y - cy, x - cx) for x, y in ((x0, y0), (x1, y1)))
        sweep = (sense * (last - first)) % math.tau
        assert (sweep > math.pi + 1e-3) <= ("over 180°" in notes)
        for x, y in ((x0, y0), (x1, y1)):
            assert abs(math.dist((x, y), center) - float(radius)) < 2e-3
        for i in range(1, 400):
            angle = first + sense * sweep * i / 400
            points.append((cx + float(radius) * math.cos(angle), cy + float(radius) * math.sin(angle)))
    return Polygon(points)


def solid(file):
    reader = STEPControl_Reader()
    assert reader.ReadFile(str(file)) == IFSelect_RetDone
    assert reader.TransferRoots() == 1
    return reader.OneShape()


def pieces(shape, kind):
    """Faces or edges of a shape."""
    explorer = TopExp_Explorer(shape, kind)
    while explorer.More():
        yield explorer.Current()
        explorer.Next()


def cylinders(shape):
    """Axes and radii of the round faces."""
    for face in pieces(shape, TopAbs_FACE):
        surface = BRepAdaptor_Surface(TopoDS.Face(face))
        if surface.GetType() == GeomAbs_Cylinder:
            cylinder = surface.Cylinder()
            at = cylinder.Location()
            yield at.X(), at.Y(), cylinder.Radius()


def thickness(shape):
    bounds = Bnd_Box()
    BRepBndLib.AddOptimal_s(shape, bounds, True, False)
    return bounds.CornerMax().Z() - bounds.CornerMin().Z()


@pytest.mark.parametrize("name", sampled(name for name in [*DESIGNS, *TEMPLATES] if family(name) in FLAT))
def test_a_plate_made_from_its_sheet_alone_is_its_solid(name, exported):
    assert plates_made_from_their_sheets(exported(name))


def test_a_plate_with_concave_arcs_made_from_its_sheet_alone_is_its_solid(tmp_path, run):
    design = tmp_path / "waisted.toml"
    waist = "[bodies.shaft]\noutline = [[-14, -12], [14, -12, -0.3], [14, 12], [-14, 12, -0.2]]\n"
    press = (ROOT / "tests" / "designs" / "press.toml").read_text()
    design.write_text(press.replace("[bodies.shaft]\n", waist))
    run("export", design, "--to", tmp_path, "--format", "dxf,sheet,step,csv")
    sides = [side for _, _, side, _ in contours(words(tmp_path, "shaft"))["outside"]]
    # Of a chord c and a bulge b the radius is c (1 + b^2) / (4 b).
    radii = [f"{24 * (1 + b * b) / (4 * b):.3f}".rstrip("0") for b in (0.3, 0.2)]
    assert sorted(sides) == sorted(["line", "line", *(f"{radius}, concave" for radius in radii)])
    assert plates_made_from_their_sheets(tmp_path)


def drawn_area(entity):
    """Area within a closed contour of lines and arcs, or a circle."""
    if entity.dxftype() == "CIRCLE":
        return math.pi * entity.dxf.radius**2
    corners = list(entity.get_points("xyb"))
    area = 0.0
    for (x0, y0, bulge), (x1, y1, _) in zip(corners, corners[1:] + corners[:1], strict=True):
        angle, chord = 4 * math.atan(bulge), math.hypot(x1 - x0, y1 - y0)
        radius = chord / (2 * math.sin(angle / 2)) if bulge else 0.0
        area += (x0 * y1 - x1 * y0) / 2 + radius**2 * (angle - math.sin(angle)) / 2 * (1 if bulge else 0)
    return abs(area)


def cut_area(file):
    """Area within the contour of a cutting file less its holes."""
    areas = {"PROFILE": 0.0, "HOLE": 0.0}
    for entity in ezdxf.readfile(file).modelspace():
        if entity.dxf.layer in areas:
            areas[entity.dxf.layer] += drawn_area(entity)
    return areas["PROFILE"] - areas["HOLE"]


def plates_made_from_their_sheets(folder):
    """Makes each plate from its sheet and compares it with its solid; how many."""
    made = 0
    for row in parts(folder):
        part = row["files"]
        texts = words(folder, part)
        if f"Cutting file: {part}.dxf." not in texts:
            continue
        made += 1
        outlines = contours(texts)
        area = polygon(outlines["outside"]).area
        length = polygon(outlines["outside"]).length
        if "opening" in outlines:
            area -= polygon(outlines["opening"]).area
            length += polygon(outlines["opening"]).length
        shape = solid(folder / f"{part}.step")
        round_faces = list(cylinders(shape))
        drilled = sum("drilled Ø" in text for text in texts)
        assert drilled == sum(bool(THREAD.match(text)) for text in texts), part

        def has(x, y, radius, faces=round_faces):
            return any(math.dist((x, y, radius), face) < 2e-4 for face in faces)

        for text, after in pairwise(texts):
            if (hole := HOLE.match(text)) and (at := PLACE.match(after)):
                radius = float(hole[1]) / 2
                x, y = float(at[1]), float(at[2])
                area -= math.pi * radius**2
                assert has(x, y, radius), (part, text, after)
                # Whatever is drilled has a class, and with it limits.
                assert hole[2], (part, text)
                bored = 2 * radius
            if (thread := THREAD.match(text)) and (at := PLACE.match(after)):
                radius = DRILLS[float(thread[1])] / 2
                area -= math.pi * radius**2
                assert has(float(at[1]), float(at[2]), radius), (part, text, after)
                assert 2 * float(thread[3] or 0) < thickness(shape), (part, text)
            if (keyway := KEYWAY.match(text)) and (keyed := KEYED.match(after)):
                half, above = float(keyway[1]) / 2, float(keyed[1]) - bored / 2
                # What the keyway takes beyond the bore's circle.
                leg = math.sqrt(bored**2 / 4 - half**2)
                area -= 2 * half * above - half * leg - bored**2 / 4 * math.asin(2 * half / bored)
            if ends := ENDS.match(after):
                radius, x0, y0, x1, y1 = map(float, ends.groups())
                area -= math.pi * radius**2 + 2 * radius * math.hypot(x1 - x0, y1 - y0)
                for x, y in ((x0, y0), (x1, y1)):
                    assert has(x, y, radius), (part, text, after)
        box = Bnd_Box()
        BRepBndLib.AddOptimal_s(shape, box, True, False)
        low, high = box.CornerMin(), box.CornerMax()
        # Neither the letters of the frame nor the cells of tables are dimensions.
        (first,) = [i for i, text in enumerate(texts) if text.endswith(" for each machine.")]
        views = texts[first : texts.index("Contour")]
        numbers = [float(found[1]) for text in views if (found := SIZE.match(text))]
        for side in (high.X() - low.X(), high.Y() - low.Y(), high.Z() - low.Z()):
            assert min(abs(side - x) for x in numbers) < 6e-4, (part, side)
        thick = high.Z() - low.Z()
        properties = GProp_GProps()
        BRepGProp.VolumeProperties_s(shape, properties)
        if "opening" in outlines:
            # A wall may have a bore through it that is told in words.
            assert properties.Mass() <= area * thick + 1e-3 * length * thick, part
            continue
        # Corners are written to a micrometre.
        assert abs(properties.Mass() - area * thick) < 1e-3 * length * thick, part
        assert abs(cut_area(folder / f"{part}.dxf") - area) < 2e-3 * length, part
    return made


def inked(page):
    """Rectangles around the ink of each line of words on a page, mm, as PDFium draws it, turned as the words are."""
    for text in page.get_objects(filter=[pypdfium2.raw.FPDF_PAGEOBJ_TEXT]):
        bounds = box(*(side * 25.4 / 72 for side in text.get_bounds()))
        matrix = text.get_matrix()
        turn = math.atan2(matrix.b, matrix.a)
        sine, cosine = abs(math.sin(turn)), abs(math.cos(turn))
        if min(sine, cosine) < 1e-6 or abs(cosine - sine) < 0.2:
            yield bounds
            continue
        # What PDFium tells stands upright about the turned rectangle: wide = w cos + h sin, high = w sin + h cos.
        left, low, right, top = bounds.bounds
        wide, high = right - left, top - low
        share = cosine**2 - sine**2
        half = [(wide * cosine - high * sine) / share / 2, (high * cosine - wide * sine) / share / 2]
        upright = box(-half[0], -half[1], half[0], half[1])
        turned = rotate(upright, turn, origin=(0, 0), use_radians=True)
        yield translate(turned, (left + right) / 2, (low + top) / 2)


def corners(page):
    """Ends and control points of the lines on a page, mm; the sharp corners of wide strokes are not told by PDFium."""
    for path in page.get_objects(filter=[pypdfium2.raw.FPDF_PAGEOBJ_PATH]):
        matrix = path.get_matrix()
        x, y = ctypes.c_float(), ctypes.c_float()
        for index in range(pypdfium2.raw.FPDFPath_CountSegments(path.raw)):
            segment = pypdfium2.raw.FPDFPath_GetPathSegment(path.raw, index)
            assert pypdfium2.raw.FPDFPathSegment_GetPoint(segment, x, y)
            yield tuple(side * 25.4 / 72 for side in matrix.on_point(x.value, y.value))


@pytest.fixture(scope="module")
def drawn(shipped, tmp_path_factory, run):
    """Folder with the sheets of a shipped design, or of the template of a family."""

    @cache
    def folder(name):
        if name not in TEMPLATES:
            return shipped(name, "pdf")
        to = tmp_path_factory.mktemp(name)
        design = to / "new.toml"
        design.write_text(run("new", name).stdout)
        run("export", design, "--to", to, "--format", "pdf", check=False)
        return to

    return folder


@pytest.mark.parametrize("name", sampled([*DESIGNS, *TEMPLATES]))
def test_no_words_overlap_others_and_nothing_leaves_the_frame(name, drawn):
    sheets = sorted(drawn(name).glob("*.pdf"))
    assert sheets
    for sheet in sheets:
        for number, page in enumerate(pypdfium2.PdfDocument(sheet)):
            where = (sheet.name, number + 1)
            width, height = (side * 25.4 / 72 for side in page.get_size())
            words = list(inked(page))
            assert len(words) > 30, where
            tree = STRtree(words)
            one, other = tree.query(words, predicate="intersects")
            assert [words[i].bounds for i, j in zip(one, other, strict=True) if i < j] == [], where
            # ISO 5457: the frame lies 20 mm from the left edge and 10 mm from the others, with letters between.
            fields = box(0, 0, width, height) - box(20, 10, width - 10, height - 10)
            inside = box(20, 10, width - 10, height - 10)
            for shape in words:
                assert inside.contains(shape) or fields.contains(shape), (where, shape.bounds)
            for x, y in corners(page):
                assert -1e-3 < x < width + 1e-3, where
                assert -1e-3 < y < height + 1e-3, where


def strokes(page):
    """Ends of straight lines, and of chords of curves, on a page, mm."""
    for path in page.get_objects(filter=[pypdfium2.raw.FPDF_PAGEOBJ_PATH]):
        matrix, last = path.get_matrix(), None
        x, y = ctypes.c_float(), ctypes.c_float()
        for index in range(pypdfium2.raw.FPDFPath_CountSegments(path.raw)):
            segment = pypdfium2.raw.FPDFPath_GetPathSegment(path.raw, index)
            assert pypdfium2.raw.FPDFPathSegment_GetPoint(segment, x, y)
            at = tuple(side * 25.4 / 72 for side in matrix.on_point(x.value, y.value))
            moves = pypdfium2.raw.FPDFPathSegment_GetType(segment) == pypdfium2.raw.FPDF_SEGMENT_MOVETO
            if not moves and last != at:
                yield last, at
            last = at


@pytest.mark.parametrize("name", sampled([*DESIGNS, *TEMPLATES]))
def test_no_line_runs_through_words(name, drawn):
    for sheet in sorted(drawn(name).glob("*.pdf")):
        for number, page in enumerate(pypdfium2.PdfDocument(sheet)):
            lines = shapely.linestrings(list(strokes(page)))
            assert len(lines), sheet
            # Within the ink by more than a thin line is wide.
            words = [shape.buffer(-0.12) for shape in inked(page)]
            words = [shape for shape in words if not shape.is_empty]
            struck, _ = STRtree(lines).query(words, predicate="intersects")
            assert [words[i].bounds for i in sorted(set(struck))] == [], (sheet.name, number + 1)


KEY_WIDTH = re.compile(rf"^({NUMBER}) (?:JS|N|P|D)\d+ \(")
KEY_DEPTH = re.compile(rf"^({NUMBER}) \(\+0\.[12]00 / 0\)$")
KEY_ANGLE = re.compile(rf"^Keyway at polar angle ({NUMBER})°")
KEY_LINE = re.compile(rf"^Ø \+ depth ({NUMBER}) \(\+0\.[12]00 / 0\), at ({NUMBER})°(?: ±{NUMBER}°)?$")


def told_points(folder, texts):
    """The contour in the file that a sheet names, its arcs as short chords."""
    with (folder / texts[texts.index("File") + 1]).open(newline="") as lines:
        table = list(csv.DictReader(lines))
    assert len(table) == int(texts[texts.index("Rows") + 1])
    table = [row for row in table if row.get("state") != "undercut"]
    points = [(float(row["x_mm"]), float(row["y_mm"])) for row in table]
    if "bulge" not in table[0]:
        return Polygon(points)
    found = []
    for row, start, end in zip(table, points, points[1:] + points[:1], strict=True):
        found.append(start)
        if bulge := float(row["bulge"]):
            # From the middle of the chord to the arc's centre.
            along = (end[0] - start[0], end[1] - start[1])
            off = (1 / bulge - bulge) / 4
            center = ((start[0] + end[0]) / 2 - off * along[1], (start[1] + end[1]) / 2 + off * along[0])
            radius, first = math.dist(center, start), math.atan2(start[1] - center[1], start[0] - center[0])
            steps = 8 + math.ceil(abs(4 * math.atan(bulge)) / 2e-3)
            turned = [first + 4 * math.atan(bulge) * i / steps for i in range(1, steps)]
            found += [(center[0] + radius * math.cos(a), center[1] + radius * math.sin(a)) for a in turned]
    return Polygon(found)


def keyed(diameter, width, over, degrees):
    """A bore with a keyway that reaches so far over its diameter."""
    bore = Point(0, 0).buffer(diameter / 2, quad_segs=512)
    slot = box(0, -width / 2, over - diameter / 2, width / 2)
    return rotate(bore.union(slot), degrees, origin=(0, 0))


def told_holes(texts):
    """Holes of a gear or cam as its sheet gives them: by a detail of the bore, or by lines next to it."""
    found = []
    for index, text in enumerate(texts):
        if not (hole := HOLE.match(text)) or text.startswith("Ø +") or "(" not in text:
            continue
        diameter, after = float(hole[1]), texts[index + 1 : index + 3]
        if at := PLACE.match(after[0]):
            found.append(Point(float(at[1]), float(at[2])).buffer(diameter / 2, quad_segs=512))
        elif (key := KEYWAY.match(after[0])) and (line := KEY_LINE.match(after[1])):
            found.append(keyed(diameter, float(key[1]), float(line[1]), float(line[2])))
        else:
            widths = [float(match[1]) for text in texts if (match := KEY_WIDTH.match(text))]
            depths = [float(match[1]) for text in texts if (match := KEY_DEPTH.match(text))]
            angles = [float(match[1]) for text in texts if (match := KEY_ANGLE.match(text))]
            assert len(widths) == len(depths) <= 1
            key = [widths[0], depths[0]] if widths else [0.0, diameter]
            found.append(keyed(diameter, *key, (angles or [0.0])[0]))
    return found


def edge_points(shape, z):
    """Places along the edges of a solid at a height."""
    for edge in pieces(shape, TopAbs_EDGE):
        curve = BRepAdaptor_Curve(TopoDS.Edge(edge))
        first, last = curve.FirstParameter(), curve.LastParameter()
        points = [curve.Value(first + (last - first) * i / 8) for i in range(9)]
        if all(abs(p.Z() - z) < 1e-6 for p in points):
            yield from ((p.X(), p.Y()) for p in points)


def boundary_tree(flat):
    """The sides of a polygon and its holes, to look for the nearest to a point."""
    rings = [np.array(ring.coords) for ring in (flat.exterior, *flat.interiors)]
    return STRtree(np.concatenate([shapely.linestrings(np.stack([r[:-1], r[1:]], axis=1)) for r in rings]))


@pytest.mark.parametrize("name", sampled([*DESIGNS, *TEMPLATES]))
def test_a_gear_or_cam_made_from_its_sheet_and_the_file_it_names_is_its_solid(name, exported):
    folder = exported(name)
    made = 0
    for row in parts(folder):
        part = row["files"]
        texts = words(folder, part)
        if "Profile points" not in texts:
            continue
        made += 1
        outline, holes = told_points(folder, texts), told_holes(texts)
        flat = outline
        for hole in holes:
            assert outline.contains(hole)
            flat = flat.difference(hole)
        shape = solid(folder / f"{part}.step")
        bounds = Bnd_Box()
        BRepBndLib.AddOptimal_s(shape, bounds, True, False)
        low, high = bounds.CornerMin().Z(), bounds.CornerMax().Z()
        numbers = [float(text) for text in texts if re.fullmatch(r"\d+(\.\d+)?", text)]
        assert min(abs(high - low - x) for x in numbers) < 6e-4, part
        points = list(edge_points(shape, low))
        assert len(points) > 100
        # Points of a cam stand half a degree apart; all others are within a micrometre of the contour.
        _, far = boundary_tree(flat).query_nearest(shapely.points(points), return_distance=True)
        assert far.max() < 5e-3, (part, far.max())
        properties = GProp_GProps()
        BRepGProp.VolumeProperties_s(shape, properties)
        assert abs(properties.Mass() / (high - low) - flat.area) < 2e-3 * flat.length, part
        assert abs(cut_area(folder / f"{part}.dxf") - flat.area) < 5e-3 * flat.length, part
    assert made or family(name) in ("machine", "spiral-shaft"), name


@pytest.mark.parametrize("name", sampled(["spiral-shaft-2018", "moving-box-2018", "spiral-shaft", "moving-box"]))
def test_the_slider_made_from_its_sheet_alone_is_its_solid(name, exported):
    folder = exported(name)
    texts = words(folder, "slider")
    (wide,) = (float(match[1]) for text in texts if (match := re.match(rf"^({NUMBER}) h11 \(", text)))
    (bore,) = (float(match[1]) for text in texts if (match := re.match(rf"^Ø({NUMBER}) H8 \(", text)))
    (rounding,) = (float(match[1]) for text in texts if (match := re.fullmatch(rf"R({NUMBER})", text)))
    assert abs(2 * rounding - wide) < 1e-3
    # After the letters of the frame and before the title block.
    view = texts[texts.index("F") + 1 : texts.index("Material")]
    lengths = [float(text) for text in view if re.fullmatch(r"\d+(\.\d+)?", text)]
    long, thick = max(lengths), min(lengths)
    area = wide * (long - wide) + math.pi * (wide**2 - bore**2) / 4
    shape = solid(folder / "slider.step")
    properties = GProp_GProps()
    BRepGProp.VolumeProperties_s(shape, properties)
    assert abs(properties.Mass() / (area * thick) - 1) < 1e-4
    assert {round(bore / 2, 6), round(wide / 2, 6)} <= {round(radius, 6) for radius in turned_radii(shape)}
    assert abs(cut_area(folder / "slider.dxf") - area) < 1e-2


@pytest.mark.parametrize("name", sampled([*DESIGNS, *TEMPLATES]))
def test_every_file_of_a_package_is_the_same_bytes_again(name, exported, tmp_path, run):
    folder = exported(name)
    run("export", design_file(name, folder), "--to", tmp_path, "--format", "csv,dxf,sheet,step", check=False)
    files = sorted(path.relative_to(tmp_path) for path in tmp_path.rglob("[!.]*") if path.is_file())
    assert len(files) > 5
    for file in files:
        assert (tmp_path / file).read_bytes() == (folder / file).read_bytes(), file


@pytest.mark.parametrize("name", sampled(["spiral-shaft-2018", "moving-box-2018", "spiral-shaft", "moving-box"]))
def test_the_turned_shaft_has_the_diameters_and_lengths_of_its_sheet(name, exported):
    folder = exported(name)
    texts = words(folder, "shaft")
    journal = next(float(match[1]) for text in texts if (match := re.match(rf"^Ø({NUMBER}) h6 \(", text)))
    thick = next(float(match[1]) for text in texts if (match := re.fullmatch(rf"Ø({NUMBER})", text)))
    shape = solid(folder / "shaft.step")
    radii = {round(radius, 6) for radius in turned_radii(shape)}
    assert {journal / 2, thick / 2} <= radii
    bounds = Bnd_Box()
    BRepBndLib.AddOptimal_s(shape, bounds, True, False)
    low, high = bounds.CornerMin(), bounds.CornerMax()
    longest = max(high.X() - low.X(), high.Y() - low.Y(), high.Z() - low.Z())
    lengths = [float(text) for text in texts if re.fullmatch(r"\d+(\.\d+)?", text)]
    assert min(abs(longest - x) for x in lengths) < 6e-4
    # Two journals and what lies between them are the whole length.
    (short,) = {x for x in lengths if lengths.count(x) >= 2 and any(abs(longest - 2 * x - y) < 2e-3 for y in lengths)}
    assert short > 0
    assert any(text.startswith("Centre holes at both ends: ISO 6411-A") for text in texts)


def turned_radii(shape):
    """Radii of the round faces of a solid."""
    explorer = TopExp_Explorer(shape, TopAbs_FACE)
    while explorer.More():
        surface = BRepAdaptor_Surface(TopoDS.Face(explorer.Current()))
        if surface.GetType() == GeomAbs_Cylinder:
            yield surface.Cylinder().Radius()
        explorer.Next()


TURNED = re.compile(r"^Turned; contour: ([\w-]+)\.dxf\.$")
GROOVE = re.compile(rf"^groove ({NUMBER}) H13 \(")
CHAMFER = re.compile(rf"^({NUMBER}) x 45°, both ends$")
REST = re.compile(rf"^({NUMBER}) \(0 / -0\.[12]00\)$")
SLOT = re.compile(rf"^({NUMBER}) N9 \(")
LENGTH = re.compile(rf"^({NUMBER})(?: \(([+-]\d\.\d+|0) / ([+-]\d\.\d+|0)\))?$")


def ring_of(lines):
    """Thickness of the ring that a groove is for."""
    return next(
        float(match[1]) for line in lines if (match := re.match(rf"^for Circlip DIN 471 - \S+ x ({NUMBER})$", line))
    )


def turned_steps(texts):
    """Steps of a turned part from the left by its sheet: diameter, length, whether the keyway is in it; its chamfer."""
    sized = [i for i, text in enumerate(texts) if HOLE.match(text)]
    # The view has the chamfers; the section across the keyway, notes and title block come before or after it.
    first = next((i for i, text in enumerate(texts) if CHAMFER.match(text)), sized[0])

    def ends(text):
        others = text == "Material" or text.endswith(" for each machine.") or text.startswith("C-C ")
        return others or REST.match(text)

    before = next((i for i in range(first, -1, -1) if ends(texts[i])), 0)
    end = next(i for i, text in enumerate(texts) if i > first and ends(text))
    view = texts[before:end]
    notes = [i for i, text in enumerate(view) if HOLE.match(text)]
    chamfers = [(i, float(match[1])) for i, text in enumerate(view) if (match := CHAMFER.match(text))]
    steps = []
    # Notes follow each other from the right.
    for first, last in pairwise([*notes, len(view)]):
        lines = view[first:last]
        step = {"diameter": float(HOLE.match(lines[0])[1]), "keyed": "with keyway" in lines}
        widths = [float(match[1]) for line in lines if (match := GROOVE.match(line))]
        steps.insert(0, step | ({"length": widths[0], "groove": ring_of(lines)} if widths else {}))
    plain = [step for step in steps if "length" not in step]
    # Below the view every length but those of grooves and of the last step, and that over all.
    before = chamfers[0][0] if chamfers else notes[0]
    *lengths, whole = (LENGTH.match(text) for text in view[before - len(plain) : before])
    whole = float(whole[1])
    for step, text in zip(plain[:-1], lengths, strict=True):
        step["length"] = float(text[1])
        if text[2]:
            # From groove to groove, with its deviations: what is before this step in it has a length of its own.
            earlier = steps[: next(i for i, other in enumerate(steps) if other is step)]
            for other in reversed(earlier):
                if "groove" in other:
                    break
                step["length"] -= other["length"]
            step["held"] = (float(text[1]), float(text[3]), float(text[2]))
    plain[-1]["length"] = whole - sum(step.get("length", 0.0) for step in steps)
    return steps, chamfers[0][1] if chamfers else 0.0


def profile(steps, chamfer):
    """Silhouette of a turned part, its axis along x."""
    x, upper = 0.0, []
    for step in steps:
        upper += [(x, step["diameter"] / 2), (x + step["length"], step["diameter"] / 2)]
        x += step["length"]
    (x0, r0), (x1, r1) = upper[0], upper[-1]
    upper[0:1] = [(x0, r0 - chamfer), (x0 + chamfer, r0)]
    upper[-1:] = [(x1 - chamfer, r1), (x1, r1 - chamfer)]
    return Polygon([*upper, *((x, -r) for x, r in reversed(upper))])


def revolved(polygon):
    """Volume of a silhouette turned about its axis, cone by cone."""
    upper = [(x, r) for x, r in polygon.exterior.coords[:-1] if r > 0]
    cones = ((b[0] - a[0]) * (a[1] ** 2 + a[1] * b[1] + b[1] ** 2) for a, b in pairwise(upper))
    return abs(sum(cones)) * math.pi / 3


def slot_area(radius, width, foot):
    """Area that a keyway takes of a disc."""
    half = width / 2
    return half * math.sqrt(radius**2 - half**2) + radius**2 * math.asin(half / radius) - width * foot


def milled_ends(steps):
    """Steps in which the keyway ends half round: those next to one that is as thick without it."""
    for step, other in [*pairwise(steps), *((b, a) for a, b in pairwise(steps))]:
        if step["keyed"] and not other["keyed"] and step["diameter"] == other["diameter"]:
            yield step


def end_corners(radius, width, foot):
    """Volume between a half round end of a keyway and a plane one, by the midpoints of strips across it."""
    half, count = width / 2, 2000
    places = (half * (i + 0.5) / count for i in range(count))
    strips = ((half - math.sqrt(half**2 - y**2)) * (math.sqrt(radius**2 - y**2) - foot) for y in places)
    return 2 * sum(strips) * half / count


def walls(shape):
    """Round faces of a solid along z: radius, lower end, upper end."""
    for face in pieces(shape, TopAbs_FACE):
        surface = BRepAdaptor_Surface(TopoDS.Face(face))
        if surface.GetType() == GeomAbs_Cylinder:
            base = surface.Cylinder().Location().Z()
            ends = sorted((base + surface.FirstVParameter(), base + surface.LastVParameter()))
            yield surface.Cylinder().Radius(), *ends


@pytest.mark.parametrize("name", sampled([*DESIGNS, *TEMPLATES]))
def test_a_turned_part_made_from_its_sheet_alone_is_its_solid(name, exported):
    folder = exported(name)
    for row in parts(folder):
        part = row["files"]
        texts = words(folder, part)
        if not any(TURNED.match(text) for text in texts):
            continue
        steps, chamfer = turned_steps(texts)
        outline = profile(steps, chamfer)
        (drawn,) = reading.contours(folder / f"{part}.dxf")
        assert drawn.symmetric_difference(outline).area < 2e-3 * outline.length, part
        volume = revolved(outline)
        keyed = [step for step in steps if step["keyed"]]
        if keyed:
            width = next(float(match[1]) for text in texts if (match := SLOT.match(text)))
            rest = next(float(match[1]) for text in texts if (match := REST.match(text)))
            foot = rest - max(step["diameter"] for step in steps) / 2
            for step in keyed:
                volume -= step["length"] * slot_area(step["diameter"] / 2, width, foot)
            volume += sum(end_corners(step["diameter"] / 2, width, foot) for step in milled_ends(steps))
            ends = (steps[0], steps[-1])
            for end in (end for end in ends if end["keyed"]):
                radius = end["diameter"] / 2
                mean = sum(slot_area(radius - chamfer * (i + 0.5) / 100, width, foot) for i in range(100))
                volume += chamfer * (slot_area(radius, width, foot) - mean / 100)
        shape = solid(folder / f"{part}.step")
        properties = GProp_GProps()
        BRepGProp.VolumeProperties_s(shape, properties)
        # Lengths are written to a micrometre.
        assert abs(properties.Mass() / volume - 1) < 5e-5, (part, properties.Mass(), volume)
        found, at = list(walls(shape)), chamfer
        # Steps of one diameter are one cylinder, in faces that the ends of a keyway part.
        for diameter, alike in groupby(steps, key=lambda step: step["diameter"]):
            alike = list(alike)
            ends = chamfer * ((alike[0] is steps[0]) + (alike[-1] is steps[-1]))
            low, at = at, at + sum(step["length"] for step in alike) - ends
            spans = sorted(
                (bottom, top)
                for radius, bottom, top in found
                if abs(2 * radius - diameter) < 1e-3 and low - 5e-3 < bottom and top < at + 5e-3
            )
            reached = low
            for bottom, top in spans:
                assert bottom < reached + 5e-3, (part, diameter, spans)
                reached = max(reached, top)
            assert abs(reached - at) < 5e-3, (part, diameter, low, at, spans)


def test_gears_of_a_machine_are_keyed_on_shafts_of_their_bore_as_both_sheets_tell(exported):
    folder = exported("press")
    listed = parts(folder)
    gears = [row for row in listed if re.match(r"^\d+ teeth", row["remark"])]
    shafts = [row for row in listed if row["part"].startswith("Shaft of ")]
    assert gears
    for gear in gears:
        assert "not" not in gear["remark"], gear
        # On the shaft that belongs to the same bodies.
        (shaft,) = (row for row in shafts if set(gear["links"].split()) <= set(row["links"].split()))
        told = words(folder, gear["files"])
        bore = next(float(match[1]) for text in told if (match := re.match(rf"^Ø({NUMBER}) H7 \(", text)))
        key = next(float(match[1]) for text in told if (match := re.match(rf"^({NUMBER}) JS9 \(", text)))
        texts = words(folder, shaft["files"])
        steps, _ = turned_steps(texts)
        assert {step["diameter"] for step in steps if "groove" not in step} == {bore}, gear
        slot = next(float(match[1]) for text in texts if (match := SLOT.match(text)))
        assert key == slot, gear
        wide = thickness(solid(folder / f"{gear['files']}.step"))
        # The keyway next to it may begin under the gear: its lengths follow each other.
        lengths = [step["length"] if step["keyed"] and "groove" not in step else math.nan for step in steps]
        spans = [sum(lengths[i:k]) for i in range(len(lengths)) for k in range(i + 1, len(lengths) + 1)]
        assert any(abs(length - wide) < 1e-3 for length in spans), (gear, lengths)


def general(length):
    """Deviation either way that ISO 2768-m allows a length."""
    return next(off for most, off in ((3, 0.1), (6, 0.1), (30, 0.2), (120, 0.3), (400, 0.5)) if length <= most)


# What lies between the rings of shafts and pins, from the lower end on. The hub of an arm has no sheet: the parts list
# tells its length.
HELD = {
    "feeder": {
        "shaft-a": [["gear-driven"], ["frame"]],
        "shaft-g": [["gear-entry-cam"], ["gear-driver"], ["gear-exit-cam"], ["frame"]],
        "pin-b": [["crank", "coupler"]],
        "pin-c": [["coupler", "rocker", "slider"]],
        "pin-d": [["frame", "spacer", "frame"]],
        "pin-f": [["effector", "frame"]],
    },
    "three-arm": {
        "shaft-intermediate": [["carrier", "spacer", "carrier"]],
        "shaft-planet": [["carrier", "spacer", "carrier", "hub"]],
    },
}


@pytest.mark.parametrize("name", sampled(name for name in [*DESIGNS, *TEMPLATES] if family(name) in HELD))
def test_what_rings_hold_has_play_along_the_axis_whatever_the_tolerances_make_of_it(name, exported):
    """Minimum axial clearance from the sheets alone: the shortest room between rings, minus the thickest parts."""
    folder = exported(name)

    def thickness_told(part):
        if part == "hub":
            with (folder / "parts.csv").open(newline="") as lines:
                remark = next(row["remark"] for row in csv.DictReader(lines) if row["part"] == "Hub of an arm")
            return float(re.search(rf"; from {NUMBER} to ({NUMBER}) before", remark)[1])
        return round(thickness(solid(folder / f"{part}.step")), 6)

    told = 0
    for part, stacks in HELD[family(name)].items():
        if not (folder / f"{part}.step").exists():
            continue
        steps, _ = turned_steps(words(folder, part))
        grooves = [i for i, step in enumerate(steps) if "groove" in step]
        # Groove to groove, the first and last of each room those that hold what is in it.
        rooms = [(low, high) for low, high in pairwise(grooves) if high > low + 1]
        tight = []
        for low, high in rooms:
            between = steps[low + 1 : high]
            length = sum(step["length"] for step in between)
            held = next((step["held"] for step in between if "held" in step), None)
            least = held[0] + held[1] if held else length - general(length)
            tight.append((least, steps[low], steps[high], held))
        for stack in stacks:
            thick = [thickness_told(other) for other in stack]
            most = sum(t + general(t) for t in thick)
            # The smallest room not taken yet that is about as long as the stack.
            room = min((room for room in tight if room[0] + 0.5 > sum(thick)), key=lambda room: room[0])
            tight.remove(room)
            least, low, high, held = room
            # Rings give way to the far wall of their grooves, which are at least as wide as told. One that holds what
            # is beyond it does not: rooms of shaft G but its first have one such.
            away = [low, high] if part != "shaft-g" or stack == stacks[0] else [high]
            slack = sum(groove["length"] - groove["groove"] for groove in away)
            assert least + slack - most >= 0.05 - 1e-6, (part, stack, least, slack, most)
            told += held is not None
    assert told, name
