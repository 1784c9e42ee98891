"""Figures of all other pages, each computed anew."""

import json
import tempfile
from functools import cache
from itertools import pairwise
from math import degrees, pi, sqrt
from pathlib import Path

import centrode as ct
import numpy as np
import tomllib
from conftest import ROOT
from figures import Said
from figures_machines import TAU, design, least_transmission, values
from scipy.special import ellipe

DESIGNS = ROOT / "tests" / "designs"
K = 1 / (2 + sqrt(3))


def ellipse():
    """Centre distance, the sum of the distances from both foci, and perimeter of the published ellipse, mm."""
    perimeter = pi * 2.25 * 23
    return [2 * perimeter / (4 * ellipe(K**2)), perimeter]


def error():
    """Transmission error of the published pair, rad."""
    return values("elliptic-pair-2018")["transmission_error_max"]


@cache
def proof(name):
    """Size of the certificate of a pair, MB, its sectors and stretches; how far the law in pieces is off."""
    with tempfile.TemporaryDirectory() as folder:
        file = design(name).prove(Path(folder) / "pair.proof")
        found = json.loads(file.read_text())
        figures = [file.stat().st_size / 1e6, found["sectors"], len(found["stretches"])]
        return figures, law_error(found["law"], design(name))


def law_error(law, pair):
    """Maximum distance of the pieces of a law in a certificate from the law of the pair, rad."""
    places, errors = np.linspace(-1, 1, 17), []
    for (low, high), series in zip(pairwise(law["ends"]), law["pieces"], strict=True):
        phi = (low + high) / 2 + places * (high - low) / 2
        angle = phi * (law["advance"] / law["period"]) + np.polynomial.chebyshev.chebval(places, series)
        errors.append(np.abs(angle - pair.driven_angle(phi)).max())
    return max(errors)


PROVED = (
    *("circular-pair", "law-pair", "elliptic-pair-2018", "lobed-pair-3-2", "lobed-pair-2-1", "lobed-pair-5-2"),
    *("quintic-pair", "cubic-pair"),
)


@cache
def lost(name):
    """Driver angle at which the certificate of a strong law ends, rad."""
    laws = tomllib.loads((ROOT / "tests" / "published" / "data" / "strong_laws.toml").read_text())["case"]
    law = next(law for law in laws if law["name"] == name)
    pitch = ct.pitch.polar(law["radius"], module=1, tooth_count=law["teeth"])
    try:
        ct.GearPair(pitch, addendum="fitted").prove("never.proof")
    except ct.GearPairError as fault:
        return float(str(fault).partition("angle ")[2].partition(" rad")[0])
    raise AssertionError(f"{name} has a certificate")


def laws():
    """How many laws the page of strong laws has."""
    return len(tomllib.loads((ROOT / "tests" / "published" / "data" / "strong_laws.toml").read_text())["case"])


def baesel():
    """Centre distance of 14 teeth of module 2 for psi = phi - (2 - sqrt 2) sin phi: the length of r = a i/(1 + i)."""
    phi = np.linspace(0, TAU, 4096, endpoint=False)
    c = 2 - sqrt(2)
    ratio, slope = 1 - c * np.cos(phi), c * np.sin(phi)
    length = TAU * np.hypot(ratio / (1 + ratio), slope / (1 + ratio) ** 2).mean()
    return pi * 2 * 14 / length


def remedy():
    """Minimum counts of fitted teeth that transmit 1 + 0.45 cos 2 phi, as they are and with a choice."""
    law = ct.pitch.from_ratio("1 + 0.45*cos(2*phi)", module=2, tooth_count=24)
    return [found.minimum_tooth_count for found in ct.GearPair(law, addendum="fitted").remedies()]


def press():
    """Dead centres of the press, deg, what lies between them either way, and the quick return."""
    table = next(table for table in design("press").check().tables if table.name == "dead-centres")
    first, second = map(degrees, table.rows["ram"])
    return [first, second, second - first, 360 - second + first, (second - first) / (360 - second + first)]


def template_ratio():
    """Minimum and maximum ratio of the template's ellipse."""
    return [(1 - 0.25) / (1 + 0.25), (1 + 0.25) / (1 - 0.25)]


def edges():
    """Edges of both gears of the published pair, bores and all."""
    pair = design("elliptic-pair-2018")
    return sum(len(contour) for gear in (pair.driver, pair.driven) for contour in gear.solid().contours)


def parts():
    """Parts of all shipped designs that are solids, the grooved shafts among them, and the designs."""
    machines = [ct.load(file) for file in DESIGNS.glob("*.toml")]
    return [sum(len(one.solids()) + isinstance(one, ct.BoxDrive) for one in machines), len(machines)]


def python():
    """The oldest Python that the package takes."""
    project = tomllib.loads((ROOT / "python" / "pyproject.toml").read_text())["project"]
    return float(project["requires-python"].removeprefix(">="))


PAGES = {
    "README.md": [
        Said("The 2018 elliptic pair (k = {}, m = 2.25 mm", lambda: K),
        Said("both flanks | {} rad, without backlash and with 0.05 mm of it", error),
        Said("as an independent computation: {} mm, {} mm", ellipse),
    ],
    "docs/measured.md": [
        Said("The pair of 2018: k = {}, m = 2.25 mm", lambda: K),
        Said("both flanks | {} rad |", error),
        Said("every digit of an independent computation: {} mm, {} mm |", ellipse),
        Said("| teeth on {} strong laws |", laws),
    ],
    "docs/proof.md": [
        *(Said(f"| `{name}`... s | {{}} MB | {{}} | {{}} |", lambda name=name: proof(name)[0]) for name in PROVED),
        Said("at most {<} rad in the shipped pairs", lambda: max(proof(name)[1] for name in PROVED)),
        Said("Of the {} laws", laws),
        Said("the holding features cannot be followed at {} rad", lambda: lost("limit_five_lobe_deep")),
    ],
    "docs/strong-laws.md": [
        Said(
            "cos 2 phi: fitted teeth work with {}, full ones at none of the counts."
            " With optimised thickness, pressure angle (23 degrees) and phase, {} are",
            remedy,
        ),
        Said("distance {} mm, and of the {} flanks", lambda: [baesel(), 2 * 14]),
    ],
    "docs/adapters.md": [
        Said("| {} parts of the {} shipped designs |", parts),
        Said("2018 pair to solids, {} edges", edges),
    ],
    "docs/install.md": [Said("Python {} or newer", python)],
    "docs/limits.md": [Said("Design files up to {} MiB", lambda: ct._centrode._LARGEST_DESIGN / 2**20)],
    "docs/theory/feeder.md": [
        Said("published lengths have {} degrees", lambda: least_transmission(design("feeder-2022").six_bar.lengths)),
        Said(
            "the ratio is {}/{}, and without entry the rest would be {} degrees",
            lambda: [40 / 10, 30 / 10, 360 * (1 - 30 / 40)],
        ),
    ],
    "docs/how-to/shop.md": [
        Said(
            "with a radius of 1/{} = {} mm",
            lambda: [
                -values("transplanter-pair-2021")["driver_curvature_min"],
                -1 / values("transplanter-pair-2021")["driver_curvature_min"],
            ],
        ),
    ],
    "docs/tutorial/1-laser.md": [Said("turns {} to {} times as fast", template_ratio)],
    "docs/tutorial/3-transplanter.md": [
        Said(
            "requires, {} flanks cannot",
            lambda: next(goal.value for goal in design("three-arm-2021").check().goals if goal.name == "sound-teeth"),
        ),
    ],
    "docs/tutorial/4-compose.md": [
        Said("at {} and {} degrees of the input", lambda: press()[:2]),
        Said("one stroke takes {} degrees and the return {}: a quick return of {} to 1", lambda: press()[2:]),
    ],
}
