use centrode_geometry::{MassProperties, Solid, SolidError};

use super::{Composed, ComposedGear};

/// What a body is made of.
pub(super) struct Pieces<'a> {
    pub(super) plate: Option<Solid>,
    /// Mass of the plate, or the one given in its place.
    pub(super) mass: Option<MassProperties>,
    pub(super) gears: Vec<GearPiece<'a>>,
}

/// A gear on a body.
pub(super) struct GearPiece<'a> {
    pub(super) gear: &'a ComposedGear,
    pub(super) solid: Solid,
    pub(super) mass: MassProperties,
}

impl Pieces<'_> {
    /// Mass of all of them; none without any.
    pub(super) fn together(&self) -> Option<MassProperties> {
        let gears = self.gears.iter().map(|gear| gear.mass);
        MassProperties::together(&self.mass.into_iter().chain(gears).collect::<Vec<_>>())
    }

    /// Plate and gears.
    pub(super) fn solids(&self) -> Vec<Solid> {
        let gears = self.gears.iter().map(|gear| &gear.solid);
        self.plate.iter().chain(gears).cloned().collect()
    }
}

impl Composed {
    /// Plate, mass and gears of a body.
    pub(super) fn pieces(&self, body: usize) -> Result<Pieces<'_>, SolidError> {
        let name = &self.bodies[body].name;
        let plate = self.plate(body)?;
        let density = self.design.plates.density;
        let own = plate.as_ref().map(|plate| plate.mass_properties(density));
        let height = self.bottom(body) + 0.5 * self.thickness(body);
        let mass = match self.design.bodies.get(name) {
            Some(spec) => spec.given_mass().of(own, height),
            None => own,
        };
        let gears = self.gears.iter().filter(|gear| gear.body_name == *name);
        let gears = gears.map(|gear| {
            let solid = gear.solid(self.gear_bottom(gear))?;
            let mass = solid.mass_properties(gear.gear().body().density);
            Ok(GearPiece { gear, solid, mass })
        });
        Ok(Pieces {
            plate,
            mass,
            gears: gears.collect::<Result<_, SolidError>>()?,
        })
    }
}
