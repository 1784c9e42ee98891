//! The tables of a gear's sheets.

use super::part::{Part, degrees};
use crate::gear_pair::arrangement;
use crate::{
    drawing::Anchor,
    sheet::{Table, broken, fixed, number, range},
};
use centrode_mechanism::{
    gear::{CurvatureRange, GearPair, Member, OverPins, PinFault, ToolKind, design::Addendum},
    machine::Datum,
};

/// Most points of the contour on paper.
const POINTS: usize = 138;

/// The gear data, in the order of ISO 1340 as far as it goes.
pub(super) fn data(part: &Part<'_>, found: &[Datum]) -> Table {
    let (pair, gear) = (part.pair, part.gear);
    let teeth = pair.teeth();
    let tool = &teeth.tool;
    let m = pair.module();
    let shift = match part.member {
        Member::Driver => tool.profile_shift,
        Member::Driven => -tool.profile_shift,
    };
    let body = gear.body();
    let mut rows = Rows::default();
    rows.add("Number of teeth", "z", gear.tooth_count().to_string());
    rows.add("Module", "m", number(m, 6));
    rows.add(
        "Pressure angle",
        "α",
        format!("{}°", number(tool.pressure_angle.to_degrees(), 4)),
    );
    rows.add("Addendum coefficient", "ha*", number(tool.addendum / m, 4));
    let clearance = (tool.dedendum - tool.addendum) / m;
    rows.add("Clearance coefficient", "c*", number(clearance, 4));
    rows.add("Tool tip radius", "ρ", number(tool.tip_radius, 4));
    rows.add("Profile shift", "x·m", number(shift, 4));
    rows.add(
        "Tool",
        "",
        match tool.kind {
            ToolKind::Rack => "rack".to_owned(),
            ToolKind::Shaper { radius } => {
                format!("shaper, {} teeth", number(2.0 * radius / m, 2))
            }
        },
    );
    rows.add(
        "Addendum",
        "",
        match teeth.addendum {
            Addendum::Full => "full height".to_owned(),
            Addendum::Fitted => "fitted tooth by tooth".to_owned(),
        },
    );
    let definition = match part.member {
        Member::Driver => pair.definition().to_owned(),
        Member::Driven => format!("rolls on the driver's: {}", pair.definition()),
    };
    rows.add("Pitch curve", "", &definition);
    rows.add("Length of pitch curve", "", number(gear.pitch_length(), 6));
    let (least, greatest) = pair.rolling().radii(part.member);
    rows.add("Pitch radius", "r", range([least, greatest], 4));
    let bend = CurvatureRange::of(pair.rolling(), part.member);
    rows.add(
        "Curvature of pitch curve",
        "1/mm",
        range([bend.least.1, bend.greatest.1], 6),
    );
    let mate = part.member.mate();
    let mate = match part.label {
        Some(label) => label.mate.to_owned(),
        None => mate_name(pair, mate),
    };
    rows.add("Mate", "", mate);
    for datum in arrangement::of_both(pair).iter().chain(found) {
        rows.add(&datum.name, &datum.symbol, &datum.value);
    }
    rows.add("Accuracy class", "", body.accuracy.clone());
    rows.add("Material", "", body.material.clone());
    rows.add("Heat treatment", "", body.heat_treatment.clone());
    rows.table("Gear data")
}

fn mate_name(pair: &GearPair, mate: Member) -> String {
    let number = &pair.drawing().number;
    let name = if number.is_empty() {
        mate.name().to_owned()
    } else {
        format!("{number}-{}", mate.name())
    };
    let same = if pair.congruent() { ", same part" } else { "" };
    format!("{name}, {} teeth{same}", pair.gear(mate).tooth_count())
}

/// The measure over a pin in every space, with limits where the thickness of the teeth has them.
pub(super) fn over_pins(part: &Part<'_>, limits: Option<&[OverPins; 2]>) -> Table {
    let pins = part.gear.over_pins(part.pair.pin_diameter(part.member));
    // Of thicker teeth the measures are greater.
    let between = |of: &dyn Fn(&OverPins) -> Option<f64>| {
        let ends = limits.map(|both| both.each_ref().map(of));
        match ends {
            Some([Some(high), Some(low)]) => format!("{} / {}", fixed(high, 4), fixed(low, 4)),
            _ => String::new(),
        }
    };
    let mut faults = Vec::new();
    let rows = pins.pins.iter().enumerate().map(|(space, pin)| match pin {
        Ok(pin) => {
            let across = pins.across(space);
            let [j, m, limits_across] = across.map_or_else(Default::default, |(j, m)| {
                let limits = between(&|over| over.over(space, j));
                [j.to_string(), fixed(m, 4), limits]
            });
            let limits = between(&|over| over.pins[space].as_ref().ok().map(|pin| pin.radial));
            vec![
                space.to_string(),
                fixed(degrees(pin.center), 4),
                fixed(pin.center.coords.norm(), 4),
                fixed(pin.radial, 4),
                limits,
                j,
                m,
                limits_across,
            ]
        }
        Err(fault) => {
            let known = faults.iter().position(|f| f == fault);
            let at = known.unwrap_or_else(|| {
                faults.push(*fault);
                faults.len() - 1
            });
            let mark = format!("*{}", at + 1);
            let mut row = vec![space.to_string()];
            row.extend(std::iter::repeat_n(mark, 7));
            row
        }
    });
    let rows = rows.collect();
    let mut notes = vec![
        "angle, R: polar position of the pin's centre".to_owned(),
        "M: from the axis of the bore over the pin".to_owned(),
        "M2: over this pin and the one in the space opposite".to_owned(),
    ];
    if limits.is_some() {
        notes.push("limits: by the deviations of tooth thickness".to_owned());
    }
    let named = faults.iter().enumerate();
    notes.extend(named.map(|(i, fault): (usize, &PinFault)| format!("*{} {fault}", i + 1)));
    Table {
        title: format!("Over pins Ø{}", number(pins.diameter, 3)),
        headings: [
            "space",
            "angle °",
            "R",
            "M",
            "limits of M",
            "opposite",
            "M2",
            "limits of M2",
        ]
        .map(String::from)
        .to_vec(),
        columns: vec![Anchor::Right; 8],
        rows,
        notes,
    }
    .filled()
}

/// Points of the contour, every so many of those in the CSV file.
pub(super) fn profile(part: &Part<'_>) -> Table {
    let samples = part.gear.outline().samples(part.tolerance);
    let every = samples.len().div_ceil(POINTS).max(1);
    let rows = samples.iter().enumerate().step_by(every).map(|(i, s)| {
        let role = part.gear.roles().get(s.segment).map_or("", |r| r.name());
        let owner = part.gear.owners().get(s.segment);
        vec![
            (i + 1).to_string(),
            fixed(s.point.x, 4),
            fixed(s.point.y, 4),
            role.to_owned(),
            owner.map_or_else(String::new, u32::to_string),
        ]
    });
    let name = part.name();
    let which = match every {
        1 => "every point".to_owned(),
        n => format!("one point in {n}"),
    };
    Table {
        title: "Profile".into(),
        headings: ["row", "x", "y", "part", "tooth"]
            .map(String::from)
            .to_vec(),
        columns: vec![
            Anchor::Right,
            Anchor::Right,
            Anchor::Right,
            Anchor::Left,
            Anchor::Right,
        ],
        rows: rows.collect(),
        notes: vec![
            format!("{which}; all {}:", samples.len()),
            format!("{name}.csv, same rows"),
        ],
    }
}

#[derive(Default)]
struct Rows(Vec<Vec<String>>);

impl Rows {
    /// A value, on several lines where it is long.
    fn add(&mut self, name: &str, symbol: &str, value: impl AsRef<str>) {
        self.0.extend(broken(name, symbol, value.as_ref()));
    }

    fn table(self, title: &str) -> Table {
        Table {
            title: title.to_owned(),
            headings: Vec::new(),
            columns: vec![Anchor::Left; 3],
            rows: self.0,
            notes: Vec::new(),
        }
    }
}
