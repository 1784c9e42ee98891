"""Searches from random starts in every family: a design that reaches its goals must pass its check.

python tests/campaigns/searches.py --starts 200
"""

import argparse
import random
import time
from collections import Counter
from pathlib import Path
from typing import NamedTuple

import centrode as ct


class Family(NamedTuple):
    """A design file with goals, the numbers that a start changes by their ranges, and the evaluations of a search."""

    text: str
    starts: dict[str, tuple[float, float]]
    evaluations: int


PAIR = """family = "gear-pair"
[pitch]
kind = "ellipse"
eccentricity = @e
module = @m
tooth_count = 31
[goals.fastest]
figure = "ratio_max"
between = [@low, @high]
[goals.size]
figure = "center_distance"
maximum = 70
[goals.contact]
figure = "contact_ratio_mean"
minimum = @contact
[vary]
"pitch.eccentricity" = [0, 0.5]
"pitch.module" = [1, 3]
"""
SHAFT = """family = "spiral-shaft"
radius = @radius
slider = { length = 42, clearance = 1 }
law = { kind = "sine", amplitude = @amplitude }
[goals.moves]
figure = "moved_distance"
maximum = @moves
[goals.pressure]
figure = "pressure_angle_max"
maximum = @pressure
[vary]
"law.amplitude" = [0, 1.6]
radius = [10, 30]
"""
BOX = """family = "moving-box"
scheme = "elliptic-gear"
gears = { eccentricity = @e }
[shaft.slider]
length = 42
clearance = 1
[goals.moves]
figure = "box_moved_distance"
maximum = @moves
[vary]
"gears.eccentricity" = [0, 0.5]
"""
MACHINE = """family = "machine"
[frame.points]
O = [0, 0]
D = [105, 0]
[bodies.crank]
on = "frame.O"
law = { ratio = 1 }
points = { B = [@crank, 0] }
[dyads.four-bar]
type = "RRR"
from = "crank.B"
to = "frame.D"
lengths = [@coupler, 127]
side = "left"
bodies = ["coupler", "rocker"]
joint = "C"
[goals.swing]
figure = "rocker.swing"
over = "span"
between = [@low, @high]
[goals.holds]
figure = "transmission(four-bar)"
over = "minimum"
minimum = @angle
[vary]
"bodies.crank.points.B[0]" = [20, 80]
"dyads.four-bar.lengths[0]" = [100, 180]
"""
DESIGNS = Path(__file__).parents[1] / "designs"
ARMS = (DESIGNS / "three-arm-all-goals.toml").read_text(encoding="utf-8")
ARMS = ARMS.replace("radius = [32.96,", "radius = [@r1,").replace("bend_deg = -50.861", "bend_deg = @bend")
ARMS = ARMS.replace("tip_distance = 146.04", "tip_distance = @tip")
FEEDER = """family = "feeder"
[linkage]
crank = @crank
coupler = @coupler
rocker = @rocker
frame = 120
pivot = [84, 64]
effector_length = 200
[goals]
transmission_angle_deg = @angle
[optimise]
free_pivot = true
pivot_weight_deg = 0.01
[figure_goals.rate]
figure = "feed_rate"
minimum = 50
"""

FAMILIES = {
    "gear-pair": Family(
        PAIR,
        {"e": (0.01, 0.49), "m": (1, 3), "low": (1.3, 2.2), "contact": (1, 1.6)},
        300,
    ),
    "spiral-shaft": Family(
        SHAFT,
        {"radius": (10, 30), "amplitude": (0, 1.6), "moves": (1.8, 3.2), "pressure": (12, 30)},
        300,
    ),
    "moving-box": Family(BOX, {"e": (0, 0.5), "moves": (1, 3)}, 300),
    "machine": Family(
        MACHINE,
        {"crank": (20, 80), "coupler": (100, 180), "low": (30, 70), "angle": (10, 40)},
        2000,
    ),
    "three-arm": Family(ARMS, {"r1": (30, 36), "bend": (-53, -49), "tip": (142, 150)}, 600),
    "feeder": Family(
        FEEDER,
        {"crank": (59, 70), "coupler": (105, 150), "rocker": (98, 130), "angle": (5, 20)},
        4000,
    ),
}


def start(family: str, chance: random.Random) -> str:
    """A design file with random numbers within the ranges of its family."""
    text, starts, _ = FAMILIES[family]
    values = {name: round(chance.uniform(*ends), 3) for name, ends in starts.items()}
    if "low" in values:
        values["high"] = round(values["low"] + 0.05, 3)
    for name, value in values.items():
        text = text.replace(f"@{name}", str(value))
    return text


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--starts", type=int, default=200, help="random starts of each family")
    parser.add_argument("--seed", type=int, default=2031)
    parser.add_argument("--families", nargs="+", default=list(FAMILIES), choices=list(FAMILIES))
    options = parser.parse_args()
    wrong = 0
    for family in options.families:
        chance = random.Random(f"{options.seed} {family}")
        begun, count = time.monotonic(), Counter[str]()
        for number in range(options.starts):
            method = chance.choice(["guided", "cma-es", "de", "ga"])
            text, evaluations = start(family, chance), FAMILIES[family].evaluations
            try:
                found = ct.Mechanism.from_toml(text).optimise(method, seed=number, evaluations=evaluations)
            except ct.Error:
                count["no machine"] += 1
                continue
            count["reached" if found.reached else "not reached"] += 1
            if found.reached and not found.mechanism.check().ok:
                wrong += 1
                print(f"{family}, {method}, seed {number}: reached, but the check fails\n{text}", flush=True)
        words = ", ".join(f"{count[word]} {word}" for word in ("reached", "not reached", "no machine"))
        print(f"{family}: {options.starts} starts, {words}; {time.monotonic() - begun:.0f} s", flush=True)
    print(f"{wrong} designs reached their goals and failed the check")
    raise SystemExit(wrong > 0)


if __name__ == "__main__":
    main()
