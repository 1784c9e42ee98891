"""Notebooks of the tutorial's pages that are all Python: made from the page, so both are identical, and executed."""

import json
import re
from pathlib import Path

from blocks import blocks

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "docs" / "notebooks"
PAGES = ("tutorial/2-your-own-law", "tutorial/5-sweep", "tutorial/6-simulate")


def made(page: Path) -> str:
    """The notebook of a page, without outputs: a cell for each stretch of text and each block of Python."""
    text = page.read_text()
    lines = text.split("\n")
    cells, here = [], 0
    for block in blocks(text):
        before = "\n".join(lines[here : max(block.first - 1, here)])
        cells.append(("markdown", words(before)))
        if block.language == "python":
            cells.append(("code", block.text))
        elif block.language not in ("text", "indented"):
            cells.append(("markdown", f"```{block.language}\n{block.text}\n```"))
        here = block.last + 1
    cells.append(("markdown", words("\n".join(lines[here:]))))
    listed = [cell(kind, source, number) for number, (kind, source) in enumerate(cells, 1) if source]
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    book = {
        "cells": listed,
        "metadata": {"kernelspec": kernel, "language_info": {"name": "python"}},
        "nbformat": 4,
        "nbformat_minor": 5,
    }
    return json.dumps(book, indent=1, ensure_ascii=False) + "\n"


def words(text: str) -> str:
    """Text without what a notebook has not: pictures next to it, links to other pages."""
    text = re.sub(r"^!\[[^\]]*\]\([^)]*\)$", "", text, flags=re.M)
    text = re.sub(r"\[([^\]]*)\]\((?!https?:)[^)]*\)", r"\1", text)
    return re.sub(r"\n{3,}", "\n\n", text).strip()


def cell(kind: str, source: str, number: int) -> dict:
    """A cell as the format has it."""
    lines = source.splitlines(keepends=True)
    base = {"cell_type": kind, "id": f"cell-{number}", "metadata": {}, "source": lines}
    return base if kind == "markdown" else {**base, "execution_count": None, "outputs": []}


def path(page: str) -> Path:
    """Where the notebook of a page is kept."""
    return FOLDER / f"{page.rsplit('/', 1)[-1]}.ipynb"


def execute(notebook: Path, folder: Path, to: Path) -> int:
    """Executes a notebook in a folder with its own kernel, writes it with outputs and gives the cells that ran."""
    import nbformat
    from nbclient import NotebookClient

    book = nbformat.read(notebook, as_version=4)
    nbformat.validate(book)
    # The kernel warns that other users of this computer could listen.
    quiet = ["--IPKernelApp.log_level=40"]
    NotebookClient(book, timeout=60, extra_arguments=quiet, resources={"metadata": {"path": str(folder)}}).execute()
    to.parent.mkdir(parents=True, exist_ok=True)
    nbformat.write(book, to)
    return sum(each.cell_type == "code" and each.execution_count is not None for each in book.cells)


def main() -> None:
    """Writes all notebooks anew."""
    FOLDER.mkdir(exist_ok=True)
    for page in PAGES:
        path(page).write_text(made(ROOT / "docs" / f"{page}.md"))
        print(path(page).relative_to(ROOT))


if __name__ == "__main__":
    main()
