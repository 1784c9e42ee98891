"""Plots from Python."""

import subprocess
import sys
from pathlib import Path

import centrode as ct
import matplotlib as mpl
import numpy as np
import pytest
from matplotlib import pyplot
from PIL import Image

mpl.use("Agg")


@pytest.fixture(autouse=True)
def _close():
    yield
    pyplot.close("all")


def shown(ax):
    """The picture as an array of grey levels."""
    figure = ax.figure
    figure.canvas.draw()
    return np.asarray(figure.canvas.buffer_rgba())[..., :3].mean(axis=2)


def test_a_turned_pair_stands_as_the_law_says(pair):
    ax = ct.plot.pair(pair, 0.7, pitch_curves=False)
    driver, driven = ax.patches
    to_mm = ax.transData.inverted()

    def posed(patch):
        return to_mm.transform(patch.get_transform().transform(patch.get_path().vertices))

    turn = np.exp(-0.7j)
    at = pair.driver.outline(0.01 * pair.module) @ [1, 1j]
    np.testing.assert_allclose(posed(driver)[: len(at)] @ [1, 1j], at * turn, atol=1e-9)
    turn = np.exp(1j * pair.driven_angle(0.7))
    at = pair.driven.outline(0.01 * pair.module) @ [1, 1j]
    np.testing.assert_allclose(posed(driven)[: len(at)] @ [1, 1j], at * turn + pair.center_distance, atol=1e-9)


def test_pairs_are_drawn_into_given_axes(design):
    pair = ct.load(design)
    _, axes = pyplot.subplots(1, 2)
    assert ct.plot.pair(pair, ax=axes[0]) is axes[0]
    assert len(axes[0].patches) == 4
    assert ct.plot.motion(pair, ax=axes[1]) is axes[1]
    grey = shown(axes[0])
    assert (grey < 200).mean() > 0.05


def test_motion_shows_the_ratio(pair):
    ax = ct.plot.motion(pair)
    ratio = ax.lines[0].get_ydata()
    assert (ratio.max(), ratio.min()) == pytest.approx((3**0.5, 3**-0.5), rel=1e-9)


def test_contact_takes_a_pair_or_an_analysis(pair):
    contact = pair.contact(2)
    for axes in (ct.plot.contact(contact), ct.plot.contact(pair)):
        assert len(axes) == 4
    drawn = ct.plot.contact(contact)[1].lines[0].get_ydata()
    np.testing.assert_array_equal(drawn, contact.contacts)


def test_an_animation_moves(pair, tmp_path):
    ct.plot.animate(pair, tmp_path / "mesh.gif", frames=3, fps=10)
    with Image.open(tmp_path / "mesh.gif") as film:
        assert film.n_frames == 3
        pictures = []
        for i in range(3):
            film.seek(i)
            pictures.append(np.asarray(film.convert("L"), dtype=float))
    assert np.abs(pictures[0] - pictures[1]).max() > 50
    ct.plot.animate(pair, str(tmp_path / "mesh.html"), frames=2)
    assert "<script" in (tmp_path / "mesh.html").read_text()


def test_other_kinds_of_film_are_refused(pair, tmp_path):
    with pytest.raises(ValueError, match="gif"):
        ct.plot.animate(pair, tmp_path / "mesh.png")
    with pytest.raises(ValueError, match="frames"):
        ct.plot.animate(pair, frames=0)


def test_a_cam_has_a_picture_of_position_velocity_acceleration_and_jerk():
    law = ct.cam.law("polynomial-4567")
    rise, fall = (make(span=np.pi, lift=20, law=law) for make in (ct.cam.rise, ct.cam.return_))
    cam = ct.DiscCam(ct.cam.translating_roller(roller_radius=8), [rise, fall], base_radius=35)
    axes = ct.plot.cam(cam)
    drawn = [ax.lines[0].get_ydata() for ax in axes]
    assert [ax.get_ylabel() for ax in axes] == [
        f"{name}\nmm{per}"
        for name, per in [("position", ""), ("velocity", "/rad"), ("acceleration", "/rad²"), ("jerk", "/rad³")]
    ]
    # Characteristic values of VDI 2143, at the nearest of 720 steps of each stroke.
    peaks = [np.abs(values).max() * np.pi**k / 20 for k, values in enumerate(drawn)]
    np.testing.assert_allclose(peaks, [1, 2.1875, 7.5132, 52.5], rtol=2e-5)
    machine = ct.load(Path(__file__).parents[2] / "tests" / "designs" / "disc-cam.toml")
    (row,) = {t.name: t for t in machine.check().tables}["cam-slide-motion"].rows.values()
    rise = 2 * np.pi / 3
    np.testing.assert_allclose(row, [20 * v / rise**k for k, v in enumerate([1, 2.1875, 7.5132, 52.5])], rtol=2e-5)


def test_goals_are_bars_as_long_as_their_progress():
    arms = ct.ThreeArm.from_toml(ct.template("three-arm"))
    ax = ct.plot.goals(arms)
    lengths = [bar.get_width() for bar in ax.patches]
    assert lengths == [goal.progress or 0 for goal in arms.goals()]
    words = [text.get_text() for text in ax.texts]
    assert words[1].startswith("0.6161 deg, required -5 to 15")
    assert words[6].startswith("370.8 mm, required at least 260")
    assert ct.plot.goals(arms.goals(), ax=ax) is ax


def test_a_response_is_drawn_a_picture_a_goal():
    arms = ct.ThreeArm.from_toml(ct.template("three-arm"))
    values = [15, 21, 27]
    axes = ct.plot.response(arms, "r1", values)
    answers = arms.response("r1", values)
    shown = [goal for goal in arms.goals() if goal.value is not None]
    for goal, ax in zip(shown, np.ravel(axes), strict=False):
        drawn = ax.lines[0].get_ydata()
        wanted = answers[goal.name]
        np.testing.assert_allclose(drawn, np.degrees(wanted) if goal.unit == "rad" else wanted)
    pick = np.ravel(axes)[1]
    low, high = pick.patches[0].get_y(), pick.patches[0].get_y() + pick.patches[0].get_height()
    assert (low, high) == pytest.approx((-5, 15))


def test_without_matplotlib_an_error_says_how_to_have_it():
    """A finder that knows no matplotlib stands before the others, as in an environment without it."""
    code = """
import sys

class Without:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] == "matplotlib":
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)

sys.meta_path.insert(0, Without())
import centrode as ct

pair = ct.GearPair(ct.pitch.circle(module=2, tooth_count=20))
for draw in (ct.plot.pair, ct.plot.motion, ct.plot.contact, ct.plot.animate):
    try:
        draw(pair)
    except ImportError as missing:
        print(missing)
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert done.stdout == 4 * "plots need matplotlib: pip install matplotlib\n", done.stderr
