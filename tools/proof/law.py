"""The law between the gears."""

from itertools import pairwise, zip_longest

from flint import arb, arb_poly
from proof.balls import ZERO, RejectedError, chebyshev, magnitude

#: By how much a box is widened, as a share of it, so that no rounding of its ends leaves a gap.
OVERLAP = arb(1) + arb(1e-9)


class Law:
    """Driven angle by driver angle, in Chebyshev pieces."""

    def __init__(self, law):
        self.ends, self.period = law["ends"], law["period"]
        self.slope = arb(law["advance"]) / arb(self.period)
        self.series = law["pieces"]
        if not all(isinstance(c, (int, float)) for series in self.series for c in series):
            raise RejectedError("a coefficient of the law is no number")
        self.pieces = [chebyshev(c) for c in self.series]
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

    def repeats(self, turns, sectors):
        """Bounds by how much the law less its mean growth differs after a sector of so many turns."""
        if turns % sectors == 0:
            return ZERO
        if len(self.pieces) == 1:
            return 2 * sum((abs(arb(c)) for c in self.series[0][1:]), ZERO)
        count, drift, out = len(self.pieces), ZERO, ZERO
        period, sector = arb(self.period), arb(self.period) * (turns % sectors) / sectors
        shift = min(range(count), key=lambda i: abs(self.ends[i] - float(sector.mid())))
        for i, piece in enumerate(self.series):
            there = self.series[(i + shift) % count]
            for end in (i, i + 1):
                turned = (end + shift) // count
                off = arb(self.ends[(end + shift) % count]) + turned * period - arb(self.ends[end]) - sector
                steep = sum((k * k * abs(arb(c)) for k, c in enumerate(there)), ZERO)
                length = arb(self.ends[i + 1]) - arb(self.ends[i])
                if not magnitude(off) < 1e-3 * length:
                    raise RejectedError("the law's pieces do not come again")
                drift = drift.max(4 * magnitude(off) * steep / length)
            pairs = zip_longest(piece, there, fillvalue=0.0)
            out = out.max(sum((abs(arb(a) - arb(b)) for a, b in pairs), ZERO))
        return out + drift

    def along(self, middle, half):
        """The law over a box of the cycle, a polynomial in t from -1 to 1."""
        turn = int(float(middle.mid()) // self.period)
        x = middle - turn * arb(self.period)
        i = max(j for j, end in enumerate(self.ends[:-1]) if j == 0 or end <= float(x.mid()))
        centre, reach = (arb(self.ends[i]) + arb(self.ends[i + 1])) / 2, (arb(self.ends[i + 1]) - arb(self.ends[i])) / 2
        if not magnitude(x - centre) + half < reach * (OVERLAP + arb(1e-7)):
            raise RejectedError(f"a stretch at {middle} rad lies on two pieces of the law")
        rest = self.pieces[i](arb_poly([(x - centre) / reach, half / reach]))
        return rest + arb_poly([self.slope * middle, self.slope * half])
