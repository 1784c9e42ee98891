#!/usr/bin/env python3
"""Plays machine.urdf in PyBullet by the laws of motion.csv.

python play_pybullet.py                  until the window is closed
python play_pybullet.py --check          no window: one turn, prints how far the tips are off their path

Needs: pip install pybullet numpy

By the laws only: Bullet rounds every convex body by a margin of 1 mm, and teeth that thick do not mesh.
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


class Machine:
    """The loaded machine with the laws of its joints."""

    def __init__(self):
        """Loads the machine at the start of its laws."""
        self.body = pybullet.loadURDF(str(FOLDER / "machine.urdf"), useFixedBase=True)
        known = [pybullet.getJointInfo(self.body, i) for i in range(pybullet.getNumJoints(self.body))]
        self.joints = {one[1].decode(): one[0] for one in known}
        self.links = {one[12].decode(): one[0] for one in known}
        self.law = Law(FOLDER)
        self.about = json.loads((FOLDER / "motion.json").read_text())
        self.place(0.0)

    def place(self, travel):
        """Puts every joint where its law has it."""
        for name in self.law.joints:
            pybullet.resetJointState(self.body, self.joints[name], self.law(name, travel))

    def tip(self, arm):
        """Where the tip of an arm is, m."""
        state = pybullet.getLinkState(self.body, self.links[f"arm_{arm}"], computeForwardKinematics=True)
        local = [1e-3 * x for x in (*self.about["tip_in_arm_mm"], 0.0)]
        return pybullet.multiplyTransforms(state[4], state[5], local, (0, 0, 0, 1))[0][:2]


def check(machine):
    """Prints the greatest distance of a tip from the path in motion.csv over one turn."""
    table = np.genfromtxt(FOLDER / "motion.csv", delimiter=",", names=True)
    off = 0.0
    for row in table:
        machine.place(row["carrier_turn_rad"])
        for arm in range(machine.about["arms"]):
            path = np.array([row[f"tip_{arm}_x_mm"], row[f"tip_{arm}_y_mm"]]) * 1e-3
            off = max(off, float(np.linalg.norm(machine.tip(arm) - path)))
    print(json.dumps({"mode": "law", "rows": len(table), "tip_off_max_m": off}))


def main():
    """Loads the machine and plays it."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--speed", type=float, default=0.0, help="carrier's speed, rad/s (the design's)")
    parser.add_argument("--check", action="store_true", help="no window: print the error as one line of JSON")
    options = parser.parse_args()
    pybullet.connect(pybullet.DIRECT if options.check else pybullet.GUI)
    machine = Machine()
    if options.check:
        check(machine)
        return
    speed = options.speed or machine.about["carrier_speed_rad_per_s"]
    start = time.monotonic()
    while pybullet.isConnected():
        machine.place(speed * (time.monotonic() - start))
        time.sleep(0.01)


if __name__ == "__main__":
    main()
