use super::ring::{Ring, flat, seen, surface};
use super::round_end::Part;
use super::{Turned, TurnedSection, TurnedSlot};
use crate::curve::BezierFit;
use crate::solid::{ShellBuilder, ShellSide, ShellSurface};

/// End of a turned body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TurnedEnd<'a> {
    /// A plane face.
    Flat,
    /// Another body goes on there as a cylinder, which has vertices on its rim.
    Joined {
        /// Height of its rim, mm: that of the end but for rounding.
        height: f64,
        /// Radius of the cylinder, mm.
        radius: f64,
        /// Angles of the vertices, rad.
        angles: &'a [f64],
    },
}

/// A section with its rings.
pub(super) struct Walled<'a> {
    part: &'a Part,
    pub(super) rings: [Ring; 2],
}

impl Walled<'_> {
    fn section(&self) -> &TurnedSection {
        &self.part.section
    }
}

/// One side of a plane across the axis between sections.
struct Side<'a> {
    ring: &'a Ring,
    slotted: bool,
}

impl Turned {
    /// Adds the faces of the body to a shell, its ends flat or joined to a body that is there already.
    pub fn close(&self, builder: &mut ShellBuilder, ends: [TurnedEnd<'_>; 2]) {
        let parts = self.parts();
        let mut levels = vec![self.bottom];
        for part in &parts {
            levels.push(levels[levels.len() - 1] + part.section.length);
        }
        let last = parts.len() - 1;
        for (end, level) in [(0, 0), (1, last + 1)] {
            if let TurnedEnd::Joined { height, .. } = ends[end] {
                levels[level] = height;
            }
        }
        let walled: Vec<Walled<'_>> = parts
            .iter()
            .enumerate()
            .map(|(index, part)| {
                let section = part.section;
                let joined =
                    [(0, 0), (last, 1)]
                        .into_iter()
                        .find_map(|(at, end)| match ends[end] {
                            TurnedEnd::Joined { radius, angles, .. }
                                if at == index && section.radii[end] == radius =>
                            {
                                Some(angles.to_vec())
                            }
                            _ => None,
                        });
                let wide = section.radii[0].max(section.radii[1]);
                let rings = [0, 1].map(|end| {
                    let radius = section.radii[end];
                    let own = if section.slotted { radius } else { wide };
                    let angles = joined.clone().unwrap_or_else(|| self.angles(own));
                    Ring::new(builder, &angles, radius, levels[index + end])
                });
                Walled { part, rings }
            })
            .collect();
        for (index, part) in walled.iter().enumerate() {
            let beside = [
                index.checked_sub(1).map(|below| &walled[below]),
                walled.get(index + 1),
            ];
            self.sides(builder, part, beside);
        }
        for pair in walled.windows(2) {
            let [low, high] = [(&pair[0], 1), (&pair[1], 0)].map(|(part, end)| Side {
                ring: &part.rings[end],
                slotted: part.part.is_slotted(end),
            });
            self.shoulder(builder, &low, &high);
        }
        for (end, (part, way)) in [(&walled[0], -1.0), (&walled[last], 1.0)]
            .into_iter()
            .enumerate()
        {
            let own = Side {
                ring: &part.rings[end],
                slotted: part.part.is_slotted(end),
            };
            match ends[end] {
                TurnedEnd::Flat => {
                    let bound = seen(self.outline(builder, &own), way);
                    builder.face(flat(own.ring.height, way), vec![bound]);
                }
                TurnedEnd::Joined { radius, angles, .. } => {
                    let rim = Ring::new(builder, angles, radius, own.ring.height);
                    let rim = Side {
                        ring: &rim,
                        slotted: false,
                    };
                    match end {
                        0 => self.shoulder(builder, &rim, &own),
                        _ => self.shoulder(builder, &own, &rim),
                    }
                }
            }
        }
    }

    /// Round faces of a section, and walls and floor of the slot in it.
    fn sides(
        &self,
        builder: &mut ShellBuilder,
        part: &Walled<'_>,
        beside: [Option<&Walled<'_>>; 2],
    ) {
        let [low, high] = &part.rings;
        if let (Some(slot), Some(from_below)) = (self.slot, part.part.end) {
            let end = usize::from(!from_below);
            let open = [0, 1].map(|side| {
                let feet = slot.feet(builder, part.rings[end].height);
                self.across(part, end, beside[end], (side, feet[side]))
            });
            self.round_end(builder, part, slot, (from_below, open));
            return;
        }
        let slotted = self.slot.filter(|_| part.section().slotted);
        let count = if slotted.is_some() {
            low.last()
        } else {
            low.len()
        };
        let up: Vec<ShellSide> = (0..=count)
            .map(|i| match slotted {
                Some(slot) if low.radius != high.radius && (i == 0 || i == count) => {
                    let y = if i == 0 { 0.5 } else { -0.5 } * slot.width;
                    slanted(
                        builder,
                        y,
                        [low, high].map(|ring| (ring.at(i), ring.radius)),
                    )
                }
                _ => builder.line(low.at(i), high.at(i)),
            })
            .collect();
        for i in 0..count {
            let (bottom, top) = (low.arc(builder, i), high.arc(builder, i));
            let [top, left] = [top, up[i]].map(ShellBuilder::back);
            let round = surface(part.section(), low.height);
            builder.face(round, vec![vec![bottom, up[i + 1], top, left]]);
        }
        let Some(slot) = slotted else {
            return;
        };
        let feet = [low, high].map(|ring| slot.feet(builder, ring.height));
        for (side, edge) in [(0, 0), (1, count)] {
            let ends =
                [0, 1].map(|end| self.across(part, end, beside[end], (side, feet[end][side])));
            let mut bound = builder.lines(&ends[0]);
            bound.push(up[edge]);
            let inwards: Vec<usize> = ends[1].iter().rev().copied().collect();
            bound.extend(builder.lines(&inwards));
            bound.push(builder.line(feet[1][side], feet[0][side]));
            let way = if side == 0 { 1.0 } else { -1.0 };
            let plane = ShellSurface::Plane {
                point: [slot.foot, 0.5 * way * slot.width, low.height],
                normal: [0.0, -way, 0.0],
            };
            builder.face(plane, vec![seen(bound, way)]);
        }
        let floor = ShellSurface::Plane {
            point: [slot.foot, 0.0, low.height],
            normal: [1.0, 0.0, 0.0],
        };
        let [[left, right], [above, beyond]] = [0, 1].map(|end| [feet[end][1], feet[end][0]]);
        let bound = builder.lines(&[left, right, beyond, above, left]);
        builder.face(floor, vec![bound]);
    }

    /// Vertices along x at an end of a slotted section, from the foot of a wall of the slot to its edge, through the corner of the
    /// neighbour.
    fn across(
        &self,
        part: &Walled<'_>,
        end: usize,
        beside: Option<&Walled<'_>>,
        (side, foot): (usize, usize),
    ) -> Vec<usize> {
        let corner = |ring: &Ring| ring.at(if side == 0 { 0 } else { ring.last() });
        let own = &part.rings[end];
        let next = beside.map(|other| &other.rings[1 - end]);
        let narrow =
            next.filter(|ring| ring.radius < own.radius && self.edge(ring.radius).is_some());
        let through = [Some(foot), narrow.map(corner), Some(corner(own))];
        through.into_iter().flatten().collect()
    }

    /// Faces across the axis where two sections meet.
    fn shoulder(&self, builder: &mut ShellBuilder, low: &Side<'_>, high: &Side<'_>) {
        let height = low.ring.height;
        if low.ring.radius == high.ring.radius {
            match (low.slotted, high.slotted) {
                (true, false) => self.over_slot(builder, high.ring, -1.0),
                (false, true) => self.over_slot(builder, low.ring, 1.0),
                _ => {}
            }
            return;
        }
        let (wide, narrow, way) = match high.ring.radius > low.ring.radius {
            true => (high, low, -1.0),
            false => (low, high, 1.0),
        };
        let open = wide.slotted && self.edge(narrow.ring.radius).is_some();
        if !open {
            let outer = seen(self.outline(builder, wide), way);
            let inner = seen(self.outline(builder, narrow), -way);
            builder.face(flat(height, way), vec![outer, inner]);
            return;
        }
        let mut bound = wide.ring.beside_slot(builder);
        let [outer, inner] = [wide.ring, narrow.ring];
        bound.push(builder.line(outer.at(outer.last()), inner.at(inner.last())));
        bound.extend(seen(inner.beside_slot(builder), -1.0));
        bound.push(builder.line(inner.at(0), outer.at(0)));
        builder.face(flat(height, way), vec![seen(bound, way)]);
        if !narrow.slotted {
            self.over_slot(builder, narrow.ring, -way);
        }
    }

    /// End wall of the slot.
    fn over_slot(&self, builder: &mut ShellBuilder, ring: &Ring, way: f64) {
        let Some(slot) = self.slot else {
            return;
        };
        let feet = slot.feet(builder, ring.height);
        let mut bound = vec![ring.arc(builder, ring.last())];
        bound.extend(builder.lines(&[ring.at(0), feet[0], feet[1], ring.at(ring.last())]));
        builder.face(flat(ring.height, way), vec![seen(bound, way)]);
    }

    /// Outline of a section across the axis, counter-clockwise seen from above.
    fn outline(&self, builder: &mut ShellBuilder, side: &Side<'_>) -> Vec<ShellSide> {
        let ring = side.ring;
        let Some(slot) = self.slot.filter(|_| side.slotted) else {
            return ring.round(builder);
        };
        let feet = slot.feet(builder, ring.height);
        let mut bound = ring.beside_slot(builder);
        bound.extend(builder.lines(&[ring.at(ring.last()), feet[1], feet[0], ring.at(0)]));
        bound
    }
}

impl TurnedSlot {
    /// Vertices at the ends of the floor across the slot, the one at the greater y first.
    fn feet(self, builder: &mut ShellBuilder, height: f64) -> [usize; 2] {
        [0.5, -0.5].map(|side| builder.vertex([self.foot, side * self.width, height]))
    }
}

/// Edge of a slot's wall on a cone, where a plane beside the axis cuts it, upwards; by vertices and radii.
fn slanted(builder: &mut ShellBuilder, y: f64, ends: [(usize, f64); 2]) -> ShellSide {
    let [(low, from), (high, to)] = ends;
    let heights = [low, high].map(|vertex| builder.place(vertex)[2]);
    let mut points = BezierFit::default().through(&|x| {
        let radius = from + (to - from) * x;
        let height = heights[0] + (heights[1] - heights[0]) * x;
        [(radius * radius - y * y).max(0.0).sqrt(), y, height]
    });
    let last = points.len() - 1;
    points[0] = builder.place(low);
    points[last] = builder.place(high);
    builder.free(points)
}
