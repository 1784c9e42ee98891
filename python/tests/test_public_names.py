"""The public names are those of the list in the repository, so that none goes unnoticed."""

import importlib

import centrode as ct
import pytest
from public_names import LIST, PACKAGE, Names, read, removed, untold, written

MODULES = sorted(path.stem for path in PACKAGE.glob("*.py") if path.stem[0] != "_")


@pytest.fixture(scope="module")
def found():
    return Names().found


def test_the_list_is_that_of_the_package(found):
    told = LIST.read_text()
    assert removed(read(told), found) == [], "gone: tell it in CHANGELOG.md, then run scripts/api"
    assert told == written(found), "new: run scripts/api"
    assert read(told) == found


def test_the_list_has_every_public_name_of_the_modules(found):
    assert {"cam", "pitch", "plot"} <= set(MODULES)
    for module in (ct, *(importlib.import_module(f"centrode.{name}") for name in MODULES)):
        for name in set(module.__all__) - set(MODULES):
            assert f"{module.__name__}.{name}" in found
    assert found["centrode.GearPair"]
    assert {"centrode.GearPair.check", "centrode.Finding.message", "centrode.ThreeArm.export"} <= set(found)


def test_every_name_is_there(found):
    for name in found:
        module, _, rest = name.removeprefix("centrode").removeprefix(".").partition(".")
        thing = ct
        if module in MODULES:
            thing = importlib.import_module(f"centrode.{module}")
        elif module:
            thing = getattr(ct, module)
        for word in filter(None, rest.split(".")):
            # A field without a default is no attribute of its class.
            fields = {name for base in getattr(thing, "__mro__", ()) for name in vars(base).get("__annotations__", ())}
            assert word in fields or hasattr(thing, word), name
            thing = getattr(thing, word, None)


def test_what_has_gone_must_be_told():
    modules = {"centrode": None, "centrode.cam": None}
    old = {**modules, "centrode.A": ["x", "y"], "centrode.A.f": ["z"], "centrode.B": None, "centrode.B.g": []}
    old["centrode.cam.h"] = []
    new = {**modules, "centrode.A": ["y"], "centrode.A.f": ["z", "w"]}
    assert removed(old, new) == ["A(x=)", "B", "cam.h"]
    assert removed(new, old) == ["A.f(w=)"]
    log = "# Changelog\n## [Unreleased]\n### Removed\n- `B`, and `A(x=)`.\n## [0.1.0]\n- `cam.h`\n"
    assert untold(["A(x=)", "B", "cam.h"], log) == ["cam.h"]
    assert untold(["cam.h"], "# Changelog\n## [Unreleased]\n") == []
    assert read(written(old)) == old
