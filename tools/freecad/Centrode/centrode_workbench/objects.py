"""Objects of a document: the design with its numbers, and a body for each link that follows it."""

import centrode
import FreeCAD

from . import parameters, shapes

TEXT, INPUT = "Text", "Input"
COLORS = ((0.23, 0.43, 0.65), (0.79, 0.54, 0.17), (0.36, 0.55, 0.35), (0.55, 0.35, 0.48), (0.42, 0.48, 0.56))


def make(document, text):
    """Put a design into a document: a group with the design and its links; gives the design's object."""
    machine = centrode.Mechanism.from_toml(text)
    group = document.addObject("App::DocumentObjectGroup", "Centrode")
    group.Label = machine.title or machine.name
    design = document.addObject("App::FeaturePython", "Design")
    Design(design)
    group.addObject(design)
    design.Text = text
    update(design)
    return design


def update(design):
    """Recompute a design, and add and take away links where a change made others."""
    document, group = design.Document, design.getParentGroup()
    document.recompute([design])
    machine = design.Proxy.machine(design)
    bodies = {
        link.name: link for link in machine.links() if link.mesh is not None or link.solids or link.part or link.mounted
    }
    there = {child.Link: child for child in group.Group if hasattr(child, "Link")}
    for name in there.keys() - bodies.keys():
        document.removeObject(there[name].Name)
    for name in bodies:
        if name not in there:
            child = document.addObject("Part::FeaturePython", "Link")
            Link(child, design, name)
            group.addObject(child)
    document.recompute()


class Design:
    """A design file with its numbers as properties, and the input at which the machine stands."""

    # Of the class, for an object of a document that is opened: FreeCAD makes it without its constructor.
    _busy = False
    _made = None

    def __init__(self, obj):
        """Add what does not depend on the design."""
        obj.addProperty("App::PropertyString", TEXT, "Design", "Design file, TOML")
        obj.addProperty("App::PropertyAngle", INPUT, "Design", "Input at which the machine stands")
        obj.addProperty("App::PropertyStringList", "Keys", "Design", "Keys of the design file, a property each")
        obj.setEditorMode("Keys", 2)
        obj.Proxy = self

    def machine(self, obj):
        """Make the machine of the design; the last one is kept."""
        if self._made is None or self._made[0] != obj.Text:
            self._made = (obj.Text, centrode.Mechanism.from_toml(obj.Text), {})
        return self._made[1]

    def body(self, obj, name):
        """Make the shape of a link; kept as long as the design stays."""
        machine = self.machine(obj)
        known = self._made[2]
        if name not in known:
            (link,) = (link for link in machine.links() if link.name == name)
            known[name] = shapes.body(machine, link)
        return known[name]

    def execute(self, obj):
        """Refuse a design that is none, with its own message."""
        self.machine(obj)

    def onChanged(self, obj, name):
        """Keep the text and the numbers the same."""
        if self._busy or "Keys" not in obj.PropertiesList or FreeCAD.isRestoring():
            return
        keys = dict(line.split("=", 1) for line in obj.Keys)
        self._busy = True
        try:
            if name == TEXT:
                self._show(obj)
            elif name in keys:
                obj.Text = parameters.changed(obj.Text, {keys[name]: getattr(obj, name)})
        finally:
            self._busy = False

    def _show(self, obj):
        """A property for each number of the text, grouped by its table."""
        numbers = parameters.numbers(obj.Text)
        names = {key.replace(".", "_").replace("-", "_"): key for key in numbers}
        for line in obj.Keys:
            name = line.partition("=")[0]
            if name not in names:
                obj.removeProperty(name)
        for name, key in names.items():
            if name not in obj.PropertiesList:
                obj.addProperty("App::PropertyFloat", name, key.rpartition(".")[0] or "machine", key)
            setattr(obj, name, float(numbers[key]))
        obj.Keys = [f"{name}={key}" for name, key in names.items()]

    def __getstate__(self):
        """Keep nothing in the document: the properties are all there is."""
        return None

    def __setstate__(self, state):
        """Begin anew in a document that is opened."""

    dumps, loads = __getstate__, __setstate__


class Link:
    """A body of the machine, at the place where its law has it."""

    def __init__(self, obj, design, name):
        """Tie it to its design."""
        obj.addProperty("App::PropertyLink", "Design", "Link", "Design that it is of")
        obj.addProperty("App::PropertyString", "Link", "Link", "Name of the link")
        obj.Design, obj.Link, obj.Label = design, name, name
        obj.Proxy = self
        view = getattr(obj, "ViewObject", None)
        if view is not None:
            view.Proxy = 0
            view.ShapeColor = COLORS[sum(hasattr(one, "Link") for one in design.InList) % len(COLORS)]

    def execute(self, obj):
        """Make the shape and put it in its place."""
        design = obj.Design.Proxy
        machine = design.machine(obj.Design)
        frame = machine.frames(obj.Design.Input.getValueAs("rad").Value)[obj.Link]
        obj.Shape = design.body(obj.Design, obj.Link)
        obj.Placement = shapes.placement(frame)

    def __getstate__(self):
        """Keep nothing in the document: the properties are all there is."""
        return None

    def __setstate__(self, state):
        """Begin anew in a document that is opened."""

    dumps, loads = __getstate__, __setstate__
