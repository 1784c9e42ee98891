#!/usr/bin/env python3
"""Plays feeder.xml in MuJoCo: the crank follows motion.csv, the closed loops carry the rest.

python play_mujoco.py                    in a window
python play_mujoco.py --check            no window: prints how far the joints are off motion.csv

Needs: pip install mujoco numpy
"""

import argparse
import json
import time
from pathlib import Path

import mujoco
import numpy as np

FOLDER = Path(__file__).resolve().parent


class Feeder:
    """The model with what plays it."""

    def __init__(self, speed):
        """Loads the model at rest."""
        self.model = mujoco.MjModel.from_xml_path(str(FOLDER / "feeder.xml"))
        self.data = mujoco.MjData(self.model)
        self.about = json.loads((FOLDER / "motion.json").read_text())
        table = np.genfromtxt(FOLDER / "motion.csv", delimiter=",", names=True)
        self.columns = {j["name"]: j["factor"] * table[j["column"]] for j in self.about["joints"]}
        self.speed = speed or self.about["speed_rad_per_s"]
        self.crank = self.model.joint("crank_joint")
        # A crank too heavy to be held up by what it carries.
        self.model.dof_armature[self.crank.dofadr] = 1e3
        mujoco.mj_forward(self.model, self.data)

    def law(self, joint, travel):
        """The position motion.csv has for a joint, rad or m."""
        column = self.columns[joint]
        count, rise = len(column) - 1, column[-1] - column[0]
        place = travel / (2 * np.pi) * count
        row = int(place // 1)
        s = place - row
        # A cubic through four rows: straight lines between them are off by more than the model is.
        cubic = (
            s * (s - 1) * (2 - s) / 6,
            (s + 1) * (s - 1) * (s - 2) / 2,
            (s + 1) * s * (2 - s) / 2,
            (s + 1) * s * (s - 1) / 6,
        )
        position = 0.0
        for at, weight in enumerate(cubic, row - 1):
            turns, at = divmod(at, count)
            position += weight * (column[at] + turns * rise)
        return position

    def advance(self):
        """Goes on by one time step."""
        step = self.model.opt.timestep
        now, then = (self.law("crank_joint", self.speed * t) for t in (self.data.time, self.data.time + step))
        self.data.qpos[self.crank.qposadr] = now
        self.data.qvel[self.crank.dofadr] = (then - now) / step
        mujoco.mj_step(self.model, self.data)

    def off(self):
        """How far each joint is off motion.csv where the crank is now, rad or m."""
        travel = self.speed * self.data.time
        return {
            name: self.data.qpos[self.model.joint(name).qposadr[0]] - self.law(name, travel) for name in self.columns
        }


def check(feeder):
    """Prints the greatest error of each joint over one cycle."""
    worst = dict.fromkeys(feeder.columns, 0.0)
    while feeder.data.time < 2 * np.pi / feeder.speed:
        feeder.advance()
        for name, off in feeder.off().items():
            worst[name] = max(worst[name], abs(off))
    print(json.dumps({f"{name}_off_max": off for name, off in worst.items()}))


def show(feeder):
    """Plays in a window, in real time, until it is closed."""
    from mujoco import viewer

    with viewer.launch_passive(feeder.model, feeder.data) as window:
        start = time.monotonic()
        while window.is_running():
            while feeder.data.time < time.monotonic() - start:
                feeder.advance()
            window.sync()
            time.sleep(0.005)


def main():
    """Reads the arguments and plays."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--speed", type=float, help="speed of the incomplete gear, rad/s (the design's)")
    parser.add_argument(
        "--check",
        action="store_true",
        help="no window: print the errors as one line of JSON",
    )
    options = parser.parse_args()
    if options.speed is not None and options.speed <= 0:
        parser.error("--speed must be positive")
    feeder = Feeder(options.speed)
    if options.check:
        check(feeder)
    else:
        show(feeder)


if __name__ == "__main__":
    main()
