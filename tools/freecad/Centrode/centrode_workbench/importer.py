"""Opens design files from FreeCAD's own menus."""

from pathlib import Path

import FreeCAD

from . import objects


def open(path):
    """Open a design file in a document of its own."""
    name = Path(path).stem
    return insert(path, FreeCAD.newDocument(name).Name)


def insert(path, document):
    """Put a design file into a document, by its name."""
    return objects.make(FreeCAD.getDocument(document), Path(path).read_text(encoding="utf-8"))
