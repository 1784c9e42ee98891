"""Simulator models of composed machines whose loops pins close, by the files that they come with."""

import json
import subprocess
import sys

import mujoco
import numpy as np
import pytest
import tomllib
from conftest import ROOT
from reading import rows

SHIPPED = {path.stem: tomllib.loads(path.read_text()) for path in sorted((ROOT / "tests" / "designs").glob("*.toml"))}
CLOSED = [name for name, design in SHIPPED.items() if design["family"] == "machine" and "dyads" in design]
# Teeth have backlash: the joints that they move follow their law less closely.
TOOTHLESS = [name for name in CLOSED if "pairs" not in SHIPPED[name]]


@pytest.fixture(scope="module")
def exported(shipped):
    """Folder of a design's files, written once."""
    return lambda name: shipped(name, "csv,mjcf")


def test_there_are_designs_to_play():
    assert {"jansen-leg", "press", "composed-feeder"} <= set(CLOSED)
    assert len(TOOTHLESS) >= 3


@pytest.mark.parametrize("name", TOOTHLESS)
def test_mujoco_closes_the_loops_and_every_joint_follows_the_law(name, exported):
    folder = exported(name)
    command = [sys.executable, str(folder / "play_mujoco.py"), "--check", "--contact"]
    done = subprocess.run(command, check=True, capture_output=True, text=True, timeout=300, cwd="/")
    off = json.loads(done.stdout.splitlines()[-1])
    # Two joints a loop at least, next to the one that is driven.
    assert len(off["joints"]) >= 2 * len(SHIPPED[name]["dyads"])
    for joint, found in off["joints"].items():
        assert found["off_max"] < 1e-5, joint


def test_mujoco_carries_a_train_whose_sun_stands_still_by_its_teeth(exported):
    folder = exported("two-stage")
    command = [sys.executable, str(folder / "play_mujoco.py"), "--check", "--contact", "--speed", "2", "--load", "0.02"]
    done = subprocess.run(command, check=True, capture_output=True, text=True, timeout=300, cwd="/")
    found = json.loads(done.stdout.splitlines()[-1])
    assert len(found["joints"]) == 4
    # About the backlash of two meshes: without the sun's teeth the gears are soon whole turns away.
    for joint, off in found["joints"].items():
        assert 0 < off["off_max"] < 5e-3, joint


def loops(design):
    """Dyads of a design and of its copies."""
    times = {body: copies["count"] for copies in design.get("copies", {}).values() for body in copies["bodies"]}
    return sum(times.get(dyad["bodies"][0], 1) for dyad in design["dyads"].values())


@pytest.mark.parametrize("name", CLOSED)
def test_with_all_joints_as_the_law_has_them_no_pin_is_open(name, exported):
    folder = exported(name)
    about = json.loads((folder / "motion.json").read_text())
    table = rows(folder / "motion.csv")
    model = mujoco.MjModel.from_xml_path(str(folder / "machine.xml"))
    assert np.sum(model.eq_type == mujoco.mjtEq.mjEQ_CONNECT) == len(about["closures"]) == loops(SHIPPED[name])
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT
    data = mujoco.MjData(model)

    def open_by(row):
        for joint in about["joints"]:
            at = joint["factor"] * table[joint["column"]][row] + joint["offset"]
            data.qpos[model.joint(joint["name"]).qposadr] = at
        mujoco.mj_forward(model, data)
        return np.abs(data.efc_pos[data.efc_type == mujoco.mjtConstraint.mjCNSTR_EQUALITY])

    for row in range(0, len(table["time_s"]), max(1, len(table["time_s"]) // 60)):
        gaps = open_by(row)
        assert gaps.size >= 3 * len(about["closures"])
        # Metres.
        assert gaps.max() < 1e-9, row
    # With a joint elsewhere the loop is open.
    moved = about["joints"][-1]
    data.qpos[model.joint(moved["name"]).qposadr] += 0.01
    mujoco.mj_forward(model, data)
    assert np.abs(data.efc_pos[data.efc_type == mujoco.mjtConstraint.mjCNSTR_EQUALITY]).max() > 1e-5
