mod edge;
mod event;
mod level;

use std::f64::consts::{FRAC_PI_2, TAU};

use centrode_geometry::{Tolerance, bracketed_root, checkpoint};

pub(super) use edge::Edge;
use event::{Event, even};
pub(super) use level::{Level, columns};
use level::{levels, rises};

use crate::{Groove, Wall};
use centrode_kinematics::transmission::Transmission;

/// Difference, rad, below which two angles count as equal.
const SAME: f64 = 1e-9;

/// Share of the tolerance for the bend of an edge between two lines; the rest is for the walls' twist.
const BENT: f64 = 0.25;

/// Maximum number of halvings of the angle between two lines.
const DEEPEST: u32 = 12;

/// Number of lines on which edges are compared to find where they meet.
const SAMPLES: u32 = 360;

/// The lines: angles round the shaft at which edges meet, break or must be sampled, and every edge's height there.
#[derive(Debug)]
pub(super) struct Plan<'a> {
    groove: &'a Groove,
    pub(super) turns: usize,
    /// Height, mm, by which each turn of the groove lies above the one before; `None` if it does not repeat it.
    rises: Vec<Option<f64>>,
    /// Foot of the wall first, then the fillet down to the floor.
    pub(super) levels: Vec<Level>,
    /// Rows of faces from the foot of a wall up to the surface.
    pub(super) rows: u32,
    /// Angles in [0, one turn), ascending.
    pub(super) lines: Vec<f64>,
    /// Heights by line and edge.
    heights: Vec<Vec<f64>>,
}

impl<'a> Plan<'a> {
    pub(super) fn new(groove: &'a Groove, fillet: f64, tolerance: Tolerance) -> Self {
        let (foot, tol) = (groove.radius() - groove.depth() + fillet, tolerance.mm());
        // Along the fillet the chords round the shaft and those down the fillet add up.
        let chord = if fillet > 0.0 { 0.5 * tol } else { tol };
        let mut plan = Self::empty(groove, levels(groove, fillet, 0.5 * tol));
        let count = columns(groove.radius(), tol).max(columns(foot, chord));
        let rows = plan.rows(count);
        let mut events = plan.meetings(&rows);
        events.extend(even(count).zip(rows).map(|(event, heights)| Event {
            heights: Some(heights),
            ..event
        }));
        plan.set_lines(events);
        plan.refine(BENT * tol);
        plan.rows = plan.wall_rows((1.0 - BENT) * tol);
        plan
    }

    /// Plan of one level whose edges are smooth between its lines: `count` equally spaced lines, those where edges meet, and
    /// those where the law breaks.
    pub(super) fn smooth(groove: &'a Groove, level: Level, count: u32) -> Self {
        let mut plan = Self::empty(groove, vec![level]);
        let mut events: Vec<Event> = even(count).collect();
        events.extend(plan.meetings(&plan.rows(SAMPLES.max(count))));
        events.extend(plan.breaks().into_iter().map(Event::new));
        plan.set_lines(events);
        plan
    }

    fn empty(groove: &'a Groove, levels: Vec<Level>) -> Self {
        Self {
            groove,
            turns: groove.traverse().turns() as usize,
            rises: rises(groove),
            levels,
            rows: 1,
            lines: Vec::new(),
            heights: Vec::new(),
        }
    }

    /// Heights of all edges on `count` equally spaced lines.
    fn rows(&self, count: u32) -> Vec<Vec<f64>> {
        even(count)
            .map(|event| self.heights_at(event.phi))
            .collect()
    }

    /// Angles at which two edges meet: their order changes between two of the equally spaced lines with these heights.
    fn meetings(&self, rows: &[Vec<f64>]) -> Vec<Event> {
        let angle = |i: usize| TAU * i as f64 / rows.len() as f64;
        let mut meetings = Vec::new();
        for (i, before) in rows.iter().enumerate() {
            let later;
            let after = if let Some(heights) = rows.get(i + 1) {
                heights
            } else {
                later = self.next_turn(&rows[0]);
                &later
            };
            for pair in self.swapped(before, after) {
                meetings.push(Event {
                    pairs: vec![pair],
                    ..Event::new(self.meeting(pair, angle(i), angle(i + 1)))
                });
            }
        }
        meetings
    }

    /// Angles round the shaft at which an edge is not smooth.
    fn breaks(&self) -> Vec<f64> {
        let (traverse, r) = (self.groove.traverse(), self.groove.radius());
        let sides = self
            .levels
            .iter()
            .flat_map(|level| Wall::BOTH.map(|wall| wall.sign() * level.half));
        let sides: Vec<f64> = sides.collect();
        let breaks = traverse.breaks();
        let at = |theta: f64, side: f64| {
            let slope = traverse.at(theta).velocity;
            (theta - side * slope / (r * r.hypot(slope))).rem_euclid(TAU)
        };
        breaks
            .iter()
            .flat_map(|&theta| sides.iter().map(move |&side| at(theta, side)))
            .collect()
    }

    /// Sorts the angles, merges nearly equal ones, and gives equal heights to edges that meet there.
    fn set_lines(&mut self, mut events: Vec<Event>) {
        for event in &mut events {
            if event.phi >= TAU - SAME {
                event.phi = 0.0;
                // At the angle zero these are the edges one turn later.
                let next = |edge: usize| self.edge_after(edge);
                event.pairs = event
                    .pairs
                    .iter()
                    .map(|&[a, b]| [next(a), next(b)])
                    .collect();
            }
        }
        events.sort_by(|a, b| a.phi.total_cmp(&b.phi));
        let mut merged: Vec<Event> = Vec::new();
        for event in events {
            match merged.last_mut() {
                Some(last) if event.phi - last.phi < SAME => last.pairs.extend(event.pairs),
                _ => merged.push(event),
            }
        }
        for event in merged {
            let mut heights = event.heights.unwrap_or_else(|| self.heights_at(event.phi));
            for [a, b] in event.pairs {
                heights[b] = heights[a];
            }
            self.lines.push(event.phi);
            self.heights.push(heights);
        }
    }

    /// Adds lines until every edge is straight between two lines to within `limit`, mm.
    fn refine(&mut self, limit: f64) {
        let mut lines = Vec::new();
        let mut heights = Vec::new();
        for line in 0..self.lines.len() {
            let end = self.lines.get(line + 1).copied().unwrap_or(TAU);
            let mut open = vec![(
                self.lines[line],
                end,
                self.heights(line),
                self.heights(line + 1),
                0,
            )];
            while let Some((from, to, low, high, depth)) = open.pop() {
                let angle = 0.5 * (from + to);
                let middle = self.heights_at(angle);
                let bent = |k: usize| (middle[k] - 0.5 * (low[k] + high[k])).abs() > limit;
                if depth < DEEPEST && (0..middle.len()).any(bent) {
                    open.push((angle, to, middle.clone(), high, depth + 1));
                    open.push((from, angle, low, middle, depth + 1));
                } else {
                    lines.push(from);
                    heights.push(low);
                }
            }
        }
        (self.lines, self.heights) = (lines, heights);
    }

    /// Number of rows of faces with which the twisted walls are within `limit` (mm) of their triangles. Between lines an angle
    /// `h` apart, with rows `d` high and a height that grows by `s` with the angle, the middle of a diagonal is off by `h d s /
    /// (4 sqrt(r^2 + s^2))`.
    fn wall_rows(&self, limit: f64) -> u32 {
        let radius = self.groove.radius();
        let slope = radius * self.groove.steepest().value.tan();
        let foot = self.levels[0].radius;
        let ends = self.lines.iter().copied().chain([TAU]);
        let widest = ends
            .clone()
            .zip(ends.skip(1))
            .map(|(from, to)| to - from)
            .fold(0.0, f64::max);
        let twist = 0.25 * widest * (radius - foot) * slope / foot.hypot(slope);
        (twist / limit).ceil().clamp(1.0, 1e3) as u32
    }

    /// Crest on a line between two turns of the groove that are open together at the level `above`, but not at the next deeper
    /// level, `above + 1`. `low` is a left edge, `high` a right one, both of the deeper level. Height and radius; `None` if the
    /// turns do not meet.
    pub(super) fn ridge(&self, [low, high]: [usize; 2], line: usize) -> Option<(f64, f64)> {
        // The line after the last is the first, a turn later.
        let (phi, low, high) = match self.lines.get(line) {
            Some(&phi) => (phi, low, high),
            None => (self.lines[0], self.edge_after(low), self.edge_after(high)),
        };
        let [deep, above] = [self.edge(low).level, self.edge(low).level.checked_sub(1)?];
        let floor = self.groove.radius() - self.groove.depth();
        let fillet = self.levels[0].radius - floor;
        let at = |angle: f64| Level::new(0.5 * self.groove.width(), floor, fillet, angle);
        let apart = |angle: f64| {
            let half = at(angle).half;
            self.found(low, half, phi, None).0 - self.found(high, half, phi, None).0
        };
        let [from, to] = [above, deep].map(|level| self.fillet_angle(level));
        let (start, end) = (apart(from), apart(to));
        if start <= 0.0 || end >= 0.0 {
            return None;
        }
        let level = at(bracketed_root(apart, from, to, start, end));
        Some((self.found(low, level.half, phi, None).0, level.radius))
    }

    /// Angle down the fillet at which a level lies: 0 at the foot of the wall, a quarter turn at the floor.
    fn fillet_angle(&self, level: usize) -> f64 {
        FRAC_PI_2 * level as f64 / (self.levels.len() - 1) as f64
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

    /// Lower and upper edges of the groove at a level, upwards: turns that overlap are open together. `height` gives
    /// the height of an edge.
    pub(super) fn open(&self, level: usize, height: impl Fn(usize) -> f64) -> Vec<[usize; 2]> {
        let row = 2 * self.turns;
        // Left and right wall of a turn are adjacent in the numbering.
        let mut turns: Vec<[usize; 2]> = (level * row..(level + 1) * row)
            .step_by(2)
            .map(|left| [left + 1, left])
            .collect();
        turns.sort_by(|a, b| height(a[0]).total_cmp(&height(b[0])));
        let mut open: Vec<[usize; 2]> = Vec::new();
        for turn in turns {
            match open.last_mut() {
                Some(last) if height(turn[0]) <= height(last[1]) => {
                    if height(turn[1]) > height(last[1]) {
                        last[1] = turn[1];
                    }
                }
                _ => open.push(turn),
            }
        }
        open
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

    /// Heights of all edges at an angle round the shaft.
    pub(super) fn heights_at(&self, phi: f64) -> Vec<f64> {
        let row = 2 * self.turns;
        // The levels of one wall lie close to one another: the search for each starts from the one before.
        let mut feet = vec![None; row];
        let mut heights: Vec<f64> = Vec::with_capacity(self.edges());
        for edge in 0..self.edges() {
            let height = if let Some(rise) = self.rises[self.edge(edge).turn] {
                heights[edge - 2] + rise
            } else {
                let half = self.levels[self.edge(edge).level].half;
                let (height, theta) = self.found(edge, half, phi, feet[edge % row]);
                feet[edge % row] = Some(theta);
                height
            };
            heights.push(height);
        }
        heights
    }

    /// Height of an edge at an angle round the shaft.
    pub(super) fn height(&self, edge: usize, phi: f64) -> f64 {
        let half = self.levels[self.edge(edge).level].half;
        self.found(edge, half, phi, None).0
    }

    /// Height of an edge at an angle round the shaft for a groove `half` wide to each side, and the shaft angle of its point on
    /// the centre line. The search starts from `near`.
    fn found(&self, edge: usize, half: f64, phi: f64, near: Option<f64>) -> (f64, f64) {
        checkpoint();
        let Edge { turn, wall, .. } = self.edge(edge);
        let side = match wall {
            Wall::Left => half,
            Wall::Right => -half,
        };
        let (traverse, r) = (self.groove.traverse(), self.groove.radius());
        let target = phi + TAU * turn as f64;
        // The foot of the normal: R theta - side sin(lead angle) = R target.
        let mut theta = near.unwrap_or(target);
        let mut motion = traverse.at(theta);
        for _ in 0..30 {
            let length = r.hypot(motion.velocity);
            let off = r * (theta - target) - side * motion.velocity / length;
            let slope = r - side * motion.acceleration * r * r / (length * length * length);
            let step = off / slope;
            theta -= step;
            motion = traverse.at(theta);
            // The error is squared by every step: the next step would be below the last digit.
            if step.abs() <= 1e-8 {
                break;
            }
        }
        let height = motion.position + side * r / r.hypot(motion.velocity);
        (height, theta)
    }

    /// Pairs of edges of one level whose order differs between two lines.
    fn swapped(&self, before: &[f64], after: &[f64]) -> Vec<[usize; 2]> {
        let mut pairs = Vec::new();
        let row = 2 * self.turns;
        for level in 0..self.levels.len() {
            let mut order: Vec<usize> = (level * row..(level + 1) * row).collect();
            order.sort_by(|&a, &b| before[a].total_cmp(&before[b]));
            // Insertion sort by the later heights visits every swapped pair once.
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

    /// Angle at which two edges meet whose order differs between two angles.
    fn meeting(&self, [a, b]: [usize; 2], start: f64, end: f64) -> f64 {
        let apart = |phi: f64| self.height(a, phi) - self.height(b, phi);
        let (low, high) = (apart(start), apart(end));
        if low * high > 0.0 {
            return if low.abs() < high.abs() { start } else { end };
        }
        bracketed_root(apart, start, end, low, high)
    }
}
