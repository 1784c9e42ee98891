import re

import pytest
from conftest import DESIGNS, ROOT, centrode

SHIPPED = sorted((ROOT / "tests" / "designs").glob("*.toml"))


@pytest.mark.parametrize("design", SHIPPED, ids=lambda path: path.stem)
def test_a_report_is_one_small_file_that_asks_for_nothing(design, tmp_path):
    out = tmp_path / "report.html"
    centrode("report", design, "-o", out, check=False)
    html = out.read_text()
    assert len(html.encode()) < 2_000_000
    assert "default-src 'none'" in html
    assert not re.search(r"<link\b|<script[^>]*\bsrc=|<img\b|@import", html)
    assert [path.name for path in tmp_path.iterdir()] == ["report.html"]


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
