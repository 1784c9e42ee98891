import base64
import hashlib
import re

import pytest
from conftest import DESIGNS, ROOT, centrode
from sample import sampled

SHIPPED = sorted((ROOT / "tests" / "designs").glob("*.toml"))


@pytest.mark.parametrize("design", sampled(SHIPPED), ids=lambda path: path.stem)
def test_a_report_is_one_small_file_that_asks_for_nothing(design, tmp_path):
    out = tmp_path / "report.html"
    centrode("report", design, "-o", out, check=False)
    html = out.read_text()
    assert len(html.encode()) < 2_000_000
    assert "default-src 'none'" in html
    assert not re.search(r"<link\b|<script[^>]*\bsrc=|<img\b|@import", html)
    assert [path.name for path in tmp_path.iterdir()] == ["report.html"]


def test_what_runs_in_a_report_is_named_by_its_hash(tmp_path):
    out = tmp_path / "report.html"
    centrode("report", ROOT / "tests" / "designs" / "elliptic-pair-2018.toml", "-o", out)
    html = out.read_text()
    (policy,) = re.findall(r'<meta http-equiv="Content-Security-Policy" content="([^"]*)">', html)
    assert "unsafe" not in policy
    rules = {rule.split()[0]: rule.split()[1:] for rule in policy.split("; ")}

    def hashes(pattern):
        found = re.findall(pattern, html, re.S)
        return ["'sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode() + "'" for text in found]

    assert rules["script-src"] == hashes(r'<script type="module">(.*?)</script>')
    assert rules["style-src"] == hashes(r"<style>(.*?)</style>")
    # No attribute has a style or a script in it, which no hash would name.
    assert not re.search(r'<[a-z][^<>]* (style|on[a-z]+)="', html.split('id="snapshot"')[0])


def test_a_report_is_the_same_every_time(tmp_path):
    design = tmp_path / "pair.toml"
    design.write_text(DESIGNS["circle"])
    texts = []
    for name in ["a.html", "b.html"]:
        centrode("report", design, "-o", tmp_path / name)
        texts.append((tmp_path / name).read_text())
    assert texts[0] == texts[1]


def test_a_bad_design_gives_no_report(tmp_path):
    design = tmp_path / "pair.toml"
    design.write_text(DESIGNS["circle"].replace("2.0", "-2.0"))
    done = centrode("report", design, "-o", tmp_path / "pair.html", check=False)
    assert done.returncode == 2
    assert "pitch.module" in done.stderr
    assert "-->" in done.stderr
    assert not (tmp_path / "pair.html").exists()
