"""Every example in a docstring or in the README gives the answer it shows."""

import doctest
import inspect
import re
from pathlib import Path

import centrode as ct
import pytest

README = Path(__file__).resolve().parents[1] / "README.md"


def documented():
    """Everything public with its documentation."""
    yield "centrode", ct
    for module in (ct, ct.build123d, ct.cadquery, ct.cam, ct.mujoco, ct.pitch, ct.plot):
        for name in module.__all__:
            thing = getattr(module, name)
            if inspect.ismodule(thing) or isinstance(thing, str):
                continue
            yield f"{module.__name__}.{name}", thing
            if inspect.isclass(thing):
                # A class of the module lists its members in another order in every process.
                for member in sorted(vars(thing)):
                    value = vars(thing)[member]
                    if not member.startswith("_") and getattr(value, "__doc__", None):
                        yield f"{module.__name__}.{name}.{member}", value


THINGS = dict(documented())


@pytest.mark.parametrize("name", THINGS)
def test_everything_public_says_what_it_is(name):
    assert inspect.getdoc(THINGS[name])


@pytest.mark.parametrize("name", [name for name, thing in THINGS.items() if ">>>" in (inspect.getdoc(thing) or "")])
def test_examples_show_their_answers(name):
    run(name, inspect.getdoc(THINGS[name]))


def test_the_readme_runs():
    run("README", README.read_text())


def run(name, text):
    """Runs the examples of a text, each block of code as one."""
    text = text.replace("```", "\n")
    test = doctest.DocTestParser().get_doctest(text, {}, name, None, None)
    assert test.examples
    told = []
    doctest.DocTestRunner(verbose=False).run(test, out=told.append)
    assert not told, "".join(told)


def test_the_page_of_adapters_runs():
    # CadQuery needs an environment of its own: tests/campaigns/cadquery_parts.py runs its section there.
    page = (README.parents[1] / "docs" / "adapters.md").read_text()
    sections = re.split(r"^## ", page, flags=re.MULTILINE)
    kept = [section for section in sections if not section.startswith("CadQuery")]
    assert len(kept) == len(sections) - 1
    run("adapters", "\n".join(kept))
