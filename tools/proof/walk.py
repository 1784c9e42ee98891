"""A walk along a contour, away from where it touches."""

from proof.contour import REACH
from proof.floats import SHARE, above, below, better

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
        self.meeting, self.member, self.near, self.k = meeting, member, near, meeting.k
        self.sign = (1, -1)[member]
        self.floor = self.sign * floor
        self.contour = (meeting.pair.driver, meeting.pair.driven)[member]
        self.motion = meeting.motions[member]
        self.piece, self.staying = meeting.pieces[member], {}
        # Turned in its backlash the driven gear reaches as much farther.
        self.slack, self.more = self.contour.slack, meeting.box.backlash * self.contour.bound

    def curve(self, piece, start, stop):
        """Bounds on the second derivative of the height in x over a part; None if x is not monotone there."""
        hull = self.contour.hull(piece, start, stop)
        run = self.motion.run(hull.tangents) if hull.tangents is not None else None
        if run is None:
            return None
        (low, high), (least, most) = hull.curvatures, (abs(run[0] ** 3), abs(run[1] ** 3))
        if (run[0] > 0) != (self.sign > 0):
            low, high = -high, -low
        if run[0] < 0:
            least, most = most, least
        low, high = low / (most if low > 0 else least), high / (least if high > 0 else most)
        bend = 2 * self.k * self.sign
        return below(low, -bend), above(high, -bend)

    def height(self, piece, start, stop):
        """Float below the height over a part."""
        return self.level(*self.motion.place(*self.contour.hull(piece, start, stop).points))

    def level(self, y, across, up):
        """Float below the height of a place and of all within a reach of it."""
        k, far = self.sign * self.k, abs(y.real) + across
        x = far if k > 0 else max(0.0, abs(y.real) - across)
        return below(self.sign * y.imag, -up, -k * x * x, -self.floor, -self.room(far))

    def room(self, far):
        """Change of H within the contour's slack at an x up to so far."""
        return self.slack * (1 + 2 * abs(self.k) * (far + self.more)) * (1 + SHARE)

    def reach(self, *points):
        """Maximum x of points, either way."""
        places = [self.motion.place(point) for point in points]
        return max(abs(y.real) + across for y, across, _ in places)

    def stays(self, piece, start, stop):
        """Whether a part of a gear stays on its side when the driven gear is turned on in its backlash."""
        if self.member == 0:
            return True
        if piece not in self.staying:
            self.staying[piece] = self.turns_away(piece, -1.0, 1.0)
        return self.staying[piece] or self.turns_away(piece, start, stop)

    def turns_away(self, piece, start, stop):
        """Whether a part of the driven gear turns away from the parabola."""
        m, (point, *reach) = self.meeting, self.contour.hull(piece, start, stop).points
        y, across, _ = self.motion.place(point, *reach)
        arm, along, up = self.motion.turn(point, *reach)
        more = m.box.backlash * (abs(arm) + along + up)
        across, along, up = across + more, along + more, up + more
        # H gains arm.real + 2 k y.real arm.imag a radian.
        bend = 2 * self.k
        off = along + abs(bend) * (abs(y.real) * up + across * abs(arm.imag) + across * up)
        return below(-m.way * arm.real, -m.way * bend * y.real * arm.imag, -off) > 0

    def at(self, piece, end, way):
        """Point, height and slope at a place of a piece; no slope where x does not run on with the walk."""
        point, first = self.contour.place(piece, end)
        place = self.motion.place(point)
        return point, self.level(*place), self.slope(piece, first, place, way)

    def slope(self, piece, first, place, way):
        """Float below the slope along a vector at a place; None if x does not run in the direction of the walk."""
        direction, across, up = self.motion.turn(first, self.contour.errors[piece][1])
        run = below(abs(direction.real), -across)
        if not (run > 0 and self.sign * direction.real > 0):
            return None
        y, reach, _ = place
        # Im / Re lies as far from the middle's as Im - (Im / Re of the middle) Re reaches, over Re.
        middle = direction.imag / direction.real
        off = (up + abs(middle) * across) / run
        bend = 2 * self.k * y.real
        return below(way * middle, -off, -way * bend, -2 * abs(self.k) * reach)

    def walked(self, start, stop, way):
        """Minimum and maximum distance in x between two points, on with the walk."""
        middle, reach = self.motion.across(stop - start, 2 * self.contour.off)
        middle *= self.sign * way
        return below(middle, -reach), above(middle, reach)

    def from_touch(self, place, x, height, slope, way):
        """Last place of the walk from near the parabola's point: there are minimum and maximum numbers of each."""
        outward, height = self.sign * way, below(height, -self.floor)
        bound, steep = place[1] if way > 0 else -place[0], max(-slope[0], slope[1])
        # The first part is short, for the slope changes its sign there.
        for share in (8, 32, 128, 512, 2048):
            end = way * min(1.0, (int((bound + 1) * share) + 1) / share - 1)
            # A little more than that, for floats round.
            start, stop = min(place[0], end) - 1e-9, max(place[1], end) + 1e-9
            if not max(-start, stop) < REACH:
                return None
            curve = self.curve(self.piece, start, stop)
            if curve is None:
                continue
            there, level, rate = self.at(self.piece, end, way)
            y, reach, _ = self.motion.place(there)
            nearest, farthest = x if outward > 0 else (-x[1], -x[0])
            walked = below(outward * y.real, -reach, -farthest), above(outward * y.real, reach, -nearest)
            far = max(-walked[0], walked[1])
            fall = -steep * steep / (2 * curve[0]) if curve[0] > 0 else curve[0] * far * far / 2 - steep * far
            room = self.room(self.reach(there) + max(-x[0], x[1])) if self.slack else 0.0
            if below(height, fall, -room) > 0:
                break
        else:
            return None
        if not self.stays(self.piece, start, stop):
            return None
        rise = max(walked[0], 0.0) if curve[0] > 0 else far
        height = below(height, -steep * far, curve[0] * rise * rise / 2)
        slope = below(slope[0] if outward > 0 else -slope[1], min(bend * w for bend in curve for w in walked))
        return self.go(self.piece, end, there, max(height, level), better(slope, rate), way)

    def from_corner(self, way):
        """Last place of the walk from the corner that touches."""
        end, piece = self.meeting.end, self.piece
        if end == way:
            piece = (piece + way) % self.contour.count
        point, height, slope = self.at(piece, -way, way)
        if self.member == 0:
            height = below(-self.floor, -2 * self.contour.miss)
        return self.go(piece, -float(way), point, height, slope, way)

    def go(self, piece, start, point, height, slope, way):
        """Last place of a walk, in pieces from the first one's number on."""
        count = self.contour.count
        turned = piece - self.piece if abs(piece - self.piece) < 2 else way
        # Height and slope have come from part to part; where they do not do, those of the place itself may.
        fresh = None
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
                elif fresh != (piece, start):
                    fresh = piece, start
                    _, level, rate = self.at(piece, start, way)
                    height, slope = max(height, level), better(slope, rate)
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
        return curve is None or curve[0] <= 0 <= curve[1]

    def part(self, piece, start, end, point, height, slope, way):
        """Point, height and slope after a part of a piece, if H keeps on its side all along."""
        ends = min(start, end), max(start, end)
        if not self.stays(piece, *ends):
            return None
        curve = self.curve(piece, *ends) if slope is not None else None
        there = self.contour.place(piece, end)[0]
        after = gain = least = None
        if curve is not None:
            # Of the way itself, for both ends move alike.
            walked, bend = self.walked(point, there, way), curve[0]
            if walked[0] > 0:
                near, far = walked
                after = below(height, min(slope * near, slope * far), min(bend * near * near, bend * far * far) / 2)
                gain = below(slope, min(bend * near, bend * far))
                if slope >= 0 and bend >= 0:
                    least = height
                elif bend > 0:
                    least = below(height, -slope * slope / (2 * bend))
                else:
                    least = min(height, after)
        if least is not None and self.slack:
            least = below(least, -self.room(self.reach(point, there)))
        held = least is not None and least > 0
        if held and after > 0 and gain > 0:
            return there, after, gain
        if not held and not self.height(piece, *ends) > 0:
            return None
        _, level, rate = self.at(piece, end, way)
        return there, better(after, level), better(gain, rate)

    def join(self, piece, following, height, slope, way):
        """Point, height and slope beyond a joint, whose ends miss each other by rounding."""
        contour, k = self.contour, 2 * abs(self.k)
        there, off, bent, vectors = contour.joint(piece, following, way)
        y, reach, _ = self.motion.place(there)
        height = below(height, -off * (1 + k * (abs(y) + 2 * reach + off)))
        if slope is not None:
            # Slopes Im/Re of two vectors differ by their cross product over both real parts.
            runs = [self.motion.across(*vector) for vector in vectors]
            runs = [below(self.sign * middle, -reach) for middle, reach in runs]
            slope = below(slope, -bent / (runs[0] * runs[1]), -k * off) if min(runs) > 0 else None
        if slope is None or not slope > 0:
            _, level, rate = self.at(following, -way, way)
            height, slope = max(height, level), better(slope, rate)
        return there, height, slope
