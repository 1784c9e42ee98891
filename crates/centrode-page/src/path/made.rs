use super::answer::{GoalAnswer, goals};
use super::cache::Cached;
use super::wish::Wish;
use crate::reverse::words::{self, Labelled};
use crate::reverse::{Toothed, rolled};
use centrode_analysis::{NoSoundTeeth, Unit};
use centrode_synthesis::reverse::Split;
use serde::Serialize;
use std::ops::ControlFlow;

/// A design with sound teeth, or the machine found and the reason why it has none.
#[derive(Debug, Serialize)]
pub struct PathMachine {
    /// The design file.
    #[serde(skip_serializing_if = "Option::is_none")]
    text: Option<String>,
    /// Reason why there are no sound teeth.
    #[serde(skip_serializing_if = "Option::is_none")]
    refused: Option<String>,
    /// Lines on the machine found: names and words.
    stated: Vec<Labelled>,
    /// Further wishes, and how far they are reached.
    goals: Vec<GoalAnswer>,
    /// Findings: names of rules and words.
    findings: Vec<Labelled>,
}

/// Makes the design that `centrode reverse -o` writes.
///
/// # Errors
/// The reason in words if there is no machine.
pub fn machine(
    wish: &Wish,
    kept: &Cached,
    observe: &mut dyn FnMut(u64) -> ControlFlow<()>,
) -> Result<PathMachine, String> {
    let design = wish.design()?;
    let found = kept.found(wish, observe)?;
    let split = Split::new(&found.chain, design.split, design.bend);
    let split = split.map_err(|error| error.to_string())?;
    let made = rolled(&design, &found.chain, &split).map_err(|error| error.to_string())?;
    // The result is reported even if there are no teeth.
    let (toothed, refused) = match Toothed::new(&made) {
        Ok(toothed) => (Some(toothed), None),
        Err(error) => (None, Some(without_teeth(&error))),
    };
    let text = toothed.as_ref().map(|toothed| toothed.design.to_toml());
    let teeth = toothed.iter().flat_map(|toothed| &toothed.teeth);
    let collisions = toothed.iter().flat_map(|toothed| &toothed.findings);
    let findings = found.findings.iter().chain(collisions);
    Ok(PathMachine {
        text: text.transpose().map_err(|error| error.to_string())?,
        refused,
        stated: found
            .stated
            .iter()
            .cloned()
            .chain(teeth.map(words::teeth))
            .collect(),
        goals: goals(&found.goals),
        findings: findings.map(words::finding).collect(),
    })
}

/// The reason, and the remedy on the page.
fn without_teeth(error: &NoSoundTeeth) -> String {
    match error {
        NoSoundTeeth::None { pair, full_module } => {
            let module = Unit::Millimetre.with_unit(*full_module);
            format!(
                "No teeth of pair {pair} transmit the motion by their flanks alone: full teeth are undercut above a module of {module}, and no fitted teeth work either."
            )
        }
        error => error.to_string(),
    }
}
