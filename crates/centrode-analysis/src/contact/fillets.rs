//! Least clearance of the edges of teeth from the fillets of the mate, with the gears at their law.

use std::ops::Range;

use centrode_geometry::{Extreme, Point, bracketed_minimum_below};
use centrode_mechanism::gear::{Member, Role};

use super::{
    body::{Body, Corner},
    meshing::Meshing,
    touch::{self, Pose},
    walk::Walk,
};

/// Steps a pitch among which the least distance is sought.
const STEPS: u32 = 16;

/// Multiple of the least distance known within which lesser ones are looked for.
const BEYOND: f64 = 4.0;

/// Least such distance, modules.
const LEAST: f64 = 0.05;

/// Way of an edge along a fillet in a step, modules, at most.
const STEP: f64 = 0.25;

/// Share of the greatest distance looked at by which no place is told from another.
const ROUNDING: f64 = 1e-12;

/// An edge of one gear on its way along a fillet of the other.
struct Approach<'a> {
    meshing: &'a Meshing<'a>,
    walk: &'a Walk,
    /// First part of the fillet of each part of the mate.
    fillets: &'a [Option<usize>],
    /// Distance beyond which nothing is looked at, mm.
    within: f64,
    /// The gear with the edge.
    member: Member,
    corner: &'a Corner,
}

/// Where an edge is near a fillet at a step: the fillet by its first part, and how far off it is, if it faces the edge.
struct Step {
    fillet: usize,
    step: usize,
    gap: Option<f64>,
}

/// First part of the fillet of each part of a body; nothing where it is none.
fn fillets(body: &Body<'_>) -> Vec<Option<usize>> {
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
    first
}

impl Meshing<'_> {
    /// Least clearance of an edge from a fillet over the cycle with the gears at their law, where one of `known` mm is known;
    /// nothing where none is near.
    ///
    /// An edge is nearest where its way runs along the fillet, or where the fillet that faces it ends. The latter is the root of
    /// the edge's distance, along the tangent, from that end.
    pub(super) fn edges_to_fillets(&self, known: f64) -> Option<Extreme> {
        let within = (BEYOND * known).max(LEAST * self.module).min(self.near);
        let walk = Walk::new(self.pair, STEPS);
        let gears = [
            (Member::Driver, &self.driver, &self.driven),
            (Member::Driven, &self.driven, &self.driver),
        ];
        let mut best: Option<Extreme> = None;
        for (member, own, mate) in gears {
            let fillets = fillets(mate);
            for corner in own.parts.iter().filter_map(|part| part.corner.as_ref()) {
                let approach = Approach {
                    meshing: self,
                    walk: &walk,
                    fillets: &fillets,
                    within,
                    member,
                    corner,
                };
                for steps in walk.passages(member, corner.point) {
                    let steps = approach.steps(steps);
                    for steps in steps.chunk_by(|a, b| a.fillet == b.fillet) {
                        approach.at_ends(steps, &mut best);
                        approach.between_ends(steps, &mut best);
                    }
                }
            }
        }
        best
    }
}

impl Approach<'_> {
    fn mate(&self) -> &Body<'_> {
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
        Pose::at_law(self.meshing.pair, phi)
    }

    /// Distance from a part that faces the edge.
    fn gap(&self, part: usize, pose: &Pose) -> Option<f64> {
        let part = &self.mate().parts[part];
        let touch = match self.member {
            Member::Driver => touch::driver_corner(self.corner, part, pose),
            Member::Driven => touch::driven_corner(part, self.corner, pose),
        };
        let touch = touch.filter(|t| self.meshing.in_reach(t, self.within, pose))?;
        Some(touch.gap)
    }

    /// Parts of a fillet, in the contour's order.
    fn parts(&self, fillet: usize) -> impl Iterator<Item = usize> {
        let count = self.fillets.len();
        let parts = (0..count).map(move |k| (fillet + k) % count);
        parts.take_while(move |&i| self.fillets[i] == Some(fillet))
    }

    /// Least distance from the parts of a fillet that face the edge.
    fn fillet_gap(&self, fillet: usize, pose: &Pose) -> Option<f64> {
        let gaps = self.parts(fillet).filter_map(|i| self.gap(i, pose));
        gaps.reduce(f64::min)
    }

    /// Steps at which a fillet is near, fillet by fillet.
    fn steps(&self, all: Range<usize>) -> Vec<Step> {
        let (mate, near) = (self.mate(), self.within + STEP * self.meshing.module);
        let mut found: Vec<Step> = Vec::new();
        for step in all {
            let pose = &self.walk.poses[step];
            let point = self.point(pose);
            if !mate.is_near(&point.coords, near) {
                continue;
            }
            let start = found.len();
            mate.tree.each(
                &|run| (run.center - point).norm() < run.radius + near,
                |i| {
                    let Some(fillet) = self.fillets[i] else {
                        return;
                    };
                    let part = &mate.parts[i];
                    let is_close = (part.center - point).norm() < part.radius + self.within;
                    let gap = is_close.then(|| self.gap(i, pose)).flatten();
                    match found[start..].iter_mut().find(|s| s.fillet == fillet) {
                        Some(known) => {
                            known.gap = known.gap.into_iter().chain(gap).reduce(f64::min)
                        }
                        None => found.push(Step { fillet, step, gap }),
                    }
                },
            );
        }
        found.sort_by_key(|s| (s.fillet, s.step));
        found
    }

    /// Distances where the edge passes the normals at the ends of a fillet.
    fn at_ends(&self, steps: &[Step], best: &mut Option<Extreme>) {
        let (first, walk) = (steps[0].fillet, self.walk);
        let last = self.parts(first).last().unwrap_or(first);
        let from = steps[0].step.saturating_sub(1);
        let to = (steps[steps.len() - 1].step + 1).min(walk.inputs.len() - 1);
        for (part, u) in [(first, -1.0), (last, 1.0)] {
            let jet = self.mate().parts[part].segment.at(u);
            let along = |pose: &Pose| (self.point(pose) - jet.point).dot(&jet.first);
            let at_step = |k: usize| along(&walk.poses[k]);
            for phi in walk.roots(from..to, at_step, |phi| along(&self.pose(phi))) {
                if let Some(value) = self.gap(part, &self.pose(phi)) {
                    self.keep(best, phi, value);
                }
            }
        }
    }

    /// Least distances where the fillet faces the edge on and on.
    fn between_ends(&self, steps: &[Step], best: &mut Option<Extreme>) {
        let rounding = self.within * ROUNDING;
        // Beyond what is looked at there is nothing nearer.
        let gap_at = |step: usize| {
            let known = steps.iter().find(|s| s.step == step);
            known.and_then(|s| s.gap).unwrap_or(self.within)
        };
        for here in steps {
            let (Some(value), step) = (here.gap, here.step) else {
                continue;
            };
            if step == 0 || step + 1 == self.walk.inputs.len() {
                continue;
            }
            let [f, g] = [gap_at(step - 1), gap_at(step + 1)];
            let above = f + g - 2.0 * value;
            let known = best.map_or(f64::INFINITY, |b| b.value);
            if value > f.min(g) || value - above >= known {
                continue;
            }
            let at = |step: usize, gap: f64| (self.walk.inputs[step], gap);
            let (phi, value) = bracketed_minimum_below(
                |phi| {
                    let gap = self.fillet_gap(here.fillet, &self.pose(phi));
                    gap.unwrap_or(self.within)
                },
                [at(step - 1, f), at(step, value), at(step + 1, g)],
                known,
                rounding,
            );
            self.keep(best, phi, value);
        }
    }

    fn keep(&self, best: &mut Option<Extreme>, phi: f64, value: f64) {
        if best.is_none_or(|b| value < b.value) {
            let input = phi.rem_euclid(self.meshing.pair.cycle());
            *best = Some(Extreme { input, value });
        }
    }
}
