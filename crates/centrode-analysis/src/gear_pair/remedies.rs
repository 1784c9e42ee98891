//! Tooth counts from which the flanks alone carry the motion.

use centrode_mechanism::gear::GearPair;
use centrode_mechanism::gear::design::{Addendum, GearPairDesign};

use super::{PENETRATION, thinned};
use crate::Contact;

/// Transmission error up to which the flanks carry the motion by themselves, rad.
const CARRIED: f64 = 1e-9;
/// Greatest tooth count of a driver that [`remedies`] tries.
pub const MOST_TEETH: u32 = 600;

/// Tooth count at which teeth of a kind begin to carry the motion of a pair by their flanks alone, and the pair changed to it.
#[derive(Clone, Debug, PartialEq)]
pub struct PairRemedy {
    /// Height of the teeth.
    pub addendum: Addendum,
    /// Tooth count of the driver at which they do: with one step fewer they do not. A greater one may fail again.
    pub least_tooth_count: u32,
    /// The design with such teeth: as many as written where those are enough, else the least that are, on pitch curves of the
    /// same size.
    pub design: GearPairDesign,
}

/// Finds from which tooth count on full teeth, and fitted ones, carry the motion of a pair by their flanks alone.
///
/// They do where the transmission error stays below 1e-9 rad, more only by what the play thins them, and nothing penetrates,
/// over the samples of [`Contact::analyse`]. Counts grow by a quarter till one does and are halved between it and the greatest that does
/// not: the count found carries the motion and the one below it does not, but a greater one may fail again. A kind of teeth that does not up to [`MOST_TEETH`]
/// is left out. Each count tried costs a pair and its contact.
#[must_use]
pub fn remedies(pair: &GearPair) -> Vec<PairRemedy> {
    let written = pair.driver().tooth_count();
    let kinds = [Addendum::Full, Addendum::Fitted].into_iter();
    kinds
        .filter_map(|addendum| {
            let mut design = pair.design().clone();
            design.teeth.addendum = addendum;
            let least = least_count(&design, written)?;
            Some(PairRemedy {
                addendum,
                least_tooth_count: least,
                design: if least > written {
                    design.with_tooth_count(least)
                } else {
                    design
                },
            })
        })
        .collect()
}

/// The least tooth count at which the flanks of a design carry its motion, looked for from one on.
pub(crate) fn least_count(design: &GearPairDesign, written: u32) -> Option<u32> {
    // The driven gear has a whole number of teeth.
    let step = design.mean_ratio[1];
    let carries = |steps: u32| is_carried(&design.with_tooth_count(steps * step));
    let first = (written / step).max(1);
    let (mut low, mut high) = (0, first);
    if carries(first) {
        low = high * 2 / 3;
        while low > 0 && carries(low) {
            (low, high) = (low * 2 / 3, low);
        }
    } else {
        while low == 0 || !carries(high) {
            (low, high) = (high, high + high.div_ceil(4));
            if high * step > MOST_TEETH {
                return None;
            }
        }
    }
    while high - low > 1 {
        let middle = low + (high - low) / 2;
        if carries(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    Some(high * step)
}

/// Whether the flanks alone carry the motion of a design.
pub(crate) fn is_carried(design: &GearPairDesign) -> bool {
    let Ok(pair) = GearPair::resolve(design) else {
        return false;
    };
    // Most of those that do not show it at the first few inputs.
    is_exact(&pair, &Contact::sampled(&pair, 1)) && is_exact(&pair, &Contact::analyse(&pair))
}

/// Whether the flanks carry the motion wherever a contact was looked at.
fn is_exact(pair: &GearPair, found: &Contact) -> bool {
    let allowed = CARRIED.max(thinned(pair));
    let errors = [&found.transmission_error, &found.reverse_transmission_error];
    let mut errors = errors.into_iter().flatten();
    let deepest = PENETRATION * pair.module();
    let mut clear = found.clearance.iter().chain(&found.fillet_clearance);
    errors.all(|error| error.abs() <= allowed)
        && found
            .penetration
            .iter()
            .all(|&penetration| penetration <= deepest)
        && clear.all(|&clear| clear >= -deepest)
}
