use super::machine::Parts;
use centrode_formats::drawing::{Anchor, Color, Drawing, EntityShape, LineType, Text};
use centrode_gear::Member;
use centrode_geometry::{Outline, Point, Tolerance};
use centrode_machines::three_arm::{ThreeArm, ThreeArmLink};
use nalgebra::Isometry2;
use std::f64::consts::TAU;

/// Number of segments of the tip's path.
const PATH: u32 = 720;

/// The whole machine while its first arm picks: gears, carrier, cams and forks, arms, path of the tip, ground, tray, seedlings.
pub(super) fn drawing(machine: &Parts<'_>, tolerance: Tolerance) -> Drawing {
    let mut drawing = layers();
    for (layer, outline) in contours(machine, tolerance) {
        drawing.draw(layer, EntityShape::Contour(outline));
    }
    surroundings(machine, &mut drawing);
    drawing
}

/// Contours of all turning parts while the first arm picks, each with its layer.
pub(super) fn contours(machine: &Parts<'_>, tolerance: Tolerance) -> Vec<(&'static str, Outline)> {
    let mechanism = machine.mechanism;
    let input = mechanism.picking(0);
    let place = |link: ThreeArmLink| {
        let stands = mechanism.link(link, input);
        Isometry2::new(stands.origin.position.coords, stands.angle.position)
    };
    let mut found = Vec::new();
    let mut draw = |layer: &'static str, outline: &Outline, at: &Isometry2<f64>| {
        // Arcs first: turned splines would be fitted anew for every position.
        found.push((layer, outline.arcs(tolerance).transformed(at)));
    };
    let carrier = place(ThreeArmLink::Carrier);
    draw("CARRIER", &machine.gearbox.outline, &carrier);
    let mut gear = |link: ThreeArmLink| {
        let (pair, member) = match link {
            ThreeArmLink::Sun => (&machine.pairs[0], Member::Driver),
            ThreeArmLink::Planet(_) => (&machine.pairs[1], Member::Driver),
            _ => (&machine.pairs[0], Member::Driven),
        };
        let (gear, at) = (pair.gear(member), place(link));
        draw("GEARS", gear.outline(), &at);
        draw("PITCH_CURVE", gear.pitch_curve(), &at);
        if let Some(bore) = gear.bore() {
            draw("HOLE", &bore, &at);
        }
    };
    gear(ThreeArmLink::Sun);
    for k in 0..mechanism.arms() {
        gear(ThreeArmLink::Intermediate(k));
        gear(ThreeArmLink::Planet(k));
    }
    let pusher = &machine.pusher;
    for k in 0..mechanism.arms() {
        let arm = place(ThreeArmLink::Arm(k));
        for name in ["housing", "flake-left", "push-rod", "pusher"] {
            let Some(part) = machine.of_arm(name) else {
                continue;
            };
            let back = pusher.retraction(mechanism.own_input(input, k)).position;
            let moves = matches!(name, "push-rod" | "pusher");
            let by = Isometry2::translation(if moves { -back } else { 0.0 }, 0.0);
            draw("ARMS", &part.outline, &(arm * by));
        }
        let cam = carrier * super::links::cam_on_carrier(machine, k);
        draw("CAMS", pusher.cam().profile().outline(), &cam);
        if let Some((fork, _)) = pusher.fork_outline() {
            let back = pusher.retraction(mechanism.own_input(input, k));
            let turn = pusher.fork_angle(&back).position;
            let at = arm * Isometry2::new(pusher.pivot().coords, turn);
            draw("CAMS", &fork, &at);
        }
    }
    found
}

fn layers() -> Drawing {
    Drawing::default()
        .layer("PATH", Color::Red, LineType::Center, 0.18)
        .layer("GROUND", Color::Gray, LineType::Continuous, 0.35)
        .layer("TRAY", Color::Gray, LineType::Continuous, 0.35)
        .layer("SEEDLINGS", Color::Green, LineType::Continuous, 0.18)
        .layer("CARRIER", Color::Gray, LineType::Phantom, 0.25)
        .layer("PITCH_CURVE", Color::Blue, LineType::Center, 0.13)
        .layer("HOLE", Color::Foreground, LineType::Continuous, 0.25)
        .layer("GEARS", Color::Foreground, LineType::Continuous, 0.25)
        .layer("CAMS", Color::Red, LineType::Continuous, 0.25)
        .layer("ARMS", Color::Green, LineType::Continuous, 0.35)
        .layer("TEXT", Color::Foreground, LineType::Continuous, 0.25)
}

/// The tip's path in the machine's frame, closed.
pub(super) fn path(mechanism: &ThreeArm) -> Vec<Point> {
    let at = |i: u32| TAU * f64::from(i % PATH) / f64::from(PATH);
    (0..=PATH)
        .map(|i| mechanism.tip(at(i), 0).position)
        .collect()
}

/// Feet of the seedlings planted when the first arm picks, up to a horizontal distance from the carrier's axis, mm.
pub(super) fn planted(mechanism: &ThreeArm, reach: f64) -> Vec<Point> {
    let mut feet = mechanism.planted(mechanism.picking(0), 2 * mechanism.arms());
    feet.retain(|foot| foot.x.abs() < reach);
    feet
}

/// Stems of the planted seedlings.
pub(super) fn planted_stems(mechanism: &ThreeArm, reach: f64) -> Vec<Outline> {
    let feet = planted(mechanism, reach);
    let place = |stem: &Outline, foot: &Point| stem.transformed(&Isometry2::new(foot.coords, 0.0));
    mechanism.stem().map_or_else(Vec::new, |stem| {
        feet.iter().map(|foot| place(&stem, foot)).collect()
    })
}

/// Surroundings that do not turn: path of the tip, ground, tray; and the title.
fn surroundings(machine: &Parts<'_>, drawing: &mut Drawing) {
    let mechanism = machine.mechanism;
    let path = path(mechanism);
    let reach = path.iter().map(|p| p.coords.norm()).fold(0.0, f64::max);
    drawing.draw("PATH", EntityShape::Polyline(path));
    let ground = mechanism.ground();
    let (left, right) = (Point::new(-reach, ground), Point::new(reach, ground));
    drawing.draw("GROUND", EntityShape::Line(left, right));
    let tray = mechanism.tray_body();
    drawing.draw("TRAY", EntityShape::Contour(tray.placed(&tray.plate)));
    let unpicked = tray.stems.iter().map(|stem| tray.placed(stem));
    for stem in unpicked.chain(planted_stems(mechanism, reach)) {
        drawing.draw("SEEDLINGS", EntityShape::Contour(stem));
    }
    let height = 0.025 * reach;
    let design = mechanism.design();
    let title = match design.title.as_str() {
        "" => &design.name,
        title => title,
    };
    let figures = format!(
        "a = {:.4} mm, {} gears of {} teeth, m = {:.4} mm; arm I picks",
        mechanism.center_distance(),
        1 + 2 * mechanism.arms(),
        machine.pairs[0].driver().tooth_count(),
        machine.pairs[0].module(),
    );
    let lowest = drawing.bounds().min.y;
    for (row, words) in [title.to_owned(), figures].into_iter().enumerate() {
        let y = lowest - (1.5 + 1.7 * row as f64) * height;
        let text = Text::new(Point::new(0.0, y), height, words, Anchor::Middle);
        drawing.draw("TEXT", EntityShape::Text(text));
    }
}
