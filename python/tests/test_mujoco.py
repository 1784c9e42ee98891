"""Models that follow the laws in MuJoCo: every link where the machine has it, step after step, moved by forces."""

import math
import pickle
from pathlib import Path

import centrode as ct
import mujoco
import numpy as np
import pytest

DESIGNS = Path(__file__).parents[2] / "tests" / "designs"
STEPS = 400
# What the cubics between rows of the table cost, m and rad.
TABLE = 2e-8
# How far the forces leave a joint off its cubic, m and rad.
LAW = 1e-10
FAMILIES = [
    "elliptic-pair-2018",
    "circular-pair",
    "three-arm-2021",
    "moving-box-2018",
    "feeder-2022",
    "peaucellier-cell",
]


@pytest.fixture
def callback():
    """Sets what MuJoCo calls at every step, and takes it away again."""
    yield mujoco.set_mjcb_control
    mujoco.set_mjcb_control(None)


def off_frames(machine, model, data, phi):
    """Maximum distance of any link of the model from where the machine has it, m, or rad of its turn."""
    off = 0.0
    for name, frame in machine.frames(phi).items():
        # The link that stands still is the world.
        if mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, name) < 0:
            continue
        body = data.body(name)
        off = max(off, np.abs(body.xpos - 1e-3 * frame[:3, 3]).max())
        off = max(off, np.abs(body.xmat.reshape(3, 3) - frame[:3, :3]).max())
    return off


@pytest.mark.parametrize("name", FAMILIES)
def test_every_joint_is_on_its_law_after_every_step(name, callback):
    machine = ct.load(DESIGNS / f"{name}.toml")
    model, control = ct.mujoco.load(machine)
    # A period and a bit.
    speed = 1.1 * control.period / (STEPS * model.opt.timestep)
    model, control = ct.mujoco.load(machine, speed=speed)
    callback(control)
    data = mujoco.MjData(model)
    for step in range(STEPS):
        mujoco.mj_step(model, data)
        assert max(map(abs, control.off(data).values())) < LAW
        if step % 40 == 0:
            mujoco.mj_kinematics(model, data)
            assert off_frames(machine, model, data, speed * data.time) < TABLE
    assert speed * data.time > control.period
    # It is the forces that do it: stopped, the joints are on their laws after one step; without them they stay behind.
    data.qvel[:] = 0
    mujoco.mj_step(model, data)
    assert max(map(abs, control.off(data).values())) < LAW
    callback(None)
    data.qvel[:], data.qfrc_applied[:] = 0, 0
    mujoco.mj_step(model, data)
    assert max(map(abs, control.off(data).values())) > 1e-5


def test_three_lines_and_steps_without_a_callback_go_the_same_way(callback):
    pair = ct.load(DESIGNS / "elliptic-pair-2018.toml")
    model, control = ct.mujoco.load(pair, speed=-30.0)
    one, other = mujoco.MjData(model), mujoco.MjData(model)
    for data in (one, other):
        control.place(model, data)
    callback(control)
    mujoco.mj_step(model, one, 100)
    callback(None)
    control.step(model, other, 100)
    np.testing.assert_array_equal(one.qpos, other.qpos)
    driver, driven = (other.joint(f"{name}_joint").qpos[0] for name in ("driver", "driven"))
    assert driver == pytest.approx(30.0 * other.time, abs=1e-12)
    assert driven == pytest.approx(pair.driven_angle(-30.0 * other.time), abs=TABLE)
    # From the first step on the rates are those of the law: the pair was placed.
    assert other.joint("driven_joint").qvel[0] == pytest.approx(-30.0 * pair.ratio(-driver), rel=1e-2)


def test_the_model_is_the_one_that_export_writes(tmp_path):
    box = ct.MovingBox.from_toml(ct.template("moving-box"))
    box.export(tmp_path, formats=["mjcf"], tolerance=1e-2)
    theirs = mujoco.MjModel.from_xml_path(str(tmp_path / "machine.xml"))
    ours, control = ct.mujoco.load(box)
    for of in ("nq", "nbody", "ngeom", "nmesh", "nmeshvert"):
        assert getattr(ours, of) == getattr(theirs, of)
    np.testing.assert_array_equal(ours.body_inertia, theirs.body_inertia)
    assert set(control.joints) == {theirs.joint(index).name for index in range(theirs.njnt)}
    touches = mujoco.mjtDisableBit.mjDSBL_CONTACT
    assert ours.opt.disableflags == theirs.opt.disableflags | touches
    assert not ct.mujoco.load(box, contact=True)[0].opt.disableflags & touches


def test_a_control_is_handed_to_other_processes():
    model, control = ct.mujoco.load(ct.GearPair(ct.pitch.circle(module=2, tooth_count=20)), speed=3)
    again = pickle.loads(pickle.dumps(control))
    assert repr(again) == repr(control) == "Control(2 joints, speed=3.0)"
    data = mujoco.MjData(model)
    again.step(model, data, 5)
    assert max(map(abs, control.off(data).values())) < 1e-12


def test_what_is_no_machine_is_refused(pair):
    with pytest.raises(TypeError, match="must be a machine, such as a GearPair or the result"):
        ct.mujoco.load(pair.driver)  # type: ignore[arg-type]
    with pytest.raises(ct.DesignError, match="tolerance"):
        ct.mujoco.load(pair, tolerance=0.0)
    model, control = ct.mujoco.load(pair)
    model.opt.integrator = mujoco.mjtIntegrator.mjINT_RK4
    with pytest.raises(ValueError, match="the integrator of the model must be Euler's"):
        control(model, mujoco.MjData(model))
    with pytest.raises(ct.DesignError, match="speed must be a finite number, not nan"):
        ct.mujoco.load(pair, speed=math.nan)
