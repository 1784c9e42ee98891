"""Loaded by every FreeCAD, with or without a window: designs can be opened like other files."""

import FreeCAD

FreeCAD.addImportType("Centrode design (*.toml)", "centrode_workbench.importer")
