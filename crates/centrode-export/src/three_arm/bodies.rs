use centrode_geometry::{Outline, Point};
use centrode_kinematics::machine::{self, Line, LineRole};

use super::ThreeArmPart;
use super::machine::Parts;

/// Draws the contours of cams, forks, arms and push rods, and of the carrier in front. The page's picture has bars instead.
pub(super) fn draw(parts: &Parts<'_>, machine: &mut machine::LinkedMachine) {
    let plate = |part: ThreeArmPart| {
        let plate = parts.plate_of(part);
        plate.map_or_else(Vec::new, |plate| {
            contours([&plate.outline], &plate.cut_outs())
        })
    };
    let spec = parts.pusher.fork_spec();
    let roller = Outline::circle(Point::new(spec.arm_length, 0.0), spec.roller_radius);
    let mut fork = plate(ThreeArmPart::Fork);
    fork.push(Line::contour(LineRole::Body, &roller));
    let limbs = ["housing", "flake-left"].map(|name| Some(&parts.of_arm(name)?.outline));
    let chains = [
        ("cam", "cam", plate(ThreeArmPart::Cam)),
        ("fork", "fork", fork),
        ("arm", "arm", contours(limbs.into_iter().flatten(), &[])),
        ("push rod", "push_rod", plate(ThreeArmPart::PushRod)),
    ];
    for (name, link, lines) in chains {
        let sketch = machine.sketch(name, lines);
        for k in 0..parts.mechanism.arms() {
            if let Some(own) = machine.link_named(&format!("{link}_{k}")) {
                machine.draw(&format!("{name} {}", k + 1), own, sketch);
            }
        }
    }
    let sketch = machine.sketch("carrier", plate(ThreeArmPart::Carrier));
    let carrier = machine.link_named("carrier").unwrap_or(0);
    machine.draw("carrier", carrier, sketch);
}

/// Contours of bodies and their holes.
fn contours<'a>(bodies: impl IntoIterator<Item = &'a Outline>, holes: &[Outline]) -> Vec<Line> {
    let bodies = bodies.into_iter().map(|outline| (LineRole::Body, outline));
    let holes = holes.iter().map(|hole| (LineRole::Hole, hole));
    let all = bodies.chain(holes);
    all.map(|(role, outline)| Line::contour(role, outline))
        .collect()
}
