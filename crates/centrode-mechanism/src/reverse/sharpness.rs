use std::f64::consts::TAU;

use centrode_geometry::{Extreme, greatest_sampled, rounding};

use super::TwoBar;
use super::curvature::curvatures;
use super::distance::Series;
use super::path::{PathSamples, Sample};
use super::split::SHARE;

/// Most pieces of the path that a map looks at: of more it takes as many, evenly spread.
const MOST_PIECES: usize = 64;

impl TwoBar {
    /// Centre distance of the gears, mm: length of both legs of the carrier. `bend` is the angle from the first to the second, rad.
    #[must_use]
    pub fn center_distance(&self, bend: f64) -> f64 {
        leg(self.carrier(), bend)
    }

    /// Greatest curvature of the four pitch curves of the split by powers, as a multiple of one over the centre distance, and the
    /// path's parameter there: exact to the float limit.
    #[must_use]
    pub fn sharpness(&self) -> Extreme {
        self.greatest_bend(usize::MAX, |[a, b, c, d]| a.max(b).max(c.max(d)))
    }

    /// Greatest convex and greatest concave curvature of the four pitch curves of the split by powers, 1/mm: they bound the
    /// module of full teeth. `bend` is the angle from the carrier's first leg to its second, rad.
    #[must_use]
    pub fn curvatures(&self, bend: f64) -> [f64; 2] {
        let leg = self.center_distance(bend);
        let greatest = |sign: f64| {
            let most =
                |curvatures: [f64; 4]| curvatures.iter().fold(0.0_f64, |s, c| s.max(sign * c));
            self.greatest_bend(usize::MAX, most).value / leg
        };
        [greatest(1.0), greatest(-1.0)]
    }

    /// Least radius of curvature of the four pitch curves of the split by powers where they are convex, mm; `bend` is the angle
    /// from the carrier's first leg to its second, rad.
    #[must_use]
    pub fn least_radius(&self, bend: f64) -> f64 {
        self.center_distance(bend) / self.sharpness().value
    }

    /// The sharpness on as many pieces of the path as a map looks at.
    pub(super) fn sharpness_sampled(&self) -> Extreme {
        self.greatest_bend(MOST_PIECES, |[a, b, c, d]| a.max(b).max(c.max(d)))
    }

    /// Greatest value of a measure of the four curvatures, times the centre distance.
    fn greatest_bend(&self, most: usize, of: impl Fn([f64; 4]) -> f64) -> Extreme {
        let looks = PathSamples::new(self.path(), most);
        let jets = looks.samples.iter();
        let speeds: Vec<[Series; 2]> = jets.map(|s| self.speed_series(s.at, &s.jet)).collect();
        let scale = self.scale(&looks.samples, &speeds);
        let sharpest = |speeds: [Series; 2]| of(by_powers(scale, speeds));
        let samples: Vec<f64> = speeds.iter().map(|speeds| sharpest(*speeds)).collect();
        let at = |t: f64| sharpest(self.speed_series(t, &self.path().at(t)));
        greatest_sampled(&samples, at, rounding, &looks.pieces)
    }

    /// Logarithm of the mean ratio of the first stage's ratio to the power of the total one, by samples in order.
    ///
    /// By the trapezoidal rule with the slopes at both ends of each step: the integrand has a continuous slope.
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

/// Distance of the axes of each stage, mm: both legs of a carrier are as long.
pub(crate) fn leg(carrier: f64, bend: f64) -> f64 {
    0.5 * carrier / (0.5 * bend).cos()
}

/// Curvatures of the pitch curves of both stages, times the centre distance, from the speeds of carrier and planet.
fn by_powers(scale: f64, [carrier, planet]: [Series; 2]) -> [f64; 4] {
    let [w, slope, bend, _] = (planet / carrier).ln().derivatives();
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
