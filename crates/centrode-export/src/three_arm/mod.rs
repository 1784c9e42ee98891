//! The files of a three-arm mechanism.

mod arrangement;
mod assembly;
mod bodies;
mod contacts;
mod curves;
mod figures;
mod limbs;
mod links;
mod machine;
mod part;
mod pieces;
mod pushed;
mod surroundings;

use crate::gear_pair::{self, Label};
use crate::{ExportError, Options, Package, cam, turned};
use centrode_formats::{Bundle, Format};
use centrode_gear::GearPair;
use centrode_kinematics::machine::LinkedMachine;
use centrode_machines::arm::ArmError;
use centrode_machines::three_arm::{PusherError, ThreeArm};
use centrode_spec::DrawingSpec;
pub use contacts::contacts;
pub use curves::{arm_curves, curves};
use machine::Parts;
pub use part::ThreeArmPart;

impl From<ArmError> for ExportError {
    fn from(error: ArmError) -> Self {
        Self::missing_at("arm.body", error)
    }
}

impl From<PusherError> for ExportError {
    fn from(error: PusherError) -> Self {
        Self::missing_at(error.key(), error)
    }
}

/// The mechanism as links and joints.
///
/// # Errors
/// [`ExportError`] where a part does not exist.
pub fn machine(mechanism: &ThreeArm) -> Result<LinkedMachine, ExportError> {
    linked(&Parts::new(mechanism)?)
}

/// The mechanism with its motion and its drawn lines, without bodies. The gears have teeth if a pair is given; otherwise pitch
/// and tip curves are drawn, and no teeth are cut.
///
/// # Errors
/// [`ExportError`] where a part does not exist.
pub fn drawn(mechanism: &ThreeArm, teeth: Option<&GearPair>) -> Result<LinkedMachine, ExportError> {
    links::machine(mechanism, None, teeth)
}

fn linked(machine: &Parts<'_>) -> Result<LinkedMachine, ExportError> {
    links::machine(machine.mechanism, Some(machine), Some(&machine.pairs[0]))
}

/// The files of a mechanism's parts in the requested formats, not yet on disk: each part once, however many
/// there are. URDF and MJCF are of the whole machine, with the STL files they show, the laws of motion and
/// a script that plays them.
///
/// # Errors
/// [`ExportError`] where a part does not exist or a format cannot hold it.
pub fn files(
    mechanism: &ThreeArm,
    formats: &[Format],
    options: &Options,
) -> Result<Bundle, ExportError> {
    let (machine, tolerance) = (Parts::new(mechanism)?, options.tolerance);
    let design = mechanism.design();
    let (name, title) = (&design.name, &design.title);
    let mut package = Package::new("a three-arm mechanism", name, title, formats, options);
    package.finer_than(machine.pairs[0].module(), "module")?;
    for part in ThreeArmPart::ALL {
        if let Some((pair, member)) = machine.gear(part) {
            let label = label(part, mechanism.arms(), &design.drawing, package.design());
            gear_pair::add_gear(&mut package, pair, member, label)?;
        } else if let Some(plate) = machine.made(part) {
            plate.add(&mut package, &design.drawing)?;
        }
    }
    turned::add(&machine.turned(), &mut package, &design.drawing)?;
    let cam = machine.pusher.cam();
    package.points(ThreeArmPart::Cam.name(), "cam", || {
        cam::columns(cam, cam::ROWS)
    })?;
    package.drawing(ThreeArmPart::Assembly.name(), |_| {
        Ok(assembly::drawing(&machine, tolerance))
    })?;
    package.machine(|| linked(&machine))?;
    package.finish()
}

/// Names for the sheets of a gear.
fn label<'a>(
    part: ThreeArmPart,
    arms: u32,
    drawing: &'a DrawingSpec,
    machine: &'a str,
) -> Label<'a> {
    Label {
        name: part.name(),
        title: part.title(),
        mate: match part {
            ThreeArmPart::Intermediate => "sun and planet",
            _ => ThreeArmPart::Intermediate.name(),
        },
        machine,
        drawing,
        quantity: part.quantity(arms) as usize,
    }
}

#[cfg(test)]
mod tests;
