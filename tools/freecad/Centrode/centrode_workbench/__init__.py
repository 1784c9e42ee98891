"""FreeCAD workbench of centrode. Only `shapes` and `objects` need FreeCAD, only `commands` its window."""
