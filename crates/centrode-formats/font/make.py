# ruff: noqa: RUF001 - the letters drawn here are meant
"""Makes the lettering font of the drawing sheets out of Routed Gothic (SIL Open Font License 1.1).

    python make.py routed-gothic.ttf CentrodeLettering.ttf

ISO 3098 type B asks for strokes of h/10, the figures of a table for one width, and a drawing for a few Greek letters
and signs: strokes are thinned, the figure 1 widened, and the missing letters drawn with the same pen.
Needs fonttools and shapely.
"""

import math
import sys

from fontTools.fontBuilder import FontBuilder
from fontTools.pens.basePen import BasePen
from fontTools.pens.ttGlyphPen import TTGlyphPen
from fontTools.ttLib import TTFont
from shapely import transform
from shapely.affinity import translate
from shapely.geometry import LineString, MultiPolygon, Polygon
from shapely.geometry.polygon import orient
from shapely.ops import unary_union

NAME = "Centrode Lettering"
CAPITAL = 736.0
STROKE = 96.0
WANTED = CAPITAL / 10
FIGURE = 616
LIMIT = 0.6  # font units a curve may leave its chord


class Flatten(BasePen):
    """Contours as closed lists of points."""

    def __init__(self, glyphs):
        """Starts with no contour."""
        super().__init__(glyphs)
        self.contours = []

    def _moveTo(self, point):  # noqa: N802 - the base class names it
        self.contours.append([point])

    def _lineTo(self, point):  # noqa: N802 - the base class names it
        self.contours[-1].append(point)

    def _curveToOne(self, a, b, c):  # noqa: N802 - the base class names it
        start = self._getCurrentPoint()
        for i in range(1, 9):
            t = i / 8
            weights = ((1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t**3)
            points = (start, a, b, c)
            self.contours[-1].append(tuple(sum(w * p[k] for w, p in zip(weights, points, strict=True)) for k in (0, 1)))


def area(glyphs, name):
    """The filled area of a glyph, winding number not zero."""
    pen = Flatten(glyphs)
    glyphs[name].draw(pen)
    outer, holes = [], []
    for contour in pen.contours:
        polygon = Polygon(contour).buffer(0)
        (outer if not Polygon(contour).exterior.is_ccw else holes).append(polygon)
    return unary_union(outer).difference(unary_union(holes)) if outer else Polygon()


def arc(cx, cy, rx, ry, start, end):
    """Points of an elliptic arc, angles in degrees."""
    steps = max(4, int(abs(end - start) / 10))
    angles = (math.radians(start + (end - start) * i / steps) for i in range(steps + 1))
    return [(cx + rx * math.cos(a), cy + ry * math.sin(a)) for a in angles]


# Advance and pen strokes, in units of a capital of 736; x-height 488 on the middle of the pen.
X = 488
DRAWN = {
    "α": (560, [[(470, X), (400, 120), (430, 30), (500, 30)], [*arc(240, 259, 190, 229, -38, 322)[3:-3], (440, 330)]]),
    "β": (
        560,
        [
            [(90, -200), (90, 560), *arc(250, 560, 150, 150, 180, -60)],
            [(210, 420), (260, 420), *arc(270, 225, 195, 195, 90, -90), (210, 30), (90, 90)],
        ],
    ),
    "γ": (540, [[(70, X), (260, 60), (470, X)], [(260, 60), (250, -190)]]),
    "δ": (560, [arc(270, 240, 200, 210, 90, 450), [(270, 450), (150, 600), (190, 690), (300, 710), (420, 680)]]),
    "ε": (
        500,
        [
            [(420, 420), (330, 488), (210, 488), (110, 430), (120, 320), (230, 270)],
            [(230, 270), (100, 220), (70, 120), (140, 40), (270, 30), (420, 100)],
            [(230, 270), (310, 270)],
        ],
    ),
    "η": (560, [[(90, X), (90, 30)], [(90, 330), *arc(270, 310, 180, 178, 170, 0), (450, -190)]]),
    "θ": (560, [arc(270, 370, 190, 340, 0, 360), [(80, 370), (460, 370)]]),
    "κ": (520, [[(90, X), (90, 30)], [(430, X), (90, 220)], [(210, 310), (440, 30)]]),
    "λ": (540, [[(90, 700), (170, 700), (460, 30)], [(270, 460), (80, 30)]]),
    "μ": (
        580,
        [
            [(90, X), (90, -190)],
            [(90, 190), *arc(265, 200, 175, 170, 180, 360), (440, X)],
            [(440, 200), (450, 60), (510, 30)],
        ],
    ),
    "ν": (520, [[(70, X), (260, 30), (450, X)]]),
    "ξ": (
        500,
        [
            [(120, 710), (400, 710)],
            [(300, 710), (120, 600), (200, 450), (340, 440)],
            [(200, 450), (80, 300), (110, 120), (400, 40), (410, -80), (330, -170)],
        ],
    ),
    "π": (640, [[(60, X), (580, X)], [(190, X), (180, 30)], [(450, X), (450, 120), (490, 40), (560, 40)]]),
    "ρ": (560, [[(90, -190), (90, 270), *arc(280, 265, 190, 230, 180, -180)]]),
    "σ": (580, [arc(260, 259, 190, 229, 90, 450), [(260, X), (530, X)]]),
    "τ": (500, [[(60, X), (440, X)], [(250, X), (250, 120), (300, 40), (390, 40)]]),
    "φ": (640, [arc(320, 259, 240, 229, 0, 360), [(320, 710), (320, -190)]]),
    "χ": (540, [[(80, X), (460, -190)], [(460, X), (80, -190)]]),
    "ψ": (640, [[(80, X), (90, 230), *arc(320, 250, 230, 220, 185, 355), (560, X)], [(320, 710), (320, -190)]]),
    "ω": (
        700,
        [
            [(170, X), (80, 330), *arc(210, 190, 135, 160, 170, 350), (345, 330)],
            [(345, 330), *arc(480, 190, 135, 160, 190, 370), (610, 330), (520, X)],
        ],
    ),
    "Γ": (560, [[(90, 36), (90, 700), (500, 700)]]),
    "Δ": (680, [[(60, 36), (340, 700), (620, 36), (60, 36)]]),
    "Θ": (720, [arc(360, 368, 270, 332, 0, 360), [(220, 368), (500, 368)]]),
    "Λ": (660, [[(60, 36), (330, 700), (600, 36)]]),
    "Π": (680, [[(90, 36), (90, 700), (590, 700), (590, 36)]]),
    "Σ": (620, [[(540, 700), (90, 700), (360, 380), (90, 36), (550, 36)]]),
    "Φ": (720, [arc(360, 368, 270, 230, 0, 360), [(360, 736), (360, 0)]]),
    "Ψ": (720, [[(90, 700), (90, 480), *arc(360, 480, 270, 230, 180, 360), (630, 700)], [(360, 736), (360, 0)]]),
    "Ω": (
        740,
        [[(70, 36), (260, 36), (260, 110), *arc(370, 400, 280, 300, 230, -50), (480, 110), (480, 36), (670, 36)]],
    ),
    "√": (640, [[(40, 330), (130, 370), (270, 20), (450, 760), (620, 760)]]),
    "≤": (640, [[(540, 600), (100, 400), (540, 200)], [(100, 60), (540, 60)]]),
    "≥": (640, [[(100, 600), (540, 400), (100, 200)], [(100, 60), (540, 60)]]),
    "≈": (
        640,
        [
            [(90, 400), (180, 470), (320, 430), (460, 390), (550, 460)],
            [(90, 200), (180, 270), (320, 230), (460, 190), (550, 260)],
        ],
    ),
    "∠": (640, [[(540, 600), (90, 36), (570, 36)]]),
    "∞": (800, [arc(240, 368, 150, 150, 45, 315) + arc(560, 368, 150, 150, 225, 495) + [(346, 474)]]),
    "…": (760, [[(130, 37), (130, 38)], [(380, 37), (380, 38)], [(630, 37), (630, 38)]]),
    "⌀": (736, [arc(368, 368, 300, 300, 0, 360), [(110, 36), (626, 700)]]),
}


def outline(shape):
    """A TrueType glyph: outer contours clockwise."""
    pen = TTGlyphPen(None)
    polygons = shape.geoms if isinstance(shape, MultiPolygon) else [shape]
    for polygon in polygons:
        if polygon.is_empty:
            continue
        polygon = orient(polygon, -1)
        for ring in (polygon.exterior, *polygon.interiors):
            points = [(round(x), round(y)) for x, y in ring.coords[:-1]]
            pen.moveTo(points[0])
            for point in points[1:]:
                pen.lineTo(point)
            pen.closePath()
    return pen.glyph()


def main(source, target):
    """Reads one font and writes the other."""
    font = TTFont(source)
    glyphs, metrics = font.getGlyphSet(), font["hmtx"]
    thinner = (STROKE - WANTED) / 2
    grow = CAPITAL / (CAPITAL - 2 * thinner)
    shapes, advances, table = (
        {
            ".notdef": Polygon(
                [(60, 0), (440, 0), (440, 736), (60, 736)], [[(130, 70), (370, 70), (370, 666), (130, 666)]]
            )
        },
        {".notdef": 500},
        {},
    )
    for code, name in sorted(font.getBestCmap().items()):
        if chr(code) in DRAWN:
            continue
        thinned = area(glyphs, name).buffer(-thinner, quad_segs=4)
        thinned = transform(thinned, lambda a: (a - [0, thinner]) * grow)
        advance = metrics[name][0]
        if chr(code).isdigit() and advance < FIGURE:
            middle = (thinned.bounds[0] + thinned.bounds[2]) / 2
            thinned = translate(thinned, FIGURE / 2 - middle)
            advance = FIGURE
        elif chr(code) in "0123456789":
            thinned = translate(thinned, (FIGURE - advance) / 2)
            advance = FIGURE
        shapes[f"u{code:04X}"], advances[f"u{code:04X}"] = thinned, advance
        table[code] = f"u{code:04X}"
    for letter, (advance, strokes) in DRAWN.items():
        pen = unary_union([LineString(points).buffer(WANTED / 2, quad_segs=6) for points in strokes])
        shapes[f"u{ord(letter):04X}"], advances[f"u{ord(letter):04X}"] = pen, advance
        table[ord(letter)] = f"u{ord(letter):04X}"
    order = [".notdef", *sorted(n for n in shapes if n != ".notdef")]
    drawn = {name: outline(shapes[name].simplify(LIMIT)) for name in order}
    builder = FontBuilder(1024, isTTF=True)
    builder.setupGlyphOrder(order)
    builder.setupCharacterMap(table)
    builder.setupGlyf(drawn)
    builder.setupHorizontalMetrics({n: (int(advances[n]), getattr(drawn[n], "xMin", 0) or 0) for n in order})
    builder.setupHorizontalHeader(ascent=1000, descent=-300)
    builder.setupNameTable(
        {
            "copyright": "Copyright (c) 2017, Darren Embry, with Reserved Font Name Routed Gothic. "
            "Thinned and extended for drawing sheets by the centrode authors.",
            "familyName": NAME,
            "styleName": "Regular",
            "uniqueFontIdentifier": "CentrodeLettering-Regular-1",
            "fullName": NAME,
            "psName": "CentrodeLettering-Regular",
            "version": "Version 1.0",
            "licenseDescription": "This Font Software is licensed under the SIL Open Font License, Version 1.1.",
            "licenseInfoURL": "https://openfontlicense.org",
        }
    )
    builder.setupOS2(
        sTypoAscender=1000,
        sTypoDescender=-300,
        usWinAscent=1000,
        usWinDescent=300,
        sCapHeight=736,
        sxHeight=528,
        version=4,
    )
    builder.setupPost(keepGlyphNames=False)
    builder.font["head"].created = builder.font["head"].modified = 3_600_000_000
    builder.font.recalcTimestamp = False
    builder.save(target)


if __name__ == "__main__":
    main(*sys.argv[1:])
