"""3MF packages as two other programs read them."""

import lib3mf
import numpy as np
import pytest
import trimesh
from reading import GEARS


@pytest.mark.parametrize("gear", GEARS)
def test_the_package_holds_the_mesh_of_the_stl(exported, gear):
    mesh = trimesh.load_mesh(exported / f"{gear}.3mf")
    assert mesh.units == "millimeter"
    assert mesh.is_watertight
    assert mesh.is_volume
    stl = trimesh.load_mesh(exported / f"{gear}.stl")
    assert mesh.volume == pytest.approx(stl.volume, rel=1e-7)
    np.testing.assert_allclose(mesh.bounds, stl.bounds, atol=1e-6)


@pytest.mark.parametrize("gear", GEARS)
def test_the_reference_reader_takes_it_strictly(exported, gear):
    model = lib3mf.get_wrapper().CreateModel()
    reader = model.QueryReader("3mf")
    reader.SetStrictModeActive(True)
    reader.ReadFromFile(str(exported / f"{gear}.3mf"))
    assert reader.GetWarningCount() == 0
    assert model.GetUnit() == lib3mf.ModelUnit.MilliMeter
    objects = model.GetMeshObjects()
    assert objects.Count() == 1
    objects.MoveNext()
    mesh = objects.GetCurrentMeshObject()
    assert mesh.GetName() == gear
    assert mesh.IsManifoldAndOriented()
