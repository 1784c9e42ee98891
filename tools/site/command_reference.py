"""The reference of the command line, from the help texts of the program."""

import re
import subprocess
from pathlib import Path


def make(pages: Path, binary: Path) -> None:
    """Writes `reference/commands.md`."""
    top = help_of(binary)
    names = re.findall(r"^  ([a-z]+)  ", top[top.index("Commands:") : top.index("Options:")], flags=re.M)
    text = [
        "# Commands",
        "",
        "This page is what each command prints with `--help`, taken from the program when the site is built. On a",
        "computer with `man`, `centrode man export | man -l -` shows the same as a manual page.",
        "",
        "## centrode",
        "",
        "```text",
        top.rstrip(),
        "```",
    ]
    for name in names:
        if name != "help":
            text += ["", f"## centrode {name}", "", "```text", help_of(binary, name).rstrip(), "```"]
    (pages / "reference").mkdir(exist_ok=True)
    (pages / "reference" / "commands.md").write_text("\n".join(text) + "\n")


def help_of(binary: Path, *words: str) -> str:
    """What a command prints of itself."""
    return subprocess.run([binary, *words, "--help"], check=True, capture_output=True, text=True, timeout=60).stdout
