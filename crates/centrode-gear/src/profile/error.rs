use centrode_geometry::{LoopError, OpenOutline};

use crate::rolling::Member;

use super::Role;

/// Reason why a gear has no profile.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ProfileError {
    /// The pitch curve is too sharp for any tooth.
    #[error("the {} has no profile: nothing of its contour remains after its loops are cut off, because the teeth are too large for the pitch curve", .member.name())]
    Looped {
        /// Gear at fault.
        member: Member,
    },
    /// The crossings of the contour with itself cannot be determined.
    #[error("the {} has no profile: {cause}", .member.name())]
    Unresolved {
        /// Gear at fault.
        member: Member,
        /// Position and cause.
        cause: LoopError,
    },
    /// Two curves of a tooth that do not meet.
    #[error("the {} has no profile: on tooth {tooth} the ends of {} and {} are {gap:.3e} mm apart, because the teeth are too large for the pitch curve", .member.name(), .roles[0].name(), .roles[1].name())]
    Gap {
        /// Gear at fault.
        member: Member,
        /// Tooth, counted from 0.
        tooth: u32,
        /// Roles of the two curves.
        roles: [Role; 2],
        /// Distance of their ends, mm.
        gap: f64,
    },
    /// A contour that does not enclose its axis, so that no shaft can carry the gear.
    #[error("the {} has no profile: its axis is outside its contour, {away:.6} mm from it, because the teeth are too large for the pitch curve", .member.name())]
    AxisOutside {
        /// Gear at fault.
        member: Member,
        /// Distance of the axis from the contour, mm.
        away: f64,
    },
    /// The contour does not close: a coordinate is not a number.
    #[error(transparent)]
    Open(#[from] OpenOutline),
}
