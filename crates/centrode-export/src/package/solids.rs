use centrode_formats::{
    Format,
    step::{self, StepError},
    stl, threemf,
};
use centrode_geometry::{Mesh, Shell, Solid, Tolerance};

use super::Package;
use crate::ExportError;

impl Package<'_> {
    /// Offers a part as a solid; its files contain the title.
    ///
    /// # Errors
    /// [`ExportError`] where it cannot be made or written.
    pub fn solid(
        &mut self,
        part: &str,
        title: &str,
        make: impl FnOnce() -> Result<Solid, ExportError>,
    ) -> Result<(), ExportError> {
        if !self.takes(part, &[Format::Step, Format::Stl, Format::ThreeMf]) {
            return Ok(());
        }
        let solid = make()?;
        if self.options.keep_solids {
            self.bundle.keep(&self.name_of(part), solid);
            return Ok(());
        }
        self.exact(part, || Ok(step::write(&solid, part, title)))?;
        self.mesh(part, title, |tolerance| {
            solid.mesh(tolerance).map_err(ExportError::no_solid(part))
        })
    }

    /// Offers a part as an exact shell.
    pub(crate) fn shell(
        &mut self,
        part: &str,
        make: impl FnOnce() -> Result<Shell, ExportError>,
    ) -> Result<(), ExportError> {
        if self.options.keep_solids {
            return Ok(());
        }
        let title = self.titled(part);
        self.exact(part, || Ok(step::write_shell(&make()?, part, &title)))
    }

    fn exact(
        &mut self,
        part: &str,
        write: impl FnOnce() -> Result<Result<Vec<u8>, StepError>, ExportError>,
    ) -> Result<(), ExportError> {
        if !self.takes(part, &[Format::Step]) {
            return Ok(());
        }
        let bytes = write()?.map_err(|source| ExportError::Step {
            part: part.to_owned(),
            source,
        })?;
        self.file(&format!("{part}.step"), bytes)
    }

    /// Offers a part as triangles within a tolerance; its files contain the title.
    pub(crate) fn mesh(
        &mut self,
        part: &str,
        title: &str,
        make: impl FnOnce(Tolerance) -> Result<Mesh, ExportError>,
    ) -> Result<(), ExportError> {
        if !self.takes(part, &[Format::Stl, Format::ThreeMf]) {
            return Ok(());
        }
        let mesh = make(self.tolerance())?;
        if self.wants(&[Format::Stl]) {
            self.file(&format!("{part}.stl"), stl::write(&mesh))?;
        }
        if self.wants(&[Format::ThreeMf]) {
            let bytes = threemf::write(&mesh, part, title)?;
            self.file(&format!("{part}.3mf"), bytes)?;
        }
        Ok(())
    }

    /// Adds the STL file of a mesh unless a file of its name is there already.
    pub(crate) fn shown(
        &mut self,
        name: &str,
        make: impl FnOnce() -> Result<Mesh, ExportError>,
    ) -> Result<(), ExportError> {
        let file = self.name_of(name);
        if self.bundle.files().any(|(known, _)| known == file) {
            return Ok(());
        }
        self.file(name, stl::write(&make()?))
    }
}
