use centrode_geometry::{LoopError, OpenOutline};

use crate::gear::rolling::Member;

/// Reason why a gear has no profile.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ProfileError {
    /// The pitch curve is too sharp for any tooth.
    #[error("the {} has no profile: every part of its contour lies in a loop, so the teeth are too large for the pitch curve", .member.name())]
    Looped {
        /// Gear at fault.
        member: Member,
    },
    /// The crossings of the contour with itself cannot be determined.
    #[error("the {} has no profile: {cause}", .member.name())]
    Unresolved {
        /// Gear at fault.
        member: Member,
        /// Place and cause.
        cause: LoopError,
    },
    /// The contour does not close: a coordinate is not a number.
    #[error(transparent)]
    Open(#[from] OpenOutline),
}
