"""Work on the design page by quick hands: nothing given is lost, nothing shown is old."""

import json
import re

import pytest
from page import ARMS, BOX, CIRCLE, FEEDER, POINTS, drawing, field, figures, opened, settled, shown, until
from playwright.sync_api import expect
from studio import studio


def test_what_is_being_typed_is_not_touched_by_answers(arms):
    page, _ = arms
    field(page, "arm.tip_distance").fill("146")
    field(page, "arm.tip_distance").press("Tab")
    offset = field(page, "arm.pusher_offset")
    offset.focus()
    page.keyboard.press("Control+a")
    # The picture and then the checks of the first change arrive meanwhile.
    offset.press_sequentially("67.125", delay=400)
    offset.press("Enter")
    expect(page.locator("#file")).to_contain_text("not saved")
    page.keyboard.press("Control+s")
    expect(page.locator("#file")).not_to_contain_text("not saved")
    expect(offset).to_have_value("67.125")
    expect(field(page, "arm.tip_distance")).to_have_value("146")


def test_an_arrow_key_held_takes_every_step(points):
    page, _ = points
    backlash = field(page, "teeth.backlash")
    backlash.focus()
    for _ in range(30):
        page.keyboard.press("ArrowUp")
        page.wait_for_timeout(15)
    settled(page)
    step = 0.0001
    expect(backlash).to_have_value(f"{0.05 + 30 * step:g}")
    for _ in range(30):
        page.keyboard.press("ArrowDown")
    expect(backlash).to_have_value("0.05")


def test_a_step_keeps_the_digits_of_a_number(points):
    page, _ = points
    backlash = field(page, "teeth.backlash")
    backlash.fill("0.0503125")
    backlash.press("Enter")
    for key, value in [("ArrowUp", "0.0513125"), ("Shift+ArrowUp", "0.0613125"), ("Alt+ArrowDown", "0.0612125")]:
        backlash.press(key)
        expect(backlash).to_have_value(value)


def test_a_number_just_typed_is_saved(points):
    page, design = points
    backlash = field(page, "teeth.backlash")
    backlash.fill("0.06")
    with page.expect_response("**/save"):
        page.keyboard.press("Control+s")
    assert "backlash = 0.06" in design.read_text()
    expect(page.locator("#save")).to_be_disabled()


def test_undo_and_redo_held_take_every_step(points):
    page, _ = points
    backlash = field(page, "teeth.backlash")
    values = [f"{0.06 + 0.01 * step:.2f}" for step in range(8)]
    for value in values:
        backlash.fill(value)
        backlash.press("Enter")
        expect(page.locator("#stage")).to_be_visible()
        page.wait_for_timeout(150)
    settled(page)
    page.locator("#stage").focus()
    for _ in range(5):
        page.keyboard.press("Control+z")
        page.wait_for_timeout(20)
    expect(backlash).to_have_value("0.08")
    for _ in range(5):
        page.keyboard.press("Control+Shift+z")
        page.wait_for_timeout(20)
    expect(backlash).to_have_value(re.compile(r"0\.130?"))
    for _ in range(20):
        page.keyboard.press("Control+z")
    expect(backlash).to_have_value("0.05")
    expect(page.locator("#undo")).to_be_disabled()
    expect(page.locator("#redo")).to_be_enabled()


@pytest.mark.parametrize(
    ("design", "key", "value"),
    [
        (CIRCLE, "tool.pressure_angle_deg", "21"),
        (BOX, "gears.tool.addendum_coefficient", "0.9"),
        (BOX, "shaft.body.keyway.width", "4"),
    ],
    ids=lambda value: getattr(value, "stem", value),
)
def test_a_number_of_a_table_that_is_not_in_the_file_can_be_changed(browser, tmp_path, design, key, value):
    with opened(browser, tmp_path, design) as (page, copy):
        page.locator("details.table").evaluate_all("all => all.forEach(one => { one.open = true; })")
        field(page, key).fill(value)
        field(page, key).press("Enter")
        expect(page.locator("#file")).to_contain_text("not saved")
        settled(page)
        expect(field(page, key)).to_have_value(value)
        expect(page.locator("#findings")).not_to_contain_text("No mechanism")
        page.keyboard.press("Control+s")
        expect(page.locator("#save")).to_be_disabled()
        saved = iter(copy.read_text().splitlines())
        assert all(line in saved for line in design.read_text().splitlines()), "every line stays, in order"


def test_two_windows_do_not_overwrite_each_other(browser, tmp_path):
    copy = tmp_path / POINTS.name
    copy.write_text(POINTS.read_text())
    with studio(copy) as running, shown(browser, running.url) as one, shown(browser, running.url) as two:
        for page, value in [(one, "0.07"), (two, "0.09")]:
            field(page, "teeth.backlash").fill(value)
            field(page, "teeth.backlash").press("Enter")
            expect(page.locator("#file")).to_contain_text("not saved")
        one.keyboard.press("Control+s")
        expect(one.locator("#save")).to_be_disabled()
        expect(two.locator("#notices")).to_contain_text("has been changed on disk")
        two.keyboard.press("Control+s")
        expect(two.locator("#dialog")).to_contain_text("Changed on disk")
        two.get_by_role("button", name="Cancel").click()
        assert "backlash = 0.07" in copy.read_text()
        two.wait_for_timeout(500)
        assert "backlash = 0.09" in copy.with_name(f"{copy.name}.autosave").read_text()


def test_recovered_work_survives_the_next_edit(points):
    page, design = points
    left = design.with_name(f"{design.name}.autosave")
    left.write_text(POINTS.read_text() + "# lost\n")
    page.reload()
    expect(page.locator("#notices")).to_contain_text("not saved")
    field(page, "teeth.backlash").fill("0.07")
    field(page, "teeth.backlash").press("Enter")
    expect(page.locator("#file")).to_contain_text("not saved")
    page.wait_for_timeout(500)
    kept = [path.read_text() for path in design.parent.glob("*.autosave*")]
    assert sorted("# lost" in text for text in kept) == [False, True]
    page.reload()
    expect(page.get_by_role("button", name="Restore")).to_have_count(2)


def test_a_file_that_is_gone_is_told_and_written_anew(points):
    page, design = points
    design.unlink()
    expect(page.locator("#notices")).to_contain_text("has been deleted or moved")
    field(page, "teeth.backlash").fill("0.07")
    page.keyboard.press("Control+s")
    expect(page.locator("#dialog")).to_contain_text("deleted")
    page.locator("#dialog").get_by_role("button", name="Save").click()
    expect(page.locator("#save")).to_be_disabled()
    assert "backlash = 0.07" in design.read_text()


def test_an_error_goes_with_the_number_that_caused_it(arms):
    page, _ = arms
    tip = field(page, "arm.tip_distance")
    tip.fill("-5")
    tip.press("Enter")
    expect(page.locator("#findings")).to_contain_text("No mechanism")
    expect(page.locator('[id="remark-arm.tip_distance"]')).to_contain_text("greater than 0")
    page.keyboard.press("Control+z")
    # As soon as there is a picture, not only when it has been checked.
    until(page, "document.querySelector('#verdict').classList.contains('stale')")
    expect(page.locator("#findings")).not_to_contain_text("No mechanism", timeout=1_000)
    expect(page.locator('[id="remark-arm.tip_distance"]')).to_be_empty(timeout=1_000)
    settled(page)


def test_a_design_pinned_before_its_checks_is_compared_all_the_same(arms):
    page, _ = arms
    tip = field(page, "arm.tip_distance")
    tip.fill("146")
    tip.press("Enter")
    page.locator("#pin").click()
    settled(page)
    tip.fill("147")
    tip.press("Enter")
    settled(page)
    expect(page.locator("#figures .before").first).to_be_visible()
    expect(page.locator("#goals")).to_contain_text("(was ")


def test_goals_follow_the_search(arms):
    page, _ = arms
    goal = page.locator('.goal[data-goal="clamp_at_picking"] b, .goal b').nth(6)
    before = goal.text_content()
    page.locator("#optimise").click()
    page.locator("#search-method").select_option("de")
    page.locator("#search-evaluations").fill("100000000")
    page.locator("#search-evaluations").press("Enter")
    expect(goal).not_to_have_text(before, timeout=30_000)
    assert page.locator("#search-stop").is_visible(), "the search is still under way"
    page.locator("#search-stop").click()
    expect(page.locator("#search [role=status]")).to_contain_text("stopped")
    # A page loaded anew finds what was neither taken nor dropped.
    page.reload()
    page.locator("#search-take").click()
    expect(page.locator("#file")).to_contain_text("not saved")
    page.reload()
    settled(page)
    assert page.locator("#search-take").is_hidden()


def test_an_answer_asked_for_twice_is_drawn_once(browser, tmp_path):
    with opened(browser, tmp_path, FEEDER) as (page, _):
        page.locator("#response").click()
        page.locator("#response-key").select_option("linkage.crank")
        for _ in range(2):
            page.locator("#response-to").press("Enter")
        status = page.locator("#dialog [role=status]")
        expect(status).to_contain_text("linkage.crank, mm", timeout=60_000)
        page.wait_for_timeout(1_000)
        goals = page.locator(".goal").count()
        expect(page.locator(".multiples .chart canvas")).to_have_count(goals)


def test_the_enter_key_exports(points):
    page, _ = points
    page.locator("#export").click()
    expect(page.locator("#export-tolerance")).to_be_visible()
    for box in page.locator("fieldset").first.locator("input").all():
        box.set_checked(box.get_attribute("value") == "csv")
    with page.expect_download():
        page.locator("#export-tolerance").press("Enter")
    page.locator("#export").click()
    expect(page.locator("#export-tolerance")).to_be_visible()
    for box in page.locator("fieldset").first.locator("input").all():
        box.uncheck()
    page.locator("#export-tolerance").press("Enter")
    expect(page.locator("#notices")).to_contain_text("nothing to export")


@pytest.mark.parametrize("size", [(1920, 1000), (390, 844)], ids=str)
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_on_paper_the_drawing_keeps_its_shape_dark_on_light(browser, tmp_path, size, scheme):
    with opened(browser, tmp_path, CIRCLE, color_scheme=scheme) as (page, _):
        page.set_viewport_size({"width": size[0], "height": size[1]})
        shape = "({ width, height }) => width / height"
        stage = page.locator("#stage canvas")
        # The canvas follows the window a little later.
        before, on_screen = None, stage.evaluate(f"canvas => ({shape})(canvas.getBoundingClientRect())")
        while on_screen != before:
            page.wait_for_timeout(300)
            before, on_screen = on_screen, stage.evaluate(f"canvas => ({shape})(canvas.getBoundingClientRect())")
        page.evaluate("dispatchEvent(new Event('beforeprint'))")
        page.emulate_media(media="print")
        box = stage.evaluate(f"canvas => ({shape})(canvas.getBoundingClientRect())")
        own = stage.evaluate(f"canvas => ({shape})(canvas)")
        assert abs(box / own - 1) < 0.02
        assert abs(own / on_screen - 1) < 0.02
        ink = page.evaluate("getComputedStyle(document.documentElement).getPropertyValue('--ink')")
        assert ink.strip() == "#000"
        # What is drawn on the canvas has the colours of paper, too.
        darkest = stage.evaluate(
            """canvas => {
              const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
              let minimum = 255, filled = 0, light = 0;
              for (let i = 0; i < data.length; i += 4) if (data[i + 3] === 255) {
                filled += 1;
                if (data[i + 1] > 180) light += 1;
                minimum = Math.min(minimum, data[i + 1]);
              }
              return [minimum, light / filled];
            }"""
        )
        assert darkest[0] < 80
        assert darkest[1] > 0.6
        page.evaluate("dispatchEvent(new Event('afterprint'))")
        page.emulate_media(media="screen")
        ground = page.evaluate("getComputedStyle(document.body).backgroundColor")
        dark = max(json.loads(ground.replace("rgb(", "[").replace(")", "]"))) < 60
        assert dark == (scheme == "dark")


def test_a_program_that_is_gone_is_told_once(browser, tmp_path):
    copy = tmp_path / POINTS.name
    copy.write_text(POINTS.read_text())
    with studio(copy) as running:
        context = browser.new_context(viewport={"width": 1440, "height": 900})
        page = context.new_page()
        page.goto(running.url)
        settled(page)
        picture, told = drawing(page), figures(page)
        running.process.kill()
        running.process.wait(timeout=10)
        # Before anybody asks anything of it.
        expect(page.locator("#notices")).to_contain_text("does not answer", timeout=10_000)
        field(page, "teeth.backlash").fill("0.07")
        page.keyboard.press("Control+s")
        page.wait_for_timeout(800)
        expect(page.locator(".notice")).to_have_count(1)
        assert (drawing(page), figures(page)) == (picture, told)
        expect(field(page, "teeth.backlash")).to_have_value("0.07")
        context.close()


def test_a_heavy_design_is_drawn_with_its_teeth_before_it_is_checked(browser, tmp_path):
    with opened(browser, tmp_path, ARMS) as (page, _):
        depths = []
        page.on(
            "request",
            lambda request: depths.append(request.post_data_json["depth"]) if request.url.endswith("/solve") else None,
        )
        field(page, "arm.tip_distance").fill("146")
        field(page, "arm.tip_distance").press("Enter")
        expect(page.locator("#verdict")).to_have_class(re.compile("stale"))
        settled(page)
        assert depths == ["picture", "goals", "detail", "checks"]


def slowly(page):
    """Gives a number that takes minutes to solve."""
    field(page, "pitch.tooth_count").fill("10000")
    field(page, "pitch.tooth_count").press("Enter")


def test_a_slow_number_shows_that_it_works_and_can_be_cancelled(browser, tmp_path):
    with opened(browser, tmp_path, CIRCLE) as (page, design):
        expect(page.locator("#working")).to_be_hidden()
        slowly(page)
        expect(page.locator("#working [role=status]")).to_contain_text("working", timeout=5_000)
        expect(page.locator("#working-time")).to_have_text("2 s", timeout=10_000)
        page.get_by_role("button", name="Cancel").click()
        expect(page.locator("#working")).to_be_hidden(timeout=2_000)
        expect(page.locator("#findings")).to_contain_text("cancelled")
        # The number stands, can be saved as it is, and is changed as any other.
        expect(field(page, "pitch.tooth_count")).to_have_value("10000")
        page.keyboard.press("Control+s")
        expect(page.locator("#save")).to_be_disabled()
        assert "tooth_count = 10000" in design.read_text()
        field(page, "pitch.tooth_count").fill("24")
        field(page, "pitch.tooth_count").press("Enter")
        settled(page)
        expect(page.locator("#findings")).not_to_contain_text("cancelled")


def test_a_later_change_does_not_wait_for_a_slow_one(browser, tmp_path):
    with opened(browser, tmp_path, CIRCLE) as (page, _):
        slowly(page)
        page.wait_for_timeout(500)
        field(page, "teeth.backlash").fill("0.03")
        field(page, "teeth.backlash").press("Enter")
        page.wait_for_timeout(500)
        page.locator("#stage").focus()
        for _ in range(2):
            page.keyboard.press("Control+z")
        expect(field(page, "pitch.tooth_count")).to_have_value("24")
        expect(field(page, "teeth.backlash")).to_have_value("0.05")
        settled(page)
        expect(page.locator("#undo")).to_be_disabled()
        slowly(page)
        page.wait_for_timeout(300)
        field(page, "pitch.tooth_count").fill("26")
        field(page, "pitch.tooth_count").press("Enter")
        told = page.locator('#figures td[data-key="driver_tooth_count"]')
        expect(told).to_have_attribute("data-exact", "26.0", timeout=30_000)
        expect(field(page, "pitch.tooth_count")).to_have_value("26")


def test_a_page_whose_file_is_slow_can_be_worked_on(browser, tmp_path):
    slow = tmp_path / "slow.toml"
    slow.write_text(re.sub(r"tooth_count = \d+", "tooth_count = 10000", CIRCLE.read_text()))
    with studio(slow) as running:
        context = browser.new_context(viewport={"width": 1440, "height": 900})
        page = context.new_page()
        page.goto(running.url)
        page.get_by_role("button", name="Cancel").click(timeout=10_000)
        field(page, "pitch.tooth_count").fill("24")
        field(page, "pitch.tooth_count").press("Enter")
        settled(page)
        expect(page.locator("#findings")).not_to_contain_text("cancelled")
        context.close()


# While `window.hold` is set, an answer of the solver stops after its picture: until `window.release(true)`, or for good
# by `window.release(false)`.
HALVED = """
const ask = window.fetch;
window.fetch = async (path, ...rest) => {
  const answer = await ask(path, ...rest);
  if (!window.hold || !String(path).endsWith("solve")) return answer;
  const text = await answer.text();
  const end = text.indexOf("\\n") + 1;
  if (!end) return new Response(text);
  const [first, second] = [text.slice(0, end), text.slice(end)].map((part) => new TextEncoder().encode(part));
  return new Response(new ReadableStream({
    async start(stream) {
      stream.enqueue(first);
      const whole = await new Promise((resume) => { window.release = resume; });
      if (whole) stream.enqueue(second);
      stream.close();
    },
  }));
};
"""


def test_a_picture_is_drawn_before_its_numbers_and_curves_are_there(browser, tmp_path):
    with opened(browser, tmp_path, ARMS, script=HALVED) as (page, _):
        before, read = drawing(page), page.locator("#readout").inner_text()
        page.evaluate("window.hold = true")
        field(page, "arm.tip_distance").press("ArrowUp")
        until(page, "Boolean(window.release)")
        until(page, "before => document.querySelector('#stage canvas').toDataURL() !== before", arg=before)
        # What is not of this picture is marked; a change is one to take back once all of it is there.
        expect(page.locator("#verdict")).to_have_class(re.compile("stale"))
        expect(page.locator("#undo")).to_be_disabled()
        assert page.locator("#readout").inner_text() == read
        page.evaluate("window.hold = false; window.release(true)")
        settled(page)
        assert page.locator("#readout").inner_text() != read
        page.locator("#undo").click()
        settled(page)
        assert drawing(page) == before
        # An answer that breaks off is told, and the next one is as good as any.
        page.evaluate("window.hold = true; window.release = null")
        number = field(page, "arm.tip_distance")
        number.press("ArrowUp")
        until(page, "Boolean(window.release)")
        page.evaluate("window.hold = false; window.release(false)")
        expect(page.locator("#notices")).to_contain_text("solving this design has failed")
        number.press("ArrowUp")
        settled(page)
        assert page.locator("#readout").inner_text() != read


def test_an_edit_leaves_the_scrubber_alone(arms):
    page, _ = arms
    page.evaluate("""() => {
      window.written = 0;
      const watch = new MutationObserver((changes) => { window.written += changes.length; });
      for (const id of ["angle", "scrub"]) {
        watch.observe(document.getElementById(id), { attributes: true, childList: true, characterData: true });
      }
    }""")
    for key in ("ArrowUp", "ArrowDown"):
        before = drawing(page)
        field(page, "arm.tip_distance").press(key)
        until(page, "before => document.querySelector('#stage canvas').toDataURL() !== before", before)
    settled(page)
    assert page.evaluate("window.written") == 0
    page.locator("#scrub").press("PageUp")
    expect(page.locator("#angle")).to_have_text("10.0°")
    expect(page.locator("#scrub")).to_have_attribute("aria-valuetext", "10.0°")
    assert page.evaluate("window.written") > 0
