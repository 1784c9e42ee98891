use serde::{Deserialize, Serialize};

use super::sought::{Found, Sought, moved, searched};
use super::wish::{Wish, points};
use crate::analysis::optimise::{Easing, EasingSpec};
use crate::analysis::{NoSoundTeeth, SoundTeeth, Unit, with_sound_teeth};
use crate::mechanism::design::Design as _;
use crate::mechanism::gear::design::Addendum;
use crate::mechanism::reverse::{ReversedMachine, Split, TwoBar};

/// Request of a machine: of a wish, or of one whose machine is sought.
#[derive(Debug, Deserialize)]
#[serde(untagged)]
pub(super) enum Ask {
    Sought(Sought),
    Path {
        #[serde(flatten)]
        wish: Wish,
        /// Distance within which the path may pass its points, mm.
        band: Option<f64>,
    },
}

/// A design with sound teeth.
#[derive(Debug, Serialize)]
pub(super) struct Machine {
    /// The design file.
    text: String,
    /// Names and words of what was found.
    told: Vec<(String, String)>,
}

/// Makes the design that `centrode reverse -o` writes.
pub(super) fn machine(ask: &Ask) -> Result<Machine, String> {
    let (found, choices) = match ask {
        Ask::Sought(sought) => (sought.found()?, sought.choices()),
        Ask::Path { wish, band } => (found(wish, *band)?, &wish.choices),
    };
    let Found { chain, mut told } = found;
    choices.check_arms()?;
    let split = Split::new(&chain, choices.kind()?, choices.bend());
    let split = split.map_err(|error| error.to_string())?;
    let made = ReversedMachine::new(&chain, &split, choices.arms, None);
    let made = made.map_err(|error| error.to_string())?;
    let toothed = with_sound_teeth(&made.design, |_| true);
    let (design, teeth) = toothed.map_err(|error| without_teeth(&error))?;
    told.extend(teeth.iter().map(line));
    let text = design.to_toml().map_err(|error| error.to_string())?;
    Ok(Machine { text, told })
}

/// The chain of a path as it is wished for, or within a band that whose gears are the bluntest.
fn found(wish: &Wish, band: Option<f64>) -> Result<Found, String> {
    if let Some(band) = band {
        let spec = EasingSpec {
            axis: Some(wish.axis()),
            ..EasingSpec::new(&[band], wish.choices.bend())
        };
        let eased = searched(Easing::new(&points(&wish.points), &spec))?;
        let told = vec![moved(&eased)];
        let chain = eased.chain;
        return Ok(Found { chain, told });
    }
    let wanted = wish.path().map_err(|error| error.to_string())?;
    wanted.check_simple().map_err(|error| error.to_string())?;
    let chain = TwoBar::new(&wanted, wish.axis(), None).map_err(|fault| fault.to_string())?;
    let told = Vec::new();
    Ok(Found { chain, told })
}

fn line(teeth: &SoundTeeth) -> (String, String) {
    let kind = match teeth.addendum {
        Addendum::Full => "full",
        Addendum::Fitted => "fitted",
    };
    let module = Unit::Millimetre.tell(teeth.module);
    (
        format!("teeth of {}", teeth.pair),
        format!("{} {kind} teeth, module {module}", teeth.tooth_count),
    )
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
