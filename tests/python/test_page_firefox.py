"""The design page and a report in Firefox: the Debian package firefox-esr."""

import pytest
from conftest import centrode
from firefox import FIREFOX, firefox
from page import ARMS
from studio import studio

pytestmark = pytest.mark.skipif(FIREFOX is None, reason="the page needs a second browser: apt-get install firefox-esr")

SETTLED = """return document.querySelector("#findings h2") !== null
  && document.querySelector("#verdict:not(.stale, [aria-busy=true])") !== null"""
DRAWING = """return document.querySelector("#stage canvas").toDataURL()"""
GOALS = """return document.querySelector("#goals").innerText"""
CONTACTS = """return Number(document.querySelector("#mesh").dataset.contacts)"""
TOLD = """return document.querySelector("#verdict").innerText"""


@pytest.fixture(scope="module")
def browser(tmp_path_factory):
    with firefox(tmp_path_factory.mktemp("firefox")) as running:
        yield running


def seen(browser, url):
    browser.go(url)
    browser.run("""document.cookie = "centrode-tour=seen; path=/"; document.cookie = "centrode-form=all; path=/" """)
    browser.go(url)
    browser.wait(SETTLED)


def test_what_the_page_complains_of_is_heard(browser, tmp_path):
    copy = tmp_path / ARMS.name
    copy.write_text(ARMS.read_text())
    with studio(copy) as running:
        seen(browser, running.url)
        assert browser.console() == []
        # The policy of the page lets no script in but its own: a picture from elsewhere is enough to complain of.
        browser.run("document.body.append(Object.assign(new Image(), { src: 'http://127.0.0.1:9/x.png' }))")
        browser.run("return new Promise((resume) => setTimeout(resume, 200))")
        assert "9/x.png" in " ".join(browser.console())
        assert browser.console() == []


def test_an_edit_changes_picture_and_goals_and_undo_brings_them_back(browser, tmp_path):
    copy = tmp_path / ARMS.name
    copy.write_text(ARMS.read_text())
    with studio(copy) as running:
        seen(browser, running.url)
        before = browser.run(DRAWING), browser.run(GOALS), browser.run(TOLD)
        assert len(before[0]) > 5000
        browser.keys('[id="field-arm.tip_distance"]', "\ue009a\ue009" + "150\ue007")
        browser.wait("return document.querySelector('#undo').disabled === false")
        browser.wait(SETTLED)
        after = browser.run(DRAWING), browser.run(GOALS)
        assert after[0] != before[0]
        assert after[1] != before[1]
        browser.click("#undo")
        browser.wait("return document.querySelector('#undo').disabled")
        browser.wait(SETTLED)
        assert (browser.run(DRAWING), browser.run(GOALS), browser.run(TOLD)) == before
        assert browser.console() == []


def test_the_meshes_of_three_arms_are_looked_at(browser, tmp_path):
    copy = tmp_path / ARMS.name
    copy.write_text(ARMS.read_text())
    with studio(copy) as running:
        seen(browser, running.url)
        before = browser.run(DRAWING)
        browser.click("#mesh")
        assert browser.run("return document.querySelector('#mesh').textContent") == "Mesh 1/6"
        assert browser.run(CONTACTS) >= 6
        assert browser.run(DRAWING) != before
        assert browser.console() == []


def test_a_report_opens(browser, tmp_path):
    out = tmp_path / "report.html"
    centrode("report", ARMS, "-o", out, check=False)
    browser.go(out.as_uri())
    browser.wait("return document.querySelector('#findings h2') !== null")
    assert browser.run("return document.body.classList.contains('report')")
    assert len(browser.run(DRAWING)) > 5000
    assert browser.console() == []
