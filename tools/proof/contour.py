"""A gear's closed contour, and the discs and strips around its parts."""

from functools import cached_property
from math import ceil, floor, perm
from operator import mul

from flint import acb, acb_poly, arb
from proof.balls import ZERO, RejectedError, UndecidedError, high, interval, magnitude
from proof.floats import SHARE, above, below, near, upper

#: Distance, as a share of a contour's size, up to which pieces may miss each other at a joint that counts as closed.
JOINT = arb(2e-11)
#: Distance, as a share of a contour's size, up to which its sectors may differ.
SLACK = 2e-9
#: Parts of a piece, of 2, over which functions are bounded one by one, longer ones by all of theirs.
CELLS = 32
#: How far, from a piece's middle, its polynomial is used, and how far with a cell more.
REACH = 1.25
BEYOND = REACH + 2 / CELLS
#: Halvings of parts whose bounds are kept for other angles.
KEPT = 14
#: Factors of the j-th derivative of powers k.
FALLING = [[float(perm(k, j)) for k in range(40)] for j in range(5)]


class Hull:
    """Bounds on a part of a contour: of the points a middle and how far they reach along either axis, of the unit
    tangents a disc, of the curvatures minimum and maximum; no tangents and curvatures where it may stand still."""

    def __init__(self, points, tangents=None, curvatures=None):
        self.points, self.tangents, self.curvatures = points, tangents, curvatures

    def union(self, other):
        """Bounds on two parts."""
        (p, x, y), (q, z, w) = self.points, other.points
        off = (p - q) / 2
        more = SHARE * (abs(p) + abs(q))
        points = (p + q) / 2, abs(off.real) + max(x, z) + more, abs(off.imag) + max(y, w) + more
        if self.tangents is None or other.tangents is None:
            return Hull(points)
        (d, r), (e, s) = self.tangents, other.tangents
        (a, b), (c, f) = self.curvatures, other.curvatures
        return Hull(points, ((d + e) / 2, above(abs(d - e) / 2, max(r, s), SHARE)), (min(a, c), max(b, f)))


class Node:
    """Part of a contour's piece, or a run of pieces: a disc around it, a strip along it, and what it splits into."""

    def __init__(self, first, last, centre, radius, split, along=None, thick=0.0):
        """`along` is a float near a unit vector, `thick` how far the part reaches off the line through the centre."""
        self.first, self.last = first, last
        self.centre, self.radius, self.size = centre, radius, above(abs(centre), radius)
        self.along, self.thick = along, thick
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
        if not all(2 <= len(piece) <= 40 for piece in pieces):
            raise RejectedError(f"the {name}'s contour has a piece of degree 0 or above 39")
        self.name, self.count, self.hulls, self.places, self.joints = name, len(pieces), {}, {}, {}
        self.floats = [[complex(x, y) for x, y in piece] + [0j] * (5 - len(piece)) for piece in pieces]
        # A Taylor coefficient around a place is a sum in at most 40 steps: Horner's scheme, run again and again.
        self.errors = [
            [
                SHARE * sum(perm(k, j) * abs(c) * BEYOND ** (k - j) for k, c in enumerate(piece) if k >= j)
                for j in range(5)
            ]
            for piece in self.floats
        ]
        self.off = max(errors[0] for errors in self.errors)
        self.at = [acb_poly([acb(x, y) for x, y in piece]) for piece in pieces]
        self.first = [p.derivative() for p in self.at]
        self.second = [p.derivative() for p in self.first]
        self.starts = [p(acb(-1)) for p in self.at]
        self.stops = [p(acb(1)) for p in self.at]
        self.slopes = [(d(acb(-1)), d(acb(1))) for d in self.first]
        area, self.gap = ZERO, ZERO
        around = max(sum(map(abs, piece)) for piece in self.floats)
        for i in range(self.count):
            gap = magnitude(self.starts[(i + 1) % self.count] - self.stops[i])
            self.gap = self.gap.max(gap)
            if not gap < JOINT * around:
                raise RejectedError(f"the {name}'s contour is open by {gap} mm after piece {i}")
            conjugate = acb_poly([c.conjugate() for c in self.at[i].coeffs()])
            swept = (conjugate * self.first[i]).integral()
            area += (swept(acb(1)) - swept(acb(-1))).imag
        if not area > 0:
            raise RejectedError(f"the {name}'s contour does not run counter-clockwise")
        #: Floats above the gap at any joint, and above what the contour differs by from itself turned by sectors.
        self.miss, self.slack = upper(self.gap), 0.0
        #: No point of it lies farther out; and a bound for places a little beyond the ends of pieces.
        self.bound = float("inf")
        self.size = 1.001 * max(self.part(i, -1.0, 1.0).size for i in range(self.count))
        self.bound = 2 * self.size

    @cached_property
    def root(self):
        """Node of the whole contour."""
        return self.run(0, self.count)

    def repeats(self, turns, sectors):
        """Bounds by how much the contour differs from itself turned by sectors of so many turns."""
        if self.count * turns % sectors != 0:
            raise RejectedError(f"{self.count} pieces are no {sectors} sectors of {turns} turns")
        for sector in range(1, sectors):
            shift = self.count * turns * sector // sectors
            turn, rounding = near((2 * arb.pi() * arb(turns * sector) / sectors * acb(0, 1)).exp())
            for piece, there in zip(self.floats, self.floats[shift % self.count :] + self.floats, strict=False):
                if len(piece) != len(there):
                    raise RejectedError("sectors have pieces of different degrees")
                size = sum(map(abs, piece))
                off = sum(abs(turn * a - b) for a, b in zip(piece, there, strict=True))
                self.slack = max(self.slack, above(off, (2 * SHARE + rounding) * size))
            if not self.slack < SLACK * self.size:
                raise RejectedError(f"the {self.name}'s contour differs by {self.slack} mm from sector to sector")

    def run(self, first, last):
        """Node of whole pieces."""
        if last - first == 1:
            return self.part(first, -1.0, 1.0)
        middle = (first + last) // 2
        a, b = self.run(first, middle), self.run(middle, last)
        centre = (a.centre + b.centre) / 2
        radius = max(above(abs(n.centre - centre), n.radius, SHARE * n.size) for n in (a, b))
        return Node(first, last, centre, radius, lambda: (a, b))

    def end(self, piece, end):
        """Point and derivative at an end of a piece."""
        return (self.starts[piece], self.slopes[piece][0]) if end == -1 else (self.stops[piece], self.slopes[piece][1])

    def taylor(self, piece, at):
        """Floats of the Taylor coefficients of a piece."""
        out = list(self.floats[piece])
        count = len(out)
        for i in range(count - 1):
            last = out[-1]
            for k in range(count - 2, i - 1, -1):
                last = out[k] = out[k] + at * last
        return out

    def place(self, piece, at):
        """Floats near the point and the derivative at a place within a piece, kept."""
        key = piece, at
        if key not in self.places:
            out = self.taylor(piece, at)
            self.places[key] = out[0], out[1]
        return self.places[key]

    def joint(self, piece, following, way):
        """Point beyond a joint, how far it is from that before it, bound for the cross product of the derivatives,
        and each of them with its error, kept."""
        key = piece, way
        if key not in self.joints:
            (point, first), (next_point, next_first) = self.place(piece, way), self.place(following, -way)
            e, f = self.errors[piece][1], self.errors[following][1]
            bent = abs((first.conjugate() * next_first).imag) + SHARE * abs(first) * abs(next_first)
            bent += 2 * e * (abs(next_first) + e) + 2 * f * (abs(first) + f)
            self.joints[key] = next_point, abs(next_point - point) + 2 * self.off, bent, ((first, e), (next_first, f))
        return self.joints[key]

    def hull(self, piece, start, stop):
        """Bounds on a part of a piece, or a little more than it."""
        if stop - start > 1 / CELLS:
            first, last = floor(start * CELLS), ceil(stop * CELLS)
            key = piece, first, last
            if key not in self.hulls:
                middle = (first + last) // 2 / CELLS
                parts = self.hull(piece, first / CELLS, middle), self.hull(piece, middle, last / CELLS)
                self.hulls[key] = parts[0].union(parts[1])
            return self.hulls[key]
        if not (start * 2.0**KEPT).is_integer() or not (stop * 2.0**KEPT).is_integer():
            return self.cell(piece, start, stop)
        key = piece, start, stop
        if key not in self.hulls:
            self.hulls[key] = self.cell(*key)
        return self.hulls[key]

    def cell(self, piece, start, stop):
        """Bounds on a short part, from the Taylor series around its middle, the part from -1 to 1."""
        series, off = self.scaled(piece, start, stop)
        points = series[0], sum(abs(c.real) for c in series[1:]) + off[0], sum(abs(c.imag) for c in series[1:]) + off[0]
        sizes = [abs(c) for c in series]
        # Of the derivatives: by how much they differ from those in the middle at most, and how large they are.
        rest = [sum(map(mul, FALLING[j][j + 1 :], sizes[j + 1 :])) + off[j] for j in range(5)]
        most = [FALLING[j][j] * sizes[j] + rest[j] for j in range(5)]
        if not most[0] < self.bound:
            raise UndecidedError
        if not rest[1] < 0.7 * sizes[1]:
            return Hull(points)
        # A unit vector's distance from another, where q is the sine of the angle between them, is below q + q^3 / 2.
        q = rest[1] / sizes[1]
        tangents = series[1] / sizes[1], q * (1 + q * q / 2) + SHARE
        # The curvature is Im(conj z' * z") over the cube of |z'|; its numerator's derivative is Im(conj z' * z"').
        back = series[1].conjugate()
        numerator, rate = (back * series[2]).imag * 2, (back * series[3]).imag * 6
        error = off[1] * (most[2] + most[3]) + most[1] * (off[2] + off[3]) + SHARE * most[1] * (most[2] + most[3])
        reach = abs(rate) + (most[2] * most[3] + most[1] * most[4]) / 2 + error
        slow, fast = (sizes[1] - rest[1]) ** 3, most[1] ** 3
        low, high = below(numerator, -reach), above(numerator, reach)
        low, high = low / (fast if low > 0 else slow), high / (slow if high > 0 else fast)
        return Hull(points, tangents, (below(low), above(high)))

    def scaled(self, piece, start, stop):
        """Taylor coefficients of a part, which goes from -1 to 1, and how far derivatives of floats of it are off."""
        if not max(-start, stop) < BEYOND:
            raise UndecidedError
        half, power, out = (stop - start) / 2, 1.0, self.taylor(piece, (start + stop) / 2)
        for k in range(1, len(out)):
            power *= half
            out[k] *= power
        return out, [error * half**j for j, error in enumerate(self.errors[piece])]

    def beyond(self, piece, place, reach):
        """How far the contour leaves a piece's continuation within a reach of a place; None if it is far."""
        # A place known only roughly may reach beyond both ends.
        both = [self.past(piece, place, reach, end) for end in (-1, 1)]
        return None if None in both else both[0].max(both[1])

    def past(self, piece, place, reach, end):
        """How far the contour leaves a piece's continuation over one end of it."""
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
        middle = (start + stop) / 2
        series, off = self.scaled(piece, start, stop)

        def split():
            return self.part(piece, start, middle), self.part(piece, middle, stop)

        ends, more = (piece + (start + 1) / 2, piece + (stop + 1) / 2), (off[0], self.miss, self.slack)
        radius, speed = above(sum(map(abs, series[1:])), *more), abs(series[1])
        if not speed > SHARE * radius:
            return Node(*ends, series[0], radius, split)
        along = series[1] / speed
        thick = above(sum(abs((along.conjugate() * c).imag) for c in series[2:]), *more, SHARE * radius)
        return Node(*ends, series[0], radius, split, along, thick)


class Range:
    """Places of a contour from one to another, on round and round it."""

    def __init__(self, start, stop, count):
        self.start, self.stop, self.count = start, stop, count

    def holds(self, node):
        """Whether a part of the contour lies in it."""
        first, last = node.first, node.last
        if first < self.start:
            first, last = first + self.count, last + self.count
        elif last > self.stop:
            first, last = first - self.count, last - self.count
        return self.start <= first and last <= self.stop
