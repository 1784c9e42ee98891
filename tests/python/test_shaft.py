"""The files of a spiral shaft and a moving box as other programs read them."""

import csv
import json
import re
import subprocess
import sys
from collections import Counter

import ezdxf
import mujoco
import numpy as np
import pytest
import trimesh
import yourdfpy
from conftest import BINARY, ROOT, centrode
from ezdxf import path
from OCP.BRepAdaptor import BRepAdaptor_Surface
from OCP.BRepCheck import BRepCheck_Analyzer
from OCP.BRepGProp import BRepGProp
from OCP.GeomAbs import GeomAbs_BSplineSurface, GeomAbs_Cone, GeomAbs_Cylinder, GeomAbs_Plane
from OCP.GProp import GProp_GProps
from OCP.IFSelect import IFSelect_RetDone
from OCP.STEPControl import STEPControl_Reader
from OCP.TopAbs import TopAbs_FACE
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS
from reading import rows as table
from shapely.affinity import translate
from shapely.geometry import LineString, Point, Polygon, box
from shapely.ops import unary_union

MACHINES = ["spiral-shaft", "moving-box"]
RADIUS, DEPTH = 15.0, 4.0


@pytest.fixture(scope="session")
def machines(tmp_path_factory):
    """Both shipped machines, exported whole."""
    folder = tmp_path_factory.mktemp("machines")
    for name in MACHINES:
        design = ROOT / "tests" / "designs" / f"{name}-2018.toml"
        command = [BINARY, "export", design, "--to", folder / name, "--tolerance", "0.01", "--format", "all"]
        subprocess.run(command, check=True, capture_output=True)
    return folder


def step(path):
    """The one solid of a STEP file."""
    reader = STEPControl_Reader()
    assert reader.ReadFile(str(path)) == IFSelect_RetDone
    assert reader.TransferRoots() == 1
    return reader.OneShape()


def volume(shape):
    """Volume by the kernel's own integration, mm³."""
    properties = GProp_GProps()
    BRepGProp.VolumeProperties_s(shape, properties)
    return properties.Mass()


def grooved(area, length):
    """Volume of a cylinder with a sharp-cornered groove of a developed area, mm³."""
    floor = RADIUS - DEPTH
    whole = np.pi * RADIUS**2 * length
    # The walls are radial: over the groove's area the ring between floor and surface is missing.
    return whole - area / RADIUS * (RADIUS**2 - floor**2) / 2


def developed_area(folder):
    """Area of the groove on the development and length of the thick part, from the lead table alone."""
    rows = table(folder / "motion.csv")
    x, y = RADIUS * rows["shaft_angle_rad"], rows["position_mm"]
    around = 2 * np.pi * RADIUS
    way = LineString(np.column_stack([x, y])).buffer(5.0, quad_segs=64, cap_style="flat")
    turns = range(-1, round(x[-1] / around) + 1)
    strips = [way.intersection(box(k * around, -1e3, (k + 1) * around, 1e3)) for k in turns]
    laid = unary_union([translate(strip, -k * around, 0) for k, strip in zip(turns, strips, strict=True)])
    return laid.area, y.max() - y.min() + 2 * (5.0 + 8.0)


def test_the_shaft_is_one_valid_solid_of_real_surfaces(machines):
    shape = step(machines / "spiral-shaft" / "shaft.step")
    assert BRepCheck_Analyzer(shape).IsValid()
    explorer, kinds = TopExp_Explorer(shape, TopAbs_FACE), Counter()
    while explorer.More():
        kinds[BRepAdaptor_Surface(TopoDS.Face(explorer.Current())).GetType()] += 1
        explorer.Next()
    assert set(kinds) == {GeomAbs_BSplineSurface, GeomAbs_Cone, GeomAbs_Cylinder, GeomAbs_Plane}


def test_solids_enclose_what_the_development_says(machines):
    folder = machines / "spiral-shaft"
    area, length = developed_area(folder)
    mesh = trimesh.load(folder / "shaft.stl")
    assert mesh.is_watertight
    # Journals less chamfers and keyway, chamfers of the thick part.
    journal = 2 * (np.pi * 8.0**2 * 24.0 + np.pi * (8.0**2 + 8.0 * 7.0 + 7.0**2) / 3.0)
    shoulders = 2 * np.pi * (RADIUS**2 + RADIUS * 14.0 + 14.0**2) / 3.0
    slot = 5.0 * 3.0 * 18.0
    expected = grooved(area, length) + journal + shoulders - slot
    exact = volume(step(folder / "shaft.step"))
    assert exact == pytest.approx(expected, rel=1e-3)
    # The fillet, which the exact solid leaves out, and the mesh's chords.
    assert mesh.volume == pytest.approx(exact, rel=1e-3)
    assert volume(step(folder / "slider.step")) == pytest.approx(trimesh.load(folder / "slider.stl").volume, rel=1e-3)


@pytest.mark.parametrize("name", MACHINES)
def test_drawings_have_no_fault(machines, name):
    files = sorted((machines / name).glob("*.dxf"))
    assert {"groove.dxf", "shaft-sheet.dxf", "slider-sheet.dxf"} <= {file.name for file in files}
    for file in files:
        assert not ezdxf.readfile(file).audit().errors, file.name


def test_the_drawn_walls_stand_half_a_groove_off_the_way(machines):
    rows = table(machines / "spiral-shaft" / "motion.csv")
    way = LineString(np.column_stack([RADIUS * rows["shaft_angle_rad"], rows["position_mm"]]))
    around, turns = 2 * np.pi * RADIUS, 28
    drawing = ezdxf.readfile(machines / "spiral-shaft" / "groove.dxf").modelspace()
    walls = [entity for entity in drawing if entity.dxf.layer == "WALL"]
    assert len(walls) > 50
    for wall in walls[::7]:
        for x, y in list(wall.get_points("xy"))[1:-1:9]:
            nearest = min(way.distance(Point(x + k * around, y)) for k in range(-1, turns + 1))
            assert nearest == pytest.approx(5.0, abs=0.011)


@pytest.mark.parametrize("name", MACHINES)
def test_simulators_read_the_model(machines, name):
    robot = yourdfpy.URDF.load(str(machines / name / "machine.urdf"))
    joint = robot.joint_map["box_joint"]
    assert joint.type == "prismatic"
    assert joint.limit.upper > 0.26
    model = mujoco.MjModel.from_xml_path(str(machines / name / "machine.xml"))
    assert model.body("box").mass[0] + model.body("slider").mass[0] == pytest.approx(10.0)
    # Steel: a little more than the mesh, whose chords cut the round off, and by less than the tolerance all over.
    mesh = trimesh.load(machines / name / "shaft.stl")
    mass = model.body("shaft").mass[0]
    assert mesh.volume * 7850e-9 < mass < (mesh.volume + 0.01 * mesh.area) * 7850e-9


def test_mass_and_inertia_are_those_the_kernel_integrates(tmp_path):
    design = (ROOT / "tests" / "designs" / "spiral-shaft-2018.toml").read_text()
    sharp = tmp_path / "sharp.toml"
    # The exact solid in STEP leaves the fillet out.
    sharp.write_text(design.replace("holes = 14 ", "holes = 4 ").replace("fillet = 0.5 ", "fillet = 0 "))
    centrode("export", sharp, "--to", tmp_path, "--format", "step,urdf", "--tolerance", "0.1")
    kernel = GProp_GProps()
    BRepGProp.VolumeProperties_s(step(tmp_path / "shaft.step"), kernel, 1e-9)
    ours = yourdfpy.URDF.load(str(tmp_path / "machine.urdf"), load_meshes=False).link_map["shaft"].inertial
    density = 7850e-9
    assert ours.mass == pytest.approx(kernel.Mass() * density, rel=1e-7)
    center = kernel.CentreOfMass()
    center = np.array([center.X(), center.Y(), center.Z()])
    np.testing.assert_allclose(ours.origin[:3, 3] * 1e3, center, rtol=0, atol=1e-5)
    matrix = kernel.MatrixOfInertia()
    inertia = np.array([[matrix.Value(i, j) for j in (1, 2, 3)] for i in (1, 2, 3)]) * density * 1e-6
    np.testing.assert_allclose(ours.inertia, inertia, rtol=0, atol=1e-7 * inertia[2, 2])


def arrow(sheet):
    """Way the arrows of the cutting plane point along the shaft: each has its letter before its tip."""
    heads = [np.mean([e.dxf.vtx0.vec2, e.dxf.vtx1.vec2, e.dxf.vtx2.vec2], axis=0) for e in sheet.query("SOLID")]
    ways = []
    for letter in sheet.query("TEXT[text=='C' & height>3]"):
        at = np.array(letter.get_placement()[1].vec2)
        off = min((at - head for head in heads), key=lambda off: np.hypot(*off))
        # The letters of the sheet's zones have no arrow.
        if np.hypot(*off) < 8:
            ways.append(np.sign(off[0]))
    assert len(ways) == 2
    assert ways[0] == ways[1]
    return ways[0]


def sectioned(sheet):
    """The contour of section C-C about its centre, in millimetres of the part."""
    (title,) = [e for e in sheet.query("TEXT") if e.dxf.text.startswith("C-C (")]
    paper, part = map(float, re.fullmatch(r"C-C \(([\d.]+):([\d.]+)\)", title.dxf.text).groups())
    above = np.array(title.get_placement()[1].vec2)
    closed = [e for e in sheet.query("LWPOLYLINE[layer=='OUTLINE']") if e.closed and e.has_arc]
    contour = min(closed, key=lambda e: np.hypot(*(np.mean(e.get_points("xy"), axis=0) - above)))
    arcs = [e for e in contour.virtual_entities() if e.dxftype() == "ARC"]
    centre = np.mean([arc.dxf.center.vec2 for arc in arcs], axis=0)
    points = np.array([p.vec2 for p in path.make_path(contour).flattening(0.01)]) - centre
    return Polygon(points * part / paper)


@pytest.mark.parametrize("projection", ["first-angle", "third-angle"])
def test_section_c_c_is_the_solid_cut_there_and_seen_along_the_arrows(machines, tmp_path, projection):
    design = ROOT / "tests" / "designs" / "spiral-shaft-2018.toml"
    centrode("export", design, "--to", tmp_path, "--format", "sheet", "--projection", projection)
    sheet = ezdxf.readfile(sorted(tmp_path.glob("shaft-sheet*.dxf"))[0]).modelspace()
    mesh = trimesh.load(machines / "spiral-shaft" / "shaft.stl")
    # In the side view the axis z runs to the right and the angle zero, x, faces the viewer: -y is up.
    up, seen_from = np.array([0, -1, 0]), np.array([0, 0, -arrow(sheet)])
    right = np.cross(up, seen_from)
    # Through the middle of the keyway, 18 mm long from the near end.
    cut = mesh.section(plane_origin=[0, 0, mesh.bounds[0, 2] + 9], plane_normal=[0, 0, 1])
    (ring,) = cut.discrete
    solid = Polygon(np.column_stack([ring @ right, ring @ up]))
    drawn = sectioned(sheet)
    assert drawn.symmetric_difference(solid).area < 0.01 * solid.area
    mirrored = Polygon(np.asarray(drawn.exterior.coords) * [-1, 1])
    assert mirrored.symmetric_difference(solid).area > 0.05 * solid.area


def played(folder, *options):
    """What the script prints."""
    command = [sys.executable, folder / "play_mujoco.py", "--check", *options]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


@pytest.mark.parametrize("name", MACHINES)
def test_driven_by_forces_the_box_is_where_the_table_has_it(machines, name):
    result = played(machines / name, "--drive")
    assert 1e3 * result["joints"]["box_joint"]["off_max"] < 1e-3
    assert result["seconds"] == pytest.approx(28 * 60 / 200, rel=1e-3)
    # The push without the rails' friction is mass times acceleration.
    rows = table(machines / name / "motion.csv")
    for found, of in zip(result["joints"]["box_joint"]["force_range"], [min, max], strict=True):
        assert found == pytest.approx(10.0 * of(rows["acceleration_mm_per_s2"]) * 1e-3, rel=2e-3)


@pytest.mark.campaign
def test_turned_by_the_teeth_alone_the_box_follows(machines):
    result = played(machines / "moving-box", "--contact")
    # The shaft is driven by the teeth alone: it stays behind by their backlash.
    assert json.loads((machines / "moving-box" / "motion.json").read_text())["input"]["joint"] == "driver_joint"
    assert result["joints"]["shaft_joint"]["off_max"] > 1e-5
    assert result["penetration_max_mm"] > 0
    assert 1e3 * result["joints"]["box_joint"]["off_max"] < 0.1


def test_forces_in_the_table_balance(machines):
    """Newton's second law along the shaft, and work: what goes in at the input comes out or rubs."""
    for name in MACHINES:
        rows = table(machines / name / "motion.csv")
        push = 10.0 * (rows["acceleration_mm_per_s2"] * 1e-3 * np.sign(rows["velocity_mm_per_s"]) + 9.81 * 0.15)
        moving = np.abs(rows["velocity_mm_per_s"]) > 1e-6
        np.testing.assert_allclose(rows["push_N"][moving], push[moving], rtol=1e-9, atol=1e-9)
        power = rows["input_torque_Nmm"] * 200 * np.pi / 30
        same = rows["shaft_torque_Nmm"] * rows["shaft_speed_rad_per_s"]
        np.testing.assert_allclose(power, same, rtol=1e-9, atol=1e-6)


def test_the_tool_path_is_the_groove(machines):
    folder = machines / "spiral-shaft"
    with open(folder / "tool-path.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    motion = table(folder / "motion.csv")
    angle = np.radians([float(row["a_deg"]) for row in rows])
    place = np.interp(angle, motion["shaft_angle_rad"], motion["position_mm"])
    assert np.abs(place - [float(row["x_mm"]) for row in rows]).max() < 1e-3
    assert max(float(row["depth_mm"]) for row in rows) == DEPTH
