"""Random valid designs: every file is the same twice, and other programs read it without complaint."""

import subprocess

import ezdxf
import lib3mf
import mujoco
import trimesh
import yourdfpy
from conftest import BINARY
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from OCP.BRepCheck import BRepCheck_Analyzer
from OCP.IFSelect import IFSelect_RetDone
from OCP.STEPControl import STEPControl_Reader
from OCP.TopAbs import TopAbs_SOLID
from reading import GEARS

CURVES = st.one_of(
    st.floats(0.0, 0.35).map(lambda k: ((1, 1), f'kind = "ellipse"\neccentricity = {k!r}')),
    st.floats(0.0, 0.2).map(lambda k: ((2, 1), f'kind = "lobed-ellipse"\nlobes = 1\neccentricity = {k!r}')),
    st.tuples(st.floats(0.0, 0.1), st.integers(1, 4)).map(
        lambda c: ((1, 1), f'kind = "polar"\nexpression = "1 + {c[0]!r}*cos({c[1]}*phi)"')
    ),
    st.floats(0.0, 0.2).map(
        lambda a: ((1, 1), f'kind = "transmission"\nexpression = "phi - {a!r}*sin(phi)"'),
    ),
)


@st.composite
def designs(draw):
    """A design file; its curve may prove impossible for the mean ratio."""
    ratio, curve = draw(CURVES)
    module = draw(st.floats(0.3, 6.0))
    teeth = draw(st.integers(24, 50))
    radius = module * teeth / 2
    bore = draw(st.floats(0.05, 0.4)) * radius
    width = draw(st.floats(0.5, 40.0))
    keyway = draw(st.sampled_from(["", f"keyway = {{ width = {0.3 * bore!r}, depth = {0.15 * bore!r} }}"]))
    return f"""
family = "gear-pair"
mean_ratio = {list(ratio)}
[pitch]
{curve}
module = {module!r}
tooth_count = {teeth}
[teeth]
addendum = "{draw(st.sampled_from(["full", "fitted"]))}"
backlash = {draw(st.floats(0.0, 0.05)) * module!r}
[driver]
width = {width!r}
bore = {bore!r}
{keyway}
[driven]
width = {width!r}
"""


def export(design, folder):
    """Every file; whether the pair does its job or not, but not what is no pair."""
    command = [BINARY, "export", "-", "--to", folder, "--tolerance", "0.003", "--format", "all"]
    done = subprocess.run(command, input=design, capture_output=True, text=True, timeout=60, check=False)
    assume(done.returncode != 2)
    return {path.relative_to(folder): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def read_back(folder):
    """Opens every file with a program that knows nothing of gears."""
    for file in folder.glob("*.dxf"):
        audit = ezdxf.readfile(file).audit()
        assert not audit.errors
        assert not audit.fixes
    for gear in GEARS:
        for kind in ("stl", "3mf"):
            assert trimesh.load_mesh(folder / f"{gear}.{kind}").is_volume
        reader = lib3mf.get_wrapper().CreateModel().QueryReader("3mf")
        reader.SetStrictModeActive(True)
        reader.ReadFromFile(str(folder / f"{gear}.3mf"))
        assert reader.GetWarningCount() == 0
        step = STEPControl_Reader()
        assert step.ReadFile(str(folder / f"{gear}.step")) == IFSelect_RetDone
        assert step.TransferRoots() == 1
        assert step.OneShape().ShapeType() == TopAbs_SOLID
        assert BRepCheck_Analyzer(step.OneShape()).IsValid()
    for model in ("machine.xml", "machine.urdf"):
        assert mujoco.MjModel.from_xml_path(str(folder / model)).njnt == 2
    assert yourdfpy.URDF.load(str(folder / "machine.urdf"), load_collision_meshes=True).validate()


@settings(
    max_examples=4,
    derandomize=True,
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)
@given(design=designs())
def test_every_file_is_the_same_twice_and_reads_back(tmp_path_factory, design):
    folder, again = tmp_path_factory.mktemp("first"), tmp_path_factory.mktemp("again")
    files = export(design, folder)
    assert len(files) > 50
    assert export(design, again) == files
    read_back(folder)
