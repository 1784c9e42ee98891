import json
import math
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

import jsonschema
import mujoco
import numpy as np
import pytest
import trimesh
from conftest import centrode
from reading import GEARS, outline, rows
from shapely.geometry import MultiPoint

TEETH = {"elliptic": (23, 23), "two-to-one": (24, 48), "circle": (20, 20)}


@pytest.fixture
def model(exported):
    return mujoco.MjModel.from_xml_path(str(exported / "machine.xml"))


def play(folder, *arguments, script="play_mujoco.py"):
    """The script's verdict."""
    command = [sys.executable, str(folder / script), "--check", *arguments]
    done = subprocess.run(command, check=True, capture_output=True, text=True, timeout=120, cwd="/")
    return json.loads(done.stdout.splitlines()[-1])


def place(model, data, table, row):
    """Puts both joints where a row has them, by hand rather than by the script."""
    for joint, angle in (
        ("driver_joint", -table["driver_angle_rad"][row]),
        ("driven_joint", table["driven_angle_rad"][row]),
    ):
        data.qpos[model.joint(joint).qposadr] = angle
    mujoco.mj_forward(model, data)


def inertia(model, gear):
    """A body's inertia tensor in the axes of the link, kg m²."""
    body = model.body(gear)
    turn = np.empty(9)
    mujoco.mju_quat2Mat(turn, body.iquat)
    turn = turn.reshape(3, 3)
    return turn @ np.diag(body.inertia) @ turn.T


def test_a_gear_touches_with_its_teeth_and_its_hub(exported, model):
    for gear, teeth in zip(GEARS, TEETH[exported.name], strict=True):
        body = model.body(gear)
        geoms = range(body.geomadr[0], body.geomadr[0] + body.geomnum[0])
        assert sum(model.geom_contype[g] > 0 for g in geoms) == teeth + 1
        assert sum(model.geom_contype[g] == 0 for g in geoms) == 1
    assert model.njnt == 2
    assert model.neq == (exported.name == "circle")


def test_the_bodies_to_touch_with_are_in_the_gear(exported):
    root = ElementTree.parse(exported / "machine.xml").getroot()
    for gear in GEARS:
        whole = outline(exported, gear)
        bodies = {
            mesh.get("name"): 1e3 * np.array(mesh.get("vertex").split(), dtype=float).reshape(-1, 3)
            for mesh in root.iter("mesh")
            if mesh.get("vertex") and mesh.get("name").startswith(gear)
        }
        for name, points in bodies.items():
            section = MultiPoint(points[:, :2]).convex_hull
            assert section.area > (100.0 if name.endswith("hub") else 1.0)
            assert section.difference(whole.buffer(1.1e-3)).is_empty, name


def test_inertias_are_those_of_the_solid(model, fine):
    for gear in GEARS:
        mesh = trimesh.load_mesh(fine / f"{gear}.stl")
        mesh.apply_scale(1e-3)
        mesh.density = 7850.0
        body = model.body(gear)
        assert body.mass[0] == pytest.approx(mesh.mass, rel=1e-6)
        np.testing.assert_allclose(body.ipos, mesh.center_mass, atol=1e-8)
        scale = mesh.moment_inertia[2, 2]
        np.testing.assert_allclose(inertia(model, gear), mesh.moment_inertia, atol=1e-6 * scale)


def test_placed_by_the_table_no_teeth_overlap(exported, model):
    table = rows(exported / "motion.csv")
    data = mujoco.MjData(model)
    deepest = 0.0
    for row in range(0, len(table["driver_angle_rad"]), 4):
        place(model, data, table, row)
        deepest = max(deepest, *(-data.contact.dist), 0.0)
    assert deepest < 2e-6  # metres
    # The bodies do touch: a driven gear a quarter of a tooth too far does not fit.
    pitch = 2 * math.pi / TEETH[exported.name][1]
    data.qpos[model.joint("driven_joint").qposadr] += pitch / 4
    mujoco.mj_forward(model, data)
    assert np.any(data.contact.dist < -1e-4)


def test_the_sidecar_describes_the_table(exported):
    about = json.loads((exported / "motion.json").read_text())
    table = rows(exported / "motion.csv")
    assert [column["name"] for column in about["columns"]] == list(table)
    assert about["rows"] == len(table["ratio"])
    driver, driven = table["driver_angle_rad"], table["driven_angle_rad"]
    advance = {column["name"]: column["advance"] for column in about["columns"]}
    assert advance["driver_angle_rad"] == pytest.approx(driver[-1], rel=1e-12)
    assert advance["driven_angle_rad"] == pytest.approx(driven[-1], rel=1e-9)
    line = {joint["name"]: joint["linear"] for joint in about["joints"]}["driven_joint"]
    off = np.abs(driven - line["multiplier"] * driver - line["offset"]).max()
    assert line["error_max"] == pytest.approx(off, rel=1e-3, abs=1e-9)
    assert (line["error_max"] < 1e-9) == (exported.name == "circle")
    # The bound between rows holds on every second row, taken over twice the step: four times the error.
    between = np.abs(driven[1:-1] - (driven[:-2] + driven[2:]) / 2).max()
    reach = np.hypot(*np.array(outline(exported, "driven").exterior.coords).T).max()
    assert reach * between <= 4.01 * about["interpolation"]["linear_error_max_mm"] + 1e-12


def test_the_sidecar_keeps_to_its_schema(exported):
    schema = json.loads(centrode("schema", "motion").stdout)
    about = json.loads((exported / "motion.json").read_text())
    jsonschema.Draft202012Validator(schema).validate(about)
    assert (about["format"], about["version"]) == ("centrode-motion", 1)


def test_the_script_plays_the_law(exported, tmp_path):
    result = play(exported.folder)
    assert result["mode"] == "law"
    assert result["joints"]["driven_joint"]["off_max"] < 1e-11
    assert result["penetration_max_mm"] < 2e-3


@pytest.mark.parametrize("way", [(), ("--backward",)])
def test_teeth_alone_carry_the_driven_gear_by_the_law(exported, way):
    result = play(exported.folder, "--contact", "--speed", "2", "--cycles", "2", *way)
    assert result["cycles"] == (-2 if way else 2)
    found = {name: math.degrees(off) for name, off in result["joints"]["driven_joint"].items()}
    assert found["off_range"] < 0.02
    # The rest is half the backlash: 0.025 mm along the normal, on the driven gear of some 36 mm radius.
    assert found["off_max"] < (0.06 if exported.name == "two-to-one" else 0.02)


def test_without_teeth_the_driven_gear_does_not_follow(exported, tmp_path):
    shutil.copytree(exported.folder, tmp_path, dirs_exist_ok=True)
    model = tmp_path / "machine.xml"
    bare = model.read_text().replace('<geom type="mesh" condim="1"', '<geom type="mesh" contype="0" conaffinity="0"')
    assert bare != model.read_text()
    model.write_text(bare)
    assert math.degrees(play(tmp_path, "--contact", "--speed", "2")["joints"]["driven_joint"]["off_range"]) > 10
