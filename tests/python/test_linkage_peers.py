"""Holds the six-bar against pylinkage, on random lengths and both branches."""

import centrode as ct
import numpy as np
import pytest
from pylinkage.actuators import Crank
from pylinkage.components import Ground
from pylinkage.dyads import FixedDyad, RRRDyad
from pylinkage.simulation import Linkage

STEPS = 360


def crank_rockers(count):
    """Lengths of crank-rockers well away from their change points, a pivot off the slider's path, and a branch."""
    random = np.random.default_rng(6)
    found = []
    while len(found) < count:
        a, (b, c, d) = random.uniform(20, 60), random.uniform(65, 200, 3)
        pivot = random.uniform(-100, 250, 2)
        if a + max(b, c, d) + 5 > b + c + d - max(b, c, d) or abs(np.hypot(pivot[0] - d, pivot[1]) - c) < 10:
            continue
        found.append((a, b, c, d, pivot, ("upper", "lower")[len(found) % 2]))
    return found


def trajectory(a, b, c, d, pivot, branch):
    """B, C and E over a turn by pylinkage."""
    at_a, at_d, at_f = Ground(0.0, 0.0), Ground(d, 0.0), Ground(*pivot)
    crank = Crank(at_a, a, 2 * np.pi / STEPS)
    # Its own rule for the branch is to stay near: the first place is told.
    side = 1 if branch == "upper" else -1
    along = (b**2 - c**2 + (d - a) ** 2) / (2 * (d - a))
    first = (a + along, side * np.sqrt(b**2 - along**2)) if d > a else (a + along, -side * np.sqrt(b**2 - along**2))
    joint = RRRDyad(crank.output, at_d, b, c, *first)
    tip = FixedDyad(at_f, joint, 200.0, 0.0)
    linkage = Linkage([at_a, at_d, at_f, crank, joint, tip])
    return linkage.step_fast(iterations=STEPS)[:, 3:]


@pytest.mark.parametrize("case", crank_rockers(20), ids=range(20))
def test_positions_are_those_of_pylinkage(case):
    a, b, c, d, pivot, branch = case
    theirs = trajectory(*case)
    phi = np.arctan2(theirs[:, 0, 1], theirs[:, 0, 0])
    six = ct.SixBar(crank=a, coupler=b, rocker=c, frame=d, pivot=tuple(pivot), effector_length=200, branch=branch)
    np.testing.assert_allclose(six.position(phi), theirs, atol=1e-9)
