//! Screws and spacers between the two plates of the frame, and the contour of the frame plates around them.

use std::f64::consts::TAU;

use centrode_geometry::{Outline, Point, Recent};

use super::{Feeder, FeederError, FeederPart, GearsSpec, LinkageSpec, Plate, PlatesSpec};
use crate::screw_room::ScrewRoom;
use centrode_kinematics::machine::{Fastening, FasteningError};

/// Minimum length of thread that a screw enters in a steel spacer, in screw diameters.
const ENTERED: f64 = 1.0;
/// Distance of the axis of a screw from the edge of the frame, in screw diameters.
const EDGE: f64 = 1.5;
/// Number of screws of the frame.
const SCREWS: usize = 4;
/// Positions of the crank at which the links are sampled.
const PLACES: u32 = 180;
/// Step of the coordinates of screws, mm.
const GRID: f64 = 1.0;
/// Steps by which the frame grows, as a share of the plates' width, and their number.
const STEP: f64 = 0.125;
const STEPS: u32 = 80;

/// Parts of the design that determine the positions of the screws.
type Frame = (LinkageSpec, PlatesSpec, GearsSpec);

impl Feeder {
    /// Screws of both plates of the frame, in the frame's axes. Each enters a steel spacer of twice its diameter. The screws
    /// clear all links in every position of the crank, and gears and cams behind the frame, by the gap of the plates. The frame
    /// grows until its screws surround its middle. `None` if the design requires no screws.
    #[must_use]
    pub fn frame_screws(&self) -> Option<Result<Fastening, FasteningError>> {
        static FOUND: Recent<Frame, Option<Result<Fastening, FasteningError>>> = Recent::new();
        let design = self.design();
        let spec = &design.plates;
        let key = (design.linkage.clone(), spec.clone(), design.gears.clone());
        FOUND.get(&key, || {
            let next = spec.thickness + spec.gap;
            let faces = [-next, -next + 5.0 * next + spec.thickness];
            let taken = self.swept();
            Fastening::largest(spec.screw, spec.thickness, |diameter| {
                let mut found = Fastening::new(diameter, faces, spec.thickness, ENTERED)?;
                found.at = self.around(diameter, &taken)?;
                Ok(found)
            })
        })
    }

    /// A plate with the screws of the frame: the frame plate reaches around them and has their holes, other plates are unchanged.
    ///
    /// # Errors
    /// [`FeederError::NoPlate`] if the contour encloses nothing.
    pub fn screwed(&self, mut plate: Plate) -> Result<Plate, FeederError> {
        let screws = self.frame_screws().and_then(Result::ok);
        let Some(screws) = screws.filter(|_| plate.part == FeederPart::Frame) else {
            return Ok(plate);
        };
        let half = 0.5 * self.design().plates.width;
        let joints = plate.joints.iter().map(|joint| (joint.at, half));
        let edge = EDGE * screws.screw.diameter;
        let around = joints.chain(screws.at.iter().map(|at| (*at, edge)));
        plate.outline = Outline::hull(&around.collect::<Vec<_>>())
            .ok_or_else(|| FeederError::NoPlate(plate.part.name()))?;
        plate.screws = screws.clearance_holes();
        Ok(plate)
    }

    /// Positions of screws around the joints of the frame, as near to the joints as the room allows.
    fn around(
        &self,
        diameter: f64,
        taken: &[([Point; 2], f64)],
    ) -> Result<Vec<Point>, FasteningError> {
        let joints = self.on_frame();
        let middle = joints
            .iter()
            .map(|at| at.coords)
            .sum::<centrode_geometry::Vector>()
            / 4.0;
        let width = self.design().plates.width;
        let mut last = None;
        for step in 0..STEPS {
            let radius = 0.5 * width - EDGE * diameter + STEP * width * f64::from(step);
            let circles = joints.map(|at| (at, radius.max(0.0)));
            let room = ScrewRoom {
                line: Outline::hull(&circles),
                taken: taken.to_vec(),
                turns: 1,
                grid: GRID,
            };
            match room.places(diameter, diameter, SCREWS) {
                Ok(places) if is_within(Point::from(middle), &places) => return Ok(places),
                Ok(places) => {
                    last = Some(FasteningError::NoRoom {
                        diameter,
                        found: places.len(),
                        around: 2.0 * diameter,
                    });
                }
                Err(error) => last = Some(error),
            }
        }
        last.map_or_else(|| Ok(Vec::new()), Err)
    }

    /// Positions of the shafts and pins that the frame holds: A, D, F, G.
    fn on_frame(&self) -> [Point; 4] {
        let frame = self.six_bar().four_bar().lengths()[3];
        let away = self.design().gears.center_distance();
        [
            Point::origin(),
            Point::new(frame, 0.0),
            self.six_bar().pivot(),
            Point::new(-away, 0.0),
        ]
    }

    /// Room that the links sweep between the plates of the frame, and that of the gears behind them.
    fn swept(&self) -> Vec<([Point; 2], f64)> {
        let (spec, gears) = (&self.design().plates, &self.design().gears);
        let [a, d, f, g] = self.on_frame();
        let half = 0.5 * spec.width + spec.gap;
        let far = self.six_bar().effector_length();
        let far = far.max(self.six_bar().maximum_slider_distance() + spec.slider_length);
        // Between two sampled positions a point moves by at most half a step times its reach: links are widened by this.
        let step = 0.5 * TAU / f64::from(PLACES);
        let mut taken = Vec::new();
        for i in 0..PLACES {
            let crank = TAU * f64::from(i) / f64::from(PLACES);
            let [b, c, _] = self.six_bar().joints(crank);
            let end = f + (c - f).normalize() * far;
            let moves = |reach: f64| half + step * reach;
            taken.extend([
                ([a, b], moves((b - a).norm())),
                ([b, c], moves((b - a).norm() + (c - d).norm())),
                ([d, c], moves((c - d).norm())),
                ([f, end], moves(2.0 * far)),
            ]);
        }
        let tip = |pitches: u32| 0.5 * gears.module * f64::from(pitches) + gears.module + spec.gap;
        let (driver, driven) = (tip(gears.driver_pitches), tip(gears.driven_pitches));
        // The reach of a cam is the distance of the pin that it takes first or leaves last.
        let circle = 0.75 * gears.module * f64::from(gears.driven_pitches);
        let (circle, away) = (0.5 * gears.pin_circle.unwrap_or(circle), (g - a).norm());
        let square = away * away + circle * circle - 2.0 * away * circle * gears.pin_angle.cos();
        let cams = match self.has_cams() {
            true => square.sqrt() + 0.5 * gears.cam_pin() + spec.gap,
            false => 0.0,
        };
        taken.extend([([a, a], driven), ([g, g], driver.max(cams))]);
        taken
    }
}

/// Whether a point is within the convex hull of other points.
fn is_within(at: Point, others: &[Point]) -> bool {
    let circles: Vec<(Point, f64)> = others.iter().map(|other| (*other, 0.0)).collect();
    Outline::hull(&circles).is_some_and(|hull| {
        hull.segments().iter().all(|side| {
            let (from, to) = (side.start(), side.end());
            (to - from).perp(&(at - from)) > 0.0
        })
    })
}
