import math
import pickle
from pathlib import Path

import centrode as ct
import numpy as np
import pytest

DESIGNS = Path(__file__).parents[2] / "tests" / "designs"
PHI = np.linspace(0.0, 2.0 * np.pi, 181)


def closed(unknowns, lengths, start):
    """Places of the joints by Newton's method on the lengths of the bars alone, each input from the solution before it.

    `unknowns` are names of joints; `lengths` rows of two joints and their distance; `start` gives the fixed joints at
    an input and, at the first, a guess of the others.
    """
    found = []
    guess = None
    for phi in PHI:
        fixed, first = start(phi)
        x = np.array([first[name] for name in unknowns], float) if guess is None else guess
        for _ in range(60):
            place = {**fixed, **dict(zip(unknowns, x, strict=True))}
            ways = [(np.subtract(place[a], place[b]), a, b, length) for a, b, length in lengths]
            error = np.array([way @ way - length**2 for way, *_, length in ways])
            slope = np.zeros((len(lengths), 2 * len(unknowns)))
            for row, (way, a, b, _) in zip(slope, ways, strict=True):
                for joint, sign in ((a, 2.0), (b, -2.0)):
                    if joint in unknowns:
                        at = 2 * unknowns.index(joint)
                        row[at : at + 2] += sign * way
            step = np.linalg.solve(slope, error).reshape(-1, 2)
            x = x - step
            if np.abs(step).max() < 1e-13:
                break
        guess = x
        found.append(x)
    return dict(zip(unknowns, np.moveaxis(np.array(found), 1, 0), strict=True))


def leg(phi):
    """Fixed joints of Jansen's leg, and where the others stand roughly at the start."""
    fixed = {"A": (15 * math.cos(phi), 15 * math.sin(phi)), "P": (-38.0, -7.8)}
    return fixed, {"B": (-24, 31), "C": (-27, -45), "D": (-75, 8), "E": (-59, -28), "F": (-43, -92)}


LEG = [
    *(("A", "B", 50.0), ("P", "B", 41.5), ("A", "C", 61.9), ("P", "C", 39.3), ("P", "D", 40.1), ("B", "D", 55.8)),
    *(("D", "E", 39.4), ("C", "E", 36.7), ("C", "F", 49.0), ("E", "F", 65.7)),
]


def test_jansens_leg_stands_where_its_bars_let_it():
    machine = ct.Machine.load(DESIGNS / "jansen-leg.toml")
    theirs = closed(["B", "C", "D", "E", "F"], LEG, leg)
    names = {"B": "upper-rod.B", "C": "lower-rod.C", "D": "thigh.D", "E": "tie.E", "F": "foot"}
    for joint, name in names.items():
        np.testing.assert_allclose(machine.point(name, PHI), theirs[joint], atol=1e-10, err_msg=joint)
    # Published: the foot goes along the ground for about half of the turn.
    foot = machine.point("foot", PHI)
    assert (foot[:, 1] < foot[:, 1].min() + 1.5).mean() > 0.4


def test_peaucelliers_pen_goes_along_a_straight_line():
    machine = ct.Machine.load(DESIGNS / "peaucellier-cell.toml")
    pen = machine.point("pen", PHI)
    np.testing.assert_allclose(pen[:, 0], (60**2 - 25**2) / (2 * 20), atol=1e-9)
    # Inversion: the pen stands where the ray through the crank's end meets the line.
    end = machine.point("crank.P", PHI)
    np.testing.assert_allclose(pen[:, 1], pen[:, 0] * end[:, 1] / end[:, 0], atol=1e-9)
    assert np.ptp(pen[:, 1]) > 60
    np.testing.assert_allclose(machine.point("pen", PHI, 1)[:, 0], 0.0, atol=1e-9)


def test_derivatives_are_those_of_places_and_angles():
    machine = ct.Machine.from_toml(ct.template("machine"))
    step = 1e-4
    for order in range(3):
        for ask in (machine.point, machine.body):
            name = "foot" if ask == machine.point else "shin"
            slope = (ask(name, PHI + step, order) - ask(name, PHI - step, order)) / (2 * step)
            exact = ask(name, PHI, order + 1)
            np.testing.assert_allclose(slope, exact, atol=1e-6 * np.abs(exact).max())
    assert machine.point("foot", 1.0).shape == (2,)
    assert machine.body("shin", np.ones((3, 4))).shape == (3, 4, 3)


def test_names_are_those_of_the_file():
    machine = ct.Machine.from_toml(ct.template("machine"))
    assert machine.dyads == ("heel", "knee", "ankle")
    assert machine.period == 2 * math.pi
    assert machine.speed == pytest.approx(math.pi)
    assert "shin.foot" in machine.points
    np.testing.assert_array_equal(machine.point("shin.foot", PHI), machine.point("foot", PHI))
    for call in (machine.point, machine.body, machine.transmission_angle):
        with pytest.raises(ct.DesignError, match="name must be one of"):
            call("nose", 0.0)
    with pytest.raises(ct.DesignError, match="order must be a whole number from 0 to 3, not 4"):
        machine.point("foot", 0.0, 4)
    with pytest.raises(ct.DesignError, match="order must be a whole number from 0 to 3, not -1"):
        machine.body("shin", 0.0, -1)
    assert pickle.loads(pickle.dumps(machine)) == machine


def test_a_transmission_angle_is_that_of_the_bars():
    machine = ct.Machine.from_toml(ct.template("machine"))
    bars = machine.point("crank.A", PHI), machine.point("upper-rod.B", PHI), machine.point("frame.P", PHI)
    one, other = bars[0] - bars[1], bars[2] - bars[1]
    cosine = (one * other).sum(axis=1) / np.hypot(*one.T) / np.hypot(*other.T)
    angle = np.arccos(cosine)
    np.testing.assert_allclose(machine.transmission_angle("knee", PHI), angle, atol=1e-7)
    report = machine.check()
    table = {t.name: t for t in report.tables}["transmission-angles"]
    least, _, greatest, _ = dict(table.rows)["knee"]
    assert least <= angle.min() + 1e-12 < angle.max() - 1e-12 <= greatest
    others = [np.array([row[0], math.pi - row[2]]).min() for row in table.rows.values()]
    assert report.values["transmission_angle_min"] == pytest.approx(min(others), abs=1e-12)


def test_a_table_of_angles_that_turns_on_is_read_as_it_is_written():
    def wheel(law):
        return ct.Machine.from_toml(
            'family = "machine"\n[frame.points]\nW = [0, 0]\n[bodies.wheel]\non = "frame.W"\n' + f"law = {{ {law} }}\n"
        )

    turning = wheel("table_deg = [0, 45, 90, 135, 180, 225, 270, 315]")
    np.testing.assert_allclose(turning.body("wheel", PHI)[:, 2], PHI, atol=1e-12)
    (table,) = [t for t in turning.check().tables if t.name == "table-readings"]
    np.testing.assert_allclose(table.rows["wheel"], [2 * math.pi, math.pi / 4, math.pi / 4], atol=1e-12)
    with pytest.raises(
        ct.DesignError,
        match="turns = 1 the body turns on, in a last step of 160 deg; with turns = 0 the body swings back",
    ):
        wheel("table_deg = [0, 40, 80, 120, 160, 200]")
    for turns in [-1, 0, 1, 2]:
        given = wheel(f"table_deg = [0, 40, 80, 120, 160, 200], turns = {turns}")
        assert np.diff(given.body("wheel", np.array([0, 2 * math.pi]))[:, 2]) == pytest.approx(2 * math.pi * turns)


GOALS = """
[goals.stride]
figure = "foot.x"
over = "span"
minimum = 70
[goals.lift]
figure = "foot.y"
over = "span"
between = [15, 30]
[vary]
"bodies.crank.points.A[0]" = [12, 17]
"""


def test_goals_response_and_search_go_the_ways_of_all_families():
    machine = ct.Machine.from_toml(ct.template("machine") + GOALS)
    stride, lift = (goal for goal in sorted(machine.goals(), key=lambda goal: goal.name, reverse=True))
    assert (stride.name, stride.met, lift.met) == ("stride", False, True)
    fine = np.linspace(0.0, 2.0 * np.pi, 20001)
    assert stride.value == pytest.approx(np.ptp(machine.point("foot", fine)[:, 0]), abs=1e-5)
    assert [f.rule for f in machine.check().findings if f.severity == "error"] == ["goal"]
    answers = machine.response("bodies.crank.points.A[0]", [14.0, 15.0, 90.0])
    assert answers["stride"][0] < answers["stride"][1] == stride.value
    assert np.isnan(answers["stride"][2])
    # With plates the pins of such a stride collide, which no bound changes.
    bare = ct.template("machine").replace("[input]", 'hardware = "none"\n\n[input]', 1) + GOALS
    assert machine.optimise("cma-es", seed=1, evaluations=100).ended == "evaluations"
    found = ct.Machine.from_toml(bare).optimise("cma-es", seed=1, evaluations=400)
    assert found.ended == "target"
    assert found.mechanism.check().ok
    assert all(goal.met for goal in found.mechanism.goals())
    with pytest.raises(TypeError, match=r"designs\[1\] must be a design file as text or a mechanism, not int"):
        ct.sweep([machine, 1])  # type: ignore[list-item]
    one, none = ct.sweep([machine, "family = 1"])
    assert one["stride"] == stride.value
    assert none is None


def driven(phi, k):
    """Angle of the driven one of two ellipses that turn about foci, by that of the driver, in closed form."""
    half = np.arctan2((1 + k) * np.sin(phi / 2), (1 - k) * np.cos(phi / 2))
    return 2 * (half + 2 * np.pi * np.round((phi / 2 - half) / (2 * np.pi)))


def axes_apart(k, module, teeth):
    """Centre distance of two such ellipses: twice the half axis of one whose perimeter is pi m z."""
    t = np.arange(256) * 2 * np.pi / 256
    return 2 * np.pi * module * teeth / (2 * np.pi * np.sqrt(1 - (k * np.sin(t)) ** 2).mean())


def test_the_press_follows_its_closed_form():
    machine = ct.Machine.load(DESIGNS / "press.toml")
    phi = np.linspace(-7.0, 14.0, 400)
    a, turned = axes_apart(0.3, 2, 31), driven(phi, 0.3)
    t = turned + math.pi / 2
    ram = a + 30 * np.cos(t) + np.sqrt(120**2 - (30 * np.sin(t)) ** 2)
    np.testing.assert_allclose(machine.body("ram", phi)[:, 0], ram, atol=1e-10)
    np.testing.assert_allclose(machine.body("crank", phi)[:, 2], turned, atol=1e-12)
    np.testing.assert_allclose(machine.body("crank", phi, 1)[:, 2], 0.91 / (1.09 - 0.6 * np.cos(phi)), atol=1e-11)
    report = machine.check()
    dead = {t.name: t for t in report.tables}["dead-centres"].rows["ram"]
    limit = 2 * math.atan(0.7 / 1.3)
    np.testing.assert_allclose(sorted(dead), [limit, 2 * math.pi - limit], atol=1e-6)
    assert report.ok


def test_the_arms_of_a_train_follow_its_closed_form():
    machine = ct.Machine.load(DESIGNS / "two-arm.toml")
    phi, k = np.linspace(-4.0, 9.0, 300), 0.2
    a = axes_apart(k, 2.5, 23)
    for number, side in (("1", 0.0), ("2", math.pi)):
        first = phi + side
        idler = first + driven(first - math.radians(86), k)
        second = phi + side + math.radians(20) + math.pi
        # The inverse of the pair of ellipses: eccentricity with its sign changed.
        planet = second - driven(idler - second, -k)
        # A mesh begins its cycle within half a turn of zero.
        for name, angle in ((f"idler-{number}", idler), (f"planet-{number}", planet)):
            angle -= 2.0 * math.pi * np.round((angle - machine.body(name, phi)[:, 2])[0] / (2.0 * math.pi))
            begin = machine.body(name, 0.0)[2] - machine.body("carrier", 0.0)[2]
            assert abs(begin) <= math.pi + 1e-12
        np.testing.assert_allclose(machine.body(f"idler-{number}", phi)[:, 2], idler, atol=1e-11)
        np.testing.assert_allclose(machine.body(f"planet-{number}", phi)[:, 2], planet, atol=1e-11)
        axis = a * np.stack([np.cos(first) - np.cos(second), np.sin(first) - np.sin(second)], axis=1)
        arm = planet - math.radians(29)
        tip = axis + 110 * np.stack([np.cos(arm), np.sin(arm)], axis=1)
        np.testing.assert_allclose(machine.point(f"arm-{number}.tip", phi), tip, atol=1e-9)
        step, name = 1e-4, f"arm-{number}.tip"
        slope = (machine.point(name, phi + step, 2) - machine.point(name, phi - step, 2)) / (2 * step)
        np.testing.assert_allclose(machine.point(name, phi, 3), slope, rtol=1e-5, atol=1e-2)


CLEAR = """
family = "machine"
[frame.points]
O = [0, 0]
[bodies.crank]
on = "frame.O"
law = { ratio = 1 }
plate = false
[bodies.disc]
fixed_to = "crank"
circle = { center = [40, 0], radius = 5 }
[bodies.far]
fixed_to = "frame"
layer = 9
[obstacles.ground]
below = -60
[obstacles.post]
circle = { center = [0, 62], radius = 3 }
"""


@pytest.mark.campaign
def test_clearances_are_those_of_the_drawing_over_the_cycle_and_at_inputs():
    machine = ct.Machine.from_toml(CLEAR)
    least, phi = machine.clearance("disc", "ground", tolerance=1e-6)
    assert least == pytest.approx(15.0, abs=2e-6)
    assert phi == pytest.approx(1.5 * math.pi, abs=1e-3)
    found = machine.clearance("ground", "disc", PHI, tolerance=1e-6)
    np.testing.assert_allclose(found, 60 + 40 * np.sin(PHI) - 5, atol=2e-6)
    middle = 40 * np.stack([np.cos(PHI), np.sin(PHI)], axis=-1)
    post = machine.clearance("disc", "post", PHI[:, None], tolerance=1e-6)
    assert post.shape == (181, 1)
    np.testing.assert_allclose(post[:, 0], np.linalg.norm(middle - [0, 62], axis=-1) - 8, atol=2e-6)
    assert isinstance(machine.clearance("disc", "post", 0.5), float)
    assert machine.clearance("disc", "far")[0] == math.inf
    with pytest.raises(ct.DesignError, match="sky"):
        machine.clearance("disc", "sky")
    with pytest.raises(ct.DesignError, match="same body"):
        machine.clearance("ground", "post")


def test_obstacles_are_drawn_as_scenery_and_are_no_parts_and_bodies_without_mass_can_be_simulated(tmp_path):
    ezdxf = pytest.importorskip("ezdxf")
    machine = ct.Machine.from_toml(CLEAR)
    machine.export(tmp_path, formats=["dxf", "mjcf"], tolerance=0.1)
    drawing = ezdxf.readfile(tmp_path / "assembly.dxf")
    assert drawing.layers.get("SCENERY").dxf.linetype.upper() == "PHANTOM"
    scenery = [entity for entity in drawing.modelspace() if entity.dxf.layer == "SCENERY"]
    assert len(scenery) >= 2
    parts = machine.parts()
    assert {part.name for part in parts if part.file} == {"disc"}
    assert {"frame", "Drive of crank"} <= {part.name for part in parts if not part.file}
    assert not list(tmp_path.glob("ground*"))
    mujoco = pytest.importorskip("mujoco")
    model = mujoco.MjModel.from_xml_path(str(tmp_path / "machine.xml"))
    crank = model.body("crank")
    assert 0 < crank.mass[0] < 1e-5
