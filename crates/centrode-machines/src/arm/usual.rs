//! Default sizes of an arm, for a design that gives none.

use super::ArmBodySpec;
use super::parts::Reach;
use centrode_kinematics::machine::preferred_size;

/// Distance of the tip from the planet's axis, mm, for which the default sizes are made.
const TIP_DISTANCE: f64 = 145.0;
/// Length, mm, that tube, spring and the fork's pin of the default sizes take along the pusher's axis, from the
/// planet's axis to the clamp.
const BEHIND_CLAMP: f64 = 66.0;
/// Distance of the pusher's axis from the planet's, mm, for which the default fork's lever is made.
const BETWEEN_AXES: f64 = 46.0;
/// Used share of the maximum height of the clamp at the housing's front.
const FILLED: f64 = 0.98;
/// Ratio of each scale tried to the one before, and of each height tried to the one before.
const SMALLER: f64 = 0.9;
/// Number of scales tried.
const SCALES: i32 = 24;
/// Number of heights of clamp and rod tried at each scale: the last is 0.43 of the first.
const HEIGHTS: i32 = 9;

/// Default sizes at the scale that suits an arm.
#[derive(Clone, Debug, PartialEq)]
pub struct UsualArm {
    /// Scale of the default sizes, and of the usual cam and fork.
    pub scale: f64,
    /// Sizes of the body.
    pub body: ArmBodySpec,
}

impl UsualArm {
    /// Sizes the arm whose tip is `tip_distance` (S) from the planet's axis, on a pusher's axis at the distance
    /// `pusher_offset` (H) from the planet's axis, with a clamp of `clamp_length` (L); all mm.
    ///
    /// The scale is `min(S / 145, (sqrt(S^2 - H^2) - L) / 66, |H| / 46)`. It leaves room behind the clamp for the spring and the
    /// fork's pin, and between the axes for the fork and its lever. If the clamp is then too high for the housing's front, its
    /// root is made lower, down to the height of its tip. If that is not enough, clamp and rod are made slimmer, down to 0.43 of
    /// their heights, and after that the whole arm smaller. If nothing fits, the sizes are those of the scale, and
    /// [`ArmBody::new`](super::ArmBody::new) or the fork reports the part that does not fit.
    #[must_use]
    pub fn new(tip_distance: f64, pusher_offset: f64, clamp_length: f64) -> Self {
        let usual = tip_distance / TIP_DISTANCE;
        let along = (tip_distance * tip_distance - pusher_offset * pusher_offset).max(0.0);
        let scale = usual
            .min((along.sqrt() - clamp_length) / BEHIND_CLAMP)
            .min(pusher_offset.abs() / BETWEEN_AXES)
            .max(1e-3 * usual);
        let reach = Reach {
            tip_distance,
            pusher_offset,
            clamp_length,
        };
        (0..SCALES)
            .map(|i| scale * SMALLER.powi(i))
            .find_map(|scale| {
                let slim = |i| slimmer(enlarged(scale), SMALLER.powi(i));
                let body = (0..HEIGHTS).find_map(|i| fitted(slim(i), &reach))?;
                Some(Self { scale, body })
            })
            .unwrap_or_else(|| Self {
                scale,
                body: enlarged(scale),
            })
    }
}

/// A length rounded to two significant digits.
fn of_two_digits(length: f64) -> f64 {
    let parts = 10_f64.powi(1 - length.log10().floor() as i32);
    let rounded = (length * parts).round() / parts;
    if rounded.is_finite() { rounded } else { length }
}

/// A length of at least 1 mm rounded up to half millimetres; a shorter one is unchanged.
fn whole_halves(length: f64) -> f64 {
    match length >= 1.0 && length.is_finite() {
        true => 0.5 * (2.0 * length - 1e-9).ceil(),
        false => length,
    }
}

/// Default sizes enlarged and rounded: bore and push rod to preferred sizes, the bore for the cam's sleeve up to half
/// millimetres, wall, width and clamp thickness to two significant digits.
fn enlarged(scale: f64) -> ArmBodySpec {
    let mut body = ArmBodySpec::default().scaled(scale);
    for size in [&mut body.housing.bore, &mut body.push_rod.diameter] {
        *size = preferred_size(*size);
    }
    body.housing.sleeve_bore = whole_halves(body.housing.sleeve_bore);
    for thickness in [
        &mut body.housing.wall,
        &mut body.housing.width,
        &mut body.clamp.thickness,
    ] {
        *thickness = of_two_digits(*thickness);
    }
    body
}

/// The sizes with the heights of clamp, rod and pusher multiplied by `share`.
fn slimmer(mut body: ArmBodySpec, share: f64) -> ArmBodySpec {
    for height in [
        &mut body.clamp.root_height,
        &mut body.clamp.tip_height,
        &mut body.push_rod.diameter,
        &mut body.push_rod.pusher_height,
    ] {
        *height *= share;
    }
    body.push_rod.diameter = preferred_size(body.push_rod.diameter);
    body
}

/// The sizes with the clamp's root lowered to the height that the housing's front allows; `None` if it becomes lower than the
/// tip.
fn fitted(mut body: ArmBodySpec, reach: &Reach) -> Option<ArmBodySpec> {
    // A lower root changes the slope of the clamp's sides, and with it the maximum height: iterate.
    for _ in 0..20 {
        let contour = reach.contour(&body).ok()?;
        let most = 2.0 * FILLED * contour.room();
        if body.clamp.root_height <= most {
            let half = 0.5 * body.rod_bore();
            contour.split(body.housing.wall, half)?;
            contour.split(0.0, half)?;
            return Some(body);
        }
        if most < body.clamp.tip_height {
            return None;
        }
        body.clamp.root_height = FILLED * most;
    }
    None
}
