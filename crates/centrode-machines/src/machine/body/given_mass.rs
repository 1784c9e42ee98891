//! Masses of bodies that the design gives. Otherwise a mass follows from the plate.

use centrode_geometry::{MassProperties, Point};
use nalgebra::{Matrix3, Point3};

use centrode_spec::SpecError;
use centrode_spec::rule::{Rule, broken, finite, positive};

/// Mass of a body as the design file gives it.
#[derive(Clone, Copy, Debug)]
pub(in crate::machine) struct GivenMass {
    pub(in crate::machine) mass: Option<f64>,
    pub(in crate::machine) center: Option<[f64; 2]>,
    pub(in crate::machine) inertia: Option<f64>,
}

impl GivenMass {
    /// Checks the mass of a body; `has_plate`: whether the body has a plate.
    pub(in crate::machine) fn validate(&self, has_plate: bool) -> Result<(), SpecError> {
        let Some(mass) = self.mass else {
            let beside = [
                ("center", self.center.is_some()),
                ("inertia_kg_mm2", self.inertia.is_some()),
            ];
            return match beside.into_iter().find(|(_, given)| *given) {
                Some((key, _)) => broken(key, Rule::Unused("without mass_kg")),
                None => Ok(()),
            };
        };
        positive("mass_kg", mass)?;
        for x in self.center.iter().flatten() {
            finite("center", *x)?;
        }
        match self.inertia {
            Some(inertia) => positive("inertia_kg_mm2", inertia),
            None if has_plate => Ok(()),
            None => broken(
                "inertia_kg_mm2",
                Rule::Needed("with mass_kg for a body without a plate"),
            ),
        }
    }

    /// Mass of a body with a plate whose middle is at `height`, mm: given values replace those of the plate.
    ///
    /// A given moment of inertia is halved for the axes in the plane, as for a disc; planar motion does not need these values.
    pub(in crate::machine) fn of(
        &self,
        plate: Option<MassProperties>,
        height: f64,
    ) -> Option<MassProperties> {
        let Some(mass) = self.mass else {
            return plate;
        };
        let origin = Point::origin();
        let center = self.center.map_or_else(
            || plate.map_or(origin, |plate| plate.center.xy()),
            Point::from,
        );
        let inertia = match (self.inertia, plate) {
            (Some(about), _) => Matrix3::from_diagonal(&[0.5 * about, 0.5 * about, about].into()),
            (None, Some(plate)) => plate.inertia * (mass / plate.mass),
            (None, None) => return None,
        };
        Some(MassProperties {
            mass,
            center: Point3::new(center.x, center.y, height),
            inertia,
        })
    }
}
