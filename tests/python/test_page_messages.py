"""Messages of the design page: one numbering of goals, words of the form, and details of bodies that cannot be made."""

import re

import pytest
from conftest import ROOT, centrode
from page import ARMS, BOX, CIRCLE, FEEDER, POINTS, drawing, field, opened, settled
from playwright.sync_api import expect

# More digits than a reader has use for.
LONG = re.compile(r"\d\.\d{7,}|\d{2,}\.\d{6,}")


def give(page, key, value):
    field(page, key).fill(value)
    field(page, key).press("Enter")


def test_a_goal_has_one_number_in_list_finding_and_command(arms):
    page, copy = arms
    heads = page.locator(".goal .head > span:first-child").all_text_contents()
    assert heads[-1] == "9. undercut or short full-height flanks goal 8 of the paper"
    assert [head.split(".")[0] for head in heads] == [str(number + 1) for number in range(9)]
    expect(page.locator(".findings")).to_contain_text("goal 9, undercut or short full-height flanks")
    told = centrode("check", copy, check=False).stdout
    assert "goal 9, undercut or short full-height flanks" in told
    assert re.search(r"^ +9 undercut or short full-height flanks .*; goal 8 of the paper$", told, re.M)
    assert [row.split()[0] for row in re.findall(r"^  +\d .*\[.*$", told, re.M)] == [
        str(number + 1) for number in range(9)
    ]


@pytest.mark.parametrize(
    ("key", "value", "words"),
    [
        ("pitch.module", "-1.123456789012", "must be greater than 0, not -1.12346"),
        ("pitch.module", "wide", 'must be a number, not "wide"'),
        ("pitch.tooth_count", "3.5", "must be a whole number, 0 or greater, not 3.5"),
    ],
)
def test_a_message_speaks_of_the_form_at_the_number_at_fault_alone(browser, tmp_path, key, value, words):
    with opened(browser, tmp_path, CIRCLE) as (page, _):
        give(page, key, value)
        expect(page.locator("#findings h2")).to_have_text("✕ No mechanism")
        remark = page.locator(f'[id="remark-{key}"]')
        expect(remark).to_have_text(f"error {words}")
        assert page.locator(".remark:not(:empty)").count() == 1
        assert page.locator('[aria-invalid="true"]').count() == 1
        place = "Module" if key.endswith("module") else "Tooth count"
        said = page.locator("#findings li")
        expect(said).to_have_text(f"✕ error Pitch · {place}: {words}")
        assert not re.search(r"line \d|column|f64|u32|invalid type", page.locator("body").inner_text())


@pytest.mark.parametrize(
    ("design", "key", "value", "words"),
    [
        # Serde tells of lists in its own words, and of the tables below a kind without their keys.
        (ARMS, "teeth.thickness_deviations", "-0.02", "must have 2 values, not 1"),
        (BOX, "shaft.law.harmonic", "often", 'must be a whole number, 0 or greater, not "often"'),
        (BOX, "gears.tool.pressure_angle_deg", "steep", 'must be a number, not "steep"'),
        (FEEDER, "plates.slider_length", "1.5", "must be at least 16 mm, not 1.5 mm"),
        # Solving it would be an index out of bounds.
        (BOX, "shaft.pick_deg", "1e9", "must be -36000 to 36000 deg, not 1000000000 deg"),
    ],
)
def test_a_message_has_no_word_of_the_program_and_stands_at_its_number(browser, tmp_path, design, key, value, words):
    with opened(browser, tmp_path, design) as (page, _):
        give(page, key, value)
        expect(page.locator(f'[id="remark-{key}"]')).to_have_text(f"error {words}")
        assert page.locator(".remark .error").count() == 1
        assert page.locator('[aria-invalid="true"]').count() == 1
        expect(page.locator(".notice")).to_have_count(0)
        page.locator("#undo").click()
        settled(page)
        expect(page.locator(".remark .error")).to_have_count(0)


def test_a_bore_that_does_not_fit_is_a_finding_and_the_motion_goes_on(browser, tmp_path):
    with opened(browser, tmp_path, CIRCLE) as (page, _):
        charts = page.locator(".chart").count()
        give(page, "driver.bore", "100")
        settled(page)
        expect(page.locator("#findings h2")).to_have_text("✕ Cannot be made")
        expect(page.locator("#findings li").first).to_contain_text(
            "bore of the driver reaches 52.3597 mm from the axis, but the minimum radius of its outline is 21.5 mm"
        )
        expect(page.locator("#findings li").first).to_contain_text("the figures and drawings are without driver.bore")
        expect(page.locator('[id="remark-driver.bore"]')).to_contain_text("52.3597 mm")
        assert page.locator('#form [aria-invalid="true"]').count() == 1
        assert not LONG.search(page.locator("#findings").inner_text())
        # The numbers of the motion follow, with the bore still at fault.
        still = drawing(page)
        give(page, "pitch.module", "3")
        settled(page)
        assert drawing(page) != still
        assert page.locator(".chart").count() == charts
        expect(page.locator("#charts")).not_to_have_class(re.compile("stale"))
        still = drawing(page)
        page.locator("#scrub").focus()
        page.keyboard.press("PageUp")
        assert drawing(page) != still
        give(page, "driver.bore", "14")
        settled(page)
        expect(page.locator("#findings h2")).to_have_text("✓ Sound")
        expect(page.locator('[id="remark-driver.bore"]')).to_be_empty()


@pytest.mark.parametrize(
    ("design", "key", "value"),
    [
        (ARMS, "sun.bore", "-1"),
        (ROOT / "tests" / "designs" / "feeder-2022.toml", "plates.width", "0"),
        (ROOT / "tests" / "designs" / "spiral-shaft-2018.toml", "body.journal_diameter", "-3"),
        (POINTS, "driven.keyway_angle_deg", "1000"),
    ],
    ids=lambda value: getattr(value, "stem", None),
)
def test_details_of_every_kind_of_body_leave_the_picture(browser, tmp_path, design, key, value):
    with opened(browser, tmp_path, design) as (page, _):
        give(page, key, value)
        settled(page)
        expect(page.locator("#findings h2")).to_have_text("✕ Cannot be made")
        expect(page.locator(f'[id="remark-{key}"]')).not_to_be_empty()
        expect(page.locator("#charts")).not_to_have_class(re.compile("stale"))
        assert page.locator(".chart").count() > 0


def test_symbols_of_the_paper_stand_beside_the_words(arms):
    page, _ = arms
    symbols = page.locator(".field label:has(.symbol)").all_inner_texts()
    for words in ["Carrier start φ0", "Bend \N{GREEK SMALL LETTER GAMMA}0", "Tip distance S", "Pusher offset H1"]:
        assert words in [symbol.replace("\n", "") for symbol in symbols]
    expect(page.locator(".points thead")).to_contain_text("ri")
    page.locator("#find").fill("H_1")
    expect(page.locator("#find-count")).to_contain_text("1 of")


def test_what_a_search_counts_as_missed_is_named_with_start_and_bounds(browser, tmp_path):
    with opened(browser, tmp_path, ARMS) as (page, _):
        page.locator("#optimise").click()
        page.locator("#search-method").select_option("de")
        page.locator("#search-evaluations").fill("300")
        page.locator("#search-evaluations").press("Enter")
        row = page.locator(".missed tbody tr").filter(has_text="undercut or short full-height flanks")
        expect(row.locator("td").first).to_have_text("31", timeout=60_000)
        expect(row.locator("td").last).to_have_text("at most 0")
        # Constraints that are no goals of the list are named, too, with their units.
        # Read at once: the search has the table made anew all the time.
        rows = page.evaluate(
            "[...document.querySelectorAll('.missed tr')].map(row => [...row.cells].map(cell => cell.textContent))"
        )
        assert rows[0] == ["", "start", "now", "required"]
        assert len(rows) > 1
        assert all(len(row) == 4 and all(row) for row in rows[1:])
        expect(page.locator("#search-drop")).to_be_visible(timeout=120_000)
        page.locator("#search-drop").click()
        expect(page.locator(".missed")).to_be_hidden()
