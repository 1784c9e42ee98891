//! The files of a feeder: its links as plates, a simulator model, and its motion.

mod arrangement;
mod curves;
mod figures;
mod gears;
mod links;
mod pins;
mod plates;

use crate::package::title_or_name;
use crate::{ExportError, Options, Package, turned};
use centrode_formats::{Bundle, Format};
use centrode_gear::IntermittentPair;
use centrode_kinematics::machine::LinkedMachine;
use centrode_machines::feeder::{Feeder, FeederError, FeederPart, Plate};
pub use curves::curves;
pub use plates::assembly;

impl From<FeederError> for ExportError {
    fn from(error: FeederError) -> Self {
        Self::missing(error)
    }
}

/// The six-bar as links and joints.
///
/// # Errors
/// [`ExportError`] where a link cannot be cut from plate.
pub fn machine(feeder: &Feeder) -> Result<LinkedMachine, ExportError> {
    links::machine(feeder, &cut(feeder)?)
}

/// The six-bar with its motion and its drawn lines, without bodies. The gears have teeth if a pair is given; otherwise they are
/// circles, and no teeth are cut. Links that make no plate are not drawn.
#[must_use]
pub fn drawn(feeder: &Feeder, gears: Option<&IntermittentPair>) -> LinkedMachine {
    let plates = FeederPart::ALL
        .into_iter()
        .filter_map(|part| feeder.screwed(feeder.plate(part).ok()?).ok());
    links::drawn(feeder, &plates.collect::<Vec<_>>(), gears)
}

/// Every part as a plate.
fn cut(feeder: &Feeder) -> Result<Vec<Plate>, FeederError> {
    let plates = FeederPart::ALL.into_iter();
    let plates = plates.map(|part| feeder.screwed(feeder.plate(part)?));
    plates.collect()
}

/// The files of a feeder in the requested formats, not yet on disk.
///
/// Each link is a plate with holes for pins (the effector also with a slot), named after the link; `assembly` is the six-bar at
/// rest. The intermittent gears are parts, too: `gear-driver`, `gear-driven`, the cams `gear-entry-cam` and `gear-exit-cam`, and
/// `gears` shows them assembled. MJCF closes the loops of the linkage by equality constraints; URDF, which has no loops, leaves
/// them open and states this. Both come with their solids in a folder `links` and the motion of every joint.
///
/// # Errors
/// [`ExportError`], for instance for an effector whose slot runs into its pivot.
pub fn files(
    feeder: &Feeder,
    formats: &[Format],
    options: &Options,
) -> Result<Bundle, ExportError> {
    let design = feeder.design();
    let plates = cut(feeder)?;
    let (name, title) = (&design.name, &design.title);
    let mut package = Package::new("a feeder", name, title, formats, options);
    for part in &plates {
        plates::made(feeder, part).add(&mut package, &design.drawing)?;
    }
    if let Some(spacer) = plates::spacer(feeder) {
        spacer.add(&mut package, &design.drawing)?;
    }
    turned::add(&feeder.turned(&plates), &mut package, &design.drawing)?;
    package.drawing("assembly", |_| Ok(assembly(feeder, &plates)))?;
    add_gears(&mut package, feeder)?;
    package.machine(|| links::machine(feeder, &plates))?;
    package.finish()
}

/// Formats that show a part.
const PARTS: [Format; 8] = [
    Format::Dxf,
    Format::Svg,
    Format::Sheet,
    Format::Pdf,
    Format::Step,
    Format::Stl,
    Format::ThreeMf,
    Format::Csv,
];

/// Offers the intermittent gears. They take long to cut, so only if a requested format shows parts or parts are selected.
fn add_gears(package: &mut Package<'_>, feeder: &Feeder) -> Result<(), ExportError> {
    if !package.wants(&PARTS) && package.options().parts.is_none() {
        return Ok(());
    }
    let pair = feeder.gears()?;
    let parts = gears::parts(feeder, &pair, package.tolerance());
    for part in &parts {
        part.add(package, &feeder.design().drawing)?;
        package.points(&part.name, &part.name, || gears::columns(part))?;
    }
    package.drawing("gears", |_| Ok(gears::assembly(&pair, &parts)))
}

fn named(feeder: &Feeder) -> &str {
    title_or_name(&feeder.design().title, &feeder.design().name)
}
