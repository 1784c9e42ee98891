//! The general arrangement of any machine: its views at one input, with dimensions, item numbers of the parts, and
//! data.

mod axes;
mod fits;
mod measure;
mod scene;
mod stacks;
mod view;

use centrode_formats::drawing::Anchor;
use centrode_formats::sheet::{
    Corner, Draft, Scale, Sheet, SheetBlock, SheetError, Table, TitleBlock, broken, compose, number,
};
use centrode_geometry::Tolerance;
use centrode_kinematics::machine::{Column, LinkedMachine, Place};
use centrode_spec::SheetSize;

use super::cuts::cut_list;
use super::parts::parts_list;
use crate::SheetOptions;
use crate::number::{fixed, mass};
use axes::Length;
use scene::Scene;
use stacks::Stack;
use view::View;

/// Name of the sheet.
pub(crate) const NAME: &str = "assembly";
/// Longest side of a machine for which the smallest sheet that takes it at full scale is chosen, mm; larger ones are drawn on
/// [`LARGE`].
const SMALL: f64 = 420.0;
const LARGE: SheetSize = SheetSize::A2;
/// Step of the table of motion, degrees.
const STEP: u32 = 10;
/// Maximum number of rows of a table of motion next to the view; longer ones continue on further sheets.
const BESIDE: usize = 40;

/// The general arrangement of a machine: its figures in their positions at the input of the arrangement, axes, dimensions, parts
/// list and data.
///
/// Dimensions are the distances of shafts that are fixed, the extent of the drawn paths of points, and those of
/// [`LinkedMachine::arrangement`]; a table has the distances between the axes of each link.
///
/// # Errors
/// [`SheetError`] where the requested sheet is too small.
pub fn arrangement(
    machine: &LinkedMachine,
    options: &SheetOptions,
    tolerance: Tolerance,
) -> Result<Vec<Sheet>, SheetError> {
    let stated = &machine.arrangement;
    let mut block = TitleBlock::new(&stated.drawing, NAME, options.projection);
    block.title = match &*stated.title {
        "" => "Machine".into(),
        title => title.into(),
    };
    block.supplement = machine.heading().to_owned();
    block.document = "General arrangement".into();
    let whole = machine.parts.iter().all(|part| part.mass.is_some());
    if let Some(found) = machine.mass_properties(stated.input).filter(|_| whole) {
        block.mass = mass(found.mass * 1e3);
    }
    let scene = Scene::new(machine, tolerance);
    let axes = axes::axes(&scene);
    let lengths = lengths(axes::lengths(&scene, &axes));
    let view = View {
        dimensions: measure::dimensions(&scene, &axes),
        balloons: balloons(machine),
        axes,
        scene,
    };
    let stacks = Stack::all(machine, &view.scene.places, tolerance);
    let stacks: Vec<Draft> = stacks.iter().map(|stack| stack.draft(tolerance)).collect();
    let (parts, data) = (parts_list(machine), data(machine, options));
    let fits = fits::table(machine);
    let (beside, mut flowing): (Vec<Table>, Vec<Table>) = motion(machine)
        .into_iter()
        .partition(|table| table.rows.len() <= BESIDE);
    flowing.insert(0, cut_list(machine));
    let further = stated.tables.iter().map(|table| Table {
        title: table.title.clone(),
        headings: table.headings.clone(),
        columns: vec![Anchor::Left; table.headings.len()],
        rows: table.rows.clone(),
        notes: Vec::new(),
    });
    flowing.splice(0..0, further);
    let pieces = |scale: Scale, size| {
        let tables = [
            ("parts list", &parts),
            ("data", &data),
            ("fits", &fits),
            ("distances of axes", &lengths),
        ];
        let filled = tables
            .into_iter()
            .filter(|(_, table)| !table.rows.is_empty());
        let mut pieces: Vec<SheetBlock> = filled
            .map(|(name, table)| SheetBlock::table(name, table))
            .collect();
        if !stated.notes.is_empty() {
            pieces.push(SheetBlock::notes(&stated.notes));
        }
        if !view.scene.lines.is_empty() {
            pieces.push(SheetBlock::view("machine", view.draft(scale, size)));
        }
        let sections = stacks.iter().cloned();
        let section = |draft| SheetBlock::further("section", draft);
        pieces.extend(sections.map(section));
        pieces.extend(beside.iter().map(|table| SheetBlock {
            corner: Corner::UpperLeft,
            ..SheetBlock::table("motion", table)
        }));
        pieces
    };
    // If nothing is drawn, the bounds are empty.
    let size = view.scene.whole.max - view.scene.whole.min;
    let extent = size.x.max(size.y).max(0.0);
    let usual = (extent > SMALL).then_some(LARGE);
    let size = options.size.or(stated.drawing.sheet).or(usual);
    compose(size, &block, extent, &pieces, &flowing)
}

/// Item numbers of the parts list with the positions they point to; parts at one position share a balloon.
fn balloons(machine: &LinkedMachine) -> Vec<(Place, String)> {
    let mut all: Vec<(Place, String)> = Vec::new();
    for (index, part) in machine.parts.iter().enumerate() {
        let Some(place) = part.place else { continue };
        let item = (index + 1).to_string();
        match all.iter_mut().find(|(known, _)| *known == place) {
            Some((_, items)) => *items += &format!(", {item}"),
            None => all.push((place, item)),
        }
    }
    all
}

/// Data of the machine, and results of checks.
fn data(machine: &LinkedMachine, options: &SheetOptions) -> Table {
    let stated = machine.arrangement.data.iter().chain(&options.found);
    Table {
        title: "Data".into(),
        columns: vec![Anchor::Left; 3],
        rows: stated
            .flat_map(|datum| broken(&datum.name, &datum.symbol, &datum.value))
            .collect(),
        ..Table::default()
    }
    .filled()
}

fn lengths(all: Vec<Length>) -> Table {
    let row = |Length {
                   link,
                   between,
                   length,
               }| vec![link, between, number(length, 4)];
    Table {
        title: "Distances of axes".into(),
        headings: ["link", "between", "mm"].map(String::from).into(),
        columns: vec![Anchor::Left, Anchor::Left, Anchor::Right],
        rows: all.into_iter().map(row).collect(),
        notes: Vec::new(),
    }
}

/// The columns of motion of the machine, over one period; `None` if it has none.
fn motion(machine: &LinkedMachine) -> Option<Table> {
    let stated = &machine.arrangement.columns;
    if stated.is_empty() {
        return None;
    }
    let columns = stated.iter().map(|&index| &machine.columns[index]);
    let steps = (machine.input.period.to_degrees() / f64::from(STEP)).round() as u32;
    let (headings, factors): (Vec<String>, Vec<(f64, usize)>) = columns
        .clone()
        .map(|column| {
            let unit = format!("_{}", column.unit);
            let name = axes::words(column.name.strip_suffix(&unit).unwrap_or(&column.name));
            match column.unit.as_str() {
                "rad" => (format!("{name} °"), (1_f64.to_degrees(), 4)),
                "1" => (name, (1.0, 5)),
                unit => (format!("{name} {unit}"), (1.0, 4)),
            }
        })
        .unzip();
    let row = |i: u32| {
        let input = f64::from(STEP * i).to_radians();
        let cells = columns.clone().zip(&factors);
        let cell = |(column, (factor, places)): (&Column, &(f64, usize))| {
            let value = machine.value(&column.quantity, input);
            fixed(value * factor, *places)
        };
        cells.map(cell).collect()
    };
    Some(Table {
        title: "Motion".into(),
        columns: vec![Anchor::Right; headings.len()],
        headings,
        rows: (0..=steps).map(row).collect(),
        notes: vec!["full table: motion.csv".into()],
    })
}
