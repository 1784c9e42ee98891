use std::sync::Arc;

use centrode_geometry::{Outline, Point, Segment, SolidError, Tolerance};
use centrode_mechanism::feeder::{Feeder, Part};
use centrode_mechanism::gear::design::BodySpec;
use centrode_mechanism::gear::{Gear, IncompletePair};
use centrode_mechanism::machine::{Form, Joint, Linear, Link, Machine, Quantity, Shape};
use nalgebra::Isometry2;

use crate::csv::Column;
use crate::drawing::{Anchor, CENTER, Color, Drawing, HOLE, LineType, PROFILE, Shape as Drawn};
use crate::plate::{Hole, Plate};
use crate::sheet::{Table, capital, number};

const CAM: &str = "CAM";

/// Names of the files.
const DRIVER: &str = "gear-driver";
const DRIVEN: &str = "gear-driven";
const CAMS: [&str; 2] = ["gear-entry-cam", "gear-exit-cam"];

/// Accuracy of their bodies in the machine, mm.
const FINE: f64 = 1e-3;

/// Links of the gears: the incomplete gear with its cams on the shaft G, its mate on that of the crank.
pub(super) const LINKS: [&str; 4] = [DRIVER, DRIVEN, CAMS[0], CAMS[1]];

/// Tolerance class of the holes into which the pins are pressed.
pub(super) const PIN_HOLES: &str = "H7";
/// Tolerance class of the pins, ISO 8734.
pub(super) const PINS: &str = "m6";

/// Driver, driven gear and, where there is an entry angle, the cams beside the driver; with arcs within the tolerance.
pub(super) fn parts(feeder: &Feeder, gears: &IncompletePair, tolerance: Tolerance) -> Vec<Plate> {
    let pair = gears.pair();
    let (driver, driven) = (pair.driver(), pair.driven());
    let table = |gear: &Gear, teeth: String| data(feeder, gears, gear, teeth);
    let part = |name: &str, outline: &Outline, body: &BodySpec, bore: Option<Outline>| {
        // Cut as short chords: lines and arcs of the same accuracy, which a solid can have, too.
        let outline = outline.arcs_of_chords(gears.accuracy(), tolerance);
        Plate::of_body([name, &capital(name)], outline, bore, body)
            .noted(&format!("Points of the contour: {name}.csv."))
            .noted("Drawn as the motion begins: on the driver x points to the")
            .noted("driven gear's axis, on the driven gear away from the driver's.")
            .noted("Keyed along x: gears and cams stand right on the shaft.")
    };
    let mut first = part(DRIVER, gears.driver(), driver.body(), driver.bore());
    first.tables = vec![table(
        driver,
        format!("{} of {}", gears.teeth(), driver.tooth_count()),
    )];
    let mut second = part(DRIVEN, gears.driven(), driven.body(), driven.bore());
    second.tables = vec![table(driven, driven.tooth_count().to_string())];
    let pins = gears.cams().iter().flat_map(|cam| {
        let hole = |&at: &Point| Hole {
            label: "pin".into(),
            fit: PIN_HOLES.into(),
            off: 0.02,
            ..Hole::from(Outline::circle(at, cam.pin_radius))
        };
        cam.pins.iter().map(hole).collect::<Vec<_>>()
    });
    second.holes.extend(pins);
    let mut all = vec![first, second];
    for (name, cam) in CAMS.into_iter().zip(gears.cams()) {
        let cam = part(name, &cam.outline, driver.body(), driver.bore());
        all.push(cam.noted("Fixed beside the driver, its x axis on the driver's."));
    }
    all
}

/// The data of a gear.
fn data(feeder: &Feeder, gears: &IncompletePair, gear: &Gear, teeth: String) -> Table {
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

/// Adds the gears as links with their bodies, behind the rear frame plate: from there the exit cam, the gears, the entry cam.
pub(super) fn mount(
    feeder: &Feeder,
    gears: &IncompletePair,
    machine: &mut Machine,
) -> Result<(), SolidError> {
    let parts = parts(
        feeder,
        gears,
        Tolerance::new(FINE).unwrap_or(gears.accuracy()),
    );
    let (frame, crank) = (Part::Frame.link(), Part::Crank.link());
    let (spec, plates) = (&feeder.design().gears, &feeder.design().plates);
    let next = spec.width + plates.gap;
    let behind = -(plates.thickness + plates.gap) - next;
    let middle = if parts.len() > 2 {
        behind - next
    } else {
        behind
    };
    let mut driver = frame;
    for part in &parts {
        let link = machine.link(Link {
            name: part.name.clone(),
            ..Link::default()
        });
        let (joint, bottom) = match &*part.name {
            DRIVER => {
                driver = link;
                let law = Linear {
                    start: 0.0,
                    slope: -1.0,
                };
                let joint = Joint::turning(frame, link, Arc::new(law));
                (joint.at([-spec.center_distance(), 0.0, 0.0]), middle)
            }
            DRIVEN => (Joint::fixed(crank, link), middle),
            name if name == CAMS[0] => (Joint::fixed(driver, link), middle - next),
            _ => (Joint::fixed(driver, link), behind),
        };
        let joint = machine.joint(joint);
        if link == driver {
            // Its locking arc and its teeth hold the crank to it.
            machine.joints[Part::Crank.joint()].leader = Some(joint);
            let meaning = "incomplete gear against the frame, counter-clockwise";
            let name = "gear_driver_joint_rad";
            machine.column(name, "rad", meaning, Quantity::joint(joint));
        }
        let span = [bottom, bottom + part.thickness];
        machine.links[link].mass = Some(part.mass(span)?);
        let shape = machine.shape(Shape {
            name: format!("links/{}", part.name),
            part: String::new(),
            form: Form::Solids(vec![part.placed(span)?]),
        });
        machine.links[link].shape = Some(shape);
    }
    Ok(())
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
pub(super) fn assembly(gears: &IncompletePair, parts: &[Plate]) -> Drawing {
    let mut drawing = Drawing::cutting().layer(CAM, Color::Green, LineType::Continuous, 0.25);
    for part in parts {
        let x = match &*part.name {
            DRIVEN => gears.center_distance(),
            _ => 0.0,
        };
        let place = Isometry2::translation(x, 0.0);
        let layer = match CAMS.contains(&&*part.name) {
            true => CAM,
            false => PROFILE,
        };
        for hole in &part.holes {
            drawing.draw(HOLE, Drawn::Contour(hole.outline.transformed(&place)));
        }
        drawing.draw(CENTER, Drawn::Mark(place * Point::origin()));
        drawing.draw(layer, Drawn::Contour(part.outline.transformed(&place)));
    }
    drawing
}
