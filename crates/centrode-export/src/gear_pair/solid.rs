use crate::ExportError;
use centrode_gear::{GearPair, Member};
use centrode_geometry::{Mesh, Solid, Tolerance};

/// A gear as a solid: toothed outline less the bore, from z = 0 to its width.
///
/// # Errors
/// [`ExportError::Solid`] if the width is not positive.
pub fn solid(pair: &GearPair, member: Member) -> Result<Solid, ExportError> {
    let gear = pair.gear(member);
    let holes = gear.bore().into_iter().collect();
    Solid::new(gear.outline().clone(), holes, 0.0, gear.body().width)
        .map_err(ExportError::no_solid(member.name()))
}

/// A gear as a closed triangle mesh.
///
/// # Errors
/// [`ExportError::Solid`] if the flattened outline and bore meet.
pub fn mesh(pair: &GearPair, member: Member, tolerance: Tolerance) -> Result<Mesh, ExportError> {
    solid(pair, member)?
        .mesh(tolerance)
        .map_err(ExportError::no_solid(member.name()))
}
