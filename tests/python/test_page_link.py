"""A design in the fragment of an address: copied, offered, and never taken by itself."""

import base64
import json
import re
import zlib

import pytest
from axe_playwright_python.sync_playwright import Axe
from conftest import centrode
from page import ARMS, CIRCLE, POINTS, SHIPPED, field, figures, opened, settled, shown
from playwright.sync_api import expect
from sample import sampled
from studio import studio


def fragment(text):
    """The fragment as its documentation has it."""
    data = text if isinstance(text, bytes) else text.encode()
    return "#design=1." + base64.urlsafe_b64encode(zlib.compress(data)).decode().rstrip("=")


def unpacked(link):
    assert link.startswith("#design=1.")
    letters = link.removeprefix("#design=1.")
    return zlib.decompress(base64.urlsafe_b64decode(letters + "=" * (-len(letters) % 4))).decode()


def follow(page, link):
    page.evaluate("link => { location.hash = link; }", link)


def copied(page):
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    page.locator("#link").click()
    expect(page.locator("#notices")).to_contain_text("hold the whole design")
    return page.evaluate("navigator.clipboard.readText()")


def test_a_link_holds_the_design_as_it_is_shown(points):
    page, design = points
    field(page, "teeth.backlash").fill("0.06")
    field(page, "teeth.backlash").press("Enter")
    assert unpacked(copied(page)) == POINTS.read_text().replace("backlash = 0.05", "backlash = 0.06")
    assert design.read_text() == POINTS.read_text()


@pytest.mark.parametrize("design", sampled(SHIPPED), ids=lambda path: path.stem)
def test_every_shipped_design_finds_room_in_a_link(points, design):
    page, _ = points
    text = design.read_text()
    both = "text => import(new URL('link.js', location)).then(async link => { const made = await link.written(text);"
    made, back = page.evaluate(f"{both} return [made, await link.read(made)]; }})", text)
    assert back == unpacked(made) == text
    assert len(made) < 15_000


def test_a_browser_that_does_not_copy_shows_the_link(browser, tmp_path):
    refuse = "navigator.clipboard.writeText = () => Promise.reject(new Error('no'));"
    with opened(browser, tmp_path, POINTS, script=refuse) as (page, _):
        page.locator("#link").click()
        area = page.get_by_role("textbox", name="Link")
        expect(area).to_be_focused()
        assert unpacked(area.input_value()) == POINTS.read_text()
        assert area.evaluate("area => area.selectionEnd - area.selectionStart") == len(area.input_value())


def test_a_link_is_offered_and_not_taken_over_work(points):
    page, design = points
    backlash = field(page, "teeth.backlash")
    backlash.fill("0.07")
    backlash.press("Enter")
    expect(page.locator("#file")).to_contain_text("not saved")
    follow(page, fragment(ARMS.read_text()))
    notice = page.locator(".notice")
    expect(notice).to_contain_text(re.compile(r"The link holds .*Undo brings that back"))
    expect(backlash).to_have_value("0.07")
    assert "#" not in page.url
    settled(page)
    found = Axe().run(page).response["violations"]
    assert not [(rule["id"], [node["target"] for node in rule["nodes"]]) for rule in found]
    notice.get_by_role("button", name="Open it").click()
    expect(field(page, "arm.tip_distance")).to_be_visible()
    settled(page)
    page.locator("#undo").click()
    expect(backlash).to_have_value("0.07")
    assert design.read_text() == POINTS.read_text()


def test_a_page_opened_with_a_link_offers_it_once(browser, tmp_path):
    copy = tmp_path / POINTS.name
    copy.write_text(POINTS.read_text())
    with studio(copy) as running, shown(browser, running.url + fragment(ARMS.read_text())) as page:
        expect(page.locator(".notice")).to_contain_text("The link holds")
        expect(field(page, "teeth.backlash")).to_have_value("0.05")
        page.reload()
        settled(page)
        expect(page.locator(".notice")).to_have_count(0)
        follow(page, fragment(POINTS.read_text()))
        expect(page.locator(".notice")).to_contain_text("the one that is shown")


@pytest.mark.parametrize(
    ("link", "words"),
    [
        ("#design=2.abcd", "another kind"),
        ("#design=", "another kind"),
        ("#design=1.<img src=x onerror=alert(1)>", "characters that no link has"),
        ("#design=1.abcd", "damaged or was cut off"),
        (fragment(POINTS.read_text())[:-9], "damaged or was cut off"),
        ("#design=1." + "A" * 30_000, "30010 characters, where 30000 is the most"),
        (fragment(b" " * ((1 << 20) + 1)), "more than 1048576 bytes"),
        (fragment(b"\xff\xfe\xfd"), "holds no text"),
        (fragment('family = "gear-pair"\n<script>alert(1)</script>'), "holds no design"),
        (fragment(""), "holds no design"),
    ],
    ids=["later", "empty", "letters", "noise", "cut", "long", "bomb", "bytes", "script", "nothing"],
)
def test_a_hostile_link_is_told_and_changes_nothing(points, link, words):
    page, design = points
    follow(page, link)
    expect(page.locator(".notice.error")).to_contain_text(words)
    expect(page.locator(".notice button")).to_have_count(1)
    expect(field(page, "teeth.backlash")).to_have_value("0.05")
    expect(page.locator("#save")).to_be_disabled()
    assert design.read_text() == POINTS.read_text()


def test_a_design_too_long_for_a_link_is_told(points):
    page, _ = points
    noise = base64.b64encode(json.dumps([hash(str(i)) for i in range(4000)]).encode()).decode()
    page.locator("#source").click()
    page.get_by_role("textbox", name="Design file").fill(f"# {noise}\n{POINTS.read_text()}")
    page.get_by_role("button", name="Apply").click()
    expect(page.locator("#file")).to_contain_text("not saved")
    page.locator("#link").click()
    expect(page.locator(".notice.error")).to_contain_text("too long for a link")


def test_the_start_page_makes_a_file_of_a_link(browser, tmp_path):
    def ready(page):
        expect(page.locator("#found li").first).to_be_visible()

    with studio(None, cwd=tmp_path) as running, shown(browser, running.url, ready=ready) as page:
        path = page.locator("#path")
        path.fill("#design=1.abcd")
        path.press("Enter")
        expect(page.locator("#notices")).to_contain_text("damaged")
        path.fill(f"http://127.0.0.1:9/{fragment(POINTS.read_text())}")
        path.press("Enter")
        expect(page.locator("#dialog")).to_contain_text("New design file")
        assert not list(tmp_path.iterdir())
        page.locator("#new-path").fill("shared.toml")
        page.locator("#new-path").press("Enter")
        settled(page)
        assert (tmp_path / "shared.toml").read_text() == POINTS.read_text()
        expect(field(page, "teeth.backlash")).to_have_value("0.05")
        page.locator("#start").click()
        follow(page, fragment(ARMS.read_text()))
        expect(page.locator("#dialog")).to_contain_text("New design file")


@pytest.fixture(scope="module")
def report(tmp_path_factory):
    out = tmp_path_factory.mktemp("report") / "pair.html"
    centrode("report", POINTS, "-o", out, check=False)
    return out.as_uri()


def test_a_report_offers_the_file_of_a_link_and_has_a_link_of_its_own(browser, report, tmp_path):
    with shown(browser, report + fragment(CIRCLE.read_text()), offline=True) as page:
        notice = page.locator(".notice")
        expect(notice).to_contain_text("The link holds Circular pair")
        expect(notice).to_contain_text("centrode studio circular-pair.toml")
        with page.expect_download() as download:
            notice.get_by_role("button", name="Save the file").click()
        assert download.value.suggested_filename == "circular-pair.toml"
        download.value.save_as(tmp_path / "saved.toml")
        assert (tmp_path / "saved.toml").read_text() == CIRCLE.read_text()
        # The report is what it was.
        assert figures(page)["center_distance"].startswith("82.0463")
        follow(page, fragment(CIRCLE.read_text()))
        page.get_by_role("button", name="Show its text").click()
        expect(page.get_by_role("textbox", name="Design file")).to_have_value(CIRCLE.read_text())
        assert Axe().run(page).response["violations"] == []
        page.keyboard.press("Escape")
        own = """() => new Promise((resolve) => {
          navigator.clipboard.writeText = async (text) => resolve(text);
          document.getElementById("link").click();
        })"""
        link = page.evaluate(own)
        assert unpacked(link) == POINTS.read_text()
        follow(page, link)
        expect(notice).to_have_text(re.compile("is the one that is shown"))


@pytest.mark.parametrize(
    ("link", "words"),
    [("#design=1.abcd", "damaged"), ("#design=9.abcd", "another kind"), (fragment("a = 1"), "holds no design")],
)
def test_a_hostile_link_to_a_report_is_told(browser, report, link, words):
    with shown(browser, report + link, offline=True) as page:
        expect(page.locator(".notice.error")).to_contain_text(words)
        expect(page.locator(".notice button")).to_have_count(1)
