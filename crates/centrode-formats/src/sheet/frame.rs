use super::{Draft, Pen, title_block};
use crate::drawing::{Anchor, EntityShape};
use centrode_geometry::{Bounds, Point, Vector};
use centrode_spec::SheetSize;

/// Width of the filing edge on the left, mm.
const FILING_EDGE: f64 = 20.0;
/// Width of the other borders, mm.
const BORDER: f64 = 10.0;
/// Width of the grid reference border, mm.
const GRID: f64 = 5.0;
/// Length of a field of the grid, mm.
const FIELD: f64 = 50.0;

/// The drawing space of a sheet, ISO 5457.
pub(super) fn space(size: SheetSize) -> Bounds {
    let [width, height] = size.size();
    Bounds {
        min: Point::new(FILING_EDGE, BORDER),
        max: Point::new(width - BORDER, height - BORDER),
    }
}

/// Trimming marks, grid reference border, centring marks and frame, ISO 5457.
pub(super) fn draw(size: SheetSize) -> Draft {
    let [width, height] = size.size();
    let mut draft = Draft::default();
    trimming_marks(&mut draft, width, height);
    let inner = space(size);
    let margin = Vector::repeat(GRID);
    let outer = Bounds {
        min: inner.min - margin,
        max: inner.max + margin,
    };
    draft.rectangle(Pen::Frame, inner);
    draft.rectangle(Pen::Rule, outer);
    let p = Point::new;
    // A4 has its letters and numbers at the top and on the right only.
    let upright = size == SheetSize::A4;
    for (name, from, to) in fields(0.5 * width, inner.min.x, inner.max.x, |i| {
        (i + 1).to_string()
    }) {
        let edges = [(outer.max.y, inner.max.y), (outer.min.y, inner.min.y)];
        for &(a, b) in &edges[..if upright { 1 } else { 2 }] {
            if to < inner.max.x {
                draft.line(Pen::Rule, p(to, a), p(to, b));
            }
            let middle = p(0.5 * (from + to), 0.5 * (a + b) - 1.25);
            draft.text(middle, 2.5, &name, Anchor::Middle);
        }
    }
    for (name, from, to) in fields(0.5 * height, inner.min.y, inner.max.y, |_| String::new())
        .into_iter()
        .rev()
        .zip(LETTERS.chars())
        .map(|((_, from, to), letter)| (letter.to_string(), from, to))
    {
        let edges = [(outer.max.x, inner.max.x), (outer.min.x, inner.min.x)];
        for &(a, b) in &edges[..if upright { 1 } else { 2 }] {
            if to < inner.max.y {
                draft.line(Pen::Rule, p(a, to), p(b, to));
            }
            let middle = p(0.5 * (a + b), 0.5 * (from + to) - 1.25);
            draft.text(middle, 2.5, &name, Anchor::Middle);
        }
    }
    let (x, y) = (0.5 * width, 0.5 * height);
    draft.line(Pen::Frame, p(x, outer.max.y), p(x, inner.max.y - GRID));
    draft.line(Pen::Frame, p(outer.min.x, y), p(inner.min.x + GRID, y));
    draft.line(Pen::Frame, p(outer.max.x, y), p(inner.max.x - GRID, y));
    // The lower mark extends into the drawing space only where the title block leaves room.
    let block = inner.max.x - title_block::WIDTH;
    let up = if x > block { 0.0 } else { GRID };
    draft.line(Pen::Frame, p(x, outer.min.y), p(x, inner.min.y + up));
    draft
}

/// Letters of the grid, from the top; I and O would be read as figures.
const LETTERS: &str = "ABCDEFGHJKLMNPQRSTUVWXYZ";

/// Fields of 50 mm on both sides of the middle; the outermost fields take the rest.
fn fields(
    middle: f64,
    low: f64,
    high: f64,
    name: impl Fn(usize) -> String,
) -> Vec<(String, f64, f64)> {
    let side = ((middle - BORDER) / FIELD).round() as i32;
    let mut ends = vec![low];
    ends.extend((1 - side..side).map(|k| middle + FIELD * f64::from(k)));
    ends.push(high);
    let fields = ends.windows(2).enumerate();
    fields
        .map(|(i, pair)| (name(i), pair[0], pair[1]))
        .collect()
}

/// An angle of two filled bars, 10 x 5 mm, in each corner of the trimmed sheet.
fn trimming_marks(draft: &mut Draft, width: f64, height: f64) {
    for (x, sx) in [(0.0, 1.0), (width, -1.0)] {
        for (y, sy) in [(0.0, 1.0), (height, -1.0)] {
            let p = |u: f64, v: f64| Point::new(x + sx * u, y + sy * v);
            for (u, v) in [(10.0, 5.0), (5.0, 10.0)] {
                let halves = [
                    [p(0.0, 0.0), p(u, 0.0), p(u, v)],
                    [p(0.0, 0.0), p(u, v), p(0.0, v)],
                ];
                for half in halves {
                    draft.draw(Pen::Frame, EntityShape::Triangle(half));
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_grid_has_the_fields_of_the_standard() {
        let counts = [(4, 6), (8, 6), (12, 8), (16, 12), (24, 16)];
        for (size, (across, up)) in SheetSize::ALL.into_iter().zip(counts) {
            let [width, height] = size.size();
            let Bounds { min, max } = space(size);
            let none = |_| String::new();
            assert_eq!(fields(0.5 * width, min.x, max.x, none).len(), across);
            assert_eq!(fields(0.5 * height, min.y, max.y, none).len(), up);
        }
    }
}
