use super::ring::{Ring, oriented, plane_across, surface};
use super::round_end::Part;
use super::{Turned, TurnedSection, TurnedSlot};
use crate::curve::BezierFit;
use crate::solid::{ShellBuilder, ShellSide, ShellSurface};

/// End of a turned body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TurnedEnd<'a> {
    /// A plane face.
    Flat,
    /// Another body continues there as a cylinder with vertices on its rim.
    Joined {
        /// Height of its rim, mm; equal to that of the end except for rounding.
        height: f64,
        /// Radius of the cylinder, mm.
        radius: f64,
        /// Angles of the vertices, rad.
        angles: &'a [f64],
    },
}

/// A part with the rings at its ends.
pub(super) struct RingedPart<'a> {
    part: &'a Part,
    pub(super) rings: [Ring; 2],
}

impl RingedPart<'_> {
    fn section(&self) -> &TurnedSection {
        &self.part.section
    }
}

/// A section on one side of a plane across the axis.
struct PlaneSide<'a> {
    ring: &'a Ring,
    slotted: bool,
}

impl Turned {
    /// Adds the faces of the body to a shell. Its ends are plane, or joined to a body that the shell already contains.
    pub fn add_faces(&self, builder: &mut ShellBuilder, ends: [TurnedEnd<'_>; 2]) {
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
        let walled: Vec<RingedPart<'_>> = parts
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
                RingedPart { part, rings }
            })
            .collect();
        for (index, part) in walled.iter().enumerate() {
            let neighbours = [
                index.checked_sub(1).map(|below| &walled[below]),
                walled.get(index + 1),
            ];
            self.sides(builder, part, neighbours);
        }
        for pair in walled.windows(2) {
            let [low, high] = [(&pair[0], 1), (&pair[1], 0)].map(|(part, end)| PlaneSide {
                ring: &part.rings[end],
                slotted: part.part.is_slotted(end),
            });
            self.shoulder(builder, &low, &high);
        }
        for (end, (part, sign)) in [(&walled[0], -1.0), (&walled[last], 1.0)]
            .into_iter()
            .enumerate()
        {
            let own = PlaneSide {
                ring: &part.rings[end],
                slotted: part.part.is_slotted(end),
            };
            match ends[end] {
                TurnedEnd::Flat => {
                    let bound = oriented(self.outline(builder, &own), sign);
                    builder.face(plane_across(own.ring.height, sign), vec![bound]);
                }
                TurnedEnd::Joined { radius, angles, .. } => {
                    let rim = Ring::new(builder, angles, radius, own.ring.height);
                    let rim = PlaneSide {
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
        part: &RingedPart<'_>,
        neighbours: [Option<&RingedPart<'_>>; 2],
    ) {
        let [low, high] = &part.rings;
        if let (Some(slot), Some(from_below)) = (self.slot, part.part.slot_from_below) {
            let end = usize::from(!from_below);
            let open = [0, 1].map(|side| {
                let floor_vertices = slot.floor_vertices(builder, part.rings[end].height);
                self.wall_end(part, end, neighbours[end], side, floor_vertices[side])
            });
            self.round_end(builder, part, slot, from_below, open);
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
                    slanted(builder, y, [low, high], i)
                }
                _ => builder.line(low.at(i), high.at(i)),
            })
            .collect();
        for i in 0..count {
            let (bottom, top) = (low.arc(builder, i), high.arc(builder, i));
            let [top, left] = [top, up[i]].map(ShellSide::reversed);
            let round = surface(part.section(), low.height);
            builder.face(round, vec![vec![bottom, up[i + 1], top, left]]);
        }
        let Some(slot) = slotted else {
            return;
        };
        let floor_vertices = [low, high].map(|ring| slot.floor_vertices(builder, ring.height));
        for (side, edge) in [(0, 0), (1, count)] {
            let ends = [0, 1].map(|end| {
                self.wall_end(part, end, neighbours[end], side, floor_vertices[end][side])
            });
            let mut bound = builder.lines(&ends[0]);
            bound.push(up[edge]);
            let inwards: Vec<usize> = ends[1].iter().rev().copied().collect();
            bound.extend(builder.lines(&inwards));
            bound.push(builder.line(floor_vertices[1][side], floor_vertices[0][side]));
            let sign = if side == 0 { 1.0 } else { -1.0 };
            let plane = ShellSurface::Plane {
                point: [slot.floor, 0.5 * sign * slot.width, low.height],
                normal: [0.0, -sign, 0.0],
            };
            builder.face(plane, vec![oriented(bound, sign)]);
        }
        let floor = ShellSurface::Plane {
            point: [slot.floor, 0.0, low.height],
            normal: [1.0, 0.0, 0.0],
        };
        let [[left, right], [upper_left, upper_right]] =
            [0, 1].map(|end| [floor_vertices[end][1], floor_vertices[end][0]]);
        let bound = builder.lines(&[left, right, upper_right, upper_left, left]);
        builder.face(floor, vec![bound]);
    }

    /// Vertices along x at an end of a slotted section: from the floor along a wall of the slot to its edge, through the corner
    /// of the neighbour.
    fn wall_end(
        &self,
        part: &RingedPart<'_>,
        end: usize,
        neighbour: Option<&RingedPart<'_>>,
        side: usize,
        floor_vertex: usize,
    ) -> Vec<usize> {
        let corner = |ring: &Ring| ring.at(if side == 0 { 0 } else { ring.last() });
        let own = &part.rings[end];
        let next = neighbour.map(|other| &other.rings[1 - end]);
        let narrow = next
            .filter(|ring| ring.radius < own.radius && self.edge_distance(ring.radius).is_some());
        let through = [Some(floor_vertex), narrow.map(corner), Some(corner(own))];
        through.into_iter().flatten().collect()
    }

    /// Faces across the axis where two sections meet.
    fn shoulder(&self, builder: &mut ShellBuilder, low: &PlaneSide<'_>, high: &PlaneSide<'_>) {
        let height = low.ring.height;
        if low.ring.radius == high.ring.radius {
            match (low.slotted, high.slotted) {
                (true, false) => self.slot_end(builder, high.ring, -1.0),
                (false, true) => self.slot_end(builder, low.ring, 1.0),
                _ => {}
            }
            return;
        }
        let (wide, narrow, sign) = match high.ring.radius > low.ring.radius {
            true => (high, low, -1.0),
            false => (low, high, 1.0),
        };
        let open = wide.slotted && self.edge_distance(narrow.ring.radius).is_some();
        if !open {
            let outer = oriented(self.outline(builder, wide), sign);
            let inner = oriented(self.outline(builder, narrow), -sign);
            builder.face(plane_across(height, sign), vec![outer, inner]);
            return;
        }
        let mut bound = wide.ring.arcs_outside_slot(builder);
        let [outer, inner] = [wide.ring, narrow.ring];
        bound.push(builder.line(outer.at(outer.last()), inner.at(inner.last())));
        bound.extend(oriented(inner.arcs_outside_slot(builder), -1.0));
        bound.push(builder.line(inner.at(0), outer.at(0)));
        builder.face(plane_across(height, sign), vec![oriented(bound, sign)]);
        if !narrow.slotted {
            self.slot_end(builder, narrow.ring, -sign);
        }
    }

    /// End wall of the slot.
    fn slot_end(&self, builder: &mut ShellBuilder, ring: &Ring, sign: f64) {
        let Some(slot) = self.slot else {
            return;
        };
        let floor_vertices = slot.floor_vertices(builder, ring.height);
        let mut bound = vec![ring.arc(builder, ring.last())];
        bound.extend(builder.lines(&[
            ring.at(0),
            floor_vertices[0],
            floor_vertices[1],
            ring.at(ring.last()),
        ]));
        builder.face(plane_across(ring.height, sign), vec![oriented(bound, sign)]);
    }

    /// Outline of a section across the axis, counter-clockwise seen from above.
    fn outline(&self, builder: &mut ShellBuilder, side: &PlaneSide<'_>) -> Vec<ShellSide> {
        let ring = side.ring;
        let Some(slot) = self.slot.filter(|_| side.slotted) else {
            return ring.all_arcs(builder);
        };
        let floor_vertices = slot.floor_vertices(builder, ring.height);
        let mut bound = ring.arcs_outside_slot(builder);
        bound.extend(builder.lines(&[
            ring.at(ring.last()),
            floor_vertices[1],
            floor_vertices[0],
            ring.at(0),
        ]));
        bound
    }
}

impl TurnedSlot {
    /// Vertices at both ends of a line across the floor of the slot, the one at +y first.
    fn floor_vertices(self, builder: &mut ShellBuilder, height: f64) -> [usize; 2] {
        [0.5, -0.5].map(|side| builder.vertex([self.floor, side * self.width, height]))
    }
}

/// Edge of a slot's wall on a cone, from vertex `i` of the lower ring to that of the upper: the cone at a constant y.
fn slanted(builder: &mut ShellBuilder, y: f64, rings: [&Ring; 2], i: usize) -> ShellSide {
    let [low, high] = rings.map(|ring| ring.at(i));
    let [from, to] = rings.map(|ring| ring.radius);
    let heights = [low, high].map(|vertex| builder.position(vertex)[2]);
    let mut points = BezierFit::default().through(&|x| {
        let radius = from + (to - from) * x;
        let height = heights[0] + (heights[1] - heights[0]) * x;
        [(radius * radius - y * y).max(0.0).sqrt(), y, height]
    });
    let last = points.len() - 1;
    points[0] = builder.position(low);
    points[last] = builder.position(high);
    builder.bezier(points)
}
