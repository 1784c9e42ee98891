"""Figures of the page that goes through the papers figure by figure."""

import re
from functools import cache
from math import atan, atan2, degrees, radians

import centrode as ct
import numpy as np
from conftest import ROOT
from figures import Said
from figures_machines import (
    MEAN,
    SLOW,
    TAU,
    WINDOW,
    K,
    best_in_bounds,
    dead_centers,
    design,
    eccentricity,
    elliptic,
    elliptic_moved,
    least_transmission,
    rates,
    reference,
    sine,
    swing,
    tables,
    values,
)
from scipy.optimize import brentq

STATES = ("agrees", "no numbers", "in part", "given", "differs", "not reproduced")


def counts():
    """Rows of figures and of tables on the page, and how many of all there are of each state, in the page's order."""
    page = (ROOT / "docs" / "papers.md").read_text()
    rows = re.findall(r"(?m)^\| (Figure|Table) \d+ \|.*\| \*\*([a-z ]+)\*\*[^|]*\|$", page)
    kinds, states = zip(*rows, strict=True)
    return [kinds.count("Figure"), kinds.count("Table"), *map(states.count, STATES)]


# The three-arm mechanism

SOURCE = (ROOT / "tests" / "designs" / "three-arm-2021.toml").read_text()
PICKING, PLANTING = radians(20), radians(191)
RADII = (21, 28, 50, 49, 58, 47, 18, 12, 28, 60, 48, 24)
ANGLES = (20, 45, 76, 105, 132, 165, 195, 225, 255, 285, 316, 345)
# Plane, degree and whether the curve runs through the points; the shipped reading first.
READINGS = (
    *(("polar", 2, False), ("polar", 3, False), ("polar", 2, True), ("polar", 3, True)),
    *(("cartesian", 2, False), ("cartesian", 3, False), ("cartesian", 3, True)),
)
NUMBERS = {"beta_0": ("mounting_angle_deg", -29), "S": ("tip_distance", 145), "gamma_0": ("bend_deg", -53)}
# The ways in which section 4.2 says that figures of the path go as a parameter grows.
SAYS = (
    {"r1": {"return": -1}, "r7": {"loop": -1}}
    | {f"r{i}": {"return": -1, "fall": 1, "loop": -1} for i in range(2, 7)}
    | {f"r{i}": {"loop": 1, "fall": -1} for i in range(8, 13)}
    | {
        "beta_0": {"pick": 1, "plant": 1, "return": 1},
        "S": {"farthest": 1, "loop": 1},
        "gamma_0": {"loop": -1, "fall": 1},
    }
)


@cache
def free():
    """The published machine without Table 1."""
    return ct.ThreeArm.from_toml(SOURCE.replace("picking_deg = 20\n", "").replace("planting_deg = 191\n", ""))


def turns(arms):
    """Turns of the carrier at which the arms pick, and those at which they plant, deg."""
    return [degrees(place(arm)) for place in (arms.picking, arms.planting) for arm in range(3)]


def tray_of(distance):
    """Turn of the carrier at which the first arm picks from a tray at that distance, deg."""
    text = free().to_toml().replace("[tray]\n", f"[tray]\ndistance = {distance}\n")
    return degrees(ct.ThreeArm.from_toml(text).picking())


@cache
def course():
    """Place, mm, and velocity, mm/s, of the first tip over a turn of the carrier."""
    arms, theta = design("three-arm-2021"), np.radians(np.arange(0, 360, 0.01))
    return arms.tip(theta), arms.tip_velocity(theta) * arms.carrier_speed


def ranges(motion):
    """Minimum and maximum x, then y."""
    return [float(one) for column in motion.T for one in (column.min(), column.max())]


def short():
    """How far short of its farthest and of its lowest place the tip is at Table 1, mm."""
    arms, (tip, _) = design("three-arm-2021"), course()
    return [tip[:, 0].max() - arms.tip(PICKING)[0], arms.tip(PLANTING)[1] - tip[:, 1].min()]


def goals(arms, *numbers):
    """Figures of goals of a machine, angles in degrees."""
    found = {goal.number: goal for goal in arms.check().goals}
    return [degrees(found[n].value) if found[n].unit == "rad" else found[n].value for n in numbers]


def slower():
    """How much slower the tip picks than with two arms, %, and both speeds, mm/s."""
    speeds = [values("three-arm-2021")[name] for name in ("picking_speed", "picking_speed_of_two_arms")]
    return [100 * (1 - speeds[0] / speeds[1]), *speeds]


def as_printed():
    """The (10) of the paper as an integral: the radii the wrong way round, deg."""
    phi = np.linspace(0, -radians(53), 100_001)
    return -degrees(np.trapezoid(1 / design("three-arm-2021").gear_pair().ratio(phi), phi))


def moved(parameter, by, plane, degree, interpolate):
    """The published machine in some reading of its points, with one parameter moved."""
    radii = [r + by * (parameter == f"r{i}") for i, r in enumerate(RADII, 1)]
    points = f"radius = {radii}\nangle_deg = {list(ANGLES)}"
    if plane == "cartesian":
        angles = np.radians(ANGLES)
        points = f"x = {(radii * np.cos(angles)).tolist()}\ny = {(radii * np.sin(angles)).tolist()}"
    points += f"\ninterpolate = {str(interpolate).lower()}"
    text = re.sub(r"(?m)^radius = .*\nangle_deg = .*$", points, SOURCE)
    text = text.replace("degree = 2", f"degree = {degree}").replace('"polar"', f'"{plane}"')
    if parameter in NUMBERS:
        key, number = NUMBERS[parameter]
        text = re.sub(rf"(?m)^{key} = .*$", f"{key} = {number + by}", text)
    return ct.ThreeArm.from_toml(text)


def path(arms):
    """Figures of the path of the tip by name, mm."""
    tip = arms.tip(np.radians(np.arange(0, 360, 0.25)))
    pick, plant = arms.tip(PICKING), arms.tip(PLANTING)
    highest, farthest = tip[:, 1].max(), tip[:, 0].max()
    return {
        "return": highest,
        "farthest": farthest,
        "pick": pick[1],
        "plant": plant[1],
        "fall": pick[1] - plant[1],
        "loop": farthest - pick[0],
    }


@cache
def directions(reading):
    """How many of the ways in which a path is said to go it goes in a reading of the points, and how many are said."""
    kept = []
    for parameter, ways in SAYS.items():
        less, more = (path(moved(parameter, by, *reading)) for by in (-0.5, 0.5))
        kept += [(more[name] - less[name]) * way > 0 for name, way in ways.items()]
    return [sum(kept), len(kept)]


def others():
    """The fewest and the most ways that another reading keeps."""
    kept = [directions(reading)[0] for reading in READINGS[1:]]
    return [min(kept), max(kept)]


THREE_ARM = [
    Said(
        "{} gears, {} arms; the path is {} mm wide and {} mm high",
        lambda: [
            1 + 2 * design("three-arm-2021").arms,
            design("three-arm-2021").arms,
            np.ptp(course()[0][:, 0]),
            np.ptp(course()[0][:, 1]),
        ],
    ),
    Said("the rod moves {} mm", lambda: values("three-arm-2021")["push_rod_stroke"]),
    Said(
        "centre distance {} mm; the tip picks at ({}, {}) mm and plants at ({}, {}) mm",
        lambda: [
            design("three-arm-2021").center_distance,
            *design("three-arm-2021").tip(PICKING),
            *design("three-arm-2021").tip(PLANTING),
        ],
    ),
    Said(
        "| {} deg, {} deg, {} deg; {} mm, {} mm and {} mm |", lambda: goals(design("three-arm-2021"), 2, 3, 4, 6, 7, 8)
    ),
    Said("but {} flanks cannot be cut", lambda: goals(design("three-arm-2021"), 9)),
    Said("left free {}, {}, {} deg and {}, {}, {} deg", lambda: turns(free())),
    Said("only the {} deg between arms", lambda: 360 / design("three-arm-2021").arms),
    Said("the shift is {} deg |", lambda: 360 / design("three-arm-2021").arms),
    Said("| {} of {} directions |", lambda: directions(READINGS[0])),
    Said("has all {} directions. The other six ... have {} to {}.", lambda: [directions(READINGS[0])[0], *others()]),
    Said("x from {} to {} mm, y from {} to {} mm;", lambda: ranges(course()[0])),
    Said("x from {} to {} mm/s, y from {} to {} mm/s", lambda: ranges(course()[1])),
    Said("the carrier turns at {} r/min", lambda: design("three-arm-2021").carrier_speed * 60 / TAU),
    Said("{} % slower: {} mm/s, not {} mm/s", slower),
    Said("picks {} mm before the farthest reach and plants {} mm above the lowest point", short),
    Said("are missed: {}, {} and {} deg", lambda: goals(free(), 2, 3, 4)),
    Said("from the carrier's axis gives a picking turn of {} deg", lambda: tray_of(243.62)),
    Said("it gives about {} deg, and", as_printed),
    Said("is {} deg.\n- The sun", reference),
]

# The moving box


def range_of(speeds):
    """Minimum and maximum speed of the box, mm/s, from those over the mean, and the mean, at 200 r/min."""
    mean = 20 * 200 / 60
    return [speeds[0] * mean, speeds[1] * mean, mean]


def by_17():
    """Minimum and maximum normal force by the (17) of the paper, N."""
    forces = [tables(theta)[6] for theta in np.arange(0, 360, 0.25)]
    return [min(forces), max(forces)]


def leads():
    """Lead angles of the plain shaft and of the shaft of the sine, slow and fast, deg."""
    return [degrees(atan(s / 15)) for s in (MEAN, SLOW, 2 * MEAN - SLOW)]


BOX = [
    Said("lead angle {} deg all along; {} to {} deg", leads),
    Said("{} to {} mm/s about a mean of {} mm/s", lambda: range_of(sine(1))),
    Said("F_n = {} N, F_oy = {} N; by (15) {} N", lambda: [tables(0)[i] for i in (4, 7, 8)]),
    Said("| {} to {} N; by (17) with our load {} to {} N", lambda: [*sine(1)[2:4], *by_17()]),
    Said(
        "centre distance {} mm, radii from {} to {} mm",
        lambda: [
            values("elliptic-pair-2018")[name] for name in ("center_distance", "driver_radius_min", "driver_radius_max")
        ],
    ),
    Said("| {} to {} mm/s at 200 r/min |", lambda: range_of(elliptic(K))[:2]),
    Said(
        "| {} mm; plain shaft {} mm, so {} mm less |",
        lambda: [elliptic_moved(K), MEAN * WINDOW, MEAN * WINDOW - elliptic_moved(K)],
    ),
    Said("By (9), k = {} gives {} mm", lambda: [K, elliptic_moved(K)]),
    Said(
        "needs k = {} or a window of {} deg, and",
        lambda: [eccentricity(2.1), degrees(brentq(lambda window: elliptic_moved(K, window) - 2.1, 1, 2))],
    ),
    Said("2.05 mm needs k = {}.", lambda: eccentricity(2.05)),
    Said("the speeds are {} and {} times the mean", lambda: elliptic(K)[:2]),
    Said("so only the factor of {} holds", lambda: elliptic(K)[1] / elliptic(K)[0]),
    Said("With 15 deg the plain shaft moves {} mm", lambda: MEAN * radians(15)),
]

# The feeder


def joints():
    """The joints B and C at 200 degrees, mm."""
    return [float(one) for joint in design("feeder-2022").six_bar.position(radians(200))[:2] for one in joint]


def rocker_of_other_branch():
    """The rocker's angle on the branch of (4) at 200 degrees: by (5) as printed, and as it is, deg."""
    crank, coupler, rocker, frame = design("feeder-2022").six_bar.lengths
    lower = ct.SixBar(
        **{"crank": crank, "coupler": coupler, "rocker": rocker, "frame": frame},
        **{"pivot": design("feeder-2022").six_bar.pivot, "effector_length": 200, "branch": "lower"},
    )
    x, y = lower.position(radians(200))[1]
    return [degrees(atan(y / rocker)), degrees(atan2(y, x - frame))]


def dead():
    """Turns of the crank at the dead centres, deg."""
    stretched, folded = dead_centers(design("feeder-2022").six_bar.lengths)
    return [degrees(atan2(*stretched[::-1])), degrees(atan2(*-folded[::-1])) % 360]


def course_of_tip():
    """Where the tip's feed begins and ends, mm, times of feed, return and rest, s, and both maximum speeds, mm/s."""
    feeder, names = design("feeder-2022"), ("feed_time", "return_time", "dwell_time")
    begin, end = feeder.tip(0.0), feeder.tip(feeder.strokes[0])
    figures = values("feeder-2022")
    peaks = [figures[f"tip_speed_{way}_max"] for way in ("feed", "return")]
    return [*begin, *end, *(figures[name] for name in names), *peaks]


def transmission():
    """Transmission angle of the published lengths, deg."""
    return least_transmission(design("feeder-2022").six_bar.lengths)


FEEDER = [
    Said("6 links: {}, {}, {} and {} mm", lambda: design("feeder-2022").six_bar.lengths),
    Said("at 200 deg B ({}, {}) mm, C ({}, {}) mm", joints),
    Said(
        "dead centres at {} and {} deg; swing {} deg",
        lambda: [*dead(), swing(design("feeder-2022").six_bar.lengths, design("feeder-2022").six_bar.pivot)],
    ),
    Said("| {} deg; within (18) no more than {} deg", lambda: [transmission(), least_transmission(best_in_bounds())]),
    Said(
        "from ({}, {}) to ({}, {}) mm in {} s, back in {} s, rest {} s; peaks of {} and {} mm/s",
        course_of_tip,
    ),
    Said("| {} r/min and {} cuttings per minute |", rates),
    Said("the mean is {} |", lambda: (82 + 86 + 80) / 3),
    Said("except for rounding (below {<} mm/s)", lambda: values("feeder-2022")["tip_speed_ends_max"]),
    Said("it gives {} deg, where the rocker is at {} deg", rocker_of_other_branch),
    Said("the optimum has {} deg, not", transmission),
    Said("The mean of Table 1 is {}, printed as 83, and {} cuttings", lambda: [(82 + 86 + 80) / 3, rates()[1]]),
]

PAGES = {
    "docs/papers.md": [
        Said(
            "Of {} figures and {} tables, {} agree and {} are reproduced without a number to compare. {} are reproduced"
            " in part, {} is given, {} differ, and {} are not reproduced.",
            counts,
        ),
        *THREE_ARM,
        *BOX,
        *FEEDER,
    ],
}
