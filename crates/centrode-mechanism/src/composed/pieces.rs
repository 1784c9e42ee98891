use centrode_geometry::{MassProperties, Solid, SolidError};

use super::{Composed, ComposedCam, ComposedGear};

/// Pieces of which a body is made.
pub(super) struct Pieces<'a> {
    pub(super) plate: Option<Solid>,
    /// Mass of the plate, or the one given in its place.
    pub(super) mass: Option<MassProperties>,
    pub(super) gears: Vec<BodyPiece<'a, ComposedGear>>,
    pub(super) cams: Vec<BodyPiece<'a, ComposedCam>>,
}

/// A gear or a cam on a body.
pub(super) struct BodyPiece<'a, T> {
    pub(super) of: &'a T,
    pub(super) solid: Solid,
    pub(super) mass: MassProperties,
}

impl Pieces<'_> {
    /// Mass of all of them; none without any.
    pub(super) fn together(&self) -> Option<MassProperties> {
        let gears = self.gears.iter().map(|gear| gear.mass);
        let cams = self.cams.iter().map(|cam| cam.mass);
        let all = self.mass.into_iter().chain(gears).chain(cams);
        MassProperties::together(&all.collect::<Vec<_>>())
    }

    /// Plate, gears and cams.
    pub(super) fn solids(&self) -> Vec<Solid> {
        let gears = self.gears.iter().map(|gear| &gear.solid);
        let cams = self.cams.iter().map(|cam| &cam.solid);
        self.plate
            .iter()
            .chain(gears)
            .chain(cams)
            .cloned()
            .collect()
    }
}

impl Composed {
    /// Plate, mass, gears and cams of a body.
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
            Ok(BodyPiece {
                of: gear,
                solid,
                mass,
            })
        });
        let cams = self.cams.iter().filter(|cam| cam.body_name == *name);
        let cams = cams.map(|cam| {
            let solid = cam.solid(self.cam_bottom(cam))?;
            let mass = solid.mass_properties(cam.part.body().density);
            Ok(BodyPiece {
                of: cam,
                solid,
                mass,
            })
        });
        Ok(Pieces {
            plate,
            mass,
            gears: gears.collect::<Result<_, SolidError>>()?,
            cams: cams.collect::<Result<_, SolidError>>()?,
        })
    }
}
