use std::collections::BTreeMap;

use std::f64::consts::TAU;

use centrode_geometry::{Mesh, Point, checkpoint};

use super::plan::Plan;
use crate::Wall;

/// Mark of a vertex on the shaft's surface, instead of a level of the groove.
const LAND: usize = usize::MAX;
/// Mark of a vertex on the crest between two grooves' fillets; from here on, of rows of the walls.
const RIDGE: usize = usize::MAX / 4;
const WALL: usize = usize::MAX / 2;

/// Integer key of a height; keys have the order of the heights.
fn key(z: f64) -> u64 {
    let bits = (z + 0.0).to_bits();
    if bits >> 63 == 0 {
        bits | 1 << 63
    } else {
        !bits
    }
}

/// Height of a key.
fn height(key: u64) -> f64 {
    if key >> 63 == 1 {
        f64::from_bits(key ^ 1 << 63)
    } else {
        f64::from_bits(!key)
    }
}

/// Part of the surface between two lines and two edges.
#[derive(Debug)]
struct Cell {
    /// First of its two lines.
    line: usize,
    low: Rim,
    high: Rim,
}

/// An edge of a cell: on both lines its height, and the level seen from the cell.
#[derive(Clone, Copy, Debug)]
struct Rim {
    heights: [f64; 2],
    levels: [usize; 2],
}

impl Rim {
    fn new(heights: [f64; 2], level: usize) -> Self {
        Self {
            heights,
            levels: [level; 2],
        }
    }
}

/// The shaft's surface with the groove in it, between two heights: an open mesh.
#[derive(Debug)]
pub(super) struct Surface<'a> {
    plan: &'a Plan<'a>,
    radius: f64,
    ends: [f64; 2],
    vertices: Vec<[f64; 3]>,
    faces: Vec<[u32; 3]>,
    /// Vertices on each line, by height and level.
    on_line: Vec<BTreeMap<(u64, usize), u32>>,
    /// Sine and cosine of each line's angle.
    ways: Vec<(f64, f64)>,
    cells: Vec<Cell>,
    /// Edges of the walls' tops: edge of the plan, line, heights there and on the next line.
    tops: Vec<(usize, usize, [f64; 2])>,
}

impl<'a> Surface<'a> {
    pub(super) fn new(plan: &'a Plan<'a>, radius: f64, ends: [f64; 2]) -> Self {
        Self {
            plan,
            radius,
            ends,
            vertices: Vec::new(),
            faces: Vec::new(),
            on_line: vec![BTreeMap::new(); plan.lines.len()],
            ways: plan.lines.iter().map(|phi| phi.sin_cos()).collect(),
            cells: Vec::new(),
            tops: Vec::new(),
        }
    }

    /// Finds the cells and walls, and covers them with triangles.
    pub(super) fn fill(&mut self) {
        self.find();
        let count = self.plan.lines.len();
        for cell in std::mem::take(&mut self.cells) {
            checkpoint();
            let left = self.chain(cell.line, 0, &cell);
            let right = self.chain((cell.line + 1) % count, 1, &cell);
            self.zip(&left, &right);
        }
    }

    /// Finds the cells and walls.
    pub(super) fn find(&mut self) {
        let count = self.plan.lines.len();
        let mut here = self.plan.heights(0);
        for line in 0..count {
            checkpoint();
            let next = self.plan.heights(line + 1);
            self.strip(line, &here, &next);
            here = next;
        }
    }

    /// Adds the cells between a line and the next, and the walls between them.
    fn strip(&mut self, line: usize, here: &[f64], next: &[f64]) {
        let middle = |edge: usize| here[edge] + next[edge];
        let levels = 0..self.plan.levels.len();
        let mut visible: Vec<usize> = levels
            .flat_map(|level| self.plan.open(level, middle))
            .flatten()
            .collect();
        visible.sort_by(|&a, &b| {
            let by_height = middle(a).total_cmp(&middle(b));
            by_height.then(self.plan.edge(a).level.cmp(&self.plan.edge(b).level))
        });
        let mut low = Rim::new([self.ends[0]; 2], LAND);
        let mut before = None;
        for &edge in &visible {
            let heights = [here[edge], next[edge]];
            let (level, wall) = (self.plan.edge(edge).level, self.plan.edge(edge).wall);
            let outside = if level == 0 { LAND } else { level };
            // Upwards, a right wall leads into the groove, a left one out of it.
            let (below, above) = match wall {
                Wall::Right => (outside, level),
                Wall::Left => (level, outside),
            };
            let high = Rim::new(heights, below);
            // From a left edge to a right one, without land between them.
            let crest = before
                .filter(|_| wall == Wall::Right && below != LAND && low.levels[0] == below)
                .and_then(|before| self.crest(line, [before, edge], [here, next]));
            if let Some(crest) = crest {
                self.cell(Cell {
                    line,
                    low,
                    high: crest,
                });
                low = crest;
            }
            self.cell(Cell { line, low, high });
            low = Rim::new(heights, above);
            before = Some(edge);
            if level == 0 {
                self.upright(line, heights, wall);
                self.tops.push((edge, line, heights));
            }
        }
        self.cell(Cell {
            line,
            low,
            high: Rim::new([self.ends[1]; 2], LAND),
        });
    }

    /// The crest between the fillets of two grooves that are open together one level up: between a left edge and
    /// the right edge above it.
    fn crest(&mut self, line: usize, pair: [usize; 2], heights: [&[f64]; 2]) -> Option<Rim> {
        let level = self.plan.edge(pair[0]).level;
        let above = pair.map(|edge| edge - 2 * self.plan.turns);
        let mut crest = Rim::new([0.0; 2], level);
        let mut found = false;
        for (side, heights) in heights.into_iter().enumerate() {
            let [[low, high], [met, other]] = [pair, above].map(|p| p.map(|edge| heights[edge]));
            // Where the edges of a level meet, the crest ends on them.
            (crest.heights[side], crest.levels[side]) = if low == high {
                (low, level)
            } else if met == other {
                (met, level - 1)
            } else if let Some((z, radius)) = self.plan.ridge(pair, line + side)
                && low < z
                && z < high
            {
                self.vertex_at((line + side) % self.plan.lines.len(), z, RIDGE, radius);
                (z, RIDGE)
            } else {
                (low, level)
            };
            found |= crest.levels[side] != level;
        }
        found.then_some(crest)
    }

    fn cell(&mut self, cell: Cell) {
        let count = self.plan.lines.len();
        for rim in [&cell.low, &cell.high] {
            for side in 0..2 {
                if rim.levels[side] != RIDGE {
                    self.vertex(
                        (cell.line + side) % count,
                        rim.heights[side],
                        rim.levels[side],
                    );
                }
            }
        }
        self.cells.push(cell);
    }

    /// Adds the radial wall along an edge between a line and the next.
    fn upright(&mut self, line: usize, heights: [f64; 2], wall: Wall) {
        let next = (line + 1) % self.plan.lines.len();
        let rows = self.plan.rows as usize;
        let level = |row: usize| match row {
            0 => 0,
            row if row == rows => LAND,
            row => WALL + row,
        };
        for row in 0..rows {
            let [below, above] = [row, row + 1].map(level);
            let corners = [
                self.vertex(line, heights[0], below),
                self.vertex(line, heights[0], above),
                self.vertex(next, heights[1], above),
                self.vertex(next, heights[1], below),
            ];
            let [a, b, c, d] = corners;
            match wall {
                Wall::Right => self.faces.extend([[a, b, c], [a, c, d]]),
                Wall::Left => self.faces.extend([[a, c, b], [a, d, c]]),
            }
        }
    }

    fn vertex(&mut self, line: usize, z: f64, level: usize) -> u32 {
        let foot = self.plan.levels[0].radius;
        let radius = match level {
            LAND => self.radius,
            row if row > WALL => {
                let share = (row - WALL) as f64 / f64::from(self.plan.rows);
                foot + (self.radius - foot) * share
            }
            level => self.plan.levels[level].radius,
        };
        self.vertex_at(line, z, level, radius)
    }

    fn vertex_at(&mut self, line: usize, z: f64, level: usize, radius: f64) -> u32 {
        let (vertices, (sin, cos)) = (&mut self.vertices, self.ways[line]);
        *self.on_line[line]
            .entry((key(z), level))
            .or_insert_with(|| {
                vertices.push([radius * cos, radius * sin, z]);
                (vertices.len() - 1) as u32
            })
    }

    /// Vertices along one side of a cell, upwards: its corners, and the vertices of neighbouring cells between them.
    fn chain(&self, line: usize, side: usize, cell: &Cell) -> Vec<(f64, u32)> {
        let [low, high] = [&cell.low, &cell.high].map(|rim| key(rim.heights[side]));
        let on_line = &self.on_line[line];
        let of = |z: u64, level: usize| {
            let vertex = on_line[&(z, level)];
            (self.vertices[vertex as usize][2], vertex)
        };
        let mut chain = vec![of(low, cell.low.levels[side])];
        if low < high {
            let land = cell.low.levels == [LAND; 2] && cell.high.levels == [LAND; 2];
            for (&(z, level), &vertex) in on_line.range((low + 1, 0)..(high, 0)) {
                let walls_own = level > WALL && level != LAND;
                if (level == LAND) == land && !walls_own {
                    chain.push((height(z), vertex));
                }
            }
        }
        chain.push(of(high, cell.high.levels[side]));
        chain.dedup_by_key(|(_, vertex)| *vertex);
        chain
    }

    /// Triangles between two chains that run upwards, the second on the right seen from outside.
    fn zip(&mut self, left: &[(f64, u32)], right: &[(f64, u32)]) {
        let (mut i, mut j) = (0, 0);
        while i + 1 < left.len() || j + 1 < right.len() {
            let up_left = j + 1 >= right.len()
                || (i + 1 < left.len() && left[i + 1].0 + left[i].0 <= right[j + 1].0 + right[j].0);
            let face = if up_left {
                i += 1;
                [left[i - 1].1, right[j].1, left[i].1]
            } else {
                j += 1;
                [left[i].1, right[j - 1].1, right[j].1]
            };
            let [a, b, c] = face;
            if a != b && b != c && c != a {
                self.faces.push(face);
            }
        }
    }

    /// The walls' upper edges between a line and the next, upwards: edge of the plan, heights on both lines.
    pub(super) fn tops_by_line(&self) -> Vec<Vec<(usize, [f64; 2])>> {
        let mut lines = vec![Vec::new(); self.plan.lines.len()];
        for &(edge, line, heights) in &self.tops {
            lines[line].push((edge, heights));
        }
        lines
    }

    /// Heights of the vertices on a line, on the shaft's surface or in the groove, ascending.
    pub(super) fn heights_on(&self, line: usize, land: bool) -> Vec<f64> {
        let on_line = self.on_line[line].keys();
        let mut keys: Vec<u64> = on_line
            .filter(|&&(_, level)| (level == LAND) == land)
            .map(|&(key, _)| key)
            .collect();
        keys.dedup();
        keys.into_iter().map(height).collect()
    }

    /// Tops of the walls on the development, each as far as it remains within one turn.
    pub(super) fn wall_edges(mut self) -> Vec<Vec<Point>> {
        let angle = |line: usize| self.plan.lines.get(line).copied().unwrap_or(TAU);
        let at = |line: usize, z: f64| Point::new(self.radius * angle(line), z);
        self.tops.sort_by_key(|&(edge, line, _)| (edge, line));
        let mut edges: Vec<Vec<Point>> = Vec::new();
        let mut last = None;
        for &(edge, line, [here, next]) in &self.tops {
            match edges.last_mut() {
                Some(points) if last == Some((edge, line)) => points.push(at(line + 1, next)),
                _ => edges.push(vec![at(line, here), at(line + 1, next)]),
            }
            last = Some((edge, line + 1));
        }
        edges
    }

    /// The mesh, and the vertices along its lower and its upper rim, counter-clockwise seen from above.
    pub(super) fn finish(self) -> (Mesh, Vec<u32>, Vec<u32>) {
        let rim = |z: f64| -> Vec<u32> {
            let lines = 0..self.plan.lines.len();
            lines.map(|l| self.on_line[l][&(key(z), LAND)]).collect()
        };
        let (lower, upper) = (rim(self.ends[0]), rim(self.ends[1]));
        let mesh = Mesh {
            vertices: self.vertices,
            faces: self.faces,
        };
        (mesh, lower, upper)
    }
}
