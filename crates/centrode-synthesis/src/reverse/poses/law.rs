use std::f64::consts::TAU;

use centrode_geometry::gauss_legendre;
use nalgebra::{DMatrix, DVector};

use super::{Circle, KeyPose};

/// Harmonics of the logarithm of the ratio.
const HARMONICS: usize = 12;
const TERMS: usize = 2 * HARMONICS + 1;
/// Number of parts in which the turns grow from those of even motion to the required ones.
const GROWTH: usize = 8;
/// Newton steps, and the error at which they end, rad.
const STEPS: usize = 30;
const CLOSED: f64 = 1e-13;
/// Minimum turn of a body between two poses, rad.
const MIN_TURN: f64 = 1e-3;
/// Maximum |ln| of a ratio: gears beyond it are not practical.
const UNEVEN: f64 = 3.0;

/// Turns of carrier and planet from pose to pose, both in the carrier's sense.
#[derive(Clone, Debug)]
pub(super) struct PoseLaw {
    sense: f64,
    /// Directions of carrier and arm in the first pose, rad.
    start: [f64; 2],
    turns: Vec<[f64; 2]>,
}

/// The law with the logarithm of its ratio as a sum of harmonics.
#[derive(Clone, Debug)]
pub(super) struct MildLaw {
    law: PoseLaw,
    amplitudes: [f64; TERMS],
}

/// One, then cosines and sines of the harmonics.
fn waves(psi: f64) -> [f64; TERMS] {
    let mut waves = [1.0; TERMS];
    for k in 1..=HARMONICS {
        let (sin, cos) = (k as f64 * psi).sin_cos();
        waves[2 * k - 1] = cos;
        waves[2 * k] = sin;
    }
    waves
}

/// Cost of a squared amplitude: its part in the squares of the logarithm and of the logarithm's second derivative.
fn cost(term: usize) -> f64 {
    let k = term.div_ceil(2) as f64;
    1.0 + k.powi(4)
}

impl PoseLaw {
    pub(super) fn through(poses: &[KeyPose], circle: &Circle, sense: f64) -> Self {
        let angles: Vec<[f64; 2]> = poses
            .iter()
            .map(|pose| [circle.direction(pose), pose.direction + circle.clamp()])
            .collect();
        let next = angles.iter().cycle().skip(1);
        let turns = angles.iter().zip(next).map(|(one, other)| {
            let carrier = sense * (other[0] - one[0]);
            let arm = sense * (other[1] - one[1]);
            // The planet turns like the arm relative to the carrier, in the opposite direction.
            [carrier.rem_euclid(TAU), (carrier - arm).rem_euclid(TAU)]
        });
        Self {
            sense,
            start: angles[0],
            turns: turns.collect(),
        }
    }

    /// Number of poses passed within one turn of both bodies.
    pub(super) fn passed(&self) -> usize {
        let mut sum = [0.0; 2];
        let within = self.turns.iter().take_while(|turn| {
            sum = [sum[0] + turn[0], sum[1] + turn[1]];
            let moves = turn.iter().all(|turn| *turn >= MIN_TURN);
            moves && sum.iter().all(|sum| *sum <= TAU + 1e-9)
        });
        within.count()
    }

    pub(super) fn is_in_order(&self) -> bool {
        self.passed() == self.turns.len()
    }

    /// The law of minimum mean square of ln(ratio) and of its second derivative; `None` if the steps do not converge.
    pub(super) fn mildest(&self) -> Option<MildLaw> {
        let count = self.turns.len();
        let mut amplitudes = [0.0; TERMS];
        for part in 1..=GROWTH {
            let share = part as f64 / GROWTH as f64;
            let mut is_met = false;
            for _ in 0..STEPS {
                let mut off = DVector::zeros(count);
                let mut slopes = DMatrix::zeros(count, TERMS);
                let mut from = 0.0;
                for (i, [carrier, planet]) in self.turns.iter().enumerate() {
                    let required = carrier + share * (planet - carrier);
                    let mut turn = 0.0;
                    visit(from, from + carrier, |psi, weight| {
                        let waves = waves(psi);
                        let ratio = weight * ratio(&amplitudes, &waves);
                        turn += ratio;
                        for (j, wave) in waves.into_iter().enumerate() {
                            slopes[(i, j)] += ratio * wave;
                        }
                    });
                    from += carrier;
                    off[i] = required - turn;
                }
                is_met = off.amax() < CLOSED * 100.0;
                // The smallest amplitudes that meet the linearised turns.
                let now = DVector::from_iterator(TERMS, amplitudes);
                let right = &off + &slopes * &now;
                let scaled = DMatrix::from_fn(TERMS, count, |j, i| slopes[(i, j)] / cost(j));
                let factors = (&slopes * &scaled).lu().solve(&right)?;
                let next = scaled * factors;
                let step = (&next - &now).amax();
                let share = (0.5 / step).min(1.0);
                for (a, next) in amplitudes.iter_mut().zip(next.iter()) {
                    *a += share * (next - *a);
                }
                if is_met && step < 1e-12 {
                    break;
                }
            }
            if !is_met {
                return None;
            }
        }
        let found = MildLaw {
            law: self.clone(),
            amplitudes,
        };
        (found.unevenness() < UNEVEN).then_some(found)
    }
}

impl MildLaw {
    pub(super) fn sense(&self) -> f64 {
        self.law.sense
    }

    /// Directions of carrier and arm in the first pose, rad.
    pub(super) fn start(&self) -> [f64; 2] {
        self.law.start
    }

    /// Turns of carrier and planet from the first pose to each, in the carrier's sense, rad.
    pub(super) fn turns(&self) -> Vec<[f64; 2]> {
        let mut sum = [0.0; 2];
        let before = |turn: &[f64; 2]| {
            let before = sum;
            sum = [sum[0] + turn[0], sum[1] + turn[1]];
            before
        };
        self.law.turns.iter().map(before).collect()
    }

    /// Maximum |ln| of the ratio at 360 samples; it only ranks laws.
    pub(super) fn unevenness(&self) -> f64 {
        let at = |i: u32| ratio(&self.amplitudes, &waves(f64::from(i).to_radians()));
        (0..360).map(|i| at(i).ln().abs()).fold(0.0, f64::max)
    }

    /// Directions of carrier and arm at even samples of the carrier from the first pose on, rad.
    pub(super) fn places(&self, count: usize) -> Vec<[f64; 2]> {
        let [carrier, arm] = self.law.start;
        let step = TAU / count as f64;
        let mut planet = 0.0;
        let place = |i: usize| {
            let psi = step * i as f64;
            let turned = psi - planet;
            gauss_legendre(psi, psi + step, |psi, weight| {
                planet += weight * ratio(&self.amplitudes, &waves(psi));
            });
            let sense = self.law.sense;
            [carrier + sense * psi, arm + sense * turned]
        };
        (0..count).map(place).collect()
    }
}

fn ratio(amplitudes: &[f64; TERMS], waves: &[f64; TERMS]) -> f64 {
    let terms = amplitudes.iter().zip(waves).map(|(a, wave)| a * wave);
    terms.sum::<f64>().exp()
}

/// Visits the nodes of a quadrature over an interval, in parts of at most half a turn.
fn visit(from: f64, to: f64, mut see: impl FnMut(f64, f64)) {
    let parts = ((to - from) / (0.5 * TAU)).ceil().max(1.0);
    for part in 0..parts as usize {
        let at = |i: usize| from + (to - from) * i as f64 / parts;
        gauss_legendre(at(part), at(part + 1), &mut see);
    }
}
