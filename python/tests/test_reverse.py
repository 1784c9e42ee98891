"""A machine made from a path: bars by closed forms, the machine held against the path itself."""

import json
import pickle
import subprocess
import sys

import centrode as ct
import numpy as np
import pytest
import shapely
import tomllib
from scipy.interpolate import BSpline

DRAWN = np.array(
    [
        (0, 0),
        (60, 70),
        (150, 150),
        (230, 215),
        (262, 262),
        (235, 300),
        (170, 330),
        (100, 330),
        (40, 300),
        (-5, 250),
        (-30, 190),
        (-38, 130),
        (-30, 60),
    ],
    float,
)


def test_bars_are_half_the_sum_and_half_the_difference_of_the_extreme_distances():
    # An ellipse seen from a place on its long axis, outside: its distances are maximum and minimum at the vertices.
    t = np.linspace(0, 2 * np.pi, 400, endpoint=False)
    path = np.column_stack([50 * np.cos(t), 45 * np.sin(t)])
    made = ct.reverse(path, (120, 0))
    assert made.carrier == pytest.approx(50, abs=1e-7)
    assert made.arm == pytest.approx(120, abs=1e-7)
    assert made.shaft_distance == pytest.approx(70, abs=1e-7)


def test_the_law_grows_by_a_turn_within_its_ratios():
    made = ct.reverse(DRAWN, (260, 160), bend_deg=40)
    psi = np.linspace(0, 2 * np.pi, 2001)
    law = made.law(psi)
    assert law[-1] - law[0] == pytest.approx(2 * np.pi, abs=1e-12)
    slope = np.diff(law) / np.diff(psi)
    least, greatest = made.ratios
    assert least - 1e-6 <= slope.min() < least + 1e-3
    assert greatest - 1e-3 < slope.max() <= greatest + 1e-6


def test_the_map_has_figures_where_an_axis_is_possible_and_a_reason_elsewhere():
    made = ct.reverse(DRAWN, (260, 160))
    axes = made.axes
    assert axes.possible.any()
    assert not axes.possible.all()
    assert np.isfinite(axes.carrier[axes.possible]).all()
    assert np.isnan(axes.carrier[~axes.possible]).all()
    fault = np.array(axes.fault, dtype=object)
    assert all(f is None for f in fault[axes.possible])
    assert set(fault[~axes.possible]) <= {"extremes", "circle", "on-axis", "winding", "carrier-turns-back", "arm-stops"}
    # The axis chosen is milder than any of the grid.
    best = ct.reverse(DRAWN).ratios
    assert axes.ratios.shape == (*axes.possible.shape, 2)
    grid = np.maximum(-np.log(axes.ratios[..., 0]), np.log(axes.ratios[..., 1]))
    assert max(-np.log(best[0]), np.log(best[1])) <= np.nanmin(grid)


def curvatures(ratio, slope, bend):
    """Of the polar curves r1 = i/(1 + i) and r2 = 1/(1 + i), from ln i and its derivatives by the driver."""
    i = np.exp(ratio)
    r1, r2 = i / (1 + i), 1 / (1 + i)
    # d r1/d phi1, and r2 by its own angle: d phi2 = i d phi1.
    d1, dd1 = r1 * r2 * slope, r1 * r2 * (bend + (r2 - r1) * slope**2)
    d2 = -d1 / i
    dd2 = -(dd1 - d1 * slope) / i**2
    return [(r * r + 2 * d * d - r * dd) / (r * r + d * d) ** 1.5 for r, d, dd in ((r1, d1, dd1), (r2, d2, dd2))]


def test_the_least_radius_is_that_of_the_law_by_differences():
    made = ct.reverse(DRAWN, (260, 160), bend_deg=40)
    psi = np.linspace(0, 2 * np.pi, 40001)[:-1]
    step = 2e-4
    low, here, high = (made.law(psi + h) for h in (-step, 0.0, step))
    far = made.law(psi + 2 * step) - made.law(psi - 2 * step)
    first = (8 * (high - low) - far) / (12 * step)
    second = (high - 2 * here + low) / step**2
    third = (far - 2 * (high - low)) / (2 * step**3)
    slope = second / first
    bend = third / first - slope**2
    share = 0.5
    scale = -np.log(np.mean(first**share))
    # The second stage by the planet's angle.
    turned = [-share * slope / first, -share * (bend - slope**2) / first**2]
    both = [
        *curvatures(scale + share * np.log(first), share * slope, share * bend),
        *curvatures(scale - share * np.log(first), *turned),
    ]
    leg = 0.5 * made.carrier / np.cos(np.radians(20))
    assert made.minimum_radius == pytest.approx(leg / np.max(both), rel=5e-3)


@pytest.mark.parametrize(
    ("path", "options", "error", "key"),
    [
        (DRAWN[:3], {}, ct.DesignError, "path"),
        (DRAWN.ravel(), {}, ct.DesignError, "path"),
        (np.where(DRAWN == 70, np.nan, DRAWN), {}, ct.DesignError, "path"),
        (DRAWN, {"axis": (60, 200)}, ct.MechanismError, "axis"),
        (DRAWN, {"axis": (float("nan"), 0)}, ct.DesignError, "axis"),
        (DRAWN, {"split": "halves"}, ct.DesignError, "split"),
        (DRAWN, {"axis": (260, 160), "split": "one-pair", "bend_deg": -60}, ct.MechanismError, "split"),
        (DRAWN, {"axis": (260, 160), "bend_deg": 180}, ct.MechanismError, "split"),
        (DRAWN, {"arms": 0}, ct.DesignError, "arms"),
    ],
)
def test_what_cannot_be_made_is_an_error_of_its_key(path, options, error, key):
    with pytest.raises(error) as raised:
        ct.reverse(path, **options)
    assert raised.value.key == key


def test_other_threads_run_meanwhile(turns_meanwhile):
    assert turns_meanwhile(lambda: ct.reverse(DRAWN)) > 2


def test_every_split_has_its_figures_or_its_refusal():
    arms = ct.reverse(DRAWN, (260, 160), bend_deg=47)
    powers, mildest, one_pair = arms.splits
    assert (powers.name, mildest.name, one_pair.name) == ("powers", "mildest", "one-pair")
    assert [len(split.minimum_radii) for split in (powers, mildest, one_pair)] == [2, 2, 1]
    assert powers.minimum_radius == pytest.approx(arms.minimum_radius, rel=1e-3)
    assert mildest.minimum_radius > 1.2 * powers.minimum_radius
    assert all(split.refusal is None and split.tip_error < 1e-4 for split in (powers, mildest, one_pair))
    assert "mildest" in repr(mildest)
    refused = ct.reverse(DRAWN, (260, 160), bend_deg=60).splits[2]
    assert "2/3" in refused.refusal
    assert refused.minimum_radii == ()
    assert np.isnan(refused.minimum_radius)


def drawing(tmp_path, data, **keys):
    page = {"width": "200mm", "height": "100mm", "viewBox": "0 0 200 100"} | keys
    root = " ".join(f'{key}="{value}"' for key, value in page.items())
    file = tmp_path / "drawn.svg"
    file.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" {root}><path d="{data}"/></svg>')
    return file


@pytest.mark.parametrize("within", [0.1, 1e-2, 1e-4])
def test_a_drawn_path_comes_within_the_distance_of_its_bezier_curves(tmp_path, within):
    from scipy.interpolate import CubicSpline

    file = drawing(tmp_path, "M 20 50 C 20 0 180 0 180 50 C 180 100 20 100 20 50 Z")
    points = ct.drawn_path(file, within=within)
    closed = np.vstack([points, points[:1]])
    spline = CubicSpline(np.arange(len(closed)), closed, bc_type="periodic")
    made = spline(np.linspace(0, len(points), 20_001))
    t = np.linspace(0, 1, 20_001)[:, None]
    ends = np.array([[[20, 50], [20, 0], [180, 0], [180, 50]], [[180, 50], [180, 100], [20, 100], [20, 50]]], float)
    ends[:, :, 1] = 100 - ends[:, :, 1]
    bezier = [(1 - t) ** 3 * a + 3 * t * (1 - t) ** 2 * b + 3 * t**2 * (1 - t) * c + t**3 * d for a, b, c, d in ends]
    off = np.max(distances(np.vstack(bezier), made))
    assert off <= within + 1e-6
    # Half as many points would not do.
    half = np.vstack([points[::2], points[:1]])
    coarse = CubicSpline(np.arange(len(half)), half, bc_type="periodic")(np.linspace(0, len(half) - 1, 20_001))
    assert len(points) == 32 or np.max(distances(np.vstack(bezier), coarse)) > within


def distances(points, line):
    """Distance of points from a fine polygon: from its nearest corner's two sides."""
    from scipy.spatial import cKDTree

    _, near = cKDTree(line).query(points)
    found = np.full(len(points), np.inf)
    for step in (-1, 0):
        one = line[(near + step) % (len(line) - 1)]
        side = line[(near + step) % (len(line) - 1) + 1] - one
        share = np.clip(np.sum((points - one) * side, axis=1) / np.sum(side**2, axis=1), 0, 1)
        found = np.minimum(found, np.linalg.norm(one + share[:, None] * side - points, axis=1))
    return found


def test_a_machine_follows_a_drawn_path(tmp_path):
    file = drawing(tmp_path, "M 20 50 C 20 0 180 0 180 50 C 180 100 20 100 20 50 Z")
    points = ct.drawn_path(file)
    made = ct.reverse(points, (230, 40), bend_deg=40)
    radii = np.hypot(points[:, 0] - 230, points[:, 1] - 40)
    assert made.carrier + made.arm == pytest.approx(radii.max(), abs=0.5)
    assert made.tip_error < 1e-3


def test_a_drawing_that_gives_no_path_is_refused_with_its_file(tmp_path):
    square = drawing(tmp_path, "M 20 20 H 120 V 80 H 20 Z")
    with pytest.raises(ct.DesignError, match=r"drawn\.svg: .* turns by 90\.00 deg, at \(.*\) mm; round corners"):
        ct.drawn_path(square)
    with pytest.raises(ct.DesignError, match=r"drawn\.svg: .* does not state its size: width is \"200\""):
        ct.drawn_path(drawing(tmp_path, "M 0 0 Z", width="200"))
    with pytest.raises(ct.DesignError, match="greater than zero"):
        ct.drawn_path(square, within=-1)
    with pytest.raises(FileNotFoundError):
        ct.drawn_path(tmp_path / "none.svg")


POSES = [(249.08, 50.03, 31.93), (167.32, 64.88, 20.89), (104.40, 34.05, 42.55), (175.51, 14.69, 53.59)]


def test_key_poses_are_met_in_order_by_the_machine_they_make():
    made = ct.reverse_poses(POSES, bend_deg=40)
    machine = made.machine()
    phi = np.linspace(0, 2 * np.pi, 200_001)
    tip, arm = machine.point("arm.tip", phi), machine.frames(phi)["arm"]
    clamp = np.degrees(np.arctan2(*(tip - arm[:, :2, 3]).T[::-1])) + made.clamp_deg
    at = []
    for x, y, direction in POSES:
        off = np.hypot(*(tip - [x, y]).T)
        at.append(np.argmin(off))
        turned = (clamp[at[-1]] - direction + 180) % 360 - 180
        # Between two places looked at the tip moves some hundredths.
        assert off[at[-1]] < 0.1
        assert abs(turned) < 0.1
    steps = np.diff([*at, at[0]]) % (len(phi) - 1)
    assert steps.sum() == len(phi) - 1
    assert made.misses.shape == (4, 2)
    assert (made.misses < 0.1).all()


def test_as_many_key_poses_as_no_machine_meets_are_refused_by_number():
    with pytest.raises(ct.DesignError, match="3 to 7"):
        ct.reverse_poses(POSES[:2])
    with pytest.raises(ct.DesignError, match=r"\(N, 3\)"):
        ct.reverse_poses([(0, 0)] * 4)
    with pytest.raises(ct.MechanismError, match="circle"):
        ct.reverse_poses(
            [(0, 0, 0), (0, 0, 180), (1000, 0, 0), (0, 1000, 90), (-1000, 0, 45), (0, -1000, 10), (500, 5, 77)]
        )


def test_a_transplanter_takes_its_poses_and_reaches_every_goal():
    poses = np.array([(240, 40, 5), (288, -6, 17), (240, -165, -4), (85, -272, -33), (-70, -268, -54)])
    made = ct.reverse_poses(poses, arms=3)
    arms = made.three_arm()
    assert isinstance(arms, ct.ThreeArm)
    assert all(goal.met for goal in arms.goals())
    found = {finding.rule for finding in arms.check().findings if finding.severity != "note"}
    # Stems in the tray spring back; no goal is about them.
    assert found <= {"unpicked-seedlings"}
    # The tip's own course: it comes to every pose in order, and the clamp points as wanted there.
    theta = np.linspace(-0.5, 2 * np.pi - 0.5, 200_001)
    tip = arms.tip(theta) + made.axis
    at = [np.argmin(np.hypot(*(tip - pose[:2]).T)) for pose in poses]
    assert (np.diff(at) > 0).all()
    assert np.abs(np.linalg.norm(tip[at] - poses[:, :2], axis=1)).max() < 0.01
    assert np.abs(np.degrees(arms.clamp_angle(theta[at])) - poses[:, 2]).max() < 0.01
    with pytest.raises(ct.MechanismError, match="key poses"):
        ct.reverse(DRAWN, (260, 160), bend_deg=40).three_arm()


def distance_to_spline(points, closed):
    """Distances of points from a closed spline of degree five through others, by SciPy."""
    from scipy.interpolate import make_interp_spline

    count = len(closed)
    curve = make_interp_spline(np.arange(count + 1), np.vstack([closed, closed[:1]]), k=5, bc_type="periodic")
    coarse = np.linspace(0, count, 4001)
    places = curve(coarse)

    def distance(point):
        at = coarse[np.hypot(*(places - point).T).argmin()]
        for _ in range(6):
            away, along = curve(at % count) - point, curve(at % count, 1)
            at -= away @ along / (along @ along)
        return np.hypot(*(curve(at % count) - point))

    return np.array([distance(point) for point in points])


def test_an_eased_path_stays_in_its_bands_and_bears_full_teeth():
    made = ct.reverse(DRAWN, (260, 160), bend_deg=40, band=5)
    assert (np.hypot(*(made.eased - DRAWN).T) <= 5 + 1e-9).all()
    assert (distance_to_spline(DRAWN, made.eased) <= 5 + 1e-9).all()
    assert made.full_module > 2
    machine = made.machine()
    assert machine.check().ok
    # The tip of the machine runs along the eased path, which SciPy draws.
    tip = machine.point("arm.tip", np.linspace(0, 2 * np.pi, 200, endpoint=False))
    assert distance_to_spline(tip, made.eased).max() < 1e-5


@pytest.mark.campaign
def test_each_point_may_have_its_own_band_and_the_same_answer_comes_from_a_copy():
    bands = np.full(len(DRAWN), 6.0)
    bands[[0, 4]] = 0
    made = ct.reverse(DRAWN, (260, 160), bend_deg=40, band=bands, module=0.5)
    assert made.full_module >= 0.5
    assert np.array_equal(made.eased[[0, 4]], DRAWN[[0, 4]])
    moved = np.hypot(*(made.eased - DRAWN).T)
    assert 0 < moved.max() < 6
    copy = pickle.loads(pickle.dumps(made))
    assert np.array_equal(copy.eased, made.eased)
    assert copy.full_module == made.full_module


@pytest.mark.campaign
def test_a_free_return_keeps_the_stroke():
    stroke = DRAWN[:6]
    made = ct.reverse(stroke, bend_deg=40, open=True)
    assert np.array_equal(made.eased[:6], stroke)
    assert len(made.eased) >= 10
    assert made.full_module > 1
    tip = made.machine().point("arm.tip", np.linspace(0, 2 * np.pi, 4001))
    assert np.hypot(*(tip[:, None] - stroke[None]).transpose(2, 0, 1)).min(axis=0).max() < 0.5
    with pytest.raises(ct.DesignError, match="3 points or more, not 2"):
        ct.reverse(stroke[:2], open=True)


@pytest.mark.parametrize(
    ("keywords", "word"),
    [
        ({"band": -1}, "band of point 1"),
        ({"band": [1, 2]}, "2 bands for 13 points"),
        ({"band": 1, "module": 0}, "module must be greater than zero"),
        ({"module": 1}, "give band"),
    ],
)
def test_what_is_no_band_is_refused(keywords, word):
    with pytest.raises(ct.DesignError, match=word):
        ct.reverse(DRAWN, (260, 160), **keywords)


def test_a_machine_of_an_eased_path_follows_it_through_tooth_contact_alone(tmp_path):
    """In MuJoCo, driven by its teeth alone, the planet is off its law by no more than the backlash of both meshes."""
    made = ct.reverse(DRAWN, (260, 160), bend_deg=40, band=5)
    machine = made.machine()
    machine.export(tmp_path, formats=["mjcf"])
    how = ["--check", "--contact", "--speed", "2", "--load", "0.02"]
    command = [sys.executable, str(tmp_path / "play_mujoco.py"), *how]
    played = subprocess.run(command, capture_output=True, text=True, check=True)
    found = json.loads(played.stdout.splitlines()[-1])
    # Half the backlash of the first mesh, transmitted by the second, and half of the second, by the minimum radius.
    pair = tomllib.loads(machine.to_toml())["pairs"]["first-stage"]
    distance, backlash = pair["pitch"]["center_distance"], pair["teeth"]["backlash"]
    ratio = made.ratios[1]
    half = 0.5 * backlash / (distance / (1 + ratio) * np.cos(np.radians(20)))
    assert 0 < found["joints"]["idler_joint"]["off_max"] < half
    assert 0 < found["joints"]["planet_joint"]["off_max"] < half * (1 + ratio)
    assert found["penetration_max_mm"] < 0.01


WISHES = {
    "carrier": {"maximum": 130},
    "arm": {"minimum": 150, "maximum": 190},
    "directions": [
        {"point": 5, "direction_deg": 40, "tolerance_deg": 5},
        {"point": 9, "direction_deg": 85, "tolerance_deg": 5},
    ],
    "keep_out": {"tray": {"corners": [[320, 330], [360, 330], [360, 420], [320, 420]], "clearance": 2}},
}


@pytest.mark.campaign
def test_what_else_is_wanted_is_reached_and_is_so_by_other_measures():
    made = ct.reverse(DRAWN, bend_deg=40, band=5, wishes=WISHES)
    assert made.carrier <= 130
    assert 150 <= made.arm <= 190
    assert all(goal.met for goal in made.goals), made.goals
    goals = {goal.name: goal.value for goal in made.goals}
    machine = made.machine()
    phi = np.linspace(0, 2 * np.pi, 4001)
    # Directions: those of the arm where its tip is nearest to the points as they were eased.
    tip, arm = machine.point("arm.tip", phi), machine.body("arm", phi)[:, 2]
    for point in (5, 9):
        nearest = np.hypot(*(tip - made.eased[point - 1]).T).argmin()
        wanted = next(w["direction_deg"] for w in WISHES["directions"] if w["point"] == point)
        off = np.degrees(arm[nearest]) + made.clamp_deg - wanted
        off = (off + 180) % 360 - 180
        assert off == pytest.approx(np.degrees(goals[f"direction-{point}"]), abs=0.2)
        assert abs(off) < 5.2
    # The distance from the tray: of a plate with round ends, by shapely, and by the machine's own clearance.
    tray = shapely.Polygon(WISHES["keep_out"]["tray"]["corners"])
    design = tomllib.loads(machine.to_toml())
    half = 0.5 * design["plates"]["width"]
    knee = machine.body("arm", phi)[:, :2]
    bars = [shapely.LineString([k, t]) for k, t in zip(knee, tip, strict=True)]
    gap = min(bar.distance(tray) for bar in bars) - half
    assert goals["keep-out-tray"] == pytest.approx(gap, abs=1e-3)
    assert machine.clearance("arm", "tray")[0] == pytest.approx(gap, abs=0.01)
    assert design["obstacles"]["tray"]["outline"] == WISHES["keep_out"]["tray"]["corners"]
    copy = pickle.loads(pickle.dumps(made))
    assert np.array_equal(copy.eased, made.eased)
    assert copy.goals == made.goals


def test_control_points_give_their_b_spline():
    """The tip of the machine runs along SciPy's spline."""
    made = ct.reverse(DRAWN, bend_deg=40, control=True)
    count = len(DRAWN)
    controls = DRAWN[np.arange(-1, count + 2) % count]
    spline = BSpline(np.arange(-3, count + 4), controls, 3)
    tip = machine_tip(made)
    line = shapely.LineString(spline(np.linspace(0, count, 20001)))
    assert max(line.distance(shapely.Point(p)) for p in tip) < 1e-3
    with pytest.raises(ct.DesignError, match="not with open"):
        ct.reverse(DRAWN, control=True, open=True)


def machine_tip(made):
    """Places of the tip by both bars alone."""
    psi = np.linspace(0, 2 * np.pi, 501)
    arm = psi - made.law(psi)
    bars = [length * np.c_[np.cos(angle), np.sin(angle)] for length, angle in ((made.carrier, psi), (made.arm, arm))]
    return np.array(made.axis) + bars[0] + bars[1]


@pytest.mark.campaign
def test_an_aim_is_the_better_for_being_sought():
    module, mild, small = (ct.reverse(DRAWN, bend_deg=40, aim=aim) for aim in ("module", "mild", "small"))
    uneven = [max(r.ratios[1], 1 / r.ratios[0]) for r in (module, mild, small)]
    reach = [r.carrier + r.arm for r in (module, mild, small)]
    assert min(uneven) == uneven[1]
    assert min(reach) == reach[2]
    assert module.full_module >= max(mild.full_module, small.full_module)


@pytest.mark.campaign
def test_a_wish_out_of_reach_is_come_near_to_and_told():
    made = ct.reverse(DRAWN, bend_deg=40, wishes={"carrier": {"maximum": 20}})
    (goal,) = made.goals
    assert not goal.met
    assert goal.value == pytest.approx(made.carrier)
    assert goal.margin < 0
    # No axis of the map has a shorter one; the eased path is of degree five, that of the map a cubic.
    assert made.carrier < np.nanmin(ct.reverse(DRAWN, bend_deg=40).axes.carrier) + 0.5


@pytest.mark.parametrize(
    ("wishes", "key"),
    [
        ({"clamp_deg": "up"}, "wishes.clamp_deg"),
        ({"arm": {"minimum": "long"}}, "wishes.arm.minimum"),
        ({"arm": 5}, "wishes.arm"),
        (
            {"directions": [{"point": 1, "direction_deg": 0}, {"point": "two", "direction_deg": 1}]},
            "wishes.directions[1].point",
        ),
        ({"directions": [{"point": 99, "direction_deg": 1}]}, "wishes.directions[0].point"),
        ({"keep_out": {"tray": {"corners": [[0, 0], [1, "x"]]}}}, "wishes.keep_out.tray.corners[1][1]"),
        ({"turn": {"from": 1, "to": 2, "between_deg": 5}}, "wishes.turn.between_deg"),
    ],
)
def test_a_wish_of_a_wrong_type_names_its_key(wishes, key):
    with pytest.raises(ct.DesignError) as told:
        ct.reverse(DRAWN, wishes=wishes)
    assert told.value.key == key
    assert key in str(told.value)


def test_an_axis_at_the_border_of_its_box_is_a_finding():
    corners = ((240, 150), (200, 100))
    made = ct.reverse(DRAWN, bend_deg=40, axis_box=corners)
    (finding,) = made.findings
    assert finding.rule == "axis-at-border"
    x, y = made.axis
    assert 200 <= x <= 240
    assert 100 <= y <= 150
    assert min(abs(x - 200), abs(x - 240), abs(y - 100), abs(y - 150)) < 0.1
    assert (made.axes.x[0], made.axes.x[-1], made.axes.y[0], made.axes.y[-1]) == (200, 240, 100, 150)
    assert pickle.loads(pickle.dumps(made)).axis == made.axis
    # No axis of the box is milder.
    ratios = made.axes.ratios[made.axes.possible]
    assert max(made.ratios[1], 1 / made.ratios[0]) <= np.maximum(ratios[:, 1], 1 / ratios[:, 0]).min() + 1e-9
    assert ct.reverse(DRAWN, (260, 160), bend_deg=40).findings == ()
    with pytest.raises(ct.DesignError, match="axis_box"):
        ct.reverse(DRAWN, (260, 160), axis_box=corners)
    with pytest.raises(ct.DesignError, match="axis_box"):
        ct.reverse(DRAWN, axis_box=((1, 2), (1, 5)))


@pytest.mark.campaign
def test_arms_that_collide_are_findings_with_their_place():
    t = np.arange(40) * 2 * np.pi / 40
    radius = 60 + 1.5 * np.cos(2 * t)
    path = np.column_stack([100 + radius * np.cos(t), radius * np.sin(t)])
    made = ct.reverse(path, (0, 0), arms=6)
    found = [finding for finding in made.findings if finding.rule == "gears-collide"]
    assert found
    machine = made.machine()
    told = {finding.message for finding in machine.check().findings}
    assert {finding.message for finding in found} <= told
    assert found[0].measured == min(finding.measured for finding in found)
    place = found[0].place
    assert 0 <= place.input <= 2 * np.pi
    assert ct.reverse(path, (0, 0), arms=1).findings == ()


@pytest.mark.parametrize(
    ("wishes", "key"),
    [
        ({"arm": {"minimum": -1}}, "arm.minimum"),
        ({"arms": {}}, "unknown field `arms`"),
        ({"directions": [{"point": 99, "direction_deg": 1}]}, "directions"),
        ({"keep_out": {"tray": {}}}, "keep_out.tray.corners"),
        ({"clamp_deg": "up"}, "invalid type"),
    ],
)
def test_a_wish_that_breaks_a_rule_is_named(wishes, key):
    with pytest.raises(ct.DesignError, match=key):
        ct.reverse(DRAWN, wishes=wishes)
