//! Proof that a curve goes round the shaft axis once, in order, without touching it.

use centrode_geometry::{Curve, Jet, bracketed_minimum};

use super::PitchError;
use super::plane::Shape;

/// Fewest samples of a whole curve and of one analytic piece of it.
const SAMPLES: (usize, usize) = (1024, 8);
/// Halvings of a sample interval where the curve is not yet resolved.
const DEEPEST: u32 = 8;

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
pub(crate) fn goes_round_once(curve: &dyn Shape, key: &'static str) -> Result<(), PitchError> {
    let ends = piece_ends(curve);
    let count = (SAMPLES.0 / (ends.len() - 1)).max(SAMPLES.1);
    let mut turn = 0.0;
    let mut faults = None;
    let mut before: Option<Jet> = None;
    for pair in ends.windows(2) {
        // The last sample of a piece is its limit from the left.
        let (a, b) = (pair[0], pair[1].next_down());
        let start = curve.at(a);
        if let Some(end) = before {
            joined(key, &end, &start)?;
        }
        let mut low = sample(curve, key, a)?;
        for i in 1..=count {
            let t = if i == count {
                b
            } else {
                a + (b - a) * i as f64 / count as f64
            };
            let high = sample(curve, key, t)?;
            piece(curve, key, low, high, 0, &mut turn, &mut faults)?;
            low = high;
        }
        before = Some(curve.at(b));
    }
    if let Some(end) = before {
        joined(key, &end, &curve.at(0.0))?;
    }
    if turn < -std::f64::consts::PI {
        return Err(PitchError::Clockwise { key });
    }
    if let Some(fault) = faults {
        return Err(fault);
    }
    let turns = (turn / std::f64::consts::TAU).round() as i32;
    if turns == 1 {
        Ok(())
    } else {
        Err(PitchError::NotAroundAxis { key, turns })
    }
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

fn sample(curve: &dyn Shape, key: &'static str, t: f64) -> Result<Sample, PitchError> {
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
        let angle = degrees(jet.first.y.atan2(jet.first.x));
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

/// Adds the turn of one interval, halving it until cubic Hermite interpolation foretells its middle.
fn piece(
    curve: &dyn Shape,
    key: &'static str,
    low: Sample,
    high: Sample,
    depth: u32,
    turn: &mut f64,
    fault: &mut Option<PitchError>,
) -> Result<(), PitchError> {
    let middle = sample(curve, key, 0.5 * (low.t + high.t))?;
    let step = high.t - low.t;
    let unforeseen = |a: [f64; 2], b: [f64; 2], m: f64| {
        let foretold = 0.5 * (a[0] + b[0]) + 0.125 * step * (a[1] - b[1]);
        (foretold - m).abs() > 0.05 * a[0].min(b[0]).min(m).max(0.0)
    };
    let unresolved = unforeseen(low.radius, high.radius, middle.radius[0])
        || unforeseen(low.speed, high.speed, middle.speed[0]);
    if unresolved && depth < DEEPEST && fault.is_none() {
        piece(curve, key, low, middle, depth + 1, turn, fault)?;
        return piece(curve, key, middle, high, depth + 1, turn, fault);
    }
    let wrapped = |a: f64| a - std::f64::consts::TAU * (a / std::f64::consts::TAU).round();
    *turn += wrapped(middle.angle - low.angle) + wrapped(high.angle - middle.angle);
    if fault.is_some() {
        return Ok(());
    }
    // A minimum can hide only where the slope changes from falling to rising.
    let dips = |a: [f64; 2], b: [f64; 2]| a[1] <= 0.0 && b[1] >= 0.0;
    let least = |figure: fn(&Sample) -> [f64; 2]| {
        let ends = [low, middle, high].into_iter();
        let at = ends.min_by(|a, b| figure(a)[0].total_cmp(&figure(b)[0]));
        let at = at.unwrap_or(middle);
        if !dips(figure(&low), figure(&high)) {
            return Ok(at);
        }
        let f = |t: f64| sample(curve, key, t).map_or(f64::INFINITY, |s| figure(&s)[0]);
        let (t, value) = bracketed_minimum(f, low.t, high.t);
        if value < figure(&at)[0] {
            sample(curve, key, t)
        } else {
            Ok(at)
        }
    };
    let nearest = least(|s| s.radius)?;
    let slowest = least(|s| s.speed)?;
    if nearest.radius[0] <= 0.0 {
        // A negative radius lies opposite the angle it belongs to.
        let opposite = if nearest.radius[0] < 0.0 {
            std::f64::consts::PI
        } else {
            0.0
        };
        let (angle, radius) = (degrees(nearest.angle + opposite), nearest.radius[0]);
        *fault = Some(PitchError::RadiusNotPositive { key, angle, radius });
    } else if slowest.speed[0] <= 0.0 {
        let (angle, radius) = (degrees(slowest.angle), slowest.radius[0]);
        *fault = Some(PitchError::SelfCrossing { key, angle, radius });
    }
    Ok(())
}

fn degrees(angle: f64) -> f64 {
    angle.to_degrees().rem_euclid(360.0)
}
