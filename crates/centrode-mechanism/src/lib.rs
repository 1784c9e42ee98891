//! The design file and each family of mechanism, resolved to exact curves.

mod degrees;
mod formula;
pub mod gear;
