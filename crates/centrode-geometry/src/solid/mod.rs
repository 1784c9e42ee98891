//! Bodies: extrusions and turned parts, their meshes, exact shells and masses.
//!
//! Reading order: [`mesh`], [`triangulation`], [`extrusion`] with its [`opening`], [`mass`]; [`shell`] and [`shell_builder`]
//! (exact boundaries for CAD), [`turned`] (bodies turned about an axis). Uses every other module.

mod error;
mod extrusion;
mod mass;
mod mesh;
mod opening;
mod shell;
mod shell_builder;
mod triangulation;
mod turned;

pub use error::SolidError;
pub use extrusion::Solid;
pub use mass::{MassProperties, VolumeMoments};
pub use mesh::Mesh;
pub use opening::Opening;
pub use shell::{Shell, ShellCurve, ShellEdge, ShellFace, ShellSide, ShellSurface};
pub use shell_builder::ShellBuilder;
pub use turned::{Turned, TurnedEnd, TurnedSection, TurnedSlot};
