"""The spiral shaft of 2018 from Python."""

import math

import centrode as ct
import numpy as np
import pytest


@pytest.fixture(scope="module")
def shaft():
    return ct.SpiralShaft.for_moved_distance(2.05, window=math.pi / 3, lead=20)


def test_the_amplitude_is_solved(shaft):
    assert shaft.amplitude == pytest.approx(1.283333, abs=1e-6)
    assert shaft.moved(-math.pi / 6, math.pi / 6) == pytest.approx(2.05, abs=1e-12)
    assert shaft.moved_in_window == pytest.approx(2.05, abs=1e-12)
    assert shaft == ct.SpiralShaft.for_moved_distance(2.05, window=math.pi / 3)
    assert shaft != ct.SpiralShaft(amplitude=1.0)


def test_motion_over_the_cycle_is_consistent_and_closes(shaft):
    assert shaft.cycle == pytest.approx(28 * 2 * math.pi, rel=1e-15)
    theta = np.linspace(0, shaft.cycle, 20001)
    place, speed = shaft.position(theta), shaft.velocity(theta)
    assert abs(place[-1] - place[0]) < 1e-12
    step = theta[1] - theta[0]
    np.testing.assert_allclose(np.gradient(place, step)[1:-1], speed[1:-1], atol=1e-3)
    np.testing.assert_allclose(np.gradient(speed, step)[2:-2], shaft.acceleration(theta)[2:-2], atol=2e-2)
    turns = np.count_nonzero(np.diff(np.sign(speed)) != 0)
    assert turns == 2
    np.testing.assert_allclose(np.tan(shaft.lead_angle(theta)) * 15, speed, atol=1e-12)


def test_published_forces(shaft):
    theta = np.linspace(0, 2 * math.pi, 100001)
    force = shaft.force(theta, speed_rpm=200, mass=10, groove_friction=0.10, rail_friction=0.15)
    assert force.normal.max() == pytest.approx(21.275002, abs=1e-6)
    assert force.normal.min() == pytest.approx(9.484193, abs=1e-6)
    np.testing.assert_allclose(force.torque, force.transverse * 15, rtol=1e-14)
    smooth = shaft.force(theta, groove_friction=0)
    np.testing.assert_allclose(smooth.torque, smooth.push * shaft.velocity(theta), rtol=1e-12)


def test_the_developed_walls_keep_their_distance(shaft):
    developed = shaft.developed(1e-4)
    left, right = developed["left"], developed["right"]
    np.testing.assert_allclose(np.hypot(*(left[0] - right[0])), 10, rtol=1e-12)
    assert developed["center"][-1, 0] == pytest.approx(15 * shaft.cycle)


def test_crossings_and_report(shaft):
    crossings = shaft.crossings()
    assert crossings.shape == (27, 4)
    report = shaft.check()
    assert report.ok
    assert report.values["contact_limit_rpm"] == pytest.approx(323.36, abs=0.01)


def test_the_mesh_is_closed():
    trimesh = pytest.importorskip("trimesh")
    vertices, faces = ct.SpiralShaft(amplitude=1.28, holes=4).mesh(tolerance=0.02)
    mesh = trimesh.Trimesh(vertices, faces, process=False)
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    assert mesh.volume > 0


def test_other_laws():
    rotated = ct.SpiralShaft(amplitude=1.283333, rotated=True)
    assert rotated.moved_in_window == pytest.approx(2.041344, abs=1e-6)
    table = ct.SpiralShaft(speed=[0.6, 0.8, 1.1, 1.3, 1.3, 1.3, 1.1, 0.8])
    assert table.amplitude is None
    assert table.moved(0, 2 * math.pi) == pytest.approx(20)
    formula = ct.SpiralShaft(expression="1 - 0.4*cos(phi)")
    assert formula.speed_ratio == pytest.approx((0.6, 1.4))


def test_files_are_written(tmp_path):
    paths = ct.SpiralShaft(amplitude=1.28, holes=3).export(tmp_path, formats=["dxf", "csv"], tolerance=0.05)
    names = [path.name for path in paths]
    assert names[:3] == ["groove.dxf", "shaft.dxf", "slider.dxf"]
    assert (tmp_path / "groove.ngc").read_text().endswith("M2\n")


@pytest.mark.parametrize(
    ("keywords", "key"),
    [
        ({"lead": 0}, "lead"),
        ({"amplitude": 3.5}, "law.amplitude"),
        ({"groove_width": 19.9}, "groove.width"),
        ({"groove_depth": 15}, "groove.depth"),
        ({"reversal_angle": 1.0}, "reversal.angle_deg"),
        ({"reversal_law": "sideways"}, "reversal.law"),
        ({"holes": -1}, "holes"),
        ({"mass": 0}, "load.mass"),
    ],
)
def test_bad_input_names_its_key(keywords, key):
    with pytest.raises(ct.DesignError) as caught:
        ct.SpiralShaft(**keywords)
    assert caught.value.key == key


def test_a_tolerance_must_be_a_length(shaft):
    for tolerance in (0, -1, math.nan):
        with pytest.raises(ct.DesignError) as caught:
            shaft.developed(tolerance)
        assert caught.value.key == "tolerance"


def test_a_design_file_reads_back(shaft, tmp_path):
    assert ct.SpiralShaft.from_toml(shaft.to_toml()) == shaft
    path = tmp_path / "shaft.toml"
    path.write_text(ct.template("spiral-shaft"))
    assert ct.load(path).amplitude == pytest.approx(1.283333, abs=1e-6)
