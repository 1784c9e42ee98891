use std::error::Error;
use std::sync::Arc;

use centrode_mechanism::design::Design;

/// Why there is no widening, in a sentence.
pub type WideningError = Box<dyn Error + Send + Sync>;

/// A design whose bounds have been widened by as little as lets all its goals be reached.
#[derive(Clone, Debug)]
pub struct Widening {
    /// Share by which the bounds were widened.
    pub share: f64,
    /// The design there.
    pub design: Arc<dyn Design>,
    /// Tables of the design that hold something new.
    pub tables: &'static [&'static str],
    /// New numbers, each by its key in the file.
    pub numbers: Vec<(String, f64)>,
    /// New lists, each whole by its key: a file may leave them out.
    pub lists: Vec<(String, Vec<f64>)>,
    /// The new dimensions in words, a line each.
    pub lines: Vec<String>,
}
