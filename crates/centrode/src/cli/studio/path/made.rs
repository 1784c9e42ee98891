use std::ops::ControlFlow;

use serde::Serialize;

use super::answer::{GoalAnswer, goals};
use super::sought::Kept;
use super::wish::Wish;
use crate::analysis::{NoSoundTeeth, Unit};
use crate::cli::reverse::made::{Toothed, rolled};
use crate::cli::reverse::words::{self, Told};
use crate::mechanism::design::Design as _;
use crate::mechanism::reverse::Split;

/// A design with sound teeth.
#[derive(Debug, Serialize)]
pub(super) struct Machine {
    /// The design file.
    text: String,
    /// Names and words of what was found.
    told: Vec<Told>,
    /// What else was wanted, and how far it is reached.
    goals: Vec<GoalAnswer>,
    /// What there is to tell: names of rules and words.
    findings: Vec<Told>,
}

/// Makes the design that `centrode reverse -o` writes.
pub(super) fn machine(
    wish: &Wish,
    kept: &Kept,
    observe: &mut dyn FnMut(u64) -> ControlFlow<()>,
) -> Result<Machine, String> {
    let design = wish.design()?;
    let found = kept.found(wish, observe)?;
    let split = Split::new(&found.chain, design.split, design.bend);
    let split = split.map_err(|error| error.to_string())?;
    let made = rolled(&design, &found.chain, &split).map_err(|error| error.to_string())?;
    let toothed = Toothed::new(&made).map_err(|error| without_teeth(&error))?;
    let mut told = found.told.clone();
    told.extend(toothed.teeth.iter().map(words::teeth));
    let findings = found.findings.iter().chain(&toothed.findings);
    Ok(Machine {
        text: toothed
            .design
            .to_toml()
            .map_err(|error| error.to_string())?,
        told,
        goals: goals(&found.goals),
        findings: findings.map(words::finding).collect(),
    })
}

/// The reason with what can be done on the page.
fn without_teeth(error: &NoSoundTeeth) -> String {
    match error {
        NoSoundTeeth::None { pair, full_module } => {
            let module = Unit::Millimetre.tell(*full_module);
            format!(
                "No teeth of pair {pair} carry the motion by their flanks alone: full ones are undercut above a module of {module}, and no fitted ones will do."
            )
        }
        error => error.to_string(),
    }
}
