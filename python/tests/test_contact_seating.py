"""Gears seated by the contact analysis, held against polygons by GEOS, which shares nothing with it."""

import importlib.util
import sys
from pathlib import Path

import centrode as ct
import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]


def load_campaign():
    path = ROOT / "tests" / "campaigns" / "contact_seating.py"
    spec = importlib.util.spec_from_file_location("contact_seating", path)
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


campaign = load_campaign()


def rest(polygons, phi, psi, sense):
    """Driven angle at which the polygons come to rest when turned from a free one, rad."""
    free, stopped = psi, psi + 4e-3 * sense
    assert polygons.depth(phi, free) == 0
    assert polygons.depth(phi, stopped) > 0
    for _ in range(40):
        middle = (free + stopped) / 2
        if polygons.depth(phi, middle) > 0:
            stopped = middle
        else:
            free = middle
    return free


@pytest.mark.campaign
def test_edges_and_trimmed_teeth_seat_as_their_polygons_do():
    pair = ct.load(ROOT / "tests" / "designs" / "transplanter-pair-2021.toml")
    inputs = np.append(np.linspace(3.82, 3.98, 33), [3.876, 3.880, 3.888, 3.900, 3.5343])
    contact, polygons = pair.contact(inputs=inputs), campaign.Polygons(pair)
    middle = 0.5 * (contact.driven_angle + contact.reverse_driven_angle)
    for phi, psi, on, back in zip(inputs, middle, contact.driven_angle, contact.reverse_driven_angle, strict=True):
        # Two chord errors of 10 nm at a lever of 40 mm or more.
        assert on == pytest.approx(rest(polygons, phi, psi, -1), abs=2e-6)
        assert back == pytest.approx(rest(polygons, phi, psi, 1), abs=2e-6)


@pytest.mark.parametrize("number", [11, 16, 31, 42, 50])
def test_random_pairs_rest_where_they_touch(number):
    pair, words = campaign.draw(1, number)
    outcome = campaign.examine(pair, number, words, 60, seed=1)
    assert outcome.seats > 0
    assert outcome.failures == []


def test_the_search_ends_where_a_contour_turns_about_the_other_axis():
    pair, _ = campaign.draw(1, 421)
    contact = pair.contact(inputs=[5.977699264169549])
    assert contact.backlash[0] == pytest.approx(contact.reverse_driven_angle[0] - contact.driven_angle[0], abs=1e-12)
    assert np.isfinite(contact.backlash[0])


def test_teeth_that_lie_deep_in_each_other_have_no_play():
    for number, phi in [(797, 0.3), (813, 5.1), (854, 4.8)]:
        pair, _ = campaign.draw(1, number)
        contact = pair.contact(inputs=[phi])
        assert (contact.backlash < 0).all()
        assert (contact.penetration > 1).all()
