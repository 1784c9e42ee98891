use std::f64::consts::TAU;
use std::sync::Arc;

use centrode_geometry::{MassProperties, Solid, Vector};
use centrode_mechanism::feeder::{Feeder, Part, Plate};
use centrode_mechanism::gear::IncompletePair;
use centrode_mechanism::machine::{
    Closure, Form, Input, Joint, Link, LinkPoint, Machine, Quantity, Shape,
};
use centrode_mechanism::transmission::{FromFn, MotionJet, Transmission};
use nalgebra::{Isometry2, Isometry3};

use super::{arrangement, figures};
use crate::ExportError;

/// The links as a tree, every joint zero where the effector rests; the loops close at C. The gears are drawn with the teeth
/// of a pair, or by their pitch circles.
pub(super) fn drawn(feeder: &Feeder, plates: &[Plate], gears: Option<&IncompletePair>) -> Machine {
    let design = feeder.design();
    let mut machine = Machine {
        name: design.name.clone(),
        title: design.title.clone(),
        input: Input {
            name: "incomplete gear".into(),
            period: TAU,
            speed: feeder.speed(),
        },
        ..Machine::default()
    };
    let meaning =
        "angle the incomplete gear has turned by since the effector left its place of rest";
    machine.column("input_angle_rad", "rad", meaning, Quantity::Input(1.0));
    let time = Quantity::Input(1.0 / feeder.speed());
    machine.column("time_s", "s", "time at the design's speed", time);
    let rest = |part: Part| feeder.place(part, feeder.start()).translation.vector;
    for part in Part::ALL {
        let link = machine.link(Link {
            name: part.name().into(),
            ..Link::default()
        });
        let Some(carrier) = carrier(part) else {
            continue;
        };
        let parent = machine.link_named(carrier.name()).unwrap_or(0);
        let at = rest(part) - rest(carrier);
        let law = law(feeder, part);
        let joint = if part == Part::Slider {
            let along = feeder.place(Part::Effector, feeder.start()).rotation * Vector::x();
            let bar = feeder.six_bar();
            let now = bar.slider_distance(feeder.start()).position;
            // As far as the slot lets it.
            let play = design.plates.slot_play;
            let range = [
                bar.least_slider_distance() - now - play,
                bar.greatest_slider_distance() - now + play,
            ];
            Joint::sliding(parent, link, ([along.x, along.y, 0.0], range), law)
        } else {
            Joint::turning(parent, link, law)
        };
        let joint = machine.joint(joint.at([at.x, at.y, 0.0]));
        let (unit, meaning) = meaning_of(part);
        let name = format!("{}_joint_{unit}", part.name());
        machine.column(&name, unit, meaning, Quantity::joint(joint));
    }
    close(feeder, &mut machine);
    tip(feeder, &mut machine);
    figures::draw(feeder, plates, gears, &mut machine);
    machine
}

/// The links with their bodies.
pub(super) fn machine(feeder: &Feeder, plates: &[Plate]) -> Result<Machine, ExportError> {
    let mut machine = drawn(feeder, plates, None);
    arrangement::tell(feeder, plates, &mut machine);
    for plate in plates {
        let name = plate.part.name();
        let solid = solid(feeder, plate)?;
        let mass = mass(feeder, plate, &solid);
        let shape = machine.shape(Shape {
            name: format!("links/{name}"),
            part: String::new(),
            form: Form::Solids(vec![solid]),
        });
        if let Some(link) = machine.link_named(name) {
            machine.links[link].mass = Some(mass);
            machine.links[link].shape = Some(shape);
        }
    }
    Ok(machine)
}

/// Mass of a part with all its plates: a second one of the frame stands above the others.
fn mass(feeder: &Feeder, plate: &Plate, solid: &Solid) -> MassProperties {
    let spec = &feeder.design().plates;
    let one = solid.mass_properties(spec.density);
    let above = 5.0 * (spec.thickness + spec.gap);
    let all: Vec<MassProperties> = (0..plate.part.quantity())
        .map(|k| one.placed(&Isometry3::translation(0.0, 0.0, f64::from(k) * above)))
        .collect();
    MassProperties::together(&all).unwrap_or(one)
}

/// A plate in the axes of the model's link: parallel to the world's where the effector rests.
fn solid(feeder: &Feeder, plate: &Plate) -> Result<Solid, ExportError> {
    let place = feeder.place(plate.part, feeder.start());
    let turned = Isometry2::new(Vector::zeros(), place.rotation.angle());
    plate
        .solid_at(&turned, plate.bottom)
        .map_err(ExportError::no_solid(plate.part.name()))
}

/// The part another one is mounted on.
fn carrier(part: Part) -> Option<Part> {
    match part {
        Part::Frame => None,
        Part::Crank | Part::Rocker | Part::Effector => Some(Part::Frame),
        Part::Coupler => Some(Part::Crank),
        Part::Slider => Some(Part::Effector),
    }
}

fn meaning_of(part: Part) -> (&'static str, &'static str) {
    match part {
        Part::Frame => ("rad", ""),
        Part::Crank => (
            "rad",
            "crank against the frame, counter-clockwise since it rested",
        ),
        Part::Coupler => ("rad", "coupler against the crank"),
        Part::Rocker => ("rad", "rocker against the frame"),
        Part::Effector => ("rad", "effector against the frame"),
        Part::Slider => ("mm", "slider along the effector, outwards"),
    }
}

/// A joint's coordinate since the effector rested.
fn law(feeder: &Feeder, part: Part) -> Arc<dyn Transmission> {
    let bar = *feeder.six_bar();
    let at = move |crank: f64| -> MotionJet {
        let by_crank = MotionJet {
            position: crank,
            velocity: 1.0,
            ..MotionJet::default()
        };
        let four = bar.four_bar();
        let rocker = || four.rocker_angle(crank).unwrap_or_default();
        match part {
            Part::Frame => MotionJet::default(),
            Part::Crank => by_crank,
            Part::Coupler => four
                .coupler_angle(crank)
                .unwrap_or_default()
                .plus(-1.0, &by_crank),
            Part::Rocker => rocker(),
            Part::Effector => bar.effector_angle(crank),
            Part::Slider => bar.slider_distance(crank),
        }
    };
    let (own, start) = (feeder.clone(), feeder.start());
    let rest = at(start).position;
    let advance = match part {
        Part::Crank => TAU,
        Part::Coupler => at(start + TAU).position - rest,
        _ => 0.0,
    };
    Arc::new(FromFn::new(TAU, advance, feeder.breaks(), move |input| {
        let crank = own.crank(input);
        let mut jet = at(crank.position).after(&crank);
        jet.position -= rest;
        jet
    }))
}

/// Coupler and slider are pinned to the rocker at C.
fn close(feeder: &Feeder, machine: &mut Machine) {
    let rest = |part: Part| feeder.place(part, feeder.start()).translation.vector;
    let index = |machine: &Machine, part: Part| machine.link_named(part.name()).unwrap_or(0);
    for part in [Part::Coupler, Part::Slider] {
        let at = rest(Part::Slider) - rest(part);
        machine.closures.push(Closure {
            links: [index(machine, part), index(machine, Part::Rocker)],
            at: [at.x, at.y, 0.0],
        });
    }
}

/// The tip of the effector and its columns.
fn tip(feeder: &Feeder, machine: &mut Machine) {
    let Some(link) = machine.link_named(Part::Effector.name()) else {
        return;
    };
    let turned = feeder.place(Part::Effector, feeder.start()).rotation;
    let at = turned * Vector::new(feeder.six_bar().effector_length(), 0.0);
    let point = machine.points.len();
    machine.points.push(LinkPoint {
        name: "tip".into(),
        link,
        at: [at.x, at.y, 0.0],
    });
    let meaning = "tip E of the effector, from the crank's shaft";
    for (axis, name) in ["tip_x_mm", "tip_y_mm"].into_iter().enumerate() {
        machine.column(name, "mm", meaning, Quantity::Point { point, axis });
    }
    let factor = feeder.speed();
    let speed = Quantity::PointSpeed { point, factor };
    let meaning = "speed of the tip at the design's speed";
    machine.column("tip_speed_mm_per_s", "mm/s", meaning, speed);
}
