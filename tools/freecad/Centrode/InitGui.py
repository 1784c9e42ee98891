"""Loaded by FreeCAD with a window: the workbench."""

import FreeCADGui


class CentrodeWorkbench(FreeCADGui.Workbench):
    """Designs of centrode as solids."""

    MenuText = "Centrode"
    ToolTip = "Non-circular gears, cams and machines by their design files"

    def Initialize(self):
        """Make the commands known and put them in a toolbar and a menu."""
        from centrode_workbench import commands

        names = commands.register()
        self.appendToolbar("Centrode", names)
        self.appendMenu("Centrode", names)

    def GetClassName(self):
        """Say that it is written in Python."""
        return "Gui::PythonWorkbench"


FreeCADGui.addWorkbench(CentrodeWorkbench())
