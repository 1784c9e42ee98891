"""`python -m centrode` is the program `centrode`: the same output, files and exit status."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from conftest import BINARY, ROOT
from studio import studio

MODULE = [sys.executable, "-m", "centrode"]
DESIGNS = ROOT / "tests" / "designs"
PAIR = DESIGNS / "elliptic-pair-2018.toml"
SLOW = 'family = "gear-pair"\n[pitch]\nkind = "circle"\nmodule = 1\ntooth_count = 10000\n'


def both(*words, **options):
    """What the program and the package's module do with the same words."""
    words = [str(word) for word in words]
    runs = [
        subprocess.run([*program, *words], capture_output=True, timeout=60, **options) for program in ([BINARY], MODULE)
    ]
    return [(done.returncode, done.stdout, done.stderr) for done in runs]


@pytest.mark.parametrize(
    ("status", "words"),
    [
        (0, "--version"),
        (0, "export --help"),
        (0, "check DESIGN"),
        (0, "check DESIGN --json"),
        (0, "schema"),
        (0, "new three-arm"),
        (0, "man check"),
        (0, "completions bash"),
        (2, ""),
        (2, "check none.toml"),
        (2, "check --tolerance 1"),
        (2, "schema nothing"),
    ],
)
def test_the_same_output(status, words, tmp_path):
    binary, module = both(*[PAIR if word == "DESIGN" else word for word in words.split()], cwd=tmp_path)
    assert module == binary
    assert module[0] == status
    assert (module[2] if status else module[1]).strip()


def test_the_help_names_the_program():
    text = subprocess.run([*MODULE, "--help"], check=True, capture_output=True, text=True).stdout
    assert "Usage: centrode <COMMAND>" in text
    assert "python" not in text
    assert "__main__" not in text


def test_a_bad_design_and_a_missed_goal_have_their_status():
    binary, module = both("check", "-", input=b'family = "gear-pair"\n[pitch]\nkind = "circel"\n')
    assert module == binary
    assert module[0] == 2
    assert module[1] == b""
    assert b"standard input:3:" in module[2]
    binary, module = both("check", DESIGNS / "three-arm-2021.toml")
    assert module == binary
    assert module[0] == 1


def test_the_same_files(tmp_path):
    folders = []
    for name, program in (("binary", [BINARY]), ("module", MODULE)):
        (tmp_path / name).mkdir()
        command = [*program, "export", PAIR, "--to", "out", "--tolerance", "0.01", "--format", "dxf,stl,pdf,urdf,json"]
        done = subprocess.run(command, cwd=tmp_path / name, check=True, capture_output=True, timeout=60)
        files = {path.relative_to(tmp_path / name): path for path in (tmp_path / name).rglob("*") if path.is_file()}
        folders.append((done.stdout, done.stderr, {name: path.read_bytes() for name, path in files.items()}))
    binary, module = folders
    assert module == binary
    assert len(module[2]) > 10


def test_a_name_that_is_no_text_is_found(tmp_path):
    design = os.fsencode(tmp_path) + b"/p\xe4r.toml"
    with open(design, "wb") as file:
        file.write(PAIR.read_bytes())
    done = subprocess.run([*MODULE, "check", design], capture_output=True, timeout=60)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("program", [[BINARY], MODULE], ids=["program", "module"])
def test_a_reader_that_has_gone_is_no_failure(program):
    reading, writing = os.pipe()
    os.close(reading)
    try:
        done = subprocess.run([*program, "schema"], stdout=writing, stderr=subprocess.PIPE, timeout=60)
    finally:
        os.close(writing)
    assert (done.returncode, done.stderr) == (0, b"")


def test_no_file_stands_in_for_an_output_closed_from_the_start(tmp_path):
    """Where it did, the page's server would write its address into a file of its own."""
    code = (
        "import os; from centrode.__main__ import main; main(); "
        "assert os.fstat(1).st_rdev == os.stat(os.devnull).st_rdev"
    )
    command = [sys.executable, "-c", code, "export", PAIR, "--to", tmp_path, "--format", "svg", "--tolerance", "0.01"]
    done = subprocess.run(command, stderr=subprocess.PIPE, timeout=60, preexec_fn=lambda: os.close(1))
    assert done.returncode == 0, done.stderr
    assert sorted(path.name for path in tmp_path.glob("[!.]*")) == ["assembly.svg", "driven.svg", "driver.svg"]
    assert all(path.read_text().rstrip().endswith("</svg>") for path in tmp_path.glob("*.svg"))


def heard():
    """A job started in the background ignores the signal unless asked not to."""
    signal.signal(signal.SIGINT, signal.default_int_handler)


def left_to_the_program(process):
    """Waits until the module runs and Python has left Ctrl-C to it."""
    begun = time.monotonic()
    while True:
        assert time.monotonic() < begun + 60
        assert process.poll() is None
        mapped = "_centrode.abi3" in Path(f"/proc/{process.pid}/maps").read_text()
        status = Path(f"/proc/{process.pid}/status").read_text()
        caught = int(status.split("SigCgt:")[1].split()[0], 16)
        if mapped and not caught & 1 << signal.SIGINT - 1:
            return
        time.sleep(0.005)


@pytest.mark.skipif(not Path("/proc/self/maps").exists(), reason="needs Linux: signals are read in /proc")
def test_ctrl_c_ends_a_slow_command_at_once(tmp_path):
    (tmp_path / "slow.toml").write_text(SLOW)
    command = [*MODULE, "check", "slow.toml"]
    process = subprocess.Popen(command, cwd=tmp_path, stderr=subprocess.PIPE, preexec_fn=heard)
    left_to_the_program(process)
    process.send_signal(signal.SIGINT)
    assert process.wait(timeout=10) == -signal.SIGINT
    assert process.stderr.read() == b""
    process.stderr.close()


def test_ctrl_c_in_a_search_keeps_the_best_so_far(tmp_path):
    words = [
        "optimise",
        DESIGNS / "three-arm-2021.toml",
        "-o",
        "better.toml",
        "--evaluations",
        "10000000",
        "--seed",
        "1",
    ]
    process = subprocess.Popen([*MODULE, *words], cwd=tmp_path, stdout=subprocess.PIPE, preexec_fn=heard)
    begun = time.monotonic()
    # Long after the search has taken Ctrl-C over, on any machine: its threads are at work.
    while time.monotonic() < begun + 60 and len(list(Path(f"/proc/{process.pid}/task").iterdir())) < 3:
        time.sleep(0.01)
    time.sleep(0.3)
    process.send_signal(signal.SIGINT)
    out, _ = process.communicate(timeout=20)
    assert process.returncode in (0, 1)
    assert b"better.toml" in out
    assert (tmp_path / "better.toml").exists()


def test_the_design_page_is_served(tmp_path):
    design = tmp_path / "pair.toml"
    design.write_bytes(PAIR.read_bytes())
    with studio(design, *MODULE) as page:
        assert page.answers()
        text = design.read_text()
        status, snapshot = page.json("POST", "solve", {"text": text, "depth": "checks"})
        assert status == 200
        assert snapshot["verdict"]["figures"]
