//! Motion of one input: formulas, transmission functions, linkages, and the links and joints of a machine.
//!
//! A machine is a tree of links whose joints follow transmission functions of the input; poses, closures, meshes and parts
//! are read from it. The crate contains no gear teeth, no cam profiles and no families of machines, and writes no files.

pub mod formula;
pub mod linkage;
pub mod machine;
pub mod transmission;
