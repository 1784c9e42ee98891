//! The drawing sheets of a gear pair.

mod assembly;
mod face;
mod part;
mod tables;
mod tooth;

use crate::{
    drawing::Anchor,
    sheet::{Corner, Draft, Piece, Scale, Sheet, SheetError, Table, TitleBlock, compose, number},
};
use centrode_geometry::{Point, Tolerance};
use centrode_mechanism::{
    design::{Projection, SheetSize},
    gear::{GearPair, Member},
};
use part::Part;

/// What a sheet is of.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum Subject {
    /// The driver.
    Driver,
    /// The driven gear.
    Driven,
    /// Both in place.
    Assembly,
}

impl Subject {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Driver, Self::Driven, Self::Assembly];

    /// The name its files have.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Driver => "driver",
            Self::Driven => "driven",
            Self::Assembly => "assembly",
        }
    }
}

impl From<Member> for Subject {
    fn from(member: Member) -> Self {
        match member {
            Member::Driver => Self::Driver,
            Member::Driven => Self::Driven,
        }
    }
}

/// What the contact analysis has found, for the tables of the sheets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meshing {
    /// Least and greatest number of tooth pairs in contact.
    pub contact_ratio: [f64; 2],
    /// Least and greatest play along the common normal, mm.
    pub backlash: [f64; 2],
}

/// What a gear is called in a machine larger than its pair.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub struct Label {
    /// The name its files have.
    pub name: &'static str,
    /// What its drawing is called.
    pub title: &'static str,
    /// What it meshes with.
    pub mate: &'static str,
    /// How many of it a machine has.
    pub quantity: u32,
}

/// How sheets are laid out where it is not to be as the design says.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SheetOptions {
    /// Size; left out, the design's, and without one there the smallest that takes the part.
    pub size: Option<SheetSize>,
    /// How views lie to each other; left out, as the design says.
    pub projection: Option<Projection>,
    /// What the contact analysis has found; left out, the sheets do not tell.
    pub meshing: Option<Meshing>,
    /// What the gear is called; left out, driver or driven.
    pub label: Option<Label>,
}

/// The sheets of one gear, or of both in place: views, dimensions, data, tables.
///
/// # Errors
/// [`SheetError`] if the size asked for is too small.
pub fn sheets(
    pair: &GearPair,
    subject: Subject,
    options: &SheetOptions,
    tolerance: Tolerance,
) -> Result<Vec<Sheet>, SheetError> {
    match subject {
        Subject::Driver => gear(pair, Member::Driver, options, tolerance),
        Subject::Driven => gear(pair, Member::Driven, options, tolerance),
        Subject::Assembly => both(pair, options, tolerance),
    }
}

/// The title block of a subject's sheets, and the size and projection that hold.
fn block(pair: &GearPair, subject: Subject, options: &SheetOptions) -> TitleBlock {
    let spec = pair.drawing();
    let mut block = TitleBlock::of(spec);
    if !spec.number.is_empty() {
        let name = options.label.map_or(subject.name(), |label| label.name);
        block.number = format!("{}-{name}", spec.number);
    }
    block.projection = options.projection.unwrap_or(spec.projection);
    let (title, supplement) = match subject {
        Subject::Driver => ("Driver gear", pair.title()),
        Subject::Driven => ("Driven gear", pair.title()),
        Subject::Assembly => ("Gear pair", pair.title()),
    };
    block.title = options.label.map_or(title, |label| label.title).to_owned();
    block.supplement = match supplement {
        "" => pair.name(),
        title => title,
    }
    .to_owned();
    block
}

fn gear(
    pair: &GearPair,
    member: Member,
    options: &SheetOptions,
    tolerance: Tolerance,
) -> Result<Vec<Sheet>, SheetError> {
    let mut part = Part::new(pair, member, tolerance);
    part.label = options.label;
    let mut block = block(pair, member.into(), options);
    block.document = "Part drawing".into();
    block.material = part.gear.body().material.clone();
    block.mass = mass(&part);
    let data = tables::data(&part, options.meshing);
    let details: Vec<Draft> = tooth::extremes(&part)
        .into_iter()
        .zip(['C', 'D'])
        .map(|((tooth, place), letter)| tooth::detail(&part, letter, tooth, place))
        .collect();
    let bore = face::bore(&part);
    let lines = notes(&part);
    let projection = block.projection;
    let pieces = |scale: Scale, size: SheetSize| {
        let view = |name, draft, corner, leads| Piece {
            name,
            draft,
            corner,
            floats: true,
            leads,
        };
        let face = face::views(&part, scale, letters(size), projection);
        let mut pieces = vec![
            table_piece("gear data table", &data),
            notes_piece(&lines, Corner::UpperRight),
            view("face view with section", face, Corner::UpperLeft, true),
        ];
        let bore = bore.iter().cloned();
        pieces.extend(bore.map(|draft| view("bore detail", draft, Corner::LowerRight, false)));
        let details = details.iter().cloned();
        pieces.extend(details.map(|draft| view("tooth detail", draft, Corner::LowerLeft, false)));
        pieces
    };
    let bounds = part.bounds();
    let extent = (bounds.max - bounds.min).amax();
    let flowing = [tables::over_pins(&part), tables::profile(&part)];
    let size = options.size.or(pair.drawing().sheet);
    compose(size, &block, extent, &pieces, &flowing)
}

fn both(
    pair: &GearPair,
    options: &SheetOptions,
    tolerance: Tolerance,
) -> Result<Vec<Sheet>, SheetError> {
    let [driver, driven] =
        [Member::Driver, Member::Driven].map(|member| Part::new(pair, member, tolerance));
    let mut block = block(pair, Subject::Assembly, options);
    block.document = "Assembly drawing".into();
    let data = tables::pair_data(pair, options.meshing);
    let lines = [
        "Shown at φ = 0: pitch point on the line of centres.".to_owned(),
        "φ is the polar angle of the pitch point on the driver;".to_owned(),
        "the driver has then turned clockwise by φ,".to_owned(),
        "the driven gear counter-clockwise by the angle of the table.".to_owned(),
        "Driver tooth k runs in driven space k - 1,".to_owned(),
        "driven tooth k in driver space k.".to_owned(),
    ];
    let motion = tables::motion(pair);
    // One turn of a table goes beside the gears, more on to the next sheet.
    let (beside, flowing) = if motion.rows.len() <= 40 {
        (Some(motion), Vec::new())
    } else {
        (None, vec![motion])
    };
    let pieces = |scale: Scale, size: SheetSize| {
        let mut pieces = vec![
            table_piece("gear pair data table", &data),
            notes_piece(&lines, Corner::UpperRight),
            Piece {
                name: "view of both gears",
                draft: assembly::view(&driver, &driven, scale, letters(size)),
                corner: Corner::UpperLeft,
                floats: true,
                leads: true,
            },
        ];
        pieces.extend(beside.iter().map(|table| Piece {
            corner: Corner::UpperLeft,
            ..table_piece("motion table", table)
        }));
        pieces
    };
    let a = pair.center_distance();
    let width = driven.bounds().max.x + a - driver.bounds().min.x;
    let size = options.size.or(pair.drawing().sheet);
    compose(size, &block, width, &pieces, &flowing)
}

/// Height of the letters of the views, mm: smaller on the smallest sheet.
fn letters(size: SheetSize) -> f64 {
    match size {
        SheetSize::A4 => 2.5,
        _ => 3.5,
    }
}

fn table_piece(name: &'static str, table: &Table) -> Piece {
    Piece {
        name,
        draft: table.whole(),
        corner: Corner::UpperRight,
        floats: false,
        leads: false,
    }
}

fn notes_piece(lines: &[String], corner: Corner) -> Piece {
    let mut draft = Draft::default();
    for (row, line) in lines.iter().enumerate() {
        let at = Point::new(0.0, -4.6 * row as f64);
        draft.text(at, 2.5, line, Anchor::Left);
    }
    Piece {
        name: "notes",
        draft,
        corner,
        floats: false,
        leads: false,
    }
}

fn notes(part: &Part<'_>) -> Vec<String> {
    let name = part.name();
    let mut lines = vec![
        format!("Exact tooth profile: {name}.step, points {name}.csv."),
        "Polar angles from the line of centres at φ = 0,".to_owned(),
        format!(
            "counter-clockwise; the mate's axis lies at {}°.",
            if part.member == Member::Driver {
                0
            } else {
                180
            }
        ),
    ];
    lines.push(format!("Teeth and spaces are numbered {}.", part.sense()));
    let body = part.gear.body();
    if body.keyway.is_some() {
        lines.push(match body.keyway_angle {
            0.0 => "Keyway on the x axis, at polar angle 0°.".to_owned(),
            angle => format!("Keyway at polar angle {}°.", number(angle.to_degrees(), 4)),
        });
    }
    if let Some(label) = part.label {
        lines.push(format!("{} of these a machine.", label.quantity));
    } else if part.pair.congruent() && part.pair.driver().body() == part.pair.driven().body() {
        lines.push("Driver and driven gear are the same part.".to_owned());
    }
    lines
}

/// Mass of the gear, for the title block.
fn mass(part: &Part<'_>) -> String {
    let body = part.gear.body();
    let bore = part.bore.as_ref().map_or(0.0, |bore| bore.area());
    let grams = (part.gear.outline().area() - bore) * body.width * body.density * 1e-6;
    if grams >= 1000.0 {
        format!("{} kg", number(grams / 1000.0, 3))
    } else {
        format!("{} g", number(grams, 1))
    }
}
