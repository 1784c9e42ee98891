use super::{Format, GearPairFilesError, Options};
use crate::{Bundle, step, stl, threemf};
use centrode_geometry::{Mesh, Solid, Tolerance};
use centrode_mechanism::gear::{GearPair, Member};

/// A gear as a solid: toothed outline less the bore, from z = 0 to its width.
///
/// # Errors
/// [`GearPairFilesError::Solid`] if the width is not positive.
pub fn solid(pair: &GearPair, member: Member) -> Result<Solid, GearPairFilesError> {
    let gear = pair.gear(member);
    let holes = gear.bore().into_iter().collect();
    Solid::new(gear.outline().clone(), holes, 0.0, gear.body().width)
        .map_err(|source| GearPairFilesError::Solid { member, source })
}

/// A gear as a closed triangle mesh.
///
/// # Errors
/// [`GearPairFilesError::Solid`] if the flattened outline and bore meet.
pub fn mesh(
    pair: &GearPair,
    member: Member,
    tolerance: Tolerance,
) -> Result<Mesh, GearPairFilesError> {
    solid(pair, member)?
        .mesh(tolerance)
        .map_err(|source| GearPairFilesError::Solid { member, source })
}

/// A gear as an exact STEP file, named after the gear.
///
/// # Errors
/// [`GearPairFilesError::Solid`] if the width is not positive, [`GearPairFilesError::Step`] if a contour is
/// too short to be written.
pub fn step_file(pair: &GearPair, member: Member) -> Result<Vec<u8>, GearPairFilesError> {
    step::write(&solid(pair, member)?, member.name(), &title(pair, member))
        .map_err(|source| GearPairFilesError::Step { member, source })
}

/// A gear as a binary STL file in mm.
///
/// # Errors
/// As [`mesh`].
pub fn stl_file(
    pair: &GearPair,
    member: Member,
    tolerance: Tolerance,
) -> Result<Vec<u8>, GearPairFilesError> {
    Ok(stl::write(&mesh(pair, member, tolerance)?))
}

/// A gear as a 3MF package, named after the gear.
///
/// # Errors
/// As [`mesh`], and [`GearPairFilesError::Package`].
pub fn threemf_file(
    pair: &GearPair,
    member: Member,
    tolerance: Tolerance,
) -> Result<Vec<u8>, GearPairFilesError> {
    package(pair, member, &mesh(pair, member, tolerance)?)
}

fn package(pair: &GearPair, member: Member, mesh: &Mesh) -> Result<Vec<u8>, GearPairFilesError> {
    Ok(threemf::write(mesh, member.name(), &title(pair, member))?)
}

/// What a file says it holds: the design, and which of its gears.
fn title(pair: &GearPair, member: Member) -> String {
    let design = match pair.title() {
        "" => pair.name(),
        title => title,
    };
    format!("{design}: {} gear", member.name())
}

/// Adds the files of both solids.
pub(super) fn add(
    pair: &GearPair,
    wanted: &impl Fn(Format) -> bool,
    options: &Options,
    bundle: &mut Bundle,
) -> Result<(), GearPairFilesError> {
    for member in [Member::Driver, Member::Driven] {
        let own = options.members().any(|m| m == member);
        let name = member.name();
        if own && wanted(Format::Step) {
            bundle.add(&format!("{name}.step"), step_file(pair, member)?)?;
        }
        let (stl, packaged) = (own && wanted(Format::Stl), own && wanted(Format::ThreeMf));
        if stl || packaged {
            let mesh = mesh(pair, member, options.tolerance)?;
            if stl {
                bundle.add(&format!("{name}.stl"), stl::write(&mesh))?;
            }
            if packaged {
                bundle.add(&format!("{name}.3mf"), package(pair, member, &mesh)?)?;
            }
        }
    }
    Ok(())
}
