use centrode::analysis::Contact;
use centrode::export::gear_pair;
use centrode::export::page::{Curve, Picture};
use centrode::geometry::Tolerance;
use centrode::mechanism::design::Design;
use centrode::mechanism::gear::GearPair;

use super::handles::handles;

/// Tolerance of the picture, as a share of the module: a tenth of a pixel when a tooth is as high as a hand.
const DRAWN: f64 = 2e-3;

/// The pair as it moves, with its control points.
pub(super) fn picture(design: &Design, pair: &GearPair) -> Picture {
    let tolerance = Tolerance::new(DRAWN * pair.module());
    let mut picture =
        tolerance.map_or_else(|_| Picture::default(), |t| gear_pair::picture(pair, t));
    let Design::GearPair(design) = design else {
        return picture;
    };
    let driver = picture
        .links
        .iter()
        .position(|link| link.name == picture.motion.input_name);
    if let Some(link) = driver {
        let length = pair.driver().pitch_length();
        picture.handles = handles(&design.pitch, length, link);
    }
    picture
}

/// What running the finished gears together says along the cycle.
pub(super) fn contact_curves(contact: &Contact) -> Vec<Curve> {
    let curve = |chart, name, unit, value: Vec<f64>| Curve {
        chart,
        name,
        unit,
        count: false,
        input: contact.input.clone(),
        value,
    };
    let degrees = |list: &[f64]| list.iter().map(|v| v.to_degrees()).collect::<Vec<_>>();
    vec![
        Curve {
            count: true,
            ..curve(
                "Contacts at once",
                "",
                "",
                contact.contacts.iter().map(|&n| f64::from(n)).collect(),
            )
        },
        curve(
            "Backlash of the driven gear",
            "",
            "°",
            degrees(&contact.backlash),
        ),
        curve("Clearance", "tip to root", "mm", contact.clearance.clone()),
        curve(
            "Clearance",
            "tip to fillet",
            "mm",
            contact.fillet_clearance.clone(),
        ),
        curve(
            "Transmission error",
            "forward",
            "rad",
            contact.transmission_error.clone(),
        ),
        curve(
            "Transmission error",
            "reverse",
            "rad",
            contact.reverse_transmission_error.clone(),
        ),
        curve(
            "Sliding a rad of the driver",
            "",
            "mm",
            contact.sliding.clone(),
        ),
    ]
}
