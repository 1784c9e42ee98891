"""A walk along a contour, away from where it touches."""

from flint import arb
from proof.balls import ZERO, better, disc, high, low, magnitude

#: Length of the shortest parts of a walk.
SHORTEST = 2.0**-4
#: Length of the shortest near a joint, where a contour may bend towards the other at once, and how far near is.
NEXT, NEAR = 2.0**-12, 4 * SHORTEST


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
        self.piece, self.staying = meeting.pieces[member], {}

    def curve(self, piece, start, stop):
        """Second derivative of the height in x over a part; none where x does not run on."""
        _, tangents, curvatures = self.contour.hull(piece, start, stop)
        run = ZERO if tangents is None else self.motion.turn(tangents).real
        return self.sign * (curvatures / (run * run * run) - 2 * self.meeting.k) if run != 0 else None

    def height(self, piece, start, stop):
        """Height over a part."""
        points = self.contour.hull(piece, start, stop)[0]
        return self.sign * self.meeting.height(self.motion.place(points)) - self.floor

    def stays(self, piece, start, stop):
        """Whether a part of a gear stays on its side when the driven gear is turned on in its play."""
        if self.member == 0:
            return True
        if piece not in self.staying:
            self.staying[piece] = self.turns_away(piece, -1.0, 1.0)
        return self.staying[piece] or self.turns_away(piece, start, stop)

    def turns_away(self, piece, start, stop):
        """Whether a part of the driven gear turns away from the parabola."""
        m, points = self.meeting, self.contour.hull(piece, start, stop)[0]
        arm = self.motion.turn(points)
        more = disc(magnitude(arm) * m.box.play)
        y, arm = self.motion.place(points) + more, arm + more
        return m.way * (arm.real + 2 * m.k * y.real * arm.imag) < 0

    def at(self, piece, end, way):
        """Point, height and slope at an end of a piece; no slope where x does not run on with the walk."""
        m = self.meeting
        point, first = self.contour.end(piece, end)
        y, first = self.motion.place(point), self.motion.turn(first)
        slope = None
        if self.sign * first.real > 0:
            slope = low(way * (first.imag / first.real - 2 * m.k * y.real))
        return point, low(self.sign * m.height(y) - self.floor), slope

    def from_touch(self, place, x, height, slope, way):
        """Last place of the walk from near the parabola's point."""
        outward, height = self.sign * way, height - self.floor
        bound = high(place) if way > 0 else -low(place)
        # The first part is short, for the slope changes its sign there.
        for share in (8, 32, 128, 512, 2048):
            end = way * min(1.0, (int(float((bound + 1) * share)) + 1) / share - 1)
            # A little more than that, for floats round.
            start, stop = float(low(place).min(arb(end))) - 1e-9, float(high(place).max(arb(end))) + 1e-9
            if not abs(start) < 2 > abs(stop):
                return None
            curve = self.curve(self.piece, start, stop)
            if curve is not None and curve > 0:
                break
        else:
            return None
        if not (self.stays(self.piece, start, stop) and height - slope * slope / (2 * curve) > 0):
            return None
        there, level, rate = self.at(self.piece, end, way)
        walked = outward * (self.motion.place(there).real - x)
        rise = low(walked).max(ZERO)
        height = low(height - magnitude(slope) * magnitude(walked) + low(curve) * rise * rise / 2)
        slope = low(outward * slope + curve * walked)
        return self.go(self.piece, end, there, height.max(level), better(slope, rate), way)

    def from_corner(self, way):
        """Last place of the walk from the corner that touches."""
        end, piece = self.meeting.end, self.piece
        if end == way:
            piece = (piece + way) % self.contour.count
        point, height, slope = self.at(piece, -way, way)
        if self.member == 0:
            height = low(-self.floor - 2 * self.contour.gap)
        return self.go(piece, -float(way), point, height, slope, way)

    def go(self, piece, start, point, height, slope, way):
        """Last place of a walk, in pieces from the first one's number on."""
        count = self.contour.count
        turned = piece - self.piece if abs(piece - self.piece) < 2 else way
        for _ in range(len(self.near) + 2):
            length = 2.0
            while start != way:
                # Parts begin and end at multiples of their length: they come again at other angles.
                while (start + 1) % length != 0:
                    length /= 2
                reached = self.part(piece, start, start + way * length, point, height, slope, way)
                if reached is not None:
                    start, (point, height, slope) = start + way * length, reached
                    length = 2 * length
                elif length > SHORTEST or (length > NEXT and self.is_sharp(piece, start, start + way * length, way)):
                    length /= 2
                else:
                    return self.piece + turned + (start + 1) / 2
            following = (piece + way) % count
            if following not in self.near:
                break
            point, height, slope = self.join(piece, following, height, slope, way)
            if not height > 0:
                break
            piece, start, turned = following, -float(way), turned + way
        return self.piece + turned + (start + 1) / 2

    def is_sharp(self, piece, start, end, way):
        """Whether shorter parts than the shortest may tell more: near a joint, and where the contour turns too much."""
        if abs(start + way) < NEAR:
            return True
        curve = self.curve(piece, min(start, end), max(start, end))
        return curve is None or curve.contains(0)

    def part(self, piece, start, end, point, height, slope, way):
        """Point, height and slope after a part of a piece, if H keeps on its side all along."""
        ends = min(start, end), max(start, end)
        if not self.stays(piece, *ends):
            return None
        curve = self.curve(piece, *ends)
        there, level, rate = self.at(piece, end, way)
        after = gain = least = None
        if curve is not None and slope is not None:
            # Of the way itself, for both ends move alike.
            walked, bend = self.sign * way * self.motion.turn(there - point).real, low(curve)
            after = low(height + slope * walked + bend * walked * walked / 2)
            gain = low(slope + bend * walked)
            least = height if slope >= 0 else height - slope * slope / (2 * bend) if bend > 0 else None
            if not bend > 0:
                least = height.min(after)
        if not ((least is not None and least > 0) or self.height(piece, *ends) > 0):
            return None
        return there, better(after, level), better(gain, rate)

    def join(self, piece, following, height, slope, way):
        """Point, height and slope beyond a joint, whose ends miss each other by rounding."""
        m = self.meeting
        (point, first), (next_point, next_first) = self.contour.end(piece, way), self.contour.end(following, -way)
        there, level, rate = self.at(following, -way, way)
        off = magnitude(next_point - point)
        height = low(height - off * (1 + 2 * abs(m.k) * (magnitude(self.motion.place(there)) + off)))
        if slope is not None:
            runs = [self.sign * self.motion.turn(v).real for v in (first, next_first)]
            # Slopes Im/Re of two vectors differ by their cross product over both real parts.
            bent = magnitude((first.conjugate() * next_first).imag)
            if runs[0] > 0 and runs[1] > 0:
                slope = low(slope - bent / (runs[0] * runs[1]) - 2 * abs(m.k) * off)
            else:
                slope = None
        return there, better(height, level), better(slope, rate)
