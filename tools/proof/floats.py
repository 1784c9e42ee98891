"""Floats that bound balls: every bound gives way by more than all rounding behind it.

A float operation is off by at most 2^-53 of its result. A term of a sum here comes from fewer than sixty operations, so
it is off by less than SHARE of its size, and a sum by less than SHARE of the sizes of its terms.
"""

from math import isfinite, sqrt

from flint import acb, arb
from proof.balls import UndecidedError, magnitude

SHARE = 2.0**-46


def upper(ball):
    """Float above a ball and above all rounding of it."""
    value = float(ball.upper() if isinstance(ball, arb) else magnitude(ball))
    if not isfinite(value):
        raise UndecidedError
    return value + SHARE * abs(value)


def ends(ball):
    """Floats below and above a ball."""
    return -upper(-ball), upper(ball)


def near(ball):
    """Complex float near a complex ball, and how far the ball reaches from it at most."""
    middle = complex(float(ball.real.mid()), float(ball.imag.mid()))
    return middle, upper(ball - acb(middle.real, middle.imag))


def below(*terms):
    """Float below a sum."""
    total = size = 0.0
    for term in terms:
        total += term
        size += abs(term)
    return total - SHARE * size


def above(*terms):
    """Float above a sum."""
    total = size = 0.0
    for term in terms:
        total += term
        size += abs(term)
    return total + SHARE * size


def better(a, b):
    """The greater of two lower bounds, of which either may be missing."""
    return b if a is None else a if b is None else max(a, b)


class Motion:
    """Places z = A(t) + B(t) x over a box, t from -1 to 1, from the Taylor coefficients of A and of B, a turn."""

    def __init__(self, a, b, size, off):
        """`size` bounds the points that are placed, `off` how far floats of them are from the points."""
        middles, rests = [], []
        for series in (a, b):
            start = [near(c) for c in series[:3]]
            rest = sum(r for _, r in start) + sum(upper(c) for c in series[3:])
            rests.append((1 + SHARE) * rest + 2 * SHARE * sum(abs(c) for c, _ in start))
            # t^2 is from 0 to 1: one half, and one half either way.
            middles.append((start[0][0] + start[2][0] / 2, start[1][0], start[2][0] / 2))
        (self.a, *self.along_a), (self.b, *self.along_b) = middles
        self.turn_rest = rests[1]
        self.rest = (1 + SHARE) * (rests[0] + rests[1] * size + 2 * off)
        self.swing = (1 + SHARE) * (abs(self.along_b[0]) + abs(self.along_b[1]) + self.turn_rest)

    def place(self, x, across=0.0, up=0.0):
        """Middle of all places of a point, and of points near it, and how far they reach along either axis."""
        (a1, a2), (b1, b2) = self.along_a, self.along_b
        first, second = a1 + b1 * x, a2 + b2 * x
        rest = self.rest
        if across or up:
            across, up = self.turned(across, up)
        return (
            self.a + self.b * x,
            abs(first.real) + abs(second.real) + rest + across,
            abs(first.imag) + abs(second.imag) + rest + up,
        )

    def turned(self, across, up):
        """Reach along either axis of a turned rectangle."""
        re, im, rest = abs(self.b.real), abs(self.b.imag), self.swing * (across + up)
        return above(re * across, im * up, rest), above(im * across, re * up, rest)

    def reach(self, x):
        """Middle of all places of a point and how far they reach from it."""
        (a1, a2), (b1, b2) = self.along_a, self.along_b
        return self.a + self.b * x, abs(a1 + b1 * x) + abs(a2 + b2 * x) + self.rest

    def turn(self, x, across=0.0, up=None):
        """Middle of all directions of a vector over the box, and how far they reach; of vectors near it, too."""
        first, second = self.along_b[0] * x, self.along_b[1] * x
        rest = (self.turn_rest + SHARE) * abs(x)
        across, up = self.turned(across, across if up is None else up) if across or up else (0.0, 0.0)
        return (
            self.b * x,
            abs(first.real) + abs(second.real) + rest + across,
            abs(first.imag) + abs(second.imag) + rest + up,
        )

    def across(self, x, error):
        """Middle of the real part of a turned vector, which may be off by an error either way, and its reach."""
        (b1, b2), middle = self.along_b, self.b * x
        # A turn keeps lengths: the error's is below one and a half of it.
        rest = (self.turn_rest + SHARE) * abs(x) + 2 * error
        return middle.real, abs((b1 * x).real) + abs((b2 * x).real) + rest

    def run(self, tangents):
        """Bounds on the real part of turned unit vectors within a disc; None if it may be zero."""
        middle, radius = tangents
        middle, radius = self.b * middle, above(radius, self.swing)
        if not abs(middle.real) > 1.001 * radius:
            return None
        most, least = above(abs(middle.imag), radius), below(abs(middle.imag), -radius)
        if not most < 0.999:
            return None
        bounds = (1 - SHARE) * sqrt(1 - most * most), (1 + SHARE) * sqrt(1 - max(0.0, least) ** 2)
        return bounds if middle.real > 0 else (-bounds[1], -bounds[0])
