"""The page on which a machine is made from a path, in a real browser: points, axis, possible axes, poses, design."""

import json
import math
import re

import pytest
import tomllib
from axe_playwright_python.sync_playwright import Axe
from conftest import centrode
from page import drag, field, settled, shown
from page import figures as page_figures
from playwright.sync_api import expect
from studio import studio

X = [0, 60, 150, 230, 262, 235, 170, 100, 40, -5, -30, -38, -30]
Y = [0, 70, 150, 215, 262, 300, 330, 330, 300, 250, 190, 130, 60]
EXAMPLE = list(zip(X, Y, strict=True))
DESIGN = {"axis": [260, 160], "bend_deg": 40, "arms": 3, "split": "powers", "path": {"points": EXAMPLE}}
WISH = {"design": DESIGN}


def solved(page):
    """Waits until the wish that is shown has been answered, with the figures that take longer."""
    expect(page.locator("#verdict[aria-busy=false]")).to_be_attached()


def mapped(page):
    expect(page.locator("#field[aria-busy=false]:not(.stale)")).to_be_attached()


@pytest.fixture(scope="module")
def running(tmp_path_factory):
    folder = tmp_path_factory.mktemp("path")
    with studio(None, cwd=folder) as running:
        running.folder = folder
        yield running


@pytest.fixture(scope="module")
def shared(browser, running):
    granted = ["clipboard-read", "clipboard-write"]
    with shown(browser, f"{running.url}path", ready=solved, permissions=granted) as page:
        yield page


@pytest.fixture
def page(shared, running):
    """The page as it comes, in the one window of these tests."""
    shared.evaluate("sessionStorage.clear()")
    shared.goto(f"{running.url}path")
    solved(shared)
    return shared


def figures(page):
    cells = page.locator("#figures tr:not(.stale) td[data-key]")
    return dict(cells.evaluate_all("all => all.map(cell => [cell.dataset.key, cell.textContent])"))


def told(folder, points, *options, name="wished.csv", check=True):
    """Lines of the command line for a path, by their names, and what it complains of."""
    path = folder / name
    path.write_text("".join(f"{x!r},{y!r}\n" for x, y in points))
    done = centrode("reverse", path, *options, check=check)
    lines = re.findall(r"^(.{23}\S?) *(\S.*)$", done.stdout, re.M)
    return {name.strip(): words for name, words in lines}, done.stderr


def column(page, number, table="path"):
    """Words in a column of the table of points."""
    cells = page.locator(f'[id^="field-{table}."][data-column="{number}"]')
    return cells.evaluate_all("all => all.map(input => input.value)")


def rows(page):
    given = field(page, "wanted.given").input_value()
    return [(float(x), float(y)) for x, y in zip(column(page, 0, given), column(page, 1, given), strict=True)]


def answered(running, path, wish):
    """The answer of a search, which comes last, and how often it was told how far that was."""
    status, text = running.ask("POST", path, wish)
    assert status == 200
    *news, last = [json.loads(line) for line in text.splitlines()]
    assert all(set(one) == {"evaluations"} for one in news)
    return last["answer"], [one["evaluations"] for one in news]


def handle(page, name):
    return page.get_by_role("button", name=name)


def counted(page, count):
    table = field(page, "wanted.given").input_value()
    expect(page.locator(f'[id^="field-{table}."][data-column="0"]')).to_have_count(count)
    solved(page)


def typed(page, key, text):
    field(page, key).fill(text)
    field(page, key).press("Enter")


def middle(page, name):
    box = handle(page, name).locator("circle").last.bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def test_the_start_page_leads_here_and_back(browser, running):
    def ready(page):
        expect(page.get_by_role("link", name="Draw a path")).to_be_visible()

    with shown(browser, running.url, ready=ready) as page:
        page.get_by_role("link", name="Draw a path").click()
        solved(page)
        page.get_by_role("link", name="Start").click()
        ready(page)


def test_figures_are_those_of_the_command_line(page, running):
    lines, _ = told(running.folder, EXAMPLE, "--axis", "260,160", "--bend", "40", "--arms", "3")
    # The other splits come last.
    expect(page.locator('#figures tr:not(.stale) td[data-key="split one-pair"]')).to_be_visible()
    own = figures(page)
    assert own["axis of the carrier"] == lines["axis of the carrier"].removesuffix(", as given")
    same = [name for name in own if name in lines and name != "axis of the carrier"]
    assert len(same) == 10
    assert {name: own[name] for name in same} == {name: lines[name] for name in same}


def test_gears_roll_as_drawn_and_the_tip_runs_along_the_path(running):
    status, answer = running.json("POST", "path/solve", WISH | {"rest": True})
    assert status == 200
    picture = answer["picture"]
    shapes, motion = picture["shapes"], picture["motion"]
    placed = zip(picture["links"], motion["poses"], strict=True)
    links = {link["name"]: (link["shape"], poses) for link, poses in placed}

    def corners(name):
        flat = shapes[links[name][0]][0]["vertices"]
        return [complex(x, y) for x, y in zip(flat[::3], flat[1::3], strict=True)]

    def pose(name, moment):
        poses = links[name][1]
        x, y, angle = poses[:3] if len(poses) == 3 else poses[3 * moment : 3 * moment + 3]
        return complex(x, y), complex(math.cos(angle), math.sin(angle))

    def reach(name, moment, towards):
        """How far a pitch curve reaches from its axis towards a place."""
        at, turned = pose(name, moment)
        way = (towards - at) / abs(towards - at)
        outline = [corner * turned / way for corner in corners(name)]
        around = zip(outline, [*outline[1:], outline[0]], strict=True)
        for a, b in around:
            if a.real > 0 and b.real > 0 and a.imag * b.imag <= 0 and a.imag != b.imag:
                return (a.real * b.imag - b.real * a.imag) / (b.imag - a.imag)
        raise AssertionError(name)

    path = corners("path")
    for moment in range(0, len(motion["input"]), 7):
        for arm in (1, 2, 3):
            for one, other in [("sun", f"idler gear {arm}"), (f"planet {arm}", f"idler second gear {arm}")]:
                here, there = pose(one, moment)[0], pose(other, moment)[0]
                apart = reach(one, moment, there) + reach(other, moment, here) - abs(there - here)
                assert abs(apart) < 0.05
            at, turned = pose(f"arm {arm}", moment)
            tip = at + corners(f"arm {arm}")[-1] * turned
            off = min(abs(tip - place) for place in path)
            assert off < 2
    # The sharpest place of the chart is that of the figure.
    charts = {(curve["chart"], curve["name"]): curve["value"] for curve in answer["curves"]}
    sharpest = max(max(value) for (chart, _), value in charts.items() if chart.startswith("Curvature"))
    words = next(figure["words"] for figure in answer["figures"] if figure["name"] == "minimum convex radius")
    assert 1 / sharpest == pytest.approx(float(words.split()[0]), rel=0.03)
    assert min(charts["Ratio", ""]) == pytest.approx(0.5155, abs=2e-4)


def test_a_dragged_point_moves_the_path_and_all_that_follows(page, running):
    before = figures(page)
    drag(page, handle(page, "point 8 of the path"), 12, -9)
    solved(page)
    points = rows(page)
    assert points[:7] + points[8:] == EXAMPLE[:7] + EXAMPLE[8:]
    assert points[7] != EXAMPLE[7]
    lines, _ = told(running.folder, points, "--axis", "260,160", "--bend", "40")
    assert figures(page)["ratio"] == lines["ratio"] != before["ratio"]
    page.keyboard.press("Control+z")
    solved(page)
    assert rows(page) == EXAMPLE
    assert figures(page)["ratio"] == before["ratio"]
    page.keyboard.press("Control+Shift+z")
    solved(page)
    # Left and come back to, the path is there still.
    page.reload()
    solved(page)
    assert rows(page) == points


def test_the_axis_is_dragged_moved_by_keys_and_typed(page):
    solved(page)
    x, y = middle(page, "axis of the carrier")
    ratio = page.locator('#figures td[data-key="ratio"]')
    start = ratio.text_content()
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 15, y + 5, steps=3)
    # It follows while the hand is at it.
    expect(ratio).not_to_have_text(start)
    page.mouse.up()
    solved(page)
    dragged = float(field(page, "axis.x").input_value())
    assert dragged > 265
    assert figures(page)["axis of the carrier"].startswith(f"{dragged:.4f}, ")
    handle(page, "axis of the carrier").focus()
    page.keyboard.press("ArrowRight")
    solved(page)
    assert float(field(page, "axis.x").input_value()) > dragged
    typed(page, "gears.arms", "2.5")
    expect(page.locator('[id="remark-gears.arms"]')).to_contain_text("2.5 is no whole number")
    typed(page, "gears.arms", "2")
    typed(page, "axis.x", "250+10")
    typed(page, "axis.y", "16 cm")
    solved(page)
    assert figures(page)["axis of the carrier"] == "260.0000, 160.0000 mm"


def test_an_axis_that_is_not_possible_says_why_and_where(page, running):
    typed(page, "axis.x", "60")
    solved(page)
    _, complaint = told(running.folder, EXAMPLE, "--axis", "60,160", check=False)
    message = page.locator("#possible p").text_content()
    assert message[1:] in complaint
    assert re.search(r"at \(257\.5853, 277\.8302\)", message)
    expect(page.locator("#possible h2")).to_contain_text("not possible")
    expect(page.locator("#make")).to_be_disabled()
    page.get_by_role("button", name="Mildest axis").click()
    expect(page.locator("#possible h2")).to_contain_text("is possible")
    solved(page)
    lines, _ = told(running.folder, EXAMPLE, "--bend", "40")
    assert figures(page)["ratio"] == lines["ratio"]


def test_the_field_tells_of_every_place(page):
    mapped(page)
    counts = [int(number) for number in re.findall(r"\d+", page.locator("#field-count").text_content())]
    assert counts[0] == counts[2] + counts[3]
    assert counts[1] == 100 * 100
    readout = page.locator("#field-readout")
    x, y = middle(page, "axis of the carrier")
    page.mouse.move(x + 9, y)
    words = re.compile(r"Axis at 27\d\.\d, 1[56]\d\.\d: ratio 0\.\d+ to \d\.\d+, minimum radius \d")
    expect(readout).to_contain_text(words)
    x, y = middle(page, "point 12 of the path")
    page.mouse.move(x + 60, y)
    expect(readout).to_contain_text(
        "not possible, the distance of the path from this axis has several maxima and minima"
    )
    expect(page.locator('#field-faults li[data-fault="extremes"]')).to_be_visible()
    painted = "document.querySelector('#stage canvas').toDataURL()"
    by_ratio = page.evaluate(painted)
    page.get_by_label("Colour by").select_option("radius")
    expect(page.locator("#field-low")).to_contain_text("mm")
    by_radius = page.evaluate(painted)
    page.get_by_label("Possible axes").uncheck()
    assert len({by_ratio, by_radius, page.evaluate(painted)}) == 3
    # The map is that of the path as it is now.
    typed(page, "path.x-7", "110")
    mapped(page)
    expect(page.locator("#field-count")).not_to_contain_text(f"{counts[0]} of")


def test_points_are_added_and_deleted(page):
    (x, y), (u, v) = middle(page, "point 11 of the path"), middle(page, "point 12 of the path")
    # Between them the curve lies a little to the left.
    page.mouse.dblclick((x + u) / 2 - 2, (y + v) / 2)
    counted(page, 14)
    made = rows(page)[11]
    assert rows(page)[:11] + rows(page)[12:] == EXAMPLE
    assert abs(complex(*made) - (complex(*EXAMPLE[10]) + complex(*EXAMPLE[11])) / 2) < 8
    expect(handle(page, "point 12 of the path")).to_be_focused()
    page.keyboard.press("Delete")
    counted(page, 13)
    handle(page, "point 3 of the path").focus()
    page.keyboard.press("Insert")
    counted(page, 14)
    # On the curve, not on the chord, and hence the machine is much the same.
    assert rows(page)[3] == (193.625, 184.563)
    page.get_by_role("button", name="As text").click()
    text = page.get_by_role("textbox", name="Points, one a line")
    text.fill("0 0\n10 0\n10 10")
    page.locator("#dialog").get_by_role("button", name="Apply").click()
    expect(page.locator("#dialog [role=status]")).to_contain_text("at least 4 points")
    text.fill("0 0\n100 0\n100 60\n0 60")
    page.locator("#dialog").get_by_role("button", name="Apply").click()
    counted(page, 4)
    expect(page.get_by_role("button", name="Delete point 1", exact=True)).to_be_disabled()


def test_cells_of_a_spreadsheet_are_pasted_and_bad_ones_change_nothing(page):
    def paste(text, cell="path.x"):
        page.evaluate("text => navigator.clipboard.writeText(text)", text)
        field(page, cell).focus()
        page.keyboard.press("Control+v")

    remark = page.locator('[id="remark-path.x"]')
    paste("1\tNaN\n2\t3\n")
    expect(remark).to_contain_text("NaN is no number")
    assert rows(page) == EXAMPLE
    typed(page, "path.y-2", "nan")
    expect(page.locator('[id="remark-path.y"]')).to_contain_text("nan is no number")
    typed(page, "path.y-2", "150")
    paste("x\ty\n" + "".join(f"{x},5\t{y}\n" for x, y in EXAMPLE) + "-20\t30\n")
    counted(page, 14)
    assert rows(page) == [*((x + math.copysign(0.5, x), y) for x, y in EXAMPLE), (-20, 30)]
    # Over a point that is there already.
    typed(page, "path.x-13", "-30.5")
    typed(page, "path.y-13", "60")
    expect(page.locator("#possible p")).to_contain_text("Points 13 and 14 of the path are both (-30.5, 60) mm")


def test_a_path_that_crosses_itself_is_told_with_the_place(page, running):
    typed(page, "path.x-3", "-100")
    solved(page)
    points = [*EXAMPLE[:3], (-100, 215), *EXAMPLE[4:]]
    _, complaint = told(running.folder, points, check=False)
    message = page.locator("#possible p").text_content()
    assert "crosses itself at (-30.1345, 189.4689) mm" in message
    assert message[1:] in complaint
    page.locator("#undo").click()
    solved(page)
    expect(page.locator("#possible h2")).to_contain_text("is possible")


def test_files_of_a_path_are_opened_or_refused_and_written(page, running):
    folder = running.folder
    notice = page.locator('#notices [data-key="path"]')

    def open_file(name, text):
        (folder / name).write_text(text)
        page.locator("#path-file").set_input_files(folder / name)

    open_file("open.csv", "".join(f"{i},{i * i / 40}\n" for i in range(9)))
    expect(page.locator("#possible p")).to_contain_text("The path is open: its last point is 8.1584 mm from the first")
    open_file("words.csv", "0,0\n1,about\n")
    expect(notice).to_contain_text("words.csv: line 2")
    open_file("many.csv", "".join(f"{math.cos(i / 50)},{math.sin(i / 50)}\n" for i in range(314)))
    expect(notice).to_contain_text("the path has 314 points; the page shows up to 200")
    open_file("huge.csv", "0,0\n" * 300_000)
    expect(notice).to_contain_text("bytes; the limit is 1048576")
    counted(page, 9)
    curve = '<path d="M 20 50 C 20 0 180 0 180 50 C 180 100 20 100 20 50 Z"/>'
    open_file(
        "drawn.svg",
        f'<svg xmlns="http://www.w3.org/2000/svg" width="200mm" height="100mm" viewBox="0 0 200 100">{curve}</svg>',
    )
    counted(page, 64)
    expect(notice).to_contain_text("64 points, within 1.4e-3 mm of the drawing")
    semicolons = "x;y\n" + "".join(f"{x},25;{y}\n" for x, y in EXAMPLE if x > 0)
    open_file("decimal.csv", semicolons)
    counted(page, 8)
    with page.expect_download() as found:
        page.get_by_role("button", name="Points as CSV").click()
    found.value.save_as(folder / "saved.csv")
    assert (folder / "saved.csv").read_text() == "x,y\n" + "".join(f"{x + 0.25},{y}\n" for x, y in EXAMPLE if x > 0)


def test_a_made_machine_is_the_design_of_the_command_line(page, running):
    typed(page, "gears.arms", "1")
    typed(page, "gears.band", "5")
    solved(page)
    page.get_by_role("button", name="Make the machine").click()
    expect(page.locator("#dialog")).to_contain_text("teeth of first-stage", timeout=30_000)
    expect(page.locator("#dialog")).to_contain_text("full teeth, module")
    name = page.get_by_label("File", exact=True)
    expect(name).to_have_value("reversed.toml")
    name.press("Enter")
    expect(page.locator("#file")).to_have_text("reversed.toml")
    settled(page)
    folder = running.folder
    given = ["--axis", "260,160", "--bend", "40", "--band", "5"]
    told(folder, EXAMPLE, *given, "-o", folder / "by-command.toml")
    assert (folder / "reversed.toml").read_text() == (folder / "by-command.toml").read_text()
    report = json.loads(centrode("check", folder / "by-command.toml", "--json", check=False).stdout)
    shown = page_figures(page)
    assert len(report["values"]) > 5
    assert {key: float(shown[key]) for key in report["values"]} == report["values"]


def test_a_machine_of_the_path_as_it_is_drawn_is_that_of_the_command_line(running):
    axis = [345.5876, 355.1393]
    made, _ = answered(running, "path/machine", {"design": DESIGN | {"axis": axis, "arms": 1}})
    design = running.folder / "as-drawn.toml"
    told(running.folder, EXAMPLE, "--axis", "345.5876,355.1393", "--bend", "40", "-o", design)
    assert made["text"] == design.read_text()


@pytest.mark.campaign
def test_the_search_for_teeth_is_cancelled_and_where_none_will_do_the_path_eased(page, running):
    before = set(running.folder.iterdir())
    make, dialog = page.get_by_role("button", name="Make the machine"), page.locator("#dialog")
    # Here it takes long.
    make.click()
    page.get_by_role("button", name="Cancel").click()
    expect(page.locator("#working")).to_be_hidden()
    typed(page, "axis.x", "180")
    typed(page, "axis.y", "60")
    typed(page, "gears.arms", "1")
    solved(page)
    make.click()
    expect(dialog).to_contain_text("full teeth are undercut above a module of 0.0334 mm", timeout=30_000)
    page.get_by_label("Pass within").fill("none")
    page.get_by_label("Pass within").press("Enter")
    expect(dialog).to_contain_text("the band is a number above zero")
    page.get_by_label("Pass within").fill("15")
    page.get_by_label("Pass within").press("Enter")
    expect(dialog).to_contain_text(re.compile(r"path eased\s*by 1[45]\."), timeout=30_000)
    expect(dialog).to_contain_text("teeth, module")
    page.keyboard.press("Escape")
    expect(dialog).to_be_hidden()
    # The page goes on, and nothing was made.
    typed(page, "axis.x", "260")
    solved(page)
    assert set(running.folder.iterdir()) == before


@pytest.mark.campaign
def test_key_poses_are_dragged_by_place_and_direction_and_a_machine_found(page, running):
    field(page, "wanted.given").select_option("poses")
    counted(page, 4)
    expect(page.locator("#possible h2")).to_contain_text("Not searched yet")
    expect(page.locator("#field")).to_be_hidden()
    expect(page.locator("#make")).to_be_disabled()
    drag(page, handle(page, "direction of pose 2"), 0, -12)
    direction = float(field(page, "poses.direction_deg-1").input_value())
    assert 22 < direction < 45
    handle(page, "direction of pose 2").focus()
    page.keyboard.press("ArrowDown")
    expect(field(page, "poses.direction_deg-1")).not_to_have_value(str(direction))
    handle(page, "pose 1 of the path").focus()
    page.keyboard.press("Insert")
    counted(page, 5)
    page.keyboard.press("Delete")
    counted(page, 4)
    page.locator("#undo").click()
    page.locator("#undo").click()
    page.locator("#undo").click()
    page.locator("#undo").click()
    expect(field(page, "poses.direction_deg-1")).to_have_value("20.89")
    typed(page, "gears.arms", "1")
    page.get_by_role("button", name="Find the machine").click()
    expect(page.locator("#possible h2")).to_contain_text("A machine is found", timeout=30_000)
    folder = running.folder
    poses = folder / "poses.csv"
    with page.expect_download() as found:
        page.get_by_role("button", name="Points as CSV").click()
    found.value.save_as(poses)
    done = centrode("reverse", poses, "--poses", "--bend", "40", "-o", folder / "posed.toml").stdout
    own = figures(page)
    for name in ("clamp", "carrier", "arm", "ratio", "pose 4", "pair second-stage"):
        assert re.search(rf"^{name} +{re.escape(own[name])}$", done, re.M), name
    page.get_by_role("button", name="Make the machine").click()
    expect(page.locator("#dialog")).to_contain_text("teeth of second-stage", timeout=30_000)
    page.get_by_label("File", exact=True).fill("from-poses.toml")
    page.get_by_label("File", exact=True).press("Enter")
    expect(page.locator("#file")).to_have_text("from-poses.toml")
    assert (folder / "from-poses.toml").read_text() == (folder / "posed.toml").read_text()


@pytest.mark.campaign
def test_the_return_of_a_stroke_is_found(page, running):
    field(page, "wanted.given").select_option("stroke")
    counted(page, 5)
    expect(page.locator("#field")).to_be_hidden()
    page.get_by_role("button", name="Find the machine").click()
    expect(page.locator("#possible h2")).to_contain_text("A machine is found", timeout=30_000)
    assert "free return" in figures(page)
    stroke = rows(page)
    assert stroke == EXAMPLE[:5]
    path = {"points": stroke, "open": True}
    answer, _ = answered(running, "path/find", {"design": {"bend_deg": 40, "arms": 3, "split": "powers", "path": path}})
    flat = answer["picture"]["shapes"][0][0]["vertices"]
    path = [complex(x, y) for x, y in zip(flat[::3], flat[1::3], strict=True)]
    around = [*path[1:], path[0]]
    for point in stroke:
        # Off the chords of the path as it is drawn.
        at = complex(*point)
        offs = [
            abs(at - a - (b - a) * min(max(((at - a) / (b - a)).real, 0), 1)) for a, b in zip(path, around, strict=True)
        ]
        assert min(offs) < 0.05
    # What was found is that of other points no longer.
    page.get_by_role("button", name="Delete point 3", exact=True).click()
    counted(page, 4)
    expect(page.locator("#possible h2")).to_contain_text("Not searched yet")


def saved(page, folder, button="Save the path"):
    """Text of the file that a button gives."""
    with page.expect_download() as found:
        page.get_by_role("button", name=button).click()
    found.value.save_as(folder / "saved")
    return (folder / "saved").read_text()


def wishes(page):
    return page.locator("#wished li").all_text_contents()


def test_directions_at_points_are_dragged_typed_and_told(page, running):
    field(page, "path.directions").check()
    drag(page, handle(page, "direction at point 5"), 10, -25)
    solved(page)
    angle = float(column(page, 2)[4])
    assert 40 < angle < 85
    # The one direction there is fixes the clamp: it is met as it is drawn.
    assert wishes(page) == ["✓ clamp direction error at point 5 0 deg, required -2.0000 deg to 2.0000 deg"]
    handle(page, "direction at point 9").focus()
    page.keyboard.press("ArrowDown")
    expect(field(page, "path.direction_deg-8")).not_to_have_value("")
    typed(page, "path.direction_deg-8", "-140")
    typed(page, "path.direction_tolerance_deg-8", "0")
    expect(page.locator('[id="remark-path.direction_tolerance_deg"]')).to_contain_text("a number above 0")
    typed(page, "path.direction_tolerance_deg-8", "5")
    solved(page)
    assert len(wishes(page)) == 2
    assert any("missed by" in words for words in wishes(page))
    # Points added before them leave them where they are.
    handle(page, "point 3 of the path").focus()
    page.keyboard.press("Insert")
    counted(page, 14)
    assert [i for i, words in enumerate(column(page, 2)) if words] == [5, 9]
    design = tomllib.loads(saved(page, running.folder))
    assert design["wishes"]["directions"] == [
        {"point": 6, "direction_deg": angle, "tolerance_deg": 2.0},
        {"point": 10, "direction_deg": -140.0, "tolerance_deg": 5.0},
    ]
    handle(page, "direction at point 10").focus()
    page.keyboard.press("Delete")
    expect(field(page, "path.direction_deg-9")).to_have_value("")
    solved(page)
    assert len(wishes(page)) == 1
    page.locator("#undo").click()
    expect(field(page, "path.direction_deg-9")).to_have_value("-140")


@pytest.mark.campaign
def test_shapes_to_keep_out_of_are_added_dragged_and_deleted(page, running):
    page.get_by_role("button", name="Circle").focus()
    page.keyboard.press("Enter")
    field(page, "wishes.keep_out.circle.name").fill("stem")
    page.keyboard.press("Enter")
    solved(page)
    x, y = (float(field(page, f"wishes.keep_out.stem.center{end}").input_value()) for end in ("", "-1"))
    scale = middle(page, "radius of stem")[0] - middle(page, "centre of stem")[0]
    radius = float(field(page, "wishes.keep_out.stem.radius").input_value())
    drag(page, handle(page, "centre of stem"), 30, -40)
    solved(page)
    moved = [float(field(page, f"wishes.keep_out.stem.center{end}").input_value()) for end in ("", "-1")]
    assert moved == pytest.approx([x + 30 * radius / scale, y + 40 * radius / scale], abs=1)
    handle(page, "radius of stem").focus()
    page.keyboard.press("Shift+ArrowLeft")
    expect(field(page, "wishes.keep_out.stem.radius")).not_to_have_value(str(radius))
    page.get_by_role("button", name="Polygon").click()
    solved(page)
    handle(page, "corner 2 of polygon").focus()
    page.keyboard.press("Insert")
    expect(handle(page, "corner 5 of polygon")).to_be_visible()
    before = [float(x) for x in column(page, 0, "wishes.keep_out.polygon")]
    drag(page, handle(page, "middle of polygon"), 60, 0)
    solved(page)
    after = [float(x) for x in column(page, 0, "wishes.keep_out.polygon")]
    steps = [b - a for a, b in zip(before, after, strict=True)]
    assert steps == pytest.approx([60 * radius / scale] * 5, abs=1)
    page.get_by_role("button", name="Ground").click()
    typed(page, "wishes.keep_out.ground.clearance", "3")
    typed(page, "wishes.keep_out.ground.below", "-150")
    solved(page)
    told = wishes(page)
    assert [re.search("from ([a-z]+)", words)[1] for words in told] == ["ground", "polygon", "stem"]
    design = tomllib.loads(saved(page, running.folder))
    shapes = design["wishes"]["keep_out"]
    assert shapes["ground"] == {"below": -150.0, "clearance": 3.0}
    assert shapes["stem"]["center"] == moved
    assert [corner[0] for corner in shapes["polygon"]["corners"]] == after
    # The figures are those of the command.
    path = running.folder / "shapes.toml"
    path.write_text(saved(page, running.folder).replace("[path]", "[path]\ncrossing = false"))
    done = centrode("reverse", path, check=False).stdout
    assert len(re.findall("distance of the arm from", done)) == 3
    typed(page, "wishes.keep_out.ground.name", "arm")
    expect(page.locator("#possible h2")).to_contain_text("A value breaks a rule")
    expect(page.locator('[id="remark-wishes.keep_out.arm"]')).to_contain_text("a body of the same name")
    typed(page, "wishes.keep_out.arm.name", "stem")
    expect(page.locator('[id="remark-wishes.keep_out.arm.name"]')).to_contain_text("there is a shape stem already")
    handle(page, "height of arm").focus()
    page.keyboard.press("Delete")
    expect(field(page, "wishes.keep_out.arm.below")).to_have_count(0)
    page.get_by_role("button", name="Delete polygon").click()
    expect(handle(page, "corner 2 of polygon")).to_have_count(0)
    solved(page)
    assert len(wishes(page)) == 1


WANTED = f"""family = "path"
name = "wanted"
bend_deg = 40
axis = [264.9914, 162.9171]
[path]
points = {[list(point) for point in EXAMPLE]}
band = 5
[wishes]
carrier = {{ maximum = 131 }}
arm = {{ minimum = 150, maximum = 190 }}
directions = [
    {{ point = 5, direction_deg = 40, tolerance_deg = 5 }},
    {{ point = 9, direction_deg = 85, tolerance_deg = 5 }},
]
turn = {{ from = 1, to = 5, between_deg = [20, 150] }}
[wishes.keep_out.tray]
corners = [[320, 330], [360, 330], [360, 420], [320, 420]]
clearance = 2
"""


@pytest.mark.campaign
def test_a_machine_with_wishes_is_that_of_the_command_and_its_search_is_cancelled(page, running):
    folder = running.folder
    (folder / "wanted.toml").write_text(WANTED)
    page.locator("#path-file").set_input_files(folder / "wanted.toml")
    expect(page.locator('#notices [data-key="path"]')).to_contain_text("13 points, with all requirements")
    solved(page)
    expect(field(page, "wishes.carrier-1")).to_have_value("131")
    expect(handle(page, "corner 4 of tray")).to_be_visible()
    assert column(page, 2)[4] == "40"
    assert len(wishes(page)) == 7
    text = saved(page, folder)
    kept, given = tomllib.loads(text), tomllib.loads(WANTED)
    assert {**kept, "split": None, "arms": None} == {**given, "split": None, "arms": None}
    make, dialog = page.get_by_role("button", name="Make the machine"), page.locator("#dialog")
    make.click()
    expect(page.locator("#working-time")).to_contain_text("evaluations")
    page.get_by_role("button", name="Cancel").click()
    expect(page.locator("#working")).to_be_hidden()
    expect(dialog).to_be_hidden()
    page.get_by_role("button", name="Find the machine").click()
    expect(page.locator("#possible h2")).to_contain_text("A machine is found", timeout=60_000)
    expect(page.locator("#wished h2")).to_have_text("Wishes: all reached")
    found = wishes(page)
    make.click()
    expect(dialog).to_contain_text("teeth of second-stage", timeout=60_000)
    assert dialog.locator("li").all_text_contents() == found
    name = page.get_by_label("File", exact=True)
    name.fill("with-wishes.toml")
    name.press("Enter")
    expect(page.locator("#file")).to_have_text("with-wishes.toml")
    (folder / "kept.toml").write_text(text)
    told = centrode("reverse", folder / "kept.toml", "-o", folder / "by-file.toml").stdout
    assert (folder / "with-wishes.toml").read_text() == (folder / "by-file.toml").read_text()
    assert all(words.removeprefix("✓ ") in told for words in found)


@pytest.mark.campaign
def test_what_is_out_of_reach_is_told_with_the_miss(page, running):
    page.locator("summary", has_text="Bounds, clamp, turn").click()
    typed(page, "axis.x", "345.5876")
    typed(page, "axis.y", "355.1393")
    typed(page, "wishes.carrier-1", "20")
    typed(page, "gears.arms", "8")
    solved(page)
    expect(page.locator("#wished h2")).to_have_text("Wishes as drawn: 1 of 1 missed")
    (drawn,) = wishes(page)
    assert re.search("^✕ length of the carrier .* mm, required at most 20.0000 mm, missed by ", drawn)
    page.get_by_role("button", name="Make the machine").click()
    dialog = page.locator("#dialog")
    expect(dialog).to_contain_text("Wishes: 1 of 1 missed", timeout=60_000)
    expect(dialog.locator("li")).to_contain_text("missed by")
    # Eight arms have no room next to each other.
    expect(dialog.locator('[data-rule="gears-collide"]')).to_contain_text(re.compile("overlap by .* at an input of"))
    page.keyboard.press("Escape")


def test_a_value_at_fault_is_not_passed_over(page, running):
    make = page.locator("#make")
    expect(make).to_be_enabled()
    typed(page, "gears.bend_deg", "500")
    expect(page.locator('[id="remark-gears.bend_deg"]')).to_contain_text("a number from -170 to 170, not 500")
    expect(make).to_be_disabled()
    for place in [page.locator("#amiss"), make]:
        words = place.text_content() if place is not make else place.get_attribute("title")
        assert "Gears · Bend: a number from -170 to 170, not 500" in words
    # Nor by what the program answers afterwards.
    page.wait_for_timeout(300)
    expect(make).to_be_disabled()
    assert saved(page, running.folder).count("bend_deg = 40") == 1
    typed(page, "gears.bend_deg", "45")
    solved(page)
    expect(make).to_be_enabled()
    expect(page.locator("#amiss")).to_be_hidden()
    assert make.get_attribute("title") == "Sound teeth are searched, and the design is opened"


def test_a_turn_goes_with_its_point_and_needs_both(page, running):
    page.locator("summary", has_text="Bounds, clamp, turn").click()
    make, amiss = page.locator("#make"), page.locator("#amiss")
    typed(page, "wishes.turn.from", "2")
    expect(page.locator('[id="remark-wishes.turn.to"]')).to_contain_text("give both, or neither")
    expect(make).to_be_disabled()
    typed(page, "wishes.turn.to", "6")
    expect(amiss).to_contain_text("no turn is given")
    typed(page, "wishes.turn.between_deg-1", "170")
    solved(page)
    expect(amiss).to_be_hidden()
    turn = {"from": 2, "to": 6, "between_deg": [0.0, 170.0]}
    assert tomllib.loads(saved(page, running.folder))["wishes"]["turn"] == turn
    # Another point is deleted: the wish keeps its own.
    handle(page, "point 4 of the path").focus()
    page.keyboard.press("Delete")
    counted(page, 12)
    expect(field(page, "wishes.turn.to")).to_have_value("5")
    expect(page.locator('#notices [data-key="turn"]')).to_have_count(0)
    handle(page, "point 5 of the path").focus()
    page.keyboard.press("Delete")
    counted(page, 11)
    notice = page.locator('#notices [data-key="turn"]')
    expect(notice).to_contain_text("With point 5 its wish for a turn of the carrier")
    expect(field(page, "wishes.turn.from")).to_have_value("")
    assert "wishes" not in tomllib.loads(saved(page, running.folder))
    page.get_by_role("button", name="Undo").click()
    counted(page, 12)
    expect(field(page, "wishes.turn.to")).to_have_value("5")
    # What is taken away from one end stays at the other.
    field(page, "wishes.turn.to").fill("")
    field(page, "wishes.turn.to").press("Enter")
    expect(field(page, "wishes.turn.from")).to_have_value("2")
    expect(make).to_be_disabled()


def test_the_axis_is_sought_within_a_box(page, running):
    expect(field(page, "axis.within_x")).to_have_count(0)
    field(page, "axis.sought").check()
    solved(page)
    for key, value in [("x", "200"), ("x-1", "300"), ("y", "120")]:
        typed(page, f"axis.within_{key}", value)
    expect(page.locator('[id="remark-axis.within_y"]')).to_contain_text("four numbers")
    expect(page.locator("#make")).to_be_disabled()
    typed(page, "axis.within_y-1", "200")
    solved(page)
    expect(page.locator("#make")).to_be_enabled()
    text = saved(page, running.folder)
    design = tomllib.loads(text)
    assert "axis" not in design
    assert design["axis_box"] == [[200.0, 120.0], [300.0, 200.0]]
    page.get_by_role("button", name="Find the machine").click()
    expect(page.locator("#possible h2")).to_contain_text("A machine is found", timeout=60_000)
    (running.folder / "boxed.toml").write_text(text.replace("200.0]", "210.0]"))
    page.locator("#path-file").set_input_files(running.folder / "boxed.toml")
    expect(field(page, "axis.within_y-1")).to_have_value("210")
    assert tomllib.loads(saved(page, running.folder))["axis_box"] == [[200.0, 120.0], [300.0, 210.0]]


def test_the_machine_found_stays_though_figures_of_the_path_come_late(page, running):
    held = []

    def hold(route):
        if route.request.post_data_json.get("others"):
            held.append(route)
        else:
            route.continue_()

    page.route("**/path/solve", hold)
    field(page, "axis.sought").check()
    solved(page)
    expect(page.locator("#possible h2")).to_contain_text("This axis is possible")
    for _ in range(1000):
        if held:
            break
        page.wait_for_timeout(10)
    page.get_by_role("button", name="Find the machine").click()
    expect(page.locator("#verdict[aria-busy=true]")).to_be_attached()
    expect(page.locator("#possible h2")).to_contain_text("A machine is found", timeout=60_000)
    for route in held:
        route.fulfill(json={"picture": None, "curves": [], "figures": [], "goals": [], "findings": []})
    page.unroute("**/path/solve")
    page.wait_for_timeout(300)
    expect(page.locator("#possible h2")).to_contain_text("A machine is found")
    solved(page)


def test_columns_of_a_file_become_bands_and_directions(page, running):
    rows = ["x,y,tolerance,direction_deg,direction_tolerance_deg"]
    rows += [f"{x},{y},{i % 3},{40 if i == 4 else ''},{3.5 if i == 4 else ''}" for i, (x, y) in enumerate(EXAMPLE)]
    (running.folder / "bands.csv").write_text("\n".join(rows) + "\n")
    page.locator("#path-file").set_input_files(running.folder / "bands.csv")
    expect(page.locator('#notices [data-key="path"]')).to_contain_text("13 points, each with a tolerance, 1 direction")
    solved(page)
    assert column(page, 2) == [str(i % 3) for i in range(13)]
    assert [column(page, k)[4] for k in (3, 4)] == ["40", "3.5"]
    expect(field(page, "gears.band")).to_have_count(0)
    design = tomllib.loads(saved(page, running.folder))
    assert design["path"]["tolerance"] == [float(i % 3) for i in range(13)]
    assert design["wishes"] == {"directions": [{"point": 5, "direction_deg": 40.0, "tolerance_deg": 3.5}]}
    assert saved(page, running.folder, "Points as CSV") == "\n".join(rows) + "\n"


def test_poses_of_a_file_may_have_no_machine(page, running):
    field(page, "wanted.given").select_option("poses")
    notice = page.locator('#notices [data-key="path"]')
    for text, words in [
        ("0,0\n1,1\n", "line 1: a pose has three numbers"),
        ("0,0,north\n1,1,5\n", "line 1: north is no number"),
    ]:
        (running.folder / "bad.csv").write_text(text)
        page.locator("#path-file").set_input_files(running.folder / "bad.csv")
        expect(notice).to_contain_text(words)
    (running.folder / "two.csv").write_text("x,y,direction_deg\n0,0,0\n100,0,10\n")
    page.locator("#path-file").set_input_files(running.folder / "two.csv")
    counted(page, 2)
    page.get_by_role("button", name="Find the machine").click()
    expect(page.locator("#possible")).to_contain_text("2 key poses are given; there must be 3 to 7")
    expect(page.locator("#make")).to_be_disabled()


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"path": {"points": EXAMPLE[:3]}}, "the path has 3 points; a closed curve takes at least 4"),
        ({"path": {"points": [[0, 0], [0, 0], [10, 0], [10, 10]]}}, "points 1 and 2 of the path are both (0, 0) mm"),
        ({"path": {"points": [[1e10, 0], [0, 0], [10, 0], [10, 10]]}}, "coordinates may be up to"),
        ({"path": {"file": "path.csv"}}, "path.file: the points are in path.csv"),
        ({"bend_deg": 175}, "the bend must be at most 170"),
        ({"arms": 4000000000}, "arms: must be 1 to 12, not 4000000000"),
        ({"split": "one-pair"}, "the planet must lag by 0.611111 turns, 11/18"),
        ({"axis": [1e12, 0]}, "must be two finite numbers within"),
        ({"wishes": {"turn": {"from": 1, "to": 14, "between_deg": [0, 9]}}}, "wishes.turn.to: must be 1 to 13, not 14"),
        ({"wishes": {"keep_out": {"arm": {"below": 0}}}}, "wishes.keep_out.arm"),
    ],
    ids=["few", "twice", "far", "file", "bend", "arms", "resonance", "axis", "turn", "name"],
)
def test_a_wish_that_cannot_be_met_is_told(running, change, words):
    wish = {"design": DESIGN | change}
    status, answer = running.json("POST", "path/solve", wish)
    assert status == 200
    assert words in answer["fault"]["message"]
    assert words in answered(running, "path/machine", wish)[0]["refused"]


def test_strangers_and_nonsense_are_refused(running):
    for path in ("solve", "find", "map", "axis", "open", "machine", "design"):
        for headers in ({"Host": "example.org"}, {"Origin": "http://example.org"}, {"Origin": None}):
            assert running.ask("POST", f"path/{path}", WISH, headers)[0] == 403
        assert running.ask("POST", f"path/{path}", {"points": [["NaN", 0]]})[0] == 422
        assert running.ask("POST", f"path/{path}", b"", {"Content-Length": str(5 << 20)})[0] == 413
    assert running.ask("GET", f"/{'0' * 32}/path", absolute=True)[0] == 403
    wide = {"points": EXAMPLE, "bend_deg": 40, "count": 100_000}
    refused = running.json("POST", "path/map", wide)[1]["refused"]
    assert refused == "a map must have 2 to 200 axes per side, not 100000"


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_the_page_is_for_everybody(browser, running, scheme):
    with shown(browser, f"{running.url}path", ready=solved, color_scheme=scheme) as page:
        for width, tabs in {1440: [None], 1024: ["Machine"], 390: ["Path", "Curves", "Machine"]}.items():
            page.set_viewport_size({"width": width, "height": 900})
            for tab in tabs:
                if tab:
                    page.get_by_role("tab", name=tab, exact=True).click()
                found = Axe().run(page).response["violations"]
                assert not [(rule["id"], [node["target"] for node in rule["nodes"]]) for rule in found]
                assert page.evaluate("document.documentElement.scrollWidth") <= width
        page.get_by_role("tab", name="Path", exact=True).click()
        field(page, "wanted.given").select_option("poses")
        counted(page, 4)
        assert not Axe().run(page).response["violations"]


def test_a_finger_drags_a_point(browser, running):
    with shown(browser, f"{running.url}path", ready=solved, size=(390, 844), has_touch=True, is_mobile=True) as page:
        x, y = middle(page, "point 10 of the path")
        touch = page.context.new_cdp_session(page)
        for kind, places in [("Start", [(x, y)]), ("Move", [(x - 6, y)]), ("Move", [(x - 12, y)]), ("End", [])]:
            points = [{"x": u, "y": v} for u, v in places]
            touch.send("Input.dispatchTouchEvent", {"type": f"touch{kind}", "touchPoints": points})
        solved(page)
        page.get_by_role("tab", name="Path", exact=True).click()
        assert rows(page)[9][0] < -10
        assert rows(page)[:9] == EXAMPLE[:9]
