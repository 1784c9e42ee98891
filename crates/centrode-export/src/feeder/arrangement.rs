use std::f64::consts::TAU;

use centrode_geometry::Point;
use centrode_mechanism::feeder::{Feeder, Part, Plate};
use centrode_mechanism::gear::design::BodySpec;
use centrode_mechanism::machine::{self, Axis, Datum, Dimension, Fit, Line, LineRole, Machine};

use super::gears;
use crate::sheet::{fit, number};

/// Corners of a path.
const POINTS: u32 = 360;
/// Places of lengths, and of angles in degrees.
const PLACES: usize = 4;

/// Lists plates, pins and gears, and tells the arrangement: the six-bar as its effector rests.
pub(super) fn tell(feeder: &Feeder, plates: &[Plate], machine: &mut Machine) {
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
    let frame = machine.place_on(Part::Frame.name(), [0.0; 2]);
    let told = &mut machine.arrangement;
    told.seen_through.extend(frame.map(|place| place.figure));
    told.title = "Feeder".into();
    told.drawing = feeder.design().drawing.clone();
    told.data = data(feeder);
    told.notes = [
        "Shown where the effector rests and is filled.",
        "Heights z of the lower faces, mm; a second frame plate above.",
        "Dash-dotted: path of the tip E; thin: paths of B and C.",
        "Gears by their tip circles, pitch circles dash-dotted.",
    ]
    .map(String::from)
    .into();
}

/// Draws the paths of B and C; C comes back the way it went.
fn paths(feeder: &Feeder, machine: &mut Machine) {
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

fn list(feeder: &Feeder, plate: &Plate, machine: &mut Machine) {
    let spec = &feeder.design().plates;
    let (part, name) = (plate.part, plate.part.name());
    let Some(link) = machine.link_named(name) else {
        return;
    };
    let cut: f64 = plate.cut_outs().iter().map(|hole| hole.area().abs()).sum();
    let volume = (plate.outline.area() - cut) * plate.thickness;
    machine.part(machine::Part {
        name: name.into(),
        links: vec![link; part.quantity() as usize],
        material: spec.material.clone(),
        mass: Some(volume * spec.density * 1e-9),
        file: name.into(),
        remark: format!("z = {}", number(plate.bottom, PLACES)),
        place: machine.place_on_edge(name, &plate.outline),
    });
}

/// The pins of the joints: of three shafts in the frame, of B, and of C.
fn pins(feeder: &Feeder, machine: &mut Machine) {
    let pin = feeder.design().plates.pin_diameter;
    let on = [
        Part::Frame,
        Part::Frame,
        Part::Frame,
        Part::Crank,
        Part::Rocker,
    ];
    let links = on.iter().filter_map(|part| machine.link_named(part.name()));
    let links = links.collect();
    let [_, c, _] = feeder.six_bar().joints(feeder.start());
    let rim = [c.x - 0.5 * pin, c.y];
    let spec = &feeder.design().plates;
    let fit = Fit {
        name: "pins of A, B, C, D, F".into(),
        size: pin,
        is_width: false,
        hole: spec.hole_fit.clone(),
        shaft: spec.pin_fit.clone(),
    };
    let remark = format!("{}, of A, B, C, D and F", fit::shaft(&fit));
    machine.fit(fit);
    machine.fit(Fit {
        name: "slider in the slot".into(),
        size: spec.slot_width,
        is_width: true,
        hole: spec.slot_fit.clone(),
        shaft: spec.slider_fit.clone(),
    });
    machine.part(machine::Part {
        name: "pin of a joint".into(),
        links,
        remark,
        place: machine.place_on(Part::Frame.name(), rim),
        ..machine::Part::default()
    });
}

/// Fit of the pins of the cams in the driven gear.
fn pressed(diameter: f64) -> Fit {
    Fit {
        name: "pins of the cams".into(),
        size: diameter,
        is_width: false,
        hole: gears::PIN_HOLES.into(),
        shaft: gears::PINS.into(),
    }
}

/// The incomplete gears with their cams and pins, which are not cut for this.
fn gears(feeder: &Feeder, machine: &mut Machine) {
    let spec = &feeder.design().gears;
    let crank = machine.link_named(Part::Crank.name()).unwrap_or(0);
    let rim = |pitches: u32| [0.0, 0.5 * spec.module * f64::from(pitches) + spec.module];
    let bored = |pitches: u32| format!("{pitches} pitches, bore Ø{}", number(spec.bore, PLACES));
    let mut add =
        |name: &str, links: Vec<usize>, file: &str, remark: String, seen: Option<(&str, u32)>| {
            machine.part(machine::Part {
                name: name.into(),
                links,
                material: match file.is_empty() {
                    true => String::new(),
                    false => BodySpec::default().material,
                },
                file: file.into(),
                remark,
                place: seen.and_then(|(figure, pitches)| machine.place_on(figure, rim(pitches))),
                ..machine::Part::default()
            });
        };
    let (driver, driven) = (spec.driver_pitches, spec.driven_pitches);
    let seen = Some(("driver", driver));
    add(
        "incomplete gear",
        vec![0],
        "gear-driver",
        bored(driver),
        seen,
    );
    let seen = Some(("driven gear", driven));
    add(
        "gear on the crank",
        vec![crank],
        "gear-driven",
        bored(driven),
        seen,
    );
    let stops = feeder
        .design()
        .gears
        .drive()
        .map_or(0, |drive| drive.stops());
    if spec.entry > 0.0 && stops > 0 {
        let beside = "beside the incomplete gear";
        add("entry cam", vec![0], "gear-entry-cam", beside.into(), None);
        add("exit cam", vec![0], "gear-exit-cam", beside.into(), None);
        let pin = pressed(spec.pin_diameter.unwrap_or(2.5 * spec.module));
        let pins = vec![crank; 2 * stops as usize];
        let remark = format!("{}, pressed into the driven gear", fit::shaft(&pin));
        add("pin of a cam", pins, "", remark, None);
    }
    let body = BodySpec::default();
    let shaft = Fit {
        name: "shafts of the gears".into(),
        size: spec.bore,
        is_width: false,
        hole: body.bore_fit,
        shaft: body.shaft_fit,
    };
    let remark = fit::shaft(&shaft);
    add("shaft of the incomplete gear", vec![0], "", remark, None);
    if spec.entry > 0.0 && stops > 0 {
        machine.fit(pressed(spec.pin_diameter.unwrap_or(2.5 * spec.module)));
    }
    machine.fit(shaft);
}

fn data(feeder: &Feeder) -> Vec<Datum> {
    let six_bar = feeder.six_bar();
    let pivot = six_bar.pivot();
    let length = |x: f64| number(x, PLACES);
    let degrees = |x: f64| format!("{:.4}°", x.to_degrees());
    let least = six_bar.four_bar().least_transmission_angle();
    [
        (
            "pivot F",
            format!("{}, {}", length(pivot.x), length(pivot.y)),
        ),
        ("swing", degrees(six_bar.swing())),
        ("least transmission angle", degrees(least)),
        ("crank at rest", degrees(feeder.start())),
        (
            "cycles a minute",
            format!("{:.4}", feeder.cycles_per_minute()),
        ),
    ]
    .map(|(name, value)| Datum::new(name, "", value))
    .into()
}
