//! Shafts and pins of a feeder, turned to the heights of what is on them.

use centrode_geometry::Point;
use centrode_mechanism::feeder::{Feeder, GearBody, Part, Plate};
use centrode_mechanism::machine::{self, Fit, Machine, dowel};

use super::gears::{PIN_HOLES, PINS};
use crate::sheet::fit;
use crate::turned::{Bar, Turned};

/// Files of the pins of the cams, where no standard pin has their diameter.
const CAM_PIN: &str = "pin-cam";

/// A turned part and the names of the links that its pieces belong to.
pub(super) struct Piece {
    pub(super) part: Turned,
    pub(super) links: Vec<&'static str>,
    remark: String,
    /// Its axis in the frame where the effector rests.
    axis: Option<Point>,
}

/// Pins of the cams: how many, their fit in the driven gear, and the length of gear, gap and cam.
struct CamPins {
    count: usize,
    fit: Fit,
    length: f64,
}

fn cam_pins(feeder: &Feeder) -> Option<CamPins> {
    let (spec, plates) = (&feeder.design().gears, &feeder.design().plates);
    let stops = spec.drive().ok()?.stops();
    let fit = Fit::new("pins of the cams", spec.cam_pin(), [PIN_HOLES, PINS]);
    feeder.has_cams().then(|| CamPins {
        count: 2 * stops as usize,
        fit,
        length: 2.0 * spec.width + plates.gap,
    })
}

/// All that are turned.
pub(super) fn all(feeder: &Feeder, plates: &[Plate]) -> Vec<Piece> {
    let mut all = pins(feeder, plates);
    all.extend(shafts(feeder));
    let made = cam_pins(feeder).filter(|pins| dowel(pins.fit.size, pins.length).is_none());
    all.extend(made.map(|pins| {
        let body = feeder.design().gears.body();
        let bar = Bar::new(pins.fit.size, &pins.fit.shaft, [0.0, pins.length]);
        Piece {
            part: bar.part([CAM_PIN, "Pin of a cam"], (&body.material, body.density)),
            links: vec![GearBody::NAMES[1]; pins.count],
            remark: fit::shaft(&pins.fit),
            axis: None,
        }
    }));
    all
}

/// Pins of the joints, which float in all their holes, a ring at either end.
fn pins(feeder: &Feeder, plates: &[Plate]) -> Vec<Piece> {
    let spec = &feeder.design().plates;
    let level = |part: Part| {
        let plate = plates.iter().find(|plate| plate.part == part);
        let bottom = plate.map_or(0.0, |plate| plate.bottom);
        [bottom, bottom + spec.thickness]
    };
    let [rear, _] = level(Part::Frame);
    // The second frame plate stands above all others.
    let front = level(Part::Effector)[1] + spec.gap + spec.thickness;
    let (gap, free) = (spec.gap, f64::INFINITY);
    let [b, c, _] = feeder.six_bar().joints(feeder.start());
    let d = Point::new(feeder.six_bar().four_bar().lengths()[3], 0.0);
    let fit = Fit::new("", spec.pin_diameter, [&spec.hole_fit, &spec.pin_fit]);
    [
        (
            ["pin-b", "Pin B"],
            Part::Crank,
            b,
            [level(Part::Crank)[0], level(Part::Coupler)[1]],
            [gap, gap],
        ),
        (
            ["pin-c", "Pin C"],
            Part::Rocker,
            c,
            [level(Part::Coupler)[0], level(Part::Slider)[1]],
            [gap, gap],
        ),
        (
            ["pin-d", "Pin D"],
            Part::Frame,
            d,
            [rear, front],
            [free, free],
        ),
        (
            ["pin-f", "Pin F"],
            Part::Frame,
            feeder.six_bar().pivot(),
            [level(Part::Effector)[0], front],
            [gap, free],
        ),
    ]
    .map(|(names, link, axis, span, room)| {
        let bar = Bar::new(spec.pin_diameter, &spec.pin_fit, span).held(room);
        Piece {
            part: bar.part(names, (&spec.material, spec.density)),
            links: vec![link.name()],
            remark: fit::shaft(&fit),
            axis: Some(axis),
        }
    })
    .into()
}

/// Shafts of the crank and of the intermittent gear, which turn in the rear frame plate.
fn shafts(feeder: &Feeder) -> [Piece; 2] {
    let (body, plates) = (feeder.design().gears.body(), &feeder.design().plates);
    let [middle, entry, exit] = feeder.gear_levels(feeder.has_cams());
    let (gap, free) = (plates.gap, f64::INFINITY);
    let [rear, front] = [-gap - plates.thickness, -gap];
    let hub = |bottom: f64| [bottom, bottom + body.width];
    let material = (&*body.material, body.density);
    let fit = Fit::new("", body.bore, [&body.bore_fit, &body.shaft_fit]);
    let keyed = |bar: Bar, ends: [f64; 2]| bar.keyed(body.keyway, ends);
    let held = |bar: Bar| bar.ring(rear, false, gap).ring(front, true, gap);
    let crank = Bar::new(body.bore, &body.shaft_fit, [middle, plates.thickness]);
    let crank = crank.ring(middle, false, free);
    let crank = keyed(crank, [f64::NEG_INFINITY, hub(middle)[1]]);
    let crank = keyed(held(crank.ring(hub(middle)[1], true, gap)), [0.0, free]);
    let hubs = match feeder.has_cams() {
        true => vec![entry, middle, exit],
        false => vec![middle],
    };
    // The crank does not reach as far as this shaft.
    let reach = feeder.six_bar().four_bar().lengths()[0] + 0.5 * plates.width;
    let beside = feeder.design().gears.center_distance() - 0.5 * body.bore;
    let before = match reach < beside {
        true => gap + plates.thickness,
        false => gap,
    };
    let own = Bar::new(body.bore, &body.shaft_fit, [hubs[0], front]);
    let own = own.ring(hubs[0], false, free);
    let own = hubs
        .iter()
        .fold(own, |bar, &bottom| bar.ring(hub(bottom)[1], true, gap));
    let last = hubs
        .iter()
        .fold(f64::NEG_INFINITY, |top, &bottom| top.max(hub(bottom)[1]));
    let own = keyed(own, [f64::NEG_INFINITY, last]).ring(front, true, before);
    let mut of_crank = crank.part(["shaft-a", "Shaft A"], material);
    of_crank.notes = vec!["The crank is bonded to its seat, flush with the end.".into()];
    [
        Piece {
            part: of_crank,
            links: vec![Part::Crank.name()],
            remark: format!("{}, of the crank", fit::shaft(&fit)),
            axis: Some(Point::origin()),
        },
        Piece {
            part: own.part(["shaft-g", "Shaft G"], material),
            links: vec![GearBody::NAMES[0]],
            remark: format!("{}, of the intermittent gear", fit::shaft(&fit)),
            axis: Some(Point::new(-feeder.design().gears.center_distance(), 0.0)),
        },
    ]
}

/// Lists all that are turned, with what is bought for them, and the pins of the cams.
pub(super) fn list(feeder: &Feeder, plates: &[Plate], machine: &mut Machine) {
    for piece in all(feeder, plates) {
        let links = piece.links.iter().map(|name| machine.link_named(name));
        let links: Vec<usize> = links.map(|link| link.unwrap_or(0)).collect();
        let rim = piece
            .axis
            .map(|axis| [axis.x - 0.5 * piece.part.diameter(), axis.y]);
        let place = rim.and_then(|rim| machine.place_on(Part::Frame.name(), rim));
        piece.part.list(machine, &links, piece.remark, place);
    }
    let Some(pins) = cam_pins(feeder) else {
        return;
    };
    if let Some(name) = dowel(pins.fit.size, pins.length) {
        let driven = machine.link_named(GearBody::NAMES[1]).unwrap_or(0);
        machine.part(machine::Part {
            remark: format!("{}, pressed into the driven gear", fit::shaft(&pins.fit)),
            ..machine::Part::bought(name, vec![driven; pins.count])
        });
    }
    machine.fit(pins.fit);
}
