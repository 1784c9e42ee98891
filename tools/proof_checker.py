#!/usr/bin/env python3
"""Checks a proof of `centrode prove`: that its two contours hold each other at every driver angle, and never overlap.

    proof_checker.py pair.proof [pair.toml]

Needs python-flint alone; shares no code with centrode. All numbers are balls: a midpoint and a radius that holds every
error of rounding. The file gives the contours, the law and hints (where the gears touch, and a parabola between them);
a wrong hint fails the check, it cannot pass it.

The driver stands in its own axes. At the driver angle phi the driven gear, turned by psi, has its point q at

    X = a e^(i phi) + e^(i (phi + psi)) q.

Its seat `on` is the minimum psi of its backlash, `back` the maximum. With w the half width, for every phi of the cycle:

 1. Neither contour meets the other at any psi from on + w to back - w. Two pieces are apart by the discs around them,
    by a strip along one of them, or by a parabola H(X) = Im y - k (Re y)^2 = 0, y = conj(T) (X - c), through a point c
    of a contour along its unit tangent T: the driver keeps H above a number, the driven gear below it. A walk along a
    contour, away from c, bounds H by its slope and its second derivative. As dH/dpsi has one sign, the driven gear
    stays below when it is turned.
 2. Within w of either seat the contours meet: two components of the vector from a point of one to the other change
    their signs over opposite sides of a rectangle in (place along the contour, psi), so both vanish in it (Miranda).

Both seats go on from stretch to stretch and at the end of the cycle as at its start, within 2 w.

So each seat lies within w of its series in the file. The transmission error is the seat less the law in the file. At
each angle it lies in an interval 2 w wide.
Where there is no backlash, nothing lies between on + w and back - w; then 1 says that the flanks of either side are
apart when the driven gear is turned by w off its seat on that side: they overlap by no more than w times the radius.

Where contours and law come again in equal sectors of the cycle, a sector is checked: the contours of the others lie
within `slack` of those of the first, turned, and every bound keeps so much more.

Every key of the file is checked, but for `pair`, a label, `law.breaks`, which nothing uses, and `design`, which is
compared with the design file if one is given. A file with another key is rejected.

Not shown: that the contours are those of the design, that neither crosses itself, and that the law in the file is the
design's law. Joints closed but for rounding count as closed.
"""

import json
import sys
from argparse import ArgumentParser
from concurrent.futures import ProcessPoolExecutor
from math import isfinite, tau

from flint import acb, arb, arb_poly
from proof.balls import (
    UNIT,
    Motion,
    RejectedError,
    UndecidedError,
    high,
    interval,
    low,
    magnitude,
    sweep,
)
from proof.box import Box, settle
from proof.contour import Contour
from proof.law import Law

#: Keys of a file. A file with another key is rejected, because nothing checks it.
KEYS = {
    *("format", "version", "design", "pair", "center_distance", "cycle", "law", "half_width"),
    *("driver", "driven", "sectors", "stretches"),
}
#: Stretches checked in one go.
RUN = 16
#: Half length of the shortest piece over which a polynomial is looked at, of a stretch from -1 to 1.
FINEST = 2.0**-12


class Pair:
    """Data of the pair from the file, in balls."""

    def __init__(self, proof):
        if proof["format"] != "centrode-proof" or proof["version"] != 3:
            raise RejectedError("the file is no proof of version 3: write it again with centrode prove")
        if unknown := sorted(set(proof) - KEYS):
            raise RejectedError(f"the file has the key {unknown[0]!r}, which nothing checks")
        self.width, self.distance = arb(proof["half_width"]), arb(proof["center_distance"])
        if not (0 < self.width < 1e-3 and self.distance > 0):
            raise RejectedError("the half width or the centre distance means nothing")
        self.driver = Contour(proof["driver"], "driver")
        self.driven = Contour(proof["driven"], "driven gear")
        self.law = Law(proof["law"])
        self.cycle, self.sectors, self.stretches = proof["cycle"], proof["sectors"], proof["stretches"]
        self.covers()
        self.stand_apart()

    def covers(self):
        """Whether the stretches cover a sector of a cycle, after which both gears stand as at its start."""
        turns = round(self.cycle / tau)
        on = turns * arb(self.law.slope) * 2 * arb.pi()
        back = round(float(on.mid()) / tau)
        if not (turns > 0 and magnitude(arb(self.cycle) - turns * 2 * arb.pi()) < 1e-11):
            raise RejectedError(f"a cycle of {self.cycle} rad is no whole number of turns of the driver")
        if not (back != 0 and magnitude(on - back * 2 * arb.pi()) < 1e-11):
            raise RejectedError(f"the driven gear turns by {on} rad in a cycle, which is no whole number of turns")
        self.repeats(turns, back)
        at = 0.0
        for stretch in self.stretches:
            if stretch["from"] != at or not stretch["to"] > at:
                raise RejectedError(f"no stretch begins at {at} rad")
            at = stretch["to"]
        end = self.cycle / self.sectors
        if at != end:
            raise RejectedError(f"the stretches end at {at} rad, the part of the cycle at {end} rad")
        self.go_on()

    def go_on(self):
        """Whether both seats go on from stretch to stretch, and at the end as at the start."""
        for one, other in zip(self.stretches, self.stretches[1:] + self.stretches[:1], strict=True):
            for before, after in zip(one["seats"], other["seats"], strict=True):
                # At either end the polynomials of the series are 1, or 1 and -1 in turn.
                jump = sum(map(arb, before)) - sum(arb(-c if k % 2 else c) for k, c in enumerate(after))
                if not magnitude(jump) < 2 * self.width + self.off:
                    raise RejectedError(f"a seat jumps at {one['to']} rad")

    def repeats(self, turns, back):
        """Bounds by how much contours and law differ from sector to sector."""
        self.off = arb(0)
        if self.sectors == 1:
            return
        if not (isinstance(self.sectors, int) and self.sectors > 1):
            raise RejectedError(f"a cycle has no {self.sectors} parts")
        self.driver.repeats(turns, self.sectors)
        self.driven.repeats(back, self.sectors)
        self.off = self.sectors * self.law.repeats(turns, self.sectors)
        if not self.off < 1e-11:
            raise RejectedError("the law is another from part to part of the cycle")

    def stand_apart(self):
        """Whether neither gear lies inside the other at the start: each has a point beyond all of the other's."""
        start = Box(self, self.stretches[0])
        place = Motion(*start.series, self.driven.bound).place
        if not any(abs(place(q)) > self.driver.size for q in self.driven.starts):
            raise RejectedError("the driven gear may lie inside the driver")
        axis = place(acb(0))
        if not any(abs(p - axis) > self.driven.size for p in self.driver.starts):
            raise RejectedError("the driver may lie inside the driven gear")


def check(number):
    """Checks a stretch; gives the parts it took and the ranges of both seats, less the law, and of the backlash."""
    stretch = PAIR.stretches[number]
    whole = Box(PAIR, stretch)
    where = f"from {stretch['from']} to {stretch['to']} rad of the driver"
    boxes = 0
    # That which takes least first.
    claims = (
        (Box.is_held_on, "the driven gear pushed forward is not shown to be held"),
        (Box.is_held_back, "the driven gear pushed back is not shown to be held"),
        (Box.is_free, "the gears are not shown to be apart"),
    )
    for shown, refusal in claims:
        parts = settle(whole, shown)
        if not parts:
            raise RejectedError(f"{refusal} {where}")
        boxes += parts
    seats = [whole.along(s) for s in stretch["seats"]]
    width = (PAIR.width + PAIR.off) * UNIT
    ranges = [spread(seats[0]) + width, spread(seats[1]) + width, spread(seats[1] - seats[0]) + 2 * width]
    if not ranges[2] > -4 * PAIR.width:
        raise RejectedError(f"the backlash is negative {where}")
    return boxes, [(float(low(r)), float(high(r))) for r in ranges]


def spread(poly):
    """All values of a polynomial from -1 to 1, hardly more than it takes."""
    ends = [poly(arb(x)) for x in (-1, 0, 1)]
    least, most = min(low(y) for y in ends), max(high(y) for y in ends)
    few = PAIR.width / 16
    found, pieces = interval(least, most), [(arb(0), arb(1))]
    while pieces:
        middle, half = pieces.pop()
        values = sweep(poly(arb_poly([middle, half])))
        if half > FINEST and not (values > least - few and values < most + few):
            pieces += [(middle - half / 2, half / 2), (middle + half / 2, half / 2)]
        else:
            found = found.union(values)
    return found


PAIR = None


def load(path):
    """Reads the file, once in every process."""
    global PAIR

    def refuse(name):
        raise RejectedError(f"the file holds {name}")

    def finite(text):
        return float(text) if isfinite(float(text)) else refuse(text)

    with open(path, encoding="utf-8") as file:
        proof = json.load(file, parse_constant=refuse, parse_float=finite)
    PAIR = Pair(proof)
    return proof


def told(found, stretches):
    """Passes what was found on, and tells the share of the cycle that is done."""
    last = None
    for stretch, one in zip(stretches, found, strict=True):
        share = int(100 * stretch["to"] / stretches[-1]["to"])
        if share != last:
            print(f"\r{share} % of the cycle", end="", file=sys.stderr, flush=True)
            last = share
        yield one
    print(file=sys.stderr)


def run(path, design, workers, tells):
    """Checks a whole file and prints what it shows."""
    proof = load(path)
    if design is not None:
        with open(design, encoding="utf-8", newline="") as file:
            if file.read() != proof["design"]:
                raise RejectedError("the proof is of another design")
    with ProcessPoolExecutor(workers, initializer=load, initargs=(path,)) as pool:
        count = len(PAIR.stretches)
        found = pool.map(check, range(count), chunksize=RUN)
        found = list(told(found, PAIR.stretches) if tells else found)
    ranges = [(min(r[i][0] for _, r in found), max(r[i][1] for _, r in found)) for i in range(3)]
    turns, width = round(PAIR.cycle / tau), 2 * proof["half_width"]
    cycle = "one turn" if turns == 1 else f"{turns} turns"
    print(f"proved: the contours in the file hold each other at every angle of {cycle} of the driver,")
    print("and keep apart within their backlash; errors are relative to the law in the file")
    for name, (least, greatest) in zip(("error pushed forward", "error pushed back", "backlash"), ranges, strict=True):
        print(f"{name}: {least:.4e} to {greatest:.4e} rad")
    print(f"each error at every angle within {width:.1e} rad; {count} stretches, {sum(n for n, _ in found)} boxes")


def main():
    """The command."""
    parser = ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("proof", help="file of centrode prove")
    parser.add_argument("design", nargs="?", help="design file that it must be the proof of")
    parser.add_argument("--workers", type=int, help="processes to use, as many as there are cores unless told")
    parser.add_argument("--progress", action="store_true", help="tell the share that is done, as on a terminal")
    args = parser.parse_args()
    try:
        run(args.proof, args.design, args.workers, args.progress or sys.stderr.isatty())
    except RejectedError as reason:
        print(f"rejected: {reason}")
        return 1
    except UndecidedError:
        print("rejected: the numbers of the file are too far apart to decide")
        return 1
    except (LookupError, TypeError, ValueError, ArithmeticError, AttributeError, RecursionError) as reason:
        print(f"rejected: the file is no proof ({type(reason).__name__}: {reason})")
        return 1
    except OSError as reason:
        print(f"error: {reason}")
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
