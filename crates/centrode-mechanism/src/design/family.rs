use serde::de::DeserializeOwned;
use toml::de::{Error, ValueDeserializer};

use super::Design;
use crate::feeder::FeederDesign;
use crate::gear::design::{GearPairDesign, SpecError, ToolSpec};
use crate::gear::pitch::PitchSpec;
use crate::shaft::{MovingBoxDesign, SpeedLaw, SpiralShaftDesign};
use crate::three_arm::design::ThreeArmDesign;

/// What a reader must know of a family of mechanism: all there is to say, in one place a family.
pub(crate) trait Family: DeserializeOwned + Into<Design> {
    /// Keys at the root that hold a table.
    const TABLES: &'static [&'static str];
    /// Those of them whose key `kind` says what else is in them.
    const TAGGED: &'static [Tagged];

    /// The rules that need no geometry.
    fn validate(&self) -> Result<(), SpecError>;
}

/// A table whose key `kind` says what else is in it.
pub(crate) struct Tagged {
    pub(crate) key: &'static str,
    pub(crate) kinds: &'static [&'static str],
    /// Reads what stands beside `kind`, for the places of its errors.
    pub(crate) read: fn(&str, ValueDeserializer<'_>) -> Result<(), Error>,
}

const PITCH: Tagged = Tagged {
    key: "pitch",
    kinds: PitchSpec::KINDS,
    read: |kind, table| PitchSpec::of_kind(kind, table).map(drop),
};

const TOOL: Tagged = Tagged {
    key: "tool",
    kinds: ToolSpec::KINDS,
    read: |kind, table| ToolSpec::of_kind(kind, table).map(drop),
};

impl Family for GearPairDesign {
    const TABLES: &'static [&'static str] =
        &["pitch", "tool", "teeth", "driver", "driven", "drawing"];
    const TAGGED: &'static [Tagged] = &[PITCH, TOOL];

    fn validate(&self) -> Result<(), SpecError> {
        self.validate()
    }
}

impl From<GearPairDesign> for Design {
    fn from(design: GearPairDesign) -> Self {
        Self::GearPair(Box::new(design))
    }
}

impl Family for ThreeArmDesign {
    const TABLES: &'static [&'static str] = &[
        "pitch",
        "tool",
        "teeth",
        "arm",
        "cam",
        "fork",
        "gearbox",
        "work",
        "tray",
        "seedling",
        "goals",
        "optimise",
        "sun",
        "intermediate",
        "planet",
        "drawing",
    ];
    const TAGGED: &'static [Tagged] = &[PITCH, TOOL];

    fn validate(&self) -> Result<(), SpecError> {
        self.validate()
    }
}

impl From<ThreeArmDesign> for Design {
    fn from(design: ThreeArmDesign) -> Self {
        Self::ThreeArm(Box::new(design))
    }
}

const LAW: Tagged = Tagged {
    key: "law",
    kinds: SpeedLaw::KINDS,
    read: |kind, table| SpeedLaw::of_kind(kind, table).map(drop),
};

impl Family for SpiralShaftDesign {
    const TABLES: &'static [&'static str] = &[
        "law", "reversal", "groove", "slider", "body", "mill", "load",
    ];
    const TAGGED: &'static [Tagged] = &[LAW];

    fn validate(&self) -> Result<(), SpecError> {
        self.validate()
    }
}

impl From<SpiralShaftDesign> for Design {
    fn from(design: SpiralShaftDesign) -> Self {
        Self::SpiralShaft(Box::new(design))
    }
}

impl Family for MovingBoxDesign {
    const TABLES: &'static [&'static str] = &["gears", "shaft"];
    const TAGGED: &'static [Tagged] = &[];

    fn validate(&self) -> Result<(), SpecError> {
        self.validate()
    }
}

impl From<MovingBoxDesign> for Design {
    fn from(design: MovingBoxDesign) -> Self {
        Self::MovingBox(Box::new(design))
    }
}

impl Family for FeederDesign {
    const TABLES: &'static [&'static str] = &[
        "linkage", "bounds", "goals", "drive", "gears", "plates", "making", "optimise", "drawing",
    ];
    const TAGGED: &'static [Tagged] = &[];

    fn validate(&self) -> Result<(), SpecError> {
        self.validate()
    }
}

impl From<FeederDesign> for Design {
    fn from(design: FeederDesign) -> Self {
        Self::Feeder(Box::new(design))
    }
}
