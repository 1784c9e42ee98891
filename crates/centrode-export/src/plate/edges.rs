//! Views of a plate's edge, and of the wall that an opening goes through.

use centrode_formats::sheet::{Draft, Pen, number, steady};
use centrode_geometry::{Bounds, Point, Vector};
use centrode_spec::Projection;

use super::{Exactness, Plate};
use crate::fit;

/// Words of the runout of both faces.
const FACES: &str = "both faces";
/// Decimals of lengths.
const PLACES: usize = 3;

impl Plate {
    /// Diameter of a round plate, mm.
    pub(super) fn round(&self) -> Option<f64> {
        let (_, radius) = self.outline.as_circle()?;
        Some(2.0 * radius)
    }

    /// Axis and diameter of the tip circle of a toothed plate, mm: the plate is turned before its teeth are cut.
    pub(super) fn blank(&self) -> Option<(Point, f64)> {
        let is_toothed = matches!(self.exactness, Some(Exactness::Teeth(_)));
        let (_, axis) = self.first_datum().filter(|_| is_toothed)?;
        Some((axis, steady(2.0 * self.reach(axis))))
    }

    /// The edge next to the face, seen from the left: in first angle it is on the right.
    pub(super) fn edge(&self, draft: &mut Draft, k: f64, projection: Projection) {
        let whole = draft.bounds();
        let Bounds { min, max } = self.outline.bounds();
        let blank = self.blank();
        let [low, high] = match blank {
            Some((axis, diameter)) => [-0.5, 0.5].map(|half| k * (axis.y + half * diameter)),
            None => [min.y, max.y].map(|y| k * y),
        };
        let thick = self.thickness * k;
        let gap = 14.0;
        let left = match projection {
            Projection::FirstAngle => whole.max.x + gap,
            Projection::ThirdAngle => whole.min.x - gap - thick - 16.0,
        };
        let p = Point::new;
        let edge = Bounds {
            min: p(left, low),
            max: p(left + thick, high),
        };
        draft.rectangle(Pen::Outline, edge);
        let heights = [p(left + thick, low), p(left + thick, high)];
        let beside = p(left + thick + 9.0, low);
        let round = self.round().or(blank.map(|(_, diameter)| diameter));
        let words = match round {
            // Tips are exact only within the tolerance of the files: the diameter has no tolerance class.
            Some(diameter) if blank.is_some() => format!("Ø{}", number(diameter, PLACES)),
            Some(diameter) => fit::bore(diameter, &self.classes[0]),
            None => fit::keyway(max.y - min.y, &self.classes[0]),
        };
        draft.dimension(heights, Vector::y(), beside, &words);
        if round.is_some() {
            let middle = 0.5 * (low + high);
            let ends = [left - 3.0, left + thick + 3.0].map(|x| p(x, middle));
            draft.line(Pen::Axis, ends[0], ends[1]);
        }
        let across = [p(left, low), p(left + thick, low)];
        draft.dimension(
            across,
            Vector::x(),
            p(left, low - 12.0),
            &number(self.thickness, PLACES),
        );
        if let Some(frame) = self.face_runout() {
            let tip = p(left, high - 0.2 * (high - low));
            // Words of a short dimension are above it: the frame ends before them.
            let before = left + thick + 4.0 - frame.width(FACES);
            let at = p(
                (left - 4.0).min(before),
                (high + 8.0).max(whole.max.y + 4.0),
            );
            draft.pointed_frame(tip, at, &frame, FACES);
        }
    }

    /// The wall that an opening goes through, seen from the right; its view is on the other side of the face than that of the
    /// edge.
    pub(super) fn front(&self, draft: &mut Draft, k: f64, projection: Projection) {
        let Some(opening) = &self.opening else {
            return;
        };
        let whole = draft.bounds();
        let Bounds { min, max } = self.outline.bounds();
        let thick = self.thickness * k;
        let left = match projection {
            Projection::FirstAngle => whole.min.x - 14.0 - thick,
            Projection::ThirdAngle => whole.max.x + 26.0,
        };
        let p = Point::new;
        let rectangle = |[low, high]: [Point; 2]| Bounds {
            min: low,
            max: high,
        };
        let corners = [p(left, min.y * k), p(left + thick, max.y * k)];
        draft.rectangle(Pen::Outline, rectangle(corners));
        let heights = opening.outer.map(|at| at.y * k);
        let heights = [heights[0].min(heights[1]), heights[0].max(heights[1])];
        let across = opening.span.map(|z| left + 0.5 * thick + z * k);
        let corners = [p(across[0], heights[0]), p(across[1], heights[1])];
        draft.rectangle(Pen::Outline, rectangle(corners));
        let middle = 0.5 * (heights[0] + heights[1]);
        draft.line(
            Pen::Axis,
            p(left - 3.0, middle),
            p(left + thick + 3.0, middle),
        );
        let sides = heights.map(|y| p(across[0], y));
        let words = fit::keyway((heights[1] - heights[0]) / k, &self.classes[1]);
        draft.dimension(sides, Vector::y(), p(left - 9.0, heights[0]), &words);
    }
}
