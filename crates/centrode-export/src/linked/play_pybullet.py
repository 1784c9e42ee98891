#!/usr/bin/env python3
"""Plays machine.urdf in PyBullet by the laws of motion.csv.

python play_pybullet.py                  until the window is closed
python play_pybullet.py --check          no window: one cycle, prints how far joints and points are off the table

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
        self.law = Law(FOLDER)
        self.body = pybullet.loadURDF(str(FOLDER / self.law.about["models"][0]), useFixedBase=True)
        known = [pybullet.getJointInfo(self.body, i) for i in range(pybullet.getNumJoints(self.body))]
        self.joints = {one[1].decode(): one[0] for one in known}
        self.links = {one[12].decode(): one[0] for one in known}
        self.place(0.0)

    def place(self, travel):
        """Puts every joint where its law has it."""
        for name in self.law.joints:
            pybullet.resetJointState(self.body, self.joints[name], self.law(name, travel))

    def off(self, travel):
        """How far the joints, placed by their laws, are off the row of the table there, rad or m."""
        found = {name: pybullet.getJointState(self.body, self.joints[name])[0] for name in self.law.joints}
        return max(abs(position - self.law.row_of(name, travel)) for name, position in found.items())

    def point(self, point, travel):
        """Where a point of a link is at a travel, m."""
        self.place(travel)
        state = pybullet.getLinkState(self.body, self.links[point["link"]], computeForwardKinematics=True)
        local = [1e-3 * x for x in point["at_mm"]]
        return np.array(pybullet.multiplyTransforms(state[4], state[5], local, (0, 0, 0, 1))[0])


def check(machine):
    """Prints the greatest distance of joints and points from the table over one cycle."""
    off = 0.0
    for travel in machine.law.table[machine.law.about["input"]["column"]]:
        machine.place(travel)
        off = max(off, machine.off(travel))
    result = {"mode": "law", "rows": machine.law.about["rows"], "joint_off_max": off}
    result["point_off_max_m"] = machine.law.check(machine.point)
    print(json.dumps(result))


def main():
    """Loads the machine and plays it."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--speed", type=float, help="speed of the input, rad/s (the design's)")
    parser.add_argument("--check", action="store_true", help="no window: print the errors as one line of JSON")
    options = parser.parse_args()
    if options.speed is not None and options.speed <= 0:
        parser.error("--speed must be positive")
    pybullet.connect(pybullet.DIRECT if options.check else pybullet.GUI)
    machine = Machine()
    if options.check:
        check(machine)
        return
    speed = options.speed or machine.law.speed
    start = time.monotonic()
    while pybullet.isConnected():
        machine.place(speed * (time.monotonic() - start))
        time.sleep(0.01)


if __name__ == "__main__":
    main()
