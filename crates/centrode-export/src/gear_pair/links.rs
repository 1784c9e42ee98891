use std::sync::Arc;

use centrode_gear::{Gear, GearPair, Member, Role};
use centrode_geometry::Outline;
use centrode_kinematics::machine::{
    GearMesh, Input, Joint, Line, LineRole, Linear, Link, LinkedMachine, Quantity, Surface,
};
use centrode_kinematics::transmission::Transmission;

use super::{arrangement, solid};
use crate::ExportError;

/// A frame with both gears turning about z, the driver at its origin.
///
/// # Errors
/// [`ExportError`] where a gear is no solid.
pub fn machine(pair: &GearPair) -> Result<LinkedMachine, ExportError> {
    let mut machine = drawn(pair);
    for (link, member) in [(1, Member::Driver), (2, Member::Driven)] {
        embody(&mut machine, link, pair, member, [member.name(); 2])?;
    }
    Ok(machine)
}

/// The machine of a pair with its motion and its drawn lines, without bodies.
#[must_use]
pub fn drawn(pair: &GearPair) -> LinkedMachine {
    let mut machine = LinkedMachine {
        name: pair.name().into(),
        title: pair.title().into(),
        input: Input {
            name: Member::Driver.name().into(),
            period: pair.cycle(),
            speed: 1.0,
        },
        ..LinkedMachine::default()
    };
    let [base, driver, driven] = ["base", Member::Driver.name(), Member::Driven.name()]
        .map(|name| machine.link(Link::new(name)));
    // At the driver's polar angle phi the driver has turned by -phi, the driven gear by its driven angle.
    let law = Linear::new(0.0, -1.0);
    let driving = machine.joint(Joint::turning(base, driver, Arc::new(law)));
    let law: Arc<dyn Transmission> = Arc::new(pair.rolling().clone());
    let at = [pair.center_distance(), 0.0, 0.0];
    let joint = machine.joint(Joint::turning(base, driven, law).at(at));
    machine.meshes.push(GearMesh::new(
        [driver, driven],
        joint,
        pair.pressure_angle(),
    ));
    machine.column(
        "driver_angle_rad",
        "rad",
        "polar angle of the driver's pitch point; the driver has turned by minus this",
        Quantity::rate(driving, 0, -1.0),
    );
    machine.column(
        "driven_angle_rad",
        "rad",
        "angle the driven gear has turned by, counter-clockwise",
        Quantity::joint(joint),
    );
    machine.column(
        "ratio",
        "1",
        "d driven_angle / d driver_angle",
        Quantity::rate(joint, 1, 1.0),
    );
    machine.column(
        "ratio_slope_per_rad",
        "1/rad",
        "d ratio / d driver_angle",
        Quantity::rate(joint, 2, 1.0),
    );
    for (link, member) in [(driven, Member::Driven), (driver, Member::Driver)] {
        let sketch = machine.sketch(member.name(), lines(pair.gear(member)));
        machine.draw(member.name(), link, sketch);
    }
    arrangement::annotate(pair, &mut machine);
    machine
}

/// Outline, bore and pitch curve of a gear, in its own frame.
pub(crate) fn lines(gear: &Gear) -> Vec<Line> {
    lines_within(gear.outline(), gear)
}

/// Lines of a gear with the given outline instead of its own, bore and pitch curve.
pub(crate) fn lines_within(outline: &Outline, gear: &Gear) -> Vec<Line> {
    let mut lines = vec![Line::contour(LineRole::Body, outline)];
    lines.extend(gear.bore().map(|bore| Line::contour(LineRole::Hole, &bore)));
    lines.push(Line::contour(LineRole::Pitch, gear.pitch_curve()));
    lines
}

/// Gives a link the body of a gear; `file` is the name of its files, `name` that of its teeth.
pub(crate) fn embody(
    machine: &mut LinkedMachine,
    link: usize,
    pair: &GearPair,
    member: Member,
    [file, name]: [&str; 2],
) -> Result<(), ExportError> {
    let solid = solid(pair, member)?;
    let gear = pair.gear(member);
    let surface = machine.surface(teeth(gear, name));
    let mass = solid.mass_properties(gear.body().density);
    let shape = machine.solids(&format!("{file}-body"), file, vec![solid]);
    let link = &mut machine.links[link];
    link.mass = Some(mass);
    link.shape = Some(shape);
    link.surfaces = vec![surface];
    Ok(())
}

/// The teeth of a gear: flanks and tips touch, fillets do not.
fn teeth(gear: &Gear, name: &str) -> Surface {
    let touches =
        |(role, owner): (&Role, &u32)| matches!(role, Role::Flank | Role::Tip).then_some(*owner);
    Surface {
        teeth: gear
            .roles()
            .iter()
            .zip(gear.owners())
            .map(touches)
            .collect(),
        ..Surface::new(name, gear.outline().clone(), [0.0, gear.body().width])
    }
}
