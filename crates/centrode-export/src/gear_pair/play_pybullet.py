#!/usr/bin/env python3
"""Plays pair.urdf in PyBullet by the law of motion.csv.

python play_pybullet.py                  until the window is closed
python play_pybullet.py --check          no window: one turn, prints how far the driven joint is off the law

Needs: pip install pybullet numpy

By the law only: Bullet rounds every convex body by a margin of 1 mm, and teeth that thick do not mesh.
"""

import argparse
import json
import time
from pathlib import Path

import numpy as np
import pybullet

# isort: split
from law import Law

FOLDER = Path(__file__).resolve().parent


def place(pair, indices, law, travel):
    """Puts both joints where the law has them."""
    for name in law.joints:
        pybullet.resetJointState(pair, indices[name], law(name, travel))


def main():
    """Loads the pair and plays it."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--speed", type=float, default=2.0, help="driver's speed, rad/s (2)")
    parser.add_argument("--check", action="store_true", help="no window: print the error as one line of JSON")
    options = parser.parse_args()
    pybullet.connect(pybullet.DIRECT if options.check else pybullet.GUI)
    pair = pybullet.loadURDF(str(FOLDER / "pair.urdf"), useFixedBase=True)
    count = pybullet.getNumJoints(pair)
    indices = {pybullet.getJointInfo(pair, i)[1].decode(): i for i in range(count)}
    law = Law(FOLDER)
    if options.check:
        off = 0.0
        for travel in np.linspace(0, 2 * np.pi, 361):
            place(pair, indices, law, travel)
            driver, driven = (
                pybullet.getJointState(pair, indices[name])[0] for name in ("driver_joint", "driven_joint")
            )
            off = max(off, abs(driven - law("driven_joint", -driver)))
        print(json.dumps({"mode": "law", "off_law_max_deg": np.degrees(off)}))
        return
    start = time.monotonic()
    while pybullet.isConnected():
        place(pair, indices, law, options.speed * (time.monotonic() - start))
        time.sleep(0.01)


if __name__ == "__main__":
    main()
