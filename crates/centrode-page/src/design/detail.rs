//! Details of bodies that cannot be made: the motion is shown without them.

use super::edit::{Edit, edited};
use super::field::{Table, tables};
use centrode_analysis::{Finding, Report, Severity, Unit};
use centrode_families::{FAMILIES, Mechanism};
use centrode_spec::{DesignError, DesignFault};
use std::sync::Arc;

/// Maximum number of details omitted from one design.
const MOST: usize = 6;

/// Mechanism of a design, without the details of its bodies that cannot be made.
///
/// A detail does not affect the motion: it is that of the design as written.
#[derive(Debug)]
pub struct Made {
    /// The mechanism.
    pub mechanism: Arc<dyn Mechanism>,
    /// Details that the mechanism is without.
    pub left_out: Option<LeftOut>,
}

/// Details that are omitted from a design.
#[derive(Debug)]
pub struct LeftOut {
    /// Reason why the first of them cannot be made.
    pub error: DesignError,
    keys: Vec<String>,
}

impl Made {
    /// Resolves the text of a design file.
    ///
    /// # Errors
    /// [`DesignError`] of anything other than a detail.
    pub fn new(text: &str) -> Result<Self, DesignError> {
        let error = match resolved(text) {
            Ok(mechanism) => {
                return Ok(Self {
                    mechanism,
                    left_out: None,
                });
            }
            Err(error) => error,
        };
        match without_details(text, &error) {
            Some((mechanism, keys)) => Ok(Self {
                mechanism,
                left_out: Some(LeftOut { error, keys }),
            }),
            None => Err(error),
        }
    }
}

impl LeftOut {
    /// Reason and consequence in words.
    pub fn message(&self) -> String {
        let keys = self.keys.join(", ");
        format!(
            "{}; the figures and drawings are without {keys}",
            self.error.message()
        )
    }

    /// Adds the finding of the details to a report, before all others.
    pub fn report(&self, report: &mut Report) {
        let finding = Finding::new("detail", Severity::Error, self.message()).measured(
            None,
            None,
            Unit::Number,
        );
        report.findings.insert(0, finding);
    }
}

/// Mechanism of a design file.
fn resolved(text: &str) -> Result<Arc<dyn Mechanism>, DesignError> {
    FAMILIES.read(text.as_bytes())?.mechanism()
}

/// Mechanism of a design without the details that are at fault, and the keys omitted; `None` if the fault is not in a detail.
fn without_details(text: &str, error: &DesignError) -> Option<(Arc<dyn Mechanism>, Vec<String>)> {
    // An unknown key is not a detail: it may be a misspelt key that matters.
    if matches!(error.fault, DesignFault::UnknownKey { .. }) {
        return None;
    }
    let mut text = text.to_owned();
    let mut left_out = Vec::new();
    let mut blamed = error.key.clone();
    while left_out.len() < MOST {
        let key = written_detail(&tables(&text), &blamed)?;
        text = edited(&text, &[Edit::removal(&key)]).ok()?;
        left_out.push(key);
        match resolved(&text) {
            Ok(mechanism) => return Some((mechanism, left_out)),
            Err(error) => blamed = error.key,
        }
    }
    None
}

/// Key or table of a detail that is written and may be removed: the one at fault, else the nearest table around it.
fn written_detail(tables: &[Table], blamed: &str) -> Option<String> {
    let mut path = blamed;
    loop {
        let fields = tables.iter().flat_map(|table| {
            let fields = table.fields.iter();
            fields.filter(|field| table.detail || field.detail)
        });
        let mut fields = fields.filter(|field| field.may_go());
        if fields.any(|field| field.key == path) {
            return Some(path.to_owned());
        }
        let mut around = tables.iter().filter(|table| table.detail && table.may_go);
        if around.any(|table| table.key == path) {
            return Some(path.to_owned());
        }
        path = &path[..path.rfind(['.', '['])?];
    }
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::Path;

    use super::*;

    fn design(name: &str) -> String {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/designs");
        fs::read_to_string(folder.join(name)).expect("there")
    }

    #[test]
    fn a_detail_of_a_body_that_cannot_be_leaves_the_motion_as_it_is() {
        for (name, old, new, keys) in [
            (
                "circular-pair.toml",
                "bore = 14",
                "bore = 100",
                &["driver.bore", "driver.keyway"][..],
            ),
            (
                "circular-pair.toml",
                "depth = 2.3",
                "depth = 23",
                &["driver.bore", "driver.keyway"],
            ),
            (
                "three-arm-2021.toml",
                "bore = 10",
                "bore = -1",
                &["sun.bore", "sun.keyway"],
            ),
            (
                "spiral-shaft-2018.toml",
                "keyway = { width = 5, depth = 3 }",
                "keyway = { width = 500, depth = 3 }",
                &["body.keyway"],
            ),
        ] {
            let text = design(name);
            let good = resolved(&text).expect("sound");
            let bad = text.replacen(old, new, 1);
            let error = resolved(&bad).map(drop).expect_err("at fault");
            let (found, left_out) = without_details(&bad, &error).expect("a mechanism");
            assert!(
                left_out.iter().all(|key| keys.contains(&key.as_str())),
                "{name}: {error}: {left_out:?}"
            );
            assert_eq!(found.picture().motion, good.picture().motion, "{name}");
            assert_eq!(found.curves(), good.curves(), "{name}");
        }
    }

    #[test]
    fn a_fault_of_the_motion_is_no_detail() {
        for (old, new) in [
            ("module = 2", "module = -2"),
            ("tooth_count = 24", "tooth_count = 0"),
            ("bore = 14", "bore = 14\ninternal = true"),
            ("bore = 14", "bores = 14"),
            (
                "mean_ratio = [3, 2]",
                "mean_ratio = [3, 2]\ncenter_distance = 1",
            ),
        ] {
            let bad = design("circular-pair.toml").replacen(old, new, 1);
            let error = resolved(&bad).map(drop).expect_err("at fault");
            assert!(without_details(&bad, &error).is_none(), "{new}");
        }
    }
}
