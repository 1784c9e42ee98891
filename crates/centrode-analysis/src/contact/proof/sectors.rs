//! Equal parts of a cycle: a proof of one part is a proof of all.

use std::f64::consts::TAU;

use centrode_kinematics::machine::Piecewise;
use centrode_kinematics::transmission::Transmission;
use nalgebra::Complex;

use super::prover::HALF_WIDTH;

/// Maximum distance of a contour from its copy one part of the cycle later, as a share of the half width times the
/// centre distance. A larger share would use up the proven interval, a smaller one misses the repetition by rounding.
const ALLOWED: f64 = 0.1;

/// Difference up to which angles of the law count as equal, rad: above rounding, far below [`HALF_WIDTH`].
const SAME_ANGLE: f64 = 1e-12;

/// Coefficients of a contour's pieces.
type ContourPieces = [Vec<[f64; 2]>];

/// Maximum number of equal parts of the cycle after each of which both contours and the law repeat.
pub(super) fn sectors(
    contours: [&ContourPieces; 2],
    law: &Piecewise,
    turns: (u32, u32),
    center_distance: f64,
) -> u32 {
    let turns = [turns.0, turns.1];
    let [first, second] = [0, 1].map(|k| contours[k].len() * turns[k] as usize);
    let allowed = ALLOWED * HALF_WIDTH * center_distance;
    let repeats_by = |count: usize| {
        first % count == 0
            && second % count == 0
            && repeats(law, TAU * f64::from(turns[0]) / count as f64)
            && [0, 1].iter().all(|&k| {
                (1..count).all(|part| repeats_after(contours[k], turns[k], part, count, allowed))
            })
    };
    (2..=first.min(second))
        .rev()
        .find(|&count| repeats_by(count))
        .map_or(1, |count| count as u32)
}

/// Whether a contour coincides with itself after a rotation by `part` of `count` parts of its turns.
fn repeats_after(
    contour: &ContourPieces,
    turns: u32,
    part: usize,
    count: usize,
    allowed: f64,
) -> bool {
    let turned = part * turns as usize;
    let shift = contour.len() * turned / count;
    let turn = Complex::cis(TAU * turned as f64 / count as f64);
    contour.iter().enumerate().all(|(i, piece)| {
        let there = &contour[(i + shift) % contour.len()];
        let off = |(a, b): (&[f64; 2], &[f64; 2])| {
            (turn * Complex::new(a[0], a[1]) - Complex::new(b[0], b[1])).norm()
        };
        piece.len() == there.len() && piece.iter().zip(there).map(off).sum::<f64>() < allowed
    })
}

/// Whether the pieces of a law, apart from its mean slope, repeat after an angle, rad.
fn repeats(law: &Piecewise, angle: f64) -> bool {
    let ends = law.ends();
    let period = ends[ends.len() - 1];
    let slope = law.advance() / period;
    let rest = |phi: f64| law.at(phi).position - slope * phi;
    let is_straight = ends.len() == 2 && (0..16).all(|k| rest(f64::from(k)).abs() < SAME_ANGLE);
    let is_end = |phi: f64| {
        ends.iter()
            .any(|end| (end - phi % period).abs() < SAME_ANGLE)
    };
    is_straight
        || ends.iter().all(|end| is_end(end + angle))
            && ends.windows(2).all(|w| {
                (0..16).all(|k| {
                    let phi = w[0] + (w[1] - w[0]) * f64::from(k) / 16.0;
                    (rest(phi + angle) - rest(phi)).abs() < SAME_ANGLE
                })
            })
}
