//! Motion as a function of one input: formulas, transmission functions, linkages, and the links and joints of a
//! machine.
//!
//! A machine is a tree of links whose joints follow transmission functions of the input. It gives poses, closures,
//! meshes and parts.
//! The crate contains no gear teeth, no cam profiles, no families of machines and no file output.

pub mod formula;
pub mod linkage;
pub mod machine;
pub mod transmission;
