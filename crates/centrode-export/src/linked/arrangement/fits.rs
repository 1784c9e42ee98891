use crate::fit;
use centrode_formats::drawing::Anchor;
use centrode_formats::sheet::{Table, broken, number};
use centrode_kinematics::machine::{Fit, LinkedMachine};

/// The fits of a machine: size with both classes, minimum and maximum clearance.
pub(super) fn table(machine: &LinkedMachine) -> Table {
    let words = |fit: &Fit| match (&*fit.hole, &*fit.shaft) {
        ("", "") => fit::size(fit),
        (hole, shaft) => format!("{} {hole}/{shaft}", fit::size(fit)),
    };
    let clearance = |fit: &Fit| {
        let [minimum, maximum] = fit.clearance()?;
        Some(format!("{} to {}", number(minimum, 4), number(maximum, 4)))
    };
    let rows = machine.fits.iter().flat_map(|fit| {
        let clearance = clearance(fit).unwrap_or_default();
        broken(&fit.name, &words(fit), &clearance)
    });
    let all_known = machine.fits.iter().all(|fit| fit.clearance().is_some());
    Table {
        title: "Fits, ISO 286".into(),
        headings: ["", "size", "clearance"].map(String::from).to_vec(),
        columns: vec![Anchor::Left; 3],
        rows: rows.collect(),
        notes: match all_known {
            true => Vec::new(),
            false => vec!["No clearance: class or size beyond the tables.".into()],
        },
    }
    .filled()
}
