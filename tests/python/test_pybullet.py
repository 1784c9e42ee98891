"""The URDF as PyBullet loads and plays it."""

import math

import numpy as np
import pytest
from reading import GEARS, rows
from test_mjcf import TEETH, play

# Bullet rounds every convex body by this, m.
MARGIN = 1e-3


@pytest.fixture
def bullet():
    """PyBullet without a window."""
    pybullet = pytest.importorskip("pybullet", reason="has wheels up to Python 3.11 only")
    pybullet.connect(pybullet.DIRECT)
    yield pybullet
    pybullet.disconnect()


@pytest.mark.usefixtures("bullet")
def test_the_script_plays_the_law(exported):
    assert play(exported.folder, script="play_pybullet.py")["joint_off_max"] < 1e-11


def test_its_teeth_touch_by_the_law_and_overlap_off_it(exported, bullet):
    pair = bullet.loadURDF(str(exported / "machine.urdf"), useFixedBase=True)
    joints = {bullet.getJointInfo(pair, i)[12].decode(): i for i in range(bullet.getNumJoints(pair))}
    for gear, teeth in zip(GEARS, TEETH[exported.name], strict=True):
        assert len(bullet.getCollisionShapeData(pair, joints[gear])) == teeth + 1
    table = rows(exported / "motion.csv")

    def gaps(ahead):
        for driver, driven in zip(table["driver_angle_rad"][::16], table["driven_angle_rad"][::16], strict=True):
            bullet.resetJointState(pair, joints["driver"], -driver)
            bullet.resetJointState(pair, joints["driven"], driven + ahead)
            points = bullet.getClosestPoints(pair, pair, MARGIN, *(joints[gear] for gear in GEARS))
            yield min(point[8] for point in points) + 2 * MARGIN

    by_the_law = np.array(list(gaps(0.0)))
    assert by_the_law.min() > -5e-6  # metres
    assert by_the_law.max() < 1e-4
    assert max(gaps(math.pi / 2 / TEETH[exported.name][1])) < -1e-4
