#!/usr/bin/env python3
"""Plays machine.xml in MuJoCo by the laws of motion.csv, or one chain through tooth contact alone.

python play_mujoco.py                    every joint follows its law
python play_mujoco.py --contact          the carrier turns evenly, teeth carry the first chain
python play_mujoco.py --check            no window: prints how far tips or planet are off their law

Needs: pip install mujoco numpy; --plot also matplotlib
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
CHAIN = ("intermediate_0_joint", "planet_0_joint")


class Machine:
    """The model with what plays it."""

    def __init__(self, options):
        """Loads the model at the start of the law."""
        self.model = mujoco.MjModel.from_xml_path(str(FOLDER / "machine.xml"))
        self.data = mujoco.MjData(self.model)
        self.law = Law(FOLDER)
        self.about = json.loads((FOLDER / "motion.json").read_text())
        self.speed = options.speed or self.about["carrier_speed_rad_per_s"]
        self.contact = options.contact
        if self.contact:
            self.alone(options)
        else:
            # Nothing touches where every joint is placed.
            self.model.geom_contype[:] = 0
            self.model.geom_conaffinity[:] = 0
        self.place(0.0)

    def alone(self, options):
        """Leaves the teeth of sun and first chain only, with a load on the planet and a carrier too heavy to stop."""
        model = self.model
        for body in range(model.nbody):
            if model.body(body).name not in ("sun", "intermediate_0", "planet_0"):
                of_body = model.geom_bodyid == body
                model.geom_contype[of_body] = 0
                model.geom_conaffinity[of_body] = 0
        free = [*CHAIN, "carrier_joint"]
        for joint in range(model.njnt):
            name = model.joint(joint).name
            if name not in free:
                # Whatever else could move stays where the carrier takes it.
                model.dof_armature[model.joint(name).dofadr] = 1e6
        model.dof_armature[model.joint("carrier_joint").dofadr] = 1e3
        sense = np.sign(self.law("planet_0_joint", 2 * np.pi) - self.law("planet_0_joint", 0.0))
        self.data.qfrc_applied[model.joint("planet_0_joint").dofadr] = -sense * options.load
        step = model.opt.timestep
        for name in free:
            ahead = self.law(name, self.speed * step) - self.law(name, -self.speed * step)
            self.data.qvel[model.joint(name).dofadr] = ahead / (2 * step)

    def place(self, travel):
        """Puts every joint where its law has it."""
        for name in self.law.joints:
            self.data.qpos[self.model.joint(name).qposadr] = self.law(name, travel)
        mujoco.mj_forward(self.model, self.data)

    def travel(self):
        """Turn of the carrier from its start, rad."""
        turned = self.data.qpos[self.model.joint("carrier_joint").qposadr[0]] - self.law("carrier_joint", 0.0)
        return turned * np.sign(self.law("carrier_joint", 1.0) - self.law("carrier_joint", 0.0))

    def advance(self):
        """Goes on by one time step."""
        if self.contact:
            mujoco.mj_step(self.model, self.data)
        else:
            self.data.time += self.model.opt.timestep
            self.place(self.speed * self.data.time)

    def tip(self, arm):
        """Where the tip of an arm is, m."""
        body = self.data.body(f"arm_{arm}")
        local = np.array([*self.about["tip_in_arm_mm"], 0.0]) * 1e-3
        return (body.xpos + body.xmat.reshape(3, 3) @ local)[:2]

    def off(self):
        """How far the first planet's joint is off its law, rad."""
        joint = self.model.joint("planet_0_joint")
        return self.data.qpos[joint.qposadr[0]] - self.law("planet_0_joint", self.travel())

    def overlap(self):
        """Depth of the deepest contact between teeth, mm."""
        return 1e3 * max(0.0, *(-self.data.contact.dist), 0.0)


def check_law(machine):
    """Prints the greatest distance of a tip from the path in motion.csv over one turn."""
    table = np.genfromtxt(FOLDER / "motion.csv", delimiter=",", names=True)
    off = 0.0
    for row in table:
        machine.place(row["carrier_turn_rad"])
        for arm in range(machine.about["arms"]):
            path = np.array([row[f"tip_{arm}_x_mm"], row[f"tip_{arm}_y_mm"]]) * 1e-3
            off = max(off, float(np.linalg.norm(machine.tip(arm) - path)))
    print(json.dumps({"mode": "law", "rows": len(table), "tip_off_max_m": off}))


def rate(law, joint, travel):
    """Speed of a joint by its law for a radian of the input: exact in the middle between rows, linear from there on."""
    angles, factor, _ = law.joints[joint]
    middle = 0.5 * (law.travel[1:] + law.travel[:-1])
    slope = factor * np.diff(angles) / np.diff(law.travel)
    return np.interp(np.mod(travel, law.travel[-1]), middle, slope, period=law.travel[-1])


def plot(rows, law, speed, path):
    """Draws how far the planet is off its law, and how its speed wavers about it."""
    from matplotlib import pyplot

    travel, off, found = rows.T
    figure, axes = pyplot.subplots(3, 1, sharex=True, figsize=(8.0, 8.0), layout="constrained")
    degrees, wanted = np.degrees(travel), rate(law, "planet_0_joint", travel)
    for ax, values, title in (
        (axes[0], np.degrees(off), "planet less its law, deg"),
        (axes[1], found / speed, "planet's speed over the carrier's"),
        (axes[2], found / speed - wanted, "the same less its law"),
    ):
        ax.plot(degrees, values, linewidth=0.8)
        ax.set_ylabel(title)
    axes[2].set_xlabel("carrier's turn, deg")
    figure.savefig(path, dpi=120)


def check_contact(machine, options):
    """Prints how far the planet is off its law over some turns, driven by teeth alone."""
    turns = options.turns
    steps = round(2 * np.pi * turns / machine.speed / machine.model.opt.timestep)
    # The load first takes up the backlash: the teeth are judged after a twentieth of a turn.
    before = round(steps / turns / 20)
    rows, overlap = [], 0.0
    joint = machine.model.joint("planet_0_joint")
    for step in range(before + steps):
        machine.advance()
        if step >= before:
            rows.append([machine.travel(), machine.off(), machine.data.qvel[joint.dofadr[0]]])
            overlap = max(overlap, machine.overlap())
    rows = np.array(rows)
    low, high = np.degrees([rows[:, 1].min(), rows[:, 1].max()])
    wavers = rows[:, 2] / machine.speed - rate(machine.law, "planet_0_joint", rows[:, 0])
    result = {
        "mode": "contact",
        "turns": turns,
        "off_law_max_deg": max(abs(low), abs(high)),
        "off_law_range_deg": high - low,
        "overlap_max_mm": overlap,
        "speed_off_rms_per_carrier": float(np.sqrt(np.mean(wavers**2))),
        "speed_off_max_per_carrier": float(np.abs(wavers).max()),
    }
    print(json.dumps(result))
    if options.plot:
        plot(rows, machine.law, machine.speed, options.plot)
    if options.save:
        np.savetxt(
            options.save, rows, delimiter=",", header="carrier_turn_rad,off_law_rad,planet_speed_rad_per_s", comments=""
        )


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
    parser.add_argument("--contact", action="store_true", help="drive the first chain by its teeth alone")
    parser.add_argument("--speed", type=float, default=0.0, help="carrier's speed, rad/s (the design's)")
    parser.add_argument("--load", type=float, default=0.02, help="torque against the planet with --contact, N m")
    parser.add_argument("--check", action="store_true", help="no window: print the error as one line of JSON")
    parser.add_argument("--turns", type=int, default=1, help="turns of the carrier with --check --contact (1)")
    parser.add_argument("--plot", help="picture of the motion found with --check --contact, as PNG, SVG or PDF")
    parser.add_argument("--save", help="CSV file for the motion found with --check --contact")
    options = parser.parse_args()
    if options.speed < 0 or options.turns < 1:
        parser.error("--speed and --turns must be positive")
    machine = Machine(options)
    if not options.check:
        show(machine)
    elif options.contact:
        check_contact(machine, options)
    else:
        check_law(machine)


if __name__ == "__main__":
    main()
