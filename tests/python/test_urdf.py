import math
import xml.etree.ElementTree as ElementTree

import mujoco
import numpy as np
import pytest
import trimesh
import yourdfpy
from reading import GEARS, rows
from test_mjcf import TEETH

DENSITY = 7850.0


@pytest.fixture
def robot(exported):
    return ElementTree.parse(exported / "machine.urdf").getroot()


def gear_links(robot):
    return {link.get("name"): link for link in robot.iter("link") if link.get("name") in GEARS}


def test_yourdfpy_loads_the_pair_with_its_meshes(exported):
    model = yourdfpy.URDF.load(
        str(exported / "machine.urdf"),
        load_meshes=True,
        load_collision_meshes=True,
        build_collision_scene_graph=True,
    )
    assert model.validate()
    assert len([j for j in model.robot.joints if j.type == "continuous"]) == 2
    extents = model.scene.extents
    assert 0.01 < max(extents) < 1  # metres
    # The bodies of each link, which this reader joins into one mesh.
    assert len(model.collision_scene.geometry) == 2
    np.testing.assert_allclose(model.collision_scene.extents, extents, rtol=1e-3)


def test_every_body_to_touch_with_is_convex(exported):
    files = list((exported / "collision").iterdir())
    assert len(files) == sum(TEETH[exported.name]) + 2
    for file in files:
        body = trimesh.load_mesh(file)
        assert body.is_volume
        # Vertices are single precision.
        assert body.convex_hull.volume == pytest.approx(body.volume, rel=1e-6)


def test_mujoco_loads_the_pair_and_its_teeth_mesh(exported):
    model = mujoco.MjModel.from_xml_path(str(exported / "machine.urdf"))
    assert model.njnt == 2
    assert model.ngeom == sum(TEETH[exported.name]) + 2
    data = mujoco.MjData(model)
    table = rows(exported / "motion.csv")
    deepest = 0.0
    for driver, driven in zip(table["driver_angle_rad"][::8], table["driven_angle_rad"][::8], strict=True):
        data.qpos[:] = -driver, driven
        mujoco.mj_forward(model, data)
        deepest = max(deepest, *(-data.contact.dist), 0.0)
    assert deepest < 2e-6  # metres
    # The bodies do touch: a driven gear a quarter of a tooth too far does not fit.
    data.qpos[1] += math.pi / 2 / TEETH[exported.name][1]
    mujoco.mj_forward(model, data)
    assert np.any(data.contact.dist < -1e-4)


def test_inertias_are_those_of_the_solid(fine):
    for gear, link in gear_links(ElementTree.parse(fine / "machine.urdf").getroot()).items():
        mesh = trimesh.load_mesh(fine / f"{gear}.stl")
        mesh.apply_scale(1e-3)
        mesh.density = DENSITY
        inertial = link.find("inertial")
        assert float(inertial.find("mass").get("value")) == pytest.approx(mesh.mass, rel=1e-6)
        stated = inertial.find("inertia")
        scale = mesh.moment_inertia[2, 2]
        for key, (i, j) in {"ixx": (0, 0), "iyy": (1, 1), "izz": (2, 2), "ixy": (0, 1)}.items():
            assert float(stated.get(key)) == pytest.approx(mesh.moment_inertia[i, j], abs=1e-6 * scale)
        place = [float(v) for v in inertial.find("origin").get("xyz").split()]
        np.testing.assert_allclose(place, mesh.center_mass, atol=1e-8)


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
