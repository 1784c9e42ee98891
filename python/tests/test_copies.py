"""Everything public can be pickled and copied: it comes back equal, with the same figures."""

import copy
import enum
import inspect
import math
import pickle
from dataclasses import fields, is_dataclass

import centrode as ct
import numpy as np
import pytest

PITCH = {"module": 2, "tooth_count": 20}
PRESS = """
family = "machine"
frame.points = { O = [0, 0] }
bodies.crank = { on = "frame.O", law = { ratio = 1 }, points = { A = [30, 0] } }
dyads.ram = { type = "RRP", from = "crank.A", lengths = [120], line = "frame.O", line_deg = 0,
    side = "forward", bodies = ["rod", "ram"], joint = "B" }
goals.steady = { figure = "ram.travel", over = "deviation", within_deg = [40, 120], uniform = [105, 140],
    maximum = 1e-4 }
"""


def public_classes():
    """Every class that the package and its public modules show, found by looking."""
    modules = [ct, *(module for _, module in inspect.getmembers(ct, inspect.ismodule) if module.__name__ in PUBLIC)]
    found = {}
    for module in modules:
        for name in getattr(module, "__all__", dir(module)):
            thing = getattr(module, name)
            if inspect.isclass(thing) and thing.__module__.split(".")[0] == "centrode":
                found[thing] = f"{module.__name__}.{name}"
    return found


PUBLIC = {f"centrode.{name}" for name in ("build123d", "cadquery", "cam", "mujoco", "pitch", "plot")}
CLASSES = public_classes()


@pytest.fixture(scope="module")
def objects():
    """One or more objects of every public class, by class."""
    pair = ct.GearPair(ct.pitch.ellipse(eccentricity=0.2, **PITCH), backlash=0.05, mean_ratio=(1, 1))
    half = math.pi / 3
    segments = [
        ct.cam.rise(span=half, lift=9, law=ct.cam.polynomial(start=[0, 0], end=[0.25, 0])),
        ct.cam.transition(span=half, lift=1 / 3, start_velocity=0.1, end_acceleration=-0.7),
        ct.cam.dwell(span=2 * half),
        ct.cam.return_(span=0.1 + half, lift=9 + 1 / 3, law="modified-sine"),
    ]
    out = [ct.cam.rise(span=2, lift=9), ct.cam.dwell(span=2), ct.cam.return_(span=2 * math.pi - 4, lift=9)]
    followers = [
        ct.cam.translating_roller(roller_radius=7, offset=1 / 3),
        ct.cam.translating_flat(),
        ct.cam.swinging_roller(roller_radius=5, center_distance=52, arm_length=45, lifts="clockwise"),
        ct.cam.swinging_flat(center_distance=60, face_offset=1.5),
    ]
    fork = ct.cam.Fork(roller_radius=5, center_distance=52, arm_length=45, lever_length=40, lever_start=-0.15)
    cam = ct.DiscCam(followers[0], out, base_radius=40, rotation="clockwise", start=0.3, body=ct.Body(bore=8), name="a")
    arms = ct.ThreeArm.from_toml(ct.template("three-arm"))
    feeder = ct.Feeder.from_toml(ct.template("feeder"))
    leg = ct.Machine.from_toml(ct.template("machine"))
    shaft = ct.SpiralShaft(lead=20, holes=14, radius=15, amplitude=1.28, harmonic=1)
    rhombus = ct.SixBar(crank=77, coupler=147, rocker=127, frame=105, pivot=(100, 67), effector_length=200)
    report = arms.check()
    reverse = ct.reverse([(0, 0), (60, 70), (150, 150), (230, 215), (262, 262), (235, 300), (170, 330), (100, 330),
                          (40, 300), (-5, 250), (-30, 190), (-38, 130), (-30, 60)], bend_deg=40)  # fmt: skip
    posed = ct.reverse_poses([(249.08, 50.03, 31.93), (167.32, 64.88, 20.89), (104.40, 34.05, 42.55)], bend_deg=40)
    press = ct.Machine.from_toml(PRESS)
    over = pair.driver.over_pins()
    housing = arms.solids(parts=["housing"])["housing"]
    made = [
        leg,
        pair,
        pair.pitch,
        pair.driver,
        pair.driven,
        pair.driver.drawing(0.01),
        pair.driver.sheet(tolerance=0.01),
        *pair.driver.teeth[:1],
        pair.driver.teeth[0].leading,
        over,
        housing,
        housing.opening,
        *housing.contours[0][:2],
        *arms.links()[1:3],
        arms.links()[1].joint,
        feeder.links()[1].mounted[0],
        ct.mujoco.load(pair, tolerance=0.1)[1],
        pair.contact(1),
        ct.Rack(pressure_angle=0.4),
        ct.Shaper(tooth_count=25),
        ct.Body(bore=12, keyway=ct.Keyway(width=4, depth=1.8)),
        ct.Keyway(width=4, depth=1.8),
        ct.DrawingSpec(drawn_by="A. B."),
        *segments,
        *followers,
        ct.cam.law("modified-trapezoid"),
        ct.cam.polynomial(start=[0.1, 0], end=[0, 1 / 3]),
        fork,
        cam,
        fork.cam(out, base_radius=22),
        arms,
        arms.cam,
        arms.fork,
        feeder,
        feeder.six_bar,
        rhombus,
        rhombus.dead_centers,
        shaft,
        shaft.force(0.1),
        shaft.forces(0.1),
        feeder.forces([0.1, 0.2]),
        *feeder.parts(),
        ct.MovingBox(shaft),
        ct.MovingBox(moved_distance=2.05),
        report,
        report.goals[0],
        ct.Report(ok=True, findings=(), values={}, units={}),
        ct.Finding("a", "note", "b", 1.0, None, "mm", None, ct.Place("driver", (1,), 0.5)),
        ct.Place("driver", (1,), 0.5, (ct.FlankPlace(1, "leading", 21.0),)),
        ct.FlankPlace(1, "leading", None),
        ct.Table("a", "b", "mm", ("c",), {"d": (1.0,)}),
        arms.arm_clearance(),
        ct.PairRemedy("full", (), 23, pair),
        reverse,
        posed,
        reverse.axes,
        reverse.splits[0],
        ct.gear_drive(press, center_distance=130, direction_deg=100),
        feeder.optimise("de", evaluations=100),
        *(made("why") if not issubclass(made, ct.DesignError) else made("why", "key", 3, 4)
          for made in CLASSES if issubclass(made, Exception)),
    ]  # fmt: skip
    by_class = {}
    for thing in made:
        for one in CLASSES.keys() & type(thing).__mro__:
            by_class.setdefault(one, []).append(thing)
    return by_class


def figures(thing):
    """Every attribute of an object that is a value, arrays as lists."""
    if isinstance(thing, np.ndarray):
        return figures(thing.tolist())
    if isinstance(thing, float):
        return "nan" if math.isnan(thing) else thing
    if thing is None or isinstance(thing, (str, bytes, int, bool, enum.Enum)):
        return thing
    if isinstance(thing, (tuple, list)):
        return [figures(one) for one in thing]
    if isinstance(thing, dict):
        return {key: figures(value) for key, value in thing.items()}
    if is_dataclass(thing):
        return {field.name: figures(getattr(thing, field.name)) for field in fields(thing)}
    told = {"repr": repr(thing), "type": type(thing)}
    for name in dir(type(thing)):
        if name.startswith("_") or callable(getattr(type(thing), name)):
            continue
        try:
            told[name] = figures(getattr(thing, name))
        except ct.Error as error:
            told[name] = repr(error)
    return told


@pytest.fixture(scope="module")
def known():
    """Figures of an object, found once for each: some take seconds."""
    found = {}

    def once(thing):
        if id(thing) not in found:
            # The thing is held: no other has its number.
            found[id(thing)] = thing, figures(thing)
        return found[id(thing)][1]

    return once


@pytest.mark.parametrize("public", CLASSES, ids=CLASSES.values())
@pytest.mark.parametrize(
    "again", [lambda x: pickle.loads(pickle.dumps(x)), copy.copy, copy.deepcopy], ids=["pickle", "copy", "deepcopy"]
)
def test_every_public_class_comes_back_equal(objects, known, public, again):
    things = objects.get(public)
    assert things, f"no object of {CLASSES[public]} is tried: add one"
    for thing in things:
        other = again(thing)
        assert type(other) is type(thing)
        assert repr(other) == repr(thing)
        assert figures(other) == known(thing)
        # Classes that can be compared are.
        if public.__eq__ is not object.__eq__ and not is_dataclass(public):
            assert other == thing


def test_copies_of_parts_compute_what_their_originals_do(objects):
    angles = np.linspace(0, 6, 7)
    for cam in objects[ct.DiscCam]:
        np.testing.assert_array_equal(pickle.loads(pickle.dumps(cam)).points(angles), cam.points(angles))
    for gear in objects[ct.Gear]:
        np.testing.assert_array_equal(pickle.loads(pickle.dumps(gear)).outline(0.01), gear.outline(0.01))
    for six_bar in objects[ct.SixBar]:
        np.testing.assert_array_equal(copy.deepcopy(six_bar).position(angles), six_bar.position(angles))
