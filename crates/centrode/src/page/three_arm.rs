use centrode::export::page::Picture;
use centrode::export::three_arm::{self, Teeth};
use centrode::geometry::Tolerance;
use centrode::mechanism::gear::Member;
use centrode::mechanism::three_arm::ThreeArm;

use super::handles::handles;

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
