"""Laws from files and from noisy arrays: the file next to the design, and smoothing as numpy computes it."""

from pathlib import Path

import centrode as ct
import numpy as np
import pytest

MEASURED = Path(__file__).parents[2] / "tests" / "laws" / "measured.csv"
ROWS = np.loadtxt(MEASURED, delimiter=",", skiprows=2)
PHI, RATIO = np.radians(ROWS[:, 0]), ROWS[:, 2]


def design(keys):
    pitch = f'[pitch]\nkind = "ratio"\n{keys}\nmodule = 2\ntooth_count = 24\n'
    return f'family = "gear-pair"\n{pitch}[teeth]\nbacklash = 0.05\n'


def series(samples, harmonics, phi):
    """The Fourier series of samples, cut off, at some angles."""
    terms = np.fft.rfft(samples)[: harmonics + 1] / len(samples)
    terms[1:] *= 2
    return sum((term * np.exp(1j * n * phi)).real for n, term in enumerate(terms))


def test_a_smoothed_law_is_the_truncated_fourier_series_of_numpy():
    phi = np.linspace(0, 2 * np.pi, 50)
    pitch = ct.pitch.from_ratio(RATIO, smooth={"harmonics": 4}, module=2, tooth_count=24)
    pair = ct.GearPair(pitch)
    expected = series(RATIO, 4, phi) / RATIO.mean()
    np.testing.assert_allclose(pair.ratio(phi), expected, rtol=1e-10)
    # A driven angle, with the end of the turn and the same noise.
    angle = np.append(PHI, 2 * np.pi) + 0.01 * np.sin(np.append(PHI, 0))
    angle[:-1] += 1e-3 * (RATIO - series(RATIO, 4, PHI))
    angle[-1] = angle[0] + 2 * np.pi
    pitch = ct.pitch.from_transmission(angle, smooth={"harmonics": 5}, module=2, tooth_count=24)
    swing = series(angle[:-1] - PHI, 5, phi)
    found = ct.GearPair(pitch).driven_angle(phi)
    np.testing.assert_allclose(found - found[0], phi + swing - phi[0] - swing[0], atol=1e-10)


def test_a_tolerance_is_the_distance_from_every_sample():
    for tolerance in (0.05, 0.02):
        pitch = ct.pitch.polar(40 * RATIO, smooth={"tolerance": 40 * tolerance})
        radius = np.hypot(*pitch.points(PHI).T)
        assert abs(radius - 40 * RATIO).max() <= 40 * tolerance


def test_a_design_with_a_file_is_the_design_with_its_samples(tmp_path):
    (tmp_path / "law.csv").write_bytes(MEASURED.read_bytes())
    path = tmp_path / "pair.toml"
    path.write_text(design('file = "law.csv"\ncolumn = "ratio"\nsmooth = { harmonics = 3 }'))
    of_file = ct.load(path)
    pitch = ct.pitch.from_ratio(RATIO, angle=PHI, smooth={"harmonics": 3}, module=2, tooth_count=24)
    pair = ct.GearPair(pitch, backlash=0.05)
    np.testing.assert_allclose(of_file.driver.outline(1e-3), pair.driver.outline(1e-3), atol=1e-12)
    # The text of the design has the samples, so that it needs no folder.
    again = ct.GearPair.from_toml(of_file.to_toml())
    np.testing.assert_array_equal(again.driver.outline(1e-3), of_file.driver.outline(1e-3))
    assert "law.csv" not in of_file.to_toml()


def test_noise_is_one_finding_that_names_the_smoothing():
    noisy = ct.GearPair(ct.pitch.from_ratio(RATIO, module=2, tooth_count=24), backlash=0.05).check()
    assert [finding.rule for finding in noisy.findings] == ["noisy-law", "scaled-mean"]
    assert "smooth = { harmonics =" in noisy.findings[0].remedy


def test_a_file_needs_its_folder_and_a_smoothing_one_key(tmp_path):
    text = design('file = "law.csv"')
    with pytest.raises(ct.DesignError, match="without its folder") as refused:
        ct.GearPair.from_toml(text)
    assert refused.value.key == "pitch.file"
    path = tmp_path / "pair.toml"
    path.write_text(text)
    with pytest.raises(ct.DesignError, match=r"cannot read law\.csv") as refused:
        ct.load(path)
    assert (refused.value.key, refused.value.line) == ("pitch.file", 4)
    with pytest.raises(ct.DesignError, match="one of harmonics and tolerance"):
        ct.pitch.from_ratio(RATIO, smooth={}, center_distance=60)
    with pytest.raises(TypeError, match="harmonic"):
        ct.pitch.from_ratio(RATIO, smooth={"harmonic": 3}, center_distance=60)
    with pytest.raises(TypeError):
        ct.pitch.from_ratio(RATIO, smooth=3, center_distance=60)
