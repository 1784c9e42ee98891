//! Removal of loops from closed chains of curves.

use crate::{
    Bounds, Segment, Tolerance,
    crossings::{Unresolved, crossings, self_crossings},
};

/// Greatest number of passes; each may find loops which the one before laid bare.
const MOST_PASSES: u32 = 16;

/// Error of a closed chain that has no contour.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum LoopError {
    /// Every place of the chain lies in a loop.
    #[error("every part of its contour lies in a loop")]
    Everywhere,
    /// Two segments, or one and itself, whose crossings cannot be determined.
    #[error("where segments {} and {} of its contour cross cannot be told: {cause}", .segments[0], .segments[1])]
    Unresolved {
        /// The segments, counted from 0.
        segments: [usize; 2],
        /// Cause.
        cause: Unresolved,
    },
    /// Loops that remain after the greatest number of passes.
    #[error("its contour still crosses itself at segments {} and {} after its loops were cut off {MOST_PASSES} times", .segments[0], .segments[1])]
    Endless {
        /// Two segments that cross, counted from 0.
        segments: [usize; 2],
    },
}

/// A part of a segment that is left after the loops of its chain are cut off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kept {
    /// Index of the segment.
    pub index: usize,
    /// Parameter of its new start.
    pub from: f64,
    /// Parameter of its new end.
    pub to: f64,
}

impl Kept {
    fn whole(index: usize) -> Self {
        Self {
            index,
            from: -1.0,
            to: 1.0,
        }
    }

    fn is_whole(&self) -> bool {
        (self.from, self.to) == (-1.0, 1.0)
    }

    /// The part of `self` that a second cut keeps.
    fn cut(&self, again: &Self) -> Self {
        let at = |u: f64| self.from + 0.5 * (1.0 + u) * (self.to - self.from);
        Self {
            index: self.index,
            from: if again.from == -1.0 {
                self.from
            } else {
                at(again.from)
            },
            to: if again.to == 1.0 {
                self.to
            } else {
                at(again.to)
            },
        }
    }
}

/// Loop of a chain: segment and parameter where it opens, and where it closes; closing segments are counted on beyond
/// the last.
type Loop = (usize, f64, usize, f64);

/// Cuts the loops off a closed chain of segments: where the chain crosses itself the part between the two passes is
/// dropped, and so are loops laid bare by that.
///
/// `near(i, j)` says whether segment `j`, after `i`, may take part in a loop with it: longer detours
/// are left alone. The chain is cut open at a place no loop covers.
///
/// # Errors
/// [`LoopError`] where every place of the chain lies in a loop, or where its crossings with itself cannot be
/// determined.
pub fn without_loops(
    segments: &[Segment],
    near: impl Fn(usize, usize) -> bool,
    tolerance: Tolerance,
) -> Result<Vec<Kept>, LoopError> {
    let mut left: Vec<Kept> = (0..segments.len()).map(Kept::whole).collect();
    let mut last = [0, 0];
    for _ in 0..MOST_PASSES {
        let found = loops(segments, &left, &near, tolerance)?;
        let Some(first) = found.first() else {
            return Ok(left);
        };
        last = [first.0, first.2].map(|i| left[i % left.len()].index);
        let kept = cut(found, left.len()).ok_or(LoopError::Everywhere)?;
        if kept.len() == left.len() && kept.iter().all(Kept::is_whole) {
            return Ok(left);
        }
        left = kept.iter().map(|k| left[k.index].cut(k)).collect();
    }
    Err(LoopError::Endless { segments: last })
}

/// Every loop of a chain of parts of segments.
fn loops(
    segments: &[Segment],
    left: &[Kept],
    near: impl Fn(usize, usize) -> bool,
    tolerance: Tolerance,
) -> Result<Vec<Loop>, LoopError> {
    let count = left.len();
    let unresolved = |i: usize, j: usize| {
        let segments = [left[i].index, left[j].index];
        move |cause| LoopError::Unresolved { segments, cause }
    };
    let chain: Vec<Segment> = left
        .iter()
        .map(|k| segments[k.index].part(k.from, k.to))
        .collect();
    let boxes: Vec<Bounds> = chain.iter().map(|s| s.enclosure(-1.0, 1.0)).collect();
    let mut found = Vec::new();
    for i in 0..count {
        for (u, v) in self_crossings(&chain[i], tolerance).map_err(unresolved(i, i))? {
            found.push((i, u.min(v), i, u.max(v)));
        }
        for step in 1..=count / 2 {
            let j = (i + step) % count;
            if !near(left[i].index, left[j].index) {
                break;
            }
            if step > 1 && !boxes[i].meets(&boxes[j]) {
                continue;
            }
            let crossings = crossings(&chain[i], &chain[j], step == 1, tolerance);
            for (u, v) in crossings.map_err(unresolved(i, j))? {
                found.push((i, u, i + step, v));
            }
        }
    }
    Ok(found)
}

/// Parts of a chain of `count` segments without its loops; `None` where they cover every segment.
fn cut(mut found: Vec<Loop>, count: usize) -> Option<Vec<Kept>> {
    // Start at a segment no loop reaches into.
    let mut covered = vec![false; count];
    for &(i, _, j, _) in &found {
        for k in i..=j {
            covered[k % count] = true;
        }
    }
    let origin = covered.iter().position(|c| !c)?;
    for loop_ in &mut found {
        let shift = (loop_.0 + count - origin) % count;
        loop_.2 = shift + (loop_.2 - loop_.0);
        loop_.0 = shift;
    }
    found.sort_by(|x, y| {
        (x.0, x.1)
            .partial_cmp(&(y.0, y.1))
            .unwrap_or(std::cmp::Ordering::Equal)
    });
    let mut kept = Vec::with_capacity(count);
    let (mut index, mut from) = (0, -1.0);
    let mut next = found.iter().peekable();
    while index < count {
        // The next loop that opens at or after the present place.
        while next.peek().is_some_and(|l| (l.0, l.1) < (index, from)) {
            next.next();
        }
        let segment = (index + origin) % count;
        match next.peek() {
            Some(l) if l.0 == index => {
                if l.1 > from {
                    kept.push(Kept {
                        index: segment,
                        from,
                        to: l.1,
                    });
                }
                // Of the loops opening here the longest is dropped whole.
                (index, from) = (l.2, l.3);
            }
            _ => {
                if from < 1.0 {
                    kept.push(Kept {
                        index: segment,
                        from,
                        to: 1.0,
                    });
                }
                (index, from) = (index + 1, -1.0);
            }
        }
    }
    // Back to the order of the input.
    let turn = kept.iter().position(|k| k.index < origin).unwrap_or(0);
    kept.rotate_left(turn);
    Some(kept)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Point;

    fn fine() -> Tolerance {
        Tolerance::new(1e-13).expect("positive")
    }

    #[test]
    fn a_chain_without_crossings_is_kept_whole() {
        let square =
            [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| Point::new(x, y));
        let chain: Vec<Segment> = (0..4)
            .map(|i| Segment::Line(square[i], square[(i + 1) % 4]))
            .collect();
        let kept = without_loops(
            &chain,
            |i, j| (j + chain.len() - i) % chain.len() <= 3,
            fine(),
        )
        .expect("sound");
        assert_eq!(kept.len(), 4);
    }

    #[test]
    fn a_bow_in_a_chain_is_cut_off() {
        let corners = [
            (0.0, 0.0),
            (4.0, 0.0),
            (3.0, -1.0),
            (3.0, 1.0),
            (5.0, 1.0),
            (5.0, 4.0),
            (0.0, 4.0),
        ];
        let points = corners.map(|(x, y)| Point::new(x, y));
        let chain: Vec<Segment> = (0..7)
            .map(|i| Segment::Line(points[i], points[(i + 1) % 7]))
            .collect();
        let kept = without_loops(
            &chain,
            |i, j| (j + chain.len() - i) % chain.len() <= 3,
            fine(),
        )
        .expect("sound");
        let at = |k: &Kept| {
            (
                chain[k.index].at(k.from).point,
                chain[k.index].at(k.to).point,
            )
        };
        assert_eq!(kept.len(), 6);
        for pair in kept.windows(2) {
            assert!((at(&pair[0]).1 - at(&pair[1]).0).norm() < 1e-12);
        }
        assert!((at(&kept[0]).1 - Point::new(3.0, 0.0)).norm() < 1e-12);
    }

    #[test]
    fn a_chain_that_is_not_a_number_is_an_error_that_names_the_segment() {
        let p = Point::new;
        let corners = [p(0.0, 0.0), p(4.0, 0.0), p(f64::NAN, 4.0), p(0.0, 4.0)];
        let chain: Vec<Segment> = (0..4)
            .map(|i| Segment::Line(corners[i], corners[(i + 1) % 4]))
            .collect();
        let refused = without_loops(&chain, |_, _| true, fine());
        let named = LoopError::Unresolved {
            segments: [0, 1],
            cause: Unresolved::NotFinite,
        };
        assert_eq!(refused, Err(named));
    }

    #[test]
    fn a_chain_that_runs_back_on_itself_is_an_error_and_one_that_is_all_loop_too() {
        let p = Point::new;
        // There and back on the same arc, with a detour at either end.
        let there = crate::PolySegment::fit(|t| p(t.cos(), t.sin()), 0.0, 0.5, fine())[0];
        let (a, b) = (there.start(), there.end());
        let detour = |at: Point, y: f64| {
            let corners = [at, p(0.0, y), p(3.0, y), at];
            [0, 1, 2].map(|i| Segment::Line(corners[i], corners[i + 1]))
        };
        let mut chain = vec![Segment::Poly(there)];
        chain.extend(detour(b, 3.0));
        chain.push(Segment::Poly(there.reversed()));
        chain.extend(detour(a, -3.0));
        let refused = without_loops(&chain, |_, _| true, fine());
        assert!(
            matches!(
                refused,
                Err(LoopError::Unresolved {
                    segments: [0, 4],
                    cause: Unresolved::Overlap { .. }
                })
            ),
            "{refused:?}"
        );
        let eight = [p(0.0, 0.0), p(4.0, 4.0), p(4.0, 0.0), p(0.0, 4.0)];
        let chain: Vec<Segment> = (0..4)
            .map(|i| Segment::Line(eight[i], eight[(i + 1) % 4]))
            .collect();
        assert_eq!(
            without_loops(&chain, |_, _| true, fine()).map(|kept| kept.len()),
            Err(LoopError::Everywhere)
        );
    }
}
