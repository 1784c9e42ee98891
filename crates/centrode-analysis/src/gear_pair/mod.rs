//! Check of a gear pair, in three depths: pitch curves, teeth, mesh.

mod after_cut;
mod circular;
mod figures;
mod mesh;
mod of_samples;
mod pitch_curves;
mod remedies;
mod remedy;
mod teeth;
#[cfg(test)]
mod tests;

use centrode_gear::{CutPair, GearPair, PlannedPair};

use self::mesh::mesh;
use self::pitch_curves::pitch_curves;
use self::remedy::remedy;
use self::teeth::teeth;
use crate::contact::Meshing;
use crate::progress::filling;
use crate::{Contact, Finding, Report, Severity, Unit};

pub use figures::FIGURES;
pub(crate) use mesh::thinned;
pub use pitch_curves::pitch_overlap;
pub use remedies::{MAX_TEETH, PairRemedy, remedies};
pub(crate) use remedies::{flanks_transmit, minimum_count};

/// Penetration, in modules, above which two outlines are reported to interfere. It must be above the accuracy of the
/// outlines.
const PENETRATION: f64 = 1e-6;
/// Transmission error, rad, below which lost contact is smaller than the accuracy of manufacture: a micrometre at 50 mm from
/// the axis.
pub const SLIGHT_TRANSMISSION_ERROR: f64 = 2e-5;

/// Checks the pitch curves, the tools and the layout of the teeth of a gear pair, without the teeth: the figures in closed form.
///
/// All figures are those of [`check`], to the last bit.
#[must_use]
pub fn check_planned(pair: &PlannedPair) -> Report {
    let mut report = planned(pair);
    of_samples::noise(pair, &mut report);
    report.worst_first();
    report
}

/// Checks a gear pair and every tooth of it, without its mesh: [`check_planned`], and the teeth as they are made.
#[must_use]
pub fn check_made(pair: &GearPair) -> Report {
    let (mut report, _) = made(pair);
    of_samples::noise(pair, &mut report);
    report.worst_first();
    report
}

/// Checks a gear pair: its pitch curves, every tooth, and the mesh along one whole cycle.
///
/// Lengths are mm, angles rad. The name of a figure states its quantity; `*_min` and `*_max` are extremes over the whole
/// cycle.
#[must_use]
pub fn check(pair: &GearPair) -> Report {
    let mut ready = None;
    let contact = filling([0.0, 0.6], || Contact::analyse_with(pair, &mut ready));
    filling([0.6, 1.0], || {
        let mut report = checked(pair, &contact, ready);
        circular::name_remedy(pair, &mut report);
        report
    })
}

/// Checks a gear pair like [`check`], with a given contact analysis.
#[must_use]
pub fn check_contact(pair: &GearPair, contact: &Contact) -> Report {
    let mut report = checked(pair, contact, None);
    circular::name_remedy(pair, &mut report);
    report
}

/// The check of a pair with an analysis of its contact, and with the prepared pair if there is one. Remedies are the usual
/// ones.
fn checked<'a>(pair: &'a GearPair, contact: &'a Contact, ready: Option<Meshing<'a>>) -> Report {
    let (mut report, cut) = made(pair);
    let extremes = contact.extremes_with(pair, ready);
    mesh(pair, contact, &extremes, &mut report);
    if let Some(cut) = cut {
        after_cut::mesh_as_cut(&cut, &mut report);
    }
    of_samples::noise(pair, &mut report);
    report.worst_first();
    report
}

/// Figures and findings of the pitch curves.
fn planned(pair: &PlannedPair) -> Report {
    let mut report = Report {
        groups: FIGURES.to_vec(),
        ..Report::default()
    };
    pitch_curves(pair, &pair.limits(), &mut report);
    report
}

/// Figures and findings of the pitch curves and the teeth, and the pair that remains after a cut of its width.
fn made(pair: &GearPair) -> (Report, Option<CutPair>) {
    let mut report = planned(pair);
    // The search for an overlap takes longer than the teeth. It comes first: no teeth avoid it.
    report.findings.splice(0..0, pitch_overlap(pair));
    let limits = pair.limits();
    let values = &mut report.values;
    values.insert("largest_addendum", pair.largest_addendum());
    if let Some(housing) = pair.housing() {
        values.insert("driver_chamber_radius", housing.radii[0]);
        values.insert("driven_chamber_radius", housing.radii[1]);
        values.insert("volume_per_turn", 1e-3 * pair.displacement());
    }
    for gear in [pair.driver(), pair.driven()] {
        teeth(pair, gear, &limits, &mut report);
    }
    report
        .findings
        .extend(tight_backlash(pair, pair.backlash()));
    let cut = after_cut::check(pair, &mut report);
    (report, cut)
}

/// Finding about teeth with a normal backlash, mm: they overlap at their maximum thickness, or they have no backlash although
/// both gears have a bore and so are to be made.
pub(crate) fn tight_backlash(pair: &GearPair, backlash: f64) -> Option<Finding> {
    let [minimum, _] = pair.backlash_limits(backlash);
    let (unit, rounding) = (Unit::Millimetre, PENETRATION * pair.module());
    if minimum.abs() <= rounding
        && [pair.driver(), pair.driven()]
            .iter()
            .all(|g| g.bore().is_some())
    {
        let message =
            "the teeth have no backlash: any error of thickness or centre distance jams them";
        return Some(
            Finding::new("zero-backlash", Severity::Note, message)
                .measured(minimum, 0.0, unit)
                .remedy(remedy("zero-backlash")),
        );
    }
    if minimum >= 0.0 {
        return None;
    }
    let message = format!(
        "teeth of maximum thickness overlap the mating teeth by {} along the normal: the backlash must be at least {}",
        unit.with_unit(-minimum),
        unit.with_unit(backlash - minimum),
    );
    Some(
        Finding::new("negative-backlash", Severity::of_overlap(-minimum), message)
            .measured(minimum, 0.0, unit)
            .remedy(remedy("negative-backlash")),
    )
}
