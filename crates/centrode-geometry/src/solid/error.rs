use thiserror::Error;

/// Error of contours that do not bound a solid.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum SolidError {
    /// The top is not above the bottom.
    #[error("the top of a solid must be above its bottom: bottom {bottom} mm, top {top} mm")]
    NoHeight {
        /// Lower face, mm.
        bottom: f64,
        /// Upper face, mm.
        top: f64,
    },
    /// A point of a contour is not a finite number.
    #[error("contour {contour} (0 is the outer one) has a point that is not finite")]
    NotFinite {
        /// Index of the contour, the outer one first.
        contour: usize,
    },
    /// Contours flattened at the tolerance meet or cross themselves or one another.
    #[error("contours cross or touch near ({x}, {y}) mm at a tolerance of {tolerance} mm")]
    Crossing {
        /// X coordinate, mm.
        x: f64,
        /// Y coordinate, mm.
        y: f64,
        /// The flattening tolerance, mm.
        tolerance: f64,
    },
    /// A hole is not inside the outer contour, or lies in another hole.
    #[error("hole {hole} is outside the outer contour or inside another hole")]
    HoleOutside {
        /// Index of the hole.
        hole: usize,
    },
    /// A section of a turned body is neither a cylinder nor a cone of 45°, or does not contain the slot.
    #[error(
        "section {section} of a turned body is neither a cylinder nor a cone of 45°, or does not contain its slot"
    )]
    Turned {
        /// Index of the section.
        section: usize,
    },
    /// An opening does not lie in a wall of the solid.
    #[error(
        "an opening at heights {from} to {to} mm must go through a wall between the outline and a hole; the solid is at heights {bottom} to {top} mm"
    )]
    Opening {
        /// Its lower end, mm.
        from: f64,
        /// Its upper end, mm.
        to: f64,
        /// Lower face of the solid, mm.
        bottom: f64,
        /// Upper face, mm.
        top: f64,
    },
}
