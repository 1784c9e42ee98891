"""Random gear pairs, seated by the contact analysis, and compared with polygons by GEOS.

Seated either way the gears must not penetrate; turned a little further they must. Where no place is free none may be
found between the seats. The polygons come from the exported
contours and know nothing of how contact is found. Prints what failed, and the deepest penetration of all.

    python tests/campaigns/contact_seating.py --pairs 1000 --inputs 200 --jobs 2
"""

import argparse
import json
import math
import sys
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

import centrode as ct
import numpy as np
import shapely
from shapely.geometry import Polygon

CHORD = 1e-5
"""Maximum distance of a polygon from its contour, mm and modules, whichever is less."""
FURTHER_ANGLE, FURTHER = 1e-5, 2e-4
"""Turn, rad, or way along the contact's normal, mm, after which the gears must penetrate."""
KINDS = ["ellipse", "lobed", "waves", "eccentric", "limacon", "spline", "concave", "circle"]


def curve(random, kind, size):
    """A random pitch curve of one kind, and its mean ratio."""
    if kind == "ellipse":
        return ct.pitch.ellipse(eccentricity=random.uniform(0, 0.5), **size), (1, 1)
    if kind == "lobed":
        turns = int(random.integers(1, 4))
        return ct.pitch.lobed_ellipse(lobes=1, eccentricity=random.uniform(0, 0.2), **size), (turns, 1)
    if kind == "eccentric":
        return ct.pitch.eccentric_circle(eccentricity=random.uniform(0, 0.4), **size), (1, 1)
    if kind == "limacon":
        lobes = int(random.integers(1, 4))
        return ct.pitch.limacon(mean_radius=20, amplitude=20 * random.uniform(0, 0.25), lobes=lobes, **size), (1, 1)
    if kind == "circle":
        return ct.pitch.circle(**size), (1, int(random.integers(1, 3)))
    if kind == "spline":
        count = int(random.integers(8, 14))
        angle = np.sort(2 * math.pi * (np.arange(count) + random.uniform(-0.2, 0.2, count)) / count) % (2 * math.pi)
        radius = 40 + random.uniform(-1, 1, count) * random.uniform(4, 22)
        return ct.pitch.bspline(radius=radius.tolist(), angle=np.sort(angle).tolist(), degree=2, **size), (1, 1)
    waves = random.uniform(0.05, 0.3) if kind == "concave" else random.uniform(0, 0.12)
    lobes = int(random.integers(2, 5)) if kind == "concave" else int(random.integers(1, 4))
    tilt, turned = random.uniform(0, 0.06), random.uniform(0, 6.28)
    return ct.pitch.polar(f"1 + {waves!r}*cos({lobes}*phi) + {tilt!r}*cos(phi + {turned!r})", **size), (1, 1)


def draw(seed, number):
    """A random pair and its description; None if no such pair exists."""
    random = np.random.default_rng([seed, number])
    kind = KINDS[number % len(KINDS)]
    fitted = bool(random.integers(2))
    size = {"module": random.uniform(0.4, 4.0), "tooth_count": int(random.integers(12, 42))}
    sharp = random.uniform(0.05, 0.2)
    rack = ct.Rack(
        pressure_angle=math.radians(random.uniform(15, 25)),
        tip_radius_coefficient=sharp,
    )
    shift = random.choice([0.0, random.uniform(-0.2, 0.2)])
    try:
        pitch, ratio = curve(random, kind, size)
        pair = ct.GearPair(
            pitch,
            mean_ratio=ratio,
            tool=rack,
            driver_shift=shift,
            addendum="fitted" if fitted else "full",
            backlash=size["module"] * random.choice([0.0, random.uniform(0, 0.1)]),
            thickness_split=random.choice([0.5, random.uniform(0.46, 0.54)]),
            phase=random.uniform(0, 1),
        )
    except ct.Error:
        return None
    sides = [
        side for gear in (pair.driver, pair.driven) for tooth in gear.teeth for side in (tooth.leading, tooth.trailing)
    ]
    words = [kind, "fitted" if fitted else "full"]
    if any(side.undercut > 0 for side in sides):
        words.append("undercut")
    return pair, " ".join(words)


class Polygons:
    """The two gears as polygons, of which the teeth near the mesh are held against each other."""

    def __init__(self, pair):
        self.chord = CHORD * min(pair.module, 1.0)
        self.far = pair.center_distance
        self.gears = [gear.outline(tolerance=self.chord) for gear in (pair.driver, pair.driven)]
        self.spread = []
        radii = [np.hypot(*gear.T) for gear in self.gears]
        for own, other in (radii, radii[::-1]):
            # Within this angle of the line of centres a point may lie in the other gear's reach.
            reach, far = other.max() + 0.1 * pair.module, self.far
            near = own[own > far - reach]
            cos = (far**2 + near**2 - reach**2) / (2 * far * near)
            self.spread.append(np.arccos(np.clip(cos, -1, 1)).max() + 0.02)
        # Three turns of each contour, and the points whose ray from the axis crosses it nowhere else.
        self.turns = [np.vstack([gear] * 3) for gear in self.gears]
        self.cuts = []
        for turns in self.turns:
            angles = np.unwrap(np.arctan2(turns[:, 1], turns[:, 0]))
            before, after = np.maximum.accumulate(angles), np.minimum.accumulate(angles[::-1])[::-1]
            cuts = np.flatnonzero((angles == before) & (angles == after))
            self.cuts.append((cuts, angles[cuts]))

    def near(self, which, direction):
        """The part of a gear about a direction of its own, closed over its axis."""
        cuts, angles = self.cuts[which]
        spread, start = self.spread[which], angles[0] + 2 * math.pi
        middle = start + (direction - start) % (2 * math.pi)
        first, last = np.searchsorted(angles, [middle - spread, middle + spread])
        first, last = max(first - 1, 0), min(last, len(cuts) - 1)
        if angles[last] - angles[first] > 6:
            return self.gears[which]
        return np.vstack([[[0.0, 0.0]], self.turns[which][cuts[first] : cuts[last] + 1]])

    def placed(self, phi, psi):
        """Both gears near the mesh, the driver at `phi`, the driven gear at `psi`."""
        driver = Polygon(turned(self.near(0, phi), -phi))
        driven = Polygon(turned(self.near(1, math.pi - psi), psi) + np.array([self.far, 0.0]))
        return driver, driven

    def depth(self, phi, psi):
        """How deep the gears are in each other, mm: how far a point of one contour lies inside the other."""
        driver, driven = self.placed(phi, psi)
        pieces = shapely.get_parts(shapely.intersection(driver, driven))
        pieces = pieces[shapely.area(pieces) > 0]
        # As thick as a lens of this area and edge; a needle is deeper, which is looked at only where it tells.
        thickness = float((3 * shapely.area(pieces) / shapely.length(pieces)).max(initial=0.0))
        if thickness > 20 * self.chord:
            return thickness
        points = shapely.points(shapely.get_coordinates(pieces))
        inside = [shapely.distance(points, contour.exterior) for contour in (driver, driven)]
        return float(np.max(inside, initial=0.0))

    def stuck(self, phi, psi, noise):
        """Whether the gears penetrate and no small turn parts them: a tip stands in a root."""
        return all(self.depth(phi, psi + turn) > noise for turn in (-1e-3, -1e-4, 1e-4, 1e-3))


def turned(points, angle):
    cos, sin = math.cos(angle), math.sin(angle)
    return points @ np.array([[cos, sin], [-sin, cos]])


@dataclass
class Outcome:
    """What one pair came to."""

    number: int
    words: str
    seats: int = 0
    jammed: int = 0
    clashing: int = 0
    loose: int = 0
    crossed: bool = False
    deepest: float = 0.0
    failures: list = field(default_factory=list)


def further(polygons, phi, psi, sign, noise):
    """Whether the gears penetrate when the driven gear is turned a little further; `sign` 1 turns it back."""
    if polygons.depth(phi, psi - sign * FURTHER_ANGLE) > noise:
        return True
    # How fast the gears go into each other tells the contact's lever.
    lever = polygons.depth(phi, psi - sign * 1e-4) / 1e-4
    turn = FURTHER / max(lever, 1e-3 * polygons.far)
    return turn > FURTHER_ANGLE and polygons.depth(phi, psi - sign * turn) > noise


def examine(pair, number, words, inputs, seed):
    """Seats one pair at random inputs."""
    random = np.random.default_rng([seed, number, 1])
    phis = random.uniform(0, pair.cycle, inputs).tolist()
    contact, polygons, outcome = pair.contact(inputs=phis), Polygons(pair), Outcome(number, words)
    if not all(Polygon(gear).is_valid for gear in polygons.gears):
        outcome.crossed = True
        return outcome
    noise = 4 * polygons.chord
    clearance = np.minimum(contact.clearance, contact.fillet_clearance)
    # Of two seats past each other each has on its other side all that is missing, twice the penetration told.
    told = 2 * contact.penetration
    seats = zip(phis, contact.driven_angle, contact.reverse_driven_angle, clearance, told, strict=True)
    for phi, on, back, clear, missing in seats:
        if not math.isfinite(on):
            outcome.loose += 1
            continue
        if back < on and polygons.depth(phi, 0.5 * (on + back)) > noise:
            # No free place: none of those between must be free either.
            outcome.jammed += 1
            between = np.linspace(back, on, 5)[1:-1]
            free = [psi for psi in between if polygons.depth(phi, psi) < noise / 4]
            outcome.failures += [("free though jammed", phi, float(psi), 0.0) for psi in free]
            continue
        for psi, sign in ((on, 1), (back, -1)):
            outcome.seats += 1
            depth = polygons.depth(phi, psi) - missing
            if depth > noise and clear < -noise and polygons.stuck(phi, psi, noise):
                outcome.clashing += 1
                continue
            outcome.deepest = max(outcome.deepest, depth / polygons.chord)
            if depth > noise:
                outcome.failures.append(("penetrates", phi, float(psi), depth))
            elif not further(polygons, phi, psi, sign, noise):
                outcome.failures.append(("does not touch", phi, float(psi), depth))
    return outcome


def run(task):
    """Draws and examines one pair."""
    seed, number, inputs = task
    found = draw(seed, number)
    return examine(found[0], number, found[1], inputs, seed) if found else None


def main():
    """Run the campaign; the exit status tells whether anything failed."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--pairs", type=int, default=60, help="pairs to examine")
    parser.add_argument("--inputs", type=int, default=40, help="inputs a pair")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--first", type=int, default=0, help="number of the first pair drawn")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--store", type=Path, help="file of what is done, to go on from")
    options = parser.parse_args()
    done = {}
    if options.store and options.store.exists():
        lines = [json.loads(line) for line in options.store.read_text().splitlines()]
        done = {line["task"]: line["outcome"] for line in lines if line["run"] == [options.seed, options.inputs]}
    outcomes, number, drawn = [], options.first, 0
    with ProcessPoolExecutor(options.jobs) as pool:
        while len(outcomes) < options.pairs:
            batch = range(number, number + options.pairs - len(outcomes))
            number, drawn = batch.stop, drawn + len(batch)
            open_tasks = [k for k in batch if k not in done]
            for k, outcome in zip(
                open_tasks, pool.map(run, [(options.seed, k, options.inputs) for k in open_tasks]), strict=True
            ):
                done[k] = outcome and vars(outcome)
                if options.store:
                    line = {"run": [options.seed, options.inputs], "task": k, "outcome": done[k]}
                    with options.store.open("a") as file:
                        file.write(json.dumps(line) + "\n")
            outcomes += [Outcome(**done[k]) for k in batch if done[k]]
    for outcome in outcomes:
        for what, phi, psi, depth in outcome.failures:
            print(f"pair {outcome.number} ({outcome.words}) {what} at {phi!r}, driven {psi!r}: {depth:.3e} mm")
    failures = sum(len(o.failures) for o in outcomes)
    print(f"{len(outcomes)} pairs of {drawn} drawn, {sum(o.seats for o in outcomes)} seats, {failures} failures")
    print(
        f"{sum(o.jammed for o in outcomes)} inputs without a free place, "
        f"{sum(o.clashing for o in outcomes)} seats with a tip in a root, "
        f"{sum(o.loose for o in outcomes)} disengaged"
    )
    for outcome in outcomes:
        if outcome.crossed:
            print(f"pair {outcome.number} ({outcome.words}) left out: a contour crosses itself")
    print(f"deepest penetration of a seat: {max(o.deepest for o in outcomes):.2f} chord errors (4 allowed)")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
