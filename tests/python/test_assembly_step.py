"""The whole machine as one STEP file, read by another CAD kernel with its names, places and colours."""

import csv
import math
import re
from collections import Counter
from functools import cache
from itertools import combinations
from xml.etree import ElementTree

import centrode as ct
import numpy as np
import pytest
from conftest import ROOT
from OCP.Bnd import Bnd_Box
from OCP.BRepAdaptor import BRepAdaptor_Surface
from OCP.BRepAlgoAPI import BRepAlgoAPI_Common
from OCP.BRepBndLib import BRepBndLib
from OCP.BRepCheck import BRepCheck_Analyzer
from OCP.BRepExtrema import BRepExtrema_DistShapeShape
from OCP.BRepGProp import BRepGProp
from OCP.collections import Sequence_TDF_Label
from OCP.GeomAbs import GeomAbs_Cylinder
from OCP.gp import gp_Trsf
from OCP.GProp import GProp_GProps
from OCP.IFSelect import IFSelect_RetDone
from OCP.Quantity import Quantity_Color
from OCP.STEPCAFControl import STEPCAFControl_Reader
from OCP.TCollection import TCollection_ExtendedString
from OCP.TDataStd import TDataStd_Name
from OCP.TDF import TDF_Label
from OCP.TDocStd import TDocStd_Document
from OCP.TopAbs import TopAbs_FACE, TopAbs_SOLID
from OCP.TopExp import TopExp_Explorer
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS
from OCP.XCAFDoc import (
    XCAFDoc_ColorSurf,
    XCAFDoc_ColorTool,
    XCAFDoc_DocumentTool,
    XCAFDoc_Material,
    XCAFDoc_ShapeTool,
)
from reading import is_mounted, is_turned
from sample import sampled

# Gears in place, loops, cams on forks, a shaft with a groove.
DESIGNS = ("elliptic-pair-2018", "jansen-leg", "feeder-2022", "three-arm-2021", "spiral-shaft-2018", "moving-box-2018")
# Machines with shafts or pins.
TURNED = ("press", "feeder-2022", "three-arm-2021", "spiral-shaft-2018", "three-arm-all-goals")


def listed(sequence):
    return [sequence.Value(i) for i in range(1, sequence.Length() + 1)]


def called(label):
    name = TDataStd_Name()
    assert label.FindAttribute(TDataStd_Name.GetID_s(), name)
    return name.Get().ToExtString()


def materials(file):
    """Material of each product that has one, by name, as the file has it."""
    entities = dict(re.findall(r"^#(\d+)=(.+);$", file.read_text(), re.MULTILINE))

    def referred(number):
        return re.findall(r"#(\d+)", entities[number])

    found = {}
    for number, entity in entities.items():
        if entity.startswith("PROPERTY_DEFINITION_REPRESENTATION("):
            definition, told = referred(number)
            if "'material name'" in entities[definition]:
                (product,) = referred(referred(referred(definition)[0])[0])[:1]
                (item, _) = referred(told)
                found[re.match(r"PRODUCT\('(.*?)'", entities[product])[1]] = re.search(r"\('(.*?)'", entities[item])[1]
    return found


def parts(folder):
    """Rows of the parts list."""
    with (folder / "parts.csv").open(newline="") as lines:
        return list(csv.DictReader(lines))


def every(shape, kind):
    found = TopExp_Explorer(shape, kind)
    while found.More():
        yield found.Current()
        found.Next()


def moved(shape, place):
    transformation = gp_Trsf()
    transformation.SetValues(*place.flatten())
    return shape.Moved(TopLoc_Location(transformation))


def cylinders(shape):
    """A point, the direction and the radius of every cylinder of a shape."""
    for face in every(shape, TopAbs_FACE):
        surface = BRepAdaptor_Surface(TopoDS.Face(face))
        if surface.GetType() == GeomAbs_Cylinder:
            cylinder = surface.Cylinder()
            at, way = cylinder.Axis().Location(), cylinder.Axis().Direction()
            yield np.array([at.X(), at.Y(), at.Z()]), np.array([way.X(), way.Y(), way.Z()]), cylinder.Radius()


def box(shape):
    bounds = Bnd_Box()
    BRepBndLib.AddOptimal_s(shape, bounds, False, False)
    low, high = bounds.CornerMin(), bounds.CornerMax()
    return np.array([[low.X(), low.Y(), low.Z()], [high.X(), high.Y(), high.Z()]])


class Assembly:
    """The pieces of a file: name, product, place."""

    def __init__(self, file):
        self.document = TDocStd_Document(TCollection_ExtendedString("XmlXCAF"))
        reader = STEPCAFControl_Reader()
        reader.SetNameMode(True)
        reader.SetColorMode(True)
        reader.SetMatMode(True)
        assert reader.ReadFile(str(file)) == IFSelect_RetDone
        assert reader.Transfer(self.document)
        self.tool = XCAFDoc_DocumentTool.ShapeTool_s(self.document.Main())
        self.colors = XCAFDoc_DocumentTool.ColorTool_s(self.document.Main())
        roots = Sequence_TDF_Label()
        self.tool.GetFreeShapes(roots)
        (self.root,) = listed(roots)
        pieces = Sequence_TDF_Label()
        assert XCAFDoc_ShapeTool.GetComponents_s(self.root, pieces)
        self.pieces = []
        self.materials = materials(file)
        for piece in listed(pieces):
            product = TDF_Label()
            assert XCAFDoc_ShapeTool.GetReferredShape_s(piece, product)
            place = XCAFDoc_ShapeTool.GetLocation_s(piece).Transformation()
            matrix = np.array([[place.Value(i, j) for j in range(1, 5)] for i in range(1, 4)])
            self.pieces.append((called(piece), called(product), matrix, XCAFDoc_ShapeTool.GetShape_s(product)))

    def made_of(self):
        """Names of the materials that the reader has found, one a product."""
        tool = XCAFDoc_DocumentTool.MaterialTool_s(self.document.Main())
        labels = Sequence_TDF_Label()
        tool.GetMaterialLabels(labels)
        for label in listed(labels):
            material = XCAFDoc_Material()
            assert label.FindAttribute(XCAFDoc_Material.GetID_s(), material)
            yield material.GetName().ToCString()

    def painted(self):
        """Colours of the products' bodies."""
        shapes = Sequence_TDF_Label()
        self.tool.GetShapes(shapes)
        for label in listed(shapes):
            if XCAFDoc_ShapeTool.IsAssembly_s(label):
                continue
            bodies = Sequence_TDF_Label()
            XCAFDoc_ShapeTool.GetSubShapes_s(label, bodies)
            for body in [label, *listed(bodies)]:
                color = Quantity_Color()
                if XCAFDoc_ColorTool.GetColor_s(body, XCAFDoc_ColorSurf, color):
                    yield color.Red(), color.Green(), color.Blue()


def volume(shape):
    properties = GProp_GProps()
    BRepGProp.VolumeProperties_s(shape, properties)
    return properties.Mass()


@pytest.fixture(scope="module")
def assembled(shipped):
    """Folder of a design and its assembly, exported and read once."""

    @cache
    def read(name):
        folder = shipped(name, "csv,step,urdf" if name == "feeder-2022" else "csv,step")
        return folder, Assembly(folder / "assembly.step")

    return read


@pytest.mark.parametrize("name", sampled(DESIGNS, of=("jansen-leg", "spiral-shaft-2018", "three-arm-2021")))
def test_every_piece_is_a_sound_solid_that_stands_where_its_link_does(name, assembled):
    machine = ct.load(ROOT / "tests" / "designs" / f"{name}.toml")
    _, assembly = assembled(name)
    assert called(assembly.root) == (machine.title or machine.name)
    frames = machine.frames(0.0)
    assert assembly.pieces
    for link, product, place, _ in assembly.pieces:
        if name != "three-arm-2021" and not is_mounted(product):
            # The arrangement shows this machine as an arm picks, all others where the cycle begins.
            np.testing.assert_allclose(place, np.reshape(frames[link], (4, 4))[:3], atol=1e-12)
    checked = {product: shape for _, product, _, shape in assembly.pieces}
    for product, shape in checked.items():
        assert BRepCheck_Analyzer(shape).IsValid(), product
        solids = TopExp_Explorer(shape, TopAbs_SOLID)
        while solids.More():
            assert volume(solids.Current()) > 0, product
            solids.Next()


def test_bodies_are_written_once_and_colored(assembled):
    folder, assembly = assembled("three-arm-2021")
    counts = Counter(product for _, product, _, _ in assembly.pieces)
    bodies = (folder / "assembly.step").read_text().count("=MANIFOLD_SOLID_BREP(")
    painted = list(assembly.painted())
    # Three arms of each body.
    assert len(assembly.pieces) > 2 * len(counts)
    assert bodies < len(assembly.pieces)
    assert len(painted) >= len(counts)
    assert len(set(painted)) > 4


@pytest.mark.parametrize(("name", "density"), [("jansen-leg", 1200), ("feeder-2022", 7850)])
def test_pieces_weigh_what_the_parts_list_says(name, density, assembled):
    folder, assembly = assembled(name)
    rows = [row for row in parts(folder) if row["files"] and row["mass_kg"]]
    weighed = {product: volume(shape) * density * 1e-9 for _, product, _, shape in assembly.pieces}
    assert len(rows) > 3
    for row in rows:
        # All pieces of a part that is on one link are one product: two plates of a frame.
        pieces = int(row["quantity"]) if row["files"] == "frame" else 1
        assert math.isclose(weighed[row["files"]], pieces * float(row["mass_kg"]), rel_tol=1e-6), row["part"]


def test_gears_and_plates_of_the_feeder_stand_clear_of_each_other(assembled):
    _, assembly = assembled("feeder-2022")
    heights = {}
    for _, product, place, shape in assembly.pieces:
        if is_mounted(product):
            continue
        assert np.allclose(place[2], [0, 0, 1, 0])
        solids = TopExp_Explorer(shape, TopAbs_SOLID)
        while solids.More():
            box = Bnd_Box()
            BRepBndLib.AddOptimal_s(solids.Current(), box, False, False)
            heights.setdefault(product, []).append((box.CornerMin().Z(), box.CornerMax().Z()))
            solids.Next()
    assert len(heights["frame"]) == 2
    assert {"gear-driver", "gear-driven", "gear-entry-cam", "gear-exit-cam"} < set(heights)
    # In one layer are the gears, which mesh, and the slider in its slot.
    together = [{"gear-driver", "gear-driven"}, {"effector", "slider"}]
    spans = [(product, span) for product, all_spans in heights.items() for span in all_spans]
    for (one, (low, high)), (other, (bottom, top)) in combinations(spans, 2):
        if {one, other} not in together:
            assert high < bottom or top < low, (one, other)


@pytest.mark.parametrize("name", sampled([*DESIGNS, "composed-feeder", "composed-three-arm", "press"]))
def test_everything_that_is_made_and_bought_is_a_solid_of_its_material(name, assembled):
    folder, assembly = assembled(name)
    listed = parts(folder)
    # Of a shaft that is given no place is known, nor of its key.
    given = [row["links"] for row in listed if row["supply"] == "given" and row["part"].startswith("Shaft of")]
    given = {link for links in given for link in links.split()}
    drawn = [
        row for row in listed if row["files"] or (row["supply"] == "bought" and not given & {*row["links"].split()})
    ]
    solids = [solid for *_, shape in assembly.pieces for solid in every(shape, TopAbs_SOLID)]
    assert len(solids) == sum(int(row["quantity"]) for row in drawn)
    of_file = {row["files"]: row["material"] for row in drawn if row["files"]}
    named = {product: material for product, material in assembly.materials.items() if product in of_file}
    assert named == {product: of_file[product] for product in named}
    assert set(filter(is_turned, of_file)) <= set(named)
    assert sorted(assembly.made_of()) == sorted(assembly.materials.values())
    bought = {material for product, material in assembly.materials.items() if re.match("(circlip|key)-", product)}
    assert bought <= {"spring steel", "steel"}
    rings = [row for row in drawn if row["part"].startswith("Circlip")]
    assert ("spring steel" in bought) == bool(rings)
    assert len(list(assembly.painted())) >= len(assembly.materials)


@pytest.mark.parametrize("name", sampled(TURNED))
def test_shafts_and_pins_sit_in_their_bores(name, assembled):
    _, assembly = assembled(name)
    pieces = [(product, moved(shape, place)) for _, product, place, shape in assembly.pieces]
    turned = [(product, shape) for product, shape in pieces if is_turned(product)]
    others = [
        (product, shape, box(shape), list(cylinders(shape))) for product, shape in pieces if not is_turned(product)
    ]
    assert turned
    for product, shape in turned:
        own = list(cylinders(shape))
        at, way, _ = own[0]
        widest = max(radius for *_, radius in own)
        low, high = box(shape)
        seats = 0
        for other, body, (under, over), bores in others:
            if (low > over).any() or (under > high).any():
                continue
            # Bores round the axis of the part: none but on it.
            for point, direction, radius in bores:
                off = np.linalg.norm(np.cross(point - at, way))
                if np.linalg.norm(np.cross(direction, way)) < 1e-9 and off < 0.5 * widest and radius < 1.2 * widest:
                    assert off < 1e-6, (product, other)
                    seats += any(math.isclose(radius, step, abs_tol=1e-6) for *_, step in own)
            common = BRepAlgoAPI_Common(shape, body)
            assert common.IsDone()
            assert volume(common.Shape()) < 1e-6 * volume(shape), (product, other)
        assert seats, product


@pytest.mark.parametrize("name", sampled(TURNED))
def test_rings_keys_and_bearings_lie_on_their_shafts_clear_of_everything(name, assembled):
    folder, assembly = assembled(name)
    pieces = [(link, product, moved(shape, place)) for link, product, place, shape in assembly.pieces]
    boxed = [(link, product, shape, box(shape)) for link, product, shape in pieces]
    of_shafts = re.compile(r"(circlip|key)-din-|deep-groove-")
    bought = [piece for piece in boxed if of_shafts.match(piece[1])]
    listed = [row for row in parts(folder) if re.match("Circlip|Key|Deep groove", row["part"])]
    assert len(bought) == sum(int(row["quantity"]) for row in listed)
    for link, product, shape, (low, high) in bought:
        size, held = volume(shape), 0
        for carrier, other, body, (under, over) in boxed:
            if body is shape or (low > over + 1e-3).any() or (under > high + 1e-3).any():
                continue
            common = BRepAlgoAPI_Common(shape, body)
            assert common.IsDone()
            assert volume(common.Shape()) < 1e-6 * size, (product, other)
            if carrier == link and is_turned(other):
                apart = BRepExtrema_DistShapeShape(shape, body)
                held += apart.IsDone() and apart.Value() < 1e-6
        # On the bottom of the groove, or the floor of the keyway.
        assert held == 1, (link, product)
        diameter = re.match(r"circlip-din-471-(\d+)x", product)
        key = re.match(r"key-din-(?:6885-1|6880)-(.)-(\d+)x(\d+)x(\d+)", product)
        bearing = re.match(r"deep-groove-ball-bearing-iso-15-.+-(\d+)x(\d+)x(\d+)", product)
        sides = sorted(high - low)
        if diameter:
            assert sides[1] > float(diameter[1]), product
        elif bearing:
            inner, outer, width = map(float, bearing.groups())
            assert math.isclose(size, math.pi / 4 * (outer**2 - inner**2) * width, rel_tol=1e-9), product
        else:
            form, *sizes = key.groups()
            width, height, length = map(float, sizes)
            rounded = {"a": width * (length - width) + math.pi * width**2 / 4, "b": width * length}[form]
            assert math.isclose(size, height * rounded, rel_tol=1e-9), product


def test_links_weigh_what_is_mounted_on_them(assembled):
    """Mass and centre of a link of the simulator model are those the kernel integrates over its pieces."""
    folder, assembly = assembled("feeder-2022")
    weights = {}
    for link, _, place, shape in assembly.pieces:
        properties = GProp_GProps()
        BRepGProp.VolumeProperties_s(moved(shape, place), properties)
        at = properties.CentreOfMass()
        weights.setdefault(link, []).append((properties.Mass() * 7850e-9, np.array([at.X(), at.Y(), at.Z()])))
    frames = ct.load(ROOT / "tests" / "designs" / "feeder-2022.toml").frames(0.0)
    robot = ElementTree.parse(folder / "machine.urdf").getroot()
    compared = 0
    for element in robot.iter("link"):
        inertial = element.find("inertial")
        if inertial is None or element.get("name") not in weights:
            continue
        masses, centers = zip(*weights[element.get("name")], strict=True)
        assert math.isclose(float(inertial.find("mass").get("value")), sum(masses), rel_tol=1e-6), element.get("name")
        center = np.average(centers, axis=0, weights=masses)
        own = np.array([float(x) for x in inertial.find("origin").get("xyz").split()]) * 1e3
        frame = np.reshape(frames[element.get("name")], (4, 4))
        np.testing.assert_allclose((frame @ [*own, 1.0])[:3], center, atol=1e-5)
        compared += len(masses) > 1
    assert compared >= 4
