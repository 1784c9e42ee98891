//! Teeth of the gear pairs of a composed machine, each pair by itself.

use std::sync::Arc;

use centrode_gear::design::GearPairDesign;
use centrode_geometry::Recent;
use centrode_machines::machine::Machine;

use super::Made;
use crate::progress::filling;
use crate::{Report, Table, Unit};

/// Reports of the pairs of a machine, in the order of the pairs.
pub(super) fn checked(composed: &Machine) -> Vec<Arc<Report>> {
    static CHECKED: Recent<GearPairDesign, Arc<Report>> = Recent::new();
    let pairs = composed.pairs();
    let count = pairs.len() as f64;
    let pairs = (0_u32..).zip(pairs);
    // The check of teeth takes long: its report is cached for designs in which only other things change.
    pairs
        .map(|(number, pair)| {
            let [from, to] = [number, number + 1].map(|done| f64::from(done) / count);
            filling([from, to], || {
                CHECKED.get(pair.design(), || Arc::new(crate::check(pair)))
            })
        })
        .collect()
}

/// Reports the findings of the pairs, each with the name of its pair, and the number of tooth pairs in contact.
pub(super) fn pairs(made: &Made<'_>, report: &mut Report) {
    let mut rows = Vec::new();
    for (pair, own) in made.composed.pairs().into_iter().zip(made.pairs()) {
        let name = pair.name();
        report.findings.extend(own.findings.iter().map(|finding| {
            let mut stated = finding.clone();
            stated.message = format!("pair {name}: {}", finding.message);
            stated.place.part = finding
                .place
                .part
                .as_ref()
                .map(|part| format!("{name}-{part}"));
            // This input is that of the pair's driver, not of the machine.
            stated.place.input = None;
            stated
        }));
        let carrying = ["pairs_in_contact_min", "contact_ratio_mean"];
        let value = |key: &str| own.values.get(key).copied().unwrap_or(f64::NAN);
        rows.push((name.to_owned(), carrying.map(value).to_vec()));
    }
    report.table(
        Table::new("contact-ratios", "Contact ratio of pair", Unit::Number)
            .columns(["minimum", "mean"])
            .rows(rows),
    );
}

#[cfg(test)]
mod tests {
    use centrode_machines::machine::PAIR_FIGURES;

    #[test]
    fn every_figure_of_a_pair_that_goals_can_name_is_one_of_its_check() {
        let groups = crate::gear_pair::FIGURES.iter();
        let rows = groups.flat_map(|group| group.rows);
        let keys: Vec<&str> = rows.flat_map(|row| row.keys).copied().collect();
        for figure in PAIR_FIGURES {
            assert!(keys.contains(&figure), "{figure}");
        }
    }
}
