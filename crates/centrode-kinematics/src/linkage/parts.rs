use centrode_geometry::Point;

/// A joint of a [`Linkage`](super::Linkage): a point of one of its links.
#[derive(Clone, Copy, Debug, Eq, Hash, Ord, PartialEq, PartialOrd)]
pub struct JointId(pub(super) usize);

/// A link of a [`Linkage`](super::Linkage): a rigid body with its own axes.
#[derive(Clone, Copy, Debug, Eq, Hash, Ord, PartialEq, PartialOrd)]
pub struct LinkId(pub(super) usize);

impl LinkId {
    /// The fixed link.
    pub const FRAME: Self = Self(0);

    /// Position among the linkage's links; the frame is 0.
    #[must_use]
    pub fn index(self) -> usize {
        self.0
    }
}

impl JointId {
    /// Position among the linkage's joints.
    #[must_use]
    pub fn index(self) -> usize {
        self.0
    }
}

/// A straight guide fixed to a link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// The link it belongs to.
    pub link: LinkId,
    /// A point it passes through, in the link's axes, mm.
    pub through: Point,
    /// Direction against the link's first axis, rad.
    pub angle: f64,
}

/// The links and the joint of two bars.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub struct TwoBars {
    /// The bar from the first outer joint, its first axis towards the common joint.
    pub first: LinkId,
    /// The bar from the second outer joint, its first axis towards the common joint.
    pub second: LinkId,
    /// The common joint.
    pub joint: JointId,
}

/// The links and the joint of a dyad with a slider.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub struct SliderDyad {
    /// The block that slides, its first axis along the guide.
    pub block: LinkId,
    /// The other link of the dyad.
    pub link: LinkId,
    /// Joint of block and link, or of block and its driver.
    pub joint: JointId,
}
