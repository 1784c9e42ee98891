use super::pins::pins;
use crate::cutting::{self, CENTER, HOLE, PROFILE};
use crate::fit;
use crate::gear_pair::{by_thickness, measured, over_pins, tooth_runout};
use crate::number::capital;
use crate::plate::{Exactness, Hole, Plate};
use centrode_formats::csv::Column;
use centrode_formats::drawing::{Anchor, Color, Drawing, EntityShape, LineType};
use centrode_formats::sheet::{Table, broken, number};
use centrode_gear::{IntermittentPair, Member};
use centrode_geometry::{Arc, Outline, Point, Segment, Tolerance};
use centrode_kinematics::machine::Datum;
use centrode_machines::feeder::{Feeder, GearBody};
use nalgebra::Isometry2;

/// Names of gears and cams in lists and titles, in the order of [`GearBody::NAMES`].
pub(super) const TITLES: [&str; 4] = [
    "intermittent gear",
    "gear on the crank",
    "entry cam",
    "exit cam",
];

/// Layer of cams.
const CAM: &str = "CAM";
/// Maximum deviation of a fitted arc from the circle that the contour follows, relative to the circle's radius.
const FITTED: f64 = 1e-3;

/// Driver, driven gear and, where there is an entry angle, the cams next to the driver; their contours are arcs within the
/// tolerance.
pub(super) fn parts(feeder: &Feeder, gears: &IntermittentPair, tolerance: Tolerance) -> Vec<Plate> {
    let pair = gears.pair();
    let (driver, driven) = (pair.driver(), pair.driven());
    let part = |body: GearBody| {
        let name = body.name;
        let is_cam = body.is_cam();
        let (title, bore) = (capital(title(name)), body.bore);
        let mut part = Plate::of_body(name, &title, body.outline, bore, driver.body())
            .noted("Drawn as the motion begins: on the intermittent gear x points to the axis of")
            .noted("the gear on the crank, on that away from the intermittent gear's.")
            .noted("Keyed along x: gears and cams stand right on the shaft.");
        let cams = TITLES[2..].iter().zip(gears.cams());
        let labels = cams.flat_map(|(cam, own)| own.pins.iter().map(move |_| cam));
        if !body.pins.is_empty() {
            part = part.noted("Each pin stands out on the side of its cam.");
        }
        part.holes.extend(
            body.pins
                .into_iter()
                .zip(labels)
                .map(|(outline, cam)| Hole {
                    label: format!("pin of {cam}"),
                    fit: Feeder::CAM_PIN_FIT[0].into(),
                    off: 0.02,
                    ..Hole::from(outline)
                }),
        );
        if is_cam {
            part = part.noted("Fixed next to the intermittent gear, its x axis on that one's.");
            part.exactness = Some(Exactness::Profile);
        }
        part
    };
    let mut all: Vec<Plate> = GearBody::all(gears, tolerance)
        .into_iter()
        .map(part)
        .collect();
    let teeth = [
        format!("{} of {}", gears.teeth(), driver.tooth_count()),
        driven.tooth_count().to_string(),
    ];
    let members = [Member::Driver, Member::Driven];
    for ((part, member), teeth) in all.iter_mut().zip(members).zip(teeth) {
        let spec = &feeder.design().gears;
        let limits = pair.thickness_deviations(member);
        let over = |thinner: f64| pins(gears, member, 0.5 * spec.entry, thinner);
        let limits = limits.map(|stated| stated.limits.map(|deviation| over(-deviation)));
        let pins = over(0.0);
        part.exactness = tooth_runout(pair, member).map(Exactness::Teeth);
        let measured = (0..)
            .zip(&pins.pins)
            .find_map(|(k, pin)| Some((k, pin.ok()?.center)));
        if let Some((space, at)) = measured {
            let angle = at.y.atan2(at.x);
            let body = pair.gear(member).body();
            let angle = match body.keyway {
                Some(key) => fit::keyway_angle(angle, body.bore, key.width),
                None => format!("{}°", number(angle.to_degrees(), 4)),
            };
            part.notes.push(format!(
                "Timing: middle of space {space}, centre-punched, at {angle} from the keyway."
            ));
            let below = at.coords.norm() - 2.0 * pair.module();
            part.marks.push(Point::from(at.coords.normalize() * below));
        }
        part.heat_treatment = None;
        let mut stated = data(feeder, gears, member, &teeth);
        stated
            .rows
            .extend(locked(&part.outline, gears.lock_radius()));
        part.tables = vec![stated, over_pins(&pins, limits.as_ref())];
    }
    for part in &mut all {
        let file = format!("{}.csv", part.name);
        let points = Table::of_file("Profile points", &file, &columns(part));
        part.tables.push(points);
    }
    all
}

/// Row of the gear data: polar angles of the locking arc about the gear's own axis. `None` if the locking arcs of the gear are
/// about the mate's axis.
fn locked(outline: &Outline, radius: f64) -> Option<Vec<String>> {
    let is_lock = |arc: &Arc| {
        let off = (arc.radius() - radius)
            .abs()
            .max(arc.center().coords.norm());
        off < FITTED * radius
    };
    let arcs = outline.segments().iter().filter_map(|side| match side {
        Segment::Arc(arc) if is_lock(arc) => Some(arc),
        _ => None,
    });
    let arcs: Vec<&Arc> = arcs.collect();
    let from = *arcs.iter().find(|arc| {
        let begins = |other: &&Arc| (other.end - arc.start).norm() < FITTED * radius;
        !arcs.iter().any(begins)
    })?;
    let turn: f64 = arcs.iter().map(|arc| arc.sweep()).sum();
    let first = from.start.y.atan2(from.start.x);
    let [first, last] = [first, first + turn].map(|angle| number(angle.to_degrees(), 1));
    let row = [
        "Locking arc, polar angles",
        "",
        &format!("{first}° to {last}°"),
    ];
    Some(row.map(String::from).to_vec())
}

/// Name of a gear or cam in lists and titles, from the name of its files.
fn title(file: &str) -> &str {
    let at = GearBody::NAMES.iter().position(|name| *name == file);
    at.map_or(file, |at| TITLES[at])
}

/// The data of a gear.
fn data(feeder: &Feeder, gears: &IntermittentPair, member: Member, teeth: &str) -> Table {
    let (pair, spec) = (gears.pair(), &feeder.design().gears);
    let tool = pair.teeth().tool(member);
    let pitch = pair.gear(member).pitch_length() / std::f64::consts::PI;
    let angle = format!("{}°", number(tool.pressure_angle.to_degrees(), 4));
    let mut data = vec![
        Datum::new("Teeth, of pitches all round", "", teeth),
        Datum::new("Module", "m", number(pair.module(), 4)),
        Datum::new("Pressure angle", "α", angle),
        Datum::new("Pitch diameter", "d", number(pitch, 4)),
        Datum::new("Tip diameter", "da", number(2.0 * tip(gears, member), 3)),
        Datum::new("Normal backlash", "jn", number(spec.backlash, 4)),
        Datum::new("Radius of locking arc", "", number(gears.lock_radius(), 4)),
        Datum::new("Play of lock", "", number(spec.lock_clearance, 4)),
        Datum::new("Centre distance", "a", number(gears.center_distance(), 4)),
    ];
    data.extend(by_thickness(pair, spec.backlash));
    data.extend(measured(pair, member));
    let rows = data
        .iter()
        .flat_map(|datum| broken(&datum.name, &datum.symbol, &datum.value));
    Table {
        title: "Gear data".into(),
        columns: vec![Anchor::Left; 3],
        rows: rows.collect(),
        ..Table::default()
    }
}

/// Radius of the tips of a gear's teeth, mm: distance from its axis to the farthest corner of its contour.
fn tip(gears: &IntermittentPair, member: Member) -> f64 {
    let outline = match member {
        Member::Driver => gears.driver(),
        Member::Driven => gears.driven(),
    };
    let corners = outline.segments().iter().map(Segment::start);
    corners.map(|at| at.coords.norm()).fold(0.0, f64::max)
}

/// Corners of a part's contour, in order, each with the bulge of the side that begins there: the tangent of a quarter of the
/// arc's angle, 0 for a line.
pub(super) fn columns(part: &Plate) -> Vec<Column> {
    let segments = part.outline.segments();
    let of = |value: fn(&Segment) -> f64| segments.iter().map(value);
    let bulge = |segment: &Segment| match segment {
        Segment::Arc(arc) => arc.bulge,
        _ => 0.0,
    };
    vec![
        Column::numbers("x_mm", of(|side| side.start().x)),
        Column::numbers("y_mm", of(|side| side.start().y)),
        Column::numbers("bulge", of(bulge)),
    ]
}

/// The gears assembled, at the start of the motion.
pub(super) fn assembly(gears: &IntermittentPair, parts: &[Plate]) -> Drawing {
    let mut drawing = cutting::drawing().layer(CAM, Color::Green, LineType::Continuous, 0.25);
    for part in parts {
        let x = match &*part.name {
            name if name == GearBody::NAMES[1] => gears.center_distance(),
            _ => 0.0,
        };
        let place = Isometry2::translation(x, 0.0);
        let layer = match GearBody::NAMES[2..].contains(&&*part.name) {
            true => CAM,
            false => PROFILE,
        };
        for hole in &part.holes {
            drawing.draw(HOLE, EntityShape::Contour(hole.outline.transformed(&place)));
        }
        drawing.draw(CENTER, EntityShape::Mark(place * Point::origin()));
        drawing.draw(
            layer,
            EntityShape::Contour(part.outline.transformed(&place)),
        );
    }
    drawing
}
