"""Random gears of every pitch curve, tool, fit, ratio and shift, sound and hopeless ones: is every contour a contour?

Each is looked at as polygons by GEOS, which shares nothing with the crates: as a ring within 1e-6 of the module it must
be simple and counter-clockwise, and have the area told; a ring that is not simple is looked at within 1e-9. Of every
`--fine` pairs one is looked at within 1e-9 at once. A gear 8 times as large must be the same, scaled. Prints what
failed with its design, and how many designs are refused and why.

    python tests/campaigns/contours.py --gears 10000 --seed 1 --jobs 2
"""

import argparse
import json
import math
import re
import signal
import sys
import time
from collections import Counter
from concurrent.futures import ProcessPoolExecutor

import centrode as ct
import numpy as np
import shapely

COARSE, FINE = 1e-6, 1e-9
"""Maximum distances of a polygon from its contour, modules."""
PATIENCE = 60
"""Seconds of processor time after which a pair is given up."""


def toml(value):
    """A value as it stands in a design file."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {toml(item)}" for key, item in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(toml(item) for item in value) + "]"
    return json.dumps(value)


def points(random, kind):
    """Points round the shaft for a chain of polynomials of some degree."""
    degree = int(random.integers(2, 6))
    count = int(random.integers(6, 14))
    if kind == "bezier":
        count = degree * int(random.integers(2, 5))
    spread, uneven = random.choice([(0.1, 0.15), (0.5, 0.25), (0.3, 0.0)])
    steps = 1 + uneven * random.uniform(-1, 1, count)
    angle = 2 * math.pi * (np.cumsum(steps) - steps[0]) / steps.sum()
    radius = random.uniform(10, 40) * (1 + spread * random.uniform(-1, 1, count))
    polar = bool(random.integers(2))
    if kind == "bezier":
        # Midway between their neighbours, the joints of the arcs are no corners.
        angle += 0.5 * steps[0] / steps.sum()
        around = np.stack([radius, angle] if polar else [radius * np.cos(angle), radius * np.sin(angle)])
        after, before = np.roll(around, -1, axis=1), np.roll(around, 1, axis=1)
        if polar:
            before[1, 0] -= 2 * math.pi
        around[:, ::degree] = 0.5 * (before + after)[:, ::degree]
        radius, angle = around if polar else (np.hypot(*around), np.arctan2(around[1], around[0]))
    if polar:
        place = {"plane": "polar", "radius": radius.tolist(), "angle_deg": np.degrees(angle).tolist()}
    else:
        place = {"plane": "cartesian", "x": (radius * np.cos(angle)).tolist(), "y": (radius * np.sin(angle)).tolist()}
    own = {"interpolate": bool(random.integers(2))} if kind == "bspline" else {}
    return {"kind": kind, "degree": degree, **own, **place}


def circle(random):
    return {"kind": "circle"}, 0


def eccentric(random):
    return {"kind": "eccentric-circle", "eccentricity": random.uniform(0, 0.8)}, 1


def ellipse(random):
    return {"kind": "ellipse", "eccentricity": random.uniform(0, 0.85)}, 1


def lobed(random):
    lobes = int(random.integers(1, 6))
    return {"kind": "lobed-ellipse", "lobes": lobes, "eccentricity": random.uniform(0, 0.4)}, lobes


def limacon(random):
    lobes, mean = int(random.integers(1, 5)), random.uniform(10, 30)
    return {"kind": "limacon", "mean_radius": mean, "amplitude": mean * random.uniform(0, 0.6), "lobes": lobes}, lobes


def bspline(random):
    return points(random, "bspline"), 1


def bezier(random):
    return points(random, "bezier"), 1


def polar(random):
    form, n = random.integers(3), int(random.integers(1, 6))
    if form == 0:
        formula = f"1 + {random.uniform(0, 0.4)!r}*cos({n}*phi) - {random.uniform(0, 0.2)!r}*sin(phi)"
        return {"kind": "polar", "expression": formula}, 1
    if form == 1:
        radius = 20 * (1 + random.uniform(0.05, 0.4) * random.uniform(-1, 1, int(random.integers(5, 14))))
        word = random.choice(["cubic", "quintic", "trigonometric"])
        return {"kind": "polar", "radius": radius.tolist(), "interpolation": str(word)}, 1
    share = random.uniform(0.02, 0.3) * 20 / n
    cos, sin = (share * random.uniform(-1, 1, (2, n))).tolist()
    return {"kind": "polar", "mean": 20.0, "cos": cos, "sin": sin}, 1


def transmission(random):
    n, swing = int(random.integers(1, 5)), random.uniform(0, 0.7)
    if random.integers(2):
        return {"kind": "transmission", "expression": f"phi - {swing / n**2!r}*sin({n}*phi)"}, n
    return {"kind": "ratio", "expression": f"1 - {swing / n!r}*cos({n}*phi)"}, n


def conjugate(random):
    of, _ = CURVES[random.choice([name for name in CURVES if name != "conjugate"])](random)
    of = {**of, "module": 1.0, "tooth_count": 30}
    turns = int(random.integers(1, 3))
    return {"kind": "conjugate", "mean_ratio": [turns, 1], "of": of}, turns


CURVES = {f.__name__: f for f in [circle, eccentric, ellipse, lobed, limacon, bspline, bezier, polar, transmission]}
CURVES["conjugate"] = conjugate


def draw(seed, number):
    """The number-th random design of a seed, as tables."""
    random = np.random.default_rng([seed, number])
    pitch, lobes = CURVES[list(CURVES)[number % len(CURVES)]](random)
    least = int(random.choice([6, 12, 20]))
    pitch |= {"module": random.uniform(0.4, 4.0), "tooth_count": int(random.integers(least, 61))}
    turns = int(random.choice([1, 1, 1, 2, 3]))
    ratio = [turns, 1]
    if pitch["kind"] in ("transmission", "ratio"):
        ratio = [1, 1]  # as the law requires
    elif lobes != 1 and random.integers(2):
        ratio = [turns, lobes or int(random.integers(1, 4))]
    divisor = math.gcd(*ratio)
    ratio = [n // divisor for n in ratio]
    # Teeth are numbered over one turn of each gear.
    pitch["tooth_count"] += -pitch["tooth_count"] % ratio[1]
    height = random.choice([1.0, random.uniform(0.6, 1.3)])
    tool = {
        "kind": "rack",
        "pressure_angle_deg": float(random.choice([14.5, 20.0, random.uniform(12, 28)])),
        "addendum_coefficient": float(height),
        "dedendum_coefficient": float(height) + random.uniform(0.1, 0.3),
        "tip_radius_coefficient": float(random.choice([0.0, random.uniform(0, 0.2), 0.1])),
    }
    driver = {"shift": float(random.choice([0.0, random.uniform(-0.5, 0.5)]))}
    if random.integers(3) == 0:
        tool |= {"kind": "shaper", "tooth_count": int(random.integers(8, 50))}
    teeth = {
        "addendum": str(random.choice(["full", "fitted"])),
        "phase": random.choice([0.0, random.uniform(-1, 1)]),
        "backlash": pitch["module"] * random.choice([0.0, random.uniform(0, 0.1)]),
        "thickness_split": random.choice([0.5, random.uniform(0.45, 0.55)]),
    }
    return {"pitch": pitch, "tool": tool, "driver": driver, "teeth": teeth, "mean_ratio": ratio}


def text(design):
    """A design as a file."""
    return 'family = "gear-pair"\n' + "".join(f"{key} = {toml(value)}\n" for key, value in design.items())


def ring_faults(points, area, chord):
    """What is wrong with a contour as a polygon."""
    if not np.isfinite(points).all():
        return ["is not finite"]
    faults = []
    polygon = shapely.polygons(points)
    if not shapely.is_valid(polygon):
        faults.append(f"crosses itself: {shapely.is_valid_reason(polygon)}")
    # As a polygon it is smaller or larger by no more than its chords allow.
    x, y = (points - points.mean(axis=0)).T
    own = 0.5 * float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))
    edge = float(np.hypot(*(np.roll(points, -1, axis=0) - points).T).sum())
    if own <= 0:
        faults.append("runs clockwise")
    if abs(own - area) > chord * edge + 1e-12 * area:
        faults.append(f"has an area of {own!r}, told as {area!r}")
    return faults


def contour_faults(gear, module, fine):
    """What is wrong with a gear's contour, by polygons as fine as it takes to tell."""
    for chord in [FINE] if fine else [COARSE, FINE]:
        points = gear.outline(tolerance=chord * module)
        faults = ring_faults(points, gear.area, chord * module)
        if not faults:
            break
    return faults


def larger(design, factor):
    """The design with every length larger by a factor."""
    pitch = {**design["pitch"], "module": design["pitch"]["module"] * factor}
    teeth = {**design["teeth"], "backlash": design["teeth"]["backlash"] * factor}
    return {**design, "pitch": pitch, "teeth": teeth}


def examine(task):
    """Draws one pair and looks at its two contours: faults, the reason of a refusal, and the time it took."""
    seed, number, fine, scaled = task
    design = draw(seed, number)
    module, faults = design["pitch"]["module"], []

    def give_up(*_):
        raise TimeoutError

    signal.signal(signal.SIGPROF, give_up)
    signal.setitimer(signal.ITIMER_PROF, PATIENCE)
    began = time.process_time()
    try:
        pair = ct.GearPair.from_toml(text(design))
        took = time.process_time() - began
        for gear in (pair.driver, pair.driven):
            faults += [f"{gear.member} {fault}" for fault in contour_faults(gear, module, number % fine == 0)]
        if number % scaled == 0:
            other = ct.GearPair.from_toml(text(larger(design, 8.0)))
            for one, two in ((pair.driver, other.driver), (pair.driven, other.driven)):
                a, b = one.outline(tolerance=1e-4 * module), two.outline(tolerance=8e-4 * module)
                if a.shape != b.shape or np.abs(8 * a - b).max() > 1e-8 * module:
                    faults.append(f"{one.member} does not scale")
    except TimeoutError:
        return number, ["takes too long"], None, PATIENCE
    except ct.Error as error:
        return number, [], str(error), time.process_time() - began
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
    return number, faults, None, took


def main():
    """Run the campaign; the exit status tells whether anything failed."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--gears", type=int, default=400, help="gears to draw, two per pair")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--first", type=int, default=0, help="number of the first pair drawn")
    parser.add_argument("--fine", type=int, default=10, help="every how many pairs are looked at within 1e-9 at once")
    parser.add_argument("--scaled", type=int, default=10, help="every how many pairs are made again, scaled")
    parser.add_argument("--minutes", type=float, default=math.inf, help="time after which no more are drawn")
    parser.add_argument("--jobs", type=int, default=1)
    options = parser.parse_args()
    until = time.monotonic() + 60 * options.minutes
    reasons, times, failed, gears = Counter(), [], 0, 0
    numbers = range(options.first, options.first + options.gears // 2)
    with ProcessPoolExecutor(options.jobs) as pool:
        for start in range(0, len(numbers), 100 * options.jobs):
            if time.monotonic() > until:
                break
            tasks = [
                (options.seed, k, options.fine, options.scaled) for k in numbers[start : start + 100 * options.jobs]
            ]
            for number, faults, refusal, took in pool.map(examine, tasks):
                times.append(took)
                if refusal is None:
                    gears += 2
                else:
                    # Refusals alike but for their numbers are counted together.
                    reasons[re.sub(r"[-+]?\d[\d.]*(e[-+]?\d+)?", "#", refusal.splitlines()[0])] += 1
                if faults:
                    failed += 1
                    print(f"# pair {number} of seed {options.seed}: {'; '.join(faults)}")
                    print(text(draw(options.seed, number)), flush=True)
    for reason, count in reasons.most_common():
        print(f"# {count} x {reason}")
    times.sort()
    print(
        f"# seed {options.seed}, pairs {options.first} to {options.first + len(times) - 1}: {gears} gears, "
        f"{sum(reasons.values())} designs refused, {failed} pairs failed; "
        f"median {1e3 * times[len(times) // 2]:.1f} ms per pair, most {1e3 * times[-1]:.0f} ms"
    )
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
