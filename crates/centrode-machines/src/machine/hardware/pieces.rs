use std::cell::OnceCell;

use centrode_geometry::{MassProperties, Solid, SolidError};

use crate::machine::{Machine, MachineCam, MachineGear};

/// Pieces of a body.
pub(in crate::machine) struct Pieces<'a> {
    pub(in crate::machine) plate: Option<Solid>,
    /// Upper plate of the frame.
    pub(in crate::machine) top: Option<Solid>,
    composed: &'a Machine,
    body: usize,
    mass: OnceCell<Option<MassProperties>>,
    pub(in crate::machine) gears: Vec<BodyPiece<'a, MachineGear>>,
    pub(in crate::machine) cams: Vec<BodyPiece<'a, MachineCam>>,
}

/// A gear or a cam on a body.
pub(in crate::machine) struct BodyPiece<'a, T> {
    pub(in crate::machine) of: &'a T,
    pub(in crate::machine) solid: Solid,
    density: f64,
    mass: OnceCell<MassProperties>,
}

impl<'a, T> BodyPiece<'a, T> {
    fn new(of: &'a T, solid: Solid, density: f64) -> Self {
        Self {
            of,
            solid,
            density,
            mass: OnceCell::new(),
        }
    }

    /// Mass of the piece, computed at the first call.
    pub(in crate::machine) fn mass(&self) -> MassProperties {
        let weighed = || self.solid.mass_properties(self.density);
        *self.mass.get_or_init(weighed)
    }
}

impl Pieces<'_> {
    /// Mass of the plate, or the given mass instead, computed at the first call.
    pub(in crate::machine) fn mass(&self) -> Option<MassProperties> {
        let weighed = || {
            let design = &self.composed.design;
            let plate = self.plate.as_ref();
            let own = plate.map(|plate| plate.mass_properties(design.plates.density));
            let height = self.composed.bottom(self.body) + 0.5 * self.composed.thickness(self.body);
            match design.bodies.get(&self.composed.bodies[self.body].name) {
                Some(spec) => spec.given_mass().of(own, height),
                None => own,
            }
        };
        *self.mass.get_or_init(weighed)
    }

    /// Mass of all pieces; `None` if there are none.
    pub(in crate::machine) fn together(&self) -> Option<MassProperties> {
        let gears = self.gears.iter().map(BodyPiece::mass);
        let cams = self.cams.iter().map(BodyPiece::mass);
        let density = self.composed.design.plates.density;
        let top = self.top.iter().map(|top| top.mass_properties(density));
        let all = self.mass().into_iter().chain(top).chain(gears).chain(cams);
        MassProperties::combined(&all.collect::<Vec<_>>())
    }

    /// Plates, gears and cams.
    pub(in crate::machine) fn solids(&self) -> Vec<Solid> {
        let gears = self.gears.iter().map(|gear| &gear.solid);
        let cams = self.cams.iter().map(|cam| &cam.solid);
        self.plate
            .iter()
            .chain(&self.top)
            .chain(gears)
            .chain(cams)
            .cloned()
            .collect()
    }
}

impl Machine {
    /// Plate, mass, gears and cams of a body.
    pub(in crate::machine) fn pieces(&self, body: usize) -> Result<Pieces<'_>, SolidError> {
        let name = &self.bodies[body].name;
        let plate = self.plate(body)?;
        let top = match body {
            0 => self.top_plate()?,
            _ => None,
        };
        let gears = self.gears.iter().filter(|gear| gear.body_name == *name);
        let gears = gears.map(|gear| {
            let solid = gear.solid(self.gear_bottom(gear))?;
            Ok(BodyPiece::new(gear, solid, gear.gear().body().density))
        });
        let cams = self.cams.iter().filter(|cam| cam.body_name == *name);
        let cams = cams.map(|cam| {
            let solid = cam.solid(self.cam_bottom(cam))?;
            Ok(BodyPiece::new(cam, solid, cam.part.body().density))
        });
        Ok(Pieces {
            plate,
            top,
            composed: self,
            body,
            mass: OnceCell::new(),
            gears: gears.collect::<Result<_, SolidError>>()?,
            cams: cams.collect::<Result<_, SolidError>>()?,
        })
    }
}
