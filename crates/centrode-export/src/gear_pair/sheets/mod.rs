//! The drawing sheets of a gear pair.

mod face;
mod part;
mod tables;
mod tooth;

use super::drawn;
use crate::{
    ExportError, SheetOptions, fit, linked::arrangement, number::mass, package::title_or_name,
};
use centrode_formats::sheet::{
    Corner, Draft, Scale, Sheet, SheetBlock, SheetError, TitleBlock, compose, view_letters,
};
use centrode_gear::{GearPair, Member, OverPins};
use centrode_geometry::Tolerance;
use centrode_kinematics::machine::Keyway;
use centrode_spec::{DrawingSpec, SheetSize};
pub(super) use part::middle;
use part::{Likeness, SheetGear, likeness};
pub(crate) use tables::{measured, over_pins};

/// Subject of a sheet.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum Subject {
    /// The driver.
    Driver,
    /// The driven gear.
    Driven,
    /// Both assembled.
    Assembly,
}

centrode_spec::words!(Subject {
    Driver = "driver",
    Driven = "driven",
    Assembly = "assembly",
});

impl Subject {
    /// The gear; `None` for both assembled.
    #[must_use]
    pub fn member(self) -> Option<Member> {
        match self {
            Self::Driver => Some(Member::Driver),
            Self::Driven => Some(Member::Driven),
            Self::Assembly => None,
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

/// Names of a gear in a machine larger than its pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Label<'a> {
    /// Name of its files.
    pub(crate) name: &'a str,
    /// Name of its drawing.
    pub(crate) title: &'a str,
    /// Gear it meshes with.
    pub(crate) mate: &'a str,
    /// Title of the machine.
    pub(crate) machine: &'a str,
    /// Words for the title block.
    pub(crate) drawing: &'a DrawingSpec,
    /// Number of these gears in the machine.
    pub(crate) quantity: usize,
}

/// The sheets of one gear, or of both assembled: views, dimensions, data, tables.
///
/// # Errors
/// [`ExportError::Sheet`] if the requested size is too small.
pub fn sheets(
    pair: &GearPair,
    subject: Subject,
    options: &SheetOptions,
    tolerance: Tolerance,
) -> Result<Vec<Sheet>, ExportError> {
    labelled(pair, subject, None, subject.name(), options, tolerance)
}

/// The sheets of a subject, or of a gear under a label; `file` is the name of its files.
pub(super) fn labelled(
    pair: &GearPair,
    subject: Subject,
    label: Option<Label<'_>>,
    file: &str,
    options: &SheetOptions,
    tolerance: Tolerance,
) -> Result<Vec<Sheet>, ExportError> {
    let sheets = match subject.member() {
        Some(member) => {
            let mut part = SheetGear::new(pair, member, tolerance);
            part.label = label;
            part.file = file.to_owned();
            let limits = pair.pin_limits(member);
            gear(&part, limits.as_ref(), block(&part, options), options)
        }
        None => arrangement(&drawn(pair), options, tolerance),
    };
    sheets.map_err(ExportError::no_sheet(subject.name()))
}

/// The title block of a gear's sheets.
fn block(part: &SheetGear<'_>, options: &SheetOptions) -> TitleBlock {
    let pair = part.pair;
    let title = match part.member {
        Member::Driver => "Driver gear",
        Member::Driven => "Driven gear",
    };
    TitleBlock {
        title: part.label.map_or(title, |label| label.title).to_owned(),
        supplement: match part.label {
            Some(label) => label.machine.to_owned(),
            None => title_or_name(pair.title(), pair.name()).to_owned(),
        },
        ..TitleBlock::new(part.drawing(), part.name(), options.projection)
    }
}

fn gear(
    part: &SheetGear<'_>,
    limits: Option<&[OverPins; 2]>,
    mut block: TitleBlock,
    options: &SheetOptions,
) -> Result<Vec<Sheet>, SheetError> {
    block.document = "Part drawing".into();
    block.material = part.gear.body().material.clone();
    block.mass = mass(super::arrangement::mass(part.gear) * 1e3);
    let data = tables::data(part, &options.found);
    let details: Vec<Draft> = tooth::extremes(part)
        .into_iter()
        .zip(['E', 'F'])
        .map(|((tooth, place), letter)| tooth::detail(part, letter, tooth, place))
        .collect();
    let bore = face::bore(part);
    let mut lines = notes(part);
    let bore_class = part.gear.body();
    let bore_class = bore_class.bore_fit.as_str();
    lines.extend(block.fitted([bore_class], "the flanks"));
    let projection = block.projection;
    let pieces = |scale: Scale, size: SheetSize| {
        let face = face::views(part, scale, view_letters(size), projection);
        let mut pieces = vec![
            SheetBlock::table("gear data table", &data),
            SheetBlock::notes(&lines),
            SheetBlock::view("face view with section", face),
        ];
        let bore = bore.iter().cloned();
        pieces
            .extend(bore.map(|draft| SheetBlock::detail("bore detail", draft, Corner::LowerRight)));
        let details = details.iter().cloned();
        pieces.extend(
            details.map(|draft| SheetBlock::detail("tooth detail", draft, Corner::LowerLeft)),
        );
        pieces
    };
    let bounds = part.bounds();
    let extent = (bounds.max - bounds.min).amax().max(part.gear.body().width);
    let pins = part.gear.over_pins(part.pair.pin_diameter(part.member));
    let flowing = [tables::over_pins(&pins, limits), tables::profile(part)];
    let size = options.size.or(part.drawing().sheet);
    compose(size, &block, extent, &pieces, &flowing)
}

fn notes(part: &SheetGear<'_>) -> Vec<String> {
    let mut lines = vec![
        format!("Exact tooth profile: {}.step.", part.file),
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
    lines.push(format!("Teeth and spaces are numbered {},", part.sense()));
    lines.push("tooth k before space k; numbers are at the spaces.".to_owned());
    lines.push("Dimensions of the teeth are auxiliary: the profile holds.".to_owned());
    let body = part.gear.body();
    if let Some(key) = body.keyway {
        let angle = fit::keyway_angle(body.keyway_angle, body.bore, key.width);
        lines.push(format!("Keyway at polar angle {angle}."));
    }
    if part.label.is_none() && body.bore > 0.0 {
        // The shaft of a pair alone belongs to the machine around it: it has no sheet here.
        let shaft = body.seat("");
        let seat = format!("To sit on a shaft {}", fit::shaft(&shaft));
        if let Some(key) = body.keyway.map(Keyway::of_shaft) {
            let width = fit::keyway(key.width, fit::SHAFT_KEYWAY);
            let rest = fit::shaft_depth(body.bore, key);
            lines.extend([seat, format!("with a keyway {width}, Ø - depth {rest}.")]);
        } else {
            lines.push(format!("{seat}, fixed there by the customer."));
        }
    }
    if let Some(label) = part.label {
        lines.push(format!("{} for each machine.", label.quantity));
    } else {
        lines.extend(likeness(part.pair).map(|alike| {
            let same = match alike {
                Likeness::All => "are the same part",
                Likeness::AllButMark => "are the same but for their marks",
                Likeness::Teeth => "have the same teeth",
            };
            format!("Driver and driven gear {same}.")
        }));
    }
    lines
}
