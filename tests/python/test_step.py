"""STEP files as another CAD kernel reads them."""

import math
from collections import Counter

import pytest
from OCP.APIHeaderSection import APIHeaderSection_MakeHeader
from OCP.BRep import BRep_Tool
from OCP.BRepAdaptor import BRepAdaptor_Surface
from OCP.BRepCheck import BRepCheck_Analyzer
from OCP.BRepGProp import BRepGProp
from OCP.GeomAbs import GeomAbs_Cylinder, GeomAbs_Plane, GeomAbs_SurfaceOfExtrusion
from OCP.GProp import GProp_GProps
from OCP.IFSelect import IFSelect_RetDone
from OCP.StepBasic import StepBasic_Product
from OCP.STEPControl import STEPControl_Reader
from OCP.TopAbs import TopAbs_EDGE, TopAbs_FACE, TopAbs_SHELL, TopAbs_SOLID, TopAbs_VERTEX
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS
from reading import GEARS, outline
from test_solids import WIDTH

# Diameter of the bore, width and depth of its keyway, mm.
BORES = {("elliptic", "driver"): (12, 4, 1.8), ("elliptic", "driven"): (12, 0, 0)}


@pytest.fixture(params=GEARS)
def solid(exported, request):
    """A design's name, a gear's name, and the reader that has read its file."""
    reader = STEPControl_Reader()
    assert reader.ReadFile(str(exported / f"{request.param}.step")) == IFSelect_RetDone
    assert reader.TransferRoots() == 1
    return exported, request.param, reader


def uses(shape, kind):
    """Every use of a face, edge ... in a shape."""
    explorer = TopExp_Explorer(shape, kind)
    while explorer.More():
        yield explorer.Current()
        explorer.Next()


def bore_area(diameter, width, depth):
    """Area of a round bore united with its keyway."""
    radius, half = diameter / 2, width / 2
    within = half * math.sqrt(radius**2 - half**2) + radius**2 * math.asin(half / radius)
    return math.pi * radius**2 + width * (radius + depth) - within if width else math.pi * radius**2


def test_a_gear_is_one_valid_closed_solid_without_repair(solid):
    _, _, reader = solid
    shape = reader.OneShape()
    assert shape.ShapeType() == TopAbs_SOLID
    assert BRepCheck_Analyzer(shape).IsValid()
    (shell,) = uses(shape, TopAbs_SHELL)
    assert BRep_Tool.IsClosed_s(shell)
    # Edges meet within the accuracy the file claims: the reader widened none.
    assert max(BRep_Tool.Tolerance_s(TopoDS.Vertex(v)) for v in uses(shape, TopAbs_VERTEX)) <= 1.001e-7
    assert max(BRep_Tool.Tolerance_s(TopoDS.Edge(e)) for e in uses(shape, TopAbs_EDGE)) <= 1.001e-7


def test_the_volume_is_that_of_the_section(solid, run, tmp_path):
    export, gear, reader = solid
    run("export", export.design, "--to", tmp_path, "--format", "csv", "--tolerance", "1e-6")
    hole = BORES.get((export.name, gear))
    area = outline(tmp_path, gear).area - (bore_area(*hole) if hole else 0)
    properties = GProp_GProps()
    BRepGProp.VolumeProperties_s(reader.OneShape(), properties, 1e-10)
    assert properties.Mass() == pytest.approx(area * WIDTH[export.name], rel=1e-6)


def test_faces_are_curved_and_every_edge_joins_two(solid):
    export, gear, reader = solid
    shape = reader.OneShape()
    faces = list(uses(shape, TopAbs_FACE))
    walls = len(faces) - 2
    edges = Counter(hash(edge) for edge in uses(shape, TopAbs_EDGE))
    assert len(edges) == 3 * walls
    assert set(edges.values()) == {2}
    assert len({hash(vertex) for vertex in uses(shape, TopAbs_VERTEX)}) == 2 * walls
    kinds = Counter(BRepAdaptor_Surface(TopoDS.Face(face)).GetType() for face in faces)
    hole = BORES.get((export.name, gear))
    assert kinds[GeomAbs_Cylinder] == (2 if hole else 0)
    assert kinds[GeomAbs_Plane] == 2 + (3 if hole and hole[1] else 0)
    assert kinds.keys() <= {GeomAbs_Cylinder, GeomAbs_Plane, GeomAbs_SurfaceOfExtrusion}
    teeth = export.report()["values"][f"{gear}_tooth_count"]
    assert 4 * teeth <= kinds[GeomAbs_SurfaceOfExtrusion] <= 20 * teeth


def test_the_product_is_named_after_the_gear_and_the_file_after_the_design(solid):
    export, gear, reader = solid
    model = reader.StepModel()
    entities = (model.Entity(index + 1) for index in range(model.NbEntities()))
    names = [entity.Name().ToCString() for entity in entities if isinstance(entity, StepBasic_Product)]
    assert names == [gear]
    description = APIHeaderSection_MakeHeader(model).DescriptionValue(1).ToCString()
    assert export.name in description
    assert gear in description
