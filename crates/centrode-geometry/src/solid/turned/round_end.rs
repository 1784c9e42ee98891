//! Half round ends of a slot within a cylinder, as an end mill leaves them.

use std::f64::consts::FRAC_PI_2;

use super::boundary::Walled;
use super::ring::{Ring, seen};
use super::{ROUNDING, Turned, TurnedSection, TurnedSlot};
use crate::curve::BezierFit;
use crate::{
    numeric::gauss_legendre,
    solid::{ShellBuilder, ShellSide, ShellSurface},
};

/// A section, or a cylinder in which the slot ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    pub(super) section: TurnedSection,
    /// Where the slot ends half round in it, whether it comes from below.
    pub(super) end: Option<bool>,
}

impl Part {
    /// Whether the slot is in its lower or its upper end.
    pub(super) fn is_slotted(&self, end: usize) -> bool {
        match self.end {
            Some(from_below) => from_below == (end == 0),
            None => self.section.slotted,
        }
    }
}

impl Turned {
    /// Sections with the half round ends of the slot as cylinders of their own: each takes half the slot's width of the slotted
    /// cylinder, and the plain one beside it.
    pub(super) fn parts(&self) -> Vec<Part> {
        let all = &self.sections;
        let rounded = self.slot.filter(|slot| slot.rounded);
        let Some(half) = rounded.map(|slot| 0.5 * slot.width) else {
            let plain = |section: &TurnedSection| Part {
                section: *section,
                end: None,
            };
            return all.iter().map(plain).collect();
        };
        let beside = |index: usize, up: bool| match up {
            true => all.get(index + 1),
            false => all.get(index.wrapping_sub(1)),
        };
        // Whether the slot of a section has a cylinder of its radius, without the slot, to end in.
        let ends_in = |index: usize, up: bool| {
            let own = all[index];
            let plain = beside(index, up).filter(|other| !other.slotted);
            let alike = |other: &&TurnedSection| other.radii == own.radii;
            own.slotted && own.radii[0] == own.radii[1] && plain.filter(alike).is_some()
        };
        let is_round = |index: usize, up: bool| {
            let both = f64::from(u8::from(ends_in(index, !up))) + 1.0;
            ends_in(index, up) && all[index].length >= both * half * (1.0 - ROUNDING)
        };
        let mut parts = Vec::new();
        for (index, section) in all.iter().enumerate() {
            let part = |length: f64, end: Option<bool>| Part {
                section: TurnedSection { length, ..*section },
                end,
            };
            if section.slotted {
                let ends = [false, true].map(|up| f64::from(u8::from(is_round(index, up))));
                let length = section.length - half * (ends[0] + ends[1]);
                if length > ROUNDING * half {
                    parts.push(part(length, None));
                }
                continue;
            }
            let below = index > 0 && is_round(index - 1, true);
            let above = index + 1 < all.len() && is_round(index + 1, false);
            let own = section.length;
            match (below, above) {
                (true, true) => {
                    let each = half + 0.5 * own;
                    parts.extend([part(each, Some(true)), part(each, Some(false))]);
                }
                (true, false) => parts.push(part(half + own, Some(true))),
                (false, true) => parts.push(part(half + own, Some(false))),
                (false, false) => parts.push(part(own, None)),
            }
        }
        parts
    }

    /// Faces of a cylinder in which the slot ends.
    pub(super) fn round_end(
        &self,
        builder: &mut ShellBuilder,
        part: &Walled<'_>,
        slot: TurnedSlot,
        (from_below, open): (bool, [Vec<usize>; 2]),
    ) {
        let way = if from_below { 1.0 } else { -1.0 };
        let [low, high] = &part.rings;
        let ring: &Ring = if from_below { low } else { high };
        let (half, last) = (0.5 * slot.width, ring.last());
        // Quarters of the end from the wall at the lesser y to the crest, and on to the other wall.
        let fit = BezierFit::default();
        let quarter = |first: f64, on_floor: bool| {
            fit.through(&|x| {
                let (sin, cos) = (FRAC_PI_2 * (first + x)).sin_cos();
                let y = half * sin;
                let out = match on_floor {
                    true => slot.foot,
                    false => (ring.radius * ring.radius - y * y).sqrt(),
                };
                [out, y, ring.height + way * half * cos]
            })
        };
        let ends = |floor: bool| {
            let feet = [&open[1], &open[0]].map(|side| side[0]);
            let edges = [ring.at(last), ring.at(0)];
            if floor { feet } else { edges }
        };
        let crests =
            [slot.foot, ring.radius].map(|x| builder.vertex([x, 0.0, ring.height + way * half]));
        let mut curves = [true, false].map(|on_floor| {
            let [from, to] = ends(on_floor).map(|vertex| builder.place(vertex));
            let crest = builder.place(crests[usize::from(!on_floor)]);
            let mut both = [-1.0, 0.0].map(|first| quarter(first, on_floor));
            let [one, other] = &mut both;
            let end = one.len() - 1;
            (one[0], one[end], other[0], other[end]) = (from, crest, crest, to);
            both
        });
        let [floor, rim] = &mut curves;
        let floor_sides = [0, 1].map(|i| builder.free(floor[i].clone()));
        let rim_sides = [0, 1].map(|i| builder.free(rim[i].clone()));
        let out = builder.line(crests[0], crests[1]);
        // The wall in its two quarters.
        let inwards: Vec<usize> = open[1].iter().rev().copied().collect();
        let mut first = builder.lines(&inwards);
        first.extend([floor_sides[0], out, ShellBuilder::back(rim_sides[0])]);
        let mut second = vec![ShellBuilder::back(out), floor_sides[1]];
        second.extend(builder.lines(&open[0]));
        second.push(ShellBuilder::back(rim_sides[1]));
        for (i, bound) in [first, second].into_iter().enumerate() {
            let surface = ShellSurface::Ruled {
                points: [floor[i].clone(), rim[i].clone()],
                outward: from_below,
            };
            builder.face(surface, vec![seen(bound, way)]);
        }
        let plane = ShellSurface::Plane {
            point: [slot.foot, 0.0, ring.height],
            normal: [1.0, 0.0, 0.0],
        };
        let mut bound = vec![builder.line(open[1][0], open[0][0])];
        bound.extend([floor_sides[1], floor_sides[0]].map(ShellBuilder::back));
        builder.face(plane, vec![seen(bound, way)]);
        // The cylinder, whole but over the slot's end.
        let up: Vec<ShellSide> = (0..=last)
            .map(|i| builder.line(low.at(i), high.at(i)))
            .collect();
        let round = || ShellSurface::Cylinder {
            radius: ring.radius,
        };
        for i in 0..last {
            let [top, left] = [high.arc(builder, i), up[i]].map(ShellBuilder::back);
            let bottom = low.arc(builder, i);
            builder.face(round(), vec![vec![bottom, up[i + 1], top, left]]);
        }
        let left = ShellBuilder::back(up[last]);
        let [one, other] = rim_sides;
        let bound = match from_below {
            true => vec![
                one,
                other,
                up[0],
                ShellBuilder::back(high.arc(builder, last)),
                left,
            ],
            false => {
                let [one, other] = [one, other].map(ShellBuilder::back);
                vec![low.arc(builder, last), up[0], other, one, left]
            }
        };
        builder.face(round(), vec![bound]);
    }
}

impl TurnedSlot {
    /// Integral over the half round end of the slot in a cylinder: calls with the distance along the axis from the straight part, a
    /// weight, and the slot as wide as it is there.
    pub(super) fn along_end(self, mut cut: impl FnMut(f64, f64, Self)) {
        let half = 0.5 * self.width;
        gauss_legendre(0.0, FRAC_PI_2, |angle, weight| {
            let (sin, cos) = angle.sin_cos();
            let width = self.width * cos;
            cut(half * sin, weight * half * cos, Self { width, ..self });
        });
    }
}
