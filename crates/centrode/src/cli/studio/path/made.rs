use std::ops::ControlFlow;

use serde::{Deserialize, Serialize};

use super::wish::{Poses, Wish};
use crate::analysis::optimise::Easing;
use crate::analysis::{NoSoundTeeth, SoundTeeth, Unit, with_sound_teeth};
use crate::geometry::Point;
use crate::mechanism::design::Design as _;
use crate::mechanism::gear::design::Addendum;
use crate::mechanism::reverse::{ReversedMachine, Split, TwoBar};

/// Request of a machine: by a path, or by key poses.
#[derive(Debug, Deserialize)]
#[serde(untagged)]
pub(super) enum Ask {
    Poses(Poses),
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
    let mut told = Vec::new();
    let (chain, choices) = match ask {
        Ask::Poses(poses) => {
            let found = poses.found().map_err(|error| error.to_string())?;
            (found.chain, &poses.choices)
        }
        Ask::Path { wish, band: None } => (as_given(wish)?, &wish.choices),
        Ask::Path {
            wish,
            band: Some(band),
        } => (eased(wish, *band, &mut told)?, &wish.choices),
    };
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

/// The chain of a path as it is wished for.
fn as_given(wish: &Wish) -> Result<TwoBar, String> {
    let wanted = wish.path().map_err(|error| error.to_string())?;
    wanted.check_simple().map_err(|error| error.to_string())?;
    TwoBar::new(&wanted, wish.axis(), None).map_err(|fault| fault.to_string())
}

/// The chain of the path within a band whose gears are the bluntest.
fn eased(wish: &Wish, band: f64, told: &mut Vec<(String, String)>) -> Result<TwoBar, String> {
    let points: Vec<Point> = wish.points.iter().copied().map(Point::from).collect();
    let easing = Easing::new(&points, &[band], Some(wish.axis()), wish.choices.bend());
    let eased = easing
        .and_then(|easing| easing.search(None, &mut |_| ControlFlow::Continue(())))
        .map_err(|error| error.to_string())?;
    let simple = eased.chain.path().check_simple();
    simple.map_err(|error| error.to_string())?;
    let most = eased.moved.iter().copied().fold(0.0, f64::max);
    let words = format!("by {} at most", Unit::Millimetre.tell(most));
    told.push(("Path eased".to_owned(), words));
    Ok(eased.chain)
}

fn line(teeth: &SoundTeeth) -> (String, String) {
    let kind = match teeth.addendum {
        Addendum::Full => "full",
        Addendum::Fitted => "fitted",
    };
    let module = Unit::Millimetre.tell(teeth.module);
    (
        format!("Teeth of {}", teeth.pair),
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
