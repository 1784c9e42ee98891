"""The three-arm mechanism in Python: the published set, arrays in and out, errors."""

import copy
import math
import pickle

import centrode as ct
import numpy as np
import pytest
from conftest import ROOT

RADIUS = [21, 28, 50, 49, 58, 47, 18, 12, 28, 60, 48, 24]
ANGLE = np.radians([20, 45, 76, 105, 132, 165, 195, 225, 255, 285, 316, 345])


def published(**changes):
    keywords = {
        "carrier_start": math.radians(86),
        "bend": math.radians(-53),
        "arm_mounting_angle": math.radians(-29),
        "tip_distance": 145,
        "pusher_offset": 65,
        "picking": math.radians(20),
        "planting": math.radians(191),
        "tooth_count": 37,
    }
    pitch = ct.pitch.bspline(degree=2, radius=RADIUS, angle=ANGLE)
    return ct.ThreeArm(pitch, **(keywords | changes))


@pytest.fixture(scope="module")
def arms():
    return published()


def test_the_published_set(arms):
    assert arms.center_distance == pytest.approx(82.046340, abs=5e-7)
    assert math.degrees(arms.planet_reference) == pytest.approx(43.514276, abs=5e-7)
    angles = np.degrees(arms.clamp_angle(np.radians([20, 191])))
    assert angles == pytest.approx([0.616147, -51.707230], abs=5e-7)
    assert arms.trajectory_height == pytest.approx(370.8206, abs=5e-5)
    assert math.degrees(arms.picking(2)) == pytest.approx(260)
    assert math.degrees(arms.planting(2)) == pytest.approx(71)


def test_shapes(arms):
    assert arms.tip(0.5).shape == (2,)
    assert arms.tip(np.zeros(7)).shape == (7, 2)
    assert arms.tip(np.zeros((3, 4)), arm=2).shape == (3, 4, 2)
    assert isinstance(arms.clamp_angle(0.5), float)
    assert arms.clamp_angle([[0.1, 0.2]]).shape == (1, 2)
    pose = arms.pose(np.linspace(0, 1, 5))
    assert len(pose) == 2 + 3 * 3
    assert all(rows.shape == (5, 3) for rows in pose.values())


def test_velocity_is_that_of_the_tip(arms):
    theta = np.linspace(0.01, 6.2, 50)
    step = 1e-6
    for over_ground in (False, True):

        def tip(theta, over=over_ground):
            return arms.tip(theta, 1, over_ground=over)

        slope = (tip(theta + step) - tip(theta - step)) / (2 * step)
        assert slope == pytest.approx(arms.tip_velocity(theta, 1, over_ground=over_ground), abs=1e-4)
    slope = (arms.tip_velocity(theta + step) - arms.tip_velocity(theta - step)) / (2 * step)
    assert slope == pytest.approx(arms.tip_acceleration(theta), abs=2e-3)


def test_one_turn_travels_by_a_spacing_an_arm(arms):
    travelled = arms.tip(2 * math.pi, over_ground=True) - arms.tip(0.0, over_ground=True)
    assert travelled == pytest.approx([3 * 140, 0], abs=1e-9)


def test_arms_follow_each_other(arms):
    theta = np.linspace(0, 7, 40)
    for arm in (1, 2):
        assert arms.tip(theta, arm) == pytest.approx(arms.tip(theta - arm * 2 * math.pi / 3), abs=1e-12 * 400)
    with pytest.raises(IndexError, match="arm 3 of 3"):
        arms.tip(theta, 3)


def test_the_arm_carries_its_tip(arms):
    theta = np.linspace(0, 6, 20)
    x, y, turn = arms.pose(theta)["arm-1"].T
    foot = math.sqrt(145**2 - 65**2)
    tip = np.stack([x + foot * np.cos(turn) + 65 * np.sin(turn), y + foot * np.sin(turn) - 65 * np.cos(turn)], axis=1)
    assert tip == pytest.approx(arms.tip(theta, 1), abs=1e-10)


def test_goals(arms):
    goals = {goal.name: goal for goal in arms.goals()}
    assert [goal.number for goal in arms.goals()] == [1, 2, 3, 4, 5, 6, 7, 8, 9]
    assert [goal.paper for goal in arms.goals()] == 8 * [None] + [8]
    assert goals["pick-angle"].met
    assert goals["pick-angle"].progress == 1
    assert goals["arm-clearance"].met is True
    assert goals["sound-teeth"].met is False
    assert 0 < goals["sound-teeth"].progress < 1
    report = arms.check()
    assert report.goals == arms.goals()
    assert report.tables[0].rows["planting"][2] == pytest.approx(math.radians(71))
    assert "goal 7: height of the trajectory 370.821 mm, met" in str(report)


def test_the_clearance_of_arms_is_that_of_their_contours(arms):
    shapely = pytest.importorskip("shapely")
    found = arms.arm_clearance(1e-3)
    goals = {goal.name: goal for goal in arms.goals()}
    assert found.minimum == pytest.approx(goals["arm-clearance"].value, abs=2e-2)
    assert found.minimum - 6e-3 < found.lower_bound <= found.minimum
    contour = arms.arm_contour(1e-3)
    pose = arms.pose(np.append(np.linspace(0, 2 * math.pi, 721), found.input))

    def placed(arm):
        x, y, turn = pose[f"arm-{arm}"].T
        return [
            shapely.Polygon(contour @ [[math.cos(t), math.sin(t)], [-math.sin(t), math.cos(t)]] + [u, v])
            for u, v, t in zip(x, y, turn, strict=True)
        ]

    distance = shapely.distance(placed(found.arms[0]), placed(found.arms[1]))
    assert (distance > found.lower_bound).all()
    assert distance[-1] == pytest.approx(found.minimum, abs=2e-3)
    assert distance.min() == pytest.approx(found.minimum, abs=0.1)
    assert published(arms=1).arm_clearance() is None


def test_cam_and_fork_draw_the_rod_back(arms):
    """The cam's angle is the arm's turn against the carrier; what the fork makes of its swing is the rod's way."""
    theta = np.linspace(0, 2 * math.pi, 90)
    pose = arms.pose(theta)
    turned = np.abs(pose["arm-0"][:, 2] - pose["carrier"][:, 2] - (pose["arm-0"][0, 2] - pose["carrier"][0, 2]))
    swing = arms.cam.motion(turned)[:, 0]
    np.testing.assert_allclose(arms.fork.retraction(swing), arms.push_rod(theta), atol=1e-9)


def test_without_teeth_there_is_no_module():
    goals = {goal.name: goal for goal in published(tooth_count=None).goals()}
    assert goals["module"].value is None
    assert goals["sound-teeth"].value is None
    assert goals["trajectory-height"].met


def test_files(arms, tmp_path):
    path = ROOT / "tests" / "designs" / "three-arm-2021.toml"
    loaded = ct.ThreeArm.load(path)
    assert loaded == ct.load(path)
    assert loaded.tip(1.0) == pytest.approx(arms.tip(1.0), abs=1e-10)
    again = ct.ThreeArm.from_toml(arms.to_toml())
    assert again.tip(1.0) == pytest.approx(arms.tip(1.0), abs=1e-10)
    assert pickle.loads(pickle.dumps(loaded)) == loaded
    assert copy.copy(arms) is arms
    assert copy.deepcopy(arms) is arms
    with pytest.raises(ct.DesignError, match='must be "three-arm"'):
        ct.ThreeArm.load(ROOT / "tests" / "designs" / "circular-pair.toml")
    with pytest.raises(ct.DesignError, match='must be "gear-pair"'):
        ct.GearPair.from_toml(arms.to_toml())
    bad = tmp_path / "bad.toml"
    bad.write_text(path.read_text().replace("arms = 3", "arms = 0"))
    with pytest.raises(ct.DesignError, match="arms: must be 1 to 6, not 0") as error:
        ct.ThreeArm.load(bad)
    assert (error.value.key, error.value.line) == ("arms", 8)


def test_the_schema_of_a_family():
    assert "carrier_start_deg" in ct.schema("three-arm")["properties"]
    assert "mean_ratio" in ct.schema("gear-pair")["properties"]
    with pytest.raises(ct.DesignError):
        ct.schema("six-arm")


@pytest.mark.parametrize(
    ("changes", "error", "key"),
    [
        ({"arms": 0}, ct.DesignError, "arms"),
        ({"tip_distance": 0}, ct.DesignError, "arm.tip_distance"),
        ({"pusher_offset": 150}, ct.DesignError, "arm.pusher_offset"),
        ({"bend": math.pi}, ct.DesignError, "bend_deg"),
        ({"direction": "left"}, ct.DesignError, "direction"),
        ({"center_distance": 80}, ct.GearPairError, "center_distance"),
        ({"picking": None, "tray_distance": 400}, ct.MechanismError, "tray.distance"),
    ],
)
def test_what_cannot_be_is_refused(changes, error, key):
    with pytest.raises(error) as found:
        published(**changes)
    assert found.value.key == key


def test_the_gears_are_cut_on_demand():
    pair = published(addendum="fitted", backlash=0.05).gear_pair()
    assert pair.driver.tooth_count == pair.driven.tooth_count == 37


def test_other_threads_run_meanwhile(arms, turns_meanwhile):
    turns = np.linspace(0, 6, 200_000)
    assert turns_meanwhile(lambda: arms.tip(turns)) > 2


@pytest.mark.parametrize("arm", [-1, 3])
def test_an_arm_that_is_not_there_is_refused(arm):
    arms = ct.ThreeArm.from_toml(ct.template("three-arm"))
    with pytest.raises(IndexError, match=f"arm {arm} of 3, counted from 0"):
        arms.tip(0.1, arm=arm)


def test_bearings_are_chosen_where_the_plates_hold_them_and_missed_where_they_do_not():
    text = (ROOT / "tests" / "designs" / "three-arm-all-goals.toml").read_text()

    def with_wall(wall):
        return ct.ThreeArm.from_toml(text.replace("bearings = true", f"bearings = true\nwall = {wall}"))

    def bearings(arms):
        return {part.name: part.quantity for part in arms.parts() if "bearing" in part.name}

    # Two in each of the seven shafts; ISO 15: 61800 is 5 mm wide, 6000 8 mm, 6200 9 mm.
    assert bearings(with_wall(6)) == {"Deep groove ball bearing ISO 15 - 61800 - 10 x 19 x 5": 14}
    assert bearings(with_wall(8)) == {"Deep groove ball bearing ISO 15 - 6000 - 10 x 26 x 8": 14}
    assert bearings(with_wall(9)) == {"Deep groove ball bearing ISO 15 - 6200 - 10 x 30 x 9": 14}
    assert not any(finding.rule == "no-bearing" for finding in with_wall(6).check().findings)
    thin = with_wall(4)
    assert bearings(thin) == {}
    found = [finding for finding in thin.check().findings if finding.rule == "no-bearing"]
    assert [finding.place.part for finding in found] == ["sun", "intermediate", "planet"]
    assert all((finding.measured, finding.required) == (4, 5) and finding.remedy for finding in found)
    odd = ct.ThreeArm.from_toml(text.replace("bore = 10", "bore = 11"))
    messages = [finding.message for finding in odd.check().findings if finding.rule == "no-bearing"]
    assert len(messages) == 3
    assert all("has a bore of 11 mm" in message for message in messages)
