"""Plots of gear pairs and machines; install matplotlib with ``pip install matplotlib``.

Every function draws into the given axes or into new axes, and returns these axes.
"""

from __future__ import annotations

import json
from contextlib import contextmanager
from os import PathLike, fspath
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from ._centrode import DiscCam, Feeder, Gear, GearPair, Mechanism, MovingBox, SixBar, SpiralShaft
from ._contact import Contact
from ._goal import Goal
from ._optimised import Optimised

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from matplotlib.animation import FuncAnimation
    from matplotlib.axes import Axes
    from matplotlib.patches import PathPatch
    from numpy.typing import NDArray

__all__ = [
    "animate",
    "cam",
    "contact",
    "feeder",
    "goals",
    "history",
    "motion",
    "moving",
    "pair",
    "pivots",
    "response",
    "speed",
]

_DRIVER, _DRIVEN = "#3b6ea5", "#c98a2b"
_MET, _MISSED = "#3a7d44", "#b23a48"
_FINE = 1e-2
"""Tolerance of drawn outlines, in modules: below a pixel on any screen."""


def pair(pair: GearPair, phi: float = 0.0, ax: Axes | None = None, *, pitch_curves: bool = True) -> Axes:
    """Draw both gears in mesh at a driver angle.

    Args:
        pair: Gear pair to draw.
        phi: Driver angle, rad.
        ax: Axes to draw into; default: new axes.
        pitch_curves: Whether to draw also the pitch curves.
    """
    scene = _Scene(pair, ax or _axes((8.0, 6.0)), pitch_curves=pitch_curves)
    scene.turn(phi)
    return scene.ax


def animate(
    pair: GearPair,
    path: str | PathLike[str] | None = None,
    *,
    frames: int = 120,
    fps: int = 30,
    ax: Axes | None = None,
) -> FuncAnimation:
    """Animate the mesh over one driver turn.

    Args:
        pair: Gear pair to show.
        path: File to write, .gif or .html; default: no file.
        frames: Number of pictures of the turn.
        fps: Pictures per second.
        ax: Axes to draw into; default: new axes.

    Returns:
        The animation; keep a reference to it while it is shown.
    """
    with _matplotlib():
        from matplotlib.animation import FuncAnimation

    suffix = "" if path is None else fspath(path).rpartition(".")[2].lower()
    if path is not None and suffix not in ("gif", "html"):
        raise ValueError(f"path must end in .gif or .html, not {fspath(path)!r}")
    if frames < 1 or fps < 1:
        raise ValueError(f"frames and fps must be at least 1, not {frames} and {fps}")
    scene = _Scene(pair, ax or _axes((8.0, 6.0)), pitch_curves=True)
    angles = np.linspace(0.0, 2.0 * np.pi, frames, endpoint=False)
    animation = FuncAnimation(
        cast(Any, scene.ax.figure), lambda i: scene.turn(float(angles[i])), frames=frames, interval=1000 / fps
    )
    if path is not None and suffix == "gif":
        animation.save(fspath(path), writer="pillow", fps=fps)
    elif path is not None:
        with open(path, "w", encoding="utf-8") as file:
            file.write(animation.to_jshtml(fps=fps))
    return animation


def motion(pair: GearPair, ax: Axes | None = None) -> Axes:
    """Draw the ratio over one driver turn, and the driven angle minus that of the mean ratio."""
    ax = ax or _axes((8.0, 4.5))
    phi = np.linspace(0.0, 2.0 * np.pi, 721)
    turns, driven_turns = pair.mean_ratio
    mean = driven_turns / turns
    degrees = np.degrees(phi)
    (ratio,) = ax.plot(degrees, pair.ratio(phi), color=_DRIVER, label="ratio")
    ax.axhline(mean, color=_DRIVER, linewidth=0.8, linestyle=":")
    ax.set(xlim=(0, 360), xlabel="driver angle, deg", ylabel="driven turn per driver turn")
    ax.set_xticks(range(0, 361, 60))
    twin = ax.twinx()
    lead = np.degrees(pair.driven_angle(phi) - mean * phi)
    (swing,) = twin.plot(degrees, lead, color=_DRIVEN, linestyle="--", label="driven angle minus mean")
    twin.set_ylabel("deg")
    ax.legend(handles=[ratio, swing], loc="best")
    ax.set_title(pair.title or pair.name)
    return ax


def moving(
    *machines: SpiralShaft | MovingBox, turns: float = 1.0, start: float = -np.pi, ax: Axes | None = None
) -> Axes:
    """Draw the position of the box over the input angle, also for a plain shaft: Figures 3 and 11 of Zhou et al. 2018.

    Args:
        machines: Shafts or moving boxes, one curve each.
        turns: Number of turns of the input to draw.
        start: Input angle at which the curves begin, rad.
        ax: Axes to draw into; default: new axes.
    """
    ax, angles = _over_input(machines, turns, start, ax)
    lead = machines[0].moved(start, start + 2.0 * np.pi)
    plain = lead * (angles - start) / (2.0 * np.pi)
    ax.plot(np.degrees(angles), plain, color="grey", linewidth=0.8, linestyle=":", label="plain shaft")
    for machine in machines:
        place = [machine.moved(start, float(angle)) for angle in angles]
        ax.plot(np.degrees(angles), place, label=machine.title or machine.name)
    ax.set_ylabel("box, mm")
    ax.legend(loc="best")
    return ax


def speed(
    *machines: SpiralShaft | MovingBox,
    turns: float = 1.0,
    start: float = -np.pi,
    speed_rpm: float = 200.0,
    ax: Axes | None = None,
) -> Axes:
    """Draw the speed of the box over the input angle, also for a plain shaft: Figure 9 of Zhou et al. 2018.

    Args:
        machines: Shafts or moving boxes, one curve each.
        turns: Number of turns of the input to draw.
        start: Input angle at which the curves begin, rad.
        speed_rpm: Speed of the input, r/min.
        ax: Axes to draw into; default: new axes.
    """
    ax, angles = _over_input(machines, turns, start, ax)
    omega = speed_rpm * np.pi / 30.0
    lead = machines[0].moved(start, start + 2.0 * np.pi)
    ax.axhline(lead * speed_rpm / 60.0, color="grey", linewidth=0.8, linestyle=":", label="plain shaft")
    step = 1e-4
    for machine in machines:
        rate = [machine.moved(float(angle) - step, float(angle) + step) / (2.0 * step) for angle in angles]
        ax.plot(np.degrees(angles), omega * np.asarray(rate), label=machine.title or machine.name)
    ax.set_ylabel(f"box, mm/s at {speed_rpm:g} r/min")
    ax.set_ylim(bottom=0.0)
    ax.legend(loc="best")
    return ax


def _over_input(
    machines: tuple[SpiralShaft | MovingBox, ...], turns: float, start: float, ax: Axes | None
) -> tuple[Axes, NDArray[Any]]:
    """Axes over the input's angle, the pickings shaded, and the angles to draw at."""
    if not machines:
        raise ValueError("there is no machine to draw")
    ax = ax or _axes((8.0, 4.5))
    angles = np.linspace(start, start + 2.0 * np.pi * turns, round(360 * turns) + 1)
    ax.set(xlim=np.degrees(angles[[0, -1]]), xlabel="input angle, deg")
    ax.xaxis.set_major_locator(_locator(60.0 * max(1.0, np.ceil(turns))))
    shaft = machines[0] if isinstance(machines[0], SpiralShaft) else machines[0].shaft
    for turn in range(int(np.floor(start / (2.0 * np.pi))) - 1, int(np.ceil(angles[-1] / (2.0 * np.pi))) + 2):
        middle, half = np.degrees(shaft.pick) + 360.0 * turn, 0.5 * np.degrees(shaft.window)
        ax.axvspan(middle - half, middle + half, color=_DRIVEN, alpha=0.15, linewidth=0)
    return ax, angles


def contact(of: GearPair | Contact, axes: NDArray[Any] | None = None) -> NDArray[Any]:
    """Draw a contact analysis: transmission error, teeth in contact, backlash, clearance.

    Args:
        of: A gear pair, or the result of its contact analysis.
        axes: Four axes to draw into; default: a new column of four.
    """
    analysis = of if isinstance(of, Contact) else of.contact()
    if axes is None:
        with _matplotlib():
            from matplotlib import pyplot

        _, axes = pyplot.subplots(4, 1, sharex=True, figsize=(8.0, 8.0), layout="constrained")
    error, count, backlash, clearance = np.ravel(axes)
    degrees = np.degrees(analysis.input)
    error.plot(degrees, analysis.transmission_error, color=_DRIVER, label="driving forward")
    error.plot(degrees, analysis.reverse_transmission_error, color=_DRIVEN, label="driving back")
    error.set_ylabel("transmission\nerror, rad")
    error.legend(loc="best")
    count.step(degrees, analysis.contacts, where="mid", color=_DRIVER)
    count.set_ylabel("pairs of teeth\nin contact")
    count.set_ylim(bottom=0)
    backlash.plot(degrees, np.degrees(analysis.backlash), color=_DRIVER)
    backlash.set_ylabel("backlash of the\ndriven gear, deg")
    for values, color, label in (
        (analysis.clearance, _DRIVER, "tip to root"),
        (analysis.fillet_clearance, _DRIVEN, "to a fillet"),
    ):
        near = np.where(np.isfinite(values), values, np.nan)
        clearance.plot(degrees, near, ".-", color=color, linewidth=0.8, markersize=3, label=label)
    clearance.set_ylabel("clearance, mm")
    clearance.set_ylim(bottom=0)
    clearance.set_xlabel("driver angle, deg")
    clearance.legend(loc="best")
    return axes


def cam(of: DiscCam, axes: NDArray[Any] | None = None) -> NDArray[Any]:
    """Draw the position, velocity, acceleration and jerk of a cam's follower over one turn of the cam.

    Args:
        of: Cam to draw.
        axes: Four axes to draw into; default: a new column of four.
    """
    if axes is None:
        with _matplotlib():
            from matplotlib import pyplot

        _, axes = pyplot.subplots(4, 1, sharex=True, figsize=(8.0, 8.0), layout="constrained")
    theta = np.linspace(0.0, 2.0 * np.pi, 1441)
    unit = "rad" if of.swings else "mm"
    quantities = zip(("position", "velocity", "acceleration", "jerk"), ("", "/rad", "/rad²", "/rad³"), strict=True)
    for ax, values, (name, per) in zip(np.ravel(axes), of.motion(theta).T, quantities, strict=True):
        ax.plot(np.degrees(theta), values, color=_DRIVER)
        ax.set_ylabel(f"{name}\n{unit}{per}")
        ax.axhline(0.0, color="grey", linewidth=0.8, linestyle=":")
    ax.set(xlim=(0, 360), xlabel="cam angle, deg")
    ax.set_xticks(range(0, 361, 60))
    return axes


def goals(of: Mechanism | Sequence[Goal], ax: Axes | None = None) -> Axes:
    """Draw the progress of each goal as a bar, with its figure and its required range.

    Args:
        of: A mechanism, or its goals.
        ax: Axes to draw into; default: new axes.
    """
    found = of.goals() if isinstance(of, Mechanism) else tuple(of)
    ax = ax or _axes((9.0, 0.45 * len(found) + 1.0))
    rows = np.arange(len(found))
    colors = [_MET if goal.met else _MISSED for goal in found]
    ax.barh(rows, [0.0 if goal.progress is None else goal.progress for goal in found], color=colors, height=0.6)
    for row, goal in enumerate(found):
        figure = "not evaluated" if goal.value is None else f"{_shown(goal, goal.value):.4g} {_unit(goal)}".rstrip()
        ax.text(1.02, row, f"{figure}, required {_range(goal)}", va="center")
    ax.set_yticks(rows, [f"{goal.number}  {goal.title}" for goal in found])
    ax.invert_yaxis()
    ax.set(xlim=(0.0, 1.0), xlabel="progress")
    ax.spines[["top", "right"]].set_visible(False)
    return ax


def response(
    of: Mechanism, parameter: str, values: Sequence[float] | NDArray[Any], axes: NDArray[Any] | None = None
) -> NDArray[Any]:
    """Draw the response of each goal to one number of the design, one small plot per goal: Figure 5 of Yin et al. 2021.

    The required range of a figure is shaded.

    Args:
        of: The mechanism; all its other numbers do not change.
        parameter: Key in the design file, such as "arm.tip_distance", or name of a parameter, such as "r1".
        values: Values of the parameter in the unit of the design file: mm, degrees.
        axes: Axes to draw into, one per goal that has a figure; default: a new grid of four columns.
    """
    found = [goal for goal in of.goals() if goal.value is not None]
    answers = of.response(parameter, values)
    if axes is None:
        with _matplotlib():
            from matplotlib import pyplot

        rows = -(-len(found) // 4)
        _, axes = pyplot.subplots(rows, 4, sharex=True, figsize=(13.0, 2.8 * rows), layout="constrained", squeeze=False)
        for ax in np.ravel(axes)[len(found) :]:
            ax.set_visible(False)
    for goal, ax in zip(found, np.ravel(axes), strict=False):
        figures = _shown(goal, np.asarray(answers[goal.name]))
        ax.plot(values, figures, ".-", color=_DRIVER, markersize=4)
        low, high = ax.get_ylim()
        least, most = (None if end is None else _shown(goal, end) for end in goal.required)
        shaded = (low if least is None else least, high if most is None else most)
        ax.axhspan(min(shaded), max(shaded), color=_MET, alpha=0.15, linewidth=0)
        ax.set_ylim(low, high)
        ax.set_title(f"{goal.number}  {goal.title}", fontsize="small")
        ax.set_ylabel(_unit(goal))
        ax.set_xlabel(parameter)
        # Axes that share theirs with a hidden one would have no numbers.
        ax.xaxis.set_tick_params(labelbottom=True)
    return axes


def _shown(goal: Goal, figure: Any) -> Any:
    """A goal's figure as people read it: angles in degrees."""
    return np.degrees(figure) if goal.unit == "rad" else figure


def _unit(goal: Goal) -> str:
    return "deg" if goal.unit == "rad" else goal.unit


def _range(goal: Goal) -> str:
    least, most = (None if end is None else f"{_shown(goal, end):g}" for end in goal.required)
    if least is None or most is None:
        return f"at most {most}" if least is None else f"at least {least}"
    return f"{least} to {most}"


def feeder(of: Feeder, axes: NDArray[Any] | None = None) -> NDArray[Any]:
    """Draw the motion of a feeder's tip over one cycle: its path, and its position and speed over time.

    The curves of Figure 7 of Ye et al. 2022, DOI 10.6041/j.issn.1000-1298.2022.05.010.

    Args:
        of: Feeder to draw.
        axes: Three axes to draw into; default: a new row of three.
    """
    if axes is None:
        with _matplotlib():
            from matplotlib import pyplot

        _, axes = pyplot.subplots(1, 3, figsize=(14.0, 4.5), layout="constrained")
    path, place, speed = np.ravel(axes)
    phi = np.linspace(0.0, 2.0 * np.pi, 1441)
    tip, time = of.tip(phi), phi / of.speed
    path.plot(tip[:, 0], tip[:, 1], color=_DRIVER)
    path.set(aspect="equal", xlabel="x, mm", ylabel="y, mm", title="path of the tip")
    for column, name, color in ((0, "x", _DRIVER), (1, "y", _DRIVEN)):
        place.plot(time, tip[:, column], color=color, label=name)
    place.set(xlabel="time, s", ylabel="mm", title="position of the tip")
    place.legend(loc="best")
    speed.plot(time, of.tip_speed(phi), color=_DRIVER)
    speed.set(xlabel="time, s", ylabel="mm/s", title="speed of the tip")
    feed, back = of.strokes
    for end in (feed, back):
        for ax in (place, speed):
            ax.axvline(end / of.speed, color="black", linewidth=0.8, linestyle=":")
    return axes


def pivots(of: SixBar, swing: float = np.pi, ax: Axes | None = None) -> Axes:
    """Draw all positions of the effector's pivot that give a swing with the lengths of a six-bar, and its actual pivot.

    Args:
        of: Six-bar with the lengths.
        swing: Required swing, rad.
        ax: Axes to draw into; default: new axes.
    """
    ax = ax or _axes((6.0, 6.0))
    phi = np.linspace(0.0, 2.0 * np.pi, 721)
    slider = of.position(phi)[:, 1]
    ax.plot(slider[:, 0], slider[:, 1], color=_DRIVER, label="path of the slider")
    curve = of.pivots(swing, 200)
    ax.plot(curve[:, 0], curve[:, 1], ".", color=_DRIVEN, markersize=3, label=f"{np.degrees(swing):g} deg")
    ax.plot(*of.pivot, "+", color="black", markersize=9, label="pivot")
    ax.set(aspect="equal", xlabel="mm", ylabel="mm")
    ax.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=3, frameon=False)
    return ax


def history(*searches: Optimised[Mechanism] | str | PathLike[str], ax: Axes | None = None) -> Axes:
    """Draw the progress of searches: total miss of the goals of the best point, and, once it is zero, its objective.

    Args:
        searches: Results of `optimise`, or files `....search.json` stored by `centrode optimise`; one color each.
        ax: Axes to draw into; default: new axes.
    """
    ax = ax or _axes((8.0, 4.5))
    for number, search in enumerate(searches):
        name = f"search {number + 1}" if isinstance(search, Optimised) else fspath(search).rpartition("/")[2]
        count, violation, objective = _history(search).T
        missed = violation > 0.0
        for color, line, values, kept in (
            (f"C{number}", ":", violation, missed),
            (f"C{number}", "-", objective, ~missed & (objective > 0.0)),
        ):
            label = f"{name}: " + ("goals missed by" if line == ":" else "objective")
            if kept.any():
                ax.step(count[kept], values[kept], line, where="post", color=color, label=label)
    ax.set(yscale="log", xlabel="evaluations", ylabel="best")
    ax.legend(loc="best")
    return ax


def _history(search: Optimised[Mechanism] | str | PathLike[str]) -> NDArray[Any]:
    """Rows of evaluations, violation and objective."""
    if isinstance(search, Optimised):
        return np.array(search.history, dtype=float).reshape(-1, 3)
    with open(search, encoding="utf-8") as file:
        (state,) = json.load(file)["state"].values()
    rows = [(at["evaluations"], at["violation"], at["objective"]) for at in state["history"]]
    return np.array(rows, dtype=float).reshape(-1, 3)


class _Part:
    """One gear on the picture: its outlines in its own frame, and the patches that show them."""

    def __init__(self, gear: Gear, ax: Axes, color: str, tolerance: float, *, pitch_curve: bool) -> None:
        from matplotlib.patches import PathPatch
        from matplotlib.path import Path

        bore = gear.bore(tolerance)
        contours = [gear.outline(tolerance)]
        if bore is not None:
            contours.append(bore[::-1])
        closed = [np.vstack([contour, contour[:1]]) for contour in contours]
        codes = np.concatenate([[Path.MOVETO, *[Path.LINETO] * (len(points) - 2), Path.CLOSEPOLY] for points in closed])
        body = Path(np.concatenate(closed), codes)
        self.patches: list[PathPatch] = [PathPatch(body, facecolor=color, edgecolor="black", linewidth=0.6, alpha=0.85)]
        if pitch_curve:
            points = gear.pitch_curve(tolerance)
            curve = Path(np.vstack([points, points[:1]]), closed=True)
            self.patches.append(PathPatch(curve, fill=False, edgecolor="white", linewidth=0.8, linestyle="--"))
        for patch in self.patches:
            ax.add_patch(patch)

    def place(self, angle: float, x: float, ax: Axes) -> None:
        from matplotlib.transforms import Affine2D

        for patch in self.patches:
            patch.set_transform(Affine2D().rotate(angle).translate(x, 0.0) + ax.transData)


class _Scene:
    """Both gears in mesh, to be turned."""

    def __init__(self, pair: GearPair, ax: Axes, *, pitch_curves: bool) -> None:
        tolerance = _FINE * pair.module
        self.pair, self.ax = pair, ax
        self.driver = _Part(pair.driver, ax, _DRIVER, tolerance, pitch_curve=pitch_curves)
        self.driven = _Part(pair.driven, ax, _DRIVEN, tolerance, pitch_curve=pitch_curves)
        a = pair.center_distance
        ax.plot([0.0, a], [0.0, 0.0], "+", color="black", markersize=9)
        left, right = pair.driver.radii[1], pair.driven.radii[1]
        height = max(left, right) + pair.module
        ax.set(xlim=(-left - pair.module, a + right + pair.module), ylim=(-height, height))
        ax.set(aspect="equal", xlabel="mm", ylabel="mm", title=pair.title or pair.name)

    def turn(self, phi: float) -> list[PathPatch]:
        """Pose both gears at a driver angle."""
        self.driver.place(-phi, 0.0, self.ax)
        self.driven.place(self.pair.driven_angle(phi), self.pair.center_distance, self.ax)
        return [*self.driver.patches, *self.driven.patches]


def _locator(step: float) -> Any:
    """Ticks at multiples of a step."""
    from matplotlib.ticker import MultipleLocator

    return MultipleLocator(step)


def _axes(size: tuple[float, float]) -> Axes:
    with _matplotlib():
        from matplotlib import pyplot

    _, ax = pyplot.subplots(figsize=size, layout="constrained")
    return ax


@contextmanager
def _matplotlib() -> Iterator[None]:
    """Imports of matplotlib; if it is missing, the error states how to install it."""
    try:
        yield
    except ModuleNotFoundError as missing:
        raise ModuleNotFoundError("plots need matplotlib: pip install matplotlib", name=missing.name) from missing
