"""What the suite tries of much that is alike: some designs of each family, some looks of the page.

`pytest -m campaign` tries the rest.
"""

import pytest

# Shipped designs: a pair of one lobe and one of several, each family, and machines of cams, gears and bars.
DESIGNS = (
    "elliptic-pair-2018",
    "lobed-pair-3-2",
    "spiral-shaft-2018",
    "moving-box-2018",
    "feeder-2022",
    "three-arm-2021",
    "index-table",
    "press",
)


def sampled(values, of=DESIGNS):
    """Values for `parametrize`: those that are not of the sample, by name or file name, are left to the campaign."""
    return [
        value if getattr(value, "stem", value) in of else pytest.param(value, marks=pytest.mark.campaign)
        for value in values
    ]


def looks(*widths):
    """Widths and colour schemes of the page for `parametrize`: the suite tries the first in light, the last in dark."""
    tried = ((widths[0], "light"), (widths[-1], "dark"))
    return [
        pytest.param(*look, id="-".join(map(str, look)), marks=() if look in tried else pytest.mark.campaign)
        for look in ((width, scheme) for width in widths for scheme in ("light", "dark"))
    ]
