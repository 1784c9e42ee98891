//! New gear pairs.

use centrode_gear::GearPair;
use centrode_geometry::Vector;
use centrode_machines::machine::Machine;
use serde_json::json;

use super::adding::{degrees, numbers};
use super::scene::{Scene, clicked, line};
use super::writing::{digits, put};
use super::{Composed, Place, Refusal, naming};

/// Modules of series 1 of ISO 54, mm.
const MODULES: [f64; 17] = [
    0.5, 0.6, 0.8, 1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 16.0, 20.0,
];
/// Number of teeth near which a pair of two equal gears is easy to make.
const TEETH: f64 = 31.0;
/// Minimum number of teeth: fewer are undercut.
const FEWEST: f64 = 18.0;

/// Pitch curve of a new pair of equal gears.
pub(super) struct Curve {
    keys: String,
}

impl Curve {
    pub(super) fn new(word: &str, eccentricity: Option<f64>) -> Result<Self, Box<Refusal>> {
        match word {
            "circle" => Ok(Self {
                keys: "kind = \"circle\"".into(),
            }),
            "ellipse" => Ok(Self {
                keys: format!(
                    "kind = \"ellipse\", eccentricity = {}",
                    eccentricity.unwrap_or(0.3)
                ),
            }),
            _ => Err(Box::new(Refusal::because(format!(
                "there is no pitch curve {word}: circle or ellipse"
            )))),
        }
    }

    fn pitch(&self, module: f64, teeth: f64) -> String {
        format!(
            "{{ {}, module = {module}, tooth_count = {teeth} }}",
            self.keys
        )
    }

    /// Distance of the axes for a module of 1 mm, per tooth.
    fn distance_per_tooth(&self) -> Result<f64, Box<Refusal>> {
        let text = format!("pitch = {}", self.pitch(1.0, TEETH));
        let wrong = |why: String| Box::new(Refusal::because(why));
        let design = toml::from_str(&text).map_err(|error| wrong(error.to_string()))?;
        let pair = GearPair::cached(&design).map_err(|error| wrong(error.to_string()))?;
        Ok(pair.center_distance() / TEETH)
    }
}

/// Two equal gears: one on a body that turns, the other on a new body whose axis is where it was clicked, nearly.
///
/// The module is of the preferred series. The second axis is then at the distance of the pair, in the clicked direction.
pub(super) fn gears(
    mut scene: Scene,
    on: &str,
    at: Option<Place>,
    curve: &Curve,
    [module, teeth, angle]: [Option<f64>; 3],
) -> Result<Composed, Box<Refusal>> {
    let index = scene.body(on)?;
    let mount = scene.machine.as_deref().map(Machine::bodies);
    let mount = mount.and_then(|bodies| bodies[index].mount.as_ref());
    let carrier = mount.map(|mount| mount.carrier);
    let Some(carrier) = carrier.filter(|_| index > 0) else {
        let why = format!("{on} does not turn on another body: choose a body that turns");
        return Err(Box::new(Refusal::because(why)));
    };
    let carrier_name = scene.machine.as_deref().map(Machine::bodies);
    let carrier_name = carrier_name.map_or_else(String::new, |all| all[carrier].name.clone());
    let axis = scene.origin(index);
    let missing = "module, teeth and angle";
    let angle = match angle {
        Some(angle) => angle.to_radians(),
        None => {
            let way = clicked(at, missing)? - axis;
            way.y.atan2(way.x)
        }
    };
    let per_tooth = curve.distance_per_tooth()?;
    let (module, teeth) = match (module, teeth) {
        (Some(module), Some(teeth)) => (module, teeth),
        (module, teeth) => {
            let distance = (clicked(at, missing)? - axis).norm();
            fitting(distance / per_tooth, module, teeth)
        }
    };
    let direction = degrees(angle - scene.angle(carrier));
    let name = |word: &str| naming::part(&scene.design, word);
    let (body, pair, driver) = (name("wheel"), name("drive"), name("pinion"));
    let driven = name("gear");
    let pitch = curve.pitch(module, teeth);
    let role =
        |role: &str, on: &str| format!("pair = \"{pair}\"\nrole = \"{role}\"\non = \"{on}\"\n");
    let mesh =
        format!("{{ gear = \"{driven}\", with = \"{driver}\", direction_deg = {direction} }}");
    let document = &mut scene.document;
    put(
        document,
        "bodies",
        &body,
        &format!("on = \"{carrier_name}\"\nmesh = {mesh}\n"),
    )?;
    put(document, "pairs", &pair, &format!("pitch = {pitch}\n"))?;
    put(document, "gears", &driver, &role("driver", on))?;
    put(document, "gears", &driven, &role("driven", &body))?;
    scene.reread();
    let second = axis + Vector::new(angle.cos(), angle.sin()) * (per_tooth * module * teeth);
    let part = Composed {
        numbers: numbers([
            ("module", module.into()),
            ("teeth", json!(teeth)),
            ("angle_deg", degrees(angle).into()),
        ]),
        lines: vec![line(axis, second)],
        ..Composed::default()
    };
    scene.finish(&format!("bodies.{body}"), part)
}

/// Module and number of teeth whose product is nearest to a size, mm, with a module of the series if none is given.
fn fitting(size: f64, module: Option<f64>, teeth: Option<f64>) -> (f64, f64) {
    if let Some(teeth) = teeth {
        return (digits(size / teeth), teeth);
    }
    let whole = |module: f64| (size / module).round().max(3.0);
    if let Some(module) = module {
        return (module, whole(module));
    }
    // Of the modules with enough teeth, the one with the number of teeth nearest to the usual one.
    let off = |module: &f64| (size / module / TEETH).ln().abs();
    let enough = MODULES.iter().filter(|module| size / *module >= FEWEST);
    let found = enough.min_by(|a, b| off(a).total_cmp(&off(b)));
    let module = found.copied().unwrap_or_else(|| digits(size / TEETH));
    (module, whole(module))
}
