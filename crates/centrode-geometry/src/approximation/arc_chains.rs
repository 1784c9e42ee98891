use super::{
    arc_plan::ArcPlan,
    biarc::{Biarc, Circle, arc, bulge},
    smooth_run::Node,
};
use crate::{Point, Vector, curve::Segment};

/// How thoroughly the fewest arcs are searched for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Beam {
    /// Chains followed side by side.
    width: usize,
    /// End nodes tried for the next arc of a chain.
    branches: usize,
    /// Offsets tried there, of [`SIDES`].
    sides: usize,
}

impl Beam {
    /// For files: hardly ever an arc too many.
    pub(crate) const THOROUGH: Self = Self {
        width: 12,
        branches: 2,
        sides: SIDES.len(),
    };
    /// For what is seen: a few arcs more in a fraction of the time.
    pub(crate) const QUICK: Self = Self {
        width: 4,
        branches: 2,
        sides: 1,
    };
}

/// Lengths tried for the next arc, in arcs as planned.
const REACHES: [f64; 20] = [
    16.0, 4.0, 2.0, 1.7, 1.5, 1.4, 1.3, 1.2, 1.15, 1.1, 1.05, 1.0, 0.95, 0.9, 0.85, 0.8, 0.65, 0.5,
    0.25, 0.0,
];
/// Offsets from the curve at which arcs may join, as shares of the limit.
const SIDES: [f64; 3] = [0.0, 0.3, -0.3];
/// Greatest angle, rad, one arc turns through.
const HALF_TURN: f64 = 2.9;
/// Cost, in arcs, of reaching a node with the tangent off by one planned deviation.
const LEAN_COST: f64 = 0.15;
/// Chains that reach the same node with tangents closer than this share of the planned deviation are duplicates; the
/// better is kept.
const LEAN_CLASS: f64 = 0.35;

/// A chain of arcs from the start of the run to a place at a node.
#[derive(Clone, Copy, Debug)]
struct ArcChain {
    node: usize,
    /// Index of the node's offset in [`SIDES`].
    side: usize,
    point: Point,
    /// Direction of arrival.
    tangent: Vector,
    /// Deviation of that direction from the planned one, in classes.
    lean: i32,
    /// Index of the chain without its last arc.
    before: usize,
    /// Merit of the chain: planned arcs up to here, less the cost of a deviating tangent.
    merit: f64,
}

/// Chains of arcs along a smooth run, each arc leaving in the direction in which the one before it
/// arrived. All chains of as many arcs are carried on together, the best few of them: a beam search for
/// the fewest arcs.
pub(crate) struct ArcChains<'a> {
    nodes: &'a [Node],
    free: [bool; 2],
    limit: f64,
    plan: ArcPlan,
    links: Vec<ArcChain>,
    beam: Beam,
}

impl<'a> ArcChains<'a> {
    /// Plans the chains of a run; `free` says at which ends the tangent need not be the curve's own.
    pub(crate) fn new(nodes: &'a [Node], free: [bool; 2], limit: f64, beam: Beam) -> Self {
        Self {
            beam,
            nodes,
            free,
            limit,
            plan: ArcPlan::new(nodes, free, limit),
            links: Vec::with_capacity(1024),
        }
    }

    /// Appends the arcs of the shortest chain found.
    pub(crate) fn fewest(mut self, out: &mut Vec<Segment>) {
        let last = self.nodes.len() - 1;
        let mut front = self.starts();
        // The first chain that a pair of arcs could finish, and the count with them.
        let mut closing: Option<(usize, usize, Biarc)> = None;
        let mut count = 0;
        loop {
            crate::checkpoint();
            if let Some(&done) = front.iter().find(|&&link| self.links[link].node == last) {
                self.trace(done, out);
                return;
            }
            if let Some((total, link, biarc)) = closing
                && total <= count + 1
            {
                self.trace(link, out);
                out.extend(biarc.segments);
                return;
            }
            if !self.free[1] && closing.is_none() {
                closing = front.iter().find_map(|&link| {
                    let biarc = self.close(&self.links[link])?;
                    Some((count + 2, link, biarc))
                });
            }
            let mut next =
                Vec::with_capacity(self.beam.width * self.beam.branches * self.beam.sides);
            for &link in &front {
                self.carry_on(link, &mut next);
            }
            if next.is_empty() && closing.is_none() {
                // No arc fits even one step: the curve is bent tighter than its own nodes.
                front.truncate(1);
                next = front.iter().map(|&link| self.force(link)).collect();
            }
            front = self.best(next);
            count += 1;
        }
    }

    /// Chains of no arc yet: with the curve's tangent and, if the tangent is free, also the planned and the mean one.
    fn starts(&mut self) -> Vec<usize> {
        let (own, planned) = (self.nodes[0].tangent, self.plan.tangents[0]);
        let tangents = [own, planned, (own + planned).normalize()];
        let count = if self.free[0] { 3 } else { 1 };
        self.links
            .extend(tangents[..count].iter().map(|&tangent| ArcChain {
                node: 0,
                side: 0,
                point: self.nodes[0].point,
                tangent,
                lean: 0,
                before: usize::MAX,
                merit: 0.0,
            }));
        (0..count).collect()
    }

    /// Adds the longest arcs that fit after a chain.
    fn carry_on(&mut self, before: usize, next: &mut Vec<usize>) {
        let from = self.links[before];
        let last = self.nodes.len() - 1;
        let (mut tried, mut found) = (last + 1, 0);
        for reach in REACHES {
            let target = self.plan.count[from.node] + reach;
            let end = self.plan.count.partition_point(|&c| c <= target);
            let end = end.saturating_sub(1).max(from.node + 1).min(last);
            // The last node has a tangent of its own to arrive along, unless that is free; an arc of
            // more than a half turn could bend to the wrong side.
            let turned = self.plan.turned[end] - self.plan.turned[from.node];
            if end >= tried || (end == last && !self.free[1]) || turned.abs() > HALF_TURN {
                continue;
            }
            tried = end;
            let sides = if end == last { 1 } else { self.beam.sides };
            let known = next.len();
            for side in 0..sides {
                if let Some(link) = self.link(before, end, side) {
                    next.push(self.links.len());
                    self.links.push(link);
                }
            }
            found += usize::from(next.len() > known);
            if found == self.beam.branches {
                return;
            }
        }
    }

    /// The chain with one more arc, to a side of a node, if that arc stays within the limit.
    fn link(&self, before: usize, node: usize, side: usize) -> Option<ArcChain> {
        let from = &self.links[before];
        let to = &self.nodes[node];
        let normal = Vector::new(-to.tangent.y, to.tangent.x);
        let point = to.point + normal * (SIDES[side] * self.limit);
        let chord = (point - from.point).try_normalize(0.0)?;
        let along = from.tangent.dot(&chord);
        let circle = Circle::through(from.point, from.tangent, point);
        if along < 0.1 || !circle.follows(&self.nodes[from.node..=node], self.limit) {
            return None;
        }
        // An arc arrives as it left, mirrored in its chord.
        let tangent = (chord * (2.0 * along) - from.tangent).normalize();
        let lean = self.plan.tangents[node].perp(&tangent) / self.plan.lean[node];
        Some(ArcChain {
            node,
            side,
            point,
            tangent,
            lean: (lean / LEAN_CLASS).round() as i32,
            before,
            merit: self.plan.count[node] - LEAN_COST * lean.abs(),
        })
    }

    /// A step to the next node whatever its error, after which the curve's own tangent is taken up.
    fn force(&mut self, before: usize) -> usize {
        let node = self.links[before].node + 1;
        self.links.push(ArcChain {
            node,
            side: 0,
            point: self.nodes[node].point,
            tangent: self.nodes[node].tangent,
            lean: 0,
            before,
            merit: 0.0,
        });
        self.links.len() - 1
    }

    /// The pair of arcs from the end of a chain to the end of the run.
    fn close(&self, link: &ArcChain) -> Option<Biarc> {
        let last = self.nodes.len() - 1;
        if self.plan.count[last] - self.plan.count[link.node] > 4.0 || link.side != 0 {
            return None;
        }
        let tangents = [link.tangent, self.nodes[last].tangent];
        Biarc::fit(&self.nodes[link.node..], tangents, self.limit)
    }

    /// The best chains, only one of those that arrive at a place alike.
    fn best(&self, mut links: Vec<usize>) -> Vec<usize> {
        links.sort_by(|&a, &b| self.links[b].merit.total_cmp(&self.links[a].merit));
        let mut kept: Vec<usize> = Vec::with_capacity(self.beam.width);
        let place = |link: usize| {
            let ArcChain {
                node, side, lean, ..
            } = self.links[link];
            (node, side, lean)
        };
        for link in links {
            if kept.iter().all(|&other| place(other) != place(link)) {
                kept.push(link);
            }
            if kept.len() == self.beam.width {
                break;
            }
        }
        kept
    }

    /// Appends the arcs of a chain.
    fn trace(&self, mut link: usize, out: &mut Vec<Segment>) {
        let first = out.len();
        while let ArcChain {
            point: end, before, ..
        } = self.links[link]
            && before != usize::MAX
        {
            let ArcChain {
                point: start,
                tangent,
                ..
            } = self.links[before];
            out.push(arc(start, end, bulge(tangent, end - start)));
            link = before;
        }
        out[first..].reverse();
    }
}
