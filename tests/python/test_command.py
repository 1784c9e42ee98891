import json
import resource
import signal
import subprocess

import pytest
from conftest import BINARY, ROOT


def test_a_good_pair_checks_out(exported, run):
    done = run("check", exported.design, "--json", check=False)
    report = json.loads(done.stdout)
    assert done.returncode == 0, report["findings"]
    # Flanks thinned for backlash are conjugate to its first order only.
    bound = 1e-6 if "backlash" in exported.design.read_text() else 1e-8
    assert report["values"]["transmission_error_max"] < bound
    assert report["ok"]
    assert exported.report() == report


def test_an_infinite_figure_is_a_string_that_float_reads(run, tmp_path):
    design = ROOT / "tests" / "designs" / "moving-box-2018.toml"
    text = run("check", design, "--json").stdout
    assert "null" not in text
    values = json.loads(text)["values"]
    # The shaft alone is plain and keeps its wall at any speed.
    assert values["contact_limit_rpm"] == "Infinity"
    assert float(values["contact_limit_rpm"]) == float("inf")
    assert "infinite" in run("check", design).stdout
    run("export", design, "--to", tmp_path, "--format", "json")
    assert json.loads((tmp_path / "report.json").read_text())["values"] == values


def test_the_new_design_file_is_a_good_pair(run, tmp_path):
    design = tmp_path / "pair.toml"
    design.write_text(run("new", "gear-pair").stdout)
    assert run("check", design, check=False).returncode == 0


def limited(size, action):
    """Makes files end at a size, as on a full disk; the system's signal at it ends the program or not."""

    def limit():
        signal.signal(signal.SIGXFSZ, action)
        resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))

    return limit


@pytest.mark.parametrize(
    ("action", "code"), [(signal.SIG_IGN, 2), (signal.SIG_DFL, -signal.SIGXFSZ)], ids=["full disk", "killed by it"]
)
def test_an_export_cut_short_leaves_the_old_files(exported, tmp_path, action, code):
    old = {path.name: path.read_bytes() for path in exported.folder.iterdir() if path.is_file()}
    for name, contents in old.items():
        (tmp_path / name).write_bytes(contents)
    command = [BINARY, "export", exported.design, "--to", tmp_path, "--tolerance", "0.01"]
    # The first files fit, the solids do not.
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, preexec_fn=limited(100_000, action))
    assert done.returncode == code
    assert done.stdout == ""
    left = {path.name: path.read_bytes() for path in tmp_path.iterdir() if path.is_file()}
    parts = [name for name in left if name.endswith(".part")]
    if code == 2:
        assert "cannot write" in done.stderr
        assert not parts
    assert {name: left[name] for name in left if name not in parts} == old
    # With room, the same command goes through and differs: the old files were not its own.
    subprocess.run(command, check=True, capture_output=True, timeout=60)
    assert (tmp_path / "driver.stl").read_bytes() != old["driver.stl"]
