use std::error::Error;

use serde_json::Value;

/// Reason why there is no widening, in a sentence.
pub type WideningError = Box<dyn Error + Send + Sync>;

/// A design whose bounds have been widened by as little as lets all its goals be reached.
#[derive(Clone, Debug)]
pub struct Widening {
    /// Share by which the bounds were widened.
    pub share: f64,
    /// Tables of the design with new content, whole, as programs read them.
    pub tables: Vec<(&'static str, Value)>,
    /// New numbers, each by its key in the file.
    pub numbers: Vec<(String, f64)>,
    /// New lists, each whole by its key: a file may leave them out.
    pub lists: Vec<(String, Vec<f64>)>,
    /// The new dimensions in words, a line each.
    pub lines: Vec<String>,
}
