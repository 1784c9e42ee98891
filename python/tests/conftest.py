"""The published elliptic pair, made once."""

import threading
import time
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


@pytest.fixture
def turns_meanwhile():
    """Counts how often another thread has its turn during a call: with the lock held throughout, once at most."""

    def turns(call):
        begun, done, count = threading.Event(), threading.Event(), 0

        def take_turns():
            nonlocal count
            while not done.is_set():
                begun.set()
                count += 1
                time.sleep(1e-4)

        thread = threading.Thread(target=take_turns)
        thread.start()
        begun.wait()
        count = 0
        call()
        done.set()
        thread.join()
        return count

    return turns
