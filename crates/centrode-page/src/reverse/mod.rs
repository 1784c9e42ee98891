//! Text about a machine made from a path or from key poses, for the page and the command.

mod found;
mod made;
pub mod words;

use centrode_synthesis::reverse::{DrawnPath, PathError};

pub use found::{Found, NotFound};
pub use made::{Toothed, rolled};

/// Default of the maximum distance between a path and its drawing, mm.
pub const WITHIN: f64 = 0.01;

/// Points along the path of an SVG file; `None` if the file is not one.
///
/// # Errors
/// [`PathError`] if the drawing has no single path.
pub fn drawn(bytes: &[u8], within: f64) -> Result<Option<DrawnPath>, PathError> {
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let is_drawing = text.trim_ascii_start().starts_with(b"<");
    is_drawing
        .then(|| DrawnPath::from_svg(bytes, within))
        .transpose()
}
