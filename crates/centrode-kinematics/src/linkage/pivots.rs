use std::f64::consts::{PI, TAU};

use centrode_geometry::Point;

use super::four_bar::FourBar;
use super::six_bar::SixBar;
use super::slider_arc::SliderArc;

/// Number of points at which a curve is measured, per pivot that is returned, and the minimum total.
const MEASURED: (usize, usize) = (4, 256);
/// Maximum ratio of the longest step to the mean step at which steps count as even.
const EVEN: f64 = 1.002;
/// Maximum number of passes that space these points evenly. A dozen are needed near half a turn, where a ray hardly turns along
/// most of the curve.
const PASSES: usize = 60;

impl SixBar {
    /// Positions of the effector's pivot, `count` of them, that all give this swing (rad), in order along a curve and evenly
    /// spaced along its length. The list is empty for a swing that is not between 0 and 2 pi, or if the four-bar is not a
    /// crank-rocker.
    ///
    /// The slider runs on an arc about D, and the swing is the angle that this arc subtends at the pivot. It is half a turn only
    /// on the chord between the dead centres. Between chord and arc it is larger, elsewhere smaller. Every other swing belongs to
    /// an isoptic of the arc. Its points are found along rays from the chord's middle, on which the swing only rises towards the
    /// arc and only falls elsewhere. No pivot sees more than half a turn and half the rocker's swing. Each point gives the swing
    /// to the float limit; the spaces between the points are equal to about 1 %.
    #[must_use]
    pub fn pivots(four_bar: &FourBar, swing: f64, count: usize) -> Vec<Point> {
        let Some(arc) = SliderArc::new(four_bar) else {
            return Vec::new();
        };
        if !(swing > 0.0 && swing < TAU) || count == 0 {
            return Vec::new();
        }
        let [from, to] = arc.ends();
        let chord = to - from;
        let middle = from + 0.5 * chord;
        let shares = (0..count).map(|i| (i as f64 + 0.5) / count as f64);
        if swing == PI {
            return shares.map(|share| from + chord * share).collect();
        }
        let across = arc.outwards(middle, chord);
        let place = |turn: f64| {
            let (sin, cos) = turn.sin_cos();
            arc.seen_at(middle, chord.normalize() * cos + across * sin, swing)
        };
        // Above half a turn the curve runs between chord and arc, from end to end of the chord; below, all round the chord.
        let whole = if swing > PI { PI } else { TAU };
        let knots = even_knots(whole, count, |turn| {
            if swing > PI && turn <= 0.0 {
                Some(to)
            } else if swing > PI && turn >= whole {
                Some(from)
            } else {
                place(turn)
            }
        });
        let turns = shares.filter_map(|share| along(&knots, share));
        turns.filter_map(place).collect()
    }
}

/// Parameters of a curve at equal shares of its length, each with its share.
fn even_knots(whole: f64, count: usize, place: impl Fn(f64) -> Option<Point>) -> Vec<(f64, f64)> {
    let steps = (MEASURED.0 * count).max(MEASURED.1);
    let mut knots: Vec<(f64, f64)> = Vec::new();
    for pass in 0..=PASSES {
        let even = (0..=steps).filter_map(|i| {
            let share = i as f64 / steps as f64;
            let turn = if pass == 0 {
                whole * share
            } else {
                along(&knots, share)?
            };
            Some((turn, place(turn)?))
        });
        let points: Vec<(f64, Point)> = even.collect();
        let (mut length, mut longest) = (0.0, 0.0_f64);
        let mut measured: Vec<(f64, f64)> = points.iter().take(1).map(|p| (0.0, p.0)).collect();
        for pair in points.windows(2) {
            let step = (pair[1].1 - pair[0].1).norm();
            (length, longest) = (length + step, longest.max(step));
            measured.push((length, pair[1].0));
        }
        let even = longest * (points.len().saturating_sub(1)) as f64 <= EVEN * length;
        knots = measured
            .into_iter()
            .map(|(reached, turn)| (reached / length, turn))
            .collect();
        if even {
            break;
        }
    }
    knots
}

/// Parameter at a share of the length.
fn along(knots: &[(f64, f64)], share: f64) -> Option<f64> {
    let after = knots.partition_point(|knot| knot.0 < share).max(1);
    let (before, after) = (knots.get(after - 1)?, knots.get(after)?);
    let step = after.0 - before.0;
    let within = if step > 0.0 {
        (share - before.0) / step
    } else {
        0.0
    };
    Some(before.1 + within * (after.1 - before.1))
}
