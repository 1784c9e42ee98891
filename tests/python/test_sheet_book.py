"""All sheets of a machine as one PDF, read by another program."""

import re

import numpy as np
import pypdf
import pypdfium2
import pytest
from conftest import ROOT, centrode

NAMES = ("three-arm-2021", "moving-box-2018", "feeder-2022", "elliptic-pair-2018")


def pages(file):
    return [(page.get_size(), page.get_textpage().get_text_bounded()) for page in pypdfium2.PdfDocument(file)]


@pytest.mark.parametrize("name", NAMES)
def test_its_contents_lead_to_the_sheets_of_every_part(name, shipped):
    folder = shipped(name, "pdf")
    book = pypdf.PdfReader(folder / "sheets.pdf")
    parts = [entry.title for entry in book.outline]
    assert parts[0] == "assembly"
    assert sorted(parts) == sorted(file.stem for file in folder.glob("*.pdf") if file.stem != "sheets")
    starts = [book.get_destination_page_number(entry) for entry in book.outline]
    ends = [*starts[1:], len(book.pages)]
    whole = pages(folder / "sheets.pdf")
    for part, start, end in zip(parts, starts, ends, strict=True):
        sheets = pages(folder / f"{part}.pdf")
        assert whole[start:end] == sheets, part
        assert all(text for _, text in sheets), part


def test_it_says_that_it_is_for_archives_and_embeds_its_font(shipped):
    book = pypdf.PdfReader(shipped("three-arm-2021", "pdf") / "sheets.pdf")
    metadata = book.xmp_metadata
    assert (metadata.pdfaid_part, metadata.pdfaid_conformance) == ("2", "B")
    assert book.metadata.title.startswith("Three-arm")
    assert "/OutputIntents" in book.trailer["/Root"]
    fonts = {font for page in book.pages for font in page["/Resources"]["/Font"].values()}
    for font in fonts:
        (inner,) = font.get_object()["/DescendantFonts"]
        descriptor = inner.get_object()["/FontDescriptor"].get_object()
        assert {"/FontFile2", "/FontFile3"} & set(descriptor)


def test_words_that_the_font_has_not_stop_no_file_and_are_boxes(tmp_path):
    text = (ROOT / "tests" / "designs" / "elliptic-pair-2018.toml").read_text()

    def exported(title):
        design = tmp_path / "pair.toml"
        design.write_text(re.sub("^title = .*", f'title = "{title}"', text, flags=re.MULTILINE))
        centrode("export", design, "--to", tmp_path, "--format", "pdf")
        ink = np.asarray(pypdfium2.PdfDocument(tmp_path / "assembly.pdf")[0].render(scale=2).to_pil().convert("L"))
        return pypdf.PdfReader(tmp_path / "sheets.pdf"), np.count_nonzero(ink < 128)

    book, some = exported("水稻 Ω é 🙂 gears")
    assert book.metadata.title.startswith("水稻 Ω é 🙂 gears")
    assert "Ω é" in book.pages[0].extract_text()
    _, none = exported("Ω é gears")
    _, more = exported("水稻水稻水稻 Ω é 🙂 gears")
    assert none + 50 < some < more - 50


def test_one_part_alone_has_no_book(tmp_path):
    design = ROOT / "tests" / "designs" / "elliptic-pair-2018.toml"
    centrode("export", design, "--to", tmp_path, "--format", "pdf", "--part", "driven")
    assert {file.name for file in tmp_path.glob("[!.]*")} == {"driven.csv", "driven.pdf"}
