#!/usr/bin/env python3
"""Plays machine.xml in MuJoCo by the laws of motion.csv, by forces alone, or through teeth and closed loops alone.

python play_mujoco.py                    every joint follows its law
python play_mujoco.py --drive            forces move the joints, found from the laws by inverse dynamics
python play_mujoco.py --contact          the input turns evenly; teeth and the closures of loops move the rest
python play_mujoco.py --check            no window: prints how far joints and points are off the table

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


class Machine:
    """The model with what plays it."""

    def __init__(self, options):
        """Loads the model at the start of its laws."""
        self.law = Law(FOLDER)
        self.model = mujoco.MjModel.from_xml_path(str(FOLDER / self.law.about["models"][1]))
        self.data = mujoco.MjData(self.model)
        self.mode = "contact" if options.contact else "drive" if options.drive else "law"
        self.speed = (options.speed or self.law.speed) * (-1 if options.backward else 1)
        self.joints = {name: self.model.joint(name) for name in self.law.joints}
        self.input = self.law.about["input"]["joint"]
        self.travelled = 0.0
        self.forces = dict.fromkeys(self.joints, 0.0)
        self.held, self.free, self.load, self.reached = [], [], {}, {}
        # Of several chains that are alike the first tells.
        self.meshes = [mesh for mesh in self.law.about["meshes"] if mesh["copy"] == 0]
        self.touch({link for mesh in self.meshes for link in mesh["links"]})
        if self.mode == "contact":
            self.release(options)
        elif self.mode == "drive":
            # Bodies that are moved by their laws need not touch.
            self.model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT
        else:
            # From row to row of the table.
            self.model.opt.timestep = self.law.step / abs(self.speed)
        self.place(0.0)

    def touch(self, links):
        """Lets some links alone touch one another."""
        names = [self.model.body(body).name for body in range(self.model.nbody)]
        # A link that stands still has its shapes on the world, which has a name of its own.
        names[0] = next(iter(links.difference(names)), names[0])
        for body, name in enumerate(names):
            if name not in links:
                of_body = self.model.geom_bodyid == body
                self.model.geom_contype[of_body] = 0
                self.model.geom_conaffinity[of_body] = 0

    def release(self, options):
        """Leaves free the joints that teeth and closed loops move, with a load at the end of a chain of gears."""
        about, model, meshes = self.law.about, self.model, self.meshes
        carried = [mesh["joint"] for mesh in meshes]
        loops = [joint for closure in about["closures"] for joint in closure["joints"]]
        self.free = [name for name in self.joints if name in carried + loops]
        self.held = [name for name, joint in self.law.joints.items() if not {name, joint["leader"]} & set(self.free)]
        if not self.free:
            raise SystemExit("--contact is for machines with gears or closed loops")
        # Only teeth and closures may tie the links: no joint follows another by an equation.
        for equality in range(model.neq):
            if model.eq_type[equality] == mujoco.mjtEq.mjEQ_JOINT:
                self.data.eq_active[equality] = 0
        for name in self.joints:
            if name not in self.free:
                # Too heavy to be held up, or moved, by what it touches.
                model.dof_armature[self.joints[name].dofadr] = 1e3 if name in self.held else 1e6
        drives = {link for mesh in meshes for link in mesh["links"][:1]}
        for mesh in meshes:
            if mesh["links"][1] not in drives:
                self.load[mesh["joint"]] = options.load
        if meshes and any(self.law.joints[name]["load"] for name in carried):
            model.opt.timestep = min(model.opt.timestep, 5e-5)

    def place(self, travel):
        """Puts every joint where its law has it, at the rate that it has there."""
        self.travelled = travel
        for name, joint in self.joints.items():
            place, rate = self.law.read(name, travel)
            self.data.qpos[joint.qposadr], self.data.qvel[joint.dofadr] = place, self.speed * rate
        mujoco.mj_forward(self.model, self.data)

    def advance(self):
        """Goes on by one time step."""
        step = self.model.opt.timestep
        if self.mode == "law":
            self.data.time += step
            self.place(self.speed * self.data.time)
        elif self.mode == "drive":
            self.drive(step)
        else:
            self.carry(step)

    def drive(self, step):
        """One step by the forces that bring every joint to where its law has it at its end."""
        travel = self.speed * (self.data.time + step)
        for name, joint in self.joints.items():
            off = self.law(name, travel) - self.data.qpos[joint.qposadr[0]]
            self.data.qacc[joint.dofadr] = (off / step - self.data.qvel[joint.dofadr[0]]) / step
        mujoco.mj_inverse(self.model, self.data)
        self.data.qfrc_applied[:] = self.data.qfrc_inverse
        self.forces = {name: self.data.qfrc_inverse[joint.dofadr[0]] for name, joint in self.joints.items()}
        mujoco.mj_step(self.model, self.data)
        self.travelled = travel

    def carry(self, step):
        """One step of the joints that teeth and closures move. The others follow their law or their leading joint."""
        ahead = self.travelled + self.speed * step
        for name in self.held:
            joint, now, then = self.joints[name], self.law(name, self.travelled), self.law(name, ahead)
            self.data.qpos[joint.qposadr], self.data.qvel[joint.dofadr] = now, (then - now) / step
        for name, load in self.load.items():
            column = self.law.joints[name]["load"]
            if column:
                # The torque that the law asks for at the joint is what it must overcome.
                load = 1e-3 * self.law.value(column, self.reached.get(name, self.travelled))
            sense = np.sign(self.speed * self.law.rate(name, self.travelled))
            self.data.qfrc_applied[self.joints[name].dofadr] = -sense * load
        mujoco.mj_step(self.model, self.data)
        self.travelled = ahead
        for name in {about["leader"] for about in self.law.joints.values()} & set(self.free):
            place = self.data.qpos[self.joints[name].qposadr[0]]
            self.reached[name] = self.law.travel(name, place, self.reached.get(name, 0.0) + self.speed * step)
        for name, about in self.law.joints.items():
            if about["leader"] in self.reached:
                self.data.qpos[self.joints[name].qposadr] = self.law(name, self.reached[about["leader"]])
                self.data.qvel[self.joints[name].dofadr] = 0.0

    def off(self):
        """How far each joint that is not held is off its law, rad or m: positive if it has gone too far.

        Joints placed by their laws are held against the rows of the table.
        """
        names = self.free + [name for name, about in self.law.joints.items() if about["leader"] in self.free]
        watched = names if self.mode == "contact" else self.joints
        law = self.law.row_of if self.mode == "law" else self.law
        return {name: self.data.qpos[self.joints[name].qposadr[0]] - law(name, self.travelled) for name in watched}

    def rate(self, name):
        """Rate of a joint by the input."""
        return self.data.qvel[self.joints[name].dofadr[0]] / self.speed

    def penetration(self):
        """Depth of the deepest contact, mm."""
        return 1e3 * max(0.0, *(-self.data.contact.dist), 0.0)

    def gap(self):
        """Largest distance of the two sides of a closed loop's pin, mm; 0 if there are no loops."""
        model, data = self.model, self.data
        gaps = [0.0]
        for loop in np.flatnonzero(model.eq_type == mujoco.mjtEq.mjEQ_CONNECT):
            bodies = model.eq_obj1id[loop], model.eq_obj2id[loop]
            anchors = model.eq_data[loop, :3], model.eq_data[loop, 3:6]
            at = [data.xpos[b] + data.xmat[b].reshape(3, 3) @ a for b, a in zip(bodies, anchors, strict=True)]
            gaps.append(float(np.linalg.norm(at[0] - at[1])))
        return 1e3 * max(gaps)

    def point(self, point, travel):
        """Where a point of a link is at a travel, m."""
        self.place(travel)
        body = self.data.body(point["link"])
        return body.xpos + body.xmat.reshape(3, 3) @ (1e-3 * np.array(point["at_mm"]))


def plot(rows, names, path):
    """Draws how far each joint is off its law, and how its rate wavers about it."""
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(2, 1, sharex=True, figsize=(8.0, 6.0), layout="constrained")
    for index, name in enumerate(names):
        axes[0].plot(np.degrees(rows[:, 0]), rows[:, 1 + 2 * index], linewidth=0.8, label=name)
        axes[1].plot(np.degrees(rows[:, 0]), rows[:, 2 + 2 * index], linewidth=0.8)
    axes[0].set_ylabel("joint less its law, rad or m")
    axes[0].legend()
    axes[1].set_ylabel("rate by the input less its law")
    axes[1].set_xlabel("input, deg")
    figure.savefig(path, dpi=120)


def check(machine, options):
    """Prints how far joints and points are off the table over some cycles."""
    law, cycles = machine.law, options.cycles
    result = {"mode": machine.mode, "cycles": cycles * int(np.sign(machine.speed)), "rows": law.about["rows"]}
    steps = round(law.period * cycles / abs(machine.speed) / machine.model.opt.timestep)
    # With contact, the load first takes up the backlash: the teeth are judged after a twentieth of a cycle.
    before = round(steps / cycles / 20) if machine.load else 0
    # Rows enough to see every tooth.
    stride = max(1, steps // 20000)
    names = list(machine.off())
    rows, penetration, gap, pushes = [], 0.0, 0.0, {name: [0.0, 0.0] for name in machine.joints}
    for step in range(before + steps):
        machine.advance()
        if step < before or step % stride:
            continue
        penetration, gap = max(penetration, machine.penetration()), max(gap, machine.gap())
        off, row = machine.off(), [machine.travelled]
        for name in names:
            row += [off[name], machine.rate(name) - law.rate(name, machine.travelled)]
        rows.append(row)
        for name, push in machine.forces.items():
            pushes[name] = [min(pushes[name][0], push), max(pushes[name][1], push)]
    rows = np.array(rows)
    result["joints"] = {}
    for index, name in enumerate(names):
        off, waver = rows[:, 1 + 2 * index], rows[:, 2 + 2 * index]
        result["joints"][name] = {
            "off_max": float(np.abs(off).max()),
            "off_range": float(np.ptp(off)),
            "rate_off_rms": float(np.sqrt(np.mean(waver**2))),
            "rate_off_max": float(np.abs(waver).max()),
        }
        if machine.mode == "drive":
            result["joints"][name]["force_range"] = pushes[name]
    if machine.mode == "contact":
        result["gap_max_mm"] = gap
    result |= {"penetration_max_mm": penetration, "seconds": machine.data.time}
    if machine.mode == "law":
        result["point_off_max_m"] = law.check(machine.point)
    print(json.dumps(result))
    if options.plot:
        plot(rows, names, options.plot)
    if options.save:
        header = ["travel_rad"] + [f"{name}_{what}" for name in names for what in ("off", "rate_off")]
        np.savetxt(options.save, rows, delimiter=",", header=",".join(header), comments="")


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
    parser.add_argument("--contact", action="store_true", help="hold the input alone to its law")
    parser.add_argument("--backward", action="store_true", help="turn in the opposite direction")
    parser.add_argument("--speed", type=float, help="speed of the input, rad/s (the design's)")
    parser.add_argument("--load", type=float, default=0.01, help="torque at the end of a chain of gears, N m")
    parser.add_argument("--check", action="store_true", help="no window: print the errors as one line of JSON")
    parser.add_argument("--cycles", type=int, default=1, help="periods of the input with --check (1)")
    parser.add_argument("--plot", help="picture of the errors found by --check, as PNG, SVG or PDF")
    parser.add_argument("--save", help="CSV file for the errors found by --check")
    options = parser.parse_args()
    if (options.speed is not None and options.speed <= 0) or options.cycles < 1:
        parser.error("--speed and --cycles must be positive")
    machine = Machine(options)
    if options.check:
        check(machine, options)
    else:
        show(machine)


if __name__ == "__main__":
    main()
