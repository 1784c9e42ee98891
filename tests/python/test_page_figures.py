"""Every number on a page is computed anew, or named here with the reason why not."""

import figures
import figures_gears
import figures_machines
import figures_papers
import pytest
from conftest import ROOT
from figures import FigureError, Said
from figures_exempt import EVERYWHERE, EXEMPT
from sample import sampled

PAGES = sorted(str(page.relative_to(ROOT)) for page in [*(ROOT / "docs").rglob("*.md"), ROOT / "README.md"])
COMPUTED = figures_machines.PAGES | figures_gears.PAGES | figures_papers.PAGES


def text(page):
    """The text of a page."""
    return (ROOT / page).read_text()


def exempt(page):
    """Patterns of the numbers of a page that are not computed."""
    return [one for table in (EVERYWHERE, EXEMPT.get(page, {})) for some in table.values() for one in some]


@pytest.mark.parametrize("page", sampled(COMPUTED, of=COMPUTED.keys() - {"docs/strong-laws.md"}))
def test_figures_are_the_computed_ones(page):
    faults = figures.faults(text(page), COMPUTED[page])
    assert not faults, "\n".join(faults)


@pytest.mark.parametrize("page", sampled(COMPUTED, of=COMPUTED.keys() - {"docs/strong-laws.md"}))
def test_each_figure_is_missed_with_its_last_digit_changed(page):
    for said in COMPUTED[page]:
        for start, end in figures.held(text(page), said):
            wrong = figures.changed(text(page), said, start, end)
            with pytest.raises(FigureError, match="computed is"):
                figures.held(wrong, said)


@pytest.mark.parametrize("page", PAGES)
def test_no_number_is_left_out(page):
    left = figures.uncovered(text(page), COMPUTED.get(page, []), exempt(page))
    assert not left, "\n".join(left)


def test_a_number_without_a_test_is_found():
    page = text("docs/feeder.md") + "\nIt weighs 4.25 kg (`7 kg` with the store).\n"
    left = figures.uncovered(page, COMPUTED["docs/feeder.md"], exempt("docs/feeder.md"))
    assert [one.partition(": ")[2] for one in left] == ["4.25: It weighs 4.25 kg (`7 kg` with the store)."]


def test_words_that_a_page_lost_are_found():
    with pytest.raises(FigureError, match="stands 0 times"):
        figures.held("It weighs 4 kg.", Said("It weighs {} g", lambda: 4))


def test_every_exemption_is_of_a_page_and_of_numbers_on_it():
    assert set(EXEMPT) | set(COMPUTED) <= set(PAGES)
    idle = [
        one for some in EVERYWHERE.values() for one in some if not any(figures.exempted(text(p), one) for p in PAGES)
    ]
    for page, table in EXEMPT.items():
        idle += [(page, one) for some in table.values() for one in some if not figures.exempted(text(page), one)]
    assert not idle
