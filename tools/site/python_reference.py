"""The reference of the Python package: signatures from the stub, words from the docstrings."""

import ast
import functools
import inspect
import itertools
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
STUB = ROOT / "python" / "centrode" / "_centrode.pyi"
# Words of the stub, as a reader knows them.
TYPES = {
    "_Real": "float",
    "_Count": "int",
    "SupportsIndex": "int",
    "ArrayLike": "array_like",
    "NDArray[float64]": "ndarray",
    "NDArray[np.float64]": "ndarray",
    "NDArray[uint32]": "ndarray",
    "NDArray[Any]": "ndarray",
    "str | PathLike[str]": "path",
    "os.PathLike[str] | str": "path",
}
# Parts of a docstring, after Google's style.
PARTS = {"Args:": "Arguments", "Returns:": "Returns", "Raises:": "Raises", "Yields:": "Yields"}


class Stub:
    """Data of the stub about each name: its signatures, and the type of properties."""

    def __init__(self, path: Path = STUB):
        """Reads the stub."""
        tree = ast.parse(path.read_text())
        self.words = dict(TYPES)
        self.calls: dict[str, list[str]] = {}
        self.properties: dict[str, str] = {}
        self.order: dict[str, list[str]] = {}
        self.bases: dict[str, str] = {}
        for node in tree.body:
            if isinstance(node, ast.AnnAssign) and ast.unparse(node.annotation) == "TypeAlias" and node.value:
                self.words.setdefault(ast.unparse(node.target), ast.unparse(node.value))
        for node in tree.body:
            if isinstance(node, ast.FunctionDef):
                self.function(node.name, node)
            elif isinstance(node, ast.ClassDef):
                self.bases[node.name] = ", ".join(ast.unparse(base) for base in node.bases)
                self.order[node.name] = list(dict.fromkeys(each.name for each in functions(node)))
                for each in functions(node):
                    self.function(f"{node.name}.{each.name}", each)

    def function(self, name: str, node: ast.FunctionDef) -> None:
        """Notes a function, a method or a property."""
        marks = {ast.unparse(mark) for mark in node.decorator_list}
        returns = self.plain(ast.unparse(node.returns)) if node.returns else ""
        if "property" in marks:
            self.properties[name] = returns
            return
        text = self.plain(ast.unparse(node.args))
        text = re.sub(r"^(self|cls)(, )?(/(, )?)?", "", text)
        arrow = f" -> {returns}" if returns and not name.endswith("__new__") else ""
        self.calls.setdefault(name, []).append(f"({text}){arrow}")

    def plain(self, text: str) -> str:
        """A type in plain words."""
        for _ in range(2):
            for old, new in sorted(self.words.items(), key=lambda pair: -len(pair[0])):
                text = re.sub(rf"(?<![\w.]){re.escape(old)}(?!\w)", lambda _, new=new: new, text)
        return text.replace("float | SupportsFloat", "float")


def functions(node: ast.ClassDef) -> list[ast.FunctionDef]:
    """The functions of a class in order."""
    return [each for each in node.body if isinstance(each, ast.FunctionDef)]


def make(pages: Path) -> None:
    """Writes `reference/python.md` and one page each for its public modules."""
    import centrode as ct

    folder = pages / "reference"
    folder.mkdir(exist_ok=True)
    stub = Stub()
    (folder / "python.md").write_text(module(ct, "ct", "Python: `centrode`", stub))
    for sub in (ct.pitch, ct.cam, ct.plot, ct.build123d, ct.cadquery, ct.mujoco):
        short = sub.__name__.rsplit(".", 1)[-1]
        (folder / f"python-{short}.md").write_text(module(sub, f"ct.{short}", f"Python: `centrode.{short}`", stub))


def module(what: object, prefix: str, heading: str, stub: Stub) -> str:
    """The page of a module."""
    named = [(name, getattr(what, name)) for name in what.__all__]
    named = [(name, thing) for name, thing in named if not inspect.ismodule(thing) and not isinstance(thing, str)]
    lines = [f"# {heading}", "", "Made from the stub and the docstrings of the package when the site is built.", ""]
    lines += words(inspect.getdoc(what) or "")
    groups = {
        "Functions": [pair for pair in named if not inspect.isclass(pair[1])],
        "Classes": [pair for pair in named if inspect.isclass(pair[1]) and not issubclass(pair[1], Exception)],
        "Errors": [pair for pair in named if inspect.isclass(pair[1]) and issubclass(pair[1], Exception)],
    }
    for group, pairs in groups.items():
        if pairs:
            lines += ["", f"## {group}", ""]
        for name, thing in pairs:
            lines += ["", f"### {prefix}.{name} {{ #{name} }}", ""]
            lines += klass(name, thing, stub) if inspect.isclass(thing) else call(name, name, thing, stub)
    return "\n".join(lines) + "\n"


def klass(name: str, thing: type, stub: Stub) -> list[str]:
    """A class: how it is made, what it is, its members."""
    bases = [base.__name__ for base in thing.__bases__ if base.__module__.startswith("centrode")]
    lines = [f"A kind of {', '.join(f'[{base}](#{base})' for base in bases)}.", ""] if bases else []
    made = stub.calls.get(f"{name}.__new__") or own_signature(thing)
    if made:
        lines += ["```python", *(pretty(name, each) for each in made), "```", ""]
    lines += words(inspect.getdoc(thing) or "")
    fields = described().get(name, {})
    order = stub.order.get(name, list(dict.fromkeys([*fields, *vars(thing)])))
    members = [each for each in order if not each.startswith("_") and each in vars(thing)]
    if properties := [each for each in members if not callable(getattr(thing, each))]:
        lines += ["", "| property | type | meaning |", "|---|---|---|"]
        for each in properties:
            kind = stub.properties.get(f"{name}.{each}") or returned(vars(thing)[each])
            kind, about = fields.get(each, (kind, inspect.getdoc(vars(thing)[each]) or ""))
            lines.append(f"| `{each}` | {code(kind)} | {cell(about)} |")
    for each in members:
        if callable(getattr(thing, each)):
            lines += ["", f"#### {name}.{each} {{ #{name}.{each} }}", ""]
            lines += call(f"{name}.{each}", each, getattr(thing, each), stub)
    return lines


@functools.cache
def described() -> dict[str, dict[str, tuple[str, str]]]:
    """Type and words of each field of each data class: the words stand below the field in its source."""
    found: dict[str, dict[str, tuple[str, str]]] = {}
    for source in STUB.parent.glob("_*.py"):
        classes = [each for each in ast.parse(source.read_text()).body if isinstance(each, ast.ClassDef)]
        for each in classes:
            for field, below in itertools.pairwise(each.body):
                if isinstance(field, ast.AnnAssign) and isinstance(below, ast.Expr):
                    kind = re.sub(r"NDArray\[[^\]]*\]", "ndarray", ast.unparse(field.annotation))
                    words_of = inspect.cleandoc(below.value.value)
                    found.setdefault(each.name, {})[ast.unparse(field.target)] = (kind, words_of)
    return found


def call(key: str, name: str, thing: object, stub: Stub) -> list[str]:
    """A function or a method: its signatures and its words."""
    made = stub.calls.get(key) or own_signature(thing)
    return ["```python", *(pretty(name, each) for each in made), "```", "", *words(inspect.getdoc(thing) or "")]


def own_signature(thing: object) -> list[str]:
    """The signature of what is written in Python."""
    try:
        text = str(inspect.signature(thing))
    except (TypeError, ValueError):
        return []
    for old, new in TYPES.items():
        text = text.replace(old, new)
    # What numpy's aliases stand for.
    text = re.sub(r"\S*Union\[\S*_Buffer, .*?bytes \| str\]\]", "array_like", text)
    text = re.sub(r"[\w.]*ndarray\[tuple\[[^\]]*\], [\w.]*dtype\[[^\]]*\]\]", "ndarray", text)
    text = re.sub(r"\b(centrode|numpy|collections|matplotlib|os|typing|pathlib|concurrent)(\.[_a-z]\w*)*\.", "", text)
    text = re.sub(r"^\((self|cls)(, )?", "(", text).replace(" -> None", "")
    return [] if text in ("(*args, **kwargs)", "(/, *args, **kwargs)") else [text]


def returned(member: object) -> str:
    """The type of a property that is written in Python."""
    getter = getattr(member, "fget", None)
    text = own_signature(getter)[0] if getter and own_signature(getter) else ""
    return text.partition(" -> ")[2]


def pretty(name: str, signature: str) -> str:
    """A signature on as many lines as it needs."""
    line = f"{name}{signature}"
    if len(line) <= 90:
        return line
    depth, pieces, piece = 0, [], ""
    inside, _, after = signature[1:].rpartition(")")
    for letter in inside:
        depth += {"[": 1, "(": 1, "]": -1, ")": -1}.get(letter, 0)
        if letter == "," and depth == 0:
            pieces.append(piece.strip())
            piece = ""
        else:
            piece += letter
    pieces.append(piece.strip())
    return "\n".join([f"{name}(", *(f"    {each}," for each in pieces), f"){after}"])


def words(doc: str) -> list[str]:
    """A docstring as Markdown: paragraphs, lists of arguments, examples."""
    lines, out, part = doc.split("\n"), [], ""
    example = False
    for line in lines:
        if example and not line.strip():
            out += ["```", ""]
            example = False
        elif line.startswith(">>>") and not example:
            out += ["", "```pycon", line]
            example = True
        elif example:
            out.append(line)
        elif line in PARTS:
            part = line
            out += ["", f"{PARTS[line]}:", ""]
        elif part and line.startswith("    "):
            item = re.match(r"^    (\w+): (.*)$", line)
            if item and part in ("Args:", "Raises:"):
                out.append(f"- `{item[1]}`: {item[2]}")
            elif part in ("Args:", "Raises:"):
                out.append(f"    {line.strip()}")
            else:
                out.append(line.strip())
        else:
            part = part if not line.strip() else ""
            out.append(line)
    return [*out, "```", ""] if example else [*out, ""]


def code(text: str) -> str:
    """A type in a table."""
    return f"`{text}`".replace("|", "\\|") if text else ""


def cell(text: str) -> str:
    """Words in a table: all but examples."""
    return " ".join(text.partition(">>>")[0].split()).replace("|", "\\|")
