use centrode::analysis::Contact;
use centrode::export::gear_pair;
use centrode::export::page::{Curve, Handle, HandlePlane, Picture};
use centrode::geometry::Tolerance;
use centrode::mechanism::design::Design;
use centrode::mechanism::gear::GearPair;
use centrode::mechanism::gear::design::GearPairDesign;
use centrode::mechanism::gear::pitch::{PitchSpec, Plane};

/// Tolerance of the picture, as a share of the module: a tenth of a pixel when a tooth is as high as a hand.
const DRAWN: f64 = 2e-3;

/// Most points of a pitch curve that get a handle each: more would hide the curve.
const MOST_HANDLES: usize = 60;

/// The pair in a line.
pub(super) fn definition(pair: &GearPair) -> String {
    let (driver, driven) = pair.mean_ratio();
    format!("{}; mean ratio {driver}:{driven}", pair.definition())
}

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
        picture.handles = handles(design, pair, link);
    }
    picture
}

/// The points of the pitch curve.
fn handles(design: &GearPairDesign, pair: &GearPair, link: usize) -> Vec<Handle> {
    let (plane, first, second): (_, &[f64], &[f64]) = match &design.pitch {
        PitchSpec::Bspline(s) if s.plane == Plane::Polar => {
            (HandlePlane::Polar, &s.radius, &s.angle)
        }
        PitchSpec::Bspline(s) => (HandlePlane::Cartesian, &s.x, &s.y),
        PitchSpec::Bezier(s) if s.plane == Plane::Polar => {
            (HandlePlane::Polar, &s.radius, &s.angle)
        }
        PitchSpec::Bezier(s) => (HandlePlane::Cartesian, &s.x, &s.y),
        PitchSpec::Polar(s) => (HandlePlane::Polar, &s.radius, &s.angle),
        _ => return Vec::new(),
    };
    if first.len() > MOST_HANDLES {
        return Vec::new();
    }
    let scale = scale(design, pair);
    let turn = std::f64::consts::TAU / first.len() as f64;
    let handle = |(i, &a): (usize, &f64)| {
        let (keys, b) = match plane {
            HandlePlane::Cartesian => (["x", "y"], second.get(i).copied()),
            // A table without angles has equal steps.
            HandlePlane::Polar if second.is_empty() => (["radius", ""], Some(turn * i as f64)),
            HandlePlane::Polar => (["radius", "angle_deg"], second.get(i).copied()),
        };
        let b = match plane {
            HandlePlane::Cartesian => b?,
            HandlePlane::Polar => degrees(b?),
        };
        Some(Handle {
            name: format!("point {} of the pitch curve", i + 1),
            link,
            plane,
            keys: keys.map(|key| {
                if key.is_empty() {
                    String::new()
                } else {
                    format!("pitch.{key}[{i}]")
                }
            }),
            values: [a, b],
            scale,
        })
    };
    first.iter().enumerate().filter_map(handle).collect()
}

/// The angle in degrees, without the noise of its way through radians.
fn degrees(radians: f64) -> f64 {
    (radians.to_degrees() * 1e10).round() / 1e10
}

/// By how much module and tooth count scale the curve as written.
fn scale(design: &GearPairDesign, pair: &GearPair) -> f64 {
    let mut unscaled = design.pitch.clone();
    let (module, tooth_count) = match &mut unscaled {
        PitchSpec::Bspline(s) => (s.module.take(), s.tooth_count),
        PitchSpec::Bezier(s) => (s.module.take(), s.tooth_count),
        PitchSpec::Polar(s) => (s.module.take(), s.tooth_count),
        _ => (None, None),
    };
    if module.is_none() || tooth_count.is_none() {
        return 1.0;
    }
    let own = unscaled.resolve().ok().and_then(|pitch| pitch.module);
    own.map_or(1.0, |own| pair.module() / own)
}

/// What running the finished gears together says along the cycle.
pub(super) fn contact_curves(contact: &Contact) -> Vec<Curve> {
    let curve = |chart, name, unit, value: Vec<f64>| Curve {
        chart,
        name,
        unit,
        input: contact.input.clone(),
        value,
    };
    let degrees = |list: &[f64]| list.iter().map(|v| v.to_degrees()).collect::<Vec<_>>();
    vec![
        curve(
            "Contacts at once",
            "",
            "",
            contact.contacts.iter().map(|&n| f64::from(n)).collect(),
        ),
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
