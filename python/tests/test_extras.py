"""The package needs NumPy alone; whoever asks for more is told what to install."""

import subprocess
import sys

import pytest
import tomllib
from conftest import ROOT

# Runs with the packages named out of reach, as if they were not installed.
WITHOUT = """
import importlib.abc, sys

class Missing(importlib.abc.MetaPathFinder):
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in {missing!r}:
            raise ModuleNotFoundError(f"No module named {{name!r}}", name=name)

sys.meta_path.insert(0, Missing())
import centrode as ct
pair = ct.GearPair(ct.pitch.circle(module=2, tooth_count=20))
"""
HEAVY = {"OCP", "build123d", "cadquery", "matplotlib", "mujoco", "scipy", "vtkmodules"}


def run(missing, code):
    """What a fresh interpreter prints without some packages."""
    script = WITHOUT.format(missing=missing) + code
    return subprocess.run([sys.executable, "-c", script], check=True, capture_output=True, text=True).stdout


def test_importing_the_package_imports_numpy_alone():
    loaded = run(set(), "print(*{name.partition('.')[0] for name in sys.modules})").split()
    assert "numpy" in loaded
    assert not HEAVY & set(loaded)


@pytest.mark.parametrize(
    ("missing", "call", "extra"),
    [
        ({"build123d"}, "ct.build123d.part(pair.driver)", "build123d"),
        ({"build123d"}, "ct.build123d.assembly(pair)", "build123d"),
        ({"cadquery"}, "ct.cadquery.part(pair.driver)", "cadquery"),
        ({"cadquery"}, "ct.cadquery.assembly(pair)", "cadquery"),
        ({"mujoco"}, "ct.mujoco.load(pair)", "mujoco"),
    ],
)
def test_a_missing_package_is_named_with_its_extra(missing, call, extra):
    told = run(missing, f"try:\n    {call}\nexcept ModuleNotFoundError as error:\n    print(error, error.name)")
    assert told == f"{extra} is not installed: pip install {extra} {extra}\n"
    project = tomllib.loads((ROOT / "python" / "pyproject.toml").read_text())["project"]
    assert any(line.startswith(extra) for line in project["optional-dependencies"][extra])


def test_an_import_that_fails_within_a_package_is_not_taken_for_a_missing_one():
    told = run(
        {"anytree"}, "try:\n    ct.build123d.part(pair.driver)\nexcept ModuleNotFoundError as error:\n    print(error)"
    )
    assert told == "No module named 'anytree'\n"
