use crate::cli::failure::Failure;
use crate::formats::Bundle;
use centrode_synthesis::optimise::{DesignProblem, DesignSearch};
use serde::Deserialize;
use std::fs;
use std::path::{Path, PathBuf};

/// File of the better design, and its search next to it.
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

    pub(super) fn read(&self, problem: &dyn DesignProblem) -> Result<DesignSearch, Failure> {
        let name = self.name();
        let text = fs::read_to_string(self.folder.join(&name));
        let text = text.map_err(|error| Failure::Input {
            name: name.clone(),
            error,
        })?;
        let unusable =
            |why: &str| Failure::Usage(format!("{name} is not a valid stored search: {why}"));
        let bad = |error: serde_json::Error| unusable(&error.to_string());
        let search: DesignSearch = serde_json::from_str(&text).map_err(bad)?;
        let Sealed { seal } = serde_json::from_str(&text).map_err(bad)?;
        if !search.is_of(problem) || seal == self::seal(problem, &json(&search)?)? {
            return Ok(search);
        }
        Err(unusable(
            "the file was edited, or the design has changed since; start a new search",
        ))
    }

    pub(super) fn write(
        &self,
        problem: &dyn DesignProblem,
        search: &DesignSearch,
    ) -> Result<(), Failure> {
        let text = json(search)?;
        let seal = seal(problem, &text)?;
        // The seal is an additional key of the JSON object of the search.
        let fields = text.strip_prefix('{').unwrap_or_default();
        self.put(&self.name(), format!("{{\"seal\":\"{seal}\",{fields}"))
    }

    pub(super) fn write_design(&self, text: &str) -> Result<(), Failure> {
        self.put(&self.design, text.to_owned())
    }

    /// Writes a file, whole or not at all.
    fn put(&self, name: &str, text: String) -> Result<(), Failure> {
        let mut bundle = Bundle::default();
        bundle.add(name, text.into_bytes())?;
        bundle.write_to(&self.folder)?;
        Ok(())
    }
}

/// Content of a stored search's file.
#[derive(Deserialize)]
struct Sealed {
    seal: String,
}

fn json(search: &DesignSearch) -> Result<String, Failure> {
    serde_json::to_string(search).map_err(|error| Failure::Usage(error.to_string()))
}

/// Hash of a search and of everything in its design that the search does not change.
fn seal(problem: &dyn DesignProblem, search: &str) -> Result<String, Failure> {
    let bounds = problem.bounds();
    let middle: Vec<f64> = bounds.iter().map(|b| 0.5 * (b.0 + b.1)).collect();
    let design = problem.design(&middle).to_toml();
    let design = design.map_err(|error| Failure::Usage(error.to_string()))?;
    // FNV-1a: equal on every machine and in every version.
    let bytes = design.bytes().chain([0]).chain(search.bytes());
    let hash = bytes.fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3)
    });
    Ok(format!("{hash:016x}"))
}
