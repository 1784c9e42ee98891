//! Exact contours of an arm, in the arm's frame with the pusher's axis below the planet's.

use std::f64::consts::FRAC_PI_2;

use centrode_geometry::{Arc, Outline, Point, Segment, Vector};

/// Sizes of the contour: lengths in mm, the pusher's axis at `y = -offset`, the tip at `x = tip`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Contour {
    pub(super) drum_radius: f64,
    pub(super) tube_radius: f64,
    /// X coordinates of the centres of the tube's rounded ends.
    pub(super) rear: f64,
    pub(super) front: f64,
    pub(super) offset: f64,
    pub(super) tip: f64,
    /// Half heights of the clamp.
    pub(super) root: f64,
    pub(super) end: f64,
}

impl Contour {
    fn on_axis(&self, x: f64) -> Point {
        Point::new(x, -self.offset)
    }

    /// Belt around drum and tube.
    pub(super) fn housing(&self) -> Option<Outline> {
        self.belt(0.0)
    }

    pub(super) fn belt(&self, inset: f64) -> Option<Outline> {
        Outline::hull(&[
            (Point::origin(), self.drum_radius - inset),
            (self.on_axis(self.rear), self.tube_radius - inset),
            (self.on_axis(self.front), self.tube_radius - inset),
        ])
    }

    /// Belt whose round front is split at two corners, where a bar along the pusher's axis leaves the belt; `half` is half the
    /// height of the bar. Also the two corners, the lower one first. `None` if the bar does not leave through the front.
    pub(super) fn split(&self, inset: f64, half: f64) -> Option<(Outline, [Point; 2])> {
        let radius = self.tube_radius - inset;
        let front = self.on_axis(self.front);
        let leaves = (half < radius).then(|| (half / radius).asin())?;
        let at = |angle: f64| front + Vector::new(angle.cos(), angle.sin()) * radius;
        let corners = [at(-leaves), at(leaves)];
        let way = |p: Point| (p.y - front.y).atan2(p.x - front.x);
        let mut segments = Vec::new();
        let mut split = false;
        for segment in self.belt(inset)?.segments() {
            let Segment::Arc(arc) = segment else {
                segments.push(*segment);
                continue;
            };
            let of_front = (arc.center() - front).norm() < 1e-9 * radius;
            let (from, to) = (way(arc.start), way(arc.end));
            if !of_front || from >= -leaves || to <= leaves {
                segments.push(*segment);
                continue;
            }
            split = true;
            let round = |start, end, turn: f64| {
                let bulge = (0.25 * turn).tan();
                Segment::Arc(Arc { start, end, bulge })
            };
            segments.extend([
                round(arc.start, corners[0], -leaves - from),
                round(corners[0], corners[1], 2.0 * leaves),
                round(corners[1], arc.end, to - leaves),
            ]);
        }
        let outline = split.then(|| Outline::new(segments).ok())??;
        Some((outline, corners))
    }

    /// Side view of a flake of the clamp: rounded at both ends, tapered.
    pub(super) fn flake(&self) -> Option<Outline> {
        Outline::hull(&[
            (self.on_axis(self.front), self.root),
            (self.on_axis(self.tip - self.end), self.end),
        ])
    }

    /// Direction of the normal of the flake's upper side, rad.
    fn slant(&self) -> f64 {
        let length = self.tip - self.end - self.front;
        ((self.root - self.end) / length).acos()
    }

    /// Direction, from the centre of the tube's rounded front, of the point where the flake's upper side leaves this front, rad.
    fn leaves(&self) -> f64 {
        self.slant() - (self.root / self.tube_radius).acos()
    }

    /// Half the height, mm, at which a clamp of this taper would just leave the tube's rounded front.
    pub(super) fn room(&self) -> f64 {
        // The front is round up to the point where the belt leaves it towards the drum.
        let way = Vector::new(-self.front, self.offset);
        let share = (self.tube_radius - self.drum_radius) / way.norm();
        let upper = way.y.atan2(way.x) - share.clamp(-1.0, 1.0).acos();
        self.tube_radius * (self.slant() - upper.clamp(0.0, FRAC_PI_2)).cos()
    }

    /// Contour of housing and clamp together; `None` if the clamp does not leave through the tube's rounded front.
    pub(super) fn whole(&self) -> Option<Outline> {
        let housing = self.housing()?;
        let leaves = self.leaves();
        let front = self.on_axis(self.front);
        let at = |radius: f64, angle: f64| Vector::new(angle.cos(), angle.sin()) * radius;
        let mut segments = Vec::new();
        let mut split = false;
        for segment in housing.segments() {
            let Segment::Arc(arc) = segment else {
                segments.push(*segment);
                continue;
            };
            let way = |p: Point| (p.y - front.y).atan2(p.x - front.x);
            let of_front = (arc.center() - front).norm() < 1e-9 * self.tube_radius;
            let (from, to) = (way(arc.start), way(arc.end));
            if !of_front || from > -leaves || to < leaves {
                segments.push(*segment);
                continue;
            }
            split = true;
            let (low, high) = (
                front + at(self.tube_radius, -leaves),
                front + at(self.tube_radius, leaves),
            );
            let end = self.on_axis(self.tip - self.end);
            let slant = self.slant();
            let (under, over) = (end + at(self.end, -slant), end + at(self.end, slant));
            let round = |start, end, turn: f64| {
                let bulge = (0.25 * turn).tan();
                Segment::Arc(Arc { start, end, bulge })
            };
            segments.extend([
                round(arc.start, low, -leaves - from),
                Segment::Line(low, under),
                round(under, over, 2.0 * slant),
                Segment::Line(over, high),
                round(high, arc.end, to - leaves),
            ]);
        }
        split.then(|| Outline::new(segments).ok())?
    }

    /// A bar along the pusher's axis; `half` is half its height.
    pub(super) fn bar(&self, from: f64, to: f64, half: f64) -> Outline {
        let corner = |x: f64, side: f64| self.on_axis(x) + Vector::new(0.0, side * half);
        Outline::polygon(&[
            corner(from, -1.0),
            corner(to, -1.0),
            corner(to, 1.0),
            corner(from, 1.0),
        ])
    }
}

/// Mirror image of an outline in the x axis, again counter-clockwise.
pub(super) fn mirrored(outline: &Outline) -> Option<Outline> {
    let flip = |p: Point| Point::new(p.x, -p.y);
    let segments = outline
        .segments()
        .iter()
        .rev()
        .map(|segment| match segment {
            Segment::Line(start, end) => Some(Segment::Line(flip(*end), flip(*start))),
            Segment::Arc(arc) => Some(Segment::Arc(Arc {
                start: flip(arc.end),
                end: flip(arc.start),
                bulge: arc.bulge,
            })),
            Segment::Poly(_) => None,
        });
    Outline::new(segments.collect::<Option<Vec<_>>>()?).ok()
}
