use centrode_geometry::MassProperties;
use centrode_kinematics::machine::{Form, Mounted, Shape};

use super::links::Builder;
use crate::ExportError;
use crate::plate::Plate;

/// Bodies to be mounted, each with its mass.
pub(super) type Pieces = Vec<(Mounted, MassProperties)>;

impl Builder<'_> {
    /// A plate as a body to be mounted at positions, mm.
    pub(super) fn pieces(
        &mut self,
        plate: &Plate,
        places: &[[f64; 3]],
    ) -> Result<Pieces, ExportError> {
        let solid = plate.solid().map_err(ExportError::no_solid(&plate.name))?;
        let own = solid.mass_properties(plate.density);
        let shape = self.machine.shape(Shape {
            name: format!("{}-body", plate.name),
            part: plate.name.clone(),
            form: Form::Solids(vec![solid]),
        });
        let mounted = |at: &[f64; 3]| Mounted {
            shape,
            at: *at,
            turn: [0.0; 3],
        };
        let pieces = places.iter().map(|at| (mounted(at), own));
        Ok(pieces.collect())
    }

    /// Mounts bodies on a link.
    pub(super) fn mount(&mut self, link: usize, pieces: &Pieces) {
        for (body, own) in pieces {
            self.machine.mount_body(link, *body, Some(*own));
        }
    }
}
