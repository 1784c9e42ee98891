"""Bodies of the Open CASCADE kernel from exact edges, for the adapters of build123d and CadQuery.

One of the adapters imports it, only if the kernel is installed.
"""

# mypy: disable-error-code="import-untyped, import-not-found"
from __future__ import annotations

import math
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from OCP.BRep import BRep_Builder
from OCP.BRepAlgoAPI import BRepAlgoAPI_Cut
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge, BRepBuilderAPI_MakePolygon
from OCP.BRepPrimAPI import BRepPrimAPI_MakePrism
from OCP.Geom import Geom_BezierCurve, Geom_Circle, Geom_Plane
from OCP.gp import gp_Ax2, gp_Ax3, gp_Dir, gp_Pln, gp_Pnt, gp_Trsf, gp_Vec
from OCP.IFSelect import IFSelect_RetDone
from OCP.STEPControl import STEPControl_Reader
from OCP.TopAbs import TopAbs_SOLID
from OCP.TopExp import TopExp_Explorer
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS, TopoDS_Compound, TopoDS_Face, TopoDS_Shell, TopoDS_Solid, TopoDS_Vertex, TopoDS_Wire

from ._error import ExportError
from ._machine import LEAST, body

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy import float64
    from numpy.typing import ArrayLike, NDArray

    from ._centrode import Mechanism
    from ._link import Link, Mounted
    from ._solid import Edge, Opening, Solid

try:
    from OCP.collections import Array1_gp_Pnt as _Points
except ImportError:  # Before version 8 of the kernel.
    from OCP.TColgp import TColgp_Array1OfPnt as _Points

_CLOSE = 1e-7
"""Distance below which the kernel treats two points as one, mm."""

_to_solid = getattr(TopoDS, "Solid_s", None) or TopoDS.Solid


def extrusion(of: Solid) -> Any:
    """Make the solid of an extrusion: planes, cylinders and swept Bézier curves, nothing approximated."""
    builder = BRep_Builder()
    face = TopoDS_Face()
    up = gp_Dir(0.0, 0.0, 1.0)
    builder.MakeFace(face, Geom_Plane(gp_Pln(gp_Ax3(gp_Pnt(0.0, 0.0, of.bottom), up))), _CLOSE)
    for contour in of.contours:
        builder.Add(face, _wire(builder, contour, of.bottom))
    made = BRepPrimAPI_MakePrism(face, gp_Vec(0.0, 0.0, of.top - of.bottom)).Shape()
    if of.opening is not None:
        made = BRepAlgoAPI_Cut(made, _tool(of.opening)).Shape()
    return _only(made)


def part(of: Solid | bytes) -> Any:
    """Make the solid of a part from its exact edges, or read it from its STEP file."""
    return step(of) if isinstance(of, bytes) else extrusion(of)


def link(machine: Mechanism, of: Link) -> tuple[Any, bool]:
    """Make the body of a link with its mounted parts.

    Returns the shape, and whether it is one solid; otherwise it is a compound of none or several solids.
    """
    shape, is_solid = _body(machine, of)
    if not of.mounted:
        return shape, is_solid
    own = [shape] if is_solid or of.mesh is not None or of.solids else []
    return compound([*own, *map(mounted, of.mounted)]), False


def mounted(of: Mounted) -> Any:
    """Make the body of a shaft, pin, ring or key where it is on its link."""
    made = compound([extrusion(one) for one in of.solids]) if of.step is None else step(of.step)
    return made.Moved(location(of.frame))


def _body(machine: Mechanism, of: Link) -> tuple[Any, bool]:
    if of.mesh is not None:
        return polyhedra(*of.mesh), False
    if of.part and not of.solids:
        return part(body(machine, of.part, LEAST)[1]), True
    if len(of.solids) == 1:
        return extrusion(of.solids[0]), True
    return compound([extrusion(solid) for solid in of.solids]), False


def step(contents: bytes) -> Any:
    """Read the one solid of a STEP file."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "part.step")
        path.write_bytes(contents)
        reader = STEPControl_Reader()
        if reader.ReadFile(str(path)) != IFSelect_RetDone:
            raise ExportError("the CAD kernel cannot read the STEP file of the part")
        reader.TransferRoots()
        return _only(reader.OneShape())


def polyhedra(vertices: NDArray[float64], faces: NDArray[Any]) -> Any:
    """Make a compound of the closed bodies bounded by triangles, with one plane face per triangle."""
    return compound([_polyhedron(vertices, part) for part in _apart(faces, len(vertices))])


def compound(shapes: Sequence[Any]) -> Any:
    """Make a compound of shapes."""
    builder, whole = BRep_Builder(), TopoDS_Compound()
    builder.MakeCompound(whole)
    for shape in shapes:
        builder.Add(whole, shape)
    return whole


def location(frame: ArrayLike) -> Any:
    """Make the location of a frame, a (4, 4) matrix, mm."""
    rows = np.asarray(frame, dtype=float)[:3].ravel().tolist()
    transform = gp_Trsf()
    transform.SetValues(*rows)
    return TopLoc_Location(transform)


def _wire(builder: Any, contour: Sequence[Edge], z: float) -> Any:
    """A closed wire at a height, its edges sharing their vertices."""
    vertices = []
    for side in contour:
        x, y = side.points[0].tolist()
        vertex = TopoDS_Vertex()
        builder.MakeVertex(vertex, gp_Pnt(x, y, z), _CLOSE)
        vertices.append(vertex)
    wire = TopoDS_Wire()
    builder.MakeWire(wire)
    for side, start, end in zip(contour, vertices, vertices[1:] + vertices[:1], strict=True):
        made = _edge(side, start, end, z)
        if not made.IsDone():
            x, y = side.points[0].tolist()
            raise ExportError(f"the CAD kernel cannot make an edge of the {side.kind} that begins at ({x:g}, {y:g}) mm")
        builder.Add(wire, made.Edge())
    wire.Closed(True)
    return wire


def _edge(side: Edge, start: Any, end: Any, z: float) -> Any:
    if side.kind == "line":
        return BRepBuilderAPI_MakeEdge(start, end)
    if side.center is not None:
        (x, y), (center_x, center_y) = side.points[0].tolist(), side.center
        # The circle begins at the start of the arc, and has its direction.
        way = gp_Dir(0.0, 0.0, math.copysign(1.0, side.sweep))
        axes = gp_Ax2(gp_Pnt(center_x, center_y, z), way, gp_Dir(x - center_x, y - center_y, 0.0))
        circle = Geom_Circle(axes, math.hypot(x - center_x, y - center_y))
        return BRepBuilderAPI_MakeEdge(circle, start, end, 0.0, abs(side.sweep))
    points = side.points.tolist()
    poles = _Points(1, len(points))
    for index, (x, y) in enumerate(points, 1):
        poles.SetValue(index, gp_Pnt(x, y, z))
    return BRepBuilderAPI_MakeEdge(Geom_BezierCurve(poles), start, end, 0.0, 1.0)


def _tool(opening: Opening) -> Any:
    """Tool body that cuts an opening; it extends beyond both walls by half of their distance."""
    first, second, third, fourth = opening.corners
    one, other = 0.5 * (first - fourth), 0.5 * (second - third)
    low, high = opening.span
    polygon = BRepBuilderAPI_MakePolygon()
    for corner in (first + one, second + other, third - other, fourth - one):
        polygon.Add(gp_Pnt(*corner.tolist(), low))
    polygon.Close()
    builder, face = BRep_Builder(), TopoDS_Face()
    builder.MakeFace(face, Geom_Plane(gp_Pln(gp_Ax3(gp_Pnt(0.0, 0.0, low), gp_Dir(0.0, 0.0, 1.0)))), _CLOSE)
    builder.Add(face, polygon.Wire())
    return BRepPrimAPI_MakePrism(face, gp_Vec(0.0, 0.0, high - low)).Shape()


def _apart(faces: NDArray[Any], count: int) -> list[list[list[int]]]:
    """Triangles grouped by body: triangles of a body share vertices."""
    first = list(range(count))

    def root(vertex: int) -> int:
        while first[vertex] != vertex:
            first[vertex] = first[first[vertex]]
            vertex = first[vertex]
        return vertex

    triangles = faces.tolist()
    for a, b, c in triangles:
        first[root(b)] = first[root(c)] = root(a)
    bodies: dict[int, list[list[int]]] = {}
    for triangle in triangles:
        bodies.setdefault(root(triangle[0]), []).append(triangle)
    return list(bodies.values())


def _polyhedron(vertices: NDArray[float64], faces: list[list[int]]) -> Any:
    builder, shell, solid = BRep_Builder(), TopoDS_Shell(), TopoDS_Solid()
    builder.MakeShell(shell)
    corners: dict[int, Any] = {}
    edges: dict[tuple[int, int], Any] = {}
    for index in {index for face in faces for index in face}:
        corners[index] = TopoDS_Vertex()
        builder.MakeVertex(corners[index], gp_Pnt(*vertices[index].tolist()), _CLOSE)
    for face in faces:
        wire, made = TopoDS_Wire(), TopoDS_Face()
        builder.MakeWire(wire)
        for start, end in zip(face, face[1:] + face[:1], strict=True):
            key = (min(start, end), max(start, end))
            if key not in edges:
                edges[key] = BRepBuilderAPI_MakeEdge(corners[key[0]], corners[key[1]]).Edge()
            builder.Add(wire, edges[key] if start == key[0] else edges[key].Reversed())
        wire.Closed(True)
        a, b, c = vertices[face]
        normal = np.cross(b - a, c - a).tolist()
        plane = Geom_Plane(gp_Pln(gp_Ax3(gp_Pnt(*a.tolist()), gp_Dir(*normal))))
        builder.MakeFace(made, plane, _CLOSE)
        builder.Add(made, wire)
        builder.Add(shell, made)
    shell.Closed(True)
    builder.MakeSolid(solid)
    builder.Add(solid, shell)
    return solid


def _uses(shape: Any, kind: Any) -> Iterator[Any]:
    explorer = TopExp_Explorer(shape, kind)
    while explorer.More():
        yield explorer.Current()
        explorer.Next()


def _only(shape: Any) -> Any:
    """The one solid of a shape."""
    solids = list(_uses(shape, TopAbs_SOLID))
    if len(solids) != 1:
        raise ExportError(f"the CAD kernel made {len(solids)} solids from one part; there must be one")
    return _to_solid(solids[0])
