import json
import time

import pytest


def test_a_good_pair_checks_out(exported, run):
    done = run("check", exported.design, "--json", check=False)
    report = json.loads(done.stdout)
    assert done.returncode == 0, report["findings"]
    assert report["values"]["transmission_error_max"] < 1e-8
    assert json.loads((exported / "report.json").read_text())["values"] == report["values"]


def test_the_new_design_file_is_a_good_pair(run, tmp_path):
    design = tmp_path / "pair.toml"
    design.write_text(run("new", "gear-pair").stdout)
    assert run("check", design, check=False).returncode == 0


@pytest.mark.parametrize(
    ("text", "key"),
    [
        ('[pitch]\nkind = "ellipse"\neccentricity = nan\nmodule = 1\ntooth_count = 20\n', "eccentricity"),
        ('[pitch]\nkind = "ellipse"\neccentricity = 1.0\nmodule = 1\ntooth_count = 20\n', "eccentricity"),
        ('[pitch]\nkind = "ellipse"\neccentricity = 0.1\nmodule = 0\ntooth_count = 20\n', "module"),
        ('[pitch]\nkind = "ellipse"\neccentricity = 0.1\nmodule = 1\ntooth_count = 2\n', "tooth_count"),
        ('[pitch]\nkind = "ellipse"\neccentricty = 0.1\nmodule = 1\ntooth_count = 20\n', "eccentricty"),
        ('[pitch]\nkind = "polar"\nexpression = "1 + x"\nmodule = 1\ntooth_count = 20\n', "expression"),
        ('[pitch]\nkind = "polar"\nexpression = "1/(phi-phi)"\nmodule = 1\ntooth_count = 20\n', "expression"),
        ('[pitch]\nkind = "polar"\nexpression = "cos(phi)"\nmodule = 1\ntooth_count = 20\n', "expression"),
        ('center_distance = 7\n[pitch]\nkind = "circle"\nmodule = 1\ntooth_count = 20\n', "center_distance"),
        ('[pitch]\nkind = "ellip', "line 2"),
        ("# " + "x" * 10_000_000, "MB"),
    ],
    ids=lambda value: value[-40:] if len(value) < 200 else "10 MB",
)
def test_bad_input_is_a_clear_error_and_writes_nothing(run, tmp_path, text, key):
    design, out = tmp_path / "pair.toml", tmp_path / "out"
    design.write_text(text)
    start = time.monotonic()
    done = run("export", design, "--to", out, check=False)
    assert time.monotonic() - start < 1
    assert done.returncode == 2
    assert key in done.stderr
    assert not out.exists()
