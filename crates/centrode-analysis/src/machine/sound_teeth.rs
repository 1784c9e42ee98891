//! Teeth for the pairs of a machine made from the path of its tip, or from the motion of its output.

use std::f64::consts::PI;

use centrode_gear::design::{Addendum, GearPairDesign};
use centrode_gear::{FlankCount, GearPair, GearPairError};
use centrode_geometry::checkpoint;
use centrode_machines::machine::MachineDesign;

use crate::MAX_TEETH;
use crate::gear_pair::{flanks_transmit, minimum_count};

/// First tooth count tried for fitted teeth. The search goes down from here if they work, otherwise up.
const FIRST: u32 = 40;
/// Maximum number of full teeth of a driver. If more would be needed, fitted teeth are tried, because they are larger.
/// With a larger limit, full teeth become smaller than fitted ones.
const MAX_FULL: u32 = 120;

/// Teeth of a pair whose flanks alone transmit its motion.
#[derive(Clone, Debug, PartialEq)]
pub struct SoundTeeth {
    /// Name of the pair.
    pub pair: String,
    /// Height of the teeth.
    pub addendum: Addendum,
    /// Number of teeth of the driver.
    pub tooth_count: u32,
    /// Module, mm.
    pub module: f64,
    /// Largest module at which no full tooth can be undercut or short, mm.
    pub full_module: f64,
}

/// Reason why a pair has no sound teeth.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NoSoundTeeth {
    /// No teeth can be cut.
    #[error("pair {pair}: {error}")]
    Gears {
        /// Name of the pair.
        pair: String,
        /// Reason.
        error: Box<GearPairError>,
    },
    /// The flanks do not transmit the motion with any tooth count tried.
    #[error(
        "pair {pair}: full-height teeth are undercut above a module of {full_module:.4} mm, and fitted teeth do not keep contact on their flanks with any number up to {MAX_TEETH}. Change axis, bend or split, or smooth the path; for a drive, leave more room between its goals"
    )]
    None {
        /// Name of the pair.
        pair: String,
        /// Largest module of full teeth, mm.
        full_module: f64,
    },
}

/// Gives the pairs of a machine that `of` selects by name the largest teeth whose flanks alone transmit the motion:
/// full teeth without undercut or short flanks, if at most 120 teeth of the driver are enough; otherwise fitted teeth.
///
/// # Errors
/// [`NoSoundTeeth`] with the pair and the largest module of full teeth.
pub fn with_sound_teeth(
    design: &MachineDesign,
    of: impl Fn(&str) -> bool,
) -> Result<(MachineDesign, Vec<SoundTeeth>), NoSoundTeeth> {
    let mut changed = design.clone();
    let mut found = Vec::new();
    for (name, pair) in changed.pairs.iter_mut().filter(|(name, _)| of(name)) {
        checkpoint();
        let (sound, teeth) = sound(name, pair)?;
        *pair = sound;
        found.push(teeth);
    }
    Ok((changed, found))
}

fn sound(
    name: &str,
    design: &GearPairDesign,
) -> Result<(GearPairDesign, SoundTeeth), NoSoundTeeth> {
    let pair = cut(name, design)?;
    let length = pair.driver().pitch_length();
    let limits = pair.limits();
    let full_module = limits.largest_module_of_full_teeth();
    let teeth = |addendum: Addendum, count: u32| {
        let mut sound = design.with_tooth_count(count);
        sound.teeth.addendum = addendum;
        let teeth = SoundTeeth {
            pair: name.into(),
            addendum,
            tooth_count: count,
            module: length / (PI * f64::from(count)),
            full_module,
        };
        (sound, teeth)
    };
    if let Some(count) = full(design, &pair, length / (PI * limits.largest_module)) {
        return Ok(teeth(Addendum::Full, count));
    }
    let mut fitted = design.clone();
    fitted.teeth.addendum = Addendum::Fitted;
    let count = minimum_count(&fitted, FIRST, MAX_TEETH).ok_or_else(|| NoSoundTeeth::None {
        pair: name.into(),
        full_module,
    })?;
    Ok(teeth(Addendum::Fitted, count))
}

/// The minimum count of full teeth that are sound and transmit the motion. `fewest` is the count at the largest module
/// that the pitch curves allow.
fn full(design: &GearPairDesign, pair: &GearPair, fewest: f64) -> Option<u32> {
    let mut full = design.clone();
    full.teeth.addendum = Addendum::Full;
    let is_sound = |count: u32| {
        let counted = FlankCount::new(&full.with_tooth_count(count), pair.rolling());
        counted.is_ok_and(|gears| gears.iter().all(|gear| gear.unsound == 0))
    };
    // NaN gives no count either.
    if fewest.is_nan() || fewest > f64::from(MAX_FULL) {
        return None;
    }
    let mut count = (fewest.ceil() as u32).max(3);
    // Fewer teeth may be sound if their flanks miss the sharpest points of the pitch curves.
    while count > 3 && is_sound(count - 1) {
        checkpoint();
        count -= 1;
    }
    (count..=MAX_FULL).find(|&count| {
        checkpoint();
        is_sound(count) && flanks_transmit(&full.with_tooth_count(count))
    })
}

/// The pair with the first tooth count that can be cut.
fn cut(name: &str, design: &GearPairDesign) -> Result<GearPair, NoSoundTeeth> {
    let mut count = FIRST;
    loop {
        checkpoint();
        match GearPair::resolve(&design.with_tooth_count(count)) {
            Ok(pair) => return Ok(pair),
            Err(error) if count >= MAX_TEETH => {
                return Err(NoSoundTeeth::Gears {
                    pair: name.into(),
                    error: Box::new(error),
                });
            }
            Err(_) => count = (count + count / 4).min(MAX_TEETH),
        }
    }
}
