"""Figures of the pages of the published machines, computed anew: by a textbook's formula or by the library."""

import itertools
import re
from functools import cache
from math import asin, atan, cos, degrees, hypot, pi, radians, sin, sqrt, tan

import centrode as ct
import numpy as np
from conftest import ROOT
from figures import Said
from scipy.optimize import brentq, differential_evolution, minimize_scalar

TAU = 2 * pi


@cache
def design(name):
    """A shipped design."""
    return ct.load(ROOT / "tests" / "designs" / f"{name}.toml")


@cache
def values(name):
    """Figures of the check of a shipped design."""
    return design(name).check().values


# The feeder

FEEDERS = ("feeder-2022", "feeder-widened")


def of_both(figure):
    """A figure, or some, of both designs, one behind the other."""
    both = [figure(name) for name in FEEDERS]
    return [one for some in both for one in (some if isinstance(some, list | tuple) else [some])]


def from_report(*names, scale=1.0):
    """Figures of both designs by their names in the report."""
    return lambda: of_both(lambda name: [scale * values(name)[figure] for figure in names])


def least_transmission(lengths):
    """Minimum transmission angle of a crank-rocker, deg: with the crank along the frame."""
    crank, coupler, rocker, frame = lengths
    cosines = [(coupler**2 + rocker**2 - (frame + way * crank) ** 2) / (2 * coupler * rocker) for way in (-1, 1)]
    return 90 - degrees(asin(min(max(map(abs, cosines)), 1)))


def dead_centers(lengths):
    """The slider where crank and coupler are stretched, and where they are folded."""
    crank, coupler, rocker, frame = lengths
    for reach in (coupler + crank, coupler - crank):
        x = (reach**2 + frame**2 - rocker**2) / (2 * frame)
        yield np.array([x, sqrt(reach**2 - x**2)])


def turned(first, second):
    """Turn counter-clockwise from one direction to another, deg."""
    return degrees(np.arctan2(*second[::-1]) - np.arctan2(*first[::-1])) % 360


def swing(lengths, pivot):
    """Swing of the effector, deg: it points from the pivot to the slider."""
    stretched, folded = dead_centers(lengths)
    return turned(stretched - pivot, folded - pivot)


def strokes(name):
    """Turns of the crank for feed and return, deg: from one dead centre to the other."""
    stretched, folded = dead_centers(design(name).six_bar.lengths)
    feed = turned(stretched, -folded)
    return [feed, 360 - feed]


@cache
def best_in_bounds():
    """The crank-rocker within the paper's bounds (18) whose minimum transmission angle is maximum."""
    bounds = [(77, 81), (136, 147), (127, 138), (100, 106)]

    def missing(lengths):
        crank, *others = lengths
        turns = crank + max(others) <= sum(others) - max(others)
        return -least_transmission(lengths) if turns else 90 + crank + max(others)

    return differential_evolution(missing, bounds, seed=1, tol=1e-12, maxiter=3000).x


@cache
def middle():
    """The published lengths, and the middle of the chord of their dead centres."""
    lengths = design("feeder-2022").six_bar.lengths
    return lengths, tuple(sum(dead_centers(lengths)) / 2)


def sensitivity(lengths, pivot):
    """Change of the swing by each dimension, deg/mm, by differences."""
    at = np.array([*lengths, *pivot])
    step = 1e-4
    turn = lambda x: swing(x[:4], x[4:])  # noqa: E731
    return [(turn(at + step * way) - turn(at - step * way)) / (2 * step) for way in np.eye(6)]


def rounded():
    """Change of the swing with every length off by half a millimetre: to first order, maximum and minimum."""
    lengths, pivot = middle()
    first = 0.5 * sum(map(abs, sensitivity(lengths, pivot)[:4]))
    corners = itertools.product((-0.5, 0.5), repeat=4)
    exact = [swing(np.add(lengths, corner), pivot) - 180 for corner in corners]
    return [first, max(exact), min(exact)]


@cache
def locked():
    """How far the locking arc leaves the crank free, rad: within the dwell, and at its ends; gears without cams."""
    text = design("feeder-2022").to_toml()
    text = re.sub(r"(?m)^entry_deg = .*$", "entry_deg = 0", text)
    found = next(one for one in ct.Feeder.from_toml(text).check().findings if one.rule == "gears-loose")
    # Loose is more than twice that, and 1e-4 rad.
    return [(found.required - 1e-4) / 2, found.measured]


def slot():
    """Clearance of a pin at rest along its line from the driver's axis, mm: 40 to 30, m 3, pins at 45 deg."""
    a, r, p, w = 105, 45, 0.75 * 45, radians(45)
    turned = 0.1 / 2 / (r * cos(radians(20)))
    return turned * p * a * sin(w) / hypot(a - p * cos(w), p * sin(w))


def rates():
    """Cycles and cuttings per minute: a motor, a chain, five slots."""
    return [30 / 2.7, 5 * 30 / 2.7]


FEEDER = [
    Said(
        "| crank, coupler, rocker, frame, mm | {}, {}, {}, {} | {}, {}, {}, {} |",
        lambda: of_both(lambda name: design(name).six_bar.lengths),
    ),
    Said("| pivot F, mm | ({}, {}), not published | ({}, {}) |", lambda: of_both(lambda n: design(n).six_bar.pivot)),
    Said(
        "| swing | {} deg | {} deg |",
        lambda: of_both(lambda name: swing(design(name).six_bar.lengths, design(name).six_bar.pivot)),
    ),
    Said(
        "| minimum transmission angle | **{} deg** | {} deg |",
        lambda: of_both(lambda name: least_transmission(design(name).six_bar.lengths)),
    ),
    Said("| rocker swing | {} deg | {} deg |", from_report("rocker_swing", scale=180 / pi)),
    Said(
        "| crank turns for feed, return | {}, {} deg | {}, {} deg |",
        lambda: of_both(strokes),
    ),
    Said("| feed, return, rest, s | {}, {}, {} | {}, {}, {} |", from_report("feed_time", "return_time", "dwell_time")),
    Said(
        "| fastest tip on feed, return, mm/s | {}, {} | {}, {} |",
        from_report("tip_speed_feed_max", "tip_speed_return_max"),
    ),
    Said("| cuttings per minute | {} | {} |", lambda: [rates()[1]] * 2),
    Said("They have {} degrees.", lambda: least_transmission(middle()[0])),
    Said(
        "has more than {} (at {}, {}, {}, {} mm)",
        lambda: [least_transmission(best_in_bounds()), *best_in_bounds()],
    ),
    Said("are possible together: by {} %.", lambda: 100 * values("feeder-2022")["minimum_widening"]),
    Said("bounds is {} deg", lambda: least_transmission(best_in_bounds())),
    Said(
        "| deg | {} | {} | {} | {} | {} | {} |",
        lambda: sensitivity(design("feeder-2022").six_bar.lengths, design("feeder-2022").six_bar.pivot),
    ),
    Said("can miss by {} degrees, to first order", lambda: rounded()[0]),
    Said("it is {} and {}. A tolerance", lambda: rounded()[1:]),
    Said(
        "holds it within {<} degrees",
        lambda: 0.05 * sum(map(abs, sensitivity(*middle()))),
    ),
    Said("once in {} degrees and the entry angle", lambda: 360 * 30 / 40),
    Said("chain of 2.7 give {} cycles per minute, and five slots {} cuttings", rates),
    Said(
        "at most {} rad in either direction while it moves and {} rad while it rests",
        lambda: [values("feeder-2022")[f"gear_play_{when}_max"] for when in ("moving", "resting")],
    ),
    Said("the backlash of 0.1 mm alone is {} rad", lambda: 0.1 / 2 / (105 * 30 / 70 * cos(radians(20)))),
    Said("holds the crank within {} rad", lambda: locked()[0]),
    Said("within {<} rad in its first and last degrees", lambda: locked()[1]),
    Said("In the published design that is {} mm", lambda: slot()),
    Said("here {} mm. Below zero", lambda: values("feeder-2022")["gear_pin_clearance_min"]),
    Said("{} N/mm² in the published design", lambda: values("feeder-2022")["crank_key_pressure_max"]),
    Said("with round ends it would be {} N/mm²", lambda: 8 / 3 * values("feeder-2022")["crank_key_pressure_max"]),
    Said("Of 30 driven pitches {} teeth", lambda: values("feeder-2022")["gear_teeth"]),
]

# The moving box: LEAD, RADIUS and the load as its page names them

LEAD, RADIUS, WINDOW, WIDTH, DEPTH = 20.0, 15.0, pi / 3, 10.0, 4.0
OMEGA = 200 * TAU / 60
GRAVITY, MASS, RAILS, GROOVE = 9.81, 10.0, 0.15, atan(0.10)
MEAN = LEAD / TAU


def amplitude(waves, moved=2.05):
    """Amplitude of a sine that moves so far in the window."""
    return (MEAN * WINDOW - moved) / (2 * sin(waves * WINDOW / 2))


B = amplitude(1)
SLOW, FAST = MEAN - B, MEAN + B


def wall(slope, acceleration):
    """Normal force of the wall, N, by the groove's slope in mm/rad and the acceleration in mm/rad^2."""
    push = MASS * (acceleration * OMEGA**2 / 1000 + GRAVITY * RAILS)
    return push * cos(GROOVE) / np.cos(np.arctan(slope / RADIUS) + GROOVE)


def scheme(speed, acceleration, slope=None):
    """Minimum and maximum speed over the mean, range of the normal force, r/min at which the slider changes walls."""
    theta = np.linspace(0, TAU, 400_001)
    v, a = speed(theta), acceleration(theta)
    force = wall(slope or v, a)
    limit = sqrt(1000 * GRAVITY * RAILS / -a.min()) * 60 / TAU
    return [v.min() / MEAN, v.max() / MEAN, force.min(), force.max(), limit]


def sine(waves):
    """Figures of a sine's scheme."""
    b = amplitude(waves)
    return scheme(
        lambda theta: MEAN - waves * b * np.cos(waves * theta), lambda theta: waves**2 * b * np.sin(waves * theta)
    )


def elliptic_moved(k, window=WINDOW):
    """How far a plain shaft behind elliptic gears moves the box in a window about the slowest place."""
    return MEAN * 2 * 2 * atan((1 - k) / (1 + k) * tan(window / 4))


def elliptic(k):
    """Figures of a scheme of elliptic gears: the ratio of the published ellipse, and its slope."""
    return scheme(
        lambda theta: MEAN * (1 - k**2) / (1 + 2 * k * np.cos(theta) + k**2),
        lambda theta: MEAN * (1 - k**2) * 2 * k * np.sin(theta) / (1 + 2 * k * np.cos(theta) + k**2) ** 2,
        MEAN,
    )


K = 1 / (2 + sqrt(3))


def eccentricity(moved):
    """Eccentricity of elliptic gears that move the box so far."""
    return brentq(lambda k: elliptic_moved(k) - moved, 0.1, 0.4, xtol=1e-14)


LEAN = atan(TAU * RADIUS / LEAD)


def rotated(kappa, theta):
    """Place of a sine of that height turned by the lead angle: the curve of (3) to (5)."""
    turn = brentq(lambda t: t + kappa * cos(LEAN) / RADIUS * sin(t) - theta, theta - 1, theta + 1, xtol=1e-15)
    return MEAN * turn - kappa * sin(LEAN) * sin(turn)


def departure():
    """How far the turned sine of the same height along the shaft is off ours."""
    turn = np.linspace(0, TAU, 3601)
    return max(abs(rotated(B * sin(LEAN), theta) - MEAN * theta + B * sin(theta)) for theta in turn)


def tables(theta_deg):
    """A row of the page's table: ours next to (14) to (18)."""
    theta = radians(theta_deg)
    speed, ours = MEAN - B * cos(theta), B * sin(theta) * OMEGA**2 / 1000
    lead = atan(speed / RADIUS)
    theirs = B * sin(LEAN) * OMEGA * sin(theta) / 1000
    rail = GRAVITY * RAILS
    normal = lambda push: MASS * push * cos(GROOVE) / cos(lead + GROOVE)  # noqa: E731
    wrong = lambda push: MASS * push * sin(lead - GROOVE) / cos(lead + GROOVE)  # noqa: E731
    return [
        *(theta_deg, speed, ours, theirs),
        *(normal(rail + ours), normal(rail - ours), normal(rail - theirs)),
        *(MASS * (rail + ours) * tan(lead + GROOVE), wrong(rail - ours), wrong(rail - theirs)),
    ]


def gap(speed, width=WIDTH):
    """Length over which a wall is missing at a crossing."""
    return width / sin(2 * atan(speed / RADIUS))


@cache
def bend_radius():
    """Minimum radius of curvature of the development of the strokes."""
    theta = np.linspace(0, TAU, 400_001)
    speed, acceleration = MEAN - B * np.cos(theta), B * np.sin(theta)
    return 1 / (RADIUS * abs(acceleration) / (RADIUS**2 + speed**2) ** 1.5).max()


def bent_bar(length, speed):
    """Minimum of the maximum distance along the shaft of a bar bent round it, that swivels, from its groove."""
    half = length / 2 * cos(atan(speed / RADIUS)) / RADIUS
    turn = np.linspace(0, half, 20_001)
    off = lambda slope: abs(speed * turn - slope * np.sin(turn)).max()  # noqa: E731
    return minimize_scalar(off, bounds=(0, 3 * speed), method="bounded", options={"xatol": 1e-10}).fun


def wall_deviation(speed):
    """How far at the foot a ruled wall stands from that of an end mill as wide as the groove."""
    foot, top = RADIUS - DEPTH, WIDTH / 2 / hypot(RADIUS, speed)
    ruled = np.array([-speed * top / RADIUS * foot, RADIUS * top])
    return WIDTH / 2 - ruled @ np.array([-speed, foot]) / hypot(speed, foot)


def round_shaft(length, speed=SLOW):
    """Angle that a slider in the groove covers round the shaft, deg."""
    return degrees(length * cos(atan(speed / RADIUS)) / RADIUS)


BOX = [
    Said(
        "Lead {} mm, picking window {} deg, pot {} mm wide (so at most {} mm), m = {} kg. Friction {} in the groove and"
        " {} on the rails, g = {} m/s^2, R = {} mm, {} r/min",
        lambda: [LEAD, degrees(WINDOW), 18, 18 / 6, MASS, tan(GROOVE), RAILS, GRAVITY, RADIUS, OMEGA * 60 / TAU],
    ),
    Said("at {} r/min, {} s, in MuJoCo", lambda: [OMEGA * 60 / TAU, 28 * TAU / OMEGA]),
    Said(
        "| plain shaft | {} | {} | {} | {} | any |",
        lambda: [MEAN * WINDOW, 1, 1, wall(MEAN, 0.0)],
    ),
    Said("| sine, one wave per turn, B = {} mm | {} | {} | {} | {} to {} | {} |", lambda: [B, 2.05, *sine(1)]),
    Said("| sine, two waves, B = {} mm | {} | {} | {} | {} to {} | {} |", lambda: [amplitude(2), 2.05, *sine(2)]),
    Said(
        "| elliptic gears, k = {} (published) | {} | {} | {} | {} to {} | {} |",
        lambda: [K, elliptic_moved(K), *elliptic(K)],
    ),
    Said(
        "| elliptic gears, k = {} | {} | {} | {} | {} to {} | {} |",
        lambda: [eccentricity(2.05), 2.05, *elliptic(eccentricity(2.05))],
    ),
    Said("deviates by up to {} mm", departure),
    Said(
        "With kappa = B it moves {} mm in the window",
        lambda: 2 * rotated(B, WINDOW / 2),
    ),
    Said("the reversal takes {} deg, the cycle {} turns", lambda: [360, 2 * (14 - 1) + 2]),
    Said(
        "With {} deg the groove closes too, but every pick of the return misses its hole by {} mm",
        lambda: [180, LEAD / 2],
    ),
    Said("cross every half lead, {} times", lambda: len(design("spiral-shaft-2018").crossings())),
    Said("{} mm at the slow crossings, {} mm at the fast ones", lambda: [gap(SLOW), gap(FAST)]),
    Said(
        "A straight one 42 mm long needs {} mm of clearance to fit into the bend of {} mm radius",
        lambda: [bend_radius() - sqrt(bend_radius() ** 2 - ((42 - WIDTH) / 2) ** 2), bend_radius()],
    ),
    Said(
        "which makes it {} times too small at 12 deg",
        lambda: sin(radians(12) + GROOVE) / sin(radians(12) - GROOVE),
    ),
    Said(
        "With kappa = B sin b = {} mm it gives 1 / {} of the acceleration",
        lambda: [B * sin(LEAN), OMEGA / sin(LEAN)],
    ),
    *(
        Said(f"| {theta} | " + " | ".join(["{}"] * 9) + " |", lambda theta=theta: tables(theta)[1:])
        for theta in range(0, 360, 45)
    ),
    Said("reaches into the groove over {} mm (`flat-slider`)", lambda: 2 * sqrt(RADIUS**2 - (RADIUS - 3.5) ** 2)),
    Said("less than the {} mm without walls", lambda: gap(SLOW)),
    Said("lead angles from {} to {} deg out", lambda: [degrees(atan(s / RADIUS)) for s in (SLOW, FAST)]),
    Said(
        "a bar of 42 mm is off by {} mm at the slow points and {} mm at the fast ones",
        lambda: [bent_bar(42, SLOW), bent_bar(42, FAST)],
    ),
    Said("While the pin passes the {} mm over which", lambda: gap(SLOW)),
    Said("So it must be {} mm long, {} deg round the shaft", lambda: [2 * gap(SLOW), round_shaft(2 * gap(SLOW))]),
    Said("at 200 r/min the gap lasts {} ms", lambda: 1000 * radians(round_shaft(gap(SLOW))) / OMEGA),
    Said("divided by the slow speed of {} mm per radian", lambda: SLOW),
    Said(
        "A groove 2.5 mm wide needs a slider of {} mm, {} deg round the shaft",
        lambda: [2 * gap(SLOW, 2.5), round_shaft(2 * gap(SLOW, 2.5))],
    ),
    Said(
        "Bent, it is off by {} mm at the slow points and {} mm at the fast ones",
        lambda: [bent_bar(2 * gap(SLOW, 2.5), s) for s in (SLOW, FAST)],
    ),
    Said(
        "the difference is {} mm at the slow points, {} mm at mean speed, {} mm at the fast ones",
        lambda: [wall_deviation(speed) for speed in (SLOW, MEAN, FAST)],
    ),
    Said(
        "2 sqrt(R^2 - (R - h)^2), {} mm for R = 15 mm",
        lambda: 2 * sqrt(RADIUS**2 - (RADIUS - 3.5) ** 2),
    ),
    Said("So to bridge a crossing of {} mm it must", lambda: gap(SLOW)),
]

# The three-arm mechanism: the tables of its page are held by tests/published, as Rust writes them


def arm_rate():
    """Turn of the arm against the carrier at planting, by that of the carrier."""
    arms, step = design("three-arm-2021"), 1e-5
    at = arms.planting()
    # The carrier turns clockwise.
    return (arms.clamp_angle(at + step) - arms.clamp_angle(at - step)) / (2 * step) + 1


def after_picking():
    """Turn of the carrier from picking to where the arm is deepest in the row above, deg."""
    return degrees(values("three-arm-2021")["arm_unpicked_clearance_input"] - design("three-arm-2021").picking())


def module_over_borne():
    """By how much the module is greater than what the sharpest place bears, %: sin^2(20 deg) over its curvature."""
    pair = design("three-arm-2021").gear_pair()
    phi = np.linspace(0, TAU, 100_001)
    sharpest = max(pair.driver_curvature(phi).max(), pair.driven_curvature(phi).max())
    return 100 * (values("three-arm-2021")["module"] * sharpest / sin(radians(20)) ** 2 - 1)


def reference():
    """The intermediate gear's turn over the first |gamma_0| of the carrier's, deg: psi runs the other way."""
    return -degrees(design("three-arm-2021").gear_pair().driven_angle(radians(-53)))


def cam_radius():
    """Minimum radius of curvature of the cam, mm."""
    return 1 / design("three-arm-2021").cam.curvature(np.linspace(0, TAU, 20_001)).max()


THREE_ARM = [
    Said("For the published set it is {} degrees; against the frame", reference),
    Said("the gear turns |gamma_0| more, {} degrees", lambda: 53 + reference()),
    Said(
        "reaches {} mm into the row above in the published set, {} degrees of carrier turn after picking, and {} mm in",
        lambda: [
            -values("three-arm-2021")["arm_unpicked_clearance"],
            after_picking(),
            -values("three-arm-all-goals")["arm_unpicked_clearance"],
        ],
    ),
    Said("at about {} of its rate", arm_rate),
    Said("leave a radius of curvature of about {} mm", cam_radius),
    Said("({} % at the start)", module_over_borne),
]

PAGES = {"docs/feeder.md": FEEDER, "docs/moving-box.md": BOX, "docs/three-arm.md": THREE_ARM}
