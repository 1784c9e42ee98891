"""Hook of the site's generator: formulas in TeX become MathML, which browsers draw without a script."""

import html
import re

from latex2mathml.converter import convert

LETTER = r"(<m[in]>[^<]*</m[in]>)"
PRIME = r"<mi>&#x0203([23]);</mi>"
SIGN = r'<mo lspace="0" rspace="0">&#x0203\g<{}>;</mo>'
# A prime is raised already: browsers without a mathematical font would raise it twice.
PRIMES = {
    rf"<msup>{LETTER}{PRIME}</msup>": rf"<mrow>\1{SIGN.format(2)}</mrow>",
    rf"<msubsup>{LETTER}{LETTER}{PRIME}</msubsup>": rf"<mrow><msub>\1\2</msub>{SIGN.format(3)}</mrow>",
    rf"<msup>{LETTER}<mrow>{PRIME}{LETTER}</mrow></msup>": rf"<msup><mrow>\1{SIGN.format(2)}</mrow>\3</msup>",
}


def on_page_content(content: str, **_: object) -> str:
    """Every formula of a page, of its own line or within one."""
    return re.sub(r'<(span|div) class="arithmatex">(.*?)</\1>', formula, content, flags=re.S)


def formula(found: re.Match[str]) -> str:
    """One formula as MathML."""
    tag, text = found[1], html.unescape(found[2]).strip()
    block = tag == "div"
    text = re.sub(r"^\\[\[(]|\\[\])]$", "", text)
    made = convert(text, display="block" if block else "inline")
    for raised, plain in PRIMES.items():
        made = re.sub(raised, plain, made)
    made = re.sub(r"(?<!<msup>)(<mi>(?:sin|cos|tan)</mi>)(?=<m(?!o))", r"\1<mspace width='0.15em'></mspace>", made)
    made = re.sub(r"(?<=</m[in]>)(?=<mi>(?:sin|cos|tan)</mi>)", r"<mspace width='0.15em'></mspace>", made)
    return f'<div class="formula">{made}</div>' if block else made
