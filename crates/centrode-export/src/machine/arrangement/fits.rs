use centrode_mechanism::machine::{Fit, Machine};

use crate::drawing::Anchor;
use crate::sheet::{Table, broken, fit, number};

/// The fits of a machine: size with both classes, least and greatest play.
pub(super) fn table(machine: &Machine) -> Table {
    let words = |fit: &Fit| match (&*fit.hole, &*fit.shaft) {
        ("", "") => fit::size(fit),
        (hole, shaft) => format!("{} {hole}/{shaft}", fit::size(fit)),
    };
    let play = |fit: &Fit| {
        let [least, greatest] = fit.play()?;
        Some(format!("{} to {}", number(least, 4), number(greatest, 4)))
    };
    let rows = machine.fits.iter().flat_map(|fit| {
        let play = play(fit).unwrap_or_default();
        broken(&fit.name, &words(fit), &play)
    });
    let all_known = machine.fits.iter().all(|fit| fit.play().is_some());
    Table {
        title: "Fits, ISO 286".into(),
        headings: ["", "size", "play"].map(String::from).to_vec(),
        columns: vec![Anchor::Left; 3],
        rows: rows.collect(),
        notes: match all_known {
            true => Vec::new(),
            false => vec!["No play: class or size beyond the tables.".into()],
        },
    }
    .filled()
}
