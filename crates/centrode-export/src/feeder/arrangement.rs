use std::f64::consts::TAU;

use centrode_formats::sheet::number;
use centrode_geometry::Point;
use centrode_kinematics::machine::{
    self, Axis, Blank, Datum, Dimension, Fit, Form, Line, LineRole, LinkedMachine,
};
use centrode_machines::feeder::{Feeder, FeederPart, GearBody, Plate};

use super::gears::TITLES;
use super::plates::{made, spacer};
use crate::turned;

/// Number of segments of a drawn path.
const POINTS: u32 = 360;
/// Decimals of lengths in mm.
const PLACES: usize = 4;

/// Lists plates, pins and gears, and fills the arrangement: it shows the six-bar while its effector rests.
pub(super) fn annotate(feeder: &Feeder, plates: &[Plate], machine: &mut LinkedMachine) {
    paths(feeder, machine);
    let ends = ["driver", "driven gear"].map(|figure| machine.place_on(figure, [0.0; 2]));
    if let [Some(from), Some(to)] = ends {
        let (ends, along) = ([from, to], Axis::X);
        machine
            .arrangement
            .dimensions
            .push(Dimension { ends, along });
    }
    for plate in plates {
        list(feeder, plate, machine);
    }
    pins(feeder, machine);
    gears(feeder, machine);
    let shafts = feeder.turned(plates);
    turned::list(&shafts, machine);
    screws(feeder, machine);
    let of_cams = shafts
        .into_iter()
        .filter(|pieces| !pieces.fit.name.is_empty());
    of_cams.for_each(|pieces| machine.fit(pieces.fit));
    fits(feeder, machine);
    let frame = machine.place_on(FeederPart::Frame.name(), [0.0; 2]);
    let stated = &mut machine.arrangement;
    stated.seen_through.extend(frame.map(|place| place.figure));
    stated.title = "Feeder".into();
    stated.drawing = feeder.design().drawing.clone();
    stated.data = data(feeder);
    stated.notes = [
        "Shown where the effector rests and is filled.",
        "Heights z of the lower faces, mm; a second frame plate above.",
        "Dash-dotted: path of the tip E; thin: paths of B and C.",
        "Gears by their tip circles, pitch circles dash-dotted.",
    ]
    .map(String::from)
    .into();
}

/// Draws the paths of B and C; C returns on the same path, so one stroke of it is drawn.
fn paths(feeder: &Feeder, machine: &mut LinkedMachine) {
    let [feed, _] = feeder.strokes();
    let there = feeder.crank(feed.to).position - feeder.start();
    let path = |(joint, turned): (usize, f64)| {
        let at = |i: u32| feeder.start() + turned * f64::from(i) / f64::from(POINTS);
        let points = (0..=POINTS).map(|i| feeder.six_bar().joints(at(i))[joint]);
        Line::chain(LineRole::Trace, &points.collect::<Vec<Point>>())
    };
    let paths = machine.sketch("paths", [(0, TAU), (1, there)].map(path).into());
    machine.draw("paths", 0, paths);
}

fn list(feeder: &Feeder, plate: &Plate, machine: &mut LinkedMachine) {
    let (part, name) = (plate.part, plate.part.name());
    let links = vec![part.link(); part.quantity() as usize];
    machine.part(machine::Part {
        name: name.into(),
        remark: format!("z = {}", number(plate.bottom, PLACES)),
        place: machine.place_on_edge(name, &plate.outline),
        ..made(feeder, plate).listed(links)
    });
}

/// Spacers between the plates of the frame, and the screws into them.
fn screws(feeder: &Feeder, machine: &mut LinkedMachine) {
    let found = feeder.frame_screws().and_then(Result::ok);
    let (Some(screws), Some(spacer)) = (found, spacer(feeder)) else {
        return;
    };
    let frame = FeederPart::Frame;
    machine.part(machine::Part {
        name: "spacer of the frame".into(),
        remark: format!("{} long", number(spacer.thickness, PLACES)),
        ..spacer.listed(vec![frame.link(); screws.at.len()])
    });
    let role = "of the frame's plates";
    turned::list(&[screws.screws(&[frame.name().into()], role)], machine);
}

/// Fits of the pins of the joints and of the slider.
fn pins(feeder: &Feeder, machine: &mut LinkedMachine) {
    let spec = &feeder.design().plates;
    let classes = [&*spec.hole_fit, &spec.pin_fit];
    machine.fit(Fit::new("pins of B, C, D, F", spec.pin_diameter, classes));
    let classes = [&*spec.slot_fit, &spec.slider_fit];
    machine.fit(Fit::of_width(
        "slider in the slot",
        spec.slot_width,
        classes,
    ));
}

/// The intermittent gears with their cams.
fn gears(feeder: &Feeder, machine: &mut LinkedMachine) {
    let spec = &feeder.design().gears;
    let toothed = [
        ("driver", spec.driver_pitches, 0),
        ("driven gear", spec.driven_pitches, FeederPart::Crank.link()),
    ];
    let links = GearBody::NAMES.map(|name| machine.link_named(name));
    let cut = links[0].and_then(|_| feeder.gears().ok());
    let count = if feeder.has_cams() { 4 } else { 2 };
    for (index, (name, file)) in TITLES
        .into_iter()
        .zip(GearBody::NAMES)
        .enumerate()
        .take(count)
    {
        let seen = toothed.get(index);
        let own = links[index].map(|link| &machine.links[link]);
        let solid = own.and_then(|link| match &machine.shapes[link.shape?].form {
            Form::Solids(solids) => solids.first(),
            _ => None,
        });
        // The fitted arcs deviate from the teeth by up to a micrometre: a gear's blank comes from the exact teeth.
        let teeth = cut.as_ref().map(|pair| [pair.driver(), pair.driven()]);
        let blank = match seen {
            Some(_) => teeth.and_then(|teeth| Blank::round(teeth[index], spec.width)),
            None => solid.and_then(|solid| Blank::plate(solid.outline(), spec.width)),
        };
        let remark = match seen {
            Some((_, pitches, _)) => {
                format!("{pitches} pitches, bore Ø{}", number(spec.bore, PLACES))
            }
            None => "next to the intermittent gear".into(),
        };
        machine.part(machine::Part {
            name: name.into(),
            links: vec![links[index].or(seen.map(|seen| seen.2)).unwrap_or(0)],
            material: spec.body().material,
            blank,
            mass: own.and_then(|link| Some(link.mass?.mass)),
            file: file.into(),
            remark,
            place: seen.and_then(|(figure, pitches, _)| {
                let rim = 0.5 * spec.module * f64::from(*pitches) + spec.module;
                machine.place_on(figure, [0.0, rim])
            }),
            ..machine::Part::default()
        });
    }
}

/// Fits of the shafts of the gears.
fn fits(feeder: &Feeder, machine: &mut LinkedMachine) {
    let (body, plates) = (feeder.design().gears.body(), &feeder.design().plates);
    let seat = |name, hole: &str| Fit::new(name, body.bore, [hole, &body.shaft_fit]);
    machine.fit(seat("gears on their shafts", &body.bore_fit));
    machine.fit(Fit::new("crank on shaft A", body.bore, Feeder::CRANK_FIT));
    machine.fit(seat("shafts A and G in the frame", &plates.bearing_fit));
}

fn data(feeder: &Feeder) -> Vec<Datum> {
    let six_bar = feeder.six_bar();
    let pivot = six_bar.pivot();
    let length = |x: f64| number(x, PLACES);
    let degrees = |x: f64| format!("{:.4}°", x.to_degrees());
    let minimum = six_bar.four_bar().minimum_transmission_angle();
    [
        (
            "pivot F",
            format!("{}, {}", length(pivot.x), length(pivot.y)),
        ),
        ("swing", degrees(six_bar.swing())),
        ("minimum transmission angle", degrees(minimum)),
        ("crank at rest", degrees(feeder.start())),
        (
            "cycles per minute",
            format!("{:.4}", feeder.cycles_per_minute()),
        ),
    ]
    .map(|(name, value)| Datum::new(name, "", value))
    .into()
}
