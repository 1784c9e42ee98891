//! The tables of a gear's sheets.

use super::part::{Likeness, SheetGear, degrees, likeness};
use crate::gear_pair::{arrangement, flank_tolerances, outline};
use crate::{
    number::{fixed, range},
    treatment::treatment,
};
use centrode_formats::{
    drawing::Anchor,
    sheet::{Table, broken, number},
};
use centrode_gear::design::Addendum;
use centrode_gear::{GearPair, Member, OverPins, PinFault, ToolKind};
use centrode_kinematics::machine::Datum;

/// The gear data, in the order of ISO 1340 as far as it goes.
pub(super) fn data(part: &SheetGear<'_>, found: &[Datum]) -> Table {
    let (pair, gear) = (part.pair, part.gear);
    let teeth = pair.teeth();
    let tool = teeth.tool(part.member);
    let m = pair.module();
    let mut rows = Rows::default();
    rows.add("Number of teeth", "z", gear.tooth_count().to_string());
    rows.add("Module", "m", number(m, 6));
    rows.add(
        "Pressure angle",
        "α",
        format!("{}°", number(tool.pressure_angle.to_degrees(), 4)),
    );
    rows.add("Addendum coefficient", "ha*", number(tool.addendum / m, 4));
    let clearance = (tool.dedendum - teeth.tool(part.member.mate()).addendum) / m;
    rows.add("Clearance coefficient", "c*", number(clearance, 4));
    rows.add("Tool tip radius", "ρ", number(tool.tip_radius, 4));
    rows.add(
        "Profile shift",
        "x·m",
        number(teeth.profile_shift(part.member), 4),
    );
    for datum in shifted(pair, part.member) {
        rows.add(&datum.name, &datum.symbol, &datum.value);
    }
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
        Member::Driven => {
            let mate = if part.label.is_some() {
                "mate"
            } else {
                "driver"
            };
            format!("rolls on the {mate}'s: {}", pair.definition())
        }
    };
    rows.add("Pitch curve", "", &definition);
    rows.add("Length of pitch curve", "", number(gear.pitch_length(), 6));
    let (minimum, maximum) = pair.rolling().radii(part.member);
    rows.add("Pitch radius", "r", range([minimum, maximum], 4));
    let bend = pair.rolling().curvature_ranges()[part.member as usize];
    rows.add(
        "Curvature of pitch curve",
        "1/mm",
        range([bend.minimum.1, bend.maximum.1], 6),
    );
    let mate = part.member.mate();
    let mate = match part.label {
        Some(label) => label.mate.to_owned(),
        None => mate_name(pair, mate),
    };
    rows.add("Mate", "", mate);
    let own = part.label.map(|_| part.member);
    for datum in arrangement::of_both(pair, own).iter().chain(found) {
        rows.add(&datum.name, &datum.symbol, &datum.value);
    }
    let measures = base_tangent(pair, part.member);
    for datum in measures.into_iter().chain(measured(pair, part.member)) {
        rows.add(&datum.name, &datum.symbol, &datum.value);
    }
    rows.table("Gear data")
}

/// Coefficients and heights of a gear with profile shift, changed addendum, or heights or tool of its own, and the operating
/// pressure angle of its pair.
fn shifted(pair: &GearPair, member: Member) -> Vec<Datum> {
    let (teeth, tool, m) = (pair.teeth(), pair.teeth().tool(member), pair.module());
    let (x, k) = (pair.shift(member), pair.tip_shortening());
    let mut data = Vec::new();
    let design = pair.design();
    let spec = match member {
        Member::Driver => &design.driver,
        Member::Driven => &design.driven,
    };
    let is_own = spec.addendum.is_some() || spec.dedendum.is_some() || spec.tool.is_some();
    if x != 0.0 || k != 0.0 || is_own {
        data.push(Datum::new("Profile shift coefficient", "x", number(x, 4)));
        data.push(Datum::new("Tip shortening coefficient", "k", number(k, 5)));
        // Fitted teeth each have their own heights.
        if teeth.addendum == Addendum::Full {
            let (tip, root) = (tool.addendum + (x + k) * m, tool.dedendum - x * m);
            data.push(Datum::new("Addendum", "ha", number(tip, 4)));
            data.push(Datum::new("Dedendum", "hf", number(root, 4)));
        }
    }
    let angle = pair.pressure_angle();
    if angle != teeth.pressure_angle() {
        let degrees = format!("{}°", number(angle.to_degrees(), 4));
        data.push(Datum::new("Operating pressure angle", "αw", degrees));
        let diameter = number(pair.reference_diameter(member), 4);
        data.push(Datum::new("Reference diameter", "d", diameter));
    }
    data
}

/// Base tangent length of a circular gear, with its limits by the deviations of tooth thickness.
fn base_tangent(pair: &GearPair, member: Member) -> Option<Datum> {
    let found = pair.base_tangent(member).ok()?;
    let mut value = fixed(found.length, 4);
    if let Some(deviations) = pair.thickness_deviations(member) {
        // The deviations of thickness are those on the pitch circle.
        let cos = pair.pressure_angle().cos();
        let [upper, lower] = deviations.limits.map(|d| fixed(found.length + d * cos, 3));
        value = format!("{value} ({upper} / {lower})");
    }
    let name = format!("Base tangent length over {} teeth", found.teeth);
    Some(Datum::new(&name, "W", value))
}

/// Flank tolerances, deviations of tooth thickness, material and heat treatment of a gear, for the table of its data.
pub(crate) fn measured(pair: &GearPair, member: Member) -> Vec<Datum> {
    let body = pair.gear(member).body();
    let treated = treatment(&body.heat_treatment);
    let mut data = flank_tolerances(pair, member);
    if let Some(stated) = pair.thickness_deviations(member) {
        let [upper, lower] = stated.limits.map(|deviation| number(deviation, 4));
        let name = match stated.series {
            Some(series) => format!("Tooth thickness, DIN 3967 {series}h"),
            None => "Tooth thickness, deviations".into(),
        };
        data.push(Datum::new(&name, "Es", format!("{upper} / {lower}")));
    }
    data.push(Datum::new("Material", "", &*body.material));
    data.push(Datum::new("Heat treatment", "", treated));
    data
}

fn mate_name(pair: &GearPair, mate: Member) -> String {
    let number = &pair.drawing().number;
    let name = if number.is_empty() {
        mate.name().to_owned()
    } else {
        format!("{number}-{}", mate.name())
    };
    let same = match likeness(pair) {
        Some(Likeness::All) => ", same part",
        Some(Likeness::AllButMark) => ", same but for marks",
        Some(Likeness::Teeth) => ", same teeth",
        None => "",
    };
    format!("{name}, {} teeth{same}", pair.gear(mate).tooth_count())
}

/// The measure over a pin in every space, with limits where the thickness of the teeth has them.
pub(crate) fn over_pins(pins: &OverPins, limits: Option<&[OverPins; 2]>) -> Table {
    // Thicker teeth have greater measures: the first limit is the maximum.
    let between = |of: &dyn Fn(&OverPins) -> Option<f64>| {
        let ends = limits.map(|both| both.each_ref().map(of));
        match ends {
            Some([Some(high), Some(low)]) => format!("{} / {}", fixed(high, 3), fixed(low, 3)),
            _ => String::new(),
        }
    };
    let mut faults: Vec<(PinFault, Vec<usize>)> = Vec::new();
    let mut rows = Vec::new();
    for (space, pin) in pins.pins.iter().enumerate() {
        let pin = match pin {
            Ok(pin) => pin,
            Err(fault) => {
                match faults.iter_mut().find(|(known, _)| known == fault) {
                    Some((_, spaces)) => spaces.push(space),
                    None => faults.push((*fault, vec![space])),
                }
                continue;
            }
        };
        let across = pins.across(space);
        let [j, m, limits_across] = across.map_or_else(Default::default, |(j, m)| {
            let limits = between(&|over| over.over(space, j));
            [j.to_string(), fixed(m, 4), limits]
        });
        let limits = between(&|over| over.pins[space].as_ref().ok().map(|pin| pin.radial));
        rows.push(vec![
            space.to_string(),
            fixed(degrees(pin.center), 4),
            fixed(pin.center.coords.norm(), 4),
            fixed(pin.radial, 4),
            limits,
            j,
            m,
            limits_across,
        ]);
    }
    let mut notes = vec![
        "angle, R: polar position of the pin's centre".to_owned(),
        "M: from the axis of the bore over the pin".to_owned(),
        "M2: over this pin and the one in the other space, opposite".to_owned(),
    ];
    if limits.is_some() {
        notes.push("limits: by the deviations of tooth thickness".to_owned());
    }
    for (fault, spaces) in faults {
        notes.push(format!("spaces not measured: {}", runs(&spaces)));
        notes.push(fault.to_string());
    }
    Table {
        title: format!("Over pins Ø{}", number(pins.diameter, 3)),
        headings: [
            "space",
            "angle °",
            "R",
            "M",
            "limits of M",
            "other",
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

/// Numbers in rising order, neighbours as a run: "0, 4 to 7".
fn runs(numbers: &[usize]) -> String {
    let runs = numbers.chunk_by(|a, b| a + 1 == *b);
    let words = runs.map(|run| match run {
        [first, .., last] => format!("{first} to {last}"),
        _ => run.iter().map(usize::to_string).collect(),
    });
    words.collect::<Vec<_>>().join(", ")
}

/// File of the points of the contour.
pub(super) fn profile(part: &SheetGear<'_>) -> Table {
    let points = outline::columns(part.gear, part.tolerance);
    Table::of_file("Profile points", &format!("{}.csv", part.file), &points)
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

#[cfg(test)]
mod tests {
    use super::*;
    use centrode_gear::design::GearPairDesign;
    use centrode_gear::pitch::{Circle, PitchSpec};

    #[test]
    fn the_gear_data_list_shifts_heights_and_the_operating_angle() {
        let mut design = GearPairDesign::new(PitchSpec::Circle(Circle {
            module: Some(3.0),
            tooth_count: Some(12),
            ..Circle::default()
        }));
        design.mean_ratio = [2, 1];
        let rows = |design: &GearPairDesign, member| {
            let pair = GearPair::resolve(design).expect("a pair");
            let rows = shifted(&pair, member).into_iter();
            rows.map(|row| (row.symbol, row.value)).collect::<Vec<_>>()
        };
        assert!(rows(&design, Member::Driver).is_empty());
        let stated = |rows: &[(&str, &str)]| {
            let owned = rows
                .iter()
                .map(|(symbol, value)| (symbol.to_string(), value.to_string()));
            owned.collect::<Vec<_>>()
        };
        (design.driver.shift, design.driven.shift) = (Some(0.6), Some(0.36));
        // Of the example of ISO 21771 in the tests of published figures: tip 39.7 mm, root 33.33 mm about a reference circle of 36 mm.
        let expected = [
            ("x", "0.36"),
            ("k", "-0.12671"),
            ("ha", "3.6999"),
            ("hf", "2.67"),
            ("αw", "26.0886°"),
            ("d", "72"),
        ];
        assert_eq!(rows(&design, Member::Driven), stated(&expected));
        // Own heights and a shaper on a pair without shifts, only on the driver's sheet.
        let mut own = design.clone();
        (own.driver.shift, own.driven.shift) = (None, None);
        (own.driver.addendum, own.driver.dedendum) = (Some(1.1), Some(1.15));
        let heights = [("x", "0"), ("k", "0"), ("ha", "3.3"), ("hf", "3.45")];
        assert_eq!(rows(&own, Member::Driver), stated(&heights));
        assert!(rows(&own, Member::Driven).is_empty());
        design.driven.shift = None;
        let opposite = [("x", "-0.6"), ("k", "0"), ("ha", "1.2"), ("hf", "5.55")];
        assert_eq!(rows(&design, Member::Driven), stated(&opposite));
        design.mean_ratio = [1, 1];
        design.pitch = PitchSpec::Circle(Circle {
            module: Some(3.0),
            tooth_count: Some(24),
            ..Circle::default()
        });
        design.driver.shift = Some(0.4);
        design.teeth.thickness_deviations = Some([-0.03, -0.06]);
        let pair = GearPair::resolve(&design).expect("a pair");
        // 32.8266 mm without backlash; less 0.03 cos 20 deg and 0.06 cos 20 deg.
        let row = base_tangent(&pair, Member::Driver).expect("a length");
        assert_eq!(row.name, "Base tangent length over 4 teeth");
        assert_eq!(row.value, "32.8266 (32.798 / 32.770)");
        // Thicker teeth have a longer one: 0.05 cos 20 deg.
        design.teeth.thickness_deviations = Some([0.05, 0.0]);
        let pair = GearPair::resolve(&design).expect("a pair");
        let row = base_tangent(&pair, Member::Driver).expect("a length");
        assert_eq!(row.value, "32.8266 (32.874 / 32.827)");
    }
}
