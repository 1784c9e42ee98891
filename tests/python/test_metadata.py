"""All files agree about the packages: versions, licences, files, commands."""

import importlib
import json
import re
import shutil
import subprocess
from pathlib import Path

import centrode as ct
import pytest
import tomllib
import yaml
from conftest import ROOT

CARGO = tomllib.loads((ROOT / "Cargo.toml").read_text())
PYPROJECT = tomllib.loads((ROOT / "python" / "pyproject.toml").read_text())
CITATION = yaml.safe_load((ROOT / "CITATION.cff").read_text())
WORKFLOWS = sorted((ROOT / ".github" / "workflows").glob("*.yml"))
FORMS = sorted((ROOT / ".github" / "ISSUE_TEMPLATE").glob("*.yml"))
PUBLISHED = sorted(path.parent.name for path in (ROOT / "crates").glob("*/Cargo.toml"))


def cargo(*words):
    if shutil.which("cargo") is None:
        pytest.skip("packages are told by Cargo: install Rust")
    command = ["cargo", *words]
    return subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True, timeout=60).stdout


@pytest.fixture(scope="module")
def members():
    told = json.loads(cargo("metadata", "--no-deps", "--offline", "--format-version=1"))
    return {package["name"]: package for package in told["packages"]}


def test_the_version_is_the_same_everywhere(members):
    version = CARGO["workspace"]["package"]["version"]
    assert {package["version"] for package in members.values()} == {version}
    inner = [crate for name, crate in CARGO["workspace"]["dependencies"].items() if name.startswith("centrode")]
    assert {crate["version"] for crate in inner} == {version}
    assert PYPROJECT["project"]["dynamic"] == ["version"]
    assert ct.__version__ == version
    assert CITATION["version"] == version
    # Nothing has been released as 0.1.0 yet.
    assert f"## [{version}]" in (ROOT / "CHANGELOG.md").read_text() or version == "0.1.0"


def test_the_rust_promised_is_the_rust_tested(members):
    promised = CARGO["workspace"]["package"]["rust-version"]
    assert {package["rust_version"] for package in members.values()} == {promised}
    for path in WORKFLOWS:
        assert yaml.safe_load(path.read_text())["env"]["RUST"] == promised, path.name
    assert "`rust-version` in `Cargo.toml`" in (ROOT / "CONTRIBUTING.md").read_text()


def test_the_python_promised_is_the_one_built_for():
    minimum = PYPROJECT["project"]["requires-python"].removeprefix(">=")
    bare = minimum.replace(".", "")
    module = tomllib.loads((ROOT / "python" / "Cargo.toml").read_text())
    assert module["dependencies"]["pyo3"]["features"] == [f"abi3-py{bare}"]
    assert tomllib.loads((ROOT / "ruff.toml").read_text())["target-version"] == f"py{bare}"


def test_what_is_published_is_described(members):
    assert sorted(name for name, package in members.items() if package["publish"] is None) == PUBLISHED
    for name in PUBLISHED:
        package, folder = members[name], ROOT / "crates" / name
        assert len(package["description"]) > 30
        assert package["documentation"] == f"https://docs.rs/{name}"
        assert package["authors"] == CARGO["workspace"]["package"]["authors"]
        assert (folder / package["readme"]).read_text().startswith(f"# {name}\n")
        # Limits of the registry.
        assert 0 < len(package["keywords"]) <= 5
        assert all(re.fullmatch(r"[a-z0-9][\w+-]{0,19}", word) for word in package["keywords"])
        assert 0 < len(package["categories"]) <= 5
        for licence in ("LICENSE-MIT", "LICENSE-APACHE"):
            assert (folder / licence).read_bytes() == (ROOT / licence).read_bytes()


@pytest.mark.parametrize("name", PUBLISHED)
def test_a_package_holds_every_file_it_needs(name):
    folder = ROOT / "crates" / name
    listed = set(cargo("package", "--list", "--offline", "--allow-dirty", "-p", name).split("\n"))
    assert {"README.md", "LICENSE-MIT", "LICENSE-APACHE", "Cargo.lock", "src/lib.rs"} <= listed
    test = re.compile(r"/tests(\.rs|/)|\.proptest-regressions$")
    for path in (folder / "src").rglob("*"):
        if path.is_file():
            short = path.relative_to(folder).as_posix()
            assert (short in listed) != bool(test.search(short)), short
    included = []
    for path in (folder / "src").rglob("*.rs"):
        if path.relative_to(folder).as_posix() in listed:
            for target in re.findall(r'include_(?:str|bytes)!\(\s*"([^"]+)"', path.read_text()):
                included.append((path.parent / target).resolve())
    for target in included:
        assert target.relative_to(folder).as_posix() in listed, target
    assert included or name not in ("centrode-formats", "centrode-gear", "centrode-groove", "centrode-machines")


def test_the_python_package_has_its_command_and_its_licences():
    project = PYPROJECT["project"]
    module, _, function = project["scripts"]["centrode"].partition(":")
    assert module == "centrode.__main__"
    assert callable(getattr(importlib.import_module(module), function))
    assert project["license"] == "(MIT OR Apache-2.0) AND OFL-1.1"
    texts = {path.name: path.read_bytes() for path in (ROOT / "python").glob(project["license-files"][0])}
    assert texts == {
        "LICENSE-MIT": (ROOT / "LICENSE-MIT").read_bytes(),
        "LICENSE-APACHE": (ROOT / "LICENSE-APACHE").read_bytes(),
        "LICENSE-OFL": (ROOT / "crates/centrode-formats/font/OFL.txt").read_bytes(),
    }
    assert [word.split(">")[0] for word in project["optional-dependencies"]["plot"]] == ["matplotlib"]


def test_the_citation_is_one():
    """Keys that version 1.2.0 of the format asks for, and of the others only such as it knows."""
    assert CITATION["cff-version"] == "1.2.0"
    assert CITATION["type"] == "software"
    assert {"authors", "cff-version", "message", "title"} <= set(CITATION)
    assert set(CITATION) <= {
        *("abstract", "authors", "cff-version", "keywords", "license", "message", "title", "type", "version"),
        *("date-released", "doi", "repository-code", "url"),
    }
    assert CITATION["authors"] == [{"name": CARGO["workspace"]["package"]["authors"][0]}]
    assert " OR ".join(CITATION["license"]) == CARGO["workspace"]["package"]["license"]
    assert all(isinstance(CITATION[key], str) for key in ("abstract", "message", "title", "version"))


def runs(path):
    """The command lines of a workflow, without what the runner puts in."""
    for job in yaml.safe_load(path.read_text())["jobs"].values():
        for step in job["steps"]:
            if "run" in step:
                yield from re.sub(r"\$\{\{.*?\}\}", "x", step["run"]).splitlines()


@pytest.mark.parametrize("path", WORKFLOWS, ids=lambda path: path.stem)
def test_a_workflow_calls_what_there_is(path, members):
    workflow = yaml.safe_load(path.read_text())
    # The key `on` is read as true by this version of YAML.
    assert {"name", True, "permissions", "jobs"} <= set(workflow)
    for job in workflow["jobs"].values():
        assert set(job.get("needs", [])) <= set(workflow["jobs"]) or job["needs"] in workflow["jobs"]
        assert "runs-on" in job
        for step in job["steps"]:
            assert ("run" in step) != ("uses" in step)
            assert re.fullmatch(r"[\w.-]+/[\w.-]+@[\w./-]+", step.get("uses", "a/b@c"))
    commands = list(runs(path))
    for command in commands:
        for called in re.findall(r"(?<!\S)((?:scripts|\.ci|python|tests|crates)/[\w./-]+)", command):
            assert (ROOT / called).exists(), command
            if called.startswith(("scripts", ".ci")):
                assert (ROOT / called).stat().st_mode & 0o111, called
        for crate in re.findall(r"(?:-p|--package) ([\w-]+)", command):
            assert crate in members, command
        for profile in re.findall(r"--profile (\w+)", command):
            assert profile in {*CARGO["profile"], "minimal"}, command
    assert commands


def test_a_script_is_a_program_that_bash_can_read():
    found = [path for path in (ROOT / "scripts").iterdir() if path.read_text().startswith("#!")]
    assert {path.name for path in found} >= {"api", "sbom", "test"}
    for path in [*found, ROOT / ".ci" / "run"]:
        assert path.stat().st_mode & 0o111, path
        subprocess.run(["bash", "-n", path], check=True)


@pytest.mark.parametrize("path", FORMS, ids=lambda path: path.stem)
def test_a_form_of_an_issue_asks_questions(path):
    form = yaml.safe_load(path.read_text())
    if path.stem == "config":
        assert form == {"blank_issues_enabled": True}
        return
    assert {"name", "description", "body"} <= set(form)
    names = [field["id"] for field in form["body"]]
    assert len(set(names)) == len(names) >= 3
    assert all(field["type"] in ("input", "textarea") and field["attributes"]["label"] for field in form["body"])
    assert "design" in names or path.stem == "feature"


def test_files_about_the_project_name_files_that_exist():
    for name in ("SECURITY.md", "CODE_OF_CONDUCT.md", "CONTRIBUTING.md", ".github/pull_request_template.md"):
        text = (ROOT / name).read_text()
        for called in re.findall(r"(?<![\w/<])((?:scripts|\.ci|tests/python|python/tests)/[\w.-]+\w)", text):
            assert (ROOT / called).exists(), f"{name}: {called}"
        for document in re.findall(r"\b([A-Z_]{4,}\.md)\b", text):
            assert Path(ROOT, document).exists(), f"{name}: {document}"


def test_the_architecture_is_short_and_every_file_it_names_is_there():
    text = (ROOT / "ARCHITECTURE.md").read_text()
    assert text.count("\n") <= 120
    walks = re.findall(r"`((?:crates|python)/[^`]+)`", text)
    assert len(walks) > 25
    assert [name for name in walks if not (ROOT / name).exists()] == []
    named = set(re.findall(r"^\| `(centrode[a-z-]*)` \|", text, re.MULTILINE))
    assert named == {path.parent.name for path in (ROOT / "crates").glob("*/Cargo.toml")}


def test_each_file_to_add_has_its_folder_and_its_one_line_a_file():
    table = (ROOT / "CONTRIBUTING.md").read_text().partition("one file, one line")[2].partition("\n\n`")[0]
    rows = [row.split("|") for row in table.splitlines() if row.startswith("| a ")]
    assert len(rows) > 8
    for row in rows:
        for name in re.findall(r"`((?:crates|tests|docs|python)/[^`]+)`", row[2] + row[3]):
            folder = name.replace("<family>", "feeder").replace("<folder>", "theory")
            folder = folder.rpartition("/")[0] if "<name>" in folder or "*" in folder else folder
            assert (ROOT / folder).exists(), name
