"""The gallery: every shipped design, run; picture, file and report of each."""

import re
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import tomllib

FAMILIES = {
    "gear-pair": "Gear pairs",
    "three-arm": "Transplanters of three arms",
    "moving-box": "Seedling boxes",
    "spiral-shaft": "Spiral shafts",
    "feeder": "Feeders",
    "machine": "Composed machines",
}
# A small picture of a large machine would have lines too thin to see.
# What shows a design best, the first there is.
LINES = "<style>*{vector-effect:non-scaling-stroke;stroke-width:.8px}</style>"
PICTURES = ("assembly.svg", "gears-assembly.svg", "groove.svg")


def make(designs: list[Path], pages: Path, binary: Path) -> None:
    """Runs the designs and writes `gallery.md` with their pictures, files and reports into `pages`."""
    with ThreadPoolExecutor(2) as pool:
        entries = list(pool.map(lambda design: entry(design, pages, binary), designs))
    text = [
        "# Gallery",
        "",
        "Each picture is made when this site is built, by running the design file. Click a picture for the report",
        "of the design: a page with its moving picture, figures, findings and curves. The link below a picture is the",
        "design file itself. Copy it, change a number, and run it:",
        "",
        "```sh",
        "centrode check design.toml",
        "centrode export design.toml --to out",
        "```",
        "",
        "*Good* means that the check finds no error. A published design can miss a goal of its own paper: its report",
        "reports which, and by how much.",
    ]
    for family, title in FAMILIES.items():
        chosen = [each for each in entries if each["family"] == family]
        if chosen:
            text += ["", f"## {title}", "", '<div class="gallery" markdown="0">']
            text += [card(each) for each in chosen]
            text += ["</div>"]
    (pages / "gallery.md").write_text("\n".join(text) + "\n")


def entry(design: Path, pages: Path, binary: Path) -> dict:
    """Runs one design: its picture, its report, its file."""
    name = design.stem
    folder = pages / "gallery" / name
    folder.mkdir(parents=True, exist_ok=True)
    drawn = folder.parent / f"{name}-drawn"
    run(binary, "export", design, "--to", drawn, "--format", "svg,json")
    picture = next(drawn / each for each in PICTURES if (drawn / each).exists())
    (folder / "picture.svg").write_text(bolder(picture.read_text(), 120))
    for made in drawn.iterdir():
        made.unlink()
    drawn.rmdir()
    status = run(binary, "report", design, "-o", folder / "report.html")
    wanted = tomllib.loads(design.read_text())
    title = wanted.get("title") or wanted.get("name") or name
    return {"name": name, "family": wanted["family"], "title": title, "good": status == 0}


def bolder(svg: str, size: float) -> str:
    """A drawing with bolder lines, as if the machine were `size` mm across: those to scale would be too thin."""
    extent = max(map(float, re.search(r'viewBox="\S+ \S+ (\S+) (\S+)"', svg).groups()))
    scale = max(extent / size, 1)

    def scaled(found: re.Match[str]) -> str:
        numbers = " ".join(f"{float(number) * scale:.4g}" for number in found[2].split())
        return f'{found[1]}="{numbers}"'

    return re.sub(r'(stroke-width|stroke-dasharray)="([\d. ]+)"', scaled, svg)


def run(binary: Path, *words: object) -> int:
    """Runs a command; a finding of severity error is no failure."""
    done = subprocess.run([binary, *map(str, words)], capture_output=True, text=True, timeout=120)
    if done.returncode not in (0, 1):
        raise RuntimeError(f"{words}: {done.stderr}")
    return done.returncode


def card(entry: dict) -> str:
    """One design as HTML."""
    name, title = entry["name"], entry["title"].replace("&", "&amp;").replace("<", "&lt;")
    verdict = "good" if entry["good"] else "has an error, see its report"
    picture = f'<img src="gallery/{name}/picture.svg" alt="{title}" loading="lazy">'
    return (
        f'<figure><a href="gallery/{name}/report.html">{picture}</a>'
        f'<figcaption>{title}<br><a href="designs/{name}.toml">{name}.toml</a>: {verdict}</figcaption></figure>'
    )
