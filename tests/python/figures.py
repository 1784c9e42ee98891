"""Figures of a page: numbers in its sentences and tables, found by their words and held against computed ones."""

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

NUMBER = r"\d+(?:,\d{3})*(?:\.\d+)?(?:e[-+]?\d+)?"
# A number, with its sign; digits within a name or a word, such as r2, A4 and 3MF, are none.
FREE = re.compile(rf"(?<![\w.,&#-])(?:(?<=[\s|(*±])[-+])?{NUMBER}(?![\w]|[.,]\d)|(?<=\d-){NUMBER}(?![\w]|[.,]\d)")
# Code is run elsewhere; addresses, formulas and pictures hold no figures.
ASIDE = re.compile(
    r"^(`{3,}).*?^\1$|^(?: {4}[^\n]*\n)+|`[^`\n]+`"  # blocks of code, code in a line
    r"|\]\([^)]*\)|https?://\S+|\b(?:DOI |arXiv:)\S+"
    r"|\$\$.*?\$\$|\$[^$\n]+\$|<sub>.*?</sub>|<[^>]*>",
    re.M | re.S,
)


class FigureError(Exception):
    """A figure of a page is not the computed one."""


@dataclass
class Said:
    """Words of a page: `{}` for a figure that is computed, `{<}` for a bound it keeps, `...` for any words."""

    words: str
    figures: Callable[[], Sequence[float] | float]

    @cached_property
    def computed(self) -> list[float]:
        """The figures, computed once."""
        found = self.figures()
        return [float(one) for one in ([found] if np.isscalar(found) else found)]


def shown(text: str) -> str:
    """The text with all that holds no figures blanked out, every other character where it was."""
    blank = lambda found: re.sub(r"[^\n]", "\0", found[0])  # noqa: E731
    return ASIDE.sub(blank, text)


def numbers(text: str) -> Iterator[tuple[int, int]]:
    """Where the numbers of a page begin and end."""
    return (found.span() for found in FREE.finditer(shown(text)))


def pattern(words: str) -> re.Pattern[str]:
    """Finds words however their lines are broken."""
    kinds = {"{}": rf"([-+]?{NUMBER})", "{<}": rf"([-+]?{NUMBER})", "...": r"[^\n]*?", " ": r"\s+"}
    parts = re.split(r"(\{<?\}|\.{3}|\s+)", words)
    return re.compile("".join(kinds.get(part) or re.escape(part) for part in parts))


def value(printed: str) -> tuple[float, float]:
    """A printed number, and half a unit in its last digit."""
    digits, _, power = printed.replace(",", "").partition("e")
    places = len(digits.partition(".")[2])
    return float(digits + "e" + (power or "0")), 0.5 * 10.0 ** (int(power or 0) - places)


def held(text: str, said: Said) -> list[tuple[int, int]]:
    """Places of the figures of one sentence or row; each must be the computed one to its last digit."""
    found = list(pattern(said.words).finditer(text))
    if len(found) != 1:
        raise FigureError(f"{said.words!r} stands {len(found)} times on the page")
    kinds = re.findall(r"\{<?\}", said.words)
    for printed, kind, computed in zip(found[0].groups(), kinds, said.computed, strict=True):
        number, half = value(printed)
        if not (abs(computed) <= number if kind == "{<}" else abs(computed - number) <= half * (1 + 1e-6)):
            raise FigureError(f"{said.words!r} says {printed}, computed is {computed!r}")
    return groups(found[0])


def faults(text: str, sentences: Sequence[Said]) -> list[str]:
    """Faults of all sentences of a page."""
    told = []
    for said in sentences:
        try:
            held(text, said)
        except FigureError as fault:
            told.append(str(fault))
    return told


def changed(text: str, said: Said, start: int, end: int) -> str:
    """The text with another last digit of a figure, or a bound that is too small."""
    digits, _, power = text[start:end].partition("e")
    last = 0 if "{<}" in said.words else (int(digits[-1]) + 5) % 10
    wrong = f"{digits}e{int(power) - 9}" if power else f"{digits[:-1]}{last}"
    return text[:start] + wrong + text[end:]


def uncovered(text: str, sentences: Sequence[Said], exempt: Sequence[str]) -> list[str]:
    """Numbers, with their lines, that no sentence holds and no exempt pattern matches."""
    spans = [span for said in sentences for found in pattern(said.words).finditer(text) for span in groups(found)]
    spans += [found.span() for one in exempt for found in re.finditer(one, text, re.M)]
    left = [span for span in numbers(text) if not any(a <= span[0] and span[1] <= b for a, b in spans)]
    return [f"{text.count(chr(10), 0, start) + 1}: {text[start:end]}: {line(text, start)}" for start, end in left]


def exempted(text: str, pattern: str) -> bool:
    """True: an exempt pattern matches some number."""
    spans = [found.span() for found in re.finditer(pattern, text, re.M)]
    return any(a <= start and end <= b for start, end in numbers(text) for a, b in spans)


def groups(found: re.Match[str]) -> list[tuple[int, int]]:
    """Places of the groups of a match."""
    return [found.span(group + 1) for group in range(len(found.groups()))]


def line(text: str, place: int) -> str:
    """The line of a place."""
    return text[text.rfind("\n", 0, place) + 1 :].partition("\n")[0]
