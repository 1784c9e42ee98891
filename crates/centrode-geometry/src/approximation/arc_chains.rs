use super::{
    arc_plan::ArcPlan,
    biarc::{Biarc, Circle, arc, bulge},
    smooth_run::Node,
};
use crate::{Point, Vector, curve::Segment};

/// Effort of the beam search for the minimum number of arcs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Beam {
    /// Number of chains that are extended together.
    width: usize,
    /// Number of end nodes tried for the next arc of a chain.
    branches: usize,
    /// Number of offsets of [`SIDES`] tried at an end node.
    sides: usize,
}

impl Beam {
    /// For files: rarely one arc more than necessary.
    pub(crate) const THOROUGH: Self = Self {
        width: 12,
        branches: 2,
        sides: SIDES.len(),
    };
    /// For display: a few more arcs in a fraction of the time.
    pub(crate) const QUICK: Self = Self {
        width: 4,
        branches: 2,
        sides: 1,
    };
}

/// Lengths tried for the next arc, relative to the planned arc, from the longest. More values find a few longer arcs and cost
/// time.
const LENGTHS: [f64; 20] = [
    16.0, 4.0, 2.0, 1.7, 1.5, 1.4, 1.3, 1.2, 1.15, 1.1, 1.05, 1.0, 0.95, 0.9, 0.85, 0.8, 0.65, 0.5,
    0.25, 0.0,
];
/// Offsets from the curve at which arcs may join, relative to the limit. Larger ones leave less tolerance for the arcs.
const SIDES: [f64; 3] = [0.0, 0.3, -0.3];
/// Maximum angle, rad, of one arc: a little less than half a turn, beyond which it could bend to the wrong side.
const MAX_TURN: f64 = 2.9;
/// Cost, in arcs, of a tangent that is off by one planned tangent angle. Ten times larger, the search prefers short arcs; ten
/// times smaller, arcs end in directions that no long arc can continue.
const TANGENT_COST: f64 = 0.15;
/// Difference of tangents, relative to the planned tangent angle, below which two chains at the same node are duplicates: only
/// the better one stays. Ten times larger drops good chains; ten times smaller fills the beam with copies.
const TANGENT_CLASS: f64 = 0.35;

/// A chain of arcs from the start of the run to a point at a node.
#[derive(Clone, Copy, Debug)]
struct ArcChain {
    node: usize,
    /// Index of the node's offset in [`SIDES`].
    side: usize,
    point: Point,
    /// Direction at its end.
    tangent: Vector,
    /// Deviation of that direction from the planned one, in multiples of [`TANGENT_CLASS`].
    tangent_class: i32,
    /// Index of the chain without its last arc.
    before: usize,
    /// Number of planned arcs up to here, minus the cost of a deviating tangent.
    merit: f64,
}

/// Beam search for the minimum number of arcs along a smooth run.
///
/// Each arc starts in the direction in which the previous one ends. The search extends the best few chains of equal number
/// of arcs together.
pub(crate) struct ArcChains<'a> {
    nodes: &'a [Node],
    free: [bool; 2],
    limit: f64,
    plan: ArcPlan,
    links: Vec<ArcChain>,
    beam: Beam,
}

/// A chain that two more arcs complete.
struct Completion {
    /// Number of arcs in all.
    count: usize,
    /// Index of the chain.
    link: usize,
    /// The two arcs.
    biarc: Biarc,
}

impl<'a> ArcChains<'a> {
    /// Plans the chains of a run; `free` states at which ends the arcs need not have the tangent of the curve.
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
    pub(crate) fn shortest(mut self, out: &mut Vec<Segment>) {
        let last = self.nodes.len() - 1;
        let mut front = self.starts();
        // The first chain that a pair of arcs completes.
        let mut completion: Option<Completion> = None;
        let mut count = 0;
        loop {
            crate::checkpoint();
            if let Some(&done) = front.iter().find(|&&link| self.links[link].node == last) {
                self.trace(done, out);
                return;
            }
            if let Some(found) = &completion
                && found.count <= count + 1
            {
                self.trace(found.link, out);
                out.extend(found.biarc.segments);
                return;
            }
            if !self.free[1] && completion.is_none() {
                completion = front.iter().find_map(|&link| {
                    Some(Completion {
                        count: count + 2,
                        link,
                        biarc: self.complete(&self.links[link])?,
                    })
                });
            }
            let mut next =
                Vec::with_capacity(self.beam.width * self.beam.branches * self.beam.sides);
            for &link in &front {
                self.extend(link, &mut next);
            }
            if next.is_empty() && completion.is_none() {
                // No arc fits even one step: the curve bends more sharply than its nodes resolve.
                front.truncate(1);
                next = front.iter().map(|&link| self.force(link)).collect();
            }
            front = self.best(next);
            count += 1;
        }
    }

    /// Chains without arcs: with the tangent of the curve and, if the tangent is free, also the planned and the mean one.
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
                tangent_class: 0,
                before: usize::MAX,
                merit: 0.0,
            }));
        (0..count).collect()
    }

    /// Adds the longest arcs that fit after a chain.
    fn extend(&mut self, before: usize, next: &mut Vec<usize>) {
        let from = self.links[before];
        let last = self.nodes.len() - 1;
        let (mut tried, mut found) = (last + 1, 0);
        for length in LENGTHS {
            let target = self.plan.count[from.node] + length;
            let end = self.plan.count.partition_point(|&c| c <= target);
            let end = end.saturating_sub(1).max(from.node + 1).min(last);
            // An arc may end at the last node only if the tangent there is free.
            let turned = self.plan.turned[end] - self.plan.turned[from.node];
            if end >= tried || (end == last && !self.free[1]) || turned.abs() > MAX_TURN {
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

    /// The chain with one more arc to an offset of a node; `None` if that arc exceeds the limit.
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
        // The tangent at the end of an arc is that at its start, mirrored in its chord.
        let tangent = (chord * (2.0 * along) - from.tangent).normalize();
        let off = self.plan.tangents[node].perp(&tangent) / self.plan.tangent_angle[node];
        Some(ArcChain {
            node,
            side,
            point,
            tangent,
            tangent_class: (off / TANGENT_CLASS).round() as i32,
            before,
            merit: self.plan.count[node] - TANGENT_COST * off.abs(),
        })
    }

    /// The chain with an arc to the next node, whatever its error; it continues with the tangent of the curve.
    fn force(&mut self, before: usize) -> usize {
        let node = self.links[before].node + 1;
        self.links.push(ArcChain {
            node,
            side: 0,
            point: self.nodes[node].point,
            tangent: self.nodes[node].tangent,
            tangent_class: 0,
            before,
            merit: 0.0,
        });
        self.links.len() - 1
    }

    /// The pair of arcs from the end of a chain to the end of the run.
    fn complete(&self, link: &ArcChain) -> Option<Biarc> {
        let last = self.nodes.len() - 1;
        if self.plan.count[last] - self.plan.count[link.node] > 4.0 || link.side != 0 {
            return None;
        }
        let tangents = [link.tangent, self.nodes[last].tangent];
        Biarc::fit(&self.nodes[link.node..], tangents, self.limit)
    }

    /// The best chains, without duplicates.
    fn best(&self, mut links: Vec<usize>) -> Vec<usize> {
        links.sort_by(|&a, &b| self.links[b].merit.total_cmp(&self.links[a].merit));
        let mut best: Vec<usize> = Vec::with_capacity(self.beam.width);
        let class = |link: usize| {
            let ArcChain {
                node,
                side,
                tangent_class,
                ..
            } = self.links[link];
            (node, side, tangent_class)
        };
        for link in links {
            if best.iter().all(|&other| class(other) != class(link)) {
                best.push(link);
            }
            if best.len() == self.beam.width {
                break;
            }
        }
        best
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
