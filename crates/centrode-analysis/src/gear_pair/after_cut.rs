use centrode_gear::{CutPair, GearPair, Member};

use super::{mesh, remedy::remedy};
use crate::{Contact, Finding, Report, Severity, Unit};

/// Figures of the mesh that are also reported for the pair as it is cut.
const FIGURES: [(&str, &str); 4] = [
    ("normal_backlash_min", "cut_backlash_min"),
    ("normal_backlash_max", "cut_backlash_max"),
    ("clearance_min", "cut_clearance_min"),
    ("fillet_clearance_min", "cut_fillet_clearance_min"),
];

/// Checks what remains of both gears after a cut as wide as `cut.kerf`: corners that it does not reach. The pair as cut; `None` if
/// the design has no kerf or the cut is too wide.
pub(super) fn check(pair: &GearPair, report: &mut Report) -> Option<CutPair> {
    let kerf = pair.design().cut.kerf;
    if kerf == 0.0 {
        return None;
    }
    let mm = |length: f64| Unit::Millimetre.with_unit(length);
    let too_wide = |contour: String| {
        let message = format!("a cut of {} is too wide for {contour}", mm(kerf));
        Finding::new("kerf-too-wide", Severity::Error, message).remedy(remedy("kerf-too-wide"))
    };
    for member in Member::ALL {
        let bore = pair.gear(member).body().bore;
        if bore > 0.0 && bore <= kerf {
            let contour = format!("the bore of the {} gear, {}", member.name(), mm(bore));
            too_wide(contour).add_to(report);
        }
    }
    let cut = match pair.after_cut() {
        Ok(cut) => cut,
        Err((member, error)) => {
            too_wide(format!("the {} gear: {error}", member.name())).add_to(report);
            return None;
        }
    };
    for (member, uncut) in Member::ALL.into_iter().zip(&cut.uncut) {
        let thickest = uncut
            .iter()
            .max_by(|a, b| a.thickness.total_cmp(&b.thickness));
        let Some(thickest) = thickest else { continue };
        let corners = match uncut.len() {
            1 => "1 corner".to_owned(),
            count => format!("{count} corners"),
        };
        let message = format!(
            "a cut of {} leaves up to {} in {corners} of the {} gear, most at ({:.3}, {:.3}) mm",
            mm(kerf),
            mm(thickest.thickness),
            member.name(),
            thickest.point.x,
            thickest.point.y,
        );
        Finding::new("uncut-corner", Severity::Note, message)
            .measured(thickest.thickness, 0.0, Unit::Millimetre)
            .remedy(remedy("uncut-corner"))
            .add_to(report);
    }
    Some(cut)
}

/// Checks the mesh of a pair as cut, after the mesh of the pair as designed.
pub(super) fn mesh_as_cut(cut: &CutPair, report: &mut Report) {
    let is_whole = cut.uncut.iter().all(Vec::is_empty);
    let meshed = (!is_whole).then(|| {
        let mut meshed = Report::default();
        let contact = Contact::analyse(&cut.pair);
        let extremes = contact.extremes_with(&cut.pair, None);
        mesh(&cut.pair, &contact, &extremes, &mut meshed);
        meshed
    });
    for (name, cut_name) in FIGURES {
        let values = meshed
            .as_ref()
            .map_or(&report.values, |meshed| &meshed.values);
        if let Some(value) = values.get(name).copied() {
            report.values.insert(cut_name, value);
        }
    }
    for mut finding in meshed.into_iter().flat_map(|meshed| meshed.findings) {
        let is_known = |known: &Finding| known.rule == finding.rule;
        if !report.findings.iter().any(is_known) {
            finding.message = format!("as cut: {}", finding.message);
            report.findings.push(finding);
        }
    }
}
