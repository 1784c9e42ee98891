#!/usr/bin/env python3
"""Plays pair.xml in MuJoCo by the law of motion.csv, or through tooth contact alone.

python play_mujoco.py                    both joints follow the law
python play_mujoco.py --contact          the driver turns evenly, the teeth carry the driven gear
python play_mujoco.py --check            no window: prints how far the driven joint is off the law

Needs: pip install mujoco numpy
"""

import argparse
import json
import time
from pathlib import Path

import mujoco
import numpy as np

# isort: split
from law import Law

FOLDER = Path(__file__).resolve().parent


class Pair:
    """The model with what plays it."""

    def __init__(self, options):
        """Loads the model at the start of the law."""
        self.model = mujoco.MjModel.from_xml_path(str(FOLDER / "pair.xml"))
        self.data = mujoco.MjData(self.model)
        self.law = Law(FOLDER)
        self.speed = -options.speed if options.backward else options.speed
        self.contact = options.contact
        self.driver, self.driven = (self.model.joint(name) for name in ("driver_joint", "driven_joint"))
        if self.contact:
            # Only the teeth may tie the gears: no equality, and a driver too heavy to be held up.
            self.data.eq_active[:] = 0
            self.model.dof_armature[self.driver.dofadr] = 1e3
            sense = np.sign(self.law("driven_joint", self.speed))
            self.data.qfrc_applied[self.driven.dofadr] = -sense * options.load
            step = self.model.opt.timestep
            for joint in self.law.joints:
                ahead = self.law(joint, self.speed * step) - self.law(joint, -self.speed * step)
                self.data.qvel[self.model.joint(joint).dofadr] = ahead / (2 * step)
        self.place(0.0)

    def place(self, travel):
        """Puts both joints where the law has them."""
        for name in self.law.joints:
            self.data.qpos[self.model.joint(name).qposadr] = self.law(name, travel)
        mujoco.mj_forward(self.model, self.data)

    def advance(self):
        """Goes on by one time step."""
        if self.contact:
            mujoco.mj_step(self.model, self.data)
        else:
            self.data.time += self.model.opt.timestep
            self.place(self.speed * self.data.time)

    def off(self):
        """How far the driven joint is off the law, rad: positive if it has turned too far."""
        travel = -self.data.qpos[self.driver.qposadr[0]]
        return self.data.qpos[self.driven.qposadr[0]] - self.law("driven_joint", travel)

    def overlap(self):
        """Depth of the deepest contact between teeth, mm."""
        return 1e3 * max(0.0, *(-self.data.contact.dist), 0.0)


def check(pair, turns):
    """Prints the greatest error of the driven joint and the deepest overlap of teeth."""
    travel = 2 * np.pi * turns
    if not pair.contact:
        pair.model.opt.timestep = travel / (1440 * turns) / abs(pair.speed)
    steps = round(travel / abs(pair.speed) / pair.model.opt.timestep)
    # With contact, the load first takes up the backlash: the teeth are judged after a twentieth of a turn.
    before = round(steps / turns / 20) if pair.contact else 0
    off, overlap = [], 0.0
    for step in range(before + steps):
        pair.advance()
        if step >= before:
            off.append(pair.off())
            overlap = max(overlap, pair.overlap())
    low, high = np.degrees([min(off), max(off)])
    result = {
        "mode": "contact" if pair.contact else "law",
        "turns": turns * np.sign(pair.speed),
        "off_law_max_deg": max(abs(low), abs(high)),
        "off_law_range_deg": high - low,
        "overlap_max_mm": overlap,
    }
    print(json.dumps(result))


def show(pair):
    """Plays in a window, in real time, until it is closed."""
    from mujoco import viewer

    with viewer.launch_passive(pair.model, pair.data) as window:
        start = time.monotonic()
        while window.is_running():
            while pair.data.time < time.monotonic() - start:
                pair.advance()
            window.sync()
            time.sleep(0.005)


def main():
    """Reads the arguments and plays."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--contact", action="store_true", help="drive the driven gear by its teeth alone")
    parser.add_argument("--backward", action="store_true", help="turn the other way")
    parser.add_argument("--speed", type=float, default=2.0, help="driver's speed, rad/s (2)")
    parser.add_argument("--load", type=float, default=0.01, help="torque against the driven gear with --contact, N m")
    parser.add_argument("--check", action="store_true", help="no window: print the error as one line of JSON")
    parser.add_argument("--turns", type=int, default=2, help="turns of the driver with --check (2)")
    options = parser.parse_args()
    if options.speed <= 0 or options.turns < 1:
        parser.error("--speed and --turns must be positive")
    pair = Pair(options)
    if options.check:
        check(pair, options.turns)
    else:
        show(pair)


if __name__ == "__main__":
    main()
