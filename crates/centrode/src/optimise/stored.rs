use std::fs;
use std::path::{Path, PathBuf};

use centrode::analysis::optimise::DesignSearch;
use centrode::export::Bundle;

use crate::failure::Failure;

/// The better design's file, and its search beside it.
pub(super) struct Stored {
    folder: PathBuf,
    design: String,
}

impl Stored {
    pub(super) fn beside(output: &Path) -> Self {
        let folder = output.parent().filter(|f| !f.as_os_str().is_empty());
        Self {
            folder: folder.unwrap_or(Path::new(".")).to_owned(),
            design: output
                .file_name()
                .map_or_else(String::new, |name| name.to_string_lossy().into_owned()),
        }
    }

    /// Name of the search's file: `better.toml` has `better.search.json`.
    pub(super) fn name(&self) -> String {
        let stem = self.design.strip_suffix(".toml").unwrap_or(&self.design);
        format!("{stem}.search.json")
    }

    pub(super) fn read(&self) -> Result<DesignSearch, Failure> {
        let name = self.name();
        let text = fs::read_to_string(self.folder.join(&name));
        let text = text.map_err(|error| Failure::Input {
            name: name.clone(),
            error,
        })?;
        serde_json::from_str(&text)
            .map_err(|error| Failure::Usage(format!("{name} is no stored search: {error}")))
    }

    pub(super) fn write(&self, search: &DesignSearch) -> Result<(), Failure> {
        let text = serde_json::to_string(search);
        let text = text.map_err(|error| Failure::Usage(error.to_string()))?;
        self.put(&self.name(), text)
    }

    pub(super) fn write_design(&self, text: &str) -> Result<(), Failure> {
        self.put(&self.design, text.to_owned())
    }

    /// Whole or not at all.
    fn put(&self, name: &str, text: String) -> Result<(), Failure> {
        let mut bundle = Bundle::default();
        bundle.add(name, text.into_bytes())?;
        bundle.write_to(&self.folder)?;
        Ok(())
    }
}
