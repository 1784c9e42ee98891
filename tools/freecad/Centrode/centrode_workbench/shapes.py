"""Shapes of FreeCAD from the exact edges of parts."""

import tempfile
from pathlib import Path

import FreeCAD
import Part


def body(machine, link):
    """Make the shape of a link with what is mounted on it, in its own frame; None for a link without a body."""
    own = _own(machine, link)
    if not link.mounted:
        return own
    return Part.Compound([*([] if own is None else [own]), *map(mounted, link.mounted)])


def mounted(of):
    """Make the shape of a shaft, pin, ring or key where it is on its link."""
    made = step(of.step) if of.step is not None else Part.Compound([solid(one) for one in of.solids])
    made.Placement = placement(of.frame)
    return made


def _own(machine, link):
    if link.mesh is not None:
        return _polyhedron(*link.mesh)
    if link.solids:
        solids = [solid(one) for one in link.solids]
        return solids[0] if len(solids) == 1 else Part.Compound(solids)
    if not link.part:
        return None
    # No extrusion, as a grooved shaft: its STEP file is as exact.
    (contents,) = machine.files(formats=["step"], parts=[link.part]).values()
    return step(contents)


def step(contents):
    """Read the shape of a STEP file."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "part.step")
        path.write_bytes(contents)
        shape = Part.Shape()
        shape.read(str(path))
    return shape


def solid(of):
    """Make the solid of an extrusion: lines, arcs and Bézier curves swept, nothing approximated."""
    wires = [Part.Wire([_edge(side, of.bottom) for side in contour]) for contour in of.contours]
    made = Part.Face(wires).extrude(FreeCAD.Vector(0, 0, of.top - of.bottom))
    if of.opening is not None:
        made = made.cut(_tool(of.opening))
        (made,) = made.Solids
    return made


def placement(frame):
    """Make the placement of a frame, a (4, 4) matrix, mm."""
    return FreeCAD.Placement(FreeCAD.Matrix(*[float(value) for value in frame.ravel()]))


def _edge(side, z):
    points = [FreeCAD.Vector(x, y, z) for x, y in side.points.tolist()]
    if side.kind == "line":
        return Part.LineSegment(*points).toShape()
    if side.kind == "spline":
        curve = Part.BezierCurve()
        curve.setPoles(points)
        return curve.toShape()
    # Of a turned frame, so that the arc begins at its first point and runs as it turns.
    center = FreeCAD.Vector(*side.center, z)
    circle = Part.Circle(center, FreeCAD.Vector(0, 0, 1 if side.sweep > 0 else -1), (points[0] - center).Length)
    start = circle.parameter(points[0])
    return circle.toShape(start, start + abs(side.sweep))


def _tool(opening):
    """What an opening takes away: straight on past both walls by half of what lies between them."""
    first, second, third, fourth = opening.corners
    one, other = 0.5 * (first - fourth), 0.5 * (second - third)
    low, high = opening.span
    corners = (first + one, second + other, third - other, fourth - one)
    points = [FreeCAD.Vector(*corner.tolist(), low) for corner in corners]
    return Part.Face(Part.makePolygon([*points, points[0]])).extrude(FreeCAD.Vector(0, 0, high - low))


def _polyhedron(vertices, faces):
    """Bodies bound by triangles, as one shell."""
    points = [FreeCAD.Vector(*vertex) for vertex in vertices.tolist()]
    sides = [Part.Face(Part.makePolygon([points[a], points[b], points[c], points[a]])) for a, b, c in faces.tolist()]
    return Part.Compound(sides)
