"""Forces of every family's machine, next to MuJoCo's inverse dynamics and closed forms."""

import json
import math
from pathlib import Path

import centrode as ct
import numpy as np
import pytest
import tomllib
from sample import sampled

SHIPPED = sorted((Path(__file__).resolve().parents[2] / "tests" / "designs").glob("*.toml"))
# Free fall in the frame of the first link, m/s²; None if the family has no upright direction.
DOWN = {
    "GearPair": (0.0, 0.0, 0.0),
    "ThreeArm": (0.0, -9.80665, 0.0),
    "Feeder": (0.0, -9.80665, 0.0),
    "SpiralShaft": (0.0, 0.0, -9.81),
    "MovingBox": (0.0, 0.0, -9.81),
    "Machine": (0.0, 0.0, 0.0),
}
# Weights of the central difference of eighth order.
WEIGHTS = np.array([1 / 280, -4 / 105, 1 / 5, -4 / 5, 0, 4 / 5, -1 / 5, 4 / 105, -1 / 280])


def joints(machine, about, phi):
    """Position, rate and second derivative of each joint by the input as models count; whether the last is known."""

    def table(at):
        motion = machine.motion(at)
        rates = {}
        for joint in about["joints"]:
            if joint["rate"] is None:
                growth = next(c["advance"] for c in about["columns"] if c["name"] == joint["column"])
                even = joint["factor"] * growth / about["input"]["period_rad"]
                rates[joint["name"]] = np.full(np.shape(at), even)
            else:
                rates[joint["name"]] = joint["rate_factor"] * motion[joint["rate"]]
        return motion, rates

    def bends(step):
        _, rates = table(phi[:, None] + step * np.arange(-4, 5))
        return {name: rate @ WEIGHTS / step for name, rate in rates.items()}

    motion, rates = table(phi)
    fine, coarse = bends(1e-3), bends(2e-3)
    known = np.full(phi.shape, True)
    for name, bend in fine.items():
        # A break within reach of a difference leaves it no digits.
        known &= np.abs(bend - coarse[name]) <= 1e-9 * (1 + np.abs(bend))
    found = {}
    for joint in about["joints"]:
        name = joint["name"]
        found[name] = (joint["factor"] * motion[joint["column"]] + joint["offset"], rates[name], fine[name])
    return found, known


def inverse(machine, folder, phi, down=None):
    """Torque of the input by MuJoCo, N mm: forces of its tree of joints, each times its rate, with all loops open."""
    mujoco = pytest.importorskip("mujoco")
    machine.export(folder, formats=["csv", "mjcf"], tolerance=0.1)
    about = json.loads((folder / "motion.json").read_text())
    model = mujoco.MjModel.from_xml_path(str(folder / "machine.xml"))
    model.opt.gravity[:] = down or DOWN[type(machine).__name__]
    off = mujoco.mjtDisableBit
    model.opt.disableflags |= off.mjDSBL_CONTACT | off.mjDSBL_EQUALITY | off.mjDSBL_LIMIT
    model.dof_damping[:] = 0
    model.dof_armature[:] = 0
    model.dof_frictionloss[:] = 0
    data = mujoco.MjData(model)
    speed = about["input"]["speed_rad_per_s"]
    found, known = joints(machine, about, phi)
    torque = np.zeros(len(phi))
    for i in range(len(phi)):
        for name, (place, rate, bend) in found.items():
            joint = model.joint(name)
            data.qpos[joint.qposadr] = place[i]
            data.qvel[joint.dofadr] = speed * rate[i]
            data.qacc[joint.dofadr] = speed**2 * bend[i]
        mujoco.mj_inverse(model, data)
        for name, (_, rate, _) in found.items():
            torque[i] += 1e3 * data.qfrc_inverse[model.joint(name).dofadr[0]] * rate[i]
    return torque, known


def springs(machine, motion):
    """Torque of the input that the push rods' springs ask for, N mm: 20 N and 1.2 N/mm on the published arm."""
    if not isinstance(machine, ct.ThreeArm):
        return 0.0
    arm = tomllib.loads(machine.to_toml())["arm"]
    reach, offset, clamp = (arm[key] for key in ("tip_distance", "pusher_offset", "clamp_length"))
    scale = min(reach / 145, (math.sqrt(reach**2 - offset**2) - clamp) / 66, abs(offset) / 46)
    rods = [f"push_rod_{k}_mm" for k in range(machine.arms)]
    return sum((1.2 * motion[rod] - 20.0 * scale) * motion[f"{rod}_per_rad"] for rod in rods)


def rubbed(machine, phi, motion):
    """Torque of the input that rails and groove ask for, N mm: that of the shaft beyond what moves the box."""
    if not isinstance(machine, ct.BoxDrive):
        return 0.0
    even = machine.force(phi, groove_friction=0, rail_friction=0).torque
    rate = motion["shaft_speed_rad_per_s"] * motion["time_s"] / phi
    return (machine.force(phi).torque - even) * rate


@pytest.mark.parametrize("path", sampled(SHIPPED), ids=lambda path: path.stem)
def test_the_torque_is_that_of_mujocos_inverse_dynamics(path, tmp_path):
    try:
        machine = ct.load(path)
        forces = machine.forces(1.0)
    except ct.Error:
        pytest.skip("no such bodies")
    phi = np.random.default_rng(7).uniform(0.1, 6.0, 60)
    torque, known = inverse(machine, tmp_path, phi)
    assert known.sum() >= 20
    motion = machine.motion(phi)
    forces = machine.forces(phi)
    wanted = torque + springs(machine, motion) + rubbed(machine, phi, motion)
    size = np.abs(forces.input).max()
    # Round gears that turn evenly need nothing.
    assert (size > 1e-6) == (path.stem != "circular-pair")
    size = max(size, 1e-4)
    np.testing.assert_allclose(forces.input[known], wanted[known], rtol=0, atol=1e-8 * size)


def test_arrays_have_the_shape_of_the_inputs_and_names_of_the_parts():
    feeder = ct.Feeder.from_toml(ct.template("feeder"))
    phi = np.linspace(0.1, 4.0, 12).reshape(3, 4)
    forces = feeder.forces(phi)
    assert isinstance(forces, ct.Forces)
    assert forces.input.shape == (3, 4)
    assert set(forces.closures) == {"coupler-rocker", "slider-rocker"}
    assert forces.joints["crank_joint"].shape == (3, 4, 2)
    assert (forces.meshes, forces.undetermined) == ({}, ())
    np.testing.assert_allclose(forces.drives["crank_joint"], feeder.crank_torque(phi), rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(forces.joints["effector_joint"], feeder.joint_forces(phi)[..., 5, :], rtol=1e-9)
    single = feeder.forces(1.0)
    assert isinstance(single.input, float)
    assert single.joints["crank_joint"].shape == (2,)
    still = feeder.forces(phi, speed=0)
    np.testing.assert_allclose(still.drives["crank_joint"], feeder.crank_torque(phi, moving=False), rtol=1e-9)
    with pytest.raises(ValueError, match="speed"):
        feeder.forces(phi, speed=math.nan)


def test_a_tooth_force_is_the_moment_on_the_gear_by_its_lever():
    pair = ct.GearPair(ct.pitch.circle(module=2, tooth_count=20), mean_ratio=(2, 1))
    arms = ct.ThreeArm.from_toml(ct.template("three-arm"))
    still = pair.forces(0.7)
    # Centred gears that turn evenly need nothing.
    assert abs(still.input) < 1e-9
    assert list(still.meshes) == ["driver-driven"]
    phi = np.linspace(0.0, 6.0, 50)
    forces = arms.forces(phi)
    assert {"sun-intermediate_0", "intermediate_2-planet_2"} <= set(forces.meshes)
    assert {"cam_0-fork_0", "fork_0-push_rod_0"} <= set(forces.contacts)
    # Of the sun's bearing the teeth of all three intermediate gears ask what it holds.
    assert forces.joints["sun_joint"].shape == (50, 2)
    assert forces.undetermined == ()
    assert np.all(np.abs(forces.meshes["sun-intermediate_0"]) > 0)


def test_the_groove_hides_what_its_place_would_tell():
    shaft = ct.SpiralShaft.for_moved_distance(2.05)
    phi = np.linspace(0.5, 170.0, 40)
    forces = shaft.forces(phi)
    assert set(forces.undetermined) == {"shaft_joint", "box_joint", "slider_joint"}
    assert forces.joints["frame_joint"].shape == (40, 3)
    family = shaft.force(phi)
    np.testing.assert_allclose(forces.guides["box_joint"].torque, family.torque, rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(forces.guides["box_joint"].normal, family.normal, rtol=1e-9, atol=1e-9)


def test_weight_and_loads_of_a_composed_machine_are_those_of_mujoco_and_virtual_work(tmp_path):
    text = (Path(__file__).resolve().parents[2] / "tests" / "designs" / "press.toml").read_text()
    text = "gravity = [2.0, -9.81]\n" + text
    text += """
[bodies.ram]
mass_kg = 3
center = [4, -2]
inertia_kg_mm2 = 900
points = { tool = [20, 7] }
[loads.work]
on = "ram.tool"
force = [-800, 60]
[loads.drag]
on = "rod.B"
force = [5, -40]
axes = "body"
expression = "1 + 0.5*sin(2*phi)"
[loads.brake]
on = "crank"
torque = 350
"""
    machine = ct.Machine.from_toml(text)
    phi = np.random.default_rng(11).uniform(0.1, 6.0, 60)
    torque, known = inverse(machine, tmp_path, phi, down=(2.0, -9.81, 0.0))
    assert known.sum() >= 20
    # What loads do on their ways, the input gives back.
    tool, pin = machine.point("ram.tool", phi, 1), machine.point("rod.B", phi, 1)
    turned = machine.body("rod", phi)[:, 2]
    cos, sin = np.cos(turned), np.sin(turned)
    drag = (1 + 0.5 * np.sin(2 * phi))[:, None] * np.stack([5 * cos + 40 * sin, 5 * sin - 40 * cos], axis=-1)
    work = tool @ [-800.0, 60.0] + (drag * pin).sum(axis=-1) + 350 * machine.body("crank", phi, 1)[:, 2]
    forces = machine.forces(phi)
    size = np.abs(forces.input).max()
    np.testing.assert_allclose(forces.input[known], (torque - work)[known], rtol=0, atol=1e-8 * size)
    assert forces.joints["rod"].shape == (60, 2)
    assert list(forces.joints) == list(machine.bodies[1:])
    assert (list(forces.meshes), list(forces.closures)) == (["crank"], ["rod-ram"])
    assert forces.meshes["crank"].shape == forces.drives["shaft"].shape == forces.input.shape == (60,)
