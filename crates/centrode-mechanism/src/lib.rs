//! The design file and each family of mechanism, resolved to exact curves.

pub mod cam;
mod degrees;
pub mod design;
mod formula;
pub mod gear;
pub mod transmission;
