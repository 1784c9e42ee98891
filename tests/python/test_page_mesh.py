"""Close to the mesh on the design page: the points at which flanks touch, and the line of action."""

import io
import math

import pytest
from axe_playwright_python.sync_playwright import Axe
from page import ARMS, CIRCLE, FEEDER, POINTS, curves_of, drawing, field, opened, settled
from PIL import Image
from playwright.sync_api import expect
from studio import studio


def close_to_the_mesh(page):
    page.locator("#mesh").click()
    expect(page.locator("#mesh")).to_have_attribute("aria-pressed", "true")


def dots(page):
    """Places of the dots of contact in the picture, pixels from its middle, by their colour."""
    png = page.locator("#stage").screenshot()
    picture = Image.open(io.BytesIO(png)).convert("RGB")
    wanted = page.evaluate(
        """() => {
          const context = document.createElement("canvas").getContext("2d");
          context.fillStyle = getComputedStyle(document.documentElement).getPropertyValue("--pinned");
          context.fillRect(0, 0, 1, 1);
          return [...context.getImageData(0, 0, 1, 1).data].slice(0, 3);
        }"""
    )
    width, height = picture.size
    pixels = picture.load()
    # A dot is five pixels and more of its colour in a row; the line of action is thinner.
    hits = [
        (x, y)
        for y in range(60, height - 60)
        for x in range(3, width - 3)
        if all(list(pixels[x + k, y]) == wanted for k in range(-3, 4))
    ]
    groups = []
    for hit in hits:
        near = next((group for group in groups if math.dist(group[0], hit) < 15), None)
        if near is None:
            groups.append([hit])
        else:
            near.append(hit)
    middles = [tuple(sum(values) / len(group) for values in zip(*group, strict=True)) for group in groups]
    return [(x - width / 2, height / 2 - y) for x, y in middles]


def test_contacts_of_a_circular_pair_move_along_the_line_of_action(browser, tmp_path):
    with opened(browser, tmp_path, CIRCLE, color_scheme="light") as (page, _):
        close_to_the_mesh(page)
        seen = set()
        for turn in [0.30, 0.34, 0.38, 0.42]:
            page.locator("#scrub").fill(str(turn))
            found = dots(page)
            assert len(found) == int(page.locator("#mesh").get_attribute("data-contacts"))
            for x, y in found:
                # The pitch point is in the middle, and the pressure angle 20 degrees.
                assert abs(x * math.cos(math.radians(20)) + y * math.sin(math.radians(20))) < 2
            seen.update((round(x), round(y)) for x, y in found)
        assert len(seen) > 4
        # The contact ratio is 1.65: one pair or two.
        assert 1 <= len(found) <= 2


@pytest.mark.parametrize("way", ["Fit", "Mesh", "key"])
def test_what_leads_close_to_the_mesh_leads_back(browser, tmp_path, way):
    with opened(browser, tmp_path, POINTS) as (page, _):
        before = drawing(page)
        close_to_the_mesh(page)
        near = drawing(page)
        assert near != before
        page.locator("#scrub").press("PageUp")
        assert drawing(page) != near
        page.locator("#scrub").press("Home")
        if way == "key":
            page.locator("#stage").press("0")
        else:
            page.get_by_role("button", name=way, exact=True).click()
        expect(page.locator("#mesh")).to_have_attribute("aria-pressed", "false")
        assert drawing(page) == before


def test_a_picture_without_a_mesh_offers_none_and_axe_finds_nothing(browser, tmp_path):
    with opened(browser, tmp_path, FEEDER) as (page, _):
        expect(page.locator("#mesh")).to_be_hidden()
    with opened(browser, tmp_path, POINTS, color_scheme="dark") as (page, _):
        close_to_the_mesh(page)
        assert not Axe().run(page).response["violations"]


MESHES = [
    name
    for chain in (1, 2, 3)
    for name in (f"sun and intermediate gear {chain}", f"intermediate gear {chain} and planet {chain}")
]


@pytest.mark.campaign
def test_the_meshes_of_three_arms_are_looked_at_one_after_the_other(browser, tmp_path):
    with opened(browser, tmp_path, ARMS, color_scheme="light") as (page, _):
        before, mesh = drawing(page), page.locator("#mesh")
        for number, name in enumerate(MESHES, 1):
            mesh.click()
            expect(mesh).to_have_text(f"Mesh {number}/6")
            expect(mesh).to_have_attribute("title", name)
            places = set()
            for turn in (0.2, 0.205, 0.21):
                page.locator("#scrub").fill(str(turn))
                near = [dot for dot in dots(page) if math.hypot(*dot) < 150]
                assert near
                places.update(near)
            # They move, and the pitch point stays in the middle.
            assert len(places) > 3
            page.locator("#scrub").fill("0")
        # Each of six meshes touches at one place at least.
        assert int(mesh.get_attribute("data-contacts")) >= 6
        mesh.click()
        expect(mesh).to_have_text("Mesh")
        expect(mesh).to_have_attribute("aria-pressed", "false")
        assert drawing(page) == before


def test_a_change_keeps_the_view_at_the_mesh_of_three_arms(browser, tmp_path):
    with opened(browser, tmp_path, ARMS) as (page, _):
        mesh = page.locator("#mesh")
        close_to_the_mesh(page)
        mesh.click()
        field(page, "arm.tip_distance").press("ArrowUp")
        settled(page)
        expect(mesh).to_have_text("Mesh 2/6")
        assert int(mesh.get_attribute("data-contacts")) >= 6


@pytest.mark.parametrize(
    ("name", "share"), [("elliptic-pair-2018", 0.0), ("lobed-pair-5-2", 0.0), ("transplanter-pair-2021", 0.04)]
)
def test_as_many_flanks_touch_as_the_contact_analysis_of_the_finished_outlines_counts(tmp_path, name, share):
    """The paths come from the law of gearing alone; a sample next to the end of one may count otherwise."""
    copy = tmp_path / f"{name}.toml"
    copy.write_text(POINTS.with_name(copy.name).read_text())
    with studio(copy) as served:
        ask = {"text": copy.read_text(), "edits": [], "depth": "checks"}
        _, snapshot = served.json("POST", "solve", ask)
    (contacts,) = snapshot["picture"]["contacts"]
    cycle = contacts["pitch_point"]["input"][-1]
    ends = [(path["input"][0], path["input"][-1]) for path in contacts["paths"]]
    counted = next(curve for curve in curves_of(snapshot) if curve["chart"] == "Tooth pairs in contact")
    # Within a fiftieth of a pitch of an end an edge is still as near as what counts as touching.
    beside = 0.02 * cycle / len(ends)
    differ = [
        value
        for phi, value in zip(counted["input"], counted["value"], strict=True)
        if value != sum(any(first <= phi + turn <= last for turn in (-cycle, 0, cycle)) for first, last in ends)
        and min(abs(phi + turn - end) for turn in (-cycle, 0, cycle) for path in ends for end in path) > beside
    ]
    assert len(counted["value"]) > 50
    assert len(differ) <= share * len(counted["value"])
