//! The machine of a chain, for the command and the page.

use centrode_analysis::{Finding, NoSoundTeeth, SoundTeeth, machine_collisions, with_sound_teeth};
use centrode_spec::Design;
use centrode_synthesis::reverse::{
    PathDesign, ReversedMachine, ReversedMachineError, Split, TwoBar,
};

/// The machine of a chain, with the name, the title and the shapes to keep out of from a design.
///
/// # Errors
/// [`ReversedMachineError`] if no gears have this law.
pub fn rolled(
    design: &PathDesign,
    chain: &TwoBar,
    split: &Split,
) -> Result<ReversedMachine, ReversedMachineError> {
    let made = ReversedMachine::new(chain, split, design.arms, design.steps)?;
    let mut made = made.with_obstacles(&design.wishes.keep_out);
    made.design.name.clone_from(&design.name);
    if !design.title.is_empty() {
        made.design.title.clone_from(&design.title);
    }
    Ok(made)
}

/// A machine with sound teeth.
#[derive(Debug)]
pub struct Toothed {
    /// The design.
    pub design: Box<dyn Design>,
    /// The teeth, pair by pair.
    pub teeth: Vec<SoundTeeth>,
    /// Plates and gears of several arms that collide, as its check reports them: the deepest of each kind.
    pub findings: Vec<Finding>,
}

impl Toothed {
    /// Cuts the teeth.
    ///
    /// # Errors
    /// [`NoSoundTeeth`] if a pair has none.
    pub fn new(made: &ReversedMachine) -> Result<Self, NoSoundTeeth> {
        let (design, teeth) = with_sound_teeth(&made.design, |_| true)?;
        Ok(Self {
            findings: deepest(machine_collisions(&design)),
            design: Box::new(design),
            teeth,
        })
    }
}

/// The deepest collision of each kind, with the number of further ones.
fn deepest(all: Vec<Finding>) -> Vec<Finding> {
    let mut stated: Vec<(Finding, usize)> = Vec::new();
    for finding in all {
        match stated
            .iter_mut()
            .find(|(first, _)| first.rule == finding.rule)
        {
            Some((_, more)) => *more += 1,
            None => stated.push((finding, 0)),
        }
    }
    let counted = |(mut finding, more): (Finding, usize)| {
        let pairs = if more == 1 {
            "pair collides,"
        } else {
            "pairs collide,"
        };
        if more > 0 {
            finding.message += &format!(" ({more} more {pairs} none deeper)");
        }
        finding
    };
    stated.into_iter().map(counted).collect()
}
