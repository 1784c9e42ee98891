"""All points of Jansen's leg: centrode's composed machine next to pylinkage's compiled steps; prints ratios.

    python benches/peers/jansen.py [--rounds 5]

Each round runs both, one after the other, on one core and on arrays in Python; the best of each counts. Both find the
same foot.
"""

import argparse
import math
import time
from pathlib import Path

import centrode as ct
import numpy as np
from pylinkage.actuators import Crank
from pylinkage.components import Ground
from pylinkage.dyads import RRRDyad
from pylinkage.simulation import Linkage

ROOT = Path(__file__).resolve().parents[2]
STEPS = 200_000


def leg(machine):
    """The same leg, each joint begun where it lies at the input zero."""
    places = dict(zip(machine.points, machine.places(0.0), strict=True))

    def tied(one, other, lengths, name):
        return RRRDyad(one, other, *lengths, *places[name])

    o, p = Ground(0.0, 0.0), Ground(-38.0, -7.8)
    crank = Crank(o, 15.0, 2 * math.pi / STEPS)
    knee = tied(crank.output, p, (50.0, 41.5), "upper-rod.B")
    heel = tied(crank.output, p, (61.9, 39.3), "lower-rod.C")
    corner = tied(p, knee, (40.1, 55.8), "thigh.D")
    ankle = tied(corner, heel, (39.4, 36.7), "tie.E")
    foot = tied(heel, ankle, (49.0, 65.7), "shin.foot")
    linkage = Linkage([o, p, crank, knee, heel, corner, ankle, foot])
    linkage.set_input_velocity(crank, 1.0)
    return linkage


def seconds(action):
    begin = time.perf_counter()
    action()
    return time.perf_counter() - begin


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--rounds", type=int, default=5)
    rounds = arguments.parse_args().rounds
    machine = ct.load(ROOT / "tests" / "designs" / "jansen-leg.toml")
    linkage = leg(machine)
    theirs = np.asarray(linkage.step_fast(iterations=STEPS))[:, -1, :]
    phi = 2 * math.pi / STEPS * (np.arange(STEPS) + 1.0)
    error = np.abs(theirs - machine.point("foot", phi)).max()
    print(f"feet apart at most                      {error:10.1e} mm")
    took = {"peer, all joints": [], "centrode, all points": [], "centrode, the foot alone": []}
    for _ in range(rounds):
        took["peer, all joints"].append(seconds(lambda: linkage.step_fast(iterations=STEPS)))
        took["centrode, all points"].append(seconds(lambda: machine.places(phi)))
        took["centrode, the foot alone"].append(seconds(lambda: machine.point("foot", phi)))
    best = {name: min(all_of) / STEPS * 1e9 for name, all_of in took.items()}
    for name, one in best.items():
        print(f"{name:<36} {one:10.1f} ns a position   {best['peer, all joints'] / one:6.2f}")


if __name__ == "__main__":
    main()
