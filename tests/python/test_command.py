import json
import resource
import signal
import subprocess
import time

import pytest
from conftest import BINARY, ROOT
from studio import computes


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


# Hidden folder in which an export writes its files.
STAGE = ".centrode-*.part"


def everything(folder):
    """Contents of every file in a folder, hidden ones among them, by path."""
    return {path.relative_to(folder): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


@pytest.mark.parametrize("action", [signal.SIG_IGN, signal.SIG_DFL], ids=["full disk", "killed by it"])
def test_an_export_cut_short_leaves_the_old_files(exported, tmp_path, action):
    old = {path.name: path.read_bytes() for path in exported.folder.iterdir() if path.is_file()}
    for name, contents in old.items():
        (tmp_path / name).write_bytes(contents)
    command = [BINARY, "export", exported.design, "--to", tmp_path, "--tolerance", "0.01", "--format", "all"]
    # The first files fit, the solids do not.
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, preexec_fn=limited(100_000, action))
    assert done.returncode == 2
    assert done.stdout == ""
    assert "cannot write" in done.stderr
    assert "File too large" in done.stderr
    assert {str(path): contents for path, contents in everything(tmp_path).items()} == old
    # With room, the same command goes through and differs: the old files were not its own.
    subprocess.run(command, check=True, capture_output=True, timeout=60)
    assert (tmp_path / "driver.stl").read_bytes() != old["driver.stl"]


def writing(folder):
    """Waits until an export has begun to write into a folder."""
    begun = time.monotonic()
    while not list(folder.glob(STAGE)):
        assert time.monotonic() < begun + 60
        time.sleep(1e-4)


def test_what_a_killed_export_left_is_cleared_by_the_next(exported, tmp_path):
    command = [BINARY, "export", exported.design, "--to", tmp_path, "--tolerance", "0.01", "--format", "all"]
    subprocess.run(command, check=True, capture_output=True, timeout=60)
    whole = everything(tmp_path)
    (tmp_path / ".notes.part").write_text("mine")
    for _ in range(20):
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
        writing_seen = time.monotonic()
        while process.poll() is None and len(list(tmp_path.glob(STAGE))) < 1:
            assert time.monotonic() < writing_seen + 60
        process.kill()
        process.wait(timeout=10)
        if list(tmp_path.glob(STAGE)):
            break
    else:
        pytest.fail("none was killed while it wrote")
    # What is there under its own name is whole; an export next to a live one clears only what is dead.
    seen = {path: contents for path, contents in everything(tmp_path).items() if path.parts[0][-5:] != ".part"}
    assert seen == whole
    both = [subprocess.Popen(command, stdout=subprocess.DEVNULL) for _ in range(2)]
    assert [process.wait(timeout=60) for process in both] == [0, 0]
    (tmp_path / ".notes.part").unlink()
    assert everything(tmp_path) == whole
    assert not list(tmp_path.glob(STAGE))


def test_ctrl_c_while_files_are_written_leaves_nothing_half_written(exported, tmp_path):
    command = [BINARY, "export", exported.design, "--to", tmp_path, "--tolerance", "0.01", "--format", "all"]
    subprocess.run(command, check=True, capture_output=True, timeout=60)
    whole = everything(tmp_path)
    codes = set()
    for _ in range(20):
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, preexec_fn=heard)
        writing(tmp_path)
        process.send_signal(signal.SIGINT)
        codes.add(process.wait(timeout=10))
        assert everything(tmp_path) == whole
        if 130 in codes:
            break
    assert 130 in codes, f"never in time: {codes}"


def heard():
    """A job started in the background ignores the signal unless asked not to."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


@pytest.mark.parametrize("words", [["check"], ["export", "--to", "out"]], ids=["check", "export"])
def test_ctrl_c_ends_a_slow_command_at_once(tmp_path, words):
    (tmp_path / "slow.toml").write_text(
        'family = "gear-pair"\n[pitch]\nkind = "circle"\nmodule = 1\ntooth_count = 10000\n'
    )
    command = [BINARY, words[0], "slow.toml", *words[1:]]
    process = subprocess.Popen(command, cwd=tmp_path, stdout=subprocess.DEVNULL, preexec_fn=heard)
    # By itself it ends after minutes.
    computes(process)
    process.send_signal(signal.SIGINT)
    assert process.wait(timeout=10) == -signal.SIGINT
    assert [path.name for path in tmp_path.iterdir()] == ["slow.toml"]


def test_a_detail_of_a_body_that_cannot_be_made_is_a_finding(run, tmp_path):
    """As on the page: the motion is checked all the same, and is that of the sound design."""
    design = ROOT / "tests" / "designs" / "circular-pair.toml"
    bad = tmp_path / "bad.toml"
    bad.write_text(design.read_text().replace("bore = 14", "bore = 100", 1))
    done = run("check", bad, "--json", check=False)
    assert done.returncode == 1
    report, sound = json.loads(done.stdout), json.loads(run("check", design, "--json").stdout)
    assert report["values"] == sound["values"]
    assert [finding["rule"] for finding in report["findings"]] == ["detail"]
    assert "driver.bore" in report["findings"][0]["message"]
    for option in ["--figures", "--remedy"]:
        assert run("check", bad, option, check=False).returncode == 2
    # Files cannot be without it.
    assert run("export", bad, "--to", tmp_path / "out", check=False).returncode == 2
