"""The workbench in FreeCAD: solids, poses, a number changed, a document saved and opened again, commands.

    python tests/campaigns/freecad_workbench.py                      # finds freecadcmd: apt install freecad-python3
    python tests/campaigns/freecad_workbench.py --window pair.png    # the window too, with a picture: apt install xvfb

FreeCAD's own Python runs it: one that can load the module in python/centrode, and with NumPy.
"""

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).parents[2]
WORKBENCH = ROOT / "tools" / "freecad" / "Centrode"
INSIDE = "CENTRODE_WORKBENCH_TEST"
DESIGN_FOLDER = ROOT / "tests" / "designs"
DESIGNS = ("elliptic-pair-2018", "three-arm-2021", "spiral-shaft-2018", "feeder-2022", "press")


# Without the page that a FreeCAD with a window begins with, which is a web browser.
SETTINGS = """<?xml version="1.0" encoding="UTF-8" standalone="no" ?>
<FCParameters><FCParamGroup Name="Root"><FCParamGroup Name="BaseApp"><FCParamGroup Name="Preferences">
<FCParamGroup Name="General"><FCText Name="AutoloadModule">PartWorkbench</FCText></FCParamGroup>
</FCParamGroup></FCParamGroup></FCParamGroup></FCParameters>
"""


def found(*names):
    """Path of the first program that there is."""
    path = next(filter(None, map(shutil.which, names)), None)
    if path is None:
        raise SystemExit(f"there is no {names[0]}: apt install freecad-python3 xvfb")
    return path


def outside(picture):
    """Runs this file in FreeCAD, as a workbench that is installed."""
    command = [found("freecadcmd", "FreeCADCmd")]
    if picture:
        command = [found("xvfb-run"), "-a", found("freecad", "FreeCAD")]
    with tempfile.TemporaryDirectory() as home:
        place = {**os.environ, "HOME": home, INSIDE: str(picture.resolve()) if picture else "no window"}
        mods = Path(home, ".local", "share", "FreeCAD", "Mod")
        mods.mkdir(parents=True)
        (mods / "Centrode").symlink_to(WORKBENCH)
        settings = Path(home, ".config", "FreeCAD", "user.cfg")
        settings.parent.mkdir(parents=True)
        settings.write_text(SETTINGS)
        if not picture:
            place["QT_QPA_PLATFORM"] = "offscreen"
        command.append(__file__)
        done = subprocess.run(command, env=place, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=580)
    told = [line for line in done.stdout.splitlines() if line.startswith("> ")]
    print(*told, sep="\n")
    if not told or told[-1] != "> all well":
        raise SystemExit(done.stdout + done.stderr)


def bodies(document):
    """The links of a document by their names."""
    return {one.Link: one for one in document.Objects if hasattr(one, "Link")}


def far(placement, frame):
    """Maximum difference of a placement from a frame."""
    matrix = placement.toMatrix().A
    return max(abs(a - b) for a, b in zip(matrix, frame.ravel().tolist(), strict=True))


def compare(design, machine):
    """Every link valid, as large as the exact section tells, and where its law has it; gives how many."""
    found = bodies(design.Document)
    frames = machine.frames(design.Input.getValueAs("rad").Value)
    for link in machine.links():
        if link.name not in found:
            assert not any((link.solids, link.part, link.mesh)), link.name
            continue
        shape = found[link.name].Shape
        assert shape.isValid(), link.name
        assert far(found[link.name].Placement, frames[link.name]) < 1e-9, link.name
        if link.solids:
            wanted = sum(solid.volume for solid in link.solids)
            assert abs(shape.Volume - wanted) <= 1e-9 * wanted, (link.name, shape.Volume, wanted)
    return len(found)


def inside():
    """Runs in FreeCAD."""
    import centrode
    import FreeCAD
    from centrode_workbench import importer, parameters

    about = FreeCAD.Metadata(str(WORKBENCH / "package.xml"))
    assert (about.Name, about.Content["workbench"][0].Classname) == ("Centrode", "CentrodeWorkbench")
    for name in DESIGNS:
        path = DESIGN_FOLDER / f"{name}.toml"
        machine = centrode.load(path)
        design = importer.open(str(path))
        count = compare(design, machine)
        design.Input = "40 deg"
        design.Document.recompute()
        compare(design, machine)
        print(f"> {name}: {count} links", flush=True)
        FreeCAD.closeDocument(design.Document.Name)

    design = importer.open(str(DESIGN_FOLDER / "elliptic-pair-2018.toml"))
    before = bodies(design.Document)["driver"].Shape.Volume
    width = next(name for name, key in (line.split("=") for line in design.Keys) if key == "driver.width")
    setattr(design, width, 2 * getattr(design, width))
    design.Document.recompute()
    changed = centrode.Mechanism.from_toml(design.Text)
    compare(design, changed)
    after = bodies(design.Document)["driver"].Shape.Volume
    assert abs(after - 2 * before) < 1e-9 * after
    assert parameters.numbers(design.Text)["driver.width"] == getattr(design, width)
    print("> a width doubled in the document doubles the volume", flush=True)

    with tempfile.TemporaryDirectory() as folder:
        path = str(Path(folder, "pair.FCStd"))
        design.Document.saveAs(path)
        FreeCAD.closeDocument(design.Document.Name)
        document = FreeCAD.openDocument(path)
        (design,) = (one for one in document.Objects if hasattr(one, "Keys"))
        design.Input = "-75 deg"
        document.recompute()
        compare(design, changed)
    print("> a document opened again follows its design", flush=True)
    setattr(design, width, -1.0)
    document.recompute()
    assert "Invalid" in design.State, design.State
    print("> a width that cannot be is refused", flush=True)


def windowed(picture):
    """Runs in FreeCAD with a window."""
    import FreeCAD
    import FreeCADGui

    FreeCADGui.activateWorkbench("CentrodeWorkbench")
    assert type(FreeCADGui.activeWorkbench()).__name__ == "CentrodeWorkbench"
    import centrode
    from centrode_workbench import commands, objects

    design = objects.make(FreeCAD.newDocument("pair"), (DESIGN_FOLDER / "elliptic-pair-2018.toml").read_text())
    assert commands.chosen() is design
    FreeCADGui.runCommand("CentrodeUpdate")
    compare(design, centrode.Mechanism.from_toml(design.Text))
    view = FreeCADGui.activeDocument().activeView()
    view.viewIsometric()
    FreeCADGui.SendMsgToActiveView("ViewFit")
    view.saveImage(picture, 640, 400, "White")
    print("> the window shows the pair", flush=True)


if INSIDE in os.environ:
    # In FreeCAD, which gives a file it runs a name of its own.
    try:
        sys.path.insert(0, str(ROOT / "python"))
        if os.environ[INSIDE] != "no window":
            windowed(os.environ[INSIDE])
        inside()
        print("> all well", flush=True)
    except BaseException:
        import traceback

        traceback.print_exc()
        sys.stdout.flush()
        sys.stderr.flush()
    os._exit(0)
elif __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--window", type=Path, metavar="PNG", help="try the window too, and write a picture of it")
    outside(parser.parse_args().window)
