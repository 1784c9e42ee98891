"""The site builds without a warning, its examples give the printed results, and no link is broken."""

import json
import re
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("material")
pytest.importorskip("nbclient")
pytest.importorskip("ezdxf")
pytest.importorskip("mujoco")

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools" / "site"))

import blocks  # noqa: E402
import build  # noqa: E402
import links  # noqa: E402
import notebook  # noqa: E402

MODULES = ("build123d", "cadquery", "cam", "mujoco", "pitch", "plot")
PAGES = [str(page) for page in build.pages()]


@pytest.fixture(scope="module")
def told(tmp_path_factory):
    """What every step of the build told; without the slow blocks, with a gallery of few designs."""
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("agg")
    out = tmp_path_factory.mktemp("site") / "site"
    return build.make(out, whole=False) | {"out": out}


@pytest.mark.parametrize("page", PAGES)
def test_what_a_page_shows_is_what_comes_out(told, page):
    assert not told["pages"][page], told["pages"][page]


def test_what_the_readme_shows_is_what_comes_out(tmp_path):
    text = (ROOT / "README.md").read_text()
    run = blocks.Run(ROOT / "README.md", tmp_path, blocks.BINARY, slow=False)
    run.run()
    assert run.ran == 9
    assert len(text.splitlines()) <= 120
    for link in re.findall(r"\]\(([^)#:]+)\)", text):
        assert (ROOT / link).exists(), link


def test_the_generator_has_nothing_to_warn_of(told):
    assert not told["warnings"], told["warnings"]


def test_no_link_is_broken_and_nothing_comes_from_elsewhere(told):
    assert not told["links"], "\n".join(told["links"])
    styles = [style.read_text() for style in (told["out"] / "html").rglob("*.css")]
    assert styles
    assert not [found for style in styles for found in re.findall(r"url\([\"']?(?:https?:)?//[^)]*\)", style)]


def test_notebooks_say_what_their_pages_say_and_run(told):
    for page in notebook.PAGES:
        file = notebook.path(page)
        assert file.read_text() == notebook.made(ROOT / "docs" / f"{page}.md"), "python tools/site/notebook.py"
        code = sum(cell["cell_type"] == "code" for cell in json.loads(file.read_text())["cells"])
        assert told["notebooks"][file.name] == code > 0


def test_formulas_are_mathml(told):
    page = (told["out"] / "html" / "theory" / "teeth.html").read_text()
    assert page.count("<math") >= page.count('<div class="formula"') >= 3
    assert "arithmatex" not in page
    assert "$$" not in page


def test_references_hold_every_key_command_and_name(told):
    import centrode as ct

    folder = told["out"] / "html" / "reference"
    commands = (folder / "commands.html").read_text()
    for name in ("new", "check", "export", "reverse", "completions"):
        assert f'id="centrode-{name}"' in commands
    python = (folder / "python.html").read_text()
    for name in ct.__all__:
        assert f'id="{name}"' in python or name in MODULES or name == "__version__", name
    for family in build.design_reference.families(blocks.BINARY):
        schema = subprocess.run([blocks.BINARY, "schema", family], check=True, capture_output=True, text=True).stdout
        page = (folder / "design" / f"{family}.html").read_text()
        wanted = set(json.loads(schema)["properties"])
        wanted |= {key for what in json.loads(schema)["$defs"].values() for key in what.get("properties", {})}
        assert not [key for key in wanted if f"<code>{key}</code>" not in page]


def test_a_search_works_without_a_server(told):
    html = told["out"] / "html"
    index = (html / "search" / "search_index.js").read_text()
    assert index.startswith("var __index = ")
    assert "undercut" in index
    assert "iframe-worker/shim.js" in (html / "index.html").read_text()


def page_of(folder, text):
    page = folder / "page.md"
    page.write_text(text)
    return blocks.Run(page, folder, blocks.BINARY)


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("```python\nprint(1)\n```\n\n```text\n2\n```\n", "otherwise"),
        ("```python\n1 / 0\n```\n", "ZeroDivisionError"),
        ("```sh\ncentrode check missing.toml\n```\n", "ends with status 2"),
        ("    centrode check missing.toml\n", "ends with status 2"),
        (
            "```sh\ncentrode new gear-pair > pair.toml\ncentrode check pair.toml   # exit status 1: no\n```\n",
            "status 0",
        ),
        ("```toml\nkind = circle\n```\n", "no TOML"),
        ("```sh\nrm -r out\n```\n", "is not run"),
    ],
)
def test_a_page_that_lies_is_found(tmp_path, text, fault):
    with pytest.raises(blocks.PageError, match=fault):
        page_of(tmp_path, text).run()


def test_a_broken_link_is_found(tmp_path):
    (tmp_path / "a.html").write_text(
        '<a href="b.html#here"></a><a href="c.html"></a><a href="b.html#there"></a><img src="https://example.org/x.png">'
    )
    (tmp_path / "b.html").write_text('<h1 id="here"></h1>')
    found = links.faults(tmp_path)
    assert [fault.partition(" ")[2] for fault in found] == [
        "b.html#there has no such anchor",
        "c.html leads nowhere",
        "https://example.org/x.png comes from elsewhere",
    ]
