"""Looks at the design page of every shipped design, wide, middling and narrow, light and dark, and has axe look, too.

    python tests/campaigns/page_looks.py --to looks [--width 390] [--scheme dark] [design.toml ...]

Writes one contact sheet (PNG) a width and scheme and prints what axe finds and what is wider than the window; ends with
status 1 if there is any. Needs the program (target/debug/centrode, or CENTRODE_BIN) and Chromium.
"""

import argparse
import io
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "python"))

from axe_playwright_python.sync_playwright import Axe  # noqa: E402
from page import CHROMIUM, FLAGS, SHIPPED, settled, shown  # noqa: E402
from PIL import Image, ImageDraw  # noqa: E402
from playwright.sync_api import sync_playwright  # noqa: E402
from studio import studio  # noqa: E402

SIZES = [(1440, 900), (1024, 768), (390, 844)]
SCHEMES = ["light", "dark"]
TABS = ["Design", "Goals", "Curves"]
PIXELS = 600
"""Width of a picture on the sheet."""
PATIENCE = 300_000
"""How long the checks of a design may take where much else is going on, ms."""


def faults(page, width):
    """What axe finds, and whether the page is wider than its window."""
    rules = Axe().run(page).response["violations"]
    found = [f"{rule['id']}: {node['html'][:120]}" for rule in rules for node in rule["nodes"]]
    wide = page.evaluate("document.documentElement.scrollWidth")
    return [*found, *([f"{wide} pixels wide"] if wide > width else [])]


def looked_at(page, width):
    """Pictures of the page, one a tab where there are tabs, and all that is wrong with them."""
    tabs = [tab for tab in TABS if page.get_by_role("tab", name=tab, exact=True).is_visible()]
    pictures, found = [], []
    for tab in tabs or [None]:
        if tab:
            page.get_by_role("tab", name=tab, exact=True).click()
            page.wait_for_timeout(100)
        pictures.append(Image.open(io.BytesIO(page.screenshot())).convert("RGB"))
        found += [f"{tab or 'page'}: {fault}" for fault in faults(page, width)]
    return pictures, found


def sheet(pictures, across):
    """All pictures on one, each with its name."""
    sized = [(name, picture.resize((PIXELS, picture.height * PIXELS // picture.width))) for name, picture in pictures]
    high = max(picture.height for _, picture in sized) + 24
    whole = Image.new("RGB", (across * (PIXELS + 8), -(-len(sized) // across) * high), "grey")
    draw = ImageDraw.Draw(whole)
    for number, (name, picture) in enumerate(sized):
        place = (number % across * (PIXELS + 8), number // across * high)
        draw.text((place[0] + 4, place[1] + 4), name, fill="white")
        whole.paste(picture, (place[0], place[1] + 24))
    return whole


def main():
    """Prints what is wrong, a line each."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("designs", nargs="*", type=Path, help="design files (every shipped one)")
    parser.add_argument("--to", type=Path, required=True, metavar="DIR", help="folder of the sheets")
    parser.add_argument("--width", type=int, choices=[width for width, _ in SIZES], help="this width alone")
    parser.add_argument("--scheme", choices=SCHEMES, help="this scheme alone")
    options = parser.parse_args()
    options.to.mkdir(parents=True, exist_ok=True)
    sizes = [size for size in SIZES if options.width in (None, size[0])]
    kinds = [(size, scheme) for size in sizes for scheme in SCHEMES if options.scheme in (None, scheme)]
    sheets = {kind: [] for kind in kinds}
    wrong = 0
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        for design in options.designs or SHIPPED:
            with tempfile.TemporaryDirectory() as folder:
                copy = Path(folder) / design.name
                copy.write_text(design.read_text())
                with studio(copy) as running:
                    for size, scheme in kinds:
                        look = {"size": size, "color_scheme": scheme}
                        with shown(browser, running.url, ready=lambda page: settled(page, PATIENCE), **look) as page:
                            pictures, found = looked_at(page, size[0])
                        sheets[size, scheme] += [(design.stem, picture) for picture in pictures]
                        for fault in found:
                            print(f"{design.stem} {size[0]} {scheme}: {fault}", flush=True)
                        wrong += len(found)
        browser.close()
    for ((width, _), scheme), pictures in sheets.items():
        sheet(pictures, 6 if width < 1000 else 4).save(options.to / f"{width}-{scheme}.png")
    print(f"{sum(map(len, sheets.values()))} pictures in {options.to}, {wrong} faults")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
