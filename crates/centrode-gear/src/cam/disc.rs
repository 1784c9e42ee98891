//! The disc cam: a follower, its motion, and the base circle it starts from.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use centrode_geometry::{LoopError, OpenOutline, extremes, minimum};
use thiserror::Error;

use super::design::{CamSpec, Follower, Turn};
use super::motion::{Motion, MotionError, Peaks, ends, peaks};
use centrode_kinematics::transmission::{Transmission, TransmissionError};
use centrode_spec::SpecError;
use centrode_spec::rule::positive;

/// A disc cam with its follower, exact.
///
/// Everything is in the frame of the cam: its axis is the origin, and at the input zero the slide points, or the arm's pivot
/// lies, along the x axis. The input is the angle that the cam has turned, in its own sense of rotation, relative to the part
/// that holds the follower.
#[derive(Clone, Debug)]
pub struct DiscCam {
    motion: Arc<dyn Transmission>,
    follower: Follower,
    base_radius: f64,
    rotation: Turn,
    /// Angle of the arm to the centre line on the base circle, rad; zero for a slide.
    start_angle: f64,
    /// Distance of the roller's centre along its slide on the base circle, mm; zero for an arm.
    start_distance: f64,
}

/// Error of a cam that cannot be made.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum CamError {
    /// A value out of its range.
    #[error(transparent)]
    Spec(#[from] SpecError),
    /// The segments make no motion.
    #[error(transparent)]
    Motion(MotionError),
    /// Transmissions that cannot be combined.
    #[error(transparent)]
    Transmission(#[from] TransmissionError),
    /// A motion that changes so fast that the contour takes too many segments.
    #[error(
        "the follower's motion changes too fast after {degrees:.3} deg: up to its next break the cam's contour needs more than {most} segments"
    )]
    Wild {
        /// Cam angle where the contour needs too many segments, degrees.
        degrees: f64,
        /// Maximum number of segments up to the next break.
        most: usize,
    },
    /// A motion that does not come back after one turn of the cam.
    #[error(
        "the follower must be back at its start after one turn of the cam, but its motion has a period of {period} rad and advances by {advance} per period"
    )]
    NotPeriodic {
        /// Input after which the motion repeats.
        period: f64,
        /// Advance over that input.
        advance: f64,
    },
    /// A slide whose offset exceeds the distance of the roller's centre from the axis.
    #[error(
        "the slide is offset by {offset} mm from the axis, but the roller's centre is only {prime_radius} mm from the axis"
    )]
    Offset {
        /// Distance of the slide from the axis, mm.
        offset: f64,
        /// Radius of the base circle and of the roller together, mm.
        prime_radius: f64,
    },
    /// An arm that does not reach the base circle.
    #[error(
        "an arm of {arm} mm with its pivot {center_distance} mm from the axis cannot reach the base circle: the roller's centre or the face must be {distance} mm from the axis"
    )]
    Reach {
        /// Length of the arm or offset of its face, mm.
        arm: f64,
        /// Distance of the pivot from the axis, mm.
        center_distance: f64,
        /// Required distance, mm.
        distance: f64,
    },
    /// An arm that swings through the line from its pivot to the axis, or beyond the opposite direction.
    #[error(
        "at {degrees} deg the arm is at {arm_degrees} deg to the line of centres: this angle must be between 0 and 180 deg"
    )]
    ArmTurnsOver {
        /// Cam angle.
        degrees: f64,
        /// Angle of the arm.
        arm_degrees: f64,
    },
    /// A slide driven through the axis.
    #[error(
        "at {degrees} deg the follower is {distance} mm from the axis along its slide: this distance must be above 0"
    )]
    ThroughAxis {
        /// Cam angle.
        degrees: f64,
        /// Distance along the slide, mm.
        distance: f64,
    },
    /// A flat face that turns with the cam: no point of the profile can touch it.
    #[error(
        "at {degrees} deg the follower's face turns as fast as the cam or faster: it cannot touch the profile"
    )]
    FaceTurnsBack {
        /// Cam angle.
        degrees: f64,
    },
    /// A required retraction of a push rod that its fork cannot reach.
    #[error(
        "at {degrees} deg the rod must be retracted by {retraction} mm, which a lever of {length} mm cannot reach"
    )]
    Retraction {
        /// Cam angle.
        degrees: f64,
        /// Retraction of the rod, mm.
        retraction: f64,
        /// Length of the lever, mm.
        length: f64,
    },
    /// A motion with values that are not numbers.
    #[error("at {degrees} deg the follower's motion is not a number")]
    NotFinite {
        /// Cam angle.
        degrees: f64,
    },
    /// No part of the profile is left after its loops are cut off.
    #[error(
        "the cam has no profile: nothing of it remains after its loops are cut off, because the roller is too large for the base circle"
    )]
    Looped,
    /// The crossings of the profile with itself cannot be determined.
    #[error("the cam has no profile: {0}")]
    Unresolved(LoopError),
    /// A profile that does not enclose the axis.
    #[error("the profile does not enclose the axis")]
    AxisOutside,
    /// The contour does not close.
    #[error(transparent)]
    Open(#[from] OpenOutline),
    /// The bore, with its keyway, cuts into the profile.
    #[error(
        "the bore reaches {reach} mm from the axis, but the minimum radius of the profile is {minimum} mm"
    )]
    Bore {
        /// Radius reached by bore and keyway, mm.
        reach: f64,
        /// Minimum radius of the profile, mm.
        minimum: f64,
    },
}

impl CamError {
    /// Key of the design file at fault.
    #[must_use]
    pub fn key(&self) -> String {
        match self {
            Self::Spec(error) => error.key.clone(),
            Self::Motion(error) => format!("motion.{}", error.key()),
            Self::Offset { .. } => "follower.offset".into(),
            Self::Reach { .. } | Self::FaceTurnsBack { .. } => "follower".into(),
            Self::Bore { .. } => "body.bore".into(),
            Self::Looped | Self::Unresolved(_) | Self::AxisOutside | Self::Open(_) => {
                "base_radius".into()
            }
            Self::NotPeriodic { .. }
            | Self::ArmTurnsOver { .. }
            | Self::ThroughAxis { .. }
            | Self::Retraction { .. }
            | Self::NotFinite { .. }
            | Self::Transmission(_)
            | Self::Wild { .. } => "motion".into(),
        }
    }
}

impl From<MotionError> for CamError {
    fn from(error: MotionError) -> Self {
        match error {
            MotionError::Spec(error) => Self::Spec(error.inside("motion")),
            other => Self::Motion(other),
        }
    }
}

impl DiscCam {
    /// Makes the cam that moves a follower by a motion, in mm for a slide and in rad for an arm; 0 is on the base circle.
    ///
    /// # Errors
    /// [`CamError`] where the follower cannot reach the base circle or follow the motion.
    pub fn new(
        motion: Arc<dyn Transmission>,
        follower: Follower,
        base_radius: f64,
        rotation: Turn,
    ) -> Result<Self, CamError> {
        positive("base_radius", base_radius)?;
        follower.validate().map_err(|e| e.inside("follower"))?;
        let (period, advance) = (motion.period(), motion.advance());
        if (period - TAU).abs() > 1e-12 || advance != 0.0 {
            return Err(CamError::NotPeriodic { period, advance });
        }
        let (start_angle, start_distance) = start(&follower, base_radius)?;
        let cam = Self {
            motion,
            follower,
            base_radius,
            rotation,
            start_angle,
            start_distance,
        };
        cam.follows()?;
        Ok(cam)
    }

    /// Makes the cam of a description.
    ///
    /// # Errors
    /// [`CamError`] naming the rule broken.
    pub fn resolve(spec: &CamSpec) -> Result<Self, CamError> {
        spec.validate()?;
        let motion = Arc::new(Motion::resolve(&spec.motion)?);
        Self::new(
            motion,
            spec.follower.clone(),
            spec.base_radius,
            spec.rotation,
        )
    }

    /// Makes the cam with another base circle.
    ///
    /// # Errors
    /// Those of [`new`](Self::new).
    pub fn with_base_radius(&self, base_radius: f64) -> Result<Self, CamError> {
        let follower = self.follower.clone();
        Self::new(self.motion.clone(), follower, base_radius, self.rotation)
    }

    /// Checks that the follower can take every position of the motion.
    fn follows(&self) -> Result<(), CamError> {
        let ends = self.ends();
        let degrees = f64::to_degrees;
        for pair in ends.windows(2) {
            for input in [pair[0], 0.5 * (pair[0] + pair[1])] {
                let motion = self.motion.at(input);
                let sum = motion.position + motion.velocity + motion.acceleration + motion.jerk;
                if !sum.is_finite() {
                    let degrees = degrees(input);
                    return Err(CamError::NotFinite { degrees });
                }
            }
        }
        let position = |input: f64| self.motion.at(input).position;
        let [low, high] = extremes(position, &ends);
        match self.follower {
            Follower::SwingingRoller(_) | Follower::SwingingFlat(_) => {
                for extreme in [low, high] {
                    let arm = self.start_angle + extreme.value;
                    if !(arm > 0.0 && arm < PI) {
                        return Err(CamError::ArmTurnsOver {
                            degrees: degrees(extreme.input),
                            arm_degrees: degrees(arm),
                        });
                    }
                }
            }
            Follower::TranslatingRoller(_) | Follower::TranslatingFlat(_) => {
                let from = match self.follower {
                    Follower::TranslatingFlat(_) => self.base_radius,
                    _ => self.start_distance,
                };
                let distance = from + low.value;
                if distance <= 0.0 {
                    return Err(CamError::ThroughAxis {
                        degrees: degrees(low.input),
                        distance,
                    });
                }
            }
        }
        let slowest = minimum(|input| self.face_rate(input), &ends);
        if slowest.value <= 0.0 {
            return Err(CamError::FaceTurnsBack {
                degrees: degrees(slowest.input),
            });
        }
        Ok(())
    }

    /// The follower's motion by the cam angle.
    #[must_use]
    pub fn motion(&self) -> &dyn Transmission {
        self.motion.as_ref()
    }

    /// Maximum position, velocity, acceleration and jerk of the follower.
    #[must_use]
    pub fn peaks(&self) -> Peaks {
        peaks(self.motion())
    }

    /// Follower that rides on the cam.
    #[must_use]
    pub fn follower(&self) -> &Follower {
        &self.follower
    }

    /// Radius of the base circle, mm.
    #[must_use]
    pub fn base_radius(&self) -> f64 {
        self.base_radius
    }

    /// Sense in which the cam turns, seen from the follower.
    #[must_use]
    pub fn rotation(&self) -> Turn {
        self.rotation
    }

    /// Angle of a swinging arm to the line from its pivot to the axis on the base circle, rad; zero for
    /// a slide.
    #[must_use]
    pub fn start_angle(&self) -> f64 {
        self.start_angle
    }

    /// Distance of a sliding roller's centre along its slide on the base circle, mm; zero otherwise.
    #[must_use]
    pub fn start_distance(&self) -> f64 {
        self.start_distance
    }

    /// Sense in which the follower turns about the cam: 1 counter-clockwise.
    pub(super) fn sense(&self) -> f64 {
        -self.rotation.sign()
    }

    /// Ends of the analytic parts of one turn.
    pub(super) fn ends(&self) -> Vec<f64> {
        ends(self.motion())
    }
}

/// Angle of the arm, or distance along the slide, on the base circle.
fn start(follower: &Follower, base_radius: f64) -> Result<(f64, f64), CamError> {
    let prime_radius = base_radius + follower.roller_radius().unwrap_or(0.0);
    let reach = |arm: f64, center_distance: f64, distance: f64, cos_or_sin: f64| {
        if cos_or_sin.abs() < 1.0 {
            Ok(())
        } else {
            Err(CamError::Reach {
                arm,
                center_distance,
                distance,
            })
        }
    };
    match follower {
        Follower::TranslatingRoller(f) => {
            if f.offset.abs() >= prime_radius {
                let offset = f.offset;
                return Err(CamError::Offset {
                    offset,
                    prime_radius,
                });
            }
            let along = (prime_radius - f.offset) * (prime_radius + f.offset);
            Ok((0.0, along.sqrt()))
        }
        Follower::TranslatingFlat(_) => Ok((0.0, 0.0)),
        Follower::SwingingRoller(f) => {
            let (c, l) = (f.center_distance, f.arm_length);
            let cos = (c * c + l * l - prime_radius * prime_radius) / (2.0 * c * l);
            reach(l, c, prime_radius, cos)?;
            Ok((cos.acos(), 0.0))
        }
        Follower::SwingingFlat(f) => {
            let distance = base_radius + f.face_offset;
            let sin = distance / f.center_distance;
            reach(f.face_offset, f.center_distance, base_radius, sin)?;
            Ok((sin.asin(), 0.0))
        }
    }
}
