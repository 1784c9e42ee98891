"""The twelve published control points of the 2021 transplanter, read as closed uniform B-splines."""

from figures import write
from mpmath import atan2, cos, diff, findroot, floor, mpf, pi, sin, sqrt
from quadrature import by_parts, center_distance

RADIUS = [21, 28, 50, 49, 58, 47, 18, 12, 28, 60, 48, 24]
ANGLE_DEG = [20, 45, 76, 105, 132, 165, 195, 225, 255, 285, 316, 345]
COUNT = len(RADIUS)


def blend(degree, x):
    """The uniform B-splines of one span, `x` in [0, 1], written out."""
    if degree == 2:
        return [(1 - x) ** 2 / 2, (1 + 2 * x - 2 * x**2) / 2, x**2 / 2]
    return [
        (1 - x) ** 3 / 6,
        (4 - 6 * x**2 + 3 * x**3) / 6,
        (1 + 3 * x + 3 * x**2 - 3 * x**3) / 6,
        x**3 / 6,
    ]


def slopes(degree, x):
    """Their derivatives."""
    if degree == 2:
        return [x - 1, 1 - 2 * x, x]
    return [-((1 - x) ** 2) / 2, (3 * x**2 - 4 * x) / 2, (1 + 2 * x - 3 * x**2) / 2, x**2 / 2]


def spline(values, lap, degree, weights, t, span):
    """The spline on [span, span + 1]: control values weighted; every lap round adds `lap`."""
    total = mpf(0)
    for j, weight in enumerate(weights(degree, t - span)):
        laps, index = divmod(span + j, COUNT)
        total += weight * (values[index] + laps * lap)
    return total


class Polar:
    """Radius and angle are both splines of the parameter."""

    plane = "polar"

    def __init__(self, degree):
        self.degree = degree
        self.angles = [pi * mpf(a) / 180 for a in ANGLE_DEG]
        self.radii = [mpf(r) for r in RADIUS]

    def at(self, t, span):
        """Angle, radius and their derivatives."""
        d = self.degree
        return (
            spline(self.angles, 2 * pi, d, blend, t, span),
            spline(self.radii, 0, d, blend, t, span),
            spline(self.angles, 2 * pi, d, slopes, t, span),
            spline(self.radii, 0, d, slopes, t, span),
        )


class Cartesian:
    """x and y are both splines of the parameter."""

    plane = "cartesian"

    def __init__(self, degree):
        self.degree = degree
        angles = [pi * mpf(a) / 180 for a in ANGLE_DEG]
        self.x = [r * cos(a) for r, a in zip(RADIUS, angles, strict=True)]
        self.y = [r * sin(a) for r, a in zip(RADIUS, angles, strict=True)]

    def at(self, t, span):
        """Angle, radius and their derivatives."""
        d = self.degree
        x, y = (spline(v, 0, d, blend, t, span) for v in (self.x, self.y))
        dx, dy = (spline(v, 0, d, slopes, t, span) for v in (self.x, self.y))
        r = sqrt(x * x + y * y)
        return atan2(y, x), r, (x * dy - y * dx) / r**2, (x * dx + y * dy) / r


def parameter(curve, phi):
    """The parameter and span of polar angle `phi`, by walking the spans."""

    def off(t, span):
        away = curve.at(t, span)[0] - phi
        return away - 2 * pi * floor(away / (2 * pi) + mpf(1) / 2)

    for span in range(COUNT):
        low, high = off(mpf(span), span), off(mpf(span + 1), span)
        # An angle at a knot must not fall between two spans by rounding.
        if abs(low) < mpf(10) ** -35:
            return mpf(span), span
        if low <= 0 < high and high - low < pi:
            root = findroot(
                lambda t, s=span: off(t, s), (mpf(span), mpf(span + 1)), solver="anderson", tol=mpf(10) ** -60
            )
            return root, span
    raise ArithmeticError("the curve does not go round the origin")


def case(curve):
    knots = [mpf(i) for i in range(COUNT + 1)]

    def whole(f):
        return sum(by_parts(lambda t, s=s: f(*curve.at(t, s)), knots[s : s + 2]) for s in range(COUNT))

    for span in range(COUNT):  # the derivatives are right, and the polar angle rises
        t = span + mpf(3) / 7
        assert abs(diff(lambda u, s=span: curve.at(u, s)[0], t) - curve.at(t, span)[2]) < mpf(10) ** -12
        assert all(curve.at(span + mpf(i) / 50, span)[2] > 0 for i in range(51))
    greatest = max(curve.at(s + mpf(i) / 50, s)[1] for s in range(COUNT) for i in range(51))
    a = center_distance(lambda a: whole(lambda _, r, turn, __: r / (a - r) * turn), 2 * pi, greatest)
    perimeter = whole(lambda _, r, turn, slope: sqrt(slope**2 + (r * turn) ** 2))
    start, rows, total = parameter(curve, mpf(0)), [], mpf(0)
    before = start
    for i in range(1, 24):
        phi = 2 * pi * i / 24
        now = parameter(curve, phi)
        t, span = before
        goal = now[0] + (COUNT if now[0] < t else 0)
        while t < goal:
            stop = min(mpf(int(floor(t)) + 1), goal)
            s = int(floor(t)) % COUNT
            shift = int(floor(t)) - s
            total += by_parts(lambda u, s=s, shift=shift: driven(curve.at(u - shift, s), a), [t, stop])
            t = stop
        rows.append([phi, curve.at(*now)[1], total])
        before = now
    assert total < 2 * pi
    return {
        "plane": curve.plane,
        "degree": curve.degree,
        "radius": RADIUS,
        "angle_deg": ANGLE_DEG,
        "center_distance": a,
        "perimeter": perimeter,
        "driven_angle": rows,
    }


def driven(jet, a):
    _, r, turn, _ = jet
    return r / (a - r) * turn


if __name__ == "__main__":
    write(
        "transplanter_pair",
        """Control points (radius mm, angle degrees) of a closed uniform B-spline, mean ratio 1:1.
driven_angle: rows of driver angle phi, driver radius r(phi), driven angle since phi = 0; mm, rad.""",
        [case(Polar(2)), case(Polar(3)), case(Cartesian(3))],
    )
