"""Balls: numbers with a radius that holds every error, series of them, and all values of a function over a box."""

from flint import acb, acb_poly, acb_series, arb, arb_poly, ctx

ctx.prec = 64
TERMS = 16
ctx.cap = TERMS + 1
#: Terms that will do where the next one is so small all over the box.
FEW, SMALL = 8, 1e-11
#: Weights of the terms of one over a square root.
WEIGHTS = [[arb(-k - 2 * (n - k)) / (2 * n) if n else arb(0) for k in range(n + 1)] for n in range(TERMS + 1)]

UNIT = arb(0, 1)
ZERO = arb(0)


class UndecidedError(Exception):
    """A ball is too wide for a statement."""


class RejectedError(Exception):
    """The proof does not show what it claims."""


def interval(low, high):
    """Ball from one number to another."""
    return arb(low).union(arb(high))


def low(ball):
    """Maximum float known to lie below a ball, as a ball."""
    return ball.lower()


def high(ball):
    """Minimum float known to lie above a ball, as a ball."""
    return ball.upper()


def magnitude(z):
    """Number that no point of a complex ball exceeds by size."""
    return z.abs_upper() if isinstance(z, arb) else abs(z).upper()


def disc(radius):
    """Square around zero that holds the disc."""
    return acb(radius * UNIT, radius * UNIT)


def chebyshev(coefficients):
    """Polynomial of a Chebyshev series."""
    x = arb_poly([0, 1])
    before, last = arb_poly([1]), x
    total = arb_poly([arb(coefficients[0])])
    for c in coefficients[1:]:
        total += arb(c) * last
        before, last = last, 2 * x * last - before
    return total


class Motion:
    """Taylor coefficients in t of z = A + B x over a box in phi, the last one a ball that holds the rest."""

    def __init__(self, a, b, size):
        """`size` bounds the points that are placed."""
        self.a, self.b = a, b
        self.tail_b = sum((magnitude(c) for c in b[3:]), ZERO)
        self.tail = disc(sum((magnitude(c) for c in a[3:]), ZERO) + self.tail_b * size)

    def place(self, x):
        """All places of a point (or a ball of points) over the box."""
        a, b = self.a, self.b
        moved = (a[1] + b[1] * x) * UNIT + (a[2] + b[2] * x) * UNIT
        return a[0] + b[0] * x + moved + self.tail

    def turn(self, x):
        """All directions of a vector over the box."""
        b = self.b
        return b[0] * x + (b[1] * x + b[2] * x) * UNIT + disc(self.tail_b * magnitude(x))


def sweep(series):
    """All values over the box of a function given by its Taylor coefficients."""
    terms = [series[k] for k in range(len(series))]
    return sum((c * UNIT for c in terms[1:]), terms[0]) if terms else ZERO


def expand(functions):
    """Taylor coefficients of analytic functions of t, the last one a ball over the box; few where few will do."""
    try:
        for terms in FEW, TERMS:
            ctx.cap = terms + 1
            far = functions(UNIT)
            if all(magnitude(f[terms]) < SMALL for f in far):
                break
        near = functions(ZERO)
    finally:
        ctx.cap = TERMS + 1
    return [[f[k] for k in range(terms)] + [g[terms]] for f, g in zip(near, far, strict=True)]


def shifted(poly, at):
    """Series around a value of t."""
    return acb_series(poly(acb_poly([acb(at), 1])).coeffs(), ctx.cap)


def through(poly, series):
    """Series of a polynomial of a series."""
    start = series[0]
    if all(series[k] == 0 for k in range(1, ctx.cap)):
        return acb_series([poly(start)], ctx.cap)
    inner = acb_series([acb(0)] + [series[k] for k in range(1, ctx.cap)], ctx.cap)
    return acb_series(poly(acb_poly([start, 1])).coeffs(), ctx.cap)(inner)


def mirrored(series):
    """Complex conjugate for real t."""
    return acb_series([series[k].conjugate() for k in range(ctx.cap)], ctx.cap)


def real(series):
    """Real part for real t."""
    return acb_series([series[k].real for k in range(ctx.cap)], ctx.cap)


def root(series):
    """One over the square root of a real series (its logarithmic derivative gives each term from those before it)."""
    s = [series[k].real for k in range(ctx.cap)]
    if not s[0] > 0:
        raise UndecidedError
    # Terms that are zero from some place on, as at the ends of short boxes, add nothing.
    ratio = [c / s[0] for c in s[: max(k for k in range(ctx.cap) if s[k] != 0 or k == 0) + 1]]
    out = [s[0].rsqrt()]
    for n in range(1, ctx.cap):
        total = ZERO
        for k in range(1, min(n + 1, len(ratio))):
            total += ratio[k] * out[n - k] * WEIGHTS[n][k]
        out.append(total)
    return acb_series(out, ctx.cap)
