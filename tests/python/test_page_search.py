"""Slow answers and searches on the design page: what they may change, and what they leave behind."""

import pytest
from page import ARMS, POINTS, SLOW, field, opened, settled, shown, until
from playwright.sync_api import expect
from studio import studio


def goals(page):
    return page.locator(".goal b").all_text_contents()


def searched(page, before):
    """A search that has found something better, still under way."""
    if page.locator("#search").is_hidden():
        page.locator("#optimise").click()
    page.locator("#search-method").select_option("de")
    page.locator("#search-evaluations").fill("100000000")
    page.locator("#search-evaluations").press("Enter")
    expect(page.locator(".goal b").nth(6)).not_to_have_text(before[6], timeout=60_000)


def test_the_first_checks_are_announced(browser, tmp_path):
    copy = tmp_path / ARMS.name
    copy.write_text(ARMS.read_text())
    with studio(copy) as running:
        context = browser.new_context(viewport={"width": 1440, "height": 900})
        page = context.new_page()
        # Even before the page's own script has run.
        page.route("**/main.js", lambda route: route.abort())
        page.goto(running.url)
        expect(page.locator("#verdict")).to_contain_text("Checking …")
        context.close()
        with shown(browser, running.url) as page:
            settled(page)
            expect(page.locator("#verdict")).not_to_contain_text("Checking")


def test_goals_of_a_dropped_search_go_with_it(arms):
    page, _ = arms
    before = goals(page)
    searched(page, before)
    page.locator("#search-stop").click()
    expect(page.locator("#search-drop")).to_be_visible(timeout=60_000)
    # All that is ever to be seen from the press of the button on.
    page.evaluate(
        """() => {
          const told = () => [...document.querySelectorAll(".goal b")].map(goal => goal.textContent);
          document.getElementById("search-drop").click();
          window.seen = [told()];
          const look = () => { window.seen.push(told()); requestAnimationFrame(look); };
          requestAnimationFrame(look);
        }"""
    )
    settled(page)
    assert goals(page) == before
    assert all(seen in ([], before) for seen in page.evaluate("window.seen"))
    expect(page.locator("#search .uplot")).to_be_hidden()
    expect(page.locator("#search [role=status]")).to_be_empty()


def test_a_design_that_comes_ends_the_search_for_the_old_one(arms):
    page, design = arms
    before = goals(page)
    searched(page, before)
    design.write_text(ARMS.read_text().replace("tip_distance = 145", "tip_distance = 146"))
    page.get_by_role("button", name="Load the file").click()
    expect(page.locator("#search-start")).to_be_visible()
    expect(page.locator("#form")).not_to_have_attribute("inert", "")
    expect(field(page, "arm.tip_distance")).to_have_value("146")
    settled(page)
    # The program has forgotten it, too.
    page.reload()
    settled(page)
    expect(page.locator("#search")).to_be_hidden()


@pytest.mark.campaign
def test_the_end_of_a_search_that_is_heard_late_leaves_the_next_one(arms):
    page, _ = arms
    searched(page, goals(page))
    page.locator("#search-stop").click()
    expect(page.locator("#search-drop")).to_be_visible(timeout=60_000)
    held = []
    page.route("**/search", lambda route: held.append(route) if route.request.method == "DELETE" else route.continue_())
    page.locator("#search-drop").click()
    page.locator("#search-evaluations").fill("100000000")
    page.locator("#search-evaluations").press("Enter")
    page.wait_for_timeout(500)
    assert held
    for route in held:
        route.continue_()
    page.unroute("**/search")
    # It goes on, generation by generation.
    done = "minimum => parseInt(document.querySelector('#search [role=status]').textContent) > minimum"
    for _ in range(3):
        told = page.locator("#search [role=status]").inner_text()
        until(page, done, int(told.split()[0]) if told else 0, 30_000)


def test_a_search_of_no_evaluations_is_refused_in_words(arms):
    page, _ = arms
    page.locator("#optimise").click()
    page.locator("#search-evaluations").fill("0")
    page.locator("#search-start").click()
    status = page.locator("#search [role=status]")
    expect(status).to_have_text("a search needs at least 1 evaluation; evaluations is 0")
    expect(page.locator("#search-start")).to_be_visible()


def test_a_value_given_since_is_not_put_back_by_a_slow_answer(browser, tmp_path):
    copy = tmp_path / POINTS.name
    copy.write_text(POINTS.read_text())
    with studio(copy) as running, shown(browser, running.url, script=SLOW) as page:
        page.evaluate("window.late = 700")
        backlash, split, tip = (
            field(page, f"teeth.{key}") for key in ["backlash", "thickness_split", "minimum_tip_width_coefficient"]
        )
        addendum = field(page, "teeth.addendum")
        backlash.fill("0.07")
        backlash.press("Tab")
        split.fill("0.51")
        split.press("Tab")
        addendum.select_option("full")
        tip.focus()
        tip.press("ArrowUp")
        stepped = tip.input_value()
        page.evaluate(
            """() => {
              window.seen = [];
              const look = () => {
                const value = (key) => document.getElementById(`field-teeth.${key}`).value;
                window.seen.push(["thickness_split", "addendum", "minimum_tip_width_coefficient"].map(value).join(" "));
                requestAnimationFrame(look);
              };
              look();
            }"""
        )
        page.wait_for_timeout(3_000)
        settled(page)
        assert set(page.evaluate("window.seen")) == {f"0.51 full {stepped}"}
        page.evaluate("window.late = 0")
        expect(page.locator("#undo")).to_be_enabled()
        page.locator("#reset").click()
        expect(split).to_have_value("0.5")
        expect(addendum).to_have_value("fitted")


def test_what_is_typed_outlives_another_kind(browser, tmp_path):
    copy = tmp_path / POINTS.name
    copy.write_text(POINTS.read_text())
    with studio(copy) as running, shown(browser, running.url, script=SLOW) as page:
        page.evaluate("window.late = 700")
        field(page, "pitch.kind").select_option("circle")
        split = field(page, "teeth.thickness_split")
        split.focus()
        page.keyboard.press("Control+a")
        split.press_sequentially("0.5", delay=30)
        expect(page.locator('[id="field-pitch.degree"]')).to_have_count(0)
        expect(split).to_be_focused()
        split.press_sequentially("12")
        expect(split).to_have_value("0.512")
        split.press("Tab")
        page.evaluate("window.late = 0")
        expect(page.locator("#undo")).to_be_enabled()
        settled(page)
        expect(split).to_have_value("0.512")
        page.keyboard.press("Control+s")
        expect(page.locator("#save")).to_be_disabled()
        assert "thickness_split = 0.512" in copy.read_text()


def test_every_pitch_curve_of_the_list_gives_a_picture(browser, tmp_path):
    with opened(browser, tmp_path, POINTS) as (page, _):
        kind = field(page, "pitch.kind")
        words = kind.locator("option").evaluate_all("all => all.map(option => option.value)")
        assert len(words) > 8
        for word in [*words, "bspline"]:
            with page.expect_response("**/solve"):
                kind.select_option(word)
            settled(page)
            expect(page.locator("#findings")).not_to_contain_text("No mechanism")
            expect(kind).to_have_value(word)
