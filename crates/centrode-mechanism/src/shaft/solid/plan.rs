use std::f64::consts::{FRAC_PI_2, TAU};

use centrode_geometry::{Tolerance, bracketed_root};

use crate::shaft::{Groove, Wall};
use crate::transmission::Transmission;

/// Angles nearer than this are one, rad.
const SAME: f64 = 1e-9;

/// Lines looked at for edges that meet.
const LOOKS: u32 = 360;

/// A wall of one turn of the groove, at one level below the surface: a height over the angle round the
/// shaft, for the groove is a graph over it.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub(super) struct Edge {
    /// Turn of the cycle.
    pub(super) turn: usize,
    pub(super) wall: Wall,
    /// Index into [`Plan::levels`].
    pub(super) level: usize,
}

/// Half width and radius of a line along the groove's floor.
#[derive(Clone, Copy, Debug)]
pub(super) struct Level {
    pub(super) half: f64,
    pub(super) radius: f64,
}

/// The angles round the shaft at which anything happens, and every edge's height there.
#[derive(Debug)]
pub(super) struct Plan<'a> {
    groove: &'a Groove,
    pub(super) turns: usize,
    /// Foot of the wall first, then the fillet down to the floor.
    pub(super) levels: Vec<Level>,
    /// Angles in [0, one turn), ascending.
    pub(super) lines: Vec<f64>,
    /// Heights by line and edge.
    heights: Vec<Vec<f64>>,
}

impl<'a> Plan<'a> {
    pub(super) fn new(groove: &'a Groove, fillet: f64, tolerance: Tolerance) -> Self {
        let mut plan = Self::empty(groove, levels(groove, fillet, tolerance));
        let count = columns(groove.radius(), tolerance);
        let mut events = even(count);
        events.extend(plan.meetings(count));
        plan.set_lines(events);
        plan
    }

    /// A plan without fillet whose edges are smooth between its lines: `count` even ones, those where edges
    /// meet, and those where the law breaks.
    pub(super) fn smooth(groove: &'a Groove, count: u32) -> Self {
        let floor = Level {
            half: 0.5 * groove.width(),
            radius: groove.radius() - groove.depth(),
        };
        let mut plan = Self::empty(groove, vec![floor]);
        let mut events = even(count);
        events.extend(plan.meetings(LOOKS.max(count)));
        events.extend(plan.breaks().into_iter().map(|phi| (phi, Vec::new())));
        plan.set_lines(events);
        plan
    }

    fn empty(groove: &'a Groove, levels: Vec<Level>) -> Self {
        Self {
            groove,
            turns: groove.traverse().turns() as usize,
            levels,
            lines: Vec::new(),
            heights: Vec::new(),
        }
    }

    /// Angles at which edges meet that swap between two of `count` even lines.
    fn meetings(&self, count: u32) -> Vec<(f64, Vec<[usize; 2]>)> {
        let angle = |i: usize| TAU * i as f64 / f64::from(count);
        let heights: Vec<Vec<f64>> = (0..count as usize)
            .map(|i| self.heights_at(angle(i)))
            .collect();
        let mut meetings = Vec::new();
        for (i, before) in heights.iter().enumerate() {
            let after = match heights.get(i + 1) {
                Some(heights) => heights.clone(),
                None => self.next_turn(&heights[0]),
            };
            for pair in self.swapped(before, &after) {
                meetings.push((self.meeting(pair, angle(i), angle(i + 1)), vec![pair]));
            }
        }
        meetings
    }

    /// Angles round the shaft at which an edge is not smooth.
    fn breaks(&self) -> Vec<f64> {
        let (traverse, r) = (self.groove.traverse(), self.groove.radius());
        let sides = Wall::BOTH.map(|wall| wall.sign() * 0.5 * self.groove.width());
        let breaks = traverse.breaks();
        let at = |theta: f64, side: f64| {
            let slope = traverse.at(theta).velocity;
            (theta - side * slope / (r * r.hypot(slope))).rem_euclid(TAU)
        };
        breaks
            .iter()
            .flat_map(|&theta| sides.map(|side| at(theta, side)))
            .collect()
    }

    /// Sorts the angles, makes those that are nearly one into one, and lets edges that meet there meet.
    fn set_lines(&mut self, mut events: Vec<(f64, Vec<[usize; 2]>)>) {
        for (phi, pairs) in &mut events {
            if *phi >= TAU - SAME {
                *phi = 0.0;
                // The same edges, a turn later.
                let next = |edge: usize| self.edge_after(edge);
                *pairs = pairs.iter().map(|&[a, b]| [next(a), next(b)]).collect();
            }
        }
        events.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut merged: Vec<(f64, Vec<[usize; 2]>)> = Vec::new();
        for (phi, pairs) in events {
            match merged.last_mut() {
                Some((last, known)) if phi - *last < SAME => known.extend(pairs),
                _ => merged.push((phi, pairs)),
            }
        }
        for (phi, pairs) in merged {
            let mut heights = self.heights_at(phi);
            for [a, b] in pairs {
                heights[b] = heights[a];
            }
            self.lines.push(phi);
            self.heights.push(heights);
        }
    }

    pub(super) fn edges(&self) -> usize {
        2 * self.turns * self.levels.len()
    }

    pub(super) fn edge(&self, index: usize) -> Edge {
        let (row, side) = (index / 2, index % 2);
        Edge {
            turn: row % self.turns,
            wall: Wall::BOTH[side],
            level: row / self.turns,
        }
    }

    pub(super) fn index(&self, edge: Edge) -> usize {
        let side = usize::from(edge.wall == Wall::Right);
        2 * (edge.level * self.turns + edge.turn) + side
    }

    /// The edge that continues an edge beyond a whole turn.
    fn edge_after(&self, index: usize) -> usize {
        let edge = self.edge(index);
        self.index(Edge {
            turn: (edge.turn + 1) % self.turns,
            ..edge
        })
    }

    /// Heights at the end of the turn from those at its start.
    pub(super) fn next_turn(&self, heights: &[f64]) -> Vec<f64> {
        (0..heights.len())
            .map(|edge| heights[self.edge_after(edge)])
            .collect()
    }

    /// Heights of all edges on a line; the line after the last is the first, a turn later.
    pub(super) fn heights(&self, line: usize) -> Vec<f64> {
        match self.heights.get(line) {
            Some(heights) => heights.clone(),
            None => self.next_turn(&self.heights[0]),
        }
    }

    fn heights_at(&self, phi: f64) -> Vec<f64> {
        (0..self.edges())
            .map(|edge| self.height(edge, phi))
            .collect()
    }

    /// Height of an edge at an angle round the shaft.
    pub(super) fn height(&self, edge: usize, phi: f64) -> f64 {
        let Edge { turn, wall, level } = self.edge(edge);
        let half = self.levels[level].half;
        let side = match wall {
            Wall::Left => half,
            Wall::Right => -half,
        };
        let (traverse, r) = (self.groove.traverse(), self.groove.radius());
        let target = phi + TAU * turn as f64;
        // The foot of the normal: R theta - side sin(lead angle) = R target.
        let mut theta = target;
        let mut motion = traverse.at(theta);
        for _ in 0..30 {
            let length = r.hypot(motion.velocity);
            let off = r * (theta - target) - side * motion.velocity / length;
            let slope = r - side * motion.acceleration * r * r / (length * length * length);
            let step = off / slope;
            theta -= step;
            motion = traverse.at(theta);
            if step.abs() <= 1e-15 * (1.0 + theta.abs()) {
                break;
            }
        }
        motion.position + side * r / r.hypot(motion.velocity)
    }

    /// Pairs of edges of one level whose order differs between two lines.
    fn swapped(&self, before: &[f64], after: &[f64]) -> Vec<[usize; 2]> {
        let mut pairs = Vec::new();
        let row = 2 * self.turns;
        for level in 0..self.levels.len() {
            let mut order: Vec<usize> = (level * row..(level + 1) * row).collect();
            order.sort_by(|&a, &b| before[a].total_cmp(&before[b]));
            // Insertion sort by the later heights meets every swapped pair once.
            for i in 1..order.len() {
                let mut j = i;
                while j > 0 && after[order[j - 1]] > after[order[j]] {
                    pairs.push([order[j - 1], order[j]]);
                    order.swap(j - 1, j);
                    j -= 1;
                }
            }
        }
        pairs
    }

    /// Angle at which two edges meet that swap between two others.
    fn meeting(&self, [a, b]: [usize; 2], start: f64, end: f64) -> f64 {
        let apart = |phi: f64| self.height(a, phi) - self.height(b, phi);
        let (low, high) = (apart(start), apart(end));
        if low * high > 0.0 {
            return if low.abs() < high.abs() { start } else { end };
        }
        bracketed_root(apart, start, end, low, high)
    }
}

/// Even lines round the shaft.
fn even(count: u32) -> Vec<(f64, Vec<[usize; 2]>)> {
    (0..count)
        .map(|i| (TAU * f64::from(i) / f64::from(count), Vec::new()))
        .collect()
}

/// Columns round the shaft so that a chord is within the tolerance of its arc.
pub(super) fn columns(radius: f64, tolerance: Tolerance) -> u32 {
    let half = (1.0 - (tolerance.mm() / radius).min(0.5)).acos();
    ((FRAC_PI_2 * 2.0 / half).ceil().min(1e5) as u32).max(16)
}

/// Foot of the wall, and the fillet down to the floor within the tolerance.
fn levels(groove: &Groove, fillet: f64, tolerance: Tolerance) -> Vec<Level> {
    let (half, floor) = (0.5 * groove.width(), groove.radius() - groove.depth());
    if fillet == 0.0 {
        return vec![Level {
            half,
            radius: floor,
        }];
    }
    let step = 2.0 * (1.0 - (tolerance.mm() / fillet).min(0.5)).acos();
    let count = (FRAC_PI_2 / step).ceil().clamp(1.0, 64.0);
    (0..=count as u32)
        .map(|i| {
            let (sin, cos) = (FRAC_PI_2 * f64::from(i) / count).sin_cos();
            Level {
                half: half - fillet * (1.0 - cos),
                radius: floor + fillet * (1.0 - sin),
            }
        })
        .collect()
}
