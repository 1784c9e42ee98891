"""Forces of composed machines and the equations of Newton and Euler for all bodies, written and solved here at once.

Poses alone come from the package: accelerations are differences of them.
"""

import itertools
import math

import centrode as ct
import numpy as np
import pytest

STEP = 0.02
AT = STEP * np.arange(-4, 5)
# Weights of the central differences of eighth order.
FIRST = np.array([1 / 280, -4 / 105, 1 / 5, -4 / 5, 0, 4 / 5, -1 / 5, 4 / 105, -1 / 280]) / STEP
SECOND = np.array([-1 / 560, 8 / 315, -1 / 5, 8 / 5, -205 / 72, 8 / 5, -1 / 5, 8 / 315, -1 / 560]) / STEP**2
GRAVITY = np.array([1.5, -9.81])
ALPHA = math.radians(20)


def turned(angle, vector):
    """A vector given in axes at an angle, or at each of several angles."""
    cos, sin = np.cos(angle), np.sin(angle)
    x, y = np.moveaxis(np.asarray(vector, dtype=float), -1, 0)
    return np.stack([cos * x - sin * y, sin * x + cos * y], axis=-1)


def cross(a, b):
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


class System:
    """Bodies with mass, centre and inertia; joints, pins, meshes and loads between them, and the design's text."""

    def __init__(self, random):
        self.random = random
        self.text = (
            f'family = "machine"\ngravity = {GRAVITY.tolist()}\n[input]\nspeed_rpm = {random.uniform(30, 200)}\n'
        )
        self.tables = {}
        self.masses = {}
        self.joints = []  # body, carrier, kind
        self.pins = []  # both bodies, place in the first's axes
        self.meshes = []  # driver's and driven body, place of the driver's axis, carrier, body that is moved
        self.loads = []  # body, place, force, torque

    def body(self, name, carrier, kind="pin"):
        """Adds a body of a random mass on its carrier."""
        random = self.random
        mass, inertia = random.uniform(0.1, 3), random.uniform(50, 2000)
        center = random.uniform(-20, 20, 2)
        self.masses[name] = (mass, center, inertia)
        self.joints.append((name, carrier, kind))
        given = {"plate": "false", "mass_kg": mass, "center": center.tolist(), "inertia_kg_mm2": inertia}
        self.tables[name] = "".join(f"{key} = {value}\n" for key, value in given.items())
        if random.uniform() < 0.5:
            at, force = random.uniform(-30, 30, 2), random.uniform(-40, 40, 2)
            torque = random.uniform(-900, 900)
            self.loads.append((name, at, force, torque))
            self.tables[name] += f"points = {{ load = {at.tolist()} }}\n"
            self.text += f'[loads.of-{name}]\non = "{name}.load"\nforce = {force.tolist()}\ntorque = {torque}\n'

    def point(self, body, name, at):
        """Adds a point to a body."""
        table = self.tables[body]
        word = f"{name} = {list(map(float, at))}"
        if "points = { " in table:
            self.tables[body] = table.replace("points = { ", f"points = {{ {word}, ")
        else:
            self.tables[body] += f"points = {{ {word} }}\n"

    def bars(self, name, ends, lengths, side):
        """Adds two bars; an end is a body and the name of its point."""
        bodies = [f"{name}-one", f"{name}-other"]
        for body, (carrier, _) in zip(bodies, ends, strict=True):
            self.body(body, carrier)
        self.pins.append((*bodies, np.array([lengths[0], 0.0])))
        (a, p), (b, q) = ends
        self.text += (
            f'[dyads.{name}]\ntype = "RRR"\nfrom = "{a}.{p}"\nto = "{b}.{q}"\nlengths = {list(lengths)}\n'
            f'side = "{side}"\njoint = "C-{name}"\nbodies = {bodies}\n'.replace("'", '"')
        )
        return bodies

    def slider(self, name, end, length, direction):
        """Adds a bar to a block that slides on a line through the frame's D."""
        bodies = [f"{name}-bar", f"{name}-block"]
        self.body(bodies[0], end[0])
        self.body(bodies[1], "frame", "slide")
        self.pins.append((*bodies, np.array([length, 0.0])))
        self.text += (
            f'[dyads.{name}]\ntype = "RRP"\nfrom = "{end[0]}.{end[1]}"\nlengths = [{length}]\nline = "frame.D"\n'
            f'line_deg = {direction}\nside = "forward"\njoint = "W"\nbodies = {bodies}\n'.replace("'", '"')
        )

    def machine(self):
        tables = "".join(f"[bodies.{name}]\n{table}" for name, table in self.tables.items())
        return ct.Machine.from_toml(self.text + tables)

    def poses(self, machine, phi):
        """x, y and angle of every body at inputs around each input, (n, 9, 3)."""
        inputs = phi[:, None] + AT
        found = {name: machine.body(name, inputs) for name in self.masses}
        return found | {"frame": np.zeros((len(phi), 9, 3))}


def pitch_points(system, machine, phi):
    """Pitch point, unit tangent and unit vector from gear to gear across it, of every mesh at every input.

    The pitch point divides the way between the axes as the gears' turns against their carrier; its way in the axes
    of one gear is that gear's pitch curve.
    """
    around = (phi[:, None] + AT).ravel()
    poses = system.poses(machine, around)
    found = []
    for driver, driven, seat, carrier, _ in system.meshes:
        one, two, base = poses[driver], poses[driven], poses[carrier]
        rate = [(pose[..., 2] - base[..., 2]) @ FIRST for pose in (one, two)]
        now = [pose[:, 4] for pose in (one, two)]
        center = now[0][:, :2] + turned(now[0][:, 2], seat)
        way = now[1][:, :2] - center
        share = np.abs(rate[1]) / (np.abs(rate[0]) + np.abs(rate[1]))
        at = center + share[:, None] * way
        own = turned(-now[0][:, 2], at - center).reshape(-1, 9, 2)
        tangent = turned(now[0][:, 2].reshape(-1, 9)[:, 4], np.einsum("nkc,k->nc", own, FIRST))
        tangent /= np.linalg.norm(tangent, axis=1)[:, None]
        across = np.stack([-tangent[:, 1], tangent[:, 0]], axis=1)
        at, way = (of.reshape(-1, 9, 2)[:, 4] for of in (at, way))
        across *= np.sign((across * way).sum(axis=1))[:, None]
        found.append((at, tangent, across))
    return found


class Equations:
    """Columns of the equations of all bodies, one an unknown of unit size, at one input."""

    def __init__(self, system, now):
        self.system, self.now = system, now
        self.names = list(system.masses)
        self.columns, self.keys = [], []

    def unknown(self, key, actions):
        """Adds an unknown: on bodies, a force at a place and a torque."""
        column = np.zeros(3 * len(self.names))
        for body, at, force, torque in actions:
            if body != "frame":
                row = 3 * self.names.index(body)
                pose = self.now[body]
                center = pose[:2] + turned(pose[2], self.system.masses[body][1])
                column[row : row + 2] += force
                column[row + 2] += cross(at - center, force) + torque
        self.columns.append(column)
        self.keys.append(key)


def solved(system, machine, phi):
    """Torque of the input, forces of joints, pins and meshes at inputs."""
    poses = system.poses(machine, phi)
    meshes = pitch_points(system, machine, phi)
    speed = machine.speed
    moved = {mesh[4] for mesh in system.meshes} | {body for pin in system.pins for body in pin[:2]}
    names = list(system.masses)
    answers = []
    for i in range(len(phi)):
        motion = {name: pose[i] for name, pose in poses.items()}
        now = {name: pose[4] for name, pose in motion.items()}
        equations = Equations(system, now)
        unknown, columns, keys = equations.unknown, equations.columns, equations.keys
        zero = np.zeros(2)
        for body, carrier, kind in system.joints:
            at = now[body][:2]
            axes = np.eye(2)
            if kind == "slide":
                axes = [turned(now[body][2], [0.0, 1.0])]
                unknown((body, "moment"), [(body, at, zero, 1.0), (carrier, at, zero, -1.0)])
            for axis in axes:
                unknown((body, tuple(axis)), [(body, at, axis, 0.0), (carrier, at, -axis, 0.0)])
            if body not in moved:
                unknown((body, "drive"), [(body, at, zero, 1.0), (carrier, at, zero, -1.0)])
        for one, other, place in system.pins:
            at = now[one][:2] + turned(now[one][2], place)
            for axis in np.eye(2):
                unknown((f"{one}-{other}", tuple(axis)), [(other, at, axis, 0.0), (one, at, -axis, 0.0)])
        right = np.zeros(3 * len(names))
        for row, name in enumerate(names):
            mass, center, inertia = system.masses[name]
            x, y, angle = motion[name].T
            way = np.stack([x, y], axis=1) + turned(angle, center)
            right[3 * row : 3 * row + 2] = mass * (1e-3 * speed**2 * (SECOND @ way) - GRAVITY)
            right[3 * row + 2] = 1e-3 * inertia * speed**2 * (SECOND @ angle)
        for body, at, force, torque in system.loads:
            row = 3 * names.index(body)
            arm = turned(now[body][2], at - system.masses[body][1])
            right[row : row + 2] -= force
            right[row + 2] -= cross(arm, force) + torque
        base = len(columns)
        for signs in itertools.product([1.0, -1.0], repeat=len(meshes)):
            del columns[base:], keys[base:]
            for (driver, driven, _, _, body), (at, tangent, across), sign in zip(
                system.meshes, meshes, signs, strict=True
            ):
                push = sign * math.cos(ALPHA) * tangent[i] + math.sin(ALPHA) * across[i]
                unknown((body, "mesh"), [(driven, at[i], push, 0.0), (driver, at[i], -push, 0.0)])
            sizes = np.linalg.solve(np.array(columns).T, right)
            # Flanks push.
            if np.all(sizes[base:] >= 0):
                break
        else:
            raise AssertionError("no flanks carry the load")
        answer = {"input": 0.0, "meshes": {}}
        for key, size in zip(keys, sizes, strict=True):
            name, what = key
            if what == "drive":
                carrier = next(carrier for body, carrier, _ in system.joints if body == name)
                answer["input"] += size * (FIRST @ (motion[name][:, 2] - motion[carrier][:, 2]))
            elif what == "mesh":
                index = next(k for k, mesh in enumerate(system.meshes) if mesh[4] == name)
                at, tangent, _ = meshes[index]
                arm = at[i] - now[system.meshes[index][1]][:2]
                answer["meshes"][name] = size * np.sign(cross(arm, signs[index] * tangent[i]))
            elif what != "moment":
                answer[name] = answer.get(name, 0.0) + size * np.array(what)
        answers.append(answer)
    return answers


def four_bar(random):
    """A crank-rocker with masses; the bodies of its dyad."""
    system = System(random)
    crank, frame = random.uniform(20, 35), random.uniform(90, 120)
    bars = random.uniform(70, 110, 2)
    # Grashof: the crank is shortest and the rest can close where it stretches and folds.
    while abs(bars[0] - bars[1]) > frame - crank - 5 or bars.sum() < frame + crank + 5:
        bars = random.uniform(70, 110, 2)
    system.text += f"[frame.points]\nO = [0, 0]\nD = [{frame}, {random.uniform(-5, 5)}]\n"
    system.body("crank", "frame")
    system.tables["crank"] += 'on = "frame.O"\nlaw = { ratio = 1 }\n'
    system.point("crank", "A", [crank, 3.0])
    side = random.choice(["left", "right"])
    bodies = system.bars("first", [("crank", "A"), ("frame", "D")], bars.tolist(), side)
    return system, bodies


def six_bar(random):
    """A crank-rocker with another pair of bars on its coupler."""
    system, (coupler, _) = four_bar(random)
    system.point(coupler, "E", random.uniform(10, 50, 2))
    system.text = system.text.replace("[frame.points]\n", f"[frame.points]\nF = [{random.uniform(20, 60)}, -150]\n")
    system.bars("second", [(coupler, "E"), ("frame", "F")], [180.0, 170.0], "left")
    return system


def with_slide(random):
    """A crank-rocker whose rocker moves a slide."""
    system, (_, rocker) = four_bar(random)
    system.point(rocker, "E", random.uniform(20, 60, 2))
    system.slider("second", (rocker, "E"), random.uniform(150, 250), random.uniform(-40, 40))
    return system


def train(random):
    """A sun that stands still at a point of the frame, an idler and a planet on a carrier that turns unevenly."""
    system = System(random)
    seat = random.uniform(-80, 80, 2)
    system.text += f"[frame.points]\nO = {seat.tolist()}\n"
    system.body("carrier", "frame")
    share = random.uniform(0, 0.4)
    system.tables["carrier"] += f'on = "frame.O"\nlaw = {{ expression = "phi + {share}*sin(phi)" }}\n'
    for name, other in [("idler", "sun"), ("planet", "idler-gear")]:
        system.body(name, "carrier")
        mesh = f'{{ gear = "{name}-gear", with = "{other}", direction_deg = {random.uniform(-180, 180)} }}'
        system.tables[name] += f'on = "carrier"\nmesh = {mesh}\n'
    system.meshes.append(("frame", "idler", seat, "carrier", "idler"))
    system.meshes.append(("planet", "idler", np.zeros(2), "carrier", "planet"))
    # Gears as good as without mass.
    body = "{ width = 10, bore = 12, density = 1e-9 }"
    system.text += f"""[pairs.stage]
pitch = {{ kind = "ellipse", eccentricity = {random.uniform(0.05, 0.3)}, module = 2.5, tooth_count = 23 }}
teeth = {{ backlash = 0.05 }}
driver = {body}
driven = {body}
[gears]
sun = {{ pair = "stage", role = "driver", on = "frame.O", mount_deg = {random.uniform(0, 360)} }}
idler-gear = {{ pair = "stage", role = "driven", on = "idler" }}
planet-gear = {{ pair = "stage", role = "driver", on = "planet" }}
"""
    return system


MAKERS = {"four-bar": lambda random: four_bar(random)[0], "six-bar": six_bar, "slide": with_slide, "train": train}


def closing(maker, random):
    """The first random system whose bars close over the cycle."""
    while True:
        system = maker(random)
        try:
            return system, system.machine()
        except ct.DesignError as error:
            if "does not close" not in str(error):
                raise


@pytest.mark.parametrize("kind", MAKERS)
@pytest.mark.parametrize("seed", range(4))
def test_forces_are_those_of_newton_and_euler_for_all_bodies_at_once(kind, seed):
    random = np.random.default_rng([seed, len(kind)])
    system, machine = closing(MAKERS[kind], random)
    phi = random.uniform(0.2, 6.0, 12)
    wanted = solved(system, machine, phi)
    forces = machine.forces(phi)
    found = {**forces.joints, **forces.closures}
    for name in [key for key in wanted[0] if key not in ("input", "meshes")]:
        rows = np.array([answer[name] for answer in wanted])
        size = np.abs(rows).max()
        assert size > 0.1
        np.testing.assert_allclose(found[name], rows, rtol=0, atol=1e-6 * size, err_msg=name)
    torque = np.array([answer["input"] for answer in wanted])
    np.testing.assert_allclose(forces.input, torque, rtol=0, atol=1e-6 * np.abs(torque).max())
    assert len(forces.meshes) == len(system.meshes)
    for name, sizes in forces.meshes.items():
        rows = np.array([answer["meshes"][name] for answer in wanted])
        np.testing.assert_allclose(sizes, rows, rtol=0, atol=1e-6 * np.abs(rows).max(), err_msg=name)
