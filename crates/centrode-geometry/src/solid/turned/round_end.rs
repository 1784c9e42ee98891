//! Half round ends of a slot in a cylinder, as milled with an end mill.

use crate::COMPUTED;
use std::f64::consts::FRAC_PI_2;

use super::boundary::RingedPart;
use super::ring::{Ring, oriented};
use super::{Turned, TurnedSection, TurnedSlot};
use crate::curve::BezierFit;
use crate::{
    numeric::gauss_legendre,
    solid::{ShellBuilder, ShellSide, ShellSurface},
};

/// A section, or a cylinder in which the slot ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    pub(super) section: TurnedSection,
    /// Whether the slot comes from below, if it ends half round in this part.
    pub(super) slot_from_below: Option<bool>,
}

impl Part {
    /// Whether the slot reaches the lower (0) or upper (1) end.
    pub(super) fn is_slotted(&self, end: usize) -> bool {
        match self.slot_from_below {
            Some(from_below) => from_below == (end == 0),
            None => self.section.slotted,
        }
    }
}

impl Turned {
    /// The sections, with each half round end of the slot as a separate cylinder.
    ///
    /// Such a cylinder consists of half the width of the slot from the slotted section, and of the plain one next to it.
    pub(super) fn parts(&self) -> Vec<Part> {
        let all = &self.sections;
        let rounded = self.slot.filter(|slot| slot.rounded);
        let Some(half) = rounded.map(|slot| 0.5 * slot.width) else {
            let plain = |section: &TurnedSection| Part {
                section: *section,
                slot_from_below: None,
            };
            return all.iter().map(plain).collect();
        };
        let neighbour = |index: usize, up: bool| match up {
            true => all.get(index + 1),
            false => all.get(index.wrapping_sub(1)),
        };
        // Whether the slot of a section ends in a cylinder of equal radius without the slot.
        let ends_in = |index: usize, up: bool| {
            let own = all[index];
            let plain = neighbour(index, up).filter(|other| !other.slotted);
            let is_equal = |other: &&TurnedSection| other.radii == own.radii;
            own.slotted && own.radii[0] == own.radii[1] && plain.filter(is_equal).is_some()
        };
        let is_round = |index: usize, up: bool| {
            let both = f64::from(u8::from(ends_in(index, !up))) + 1.0;
            ends_in(index, up) && all[index].length >= both * half * (1.0 - COMPUTED)
        };
        let mut parts = Vec::new();
        for (index, section) in all.iter().enumerate() {
            let part = |length: f64, end: Option<bool>| Part {
                section: TurnedSection { length, ..*section },
                slot_from_below: end,
            };
            if section.slotted {
                let ends = [false, true].map(|up| f64::from(u8::from(is_round(index, up))));
                let length = section.length - half * (ends[0] + ends[1]);
                if length > COMPUTED * half {
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
        part: &RingedPart<'_>,
        slot: TurnedSlot,
        from_below: bool,
        open: [Vec<usize>; 2],
    ) {
        let sign = if from_below { 1.0 } else { -1.0 };
        let [low, high] = &part.rings;
        let ring: &Ring = if from_below { low } else { high };
        let (half, last) = (0.5 * slot.width, ring.last());
        // Quarters of the end: from the wall at -y to the crest, and from there to the other wall.
        let fit = BezierFit::default();
        let quarter = |first: f64, on_floor: bool| {
            fit.through(&|x| {
                let (sin, cos) = (FRAC_PI_2 * (first + x)).sin_cos();
                let y = half * sin;
                let out = match on_floor {
                    true => slot.floor,
                    false => (ring.radius * ring.radius - y * y).sqrt(),
                };
                [out, y, ring.height + sign * half * cos]
            })
        };
        let ends = |floor: bool| {
            let floor_vertices = [&open[1], &open[0]].map(|side| side[0]);
            let edges = [ring.at(last), ring.at(0)];
            if floor { floor_vertices } else { edges }
        };
        let crests =
            [slot.floor, ring.radius].map(|x| builder.vertex([x, 0.0, ring.height + sign * half]));
        let mut curves = [true, false].map(|on_floor| {
            let [from, to] = ends(on_floor).map(|vertex| builder.position(vertex));
            let crest = builder.position(crests[usize::from(!on_floor)]);
            let mut both = [-1.0, 0.0].map(|first| quarter(first, on_floor));
            let [one, other] = &mut both;
            let end = one.len() - 1;
            (one[0], one[end], other[0], other[end]) = (from, crest, crest, to);
            both
        });
        let [floor, rim] = &mut curves;
        let floor_sides = [0, 1].map(|i| builder.bezier(floor[i].clone()));
        let rim_sides = [0, 1].map(|i| builder.bezier(rim[i].clone()));
        let out = builder.line(crests[0], crests[1]);
        // The round wall, in two quarters.
        let inwards: Vec<usize> = open[1].iter().rev().copied().collect();
        let mut first = builder.lines(&inwards);
        first.extend([floor_sides[0], out, rim_sides[0].reversed()]);
        let mut second = vec![out.reversed(), floor_sides[1]];
        second.extend(builder.lines(&open[0]));
        second.push(rim_sides[1].reversed());
        for (i, bound) in [first, second].into_iter().enumerate() {
            let surface = ShellSurface::Ruled {
                points: [floor[i].clone(), rim[i].clone()],
                outward: from_below,
            };
            builder.face(surface, vec![oriented(bound, sign)]);
        }
        let plane = ShellSurface::Plane {
            point: [slot.floor, 0.0, ring.height],
            normal: [1.0, 0.0, 0.0],
        };
        let mut bound = vec![builder.line(open[1][0], open[0][0])];
        bound.extend([floor_sides[1], floor_sides[0]].map(ShellSide::reversed));
        builder.face(plane, vec![oriented(bound, sign)]);
        // The cylinder, except over the end of the slot.
        let up: Vec<ShellSide> = (0..=last)
            .map(|i| builder.line(low.at(i), high.at(i)))
            .collect();
        let round = || ShellSurface::Cylinder {
            radius: ring.radius,
        };
        for i in 0..last {
            let [top, left] = [high.arc(builder, i), up[i]].map(ShellSide::reversed);
            let bottom = low.arc(builder, i);
            builder.face(round(), vec![vec![bottom, up[i + 1], top, left]]);
        }
        let left = up[last].reversed();
        let [one, other] = rim_sides;
        let bound = match from_below {
            true => vec![one, other, up[0], high.arc(builder, last).reversed(), left],
            false => {
                let [one, other] = [one, other].map(ShellSide::reversed);
                vec![low.arc(builder, last), up[0], other, one, left]
            }
        };
        builder.face(round(), vec![bound]);
    }
}

impl TurnedSlot {
    /// Visits quadrature nodes over the half round end of the slot: distance along the axis from the straight part, mm, weight,
    /// and a slot of the width there.
    pub(super) fn along_end(self, mut cut: impl FnMut(f64, f64, Self)) {
        let half = 0.5 * self.width;
        gauss_legendre(0.0, FRAC_PI_2, |angle, weight| {
            let (sin, cos) = angle.sin_cos();
            let width = self.width * cos;
            cut(half * sin, weight * half * cos, Self { width, ..self });
        });
    }
}
