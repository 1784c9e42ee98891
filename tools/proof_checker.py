#!/usr/bin/env python3
"""Checks a proof of `centrode prove`: that two gears hold each other at every angle of the driver, and never overlap.

    proof_checker.py pair.proof [pair.toml]

Needs python-flint alone; shares no code with centrode. All numbers are balls: a midpoint and a radius that holds every
error of rounding. The file gives the contours, the law and hints (where the gears touch, and a parabola between them);
a wrong hint fails the check, it cannot pass it.

The driver stands in its own axes. At the driver angle phi the driven gear, turned by psi, has its point q at

    X = a e^(i phi) + e^(i (phi + psi)) q.

Its seat `on` is the least psi of its play, `back` the greatest. With w the half width, for every phi of the cycle:

 1. Neither contour meets the other at any psi from on + w to back - w. Two pieces are apart by the discs around them,
    or by a parabola H(X) = Im y - k (Re y)^2 = 0, y = conj(T) (X - c), through a point c of a contour along its unit
    tangent T: the driver keeps H above a number, the driven gear below it. A walk along a contour, away from c, bounds
    H by its slope and its second derivative. As dH/dpsi has one sign, the driven gear stays below when it is turned.
 2. Within w of either seat the contours meet: two components of the vector from a point of one to the other change
    their signs over opposite sides of a rectangle in (place along the contour, psi), so both vanish in it (Miranda).

So each seat lies within w of its series in the file; the transmission error, seat less law, in an interval 2 w wide.
Where there is no backlash, nothing lies between on + w and back - w; then 1 says that the flanks of either side are
apart when the driven gear is turned by w off its seat on that side: they overlap by no more than w times the radius.

Not shown: that the contours are those of the design, that neither crosses itself, and that the law's pieces are the
design's law; the file says how near it is by measurement. Joints closed but for rounding count as closed.
"""

import json
import sys
from argparse import ArgumentParser
from concurrent.futures import ProcessPoolExecutor
from itertools import pairwise
from math import tau

from flint import acb, acb_poly, acb_series, arb, arb_poly, ctx

ctx.prec = 64
TERMS, SHORT = 16, 8
ctx.cap = TERMS + 1
#: Weights of the terms of one over a square root.
WEIGHTS = [[arb(-k - 2 * (n - k)) / (2 * n) if n else arb(0) for k in range(n + 1)] for n in range(TERMS + 1)]

UNIT = arb(0, 1)
ZERO = arb(0)
#: Distance, mm, up to which pieces of a contour may miss each other at a joint: such a gap counts as closed.
JOINT = arb(1e-9)
#: Driver angle by which a box is widened, as a share of it, so that no rounding of its ends leaves a gap.
OVERLAP = arb(1) + arb(1e-9)
#: Greatest number of halvings: of a box in phi, of a piece of a contour.
DEEP, FINE, FINEST = 9, 5, 10
#: Stretches checked in one go.
RUN = 16
#: Pieces beyond those that touch whose neighbours a parabola has to part.
AROUND = 2
#: Half of the rectangle's side along the contour, mm.
REACH = arb(1e-6)


class UndecidedError(Exception):
    """A ball is too wide to say anything."""


class RejectedError(Exception):
    """The proof does not show what it claims."""


def interval(low, high):
    """Ball from one number to another."""
    return arb(low).union(arb(high))


def low(ball):
    """Greatest float known to lie below a ball, as a ball."""
    return ball.lower()


def high(ball):
    """Least float known to lie above a ball, as a ball."""
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


class Node:
    """Part of a contour's piece, or a run of pieces: a disc around it, and what it splits into."""

    def __init__(self, first, last, centre, radius, split):
        self.first, self.last = first, last
        self.centre, self.radius, self.size = centre, radius, magnitude(centre) + radius
        self._split, self._parts = split, None

    @property
    def parts(self):
        """What it splits into."""
        if self._parts is None:
            self._parts = self._split()
        return self._parts


class Contour:
    """Closed contour of polynomial pieces; a place on it is the number of the piece and the share passed of it."""

    def __init__(self, pieces, name):
        if len(pieces) < 3:
            raise RejectedError(f"the {name}'s contour has {len(pieces)} pieces")
        self.count, self.hulls = len(pieces), {}
        self.at = [acb_poly([acb(x, y) for x, y in piece]) for piece in pieces]
        self.first = [p.derivative() for p in self.at]
        self.second = [p.derivative() for p in self.first]
        self.starts = [p(acb(-1)) for p in self.at]
        self.stops = [p(acb(1)) for p in self.at]
        self.slopes = [(d(acb(-1)), d(acb(1))) for d in self.first]
        area, self.gap = ZERO, ZERO
        for i in range(self.count):
            gap = magnitude(self.starts[(i + 1) % self.count] - self.stops[i])
            self.gap = self.gap.max(gap)
            if not gap < JOINT:
                raise RejectedError(f"the {name}'s contour is open by {gap} mm after piece {i}")
            conjugate = acb_poly([c.conjugate() for c in self.at[i].coeffs()])
            swept = (conjugate * self.first[i]).integral()
            area += (swept(acb(1)) - swept(acb(-1))).imag
        if not area > 0:
            raise RejectedError(f"the {name}'s contour does not run counter-clockwise")
        self.size = max(self.part(i, -1.0, 1.0).size for i in range(self.count))
        self.root = self.run(0, self.count)

    def run(self, first, last):
        """Node of whole pieces."""
        if last - first == 1:
            return self.part(first, -1.0, 1.0)
        middle = (first + last) // 2
        a, b = self.run(first, middle), self.run(middle, last)
        centre = acb(((a.centre + b.centre) / 2).mid())
        radius = max(high(magnitude(n.centre - centre) + n.radius) for n in (a, b))
        return Node(first, last, centre, radius, lambda: (a, b))

    def end(self, piece, end):
        """Point and derivative at an end of a piece, or at any number within it."""
        if end == -1:
            return self.starts[piece], self.slopes[piece][0]
        if end == 1:
            return self.stops[piece], self.slopes[piece][1]
        return self.at[piece](acb(end)), self.first[piece](acb(end))

    def hull(self, piece, start, stop):
        """Balls around all points of a part of a piece, the unit tangents there and the curvatures."""
        key = piece, start, stop
        if key not in self.hulls:
            # Around the middle, for powers of a ball far from zero would forget how they hang together.
            half = arb((stop - start) / 2)
            local = self.at[piece](acb_poly([acb((start + stop) / 2), half]))
            first = local.derivative()
            second = first.derivative()

            def functions(at):
                along, bent = shifted(first, at), shifted(second, at)
                back = mirrored(along)
                square = back * along
                share = root(square)
                return along * share, real(acb(0, -1) * back * bent) * (share * share * share)

            try:
                tangents, curvatures = (sweep(f) for f in expand(functions, SHORT))
                found = sweep(local), tangents, curvatures.real
            except UndecidedError:
                found = sweep(local), None, None
            finally:
                ctx.cap = TERMS + 1
            if (start * 2.0**FINE).is_integer() and (stop * 2.0**FINE).is_integer():
                self.hulls[key] = found
            return found
        return self.hulls[key]

    def beyond(self, piece, place, reach):
        """How far the contour leaves a piece's continuation within a reach of a place; none where it is far."""
        end = 1 if place > 0 else -1
        over = high(place * end + reach - 1)
        if over <= 0:
            return ZERO
        if over > 1e-3:
            return None
        following = (piece + end) % self.count
        (point, first), (next_point, next_first) = self.end(piece, end), self.end(following, -end)
        share = abs(first) / abs(next_first)
        near = arb(1).union(arb(1) + over)
        bend = magnitude(self.second[piece](acb(end * near)))
        reached = arb(-end) * (arb(1) - interval(ZERO, over * share.upper()))
        bend += magnitude(self.second[following](acb(reached))) * share * share
        return magnitude(next_point - point) + magnitude(next_first * share - first) * over + bend * over * over / 2

    def part(self, piece, start, stop):
        """Node of a part of a piece, with what may lie between it and its neighbours."""
        middle, half = (start + stop) / 2, arb((stop - start) / 2)
        centre = self.at[piece](acb(middle))
        radius = high(magnitude(self.first[piece](acb(interval(start, stop)))) * half)

        def split():
            return self.part(piece, start, middle), self.part(piece, middle, stop)

        return Node(
            piece + (start + 1) / 2,
            piece + (stop + 1) / 2,
            acb(centre.mid()),
            radius + magnitude(centre - acb(centre.mid())) + self.gap,
            split,
        )


class Law:
    """Driven angle by driver angle, in Chebyshev pieces."""

    def __init__(self, law):
        self.ends, self.period = law["ends"], law["period"]
        self.slope = arb(law["advance"]) / arb(self.period)
        self.pieces = [chebyshev(c) for c in law["pieces"]]
        if self.ends[0] != 0 or self.ends[-1] != self.period or len(self.ends) != len(self.pieces) + 1:
            raise RejectedError("the law's pieces do not cover its period")
        if not all(a < b for a, b in pairwise(self.ends)):
            raise RejectedError("the ends of the law's pieces do not ascend")
        if not magnitude(arb(self.period) - 2 * arb.pi()) < 1e-12:
            raise RejectedError("the law's period is no turn of the driver")
        for i, piece in enumerate(self.pieces):
            after = self.pieces[(i + 1) % len(self.pieces)]
            if not magnitude(piece(arb(1)) - after(arb(-1))) < 1e-11:
                raise RejectedError(f"the law jumps at {self.ends[i + 1]} rad")

    def along(self, middle, half):
        """The law over a box of the cycle, a polynomial in t from -1 to 1."""
        turn = int(float(middle.mid()) // self.period)
        x = middle - turn * arb(self.period)
        i = max(j for j, end in enumerate(self.ends[:-1]) if j == 0 or end <= float(x.mid()))
        centre, reach = (arb(self.ends[i]) + arb(self.ends[i + 1])) / 2, (arb(self.ends[i + 1]) - arb(self.ends[i])) / 2
        if not magnitude(x - centre) + half < reach * (OVERLAP + arb(1e-6)):
            raise RejectedError(f"a stretch at {middle} rad lies on two pieces of the law")
        rest = self.pieces[i](arb_poly([(x - centre) / reach, half / reach]))
        return rest + arb_poly([self.slope * middle, self.slope * half])


class Motion:
    """Taylor coefficients in t of z = A + B x over a box in phi, the last one a ball that holds the rest."""

    def __init__(self, a, b):
        self.a, self.b = a, b
        self.tail_a = sum((magnitude(c) for c in a[3:]), ZERO)
        self.tail_b = sum((magnitude(c) for c in b[3:]), ZERO)

    def place(self, x):
        """All places of a point (or a ball of points) over the box."""
        a, b = self.a, self.b
        moved = (a[1] + b[1] * x) * UNIT + (a[2] + b[2] * x) * UNIT
        return a[0] + b[0] * x + moved + disc(self.tail_a + self.tail_b * magnitude(x))

    def turn(self, x):
        """All directions of a vector over the box."""
        b = self.b
        return b[0] * x + (b[1] * x + b[2] * x) * UNIT + disc(self.tail_b * magnitude(x))


def sweep(series):
    """All values over the box of a function given by its Taylor coefficients."""
    terms = [series[k] for k in range(len(series))]
    return sum((c * UNIT for c in terms[1:]), terms[0]) if terms else ZERO


def expand(functions, terms=TERMS):
    """Taylor coefficients of analytic functions of t, the last one a ball over the box."""
    ctx.cap = terms + 1
    near = functions(ZERO)
    far = functions(UNIT)
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


class Box:
    """Part of a stretch: a box in phi, tau from one number to another of the stretch's -1 to 1."""

    def __init__(self, pair, stretch, start=-1.0, stop=1.0, near=None):
        self.pair, self.stretch, self.start, self.stop = pair, stretch, start, stop
        self.suspects = near or [(pair.driver.root, pair.driven.root)]
        self.tau, self.reach = arb((start + stop) / 2), arb((stop - start) / 2) * OVERLAP
        first, last = arb(stretch["from"]), arb(stretch["to"])
        self.middle = (first + last) / 2 + (last - first) / 2 * self.tau
        self.half = (last - first) / 2 * self.reach
        law = pair.law.along(self.middle, self.half)
        ahead = arb_poly([self.middle, self.half])
        seats = [self.along(s) for s in stretch["seats"]]
        play = seats[1] - seats[0]
        self.play = magnitude(sweep(play)) + 2 * pair.width
        clear = [ahead + law + s + e * pair.width for s, e in zip(seats, (1, -1), strict=True)]
        between = ahead + law + (seats[0] + seats[1]) * arb(0.5)
        self.axis = self.turning(ahead, pair.distance)
        self.clear = [self.turning(angle, 1) for angle in clear]
        turns = self.turning(between, 1)
        self.between = Motion(*([f[0][k] for k in range(TERMS)] + [f[1][TERMS]] for f in (self.axis, turns)))

    def along(self, series):
        """A Chebyshev series of the stretch over the box, a polynomial in t."""
        return chebyshev(series)(arb_poly([self.tau, self.reach]))

    def turning(self, angle, radius):
        """radius e^(i angle) around t = 0 and around every t."""
        return [
            (shifted(acb_poly(angle), at) * acb_series([acb(0, 1)], TERMS + 1)).exp() * radius for at in (ZERO, UNIT)
        ]

    def halves(self):
        """Two parts, cut where features come to an end of their pieces if they do so inside, or in the middle."""
        middle = (self.start + self.stop) / 2
        margin = 1e-6 * (self.stop - self.start)
        inside = [c for c in self.stretch["ends"] if self.start + margin < c < self.stop - margin]
        cut = min(inside, key=lambda c: abs(c - middle), default=middle)
        return [Box(self.pair, self.stretch, *ends, self.suspects) for ends in ((self.start, cut), (cut, self.stop))]

    def meetings(self):
        """What the file says of features that touch or nearly do."""
        return [Meeting(self, hint) for hint in self.stretch["meetings"]]

    def near(self):
        """Pieces whose discs are not known to be apart."""
        out, open_ = [], list(self.suspects)
        while open_:
            a, b = open_.pop()
            if self.apart(a, b):
                continue
            whole = a.last - a.first <= 1, b.last - b.first <= 1
            if all(whole):
                out.append((a, b))
            else:
                open_ += self.split(a, b)
        self.suspects = out
        return list(out)

    def split(self, a, b):
        """The parts of the larger node with the other."""
        if (a.last - a.first, float(a.radius)) > (b.last - b.first, float(b.radius)):
            return [(part, b) for part in a.parts]
        return [(a, part) for part in b.parts]

    def apart(self, a, b, offset=ZERO, half=None):
        """Whether the discs of two nodes are apart at every angle of the box and every turn in the play."""
        half = self.play / 2 if half is None else half
        centre = b.centre if offset == 0 else b.centre * acb(ZERO, offset).exp()
        room = low(abs(self.between.place(centre) - a.centre)) - a.radius - b.radius
        swing = b.size * half
        if room > swing:
            return True
        if not room > 0 or swing < a.radius + b.radius:
            return False
        # The play is wider than the discs: in two parts.
        return all(self.apart(a, b, offset + part, half / 2) for part in (half / 2, -half / 2))

    def is_free(self):
        """Claim 1: whether no two pieces meet in the play."""
        near = self.near()
        if not near:
            return True
        pairs = [(int(a.first), int(b.first)) for a, b in near]
        parted = [ranges for m in self.meetings() for ranges in [m.parted(pairs)] if ranges]
        while near:
            a, b = near.pop()
            if any(r.holds(a) and q.holds(b) for r, q in parted) or self.apart(a, b):
                continue
            if max(a.last - a.first, b.last - b.first) <= 2.0**-FINEST:
                return False
            near += self.split(a, b)
        return True

    def is_held_on(self):
        """Claim 2: whether the contours meet within the width of the seat pushed on."""
        return self.is_held(0)

    def is_held_back(self):
        """Claim 2: whether the contours meet within the width of the seat pushed back."""
        return self.is_held(1)

    def is_held(self, side):
        """Whether the features that the file names meet within the width of a seat."""
        hint = self.stretch["meetings"][self.stretch["held_by"][side]]
        return hint["side"] == side and Meeting(self, hint).is_met()


class Range:
    """Places of a contour from one to another, on round and round it."""

    def __init__(self, start, stop, count):
        self.start, self.stop, self.count = start, stop, count

    def holds(self, node):
        """Whether a part of the contour lies in it."""
        return any(
            self.start <= node.first + turn and node.last + turn <= self.stop for turn in (-self.count, 0, self.count)
        )


def ends(stretch):
    """Places tau of a stretch at which features come to an end of their pieces: good places to cut it."""
    hints = [series for hint in stretch["meetings"] for series in hint["parameters"]]
    # Not those that stay there, as a corner does.
    hints = [series for series in hints if sum(abs(c) for c in series[1:]) > 1e-9]
    return [place for series in hints for end in (-1, 1) for place in crossings(series, end)]


def crossings(series, value):
    """Places between -1 and 1 at which a Chebyshev series passes a value, to rounding."""
    for k in range(16):
        start, stop = -1 + k / 8, -1 + (k + 1) / 8
        above = clenshaw(series, start) > value
        if (clenshaw(series, stop) > value) != above:
            for _ in range(52):
                middle = (start + stop) / 2
                start, stop = (middle, stop) if (clenshaw(series, middle) > value) == above else (start, middle)
            yield start


def clenshaw(series, x):
    """Value of a Chebyshev series, in floats."""
    last = before = 0.0
    for c in reversed(series[1:]):
        last, before = 2 * x * last - before + c, last
    return x * last - before + series[0]


class Meeting:
    """Two features of the contours that touch or nearly do, and the parabola between them."""

    def __init__(self, box, hint):
        self.box, self.pair = box, box.pair
        self.side = hint["side"]
        self.way = (1, -1)[self.side]
        self.pieces = hint["pieces"]
        self.corner = hint.get("corner")
        self.k = arb(hint["bend"])
        self.places = [acb_poly(box.along(series)) for series in hint["parameters"]]
        if self.corner is not None:
            end = self.places[self.corner](acb(0)).real
            self.end = 1.0 if end > 0 else -1.0
            self.places[self.corner] = acb_poly([self.end])
        self.build()

    def build(self):
        """Both gears in the parabola's axes."""
        i, j = self.pieces
        driver, driven = self.pair.driver, self.pair.driven

        def functions(at):
            which = 0 if at is ZERO else 1
            axis, rotation = self.box.axis[which], self.box.clear[self.side][which]
            u, v = (shifted(place, at) for place in self.places)
            point = through(driver.at[i], u)
            across = through(driven.first[j], v)
            along = through(driver.first[i], u)
            tangent = -rotation * across if self.corner == 0 else along
            back = mirrored(tangent)
            back = back * root(back * tangent)
            a, b = back * (axis - point), back * rotation
            return -back * point, back, a, b, a + b * through(driven.at[j], v), back * along, b * across, u, v

        *motions, touch, along, across, u, v = expand(functions)
        self.driver, self.driven = Motion(*motions[:2]), Motion(*motions[2:])
        self.touch, self.along, self.across = sweep(touch), sweep(along), sweep(across)
        self.u, self.v = sweep(u).real, sweep(v).real

    def height(self, y):
        """H of a point in the parabola's axes."""
        return y.imag - self.k * y.real * y.real

    def level(self, height):
        """x, height and slope of the driven gear where it touches, on its own side of the parabola."""
        x = self.touch.real
        return x, -height, -(self.across.imag / self.across.real - 2 * self.k * x)

    def parted(self, pairs):
        """Ranges of both contours that the parabola keeps apart, among pairs of pieces; none where it does not."""
        start = self.height(self.touch)
        if not start < 0:
            return None
        floor = start.upper() / 2
        around = [
            {(piece + k) % contour.count for k in range(-AROUND, AROUND + 1)}
            for piece, contour in zip(self.pieces, (self.pair.driver, self.pair.driven), strict=True)
        ]
        near = {a for a, b in pairs if b in around[1]}, {b for a, b in pairs if a in around[0]}
        ranges = []
        for member, (place, fixed) in enumerate(((self.u, 0), (self.v, 1))):
            walk = Walk(self, member, floor, near[member])
            if self.corner == fixed:
                found = [walk.from_corner(way) for way in (-1, 1)]
            else:
                # On the driver H and its slope are zero there.
                level = (ZERO, ZERO, ZERO) if member == 0 else self.level(start)
                found = [walk.from_touch(place, *level, way) for way in (-1, 1)]
            if None in found:
                return None
            ranges.append(Range(*found, walk.contour.count))
        return ranges

    def is_met(self):
        """Whether the features meet within the width of the seat."""
        i, j = self.pieces
        driver, driven = self.pair.driver, self.pair.driven
        for fixed in (0, 1):
            if self.corner == 1 - fixed:
                continue
            base = self.touch
            place = (self.u, self.v)[fixed]
            if self.corner is None and (fixed == 1 or not abs(place) < 1):
                # The point that stays is the end of its piece.
                end = 1 if place > 0 else -1
                if not abs(place - end) < 1e-4:
                    continue
                if fixed == 0:
                    base = base + (-self.driver.place(driver.at[i](acb(end))))
                else:
                    base = self.driven.place(driven.at[j](acb(end)))
            path = (self.v, self.u)[fixed]
            contour, piece = ((driven, j), (driver, i))[fixed]
            slope = (self.across, -self.along)[fixed]
            size = low(magnitude(contour.first[piece](acb(path))))
            reach = ((REACH + 2 * magnitude(base)) / size).upper()
            hull = acb(interval(low(path) - reach, high(path) + reach))
            bend = magnitude(contour.second[piece](hull))
            off = contour.beyond(piece, path, reach)
            arm = self.driven.turn(driven.at[j](acb(self.v if fixed == 0 else (1 if self.v > 0 else -1))))
            if off is not None and self.crosses(
                base, slope, reach, bend * reach * reach / 2 + off, arm + disc(reach * size)
            ):
                return True
        return False

    def crosses(self, base, slope, reach, off, arm):
        """Miranda's theorem for the vector base + slope s + (turn by beta of the driven gear), s within reach."""
        width = 2 * self.pair.width
        turned = -self.way * width
        error = disc(off)
        further = disc(magnitude(arm) * width * width)
        clear = base + slope * (reach * UNIT) + error
        deep = clear + arm * acb(0, turned) + further
        if not (clear.imag < 0 and deep.imag > 0):
            return False
        turning = arm * acb(0, interval(0, 1) * turned) + further
        before = (base - slope * reach + error + turning).real
        after = (base + slope * reach + error + turning).real
        return (before < 0 and after > 0) or (before > 0 and after < 0)


class Walk:
    """Walk along a contour away from the parabola's point, bounding how far H keeps on the contour's side of a level.

    In the parabola's axes y = x + i f(x) a contour of curvature c and unit tangent e has f'' = c / (Re e)^3, and
    H = f - k x^2. `height` stands for H - floor on the driver and floor - H on the driven gear, `slope` for what it
    gains by the distance walked in x; both are lower bounds. Where x does not run on, H is taken from the place itself.
    """

    def __init__(self, meeting, member, floor, near):
        self.meeting, self.member, self.near = meeting, member, near
        self.sign = (1, -1)[member]
        self.floor = self.sign * floor
        self.contour = (meeting.pair.driver, meeting.pair.driven)[member]
        self.motion = (meeting.driver, meeting.driven)[member]
        self.piece = meeting.pieces[member]

    def over(self, piece, start, stop):
        """Height over a part, its second derivative in x where x runs on, and whether it stays through the play."""
        m = self.meeting
        points, tangents, curvatures = self.contour.hull(piece, start, stop)
        y, curve = self.motion.place(points), None
        run = ZERO if tangents is None else self.motion.turn(tangents).real
        if run != 0:
            curve = self.sign * (curvatures / (run * run * run) - 2 * m.k)
        height = self.sign * m.height(y) - self.floor
        return height, curve, self.member == 0 or self.turns_away(y, points)

    def turns_away(self, y, points):
        """Whether a part of the driven gear stays on its side when turned on in its play."""
        m = self.meeting
        arm, play = self.motion.turn(points), m.box.play
        more = disc(magnitude(arm) * play)
        y, arm = y + more, arm + more
        return m.way * (arm.real + 2 * m.k * y.real * arm.imag) < 0

    def at(self, piece, end, way):
        """x, height and slope at an end of a piece; no slope where x does not run on with the walk."""
        m = self.meeting
        point, first = self.contour.end(piece, end)
        y, first = self.motion.place(point), self.motion.turn(first)
        slope = None
        if self.sign * first.real > 0:
            slope = low(way * (first.imag / first.real - 2 * m.k * y.real))
        return y.real, low(self.sign * m.height(y) - self.floor), slope

    def from_touch(self, place, x, height, slope, way):
        """Last place of the walk from near the parabola's point."""
        outward, height = self.sign * way, height - self.floor
        bound = high(place) if way > 0 else -low(place)
        # The first part is short, for the slope changes its sign there.
        for share in (8, 32, 128):
            end = way * min(1.0, (int(float((bound + 1) * share)) + 1) / share - 1)
            # A little more than that, for floats round.
            start, stop = float(low(place).min(arb(end))) - 1e-9, float(high(place).max(arb(end))) + 1e-9
            if not abs(start) < 2 > abs(stop):
                return None
            _, curve, away = self.over(self.piece, start, stop)
            if curve is not None and curve > 0:
                break
        else:
            return None
        if not (away and height - slope * slope / (2 * curve) > 0):
            return None
        there, level, rate = self.at(self.piece, end, way)
        walked = outward * (there - x)
        rise = low(walked).max(ZERO)
        height = low(height - magnitude(slope) * magnitude(walked) + low(curve) * rise * rise / 2)
        slope = low(outward * slope + curve * walked)
        return self.go(self.piece, end, there, height.max(level), better(slope, rate), way)

    def from_corner(self, way):
        """Last place of the walk from the corner that touches."""
        end, piece = self.meeting.end, self.piece
        if end == way:
            piece = (piece + way) % self.contour.count
        x, height, slope = self.at(piece, -way, way)
        if self.member == 0:
            height = low(-self.floor - 2 * self.contour.gap)
        return self.go(piece, -float(way), x, height, slope, way)

    def go(self, piece, start, x, height, slope, way):
        """Last place of a walk, in pieces from the first one's number on."""
        count = self.contour.count
        turned = piece - self.piece if abs(piece - self.piece) < 2 else way
        for _ in range(len(self.near) + 2):
            length = 2.0
            while start != way:
                # Parts begin and end at multiples of their length: they come again at other angles.
                while (start + 1) % length != 0:
                    length /= 2
                reached = self.part(piece, start, start + way * length, x, height, slope, way)
                if reached is not None:
                    start, (x, height, slope) = start + way * length, reached
                elif length > 2.0 ** (1 - FINE):
                    length /= 2
                else:
                    return self.piece + turned + (start + 1) / 2
            following = (piece + way) % count
            if following not in self.near:
                break
            x, height, slope = self.join(piece, following, height, slope, way)
            if not height > 0:
                break
            piece, start, turned = following, -float(way), turned + way
        return self.piece + turned + (start + 1) / 2

    def part(self, piece, start, end, x, height, slope, way):
        """x, height and slope after a part of a piece, if H keeps on its side all along."""
        value, curve, away = self.over(piece, min(start, end), max(start, end))
        if not away:
            return None
        there, level, rate = self.at(piece, end, way)
        after = gain = least = None
        if curve is not None and slope is not None:
            walked, bend = self.sign * way * (there - x), low(curve)
            after = low(height + slope * walked + bend * walked * walked / 2)
            gain = low(slope + bend * walked)
            least = height if slope >= 0 else height - slope * slope / (2 * bend) if bend > 0 else None
            if not bend > 0:
                least = height.min(after)
        if not (value > 0 or (least is not None and least > 0)):
            return None
        return there, better(after, level), better(gain, rate)

    def join(self, piece, following, height, slope, way):
        """x, height and slope beyond a joint, whose ends miss each other by rounding."""
        m = self.meeting
        (point, first), (next_point, next_first) = self.contour.end(piece, way), self.contour.end(following, -way)
        there, level, rate = self.at(following, -way, way)
        off = magnitude(next_point - point)
        height = low(height - off * (1 + 2 * abs(m.k) * (magnitude(there) + off)))
        if slope is not None:
            runs = [self.sign * self.motion.turn(v).real for v in (first, next_first)]
            # Slopes Im/Re of two vectors differ by their cross product over both real parts.
            bent = magnitude((first.conjugate() * next_first).imag)
            if runs[0] > 0 and runs[1] > 0:
                slope = low(slope - bent / (runs[0] * runs[1]) - 2 * abs(m.k) * off)
            else:
                slope = None
        return there, better(height, level), better(slope, rate)


def better(a, b):
    """The greater of two lower bounds, of which either may be missing."""
    return b if a is None else a if b is None else a.max(b)


class Pair:
    """What the file says of the pair, in balls."""

    def __init__(self, proof):
        if proof["format"] != "centrode-proof" or proof["version"] != 1:
            raise RejectedError("the file is no proof of version 1")
        self.width, self.distance = arb(proof["half_width"]), arb(proof["center_distance"])
        if not (0 < self.width < 1e-3 and self.distance > 0):
            raise RejectedError("the half width or the centre distance means nothing")
        self.driver = Contour(proof["driver"], "driver")
        self.driven = Contour(proof["driven"], "driven gear")
        self.law = Law(proof["law"])
        self.cycle, self.stretches = proof["cycle"], proof["stretches"]
        self.covers()
        self.stand_apart()

    def covers(self):
        """Whether the stretches cover a cycle, after which both gears stand as at its start."""
        turns = round(self.cycle / tau)
        on = turns * arb(self.law.slope) * 2 * arb.pi()
        back = round(float(on.mid()) / tau)
        if not (turns > 0 and magnitude(arb(self.cycle) - turns * 2 * arb.pi()) < 1e-11):
            raise RejectedError(f"a cycle of {self.cycle} rad is no whole number of turns of the driver")
        if not (back != 0 and magnitude(on - back * 2 * arb.pi()) < 1e-11):
            raise RejectedError(f"the driven gear turns by {on} rad in a cycle, which is no whole number of turns")
        at = 0.0
        for stretch in self.stretches:
            if stretch["from"] != at or not stretch["to"] > at:
                raise RejectedError(f"no stretch begins at {at} rad")
            at = stretch["to"]
        if at != self.cycle:
            raise RejectedError(f"the stretches end at {at} rad, the cycle at {self.cycle} rad")

    def stand_apart(self):
        """Whether neither gear lies inside the other at the start: each has a point beyond all of the other's."""
        start = Box(self, self.stretches[0])
        place = start.between.place
        if not any(abs(place(q)) > self.driver.size for q in self.driven.starts):
            raise RejectedError("the driven gear may lie inside the driver")
        axis = place(acb(0))
        if not any(abs(p - axis) > self.driven.size for p in self.driver.starts):
            raise RejectedError("the driver may lie inside the driven gear")


def settle(box, shown, width=None, depth=DEEP):
    """Number of parts of a box over which a claim is shown, none where it is not; longer ones than a width are cut."""
    try:
        if (width is None or box.half < width) and shown(box):
            return 1
    except UndecidedError:
        pass
    if depth == 0:
        return 0
    parts = 0
    for half in box.halves():
        found = settle(half, shown, width, depth - 1)
        if not found:
            return 0
        parts += found
    return parts


def check(numbers):
    """Checks stretches one after the other, in boxes about as long as those of the last that had to be cut."""
    out, width = [], None
    for number in numbers:
        boxes, held, ranges = check_one(number, width)
        if boxes > 2:
            stretch = PAIR.stretches[number]
            width = 0.8 * (stretch["to"] - stretch["from"]) / boxes
        out.append((boxes + held, ranges))
    return out


def check_one(number, width):
    """Checks a stretch; gives the parts it took and the ranges of both seats, less the law, and of the play."""
    stretch = dict(PAIR.stretches[number])
    stretch["ends"] = ends(stretch)
    whole = Box(PAIR, stretch)
    where = f"from {stretch['from']} to {stretch['to']} rad of the driver"
    boxes = settle(whole, Box.is_free, width)
    if not boxes:
        raise RejectedError(f"the gears are not shown to be apart {where}")
    held = 0
    for shown, name in ((Box.is_held_on, "on"), (Box.is_held_back, "back")):
        parts = settle(whole, shown, depth=2 * DEEP)
        if not parts:
            raise RejectedError(f"the driven gear pushed {name} is not shown to be held {where}")
        held += parts
    seats = [whole.along(s) for s in stretch["seats"]]
    width = PAIR.width * UNIT
    ranges = [spread(seats[0]) + width, spread(seats[1]) + width, spread(seats[1] - seats[0]) + 2 * width]
    if not ranges[2] > -4 * PAIR.width:
        raise RejectedError(f"the play is negative {where}")
    return boxes, held, [(float(low(r)), float(high(r))) for r in ranges]


def spread(poly):
    """All values of a polynomial from -1 to 1."""
    parts = [sweep(poly(arb_poly([arb(k) / 16, arb(1) / 16]))) for k in range(-15, 16, 2)]
    return interval(min(low(p) for p in parts), max(high(p) for p in parts))


PAIR = None


def load(path):
    """Reads the file, once in every process."""
    global PAIR

    def refuse(name):
        raise RejectedError(f"the file holds {name}")

    with open(path, encoding="utf-8") as file:
        proof = json.load(file, parse_constant=refuse)
    PAIR = Pair(proof)
    return proof


def run(path, design, workers):
    """Checks a whole file and prints what it shows."""
    proof = load(path)
    if design is not None:
        with open(design, encoding="utf-8", newline="") as file:
            if file.read() != proof["design"]:
                raise RejectedError("the proof is of another design")
    with ProcessPoolExecutor(workers, initializer=load, initargs=(path,)) as pool:
        count = len(PAIR.stretches)
        runs = [range(first, min(first + RUN, count)) for first in range(0, count, RUN)]
        found = [one for run in pool.map(check, runs) for one in run]
    ranges = [(min(r[i][0] for _, r in found), max(r[i][1] for _, r in found)) for i in range(3)]
    turns, width = round(PAIR.cycle / tau), 2 * proof["half_width"]
    print(
        f"proved: the gears hold each other at every angle of {turns} turns of the driver, and keep apart in their play"
    )
    for name, (least, greatest) in zip(("error pushed on", "error pushed back", "play"), ranges, strict=True):
        print(f"{name}: {least:.4e} to {greatest:.4e} rad")
    print(f"each error at every angle within {width:.1e} rad; {count} stretches, {sum(n for n, _ in found)} boxes")


def main():
    """The command."""
    parser = ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("proof", help="file of centrode prove")
    parser.add_argument("design", nargs="?", help="design file that it must be the proof of")
    parser.add_argument("--workers", type=int, help="processes to use, as many as there are cores unless told")
    args = parser.parse_args()
    try:
        run(args.proof, args.design, args.workers)
    except RejectedError as reason:
        print(f"rejected: {reason}")
        return 1
    except (KeyError, TypeError, ValueError, IndexError, ArithmeticError, AttributeError) as reason:
        print(f"rejected: the file is no proof ({type(reason).__name__}: {reason})")
        return 1
    except OSError as reason:
        print(f"error: {reason}")
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
