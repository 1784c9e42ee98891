import json


def test_a_good_pair_checks_out(exported, run):
    done = run("check", exported.design, "--json", check=False)
    report = json.loads(done.stdout)
    assert done.returncode == 0, report["findings"]
    # Flanks thinned for backlash are conjugate to its first order only.
    bound = 1e-6 if "backlash" in exported.design.read_text() else 1e-8
    assert report["values"]["transmission_error_max"] < bound
    assert report["ok"]
    assert exported.report() == report


def test_the_new_design_file_is_a_good_pair(run, tmp_path):
    design = tmp_path / "pair.toml"
    design.write_text(run("new", "gear-pair").stdout)
    assert run("check", design, check=False).returncode == 0
