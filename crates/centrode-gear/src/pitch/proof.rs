//! Proof that a curve winds once round the shaft axis, in order, without touching it.

use std::f64::consts::{PI, TAU};

use centrode_geometry::{Curve, Jet, bracketed_minimum};

use super::PitchError;
use super::plane::ScalableCurve;

/// Minimum number of samples of a whole curve and of one analytic piece of it. Fewer can miss a narrow dip of the
/// radius, more take longer.
const SAMPLES: (usize, usize) = (384, 8);
/// Maximum number of halvings of one sample interval if the curve is not yet resolved. Fewer miss narrow features, more
/// take longer.
const DEEPEST: u32 = 12;
/// Maximum number of halvings of all intervals together; above it the curve is refused as too rough.
const MAX_HALVINGS: u32 = 50_000;

/// Radius and speed of the polar angle at a parameter, each with its slope.
#[derive(Clone, Copy)]
struct Sample {
    t: f64,
    angle: f64,
    radius: [f64; 2],
    speed: [f64; 2],
}

/// The interval ends of the curve's analytic pieces, from zero to the period.
pub(crate) fn piece_ends(curve: &dyn Curve) -> Vec<f64> {
    let mut ends = vec![0.0];
    ends.extend(curve.breaks().into_iter().filter(|&t| t > 0.0));
    ends.push(curve.period());
    ends
}

/// Refuses a curve that is not a simple, counter-clockwise turn around the origin.
pub(crate) fn goes_round_once(
    curve: &dyn ScalableCurve,
    key: &'static str,
) -> Result<(), PitchError> {
    if curve.goes_round_by_form() {
        // Only the numbers themselves can still be too large.
        return (0..8)
            .try_for_each(|i| sample(curve, key, curve.period() * f64::from(i) / 8.0).map(drop));
    }
    let ends = piece_ends(curve);
    let count = (SAMPLES.0 / (ends.len() - 1)).max(SAMPLES.1);
    let first = sample(curve, key, 0.0)?;
    let mut walk = Walk {
        curve,
        key,
        turn: 0.0,
        halvings: 0,
        nearest: first,
        slowest: first,
    };
    let mut before: Option<Jet> = None;
    for pair in ends.windows(2) {
        // The last sample of a piece is its limit from the left.
        let (a, b) = (pair[0], pair[1].next_down());
        if let Some(end) = before {
            joined(key, &end, &curve.at(a))?;
        }
        let mut low = sample(curve, key, a)?;
        for i in 1..=count {
            let t = a + (b - a) * i as f64 / count as f64;
            let high = sample(curve, key, if i == count { b } else { t })?;
            walk.interval(low, high, 0)?;
            low = high;
        }
        before = Some(curve.at(b));
    }
    if let Some(end) = before {
        joined(key, &end, &curve.at(0.0))?;
    }
    walk.verdict()
}

fn joined(key: &'static str, end: &Jet, start: &Jet) -> Result<(), PitchError> {
    let size = end.point.coords.norm().max(start.point.coords.norm());
    let what = "the radius";
    if (end.point - start.point).norm() > 1e-9 * size {
        let (start, end) = (start.point.coords.norm(), end.point.coords.norm());
        return Err(PitchError::OpenCurve {
            key,
            what,
            start,
            end,
        });
    }
    Ok(())
}

fn sample(curve: &dyn ScalableCurve, key: &'static str, t: f64) -> Result<Sample, PitchError> {
    let jet = curve.at(t);
    let p = jet.point.coords;
    let square = p.norm_squared();
    let angle = p.y.atan2(p.x);
    let finite = [p, jet.first, jet.second, jet.third];
    if let Some(bad) = finite.iter().find(|v| !v.norm_squared().is_finite()) {
        let value = if bad.x.is_finite() { bad.y } else { bad.x };
        let angle = degrees(if angle.is_finite() { angle } else { t });
        return Err(PitchError::Undefined { key, angle, value });
    }
    let radius = square.sqrt() * curve.side(t);
    if radius == 0.0 {
        // At the axis the polar angle is that of the tangent; if there is no tangent, the parameter is the polar angle.
        let tangent = jet.first;
        let angle = degrees(match tangent.norm() > 0.0 {
            true => tangent.y.atan2(tangent.x),
            false => t,
        });
        return Err(PitchError::RadiusNotPositive { key, angle, radius });
    }
    let outward = p.dot(&jet.first) / square;
    let turning = p.perp(&jet.first) / square;
    let slope = p.perp(&jet.second) / square - 2.0 * outward * turning;
    Ok(Sample {
        t,
        angle,
        radius: [radius, outward * radius],
        speed: [turning, slope],
    })
}

/// State of a pass along the curve.
struct Walk<'a> {
    curve: &'a dyn ScalableCurve,
    key: &'static str,
    turn: f64,
    halvings: u32,
    /// Sample of the minimum radius.
    nearest: Sample,
    /// Sample of the minimum advance of the polar angle.
    slowest: Sample,
}

impl Walk<'_> {
    /// Samples one interval, halving it until cubic Hermite interpolation predicts its middle.
    fn interval(&mut self, low: Sample, high: Sample, depth: u32) -> Result<(), PitchError> {
        let middle = sample(self.curve, self.key, 0.5 * (low.t + high.t))?;
        let step = high.t - low.t;
        let unforeseen = |a: [f64; 2], b: [f64; 2], m: f64| {
            let foretold = 0.5 * (a[0] + b[0]) + 0.125 * step * (a[1] - b[1]);
            let minimum = a[0].min(b[0]).min(m);
            minimum > 0.0 && (foretold - m).abs() > 0.05 * minimum
        };
        let unresolved = unforeseen(low.radius, high.radius, middle.radius[0])
            || unforeseen(low.speed, high.speed, middle.speed[0]);
        if unresolved && depth < DEEPEST {
            self.halvings += 1;
            if self.halvings > MAX_HALVINGS {
                let (key, angle) = (self.key, degrees(middle.angle));
                return Err(PitchError::TooRough { key, angle });
            }
            self.interval(low, middle, depth + 1)?;
            return self.interval(middle, high, depth + 1);
        }
        let wrapped = |a: f64| a - TAU * (a / TAU).round();
        self.turn += wrapped(middle.angle - low.angle) + wrapped(high.angle - middle.angle);
        self.nearest = self.minimum(self.nearest, [low, middle, high], |s| s.radius)?;
        self.slowest = self.minimum(self.slowest, [low, middle, high], |s| s.speed)?;
        Ok(())
    }

    /// Sample where the figure is smallest: the known one, or one in the interval.
    fn minimum(
        &self,
        known: Sample,
        interval: [Sample; 3],
        figure: fn(&Sample) -> [f64; 2],
    ) -> Result<Sample, PitchError> {
        let lower = |a: Sample, b: Sample| if figure(&b)[0] < figure(&a)[0] { b } else { a };
        let minimum = interval.into_iter().fold(known, lower);
        let [low, _, high] = interval;
        // Inside, a minimum can hide only where the slope changes from falling to rising, and it matters
        // only where it may be below the known minimum.
        let dips = figure(&low)[1] < 0.0 && figure(&high)[1] > 0.0;
        let reach = 0.25 * (high.t - low.t) * (figure(&high)[1] - figure(&low)[1]);
        if !dips || figure(&low)[0].min(figure(&high)[0]) - reach > figure(&minimum)[0] {
            return Ok(minimum);
        }
        let value =
            |t: f64| sample(self.curve, self.key, t).map_or(f64::INFINITY, |s| figure(&s)[0]);
        let (t, _) = bracketed_minimum(value, low.t, high.t);
        Ok(lower(minimum, sample(self.curve, self.key, t)?))
    }

    fn verdict(&self) -> Result<(), PitchError> {
        let key = self.key;
        if self.nearest.radius[0] <= 0.0 {
            // A negative radius lies opposite the angle it belongs to.
            let radius = self.nearest.radius[0];
            let opposite = if radius < 0.0 { PI } else { 0.0 };
            let angle = degrees(self.nearest.angle + opposite);
            return Err(PitchError::RadiusNotPositive { key, angle, radius });
        }
        if self.turn < -PI {
            return Err(PitchError::Clockwise { key });
        }
        if self.slowest.speed[0] <= 0.0 {
            let (angle, radius) = (degrees(self.slowest.angle), self.slowest.radius[0]);
            return Err(PitchError::SelfCrossing { key, angle, radius });
        }
        let turns = (self.turn / TAU).round() as i32;
        if turns == 1 {
            Ok(())
        } else {
            Err(PitchError::NotAroundAxis { key, turns })
        }
    }
}

fn degrees(angle: f64) -> f64 {
    angle.to_degrees().rem_euclid(360.0)
}
