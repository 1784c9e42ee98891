"""Parts and assemblies of build123d: valid, as large as the exact section tells, and where the laws have them."""

import math
from functools import cache
from pathlib import Path

import centrode as ct
import numpy as np
import pytest
from OCP.BRepCheck import BRepCheck_Analyzer
from OCP.BRepGProp import BRepGProp
from OCP.GProp import GProp_GProps
from sample import DESIGNS as SAMPLE
from sample import sampled

b3d = pytest.importorskip("build123d")

DESIGNS = sorted((Path(__file__).parents[2] / "tests" / "designs").glob("*.toml"))
# Their parts are much like those of others; the campaign of CadQuery tries them, too.
ALIKE = {"composed-box", "feeder-widened", "lobed-pair-3-2", "lobed-pair-5-2", "three-arm-all-goals",
         "transplanter-pair-2021", "two-stage"}  # fmt: skip
TRIED = [path for path in DESIGNS if path.stem not in ALIKE]
NODES, WEIGHTS = np.polynomial.legendre.leggauss(14)


@cache
def bernstein(degree):
    """Bernstein polynomials at the nodes, a column each."""
    t = 0.5 * (NODES + 1)[:, None]
    k = np.arange(degree + 1)
    return np.array([math.comb(degree, i) for i in k]) * t**k * (1 - t) ** (degree - k)


def green(edge):
    """Integral of x dy - y dx over two along an edge, by Gauss's quadrature of the curve as it stands in the record."""
    t = 0.5 * (NODES + 1)
    first, last = edge.points[0], edge.points[-1]
    if edge.kind == "line":
        return 0.5 * (first[0] * last[1] - first[1] * last[0])
    if edge.kind == "arc":
        center = np.array(edge.center)
        radius = math.dist(first, center)
        start = math.atan2(*(first - center)[::-1])
        angle = start + edge.sweep * t
        x, y = center[:, None] + radius * np.array([np.cos(angle), np.sin(angle)])
        dx, dy = radius * edge.sweep * np.array([-np.sin(angle), np.cos(angle)])
    else:
        # Of degree 13 the integrand has degree 25, which 13 nodes would do.
        n = edge.degree
        x, y = (bernstein(n) @ edge.points).T
        dx, dy = (n * bernstein(n - 1) @ np.diff(edge.points, axis=0)).T
    return 0.5 * float((x * dy - y * dx) @ WEIGHTS) / 2


def volume(solid):
    """Volume of an extrusion by Green's theorem on its edges."""
    area = sum(green(edge) for contour in solid.contours for edge in contour)
    whole = area * (solid.top - solid.bottom)
    if solid.opening is None:
        return whole
    # Seen along z it lies between a side of the outer contour and one of a hole.
    first, second, third, fourth = corners = solid.opening.corners
    ends = {(tuple(first), tuple(second)), (tuple(third), tuple(fourth))}
    sides = [e for contour in solid.contours for e in contour if (tuple(e.points[0]), tuple(e.points[-1])) in ends]
    assert len(sides) == 2
    cut = sum(green(side) for side in sides)
    for start, end in (corners[1:3], corners[[3, 0]]):
        cut += 0.5 * (start[0] * end[1] - start[1] * end[0])
    low, high = solid.opening.span
    return whole - float(cut) * (high - low)


def measured(part):
    """What the kernel measures, valid by its own checker."""
    assert BRepCheck_Analyzer(part.wrapped).IsValid()
    return part.volume


@pytest.mark.parametrize("path", sampled(TRIED, of={*SAMPLE} - {"feeder-2022"}), ids=lambda path: path.stem)
def test_every_part_is_valid_and_as_large_as_greens_theorem_tells(path):
    machine = ct.load(path)
    solids = machine.solids()
    grooved = {"shaft"} if isinstance(machine, ct.BoxDrive) else set()
    for name in solids.keys() | grooved:
        part = ct.build123d.part(machine, name)
        assert (part.label, len(part.solids())) == (name, 1)
        found = measured(part)
        if name in grooved:
            # No extrusion: read from its STEP file.
            continue
        assert found == pytest.approx(volume(solids[name]), rel=1e-9)
        assert found == pytest.approx(solids[name].volume, rel=1e-9)


def test_a_grooved_shaft_is_as_heavy_as_the_parts_list_says():
    text = (DESIGNS[0].parent / "spiral-shaft-2018.toml").read_text()
    # The exact solid leaves the fillet of the groove out.
    sharp = ct.SpiralShaft.from_toml(text.replace("holes = 14 ", "holes = 4 ").replace("fillet = 0.5 ", "fillet = 0 "))
    (listed,) = (part for part in sharp.parts() if part.file == "shaft")
    part = ct.build123d.part(sharp, listed)
    properties = GProp_GProps()
    BRepGProp.VolumeProperties_s(part.wrapped, properties, 1e-9)
    assert properties.Mass() * 7850e-9 == pytest.approx(listed.mass, rel=1e-7)


def test_links_come_without_their_bodies_too():
    arms = ct.ThreeArm.from_toml(ct.template("three-arm"))
    whole, bare = arms.links(), arms.links(bodies=False)
    assert [(link.name, link.joint) for link in bare] == [(link.name, link.joint) for link in whole]
    assert any(link.solids for link in whole)
    assert not any(link.solids or link.mesh for link in bare)
    names = [link.name for link in bare]
    assert all(link.joint is None or names.index(link.joint.parent) < names.index(link.name) for link in bare)


def frame(child):
    """Where a link of an assembly stands, (3, 4)."""
    transform = child.location.wrapped.Transformation()
    return np.array([[transform.Value(row, column) for column in (1, 2, 3, 4)] for row in (1, 2, 3)])


@pytest.mark.parametrize("name", ["elliptic-pair-2018", "three-arm-2021", "spiral-shaft-2018", "feeder-2022", "press"])
def test_an_assembly_stands_where_the_laws_have_it(name):
    machine = ct.load(DESIGNS[0].parent / f"{name}.toml")
    assembly = ct.build123d.assembly(machine, phi=0.5)
    assert [child.label for child in assembly.children] == [link.name for link in machine.links()]
    for phi in (0.5, 0.0, -2.0, 9.25):
        if phi != 0.5:
            ct.build123d.pose(assembly, machine, phi)
        frames = machine.frames(phi)
        for child in assembly.children:
            np.testing.assert_allclose(frame(child), frames[child.label][:3], atol=1e-9)
    kinds = {"turning": b3d.RevoluteJoint, "sliding": b3d.LinearJoint, "fixed": b3d.RigidJoint}
    children = {child.label: child for child in assembly.children}
    for link in machine.links(bodies=False):
        if link.joint is not None:
            joint = children[link.joint.parent].joints[link.joint.name]
            assert type(joint) is kinds[link.joint.kind]
            assert joint.connected_to is children[link.name].joints[link.joint.name]
    shown = assembly.children[:4]
    assert len({str(child.color) for child in shown}) == len(shown)


def test_joints_of_a_pair_are_those_of_its_law(pair):
    assembly = ct.build123d.assembly(pair)
    base, _, driven = assembly.children
    assert {type(joint) for joint in base.joints.values()} == {b3d.RevoluteJoint}
    assert type(driven.joints["driven_joint"]) is b3d.RigidJoint
    # By hand, as a user would: the joint alone brings the gear to the angle of the law.
    base.joints["driven_joint"].connect_to(driven.joints["driven_joint"], angle=math.degrees(pair.driven_angle(1.0)))
    turned = math.atan2(*frame(driven)[[1, 0], 0])
    assert turned == pytest.approx(pair.driven_angle(1.0), abs=1e-9)
    np.testing.assert_allclose(frame(driven)[:, 3], [pair.center_distance, 0, 0], atol=1e-9)
    step = 1e-4
    angles = []
    for phi in (1.0 - step, 1.0 + step):
        ct.build123d.pose(assembly, pair, phi)
        angles.append(math.radians(base.joints["driven_joint"]._angle))
        assert math.radians(base.joints["driver_joint"]._angle) == pytest.approx(-phi, abs=1e-9)
    assert (angles[1] - angles[0]) / (2 * step) == pytest.approx(pair.ratio(1.0), abs=1e-7)


def test_a_posed_assembly_is_one_compound_in_mesh(pair):
    """The compound moves with its children, so that it is exported as it stands, and the gears do not overlap."""
    assembly = ct.build123d.assembly(pair)
    before = assembly.center(b3d.CenterOf.BOUNDING_BOX)
    ct.build123d.pose(assembly, pair, 1.2)
    solids = assembly.solids()
    assert len(solids) == 2
    assert (assembly.center(b3d.CenterOf.BOUNDING_BOX) - before).length > 0.1
    np.testing.assert_allclose(tuple(solids[1].center()), tuple(assembly.children[2].center()), atol=1e-9)
    shared = solids[0] & solids[1]
    assert not shared or shared.volume < 1e-6 * solids[0].volume


def test_an_assembly_goes_through_a_step_file_as_it_stands(pair, tmp_path):
    assembly = ct.build123d.assembly(pair, 0.7)
    b3d.export_step(assembly, tmp_path / "pair.step")
    again = b3d.import_step(tmp_path / "pair.step")
    assert [child.label for child in again.children] == ["base", "driver", "driven"]
    for one, other in zip(again.children[1:], assembly.children[1:], strict=True):
        np.testing.assert_allclose(frame(one), frame(other), atol=1e-9)
        assert str(one.color) == str(other.color)
        assert one.volume == pytest.approx(other.volume, rel=1e-9)


def test_sides_shorter_than_the_tolerance_are_closed_up():
    pair = ct.load(DESIGNS[0].parent / "cubic-pair.toml")
    fine, coarse = (sum(map(len, pair.driver.solid(tolerance).contours)) for tolerance in (1e-6, 0.2))
    assert coarse < fine
    closed = ct.build123d.part(pair.driver, tolerance=0.2)
    assert len(closed.faces()) == coarse + 2
    assert measured(closed) == pytest.approx(pair.driver.solid().volume, rel=1e-4)


def test_a_cam_and_a_listed_part_are_parts_too():
    arms = ct.ThreeArm.from_toml(ct.template("three-arm"))
    listed = {part.file: part for part in arms.parts()}
    assert ct.build123d.part(arms, listed["fork"]).label == "fork"
    cam = ct.build123d.part(arms.cam)
    assert cam.volume == pytest.approx(volume(arms.cam.solid()), rel=1e-9)


def test_what_is_no_part_is_refused(pair):
    with pytest.raises(TypeError, match="must be a gear, a disc cam or a machine, not str"):
        ct.build123d.part("driver")  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="must be a machine, such as a GearPair or the result"):
        ct.build123d.assembly(pair.driver)  # type: ignore[arg-type]
    with pytest.raises(ct.DesignError, match="one of driver, driven, not 'sun'"):
        ct.build123d.part(pair, "sun")
    with pytest.raises(ct.DesignError, match="one of driver, driven, not omitted"):
        ct.build123d.part(pair)
    feeder = ct.Feeder.from_toml(ct.template("feeder"))
    key = next(part for part in feeder.parts() if "DIN 6885" in str(part))
    with pytest.raises(ct.DesignError, match="must be a part with a solid"):
        ct.build123d.part(feeder, key)
    for tolerance in (0.0, -1.0, 1e-9, math.nan, math.inf):
        with pytest.raises(ct.DesignError, match="tolerance must be at least 1e-06 mm") as error:
            ct.build123d.part(pair.driver, tolerance=tolerance)
        assert error.value.key == "tolerance"
    assembly = ct.build123d.assembly(pair)
    with pytest.raises(ct.DesignError, match="phi must be a finite number"):
        ct.build123d.pose(assembly, pair, math.nan)
    with pytest.raises(ValueError, match="the assembly is not of this machine: it has no link"):
        ct.build123d.pose(assembly, feeder, 0.0)
