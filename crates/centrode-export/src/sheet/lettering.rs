//! The words on a sheet: the lettering font, and how long and high a line of it is.

use centrode_geometry::{Bounds, Point, Vector};
use std::sync::LazyLock;
use ttf_parser::{Face, GlyphId, OutlineBuilder, Rect};

/// A Leroy-style drafting font with strokes of a tenth of its height, as ISO 3098 type B.
pub(crate) const FONT: &[u8] = include_bytes!("../../font/CentrodeLettering.ttf");

static FACE: LazyLock<Option<Face<'static>>> = LazyLock::new(|| Face::parse(FONT, 0).ok());

/// The box around each glyph's ink. The font stores none that can be trusted: the outline is walked, once.
static BOXES: LazyLock<Vec<Option<Rect>>> = LazyLock::new(|| {
    let face = FACE.as_ref();
    let of = |f: &Face<'_>| {
        let glyphs = 0..f.number_of_glyphs();
        glyphs.map(|id| f.glyph_bounding_box(GlyphId(id))).collect()
    };
    face.map_or_else(Vec::new, of)
});

fn ink_of(glyph: GlyphId) -> Option<Rect> {
    BOXES.get(usize::from(glyph.0)).copied().flatten()
}

/// Height of a capital, as a share of the em.
const CAPITAL: f64 = 736.0 / 1024.0;

/// Size of the font, mm an em, at which capitals stand this high.
#[must_use]
pub(crate) fn em(height: f64) -> f64 {
    height / CAPITAL
}

/// A letter in a line: glyph, its bytes in the words, and advance in ems.
pub(crate) struct Letter {
    pub(crate) glyph: GlyphId,
    pub(crate) bytes: std::ops::Range<usize>,
    pub(crate) advance: f64,
}

impl Letter {
    /// Whether there is anything to draw: a blank has none.
    pub(crate) fn is_inked(&self) -> bool {
        ink_of(self.glyph).is_some()
    }
}

/// The letters of a line; one the font has not becomes its empty box.
pub(crate) fn letters(words: &str) -> impl Iterator<Item = Letter> + '_ {
    words.char_indices().map(|(at, c)| {
        let face = FACE.as_ref();
        let glyph = face.and_then(|f| f.glyph_index(c)).unwrap_or(GlyphId(0));
        let advance = face.and_then(|f| f.glyph_hor_advance(glyph)).unwrap_or(0);
        Letter {
            glyph,
            bytes: at..at + c.len_utf8(),
            advance: f64::from(advance) / 1024.0,
        }
    })
}

/// Length of a line of words with capitals this high, mm.
#[must_use]
pub(crate) fn width(words: &str, height: f64) -> f64 {
    letters(words).map(|l| l.advance).sum::<f64>() * em(height)
}

/// Rectangle around the ink of a line that starts at the origin, mm.
#[must_use]
pub(crate) fn ink(words: &str, height: f64) -> Bounds {
    let (mut bounds, mut x) = (Bounds::EMPTY, 0.0);
    let em = em(height);
    for letter in letters(words) {
        if let Some(b) = ink_of(letter.glyph) {
            let corner = |px: i16, py: i16| {
                let at = Vector::new(f64::from(px), f64::from(py)) / 1024.0;
                Point::new(x + at.x * em, at.y * em)
            };
            bounds = bounds.with(corner(b.x_min, b.y_min));
            bounds = bounds.with(corner(b.x_max, b.y_max));
        }
        x += letter.advance * em;
    }
    bounds
}

/// The outline of a glyph as an SVG path in font units, y downwards; empty for a blank.
pub(crate) fn path(glyph: GlyphId) -> String {
    let mut path = Path::default();
    if let Some(face) = FACE.as_ref() {
        face.outline_glyph(glyph, &mut path);
    }
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

impl OutlineBuilder for Path {
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
            assert_ne!(letter, GlyphId(0), "{c} is missing");
        }
        let digit = width("0", 3.5);
        assert!(('0'..='9').all(|c| (width(&c.to_string(), 3.5) - digit).abs() < 1e-12));
        assert!((width("00", 7.0) - 4.0 * digit).abs() < 1e-12);
        let ink = ink("H", 3.5);
        assert!((ink.max.y - 3.5).abs() < 0.05 && ink.min.y.abs() < 0.05);
    }
}
