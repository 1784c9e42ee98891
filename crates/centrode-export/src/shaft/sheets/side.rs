//! The shaft from the side, and its surface unrolled below.

use super::{SECTION, scaled};
use crate::{
    ExportError,
    shaft::{developed, side_view},
    turned::{centre, centre_mark, cutting_plane},
};
use crate::{fit, grade};
use centrode_formats::sheet::number;
use centrode_formats::{
    drawing::{Anchor, Drawing},
    sheet::{Draft, Pen, Scale},
};
use centrode_geometry::{Point, Tolerance, Vector};
use centrode_groove::{ShaftSolid, SpiralShaft};
use std::f64::consts::TAU;

/// Gap between two views, mm.
const APART: f64 = 14.0;

/// Both views at full scale, to be laid out at any scale.
pub(super) struct Views<'a> {
    shaft: &'a SpiralShaft,
    side: Drawing,
    development: Drawing,
    whole: [f64; 2],
    thick: [f64; 2],
}

impl<'a> Views<'a> {
    pub(super) fn new(shaft: &'a SpiralShaft, tolerance: Tolerance) -> Result<Self, ExportError> {
        let solid = ShaftSolid::new(shaft.groove(), shaft.body())?;
        Ok(Self {
            shaft,
            side: side_view(shaft, tolerance)?,
            development: developed(shaft, tolerance)?,
            whole: solid.whole(),
            thick: solid.ends(),
        })
    }

    /// Both views one below the other on a common axis.
    pub(super) fn draft(&self, scale: Scale, letters: f64) -> Draft {
        let mut draft = self.side(scale, letters);
        let below = self.development(scale, letters);
        let (own, other) = (draft.bounds(), below.bounds());
        // The unrolled surface is no projected view: it is below in either projection.
        draft.add(&below, Vector::new(0.0, own.min.y - APART - other.max.y));
        draft
    }

    fn side(&self, scale: Scale, letters: f64) -> Draft {
        let k = scale.factor();
        let mut draft = Draft::lettered(letters).at_scale(k);
        for entity in &self.side.entities {
            let pen = match entity.layer.as_str() {
                "PROFILE" => Pen::Outline,
                "EDGE" => Pen::Thin,
                "AXES" => Pen::Axis,
                _ => continue,
            };
            if let Some(shape) = scaled(&entity.shape, k, |p| p) {
                draft.draw(pen, shape);
            }
        }
        let p = |x: f64, y: f64| Point::new(k * x, k * y);
        let (groove, body) = (self.shaft.groove(), self.shaft.body());
        let (r, j) = (groove.radius(), 0.5 * body.journal_diameter);
        let ([start, end], [low, high]) = (self.whole, self.thick);
        let under = |row: f64| Point::new(0.0, -k * r - 8.0 - 8.0 * row);
        let along = Vector::x();
        let length = |a: f64, b: f64| number(b - a, 3);
        let c = body.chamfer;
        let lead = groove.traverse().law().lead();
        let turns = groove.traverse().holes() - 1;
        let picks = lead * f64::from(turns);
        let words = format!("{turns} x {} = {}", number(lead, 4), number(picks, 4));
        draft.dimension([p(0.0, -r), p(picks, -r)], along, under(0.0), &words);
        let mut span = |row: f64, [a, b]: [(f64, f64); 2]| {
            let words = length(a.0, b.0);
            draft.dimension([p(a.0, -a.1), p(b.0, -b.1)], along, under(row), &words);
        };
        let (near, far) = ((low - c, r - c), (high + c, r - c));
        span(1.0, [near, (0.0, r)]);
        span(2.0, [(start, j - c), near]);
        span(2.0, [near, far]);
        span(2.0, [far, (end, j - c)]);
        span(3.0, [(start, j - c), (end, j - c)]);
        let beside = |column: f64| Point::new(k * end + 12.0 + 9.0 * column, 0.0);
        let upright = Vector::y();
        let diameter = |d: f64| format!("Ø{}", number(d, 3));
        // The words of the journal's diameter extend beyond its arrows: its dimension is the outer one, so that no extension line
        // runs through them.
        draft.dimension(
            [p(end, -j), p(end, j)],
            upright,
            beside(1.0),
            &fit::bore(2.0 * j, &body.journal_fit),
        );
        draft.dimension(
            [p(high, -r), p(high, r)],
            upright,
            beside(0.0),
            &diameter(2.0 * r),
        );
        if body.keyway.is_some() {
            let to = start + body.keyway_length;
            let above = Point::new(0.0, k * r + 8.0);
            draft.dimension(
                [p(start, j), p(to, j)],
                along,
                above,
                &number(body.keyway_length, 3),
            );
            cutting_plane(&mut draft, [start, to].map(|x| k * x), k * j + 2.0, SECTION);
        }
        if let Some(frame) = grade::runout(2.0 * r, "A") {
            let tip = p(0.5 * (low + high), r);
            draft.pointed_frame(tip, tip + Vector::new(5.0, 16.0), &frame, "");
        }
        if centre(body.journal_diameter).is_some() {
            for (x, way) in [(start, -1.0), (end, 1.0)] {
                centre_mark(&mut draft, p(x, 0.0), way);
            }
        }
        if c > 0.0 {
            let tip = p(high + 0.5 * c, r - 0.5 * c);
            let elbow = tip + Vector::new(6.0, 7.0);
            draft.leader(tip, elbow, &[format!("4× {} x 45°", number(c, 3))]);
        }
        draft
    }

    fn development(&self, scale: Scale, letters: f64) -> Draft {
        let k = scale.factor();
        let mut draft = Draft::lettered(letters).at_scale(k);
        let unrolled = |p: Point| Point::new(p.y, -p.x);
        for entity in &self.development.entities {
            let pen = match entity.layer.as_str() {
                "BLANK" => Pen::Thin,
                "WALL" => Pen::Outline,
                "CENTER" => Pen::Axis,
                "PICK" => Pen::Thin,
                _ => continue,
            };
            if let Some(shape) = scaled(&entity.shape, k, unrolled) {
                draft.draw(pen, shape);
            }
        }
        let groove = self.shaft.groove();
        let around = TAU * groove.radius();
        let [low, high] = self.thick;
        let p = |x: f64, y: f64| Point::new(k * x, k * y);
        let left = Point::new(k * low - 12.0, 0.0);
        let words = format!("{} = 360°", number(around, 4));
        draft.dimension([p(low, -around), p(low, 0.0)], Vector::y(), left, &words);
        let below = |row: f64| Point::new(0.0, -k * around - 8.0 - 8.0 * row);
        let (near, far) = groove.traverse().reach();
        let words = format!("{} (slider travel)", number(far - near, 4));
        draft.dimension(
            [p(near, -around), p(far, -around)],
            Vector::x(),
            below(0.0),
            &words,
        );
        let words = number(high - low, 3);
        draft.dimension(
            [p(low, -around), p(high, -around)],
            Vector::x(),
            below(1.0),
            &words,
        );
        let title = Point::new(0.5 * k * (low + high), 6.0 + letters);
        draft.text(title, 5.0, "Development", Anchor::Middle);
        draft
    }
}
