//! Screws of a three-arm mechanism: those of the carrier's plates, with spacers between the plates, and those of the arms'
//! covers.

use centrode_geometry::{Outline, Point};

use super::{Pusher, ThreeArm, ThreeArmLink};
use crate::arm::ArmBody;
use crate::screw_room::ScrewRoom;
use centrode_kinematics::machine::{Fastening, FasteningError};

/// Minimum length of thread in screw diameters: in a steel spacer, and in a housing of light alloy.
const ENTERED: [f64; 2] = [1.0, 1.5];
/// Minimum distance of the axis of a screw from the edge of the carrier's plates, in diameters.
const EDGE: f64 = 1.5;
/// Minimum distance of the axis of a screw from the edge of a cover, in diameters of its hole; EN 1993-1-8, 3.5, e1 and e2.
const COVER_EDGE: f64 = 1.2;
/// Minimum number of screws per plate of the carrier.
const OF_CARRIER: usize = 3;
/// Number of screws per cover.
const OF_COVER: usize = 4;

/// A circle that does not move: its centre and its radius, mm.
fn round(at: Point, radius: f64) -> ([Point; 2], f64) {
    ([at; 2], radius)
}

impl ThreeArm {
    /// Screws of the carrier's plates, in the carrier's frame, with heights from the rear faces of the gears. Each enters a steel
    /// spacer of twice its diameter. Spacers clear the gears, and heads the arms' housings, by the gearbox's clearance. `None` if
    /// the design requires no screws.
    #[must_use]
    pub fn carrier_screws(&self, arm: &ArmBody) -> Option<Result<Fastening, FasteningError>> {
        let spec = &self.design().gearbox;
        let [rear, front] = self.gearbox()?.spans;
        let faces = [rear[0], front[1]];
        let reach = farthest(&arm.within(0.0)?, Point::origin());
        Fastening::largest(spec.screw, spec.wall, |diameter| {
            let mut found = Fastening::new(diameter, faces, spec.wall, ENTERED[0])?;
            let inside = spec.housing_offset - EDGE * diameter;
            let belt = Outline::hull(&self.around_gears(inside));
            let teeth = self.design().tool.addendum_coefficient() * self.module().unwrap_or(0.0);
            let gears = self.around_gears(teeth + spec.clearance);
            let gears = gears.into_iter().map(|(at, radius)| round(at, radius));
            let arms = (0..self.arms()).map(|k| {
                let at = self.on_carrier(ThreeArmLink::Planet(k));
                round(at, reach + spec.clearance)
            });
            // Spacers and heads are not wider than twice the diameter.
            let room = ScrewRoom {
                line: belt,
                taken: gears.chain(arms).collect(),
                turns: self.arms(),
                grid: 0.0,
            };
            found.at = room.places(diameter, diameter, OF_CARRIER)?;
            Ok(found)
        })
    }

    /// Screws of the covers of an arm, in the arm's frame. Each enters a boss of twice its diameter inside the wall between the
    /// covers. Bosses clear cam, fork, spring and rod by half a wall. `None` if the design requires no screws.
    #[must_use]
    pub fn cover_screws(
        &self,
        pusher: &Pusher,
        arm: &ArmBody,
    ) -> Option<Result<Fastening, FasteningError>> {
        let housing = self.arm_sizes().housing;
        let half = 0.5 * housing.width;
        Fastening::largest(housing.screw, housing.wall, |diameter| {
            let (faces, wall) = ([-half, half], housing.wall);
            let mut found = Fastening::new(diameter, faces, wall, ENTERED[1])?;
            let room = ScrewRoom {
                line: arm.within(COVER_EDGE * found.screw.clearance_hole()),
                taken: self.moving_inside(pusher, arm),
                turns: 1,
                grid: 0.0,
            };
            let radius = diameter + 0.5 * housing.wall;
            found.at = room.places(diameter, radius, OF_COVER)?;
            Ok(found)
        })
    }

    /// Room of the parts that move in an arm's housing, and of the openings in its covers.
    fn moving_inside(&self, pusher: &Pusher, arm: &ArmBody) -> Vec<([Point; 2], f64)> {
        let (spec, housing) = (pusher.fork_spec(), self.arm_sizes().housing);
        let origin = Point::origin();
        let cam = farthest(pusher.cam().profile().outline(), origin);
        let bores = 0.5 * housing.bore.max(housing.sleeve_bore);
        let mut taken = vec![round(origin, cam.max(bores))];
        // The fork turns in one direction during a stroke. At each sample, lines between pivot, roller and slot end cover it.
        let pivot = pusher.pivot();
        for i in 0..=SWINGS {
            let back = pusher.stroke() * f64::from(i) / f64::from(SWINGS);
            let roller = pusher.roller(back);
            taken.push((
                [pivot, roller],
                0.5 * spec.pivot_bore.max(spec.roller_bore) + spec.wall,
            ));
            taken.push(round(roller, spec.roller_radius));
            if let Some(pin) = pusher.pin() {
                let pin = Point::new(pin.x - back, pin.y);
                let around = 0.5 * spec.slot_width.max(spec.pivot_bore) + spec.wall;
                // The slot ends at the maximum distance of the pin from the pivot, which the pin has at both ends of the stroke.
                let end = pivot + (pin - pivot).normalize() * self.slot_end(pusher);
                taken.push(([pivot, end], around));
                taken.push(([roller, end], around));
            }
        }
        for part in arm.parts() {
            let moves = match part.name {
                "push-rod" => pusher.stroke(),
                "spring" => 0.0,
                _ => continue,
            };
            let bounds = part.outline.bounds();
            let half = 0.5 * (bounds.max.y - bounds.min.y);
            let y = bounds.center().y;
            // The part with its stroke, along its axis; it is at least as wide as the bore through which the rod leaves the
            // housing.
            let ends = [bounds.min.x - moves, bounds.max.x].map(|x| Point::new(x, y));
            taken.push((ends, half.max(0.5 * self.arm_sizes().rod_bore())));
        }
        taken
    }

    /// Distance of the far end of the fork's slot from its pivot, mm.
    fn slot_end(&self, pusher: &Pusher) -> f64 {
        let lever = pusher.pin().map(|pin| (pin - pusher.pivot()).norm());
        lever.unwrap_or_default()
    }
}

/// Number of steps of the fork's stroke that are sampled.
const SWINGS: u32 = 24;

/// Distance of the farthest point of a contour from a position, mm, from samples of every segment.
fn farthest(outline: &Outline, from: Point) -> f64 {
    let points = outline
        .segments()
        .iter()
        .flat_map(|segment| (0..=8).map(|i| segment.at(0.25 * f64::from(i) - 1.0).point));
    points.map(|p| (p - from).norm()).fold(0.0, f64::max)
}
