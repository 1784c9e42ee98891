mod crank;
mod required;

use centrode_geometry::Extreme;
use thiserror::Error;

use self::crank::Crank;
use super::reversed::{fewest_steps, minimum_convex_radii, table_pair};
use crate::reverse::{Timing, TimingError};
use centrode_gear::{GearPairError, PlannedPair};
use centrode_machines::machine::{Machine, MachineDesign, MachineError};
use centrode_spec::degrees;
use centrode_spec::digits::stated;

/// Accepted distance of the output from its law, as a share of the stroke.
const NEAR_ENOUGH: f64 = 1e-7;
/// Range of the centre distance, mm.
const DISTANCES: [f64; 2] = [1e-3, 1e6];
/// Maximum angle of the direction to the shaft, positive or negative, degrees.
const MAX_DIRECTION: f64 = 360.0;

/// Crank of a machine that a gear pair must drive, and position of the driving shaft.
#[derive(Clone, Debug, PartialEq)]
pub struct GearDriveSpec {
    /// Body that turns evenly in the machine as it is: the crank.
    pub body: String,
    /// Distance of the driving shaft from the crank's axis, mm.
    pub center_distance: f64,
    /// Direction from the crank's axis to the driving shaft, in the frame's axes, rad.
    pub direction: f64,
}

/// A machine whose crank is driven by a pair of non-circular gears, so that its output does what its goals require.
#[derive(Clone, Debug)]
pub struct GearDrive {
    /// The design; its teeth are fitted, of a count that may be changed.
    pub design: MachineDesign,
    /// Whether the output is an angle, in rad, and not a position, in mm.
    pub turns: bool,
    /// Law of the crank by the input; its output is the one that the goals name.
    pub timing: Timing,
    /// Steps of the table in which the law is written.
    pub steps: u32,
    /// Maximum distance of the output from its position with the exact law, mm or rad, and the input there.
    pub miss: Extreme,
    /// Minimum radii of curvature where convex, mm: of driver and driven gear.
    pub minimum_radii: [f64; 2],
    /// Names of the goals that do not define the law: goals of another kind, or without `within_deg`.
    pub left_alone: Vec<String>,
}

/// Reason why no gear pair drives the crank as required.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum GearDriveError {
    /// The machine as it is, or the driven one, is impossible.
    #[error(transparent)]
    Machine(#[from] Box<MachineError>),
    /// A body that is no crank on the frame.
    #[error(
        "{body} {why}: the crank must turn on a point of the frame with law = {{ ratio = 1 }} or -1, and optionally start_deg"
    )]
    NoCrank {
        /// The body named.
        body: String,
        /// Rule that it breaks.
        why: String,
    },
    /// Another body moves by the input.
    #[error(
        "bodies.{body}.law also moves {body} by the input: only the crank may do so, otherwise the output depends on both"
    )]
    Another {
        /// The other body.
        body: String,
    },
    /// No goal defines the output.
    #[error(
        "no goal defines the output: give a goal with over = \"deviation\", uniform and within_deg, or, for a rest, a goal with over = \"span\", maximum and within_deg"
    )]
    Nothing,
    /// Goals of several figures, or one that is no position or angle.
    #[error("goals.{goal} has figure {figure}: {why}")]
    Figure {
        /// The goal.
        goal: String,
        /// Its figure.
        figure: String,
        /// The rule broken.
        why: String,
    },
    /// A name that the drive needs is already used.
    #[error("{key} exists already, but the drive needs this name: rename it")]
    Taken {
        /// Its key.
        key: String,
    },
    /// A period of several turns.
    #[error("input.turns must be 1, not {turns}: a machine with such a drive repeats after 1 turn")]
    Turns {
        /// Turns given.
        turns: u32,
    },
    /// A centre distance out of range.
    #[error("the centre distance must be {minimum} to {maximum:e} mm, not {}", stated(*distance))]
    Distance {
        /// Given, mm.
        distance: f64,
        /// Minimum, mm.
        minimum: f64,
        /// Maximum, mm.
        maximum: f64,
    },
    /// A direction out of range.
    #[error("the direction of the shaft must be -{maximum} to {maximum} deg, not {}", stated(*direction))]
    Direction {
        /// Given, degrees.
        direction: f64,
        /// Maximum, degrees.
        maximum: f64,
    },
    /// No law does what is required.
    #[error(transparent)]
    Timing(#[from] TimingError),
    /// The gears do not exist.
    #[error(transparent)]
    Gears(#[from] GearPairError),
}

impl GearDrive {
    /// Name of its pair in the design.
    pub const PAIR: &'static str = crank::DRIVE;

    /// Finds the law and the gears with which the output meets its goals to move evenly (`over = "deviation"`) and to rest
    /// (`over = "span"` with `maximum` and `within_deg`); other goals are ignored.
    ///
    /// The law is written as a table of driven angles with the smallest of 90, 180 and so on up to 2,880 steps that brings the
    /// output within 1e-7 of its stroke.
    ///
    /// # Errors
    /// [`GearDriveError`]: a body that is no crank, goals that contradict each other, or a motion that no gears can make.
    pub fn new(design: &MachineDesign, spec: &GearDriveSpec) -> Result<Self, GearDriveError> {
        let [minimum, maximum] = DISTANCES;
        let distance = spec.center_distance;
        let is_between = distance >= minimum && distance <= maximum;
        if !is_between {
            return Err(GearDriveError::Distance {
                distance,
                minimum,
                maximum,
            });
        }
        let (direction, maximum) = (degrees::rounded(spec.direction), MAX_DIRECTION);
        let is_direction = direction.abs() <= maximum;
        if !is_direction {
            return Err(GearDriveError::Direction { direction, maximum });
        }
        let crank = Crank::new(design, spec)?;
        let composed = Machine::resolve(design).map_err(Box::new)?;
        let (output, turns, sections) = required::required(&composed)?;
        let left_alone = required::left_alone(&composed);
        let timing = Timing::new(output, &sections);
        let timing = match required::is_of_angle(&composed) {
            true => timing.map_err(TimingError::in_degrees)?,
            false => timing?,
        };
        let [low, high] = timing.places();
        let enough = NEAR_ENOUGH * (high - low);
        let of_steps = |steps| {
            let table = crank.table(&timing, steps);
            let (_, rolled) = PlannedPair::roll(&table_pair(table.clone(), distance))?;
            let miss = crank.miss(&timing, &rolled);
            Ok::<_, GearPairError>((steps, rolled, table, miss))
        };
        let (steps, rolled, table, miss) =
            fewest_steps(of_steps, |(.., miss)| miss.value <= enough)?;
        Ok(Self {
            design: crank.driven(&composed, &timing, table)?,
            turns,
            timing,
            steps,
            miss,
            minimum_radii: minimum_convex_radii(&rolled),
            left_alone,
        })
    }
}
