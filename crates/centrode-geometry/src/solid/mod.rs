//! Bodies: extrusions and turned parts, with their meshes, exact shells and masses.
//!
//! Reading order:
//!
//! 1. [`mesh`] and [`triangulation`].
//! 2. [`extrusion`] with its [`opening`].
//! 3. [`mass`].
//! 4. [`shell`] and [`shell_builder`]: exact boundaries for CAD.
//! 5. [`turned`]: bodies turned about an axis.
//!
//! Uses every other module.

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
