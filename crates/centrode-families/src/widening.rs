use std::error::Error;

use serde_json::Value;

/// Reason why there is no widening, in a sentence.
pub type WideningError = Box<dyn Error + Send + Sync>;

/// A design whose bounds have been widened by the smallest share with which all its goals can be reached.
#[derive(Clone, Debug)]
pub struct Widening {
    /// Share by which the bounds were widened.
    pub share: f64,
    /// New content of whole tables of the design, for programs.
    pub tables: Vec<(&'static str, Value)>,
    /// New numbers, each with its key in the file.
    pub numbers: Vec<(String, f64)>,
    /// New lists, each with its key; a file may omit these lists.
    pub lists: Vec<(String, Vec<f64>)>,
    /// Text of the new dimensions, one line per dimension.
    pub lines: Vec<String>,
}
