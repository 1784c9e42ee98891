use thiserror::Error;

use super::MachineLawError;
use centrode_gear::GearPairError;
use centrode_gear::cam::CamError;
use centrode_kinematics::linkage::{LinkageError, NotClosing};
use centrode_spec::digits::{digits, rounded};
use centrode_spec::{MechanismError, SpecError};

/// Error of a composed machine that cannot be built.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum MachineError {
    /// A value breaks a rule of its own.
    #[error(transparent)]
    Spec(#[from] SpecError),
    /// A word that does not name a point of a body.
    #[error("{word:?} names no point of a body: write body.point, as in frame.O")]
    NoReference {
        /// Key that names it.
        key: String,
        /// The word.
        word: String,
    },
    /// A body, dyad, gear, pair or cam that does not exist.
    #[error("there is no {what} {name:?}; there are {}", if known.is_empty() { "none".to_owned() } else { known.join(", ") })]
    Unknown {
        /// Key that names it.
        key: String,
        /// Kind: `body`, `dyad`, `gear`, `pair` or `cam`.
        what: &'static str,
        /// Its name.
        name: String,
        /// Names of this kind that exist.
        known: Vec<String>,
    },
    /// A point that does not exist.
    #[error("body {body:?} has no point {point:?}; it has {}", if known.is_empty() { "none".to_owned() } else { known.join(", ") })]
    NoPoint {
        /// Key that names it.
        key: String,
        /// The body.
        body: String,
        /// Name of the point.
        point: String,
        /// Points that the body has.
        known: Vec<String>,
    },
    /// Two points of a body have the same name.
    #[error("body {body:?} would have two points {point:?}: give one of them another name")]
    PointTwice {
        /// Key that gives the second one.
        key: String,
        /// The body.
        body: String,
        /// Name of the points.
        point: String,
    },
    /// A body that cannot drive another by its turn.
    #[error("body {body:?} does not turn on a pin: only a body on a pin can replace the input")]
    NoTurn {
        /// Key that names it.
        key: String,
        /// The body.
        body: String,
    },
    /// A body that is driven or tied twice.
    #[error("body {body:?} is already held by {by}: only one of the two can hold it")]
    HeldTwice {
        /// Key that holds it the second time.
        key: String,
        /// The body.
        body: String,
        /// Key that holds it already.
        by: String,
    },
    /// A body that nothing holds.
    #[error("nothing holds body {body:?}: give it on and law, or fixed_to, or name it in a dyad")]
    Loose {
        /// The body.
        body: String,
    },
    /// A body whose position depends on itself.
    #[error("{}", ring(.names))]
    Ring {
        /// Key at which the ring is entered.
        key: String,
        /// Names along the ring.
        names: Vec<String>,
    },
    /// A triangle whose sides do not meet.
    #[error(
        "sides of {} and {} mm cannot meet over points {apart:.6} mm apart: {missing:.6} mm are missing", lengths[0], lengths[1]
    )]
    NoTriangle {
        /// Key of the corner.
        key: String,
        /// Lengths of the sides, mm.
        lengths: [f64; 2],
        /// Distance between the two given points, mm.
        apart: f64,
        /// Length by which the sides fail to meet, mm.
        missing: f64,
    },
    /// A law that is not possible.
    #[error("{error}")]
    Law {
        /// Name of the body.
        body: String,
        /// Reason.
        error: MachineLawError,
    },
    /// Dyads that do not close over the whole cycle, or that have change points.
    #[error("{}", dyads.iter().map(not_closing).collect::<Vec<_>>().join("; "))]
    DoesNotClose {
        /// Names of the dyads, in the order of building, and the inputs at which each does not close.
        dyads: Vec<(String, NotClosing)>,
    },
    /// A joint whose motion has a pole.
    #[error("the direction of body {body:?} is not defined near an input of {:.4} deg", input.to_degrees())]
    NoDirection {
        /// Key that holds it.
        key: String,
        /// The body.
        body: String,
        /// Input, rad.
        input: f64,
    },
    /// A pair that cannot be cut.
    #[error("{error}")]
    Pair {
        /// Key at fault.
        key: String,
        /// Reason.
        error: Box<GearPairError>,
    },
    /// A cam that cannot be cut.
    #[error("{error}")]
    Cam {
        /// Name of the cam.
        cam: String,
        /// Reason.
        error: CamError,
    },
    /// An error of a copy that the original does not have.
    #[error("in a copy: {error}")]
    Copy {
        /// Key of the original.
        key: String,
        /// The error of the copy.
        error: Box<MachineError>,
    },
    /// A given contour, load, mesh, follower, copy or figure that is not possible.
    #[error("{why}")]
    Refused {
        /// Key at fault.
        key: String,
        /// Reason.
        why: String,
    },
    /// Any other error of the linkage.
    #[error("{error}")]
    Linkage {
        /// Key that adds it.
        key: String,
        /// Reason.
        error: LinkageError,
    },
}

/// An input, rad, in degrees to four decimals.
fn degrees(input: f64) -> String {
    rounded(input.to_degrees(), 4)
}

/// Words joined as a list.
fn listed(words: &[String]) -> String {
    match words {
        [first @ .., last] if !first.is_empty() => format!("{} and {last}", first.join(", ")),
        _ => words.concat(),
    }
}

/// Message about the inputs at which a dyad does not close or changes its branch.
fn not_closing((name, found): &(String, NotClosing)) -> String {
    let ranges = found.open.iter();
    let ranges = ranges.map(|&(low, high)| format!("{} to {}", degrees(low), degrees(high)));
    let ranges = listed(&ranges.collect::<Vec<_>>());
    let is_of_guides = found.missing.is_infinite();
    let mut points = found.change_points.clone();
    if is_of_guides {
        // Guides that become parallel change their branch at the ends of the ranges; ends of the cycle do not count.
        let mut ends: Vec<f64> = found
            .open
            .iter()
            .flat_map(|&(low, high)| [low, high])
            .collect();
        if ends.first() == Some(&0.0) {
            ends.remove(0);
            ends.pop();
        }
        points.extend(ends);
        points.sort_by(f64::total_cmp);
    }
    let points = points.into_iter().map(degrees);
    let points = listed(&points.collect::<Vec<_>>());
    let flat = "its links lie in one line and both its branches meet: change a length or a pin";
    let at = degrees(found.input);
    let missing = match found.missing {
        m if m.is_infinite() => format!("at {at} deg its guides are parallel"),
        0.0 => format!("at {at} deg its links lie in one line"),
        m => format!("at {at} deg {} mm are missing", digits(m, 6)),
    };
    let change = match found.change_points.len() {
        0 => String::new(),
        1 => format!("a change point at {points} deg, where {flat}"),
        _ => format!("change points at {points} deg, where {flat}"),
    };
    if is_of_guides && !points.is_empty() {
        return format!("the guides of dyad {name:?} are parallel at {points} deg");
    }
    match (
        found.missing == 0.0 && !change.is_empty(),
        found.open.is_empty(),
    ) {
        (true, _) => format!("dyad {name:?} has {change}"),
        (_, true) => format!("dyad {name:?} closes at no input: {missing}"),
        _ if change.is_empty() => {
            format!("dyad {name:?} closes only for inputs of {ranges} deg: {missing}")
        }
        _ => format!(
            "dyad {name:?} closes only for inputs of {ranges} deg: {missing}; it has {change}"
        ),
    }
}

/// Message about names that depend on each other.
fn ring(names: &[String]) -> String {
    match names {
        [one] => format!("the position of {one} depends on itself"),
        _ => format!("the positions of {} depend on each other", names.join(", ")),
    }
}

impl MachineError {
    /// A given value at a key that is not possible, with the reason.
    pub(crate) fn refused(key: impl Into<String>, why: impl Into<String>) -> Self {
        let (key, why) = (key.into(), why.into());
        Self::Refused { key, why }
    }

    /// A name at a key that is not among the known names of its kind.
    pub(crate) fn unknown(
        key: impl Into<String>,
        what: &'static str,
        name: impl Into<String>,
        known: impl IntoIterator<Item = String>,
    ) -> Self {
        Self::Unknown {
            key: key.into(),
            what,
            name: name.into(),
            known: known.into_iter().collect(),
        }
    }

    /// Key of the design at fault.
    #[must_use]
    pub fn key(&self) -> String {
        match self {
            Self::Spec(error) => error.key.clone(),
            Self::NoReference { key, .. }
            | Self::Unknown { key, .. }
            | Self::NoPoint { key, .. }
            | Self::PointTwice { key, .. }
            | Self::HeldTwice { key, .. }
            | Self::Ring { key, .. }
            | Self::NoTriangle { key, .. }
            | Self::NoDirection { key, .. }
            | Self::NoTurn { key, .. }
            | Self::Refused { key, .. }
            | Self::Copy { key, .. }
            | Self::Pair { key, .. }
            | Self::Linkage { key, .. } => key.clone(),
            Self::Cam { cam, error } => format!("cams.{cam}.{}", error.key()),
            Self::Loose { body } => format!("bodies.{body}"),
            Self::Law { body, error } => format!("bodies.{body}.law.{}", error.key()),
            Self::DoesNotClose { dyads } => {
                let first = dyads.first().map_or("", |(name, _)| name);
                format!("dyads.{first}")
            }
        }
    }
}

impl From<MachineError> for MechanismError {
    fn from(error: MachineError) -> Self {
        match error {
            MachineError::Spec(error) => error.into(),
            other => Self::new(other.key(), other),
        }
    }
}
