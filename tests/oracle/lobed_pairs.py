"""Pairs of several mean ratios: driver r = p u(phi), closed by int r/(a - r) dphi = 2 pi n2/n1.

mean_ratio = [n1, n2] is turns of the driver : turns of the driven gear, so the driven gear has
z n1/n2 teeth. The driven curve closes on itself when the driver's lobes are a multiple of n2.
"""

from figures import write
from mpmath import cos, mpf, pi, quad, sin, sqrt
from quadrature import center_distance, over_period

PHI = [2 * pi * i / 24 for i in range(1, 25)]


def conic(k, lobes):
    def u(t):
        return 1 / (1 - k * cos(lobes * t))

    def slope(t):
        return -k * lobes * sin(lobes * t) / (1 - k * cos(lobes * t)) ** 2

    return u, slope


def wave(k, lobes):
    return (lambda t: 1 + k * cos(lobes * t)), (lambda t: -k * lobes * sin(lobes * t))


def case(kind, shape, k, lobes, mean_ratio, module, tooth_count):
    u, slope = shape(mpf(k), lobes)
    n1, n2 = mean_ratio
    perimeter = pi * mpf(module) * tooth_count
    p = perimeter / over_period(lambda t: sqrt(u(t) ** 2 + slope(t) ** 2))
    greatest = max(u(2 * pi * i / 720) for i in range(720)) * p
    a = center_distance(lambda a: over_period(lambda t: p * u(t) / (a - p * u(t))), 2 * pi * n2 / n1, greatest)
    driven, total, before = [], mpf(0), mpf(0)
    for phi in PHI:
        total += quad(lambda t: p * u(t) / (a - p * u(t)), [before, phi])
        driven.append([phi, total])
        before = phi
    assert abs(total - 2 * pi * n2 / n1) < mpf(10) ** -28
    return {
        "kind": kind,
        "eccentricity": mpf(k),
        "lobes": lobes,
        "mean_ratio": list(mean_ratio),
        "module": mpf(module),
        "tooth_count": tooth_count,
        "driven_tooth_count": tooth_count * n1 // n2,
        "parameter": p,
        "perimeter": perimeter,
        "center_distance": a,
        "driven_angle": driven,
    }


if __name__ == "__main__":
    write(
        "lobed_pairs",
        """Driver r = p/(1 - k cos(N phi)) ("lobed-ellipse") or p (1 + k cos(N phi)) ("polar"); k = eccentricity,
N = lobes, p = parameter (mm), scaled to perimeter pi m z.
driven_angle: rows of driver angle phi and driven angle, rad.""",
        [
            case("lobed-ellipse", conic, "0.2", 1, (1, 1), "2", 20),
            case("lobed-ellipse", conic, "0.1", 2, (1, 1), "2", 24),
            case("lobed-ellipse", conic, "0.1", 2, (2, 1), "2", 24),
            case("lobed-ellipse", conic, "0.1", 2, (3, 2), "2", 24),
            case("lobed-ellipse", conic, "0.1", 2, (5, 2), "2", 22),
            case("lobed-ellipse", conic, "0.05", 3, (1, 3), "2", 60),
            case("polar", wave, "0.08", 2, (1, 1), "1.5", 24),
            case("polar", wave, "0.08", 5, (2, 5), "1", 100),
        ],
    )
