use std::sync::Arc;

use centrode_spec::{Design, DesignError, DesignFile};

use super::{Family, Mechanism};

/// Design file that has been read, and its family.
#[derive(Clone, Debug)]
pub struct OpenDesign {
    family: Family,
    file: DesignFile,
}

impl OpenDesign {
    pub(super) fn new(family: Family, file: DesignFile) -> Self {
        Self { family, file }
    }

    /// Family of the design.
    #[must_use]
    pub fn family(&self) -> &Family {
        &self.family
    }

    /// The design.
    #[must_use]
    pub fn design(&self) -> &dyn Design {
        self.file.design().as_ref()
    }

    /// Mechanism of the design.
    ///
    /// # Errors
    /// [`DesignError`] with the key at fault.
    pub fn mechanism(&self) -> Result<Arc<dyn Mechanism>, DesignError> {
        let found = self.family.resolve(self.design());
        found.map_err(|error| self.file.blame(error))
    }
}
