"""Runs commands and Python of a page in order, in one folder, and compares its output blocks with what is printed."""

import contextlib
import doctest
import io
import os
import re
import shlex
import subprocess
import sys
import threading
from dataclasses import dataclass
from pathlib import Path

import tomllib

ROOT = Path(__file__).resolve().parents[2]
BINARY = Path(os.environ.get("CENTRODE_BIN", ROOT / "target" / "debug" / "centrode"))

# What a page shows and nobody runs here: it installs, takes minutes, or has tests of its own.
NOT_RUN = (
    "cargo ",
    "git clone ",
    "cd ",
    "pip ",
    "scripts/",
    ".ci/",
    "benches/",
    "python benches/",
    "python tools/",
    "python tests/campaigns/",
    "tools/",
)
# Before a block of half a minute: it runs where the whole site is built, and not in every test.
SLOW = "<!-- slow -->"
# A search on a page is cut to so many evaluations.
EVALUATIONS = 60
SECONDS = 60


class PageError(Exception):
    """The result of a block differs from its page."""


@dataclass
class Block:
    """A block of code of a page: its language, the file it stands for, its text and where it stands."""

    language: str
    title: str
    text: str
    first: int
    last: int
    slow: bool = False


def blocks(text: str) -> list[Block]:
    """All blocks of code, fenced or indented; those that are indented have the language "indented"."""
    lines = text.split("\n")
    found = []
    number = 0
    while number < len(lines):
        fence = re.match(r"^(`{3,})\s*([\w-]*)(.*)$", lines[number])
        if fence:
            end = next(i for i in range(number + 1, len(lines)) if lines[i].startswith(fence[1]))
            title = re.search(r'title="([^"]+)"', fence[3])
            body = "\n".join(lines[number + 1 : end])
            slow = number > 0 and lines[number - 1] == SLOW
            found.append(Block(fence[2], title[1] if title else "", body, number + 1, end, slow))
            number = end + 1
        elif lines[number].startswith("    ") and (number == 0 or not lines[number - 1].strip()):
            end = number
            while end < len(lines) and lines[end].startswith("    "):
                end += 1
            found.append(Block("indented", "", "\n".join(line[4:] for line in lines[number:end]), number, end))
            number = end
        else:
            number += 1
    return found


def commands(block: Block) -> list[str]:
    """The command lines of a block: none if it holds something else."""
    if block.language not in ("sh", "indented"):
        return []
    lines = block.text.replace("\\\n", " ").split("\n")
    if block.language == "indented" and not re.match(
        r"(centrode|cargo|pip|python|scripts/|\.ci/)\b", lines[0].lstrip()
    ):
        return []
    return [line for line in lines if line.strip() and not line.startswith("#")]


class Run:
    """One page in one folder."""

    def __init__(self, page: Path, folder: Path, binary: Path, slow: bool = True):
        """Nothing runs yet; `slow` blocks run, too, or are passed over."""
        self.page, self.folder, self.binary, self.slow = page, folder, binary, slow
        self.names = {"__name__": "page"}
        self.files: set[str] = set()
        self.ran = 0

    def run(self, update: bool = False) -> str:
        """Runs every block; gives the page's text, its output blocks as they came out if `update`."""
        text = self.page.read_text()
        lines = text.split("\n")
        found = blocks(text)
        fresh = {}
        before = os.getcwd()
        shipped = self.folder / "tests"
        if not shipped.exists():
            shipped.symlink_to(ROOT / "tests")
        os.chdir(self.folder)
        try:
            printed = None
            for block in found:
                if block.slow and not self.slow:
                    continue
                if block.language == "text":
                    if printed is not None and update:
                        fresh[block.first, block.last] = printed.rstrip().split("\n")
                    elif printed is not None:
                        self.compare(block, printed)
                    printed = None
                    continue
                printed = self.one(block)
        finally:
            os.chdir(before)
        for (first, last), new in sorted(fresh.items(), reverse=True):
            if "..." not in "".join(lines[first:last]):
                lines[first:last] = new
        return "\n".join(lines)

    def one(self, block: Block) -> str | None:
        """Runs a block, or writes it to the file of its title; gives what it prints, None if nothing runs."""
        if block.title:
            Path(block.title).parent.mkdir(parents=True, exist_ok=True)
            with Path(block.title).open("a" if block.title in self.files else "w") as file:
                file.write(block.text + "\n")
            self.files.add(block.title)
            return None
        if block.language == "toml":
            try:
                tomllib.loads(block.text)
            except tomllib.TOMLDecodeError as error:
                raise PageError(f"{self.page}:{block.first}: no TOML: {error}") from error
        if block.language == "python":
            return self.python(block)
        printed = [self.command(line, block) for line in commands(block)]
        printed = [out for out in printed if out is not None]
        return "".join(printed) if printed else None

    def python(self, block: Block) -> str:
        """Runs Python; names stay for the next block of the page."""
        out = io.StringIO()
        code = "\n" * block.first + block.text
        try:
            with contextlib.redirect_stdout(out):
                exec(compile(code, str(self.page), "exec"), self.names)
        except Exception as error:
            raise PageError(f"{self.page}:{block.first}: {type(error).__name__}: {error}") from error
        self.ran += 1
        return out.getvalue()

    def command(self, line: str, block: Block) -> str | None:
        """Runs a command line; its status must be 0, or the status in the comment after it."""
        line = line.strip().removeprefix("cargo run --release -- ") if "cargo run" in line else line.strip()
        if line.startswith(("export ", "check ")):
            line = f"centrode {line}"
        if line.startswith(NOT_RUN):
            return None
        code, _, comment = line.partition(" #")
        said = re.search(r"exit status (\d)", comment)
        allowed = {int(said[1]) if said else 0}
        output = []
        for part in code.split(";"):
            words = shlex.split(part)
            target = None
            if ">" in words:
                words, target = words[: words.index(">")], words[-1]
            if words[0] == "python":
                words = [sys.executable, *words[1:]]
                if "play_" in words[1] and "--check" not in words:
                    return None  # it opens a window
            elif words[0] == "centrode":
                words = [str(self.binary), *words[1:]]
            else:
                raise PageError(f"{self.page}:{block.first}: {line!r} is not run: name it in NOT_RUN or leave it out")
            if words[1] == "studio":
                self.studio(words)
                continue
            if words[1] == "optimise" and "--widen" not in words:
                words, allowed = shorter(words), {0, 1}
            done = subprocess.run(words, capture_output=True, text=True, timeout=SECONDS, stdin=subprocess.DEVNULL)
            if done.returncode not in allowed:
                told = (done.stderr or done.stdout)[-800:]
                raise PageError(f"{self.page}:{block.first}: {line!r} ends with status {done.returncode}\n{told}")
            if target:
                Path(target).write_text(done.stdout)
            else:
                output.append(done.stdout)
        self.ran += 1
        return "".join(output)

    def studio(self, words: list[str]) -> None:
        """Starts the design page, waits for its address and ends it."""
        words = [word for word in words if word != "--open"]
        with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as page:
            timer = threading.Timer(SECONDS, page.kill)
            timer.start()
            address = page.stdout.readline()
            timer.cancel()
            page.terminate()
        if "http://127.0.0.1" not in address:
            raise PageError(f"{self.page}: the page says {address!r}")

    def compare(self, block: Block, printed: str) -> None:
        """The text of an output block against what was printed; "..." stands for anything."""
        checker = doctest.OutputChecker()
        wanted = block.text.rstrip() + "\n"
        got = "\n".join(line.rstrip() for line in printed.rstrip().split("\n")) + "\n"
        if not checker.check_output(wanted, got, doctest.ELLIPSIS):
            example = doctest.Example("", wanted)
            difference = checker.output_difference(example, got, doctest.ELLIPSIS | doctest.REPORT_NDIFF)
            raise PageError(f"{self.page}:{block.first}: printed otherwise\n{difference}")


def shorter(words: list[str]) -> list[str]:
    """A search with few evaluations."""
    if "--evaluations" in words:
        place = words.index("--evaluations")
        words = words[:place] + words[place + 2 :]
    return [*words, "--evaluations", str(EVALUATIONS)]


def main() -> None:
    """`blocks.py --update PAGE...` writes the output blocks of pages anew, for a person to read the difference."""
    import tempfile

    update = "--update" in sys.argv
    for name in [word for word in sys.argv[1:] if not word.startswith("-")]:
        page = Path(name).resolve()
        with tempfile.TemporaryDirectory() as folder:
            run = Run(page, Path(folder), BINARY)
            text = run.run(update)
            print(f"{name}: {run.ran} blocks and commands ran")
        if update:
            page.write_text(text)


if __name__ == "__main__":
    main()
