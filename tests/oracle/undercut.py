"""How many flanks of the 2021 sun a full-depth rack undercuts, by where its teeth sit.

The twelve points as control points of the cubic spline in x and y, 33 teeth, no backlash. A flank that crosses the
pitch curve at an arc length s is touched, after rolling on by x, at x cos(alpha) from the pitch point and
x sin(alpha) cos(alpha) below the pitch line of the rack; it is cut as long as sin(alpha) - k(s + x) x cos(alpha) stays
positive, k the curvature there.
"""

from bisect import bisect_right
from math import cos, pi, radians, sin

from figures import write
from transplanter_pair import ANGLE_DEG, COUNT, RADIUS, blend, slopes

TEETH, ALPHA = 33, radians(20)
PARTS = 2000
"""Samples of the curve a span: arc length by the trapezoidal rule is right to 1e-9 of a pitch."""
STEPS = 1500
PHASES = [k / 32 for k in range(32)]
CLEAR = 2e-3
"""A count is told where no flank is nearer to its limit than this."""


def second(x):
    """Second derivatives of the cubic B-splines of a span."""
    return [1 - x, 3 * x - 2, 1 - 3 * x, x]


def sampled():
    """Arc length from the polar angle zero, and curvature, over three laps; and the length of one."""
    points = [r * complex(cos(radians(a)), sin(radians(a))) for r, a in zip(RADIUS, ANGLE_DEG, strict=True)]
    places = []
    for span in range(COUNT):
        for i in range(PARTS):
            x = i / PARTS
            at, d, dd = (
                sum(float(w) * points[(span + j) % COUNT] for j, w in enumerate(weights(x)))
                for weights in (lambda x: blend(3, x), lambda x: slopes(3, x), second)
            )
            places.append((at, abs(d), (d.conjugate() * dd).imag / abs(d) ** 3))
    arc = [0.0]
    for (_, speed, _), (_, after, _) in zip(places, places[1:] + places[:1], strict=True):
        arc.append(arc[-1] + 0.5 * (speed + after) / PARTS)
    length = arc.pop()
    zero = next(
        s + (t - s) * p.imag / (p.imag - q.imag)
        for s, t, (p, *_), (q, *_) in zip(arc, [*arc[1:], length], places, places[1:] + places[:1], strict=True)
        if p.imag <= 0 < q.imag and p.real > 0
    )
    laps = [(s + lap * length - zero, k) for lap in (-1, 0, 1) for s, (*_, k) in zip(arc, places, strict=True)]
    return [s for s, _ in laps], [k for _, k in laps], length


def read(arcs, curvatures, s):
    i = bisect_right(arcs, s) - 1
    share = (s - arcs[i]) / (arcs[i + 1] - arcs[i])
    return curvatures[i] + share * (curvatures[i + 1] - curvatures[i])


def worst(arcs, curvatures, crossing, side, reach):
    """Minimum speed of generation while the rack rolls on by `reach`."""
    rolled = (reach * i / STEPS for i in range(1, STEPS + 1))
    return min(sin(ALPHA) - read(arcs, curvatures, crossing + side * x) * x * cos(ALPHA) for x in rolled)


def cases():
    arcs, curvatures, length = sampled()
    module = length / (pi * TEETH)
    pitch, reach = pi * module, module / (sin(ALPHA) * cos(ALPHA))
    for phase in PHASES:
        crossings = [((tooth + phase + side / 4) * pitch % length, side) for tooth in range(TEETH) for side in (1, -1)]
        speeds = [worst(arcs, curvatures, s, side, reach) for s, side in crossings]
        if min(abs(speed) for speed in speeds) > CLEAR:
            yield {"phase": phase, "undercut": sum(speed < 0 for speed in speeds)}


if __name__ == "__main__":
    write("undercut", __doc__, list(cases()))
