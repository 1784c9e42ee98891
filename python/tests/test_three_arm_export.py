"""The files of the three-arm mechanism, read back by others: ezdxf, trimesh, yourdfpy, MuJoCo."""

import json
import subprocess
import sys
from pathlib import Path

import centrode as ct
import numpy as np
import pytest

DESIGN = Path(__file__).resolve().parents[2] / "tests" / "designs" / "three-arm-2021.toml"
PARTS = ["sun", "intermediate", "planet", "cam", "fork", "roller", "carrier", "housing", "cover-rear", "cover-front"]
PARTS += ["clamp", "push-rod"]


@pytest.fixture(scope="module")
def arms():
    return ct.ThreeArm.load(DESIGN)


@pytest.fixture(scope="module")
def folder(arms, tmp_path_factory):
    folder = tmp_path_factory.mktemp("arms")
    arms.export(folder, formats="all")
    return folder


def test_options_reach_the_writers(arms, tmp_path):
    files = arms.files(formats=["dxf", "stl"], parts=["cam", "fork"], tolerance=0.01)
    assert list(files) == ["cam.dxf", "cam.stl", "fork.dxf", "fork.stl"]
    with pytest.raises(ct.DesignError, match="parts"):
        arms.export(tmp_path / "out", parts=["driver"])
    assert not (tmp_path / "out").exists()


def test_drawings_and_sheets_are_clean(folder):
    ezdxf = pytest.importorskip("ezdxf")
    drawings = sorted(folder.glob("*.dxf"))
    assert len(drawings) >= 2 * len(PARTS)
    for path in drawings:
        document = ezdxf.readfile(path)
        assert not document.audit().has_errors, path.name
    for part in PARTS:
        space = ezdxf.readfile(folder / f"{part}.dxf").modelspace()
        assert len(space.query('*[layer=="PROFILE"]')) == 1, part


def test_solids_are_closed(folder):
    trimesh = pytest.importorskip("trimesh")
    for part in PARTS:
        mesh = trimesh.load(folder / f"{part}.stl")
        assert mesh.is_watertight, part
        assert mesh.volume > 0, part


def test_the_cam_table_is_on_the_drawn_profile(folder):
    ezdxf = pytest.importorskip("ezdxf")
    table = np.genfromtxt(folder / "cam.csv", delimiter=",", names=True, dtype=None, encoding="utf-8")
    (profile,) = ezdxf.readfile(folder / "cam.dxf").modelspace().query('LWPOLYLINE[layer=="PROFILE"]')
    from ezdxf.path import make_path

    points = np.array([(p.x, p.y) for p in make_path(profile).flattening(1e-4)])
    a, b = points, np.roll(points, -1, axis=0)
    for row in table[::15]:
        if row["state"] != "sound":
            continue
        p = np.array([row["x_mm"], row["y_mm"]])
        t = np.clip(((p - a) * (b - a)).sum(1) / np.maximum(((b - a) ** 2).sum(1), 1e-30), 0, 1)
        off = np.linalg.norm(a + t[:, None] * (b - a) - p, axis=1).min()
        assert off < 2.5e-3


def test_mujoco_follows_our_tips(arms, folder):
    pytest.importorskip("mujoco")
    run = [sys.executable, str(folder / "play_mujoco.py"), "--check"]
    found = json.loads(subprocess.run(run, check=True, capture_output=True, text=True).stdout)
    assert found["point_off_max_m"] < 1e-6
    # The table is our motion, and straight lines between rows deviate by no more than the stated value.
    table = np.genfromtxt(folder / "motion.csv", delimiter=",", names=True)
    about = json.loads((folder / "motion.json").read_text())
    theta = table["carrier_turn_rad"]
    middle = (theta[1:] + theta[:-1]) / 2
    for arm in range(3):
        ours = arms.tip(theta, arm)
        written = np.column_stack([table[f"tip_{arm}_x_mm"], table[f"tip_{arm}_y_mm"]])
        assert np.abs(ours - written).max() < 1e-9
        planet = table[f"planet_{arm}_rad"]
        between = np.interp(middle, theta, planet)
        pose = arms.pose(middle)
        exact = pose[f"planet-{arm}"][:, 2] - pose["carrier"][:, 2]
        assert 145 * np.abs(between - exact).max() < 1.01 * about["interpolation"]["linear_error_max_mm"]
        rod = np.interp(middle, theta, table[f"push_rod_{arm}_mm"])
        assert np.abs(rod + arms.push_rod(middle, arm)).max() < 1.01e-3


def test_pybullet_follows_our_tips(folder):
    pybullet = pytest.importorskip("pybullet", reason="has wheels up to Python 3.11 only")
    run = [sys.executable, str(folder / "play_pybullet.py"), "--check"]
    done = subprocess.run(run, check=True, capture_output=True, text=True, cwd="/")
    found = json.loads(done.stdout.splitlines()[-1])
    assert found["rows"] > 500
    assert found["point_off_max_m"] < 1e-6
    client = pybullet.connect(pybullet.DIRECT)
    body = pybullet.loadURDF(str(folder / "machine.urdf"), useFixedBase=True)
    links = {pybullet.getJointInfo(body, i)[12].decode(): i for i in range(pybullet.getNumJoints(body))}
    shapes = {name: len(pybullet.getCollisionShapeData(body, links[name])) for name in links}
    pybullet.disconnect(client)
    # A hub and a body or more a tooth; planets are suns.
    assert shapes["sun"] == shapes["planet_2"] > 37
    assert shapes["intermediate_1"] > 37
    assert shapes["arm_0"] >= 3
    assert shapes["carrier"] == shapes["tray"] == shapes["ground"] == 0


def test_the_bodies_to_touch_with_are_those_of_the_arm(arms, folder):
    trimesh = pytest.importorskip("trimesh")
    shapely = pytest.importorskip("shapely")
    contour = shapely.Polygon(arms.arm_contour(1e-4))
    pieces = []
    for path in sorted((folder / "collision").glob("arm_*.stl")):
        mesh = trimesh.load(path)
        assert mesh.is_convex, path.name
        assert mesh.is_watertight, path.name
        pieces.append(shapely.MultiPoint(mesh.vertices[:, :2]).convex_hull)
    whole = shapely.union_all(pieces)
    # The push rod's end is the only part of the contour that is not among them.
    assert whole.difference(contour.buffer(0.05)).area < 1e-6
    assert contour.difference(whole).area < 0.02 * contour.area


def test_yourdfpy_reads_the_machine(arms, folder):
    yourdfpy = pytest.importorskip("yourdfpy")
    robot = yourdfpy.URDF.load(str(folder / "machine.urdf"))
    assert len(robot.link_map) == 5 + 6 * 3
    assert "no mimic joint, which is affine" in (folder / "machine.urdf").read_text()
    table = np.genfromtxt(folder / "motion.csv", delimiter=",", names=True)
    about = json.loads((folder / "motion.json").read_text())
    tips = {point["link"]: np.array([*point["at_mm"], 1e3]) * 1e-3 for point in about["points"]}
    for row in table[:: len(table) // 7]:
        robot.update_cfg({j["name"]: row[j["column"]] * j["factor"] + j["offset"] for j in about["joints"]})
        for arm in range(3):
            at = robot.get_transform(f"arm_{arm}", "base") @ tips[f"arm_{arm}"]
            ours = arms.tip(row["carrier_turn_rad"], arm) * 1e-3
            assert np.abs(at[:2] - ours).max() < 1e-9


@pytest.mark.campaign
def test_teeth_alone_carry_a_chain_of_the_design_that_meets_all_goals(tmp_path):
    pytest.importorskip("mujoco")
    text = (DESIGN.parent / "three-arm-all-goals.toml").read_text()
    # With so little play the planet's place within it does not count.
    assert "backlash = 0.05" in text
    machine = ct.ThreeArm.from_toml(text.replace("backlash = 0.05", "backlash = 0.01"))
    machine.export(tmp_path, formats=["mjcf"])
    run = [sys.executable, str(tmp_path / "play_mujoco.py"), "--check", "--contact", "--speed", "2"]
    run += ["--save", str(tmp_path / "found.csv"), "--plot", str(tmp_path / "found.png")]
    found = json.loads(subprocess.run(run, check=True, capture_output=True, text=True).stdout)
    planet = found["joints"]["planet_0_joint"]
    assert np.degrees(planet["off_max"]) < 0.05
    assert found["penetration_max_mm"] < 0.01
    rows = np.genfromtxt(tmp_path / "found.csv", delimiter=",", names=True)
    assert np.ptp(rows["travel_rad"]) > 6.2
    # The planet's speed wavers a little about its law, as teeth come and go.
    theta, step = rows["travel_rad"], 1e-4

    def turned(theta):
        pose = machine.pose(theta)
        return pose["planet-0"][:, 2] - pose["carrier"][:, 2]

    law = (turned(theta + step) - turned(theta - step)) / (2 * step)
    # The script takes the law's rate from the table.
    about = json.loads((tmp_path / "motion.json").read_text())
    table = np.genfromtxt(tmp_path / "motion.csv", delimiter=",", names=True)
    rate = {joint["name"]: joint["rate"] for joint in about["joints"]}["planet_0_joint"]
    np.testing.assert_allclose(np.interp(theta % (2 * np.pi), table["carrier_turn_rad"], table[rate]), law, atol=1e-4)
    off = rows["planet_0_joint_rate_off"]
    assert 0 < planet["rate_off_rms"] == pytest.approx(np.sqrt(np.mean(off**2)), rel=1e-6)
    assert planet["rate_off_rms"] < 0.02
    image = pytest.importorskip("matplotlib.image")
    grey = image.imread(tmp_path / "found.png")[..., :3].mean(axis=2)
    assert 0.001 < (grey < 0.8).mean() < 0.3
