"""Runs the linkage bench next to pylinkage's compiled steps and scipy's differential evolution; prints ratios.

    python benches/peers/linkage.py [--rounds 3]

Each round runs all of them, one after the other, on one core; the best of each counts.
"""

import argparse
import json
import math
import os
import subprocess
import time
from pathlib import Path

import numpy as np
from pylinkage.actuators import Crank
from pylinkage.components import Ground
from pylinkage.dyads import FixedDyad, RRRDyad
from pylinkage.simulation import Linkage
from scipy.optimize import NonlinearConstraint, differential_evolution

ROOT = Path(__file__).resolve().parents[2]
LENGTHS = (77.0, 147.0, 127.0, 105.0)
BOUNDS = [(77.0, 81.0), (136.0, 147.0), (127.0, 138.0), (100.0, 106.0)]
PIVOT = (100.0, 67.0)
STEPS = 1_000_000
TARGET = math.radians(1e-6)
INPUTS = 1000
"""Positions that one iteration of the bench works out."""


def ours(group):
    """Seconds and what it counts (positions, evaluations) of an iteration of every benchmark of a group, by name."""
    command = ["cargo", "bench", "-p", "centrode-benches", "--", f"linkage/{group}"]
    environment = os.environ | {"RAYON_NUM_THREADS": "1"}
    subprocess.run(command, check=True, cwd=ROOT, env=environment, capture_output=True)
    folder = ROOT / "target" / "criterion" / f"linkage_{group}"
    found = {}
    for path in folder.glob("*/new/estimates.json"):
        about = json.loads(path.with_name("benchmark.json").read_text())
        took = json.loads(path.read_text())["median"]["point_estimate"] * 1e-9
        found[about["function_id"] or path.parents[1].name] = took, about["throughput"]["Elements"]
    return found


def six_bar():
    """The same six-bar: A, D, F, crank, slider C and tip E."""
    a, b, c, d = LENGTHS
    at_a, at_d, at_f = Ground(0.0, 0.0), Ground(d, 0.0), Ground(*PIVOT)
    crank = Crank(at_a, a, 2 * math.pi / 1000)
    joint = RRRDyad(crank.output, at_d, b, c, 150.0, 110.0)
    linkage = Linkage([at_a, at_d, at_f, crank, joint, FixedDyad(at_f, joint, 200.0, 0.0)])
    linkage.set_input_velocity(crank, 1.0)
    return linkage


def seconds(action):
    begin = time.perf_counter()
    action()
    return time.perf_counter() - begin


def swing(lengths):
    """The effector's swing about a pivot inside the slider's circle: between the crank-rocker's dead centres."""
    a, b, c, d = lengths
    directions = []
    for reach in (b + a, b - a):
        x = (reach * reach + d * d - c * c) / (2.0 * d)
        y = math.sqrt(max(reach * reach - x * x, 0.0))
        directions.append(math.atan2(y - PIVOT[1], x - PIVOT[0]))
    return (directions[1] - directions[0]) % (2.0 * math.pi)


def turns(lengths):
    """Above zero for a crank-rocker whose shortest link is the crank."""
    longest = max(lengths[1:])
    return sum(lengths[1:]) - longest - lengths[0] - longest


def searched(seed):
    """Seconds and evaluations of scipy's search, stopped as soon as it is within the target."""

    def enough(intermediate_result):
        return intermediate_result.fun < TARGET

    begin = time.perf_counter()
    found = differential_evolution(
        lambda x: abs(swing(x) - math.pi),
        BOUNDS,
        constraints=NonlinearConstraint(turns, 1e-9, np.inf),
        callback=enough,
        polish=False,
        seed=seed,
        tol=0.0,
        maxiter=10_000,
    )
    assert found.fun < TARGET, found
    return time.perf_counter() - begin, found.nfev


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--rounds", type=int, default=3)
    rounds = arguments.parse_args().rounds
    linkage = six_bar()
    # Compiled before it is measured.
    linkage.step_fast(iterations=10)
    linkage.step_fast_with_kinematics(iterations=10)
    theirs = {"positions": [], "with two derivatives": [], "scipy": []}
    mine: dict[str, list[float]] = {}
    evaluations = {}
    for _ in range(rounds):
        for group in ("position", "search"):
            for name, (took, count) in ours(group).items():
                mine.setdefault(f"{group}/{name}", []).append(took)
                if group == "search":
                    evaluations[name] = count
        theirs["positions"].append(seconds(lambda: linkage.step_fast(iterations=STEPS)) / STEPS)
        theirs["with two derivatives"].append(
            seconds(lambda: linkage.step_fast_with_kinematics(iterations=STEPS)) / STEPS
        )
        took, evaluations["scipy"] = sorted(searched(seed) for seed in range(5))[2]
        theirs["scipy"].append(took)
    for name, took in mine.items():
        each = INPUTS if name.startswith("position") else 1
        print(f"centrode {name:<50} {min(took) / each * 1e9:14.1f} ns")
    for name, took in theirs.items():
        print(f"peer     {name:<50} {min(took) * 1e9:14.1f} ns")
    full = min(mine["position/six-bar, all joints to the jerk"]) / INPUTS
    beside = min(mine["position/six-bar, all joints to the jerk, side by side"]) / INPUTS
    plain = min(mine["position/six-bar, joints alone, side by side"]) / INPUTS
    search = min(mine["search/de"])
    for name, count in evaluations.items():
        print(f"evaluations of {name:<44} {count:14d}")
    positions, kinematics = min(theirs["positions"]), min(theirs["with two derivatives"])
    for name, ratio in (
        ("step_fast / all joints to the jerk, side by side", positions / beside),
        ("step_fast / all joints to the jerk, one by one", positions / full),
        ("step_fast / joints alone, side by side", positions / plain),
        ("with kinematics / all joints to the jerk, side by side", kinematics / beside),
        ("scipy's search / ours", min(theirs["scipy"]) / search),
    ):
        print(f"{name:<55} {ratio:6.2f}")


if __name__ == "__main__":
    main()
