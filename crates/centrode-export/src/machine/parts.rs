use centrode_geometry::Solid;
use centrode_kinematics::machine::{LinkedMachine, Stock};
use centrode_machines::PinHole;
use centrode_machines::machine::{Hardware, Machine};

use super::plates;
use crate::gear_pair::{self, Label};
use crate::plate::{Hole, Plate, hold_apart};
use crate::{ExportError, Package, cam, turned};
use crate::{fit, number::capital};

/// Offers plates, gears and cams; copies have the files of their originals.
pub(super) fn add(
    package: &mut Package<'_>,
    composed: &Machine,
    machine: &LinkedMachine,
) -> Result<(), ExportError> {
    let drawing = &composed.design().drawing;
    let is_copy = |name: &String| composed.original(name) != name;
    let quantity = |name: &str| {
        let part = machine.parts.iter().find(|part| part.name == name);
        part.map_or(1, |part| part.quantity())
    };
    for (index, body) in composed.bodies().iter().enumerate() {
        if is_copy(&body.name) {
            continue;
        }
        let plate = plate(composed, machine, index, quantity(&body.name));
        let top = plate.as_ref().filter(|_| index == 0);
        let top = top.and_then(|plate| top_plate(composed, machine, plate));
        for plate in plate.into_iter().chain(top) {
            plate.add(package, drawing)?;
        }
    }
    if composed.design().hardware() == Hardware::Full {
        turned::add(composed.turned(), package, drawing)?;
    }
    for gear in composed.gears().iter().filter(|gear| !is_copy(&gear.name)) {
        let label = Label {
            name: &gear.name,
            title: &capital(&gear.name),
            mate: &mates(composed, &gear.name),
            machine: package.design(),
            drawing,
            quantity: quantity(&gear.name),
        };
        gear_pair::add_gear(package, &gear.pair, gear.member, label)?;
    }
    for part in composed.cams().iter().filter(|cam| !is_copy(&cam.name)) {
        let (title, tolerance) = (package.titled(&part.name), package.tolerance());
        let (name, quantity) = (&part.name, quantity(&part.name));
        let plate = cam::plate(&part.part, name, &capital(name), quantity);
        plate.add_sheets(package, drawing)?;
        cam::add(package, &part.part, &title, tolerance)?;
    }
    Ok(())
}

/// A body as a plate; `None` for one without a contour.
fn plate(
    composed: &Machine,
    machine: &LinkedMachine,
    body: usize,
    quantity: usize,
) -> Option<Plate> {
    let spec = &composed.design().plates;
    // A link's plate is the first of its solids, if it has one: then it is a part.
    let name = &composed.bodies()[body].name;
    machine.parts.iter().find(|part| part.name == *name)?;
    let solid = plates(machine, body).first()?;
    let pins = composed.pin_holes(body)?;
    let [guide, block] = Machine::GUIDE_FIT;
    let guided = composed.guided(body);
    let mut holes = holes(composed, body, solid, pins);
    for pair in composed.carried_pairs(body) {
        if let Some(off) = gear_pair::half_backlash(pair, pair.backlash()) {
            hold_apart(&mut holes, pair.center_distance(), off);
        }
    }
    let axes = "x and y are the body's axes in the design.".to_owned();
    let slides = match (guided, composed.slotted(body)) {
        (Some(_), Some(guide)) => Some(format!(
            "Slides along x in the slot of {}.",
            composed.bodies()[guide].name
        )),
        (Some(height), None) => {
            let guide = fit::keyway(height, guide);
            Some(format!(
                "Slides along x in a guide of {guide}, which is the customer's."
            ))
        }
        (None, _) => None,
    };
    let (outline, thickness) = (solid.outline().clone(), composed.thickness(body));
    let stock = Stock::new(&spec.material, spec.density).treated(&spec.heat_treatment);
    Some(Plate {
        quantity,
        holes,
        notes: std::iter::once(axes).chain(slides).collect(),
        classes: [guided.map_or("", |_| block).into(), String::new()],
        ..Plate::new(name, &capital(name), outline, thickness, stock)
    })
}

/// Holes of a plate: those of pins and shafts, then those of the screws of a frame, or slots.
fn holes(composed: &Machine, body: usize, solid: &Solid, pins: Vec<PinHole>) -> Vec<Hole> {
    let [guide, _] = Machine::GUIDE_FIT;
    let slots = composed.slots(body);
    let own_slots = solid.holes().get(pins.len()..).unwrap_or_default();
    let own_slots = own_slots.iter().zip(slots).map(|(outline, slot)| Hole {
        label: composed.bodies()[slot.block].name.clone(),
        fit: guide.into(),
        ..Hole::from(outline.clone())
    });
    let bored = solid.holes().iter().zip(&pins);
    let bored = bored.map(|(outline, pin)| Hole::of_pin(outline.clone(), pin));
    let screws = composed.frame_screws().filter(|_| body == 0);
    bored
        .chain(own_slots)
        .chain(screws.into_iter().flat_map(Hole::clearance))
        .collect()
}

/// The upper plate of a frame of two plates.
fn top_plate(composed: &Machine, machine: &LinkedMachine, lower: &Plate) -> Option<Plate> {
    composed.frame_screws()?;
    let solid = plates(machine, 0).get(1)?;
    Some(Plate {
        name: Machine::FRAME_TOP.into(),
        title: "Frame, upper plate".into(),
        outline: solid.outline().clone(),
        holes: holes(composed, 0, solid, composed.top_holes()),
        ..lower.clone()
    })
}

/// Names of the gears that a gear meshes with; copies have those of their originals.
fn mates(composed: &Machine, gear: &str) -> String {
    let mates = composed.mates(gear).into_iter();
    let mut names: Vec<&str> = mates.map(|mate| composed.original(&mate.name)).collect();
    names.dedup();
    names.join(" and ")
}
