"""Parts of every shipped design, made again from their sheets alone and held against their solids."""

import csv
import math
import re
from itertools import pairwise

import pytest
import tomllib
from conftest import ROOT
from OCP.Bnd import Bnd_Box
from OCP.BRepAdaptor import BRepAdaptor_Surface
from OCP.BRepBndLib import BRepBndLib
from OCP.BRepGProp import BRepGProp
from OCP.GeomAbs import GeomAbs_Cylinder
from OCP.GProp import GProp_GProps
from OCP.IFSelect import IFSelect_RetDone
from OCP.STEPControl import STEPControl_Reader
from OCP.TopAbs import TopAbs_FACE
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS
from reading import texts
from shapely.geometry import Polygon

DESIGNS = sorted(path.stem for path in (ROOT / "tests" / "designs").glob("*.toml"))
# Families whose parts are plates, gears and cams alone.
FLAT = ("feeder", "machine", "three-arm")
NUMBER = r"-?[\d.]+"
HOLE = re.compile(rf"^(?:[^:]+: )?Ø({NUMBER})(?: (\S+))?")
PLACE = re.compile(rf"^at ({NUMBER}), ({NUMBER})")
KEYWAY = re.compile(rf"^keyway ({NUMBER})")
KEYED = re.compile(rf"^Ø \+ depth ({NUMBER}) \(\+0\.100 / 0\), at {NUMBER}°$")
ENDS = re.compile(rf"^R({NUMBER}) about ({NUMBER}), ({NUMBER}) and ({NUMBER}), ({NUMBER})$")


@pytest.fixture(scope="module")
def exported(shipped):
    """Folder of a design's files, written once."""
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
    return tomllib.loads((ROOT / "tests" / "designs" / f"{name}.toml").read_text())["family"]


@pytest.mark.parametrize("name", DESIGNS)
def test_every_part_with_files_has_a_drawing_a_solid_a_sheet_and_a_material(name, exported):
    folder = exported(name)
    listed = parts(folder)
    assert listed
    for row in listed:
        part = row["files"]
        assert (folder / f"{part}.dxf").exists(), part
        assert (folder / f"{part}.step").exists(), part
        assert list(folder.glob(f"{part}-sheet*.dxf")), part
        assert row["material"], part


@pytest.mark.parametrize("name", [name for name in DESIGNS if family(name) in FLAT])
def test_every_file_named_on_a_sheet_exists(name, exported):
    folder = exported(name)
    for row in parts(folder):
        for text in words(folder, row["files"]):
            for file in re.findall(r"[\w-]+\.(?:dxf|step|csv)\b", text):
                assert (folder / file).exists(), (row["files"], text)


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
        sense = math.copysign(1.0, turns) * (-1 if "hollow" in notes else 1)
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


def cylinders(shape):
    """Axes and radii of the round faces."""
    explorer = TopExp_Explorer(shape, TopAbs_FACE)
    while explorer.More():
        surface = BRepAdaptor_Surface(TopoDS.Face(explorer.Current()))
        if surface.GetType() == GeomAbs_Cylinder:
            cylinder = surface.Cylinder()
            at = cylinder.Location()
            yield at.X(), at.Y(), cylinder.Radius()
        explorer.Next()


@pytest.mark.parametrize("name", [name for name in DESIGNS if family(name) in FLAT])
def test_a_plate_made_from_its_sheet_alone_is_its_solid(name, exported):
    folder = exported(name)
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
        (first,) = [i for i, text in enumerate(texts) if text.endswith(" of these a machine.")]
        views = texts[first : texts.index("Contour")]
        numbers = [float(text) for text in views if re.fullmatch(r"\d+(\.\d+)?", text)]
        for side in (high.X() - low.X(), high.Y() - low.Y(), high.Z() - low.Z()):
            assert min(abs(side - x) for x in numbers) < 6e-4, (part, side)
        thickness = high.Z() - low.Z()
        properties = GProp_GProps()
        BRepGProp.VolumeProperties_s(shape, properties)
        if "opening" in outlines:
            # A wall may have a bore through it that is told in words.
            assert properties.Mass() <= area * thickness + 1e-3 * length * thickness, part
            continue
        # Corners are written to a micrometre.
        assert abs(properties.Mass() - area * thickness) < 1e-3 * length * thickness, part
    assert made
