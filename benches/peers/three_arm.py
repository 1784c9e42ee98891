"""Three-arm mechanism next to its peers: interference next to collision libraries, a sweep next to NumPy."""

import argparse
import math
from functools import partial
from pathlib import Path

import centrode as ct
import numpy as np
import numpy_three_arm
import shapely
from timing import seconds, times, worked

ROOT = Path(__file__).resolve().parents[2]
SAMPLES = 720
PAIRS = [(0, 1), (1, 2), (2, 0)]
HALF_WIDTH = 18.0
"""Of an arm along its planet's axis, mm: the peers take solids."""
BLOCKS = [8, 16, 32, 64, 128]
"""Designs handed to NumPy at once; the quickest counts."""
ANGLES = {"pick-angle", "push-angle", "angle-difference"}
OURS = {"center-distance": "center_distance"}


def prism(contour):
    """Triangles of the upright solid on a contour: corners (2 N, 3) and faces (4 N - 4, 3)."""
    count = len(contour)
    corners = np.concatenate([np.column_stack([contour, np.full(count, z)]) for z in (-HALF_WIDTH, HALF_WIDTH)])
    number = {tuple(point): i for i, point in enumerate(contour)}
    faces = []
    for part in shapely.constrained_delaunay_triangles(shapely.Polygon(contour)).geoms:
        a, b, c = (number[point] for point in part.exterior.coords[:3])
        if not part.exterior.is_ccw:
            b, c = c, b
        faces += [(a, c, b), (a + count, b + count, c + count)]
    for i in range(count):
        j = (i + 1) % count
        faces += [(i, j, j + count), (i, j + count, i + count)]
    return corners, np.array(faces)


def poses(arms):
    """Place and turning of each arm at the samples: (arm, sample, x y turn)."""
    found = arms.pose(np.linspace(0, 2 * math.pi, SAMPLES, endpoint=False))
    return [found[f"arm-{k}"] for k in range(arms.arms)]


def spatial(rows):
    """Rotation matrices and translations of poses of the plane."""
    cos, sin = np.cos(rows[:, 2]), np.sin(rows[:, 2])
    turned = np.zeros((len(rows), 3, 3))
    turned[:, 0, 0], turned[:, 0, 1], turned[:, 1, 0], turned[:, 1, 1], turned[:, 2, 2] = cos, -sin, sin, cos, 1
    return turned, np.column_stack([rows[:, :2], np.zeros(len(rows))])


def sampled_by_fcl(mesh, placed):
    import fcl

    model = fcl.BVHModel()
    corners, faces = mesh
    model.beginModel(len(corners), len(faces))
    model.addSubModel(corners, faces)
    model.endModel()
    frames = [[fcl.Transform(*frame) for frame in zip(*spatial(rows), strict=True)] for rows in placed]
    objects = [fcl.CollisionObject(model) for _ in placed]
    request = fcl.DistanceRequest()

    def run():
        least = math.inf
        for sample in range(SAMPLES):
            for own, frame in zip(objects, frames, strict=True):
                own.setTransform(frame[sample])
            for i, j in PAIRS:
                least = min(least, fcl.distance(objects[i], objects[j], request, fcl.DistanceResult()))
        return least

    return run


def sampled_by_coal(mesh, placed):
    import coal

    model = coal.BVHModelOBBRSS()
    corners, faces = mesh
    model.beginModel(len(faces), len(corners))
    model.addVertices(corners)
    model.addTriangles(np.ascontiguousarray(faces))
    model.endModel()
    frames = [[coal.Transform3s(turn, at) for turn, at in zip(*spatial(rows), strict=True)] for rows in placed]
    request, result = coal.DistanceRequest(), coal.DistanceResult()

    def run():
        least = math.inf
        for sample in range(SAMPLES):
            for i, j in PAIRS:
                result.clear()
                least = min(least, coal.distance(model, frames[i][sample], model, frames[j][sample], request, result))
        return least

    return run


def sampled_by_shapely(contour, placed):
    """In the plane, as ours: all samples of a pair in one call."""

    def turned(rows):
        cos, sin = np.cos(rows[:, 2]), np.sin(rows[:, 2])
        turns = np.stack([np.stack([cos, sin], 1), np.stack([-sin, cos], 1)], 1)
        return shapely.polygons(contour @ turns + rows[:, None, :2])

    bodies = [turned(rows) for rows in placed]
    return lambda: min(shapely.distance(bodies[i], bodies[j]).min() for i, j in PAIRS)


def interference(arms, title, tolerance):
    contour = arms.arm_contour(tolerance)
    mesh, placed = prism(contour), poses(arms)
    ours, found = worked(lambda: arms.arm_clearance(tolerance))
    print(
        f"\n{title}: three arms of {len(contour)} corners, {len(mesh[1])} triangles, over a turn\n"
        f"  {'centrode, continuous':34} {seconds(ours):>10} {'':>8}  "
        f"{found.minimum:.4f} mm, proven {found.lower_bound:.4f}"
    )
    for name, run in [
        ("python-fcl", sampled_by_fcl(mesh, placed)),
        ("coal", sampled_by_coal(mesh, placed)),
        ("shapely, in the plane", sampled_by_shapely(contour, placed)),
    ]:
        theirs, least = worked(run)
        # Ours again: what the machine does besides falls on both.
        again, _ = worked(lambda: arms.arm_clearance(tolerance))
        what = f"{name}, {SAMPLES} samples"
        print(f"  {what:34} {seconds(theirs):>10} {times(theirs, again):>8}  {least:.4f} mm", flush=True)
        assert found.lower_bound < least < found.minimum + 0.2, "not the same arms"


def published():
    """The published set, its control points, and what NumPy needs of the rest."""
    arms = ct.ThreeArm.from_toml(ct.template("three-arm"))
    radius = np.array([21.0, 28, 50, 49, 58, 47, 18, 12, 28, 60, 48, 24])
    angle = np.radians([20.0, 45, 76, 105, 132, 165, 195, 225, 255, 285, 316, 345])
    machine = numpy_three_arm.Machine(
        carrier_start=math.radians(86),
        bend=math.radians(-53),
        mounting=math.radians(-29),
        tip_distance=145.0,
        pusher_offset=65.0,
        picking=arms.picking(),
        planting=arms.planting(),
        planting_depth=10.0,
        housing_offset=10.0,
        teeth=37,
    )
    return arms, machine, angle, radius


def sweep(inputs):
    arms, machine, angle, radius = published()
    block = numpy_three_arm.Block(machine, inputs)

    def radii(count):
        return radius * (1 + 0.02 * np.sin(0.7 * np.arange(count)[:, None] + np.arange(12)))

    def by_numpy(count):
        return block.figures(np.tile(angle, (count, 1)), radii(count))

    def by_ours(count):
        return arms.sweep({f"r{k + 1}": column for k, column in enumerate(radii(count).T)}, inputs=inputs)

    theirs, ours = by_numpy(1000), by_ours(1000)
    off = {name: np.abs(theirs[name] - ours[OURS.get(name, name)]).max() for name in theirs}
    turned = max(off[name] for name in ANGLES)
    far = max(off[name] for name in off if name not in ANGLES)
    assert far < 1e-4, f"{far} mm"
    assert turned < 1e-6, f"{turned} rad"
    print(f"\ngoals 2 to 4 and 6 to 8 of a machine at {inputs} inputs, machines for a second of work", flush=True)
    slow = min(worked(partial(by_numpy, count))[0] / count for count in BLOCKS)
    quick, _ = worked(partial(by_ours, 1000))
    quick /= 1000
    print(f"  NumPy, blocks of designs   {1 / slow:>10,.0f}  within {far:.1e} mm, {turned:.1e} rad of ours")
    print(f"  centrode                   {1 / quick:>10,.0f}  {times(slow, quick)}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--only", choices=["interference", "sweep"], help="one of the two comparisons")
    arguments = parser.parse_args()
    if arguments.only != "sweep":
        for name in ("three-arm-2021", "three-arm-all-goals"):
            arms = ct.ThreeArm.load(ROOT / "tests" / "designs" / f"{name}.toml")
            for tolerance in (0.1, 1e-2):
                interference(arms, f"{name}, within {tolerance} mm", tolerance)
    if arguments.only != "interference":
        sweep(360)


if __name__ == "__main__":
    main()
