"""The three-arm mechanism of 2021 in every reading of its twelve points: angles, heights, tips."""

from figures import write
from mpmath import asin, cos, findroot, floor, lu_solve, matrix, mpf, pi, quad, sin, sqrt
from quadrature import by_parts, center_distance
from transplanter_pair import COUNT, Cartesian, Polar, blend, driven, parameter

CARRIER_START = pi * 86 / 180
BEND = -pi * 53 / 180
MOUNTING = -pi * 29 / 180
TIP, PUSHER = mpf(145), mpf(65)
PICKING, PLANTING = pi * 20 / 180, pi * 191 / 180


def controls(values, lap, degree):
    """Control values of the closed spline that takes `values` where its control points pull most."""
    at = mpf(0) if degree % 2 else mpf(1) / 2
    weights = blend(degree, at)
    half = degree // 2
    system, right = matrix(COUNT, COUNT), matrix(COUNT, 1)
    for span in range(COUNT):
        right[span] = values[(span + half) % COUNT] + (lap if span + half >= COUNT else 0)
        for j, weight in enumerate(weights):
            laps, index = divmod(span + j, COUNT)
            system[span, index] += weight
            right[span] -= weight * laps * lap
    return list(lu_solve(system, right))


class PolarThrough(Polar):
    """Radius and angle are splines that pass through the points."""

    def __init__(self, degree):
        super().__init__(degree)
        self.angles = controls(self.angles, 2 * pi, degree)
        self.radii = controls(self.radii, 0, degree)


class CartesianThrough(Cartesian):
    """x and y are splines that pass through the points."""

    def __init__(self, degree):
        super().__init__(degree)
        self.x = controls(self.x, 0, degree)
        self.y = controls(self.y, 0, degree)


class Machine:
    """One arm: the sun's curve read clockwise, two stages, the arm on the planet."""

    def __init__(self, curve):
        self.curve = curve
        knots = [mpf(i) for i in range(COUNT + 1)]

        def whole(f):
            return sum(by_parts(lambda t, s=s: f(*curve.at(t, s)), knots[s : s + 2]) for s in range(COUNT))

        greatest = max(curve.at(s + mpf(i) / 50, s)[1] for s in range(COUNT) for i in range(51))
        self.a = center_distance(lambda a: whole(lambda _, r, turn, __: r / (a - r) * turn), 2 * pi, greatest)
        self.perimeter = whole(lambda _, r, turn, slope: sqrt(slope**2 + (r * turn) ** 2))
        self.totals = [quad(lambda t, s=s: driven(curve.at(t, s), self.a), [s, s + 1]) for s in range(COUNT)]
        assert abs(sum(self.totals) - 2 * pi) < mpf(10) ** -25
        self.zero = self.past(*parameter(curve, mpf(0)))
        self.reference = -self.turned(-abs(BEND))
        self.chi = self.polar(-BEND - pi)

    def past(self, t, span):
        """Driven angle from parameter zero."""
        inside = quad(lambda u: driven(self.curve.at(u, span), self.a), [span, t]) if t > span else mpf(0)
        return sum(self.totals[:span]) + inside

    def turned(self, phi):
        """Driven angle at polar angle `phi`, any number of turns."""
        laps = floor(phi / (2 * pi))
        rest = self.past(*parameter(self.curve, phi - laps * 2 * pi)) - self.zero
        return rest - 2 * pi * floor(rest / (2 * pi)) + 2 * pi * laps

    def polar(self, turned):
        """Polar angle at a driven angle: the inverse."""
        laps = floor(turned / (2 * pi))
        value = turned - 2 * pi * laps + self.zero
        value -= 2 * pi * floor(value / (2 * pi))
        span = 0
        while span < COUNT - 1 and sum(self.totals[: span + 1]) <= value:
            span += 1
        t = findroot(
            lambda t: self.past(t, span) - value, (mpf(span), mpf(span + 1)), solver="anderson", tol=mpf(10) ** -50
        )
        angle = self.curve.at(t, span)[0]
        return angle - 2 * pi * floor(angle / (2 * pi)) + 2 * pi * laps

    def at(self, theta):
        """Tip and direction of the clamp."""
        carrier = CARRIER_START - theta
        arm = carrier + BEND - self.reference - (self.polar(self.turned(-theta) - BEND - pi) - self.chi)
        x = self.a * (cos(carrier) + cos(carrier + BEND)) + TIP * cos(arm + MOUNTING)
        y = self.a * (sin(carrier) + sin(carrier + BEND)) + TIP * sin(arm + MOUNTING)
        clamp = arm + MOUNTING + asin(PUSHER / TIP)
        return x, y, clamp - 2 * pi * floor(clamp / (2 * pi) + mpf(1) / 2)

    def crest(self, sign):
        """Maximum height of the tip (sign 1), or minimum (-1)."""
        _, best = max((sign * self.at(2 * pi * i / 24)[1], 2 * pi * i / 24) for i in range(24))
        # Golden section: a crest is flat, so half the digits of the place give all of the height.
        ratio = (sqrt(mpf(5)) - 1) / 2
        low, high = best - 2 * pi / 24, best + 2 * pi / 24
        a, b = high - ratio * (high - low), low + ratio * (high - low)
        fa, fb = sign * self.at(a)[1], sign * self.at(b)[1]
        while high - low > mpf(10) ** -7:
            if fa > fb:
                high, b, fb = b, a, fa
                a = high - ratio * (high - low)
                fa = sign * self.at(a)[1]
            else:
                low, a, fa = a, b, fb
                b = low + ratio * (high - low)
                fb = sign * self.at(b)[1]
        return sign * max(fa, fb)


def case(curve, interpolate):
    machine = Machine(curve)
    picking, planting = machine.at(PICKING), machine.at(PLANTING)
    return {
        "plane": curve.plane,
        "degree": curve.degree,
        "interpolate": interpolate,
        "center_distance": machine.a,
        "perimeter": machine.perimeter,
        "planet_reference_deg": machine.reference * 180 / pi,
        "pick_angle_deg": picking[2] * 180 / pi,
        "push_angle_deg": -planting[2] * 180 / pi,
        "picking_tip": list(picking[:2]),
        "planting_tip": list(planting[:2]),
        "height": machine.crest(1) - machine.crest(-1),
    }


if __name__ == "__main__":
    write(
        "three_arm",
        """Three-arm mechanism of 2021: its points as a closed uniform B-spline, with control points or through them.
Carrier start 86, bend -53, mounting angle -29 deg, S = 145, H1 = 65 mm; picking at 20, planting at 191 deg.
Angles in degrees, lengths in mm; the height is right to 1e-12.""",
        [
            case(Polar(2), False),
            case(Polar(3), False),
            case(PolarThrough(2), True),
            case(PolarThrough(3), True),
            case(Cartesian(2), False),
            case(Cartesian(3), False),
            case(CartesianThrough(3), True),
        ],
    )
