use thiserror::Error;

use crate::gear::IncompleteError;
use crate::gear::design::SpecError;
use crate::linkage::{FourBarError, SixBarError};

/// Why a feeder does not exist.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum FeederError {
    /// A value breaks a rule of its own.
    #[error(transparent)]
    Spec(#[from] SpecError),
    /// There is no such four-bar.
    #[error(transparent)]
    FourBar(#[from] FourBarError),
    /// There is no such six-bar.
    #[error(transparent)]
    SixBar(#[from] SixBarError),
    /// There is no such intermittent drive.
    #[error(transparent)]
    Drive(#[from] IncompleteError),
    /// A cycle that does not bring the crank back to where it rested.
    #[error(
        "{teeth} teeth turn the crank by {teeth}/{driven} of a turn each cycle: a feeder needs one whole turn, so teeth must be {driven}"
    )]
    NotOneTurn {
        /// Pitches driven in one cycle.
        teeth: u32,
        /// Pitches round the driven gear.
        driven: u32,
    },
}

impl FeederError {
    /// The key of the design to blame.
    #[must_use]
    pub fn key(&self) -> String {
        match self {
            Self::Spec(error) => error.key.clone(),
            Self::SixBar(SixBarError::PivotOnPath { .. }) => "linkage.pivot".into(),
            Self::FourBar(_) | Self::SixBar(_) => "linkage.crank".into(),
            Self::Drive(IncompleteError::Entry { .. }) => "gears.entry_deg".into(),
            Self::Drive(_) | Self::NotOneTurn { .. } => "gears.teeth".into(),
        }
    }
}
