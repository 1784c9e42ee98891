use crate::tool::Corner;

/// Role of a part of a gear's profile.
#[derive(Clone, Copy, Debug, Eq, Hash, PartialEq)]
pub enum Role {
    /// Top of a tooth.
    Tip,
    /// Side of a tooth, which transmits the motion.
    Flank,
    /// Curve from a flank to the root, cut by the tool's rounded corner.
    Fillet,
    /// Bottom of a space.
    Root,
}

impl Role {
    /// Name used in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Tip => "tip",
            Self::Flank => "flank",
            Self::Fillet => "fillet",
            Self::Root => "root",
        }
    }
}

/// Upper limit of a flank, and its end below.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FlankPlan {
    /// Arc length where the flank crosses the pitch curve.
    pub(crate) crossing: f64,
    pub(crate) top: Top,
    pub(crate) corner: Corner,
    /// Active depth: arc length of roll below the crossing down to which the mate needs the flank.
    pub(crate) active_depth: f64,
}

/// End of a flank at the tip.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Top {
    /// At a normal distance from the pitch curve.
    Height(f64),
    /// At the point generated this far, in arc length, from its crossing.
    Reach(f64),
}

/// Plan of the two flanks of a tooth.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ToothPlan {
    pub(crate) leading: FlankPlan,
    pub(crate) trailing: FlankPlan,
}

/// One side of a finished tooth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToothSide {
    /// Arc length where the flank crosses the pitch curve, mm.
    pub crossing: f64,
    /// Height of the tip corner above the pitch curve, mm.
    pub tip_height: f64,
    /// Tip shortening, mm: by how much the tip corner is lower than required, because the pitch curve or the tool allows no more
    /// flank.
    pub tip_shortening: f64,
    /// Form depth: depth below the pitch curve, at the tool's pose, that the tool's straight flank reaches, mm.
    pub form_depth: f64,
    /// Active depth: arc length of roll below the crossing down to which the flank is needed, mm: as far as the tool reaches, or,
    /// with fitted addenda, as far as the mate reaches.
    pub active_depth: f64,
    /// Length of active flank lost to undercut, in arc length of roll, mm; zero for a tooth without undercut.
    pub undercut: f64,
    /// Arc lengths of roll between which flank remains; `None` if no flank remains.
    pub active: Option<(f64, f64)>,
    /// Minimum radius of curvature of the fillet, mm.
    pub fillet_radius: f64,
}

/// A finished tooth, numbered in the order the teeth mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tooth {
    /// Flank reached first.
    pub leading: ToothSide,
    /// Flank reached last.
    pub trailing: ToothSide,
    /// Width of the top land, mm; zero for a pointed or missing tooth.
    pub tip_width: f64,
    /// Whether undercut from both sides has cut the tooth off.
    pub cut_through: bool,
}
