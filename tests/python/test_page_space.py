"""The 3D view of the design page: its meshes are those that are exported, and it is worked by mouse and keys."""

import hashlib
import io
import json
import math
import re
import struct

import pytest
from axe_playwright_python.sync_playwright import Axe
from conftest import centrode
from page import ARMS, CHROMIUM, CIRCLE, FEEDER, FLAGS, SHAFT, field, opened
from PIL import Image, ImageChops
from playwright.sync_api import expect
from sample import looks, sampled

DRAWS = re.compile(r"bodies, [\d,]+ triangles")
# Chromium warns that its software renderer is slow.
SOFTWARE = [flag for flag in FLAGS if flag != "--disable-gpu"]


@pytest.fixture(scope="module")
def drawer(browser):
    """A Chromium that draws WebGL in software."""
    flags = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
    running = browser.browser_type.launch(executable_path=CHROMIUM, args=[*SOFTWARE, *flags])
    yield running
    running.close()


def read(body):
    """Head, places of each link at every input, and STL files by name."""
    (size,) = struct.unpack_from("<I", body)
    head = json.loads(body[4 : 4 + size])
    at = 4 + size
    each = 7 * len(head["input"])
    places = []
    for _ in head["links"]:
        places.append(struct.unpack_from(f"<{each}f", body, at))
        at += 4 * each
    files = {}
    for shape in head["shapes"]:
        files[shape["file"]] = body[at : at + shape["bytes"]]
        at += shape["bytes"]
    assert at == len(body)
    return head, places, files


def space(page):
    """Opens the view, and returns what the page has got for it."""
    with page.expect_response(re.compile("/meshes$"), timeout=60_000) as response:
        page.get_by_role("button", name="3D", exact=True).click()
    expect(page.locator(".space-words")).to_contain_text(DRAWS, timeout=60_000)
    return response.value.body()


def frame(page):
    """The middle of the canvas as the browser has drawn it, without what tells of the focus."""
    page.evaluate("() => new Promise((resume) => requestAnimationFrame(() => requestAnimationFrame(resume)))")
    box = page.locator(".space-scene").bounding_box()
    middle = {"x": box["x"] + 8, "y": box["y"] + 60, "width": box["width"] - 16, "height": box["height"] - 110}
    return hashlib.sha256(page.screenshot(clip=middle)).hexdigest()


@pytest.mark.parametrize("design", [CIRCLE, ARMS, FEEDER, SHAFT], ids=lambda design: design.stem)
def test_meshes_in_space_are_those_that_are_exported(drawer, tmp_path, design):
    with opened(drawer, tmp_path, design) as (page, copy):
        head, _, files = read(space(page))
        triangles = sum(
            struct.unpack_from("<I", files[head["shapes"][link["shape"]]["file"]], 80)[0] for link in head["links"]
        )
        expect(page.locator(".space-words")).to_contain_text(f"{len(head['links'])} bodies, {triangles:,} triangles")
    out = tmp_path / "out"
    centrode("export", copy, "--to", out, "--format", "mjcf", check=False)
    hashes = {name: hashlib.sha256(data).hexdigest() for name, data in files.items()}
    assert hashes
    assert hashes == {name: hashlib.sha256((out / name).read_bytes()).hexdigest() for name in files}


def test_links_in_space_stand_where_the_picture_has_them(drawer, tmp_path):
    with opened(drawer, tmp_path, CIRCLE) as (page, copy):
        head, places, _ = read(space(page))
        request = page.request.post(
            page.url + "solve",
            data={"text": copy.read_text(), "edits": [], "depth": "picture"},
            headers={"Origin": re.match("http://[^/]+", page.url)[0]},
        )
        picture = request.json()["picture"]
    assert head["input"] == picture["motion"]["input"]
    known = {link["name"]: poses for link, poses in zip(picture["links"], picture["motion"]["poses"], strict=True)}
    compared = 0
    for link, own in zip(head["links"], places, strict=True):
        poses = known.get(link["name"])
        if poses is None:
            continue
        for index in range(0, len(head["input"]), 25):
            x, y, turn = poses if len(poses) == 3 else poses[3 * index : 3 * index + 3]
            at = own[7 * index : 7 * index + 7]
            assert at[:3] == pytest.approx((x, y, at[2]), abs=1e-2)
            # cos and sin of the whole turn from the quaternion round z.
            assert (at[6] ** 2 - at[5] ** 2, 2 * at[5] * at[6]) == pytest.approx(
                (math.cos(turn), math.sin(turn)), abs=1e-4
            )
            compared += 1
    assert compared > 20


def test_the_view_is_worked_by_keys_and_mouse(drawer, tmp_path):
    with opened(drawer, tmp_path, CIRCLE) as (page, _):
        space(page)
        expect(page.locator(".space-scene")).to_be_focused()
        start = frame(page)
        assert frame(page) == start
        for key in ["ArrowRight", "ArrowUp", "+", "-", "Shift+ArrowLeft"]:
            before = frame(page)
            page.keyboard.press(key)
            assert frame(page) != before, key
        page.keyboard.press("0")
        assert frame(page) == start
        box = page.locator(".space-scene").bounding_box()
        page.mouse.move(box["x"] + 300, box["y"] + 200)
        page.mouse.down()
        page.mouse.move(box["x"] + 360, box["y"] + 230, steps=3)
        page.mouse.up()
        assert frame(page) != start
        page.locator(".space-scene").dblclick()
        assert frame(page) == start
        page.get_by_label("Section plane").select_option("section x")
        cut = frame(page)
        assert cut != start
        page.get_by_label("Position of the section").press("ArrowRight")
        assert frame(page) != cut
        page.get_by_label("Section plane").select_option("no section")
        assert frame(page) == start
        page.get_by_label("Explode").fill("1")
        assert frame(page) != start
        page.get_by_label("Explode").fill("0")
        assert frame(page) == start
        page.locator("#scrub").press("PageUp")
        assert frame(page) != start
        page.locator(".space-scene").press("Space")
        expect(page.locator("#play")).to_have_text("Pause")
        page.locator(".space-scene").press("Space")
        expect(page.locator("#play")).to_have_text("Play")
        page.locator(".space-scene").press("Escape")
        expect(page.locator(".space-box")).to_have_count(0)
        expect(page.locator("#stage")).to_be_visible()
        expect(page.locator("#space")).to_be_focused()


def fingers(session, kind, places):
    """What a screen tells of fingers at places of the page."""
    points = [{"x": x, "y": y, "id": number} for number, (x, y) in enumerate(places)]
    session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})


def test_the_view_is_worked_by_fingers(drawer, tmp_path):
    with opened(drawer, tmp_path, CIRCLE, size=(390, 844), has_touch=True, is_mobile=True) as (page, _):
        space(page)
        session = page.context.new_cdp_session(page)
        box = page.locator(".space-scene").bounding_box()
        x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

        def moved(first, last):
            start, scrolled = frame(page), page.evaluate("scrollY")
            fingers(session, "touchStart", first)
            for step in range(1, 5):
                share = step / 4
                between = [
                    (a + share * (c - a), b + share * (d - b)) for (a, b), (c, d) in zip(first, last, strict=True)
                ]
                fingers(session, "touchMove", between)
            fingers(session, "touchEnd", [])
            assert frame(page) != start
            # The page itself stays where it is.
            assert page.evaluate("scrollY") == scrolled

        start = frame(page)
        moved([(x, y)], [(x + 60, y + 20)])
        moved([(x - 30, y), (x + 30, y)], [(x - 80, y), (x + 80, y)])
        moved([(x - 30, y), (x + 30, y)], [(x - 30, y + 60), (x + 30, y + 60)])
        page.locator(".space-scene").press("0")
        assert frame(page) == start


def test_a_change_brings_its_own_meshes(drawer, tmp_path):
    with opened(drawer, tmp_path, CIRCLE) as (page, _):
        first = read(space(page))[2]
        with page.expect_response(re.compile("/meshes$"), timeout=60_000) as response:
            field(page, "pitch.tooth_count").fill("26")
            field(page, "pitch.tooth_count").press("Enter")
        expect(page.locator(".space-words")).to_contain_text(DRAWS, timeout=60_000)
        assert read(response.value.body())[2] != first


@pytest.mark.parametrize(("width", "scheme"), looks(1440, 390))
def test_the_view_passes_axe(drawer, tmp_path, scheme, width):
    with opened(drawer, tmp_path, CIRCLE, color_scheme=scheme, size=(width, 900)) as (page, _):
        space(page)
        found = Axe().run(page).response["violations"]
        assert not found, [(one["id"], [node["html"] for node in one["nodes"]]) for one in found]


def turned(page):
    """Share of the canvas' pixels that differ once the machine has turned."""

    def seen():
        page.evaluate("() => new Promise((resume) => requestAnimationFrame(() => requestAnimationFrame(resume)))")
        box = page.locator(".space-scene").bounding_box()
        clip = {"x": box["x"], "y": box["y"] + 50, "width": box["width"], "height": box["height"] - 90}
        return Image.open(io.BytesIO(page.screenshot(clip=clip))).convert("RGB")

    scrub = "(scrub, share) => { scrub.value = share; scrub.dispatchEvent(new Event('input')); }"
    images = []
    for share in (0, 0.15):
        page.locator("#scrub").evaluate(scrub, share)
        images.append(seen())
    differing = ImageChops.difference(*images).convert("L").point(lambda value: 255 if value > 24 else 0)
    return differing.histogram()[255] / (differing.width * differing.height)


@pytest.mark.parametrize("design", sampled([ARMS, FEEDER], of=["feeder-widened"]), ids=lambda design: design.stem)
def test_what_stands_still_does_not_hide_what_moves(drawer, tmp_path, design):
    with opened(drawer, tmp_path, design) as (page, _):
        space(page)
        shares = {}
        for how in ("thin", "solid", "hidden"):
            page.get_by_role("combobox", name="Fixed parts").select_option(how)
            shares[how] = turned(page)
        # The plates, or ground and tray, lie before the machine.
        assert shares["thin"] > 1.3 * shares["solid"]
        assert shares["hidden"] > shares["solid"]


def test_the_machine_fills_the_view(drawer, tmp_path):
    with opened(drawer, tmp_path, CIRCLE) as (page, _):
        space(page)
        expect(page.get_by_role("combobox", name="Fixed parts")).to_be_hidden()
        box = page.locator(".space-scene").bounding_box()
        image = Image.open(io.BytesIO(page.screenshot(clip=box))).convert("RGB")
        sheet = image.getpixel((image.width // 2, image.height - 60))
        differing = ImageChops.difference(image, Image.new("RGB", image.size, sheet)).convert("L")
        # Without the bar and the words.
        left, top, right, bottom = (
            differing.crop((10, 60, image.width - 10, image.height - 40))
            .point(lambda v: 255 if v > 40 else 0)
            .getbbox()
        )
        assert max((right - left) / box["width"], (bottom - top) / box["height"]) > 0.5
        assert min(left, top) > 0
        assert right < image.width - 20


def test_without_webgl_the_view_says_so(browser, tmp_path):
    script = """
    const ask = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
      return kind === "2d" ? ask.call(this, kind, ...rest) : null;
    };
    """
    with opened(browser, tmp_path, CIRCLE, script=script) as (page, _):
        page.get_by_role("button", name="3D", exact=True).click()
        expect(page.locator(".space-words")).to_contain_text("WebGL is missing")
        page.get_by_role("button", name="Close 3D").click()
        expect(page.locator("#stage")).to_be_visible()
