"""Every design and every template as simulators meet it first: read without complaint, assembled, and set going."""

import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from collections import Counter

import mujoco
import numpy as np
import pytest
from conftest import BINARY, ROOT
from sample import sampled

SHIPPED = sorted(path.stem for path in (ROOT / "tests" / "designs").glob("*.toml"))
FAMILIES = ["gear-pair", "three-arm", "moving-box", "spiral-shaft", "feeder"]
MOST_FACES = 100_000
# Gears rest in the middle of their backlash; convex bodies project from the flanks by a micrometre.
DEEPEST = 3e-6


@pytest.fixture(scope="module", params=sampled([*SHIPPED, *(f"new {family}" for family in FAMILIES)]))
def folder(request, tmp_path_factory):
    """The models of a design, and what they show, exported as the command does by itself."""
    folder = tmp_path_factory.mktemp("start")
    design = ROOT / "tests" / "designs" / f"{request.param}.toml"
    if request.param.startswith("new "):
        design = folder / "design.toml"
        template = subprocess.run([BINARY, *request.param.split()], check=True, capture_output=True)
        design.write_bytes(template.stdout)
    command = [BINARY, "export", design, "--to", folder / "out", "--format", "urdf,mjcf"]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode == 2:
        pytest.skip(f"not made: {done.stderr}")
    return folder / "out"


def models(folder, kind):
    found = sorted(folder.glob(f"*.{kind}"))
    assert found
    return found


def test_no_mesh_is_too_large_for_a_simulator(folder):
    meshes = list(folder.rglob("*.stl"))
    assert meshes
    for path in meshes:
        # A binary STL file is 84 bytes and 50 a triangle.
        assert (path.stat().st_size - 84) // 50 <= MOST_FACES, path.name


def test_mujoco_reads_both_models_without_a_word(folder):
    for path in [*models(folder, "xml"), *models(folder, "urdf")]:
        script = f"import mujoco; mujoco.MjModel.from_xml_path({str(path)!r})"
        done = subprocess.run([sys.executable, "-c", script], check=True, capture_output=True, text=True, cwd=folder)
        assert done.stdout + done.stderr == ""


def test_names_are_there_once(folder):
    for path in models(folder, "urdf"):
        robot = ElementTree.parse(path).getroot()
        for kind in ("link", "joint", "collision"):
            names = Counter(one.get("name") for one in robot.iter(kind))
            assert not [name for name, count in names.items() if count > 1]


def test_the_machine_is_assembled_at_rest_and_moves(folder):
    for path in [*models(folder, "xml"), *models(folder, "urdf")]:
        model = mujoco.MjModel.from_xml_path(str(path))
        data = mujoco.MjData(model)
        mujoco.mj_forward(model, data)
        assert max([0.0, *(-data.contact.dist)]) < DEEPEST, path.name
        model.opt.timestep = 2e-4
        for _ in range(50):
            mujoco.mj_step(model, data)
        assert np.isfinite(data.qpos).all()
        assert np.isfinite(data.qvel).all()
        assert not any(warning.number for warning in data.warning)
