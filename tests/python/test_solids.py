import numpy as np
import pytest
import trimesh
from reading import GEARS, contours, rows

WIDTH = {"elliptic": 12.0, "two-to-one": 10.0, "circle": 10.0}


def section(folder, gear):
    """Area of the profile less its bore, from the cutting file."""
    (profile,) = contours(folder / f"{gear}.dxf")
    try:
        holes = contours(folder / f"{gear}.dxf", "hole")
    except AssertionError:
        holes = []
    for hole in holes:
        profile = profile.difference(hole)
    return profile


@pytest.mark.parametrize("gear", GEARS)
def test_the_mesh_is_a_solid_of_the_sections_volume(exported, gear):
    mesh = trimesh.load_mesh(exported / f"{gear}.stl")
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    assert mesh.is_volume
    assert mesh.volume > 0
    face = section(exported.folder, gear)
    assert mesh.volume == pytest.approx(face.area * WIDTH[exported.name], rel=1e-4)
    np.testing.assert_allclose(mesh.center_mass[:2], face.centroid.coords[0], atol=2e-3)
    assert np.ptp(mesh.vertices[:, 2]) == pytest.approx(WIDTH[exported.name], rel=1e-6)


@pytest.mark.parametrize("gear", GEARS)
def test_outline_normals_are_unit_and_point_outwards(exported, gear):
    table = rows(exported / f"{gear}.csv")
    x, y, nx, ny = (table[name] for name in ("x_mm", "y_mm", "normal_x", "normal_y"))
    np.testing.assert_allclose(np.hypot(nx, ny), 1, atol=1e-9)
    ahead = np.column_stack([np.roll(x, -1) - x, np.roll(y, -1) - y])
    # Counter-clockwise: outside is to the right of the way on, but at corners of the profile.
    right = ahead[:, 1] * nx - ahead[:, 0] * ny
    assert np.mean(right > 0) > 0.95


def test_every_file_is_the_same_bytes_again(exported, run, tmp_path):
    run("export", exported.design, "--to", tmp_path, "--tolerance", "0.001", "--format", "all")
    files = sorted(p.relative_to(exported.folder) for p in exported.folder.rglob("*") if p.is_file())
    assert files
    for file in files:
        assert (tmp_path / file).read_bytes() == (exported / file).read_bytes(), file
