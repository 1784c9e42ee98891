"""Builds the site: runs its pages, makes what is made, hands all to mkdocs and checks the links. See `scripts/site`."""

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import command_reference
import design_reference
import gallery
import links
import notebook
import python_reference
from blocks import BINARY, ROOT, PageError, Run

HERE = Path(__file__).resolve().parent
DOCS = ROOT / "docs"
FEW = ("law-pair", "spiral-shaft-2018", "jansen-leg", "peaucellier-cell")
PICTURE = re.compile(r"!\[([^\]]*)\]\(([^)\s]+)\)")


def pages() -> list[Path]:
    """All pages written by hand, by their paths within `docs`."""
    return sorted(page.relative_to(DOCS) for page in DOCS.rglob("*.md"))


def stage(page: Path, to: Path, ran: Path, text: str) -> None:
    """A page for the generator: links to shipped designs lead to their copies, pictures come from the page's run."""
    up = "../" * (len(page.parts) - 1)
    text = re.sub(r"\]\((?:\.\./)+tests/designs/", f"]({up}designs/", text)

    def picture(found: re.Match[str]) -> str:
        words, name = found[1], found[2]
        if (DOCS / page.parent / name).exists():
            return found[0]
        made = ran / name
        if not made.exists():
            raise PageError(f"{page}: no block of the page makes the picture {name}")
        file = f"{page.stem}-{name.replace('/', '-')}"
        drawn = made.name == "assembly.svg"
        (to / page.parent / file).write_text(gallery.bolder(made.read_text(), 300) if drawn else made.read_text())
        return f"![{words}]({file})"

    (to / page).parent.mkdir(parents=True, exist_ok=True)
    (to / page).write_text(PICTURE.sub(picture, text))


def run_pages(out: Path, binary: Path, slow: bool) -> dict[str, str]:
    """Runs and stages every page; gives what is wrong with each, nothing if it is good."""
    told = {}
    for page in pages():
        folder = out / "runs" / page.with_suffix("")
        folder.mkdir(parents=True)
        run = Run(DOCS / page, folder, binary, slow)
        try:
            stage(page, out / "pages", folder, run.run())
            told[str(page)] = ""
        except PageError as fault:
            told[str(page)] = str(fault)
    return told


def copy_assets(out: Path) -> None:
    """What pages show that is no page."""
    for file in DOCS.rglob("*.png"):
        to = out / "pages" / file.relative_to(DOCS)
        to.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(file, to)
    shutil.copytree(ROOT / "tests" / "designs", out / "pages" / "designs")
    shutil.copytree(HERE / "assets", out / "pages" / "assets", dirs_exist_ok=True)


def run_notebooks(out: Path) -> dict[str, int]:
    """Executes the notebooks; gives how many cells of each ran."""
    ran = {}
    for page in notebook.PAGES:
        file = notebook.path(page)
        with tempfile.TemporaryDirectory() as folder:
            ran[file.name] = notebook.execute(file, Path(folder), out / "pages" / "notebooks" / file.name)
    return ran


def render(out: Path) -> str:
    """Hands the pages to mkdocs, which must give no warning; returns its output."""
    # The generator's authors print an announcement of theirs with every build.
    environment = {**os.environ, "CENTRODE_PAGES": str(out / "pages"), "NO_MKDOCS_2_WARNING": "1", "NO_COLOR": "1"}
    environment["PYTHONPATH"] = os.pathsep.join([str(HERE), environment.get("PYTHONPATH", "")])
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--quiet", "--config-file", HERE / "mkdocs.yml"]
    done = subprocess.run([*command, "--site-dir", out / "html"], env=environment, capture_output=True, text=True)
    return done.stdout + done.stderr + (f"status {done.returncode}" if done.returncode else "")


def make(out: Path, binary: Path = BINARY, whole: bool = True) -> dict:
    """Builds everything into `out`: `pages` for the generator, `html` for readers; gives what each step told.

    Not `whole`: without the slow blocks, and with few designs in the gallery.
    """
    if out.exists():
        shutil.rmtree(out)
    (out / "pages").mkdir(parents=True)
    designs = sorted((ROOT / "tests" / "designs").glob("*.toml"))
    if not whole:
        designs = [ROOT / "tests" / "designs" / f"{name}.toml" for name in FEW]
    told = {"pages": run_pages(out, binary, whole)}
    gallery.make(designs, out / "pages", binary)
    design_reference.make(out / "pages", binary)
    command_reference.make(out / "pages", binary)
    python_reference.make(out / "pages")
    copy_assets(out)
    told["notebooks"] = run_notebooks(out)
    told["warnings"] = render(out)
    told["links"] = links.faults(out / "html") if (out / "html").exists() else ["there is no site"]
    return told


def main() -> None:
    """Builds the site and ends with status 1 if anything is wrong."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("--to", type=Path, default=ROOT / "site")
    out = parser.parse_args().to
    told = make(out)
    wrong = [fault for fault in told["pages"].values() if fault] + told["links"]
    if told["warnings"]:
        wrong.append(told["warnings"])
    print("\n".join(wrong) or f"{out / 'html' / 'index.html'}")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
