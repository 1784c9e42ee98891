"""Parts and assemblies for build123d; install it with ``pip install build123d``.

Edges are exact: lines, arcs and Bézier curves with the library's own polynomials, without approximation.
"""

# mypy: disable-error-code="import-untyped, import-not-found"
from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from . import _machine
from ._need import need

if TYPE_CHECKING:
    import build123d as _b3d

    from ._centrode import DiscCam, Gear, Mechanism
    from ._link import Link
    from ._part import Part

__all__ = ["assembly", "part", "pose"]


def part(of: Gear | DiscCam | Mechanism, name: str | Part | None = None, *, tolerance: float = 1e-6) -> _b3d.Solid:
    """Make the solid of a gear, a cam, or a part of any machine, with bore and keyway.

    Args:
        of: A gear, a disc cam, or a machine.
        name: Part of the machine: one of its `parts()`, or the first part of its file names.
        tolerance: Sides shorter than this, mm, are removed, because the kernel treats them as points.

    Returns:
        A solid in the part's own frame, labelled with its name.

    Raises:
        DesignError: The machine has no such part, the part has no solid, or the tolerance is too fine.
    """
    b3d = _build123d()
    label, found = _machine.body(of, name, tolerance)
    return b3d.Solid(_kernel().part(found), label=label)


def assembly(of: Mechanism, phi: float = 0.0, *, tolerance: float = 1e-6) -> _b3d.Compound:
    """Make the assembly of a machine at an input: one child per link, labelled with its name, and the joints.

    A joint has the same name as in the simulator models, such as `driven_joint`. It is a RevoluteJoint, LinearJoint or
    RigidJoint on the carrying link, and a RigidJoint on the carried link. The first link is fixed in the assembly.

    Args:
        of: The machine.
        phi: Input of the pose, rad.
        tolerance: As for `part`.
    """
    b3d = _build123d()
    machine = _machine.machine(of)
    links = machine.links(_machine.shortest(tolerance))
    starts = _machine.starts(links)
    made: dict[str, Any] = {}
    for number, link in enumerate(links):
        child = _link(b3d, machine, link)
        child.color = b3d.Color(_machine.COLORS[number % len(_machine.COLORS)])
        child.location = b3d.Location(_kernel().location(starts[link.name]))
        made[link.name] = child
    for link in links:
        if link.joint is not None:
            _connect(b3d, link, made)
    whole = b3d.Compound(label=machine.name, children=list(made.values()))
    _put(whole, machine, links, phi)
    return whole


def pose(assembly: _b3d.Compound, of: Mechanism, phi: float) -> None:
    """Move the links of an assembly to their positions at an input, joint by joint.

    Args:
        assembly: Result of `assembly`.
        of: The machine of the assembly.
        phi: Input, rad.
    """
    _build123d()
    machine = _machine.machine(of)
    _put(assembly, machine, machine.links(bodies=False), phi)


def _put(whole: Any, machine: Mechanism, links: tuple[Link, ...], phi: float) -> None:
    frames = machine.frames(_machine.angle(phi))
    children = {child.label: child for child in whole.children}
    missing = [link.name for link in links if link.name not in children]
    if missing:
        raise ValueError(f"the assembly is not of this machine: it has no link {missing[0]!r}")
    for link in links:
        joint = link.joint
        if joint is None:
            continue
        carrier = children[joint.parent].joints[joint.name]
        carried = children[link.name].joints[joint.name]
        at = _machine.coordinate(joint, frames, link.name)
        if joint.kind == "turning":
            carrier.connect_to(carried, angle=math.degrees(at))
        elif joint.kind == "sliding":
            # What goes on from period to period leaves the range of the first; rounding may leave it, too.
            low, high = carrier.linear_range
            carrier.linear_range = (min(low, at), max(high, at))
            carrier.connect_to(carried, position=at)
        else:
            carrier.connect_to(carried)
    # The compound holds its children in the positions they had when they were put in.
    whole.wrapped = _kernel().compound([child.wrapped for child in whole.children])


def _link(b3d: Any, machine: Mechanism, link: Link) -> Any:
    """A link's body: one solid, or a compound of none or several."""
    shape, is_solid = _kernel().link(machine, link)
    return (b3d.Solid if is_solid else b3d.Compound)(shape, label=link.name)


def _connect(b3d: Any, link: Link, made: dict[str, Any]) -> None:
    """Joints on both sides of a connection, the links standing where every coordinate is zero."""
    joint, child = link.joint, made[link.name]
    assert joint is not None
    carrier = made[joint.parent]
    place = child.location
    if joint.kind == "fixed":
        b3d.RigidJoint(joint.name, carrier, place)
        b3d.RigidJoint(joint.name, child, place)
        return
    along = b3d.Axis((0, 0, 0), joint.axis).located(place)
    if joint.kind == "turning":
        joined = b3d.RevoluteJoint(joint.name, carrier, along, angular_range=(-180.0, 180.0))
        b3d.RigidJoint(joint.name, child, joined.location)
        return
    joined = b3d.LinearJoint(joint.name, carrier, along, linear_range=joint.range or (-math.inf, math.inf))
    # This joint gives the sliding link the orientation of the carrying link.
    b3d.RigidJoint(joint.name, child, carrier.location * b3d.Location(joined.relative_axis.position))


def _build123d() -> Any:
    return need("build123d", "build123d")


def _kernel() -> Any:
    return need("centrode._ocp", "build123d", "OCP")
