"""The whole machine as one 3MF package, read by two other programs."""

import csv

import centrode as ct
import ezdxf
import lib3mf
import numpy as np
import pytest
import trimesh
from conftest import ROOT
from ezdxf import bbox
from reading import is_mounted
from sample import DESIGNS as SAMPLE
from sample import sampled

# Gears in place, loops, cams on forks, a shaft with a groove.
DESIGNS = ("elliptic-pair-2018", "jansen-leg", "feeder-2022", "three-arm-2021", "spiral-shaft-2018")


def read(file):
    model = lib3mf.get_wrapper().CreateModel()
    reader = model.QueryReader("3mf")
    reader.SetStrictModeActive(True)
    reader.ReadFromFile(str(file))
    assert reader.GetWarningCount() == 0
    return model


def every(iterator, current):
    while iterator.MoveNext():
        yield getattr(iterator, current)()


@pytest.mark.parametrize("name", sampled(DESIGNS, of={*DESIGNS} - {"spiral-shaft-2018"}))
def test_every_body_is_closed_and_stands_where_its_link_does(name, shipped):
    model = read(shipped(name, "3mf,dxf") / "assembly.3mf")
    assert model.GetUnit() == lib3mf.ModelUnit.MilliMeter
    meshes = {m.GetResourceID(): m for m in every(model.GetMeshObjects(), "GetCurrentMeshObject")}
    assert meshes
    assert all(mesh.IsManifoldAndOriented() and mesh.GetName() for mesh in meshes.values())
    machine = ct.load(ROOT / "tests" / "designs" / f"{name}.toml")
    frames = machine.frames(0.0)
    seen = set()
    for item in every(model.GetBuildItems(), "GetCurrent"):
        link = item.GetPartNumber()
        seen.add(link)
        fields = np.array([list(row) for row in item.GetObjectTransform().Fields])
        found = np.eye(4)
        found[:3, :] = fields.T
        # Shafts and pins are mounted on their links.
        if name != "three-arm-2021" and not is_mounted(item.GetObjectResource().GetName()):
            # The arrangement shows this machine as an arm picks, all others where the cycle begins.
            np.testing.assert_allclose(found, np.reshape(frames[link], (4, 4)), atol=2e-6)
        turn = found[:3, :3]
        np.testing.assert_allclose(turn @ turn.T, np.eye(3), atol=1e-6)
    assert seen
    assert seen <= set(frames)


def test_pieces_are_colored_and_a_body_is_written_once(shipped):
    model = read(shipped("three-arm-2021", "3mf,dxf") / "assembly.3mf")
    names = [mesh.GetName() for mesh in every(model.GetMeshObjects(), "GetCurrentMeshObject")]
    assert len(names) == len(set(names))
    items = list(every(model.GetBuildItems(), "GetCurrent"))
    # Three arms of each body.
    assert len(items) > 2 * len(names)
    groups = list(every(model.GetBaseMaterialGroups(), "GetCurrentBaseMaterialGroup"))
    assert sum(group.GetCount() for group in groups) == len(names)
    materials = [group.GetName(index) for group in groups for index in group.GetAllPropertyIDs()]
    assert {"steel", "aluminium alloy"} < set(materials)


@pytest.mark.parametrize(
    "name", sampled([*DESIGNS, "composed-feeder", "composed-three-arm", "press"], of={*SAMPLE} - {"spiral-shaft-2018"})
)
def test_everything_that_is_made_and_bought_is_a_closed_body(name, shipped):
    folder = shipped(name, "3mf,csv,dxf")
    with (folder / "parts.csv").open(newline="") as lines:
        listed = list(csv.DictReader(lines))
    # Of a shaft that is given no place is known, nor of its key.
    given = [row["links"] for row in listed if row["supply"] == "given" and row["part"].startswith("Shaft of")]
    given = {link for links in given for link in links.split()}
    rows = [
        row for row in listed if row["files"] or (row["supply"] == "bought" and not given & {*row["links"].split()})
    ]
    model = read(folder / "assembly.3mf")
    names = [mesh.GetName() for mesh in every(model.GetMeshObjects(), "GetCurrentMeshObject")]
    items = list(every(model.GetBuildItems(), "GetCurrent"))
    assert len(items) == sum(int(row["quantity"]) for row in rows)
    bodies = trimesh.load(folder / "assembly.3mf").geometry.values()
    assert len(bodies) == len(names)
    assert all(body.is_watertight and body.volume > 0 for body in bodies)


@pytest.mark.parametrize("name", ["jansen-leg", "feeder-2022"])
def test_seen_from_above_it_is_the_drawing_in_place(name, shipped):
    folder = shipped(name, "3mf,dxf")
    scene = trimesh.load(folder / "assembly.3mf")
    entities = [e for e in ezdxf.readfile(folder / "assembly.dxf").modelspace() if e.dxftype() == "LWPOLYLINE"]
    drawn = bbox.extents([e for e in entities if e.dxf.layer not in ("PATH", "SCENERY")], fast=False)
    # The gears of the feeder have a drawing of their own.
    bounds = [
        scene.geometry[scene.graph[node][1]].copy().apply_transform(scene.graph[node][0]).bounds
        for node in scene.graph.nodes_geometry
        if not scene.graph[node][1].startswith("gear-")
    ]
    low, high = np.min(bounds, axis=(0, 1)), np.max(bounds, axis=(0, 1))
    drawn = [drawn.extmin.x, drawn.extmin.y, drawn.extmax.x, drawn.extmax.y]
    np.testing.assert_allclose([*low[:2], *high[:2]], drawn, atol=5e-3)
