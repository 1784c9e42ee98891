use std::sync::Arc;

use centrode_gear::IntermittentPair;
use centrode_geometry::{Outline, Point};
use centrode_kinematics::linkage::SixBar;
use centrode_kinematics::machine::{Constant, Line, LineRole, LinkedMachine, Mark, Quantity, Seat};
use centrode_machines::feeder::{Feeder, FeederPart, Plate};

use crate::gear_pair;

/// Number of points of the curve on which the effector's pivot may lie.
const PIVOTS: usize = 240;

/// Draws the six-bar with the path of the tip and all positions of the effector's pivot that give the required swing (a chord for
/// half a turn, see [`SixBar::pivots`]). Behind the six-bar are the intermittent gears that turn its crank, the driver to the
/// left; without a pair they are drawn by their pitch and tip circles.
pub(super) fn draw(
    feeder: &Feeder,
    plates: &[Plate],
    gears: Option<&IntermittentPair>,
    machine: &mut LinkedMachine,
) {
    let [driver, driven] = match gears {
        Some(pair) => cut(pair),
        None => plain(feeder),
    };
    let driver = machine.sketch("driver", driver);
    let still = |at: f64| Quantity::Law(Arc::new(Constant(at)));
    let beside = still(-feeder.design().gears.center_distance());
    let seat = Seat::Free(Box::new([beside, still(0.0), Quantity::Input(-1.0)]));
    machine.draw_at("driver", seat, [0.0; 3], driver);
    let driven = machine.sketch("driven gear", driven);
    let crank = machine.link_named(FeederPart::Crank.name()).unwrap_or(0);
    machine.draw("driven gear", crank, driven);
    for plate in plates {
        let name = plate.part.name();
        let mut lines = vec![Line::contour(LineRole::Body, &plate.outline)];
        let holes = plate.cut_outs();
        lines.extend(holes.iter().map(|hole| Line::contour(LineRole::Hole, hole)));
        if plate.part == FeederPart::Frame {
            lines.push(Line::trace(LineRole::Trace, 0));
            let bar = feeder.six_bar().four_bar();
            let pivots = SixBar::pivots(bar, feeder.design().goals.swing, PIVOTS);
            lines.push(Line::chain(LineRole::Locus, &pivots));
        }
        let sketch = machine.sketch(name, lines);
        // Links are parallel to the frame where the effector rests.
        let rest = feeder.place(plate.part, feeder.start()).rotation.angle();
        let seat = Seat::Link(machine.link_named(name).unwrap_or(0));
        machine.draw_at(name, seat, [0.0, 0.0, rest], sketch);
        let figure = machine.figures.len() - 1;
        let named = plate.joints.iter().filter(|joint| match plate.part {
            FeederPart::Frame => true,
            FeederPart::Crank => joint.name == "B",
            FeederPart::Effector => joint.name == "E",
            FeederPart::Slider => joint.name == "C",
            FeederPart::Coupler | FeederPart::Rocker => false,
        });
        machine.marks.extend(named.map(|joint| Mark {
            name: joint.name.clone(),
            figure,
            at: joint.at.coords.into(),
        }));
    }
}

/// Driver and driven gear by their pitch and tip circles.
fn plain(feeder: &Feeder) -> [Vec<Line>; 2] {
    let gears = &feeder.design().gears;
    [gears.driver_pitches, gears.driven_pitches].map(|pitches| {
        let radius = 0.5 * gears.module * f64::from(pitches);
        let lines = [
            (LineRole::Body, radius + gears.module),
            (LineRole::Pitch, radius),
        ];
        let circle = |radius| Outline::circle(Point::origin(), radius);
        lines
            .map(|(role, radius)| Line::contour(role, &circle(radius)))
            .into()
    })
}

/// Driver and driven gear with their teeth and locking arcs, cams and pins as lines, each in its own frame.
fn cut(pair: &IntermittentPair) -> [Vec<Line>; 2] {
    let gears = pair.pair();
    let mut both = [
        gear_pair::lines_within(pair.driver(), gears.driver()),
        gear_pair::lines_within(pair.driven(), gears.driven()),
    ];
    for cam in pair.cams() {
        both[0].push(Line::contour(LineRole::Adjacent, &cam.outline));
        let pins = cam.pins.iter();
        let pins = pins.map(|&at| Outline::circle(at, cam.pin_radius));
        both[1].extend(pins.map(|pin| Line::contour(LineRole::Adjacent, &pin)));
    }
    both
}
