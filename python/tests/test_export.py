"""Files from Python."""

import errno
import os
import subprocess
import sys
import threading

import centrode as ct
import pytest


def test_export_writes_the_files_and_names_them(pair, tmp_path):
    out = tmp_path / "a" / "b"
    paths = pair.export(out, formats=["dxf", "csv"], tolerance=0.01)
    files = pair.files(formats=["dxf", "csv"], tolerance=0.01)
    assert [path.name for path in paths] == list(files)
    assert sorted(path.name for path in out.iterdir()) == sorted([".centrode-files", *files])
    for path in paths:
        assert path.read_bytes() == files[path.name]
    names = list(pair.files(formats="all", tolerance=0.1))
    assert {name.rpartition(".")[2] for name in names} >= {"dxf", "svg", "stl", "step", "3mf", "csv", "urdf"}


def test_options_reach_the_writers(pair):
    def dxf(**options):
        return pair.files(formats=["dxf"], tolerance=0.01, **options)["driver.dxf"].decode()

    assert "LWPOLYLINE" in dxf()
    assert "AC1009" in dxf(dxf_version="R12")
    assert "SPLINE" in dxf(dxf_curves="splines")
    assert "PITCH_CURVE" in dxf(layers="all")
    assert len(pair.files(formats=["stl"], tolerance=0.1)["driver.stl"]) < len(
        pair.files(formats=["stl"])["driver.stl"]
    )


@pytest.mark.parametrize(
    ("options", "text"),
    [
        ({"formats": ["dwg"]}, "formats"),
        ({"dxf_version": "R14"}, "dxf_version"),
        ({"dxf_curves": "lines"}, "dxf_curves"),
        ({"layers": "some"}, "layers"),
        ({"tolerance": 0}, "tolerance"),
    ],
)
def test_unknown_words_write_nothing(pair, tmp_path, options, text):
    with pytest.raises(ct.DesignError, match=text):
        pair.export(tmp_path / "out", **options)
    assert not (tmp_path / "out").exists()


def test_what_cannot_be_made_is_an_export_error(pair):
    with pytest.raises(ct.ExportError, match="R12"):
        pair.files(formats=["dxf"], dxf_version="R12", dxf_curves="splines")
    with pytest.raises(ct.DesignError, match="formats must be one of"):
        pair.files(formats="paper")


def test_a_receiver_decides_formats_and_tolerance(pair):
    def kinds(**options):
        return {name.rpartition(".")[2] for name in pair.files(**options)}

    assert kinds() == {"dxf", "svg", "pdf", "csv", "step", "3mf"}
    assert kinds(formats="laser") == {"dxf", "svg"}
    assert kinds(formats="cad") == {"dxf", "step"}
    assert kinds(formats="drawing") >= {"dxf", "svg", "pdf"}
    assert kinds(formats="simulation") >= {"csv", "urdf", "xml"}
    printed = pair.files(formats="print")
    assert printed == pair.files(formats=["stl", "3mf"], tolerance=0.01)
    assert printed != pair.files(formats=["stl", "3mf"], tolerance=0.001)


def test_the_system_s_refusal_is_the_cause(pair, tmp_path):
    blocked = tmp_path / "file"
    blocked.write_text("in the way")
    with pytest.raises(ct.ExportError, match="file") as caught:
        pair.export(blocked / "out", formats=["csv"])
    assert isinstance(caught.value.__cause__, OSError)
    assert caught.value.__cause__.errno in (errno.ENOTDIR, errno.EEXIST)
    assert os.listdir(tmp_path) == ["file"]


def test_a_part_is_written_in_each_solid_format(pair, tmp_path):
    files = pair.files(formats=["step", "stl", "3mf"], tolerance=0.01)
    gear = pair.driven
    paths = [
        gear.step(tmp_path / "made" / "a.step"),
        gear.stl(str(tmp_path / "a.stl"), tolerance=0.01),
        gear.threemf(tmp_path / "a.3mf", 0.01),
    ]
    for path in paths:
        assert path.read_bytes() == files[f"driven{path.suffix}"]
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.3mf", "a.stl", "made"]


def test_a_part_is_written_into_the_working_folder(pair, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert str(pair.driver.stl("here.stl", tolerance=0.1)) == "here.stl"
    assert os.listdir(tmp_path) == ["here.stl"]


def test_a_part_that_cannot_be_written_leaves_what_was_there(pair, tmp_path):
    (tmp_path / "old").mkdir()
    with pytest.raises(ct.ExportError, match="old"):
        pair.driver.step(tmp_path / "old")
    with pytest.raises(ct.ExportError, match="plain"):
        pair.driver.step(tmp_path / "..")
    with pytest.raises(ct.DesignError, match="tolerance"):
        pair.driver.stl(tmp_path / "gear.stl", tolerance=0)
    assert os.listdir(tmp_path) == ["old"]


def test_files_of_others_are_replaced_by_force_alone(pair, tmp_path):
    pair.export(tmp_path, formats=["dxf"])
    (tmp_path / "driven.dxf").write_text("with a hole more")
    with pytest.raises(ct.ExportError, match=r"changed since: driven\.dxf; .*force"):
        pair.export(tmp_path, formats=["dxf", "csv"])
    assert (tmp_path / "driven.dxf").read_text() == "with a hole more"
    assert not list(tmp_path.glob("*.csv"))
    pair.export(tmp_path, formats=["dxf"], force=True)
    pair.export(tmp_path, formats=["dxf"], tolerance=0.01)


def test_threads_export_into_one_folder_without_harm(pair, tmp_path):
    files = pair.files(formats=["csv", "dxf"], tolerance=0.01)
    wrong = []

    def work():
        for _ in range(8):
            try:
                for path in pair.export(tmp_path, formats=["csv", "dxf"], tolerance=0.01):
                    if path.read_bytes() != files[path.name]:
                        wrong.append(path)
                pair.driver.stl(tmp_path / "gear.stl", tolerance=0.1)
            except ct.ExportError as error:
                wrong.append(error)

    threads = [threading.Thread(target=work) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert wrong == []
    assert sorted(os.listdir(tmp_path)) == sorted([".centrode-files", *files, "gear.stl"])


def test_a_killed_process_leaves_nothing_that_the_next_does_not_clear(pair, tmp_path):
    script = f"""
import centrode as ct
pair = ct.GearPair(ct.pitch.circle(module=2, tooth_count=20))
while True: pair.export({str(tmp_path)!r}, formats=["csv", "dxf", "svg"], tolerance=0.01)
"""
    for _ in range(20):
        process = subprocess.Popen([sys.executable, "-c", script])
        try:
            while not list(tmp_path.glob(".centrode-*.part")):
                assert process.poll() is None
        finally:
            process.kill()
            process.wait(timeout=10)
        if list(tmp_path.glob(".centrode-*.part")):
            break
    else:
        pytest.fail("none was killed while it wrote")
    written = pair.export(tmp_path, formats=["csv", "dxf", "svg"], tolerance=0.01)
    assert sorted(os.listdir(tmp_path)) == sorted([".centrode-files", *(path.name for path in written)])


def test_a_write_beyond_the_file_size_limit_is_told_and_leaves_nothing(tmp_path):
    script = f"""
import resource
import centrode as ct
resource.setrlimit(resource.RLIMIT_FSIZE, (30_000, 30_000))
pair = ct.GearPair(ct.pitch.circle(module=2, tooth_count=20))
for write in (lambda: pair.export({str(tmp_path)!r}), lambda: pair.driver.step({str(tmp_path / "a.step")!r})):
    try:
        write()
    except ct.ExportError as error:
        print(error.__cause__.errno, error)
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=120, check=True)
    told = done.stdout.splitlines()
    assert len(told) == 2
    assert all(line.startswith(f"{errno.EFBIG} cannot write") for line in told)
    assert os.listdir(tmp_path) == []
