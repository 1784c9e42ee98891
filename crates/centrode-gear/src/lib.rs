//! Gears and cams: from a design to exact curves.
//!
//! At the root of the crate are pitch curves and their conjugates, tools, tooth profiles and pairs of gears. Disc cams
//! and their followers are in [`cam`].
//! The crate contains no machines of several gears, no checks and no file output.

mod base_tangent;
mod bore;
pub mod cam;
mod conjugate;
pub mod design;
mod fit;
mod fitted;
mod flank;
mod flank_count;
mod generation;
mod intermittent;
mod limits;
mod over_pins;
mod pair;
mod pattern;
pub mod pitch;
mod profile;
mod rolling;
mod space_rounding;
mod stage;
mod teeth;
mod thickness;
mod tool;
mod tooth_chords;
mod tooth_passage;

pub use base_tangent::{BaseTangent, BaseTangentFault};
pub use conjugate::ConjugateCurve;
pub use flank::Side;
pub use flank_count::FlankCount;
pub use intermittent::{
    Cam, IntermittentDrive, IntermittentError, IntermittentLaw, IntermittentPair,
    IntermittentPairError, IntermittentPairSpec, Pins,
};
pub use limits::{Limits, PitchPoint};
pub use over_pins::{OverPins, Pin, PinFault};
pub use pair::{CutPair, Gear, GearPair, GearPairError, Housing, PlannedPair};
pub use profile::{ProfileError, Role, Tooth, ToothSide};
pub use rolling::{CurvatureRange, Frame, Member, PitchContact, Rolling, RollingError};
pub use teeth::{TeethError, TeethParameters};
pub use thickness::ThicknessDeviations;
pub use tool::{Tool, ToolKind};
