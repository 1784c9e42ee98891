//! Tooth counts from which the flanks alone carry the motion.

use centrode_gear::GearPair;
use centrode_gear::design::{Addendum, Fit, GearPairDesign};

use super::{PENETRATION, thinned};
use crate::Contact;

/// Transmission error up to which the flanks carry the motion by themselves, rad.
const CARRIED: f64 = 1e-9;
/// Maximum tooth count of a driver that [`remedies`] tries.
pub const MAX_TEETH: u32 = 600;

/// Overlap of the pitch curves, modules, above which no teeth are searched.
const OVERLAP: f64 = 0.5;

/// Counts, from one that does not carry the motion to one that does, that are tried one by one.
const SCANNED: u32 = 16;

/// Tooth count at which teeth of a kind begin to carry the motion of a pair by their flanks alone, and the pair changed to it.
#[derive(Clone, Debug, PartialEq)]
pub struct PairRemedy {
    /// Height of the teeth.
    pub addendum: Addendum,
    /// Numbers chosen next to that height, and written in the design.
    pub fit: Vec<Fit>,
    /// Tooth count of the driver at which they do: with one step fewer they do not. A greater one may fail again.
    pub minimum_tooth_count: u32,
    /// The design with such teeth: as many as written where those are enough, else as few as are, on pitch curves of the
    /// same size.
    pub design: GearPairDesign,
}

/// Finds from which tooth count on full teeth, fitted ones, and fitted ones of chosen phase, thickness and pressure angle carry
/// the motion of a pair by their flanks alone.
///
/// They do where flanks face each other as designed at all samples of [`Contact::analyse`], nothing penetrates, and the
/// transmission error stays below 1e-9 rad, more only by what the backlash thins the flanks (2e-5 rad at most), by
/// [`Contact::extremes`]. Counts grow by a quarter from the one written till one does; between that and the first, where they
/// are few, all are tried, and else they are halved: the count found carries the motion and the one below it does not, but a
/// greater one may fail again, and a lesser one may carry. A kind of teeth that does not up to [`MAX_TEETH`] is omitted. Each
/// count tried costs a pair and its contact; a choice (`teeth.fit`) is searched only where as many fitted teeth as written do
/// not carry, up to the count from which they do and to twice the one written.
#[must_use]
pub fn remedies(pair: &GearPair) -> Vec<PairRemedy> {
    // Where pitch curves lie in each other by half a tooth or more, no teeth of that size or smaller ones roll.
    let overlap = pair.rolling().overlap();
    if overlap.is_some_and(|overlap| overlap.value > OVERLAP * pair.module()) {
        return Vec::new();
    }
    let written = pair.driver().tooth_count();
    let mut design = pair.settled_design();
    let changed = |design: &GearPairDesign, minimum: u32| match minimum > written {
        true => design.with_tooth_count(minimum),
        false => design.clone(),
    };
    let mut found = Vec::new();
    for addendum in [Addendum::Full, Addendum::Fitted] {
        design.teeth.addendum = addendum;
        let minimum = minimum_count(&design, written, MAX_TEETH);
        found.extend(minimum.map(|minimum| PairRemedy {
            addendum,
            fit: Vec::new(),
            minimum_tooth_count: minimum,
            design: changed(&design, minimum),
        }));
    }
    let fitted = found
        .iter()
        .find(|remedy| remedy.addendum == Addendum::Fitted);
    // Each count tried costs a hundred layouts.
    let most = fitted.map_or(written, |remedy| {
        (remedy.minimum_tooth_count - 1).min(2 * written)
    });
    design.teeth.fit = vec![Fit::ThicknessSplit, Fit::PressureAngle, Fit::Phase];
    if most >= written
        && let Some(minimum) = minimum_count(&design, written, most)
        && let Ok(pair) = GearPair::resolve(&changed(&design, minimum))
    {
        found.push(PairRemedy {
            addendum: Addendum::Fitted,
            fit: design.teeth.fit,
            minimum_tooth_count: minimum,
            design: pair.settled_design(),
        });
    }
    found
}

/// The minimum tooth count at which the flanks of a design carry its motion, searched from one on and up to another.
pub(crate) fn minimum_count(design: &GearPairDesign, written: u32, most: u32) -> Option<u32> {
    // The driven gear has a whole number of teeth.
    let step = design.mean_ratio[1];
    let carries = |steps: u32| is_carried(&design.with_tooth_count(steps * step));
    let first = (written / step).max(1);
    let (mut low, mut high) = (0, first);
    let failed = if carries(first) {
        low = high * 2 / 3;
        while low > 0 && carries(low) {
            (low, high) = (low * 2 / 3, low);
        }
        low
    } else {
        while low == 0 || !carries(high) {
            // The last one tried is the maximum there is.
            if high >= most / step {
                return None;
            }
            (low, high) = (high, (high + high.div_ceil(4)).min(most / step));
        }
        first
    };
    // From some count on all carry, mostly; few are tried one by one.
    if high - failed <= SCANNED {
        return (failed + 1..high)
            .find(|&steps| carries(steps))
            .or(Some(high))
            .map(|steps| steps * step);
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
    is_sampled(&pair, &Contact::sampled(&pair, 1)) && {
        let found = Contact::analyse(&pair);
        is_sampled(&pair, &found) && is_exact(&pair, &found)
    }
}

/// Whether the flanks carry the motion, by the extremes of a contact.
fn is_exact(pair: &GearPair, found: &Contact) -> bool {
    let found = found.extremes(pair);
    let allowed = if found.lost > 0.0 {
        CARRIED
    } else {
        CARRIED.max(thinned(pair))
    };
    let deepest = PENETRATION * pair.module();
    let errors = [found.transmission_error, found.reverse_transmission_error];
    errors.iter().all(|error| error.value <= allowed)
        && found.penetration.value <= deepest
        && found.clearance.value.min(found.fillet_clearance.value) >= -deepest
}

/// Whether the flanks carry the motion wherever a contact was sampled: flanks that face each other as designed do, but for what
/// backlash causes, and contacts that leave the driven gear on its law.
fn is_sampled(pair: &GearPair, found: &Contact) -> bool {
    let play = CARRIED.max(thinned(pair));
    let errors = found.transmission_error.iter();
    let mut errors = errors
        .zip(&found.reverse_transmission_error)
        .zip(found.on_flanks_in_both_directions());
    let deepest = PENETRATION * pair.module();
    let mut clear = found.clearance.iter().chain(&found.fillet_clearance);
    errors.all(|((on, back), on_flanks)| {
        let allowed = if on_flanks { play } else { CARRIED };
        on.abs().max(back.abs()) <= allowed
    }) && found
        .penetration
        .iter()
        .all(|&penetration| penetration <= deepest)
        && clear.all(|&clear| clear >= -deepest)
}
