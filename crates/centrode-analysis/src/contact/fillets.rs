//! Least clearance of the edges of teeth from the fillets of the mate, with the gears at their law.

use std::ops::Range;

use centrode_gear::{Member, Role};
use centrode_geometry::{Extreme, Point, SegmentJet, Vector, bracketed_minimum_below};

use super::{
    at_angle,
    body::{Corner, GearOutline},
    meshing::Meshing,
    touch::{self, Pose},
    walk::Walk,
};

/// Multiple of the least distance known within which lesser ones are looked for.
const BEYOND: f64 = 4.0;

/// Least such distance, modules.
const LEAST: f64 = 0.02;

/// Multiple of the way of an edge in a step beyond which it meets nothing in the next.
const WAY: f64 = 1.5;

/// Share of the greatest distance looked at by which no place is told from another.
const ROUNDING: f64 = 1e-12;

/// Share of the rise beside a least distance by which a kink may reach below it; a parabola reaches a quarter of that.
const KINK: f64 = 0.5;

/// Fillets of a body.
struct Fillets<'a> {
    /// First part of the fillet of each part of the body.
    first: Vec<Option<usize>>,
    /// The parts of fillets alone.
    alone: GearOutline<'a>,
    /// Which parts of the body those are.
    parts: Vec<usize>,
}

/// An edge of one gear on its way along the fillets of the other.
struct Approach<'a> {
    meshing: &'a Meshing<'a>,
    walk: &'a Walk,
    fillets: &'a Fillets<'a>,
    /// Distance beyond which nothing is looked at, mm.
    within: f64,
    /// The gear with the edge.
    member: Member,
    corner: &'a Corner,
}

/// A least distance bracketed between steps.
enum Chance {
    /// The edge passes the normal at a fillet's end, a part's start or end, after this step.
    End { part: usize, u: f64, step: usize },
    /// The fillet, by its first part, faces the edge at three inputs, nearest at the middle one.
    Between {
        fillet: usize,
        gaps: [(f64, f64); 3],
    },
}

/// Where an edge is near a fillet at a step: the fillet by its first part, and how far off it is, if it faces the edge.
struct Step {
    fillet: usize,
    step: usize,
    gap: Option<f64>,
}

impl<'a> Fillets<'a> {
    /// Those of a body; what is within `near` of them is told at once.
    fn new(body: &GearOutline<'a>, near: f64) -> Self {
        let count = body.parts.len();
        let is_fillet = |i: usize| body.parts[i % count].role == Role::Fillet;
        // From a part on that begins one, so that none is cut in two by the contour's start.
        let begin = (0..count).find(|&i| is_fillet(i + 1) && !is_fillet(i));
        let mut first = vec![None; count];
        let mut current = None;
        for i in (0..count).map(|k| (begin.unwrap_or(0) + 1 + k) % count) {
            current = is_fillet(i).then(|| current.unwrap_or(i));
            first[i] = current;
        }
        let parts: Vec<usize> = (0..count).filter(|&i| first[i].is_some()).collect();
        let alone = GearOutline::new(parts.iter().map(|&i| body.parts[i]).collect(), near);
        Self {
            first,
            alone,
            parts,
        }
    }
}

impl Meshing<'_> {
    /// Least clearance of an edge from a fillet over a walk, where one of `known` mm is known; nothing where no edge comes so near.
    ///
    /// An edge is nearest where its way runs along the fillet, or where the fillet that faces it ends. The latter is the root of
    /// the edge's distance, along the tangent, from that end.
    pub(super) fn edges_to_fillets(&self, walk: &Walk, known: f64) -> Option<Extreme> {
        let within = (BEYOND * known).max(LEAST * self.module).min(self.near);
        let gears = [
            (
                Member::Driver,
                &self.driver,
                Fillets::new(&self.driven, self.near),
            ),
            (
                Member::Driven,
                &self.driven,
                Fillets::new(&self.driver, self.near),
            ),
        ];
        let approaches = gears.iter().flat_map(|(member, own, fillets)| {
            let corners = own.parts.iter().filter_map(|part| part.corner.as_ref());
            corners.map(move |corner| Approach {
                meshing: self,
                walk,
                fillets,
                within,
                member: *member,
                corner,
            })
        });
        let approaches: Vec<Approach<'_>> = approaches.collect();
        let mut chances = Vec::new();
        for approach in &approaches {
            for steps in walk.passages(approach.member, approach.corner.point) {
                let steps = approach.steps(steps);
                for steps in steps.chunk_by(|a, b| a.fillet == b.fillet) {
                    let found = approach.ends(steps).chain(approach.between_ends(steps));
                    chances.extend(found.map(|(least, chance)| (least, approach, chance)));
                }
            }
        }
        // What may come nearest goes first: it leaves the others nothing to reach.
        chances.sort_by(|p, q| p.0.total_cmp(&q.0));
        let mut best: Option<Extreme> = None;
        let rounding = within * ROUNDING;
        for (least, approach, chance) in chances {
            let reached = best.map_or(known + rounding, |b| b.value);
            if least >= reached {
                break;
            }
            if let Some((phi, value)) = approach.nearest(&chance, reached)
                && best.is_none_or(|b| value < b.value)
            {
                let input = phi.rem_euclid(self.pair.cycle());
                best = Some(Extreme { input, value });
            }
        }
        best
    }
}

/// Outward normal of a contour.
fn outward(jet: &SegmentJet) -> Vector {
    Vector::new(jet.first.y, -jet.first.x).normalize()
}

impl Approach<'_> {
    fn mate(&self) -> &GearOutline<'_> {
        match self.member {
            Member::Driver => &self.meshing.driven,
            Member::Driven => &self.meshing.driver,
        }
    }

    /// The edge in the mate's axes.
    fn point(&self, pose: &Pose) -> Point {
        match self.member {
            Member::Driver => pose.back(&self.corner.point),
            Member::Driven => pose.place(&self.corner.point),
        }
    }

    fn pose(&self, phi: f64) -> Pose {
        let pair = self.meshing.pair;
        Pose::at(pair, &at_angle(pair, phi), self.walk.stand)
    }

    /// Distance from a part that faces the edge, and that the edge faces.
    fn gap(&self, part: usize, pose: &Pose) -> Option<f64> {
        let part = &self.mate().parts[part];
        let own = &self.corner.normals;
        let turned = match self.member {
            Member::Driver => pose.turn_back(&own.direction),
            Member::Driven => pose.turn(&own.direction),
        };
        if !own.turned(turned).opposes(&part.normals) {
            return None;
        }
        let touch = match self.member {
            Member::Driver => touch::driver_corner(self.corner, part, pose),
            Member::Driven => touch::driven_corner(part, self.corner, pose),
        };
        let touch = touch.filter(|t| self.meshing.in_reach(t, self.within, pose))?;
        Some(touch.gap)
    }

    /// Parts of a fillet, in the contour's order.
    fn parts(&self, fillet: usize) -> impl Iterator<Item = usize> {
        let first = &self.fillets.first;
        let parts = (0..first.len()).map(move |k| (fillet + k) % first.len());
        parts.take_while(move |&i| first[i] == Some(fillet))
    }

    /// Least distance from the parts of a fillet that face the edge.
    fn fillet_gap(&self, fillet: usize, pose: &Pose) -> Option<f64> {
        let gaps = self.parts(fillet).filter_map(|i| self.gap(i, pose));
        gaps.reduce(f64::min)
    }

    /// Distance from a fillet that goes on straight beyond its ends, of at most what is looked at: so it is smooth where the
    /// edge leaves the fillet.
    fn smooth_gap(&self, fillet: usize, gap: Option<f64>, pose: &Pose) -> f64 {
        let beyond = || {
            let point = self.point(pose);
            let last = self.parts(fillet).last().unwrap_or(fillet);
            let mut ends = [(fillet, -1.0), (last, 1.0)].into_iter();
            ends.find_map(|(part, u)| {
                let jet = self.end(part, u);
                let off = point - jet.point;
                (u * off.dot(&jet.first) > 0.0).then(|| off.dot(&outward(&jet)))
            })
        };
        gap.or_else(beyond).unwrap_or(self.within).min(self.within)
    }

    /// Places of the edge along some steps, in the mate's axes, that are near the fillets' reach: the step, the place, and how near
    /// it must be to meet something there or in the next step.
    fn places(&self, all: Range<usize>) -> Vec<(usize, Point, f64)> {
        let mut ways = [0.0; 2];
        let mut next = self.point(&self.walk.poses[all.start]);
        let mut found = Vec::new();
        for step in all {
            let point = next;
            next = self.point(&self.walk.poses[step + 1]);
            ways = [ways[1], (next - point).norm()];
            let near = self.within + WAY * ways[0].max(ways[1]);
            if self.fillets.alone.is_near(&point.coords, near) {
                found.push((step, point, near));
            }
        }
        found
    }

    /// Parts of fillets that are near some place, in the contour's order, each with its fillet.
    fn near(&self, places: &[(usize, Point, f64)]) -> Vec<(usize, usize)> {
        let mut found = Vec::new();
        if let Some(&(_, middle, _)) = places.get(places.len() / 2) {
            let reach = |(_, point, near): &(usize, Point, f64)| (point - middle).norm() + near;
            let reach = places.iter().map(reach).fold(0.0, f64::max);
            self.fillets.alone.tree.each(
                &|run| (run.center - middle).norm_squared() < (run.radius + reach).powi(2),
                |k| {
                    let part = self.fillets.parts[k];
                    found.extend(self.fillets.first[part].map(|fillet| (part, fillet)));
                },
            );
        }
        found
    }

    /// Steps at which a fillet is near or is met in the next, fillet by fillet.
    fn steps(&self, all: Range<usize>) -> Vec<Step> {
        let mate = self.mate();
        let places = self.places(all);
        let parts = self.near(&places);
        let mut found: Vec<Step> = Vec::new();
        for (step, point, near) in places {
            let pose = &self.walk.poses[step];
            let start = found.len();
            for &(i, fillet) in &parts {
                let part = &mate.parts[i];
                if (part.center - point).norm_squared() >= (part.radius + near).powi(2) {
                    continue;
                }
                let is_close = part.clear_of(&point) < self.within;
                let gap = is_close.then(|| self.gap(i, pose)).flatten();
                match found[start..].iter_mut().find(|s| s.fillet == fillet) {
                    Some(known) => known.gap = known.gap.into_iter().chain(gap).reduce(f64::min),
                    None => found.push(Step { fillet, step, gap }),
                }
            }
        }
        found.sort_by_key(|s| (s.fillet, s.step));
        found
    }

    /// An end of a fillet.
    fn end(&self, part: usize, u: f64) -> SegmentJet {
        self.mate().parts[part].segment.at(u)
    }

    /// Steps between which the edge passes the normals at the ends of a fillet, and the least distance there.
    fn ends(&self, steps: &[Step]) -> impl Iterator<Item = (f64, Chance)> {
        let first = steps[0].fillet;
        let last = self.parts(first).last().unwrap_or(first);
        let from = steps[0].step.saturating_sub(1);
        let to = (steps[steps.len() - 1].step + 1).min(self.walk.points.len() - 1);
        let ends = [(first, -1.0), (last, 1.0)].into_iter();
        ends.flat_map(move |(part, u)| {
            let jet = self.end(part, u);
            let normal = outward(&jet);
            let off = move |step: usize| self.point(&self.walk.poses[step]) - jet.point;
            (from..to).filter_map(move |step| {
                let [p, q] = [step, step + 1].map(off);
                let sides = [p.dot(&jet.first), q.dot(&jet.first)];
                if (sides[0] > 0.0) == (sides[1] > 0.0) {
                    return None;
                }
                // The way between the steps is a chord, but for an eighth of how much it bends.
                let before = off(step.saturating_sub(1));
                let bend = (before - 2.0 * p + q).norm();
                let between = p + (q - p) * (sides[0] / (sides[0] - sides[1]));
                let least = between.dot(&normal) - bend;
                Some((least, Chance::End { part, u, step }))
            })
        })
    }

    /// Steps at which the fillet faces the edge and is nearer than at those beside, and the least distance there.
    fn between_ends(&self, steps: &[Step]) -> impl Iterator<Item = (f64, Chance)> {
        let gap_at = |step: usize| {
            let known = steps.iter().find(|s| s.step == step);
            let gap = known.and_then(|s| s.gap);
            self.smooth_gap(steps[0].fillet, gap, &self.walk.poses[step])
        };
        steps.iter().filter_map(move |here| {
            let (value, step) = (here.gap?, here.step);
            if step == 0 || step + 1 == self.walk.points.len() {
                return None;
            }
            let [f, g] = [gap_at(step - 1), gap_at(step + 1)];
            let at = |step: usize, gap: f64| (self.walk.points[step].input, gap);
            let gaps = [at(step - 1, f), at(step, value), at(step + 1, g)];
            let fillet = here.fillet;
            let least = value - KINK * (f + g - 2.0 * value);
            (value <= f.min(g)).then_some((least, Chance::Between { fillet, gaps }))
        })
    }

    /// Input and distance where the edge is nearest, as far as that is less than `known`.
    fn nearest(&self, chance: &Chance, known: f64) -> Option<(f64, f64)> {
        match *chance {
            Chance::End { part, u, step } => {
                let jet = self.end(part, u);
                let along = |pose: &Pose| (self.point(pose) - jet.point).dot(&jet.first);
                let pair = self.meshing.pair;
                let at = self.walk.root(pair, step, |_, pose| along(pose))?;
                let pose = Pose::at(pair, &at, self.walk.stand);
                Some((at.input, self.gap(part, &pose)?))
            }
            Chance::Between { fillet, gaps } => {
                let gap = |phi: f64| {
                    let pose = self.pose(phi);
                    self.smooth_gap(fillet, self.fillet_gap(fillet, &pose), &pose)
                };
                let rounding = self.within * ROUNDING;
                let (phi, value) = bracketed_minimum_below(gap, gaps, known, rounding);
                // Where the fillet ends before, the edge is nearest at its end.
                let faces = self.fillet_gap(fillet, &self.pose(phi)).is_some();
                faces.then_some((phi, value))
            }
        }
    }
}
