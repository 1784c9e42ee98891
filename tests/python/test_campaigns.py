"""Every campaign and benchmark that the documentation names still runs: each is started once, on very little."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import BINARY, ROOT, centrode

PAIR = ROOT / "tests" / "designs" / "circular-pair.toml"

# Script, arguments, and what it prints of itself when it has gone through.
PROGRAMS = {
    "tests/campaigns/contact_seating.py": ("--pairs 2 --inputs 5", "0 failures"),
    "tests/campaigns/contours.py": ("--gears 8", "0 pairs failed"),
    "tests/campaigns/hostile.py": ("--designs 12 --seconds 60", "0 failed"),
    "tests/campaigns/searches.py": ("--starts 2", "0 designs reached their goals and failed the check"),
    "tests/campaigns/swings.py": ("--teeth 3", "designs; longest"),
    "tests/campaigns/law_proofs.py": ("--laws 1", "0 certificates refused"),
    "tests/campaigns/page_looks.py": (f"--to {{folder}} --width 390 --scheme dark {PAIR}", "0 faults"),
    "tests/campaigns/proofs.py": ("{folder}/pair.proof --defects 1", "0 accepted"),
    "benches/browser/edits.py": (f"--edits 2 {PAIR}", "circular-pair"),
    "benches/browser/edits.py --steady 2": (f"--rest 0.1 {PAIR}", "of rest"),
    "benches/cad_parts.py": ("--times 1", "ms"),
    "benches/sweep_on_dask.py": ("--designs 400", "same numbers: True"),
    "benches/peers/compare.py": ("--quick --alone", "errors of the check"),
    "benches/peers/three_arm.py": ("--only sweep", "machines for a second of work"),
}


def started(script, words):
    """What a script prints that must end well."""
    place = {**os.environ, "CENTRODE_BIN": str(BINARY)}
    command = [sys.executable, *script.split(), *words.split()]
    done = subprocess.run(command, cwd=ROOT, env=place, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.mark.parametrize("script", PROGRAMS)
def test_a_campaign_runs(script, tmp_path):
    words, said = PROGRAMS[script]
    if "pair.proof" in words:
        centrode("prove", PAIR, "-o", tmp_path / "pair.proof")
    assert said in started(script, words.format(folder=tmp_path))


def test_the_campaign_of_random_b_splines_runs():
    program = BINARY.parent / "examples" / "bspline_campaign"
    done = subprocess.run([program, "--count", "1"], capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stdout + done.stderr


def test_every_campaign_is_started_here_or_needs_a_program_that_is_not():
    """FreeCAD and the peers are installed by hand; CadQuery's campaign has a test of its own."""
    elsewhere = {"freecad_workbench", "cadquery_parts", "grooved_shaft", "linkage", "jansen"}
    parts = {"flanks", "timing", "numpy_three_arm"}
    files = [path for folder in ("tests/campaigns", "benches") for path in (ROOT / folder).rglob("*.py")]
    here = {Path(name.split()[0]).stem for name in PROGRAMS}
    assert {path.stem for path in files} == here | elsewhere | parts
