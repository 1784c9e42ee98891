use centrode_geometry::{Point, Segment, Tolerance};
use centrode_mechanism::feeder::{Feeder, GearBody};
use centrode_mechanism::gear::{Gear, IntermittentPair};
use nalgebra::Isometry2;

use crate::csv::Column;
use crate::drawing::{Anchor, CENTER, Color, Drawing, HOLE, LineType, PROFILE, Shape};
use crate::plate::{Hole, Plate};
use crate::sheet::{Table, capital, number};

const CAM: &str = "CAM";

/// Tolerance class of the holes into which the pins are pressed.
pub(super) const PIN_HOLES: &str = "H7";
/// Tolerance class of the pins, ISO 8734.
pub(super) const PINS: &str = "m6";

/// Driver, driven gear and, where there is an entry angle, the cams beside the driver; with arcs within the tolerance.
pub(super) fn parts(feeder: &Feeder, gears: &IntermittentPair, tolerance: Tolerance) -> Vec<Plate> {
    let pair = gears.pair();
    let (driver, driven) = (pair.driver(), pair.driven());
    let table = |gear: &Gear, teeth: String| data(feeder, gears, gear, teeth);
    let part = |body: GearBody| {
        let name = body.name;
        let is_cam = body.is_cam();
        let mut part = Plate::of_body(
            [name, &capital(name)],
            body.outline,
            body.bore,
            driver.body(),
        )
        .noted(&format!("Points of the contour: {name}.csv."))
        .noted("Drawn as the motion begins: on the driver x points to the")
        .noted("driven gear's axis, on the driven gear away from the driver's.")
        .noted("Keyed along x: gears and cams stand right on the shaft.");
        part.holes.extend(body.pins.into_iter().map(|outline| Hole {
            label: "pin".into(),
            fit: PIN_HOLES.into(),
            off: 0.02,
            ..Hole::from(outline)
        }));
        match is_cam {
            true => part.noted("Fixed beside the driver, its x axis on the driver's."),
            false => part,
        }
    };
    let mut all: Vec<Plate> = GearBody::all(gears, tolerance)
        .into_iter()
        .map(part)
        .collect();
    let teeth = [
        format!("{} of {}", gears.teeth(), driver.tooth_count()),
        driven.tooth_count().to_string(),
    ];
    for ((part, gear), teeth) in all.iter_mut().zip([driver, driven]).zip(teeth) {
        part.tables = vec![table(gear, teeth)];
    }
    all
}

/// The data of a gear.
fn data(feeder: &Feeder, gears: &IntermittentPair, gear: &Gear, teeth: String) -> Table {
    let (pair, spec) = (gears.pair(), &feeder.design().gears);
    let tool = &pair.teeth().tool;
    let pitch = gear.pitch_length() / std::f64::consts::PI;
    let row = |name: &str, value: String| vec![name.to_owned(), value];
    Table {
        title: "Gear data".into(),
        headings: Vec::new(),
        columns: vec![Anchor::Left, Anchor::Right],
        rows: vec![
            row("Teeth, of pitches all round", teeth),
            row("Module", number(pair.module(), 4)),
            row(
                "Pressure angle",
                format!("{}°", number(tool.pressure_angle.to_degrees(), 4)),
            ),
            row("Pitch diameter", number(pitch, 4)),
            row("Normal backlash", number(spec.backlash, 4)),
            row("Radius of locking arc", number(gears.lock_radius(), 4)),
            row("Play of lock", number(spec.lock_play, 4)),
            row("Centre distance", number(gears.center_distance(), 4)),
        ],
        notes: Vec::new(),
    }
}

/// Corners of a part's contour, in order, and how the side that begins there is bent: the tangent of a quarter of its angle.
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

/// The gears in place as the motion begins.
pub(super) fn assembly(gears: &IntermittentPair, parts: &[Plate]) -> Drawing {
    let mut drawing = Drawing::cutting().layer(CAM, Color::Green, LineType::Continuous, 0.25);
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
            drawing.draw(HOLE, Shape::Contour(hole.outline.transformed(&place)));
        }
        drawing.draw(CENTER, Shape::Mark(place * Point::origin()));
        drawing.draw(layer, Shape::Contour(part.outline.transformed(&place)));
    }
    drawing
}
