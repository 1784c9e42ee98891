"""The design page in a real browser."""

import json
import re
import zipfile

import pytest
from axe_playwright_python.sync_playwright import Axe
from conftest import centrode
from page import ARMS, BOX, FEEDER, INDEX, POINTS, SHAFT, SHIPPED, drag, drawing, field, figures, opened, settled, shown
from playwright.sync_api import expect
from sample import sampled
from studio import studio


@pytest.mark.parametrize("design", sampled(SHIPPED), ids=lambda path: path.stem)
def test_every_shipped_design_is_shown_with_the_figures_of_check(browser, tmp_path, design):
    copy = tmp_path / design.name
    copy.write_text(design.read_text())
    printed = centrode("check", copy, "--json", check=False).stdout
    with studio(copy) as running, shown(browser, running.url) as page:
        page.get_by_label("every digit").check()
        cells = page.locator("#figures td[data-key]")
        told = dict(cells.evaluate_all("cells => cells.map(c => [c.dataset.key, c.firstChild.data])"))
        report = json.loads(printed)
        for key in report["values"]:
            assert re.search(rf'"{key}": {re.escape(told[key])},?\n', printed), (key, told[key])
        for table in report.get("tables", []):
            for name, row in table["rows"]:
                for column, value in enumerate(row):
                    assert json.loads(told.pop(f"{table['name']}/{name}/{column}")) == value
        assert set(told) == set(report["values"])
        goals = page.locator(".goal b").evaluate_all("goals => goals.map(goal => goal.title)")
        assert [json.loads(goal or "null") for goal in goals] == [goal["value"] for goal in report.get("goals", [])]
        worst = {finding["severity"] for finding in report["findings"]} - {"note"}
        status = page.locator("#findings h2").inner_text()
        assert ("Sound" in status) == (not worst), status
        assert ("Works" in status) == (worst == {"warning"}), status
        assert len(set(drawing(page))) > 10
        assert page.locator(".chart").count() >= 5


def test_a_dragged_point_changes_numbers_and_drawing_and_can_be_undone(points):
    page, design = points
    before, picture = figures(page), drawing(page)
    drag(page, page.locator(".handle").nth(3), -2, -3)
    expect(page.locator("#undo")).to_be_enabled()
    settled(page)
    assert figures(page)["center_distance"] != before["center_distance"]
    assert drawing(page) != picture
    radius = page.locator('[id="field-pitch.radius-3"]').input_value()
    assert radius != "49"
    page.keyboard.press("Control+z")
    expect(page.locator('[id="field-pitch.radius-3"]')).to_have_value("49")
    expect(page.locator('#figures td[data-key="center_distance"]')).to_have_attribute(
        "data-exact", before["center_distance"]
    )
    page.keyboard.press("Control+Shift+z")
    expect(page.locator('[id="field-pitch.radius-3"]')).to_have_value(radius)
    expect(page.locator("#undo")).to_be_enabled()
    page.locator("#save").click()
    expect(page.locator("#save")).to_be_disabled()
    saved = design.read_text()
    assert saved.startswith(POINTS.read_text().split("radius")[0])
    assert radius in saved
    page.reload()
    expect(page.locator('[id="field-pitch.radius-3"]')).to_have_value(radius)
    assert design.read_text() == saved


def test_a_point_moves_by_arrow_keys(points):
    page, _ = points
    handle = page.get_by_role("button", name="point 1 of the pitch curve")
    handle.focus()
    page.keyboard.press("ArrowUp")
    expect(page.locator("#undo")).to_be_enabled()
    assert field(page, "pitch.radius").input_value() != "21" or field(page, "pitch.angle_deg").input_value() != "20"


@pytest.mark.parametrize(
    ("design", "name", "keys"),
    [
        pytest.param(FEEDER, "axis of the rocker", ["linkage.frame"], marks=pytest.mark.campaign),
        (FEEDER, "pivot of the effector", ["linkage.pivot", "linkage.pivot-1"]),
        (FEEDER, "end of the crank", ["linkage.crank"]),
        pytest.param(FEEDER, "middle of the coupler", ["linkage.coupler"], marks=pytest.mark.campaign),
        pytest.param(FEEDER, "middle of the rocker", ["linkage.rocker"], marks=pytest.mark.campaign),
        (FEEDER, "tip of the effector", ["linkage.effector_length"]),
        (SHAFT, "middle of the picking", ["pick_deg"]),
        (SHAFT, "end of the picking", ["window_deg"]),
        (BOX, "end of the picking", ["shaft.window_deg"]),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_joints_and_window_are_drawn_aside_by_mouse_and_keys(browser, tmp_path, design, name, keys):
    with opened(browser, tmp_path, design) as (page, copy):
        numbers = page.locator("#form input[id^=field-]")

        def written():
            return dict(numbers.evaluate_all("all => all.map(input => [input.id.slice(6), input.value])"))

        first = written()
        # Where no point lies on another.
        page.locator("#scrub").focus()
        for _ in range(8):
            page.keyboard.press("PageUp")
        handle = page.get_by_role("button", name=name)
        drag(page, handle, 3, 5)
        expect(page.locator("#undo")).to_be_enabled(timeout=30_000)
        for key in keys:
            expect(field(page, key)).not_to_have_value(first[key])
        dragged = written()
        assert {key for key in first if dragged[key] != first[key]} == set(keys)
        for key in keys:
            assert float(dragged[key]) == pytest.approx(float(first[key] or 0), abs=60)
        handle.focus()
        page.keyboard.press("ArrowDown")
        page.keyboard.press("ArrowRight")
        expect(field(page, keys[0])).not_to_have_value(dragged[keys[0]])
        assert copy.read_text() == design.read_text()


def test_the_scrubber_moves_drawing_and_curves(points):
    page, _ = points
    picture = drawing(page)
    values = page.locator(".chart output").all_inner_texts()
    page.locator("#scrub").focus()
    for _ in range(9):
        page.keyboard.press("PageUp")
    expect(page.locator("#angle")).to_have_text("90.0°")
    assert drawing(page) != picture
    assert page.locator(".chart output").all_inner_texts() != values
    chart = page.locator(".u-over").first.bounding_box()
    page.mouse.click(chart["x"] + chart["width"] / 2, chart["y"] + 20)
    expect(page.locator("#angle")).to_have_text(re.compile(r"^(179|180)\.\d°$"))
    page.locator("#stage").focus()
    page.keyboard.press("Space")
    expect(page.locator("#play")).to_have_text("Pause")
    expect(page.locator("#angle")).not_to_have_text(re.compile(r"^(179|180)\.\d°$"))
    page.keyboard.press("Space")
    expect(page.locator("#play")).to_have_text("Play")


def test_numbers_are_typed_stepped_and_dragged(points):
    page, _ = points
    backlash = field(page, "teeth.backlash")
    backlash.fill("0.08")
    backlash.press("Enter")
    expect(page.locator("#figures td[data-key=normal_backlash_max]")).not_to_have_text(re.compile(r"^0\.137\d*$"))
    backlash.press("ArrowUp")
    expect(backlash).to_have_value("0.081")
    name = page.locator("label", has_text=re.compile(r"^Thickness split$"))
    name.scroll_into_view_if_needed()
    label = name.bounding_box()
    page.mouse.move(label["x"] + 10, label["y"] + 8)
    page.mouse.down()
    page.mouse.move(label["x"] + 18, label["y"] + 8, steps=3)
    page.mouse.up()
    expect(field(page, "teeth.thickness_split")).to_have_value("0.502")
    for _ in range(3):
        page.locator("#undo").click()
    expect(field(page, "teeth.thickness_split")).to_have_value("0.5")
    expect(backlash).to_have_value("0.05")


def test_a_bad_value_shows_its_error_and_leaves_the_picture(points):
    page, design = points
    backlash = field(page, "teeth.backlash")
    backlash.fill("-1")
    backlash.press("Enter")
    remark = page.locator('[id="remark-teeth.backlash"]')
    expect(remark).to_contain_text("must not be negative, but is -1")
    expect(backlash).to_have_attribute("aria-invalid", "true")
    expect(page.locator("#findings")).to_contain_text("No mechanism")
    assert page.locator(".chart").count() >= 8
    backlash.fill("thin")
    backlash.press("Enter")
    expect(remark).to_contain_text("must be a number")
    page.locator("#undo").click()
    page.locator("#undo").click()
    expect(remark).to_be_empty()
    expect(page.locator("#findings")).to_contain_text("Works, with warnings")
    assert design.read_text() == POINTS.read_text()


def test_text_pin_and_reset(points):
    page, _ = points
    page.locator("#pin").click()
    page.locator("#source").click()
    text = page.get_by_role("textbox", name="Design file")
    text.fill(text.input_value().replace("58, 47", "57, 47"))
    page.get_by_role("button", name="Apply").click()
    expect(page.locator("#figures .before").first).to_be_visible()
    page.locator("#reset").click()
    expect(page.locator("#figures .before")).to_have_count(0)


def test_a_text_that_is_no_design_stays_in_its_dialog(points):
    page, design = points
    dialog, text = page.locator("#dialog"), page.get_by_role("textbox", name="Design file")
    page.locator("#source").click()
    design_text = text.input_value()
    for wrong, words in [
        (design_text + "= nothing\n", f"line {design_text.count(chr(10)) + 1}, column 1"),
        (design_text.replace("backlash = 0.05", "backlash = -1"), "teeth.backlash, line"),
        (design_text.replace("backlash", "backslash"), "teeth.backslash, line"),
    ]:
        text.fill(wrong)
        dialog.get_by_role("button", name="Apply").click()
        expect(dialog.locator(".error")).to_contain_text(words)
        expect(text).to_have_value(wrong)
    marked = text.evaluate("area => area.value.slice(area.selectionStart, area.selectionEnd)")
    assert marked == "backslash = 0.05"
    page.keyboard.press("Escape")
    expect(dialog).to_be_hidden()
    expect(field(page, "teeth.backlash")).to_have_value("0.05")
    page.locator("#source").click()
    expect(text).to_have_value(wrong)
    expect(dialog).to_contain_text("not been applied")
    text.fill(design_text.replace("backlash = 0.05", "backlash = 0.06"))
    dialog.get_by_role("button", name="Apply").click()
    expect(field(page, "teeth.backlash")).to_have_value("0.06")
    page.locator("#source").click()
    text.fill("given up")
    dialog.get_by_role("button", name="Cancel").click()
    page.locator("#source").click()
    expect(text).to_have_value(design_text.replace("backlash = 0.05", "backlash = 0.06"))
    assert design.read_text() == POINTS.read_text()


def test_the_export_is_a_zip(points, tmp_path):
    page, _ = points
    page.locator("#export").click()
    expect(page.locator("#export-tolerance")).to_be_visible()
    for box in page.locator("fieldset").first.locator("input").all():
        box.set_checked(box.get_attribute("value") in ("svg", "csv", "json"))
    with page.expect_download() as download:
        page.get_by_role("button", name="Export zip").click()
    path = tmp_path / "files.zip"
    download.value.save_as(path)
    with zipfile.ZipFile(path) as files:
        assert {"driver.svg", "motion.csv", "report.json"} <= set(files.namelist())
        assert json.loads(files.read("report.json"))["values"]["module"] == float(figures(page)["module"])


def searched(page):
    """A search started and stopped at its first sign of life."""
    status = page.locator("#search [role=status]")
    page.locator("#search-method").select_option("de")
    page.locator("#search-evaluations").fill("100000000")
    page.locator("#search-start").click()
    expect(status).to_contain_text(re.compile("total miss|goals reached"))
    expect(page.locator("#form")).to_have_attribute("inert", "")
    page.locator("#search-stop").click()
    expect(status).to_contain_text("stopped", timeout=20_000)


def test_a_search_is_watched_stopped_dropped_and_taken(arms):
    page, design = arms
    before = figures(page)
    page.locator("#optimise").click()
    searched(page)
    page.locator("#search-drop").click()
    expect(page.locator(f'#figures td[data-exact="{before["center_distance"]}"]').first).to_be_visible()
    expect(page.locator("#undo")).to_be_disabled()
    searched(page)
    page.locator("#search-take").click()
    expect(page.locator("#file")).to_contain_text("not saved")
    page.locator("#undo").click()
    expect(page.locator("#file")).not_to_contain_text("not saved")
    assert design.read_text() == ARMS.read_text()


def test_the_goals_answer_a_number(arms):
    page, _ = arms
    page.locator("#response").click()
    page.locator("#response-key").select_option("arm.tip_distance")
    show = page.locator("#dialog").get_by_role("button", name="Show")
    show.click()
    expect(page.locator(".multiples .chart canvas")).to_have_count(9, timeout=60_000)
    page.locator("#response-to").fill("1")
    show.click()
    expect(page.locator("#dialog [role=status]")).to_contain_text("the values must rise")


def test_a_file_changed_on_disk_is_noticed_and_lost_work_offered(points):
    page, design = points
    backlash = field(page, "teeth.backlash")
    backlash.fill("0.07")
    backlash.press("Enter")
    expect(page.locator("#file")).to_contain_text("not saved")
    design.write_text(POINTS.read_text().replace("backlash = 0.05", "backlash = 0.02"))
    expect(page.locator("#notices")).to_contain_text("has been changed on disk")
    page.locator("#save").click()
    expect(page.locator("#dialog")).to_contain_text("Changed on disk")
    page.get_by_role("button", name="Cancel").click()
    assert "backlash = 0.02" in design.read_text()
    page.reload()
    page.get_by_role("button", name="Restore").click()
    expect(backlash).to_have_value("0.07")
    page.get_by_role("button", name="Load the file").click()
    expect(backlash).to_have_value("0.02")


@pytest.mark.parametrize("scheme", sampled(["light", "dark"], of=["dark"]))
@pytest.mark.parametrize("design", [POINTS, ARMS, FEEDER, BOX, INDEX], ids=lambda path: path.stem)
def test_nothing_stands_in_the_way_of_anybody(browser, tmp_path, design, scheme):
    with opened(browser, tmp_path, design, color_scheme=scheme) as (page, _):
        found = Axe().run(page).response["violations"]
        assert not [(rule["id"], [node["target"] for node in rule["nodes"]]) for rule in found]
        page.set_viewport_size({"width": 400, "height": 800})
        assert page.evaluate("document.documentElement.scrollWidth") <= 400


def test_a_report_opens_from_its_file_alone(browser, tmp_path):
    out = tmp_path / "pair.html"
    centrode("report", POINTS, "-o", out, check=False)
    with shown(browser, out.as_uri(), offline=True) as page:
        asked = []
        page.on("request", lambda request: asked.append(request.url))
        assert figures(page)["center_distance"].startswith("82.0463")
        assert field(page, "teeth.backlash").is_disabled()
        assert page.locator("#save").is_hidden()
        picture = drawing(page)
        page.locator("#scrub").focus()
        page.keyboard.press("PageUp")
        assert drawing(page) != picture
        assert page.pdf().startswith(b"%PDF")
        found = Axe().run(page).response["violations"]
        assert not [(rule["id"], [node["target"] for node in rule["nodes"]]) for rule in found]
        assert not [url for url in asked if not url.startswith(("data:", "blob:"))]
