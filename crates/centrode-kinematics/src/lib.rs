//! Motion of one input: formulas, transmission functions, linkages, and the links and joints of a machine.
//!
//! A machine is a tree of links whose joints follow transmission functions of the input; poses, closures, meshes and parts
//! are read from it. It knows no gear tooth, no cam profile and no family of machine, and writes no file.

pub mod formula;
pub mod linkage;
pub mod machine;
pub mod transmission;
