use centrode_gear::IntermittentPair;
use centrode_kinematics::machine::{LinkedMachine, Quantity};
use centrode_machines::feeder::{Feeder, FeederPart, Plate};

use super::plates::spacer;
use super::{arrangement, figures};
use crate::ExportError;

/// The links as a tree. Every joint is zero while the effector rests, and the loops close at C. The gears are drawn with teeth if
/// a pair is given, otherwise by their pitch and tip circles.
pub(super) fn drawn(
    feeder: &Feeder,
    plates: &[Plate],
    gears: Option<&IntermittentPair>,
) -> LinkedMachine {
    let mut machine = feeder.links(feeder.design().drive.carried_mass);
    let meaning =
        "angle the intermittent gear has turned by since the effector left its place of rest";
    machine.input_columns(meaning);
    for part in FeederPart::ALL
        .into_iter()
        .filter(|part| part.carrier().is_some())
    {
        let (unit, meaning) = meaning_of(part);
        let name = format!("{}_joint_{unit}", part.name());
        machine.column(&name, unit, meaning, Quantity::joint(part.joint()));
    }
    tip(feeder, &mut machine);
    figures::draw(feeder, plates, gears, &mut machine);
    machine
}

/// The links with their bodies.
///
/// Gears that cannot be cut are omitted: the six-bar moves without them.
pub(super) fn machine(feeder: &Feeder, plates: &[Plate]) -> Result<LinkedMachine, ExportError> {
    let mut machine = drawn(feeder, plates, None);
    let mounted = feeder.mount_gears(&mut machine);
    mounted.map_err(ExportError::no_solid("gears"))?;
    for plate in plates {
        let name = plate.part.name();
        let bodies = feeder.bodies(plate);
        let (solids, mass) = bodies.map_err(ExportError::no_solid(name))?;
        let shape = machine.solids(&format!("links/{name}"), "", solids);
        let link = &mut machine.links[plate.part.link()];
        link.mass = Some(mass);
        link.shape = Some(shape);
    }
    let screws = feeder.frame_screws().and_then(Result::ok);
    if let (Some(screws), Some(spacer)) = (screws, spacer(feeder)) {
        let bottom = screws.faces[0] + screws.plate;
        let at = screws.at.iter().map(|at| [at.x, at.y, bottom]);
        let at: Vec<[f64; 3]> = at.collect();
        let pieces = spacer.pieces(&mut machine, ["links/spacer", ""], &at)?;
        for (body, own) in pieces {
            machine.mount_body(FeederPart::Frame.link(), body, Some(own));
        }
    }
    // Shafts and pins add to the masses of the plates.
    arrangement::annotate(feeder, plates, &mut machine);
    Ok(machine)
}

fn meaning_of(part: FeederPart) -> (&'static str, &'static str) {
    match part {
        FeederPart::Frame => ("rad", ""),
        FeederPart::Crank => (
            "rad",
            "crank against the frame, counter-clockwise since it rested",
        ),
        FeederPart::Coupler => ("rad", "coupler against the crank"),
        FeederPart::Rocker => ("rad", "rocker against the frame"),
        FeederPart::Effector => ("rad", "effector against the frame"),
        FeederPart::Slider => ("mm", "slider along the effector, outwards"),
    }
}

/// Adds columns for the position and the speed of the effector's tip.
fn tip(feeder: &Feeder, machine: &mut LinkedMachine) {
    let meaning = "tip E of the effector, from the crank's shaft";
    for (axis, name) in ["tip_x_mm", "tip_y_mm"].into_iter().enumerate() {
        let quantity = Quantity::Point { point: 0, axis };
        machine.column(name, "mm", meaning, quantity);
    }
    let factor = feeder.speed();
    let speed = Quantity::PointSpeed { point: 0, factor };
    let meaning = "speed of the tip at the design's speed";
    machine.column("tip_speed_mm_per_s", "mm/s", meaning, speed);
}
