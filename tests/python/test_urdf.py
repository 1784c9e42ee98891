import math
import xml.etree.ElementTree as ElementTree

import mujoco
import numpy as np
import pytest
import trimesh
import yourdfpy
from reading import GEARS, rows

DENSITY = 7850.0


@pytest.fixture
def robot(exported):
    return ElementTree.parse(exported / "pair.urdf").getroot()


def gear_links(robot):
    return {link.get("name"): link for link in robot.iter("link") if link.get("name") in GEARS}


def test_yourdfpy_loads_the_pair_with_its_meshes(exported):
    model = yourdfpy.URDF.load(str(exported / "pair.urdf"), load_meshes=True)
    assert model.validate()
    assert len([j for j in model.robot.joints if j.type == "continuous"]) == 2
    extents = model.scene.extents
    assert 0.01 < max(extents) < 1  # metres


def test_mujoco_loads_and_steps_the_pair(exported):
    model = mujoco.MjModel.from_xml_path(str(exported / "pair.urdf"))
    data = mujoco.MjData(model)
    assert model.njnt == 2
    data.qvel[:] = 1.0
    for _ in range(100):
        mujoco.mj_step(model, data)
    assert np.isfinite(data.qpos).all()
    assert abs(data.qpos[0]) > 0.01


def test_inertias_are_those_of_the_solid(exported, robot):
    for gear, link in gear_links(robot).items():
        mesh = trimesh.load_mesh(exported / f"{gear}.stl")
        mesh.apply_scale(1e-3)
        mesh.density = DENSITY
        inertial = link.find("inertial")
        assert float(inertial.find("mass").get("value")) == pytest.approx(mesh.mass, rel=2e-4)
        stated = inertial.find("inertia")
        for key, (i, j) in {"ixx": (0, 0), "iyy": (1, 1), "izz": (2, 2), "ixy": (0, 1)}.items():
            scale = mesh.moment_inertia[2, 2]
            assert float(stated.get(key)) == pytest.approx(mesh.moment_inertia[i, j], abs=5e-4 * scale)
        place = [float(v) for v in inertial.find("origin").get("xyz").split()]
        np.testing.assert_allclose(place, mesh.center_mass, atol=2e-6)


def test_a_mimic_only_where_the_law_is_linear(exported, robot):
    mimics = list(robot.iter("mimic"))
    if exported.name == "circle":
        assert len(mimics) == 1
        # Both joints turn about +z: the driven gear turns the other way.
        assert float(mimics[0].get("multiplier")) == pytest.approx(-1.0, rel=1e-12)
    else:
        assert not mimics


def test_the_motion_table_is_the_law(exported):
    table = rows(exported / "motion.csv")
    driver, driven = list(table.values())[:2]
    turns = (driver[-1] - driver[0]) / (2 * math.pi)
    assert np.all(np.diff(driver) > 0)
    assert np.all(np.diff(driven) > 0)
    goal = {"elliptic": 1, "two-to-one": 0.5, "circle": 1}[exported.name]
    if abs(turns - round(turns)) < 1e-9:
        assert (driven[-1] - driven[0]) / (driver[-1] - driver[0]) == pytest.approx(goal, rel=1e-9)
    if exported.name == "elliptic":
        k = 1 / (2 + math.sqrt(3))
        phi = driver[np.abs(driver) < 3.0]
        law = 2 * np.arctan((1 + k) / (1 - k) * np.tan(phi / 2))
        np.testing.assert_allclose(driven[np.abs(driver) < 3.0], law, atol=1e-9)
    ratio = table["ratio"]
    np.testing.assert_allclose(np.gradient(driven, driver)[1:-1], ratio[1:-1], rtol=0.02)
