"""The reference of the design file, a page a family, from the JSON schema that the program prints."""

import json
import re
import subprocess
from pathlib import Path

# Units by the end of a key, then by words of a key's description.
ENDS = {
    "_deg": "deg",
    "_rpm": "r/min",
    "_kg": "kg",
    "_kg_mm2": "kg mm²",
    "_per_minute": "1/min",
    "_coefficient": "modules",
    "_seconds": "s",
}
WORDS = r"(?<=[ ,(])(mm/rad|mm/s|mm|kg/m\^3|kg/m³|N mm|N/mm|N|kg|m/s\^2|m/s²|r/min)(?=[ .,;:)]|$)"


def families(binary: Path) -> list[str]:
    """Names of all families: in the list of `centrode new`, shipped designs are indented."""
    listed = subprocess.run([binary, "new"], check=True, capture_output=True, text=True).stdout
    return [line.split()[0] for line in listed.splitlines() if line and not line.startswith(" ")]


def make(pages: Path, binary: Path) -> list[str]:
    """Writes `reference/design/<family>.md` for every family; gives their names."""
    folder = pages / "reference" / "design"
    folder.mkdir(parents=True, exist_ok=True)
    names = families(binary)
    for family in names:
        done = subprocess.run([binary, "schema", family], check=True, capture_output=True, text=True, timeout=60)
        (folder / f"{family}.md").write_text(Page(family, json.loads(done.stdout)).text())
    return names


class Page:
    """One family: its table of keys, then each table that it holds, in the order of mention."""

    def __init__(self, family: str, schema: dict):
        """Reads nothing yet."""
        self.family, self.schema = family, schema
        self.waiting: list[str] = []
        self.done: set[str] = set()

    def text(self) -> str:
        """The whole page."""
        lines = [
            f"# Design file: `{self.family}`",
            "",
            f"Made from `centrode schema {self.family}` when the site is built. `centrode new {self.family}` prints a",
            "file with comments to start from. Keys marked *required* must stand in the file; others can be left out.",
            "",
            f"## The file {{ #{self.family} }}",
            "",
        ]
        lines += self.table(self.schema)
        while self.waiting:
            name = self.waiting.pop(0)
            if name not in self.done:
                self.done.add(name)
                lines += self.section(name)
        return "\n".join(lines) + "\n"

    def section(self, name: str) -> list[str]:
        """A table of the file that others refer to."""
        what = self.schema["$defs"][name]
        lines = ["", f"## {title(name)} {{ #{anchor(name)} }}", "", plain(what.get("description", "")), ""]
        variants = [each for each in what.get("oneOf", what.get("anyOf", [])) if each.get("type") == "object"]
        if not variants:
            return lines + self.table(what)
        for variant in variants:
            fixed = {key: value["const"] for key, value in variant.get("properties", {}).items() if "const" in value}
            head = ", ".join(f'`{key} = "{value}"`' for key, value in fixed.items())
            if head:
                lines += [f"### {head} {{ #{anchor(name)}-{'-'.join(map(str, fixed.values()))} }}", ""]
            lines += [plain(variant.get("description", "")), ""]
            lines += self.table(variant, leave_out=fixed)
            lines += [""]
        return lines

    def table(self, what: dict, leave_out: dict | None = None) -> list[str]:
        """The keys of one table."""
        keys = {key: value for key, value in what.get("properties", {}).items() if key not in (leave_out or {})}
        if not keys:
            if isinstance(what.get("additionalProperties"), dict):
                return [f"Names of your own, each {self.kind(what['additionalProperties'])}."]
            return ["No further keys."] if what.get("type") == "object" else [self.kind(what)]
        lines = ["| key | type | unit | default | meaning |", "|---|---|---|---|---|"]
        for key, value in keys.items():
            default = "*required*" if key in what.get("required", []) else shown(value)
            if key == "family":
                default = "*required*"
            about = plain(value.get("description", ""))
            lines.append(f"| `{key}` | {self.kind(value)} | {unit(key, value)} | {default} | {cell(about)} |")
        return lines

    def kind(self, value: dict) -> str:
        """The type of a key in words, with links to tables."""
        if "$ref" in value:
            name = value["$ref"].rsplit("/", 1)[-1]
            what = self.schema["$defs"][name]
            words = choices(what)
            if words:
                return words
            if what.get("type") not in (None, "object") and "properties" not in what:
                return self.kind(what)
            self.waiting.append(name)
            return f"[{title(name)}](#{anchor(name)})"
        if "const" in value:
            return f'`"{value["const"]}"`'
        if choices(value):
            return choices(value)
        for key in ("oneOf", "anyOf"):
            if key in value:
                kinds = [self.kind(each) for each in value[key] if each.get("type") != "null"]
                return " or ".join(dict.fromkeys(kinds))
        kind = value.get("type", "any")
        kind = next(each for each in kind if each != "null") if isinstance(kind, list) else kind
        if kind == "array":
            return self.list(value)
        if kind == "object" and isinstance(value.get("additionalProperties"), dict):
            return f"table of names, each {self.kind(value['additionalProperties'])}"
        if kind == "object" and "properties" in value:
            return "table: " + ", ".join(f"`{key}` {self.kind(each)}" for key, each in value["properties"].items())
        return {"string": "text", "integer": "whole number", "boolean": "true or false", "object": "table"}.get(
            kind, kind
        )

    def list(self, value: dict) -> str:
        """The type of a list in words."""
        if "prefixItems" in value:
            return "list of " + ", ".join(self.kind(each) for each in value["prefixItems"])
        count = value.get("minItems") if value.get("minItems") == value.get("maxItems") else None
        inner = self.kind(value.get("items", {}))
        inner = {"number": "numbers", "whole number": "whole numbers", "text": "texts"}.get(inner, inner)
        return f"list of {count} {inner}" if count else f"list of {inner}"


def choices(value: dict) -> str:
    """The words a text may be, or nothing."""
    words = list(value.get("enum", []))
    for each in value.get("oneOf", []):
        if each.get("type", "string") == "string" and "const" in each:
            words.append(each["const"])
        elif each.get("type") == "string" and "enum" in each:
            words += each["enum"]
    whole = words and len(words) >= len(value.get("oneOf", []))
    return " or ".join(f'`"{word}"`' for word in words if word is not None) if whole else ""


def unit(key: str, value: dict) -> str:
    """The unit of a key, by its name or its description."""
    for end, word in ENDS.items():
        if key.endswith(end):
            return word
    if '"number"' in json.dumps(value.get("type", "")) or "items" in value:
        found = re.search(WORDS, re.sub(r"`[^`]*`", "", value.get("description", "")))
        return found[1] if found else ""
    return ""


def shown(value: dict) -> str:
    """A default as a design file writes it."""
    if value.get("default") is None:
        return ""
    return "those of the table" if isinstance(value["default"], dict) else f"`{json.dumps(value['default'])}`"


def title(name: str) -> str:
    """The name of a table for people: no capitals in the middle, no "Spec"."""
    words = re.findall(r"[A-Z][a-z]*", re.sub(r"^Machine(?=[A-Z])|Spec$|Design$", "", name))
    return " ".join(words).capitalize() or name


def anchor(name: str) -> str:
    """The anchor of a table on its page."""
    return re.sub(r"(?<=[a-z])(?=[A-Z])", "-", name).lower()


def plain(text: str) -> str:
    """A description in one paragraph, without the marks of Rust's links."""
    text = re.sub(r"\[`([^`\]]+)`\]", r"`\1`", " ".join(text.split()))
    return text.replace("rad (degrees in the file)", "deg")


def cell(text: str) -> str:
    """Text that may stand in a table."""
    return text.replace("|", "\\|")
