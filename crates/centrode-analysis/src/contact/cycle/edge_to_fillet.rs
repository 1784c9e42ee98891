//! Minimum clearance of tooth edges from the fillets of the mate, in sampled poses.

use std::ops::Range;

use centrode_gear::{Member, Role};
use centrode_geometry::{Extreme, Point, SegmentJet, Vector, WRITTEN, bracketed_minimum_below};

use super::{cycle_samples::at_angle, pose_sampling::PoseSampling};
use crate::contact::contour::{Corner, GearOutline, Pose};
use crate::contact::seat::{Meshing, facing_driven_corner, facing_driver_corner};

/// Search distance as a multiple of the known clearance. A smaller factor misses candidates, a larger one takes longer.
const SEARCH_FACTOR: f64 = 4.0;

/// Minimum search distance, modules, if the known clearance is almost zero. A smaller one misses candidates, a larger
/// one takes longer.
const MIN_SEARCH_DISTANCE: f64 = 0.02;

/// Maximum motion of an edge in a step, as a multiple of its motion in the steps before and after. A smaller factor
/// skips steps in which the edge comes near, a larger one examines more steps.
const STEP_FACTOR: f64 = 1.5;

/// Possible drop of a clearance below its minimum at three steps, as a share of the second difference: that of a kink. The
/// drop of a parabola is at most a quarter of this.
const KINK_SHARE: f64 = 0.5;

/// Fillets of a gear.
struct Fillets<'a> {
    /// First part of the fillet, per part of the outline; `None` for parts that are not of a fillet.
    first: Vec<Option<usize>>,
    /// Outline of the fillets alone.
    alone: GearOutline<'a>,
    /// Index in the whole outline, per part of the fillets alone.
    parts: Vec<usize>,
}

/// An edge of one gear and the fillets of the other.
struct EdgeApproach<'a> {
    meshing: &'a Meshing<'a>,
    sampling: &'a PoseSampling,
    fillets: &'a Fillets<'a>,
    /// Search distance, mm.
    within: f64,
    /// The gear with the edge.
    member: Member,
    corner: &'a Corner,
}

/// A minimum of the clearance between steps that may be the smallest one.
struct NearestCandidate {
    /// Lower bound of the clearance, mm.
    bound: f64,
    bracket: Bracket,
}

/// Where a minimum of the clearance is searched.
enum Bracket {
    /// After this step the edge passes the normal at an end of a fillet: at `u` of a part.
    End { part: usize, u: f64, step: usize },
    /// The fillet faces the edge at three driver angles, with the minimum clearance at the middle one.
    Between {
        /// First part of the fillet.
        fillet: usize,
        /// Driver angle, rad, and clearance, mm.
        gaps: [(f64, f64); 3],
    },
}

/// A step at which an edge is near a fillet.
struct FilletStep {
    /// First part of the fillet.
    fillet: usize,
    step: usize,
    /// Clearance, mm; `None` if the fillet does not face the edge.
    gap: Option<f64>,
}

/// Position of an edge at a step, in the mate's axes.
struct EdgePosition {
    step: usize,
    point: Point,
    /// Distance within which the edge can meet something at this step or before the next one, mm.
    reach: f64,
}

/// Part of a fillet.
struct FilletPart {
    part: usize,
    /// First part of the fillet.
    fillet: usize,
}

impl<'a> Fillets<'a> {
    /// The fillets of a gear, for searches within a distance `near`, mm.
    fn new(body: &GearOutline<'a>, near: f64) -> Self {
        let count = body.parts.len();
        let is_fillet = |i: usize| body.parts[i % count].role == Role::Fillet;
        // The first part is one that begins a fillet, so that no fillet is cut in two by the start of the contour.
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
    /// Minimum clearance of an edge from a fillet over the sampled poses, mm; `None` if it is not below a known clearance of `known` mm.
    ///
    /// An edge is nearest where its path is parallel to the fillet, or where it passes the normal at an end of the fillet. The latter is a
    /// root of the edge's distance from that end along the tangent.
    pub(super) fn edges_to_fillets(&self, sampling: &PoseSampling, known: f64) -> Option<Extreme> {
        let within = (SEARCH_FACTOR * known)
            .max(MIN_SEARCH_DISTANCE * self.module)
            .min(self.search_distance);
        let gears = [
            (
                Member::Driver,
                &self.driver,
                Fillets::new(&self.driven, self.search_distance),
            ),
            (
                Member::Driven,
                &self.driven,
                Fillets::new(&self.driver, self.search_distance),
            ),
        ];
        let approaches = gears.iter().flat_map(|(member, own, fillets)| {
            let corners = own.parts.iter().filter_map(|part| part.corner.as_ref());
            corners.map(move |corner| EdgeApproach {
                meshing: self,
                sampling,
                fillets,
                within,
                member: *member,
                corner,
            })
        });
        let approaches: Vec<EdgeApproach<'_>> = approaches.collect();
        let mut candidates = Vec::new();
        for approach in &approaches {
            for steps in sampling.passages(approach.member, approach.corner.point) {
                let steps = approach.steps(steps);
                for steps in steps.chunk_by(|a, b| a.fillet == b.fillet) {
                    let found = approach.ends(steps).chain(approach.between_ends(steps));
                    candidates.extend(found.map(|candidate| (approach, candidate)));
                }
            }
        }
        // The candidate with the lowest bound first: most other candidates then cannot be below its clearance.
        candidates.sort_by(|(_, p), (_, q)| p.bound.total_cmp(&q.bound));
        let mut best: Option<Extreme> = None;
        let rounding = within * WRITTEN;
        for (approach, NearestCandidate { bound, bracket }) in candidates {
            let reached = best.map_or(known + rounding, |b| b.value);
            if bound >= reached {
                break;
            }
            if let Some(Extreme { input, value }) = approach.nearest(&bracket, reached)
                && best.is_none_or(|b| value < b.value)
            {
                let input = input.rem_euclid(self.pair.cycle());
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

impl EdgeApproach<'_> {
    fn mate(&self) -> &GearOutline<'_> {
        match self.member {
            Member::Driver => &self.meshing.driven,
            Member::Driven => &self.meshing.driver,
        }
    }

    /// The edge in the mate's axes.
    fn point(&self, pose: &Pose) -> Point {
        match self.member {
            Member::Driver => pose.point_to_driven(&self.corner.point),
            Member::Driven => pose.point_to_driver(&self.corner.point),
        }
    }

    fn pose(&self, phi: f64) -> Pose {
        let pair = self.meshing.pair;
        self.sampling.position.pose(pair, &at_angle(pair, phi))
    }

    /// Clearance from a part, mm; `None` if part and edge do not face each other.
    fn gap(&self, part: usize, pose: &Pose) -> Option<f64> {
        let part = &self.mate().parts[part];
        let own = &self.corner.normals;
        let turned = match self.member {
            Member::Driver => pose.vector_to_driven(&own.direction),
            Member::Driven => pose.vector_to_driver(&own.direction),
        };
        if !own.turned(turned).opposes(&part.normals) {
            return None;
        }
        let points = match self.member {
            Member::Driver => facing_driver_corner(self.corner, part, pose),
            Member::Driven => facing_driven_corner(part, self.corner, pose),
        };
        let points = points.filter(|p| self.meshing.in_reach(p, self.within, pose))?;
        Some(points.gap)
    }

    /// Parts of a fillet, in the contour's order.
    fn parts(&self, fillet: usize) -> impl Iterator<Item = usize> {
        let first = &self.fillets.first;
        let parts = (0..first.len()).map(move |k| (fillet + k) % first.len());
        parts.take_while(move |&i| first[i] == Some(fillet))
    }

    /// Minimum clearance from the parts of a fillet that face the edge, mm.
    fn fillet_gap(&self, fillet: usize, pose: &Pose) -> Option<f64> {
        let gaps = self.parts(fillet).filter_map(|i| self.gap(i, pose));
        gaps.reduce(f64::min)
    }

    /// Clearance from a fillet with straight extensions at its ends, mm, limited to the search distance. The extensions keep the clearance
    /// smooth where the edge passes an end.
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

    /// Positions of the edge along some steps that can be near a fillet.
    fn positions(&self, all: Range<usize>) -> Vec<EdgePosition> {
        let mut lengths = [0.0; 2];
        let mut next = self.point(&self.sampling.poses[all.start]);
        let mut found = Vec::new();
        for step in all {
            let point = next;
            next = self.point(&self.sampling.poses[step + 1]);
            lengths = [lengths[1], (next - point).norm()];
            let reach = self.within + STEP_FACTOR * lengths[0].max(lengths[1]);
            if self.fillets.alone.is_near(&point.coords, reach) {
                found.push(EdgePosition { step, point, reach });
            }
        }
        found
    }

    /// Parts of fillets that are near any of the positions, in the contour's order.
    fn near(&self, positions: &[EdgePosition]) -> Vec<FilletPart> {
        let mut found = Vec::new();
        if let Some(&EdgePosition { point: middle, .. }) = positions.get(positions.len() / 2) {
            let reach = |p: &EdgePosition| (p.point - middle).norm() + p.reach;
            let reach = positions.iter().map(reach).fold(0.0, f64::max);
            self.fillets.alone.tree.each(
                &|group| {
                    (group.bound.center - middle).norm_squared()
                        < (group.bound.radius + reach).powi(2)
                },
                |k| {
                    let part = self.fillets.parts[k];
                    let fillet = self.fillets.first[part];
                    found.extend(fillet.map(|fillet| FilletPart { part, fillet }));
                },
            );
        }
        found
    }

    /// Steps at or after which the edge can meet a fillet, fillet by fillet.
    fn steps(&self, all: Range<usize>) -> Vec<FilletStep> {
        let mate = self.mate();
        let positions = self.positions(all);
        let parts = self.near(&positions);
        let mut found: Vec<FilletStep> = Vec::new();
        for EdgePosition { step, point, reach } in positions {
            let pose = &self.sampling.poses[step];
            let start = found.len();
            for &FilletPart { part: i, fillet } in &parts {
                let part = &mate.parts[i];
                if (part.center - point).norm_squared() >= (part.radius + reach).powi(2) {
                    continue;
                }
                let is_close = part.span.min_distance(&point) < self.within;
                let gap = is_close.then(|| self.gap(i, pose)).flatten();
                match found[start..].iter_mut().find(|s| s.fillet == fillet) {
                    Some(known) => known.gap = known.gap.into_iter().chain(gap).reduce(f64::min),
                    None => found.push(FilletStep { fillet, step, gap }),
                }
            }
        }
        found.sort_by_key(|s| (s.fillet, s.step));
        found
    }

    /// A point of a part with its derivatives.
    fn end(&self, part: usize, u: f64) -> SegmentJet {
        self.mate().parts[part].span.segment.at(u)
    }

    /// Minima at which the edge passes the normals at the ends of a fillet.
    fn ends(&self, steps: &[FilletStep]) -> impl Iterator<Item = NearestCandidate> {
        let first = steps[0].fillet;
        let last = self.parts(first).last().unwrap_or(first);
        let from = steps[0].step.saturating_sub(1);
        let to = (steps[steps.len() - 1].step + 1).min(self.sampling.points.len() - 1);
        let ends = [(first, -1.0), (last, 1.0)].into_iter();
        ends.flat_map(move |(part, u)| {
            let jet = self.end(part, u);
            let normal = outward(&jet);
            let off = move |step: usize| self.point(&self.sampling.poses[step]) - jet.point;
            (from..to).filter_map(move |step| {
                let [p, q] = [step, step + 1].map(off);
                let sides = [p.dot(&jet.first), q.dot(&jet.first)];
                if (sides[0] > 0.0) == (sides[1] > 0.0) {
                    return None;
                }
                // The path between two steps deviates from its chord by about an eighth of the second difference.
                let before = off(step.saturating_sub(1));
                let bend = (before - 2.0 * p + q).norm();
                let between = p + (q - p) * (sides[0] / (sides[0] - sides[1]));
                Some(NearestCandidate {
                    bound: between.dot(&normal) - bend,
                    bracket: Bracket::End { part, u, step },
                })
            })
        })
    }

    /// Minima at steps at which the fillet faces the edge and is nearer than at the neighbouring steps.
    fn between_ends(&self, steps: &[FilletStep]) -> impl Iterator<Item = NearestCandidate> {
        let gap_at = |step: usize| {
            let known = steps.iter().find(|s| s.step == step);
            let gap = known.and_then(|s| s.gap);
            self.smooth_gap(steps[0].fillet, gap, &self.sampling.poses[step])
        };
        steps.iter().filter_map(move |here| {
            let (value, step) = (here.gap?, here.step);
            if step == 0 || step + 1 == self.sampling.points.len() {
                return None;
            }
            let [f, g] = [gap_at(step - 1), gap_at(step + 1)];
            let at = |step: usize, gap: f64| (self.sampling.points[step].input, gap);
            let gaps = [at(step - 1, f), at(step, value), at(step + 1, g)];
            let fillet = here.fillet;
            let bound = value - KINK_SHARE * (f + g - 2.0 * value);
            (value <= f.min(g)).then_some(NearestCandidate {
                bound,
                bracket: Bracket::Between { fillet, gaps },
            })
        })
    }

    /// The minimum of the clearance, mm, if it is below `known`.
    fn nearest(&self, bracket: &Bracket, known: f64) -> Option<Extreme> {
        match *bracket {
            Bracket::End { part, u, step } => {
                let jet = self.end(part, u);
                let along = |pose: &Pose| (self.point(pose) - jet.point).dot(&jet.first);
                let pair = self.meshing.pair;
                let at = self.sampling.root(pair, step, |_, pose| along(pose))?;
                let pose = self.sampling.position.pose(pair, &at);
                Some(Extreme {
                    input: at.input,
                    value: self.gap(part, &pose)?,
                })
            }
            Bracket::Between { fillet, gaps } => {
                let gap = |phi: f64| {
                    let pose = self.pose(phi);
                    self.smooth_gap(fillet, self.fillet_gap(fillet, &pose), &pose)
                };
                let rounding = self.within * WRITTEN;
                let (input, value) = bracketed_minimum_below(gap, gaps, known, rounding);
                // If the minimum is on an extension, the edge is nearest at an end of the fillet.
                let faces = self.fillet_gap(fillet, &self.pose(input)).is_some();
                faces.then_some(Extreme { input, value })
            }
        }
    }
}
