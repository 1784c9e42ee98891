//! The willow-cutting feeder: a picking six-bar that rests while it is filled, driven by an intermittent gear.
//!
//! The input is the angle of the intermittent gear, rad, in the direction that turns the crank counter-clockwise. It is
//! zero when the effector leaves its position under the store. Lengths are in mm. Source: Ye et al., "Optimal design
//! and test of picking mechanism of automatic feeding device for cutting willows", 2022, DOI
//! 10.6041/j.issn.1000-1298.2022.05.010.

mod design;
mod dimension;
mod error;
mod frame;
mod gears;
mod links;
mod mount;
mod parts;
mod plates;
mod search;
mod shafts;

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use centrode_geometry::{Extreme, Point, Recent, bracketed_root, maximum, piece_ends};

pub use design::{BoundsSpec, DriveSpec, FeederDesign, FeederGoals, LinkageSpec, MakingSpec};
pub use dimension::{Dimension, UnknownDimension};
pub use error::FeederError;
pub use gears::GearsSpec;
pub use mount::GearBody;
pub use parts::{FeederPart, Plate};
pub use plates::PlatesSpec;
pub use search::DimensionSearchSpec;

use centrode_gear::{IntermittentDrive, IntermittentPair, IntermittentPairError};
use centrode_kinematics::linkage::{FourBar, SixBar};
use centrode_kinematics::transmission::{MotionJet, Transmission};

/// Number of parts of a stroke; in each part the motion is smooth except at its breaks.
const PARTS: u32 = 8;

/// Stroke of the effector in one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    /// Input at which it begins, rad.
    pub from: f64,
    /// Input at which it ends, rad.
    pub to: f64,
    /// Input of the maximum speed, rad.
    pub fastest: f64,
    /// Maximum speed of the effector per radian of the input, without sign.
    pub speed: f64,
}

/// A feeder: its six-bar, its intermittent drive, and its motion as a function of the input.
#[derive(Clone, Debug)]
pub struct Feeder {
    design: FeederDesign,
    six_bar: SixBar,
    drive: IntermittentDrive,
    law: Arc<dyn Transmission>,
    start: f64,
}

impl Feeder {
    /// Resolves a design.
    ///
    /// # Errors
    /// [`FeederError`] with the violated rule and its numbers.
    pub fn resolve(design: &FeederDesign) -> Result<Self, FeederError> {
        design.validate()?;
        let spec = &design.linkage;
        let four_bar = FourBar::new(
            spec.crank,
            spec.coupler,
            spec.rocker,
            spec.frame,
            spec.branch,
        )?;
        let pivot = Point::from(spec.pivot);
        let six_bar = SixBar::new(four_bar, pivot, spec.effector_length)?;
        let drive = design.gears.drive()?;
        let (teeth, driven) = (design.gears.teeth, design.gears.driven_pitches);
        if teeth != driven {
            return Err(FeederError::NotOneTurn { teeth, driven });
        }
        // The slower stroke feeds, the quicker one returns.
        let extremes = six_bar.extremes();
        let [low, high] = [extremes.low.0, extremes.high.0];
        let start = if (high - low).rem_euclid(TAU) >= PI {
            low
        } else {
            high
        };
        Ok(Self {
            design: design.clone(),
            six_bar,
            drive,
            law: Arc::new(drive.transmission()),
            start,
        })
    }

    /// The design as given.
    #[must_use]
    pub fn design(&self) -> &FeederDesign {
        &self.design
    }

    /// The six-bar.
    #[must_use]
    pub fn six_bar(&self) -> &SixBar {
        &self.six_bar
    }

    /// The motion of the intermittent gear.
    #[must_use]
    pub fn drive(&self) -> &IntermittentDrive {
        &self.drive
    }

    /// The intermittent gear and its mate with their teeth, locking arcs and entry cam.
    ///
    /// Cutting the gears takes long; the result is cached by the gears' design.
    ///
    /// # Errors
    /// [`FeederError::Gears`] if they cannot be cut.
    pub fn gears(&self) -> Result<Arc<IntermittentPair>, FeederError> {
        static CUT: Recent<GearsSpec, Result<Arc<IntermittentPair>, IntermittentPairError>> =
            Recent::new();
        let spec = &self.design.gears;
        Ok(CUT.get(spec, || {
            IntermittentPair::resolve(&spec.pair()).map(Arc::new)
        })?)
    }

    /// Crank angle at which the effector rests and is filled, rad: the end of its swing at which the slower stroke
    /// begins.
    #[must_use]
    pub fn start(&self) -> f64 {
        self.start
    }

    /// The crank's angle at an input.
    #[must_use]
    pub fn crank(&self, input: f64) -> MotionJet {
        let mut jet = self.law.at(input);
        jet.position += self.start;
        jet
    }

    /// The effector's angle at an input, without jumps of whole turns.
    #[must_use]
    pub fn effector(&self, input: f64) -> MotionJet {
        let crank = self.crank(input);
        self.six_bar.effector_angle(crank.position).after(&crank)
    }

    /// The effector's tip E at an input.
    #[must_use]
    pub fn tip(&self, input: f64) -> Point {
        let [_, _, e] = self.six_bar.joints(self.crank(input).position);
        e
    }

    /// Speed of the tip at an input and at the design's speed, mm/s.
    #[must_use]
    pub fn tip_speed(&self, input: f64) -> f64 {
        (self.effector(input).velocity * self.speed() * self.six_bar.effector_length()).abs()
    }

    /// Inputs in `[0, 2 pi)` at which the law of the motion may change, ascending.
    #[must_use]
    pub fn breaks(&self) -> Vec<f64> {
        self.law.breaks()
    }

    /// Ends of short intervals of one cycle, from 0 to a whole turn; within each the motion is smooth.
    #[must_use]
    pub fn pieces(&self) -> Vec<f64> {
        piece_ends(0.0, TAU, 2 * PARTS, &self.breaks())
    }

    /// Input at which the crank has turned by an angle from its rest position, rad; the angle is at most one turn.
    #[must_use]
    pub fn input_at(&self, turned: f64) -> f64 {
        let motion = self.drive.motion_angle();
        let off = |input: f64| self.law.at(input).position - turned;
        let (low, high) = (off(0.0), self.drive.driven_angle() - turned);
        if low >= 0.0 {
            return 0.0;
        }
        if high <= 0.0 {
            return motion;
        }
        bracketed_root(off, 0.0, motion, low, high)
    }

    /// Strokes from the store to the conveyor, and back.
    #[must_use]
    pub fn strokes(&self) -> [Stroke; 2] {
        let extremes = self.six_bar.extremes();
        let ends = [extremes.low.0, extremes.high.0];
        let turned = ends.map(|crank| (crank - self.start).rem_euclid(TAU));
        let turn = self.input_at(turned[0].max(turned[1]));
        let motion = self.drive.motion_angle();
        [(0.0, turn), (turn, motion)].map(|(from, to)| self.stroke(from, to))
    }

    fn stroke(&self, from: f64, to: f64) -> Stroke {
        let speed = |input: f64| self.effector(input).velocity.abs();
        let ends = piece_ends(from, to, PARTS, &self.breaks());
        let Extreme { input, value } = maximum(speed, &ends);
        Stroke {
            from,
            to,
            fastest: input,
            speed: value,
        }
    }

    /// Speed of the intermittent gear, rad/s.
    #[must_use]
    pub fn speed(&self) -> f64 {
        self.cycles_per_minute() * TAU / 60.0
    }

    /// Cycles per minute, equal to the turns of the intermittent gear.
    #[must_use]
    pub fn cycles_per_minute(&self) -> f64 {
        self.design.drive.motor_rpm / self.design.drive.chain_ratio
    }

    /// Cuttings fed per minute.
    #[must_use]
    pub fn feed_rate(&self) -> f64 {
        self.cycles_per_minute() * f64::from(self.design.drive.slots)
    }

    /// Time for which the effector rests in each cycle, s.
    #[must_use]
    pub fn dwell_time(&self) -> f64 {
        self.drive.dwell_time(self.speed())
    }

    /// Distance of the effector's pivot from the chord between the slider's dead centres, mm; `None` if the foot of the
    /// perpendicular is not on the chord. With the pivot on the chord, any lengths swing the effector by half a turn.
    #[must_use]
    pub fn distance_from_chord(&self) -> Option<f64> {
        let dead = self.six_bar.four_bar().dead_centers()?;
        let chord = dead.stretched_at - dead.folded_at;
        let way = self.six_bar.pivot() - dead.folded_at;
        let share = way.dot(&chord) / chord.norm_squared();
        (0.0..=1.0)
            .contains(&share)
            .then(|| chord.perp(&way).abs() / chord.norm())
    }
}

#[cfg(test)]
mod tests;
