"""Numbers of a design file: found, changed, written back. Needs no FreeCAD."""

import json
import math

import tomllib


def numbers(text):
    """Give the numbers of a design by their keys, `teeth.backlash`, in the order of the file; none in lists."""
    found = {}

    def visit(table, before):
        for name, value in table.items():
            key = (*before, name)
            if isinstance(value, dict):
                visit(value, key)
            elif isinstance(value, int | float) and not isinstance(value, bool):
                found[".".join(key)] = value

    visit(tomllib.loads(text), ())
    return found


def changed(text, values):
    """Give the design with numbers changed, by their keys; its comments are lost."""
    design = tomllib.loads(text)
    for key, value in values.items():
        *tables, name = key.split(".")
        table = design
        for step in tables:
            table = table[step]
        # A count stays one; a length that was written without a point may get one.
        whole = isinstance(table[name], int) and float(value).is_integer()
        table[name] = int(value) if whole else float(value)
    return written(design)


def written(design):
    """Write a design as TOML, tables in full, lists and tables in lists on one line."""
    lines = []

    def visit(table, before):
        plain = {name: value for name, value in table.items() if not isinstance(value, dict)}
        if before and (plain or not table):
            lines.append(f"\n[{'.'.join(before)}]")
        lines.extend(f"{_key(name)} = {_value(value)}" for name, value in plain.items())
        for name, value in table.items():
            if isinstance(value, dict):
                visit(value, (*before, _key(name)))

    visit(design, ())
    return "\n".join(lines).lstrip("\n") + "\n"


def _key(name):
    plain = name and all(letter.isascii() and (letter.isalnum() or letter in "-_") for letter in name)
    return name if plain else _value(name)


def _value(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        # TOML's escapes are JSON's, but for the one that JSON leaves as it is.
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, float) and not math.isfinite(value):
        return "nan" if math.isnan(value) else "inf" if value > 0 else "-inf"
    if isinstance(value, list):
        return f"[{', '.join(map(_value, value))}]"
    if isinstance(value, dict):
        return f"{{ {', '.join(f'{_key(name)} = {_value(one)}' for name, one in value.items())} }}"
    return repr(value) if isinstance(value, int | float) else value.isoformat()
