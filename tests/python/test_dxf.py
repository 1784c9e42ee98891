import ezdxf
import pytest
from ezdxf import units
from reading import GEARS, contours, outline

FILES = ("driver.dxf", "driven.dxf", "assembly.dxf")


@pytest.mark.parametrize("name", FILES)
def test_the_audit_finds_nothing(exported, name):
    document = ezdxf.readfile(exported / name)
    audit = document.audit()
    assert not audit.errors, [error.message for error in audit.errors]
    assert not audit.fixes, [fix.message for fix in audit.fixes]


@pytest.mark.parametrize("name", FILES)
def test_units_are_millimetres(exported, name):
    header = ezdxf.readfile(exported / name).header
    assert header["$INSUNITS"] == units.MM
    assert header["$MEASUREMENT"] == 1  # metric


@pytest.mark.parametrize("name", FILES)
def test_a_program_opens_the_drawing_whole_with_the_widths_of_its_layers(exported, name):
    document = ezdxf.readfile(exported / name)
    view = document.viewports.get("*Active")[0].dxf
    low, high = document.header["$EXTMIN"], document.header["$EXTMAX"]
    assert list(view.center)[:2] == pytest.approx([(low[0] + high[0]) / 2, (low[1] + high[1]) / 2])
    assert view.height >= high[1] - low[1]
    assert view.height * view.aspect_ratio >= high[0] - low[0]
    for entity in document.modelspace():
        assert document.layers.get(entity.dxf.layer).dxf.lineweight == entity.dxf.lineweight > 0


@pytest.mark.parametrize("option", ["r2010", "r12"])
def test_measurement_is_metric(exported, run, tmp_path, option):
    run("export", exported.design, "--to", tmp_path, "--format", "dxf,sheet", "--dxf", option)
    files = sorted(tmp_path.glob("*.dxf"))
    assert len(files) > 3
    for file in files:
        assert ezdxf.readfile(file).header["$MEASUREMENT"] == 1, file.name


@pytest.mark.parametrize("gear", GEARS)
def test_the_profile_is_one_closed_simple_contour_of_few_arcs(exported, gear):
    document = ezdxf.readfile(exported / f"{gear}.dxf")
    profile = [e for e in document.modelspace() if "profile" in e.dxf.layer.lower()]
    assert [e.dxftype() for e in profile] == ["LWPOLYLINE"]
    assert profile[0].closed
    assert len(profile[0]) <= 20 * exported.report()["values"].get(f"{gear}_tooth_count", 100)
    assert any(bulge for *_, bulge in profile[0].get_points("xyb"))
    (polygon,) = contours(exported / f"{gear}.dxf")
    assert polygon.is_valid
    assert polygon.exterior.is_ccw


@pytest.mark.parametrize("gear", GEARS)
def test_the_contour_is_within_tolerance_of_the_outline(exported, gear):
    (polygon,) = contours(exported / f"{gear}.dxf")
    exact = outline(exported.folder, gear)
    # Both within 0.001 mm of the profile, and flattened by 0.001 again at most.
    assert polygon.exterior.hausdorff_distance(exact.exterior) < 3e-3


@pytest.mark.parametrize(("option", "kind"), [("r12", "POLYLINE"), ("spline", "SPLINE")])
def test_other_programs_read_the_other_flavours(exported, run, tmp_path, option, kind):
    run("export", exported.design, "--to", tmp_path, "--format", "dxf", "--dxf", option)
    for gear in GEARS:
        document = ezdxf.readfile(tmp_path / f"{gear}.dxf")
        audit = document.audit()
        assert not audit.errors
        assert not audit.fixes
        kinds = {e.dxftype() for e in document.modelspace() if "profile" in e.dxf.layer.lower()}
        assert kind in kinds
        polygons = contours(tmp_path / f"{gear}.dxf")
        if kind == "POLYLINE":
            exact = outline(exported.folder, gear)
            assert polygons[0].exterior.hausdorff_distance(exact.exterior) < 3e-3
