//! The design file and each family of mechanism, resolved to exact curves.

pub mod arm;
mod bore;
pub mod cam;
pub mod composed;
mod degrees;
pub mod design;
mod digits;
pub mod feeder;
mod formula;
pub mod gear;
pub mod linkage;
pub mod machine;
pub mod reverse;
pub mod shaft;
pub mod three_arm;
pub mod transmission;
