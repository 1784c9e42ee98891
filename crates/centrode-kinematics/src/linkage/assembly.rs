use std::f64::consts::TAU;
use std::sync::Arc;

use centrode_geometry::{Point, Vector};

use super::dyad::Branch;
use super::error::LinkageError;
use super::parts::{JointId, Line, LinkId, SliderDyad, TwoBars};
use crate::transmission::Transmission;

#[derive(Clone, Debug)]
pub(super) enum Step {
    /// A point of a link.
    Point {
        link: usize,
        local: Vector,
    },
    /// The driven link.
    Crank {
        pivot: usize,
        phase: f64,
    },
    /// A link that turns about a joint, relative to the joint's link, by a law.
    Turning {
        pivot: usize,
        law: Arc<dyn Transmission>,
    },
    /// A link that slides along a line by a law.
    Sliding {
        line: Line,
        law: Arc<dyn Transmission>,
    },
    /// A link fixed to another one.
    Fixed {
        line: Line,
    },
    Rrr {
        p: usize,
        q: usize,
        lengths: (f64, f64),
        branch: Branch,
        joint: usize,
    },
    Rrp {
        p: usize,
        length: f64,
        line: Line,
        branch: Branch,
        joint: usize,
    },
    Rpr {
        p: usize,
        q: usize,
        offset: f64,
        branch: Branch,
        link: usize,
    },
    Prp {
        lines: (Line, Line),
    },
    Rpp {
        p: usize,
        line: Line,
        slot: f64,
    },
}

/// A planar linkage of one input: a frame, a crank, links driven by laws and dyads in the order they close.
///
/// ```
/// use centrode_geometry::Point;
/// use centrode_kinematics::linkage::{Branch, LinkId, Linkage};
///
/// let mut linkage = Linkage::new();
/// let a = linkage.point(LinkId::FRAME, Point::new(0.0, 0.0))?;
/// let d = linkage.point(LinkId::FRAME, Point::new(105.0, 0.0))?;
/// let (_, b) = linkage.crank(a, 77.0, 0.0)?;
/// let bars = linkage.rrr(b, d, (147.0, 127.0), Branch::Upper)?;
/// let pose = linkage.at(1.0)?;
/// assert!(pose.joint(bars.joint).point.y > 0.0);
/// # Ok::<(), centrode_kinematics::linkage::LinkageError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Linkage {
    pub(super) steps: Vec<Step>,
    /// Link of each joint.
    pub(super) owners: Vec<usize>,
    pub(super) links: usize,
    crank: Option<LinkId>,
    /// Input after which the linkage repeats, rad.
    pub(super) period: f64,
    /// Inputs in `[0, period)` where a derivative of a law may jump, ascending.
    pub(super) breaks: Vec<f64>,
}

impl Default for Linkage {
    fn default() -> Self {
        Self::new()
    }
}

fn finite(name: &'static str, value: f64) -> Result<(), LinkageError> {
    if value.is_finite() {
        Ok(())
    } else {
        Err(LinkageError::NotFinite { name, value })
    }
}

fn length(name: &'static str, value: f64) -> Result<(), LinkageError> {
    if value.is_finite() && value > 0.0 {
        Ok(())
    } else {
        Err(LinkageError::Length { name, value })
    }
}

impl Linkage {
    /// Makes a linkage that is only a frame.
    #[must_use]
    pub fn new() -> Self {
        Self::with_turns(1)
    }

    /// Makes a linkage that is only a frame and repeats after `turns` turns of the input.
    #[must_use]
    pub fn with_turns(turns: u32) -> Self {
        Self {
            steps: Vec::new(),
            owners: Vec::new(),
            links: 1,
            crank: None,
            period: TAU * f64::from(turns.max(1)),
            breaks: Vec::new(),
        }
    }

    pub(super) fn know_joint(&self, joint: JointId) -> Result<usize, LinkageError> {
        let count = self.owners.len();
        if joint.0 < count {
            return Ok(joint.0);
        }
        Err(LinkageError::Unknown {
            what: "joint",
            index: joint.0,
            count,
        })
    }

    pub(super) fn know_line(&self, line: &Line) -> Result<(), LinkageError> {
        finite("a line's angle", line.angle)?;
        finite("a line's point", line.through.x + line.through.y)?;
        self.know_link(line.link)
    }

    pub(super) fn know_link(&self, link: LinkId) -> Result<(), LinkageError> {
        if link.0 < self.links {
            return Ok(());
        }
        Err(LinkageError::Unknown {
            what: "link",
            index: link.0,
            count: self.links,
        })
    }

    pub(super) fn new_link(&mut self) -> LinkId {
        self.links += 1;
        LinkId(self.links - 1)
    }

    pub(super) fn new_joint(&mut self, owner: LinkId) -> JointId {
        self.owners.push(owner.0);
        JointId(self.owners.len() - 1)
    }

    /// Adds a point of a link, given in the link's axes, mm: a fixed pivot on the frame, a coupler
    /// point, the third joint of a ternary link.
    ///
    /// # Errors
    /// [`LinkageError::Unknown`], [`LinkageError::NotFinite`].
    pub fn point(&mut self, link: LinkId, local: Point) -> Result<JointId, LinkageError> {
        self.know_link(link)?;
        finite("a point", local.x + local.y)?;
        self.steps.push(Step::Point {
            link: link.0,
            local: local.coords,
        });
        Ok(self.new_joint(link))
    }

    /// Adds the crank: a link that turns about `pivot` with the input, its first axis at the angle
    /// input + `phase`, with a joint `length` mm along it.
    ///
    /// # Errors
    /// [`LinkageError::SecondCrank`], [`LinkageError::Length`], [`LinkageError::Unknown`].
    pub fn crank(
        &mut self,
        pivot: JointId,
        length: f64,
        phase: f64,
    ) -> Result<(LinkId, JointId), LinkageError> {
        let at = self.know_joint(pivot)?;
        self::length("the crank", length)?;
        finite("the crank's phase", phase)?;
        if self.crank.is_some() {
            return Err(LinkageError::SecondCrank);
        }
        let link = self.new_link();
        self.crank = Some(link);
        self.steps.push(Step::Crank { pivot: at, phase });
        let tip = self.point(link, Point::new(length, 0.0))?;
        Ok((link, tip))
    }

    /// Adds two bars from the joints `p` and `q` to a common joint (dyad RRR).
    ///
    /// # Errors
    /// [`LinkageError::Length`], [`LinkageError::Unknown`].
    pub fn rrr(
        &mut self,
        p: JointId,
        q: JointId,
        lengths: (f64, f64),
        branch: Branch,
    ) -> Result<TwoBars, LinkageError> {
        let (at_p, at_q) = (self.know_joint(p)?, self.know_joint(q)?);
        length("the first bar", lengths.0)?;
        length("the second bar", lengths.1)?;
        let (first, second) = (self.new_link(), self.new_link());
        let joint = self.new_joint(first);
        self.steps.push(Step::Rrr {
            p: at_p,
            q: at_q,
            lengths,
            branch,
            joint: joint.0,
        });
        Ok(TwoBars {
            first,
            second,
            joint,
        })
    }

    /// Adds a bar from the joint `p` to a block that slides on a line (dyad RRP).
    ///
    /// # Errors
    /// [`LinkageError::Length`], [`LinkageError::Unknown`].
    pub fn rrp(
        &mut self,
        p: JointId,
        length: f64,
        line: Line,
        branch: Branch,
    ) -> Result<SliderDyad, LinkageError> {
        let at = self.know_joint(p)?;
        self.know_line(&line)?;
        self::length("the bar", length)?;
        let (link, block) = (self.new_link(), self.new_link());
        let joint = self.new_joint(link);
        self.steps.push(Step::Rrp {
            p: at,
            length,
            line,
            branch,
            joint: joint.0,
        });
        Ok(SliderDyad { block, link, joint })
    }

    /// Adds a block pinned at the joint `p` and a link that turns about the joint `q` and slides
    /// through the block (dyad RPR); its line passes `q` at the distance `offset` to the left.
    ///
    /// The upper branch points from the pivot towards the block.
    ///
    /// # Errors
    /// [`LinkageError::NotFinite`], [`LinkageError::Unknown`].
    pub fn rpr(
        &mut self,
        p: JointId,
        q: JointId,
        offset: f64,
        branch: Branch,
    ) -> Result<SliderDyad, LinkageError> {
        let (at_p, at_q) = (self.know_joint(p)?, self.know_joint(q)?);
        finite("the offset", offset)?;
        let (block, link) = (self.new_link(), self.new_link());
        self.steps.push(Step::Rpr {
            p: at_p,
            q: at_q,
            offset,
            branch,
            link: link.0,
        });
        Ok(SliderDyad {
            block,
            link,
            joint: p,
        })
    }

    /// Adds two blocks pinned to each other, each on a line of its own (dyad PRP). It has one assembly only.
    ///
    /// # Errors
    /// [`LinkageError::Unknown`], [`LinkageError::NotFinite`].
    pub fn prp(&mut self, first: Line, second: Line) -> Result<SliderDyad, LinkageError> {
        self.know_line(&first)?;
        self.know_line(&second)?;
        let (block, link) = (self.new_link(), self.new_link());
        let joint = self.new_joint(block);
        self.steps.push(Step::Prp {
            lines: (first, second),
        });
        Ok(SliderDyad { block, link, joint })
    }

    /// Adds a yoke that slides on a line, with a slot at the angle `slot` to it in which a block
    /// pinned at the joint `p` slides (dyad RPP): the Scotch yoke.
    ///
    /// # Errors
    /// [`LinkageError::Unknown`], [`LinkageError::NotFinite`].
    pub fn rpp(&mut self, p: JointId, line: Line, slot: f64) -> Result<SliderDyad, LinkageError> {
        let at = self.know_joint(p)?;
        self.know_line(&line)?;
        finite("the slot's angle", slot)?;
        let (block, link) = (self.new_link(), self.new_link());
        let joint = self.new_joint(link);
        self.steps.push(Step::Rpp { p: at, line, slot });
        Ok(SliderDyad { block, link, joint })
    }
}
