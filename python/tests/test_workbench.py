"""What of the FreeCAD workbench needs no FreeCAD; `tests/campaigns/freecad_workbench.py` runs the rest in it."""

import ast
import importlib.util
from xml.etree import ElementTree

import centrode as ct
import pytest
import tomllib
from conftest import ROOT
from sample import sampled

WORKBENCH = ROOT / "tools" / "freecad" / "Centrode"
DESIGNS = sorted((ROOT / "tests" / "designs").glob("*.toml"))
SPACE = {"p": "https://wiki.freecad.org/Package_Metadata"}


@pytest.fixture(scope="module")
def parameters():
    """The module of the workbench that reads and writes the numbers of a design."""
    spec = importlib.util.spec_from_file_location("parameters", WORKBENCH / "centrode_workbench" / "parameters.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_package_names_what_is_there():
    root = ElementTree.parse(WORKBENCH / "package.xml").getroot()
    assert root.find("p:name", SPACE).text == "Centrode"
    assert root.find("p:version", SPACE).text == ct.__version__
    for icon in root.iterfind(".//p:icon", SPACE):
        ElementTree.parse(WORKBENCH / icon.text)
    (workbench,) = root.iterfind("p:content/p:workbench", SPACE)
    classes = [node.name for node in ast.parse((WORKBENCH / "InitGui.py").read_text()).body if hasattr(node, "name")]
    assert workbench.find("p:classname", SPACE).text in classes
    assert (WORKBENCH / workbench.find("p:subdirectory", SPACE).text / "InitGui.py").exists()


def test_the_families_offered_have_templates():
    tree = ast.parse((WORKBENCH / "centrode_workbench" / "commands.py").read_text())
    (families,) = (ast.literal_eval(node.value) for node in tree.body
                   if isinstance(node, ast.Assign) and node.targets[0].id == "FAMILIES")  # fmt: skip
    known = {option["properties"]["family"]["const"] for option in ct.schema()["oneOf"]}
    assert set(families) == known
    for family in families:
        ct.template(family)


@pytest.mark.parametrize("path", sampled(DESIGNS), ids=lambda path: path.stem)
def test_a_design_written_again_is_the_same_machine(parameters, path):
    text = path.read_text()
    again = parameters.written(tomllib.loads(text))
    assert tomllib.loads(again) == tomllib.loads(text)
    assert ct.Mechanism.from_toml(again) == ct.load(path)


def test_numbers_are_changed_by_their_keys(parameters):
    text = (ROOT / "tests" / "designs" / "elliptic-pair-2018.toml").read_text()
    numbers = parameters.numbers(text)
    assert numbers["pitch.tooth_count"] == 23
    assert not any(isinstance(value, bool) for value in numbers.values())
    changed = parameters.changed(text, {"pitch.tooth_count": 25.0, "driver.width": 7.5})
    pair = ct.GearPair.from_toml(changed)
    assert (pair.driver.tooth_count, pair.driver.body.width) == (25, 7.5)
    assert pair.driven.body == ct.GearPair.from_toml(text).driven.body
    back = parameters.changed(changed, {"pitch.tooth_count": 23, "driver.width": numbers["driver.width"]})
    assert tomllib.loads(back) == tomllib.loads(text)


def test_words_are_written_as_they_were(parameters):
    design = {"a b": 'x "y" \\ \n é \x7f', "t": {"u": [1, 2.5, [True]], "v": {"w": float("inf")}, "e": {}}, "s": -1e-9}
    assert tomllib.loads(parameters.written(design)) == design
