"""Two features that touch or nearly do, as a hint of the file names them, and what is shown around them."""

from functools import cached_property

from flint import acb, acb_poly, arb
from proof import floats
from proof.balls import (
    UNIT,
    ZERO,
    Motion,
    RejectedError,
    disc,
    expand,
    high,
    interval,
    low,
    magnitude,
    mirrored,
    root,
    shifted,
    sweep,
    through,
)
from proof.contour import Range
from proof.walk import Walk

#: Pieces beyond those that touch whose neighbours a parabola has to part.
AROUND = 4
#: Half of the rectangle's side along the contour, as a share of the driver's size, and where a piece slows down.
SIDES = arb(4e-8), arb(4e-9)


class Meeting:
    """Two features of the contours that touch or nearly do, and the parabola between them."""

    def __init__(self, box, hint):
        self.box, self.pair = box, box.pair
        self.side = hint["side"]
        self.way = (1, -1)[self.side]
        self.pieces = hint["pieces"]
        self.corner = hint.get("corner")
        if not (is_one_of(self.side, (0, 1)) and (self.corner is None or is_one_of(self.corner, (0, 1)))):
            raise RejectedError(f"a meeting is on side {self.side} with the corner of {self.corner}")
        counts = self.pair.driver.count, self.pair.driven.count
        if not all(is_one_of(*named) for named in zip(self.pieces, map(range, counts), strict=True)):
            raise RejectedError(f"a meeting is of pieces {self.pieces}, which are none of the contours'")
        self.bends = [float(k) for k in hint["bends"]]
        self.k = self.bends[0]
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

        *self.series, touch, along, across, u, v = expand(functions)
        self.touch, self.along, self.across = sweep(touch), sweep(along), sweep(across)
        self.u, self.v = sweep(u).real, sweep(v).real

    @cached_property
    def motions(self):
        """How the driver's points move in the parabola's axes, and the driven gear's."""
        gears = self.pair.driver, self.pair.driven
        return [floats.Motion(*self.series[2 * i : 2 * i + 2], gear.bound, gear.off) for i, gear in enumerate(gears)]

    def height(self, y):
        """H of a point in the parabola's axes."""
        return y.imag - self.k * y.real * y.real

    def level(self, height):
        """x, height and slope of the driven gear where it touches, on its own side of the parabola."""
        x = self.touch.real
        slope = -(self.across.imag / self.across.real - 2 * self.k * x)
        return floats.ends(x), floats.ends(-height)[0], floats.ends(slope)

    def parted(self, pairs, bend=0):
        """Ranges of both contours that a parabola keeps apart, among pairs of pieces; None if it does not."""
        self.k = self.bends[bend]
        start = self.height(self.touch)
        if not start < 0:
            return None
        floor = floats.ends(start)[1] / 2
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
                level = ((0.0, 0.0), 0.0, (0.0, 0.0)) if member == 0 else self.level(start)
                found = [walk.from_touch(floats.ends(place), *level, way) for way in (-1, 1)]
            if None in found:
                return None
            ranges.append(Range(*found, walk.contour.count))
        return ranges

    def is_met(self):
        """Whether the features meet within the width of the seat."""
        i, j = self.pieces
        driver, driven = self.pair.driver, self.pair.driven
        slack = arb(driver.slack + driven.slack)
        moved = [Motion(*self.series[2 * k : 2 * k + 2], gear.bound) for k, gear in enumerate((driver, driven))]
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
                    base = base + (-moved[0].place(driver.at[i](acb(end))))
                else:
                    base = moved[1].place(driven.at[j](acb(end)))
            path = (self.v, self.u)[fixed]
            contour, piece = ((driven, j), (driver, i))[fixed]
            slope = (self.across, -self.along)[fixed]
            size = low(magnitude(contour.first[piece](acb(path))))
            still = driven.at[j](acb(self.v if fixed == 0 else (1 if self.v > 0 else -1)))
            arm = moved[1].turn(still) + disc(slack)
            for share in SIDES:
                side = share * driver.size
                reach = ((side + 2 * magnitude(base)) / size).upper()
                hull = acb(interval(low(path) - reach, high(path) + reach))
                bend = magnitude(contour.second[piece](hull))
                off = contour.beyond(piece, path, reach)
                if off is None:
                    continue
                off = bend * reach * reach / 2 + off + slack
                if self.crosses(base, slope, reach, off, arm + disc(reach * size)):
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


def is_one_of(number, numbers):
    """Whether a number is whole and one of some."""
    return type(number) is int and number in numbers


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
