"""The crates this project is built of keep to `deny.toml`: licences, versions, sources.

`cargo deny check` reads the same file and looks up advisories as well. It takes long to build: the workflow runs it.
"""

import re
import shutil
import subprocess
from collections import defaultdict

import pytest
import tomllib
from conftest import ROOT

REGISTRY = "registry+https://github.com/rust-lang/crates.io-index"
DENY = tomllib.loads((ROOT / "deny.toml").read_text())


@pytest.fixture(scope="module")
def crates():
    """Name, version and licence of every crate that is built here, for the program, the module or a test."""
    if shutil.which("cargo") is None:
        pytest.skip("the dependencies are told by Cargo: install Rust")
    tree = ["cargo", "tree", "--workspace", "--offline", "--locked", "--prefix", "none", "--format", "{p}|{l}"]
    told = subprocess.run(tree, cwd=ROOT, check=True, capture_output=True, text=True, timeout=60).stdout
    lines = {line.removesuffix(" (*)") for line in told.splitlines() if line}
    found = {(*crate.split()[:2], licence) for crate, licence in (line.split("|") for line in lines)}
    assert len(found) > 100
    return found


def choices(expression):
    """Sets of licences, each enough for what is offered under an SPDX expression."""
    tokens = re.findall(r"[()]|[^\s()]+", expression.replace("/", " OR "))

    def alternatives():
        found = together()
        while tokens[:1] == ["OR"]:
            tokens.pop(0)
            found += together()
        return found

    def together():
        found = one()
        while tokens[:1] == ["AND"]:
            tokens.pop(0)
            found = [a | b for b in one() for a in found]
        return found

    def one():
        token = tokens.pop(0)
        if token == "(":
            inner = alternatives()
            assert tokens.pop(0) == ")"
            return inner
        if tokens[:1] == ["WITH"]:
            tokens.pop(0)
            token += f" WITH {tokens.pop(0)}"
        return [{token}]

    found = alternatives()
    assert not tokens, expression
    return found


def test_expressions_of_licences_are_read():
    assert choices("MIT/Apache-2.0") == [{"MIT"}, {"Apache-2.0"}]
    assert choices("(MIT OR Zlib) AND OFL-1.1") == [{"MIT", "OFL-1.1"}, {"Zlib", "OFL-1.1"}]
    assert choices("A WITH B-exception OR C") == [{"A WITH B-exception"}, {"C"}]


def offending(crates, allowed):
    return [name for name, _, licence in crates if not any(choice <= allowed for choice in choices(licence))]


def test_every_licence_is_allowed_and_every_allowed_one_needed(crates):
    allowed = set(DENY["licenses"]["allow"])
    assert offending(crates, allowed) == []
    for licence in allowed:
        assert offending(crates, allowed - {licence}), f"no crate needs {licence}"


def test_no_banned_crate_is_built(crates):
    names = {name for name, _, _ in crates}
    banned = {entry["crate"] for entry in DENY["bans"]["deny"]}
    assert banned
    assert not names & banned


def test_no_crate_is_built_in_two_versions_but_those_told(crates):
    versions = defaultdict(set)
    for name, version, _ in crates:
        versions[name].add(version)
    for entry in DENY["bans"]["skip"]:
        name, version = entry["crate"].split("@")
        old = {found for found in versions[name] if f"{found}.".startswith(f"v{version}.")}
        assert old, f"{name} {version} is not built any more: take it off the list"
        versions[name] -= old
    assert {name: found for name, found in versions.items() if len(found) > 1} == {}


def test_every_crate_is_of_the_registry_or_of_this_repository():
    """On every platform: the lock file lists the crates of all."""
    packages = tomllib.loads((ROOT / "Cargo.lock").read_text())["package"]
    own = {package["name"] for package in packages if "source" not in package}
    assert all(name == "centrode" or name.startswith("centrode-") for name in own)
    assert {package["source"] for package in packages if "source" in package} == {REGISTRY}
    assert DENY["sources"] == {"unknown-registry": "deny", "unknown-git": "deny"}
