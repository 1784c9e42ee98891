mod error;

use std::f64::consts::{FRAC_PI_2, TAU};
use std::sync::Arc;

use centrode_geometry::{Outline, Point, Vector};
use nalgebra::Rotation2;

use super::ThreeArm;
use super::design::{ForkSpec, PusherCamSpec};
use super::making::{PRESSED, ROLLING, SWINGING};
use crate::arm::{ArmBody, ArmBodySpec, ArmError};
use centrode_gear::cam::design::{Dwell, MotionSpec, SegmentSpec, Travel, Turn};
use centrode_gear::cam::{Cam, CamError, Fork, Lever, Motion, RodJoint};
use centrode_kinematics::machine::PinFit;
use centrode_kinematics::transmission::{MotionJet, Transmission};

pub use error::PusherError;

/// Drive of an arm's push rod: the cam on the carrier and the fork on the arm.
///
/// The fork's pivot is on the line from the planet's axis perpendicular to the pusher's axis. The lever on the rod is therefore
/// as long as the distance of the pivot from the pusher's axis, and swings equally to both sides of the perpendicular.
#[derive(Clone, Debug)]
pub struct Pusher {
    cam: Cam,
    fork: Fork,
    spec: ForkSpec,
    motion: Arc<Motion>,
    stroke: f64,
    /// Sign: 1 if the pusher's axis is to the right of the planet's axis, seen along the clamp, else -1.
    side: f64,
    cam_angle: f64,
    spans: Spans,
}

/// Extents of the parts along the planet's axis, mm, from the middle of the arm's housing.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Spans {
    cam: [f64; 2],
    fork: [f64; 2],
}

impl ThreeArm {
    /// Sizes of the arms: those of the design, or the default ones of [`UsualArm`](crate::arm::UsualArm).
    #[must_use]
    pub fn arm_sizes(&self) -> ArmBodySpec {
        let arm = &self.design().arm;
        let usual = || arm.usual().body;
        arm.body.clone().unwrap_or_else(usual)
    }

    /// The body of each arm.
    ///
    /// # Errors
    /// [`ArmError`] if its parts do not fit each other or its outline crosses itself.
    pub fn arm_body(&self) -> Result<ArmBody, ArmError> {
        let arm = &self.design().arm;
        let (reach, offset) = (arm.tip_distance, arm.pusher_offset);
        ArmBody::new(&self.arm_sizes(), reach, offset, arm.clamp_length)
    }

    /// Cam and fork of each arm.
    ///
    /// # Errors
    /// [`PusherError`] with the violated rule and its numbers.
    pub fn pusher(&self) -> Result<Pusher, PusherError> {
        let design = self.design();
        let scale = design.arm.usual().scale;
        let usual_cam = || PusherCamSpec::usual(scale);
        let cam = design.cam.clone().unwrap_or_else(usual_cam);
        let usual_fork = || ForkSpec::usual(scale);
        let fork = design.fork.clone().unwrap_or_else(usual_fork);
        let sizes = self.arm_sizes();
        sizes.validate()?;
        Pusher::new(self, &cam, fork, &sizes)
    }
}

impl Pusher {
    fn new(
        mechanism: &ThreeArm,
        spec: &PusherCamSpec,
        fork: ForkSpec,
        sizes: &ArmBodySpec,
    ) -> Result<Self, PusherError> {
        let offset = mechanism.design().arm.pusher_offset;
        let lever = offset.abs() - fork.pivot_distance;
        if lever <= 0.0 {
            return Err(PusherError::Pivot {
                pivot_distance: fork.pivot_distance,
                pusher_offset: offset.abs(),
            });
        }
        let needed = 0.5 * (fork.pivot_bore + fork.roller_bore);
        if fork.arm_length <= needed {
            return Err(PusherError::Holes {
                arm_length: fork.arm_length,
                needed,
            });
        }
        let spans = Spans::new(spec, &fork, sizes)?;
        let stroke = sizes.push_rod.stroke;
        let (pin, rod) = (0.5 * stroke, sizes.rod_end() + fork.slot_width);
        if pin < rod {
            return Err(PusherError::RodEnd { pin, rod });
        }
        let side = if offset < 0.0 { -1.0 } else { 1.0 };
        let follower = Fork {
            roller_radius: fork.roller_radius,
            center_distance: fork.pivot_distance,
            arm_length: fork.arm_length,
            lifts: if side > 0.0 {
                Turn::Clockwise
            } else {
                Turn::CounterClockwise
            },
            rod: RodJoint::PinOnRod(Lever {
                length: lever,
                start: -(0.5 * stroke / lever).atan(),
            }),
        };
        let motion = Arc::new(motion(mechanism, spec, stroke)?);
        let turning = Arc::new(mechanism.train().arm_on_carrier());
        let disc = follower.cam_by_input(motion.clone(), turning, spec.base_radius)?;
        let cam = Cam::new(disc, "cam", spec.body.clone())?;
        let start = mechanism.train().at(0.0);
        let on_carrier = start.arm.position - start.carrier.position;
        let pusher = Self {
            cam,
            fork: follower,
            spec: fork,
            motion,
            stroke,
            side,
            cam_angle: on_carrier + mechanism.clamp_mounting() - side * FRAC_PI_2,
            spans,
        };
        let housing = &sizes.housing;
        let (reach, room) = (pusher.reach(), housing.drum_radius - housing.wall);
        // The limit holds above the planet's axis. Below it the belt to the tube leaves more room than the drum.
        let high = pusher.roller(stroke);
        if reach > room && high.y * side > 0.0 {
            return Err(PusherError::Roller { reach, room });
        }
        Ok(pusher)
    }

    /// The cam.
    #[must_use]
    pub fn cam(&self) -> &Cam {
        &self.cam
    }

    /// The fork as a follower.
    #[must_use]
    pub fn fork(&self) -> &Fork {
        &self.fork
    }

    /// The fork as a part.
    #[must_use]
    pub fn fork_spec(&self) -> &ForkSpec {
        &self.spec
    }

    /// Fit of the fork's pivot: a pin in the front cover of the arm.
    #[must_use]
    pub fn pivot_fit(&self) -> PinFit {
        let [pressed, pin] = PRESSED;
        PinFit {
            size: self.spec.pivot_bore,
            pin,
            pressed,
            running: SWINGING,
        }
    }

    /// Fit of the roller: a pin in the fork.
    #[must_use]
    pub fn roller_fit(&self) -> PinFit {
        PinFit {
            size: self.spec.roller_bore,
            running: ROLLING,
            ..self.pivot_fit()
        }
    }

    /// Stroke of the rod, mm.
    #[must_use]
    pub fn stroke(&self) -> f64 {
        self.stroke
    }

    /// Retraction of the first arm's rod at a carrier turn, mm; zero in the thrown-out position.
    #[must_use]
    pub fn retraction(&self, input: f64) -> MotionJet {
        self.motion.at(input)
    }

    /// Inputs in one turn at which a derivative of the first arm's rod may jump, ascending.
    #[must_use]
    pub fn breaks(&self) -> Vec<f64> {
        Transmission::breaks(self.motion.as_ref())
    }

    /// Turn of the cam's frame from the carrier's, for the first arm, rad.
    #[must_use]
    pub fn cam_angle(&self) -> f64 {
        self.cam_angle
    }

    /// The fork's pivot, in the arm's frame, mm.
    #[must_use]
    pub fn pivot(&self) -> Point {
        Point::new(0.0, -self.side * self.spec.pivot_distance)
    }

    /// Turn of the fork's frame from the arm's, rad, with the rod drawn back by a length, mm. The fork's x axis points from its
    /// pivot to the roller.
    #[must_use]
    pub fn fork_angle(&self, retraction: &MotionJet) -> MotionJet {
        let swing = self.fork.rod.swing(retraction);
        let side = self.side;
        MotionJet {
            position: side * (FRAC_PI_2 - self.cam.disc().start_angle() - swing.position),
            velocity: -side * swing.velocity,
            acceleration: -side * swing.acceleration,
            jerk: -side * swing.jerk,
        }
    }

    /// The roller's axis in the arm's frame with the rod drawn back by a length, mm.
    #[must_use]
    pub fn roller(&self, retraction: f64) -> Point {
        let jet = MotionJet::at_rest(retraction);
        let (sin, cos) = self.fork_angle(&jet).position.sin_cos();
        self.pivot() + Vector::new(cos, sin) * self.spec.arm_length
    }

    /// Maximum distance of the roller from the planet's axis with the rod drawn back, mm.
    #[must_use]
    pub fn reach(&self) -> f64 {
        self.roller(self.stroke).coords.norm() + self.spec.roller_radius
    }

    /// Contour of the fork in its own frame, and its holes: for the pivot's pin, for the roller's pin, and the slot for the
    /// rod's pin.
    #[must_use]
    pub fn fork_outline(&self) -> Option<(Outline, Vec<Outline>)> {
        let ForkSpec {
            arm_length,
            roller_bore,
            pivot_bore,
            slot_width,
            wall,
            ..
        } = self.spec;
        let RodJoint::PinOnRod(lever) = self.fork.rod else {
            return None;
        };
        let pivot = (Point::origin(), 0.5 * pivot_bore);
        let roller = (Point::new(arm_length, 0.0), 0.5 * roller_bore);
        let along = self.slot()?;
        let pin = 0.5 * slot_width;
        let slot = [lever.length, lever.length / lever.start.cos()]
            .map(|distance| (Point::from(along * distance), pin));
        let around = [pivot, roller, slot[1]].map(|(center, radius)| (center, radius + wall));
        let circle = |(center, radius)| Outline::circle(center, radius);
        let holes = vec![circle(pivot), circle(roller), Outline::hull(&slot)?];
        Some((Outline::hull(&around)?, holes))
    }

    /// Direction of the fork's slot in its own frame, from its pivot.
    #[must_use]
    pub fn slot(&self) -> Option<Vector> {
        let RodJoint::PinOnRod(lever) = self.fork.rod else {
            return None;
        };
        // Angle from the direction of the roller to that of the lever, which is the same at every swing.
        let angle = -self.side * (2.0 * FRAC_PI_2 + lever.start - self.cam.disc().start_angle());
        Some(Rotation2::new(angle) * Vector::x())
    }

    /// The rod's pin in the fork's slot with the rod thrown out, in the arm's frame, mm.
    #[must_use]
    pub fn pin(&self) -> Option<Point> {
        let RodJoint::PinOnRod(lever) = self.fork.rod else {
            return None;
        };
        let down = self.spec.pivot_distance + lever.length;
        Some(Point::new(0.5 * self.stroke, -self.side * down))
    }

    /// Extent of the cam along the planet's axis, mm, from the middle of the arm's housing.
    #[must_use]
    pub fn cam_span(&self) -> [f64; 2] {
        self.spans.cam
    }

    /// Extent of the fork along the planet's axis, mm, from the middle of the arm's housing.
    #[must_use]
    pub fn fork_span(&self) -> [f64; 2] {
        self.spans.fork
    }
}

impl Spans {
    /// Extents: the rod is in the middle, the fork behind it, the cam with the roller behind the fork.
    fn new(cam: &PusherCamSpec, fork: &ForkSpec, sizes: &ArmBodySpec) -> Result<Self, PusherError> {
        let rod = &sizes.push_rod;
        let gap = 0.1 * rod.diameter;
        let front = -0.5 * rod.diameter - gap;
        let fork = [front - fork.width, front];
        let top = fork[0] - gap;
        let cam = [top - cam.body.width, top];
        let (needed, room) = (-cam[0], 0.5 * sizes.housing.width - sizes.housing.wall);
        if needed > room {
            return Err(PusherError::Depth { needed, room });
        }
        Ok(Self { cam, fork })
    }
}

/// Retraction of the rod as a function of carrier turn: drawn back up to picking, held, thrown out from planting on.
fn motion(mechanism: &ThreeArm, spec: &PusherCamSpec, stroke: f64) -> Result<Motion, PusherError> {
    let (pick, plant) = (mechanism.picking(0), mechanism.planting(0));
    let hold = (plant - pick).rem_euclid(TAU);
    let rest = TAU - spec.closing - hold - spec.release;
    if rest <= 0.0 || hold <= 0.0 {
        return Err(PusherError::NoRest {
            closing: spec.closing.to_degrees(),
            hold: hold.to_degrees(),
            release: spec.release.to_degrees(),
        });
    }
    let travel = |span, law: &centrode_gear::cam::law::LawSpec| Travel {
        span,
        lift: Some(stroke),
        swing: None,
        law: law.clone(),
    };
    let dwell = |span| SegmentSpec::Dwell(Dwell { span });
    let written = MotionSpec {
        start: pick - spec.closing,
        segments: vec![
            SegmentSpec::Rise(travel(spec.closing, &spec.closing_law)),
            dwell(hold),
            SegmentSpec::Return(travel(spec.release, &spec.release_law)),
            dwell(rest),
        ],
    };
    Ok(Motion::resolve(&written).map_err(CamError::from)?)
}

#[cfg(test)]
mod tests;
