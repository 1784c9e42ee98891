"""Checks a built site: no link and no anchor is broken, and nothing is fetched from elsewhere."""

from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urldefrag

FETCHED = {"link": "href"} | dict.fromkeys(("img", "script", "iframe", "source", "video", "audio"), "src")


class Names(HTMLParser):
    """The anchors, links and fetched files of a page."""

    def __init__(self) -> None:
        """Empty."""
        super().__init__()
        self.anchors: set[str] = {""}
        self.links: set[str] = set()
        self.fetched: set[str] = set()

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        """Notes what the tag names or asks for."""
        given = {name: value or "" for name, value in attributes}
        self.anchors |= {given[name] for name in ("id", "name") if name in given}
        if tag == "a" and "href" in given:
            self.links.add(given["href"])
        if tag in FETCHED and FETCHED[tag] in given:
            self.fetched.add(given[FETCHED[tag]])


def read(page: Path) -> Names:
    """Reads a page."""
    names = Names()
    names.feed(page.read_text(encoding="utf-8"))
    return names


def faults(site: Path) -> list[str]:
    """Every broken link, missing anchor and file from elsewhere, each in a line."""
    pages = {page: read(page) for page in sorted(site.rglob("*.html"))}
    found = []
    for page, names in pages.items():
        where = page.relative_to(site)
        # A report is one file with its own test, and page 404 may stand in any folder.
        if where.name in ("report.html", "404.html"):
            continue
        for address in sorted(names.links | names.fetched):
            if address.startswith(("https://", "http://", "//")):
                if address in names.fetched:
                    found.append(f"{where}: {address} comes from elsewhere")
                continue
            if address.startswith(("mailto:", "data:", "javascript:")):
                continue
            file, anchor = urldefrag(unquote(address))
            target = (page.parent / file).resolve() if file else page
            if target.is_dir():
                target = target / "index.html"
            if not target.is_file():
                found.append(f"{where}: {address} leads nowhere")
            elif anchor and target in pages and anchor not in pages[target].anchors:
                found.append(f"{where}: {address} has no such anchor")
    return found
