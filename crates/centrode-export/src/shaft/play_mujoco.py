#!/usr/bin/env python3
"""Plays machine.xml in MuJoCo by the law of motion.csv, by forces alone, or through the teeth of its gears.

python play_mujoco.py                    every joint follows the law
python play_mujoco.py --drive            forces move the joints, found from the law by inverse dynamics
python play_mujoco.py --contact          the driver turns evenly, the teeth turn the shaft against its load
python play_mujoco.py --check            no window: prints how far the box is off the law

Needs: pip install mujoco numpy
"""

import argparse
import json
import time
from pathlib import Path

import mujoco
import numpy as np

FOLDER = Path(__file__).resolve().parent


class Law:
    """Places of the joints over time, as motion.json describes motion.csv."""

    def __init__(self, folder):
        """Reads both files."""
        self.about = json.loads((folder / "motion.json").read_text())
        self.table = np.genfromtxt(folder / self.about["table"], delimiter=",", names=True)
        self.joints = {joint["name"]: joint for joint in self.about["joints"]}
        self.period = self.about["continuation"]["time_s"]
        self.step = self.period / (self.about["rows"] - 1)

    def read(self, column, speed, when):
        """A column at a time by cubic Hermite, and how fast it changes; repeated beyond the table."""
        whole, rest = divmod(when, self.period)
        row = min(int(rest / self.step), self.about["rows"] - 2)
        x, h = rest / self.step - row, self.step
        a, b = self.table[column][row : row + 2]
        va, vb = np.broadcast_to(self.table[speed] if isinstance(speed, str) else speed, len(self.table))[row : row + 2]
        value = (1 + 2 * x) * (1 - x) ** 2 * a + x * x * (3 - 2 * x) * b
        value += h * (x * (1 - x) ** 2 * va - x * x * (1 - x) * vb)
        rate = 6 * x * (1 - x) * (b - a) / h + (1 - x) * (1 - 3 * x) * va + x * (3 * x - 2) * vb
        return value + whole * self.about["continuation"].get(column, 0.0), rate

    def __call__(self, name, when):
        """Place and speed of a joint, metres or radians."""
        joint = self.joints[name]
        value, rate = self.read(joint["column"], joint["speed"], when)
        return joint["factor"] * value + joint["offset"], joint["factor"] * rate

    def at_shaft(self, column, turned):
        """A column at a shaft angle, linear between rows."""
        angles = self.table["shaft_angle_rad"]
        # A whole cycle from the first row on; numpy's own period sorts the table at every call.
        turned = angles[0] + (turned - angles[0]) % self.about["continuation"]["shaft_angle_rad"]
        return np.interp(turned, angles, self.table[column])


class Machine:
    """The model with what plays it."""

    def __init__(self, options):
        """Loads the model at the start of the law."""
        self.model = mujoco.MjModel.from_xml_path(str(FOLDER / "machine.xml"))
        self.data = mujoco.MjData(self.model)
        self.law = Law(FOLDER)
        self.mode = "contact" if options.contact else "drive" if options.drive else "law"
        self.joints = {name: self.model.joint(name) for name in self.law.joints}
        self.push = 0.0
        if self.mode == "contact" and "driver_joint" not in self.joints:
            raise SystemExit("--contact is for machines with gears")
        if self.mode == "contact":
            # Fine steps for teeth at this speed, and a driver too heavy to be held up.
            self.model.opt.timestep = 5e-5
            self.model.dof_armature[self.joints["driver_joint"].dofadr] = 1e3
        else:
            # Bodies that are moved by their law need not touch.
            self.model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT
        for name, joint in self.joints.items():
            place, speed = self.law(name, 0.0)
            self.data.qpos[joint.qposadr], self.data.qvel[joint.dofadr] = place, speed
        mujoco.mj_forward(self.model, self.data)

    def follow(self, names, when):
        """Puts joints where the law has them."""
        for name in names:
            place, speed = self.law(name, when)
            self.data.qpos[self.joints[name].qposadr], self.data.qvel[self.joints[name].dofadr] = place, speed

    def advance(self):
        """Goes on by one time step."""
        step = self.model.opt.timestep
        if self.mode == "law":
            self.data.time += step
            self.follow(self.joints, self.data.time)
            mujoco.mj_forward(self.model, self.data)
        elif self.mode == "drive":
            self.drive(step)
        else:
            turned = self.turned()
            # The shaft turns backwards: its load pulls forwards.
            load = 1e-3 * self.law.at_shaft("shaft_torque_Nmm", turned)
            self.data.qfrc_applied[self.joints["shaft_joint"].dofadr] = load
            mujoco.mj_step(self.model, self.data)
            for name in ("box_joint", "slider_joint"):
                joint = self.law.joints[name]
                place = joint["factor"] * self.law.at_shaft(joint["column"], self.turned()) + joint["offset"]
                self.data.qpos[self.joints[name].qposadr] = place
                self.data.qvel[self.joints[name].dofadr] = 0.0

    def turned(self):
        """Angle of the shaft by its own law, rad."""
        joint = self.law.joints["shaft_joint"]
        return (self.data.qpos[self.joints["shaft_joint"].qposadr[0]] - joint["offset"]) / joint["factor"]

    def drive(self, step):
        """One step by the forces that bring every joint to where the law has it at its end."""
        for name, joint in self.joints.items():
            place, _ = self.law(name, self.data.time + step)
            off = place - self.data.qpos[joint.qposadr[0]]
            self.data.qacc[joint.dofadr] = (off / step - self.data.qvel[joint.dofadr[0]]) / step
        mujoco.mj_inverse(self.model, self.data)
        self.data.qfrc_applied[:] = self.data.qfrc_inverse
        self.push = self.data.qfrc_inverse[self.joints["box_joint"].dofadr[0]]
        mujoco.mj_step(self.model, self.data)

    def off(self):
        """How far the box is off the law, mm."""
        place, _ = self.law("box_joint", self.data.time)
        return 1e3 * abs(self.data.qpos[self.joints["box_joint"].qposadr[0]] - place)


def check(machine, cycles):
    """Prints the greatest error of the box over whole ways out and back."""
    off, pushes = 0.0, [0.0]
    steps = round(cycles * machine.law.period / machine.model.opt.timestep)
    for _ in range(steps):
        machine.advance()
        off = max(off, machine.off())
        pushes.append(machine.push)
    result = {"mode": machine.mode, "cycles": cycles, "off_law_max_mm": off, "seconds": machine.data.time}
    if machine.mode == "drive":
        result |= {"push_min_N": min(pushes), "push_max_N": max(pushes)}
    print(json.dumps(result))


def show(machine):
    """Plays in a window, in real time, until it is closed."""
    from mujoco import viewer

    with viewer.launch_passive(machine.model, machine.data) as window:
        start = time.monotonic()
        while window.is_running():
            while machine.data.time < time.monotonic() - start:
                machine.advance()
            window.sync()
            time.sleep(0.005)


def main():
    """Reads the arguments and plays."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--drive", action="store_true", help="move the joints by forces")
    parser.add_argument("--contact", action="store_true", help="turn the shaft by the teeth of its gears alone")
    parser.add_argument("--check", action="store_true", help="no window: print the error as one line of JSON")
    parser.add_argument("--cycles", type=int, default=1, help="ways out and back with --check (1)")
    options = parser.parse_args()
    if options.cycles < 1:
        parser.error("--cycles must be positive")
    machine = Machine(options)
    if options.check:
        check(machine, options.cycles)
    else:
        show(machine)


if __name__ == "__main__":
    main()
