//! Objects that only the newer version has: dimensions with their styles and pictures, hatched areas.

use super::entities::Writer;
use super::pairs::{Handle, Pairs};
use super::tables::{record, table};
use crate::drawing::{Dimension, Drawing, EntityShape, Group, Hatch, Object};
use centrode_geometry::{Point, Segment};

/// Style of dimensions with one height of letters and one scale.
#[derive(Clone, Copy, PartialEq)]
struct Style {
    letters: f64,
    scale: f64,
}

/// The dimensions of a drawing, each with its group of drawn entities.
fn dimensions(drawing: &Drawing) -> impl Iterator<Item = (&Dimension, &Group)> {
    drawing
        .entities
        .iter()
        .filter_map(|entity| match &entity.shape {
            EntityShape::Group(group) => match &group.object {
                Object::Dimension(dimension) => Some((dimension, group)),
                Object::Hatch(_) => None,
            },
            _ => None,
        })
}

/// The styles in use, in order of appearance.
fn styles(drawing: &Drawing) -> Vec<Style> {
    let mut found = Vec::new();
    for (dimension, _) in dimensions(drawing) {
        let style = Style::new(dimension);
        if !found.contains(&style) {
            found.push(style);
        }
    }
    found
}

impl Style {
    fn new(dimension: &Dimension) -> Self {
        Self {
            letters: dimension.letters,
            scale: dimension.scale,
        }
    }

    /// Name of the style, by its position among all.
    fn name(self, styles: &[Self]) -> String {
        let index = styles.iter().position(|style| *style == self);
        format!("ISO129-{}", index.map_or(0, |i| i + 1))
    }
}

/// Name of the block with the picture of a dimension.
fn block_name(index: usize) -> String {
    format!("*D{}", index + 1)
}

/// Names of all blocks with pictures of dimensions.
pub(super) fn block_names(drawing: &Drawing) -> Vec<String> {
    (0..dimensions(drawing).count()).map(block_name).collect()
}

/// The table of dimension styles; lengths are in millimetres of the part at any scale.
pub(super) fn dimension_styles(file: &mut Pairs, drawing: &Drawing, lettering: Option<Handle>) {
    const CLASS: &str = "AcDbDimStyleTableRecord";
    let styles = styles(drawing);
    let owner = table(file, "DIMSTYLE", 1 + styles.len());
    file.class("AcDbDimStyleTable");
    record(file, owner, "DIMSTYLE", CLASS, "STANDARD");
    for style in &styles {
        record(file, owner, "DIMSTYLE", CLASS, &style.name(&styles));
        // Overall factor, arrows, gap and length of extension lines, letters, factor of lengths, gap below words.
        for (code, value) in [
            (40, 1.0),
            (41, 3.0),
            (42, 0.8),
            (44, 2.0),
            (140, style.letters),
            (144, 1.0 / style.scale),
            (147, 1.3),
        ] {
            file.number(code, value);
        }
        // Words along and above the line, no zeros at the end, three digits, a point.
        for (code, value) in [(73, 0), (74, 0), (77, 1), (78, 8), (271, 3), (278, 46)] {
            file.whole(code, value);
        }
        if let Some(lettering) = lettering {
            file.handle(340, lettering);
        }
    }
    file.word(0, "ENDTAB");
}

/// The blocks with pictures of dimensions, owned by their records.
pub(super) fn blocks(
    writer: &mut Writer<'_>,
    drawing: &Drawing,
    records: &[Handle],
    block: impl Fn(&mut Writer<'_>, &str, Handle, &dyn Fn(&mut Writer<'_>)),
) {
    for (index, ((_, group), record)) in dimensions(drawing).zip(records).enumerate() {
        block(writer, &block_name(index), *record, &|writer| {
            for entity in &group.drawn {
                writer.entity(drawing, entity);
            }
        });
    }
}

impl Writer<'_> {
    /// Writes a linear dimension; its picture is in the block with its number.
    pub(super) fn dimension(
        &mut self,
        layer: &str,
        dimension: &Dimension,
        index: usize,
        drawing: &Drawing,
    ) {
        const ROTATED: u32 = 0;
        const OWN_BLOCK: u32 = 32;
        const WORDS_PLACED: u32 = 128;
        let style = Style::new(dimension).name(&styles(drawing));
        let [a, b] = dimension.ends;
        let file = self.begin("DIMENSION", layer, "AcDbDimension");
        file.word(2, &block_name(index));
        file.point(10, &dimension.line).point(11, &dimension.middle);
        file.whole(70, ROTATED + OWN_BLOCK + WORDS_PLACED);
        file.line(1, &escaped(&dimension.words)).whole(71, 5);
        file.number(42, (b - a).dot(&dimension.along).abs());
        file.word(3, &style).class("AcDbAlignedDimension");
        file.point(13, &a).point(14, &b);
        let angle = dimension.along.y.atan2(dimension.along.x);
        file.number(50, angle.to_degrees());
        file.class("AcDbRotatedDimension");
    }

    /// Writes a hatched area: its contours, and one family of lines.
    pub(super) fn hatch(&mut self, layer: &str, hatch: &Hatch) {
        const POLYLINE: u32 = 2;
        const EXTERNAL: u32 = 1;
        let tolerance = self.tolerance;
        let file = self.begin("HATCH", layer, "AcDbHatch");
        file.point(10, &Point::origin());
        file.number(210, 0.0).number(220, 0.0).number(230, 1.0);
        file.word(2, "_USER").whole(70, 0).whole(71, 0);
        file.whole(91, hatch.contours.len() as u32);
        for contour in &hatch.contours {
            let arcs = contour.arcs(tolerance);
            file.whole(92, POLYLINE + EXTERNAL);
            file.whole(72, 1).whole(73, 1);
            file.whole(93, arcs.segments().len() as u32);
            for segment in arcs.segments() {
                let bulge = match segment {
                    Segment::Arc(arc) => arc.bulge,
                    _ => 0.0,
                };
                file.flat(10, &segment.start()).number(42, bulge);
            }
            file.whole(97, 0);
        }
        let degrees = hatch.angle.to_degrees();
        // Hatch every second area from outside, with a user-defined pattern.
        file.whole(75, 0).whole(76, 0).number(52, degrees);
        file.number(41, hatch.spacing).whole(77, 0).whole(78, 1);
        file.number(53, degrees).number(43, hatch.origin.x);
        file.number(44, hatch.origin.y);
        file.number(45, -hatch.spacing * hatch.angle.sin());
        file.number(46, hatch.spacing * hatch.angle.cos());
        file.whole(79, 0).whole(98, 0);
    }
}

/// Words of a dimension with backslash and braces escaped, because they begin codes.
fn escaped(words: &str) -> String {
    let mut out = String::new();
    for letter in words.chars() {
        if matches!(letter, '\\' | '{' | '}') {
            out.push('\\');
        }
        out.push(letter);
    }
    out
}
