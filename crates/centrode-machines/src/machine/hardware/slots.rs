//! Slots of plates in which the blocks of dyads slide.

use centrode_geometry::{Outline, Point, Segment};

use crate::machine::Machine;
use crate::machine::hardware::plates::BLOCK;
use centrode_kinematics::machine::JointKind;

/// Slot of a plate, with round ends, in which the block of a dyad slides.
#[derive(Clone, Debug, PartialEq)]
pub struct Slot {
    /// Index of the body that slides in it.
    pub block: usize,
    /// Centres of its round ends in the axes of the body with the plate, mm.
    pub ends: [Point; 2],
    /// Width, the nominal height of the block, mm.
    pub width: f64,
}

impl Slot {
    /// Its contour in the axes of the body with the plate.
    #[must_use]
    pub fn outline(&self) -> Option<Outline> {
        Outline::hull(&self.ends.map(|end| (end, 0.5 * self.width)))
    }

    /// Distance of a point from its wall, mm; negative outside.
    #[must_use]
    pub fn depth(&self, at: Point) -> f64 {
        0.5 * self.width - self.distance(at)
    }

    /// Distance of a point from the line between the centres of its ends, mm.
    pub(in crate::machine) fn distance(&self, at: Point) -> f64 {
        let [from, to] = self.ends;
        let way = to - from;
        let square = way.norm_squared().max(f64::MIN_POSITIVE);
        let share = (at - from).dot(&way) / square;
        (from + way * share.clamp(0.0, 1.0) - at).norm()
    }
}

impl Machine {
    /// Slots in a body's plate, one per block of a dyad that slides in it.
    ///
    /// A slot is as wide as the block is high. Apart from its round ends, it is longer than the range of the block by
    /// `plates.gap` at each end.
    #[must_use]
    pub fn slots(&self, body: usize) -> Vec<Slot> {
        let dyads = self.dyads.iter();
        let blocks = dyads.flat_map(|dyad| dyad.bodies);
        blocks
            .filter(|&block| self.slotted(block) == Some(body))
            .filter_map(|block| self.slot(block))
            .collect()
    }

    /// Body with a slot in which the block of a dyad slides. `None` for a body that is not such a block, for a block with a given
    /// contour, with a point off its line or on another layer, and for a line of the frame, whose guides are the customer's.
    #[must_use]
    pub fn slotted(&self, block: usize) -> Option<usize> {
        let guide = self.guide(block)?;
        let layer = self.layer_of(block);
        let is_level = layer.is_none() || self.bottom(block) == self.bottom(guide);
        is_level.then_some(guide)
    }

    /// Body whose plate contains the line of a dyad's block, if the block can slide in a slot of that plate.
    pub(in crate::machine) fn guide(&self, block: usize) -> Option<usize> {
        let own = self.bodies.get(block)?;
        let mount = own.mount.as_ref()?;
        if mount.carrier == 0 || !matches!(mount.kind, JointKind::Sliding(_)) {
            return None;
        }
        let near = 1e-9 * self.design.plates.width;
        let points = self.points.get(&own.name).into_iter().flatten();
        let mut off = points.map(|(_, point)| point.at.y.abs());
        let is_guided = self.has_plate(block)
            && self.has_plate(mount.carrier)
            && !self.drawn.contains_key(&own.name)
            && off.all(|off| off <= near)
            && self.dyads.iter().any(|dyad| dyad.bodies.contains(&block));
        is_guided.then_some(mount.carrier)
    }

    fn slot(&self, block: usize) -> Option<Slot> {
        let mount = self.bodies[block].mount.as_ref()?;
        let JointKind::Sliding([low, high]) = mount.kind else {
            return None;
        };
        let circles = self.circles(block, self.width(block));
        let reach = |sign: f64| {
            let ends = circles.iter().map(|(at, radius)| sign * at.x + radius);
            ends.fold(0.0, f64::max) + self.design.plates.gap
        };
        let half = circles.iter().map(|(at, radius)| at.y.abs() + radius);
        Some(Slot {
            block,
            ends: [
                mount.along(low - reach(-1.0)),
                mount.along(high + reach(1.0)),
            ],
            width: 2.0 * half.fold(0.0, f64::max),
        })
    }

    /// Contour of a sliding body with a slot across its direction, and with a stem on both sides for its guides. Each stem
    /// extends beyond the wall of the slot by the stroke plus two widths. `None` for any other body, and if the wall is not
    /// straight over the height of the stem.
    pub(super) fn stemmed(&self, body: usize) -> Option<Outline> {
        let own = &self.bodies[body];
        let JointKind::Sliding([low, high]) = own.mount.as_ref()?.kind else {
            return None;
        };
        let (width, wall, slots) = (self.width(body), self.wall(body), self.slots(body));
        slots.first()?;
        let around = |at: Point| (at, self.boss(body, at).max(0.5 * width));
        let points = self.points.get(&own.name).into_iter().flatten();
        let points = points.map(|(_, point)| around(point.at));
        let ends = |slot: &Slot| slot.ends.map(|at| (at, 0.5 * slot.width + wall));
        let circles: Vec<(Point, f64)> = points.chain(slots.iter().flat_map(ends)).collect();
        let hull = Outline::hull(&circles)?;
        let (bounds, half) = (hull.bounds(), BLOCK[1] * width);
        let length = high - low + 2.0 * width;
        let mut sides = Vec::new();
        let mut stems = 0;
        for side in hull.segments() {
            let (from, to) = (side.start(), side.end());
            let is_across = from.y.min(to.y) < -half && from.y.max(to.y) > half;
            let Segment::Line(..) = side else {
                sides.push(*side);
                continue;
            };
            if !is_across {
                sides.push(*side);
                continue;
            }
            // The contour runs counter-clockwise: upwards on the right side.
            let (tip, first) = match to.y > from.y {
                true => (bounds.max.x + length, -half),
                false => (bounds.min.x - length, half),
            };
            let on_side =
                |y: f64| Point::new(from.x + (to.x - from.x) * (y - from.y) / (to.y - from.y), y);
            let corners = [
                from,
                on_side(first),
                Point::new(tip, first),
                Point::new(tip, -first),
                on_side(-first),
                to,
            ];
            sides.extend(
                corners
                    .windows(2)
                    .map(|ends| Segment::Line(ends[0], ends[1])),
            );
            stems += 1;
        }
        Outline::new(sides).ok().filter(|_| stems == 2)
    }

    /// Wall of a plate next to a slot, mm: equal to the wall next to the holes of its pins.
    pub(in crate::machine) fn wall(&self, body: usize) -> f64 {
        0.5 * (self.width(body) - self.design.plates.pin_diameter)
    }
}
