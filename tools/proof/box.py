"""A box in the driver angle, over which both claims are shown."""

from flint import acb, acb_poly, acb_series, arb, arb_poly
from proof import floats
from proof.balls import TERMS, UNIT, ZERO, UndecidedError, chebyshev, magnitude, shifted, sweep
from proof.floats import SHARE
from proof.law import OVERLAP
from proof.meeting import AROUND, Meeting, ends

#: Maximum number of halvings: of a box, of a piece of a contour.
DEEP, FINEST = 18, 14
#: Halvings of a piece before a parabola is tried that is at hand, and one that is not.
FAR = 7, 10
AT_HAND = 2.0 ** -FAR[0]


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
        backlash = seats[1] - seats[0]
        self.backlash = floats.upper(magnitude(sweep(backlash)) + 2 * pair.width)
        clear = [ahead + law + s + e * pair.width for s, e in zip(seats, (1, -1), strict=True)]
        between = ahead + law + (seats[0] + seats[1]) * arb(0.5)
        self.axis = self.turning(ahead, pair.distance)
        self.clear = [self.turning(angle, 1) for angle in clear]
        turns = self.turning(between, 1)
        self.series = [[f[0][k] for k in range(TERMS)] + [f[1][TERMS]] for f in (self.axis, turns)]
        gears = pair.driver, pair.driven
        off = sum(gear.off for gear in gears) + floats.SHARE * pair.driver.size
        self.between = floats.Motion(*self.series, pair.driven.bound, off)
        self.known, self.turned = {}, {}

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
        inside = [c for c in ends(self.stretch) if self.start + margin < c < self.stop - margin]
        cut = min(inside, key=lambda c: abs(c - middle), default=middle)
        return [Box(self.pair, self.stretch, *ends, self.suspects) for ends in ((self.start, cut), (cut, self.stop))]

    def meeting(self, number):
        """Data of the file about features that touch or nearly touch, by number."""
        if number not in self.known:
            self.known[number] = Meeting(self, self.stretch["meetings"][number])
        return self.known[number]

    def near(self):
        """Pieces whose discs and strips are not known to be apart."""
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
        if (a.last - a.first, a.radius) > (b.last - b.first, b.radius):
            return [(part, b) for part in a.parts]
        return [(a, part) for part in b.parts]

    def apart(self, a, b, offset=0.0, half=None):
        """Whether discs or strips of two nodes are apart at every angle of the box and every turn in the backlash."""
        half = self.backlash / 2 if half is None else half
        places = self.turned.get(offset)
        if places is None:
            # A float near e^(i offset): what it lacks is left to the rounding of the motion.
            places = self.turned[offset] = {None: floats.near(acb(0, offset).exp())[0]}
        found = places.get(b)
        if found is None:
            found = places[b] = self.between.reach(b.centre * places[None])
        # Other discs meet this one, too: its place is kept.
        room = abs(found[0] - a.centre) - found[1] - a.radius - b.radius
        swing = b.size * half
        if room > swing:
            return True
        if a.along and b.along and self.is_beside(a, b, found, places[None], swing):
            return True
        if not room > 0 or swing < a.radius + b.radius:
            return False
        # The backlash is wider than the discs: in two parts.
        half /= 2
        return self.apart(a, b, offset + half, half) and self.apart(a, b, offset - half, half)

    def is_beside(self, a, b, place, turn, swing):
        """Whether two parts lie on either side of a strip along one of them."""
        # No direction turns by more over the box than the motion's swing tells.
        along, off = self.between.b * turn * b.along, (place[0] - a.centre).conjugate()
        cross = abs((a.along.conjugate() * along).imag)
        over = a.thick + b.thick + swing + place[1] + self.between.swing * b.radius + SHARE * (a.size + b.size)
        if abs((off * a.along).imag) > over + cross * b.radius:
            return True
        # The middle of a turn is no unit: what is measured along it is longer or shorter by its length.
        return abs((off * along).imag) > over * max(1.0, abs(along)) + cross * a.radius

    def is_free(self):
        """Claim 1: whether no two pieces meet within the backlash."""
        near = self.near()
        pairs = [(int(a.first), int(b.first)) for a, b in near]
        # Those that touch first: a parabola between them parts many others.
        hinted = {tuple(hint["pieces"]) for hint in self.stretch["meetings"]}
        near.sort(key=lambda pair: (int(pair[0].first), int(pair[1].first)) in hinted)
        parted, orders, tried = [], {}, set()
        while near:
            a, b = near.pop()
            if is_parted(parted, a, b) or self.apart(a, b):
                continue
            length = max(a.last - a.first, b.last - b.first)
            # No more parabolas than it takes, and those at hand first: they cost much.
            if length <= AT_HAND and self.tries(a, b, length, pairs, parted, orders, tried):
                continue
            if length <= 2.0**-FINEST:
                return False
            near += self.split(a, b)
        return True

    def tries(self, a, b, length, pairs, parted, orders, tried):
        """Whether a parabola keeps two parts apart, of those not tried yet; all that part anything are noted."""
        pieces = int(a.first), int(b.first)
        if pieces not in orders:
            orders[pieces] = self.order(*pieces)
        for away, *use in orders[pieces]:
            if length > 2.0 ** -FAR[away > AROUND]:
                break
            if tuple(use) not in tried:
                tried.add(tuple(use))
                parted += self.parted(*use, pairs)
                if is_parted(parted[-1:], a, b):
                    return True
        return False

    def order(self, a, b):
        """Parabolas that may part two pieces, by how many pieces away they are, how many bends come first, number."""
        out, contours = [], (self.pair.driver, self.pair.driven)
        for number, hint in enumerate(self.stretch["meetings"]):
            off = [(n - piece) % c.count for n, piece, c in zip((a, b), hint["pieces"], contours, strict=True)]
            away = max(min(d, c.count - d) for d, c in zip(off, contours, strict=True))
            out += [(away, bend, number) for bend in range(len(hint["bends"]) if away <= AROUND else 1)]
        return sorted(out, key=lambda use: (use[0] > AROUND, use[1], use[0], use[2]))

    def parted(self, bend, number, pairs):
        """Ranges of both contours that a parabola keeps apart, if it does."""
        try:
            ranges = self.meeting(number).parted(pairs, bend)
        except UndecidedError:
            return []
        return [ranges] if ranges else []

    def is_held_on(self):
        """Claim 2: whether the contours meet within the width of the seat pushed forward."""
        return self.is_held(0)

    def is_held_back(self):
        """Claim 2: whether the contours meet within the width of the seat pushed back."""
        return self.is_held(1)

    def is_held(self, side):
        """Whether the features that the file names meet within the width of a seat."""
        holder = self.stretch["held_by"][side]
        return self.stretch["meetings"][holder]["side"] == side and self.meeting(holder).is_met()


def is_parted(parted, a, b):
    """Whether one of the parabolas keeps two parts apart."""
    return any(r.holds(a) and q.holds(b) for r, q in parted)


def settle(box, shown, depth=DEEP):
    """Number of parts of a box over which a claim is shown; None if it is not shown."""
    try:
        if shown(box):
            return 1
    except UndecidedError:
        pass
    if depth == 0:
        return 0
    parts = 0
    for half in box.halves():
        found = settle(half, shown, depth - 1)
        if not found:
            return 0
        parts += found
    return parts
