"""A grooved shaft next to cadquery: one plain helical groove there, both grooves of a variable-speed shaft here."""

import math
import time
from pathlib import Path
from tempfile import TemporaryDirectory

import cadquery as cq
import centrode as ct

LEAD, TURNS, RADIUS, WIDTH, DEPTH = 20.0, 13, 15.0, 10.0, 4.0
TOLERANCE = 0.01
"""Of both meshes, mm."""
RUNS = 5


def plain_groove():
    """A cylinder with one helical groove of constant lead, cut by sweeping the groove's section along it."""
    height = LEAD * TURNS
    blank = cq.Workplane("XY").workplane(offset=-LEAD).circle(RADIUS).extrude(height + 2 * LEAD)
    helix = cq.Wire.makeHelix(LEAD, height, RADIUS)
    tangent = cq.Vector(0, RADIUS, LEAD / math.tau)
    section = cq.Workplane(cq.Plane(origin=(RADIUS, 0, 0), xDir=(1, 0, 0), normal=tangent))
    # Half of the section stands above the surface, so that no face of the cut lies in it.
    groove = section.rect(2 * DEPTH, WIDTH).sweep(cq.Workplane(helix), isFrenet=True)
    return blank.cut(groove)


def groove_volume():
    """What the cut takes away, mm^3: the section's area by the way of its centre, both ends aside."""
    middle = RADIUS - DEPTH / 2
    return WIDTH * DEPTH * TURNS * math.hypot(math.tau * middle, LEAD)


def timed(action):
    """Seconds an action takes, and its answer."""
    start = time.perf_counter()
    answer = action()
    return time.perf_counter() - start, answer


def rows():
    """Minimum seconds of several runs, alternating: cut and STL there, solid and STL here."""
    shaft = ct.SpiralShaft.for_moved_distance(2.05, lead=LEAD, radius=RADIUS, groove_width=WIDTH, groove_depth=DEPTH)
    cuts, whole, ours = [], [], []
    with TemporaryDirectory() as folder:
        for _ in range(RUNS):
            cut, solid = timed(plain_groove)
            path = str(Path(folder, "plain.stl"))
            mesh, _ = timed(lambda: cq.exporters.export(solid, path, tolerance=TOLERANCE, angularTolerance=0.1))  # noqa: B023
            cuts.append(cut)
            whole.append(cut + mesh)
            for _ in range(RUNS):
                seconds, files = timed(lambda: shaft.files(formats=["stl"], tolerance=TOLERANCE))
                ours.append(seconds)
        taken = math.pi * RADIUS**2 * LEAD * (TURNS + 2) - solid.val().Volume()
    assert math.isclose(taken, groove_volume(), rel_tol=0.05), "cadquery cut something else"
    assert len(files["shaft.stl"]) > 1 << 20, "no fine mesh"
    return min(cuts), min(whole), min(ours)


def compare():
    """Prints the table."""
    cut, whole, ours = rows()
    print(f"\n{'shaft, lead 20, 13 turns':28} {'cadquery':>14} {'centrode':>14} {'ratio':>10}")
    for what, theirs in [("one plain groove cut", cut), ("the same and STL, 0.01 mm", whole)]:
        print(f"  {what:26} {theirs * 1e3:>11.1f} ms {ours * 1e3:>11.2f} ms {theirs / ours:>8.0f} x", flush=True)


if __name__ == "__main__":
    compare()
