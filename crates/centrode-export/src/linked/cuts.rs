use centrode_formats::drawing::Anchor;
use centrode_formats::sheet::Table;
use centrode_kinematics::machine::{Blank, LinkedMachine, Part};

/// Minimum number of parts with a blank for a cut list: the parts of a gear pair are on their own sheets.
const WORTH_IT: usize = 4;

/// The pieces of stock that a machine is made from, sorted by material and thickness; empty for few parts.
pub(super) fn cut_list(machine: &LinkedMachine) -> Table {
    let mut cuts: Vec<(usize, &Part, Blank)> = machine
        .parts
        .iter()
        .enumerate()
        .filter_map(|(index, part)| Some((index + 1, part, part.blank?)))
        .collect();
    if cuts.len() < WORTH_IT {
        cuts.clear();
    }
    cuts.sort_by(|(_, a, first), (_, b, second)| {
        let by_stock = key(first).total_cmp(&key(second));
        a.material.cmp(&b.material).then(by_stock)
    });
    let row = |(item, part, blank): (usize, &Part, Blank)| {
        vec![
            item.to_string(),
            part.name.clone(),
            part.quantity().to_string(),
            part.material.clone(),
            blank.to_string(),
        ]
    };
    let headings = ["item", "part", "quantity", "material", "blank, mm"];
    let columns = [
        Anchor::Right,
        Anchor::Left,
        Anchor::Right,
        Anchor::Left,
        Anchor::Left,
    ];
    Table {
        title: "Cut list".into(),
        headings: headings.map(String::from).into(),
        columns: columns.into(),
        rows: cuts.into_iter().map(row).collect(),
        notes: vec!["Net sizes: add what the cut takes.".into()],
    }
    .filled()
}

/// Order of blanks: plates by thickness, then bars by diameter.
fn key(blank: &Blank) -> f64 {
    match blank {
        Blank::Plate { thickness, .. } => -1.0 / thickness,
        Blank::Round { diameter, .. } => *diameter,
    }
}
