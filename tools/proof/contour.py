"""A gear's closed contour, and the discs around its parts."""

from flint import acb, acb_poly, arb
from proof.balls import (
    ZERO,
    RejectedError,
    UndecidedError,
    expand,
    high,
    interval,
    magnitude,
    mirrored,
    real,
    root,
    shifted,
    sweep,
)

#: Distance, mm, up to which pieces of a contour may miss each other at a joint: such a gap counts as closed.
JOINT = arb(1e-9)
#: Greatest number of halvings of a piece whose hull is kept for other angles.
KEPT = 13


def enough(length):
    """Terms that bound a function well over a part of a piece: fewer the shorter it is."""
    return 8 if length > 0.5 else 5 if length > 0.1 else 3


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
        #: No point of it lies farther out, nor one of a piece a little beyond its ends.
        self.size = 1.001 * max(self.part(i, -1.0, 1.0).size for i in range(self.count))
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
                tangents, curvatures = (sweep(f) for f in expand(functions, enough(stop - start)))
                found = sweep(local), tangents, curvatures.real
            except UndecidedError:
                found = sweep(local), None, None
            if (start * 2.0**KEPT).is_integer() and (stop * 2.0**KEPT).is_integer():
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
