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

/// Adds the files of both solids; the simulator models show the STL ones.
pub(super) fn add(
    pair: &GearPair,
    wanted: &impl Fn(Format) -> bool,
    options: &Options,
    bundle: &mut Bundle,
) -> Result<(), GearPairFilesError> {
    let stl = wanted(Format::Stl) || wanted(Format::Urdf) || wanted(Format::Mjcf);
    let named = match pair.title() {
        "" => pair.name(),
        title => title,
    };
    for member in [Member::Driver, Member::Driven] {
        let name = member.name();
        let title = format!("{named}: {name} gear");
        if wanted(Format::Step) {
            let file = step::write(&solid(pair, member)?, name, &title)
                .map_err(|source| GearPairFilesError::Step { member, source })?;
            bundle.add(&format!("{name}.step"), file)?;
        }
        if stl || wanted(Format::ThreeMf) {
            let mesh = mesh(pair, member, options.tolerance)?;
            if stl {
                bundle.add(&format!("{name}.stl"), stl::write(&mesh))?;
            }
            if wanted(Format::ThreeMf) {
                bundle.add(&format!("{name}.3mf"), threemf::write(&mesh, name, &title)?)?;
            }
        }
    }
    Ok(())
}
