use std::f64::consts::TAU;

use centrode_geometry::{Extreme, maximum_of_samples, rounding};

use super::TwoBar;
use super::curvature::curvatures;
use super::distance::Series;
use super::path::{PathSamples, Sample};
use super::split::SHARE;

/// Maximum number of pieces of the path that a map samples; if there are more, the sampled ones are evenly spread.
const MAX_PIECES: usize = 64;
/// Steps per turn; a map averages a curvature over one step. Most laws are written in tables of this many steps.
pub(super) const AVERAGED: f64 = 180.0;

impl TwoBar {
    /// Centre distance of the gears, mm: length of both legs of the carrier. `bend` is the angle from the first to the second, rad.
    #[must_use]
    pub fn center_distance(&self, bend: f64) -> f64 {
        leg(self.carrier(), bend)
    }

    /// Maximum curvature of the four pitch curves of the split by powers, as a multiple of one over the centre distance, and the
    /// path's parameter there: exact within rounding, for the law itself. Gears are written from a table of the law, and may be
    /// less curved: [`ReversedMachine::minimum_radius`](super::ReversedMachine::minimum_radius).
    #[must_use]
    pub fn sharpness(&self) -> Extreme {
        self.maximum_bend(|[a, b, c, d]| a.max(b).max(c.max(d)))
    }

    /// Maximum convex and maximum concave curvature of the four pitch curves of the split by powers, 1/mm: they bound the
    /// module of full teeth. `bend` is the angle from the carrier's first leg to its second, rad.
    #[must_use]
    pub fn curvatures(&self, bend: f64) -> [f64; 2] {
        let leg = self.center_distance(bend);
        let maximum = |sign: f64| {
            let most =
                |curvatures: [f64; 4]| curvatures.iter().fold(0.0_f64, |s, c| s.max(sign * c));
            self.maximum_bend(most).value / leg
        };
        [maximum(1.0), maximum(-1.0)]
    }

    /// Minimum radius of curvature of the four pitch curves of the split by powers where they are convex, mm, of the law itself as
    /// for [`sharpness`](Self::sharpness); `bend` is the angle from the carrier's first leg to its second, rad.
    #[must_use]
    pub fn minimum_radius(&self, bend: f64) -> f64 {
        self.center_distance(bend) / self.sharpness().value
    }

    /// The sharpness, averaged over a step of a table, at samples of at most 64 pieces of the path.
    ///
    /// If two pieces of the path join near a position at which the bars are stretched or folded, the law has a peak of curvature
    /// there: the nearer the joint, the higher and narrower the peak. A table of the law does not contain this peak, so the gears
    /// do not have it.
    pub(super) fn sharpness_sampled(&self) -> f64 {
        let looks = PathSamples::new(self.path(), MAX_PIECES);
        let speeds = self.speeds_of(&looks);
        let scale = self.scale(&looks.samples, &speeds);
        let mut rest = &speeds[..];
        let mut sharpest = 0.0_f64;
        for piece in &looks.pieces {
            let (own, after) = rest.split_at(piece.steps + 1);
            rest = after;
            let step = (piece.to - piece.from) / piece.steps as f64;
            let span = (self.path().period() / AVERAGED / step).ceil() as usize;
            let span = span.clamp(1, piece.steps);
            let laws: Vec<[f64; 3]> = own.iter().map(|speeds| law(*speeds)).collect();
            for (i, [w, slope, _]) in laws.iter().enumerate() {
                let low = i.saturating_sub(span / 2).min(piece.steps - span);
                let bend = (laws[low + span][1] - laws[low][1]) / (span as f64 * step);
                let curvatures = by_powers(scale, own[i], [*w, *slope, bend]);
                sharpest = curvatures.into_iter().fold(sharpest, f64::max);
            }
        }
        sharpest
    }

    fn speeds_of(&self, looks: &PathSamples) -> Vec<[Series; 2]> {
        let jets = looks.samples.iter();
        jets.map(|s| self.speed_series(s.at, &s.jet)).collect()
    }

    /// Maximum of a measure of the four curvatures, times the centre distance.
    fn maximum_bend(&self, of: impl Fn([f64; 4]) -> f64) -> Extreme {
        let looks = PathSamples::new(self.path(), usize::MAX);
        let speeds = self.speeds_of(&looks);
        let scale = self.scale(&looks.samples, &speeds);
        let sharpest = |speeds: [Series; 2]| of(by_powers(scale, speeds, law(speeds)));
        let samples: Vec<f64> = speeds.iter().map(|speeds| sharpest(*speeds)).collect();
        let at = |t: f64| sharpest(self.speed_series(t, &self.path().at(t)));
        maximum_of_samples(&samples, at, rounding, &looks.pieces)
    }

    /// Logarithm of the factor that gives the first stage the mean ratio one: its ratio is this factor times a power of the total
    /// ratio. `samples` and `speeds` are in order along the path.
    ///
    /// Computed by the trapezoidal rule with the slopes at both ends of each step: the integrand has a continuous slope.
    fn scale(&self, samples: &[Sample], speeds: &[[Series; 2]]) -> f64 {
        let rate = |[carrier, planet]: &[Series; 2]| {
            let ln = |s: &Series| (s.0[0].ln(), s.0[1] / s.0[0]);
            let ((c, c1), (p, p1)) = (ln(carrier), ln(planet));
            let value = (SHARE * p + (1.0 - SHARE) * c).exp();
            (value, value * (SHARE * p1 + (1.0 - SHARE) * c1))
        };
        let rates: Vec<(f64, f64)> = speeds.iter().map(rate).collect();
        let count = rates.len();
        let step = |i: usize| {
            let next = (i + 1) % count;
            let wrap = if next == 0 { self.path().period() } else { 0.0 };
            let h = samples[next].at + wrap - samples[i].at;
            let ((a, slope), (b, after)) = (rates[i], rates[next]);
            0.5 * h * (a + b) + h * h / 12.0 * (slope - after)
        };
        (TAU / (0..count).map(step).sum::<f64>()).ln()
    }
}

/// Centre distance of each stage, mm: both legs of a carrier have this length.
pub(crate) fn leg(carrier: f64, bend: f64) -> f64 {
    0.5 * carrier / (0.5 * bend).cos()
}

/// Logarithm of the ratio with two derivatives by the path's parameter, from the speeds of carrier and planet.
fn law([carrier, planet]: [Series; 2]) -> [f64; 3] {
    let [w, slope, bend, _] = (planet / carrier).ln().derivatives();
    [w, slope, bend]
}

/// Curvatures of the pitch curves of both stages, times the centre distance, from the speeds of carrier and planet and the law.
fn by_powers(scale: f64, [carrier, planet]: [Series; 2], [w, slope, bend]: [f64; 3]) -> [f64; 4] {
    // Derivatives by the driver's own angle.
    let by = |driver: Series, share: f64| {
        let [speed, change, ..] = driver.derivatives();
        let second = (bend - slope * change / speed) / (speed * speed);
        curvatures([scale + share * w, share * slope / speed, share * second])
    };
    let [(a, _), (b, _)] = by(carrier, SHARE);
    let [(c, _), (d, _)] = by(planet, SHARE - 1.0);
    [a, b, c, d]
}
