//! PDF pages.

use crate::{
    drawing::{EntityShape, LineType, Text},
    sheet::{Sheet, lettering},
};
use centrode_geometry::{Bounds, Outline, Point, Segment, Tolerance};
use krilla::{
    Document, SerializeSettings,
    color::luma,
    configure::{Archival, ConfigurationBuilder},
    destination::XyzDestination,
    geom::{Path, PathBuilder, Point as Place, Transform},
    metadata::{DateTime, Metadata},
    num::NormalizedF32,
    outline::{Outline as Contents, OutlineNode},
    page::PageSettings,
    paint::{Fill, LineCap, LineJoin, Stroke, StrokeDash},
    surface::Surface,
    text::{Font, GlyphId, KrillaGlyph},
};
use thiserror::Error;

/// Points per millimetre.
const POINT: f64 = 72.0 / 25.4;

/// Reason why sheets could not be written as PDF.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum PdfError {
    /// The lettering font cannot be read.
    #[error("the lettering font cannot be read")]
    Font,
    /// The PDF library refused.
    #[error("cannot write PDF: {0}")]
    Library(String),
}

/// Writes sheets as the pages of one PDF/A-2b: exact sizes, strokes of true width, the font embedded.
///
/// Equal sheets give equal bytes: the date is fixed.
///
/// # Errors
/// [`PdfError`] if the library refuses.
pub fn write(sheets: &[Sheet], title: &str, tolerance: Tolerance) -> Result<Vec<u8>, PdfError> {
    book(&[(title, sheets)], title, tolerance)
}

/// Writes the sheets of several parts as one PDF/A-2b like [`write()`], each part by its name in the list of contents.
///
/// # Errors
/// [`PdfError`] if the library refuses.
pub fn book(
    parts: &[(&str, &[Sheet])],
    title: &str,
    tolerance: Tolerance,
) -> Result<Vec<u8>, PdfError> {
    let font = Font::new(lettering::FONT.into(), 0).ok_or(PdfError::Font)?;
    let refused = |error| PdfError::Library(format!("{error:?}"));
    let archival = ConfigurationBuilder::new().with_archival_validator(Archival::A2_B);
    let mut document = Document::new_with(SerializeSettings {
        configuration: archival.finish().map_err(refused)?,
        ..SerializeSettings::default()
    });
    let metadata = Metadata::new().title(title.to_owned());
    // The archive format requires a date.
    let dated = metadata.creation_date(DateTime::new(1970).month(1).day(1));
    document.set_metadata(dated.language("en".into()));
    if parts.len() > 1 {
        let mut contents = Contents::new();
        let mut page = 0;
        for (name, sheets) in parts {
            let top = XyzDestination::new(page, Place::from_xy(0.0, 0.0));
            contents.push_child(OutlineNode::new((*name).to_owned(), top));
            page += sheets.len();
        }
        document.set_outline(contents);
    }
    for sheet in parts.iter().flat_map(|(_, sheets)| *sheets) {
        let [width, height] = sheet.size.size().map(|mm| (mm * POINT) as f32);
        let settings = PageSettings::from_wh(width, height)
            .ok_or_else(|| PdfError::Library(format!("a page cannot be {width} x {height} pt")))?;
        let mut page = document.start_page_with(settings);
        let mut surface = page.surface();
        let writer = Writer {
            font: font.clone(),
            height: sheet.size.size()[1],
            tolerance,
        };
        for layer in &sheet.drawing.layers {
            let entities = sheet.drawing.plain();
            for entity in entities.filter(|e| e.layer == layer.name) {
                writer.shape(
                    &mut surface,
                    &entity.shape,
                    layer.line_type,
                    layer.line_width,
                );
            }
        }
        surface.finish();
        page.finish();
    }
    document
        .finish()
        .map_err(|error| PdfError::Library(format!("{error:?}")))
}

struct Writer {
    font: Font,
    height: f64,
    tolerance: Tolerance,
}

impl Writer {
    /// A point of the sheet in points from the upper left corner.
    fn place(&self, p: &Point) -> (f32, f32) {
        let (x, y) = (p.x * POINT, (self.height - p.y) * POINT);
        (x as f32, y as f32)
    }

    fn shape(
        &self,
        surface: &mut Surface<'_>,
        shape: &EntityShape,
        line_type: LineType,
        width: f64,
    ) {
        match shape {
            EntityShape::Text(text) => return self.text(surface, text),
            EntityShape::Triangle(corners) => {
                surface.set_fill(Some(black()));
                surface.set_stroke(None);
                if let Some(path) = self.polygon(corners, true) {
                    surface.draw_path(&path);
                }
                return;
            }
            _ => {}
        }
        surface.set_fill(None);
        surface.set_stroke(Some(stroke(line_type, width)));
        let paths = match shape {
            EntityShape::Contour(outline) => {
                vec![self.curve(&outline.cubics(self.tolerance), true)]
            }
            EntityShape::Circle { center, radius } => {
                let circle = Outline::circle(*center, *radius);
                vec![self.curve(&circle.cubics(self.tolerance), true)]
            }
            EntityShape::Arc(arc) => {
                // Cubics for pieces of at most 0.4 rad differ from the arc by less than 1e-4 of its radius.
                let parts = (arc.sweep().abs() / 0.4).ceil().max(1.0);
                let segment = Segment::Arc(*arc);
                let at = |i: f64| segment.at(-1.0 + 2.0 * i / parts);
                let cubics: Vec<[Point; 4]> = (0..parts as u32)
                    .map(|i| {
                        let (a, b) = (at(f64::from(i)), at(f64::from(i) + 1.0));
                        let third = 2.0 / (3.0 * parts);
                        [
                            a.point,
                            a.point + a.first * third,
                            b.point - b.first * third,
                            b.point,
                        ]
                    })
                    .collect();
                vec![self.curve(&cubics, false)]
            }
            EntityShape::Polyline(points) => vec![self.polygon(points, false)],
            EntityShape::Line(a, b) => vec![self.polygon(&[*a, *b], false)],
            EntityShape::Mark(p) => {
                let reach = 6.0 * width;
                let q = |x: f64, y: f64| Point::new(p.x + x, p.y + y);
                vec![
                    self.polygon(&[q(-reach, 0.0), q(reach, 0.0)], false),
                    self.polygon(&[q(0.0, -reach), q(0.0, reach)], false),
                ]
            }
            EntityShape::Text(_) | EntityShape::Triangle(_) | EntityShape::Group(_) => Vec::new(),
        };
        for path in paths.into_iter().flatten() {
            surface.draw_path(&path);
        }
    }

    fn polygon(&self, points: &[Point], closed: bool) -> Option<Path> {
        let mut builder = PathBuilder::new();
        for (index, point) in points.iter().enumerate() {
            let (x, y) = self.place(point);
            if index == 0 {
                builder.move_to(x, y);
            } else {
                builder.line_to(x, y);
            }
        }
        if closed {
            builder.close();
        }
        builder.finish()
    }

    fn curve(&self, cubics: &[[Point; 4]], closed: bool) -> Option<Path> {
        let mut builder = PathBuilder::new();
        for (index, cubic) in cubics.iter().enumerate() {
            let [a, b, c, d] = cubic.map(|p| self.place(&p));
            if index == 0 {
                builder.move_to(a.0, a.1);
            }
            builder.cubic_to(b.0, b.1, c.0, c.1, d.0, d.1);
        }
        if closed {
            builder.close();
        }
        builder.finish()
    }

    fn text(&self, surface: &mut Surface<'_>, text: &Text) {
        let natural = lettering::width(&text.words, text.height);
        let squeeze = text.width.map_or(1.0, |width| width / natural);
        let blank = lettering::letters(" ")
            .next()
            .map_or(0, |blank| blank.glyph);
        let glyphs: Vec<KrillaGlyph> = lettering::letters(&text.words)
            .map(|letter| {
                // The archive format forbids letters that the font lacks: a box is drawn instead.
                let missing = letter.empty_box().is_some();
                let glyph = GlyphId::new(if missing { blank } else { letter.glyph });
                let advance = letter.advance as f32;
                KrillaGlyph::new(glyph, advance, 0.0, 0.0, 0.0, letter.bytes, None)
            })
            .collect();
        let (x, y) = self.place(&text.baseline()[0]);
        let (sin, cos) = (text.rotation.sin() as f32, text.rotation.cos() as f32);
        let wide = squeeze as f32;
        surface.push_transform(&Transform::from_row(
            cos * wide,
            -sin * wide,
            sin,
            cos,
            x,
            y,
        ));
        surface.set_fill(Some(black()));
        surface.set_stroke(None);
        surface.draw_glyphs(
            Place::from_xy(0.0, 0.0),
            &glyphs,
            self.font.clone(),
            &text.words,
            (lettering::em(text.height) * POINT) as f32,
            false,
        );
        surface.set_fill(None);
        surface.set_stroke(Some(stroke(LineType::Continuous, 0.1 * text.height)));
        for path in boxes(text) {
            surface.draw_path(&path);
        }
        surface.pop();
    }
}

/// Boxes instead of letters that the font lacks, measured from the start of a text.
fn boxes(text: &Text) -> impl Iterator<Item = Path> {
    let em = lettering::em(text.height) * POINT;
    let mut x = 0.0;
    let boxes = lettering::letters(&text.words).filter_map(move |letter| {
        let start = x;
        x += letter.advance;
        let Bounds { min, max } = letter.empty_box()?;
        let mut builder = PathBuilder::new();
        let at = |x: f64, y: f64| (((start + x) * em) as f32, (-y * em) as f32);
        let corners = [
            at(min.x, min.y),
            at(max.x, min.y),
            at(max.x, max.y),
            at(min.x, max.y),
        ];
        builder.move_to(corners[0].0, corners[0].1);
        for (x, y) in &corners[1..] {
            builder.line_to(*x, *y);
        }
        builder.close();
        builder.finish()
    });
    boxes.collect::<Vec<_>>().into_iter()
}

fn black() -> Fill {
    Fill {
        paint: luma::Color::black().into(),
        opacity: NormalizedF32::ONE,
        ..Fill::default()
    }
}

fn stroke(line_type: LineType, width: f64) -> Stroke {
    let array: Vec<f32> = line_type
        .pattern()
        .iter()
        .map(|d| (d.abs().max(0.01) * POINT) as f32)
        .collect();
    Stroke {
        width: (width * POINT) as f32,
        line_cap: LineCap::Round,
        line_join: LineJoin::Round,
        dash: (!array.is_empty()).then_some(StrokeDash { array, offset: 0.0 }),
        ..Stroke::default()
    }
}
