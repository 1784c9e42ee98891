use super::links::Builder;
use crate::ExportError;
use crate::plate::{Pieces, Plate};

impl Builder<'_> {
    /// A plate as a body to be mounted at positions, mm.
    pub(super) fn pieces(
        &mut self,
        plate: &Plate,
        places: &[[f64; 3]],
    ) -> Result<Pieces, ExportError> {
        let name = format!("{}-body", plate.name);
        plate.pieces(&mut self.machine, [&name, &plate.name], places)
    }

    /// Mounts bodies on a link.
    pub(super) fn mount(&mut self, link: usize, pieces: &Pieces) {
        for (body, own) in pieces {
            self.machine.mount_body(link, *body, Some(*own));
        }
    }
}
