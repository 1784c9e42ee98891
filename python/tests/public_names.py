"""Public names of the Python package, read from its stubs and sources, without importing it.

Run as a program it writes `python/api.txt`, unless a name has gone that CHANGELOG.md does not tell of.
"""

import ast
import re
import sys
import textwrap
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "python" / "centrode"
LIST = ROOT / "python" / "api.txt"


class Module:
    """Source of a module, its stub where there is one, and what it defines and imports from the package."""

    def __init__(self, name):
        self.name = name
        stub = PACKAGE / f"{name}.pyi"
        self.tree = ast.parse((stub if stub.exists() else PACKAGE / f"{name}.py").read_text())
        self.defined, self.imported = {}, {}
        for node in self.tree.body:
            if isinstance(node, ast.ClassDef):
                self.defined[node.name] = [node]
            elif isinstance(node, ast.FunctionDef):
                # An overloaded function is defined once per form.
                self.defined.setdefault(node.name, []).append(node)
            elif isinstance(node, ast.ImportFrom) and node.level == 1:
                for alias in node.names:
                    self.imported[alias.asname or alias.name] = (node.module, alias.name)

    def all(self):
        for node in self.tree.body:
            if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "__all__":
                return ast.literal_eval(node.value)
        return []


class Names:
    """Every public name, with the names of its parameters where it can be called."""

    def __init__(self):
        self.modules = {}
        self.found = {}
        files = sorted(path.stem for path in PACKAGE.glob("*.py") if not path.stem.startswith("_"))
        self.module("centrode", "__init__", skip=files)
        for name in files:
            self.module(f"centrode.{name}", name)

    def source(self, name):
        if name not in self.modules:
            self.modules[name] = Module(name)
        return self.modules[name]

    def module(self, public, name, skip=()):
        self.found[public] = None
        source = self.source(name)
        for exported in source.all():
            if exported in skip:
                continue
            home, nodes = self.resolve(source, exported)
            if nodes and isinstance(nodes[0], ast.ClassDef):
                self.found[f"{public}.{exported}"] = None
                self.members(f"{public}.{exported}", home, nodes[0])
            else:
                self.found[f"{public}.{exported}"] = parameters(nodes) if nodes else None

    def resolve(self, source, name):
        """Where a name is defined, through imports within the package."""
        while name not in source.defined and name in source.imported:
            module, name = source.imported[name]
            if module is None:
                return source, []
            source = self.source(module)
        return source, source.defined.get(name, [])

    def members(self, public, source, node):
        """Members of a class: of its bases first, which it may override."""
        for base in node.bases:
            home, nodes = self.resolve(source, ast.unparse(base))
            if nodes:
                self.members(public, home, nodes[0])
        methods = {}
        for item in node.body:
            if isinstance(item, ast.FunctionDef):
                methods.setdefault(item.name, []).append(item)
            elif isinstance(item, ast.AnnAssign) and not item.target.id.startswith("_"):
                self.found[f"{public}.{item.target.id}"] = None
        for name, nodes in methods.items():
            if name in ("__new__", "__init__"):
                self.found[public] = parameters(nodes)[1:]
            elif not name.startswith("_"):
                marks = {ast.unparse(mark) for form in nodes for mark in form.decorator_list}
                plain = "property" in marks
                bound = 0 if "staticmethod" in marks else 1
                self.found[f"{public}.{name}"] = None if plain else parameters(nodes)[bound:]


def parameters(nodes):
    """Names of the parameters of a function, in all of its forms."""
    words = []
    for node in nodes:
        given = node.args
        named = [arg.arg for arg in given.posonlyargs + given.args]
        named += [f"*{given.vararg.arg}"] if given.vararg else []
        named += [arg.arg for arg in given.kwonlyargs]
        named += [f"**{given.kwarg.arg}"] if given.kwarg else []
        words += [word for word in named if word not in words]
    return words


def written(found):
    """Names as a list to keep: a line for one that holds others, with those in it."""
    owners = {name.rpartition(".")[0] for name in found} & set(found)
    text = "# Every public name, with what is in it; made by scripts/api.\n"

    def word(name, short):
        return short if found[name] is None else f"{short}({','.join(found[name])})"

    for owner in sorted(owners):
        inside = [name for name in sorted(found) if name.rpartition(".")[0] == owner and name not in owners]
        words = " ".join([f"{word(owner, owner)}:", *(word(name, name.rpartition(".")[2]) for name in inside)])
        lines = textwrap.wrap(words, 120, subsequent_indent="    ", break_long_words=False, break_on_hyphens=False)
        text += "\n".join(lines) + "\n"
    return text


def read(text):
    """Names of a list, each with its parameters."""
    found, owner = {}, ""
    for token in text.partition("\n")[2].split():
        name, words = re.fullmatch(r"([\w.]+)(?:\((.*)\))?:?", token).groups()
        if token.endswith(":"):
            owner = name
        else:
            name = f"{owner}.{name}"
        found[name] = None if words is None else words.split(",") if words else []
    return found


def removed(old, new):
    """Names and parameters that are there no more, as CHANGELOG.md has to name them."""
    gone = []
    for name, words in old.items():
        if name not in new:
            gone.append(name)
        else:
            gone += [f"{name}({word}=)" for word in words or [] if word not in (new[name] or [])]
    # A class or module that has gone took its members along.
    return [name.removeprefix("centrode.") for name in gone if name.rpartition(".")[0] not in gone]


def untold(gone, changelog):
    """Names of those that have gone that the changelog does not name since the last release; before the first, none."""
    if not re.search(r"^## \[\d", changelog, re.MULTILINE):
        return []
    stated = re.search(r"^## \[Unreleased\]$(.*?)(?=^## |\Z)", changelog, re.MULTILINE | re.DOTALL)[1]
    return [name for name in gone if f"`{name}`" not in stated]


def main():
    new = Names().found
    old = read(LIST.read_text()) if LIST.exists() else {}
    missing = untold(removed(old, new), (ROOT / "CHANGELOG.md").read_text())
    if missing:
        sys.exit(
            "tell in CHANGELOG.md, below [Unreleased], what has gone: " + ", ".join(f"`{name}`" for name in missing)
        )
    LIST.write_text(written(new))


if __name__ == "__main__":
    main()
