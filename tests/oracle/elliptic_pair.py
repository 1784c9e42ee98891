"""The 2018 elliptic pair: perimeter, centre distance, law of motion, and points of its teeth."""

from figures import write
from mpmath import atan, atan2, cos, ellipe, floor, mpf, pi, quad, sin, sqrt, tan
from quadrature import center_distance, over_period
from rolling_rack import BasicRack, RollingRack, turned

ECCENTRICITY = 1 / (2 + sqrt(mpf(3)))
MODULE = mpf("2.25")
TOOTH_COUNT = 23


class FocalEllipse:
    """Focus at the origin, far apex on +x; parameter is the eccentric anomaly."""

    def __init__(self, k, semi_major):
        self.k, self.semi_major = k, semi_major
        self.semi_minor = semi_major * sqrt(1 - k * k)

    def point(self, t):
        return self.semi_major * (self.k + cos(t)), self.semi_minor * sin(t)

    def arc(self, t):
        """Arc length from the far apex, by the incomplete integral of the second kind."""
        m = self.k**2
        return self.semi_major * (ellipe(m) - ellipe(pi / 2 - t, m))

    def at_arc(self, s):
        """Eccentric anomaly at arc length `s`, by Newton."""
        t = s / self.semi_major
        for _ in range(60):
            step = (self.arc(t) - s) / (self.semi_major * sqrt(1 - (self.k * cos(t)) ** 2))
            t -= step
            if abs(step) < mpf(10) ** -36:
                return t
        raise ArithmeticError("arc length not inverted")


def radius(phi):
    """Pitch radius over semi-major axis."""
    return (1 - ECCENTRICITY**2) / (1 - ECCENTRICITY * cos(phi))


def radius_slope(phi):
    return -radius(phi) * ECCENTRICITY * sin(phi) / (1 - ECCENTRICITY * cos(phi))


def driven_angle(phi, a, semi_major):
    """Driven angle by quadrature, held against the closed form."""
    ratio = lambda t: semi_major * radius(t) / (a - semi_major * radius(t))  # noqa: E731
    value = quad(ratio, [0, phi / 2, phi]) if phi else mpf(0)
    turns = floor((phi + pi) / (2 * pi))
    half = atan((1 + ECCENTRICITY) / (1 - ECCENTRICITY) * tan((phi - 2 * pi * turns) / 2))
    if abs(abs(phi - 2 * pi * turns) - pi) > mpf(10) ** -20:
        assert abs(2 * half + 2 * pi * turns - value) < mpf(10) ** -28
    return value


def polar_angle(point):
    angle = atan2(point[1], point[0])
    return angle if angle >= 0 else angle + 2 * pi


def pair():
    perimeter = pi * MODULE * TOOTH_COUNT
    semi_major = perimeter / over_period(lambda t: sqrt(radius(t) ** 2 + radius_slope(t) ** 2))
    assert abs(4 * semi_major * ellipe(ECCENTRICITY**2) - perimeter) < mpf(10) ** -28
    a = center_distance(
        lambda a: over_period(lambda t: semi_major * radius(t) / (a - semi_major * radius(t))),
        2 * pi,
        semi_major * (1 + ECCENTRICITY),
    )
    assert abs(a - 2 * semi_major) < mpf(10) ** -28
    return perimeter, semi_major, a


def flank_rows(roll, ellipse, a, pitch):
    """Points cut by the same rack at the same instant on both gears: they touch there.

    Heights stay within 0.7 modules: contacts beyond lie outside the tip curve of one gear.
    """
    rows = []
    for index in (0, 3, 7, 11, 12, 17, 21):
        for side in (1, -1):
            s = index * pitch + side * pitch / 4
            for height in ("-0.7", "-0.3", "0.15", "0.7"):
                y = mpf(height) * MODULE
                # A straight line through the pitch point is close to the answer.
                guess = ellipse.at_arc(s - side * y / (sin(pi / 9) * cos(pi / 9)))
                t, (x, z) = roll.flank(s, side, y, guess)
                assert abs(t - guess) < mpf(10) ** -25
                phi = polar_angle(ellipse.point(t))
                if index == 0 and phi > pi:
                    phi -= 2 * pi
                if index == 21 and phi < pi:
                    phi += 2 * pi
                world = turned((x, z), -phi)
                psi = driven_angle(phi, a, ellipse.semi_major)
                other = turned((world[0] - a, world[1]), -psi)
                rows.append([index, side, mpf(height), phi, psi, x, z, *other])
    return rows


def fillet_rows(roll, ellipse, pitch):
    rows = []
    for index in (0, 3, 7, 11, 12, 17, 21):
        for side in (1, -1):
            s = index * pitch + side * pitch / 4
            for degrees in (10, 30, 50, 65):
                beta = pi * degrees / 180
                # The rounding's normal passes near the pitch point.
                guess = ellipse.at_arc(s + side * (roll.rack.along + roll.rack.depth * tan(beta)))
                _, (x, z) = roll.fillet(s, side, beta, guess)
                rows.append([index, side, degrees, x, z])
    return rows


if __name__ == "__main__":
    perimeter, semi_major, a = pair()
    ellipse = FocalEllipse(ECCENTRICITY, semi_major)
    rack = BasicRack(MODULE)
    roll = RollingRack(rack, ellipse.point, ellipse.arc)
    pitch = perimeter / TOOTH_COUNT
    minimum_curvature_radius = semi_major * (1 - ECCENTRICITY**2)
    write(
        "elliptic_pair",
        """Driver r = A (1 - k^2)/(1 - k cos phi) about its focus, far apex on +x. mm, rad.
driven_angle: rows of driver angle phi, driven angle.
flank: tooth index i (tooth 0 centered on the far apex), side (+1: the flank that comes last counter-clockwise),
  rack height over the pitch line in modules, driver angle phi and driven angle at contact, then the contact point
  in the driver's frame (x, y) and in the driven gear's frame (x, y), each as at phi = 0.
fillet: tooth index, side, angle in degrees of the rack tip's normal from the bottom, point in the driver's frame.""",
        [
            {
                "eccentricity": ECCENTRICITY,
                "module": MODULE,
                "tooth_count": TOOTH_COUNT,
                "perimeter": perimeter,
                "semi_major_axis": semi_major,
                "center_distance": a,
                "minimum_radius": semi_major * (1 - ECCENTRICITY),
                "maximum_radius": semi_major * (1 + ECCENTRICITY),
                "minimum_curvature_radius": minimum_curvature_radius,
                "maximum_module_without_undercut": minimum_curvature_radius * sin(pi / 9) ** 2,
                "driven_angle": [
                    [phi, driven_angle(phi, a, semi_major)] for phi in (2 * pi * i / 24 for i in range(1, 25))
                ],
                "flank": flank_rows(roll, ellipse, a, pitch),
                "fillet": fillet_rows(roll, ellipse, pitch),
            }
        ],
    )
