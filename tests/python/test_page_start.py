"""The start page of `centrode studio` in a real browser: gallery, templates, files."""

import os

import pytest
from axe_playwright_python.sync_playwright import Axe
from conftest import centrode
from page import ARMS, POINTS, SHIPPED, field, settled, shown
from playwright.sync_api import expect
from sample import looks, sampled
from studio import studio

FAMILIES = ["gear-pair", "three-arm", "spiral-shaft", "moving-box", "feeder", "machine"]


def listed(page):
    """Waits until the gallery is there."""
    expect(page.locator(".card")).to_have_count(len(SHIPPED) + len(FAMILIES))


@pytest.fixture
def served(tmp_path):
    """The start page of a program started in an empty folder, and the folder."""
    with studio(None, cwd=tmp_path) as running:
        yield running, tmp_path


@pytest.fixture
def start(browser, served):
    running, folder = served
    with shown(browser, running.url, ready=listed) as page:
        yield page, folder


def card(page, name):
    return page.locator(f'.card[data-design="{name}"]')


def inputs(page):
    """Inputs at which the pictures of the gallery are drawn; none before."""
    return page.locator(".card canvas").evaluate_all("all => all.map(one => one.dataset.input)")


def drawn(page):
    """Draws every picture of the gallery, and leads back up."""
    for one in page.locator(".card").all():
        one.scroll_into_view_if_needed()
        expect(one.locator("canvas[data-input]")).to_be_visible()
    page.locator("#files-title").scroll_into_view_if_needed()


def test_the_gallery_has_a_picture_of_every_shipped_design_and_family(start):
    page, _ = start
    names = page.locator(".card").evaluate_all("all => all.map(one => one.dataset.design)")
    assert names[: len(FAMILIES)] == FAMILIES
    assert set(names[len(FAMILIES) :]) == {path.stem for path in SHIPPED}
    drawn(page)
    colours = """all => all.map(canvas => {
      const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
      return new Set(new Uint32Array(data.buffer)).size;
    })"""
    # Lines, their edges and at least one surface.
    assert min(page.locator(".card canvas").evaluate_all(colours)) > 20


@pytest.mark.parametrize("design", sampled(SHIPPED), ids=lambda path: path.stem)
def test_a_picture_of_the_gallery_is_that_of_the_design_page(served, design):
    running, folder = served
    (folder / design.name).write_text(design.read_text())
    status, picture = running.json("GET", f"pictures/shipped/{design.stem}")
    assert status == 200
    page = running.json("POST", "open", {"path": design.name})[1]["page"]
    snapshot = running.json("POST", f"{page}solve", {"text": design.read_text(), "depth": "picture"})[1]
    assert picture == snapshot["picture"]


def test_a_shipped_design_is_made_worked_on_and_left_by_keyboard(start):
    page, folder = start
    card(page, POINTS.stem).focus()
    page.keyboard.press("Enter")
    expect(page.get_by_label("File", exact=True)).to_have_value(POINTS.name)
    page.keyboard.press("Enter")
    settled(page)
    assert (folder / POINTS.name).read_text() == POINTS.read_text()
    field(page, "teeth.backlash").fill("0.06")
    field(page, "teeth.backlash").press("Enter")
    expect(page.locator("#file")).to_contain_text("not saved")
    page.keyboard.press("Control+s")
    expect(page.locator("#save")).to_be_disabled()
    assert (folder / POINTS.name).read_text() == POINTS.read_text().replace("backlash = 0.05", "backlash = 0.06")
    page.get_by_role("link", name="Start").focus()
    page.keyboard.press("Enter")
    listed(page)
    expect(page.locator("#found b")).to_have_text([POINTS.name])
    card(page, POINTS.stem).click()
    name = page.get_by_label("File", exact=True)
    expect(name).to_have_value("transplanter-pair-2021-2.toml")
    name.fill(POINTS.name)
    name.press("Enter")
    expect(page.locator("#dialog")).to_contain_text(f"{POINTS.name} exists already")
    page.keyboard.press("Escape")
    expect(page.locator("#dialog")).to_be_hidden()
    assert "backlash = 0.06" in (folder / POINTS.name).read_text()


@pytest.mark.parametrize("family", FAMILIES)
def test_a_new_design_is_the_template_of_its_family(start, family):
    page, folder = start
    card(page, family).click()
    page.get_by_label("File", exact=True).fill("mine.toml")
    page.get_by_role("button", name="Make and open").click()
    settled(page)
    assert (folder / "mine.toml").read_text() == centrode("new", family).stdout
    expect(page.locator("#file")).to_have_text("mine.toml")


def test_a_file_is_opened_by_path_or_the_reason_told(start):
    page, folder = start
    (folder / "deeper").mkdir()
    (folder / "deeper" / "arms.toml").write_text(ARMS.read_text())
    (folder / "secret.txt").write_text("secret")
    path = page.get_by_label("Path of a design file")
    path.focus()
    for wrong, words in [
        ("none.toml", "cannot read"),
        ("secret.txt", ".toml"),
        ("/etc/passwd", ".toml"),
        ("-", ".toml"),
    ]:
        path.fill(wrong)
        path.press("Enter")
        expect(page.locator("#open-remark")).to_contain_text(words)
        expect(path).to_be_focused()
    path.fill("deeper/arms.toml")
    path.press("Enter")
    settled(page)
    expect(page.locator("#file")).to_have_text("arms.toml")


def test_the_files_of_the_folder_are_listed_the_last_changed_first(browser, served):
    running, folder = served
    for age, name in enumerate(["new.toml", "old.toml"]):
        (folder / name).write_text(POINTS.read_text())
        os.utime(folder / name, (1_700_000_000 - age, 1_700_000_000 - age))
    (folder / "other.toml").write_text("a = 1\n")
    (folder / "broken.toml").write_text("family = ")
    with shown(browser, running.url, ready=listed) as page:
        expect(page.locator("#found b")).to_have_text(["new.toml", "old.toml"])
        page.locator("#found button").last.click()
        settled(page)
        expect(page.locator("#file")).to_have_text("old.toml")


def test_designs_opened_beside_each_other_keep_to_their_files(served):
    running, folder = served
    pages = {}
    for path in (POINTS, ARMS):
        (folder / path.name).write_text(path.read_text())
        pages[path] = running.json("POST", "open", {"path": path.name})[1]["page"]
    assert len(set(pages.values())) == 2
    # By another path it is the same file, and the same page.
    assert running.json("POST", "open", {"path": f"./{POINTS.name}"})[1]["page"] == pages[POINTS]
    for path, page in pages.items():
        told = running.json("GET", f"{page}design")[1]
        assert (told["file"], told["text"]) == (path.name, path.read_text())
        body = {"text": path.read_text() + "# mine\n", "base": path.read_text()}
        assert running.json("POST", f"{page}save", body) == (200, {"saved": True})
    for path in pages:
        assert (folder / path.name).read_text() == path.read_text() + "# mine\n"
    assert running.ask("GET", "designs/2/design")[0] == 404
    assert running.ask("GET", f"{pages[ARMS]}../../start")[0] == 404


@pytest.mark.parametrize(
    ("path", "body"),
    [("open", {"path": "pair.toml"}), ("new", {"from": {"shipped": POINTS.stem}, "path": "made.toml"})],
    ids=["open", "new"],
)
@pytest.mark.parametrize(
    "headers",
    [{"Host": "example.org"}, {"Origin": "http://example.org"}, {"Origin": None}],
    ids=["foreign host", "foreign origin", "no origin"],
)
def test_strangers_open_and_make_nothing(served, path, body, headers):
    running, folder = served
    assert running.ask("POST", path, body, headers)[0] == 403
    assert running.ask("POST", f"/{'0' * 32}/{path}", body, absolute=True)[0] == 403
    assert not list(folder.iterdir())
    assert running.ask("GET", "designs/0/design")[0] == 404


@pytest.mark.parametrize(
    ("origin", "path", "reason"),
    [
        ({"shipped": "none"}, "made.toml", "no such design"),
        ({"new": "none"}, "made.toml", "no such design"),
        ({"shipped": POINTS.stem}, "made.txt", ".toml"),
        ({"shipped": POINTS.stem}, "none/made.toml", "cannot create made.toml"),
    ],
    ids=["unknown design", "unknown family", "another ending", "no folder"],
)
def test_a_file_that_cannot_be_made_is_told(served, origin, path, reason):
    running, folder = served
    status, answer = running.json("POST", "new", {"from": origin, "path": path})
    assert status == 200
    assert reason in answer["refused"]
    assert not list(folder.iterdir())


def test_pictures_move_only_while_they_are_to(start):
    page, _ = start
    expect(page.locator(".card canvas[data-input]").first).to_be_visible()
    page.wait_for_timeout(300)
    assert set(inputs(page)) <= {None, "0"}
    first, second = page.locator(".card canvas").nth(0), page.locator(".card canvas").nth(1)
    card(page, "gear-pair").focus()
    expect(first).not_to_have_attribute("data-input", "0")
    expect(second).to_have_attribute("data-input", "0")
    page.locator("#moving").click()
    expect(second).not_to_have_attribute("data-input", "0")
    page.locator("#moving").click()
    # A picture drawn for the first time later on would look like one that moves.
    drawn(page)
    page.locator("#path").focus()
    page.mouse.move(2, 2)
    page.wait_for_timeout(100)
    before = inputs(page)
    page.wait_for_timeout(300)
    assert inputs(page) == before


def test_who_asks_for_less_motion_gets_none(browser, served):
    running, _ = served
    with shown(browser, running.url, ready=listed, reduced_motion="reduce") as page:
        expect(page.locator("#moving")).to_be_hidden()
        expect(page.locator(".card canvas[data-input]").first).to_be_visible()
        card(page, "gear-pair").focus()
        page.wait_for_timeout(300)
        assert set(inputs(page)) <= {None, "0"}


@pytest.mark.parametrize(("width", "scheme"), looks(1440, 1024, 390))
def test_the_start_page_is_for_everybody(browser, served, width, scheme):
    running, folder = served
    (folder / POINTS.name).write_text(POINTS.read_text())
    with shown(browser, running.url, ready=listed, color_scheme=scheme) as page:
        page.set_viewport_size({"width": width, "height": 900})
        for dialog in (False, True):
            if dialog:
                card(page, "press").click()
            found = Axe().run(page).response["violations"]
            assert not [(rule["id"], [node["target"] for node in rule["nodes"]]) for rule in found]
            assert page.evaluate("document.documentElement.scrollWidth") <= width


def test_files_opened_of_late_are_offered_again_from_another_folder(browser, tmp_path):
    first, second = tmp_path / "first", tmp_path / "second"
    first.mkdir()
    second.mkdir()
    (first / "pair.toml").write_text(POINTS.read_text())
    context = {}

    def opened(page):
        page.locator("#found button").first.click()
        expect(page.locator("#file")).to_contain_text("pair.toml")
        settled(page)
        context["cookies"] = page.context.cookies()

    with studio(None, cwd=first) as running, shown(browser, running.url, ready=listed) as page:
        expect(page.locator("#recent-title")).to_be_hidden()
        opened(page)
    # The program stands at another address now.
    with studio(None, cwd=second) as running:
        fresh = browser.new_context()
        fresh.add_cookies(context["cookies"])
        page = fresh.new_page()
        page.goto(running.url)
        expect(page.locator("#recent button")).to_have_count(1)
        expect(page.locator("#recent button .quiet")).to_have_text(str(first / "pair.toml"))
        page.locator("#recent button").click()
        expect(page.locator("#file")).to_contain_text("pair.toml")
        settled(page)
        fresh.close()
