"""Writes reference figures as TOML, rounded from 40 working digits to 25."""

from pathlib import Path

from mpmath import mp, mpf, nstr

mp.dps = 40
FOLDER = Path(__file__).resolve().parents[1] / "published" / "data"


def written(value) -> str:
    """One TOML value: number, text, truth, or a list of them."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, str):
        return f'"{value}"'
    if isinstance(value, list | tuple):
        return "[" + ", ".join(written(item) for item in value) + "]"
    value = mpf(value)
    if abs(value) < mpf(10) ** -30:
        return "0.0"
    return nstr(value, 25, min_fixed=-4, max_fixed=12, strip_zeros=True)


def table(values: dict) -> list[str]:
    """The lines of one TOML table; a list of lists has one row per line."""
    lines = []
    for key, value in values.items():
        if isinstance(value, list) and value and isinstance(value[0], list | tuple):
            rows = ",\n".join("  " + written(row) for row in value)
            lines.append(f"{key} = [\n{rows},\n]")
        else:
            lines.append(f"{key} = {written(value)}")
    return lines


def write(name: str, head: str, cases: list[dict]) -> None:
    """Writes `tests/published/data/<name>.toml`: a comment, then one `[[case]]` each."""
    lines = [f"# {line}".rstrip() for line in head.strip().splitlines()]
    lines.append(f"# Made by scripts/oracle ({name}.py); not edited by hand.")
    for case in cases:
        lines += ["", "[[case]]", *table(case)]
    FOLDER.mkdir(parents=True, exist_ok=True)
    (FOLDER / f"{name}.toml").write_text("\n".join(lines) + "\n", encoding="utf-8")
