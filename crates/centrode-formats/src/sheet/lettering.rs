//! Lettering of a sheet: the font, and the length and height of a line of words.

use centrode_geometry::{Bounds, Point, Vector};
use skrifa::{
    FontRef, GlyphId, MetadataProvider,
    instance::{LocationRef, Size},
    outline::{DrawSettings, OutlinePen, pen::ControlBoundsPen},
};
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// Leroy-style drafting font with strokes of a tenth of its height, as in ISO 3098 type B.
pub(crate) const FONT: &[u8] = include_bytes!("../../font/CentrodeLettering.ttf");

static FACE: LazyLock<Option<FontRef<'static>>> = LazyLock::new(|| FontRef::new(FONT).ok());

/// Metrics of a letter, in ems, for setting a line.
#[derive(Clone, Copy)]
struct Metrics {
    glyph: GlyphId,
    advance: f64,
    ink: Option<Bounds>,
}

/// Metrics of every letter the font has, and of its empty box.
static METRICS: LazyLock<(BTreeMap<u32, Metrics>, Metrics)> = LazyLock::new(|| {
    let of = |glyph| {
        let widths = FACE
            .as_ref()
            .map(|face| face.glyph_metrics(Size::unscaled(), LocationRef::default()));
        let advance = widths.and_then(|w| w.advance_width(glyph));
        // The boxes around the ink that the font stores are not reliable: they are computed from the outline.
        let mut pen = ControlBoundsPen::new();
        draw(glyph, &mut pen);
        let corner = |x: f32, y: f32| Point::new(f64::from(x), f64::from(y)) / UNITS;
        let ink = pen.bounding_box().map(|b| Bounds {
            min: corner(b.x_min, b.y_min),
            max: corner(b.x_max, b.y_max),
        });
        let advance = f64::from(advance.unwrap_or(0.0)) / UNITS;
        Metrics {
            glyph,
            advance,
            ink,
        }
    };
    let mappings = FACE.iter().flat_map(|face| face.charmap().mappings());
    let letters = mappings.map(|(letter, glyph)| (letter, of(glyph)));
    (letters.collect(), of(GlyphId::NOTDEF))
});

fn draw(glyph: GlyphId, pen: &mut impl OutlinePen) {
    let outline = FACE.as_ref().and_then(|f| f.outline_glyphs().get(glyph));
    if let Some(outline) = outline {
        let unscaled = DrawSettings::unhinted(Size::unscaled(), LocationRef::default());
        // A glyph without a readable outline has no ink.
        let _ = outline.draw(unscaled, pen);
    }
}

/// Font units per em.
pub(crate) const UNITS: f64 = 1024.0;

/// Height of a capital, relative to the em.
const CAPITAL: f64 = 736.0 / UNITS;

/// Size of the font, mm per em, for capitals of this height.
#[must_use]
pub(crate) fn em(height: f64) -> f64 {
    height / CAPITAL
}

/// A letter in a line: glyph, its bytes in the words, and advance in ems.
pub(crate) struct Letter {
    pub(crate) glyph: u32,
    pub(crate) bytes: std::ops::Range<usize>,
    pub(crate) advance: f64,
    ink: Option<Bounds>,
}

impl Letter {
    /// Whether there is anything to draw; false for a blank.
    pub(crate) fn is_inked(&self) -> bool {
        self.ink.is_some()
    }

    /// The empty box instead of a letter that the font lacks, in ems from its start.
    pub(crate) fn empty_box(&self) -> Option<Bounds> {
        self.ink.filter(|_| self.glyph == GlyphId::NOTDEF.to_u32())
    }
}

/// The letters of a line; a letter that the font lacks becomes the empty box.
pub(crate) fn letters(words: &str) -> impl Iterator<Item = Letter> + '_ {
    let (letters, missing) = &*METRICS;
    words.char_indices().map(move |(at, c)| {
        let metrics = letters.get(&u32::from(c)).unwrap_or(missing);
        Letter {
            glyph: metrics.glyph.to_u32(),
            bytes: at..at + c.len_utf8(),
            advance: metrics.advance,
            ink: metrics.ink,
        }
    })
}

/// Length of a line of words with capitals this high, mm.
#[must_use]
pub fn width(words: &str, height: f64) -> f64 {
    letters(words).map(|l| l.advance).sum::<f64>() * em(height)
}

/// Rectangle around the ink of a line that starts at the origin, mm.
#[must_use]
pub fn ink(words: &str, height: f64) -> Bounds {
    let (mut bounds, mut x) = (Bounds::EMPTY, 0.0);
    let em = em(height);
    for letter in letters(words) {
        if let Some(ink) = letter.ink {
            let along = Vector::new(x, 0.0);
            bounds = bounds.with(ink.min * em + along);
            bounds = bounds.with(ink.max * em + along);
        }
        x += letter.advance * em;
    }
    bounds
}

/// The outline of a glyph as an SVG path in font units, y downwards; empty for a blank.
pub(crate) fn path(glyph: u32) -> String {
    let mut path = Path::default();
    draw(GlyphId::new(glyph), &mut path);
    path.0
}

#[derive(Default)]
struct Path(String);

impl Path {
    fn step(&mut self, command: char, points: &[(f32, f32)]) {
        self.0.push(command);
        for (i, (x, y)) in points.iter().enumerate() {
            let gap = if i > 0 { " " } else { "" };
            self.0.push_str(&format!("{gap}{} {}", x, -y + 0.0));
        }
    }
}

impl OutlinePen for Path {
    fn move_to(&mut self, x: f32, y: f32) {
        self.step('M', &[(x, y)]);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.step('L', &[(x, y)]);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.step('Q', &[(x1, y1), (x, y)]);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.step('C', &[(x1, y1), (x2, y2), (x, y)]);
    }

    fn close(&mut self) {
        self.0.push('Z');
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_font_has_the_letters_of_a_drawing_and_figures_of_one_width() {
        let needed = "Ø°±×√αβφπ∅ØÄÖÜäöüßéèçñ–·≤≥≈".replace('∅', "⌀");
        for c in needed.chars().chain('!'..='~') {
            let letter = letters(&c.to_string()).next().expect("one letter").glyph;
            assert_ne!(letter, 0, "{c} is missing");
        }
        let digit = width("0", 3.5);
        assert!(('0'..='9').all(|c| (width(&c.to_string(), 3.5) - digit).abs() < 1e-12));
        assert!((width("00", 7.0) - 4.0 * digit).abs() < 1e-12);
        let ink = ink("H", 3.5);
        assert!((ink.max.y - 3.5).abs() < 0.05 && ink.min.y.abs() < 0.05);
    }
}
