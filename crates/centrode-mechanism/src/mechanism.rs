//! What a design becomes: one resolved mechanism of one of the families.

use crate::design::Design;
use crate::feeder::{Feeder, FeederError};
use crate::gear::{GearPair, GearPairError};
use crate::shaft::{MovingBox, ShaftError, SpiralShaft};
use crate::three_arm::{ThreeArm, ThreeArmError};

/// A resolved mechanism of one of the families.
///
/// Exhaustive on purpose: whoever checks or writes mechanisms must say what to do with a new family.
#[derive(Clone, Debug)]
pub enum Mechanism {
    /// A non-circular gear pair.
    GearPair(Box<GearPair>),
    /// A three-arm transplanting mechanism.
    ThreeArm(Box<ThreeArm>),
    /// A variable-speed spiral shaft.
    SpiralShaft(Box<SpiralShaft>),
    /// A seedling box moved at a variable speed.
    MovingBox(Box<MovingBox>),
    /// A willow-cutting feeder.
    Feeder(Box<Feeder>),
}

/// Why a design gives no mechanism.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MechanismError {
    /// A gear pair.
    #[error(transparent)]
    GearPair(#[from] GearPairError),
    /// A three-arm mechanism.
    #[error(transparent)]
    ThreeArm(#[from] ThreeArmError),
    /// A spiral shaft, also that of a moving box.
    #[error(transparent)]
    Shaft(#[from] ShaftError),
    /// A feeder.
    #[error(transparent)]
    Feeder(#[from] FeederError),
}

impl Mechanism {
    /// Resolves a design.
    ///
    /// # Errors
    /// [`MechanismError`] naming the rule broken and its numbers.
    pub fn resolve(design: &Design) -> Result<Self, MechanismError> {
        Ok(match design {
            Design::GearPair(design) => Self::GearPair(Box::new(GearPair::resolve(design)?)),
            Design::ThreeArm(design) => Self::ThreeArm(Box::new(ThreeArm::resolve(design)?)),
            Design::SpiralShaft(design) => {
                Self::SpiralShaft(Box::new(SpiralShaft::resolve(design)?))
            }
            Design::MovingBox(design) => Self::MovingBox(Box::new(MovingBox::resolve(design)?)),
            Design::Feeder(design) => Self::Feeder(Box::new(Feeder::resolve(design)?)),
        })
    }

    /// The family, as written in a design's `family`.
    #[must_use]
    pub fn family(&self) -> &'static str {
        match self {
            Self::GearPair(_) => "gear-pair",
            Self::ThreeArm(_) => "three-arm",
            Self::SpiralShaft(_) => "spiral-shaft",
            Self::MovingBox(_) => "moving-box",
            Self::Feeder(_) => "feeder",
        }
    }

    /// Name, as written in the design.
    #[must_use]
    pub fn name(&self) -> &str {
        match self {
            Self::GearPair(pair) => pair.name(),
            Self::ThreeArm(mechanism) => &mechanism.design().name,
            Self::SpiralShaft(shaft) => shaft.name(),
            Self::MovingBox(machine) => &machine.design().name,
            Self::Feeder(machine) => &machine.design().name,
        }
    }

    /// Title, as written in the design.
    #[must_use]
    pub fn title(&self) -> &str {
        match self {
            Self::GearPair(pair) => pair.title(),
            Self::ThreeArm(mechanism) => &mechanism.design().title,
            Self::SpiralShaft(shaft) => shaft.title(),
            Self::MovingBox(machine) => &machine.design().title,
            Self::Feeder(machine) => &machine.design().title,
        }
    }
}

impl MechanismError {
    /// Key of the design file at fault.
    #[must_use]
    pub fn key(&self) -> String {
        match self {
            Self::GearPair(error) => error.key(),
            Self::ThreeArm(error) => error.key(),
            Self::Shaft(error) => error.key(),
            Self::Feeder(error) => error.key(),
        }
    }
}
