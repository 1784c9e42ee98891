use std::f64::consts::TAU;
use std::sync::{Arc, OnceLock};

use centrode_geometry::{Antiderivative, Curve, Jet, Point, bracketed_root};

use super::{Extreme, Rolling, RollingError, SAME};
use crate::pitch::{SampledLaw, Symmetry, gcd};

/// Maximum number of pieces on which a pitch curve may not be smooth, for example next to a kink. A larger number
/// accepts curves whose length is not exact.
const MAX_UNSETTLED: usize = 64;

/// Minimum change of the radius's slope that counts as a wave, as a share of the maximum radius per radian. A smaller
/// one counts rounding as waves, a larger one misses shallow waves.
const SWINGS: f64 = 1e-7;

impl Rolling {
    /// Finds the centre distance at which `curve` drives a closed conjugate curve at `mean_ratio`
    /// (turns of driver : turns of driven).
    ///
    /// # Errors
    /// [`RollingError`] when no such curve exists.
    pub fn new(curve: Arc<dyn Curve>, mean_ratio: (u32, u32)) -> Result<Self, RollingError> {
        let ratio = reduced(mean_ratio)?;
        let period = curve.period();
        let (start, half) = axis_crossings(&*curve, period)?;
        let breaks = curve.breaks();
        // A curve that starts at angle zero has a break there. Rounding must not separate the start from the break, nor the break
        // from its repetition one turn later.
        let on = breaks.iter().find(|&&b| (b - start).abs() <= SAME * period);
        let start = on.copied().unwrap_or(start);
        let mut jumps: Vec<f64> = breaks
            .into_iter()
            .map(|b| if b < start { b + period } else { b })
            .collect();
        jumps.sort_by(f64::total_cmp);
        let mut breaks = vec![start];
        breaks.extend(jumps.iter().copied().filter(|&b| b > start));
        breaks.push(start + period);

        let arc = Antiderivative::new(|t| curve.at(t).first.norm(), &breaks);
        if arc.unconverged() > MAX_UNSETTLED {
            return Err(RollingError::Unsettled {
                unsettled: arc.unconverged(),
                most: MAX_UNSETTLED,
            });
        }
        let jets: Vec<(f64, f64, Jet)> = arc
            .nodes()
            .map(|(t, weight)| (t, weight, curve.at(t)))
            .collect();
        let node = |&(_, weight, jet): &(f64, f64, Jet)| {
            let p = jet.point.coords;
            (p.norm(), weight * p.perp(&jet.first))
        };
        let nodes: Vec<(f64, f64)> = jets.iter().map(node).collect();
        let mut samples: Vec<(f64, Jet)> = jets.iter().map(|&(t, _, jet)| (t, jet)).collect();
        samples.sort_by(|a, b| a.0.total_cmp(&b.0));
        let [minimum, maximum] = extremes(&*curve, &samples);
        let swings = swings(&samples, SWINGS * maximum.radius);
        let required = TAU * f64::from(ratio.1) / f64::from(ratio.0);
        let mut a = closure(&nodes, maximum.radius, required);
        let mut driven = driven_angle(&*curve, &breaks, a);
        for _ in 0..4 {
            let missing = driven.total() - required;
            if missing.abs() <= 1e-15 * required {
                break;
            }
            let slope: f64 = nodes
                .iter()
                .map(|&(r, w)| -w / (r * (a - r) * (a - r)))
                .sum();
            let better = a - missing / slope;
            if better <= maximum.radius || better == a {
                break;
            }
            let retry = driven_angle(&*curve, &breaks, better);
            if (retry.total() - required).abs() >= missing.abs() {
                break;
            }
            (a, driven) = (better, retry);
        }
        if (driven.total() - required).abs().is_nan()
            || (driven.total() - required).abs() > 1e-12 * required
        {
            return Err(RollingError::NoClosure {
                center_distance: a,
                turned: driven.total(),
                required,
            });
        }
        let mut rolling = Self {
            curve,
            start,
            half,
            jumps,
            knots: Vec::new(),
            arc,
            driven,
            center_distance: a,
            mean_ratio: ratio,
            minimum,
            maximum,
            swings,
            symmetry: Symmetry::NONE,
            sampled: SampledLaw::default(),
            ranges: OnceLock::new(),
        };
        rolling.knots = rolling.knots_at(&breaks);
        rolling.check_repeats()?;
        Ok(rolling)
    }

    /// Checks that the radius repeats n2 times per turn of the driver; otherwise the driven curve would not close after its own
    /// turn.
    fn check_repeats(&self) -> Result<(), RollingError> {
        let repeats = self.mean_ratio.1;
        if repeats == 1 {
            return Ok(());
        }
        let mut difference = 0.0_f64;
        for i in 0..256 {
            let phi = TAU * f64::from(i) / 256.0;
            let r = self.radius(phi);
            let again = self.radius(phi + TAU / f64::from(repeats));
            difference = difference.max((again - r).abs());
        }
        if difference > 1e-9 * self.maximum.radius {
            return Err(RollingError::NotPeriodic {
                ratio: self.mean_ratio,
                difference,
            });
        }
        Ok(())
    }
}

fn reduced(ratio: (u32, u32)) -> Result<(u32, u32), RollingError> {
    let a = gcd(ratio.0, ratio.1);
    let fair = |n: u32| (1..=Rolling::MAX_TURNS).contains(&n);
    if a == 0 || !fair(ratio.0 / a) || !fair(ratio.1 / a) {
        return Err(RollingError::MeanRatio { ratio });
    }
    Ok((ratio.0 / a, ratio.1 / a))
}

/// Parameters at polar angle 0 and pi.
fn axis_crossings(curve: &dyn Curve, period: f64) -> Result<(f64, f64), RollingError> {
    /// Number of points of the curve between which crossings of the axis are searched. Fewer can miss two crossings,
    /// more take longer.
    const SAMPLES: usize = 128;
    let t = |i: usize| period * i as f64 / SAMPLES as f64;
    let mut points: Vec<Point> = (0..SAMPLES).map(|i| curve.at(t(i)).point).collect();
    // The end of the turn is its start, to the last digit.
    points.push(points[0]);
    let mut turned = 0.0;
    let (mut start, mut half) = (None, None);
    for i in 0..SAMPLES {
        let (p, q) = (points[i], points[i + 1]);
        turned += p.coords.perp(&q.coords).atan2(p.coords.dot(&q.coords));
        let crossing = || bracketed_root(|t| curve.at(t).point.y, t(i), t(i + 1), p.y, q.y);
        if p.y < 0.0 && q.y >= 0.0 {
            start = Some(crossing());
        }
        if p.y >= 0.0 && q.y < 0.0 {
            half = Some(crossing());
        }
    }
    match (start, half) {
        (Some(start), Some(half)) if (turned - TAU).abs() < 1e-6 => {
            // A start at the very end of the turn is one at its start.
            let start = if period - start <= SAME * period {
                0.0
            } else {
                start
            };
            let half = if half < start { half + period } else { half };
            Ok((start, half))
        }
        _ => Err(RollingError::NotAroundAxis { turned }),
    }
}

/// Minimum and maximum radius, refined from samples all along the curve.
fn extremes(curve: &dyn Curve, samples: &[(f64, Jet)]) -> [Extreme; 2] {
    let slope_of = |jet: &Jet| jet.point.coords.dot(&jet.first);
    let slope = |t: f64| slope_of(&curve.at(t));
    let extreme = |radius| Extreme { at: 0.0, radius };
    let (mut minimum, mut maximum) = (extreme(f64::INFINITY), extreme(0.0));
    let mut take = |at: f64, jet: &Jet| {
        let radius = jet.point.coords.norm();
        if radius < minimum.radius {
            minimum = Extreme { at, radius };
        }
        if radius > maximum.radius {
            maximum = Extreme { at, radius };
        }
    };
    for (i, (a, jet)) in samples.iter().enumerate() {
        let (b, next) = match samples.get(i + 1) {
            Some((b, next)) => (*b, next),
            None => (samples[0].0 + curve.period(), &samples[0].1),
        };
        let (fa, fb) = (slope_of(jet), slope_of(next));
        if (fa > 0.0) != (fb > 0.0) {
            let at = bracketed_root(slope, *a, b, fa, fb);
            take(at, &curve.at(at));
        }
        take(*a, jet);
    }
    [minimum, maximum]
}

/// Number of waves of the radius per turn: its slope changes from rising to falling and back by more than a threshold. A wave on
/// a falling radius counts, too.
fn swings(samples: &[(f64, Jet)], threshold: f64) -> usize {
    let slopes = samples.iter().map(|(_, jet)| {
        let p = jet.point.coords;
        p.norm() * p.dot(&jet.first) / p.perp(&jet.first)
    });
    turns(slopes, threshold) / 2
}

/// Number of times that a closed sequence of values changes from rising to falling or back, by more than a threshold.
fn turns(values: impl Iterator<Item = f64>, threshold: f64) -> usize {
    let mut rises = Vec::new();
    let mut from: Option<f64> = None;
    for value in values {
        let change = value - from.unwrap_or(value);
        if change.abs() > threshold {
            rises.push(change > 0.0);
        }
        if from.is_none() || change.abs() > threshold {
            from = Some(value);
        }
    }
    let again = rises.iter().cycle().skip(1);
    rises.iter().zip(again).filter(|(a, b)| a != b).count()
}

/// Centre distance by Newton's method, bounded below by the maximum radius; above it the driven angle falls from infinity to
/// zero.
fn closure(nodes: &[(f64, f64)], maximum: f64, required: f64) -> f64 {
    let turned = |a: f64| -> (f64, f64) {
        let (mut sum, mut slope) = (0.0, 0.0);
        for &(r, w) in nodes {
            let part = w / (r * (a - r));
            sum += part;
            slope -= part / (a - r);
        }
        (sum, slope)
    };
    let mut low = maximum;
    let mut high = f64::INFINITY;
    // A circle of the maximum radius would need this distance; the answer is below it.
    let mut a = maximum * (1.0 + TAU / required);
    for _ in 0..100 {
        let (sum, slope) = turned(a);
        if sum > required {
            low = low.max(a);
        } else {
            high = high.min(a);
        }
        let mut next = a - (sum - required) / slope;
        if !(next > low && next < high) {
            next = if high.is_finite() {
                0.5 * (low + high)
            } else {
                2.0 * a
            };
        }
        let done = (next - a).abs() <= 2.0 * f64::EPSILON * a;
        a = next;
        if done {
            break;
        }
    }
    a
}

fn driven_angle(curve: &dyn Curve, breaks: &[f64], a: f64) -> Antiderivative {
    Antiderivative::new(
        |t| {
            let jet = curve.at(t);
            let r = jet.point.coords.norm();
            jet.point.coords.perp(&jet.first) / (r * (a - r))
        },
        breaks,
    )
}
