//! Tooth counts from which the flanks alone transmit the motion.

use centrode_gear::GearPair;
use centrode_gear::design::{Addendum, Fit, GearPairDesign};

use super::{PENETRATION, thinned};
use crate::Contact;

/// Maximum transmission error of a pair whose flanks alone transmit the motion, rad. If it is much smaller, rounding
/// counts as an error. If it is much larger, contact on edges that is only a little off the law is accepted.
const MAX_ERROR: f64 = 1e-9;
/// Maximum tooth count of a driver that [`remedies`] tries.
pub const MAX_TEETH: u32 = 600;

/// Overlap of the pitch curves, modules, above which no teeth are searched. A larger value starts long searches without a
/// result. A smaller one finds no remedy for pairs that more teeth would repair.
const OVERLAP: f64 = 0.5;

/// Maximum number of counts between one that fails and one that works at which every count is tried. A larger value costs more
/// analyses. A smaller one can miss a smaller count that works.
const SCANNED: u32 = 16;

/// Tooth count from which the flanks of a kind of teeth alone transmit the motion of a pair, and the design changed to it.
#[derive(Clone, Debug, PartialEq)]
pub struct PairRemedy {
    /// Height of the teeth.
    pub addendum: Addendum,
    /// Numbers that are chosen in addition to the height, and written in the design.
    pub fit: Vec<Fit>,
    /// Tooth count of the driver at which the flanks transmit the motion: with one step less they do not. A larger count may fail
    /// again.
    pub minimum_tooth_count: u32,
    /// The design with such teeth, on pitch curves of the same size: with the given tooth count if that is enough, otherwise
    /// with the minimum count.
    pub design: GearPairDesign,
}

/// Finds the tooth counts from which the flanks alone transmit the motion of a pair: of full teeth, of fitted teeth, and of
/// fitted teeth with chosen phase, thickness and pressure angle.
///
/// The flanks transmit the motion if they face each other as designed at all samples of [`Contact::analyse`], nothing penetrates,
/// and the transmission error by [`Contact::extremes`] is at most 1e-9 rad. For flanks thinned by backlash a larger error is
/// allowed, up to 2e-5 rad.
///
/// If the given count fails, the count grows by a quarter until the flanks transmit the motion. If it works, the count falls by a
/// third until it fails. Between the last failed count and the working one, every count is tried if there are few; otherwise the
/// interval is halved. The count found works and the one below it does not, but a larger count may fail again, and a smaller one
/// may work. A kind of teeth that fails up to [`MAX_TEETH`] is omitted. Each count tried costs a pair and its contact. A choice
/// (`teeth.fit`) is searched only if the given count of fitted teeth fails. The search ends below the count found for fitted teeth,
/// or at twice the given count. If no count of fitted teeth was found, only the given count is tried.
#[must_use]
pub fn remedies(pair: &GearPair) -> Vec<PairRemedy> {
    // If pitch curves overlap by more than half a module, teeth of that size or smaller cannot roll.
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

/// A tooth count at which the flanks alone transmit the motion, but not with one step less (`mean_ratio[1]` teeth). The search
/// starts at `written`: downwards if this count works, otherwise upwards to `most`. `None` if no count tried up to `most` works.
/// Counts further below may work again.
pub(crate) fn minimum_count(design: &GearPairDesign, written: u32, most: u32) -> Option<u32> {
    // The driven gear has a whole number of teeth.
    let step = design.mean_ratio[1];
    let works = |steps: u32| flanks_transmit(&design.with_tooth_count(steps * step));
    let first = (written / step).max(1);
    let (mut low, mut high) = (0, first);
    let failed = if works(first) {
        low = high * 2 / 3;
        while low > 0 && works(low) {
            (low, high) = (low * 2 / 3, low);
        }
        low
    } else {
        while low == 0 || !works(high) {
            // The last count tried was the maximum.
            if high >= most / step {
                return None;
            }
            (low, high) = (high, (high + high.div_ceil(4)).min(most / step));
        }
        first
    };
    // Usually all counts above some count work. If few are left, each is tried.
    if high - failed <= SCANNED {
        return (failed + 1..high)
            .find(|&steps| works(steps))
            .or(Some(high))
            .map(|steps| steps * step);
    }
    while high - low > 1 {
        let middle = low + (high - low) / 2;
        if works(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    Some(high * step)
}

/// Whether the flanks alone transmit the motion of a design.
pub(crate) fn flanks_transmit(design: &GearPairDesign) -> bool {
    let Ok(pair) = GearPair::resolve(design) else {
        return false;
    };
    // Most designs that do not work fail at the few samples of this first analysis.
    is_sampled(&pair, &Contact::sampled(&pair, 1)) && {
        let found = Contact::analyse(&pair);
        is_sampled(&pair, &found) && is_exact(&pair, &found)
    }
}

/// Whether the flanks transmit the motion, by the extremes of a contact.
fn is_exact(pair: &GearPair, found: &Contact) -> bool {
    let found = found.extremes(pair);
    let allowed = if found.lost > 0.0 {
        MAX_ERROR
    } else {
        MAX_ERROR.max(thinned(pair))
    };
    let deepest = PENETRATION * pair.module();
    let errors = [found.transmission_error, found.reverse_transmission_error];
    errors.iter().all(|error| error.value <= allowed)
        && found.penetration.value <= deepest
        && found.clearance.value.min(found.fillet_clearance.value) >= -deepest
}

/// Whether the flanks transmit the motion at all samples of a contact: the driven gear is on its law, apart from the error that
/// backlash causes on flanks that face each other as designed.
fn is_sampled(pair: &GearPair, found: &Contact) -> bool {
    let thinned_error = MAX_ERROR.max(thinned(pair));
    let errors = found.transmission_error.iter();
    let mut errors = errors
        .zip(&found.reverse_transmission_error)
        .zip(found.on_flanks_in_both_directions());
    let deepest = PENETRATION * pair.module();
    let mut clear = found.clearance.iter().chain(&found.fillet_clearance);
    errors.all(|((on, back), on_flanks)| {
        let allowed = if on_flanks { thinned_error } else { MAX_ERROR };
        on.abs().max(back.abs()) <= allowed
    }) && found
        .penetration
        .iter()
        .all(|&penetration| penetration <= deepest)
        && clear.all(|&clear| clear >= -deepest)
}
