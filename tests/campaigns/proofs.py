"""Plants defects of a micrometre and less in a proof, and counts those that the checker does not find.

    python tests/campaigns/proofs.py pair.proof --defects 1000 --seed 1

Each defect stands where the gears touch. Stretches are checked from there on, to either side, until one is refused,
for that refuses the file; a defect is accepted when all are. Needs what `tools/proof_checker.py` needs. Ends with
status 1 if a defect is accepted.
"""

import copy
import json
import math
import random
import sys
from argparse import ArgumentParser
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "tools"))
import proof_checker


def flank(proof, stretch, rng):
    """Pieces that touch on a stretch, of one gear, by the gear's name."""
    side = rng.randrange(2)
    pieces = stretch["meetings"][stretch["held_by"][side]]["pieces"]
    member = rng.randrange(2)
    return proof[("driver", "driven")[member]], pieces[member]


def bulge(proof, stretch, rng):
    """A flank that stands out by 1 um, or lies 1 um back, smooth at its ends."""
    contour, number = flank(proof, stretch, rng)
    piece = contour[number]
    length = math.hypot(*piece[1])
    out = rng.choice((-1e-3, 1e-3))
    for power, share in ((0, 1), (2, -2), (4, 1)):
        piece[power][0] += share * out * piece[1][1] / length
        piece[power][1] -= share * out * piece[1][0] / length


def shift(proof, stretch, rng):
    """A vertex moved by 1 um."""
    contour, number = flank(proof, stretch, rng)
    angle = rng.uniform(0, math.tau)
    contour[number][0][0] += 1e-3 * math.cos(angle)
    contour[number][0][1] += 1e-3 * math.sin(angle)


def turn(proof, stretch, rng):
    """A whole gear turned by 1 um at its rim."""
    contour = proof[rng.choice(("driver", "driven"))]
    angle = rng.choice((-1, 1)) * 1e-3 / math.hypot(*contour[0][0])
    cos, sin = math.cos(angle), math.sin(angle)
    for piece in contour:
        piece[:] = [[cos * x - sin * y, sin * x + cos * y] for x, y in piece]


def drop(proof, stretch, rng):
    """A piece of a contour left out."""
    contour, number = flank(proof, stretch, rng)
    del contour[number]


def axis(proof, stretch, rng):
    """An axis moved by 1 um."""
    proof["center_distance"] += rng.choice((-1e-3, 1e-3))


def bound(proof, stretch, rng):
    """An interval narrower than rounding."""
    proof["half_width"] = 10 ** rng.uniform(-18, -14)


def seat(proof, stretch, rng):
    """A seat off by 1e-9 rad."""
    stretch["seats"][rng.randrange(2)][0] += rng.choice((-1e-9, 1e-9))


def law(proof, stretch, rng):
    """A law off by 1e-9 rad."""
    for piece in proof["law"]["pieces"]:
        piece[0] += rng.choice((-1e-9, 1e-9))


def gap(proof, stretch, rng):
    """A stretch left out."""
    proof["stretches"].remove(stretch)


def empty(proof, stretch, rng):
    """A part of the file emptied."""
    proof[rng.choice(("driver", "driven", "stretches"))].clear()


KINDS = [bulge, shift, turn, drop, axis, bound, seat, law, gap, empty]


def is_refused(proof, stretch):
    """Whether the checker refuses the file: its stretches from one on to either side."""
    stretches = proof["stretches"]
    try:
        proof_checker.PAIR = proof_checker.Pair(proof)
        here = next((i for i, s in enumerate(stretches) if s is stretch), 0)
        for number in sorted(range(len(stretches)), key=lambda i: abs(i - here)):
            proof_checker.check(number)
    except (proof_checker.RejectedError, KeyError, TypeError, ValueError, IndexError, ArithmeticError):
        return True
    return False


def main():
    parser = ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("proof", type=Path)
    parser.add_argument("--defects", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    args = parser.parse_args()
    whole = json.loads(args.proof.read_text())
    rng = random.Random(args.seed)
    accepted = 0
    for number in range(args.defects):
        proof = copy.deepcopy(whole)
        stretch = rng.choice(proof["stretches"])
        kind = KINDS[number % len(KINDS)]
        kind(proof, stretch, rng)
        if not is_refused(proof, stretch):
            accepted += 1
            print(f"accepted: defect {number}, {kind.__name__}, at {stretch['from']} rad", flush=True)
    print(f"{args.defects} defects, {accepted} accepted")
    return int(accepted > 0)


if __name__ == "__main__":
    sys.exit(main())
