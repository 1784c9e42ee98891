use centrode::analysis::{TrainTeeth, arm_clearance_course, carrier_turn};
use centrode::export::page::{Curve, Picture};
use centrode::export::three_arm::{self, Teeth};
use centrode::geometry::Tolerance;
use centrode::mechanism::gear::Member;
use centrode::mechanism::three_arm::ThreeArm;

use super::gear_pair::contact_curves;
use super::handles::handles;

/// Parts of a carrier turn in which the arms' clearance is shown.
const PARTS: u32 = 120;

/// Tolerance of the picture, as a share of the distance between two axes.
const DRAWN: f64 = 1e-4;

/// The mechanism with plain gears: cutting teeth takes longer than an eye waits.
pub(super) fn picture(mechanism: &ThreeArm) -> Picture {
    drawn(mechanism, Teeth::Plain)
}

/// The mechanism with its teeth, where they can be cut.
pub(super) fn with_teeth(mechanism: &ThreeArm) -> Option<Picture> {
    let pair = mechanism.pair().ok()?;
    Some(drawn(mechanism, Teeth::Cut(&pair)))
}

/// How clear the arms keep, and what the flanks of sun and first intermediate gear do, by the carrier's turn.
pub(super) fn checked_curves(mechanism: &ThreeArm, teeth: Option<&TrainTeeth>) -> Vec<Curve> {
    let mut curves = Vec::new();
    if let Some(course) = arm_clearance_course(mechanism, PARTS) {
        let all = [
            ("from one another", course.arms),
            ("from the tray", course.tray),
        ];
        let found = all.into_iter().filter(|(_, value)| !value.is_empty());
        curves.extend(found.map(|(name, value)| Curve {
            chart: "Clearance of the arms",
            name,
            unit: "mm",
            count: false,
            input: course.input.clone(),
            value,
        }));
    }
    if let Some(teeth) = teeth {
        curves.extend(contact_curves(&teeth.contact).into_iter().map(|curve| {
            let mut points: Vec<(f64, f64)> = curve
                .input
                .iter()
                .map(|&sun| carrier_turn(mechanism, sun))
                .zip(curve.value)
                .collect();
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            let (input, value) = points.into_iter().unzip();
            Curve {
                input,
                value,
                ..curve
            }
        }));
    }
    curves
}

fn drawn(mechanism: &ThreeArm, teeth: Teeth<'_>) -> Picture {
    let Ok(tolerance) = Tolerance::new(DRAWN * mechanism.center_distance()) else {
        return Picture::default();
    };
    let mut picture = three_arm::picture(mechanism, teeth, tolerance);
    if let Some(sun) = picture.links.iter().position(|link| link.name == "sun") {
        let length = mechanism.rolling().pitch_length(Member::Driver);
        picture.handles = handles(&mechanism.design().pitch, length, sun);
    }
    picture
}
