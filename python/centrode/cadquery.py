"""Parts and assemblies for CadQuery; install it with ``pip install cadquery``.

Edges are exact: lines, arcs and Bézier curves with the library's own polynomials, without approximation.
"""

# mypy: disable-error-code="import-untyped, import-not-found"
from __future__ import annotations

from typing import TYPE_CHECKING, Any

from . import _machine
from ._need import need

if TYPE_CHECKING:
    import cadquery as _cq

    from ._centrode import DiscCam, Gear, Mechanism
    from ._link import Link
    from ._part import Part

__all__ = ["assembly", "part", "pose"]


def part(of: Gear | DiscCam | Mechanism, name: str | Part | None = None, *, tolerance: float = 1e-6) -> _cq.Workplane:
    """Make the solid of a gear, a cam, or a part of any machine, with bore and keyway.

    Args:
        of: A gear, a disc cam, or a machine.
        name: Part of the machine: one of its `parts()`, or the first part of its file names.
        tolerance: Sides shorter than this, mm, are removed, because the kernel treats them as points.

    Returns:
        A workplane with the solid in the part's own frame.

    Raises:
        DesignError: The machine has no such part, the part has no solid, or the tolerance is too fine.
    """
    cq = _cadquery()
    _, found = _machine.body(of, name, tolerance)
    return cq.Workplane("XY").newObject([cq.Solid(_kernel().part(found))])


def assembly(of: Mechanism, phi: float = 0.0, *, tolerance: float = 1e-6) -> _cq.Assembly:
    """Make the assembly of a machine at an input: one child per link with a body, with the name of the link.

    Args:
        of: The machine.
        phi: Input of the pose, rad.
        tolerance: As for `part`.
    """
    cq = _cadquery()
    machine = _machine.machine(of)
    links = machine.links(_machine.shortest(tolerance))
    names = {link.name for link in links}
    whole = cq.Assembly(name=machine.name if machine.name not in names else f"{machine.name}-assembly")
    for number, link in enumerate(links):
        color = _machine.COLORS[number % len(_machine.COLORS)]
        red, green, blue = (int(color[at : at + 2], 16) / 255.0 for at in (1, 3, 5))
        body = _link(cq, machine, link)
        if body is not None:
            whole.add(body, name=link.name, color=cq.Color(red, green, blue))
    pose(whole, machine, phi)
    return whole


def pose(assembly: _cq.Assembly, of: Mechanism, phi: float) -> None:
    """Move the links of an assembly to their positions at an input.

    Args:
        assembly: Result of `assembly`.
        of: The machine of the assembly.
        phi: Input, rad.
    """
    cq = _cadquery()
    machine = _machine.machine(of)
    frames = machine.frames(_machine.angle(phi))
    for child in assembly.children:
        if child.name not in frames:
            raise ValueError(f"the assembly is not of this machine: the machine has no link {child.name!r}")
    for child in assembly.children:
        child.loc = cq.Location(_kernel().location(frames[child.name]))


def _link(cq: Any, machine: Mechanism, link: Link) -> Any:
    """A link's body: one solid, a compound of several, or nothing."""
    if link.mesh is None and not link.part and not link.solids and not link.mounted:
        return None
    shape, is_solid = _kernel().link(machine, link)
    return (cq.Solid if is_solid else cq.Compound)(shape)


def _cadquery() -> Any:
    return need("cadquery", "cadquery")


def _kernel() -> Any:
    return need("centrode._ocp", "cadquery", "OCP")
