"""What can be taken from the design page: pictures, animations, files, designs side by side."""

import base64
import io
import re
import zipfile
from xml.etree import ElementTree

import pytest
from axe_playwright_python.sync_playwright import Axe
from conftest import centrode
from page import ARMS, CIRCLE, FEEDER, POINTS, field, figures, opened, settled, shown
from PIL import Image, ImageChops, ImageColor, ImageFilter, ImageStat
from playwright.sync_api import expect

SVG = "{http://www.w3.org/2000/svg}"


def taken(page, kind, width=None, seconds=None):
    """The picture as a file, with its name."""
    page.locator("#take-picture").click()
    page.locator("#picture-kind").select_option(kind)
    if width:
        page.locator("#picture-width").select_option(str(width))
        page.locator("#picture-seconds").fill(str(seconds))
    with page.expect_download(timeout=60_000) as download:
        page.get_by_role("button", name="Take", exact=True).click()
    expect(page.locator("#dialog")).to_be_hidden()
    return download.value.suggested_filename, download.value.path().read_bytes()


@pytest.mark.parametrize("design", [CIRCLE, FEEDER, ARMS], ids=lambda path: path.stem)
def test_the_picture_as_svg_and_png_is_the_one_that_is_shown(browser, tmp_path, design):
    with opened(browser, tmp_path, design, color_scheme="light") as (page, _):
        page.locator("#scrub").focus()
        page.keyboard.press("PageUp")
        name, text = taken(page, "svg")
        root = ElementTree.fromstring(text)
        assert name == f"{design.stem}.svg"
        assert root.find(f"{SVG}title").text == design.stem
        assert len(root.findall(f".//{SVG}path")) > 3
        assert not re.search(rb"NaN|undefined|Infinity", text)
        name, png = taken(page, "png")
        box = page.locator("#stage").bounding_box()
        picture = Image.open(io.BytesIO(png)).convert("RGB")
        assert picture.size == (round(3 * box["width"]), round(3 * box["height"]))
        canvas = page.locator("#stage canvas").evaluate("canvas => canvas.toDataURL()").split(",")[1]
        seen = Image.open(io.BytesIO(base64.b64decode(canvas))).convert("RGBA")
        white = Image.alpha_composite(Image.new("RGBA", seen.size, "white"), seen).convert("RGB")
        small = picture.resize(white.size, Image.Resampling.BOX)
        # Crosses at axes are the screen's alone; the rest differs by how edges are smoothed.
        differ = ImageStat.Stat(ImageChops.difference(small, white)).mean
        assert max(differ) < 3, differ
        bare = ImageStat.Stat(ImageChops.difference(Image.new("RGB", white.size, "white"), white)).mean
        assert max(differ) < 0.3 * max(bare), (differ, bare)


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_lines_stop_short_of_the_names_of_places(browser, tmp_path, scheme):
    with opened(browser, tmp_path, FEEDER, color_scheme=scheme) as (page, _):
        ground = page.evaluate("getComputedStyle(document.documentElement).getPropertyValue('--sheet')")
        rims = """ground => {
          const { prototype } = CanvasRenderingContext2D;
          const stroke = prototype.strokeText;
          const names = [];
          prototype.strokeText = function (name, ...place) {
            if (this.strokeStyle === ground.trim()) names.push(name);
            return stroke.call(this, name, ...place);
          };
          document.getElementById("scrub").dispatchEvent(new Event("input"));
          prototype.strokeText = stroke;
          return names;
        }"""
        assert set("AGE") <= set(page.evaluate(rims, ground))
        root, _ = labels(page)
        names = [text for text in root.iter(f"{SVG}text") if text.text in set("AGE")]
        assert names
        assert all(name.get("paint-order") == "stroke" and name.get("stroke") for name in names)


def test_a_gif_is_one_cycle_of_the_stated_length_and_size(browser, tmp_path):
    with opened(browser, tmp_path, CIRCLE) as (page, _):
        name, data = taken(page, "gif", 320, 2)
        assert name == "circular-pair.gif"
        film = Image.open(io.BytesIO(data))
        frames = []
        for index in range(film.n_frames):
            film.seek(index)
            frames.append(film.convert("RGB"))
        assert film.size[0] == 320
        assert film.n_frames * film.info["duration"] == 2000
        assert film.info["loop"] == 0
        assert ImageChops.difference(frames[0], frames[len(frames) // 2]).getbbox()
        # White around, and nothing cut off at the edge.
        for x in range(320):
            assert frames[3].getpixel((x, 0)) == frames[3].getpixel((x, film.size[1] - 1)) == (255, 255, 255)
        expect(page.locator("#notices")).to_contain_text(
            f"One cycle in 2 s, 320 pixels wide, {round(len(data) / 1024)} kB."
        )


def test_a_webm_plays_for_the_stated_length(browser, tmp_path):
    with opened(browser, tmp_path, CIRCLE) as (page, _):
        name, data = taken(page, "webm", 320, 1)
        assert name == "circular-pair.webm"
        assert data.startswith(b"\x1a\x45\xdf\xa3")
        player = page.context.new_page()
        size = player.evaluate(
            """async data => {
              const video = document.createElement("video");
              video.src = "data:video/webm;base64," + data;
              await new Promise((resolve, reject) => Object.assign(video, { onloadeddata: resolve, onerror: reject }));
              // A recording has no length in its head: its end has.
              video.currentTime = 1e6;
              await new Promise(resolve => { video.onseeked = resolve; });
              return [video.videoWidth, video.videoHeight, video.currentTime];
            }""",
            base64.b64encode(data).decode(),
        )
        player.close()
        assert size[0] == 320
        assert size[2] == pytest.approx(1, abs=0.25)


FRAMES = """async ([data, count]) => {
  const video = document.createElement("video");
  video.src = "data:video/webm;base64," + data;
  await new Promise((resolve, reject) => Object.assign(video, { onloadeddata: resolve, onerror: reject }));
  const seek = async (to) => {
    video.currentTime = to;
    await new Promise(resolve => { video.onseeked = resolve; });
    return video.currentTime;
  };
  const end = await seek(1e6);
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [video.videoWidth, video.videoHeight];
  const frames = [];
  for (let i = 0; i < count; i += 1) {
    await seek((end * (i + 0.5)) / count);
    canvas.getContext("2d").drawImage(video, 0, 0);
    frames.push(canvas.toDataURL().split(",")[1]);
  }
  return frames;
}"""
"""Pictures of a film, evenly over its length."""


def test_a_webm_close_to_a_mesh_of_three_arms_has_its_points_of_contact(browser, tmp_path):
    count = 8
    with opened(browser, tmp_path, ARMS, color_scheme="light") as (page, _):
        page.locator("#mesh").click()
        expect(page.locator("#mesh")).to_have_text("Mesh 1/6")
        _, text = taken(page, "svg")
        dots = ElementTree.fromstring(text).iter(f"{SVG}circle")
        ink = next(dot.get("fill") for dot in dots if dot.get("data-mesh") == "contact")
        name, data = taken(page, "webm", 320, 2)
        assert name == "three-arm-2021.webm"
        player = page.context.new_page()
        frames = player.evaluate(FRAMES, [base64.b64encode(data).decode(), count])
        player.close()
    wanted, seen = ImageColor.getrgb(ink), []
    for frame in frames:
        picture = Image.open(io.BytesIO(base64.b64decode(frame))).convert("RGB")
        assert picture.width == 320
        # What a film keeps of a colour is near it: one value for four pixels.
        off = ImageChops.difference(picture, Image.new("RGB", picture.size, wanted)).split()
        near = ImageChops.lighter(ImageChops.lighter(*off[:2]), off[2]).point(lambda value: 255 * (value < 48))
        # Lines of the colour are two pixels wide; a dot is ten.
        dots = near.filter(ImageFilter.MinFilter(5)).tobytes()
        seen.append(frozenset(place for place, value in enumerate(dots) if value))
    # In 4 % of the cycle a tooth edge transmits the motion, for which no path is drawn.
    assert sum(len(places) > 4 for places in seen) >= count - 1, [len(places) for places in seen]
    # They move with the teeth, whatever else has their colour.
    assert not frozenset.intersection(*(places for places in seen if places))


@pytest.mark.parametrize("design", [CIRCLE, ARMS], ids=lambda path: path.stem)
def test_what_touches_in_a_mesh_is_in_the_files_of_the_picture(browser, tmp_path, design):
    with opened(browser, tmp_path, design, color_scheme="light") as (page, _):
        _, without = taken(page, "svg")
        assert b"data-mesh" not in without
        page.locator("#mesh").click()
        _, text = taken(page, "svg")
        root = ElementTree.fromstring(text)
        dots = [dot for dot in root.iter(f"{SVG}circle") if dot.get("data-mesh") == "contact"]
        assert len(dots) == int(page.locator("#mesh").get_attribute("data-contacts")) > 0
        lines = [line for line in root.iter(f"{SVG}path") if line.get("data-mesh") == "line"]
        assert len(lines) == (6 if design == ARMS else 1)
        ink = dots[0].get("fill")
        _, data = taken(page, "gif", 320, 1)
        film = Image.open(io.BytesIO(data))
        wanted, seen = ImageColor.getrgb(ink), []
        for index in range(film.n_frames):
            film.seek(index)
            frame = film.convert("RGB")
            pixels = frame.load()
            # A few colours are all that a GIF has.
            hits = [
                (x, y)
                for x in range(frame.width)
                for y in range(frame.height)
                if max(abs(a - b) for a, b in zip(pixels[x, y], wanted, strict=True)) < 12
            ]
            seen.append(frozenset(hits))
        # Of the arms' gears a tooth edge transmits the motion in 4 % of the cycle, as their check reports.
        assert sum(len(hits) > 20 for hits in seen) >= film.n_frames - (2 if design == ARMS else 0)
        # Of 24 teeth in 20 pictures every fifth is alike.
        assert len(set(seen)) >= 5


def test_a_length_that_cannot_be_is_refused_in_words(browser, tmp_path):
    with opened(browser, tmp_path, CIRCLE) as (page, _):
        page.locator("#take-picture").click()
        page.locator("#picture-kind").select_option("gif")
        page.locator("#picture-seconds").fill("90")
        page.get_by_role("button", name="Take", exact=True).click()
        expect(page.locator("#dialog .remark")).to_have_text("the length is 90; it must be 0.5 to 30 s")
        assert Axe().run(page).response["violations"] == []


def test_a_report_gives_its_picture_too(browser, tmp_path):
    out = tmp_path / "pair.html"
    centrode("report", CIRCLE, "-o", out, check=False)
    with shown(browser, out.as_uri(), offline=True) as page:
        name, text = taken(page, "svg")
        assert name == "circular-pair.svg"
        assert ElementTree.fromstring(text).tag == f"{SVG}svg"
        assert taken(page, "gif", 320, 0.5)[1].startswith(b"GIF89a")
    assert out.stat().st_size < 3e6


def test_the_export_takes_sheet_and_projection_of_its_own(browser, tmp_path):
    def zipped(path):
        with zipfile.ZipFile(path) as files:
            return {name: files.read(name) for name in files.namelist()}

    with opened(browser, tmp_path, CIRCLE) as (page, copy):
        page.locator("#export").click()
        expect(page.locator("#export-tolerance")).to_be_visible()
        for box in page.locator("fieldset").first.locator("input").all():
            box.set_checked(box.get_attribute("value") == "pdf")
        page.locator("#export-sheet").select_option("A2")
        page.locator("#export-projection").select_option("third-angle")
        with page.expect_download(timeout=60_000) as download:
            page.get_by_role("button", name="Export zip").click()
        found = zipped(download.value.path())
        # The design itself stays as it is.
        assert copy.read_text() == CIRCLE.read_text()
        expect(page.locator("#save")).to_be_disabled()
        asked = tmp_path / "asked.toml"
        asked.write_text(CIRCLE.read_text() + '\n[drawing]\nsheet = "A2"\nprojection = "third-angle"\n')
        centrode("export", asked, "--to", tmp_path / "out", "--format", "pdf")
        sheets = {name: data for name, data in found.items() if name.endswith(".pdf")}
        assert sheets
        for name, data in sheets.items():
            assert (tmp_path / "out" / name).read_bytes() == data


def test_designs_are_compared_side_by_side_and_one_is_taken(browser, tmp_path):
    with opened(browser, tmp_path, FEEDER) as (page, _):
        crank = field(page, "linkage.crank")
        first = crank.input_value()
        goal = page.locator('[data-goal="transmission-angle"] b').inner_text().split()[1]
        for value in [None, "60.5", "61"]:
            if value:
                crank.fill(value)
                crank.press("Enter")
                settled(page)
            page.locator("#compare").click()
            page.locator("#compare-keep").click()
            page.locator("#dialog").get_by_role("button", name="Close").click()
        page.locator("#compare").click()
        heads = page.locator(".compared thead b").all_inner_texts()
        assert heads == ["Kept 1", "Kept 2", "Kept 3"]
        row = (
            page.locator(".compared tbody tr")
            .filter(has_text="minimum transmission angle")
            .locator("td")
            .all_inner_texts()
        )
        assert len(set(row)) == 3
        assert row[0].split()[1] == goal
        pictures = "all => all.map(canvas => canvas.toDataURL())"
        before = page.locator(".compared canvas").evaluate_all(pictures)
        assert len(set(before)) == 3
        page.locator("#compare-place").focus()
        page.keyboard.press("PageUp")
        assert all(a != b for a, b in zip(before, page.locator(".compared canvas").evaluate_all(pictures), strict=True))
        assert Axe().run(page).response["violations"] == []
        page.get_by_role("button", name="Take Kept 1").click()
        settled(page)
        expect(crank).to_have_value(first)
        page.locator("#undo").click()
        settled(page)
        expect(crank).to_have_value("61")


def test_poses_and_distances_lie_over_the_picture(browser, tmp_path):
    with opened(browser, tmp_path, CIRCLE) as (page, _):
        words = """() => {
          const told = [], paint = CanvasRenderingContext2D.prototype.fillText;
          CanvasRenderingContext2D.prototype.fillText = function (text, ...rest) {
            told.push(text);
            return paint.call(this, text, ...rest);
          };
          const box = document.getElementById("show-distances");
          box.click();
          CanvasRenderingContext2D.prototype.fillText = paint;
          return told;
        }"""
        # Module 2, 24 and 36 teeth: tips a module above the pitch circles, roots 1.25 below.
        told = page.evaluate(words)
        assert {"60 mm", "R 26", "R 38", "R 21.5", "R 33.5", "⌀ 14"} <= set(told)
        strokes = """() => {
          let count = 0;
          const stroke = CanvasRenderingContext2D.prototype.stroke;
          CanvasRenderingContext2D.prototype.stroke = function (...rest) {
            count += 1;
            return stroke.call(this, ...rest);
          };
          document.getElementById("show-poses").click();
          CanvasRenderingContext2D.prototype.stroke = stroke;
          return count;
        }"""
        more, fewer = page.evaluate(strokes), page.evaluate(strokes)
        # Both gears at twelve places.
        assert more - fewer >= 24


def labels(page):
    """The picture's SVG, and the words in it."""
    root = ElementTree.fromstring(taken(page, "svg")[1])
    return root, [text.text for text in root.iter(f"{SVG}text")]


@pytest.mark.parametrize("design", [POINTS, CIRCLE], ids=lambda path: path.stem)
def test_dimensions_of_the_teeth_are_those_of_the_figures_and_in_the_file(browser, tmp_path, design):
    with opened(browser, tmp_path, design) as (page, _):
        page.locator("#show-distances").check()
        page.locator("#show-poses").check()
        root, told = labels(page)
        known = figures(page)
        radii = sorted(float(word.removeprefix("R ")) for word in told if word.startswith("R "))
        names = ["tip_radius_max", "root_radius_min"]
        wanted = sorted(float(known[f"{gear}_{name}"]) for gear in ("driver", "driven") for name in names)
        assert radii == pytest.approx(wanted, abs=0.02)
        assert f"{float(known['center_distance']):.4g} mm" in told
        over = [node for node in root.iter() if node.get("data-over") == "poses"]
        # Both gears at twelve places, the pitch curves left out.
        assert [len(group) for group in over] == [24]


def test_poses_show_bodies_and_bars_without_the_ways_of_points(browser, tmp_path):
    with opened(browser, tmp_path, ARMS) as (page, copy):
        page.locator("#show-poses").check()
        root, _ = labels(page)
        group = next(node for node in root.iter() if node.get("data-over") == "poses")
        answer = page.request.post(
            page.url + "solve",
            data={"text": copy.read_text(), "edits": [], "depth": "detail"},
            headers={"Origin": re.match("http://[^/]+", page.url)[0]},
        )
        picture = answer.json()["picture"]
        moving = [
            link for link, poses in zip(picture["links"], picture["motion"]["poses"], strict=True) if len(poses) > 3
        ]
        assert len(group) == 12 * len(moving)
        drawn = sum(1 for path in group if path.get("d"))
        solid = ("body", "hole", "bar", "clamp")
        matter = [link for link in moving if any(line["role"] in solid for line in picture["shapes"][link["shape"]])]
        assert drawn == 12 * len(matter) < len(group)


def test_parts_are_chosen_as_on_the_command_line(browser, tmp_path):
    with opened(browser, tmp_path, CIRCLE) as (page, copy):
        page.get_by_role("button", name="Export…").click()
        page.locator("#dialog summary", has_text="Parts").click()
        expect(page.locator("[id^=export-part-]")).to_have_count(3)
        assert not Axe().run(page).response["violations"]
        page.get_by_role("button", name="None").click()
        page.get_by_role("button", name="Export zip").click()
        expect(page.locator(".notice")).to_contain_text("no part is chosen")
        page.get_by_role("button", name="Export…").click()
        page.locator("#dialog summary", has_text="Parts").click()
        page.get_by_role("button", name="None").click()
        page.locator("#export-part-driven").check()
        for kind in ["urdf", "mjcf", "3mf", "pdf", "stl", "report"]:
            page.locator(f'#dialog input[value="{kind}"]').uncheck()
        with page.expect_download(timeout=60_000) as download:
            page.get_by_role("button", name="Export zip").click()
        with zipfile.ZipFile(download.value.path()) as files:
            taken = {name: files.read(name) for name in files.namelist()}
        out = tmp_path / "out"
        kinds = "dxf,svg,sheet,step,csv,json"
        centrode("export", copy, "--to", out, "--part", "driven", "--format", kinds)
        written = {str(path.relative_to(out)): path.read_bytes() for path in out.rglob("[!.]*") if path.is_file()}
        assert "driven.dxf" in taken
        assert "driver.dxf" not in taken
        assert taken == written


def test_parts_of_a_machine_are_those_that_its_design_names(browser, tmp_path):
    design = CIRCLE.with_name("two-arm.toml")
    with opened(browser, tmp_path, design) as (page, copy):
        page.get_by_role("button", name="Export…").click()
        boxes = page.locator("[id^=export-part-]")
        expect(boxes.first).to_be_attached()
        names = boxes.evaluate_all("boxes => boxes.map(box => box.value)")
        unknown = centrode("export", copy, "--to", tmp_path / "none", "--part", "nothing", check=False)
        assert names
        assert all(name in unknown.stderr for name in names)


@pytest.mark.parametrize("others", [[], ["json"]], ids=["alone", "next to"])
def test_the_report_is_among_the_files_of_the_export(browser, tmp_path, others):
    with opened(browser, tmp_path, CIRCLE) as (page, copy):
        page.locator("#export").click()
        expect(page.locator("#export-tolerance")).to_be_visible()
        for box in page.locator("fieldset").first.locator("input").all():
            box.set_checked(box.get_attribute("value") in ["report", *others])
        with page.expect_download() as download:
            page.get_by_role("button", name="Export zip").click()
        with zipfile.ZipFile(download.value.path()) as files:
            assert sorted(files.namelist()) == sorted(["report.html", *(f"report.{kind}" for kind in others)])
            html = files.read("report.html")
    out = tmp_path / "report.html"
    centrode("report", copy, "-o", out)
    assert html == out.read_bytes()
