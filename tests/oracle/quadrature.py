"""Integrals and the closure of a gear pair, to the working precision."""

from itertools import pairwise

from mpmath import findroot, mp, mpf, pi, quad


def over_period(f, period=None):
    """Integral of a smooth periodic function over one period: trapezoids, doubled until they agree."""
    period = 2 * pi if period is None else period
    count, before = 16, None
    while count <= 1 << 14:
        total = period / count * sum(f(period * i / count) for i in range(count))
        if before is not None and abs(total - before) <= abs(total) * mpf(10) ** (8 - mp.dps):
            return total
        before, count = total, 2 * count
    raise ArithmeticError("the trapezoid sum did not settle: is the function smooth and periodic?")


def by_parts(f, knots):
    """Integral of a function smooth between the knots."""
    return sum(quad(f, [a, b]) for a, b in pairwise(knots))


def center_distance(turn, target, least):
    """The `a > least` with `turn(a) == target`, where `turn` is the driven turn, falling in `a`."""
    low, high = least * (1 + mpf(10) ** -3), 2 * least
    while turn(high) > target:
        high *= 2
    while turn(low) < target:
        low = least + (low - least) / 8
    return findroot(lambda a: turn(a) - target, (low, high), solver="anderson", tol=mpf(10) ** -60)
