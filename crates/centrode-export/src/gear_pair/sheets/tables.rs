//! The tables of a gear's sheets.

use super::part::{Part, degrees};
use crate::{
    Meshing,
    drawing::Anchor,
    sheet::{Table, number},
};
use centrode_mechanism::gear::{
    CurvatureRange, GearPair, Member, PinFault, ToolKind, design::Addendum,
};

/// Most points of the contour on paper.
const POINTS: usize = 138;

/// The gear data, in the order of ISO 1340 as far as it goes.
pub(super) fn data(part: &Part<'_>, meshing: Option<Meshing>) -> Table {
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
    rows.add_long("Pitch curve", "", &definition);
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
    pair_rows(pair, meshing, &mut rows);
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

/// Rows common to both gears.
fn pair_rows(pair: &GearPair, meshing: Option<Meshing>, rows: &mut Rows) {
    let (driver, driven) = pair.mean_ratio();
    rows.add(
        "Mean ratio, turns driver : driven",
        "",
        format!("{driver}:{driven}"),
    );
    let a = pair.center_distance();
    let (least, greatest) = pair.rolling().radii(Member::Driver);
    let ratios = [least / (a - least), greatest / (a - greatest)];
    rows.add("Ratio, driven : driver speed", "i", range(ratios, 6));
    rows.add("Centre distance", "a", number(a, 6));
    rows.add(
        "Backlash, as designed, normal",
        "jn",
        number(pair.backlash(), 4),
    );
    if let Some(meshing) = meshing {
        rows.add(
            "Backlash, as proved, normal",
            "jn",
            range(meshing.backlash, 4),
        );
        let [low, high] = meshing.contact_ratio;
        rows.add("Pairs of teeth in contact", "", range([low, high], 0));
    }
}

/// Rows of the pair on the assembly sheet.
pub(super) fn pair_data(pair: &GearPair, meshing: Option<Meshing>) -> Table {
    let mut rows = Rows::default();
    let [z1, z2] = [pair.driver(), pair.driven()].map(|gear| gear.tooth_count());
    rows.add("Number of teeth", "z1 / z2", format!("{z1} / {z2}"));
    rows.add("Module", "m", number(pair.module(), 6));
    let tool = &pair.teeth().tool;
    rows.add(
        "Pressure angle",
        "α",
        format!("{}°", number(tool.pressure_angle.to_degrees(), 4)),
    );
    rows.add_long("Driver's pitch curve", "", pair.definition());
    pair_rows(pair, meshing, &mut rows);
    let radius = pair.rolling().radius(0.0);
    rows.add("Pitch point at φ = 0, from driver", "r", number(radius, 6));
    rows.add("Ratio at φ = 0", "i", number(pair.ratio(0.0), 6));
    rows.table("Gear pair data")
}

/// The driven angle and the ratio every ten degrees of the driver over a whole cycle.
pub(super) fn motion(pair: &GearPair) -> Table {
    let steps = (pair.cycle().to_degrees() / 10.0).round() as u32;
    let rows = (0..=steps).map(|i| {
        let phi = f64::from(10 * i).to_radians();
        vec![
            (10 * i).to_string(),
            format!("{:.4}", pair.driven_angle(phi).to_degrees()),
            format!("{:.5}", pair.ratio(phi)),
        ]
    });
    Table {
        title: "Motion".into(),
        headings: ["driver φ °", "driven °", "ratio i"]
            .map(String::from)
            .to_vec(),
        columns: vec![Anchor::Right; 3],
        rows: rows.collect(),
        notes: vec!["full table: motion.csv".into()],
    }
}

/// The measure over a pin in every space.
pub(super) fn over_pins(part: &Part<'_>) -> Table {
    let pins = part.gear.over_pins(part.pair.pin_diameter(part.member));
    let mut faults = Vec::new();
    let rows = pins.pins.iter().enumerate().map(|(space, pin)| match pin {
        Ok(pin) => {
            let [j, m] = pins
                .across(space)
                .map_or([String::new(), String::new()], |(j, m)| {
                    [j.to_string(), format!("{m:.4}")]
                });
            vec![
                space.to_string(),
                format!("{:.4}", degrees(pin.center)),
                format!("{:.4}", pin.center.coords.norm()),
                format!("{:.4}", pin.radial),
                j,
                m,
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
            row.extend(std::iter::repeat_n(mark, 5));
            row
        }
    });
    let rows = rows.collect();
    let mut notes = vec![
        "angle, R: polar position of the pin's centre".to_owned(),
        "M: from the axis of the bore over the pin".to_owned(),
        "M2: over this pin and the one in the space opposite".to_owned(),
    ];
    let named = faults.iter().enumerate();
    notes.extend(named.map(|(i, fault): (usize, &PinFault)| format!("*{} {fault}", i + 1)));
    Table {
        title: format!("Over pins Ø{}", number(pins.diameter, 3)),
        headings: ["space", "angle °", "R", "M", "opposite", "M2"]
            .map(String::from)
            .to_vec(),
        columns: vec![Anchor::Right; 6],
        rows,
        notes,
    }
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
            format!("{:.4}", s.point.x),
            format!("{:.4}", s.point.y),
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

fn range([low, high]: [f64; 2], places: usize) -> String {
    let [low, high] = [low, high].map(|x| number(x, places));
    if low == high {
        low
    } else {
        format!("{low} to {high}")
    }
}

/// Longest value on one line, letters.
const LINE: usize = 38;

#[derive(Default)]
struct Rows(Vec<Vec<String>>);

impl Rows {
    fn add(&mut self, name: &str, symbol: &str, value: String) {
        if value.chars().count() > LINE {
            return self.add_long(name, symbol, &value);
        }
        self.0.push(vec![name.to_owned(), symbol.to_owned(), value]);
    }

    /// A value of several lines, broken at blanks, and within a word longer than a line.
    fn add_long(&mut self, name: &str, symbol: &str, value: &str) {
        let mut lines: Vec<String> = vec![String::new()];
        for word in value.split(' ') {
            let letters: Vec<char> = word.chars().collect();
            for part in letters.chunks(LINE) {
                let part: String = part.iter().collect();
                let last = lines.last_mut();
                match last {
                    Some(line) if line.is_empty() => line.push_str(&part),
                    Some(line) if line.chars().count() + 1 + part.chars().count() <= LINE => {
                        line.push(' ');
                        line.push_str(&part);
                    }
                    _ => lines.push(part),
                }
            }
        }
        for (row, line) in lines.into_iter().enumerate() {
            let (name, symbol) = if row == 0 { (name, symbol) } else { ("", "") };
            self.0.push(vec![name.to_owned(), symbol.to_owned(), line]);
        }
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
