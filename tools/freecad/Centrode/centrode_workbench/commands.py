"""Commands of the workbench: new, open, save, update. Needs FreeCAD's window."""

from pathlib import Path

import centrode
import FreeCAD
import FreeCADGui
from PySide import QtGui

from . import objects

FAMILIES = ("gear-pair", "three-arm", "spiral-shaft", "moving-box", "feeder", "machine")
PATTERN = "Centrode design (*.toml)"


def register():
    """Make the commands known; gives their names."""
    known = {"CentrodeNew": New(), "CentrodeOpen": Open(), "CentrodeSave": Save(), "CentrodeUpdate": Update()}
    for name, command in known.items():
        FreeCADGui.addCommand(name, command)
    return list(known)


def chosen():
    """Give the design that is selected, or the only one of the document; None if there is none, or several."""
    document = FreeCAD.ActiveDocument
    if document is None:
        return None
    designs = [one for one in document.Objects if isinstance(getattr(one, "Proxy", None), objects.Design)]
    selected = [getattr(one, "Design", one) for one in FreeCADGui.Selection.getSelection()]
    wanted = [one for one in selected if one in designs] or designs
    return wanted[0] if len({one.Name for one in wanted}) == 1 else None


class Command:
    """What commands have in common."""

    text, tip = "", ""

    def GetResources(self):
        """Give menu text and tip."""
        return {"MenuText": self.text, "ToolTip": self.tip}

    def IsActive(self):
        """Say whether it can be used now."""
        return True


class New(Command):
    """A design of a family, as `centrode new` writes it."""

    text, tip = "New design", "Begin with the commented design of a family"

    def Activated(self):
        """Ask for the family."""
        window = FreeCADGui.getMainWindow()
        family, agreed = QtGui.QInputDialog.getItem(window, self.text, "Family", FAMILIES, 0, False)
        if agreed:
            document = FreeCAD.ActiveDocument or FreeCAD.newDocument(family)
            objects.make(document, centrode.template(family))
            FreeCADGui.SendMsgToActiveView("ViewFit")


class Open(Command):
    """A design file."""

    text, tip = "Open design", "Put a design file into the document"

    def Activated(self):
        """Ask for the file."""
        path, _ = QtGui.QFileDialog.getOpenFileName(FreeCADGui.getMainWindow(), self.text, "", PATTERN)
        if path:
            document = FreeCAD.ActiveDocument or FreeCAD.newDocument(Path(path).stem)
            objects.make(document, Path(path).read_text(encoding="utf-8"))
            FreeCADGui.SendMsgToActiveView("ViewFit")


class Save(Command):
    """The design with its numbers as they are, as a file."""

    text, tip = "Save design", "Write the design with the numbers as they are now"

    def IsActive(self):
        """Say whether there is a design."""
        return chosen() is not None

    def Activated(self):
        """Ask for the file."""
        path, _ = QtGui.QFileDialog.getSaveFileName(FreeCADGui.getMainWindow(), self.text, "", PATTERN)
        if path:
            Path(path).write_text(chosen().Text, encoding="utf-8")


class Update(Command):
    """Links anew where a change made others."""

    text, tip = "Update links", "Recompute, and add and take away links where a change made others"

    def IsActive(self):
        """Say whether there is a design."""
        return chosen() is not None

    def Activated(self):
        """Update the design."""
        objects.update(chosen())
