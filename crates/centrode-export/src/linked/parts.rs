use crate::number::mass;
use centrode_formats::csv::Column;
use centrode_formats::drawing::Anchor;
use centrode_formats::sheet::Table;
use centrode_kinematics::machine::{LinkedMachine, Part, Supply};

/// The parts list of a machine, numbered from one; empty columns are omitted.
#[must_use]
pub fn parts_list(machine: &LinkedMachine) -> Table {
    let row = |(index, part): (usize, &Part)| {
        vec![
            (index + 1).to_string(),
            part.name.clone(),
            part.quantity().to_string(),
            material(part),
            part.mass.map(|kg| mass(kg * 1e3)).unwrap_or_default(),
            part.file.clone(),
            part.remark.clone(),
        ]
    };
    let headings = [
        ("item", Anchor::Right),
        ("part", Anchor::Left),
        ("quantity", Anchor::Right),
        ("material", Anchor::Left),
        ("mass of one", Anchor::Right),
        ("files", Anchor::Left),
        ("remark", Anchor::Left),
    ];
    let weighed = machine
        .parts
        .iter()
        .filter(|part| part.mass.is_some())
        .count();
    let sum: f64 = (0..machine.links.len())
        .map(|link| machine.mass_of_pieces(link))
        .sum();
    let together = mass(sum * 1e3);
    let note = match weighed {
        0 => None,
        all if all == machine.parts.len() => Some(format!("Together {together}.")),
        _ => Some(format!("Parts with a mass: together {together}.")),
    };
    // For a shaft from the customer the design knows only the end in the gear.
    let mut given = machine.parts.iter().map(|part| part.supply);
    let given = given.any(|supply| supply == Supply::Given);
    let given =
        given.then(|| "Parts marked given come from the customer; sizes are in the remark.".into());
    Table {
        title: "Parts".into(),
        headings: headings.map(|(heading, _)| heading.into()).into(),
        columns: headings.map(|(_, anchor)| anchor).into(),
        rows: machine.parts.iter().enumerate().map(row).collect(),
        notes: note.into_iter().chain(given).collect(),
    }
    .filled()
}

/// Material of a part, or where it comes from.
fn material(part: &Part) -> String {
    match part.supply {
        Supply::Made => part.material.clone(),
        supply => supply.name().into(),
    }
}

/// The parts list as columns of a comma-separated table.
pub(super) fn columns(machine: &LinkedMachine) -> Vec<Column> {
    let words = |heading: &str, of: &dyn Fn(&Part) -> String| {
        // A comma would end the cell.
        let cell = |part: &Part| of(part).replace(',', ";").replace('"', "''");
        Column::words(heading, machine.parts.iter().map(cell))
    };
    let links = |part: &Part| {
        let mut names: Vec<&str> = Vec::new();
        for &link in &part.links {
            let name = machine.links[link].name.as_str();
            if !names.contains(&name) {
                names.push(name);
            }
        }
        names.join(" ")
    };
    vec![
        Column::words(
            "item",
            (1..=machine.parts.len()).map(|item| item.to_string()),
        ),
        words("part", &|part| part.name.clone()),
        words("quantity", &|part| part.quantity().to_string()),
        words("supply", &|part| part.supply.name().into()),
        words("material", &|part| part.material.clone()),
        words("blank", &|part| {
            part.blank
                .map(|blank| blank.to_string())
                .unwrap_or_default()
        }),
        words("mass_kg", &|part| {
            part.mass
                .map(|mass| format!("{mass:?}"))
                .unwrap_or_default()
        }),
        words("links", &links),
        words("files", &|part| part.file.clone()),
        words("remark", &|part| part.remark.clone()),
    ]
}
