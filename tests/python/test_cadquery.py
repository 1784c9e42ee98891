"""CadQuery's parts and assemblies, in the environment that CadQuery needs for itself."""

import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PYTHON = ROOT / ".venv-cadquery" / "bin" / "python"
# Gears, a grooved shaft, a machine with its frame; without names the campaign tries all.
DESIGNS = ("elliptic-pair-2018", "spiral-shaft-2018", "press")


@pytest.mark.skipif(not PYTHON.exists(), reason="no .venv-cadquery: scripts/test makes it")
def test_parts_are_valid_and_exact_and_assemblies_stand_where_their_laws_have_them():
    script = ROOT / "tests" / "campaigns" / "cadquery_parts.py"
    place = {**os.environ, "PYTHONPATH": str(ROOT / "python")}
    done = subprocess.run([PYTHON, script, *DESIGNS], env=place, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "parts valid" in done.stdout
