"""Public names of the crates, read from the pages that `cargo doc` has made of them.

Run as a program it writes `api.txt` next to each crate's `Cargo.toml`, unless CHANGELOG.md does not name what has gone;
with `--check` it compares and writes nothing.
"""

import re
import sys
from pathlib import Path

from public_names import ROOT, read, removed, untold, written

DOCS = ROOT / "target" / "doc"
CRATES = sorted(path.parent for path in (ROOT / "crates").glob("*/Cargo.toml"))
# Of an item's page: fields, variants, and methods but those of traits, which every type may have.
KINDS = "structfield|variant|method|tymethod|associatedconstant|associatedtype"
MEMBER = re.compile(rf'id="(?:{KINDS})\.(\w+)" class="([^"]*)"')


def names(crate, docs=DOCS):
    """Every public item of a crate with its members; no parameters, which the compiler tells its users."""
    name = crate.name.replace("-", "_")
    pages = re.findall(r'<li><a href="([^"]+)">([\w:]+)</a></li>', (docs / name / "all.html").read_text())
    found = {name: None}
    for page, item in pages:
        # The folders of an item are modules.
        path = [name, *item.split("::")]
        found |= {".".join(path[:length]): None for length in range(1, len(path) + 1)}
        for member, classes in MEMBER.findall(Path(docs, name, page).read_text()):
            if "trait-impl" not in classes:
                found[".".join([*path, member])] = None
    return found


def main():
    new = {crate / "api.txt": names(crate) for crate in CRATES}
    old = {kept: read(kept.read_text()) for kept in new if kept.exists()}
    gone = [name for kept, found in old.items() for name in removed(found, new[kept])]
    if missing := untold(gone, (ROOT / "CHANGELOG.md").read_text()):
        words = ", ".join(f"`{name}`" for name in missing)
        sys.exit(f"tell in CHANGELOG.md, below [Unreleased], what has gone, then run scripts/api crates: {words}")
    if sys.argv[1:] == ["--check"]:
        if stale := [kept.relative_to(ROOT).as_posix() for kept, found in new.items() if old.get(kept) != found]:
            sys.exit(f"run scripts/api crates: {', '.join(stale)} lacks what is new or has what has gone")
        return
    for kept, found in new.items():
        kept.write_text(written(found))


if __name__ == "__main__":
    main()
