"""The published elliptic pair, made once."""

from pathlib import Path

import centrode as ct
import pytest
import tomllib

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def case():
    """Figures of the elliptic pair of 2018, from an independent oracle."""
    return tomllib.loads((ROOT / "tests" / "published" / "data" / "elliptic_pair.toml").read_text())["case"][0]


@pytest.fixture(scope="session")
def pair(case):
    pitch = ct.pitch.ellipse(eccentricity=case["eccentricity"], module=case["module"], tooth_count=case["tooth_count"])
    return ct.GearPair(pitch, phase="tooth")


@pytest.fixture(scope="session")
def design():
    """The same pair as a design file."""
    return ROOT / "tests" / "designs" / "elliptic-pair-2018.toml"
