use std::collections::BTreeSet;
use std::io::{Result, Write};

use anstyle::Style;
use centrode::analysis::{Report, Table};
use serde::Serialize;

pub(super) const HEADING: Style = Style::new().bold();
/// Width of the names and of each column of figures.
const NAME: usize = 32;
const COLUMN: usize = 12;

/// What a figure is measured in, which settles how it is shown.
#[derive(Clone, Copy)]
enum Unit {
    Count,
    Number,
    Millimetre,
    PerMillimetre,
    /// Kept in rad, shown in degrees.
    Degree,
    /// Kept and shown in rad: errors too small for degrees.
    Radian,
    RadianPerSecond,
    MillimetrePerSecond,
    Newton,
    NewtonMillimetre,
    TurnsPerMinute,
    Second,
}

/// A line of the table: what it is called, the figures on it, their unit.
struct Row(&'static str, &'static [&'static str], Unit);

/// A part of the table: its heading, the columns, the rows.
struct Group(&'static str, &'static [&'static str], &'static [Row]);

const GROUPS: [Group; 12] = [
    Group(
        "Pitch curves",
        &["driver", "driven"],
        &[
            Row(
                "teeth",
                &["driver_tooth_count", "driven_tooth_count"],
                Unit::Count,
            ),
            Row(
                "length",
                &["driver_pitch_length", "driven_pitch_length"],
                Unit::Millimetre,
            ),
            Row(
                "least radius",
                &["driver_radius_min", "driven_radius_min"],
                Unit::Millimetre,
            ),
            Row(
                "greatest radius",
                &["driver_radius_max", "driven_radius_max"],
                Unit::Millimetre,
            ),
            Row(
                "least curvature",
                &["driver_curvature_min", "driven_curvature_min"],
                Unit::PerMillimetre,
            ),
            Row(
                "greatest curvature",
                &["driver_curvature_max", "driven_curvature_max"],
                Unit::PerMillimetre,
            ),
        ],
    ),
    Group(
        "Teeth",
        &["driver", "driven"],
        &[
            Row(
                "tip radius, greatest",
                &["driver_tip_radius_max", "driven_tip_radius_max"],
                Unit::Millimetre,
            ),
            Row(
                "root radius, least",
                &["driver_root_radius_min", "driven_root_radius_min"],
                Unit::Millimetre,
            ),
            Row(
                "tip width, least",
                &["driver_tip_width_min", "driven_tip_width_min"],
                Unit::Millimetre,
            ),
            Row(
                "fillet radius, least",
                &["driver_fillet_radius_min", "driven_fillet_radius_min"],
                Unit::Millimetre,
            ),
        ],
    ),
    Group(
        "Mesh, over the whole cycle",
        &["least", "greatest"],
        &[
            Row(
                "ratio, driven to driver",
                &["ratio_min", "ratio_max"],
                Unit::Number,
            ),
            Row(
                "contacts at once",
                &["contact_ratio_min", "contact_ratio_max"],
                Unit::Count,
            ),
            Row("contact ratio, mean", &["contact_ratio_mean"], Unit::Number),
            Row(
                "backlash of the driven gear",
                &["backlash_min", "backlash_max"],
                Unit::Degree,
            ),
            Row(
                "backlash, normal",
                &["normal_backlash_min", "normal_backlash_max"],
                Unit::Millimetre,
            ),
            Row(
                "transmission error",
                &["", "transmission_error_max"],
                Unit::Radian,
            ),
            Row("overlap", &["", "overlap_max"], Unit::Millimetre),
            Row("pressure angle", &["", "pressure_angle_max"], Unit::Degree),
            Row(
                "sliding a rad of the driver",
                &["", "sliding_max"],
                Unit::Millimetre,
            ),
            Row(
                "clearance, tip to root",
                &["clearance_min"],
                Unit::Millimetre,
            ),
            Row(
                "clearance, tip to fillet",
                &["fillet_clearance_min"],
                Unit::Millimetre,
            ),
        ],
    ),
    Group(
        "Pitch curves of sun and intermediate gears",
        &["sun", "intermediate"],
        &[
            Row(
                "least radius",
                &["sun_radius_min", "intermediate_radius_min"],
                Unit::Millimetre,
            ),
            Row(
                "greatest radius",
                &["sun_radius_max", "intermediate_radius_max"],
                Unit::Millimetre,
            ),
            Row("length", &["pitch_length"], Unit::Millimetre),
        ],
    ),
    Group(
        "Reach of the tip from the carrier's axis",
        &[],
        &[
            Row("lowest", &["tip_lowest"], Unit::Millimetre),
            Row("highest", &["tip_highest"], Unit::Millimetre),
            Row(
                "farthest towards the tray",
                &["tip_farthest"],
                Unit::Millimetre,
            ),
            Row(
                "radius swept by the gearbox",
                &["gearbox_radius"],
                Unit::Millimetre,
            ),
        ],
    ),
    Group(
        "Speed at the design's rate",
        &[],
        &[
            Row("carrier", &["carrier_speed"], Unit::RadianPerSecond),
            Row(
                "tip at picking",
                &["picking_speed"],
                Unit::MillimetrePerSecond,
            ),
            Row(
                "the same with two arms",
                &["picking_speed_of_two_arms"],
                Unit::MillimetrePerSecond,
            ),
            Row(
                "tip at planting",
                &["planting_speed"],
                Unit::MillimetrePerSecond,
            ),
        ],
    ),
    Group(
        "Limits and settings",
        &[],
        &[
            Row("centre distance", &["center_distance"], Unit::Millimetre),
            Row("module", &["module"], Unit::Millimetre),
            Row(
                "largest module, no undercut",
                &["largest_module"],
                Unit::Millimetre,
            ),
            Row(
                "largest addendum, no undercut",
                &["largest_addendum"],
                Unit::Millimetre,
            ),
            Row("phase of the first tooth", &["phase"], Unit::Millimetre),
            Row("planet's zero, behind", &["planet_reference"], Unit::Degree),
            Row("closure error", &["closure_error"], Unit::Radian),
        ],
    ),
    Group(
        "Box and groove",
        &[],
        &[
            Row("moves while picking", &["moved_distance"], Unit::Millimetre),
            Row(
                "limit, a sixth of the pot",
                &["moved_distance_limit"],
                Unit::Millimetre,
            ),
            Row(
                "with a plain shaft",
                &["moved_distance_plain"],
                Unit::Millimetre,
            ),
            Row("amplitude", &["amplitude"], Unit::Millimetre),
            Row(
                "least speed over the mean",
                &["speed_ratio_min"],
                Unit::Number,
            ),
            Row(
                "greatest speed over the mean",
                &["speed_ratio_max"],
                Unit::Number,
            ),
            Row("turns out and back", &["cycle_turns"], Unit::Count),
            Row(
                "worst miss of a hole",
                &["misplacement_max"],
                Unit::Millimetre,
            ),
            Row("least lead angle", &["lead_angle_min"], Unit::Degree),
            Row("greatest lead angle", &["lead_angle_max"], Unit::Degree),
            Row(
                "greatest pressure angle",
                &["pressure_angle_max"],
                Unit::Degree,
            ),
            Row("tightest bend", &["bend_radius_min"], Unit::Millimetre),
            Row("crossings", &["crossing_count"], Unit::Count),
            Row(
                "longest gap at a crossing",
                &["crossing_gap_max"],
                Unit::Millimetre,
            ),
            Row(
                "slider in the groove, if flat",
                &["slider_guided_length"],
                Unit::Millimetre,
            ),
            Row(
                "clearance the slider needs",
                &["slider_clearance_min"],
                Unit::Millimetre,
            ),
        ],
    ),
    Group(
        "Forces on the slider",
        &[],
        &[
            Row("least on the strokes", &["normal_force_min"], Unit::Newton),
            Row(
                "greatest on the strokes",
                &["normal_force_max"],
                Unit::Newton,
            ),
            Row("while picking", &["normal_force_picking"], Unit::Newton),
            Row(
                "greatest in a reversal",
                &["normal_force_reversal_max"],
                Unit::Newton,
            ),
            Row("least torque", &["torque_min"], Unit::NewtonMillimetre),
            Row("greatest torque", &["torque_max"], Unit::NewtonMillimetre),
            Row("speed", &["speed_rpm"], Unit::TurnsPerMinute),
            Row(
                "stays on one wall up to",
                &["contact_limit_rpm"],
                Unit::TurnsPerMinute,
            ),
            Row("jams at a lead angle of", &["jamming_angle"], Unit::Degree),
        ],
    ),
    Group(
        "Strokes of the effector",
        &["feed", "return", "rest"],
        &[
            Row(
                "time",
                &["feed_time", "return_time", "dwell_time"],
                Unit::Second,
            ),
            Row(
                "greatest speed of the tip",
                &["tip_speed_feed_max", "tip_speed_return_max"],
                Unit::MillimetrePerSecond,
            ),
            Row(
                "feed time over return time",
                &["quick_return"],
                Unit::Number,
            ),
        ],
    ),
    Group(
        "Crank-rocker",
        &["least", "greatest"],
        &[
            Row(
                "angle of coupler and rocker",
                &["coupler_rocker_angle_min", "coupler_rocker_angle_max"],
                Unit::Degree,
            ),
            Row(
                "angle of the effector",
                &["effector_angle_min", "effector_angle_max"],
                Unit::Degree,
            ),
            Row(
                "swing, as made",
                &["swing_made_min", "swing_made_max"],
                Unit::Degree,
            ),
            Row("swing of the rocker", &["", "rocker_swing"], Unit::Degree),
            Row(
                "dead centres, folded, stretched",
                &["dead_center_folded", "dead_center_stretched"],
                Unit::Degree,
            ),
            Row(
                "crank free: driven, at rest",
                &["gear_play_moving_max", "gear_play_resting_max"],
                Unit::Degree,
            ),
            Row(
                "rest of the incomplete gear",
                &["dwell_angle"],
                Unit::Degree,
            ),
            Row(
                "crank while driven",
                &["", "crank_rpm_driven"],
                Unit::TurnsPerMinute,
            ),
        ],
    ),
    Group(
        "Box by the turn of the gears",
        &[],
        &[
            Row("eccentricity", &["gear_eccentricity"], Unit::Number),
            Row(
                "least speed over the mean",
                &["box_speed_ratio_min"],
                Unit::Number,
            ),
            Row(
                "greatest speed over the mean",
                &["box_speed_ratio_max"],
                Unit::Number,
            ),
            Row(
                "greatest acceleration, m/s^2",
                &["box_acceleration_max_m_s2"],
                Unit::Number,
            ),
            Row(
                "least normal force",
                &["box_normal_force_min"],
                Unit::Newton,
            ),
            Row(
                "greatest normal force",
                &["box_normal_force_max"],
                Unit::Newton,
            ),
            Row(
                "stays on one wall up to",
                &["box_contact_limit_rpm"],
                Unit::TurnsPerMinute,
            ),
        ],
    ),
];

/// Figures that go together, as rows and columns.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Section {
    heading: String,
    columns: Vec<String>,
    rows: Vec<Line>,
}

/// A row of a [`Section`].
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Line {
    name: String,
    unit: &'static str,
    cells: Vec<Option<Cell>>,
}

/// A figure of the report.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Cell {
    /// Its key in the report.
    key: String,
    /// As the command line shows it.
    shown: String,
    /// As the JSON report has it, to the last digit.
    exact: String,
}

impl Cell {
    fn of(report: &Report, key: &str, unit: Unit) -> Option<Self> {
        let value = *report.values.get(key)?;
        Some(Self {
            key: key.into(),
            shown: unit.show(value),
            exact: exact(value),
        })
    }
}

/// A figure as the writer of the JSON report has it; what is not finite is null.
fn exact(value: f64) -> String {
    serde_json::to_string(&value).unwrap_or_else(|_| "null".into())
}

/// Every table and figure of the report, figures of no group last.
pub(crate) fn sections(report: &Report) -> Vec<Section> {
    let mut shown: BTreeSet<&str> = BTreeSet::new();
    let mut sections: Vec<Section> = report.tables.iter().map(section).collect();
    for Group(heading, columns, rows) in &GROUPS {
        let mut lines = Vec::new();
        for Row(name, keys, unit) in *rows {
            shown.extend(*keys);
            let cells: Vec<Option<Cell>> = keys
                .iter()
                .map(|key| Cell::of(report, key, *unit))
                .collect();
            if cells.iter().any(Option::is_some) {
                let (name, unit) = ((*name).to_owned(), unit.name());
                lines.push(Line { name, unit, cells });
            }
        }
        if !lines.is_empty() {
            sections.push(Section {
                heading: (*heading).into(),
                columns: columns.iter().map(|&c| c.into()).collect(),
                rows: lines,
            });
        }
    }
    let rest = report.values.keys().filter(|key| !shown.contains(*key));
    let rows: Vec<Line> = rest
        .map(|key| Line {
            name: (*key).into(),
            unit: "",
            cells: vec![Cell::of(report, key, Unit::Number)],
        })
        .collect();
    if !rows.is_empty() {
        sections.push(Section {
            heading: "More".into(),
            columns: Vec::new(),
            rows,
        });
    }
    sections
}

/// A table as a section, in the units in which it is shown.
fn section(table: &Table) -> Section {
    let (factor, unit) = match table.unit {
        "rad" => (180.0 / std::f64::consts::PI, "deg"),
        unit => (1.0, unit),
    };
    let cell = |row: &str, column: usize, value: f64| Cell {
        key: format!("{}/{row}/{column}", table.name),
        shown: figure(value * factor, 4),
        exact: exact(value),
    };
    let line = |(name, figures): &(String, Vec<f64>)| Line {
        name: name.clone(),
        unit,
        cells: (0..)
            .zip(figures)
            .map(|(column, &value)| Some(cell(name, column, value)))
            .collect(),
    };
    Section {
        heading: table.title.into(),
        columns: table.columns.clone(),
        rows: table.rows.iter().map(line).collect(),
    }
}

/// Writes every figure in its group; figures of no group come last, as they are.
pub(super) fn write(report: &Report, out: &mut impl Write) -> Result<()> {
    let mut shown = BTreeSet::from([""]);
    for Group(heading, columns, rows) in &GROUPS {
        let known = |Row(_, keys, _): &Row| keys.iter().any(|key| report.values.contains_key(key));
        if !rows.iter().any(known) {
            continue;
        }
        let width = if columns.is_empty() { 0 } else { NAME };
        write!(out, "\n{HEADING}{heading:width$}{HEADING:#}")?;
        for column in *columns {
            write!(out, "  {column:>COLUMN$}")?;
        }
        writeln!(out)?;
        for Row(name, keys, unit) in *rows {
            if !keys.iter().any(|key| report.values.contains_key(key)) {
                continue;
            }
            write!(out, "  {name:width$}", width = NAME - 2)?;
            for key in *keys {
                shown.insert(key);
                let figure = report.values.get(key).map(|value| unit.show(*value));
                write!(out, "  {:>COLUMN$}", figure.unwrap_or_default())?;
            }
            let unit = unit.name();
            writeln!(out, "{}{unit}", if unit.is_empty() { "" } else { "  " })?;
        }
    }
    let mut heading = false;
    for (key, value) in report
        .values
        .iter()
        .filter(|(key, _)| !shown.contains(*key))
    {
        if !heading {
            writeln!(out, "\n{HEADING}More{HEADING:#}")?;
            heading = true;
        }
        writeln!(
            out,
            "  {key:width$}  {:>COLUMN$}",
            Unit::Number.show(*value),
            width = NAME - 2
        )?;
    }
    Ok(())
}

impl Unit {
    fn name(self) -> &'static str {
        match self {
            Self::Count | Self::Number => "",
            Self::Millimetre => "mm",
            Self::PerMillimetre => "1/mm",
            Self::Degree => "deg",
            Self::Radian => "rad",
            Self::RadianPerSecond => "rad/s",
            Self::MillimetrePerSecond => "mm/s",
            Self::Newton => "N",
            Self::NewtonMillimetre => "N mm",
            Self::TurnsPerMinute => "r/min",
            Self::Second => "s",
        }
    }

    /// The figure in few enough digits to read; what is smaller keeps its leading digits.
    fn show(self, value: f64) -> String {
        match self {
            Self::Count => format!("{value:.0}"),
            Self::Number | Self::PerMillimetre | Self::RadianPerSecond => figure(value, 6),
            Self::MillimetrePerSecond
            | Self::Newton
            | Self::NewtonMillimetre
            | Self::TurnsPerMinute => figure(value, 2),
            Self::Second => figure(value, 4),
            Self::Millimetre => figure(value, 4),
            Self::Degree => figure(value.to_degrees(), 4),
            Self::Radian => figure(value, 0),
        }
    }
}

/// A number with so many decimals, or in powers of ten where they would hide it; without decimals,
/// always in powers of ten.
pub(super) fn figure(value: f64, decimals: i32) -> String {
    let hidden = 50.0 * 0.1_f64.powi(decimals);
    if value == 0.0 {
        "0".into()
    } else if !value.is_finite() {
        "none".into()
    } else if value.abs() < hidden || value.abs() >= 1e9 {
        format!("{value:.1e}")
    } else {
        format!("{value:.0$}", usize::try_from(decimals).unwrap_or(0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_keep_what_matters() {
        assert_eq!(Unit::Millimetre.show(52.709_221), "52.7092");
        assert_eq!(Unit::Millimetre.show(-3.2e-7), "-3.2e-7");
        assert_eq!(Unit::Degree.show(std::f64::consts::PI), "180.0000");
        assert_eq!(Unit::Count.show(23.0), "23");
        assert_eq!(Unit::Radian.show(f64::INFINITY), "none");
        assert_eq!(Unit::Radian.show(-0.0), "0");
        assert_eq!(Unit::Radian.show(2.489e-7), "2.5e-7");
    }

    #[test]
    fn a_figure_of_no_group_is_shown_too() {
        let mut report = Report::default();
        report.values.insert("module", 2.25);
        report.values.insert("swing", 0.5);
        report.values.insert("clearance_min", f64::INFINITY);
        let exact: Vec<(String, String)> = sections(&report)
            .into_iter()
            .flat_map(|section| section.rows)
            .flat_map(|row| row.cells)
            .flatten()
            .map(|cell| (cell.key, cell.exact))
            .collect();
        let expected = [
            ("clearance_min", "null"),
            ("module", "2.25"),
            ("swing", "0.5"),
        ];
        assert_eq!(
            exact,
            expected.map(|(key, text)| (key.to_owned(), text.to_owned()))
        );
        let mut out = Vec::new();
        write(&report, &mut out).expect("written");
        let text = String::from_utf8(out).expect("text");
        assert!(text.contains("More") && text.contains("swing"), "{text}");
        assert!(text.contains("2.2500  mm"), "{text}");
    }
}
