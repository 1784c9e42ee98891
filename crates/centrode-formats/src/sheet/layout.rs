//! Placing of the pieces of a sheet.

use super::{Draft, table::Table};
use centrode_geometry::{Bounds, Point, Vector};

/// Minimum distance between pieces, mm.
const GAP: f64 = 6.0;
/// Minimum number of rows for which a part of a table is started.
const FEWEST: usize = 10;

/// Corner of the drawing space near which a piece is placed.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum Corner {
    /// Upper left.
    UpperLeft,
    /// Upper right.
    UpperRight,
    /// Lower left.
    LowerLeft,
    /// Lower right.
    LowerRight,
}

/// Page while pieces are placed on it; `free` has the largest empty rectangles, which may overlap.
#[derive(Clone, Debug)]
pub(crate) struct Page {
    room: Bounds,
    free: Vec<Bounds>,
    taken: Vec<Bounds>,
    pieces: Vec<(Draft, Bounds, bool)>,
}

impl Page {
    /// Page with this room, except a rectangle that is taken.
    pub(crate) fn new(room: Bounds, taken: Bounds) -> Self {
        let mut page = Self {
            room,
            free: vec![room],
            taken: Vec::new(),
            pieces: Vec::new(),
        };
        page.take(taken);
        page
    }

    /// Area of the rectangles around all pieces placed, mm².
    pub(crate) fn filled(&self) -> f64 {
        let areas = self.pieces.iter();
        areas
            .map(|(_, Bounds { min, max }, _)| (max - min).product())
            .sum()
    }

    /// Subtracts a rectangle from all empty ones.
    fn take(&mut self, taken: Bounds) {
        self.taken.push(taken);
        let margin = Vector::repeat(GAP);
        let (low, high) = (taken.min - margin, taken.max + margin);
        let mut free = Vec::new();
        for f in std::mem::take(&mut self.free) {
            let apart =
                low.x >= f.max.x || high.x <= f.min.x || low.y >= f.max.y || high.y <= f.min.y;
            if apart {
                free.push(f);
                continue;
            }
            let parts = [
                Bounds {
                    min: f.min,
                    max: Point::new(low.x, f.max.y),
                },
                Bounds {
                    min: Point::new(high.x, f.min.y),
                    max: f.max,
                },
                Bounds {
                    min: f.min,
                    max: Point::new(f.max.x, low.y),
                },
                Bounds {
                    min: Point::new(f.min.x, high.y),
                    max: f.max,
                },
            ];
            free.extend(parts.into_iter().filter(|p| {
                let size = p.max - p.min;
                size.x > 1.0 && size.y > 1.0
            }));
        }
        let within = |a: &Bounds, b: &Bounds| {
            a.min.x >= b.min.x && a.min.y >= b.min.y && a.max.x <= b.max.x && a.max.y <= b.max.y
        };
        let kept = free.iter().enumerate().filter(|(i, a)| {
            let others = free.iter().enumerate();
            !others
                .into_iter()
                .any(|(j, b)| *i != j && within(a, b) && (!within(b, a) || j < *i))
        });
        self.free = kept.map(|(_, f)| *f).collect();
    }

    /// The lower left corner for a rectangle of this size, as near to a corner of the page as possible.
    fn find(&self, size: Vector, corner: Corner) -> Option<Point> {
        let target = match corner {
            Corner::UpperLeft => Point::new(self.room.min.x, self.room.max.y),
            Corner::UpperRight => self.room.max,
            Corner::LowerLeft => self.room.min,
            Corner::LowerRight => Point::new(self.room.max.x, self.room.min.y),
        };
        let fits = |f: &&Bounds| {
            let room = f.max - f.min;
            size.x <= room.x + 1e-9 && size.y <= room.y + 1e-9
        };
        let at = |f: &Bounds| match corner {
            Corner::UpperLeft => Point::new(f.min.x, f.max.y - size.y),
            Corner::UpperRight => f.max - size,
            Corner::LowerLeft => f.min,
            Corner::LowerRight => Point::new(f.max.x - size.x, f.min.y),
        };
        let distance = |p: &Point| {
            let own = match corner {
                Corner::UpperLeft => Point::new(p.x, p.y + size.y),
                Corner::UpperRight => p + size,
                Corner::LowerLeft => *p,
                Corner::LowerRight => Point::new(p.x + size.x, p.y),
            };
            (own - target).norm()
        };
        let places = self.free.iter().filter(fits).map(at);
        places.min_by(|a, b| distance(a).total_cmp(&distance(b)))
    }

    /// Places a piece, if there is room. A piece that floats is later moved to the middle of its room.
    pub(crate) fn place(&mut self, draft: Draft, corner: Corner, floats: bool) -> bool {
        let bounds = draft.bounds();
        let size = bounds.max - bounds.min;
        let Some(at) = self.find(size, corner) else {
            return false;
        };
        let by = at - bounds.min;
        let mut moved = Draft::default();
        moved.add(&draft, by);
        let taken = Bounds {
            min: at,
            max: at + size,
        };
        self.take(taken);
        self.pieces.push((moved, taken, floats));
        true
    }

    /// Places rows of a table from row `first` on; returns their number, or `None` if no useful part fits.
    pub(crate) fn place_rows(&mut self, table: &Table, first: usize) -> Option<usize> {
        let left = table.rows.len() - first;
        let width = table.width();
        // The room that takes the most rows, the leftmost of equals.
        let fits = |f: &&Bounds| width <= f.max.x - f.min.x + 1e-9;
        let room = |f: &Bounds| f.max.y - f.min.y;
        let rows = |f: &Bounds| table.rows_in(room(f)).min(left);
        let holds = |f: &Bounds| table.height(left, true) <= room(f) + 1e-9;
        let best = self
            .free
            .iter()
            .filter(fits)
            .filter(|f| rows(f) >= FEWEST.min(left))
            .max_by(|a, b| {
                let more = holds(a).cmp(&holds(b)).then(rows(a).cmp(&rows(b)));
                more.then(b.min.x.total_cmp(&a.min.x))
            })
            .copied()?;
        let whole = holds(&best);
        // A table next to views is not split.
        if !whole && self.pieces.iter().any(|(_, _, floats)| *floats) {
            return None;
        }
        let rows = if whole {
            left
        } else {
            table.rows_in(room(&best)).min(left.saturating_sub(1))
        };
        if rows == 0 {
            return None;
        }
        let draft = table.draft(first..first + rows, first > 0, whole);
        let at = Point::new(best.min.x, best.max.y);
        let size = Vector::new(width, table.height(rows, whole));
        let mut moved = Draft::default();
        moved.add(&draft, at.coords);
        let taken = Bounds {
            min: Point::new(at.x, at.y - size.y),
            max: Point::new(at.x + size.x, at.y),
        };
        self.take(taken);
        self.pieces.push((moved, taken, false));
        Some(rows)
    }

    /// Everything placed, the floating pieces in the middle of their rooms.
    pub(crate) fn finish(mut self) -> Draft {
        for index in 0..self.pieces.len() {
            if !self.pieces[index].2 {
                continue;
            }
            for axis in [1, 0, 1, 0] {
                self.center(index, axis);
            }
        }
        let mut whole = Draft::default();
        for (draft, _, _) in &self.pieces {
            whole.add(draft, Vector::zeros());
        }
        whole
    }

    /// Moves a piece along an axis to the middle between its neighbours.
    fn center(&mut self, index: usize, axis: usize) {
        let own = self.pieces[index].1;
        let across = 1 - axis;
        let (mut low, mut high) = (self.room.min[axis], self.room.max[axis]);
        let first = std::iter::once(&self.taken[0]);
        let pieces = self.pieces.iter().enumerate();
        let others = pieces.filter(|(i, _)| *i != index).map(|(_, p)| &p.1);
        for other in first.chain(others) {
            let beside = other.min[across] < own.max[across] + GAP
                && own.min[across] < other.max[across] + GAP;
            if !beside {
                continue;
            }
            if other.max[axis] <= own.min[axis] {
                low = low.max(other.max[axis] + GAP);
            } else if other.min[axis] >= own.max[axis] {
                high = high.min(other.min[axis] - GAP);
            }
        }
        let mut by = Vector::zeros();
        by[axis] = 0.5 * (low + high) - 0.5 * (own.min[axis] + own.max[axis]);
        let mut moved = Draft::default();
        moved.add(&self.pieces[index].0, by);
        self.pieces[index].0 = moved;
        self.pieces[index].1 = Bounds {
            min: own.min + by,
            max: own.max + by,
        };
    }
}
