use std::sync::Arc;

use centrode_mechanism::design::{Design, DesignError, DesignFile};

use super::{Family, Mechanism};

/// A design file that has been read, and the family it is of.
#[derive(Clone, Debug)]
pub struct OpenDesign {
    family: Family,
    file: DesignFile,
}

impl OpenDesign {
    pub(super) fn new(family: Family, file: DesignFile) -> Self {
        Self { family, file }
    }

    /// Its family.
    #[must_use]
    pub fn family(&self) -> &Family {
        &self.family
    }

    /// The design.
    #[must_use]
    pub fn design(&self) -> &dyn Design {
        self.file.design().as_ref()
    }

    /// The mechanism of the design.
    ///
    /// # Errors
    /// [`DesignError`] at the key to blame.
    pub fn mechanism(&self) -> Result<Arc<dyn Mechanism>, DesignError> {
        let found = self.family.resolve(self.design());
        found.map_err(|error| self.file.blame(error))
    }
}
