use centrode_geometry::{Jet, Point, Vector};

use super::dyad::{Branch, Closed, prp, rpr, rrp, rrr};
use super::point_series::PointSeries;
use crate::formula::Taylor;
use crate::transmission::MotionJet;

/// A joint of a [`Linkage`]: a point of one of its links.
#[derive(Clone, Copy, Debug, Eq, Hash, Ord, PartialEq, PartialOrd)]
pub struct Joint(pub(super) usize);

/// A link of a [`Linkage`]: a rigid body with its own axes.
#[derive(Clone, Copy, Debug, Eq, Hash, Ord, PartialEq, PartialOrd)]
pub struct Link(pub(super) usize);

impl Link {
    /// The link that stands still.
    pub const FRAME: Self = Self(0);

    /// Position among the linkage's links; the frame is 0.
    #[must_use]
    pub fn index(self) -> usize {
        self.0
    }
}

impl Joint {
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
    pub link: Link,
    /// A point it passes through, in the link's axes, mm.
    pub through: Point,
    /// Its direction against the link's first axis, rad.
    pub angle: f64,
}

/// The links and the joint of two bars.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub struct TwoBars {
    /// The bar from the first outer joint, its first axis towards the common joint.
    pub first: Link,
    /// The bar from the second outer joint, its first axis towards the common joint.
    pub second: Link,
    /// The common joint.
    pub joint: Joint,
}

/// The links and the joint of a dyad with a slider.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub struct SliderDyad {
    /// The block that slides, its first axis along the guide.
    pub block: Link,
    /// The other link of the dyad.
    pub link: Link,
    /// The joint of block and link, or of block and what drives it.
    pub joint: Joint,
}

/// How two links of a linkage are held together.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum Connection {
    /// A pin.
    Turning {
        /// Where.
        joint: Joint,
        /// The two links.
        links: (Link, Link),
    },
    /// A block in a straight guide.
    Sliding {
        /// The middle of the block.
        joint: Joint,
        /// The block; its first axis points along the guide.
        block: Link,
        /// The link with the guide.
        guide: Link,
    },
}

/// What a linkage is made of, for those who ask about forces.
#[derive(Clone, Debug)]
pub struct LinkageParts {
    /// The driven link.
    pub crank: Option<Link>,
    /// Every pin and guide.
    pub connections: Vec<Connection>,
    /// Links, the frame included.
    pub link_count: usize,
}

/// Why a linkage cannot be built or posed.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LinkageError {
    /// A length that is not above zero.
    #[error("{name} is {value} mm; it must be finite and above zero")]
    Length {
        /// Which one.
        name: &'static str,
        /// As given, mm.
        value: f64,
    },
    /// A number that is not finite.
    #[error("{name} is {value}; it must be finite")]
    NotFinite {
        /// Which one.
        name: &'static str,
        /// As given.
        value: f64,
    },
    /// A joint or link of another linkage.
    #[error("{what} {index} is not of this linkage, which has {count} of them")]
    Unknown {
        /// `joint` or `link`.
        what: &'static str,
        /// Its number.
        index: usize,
        /// How many this linkage has.
        count: usize,
    },
    /// A second crank.
    #[error("the linkage has its crank already: one input moves it")]
    SecondCrank,
    /// A dyad does not reach.
    #[error("dyad {dyad} cannot close at the input {input} rad: {missing} mm are missing")]
    DoesNotClose {
        /// Its number, from 0 in the order of building.
        dyad: usize,
        /// The input, rad.
        input: f64,
        /// How far its ends stay apart, mm; for two parallel guides not finite.
        missing: f64,
    },
    /// A dyad closes just so, and velocities have no finite value.
    #[error(
        "dyad {dyad} is stretched or folded flat at the input {input} rad: velocities are not finite there"
    )]
    Flat {
        /// Its number, from 0 in the order of building.
        dyad: usize,
        /// The input, rad.
        input: f64,
    },
    /// The angle of a link jumps: a guided link's block passes its pivot.
    #[error("the direction of link {link} is not defined near the input {input} rad")]
    NoDirection {
        /// The link's number.
        link: usize,
        /// The input, rad.
        input: f64,
    },
}

#[derive(Clone, Copy, Debug)]
enum Step {
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
    Rrr {
        p: usize,
        q: usize,
        lengths: (f64, f64),
        branch: Branch,
    },
    Rrp {
        p: usize,
        length: f64,
        line: Line,
        branch: Branch,
    },
    Rpr {
        p: usize,
        q: usize,
        offset: f64,
        branch: Branch,
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

/// A planar linkage of one input: a frame, a crank and dyads in the order they close.
///
/// ```
/// use centrode_geometry::Point;
/// use centrode_mechanism::linkage::{Branch, Link, Linkage};
///
/// let mut linkage = Linkage::new();
/// let a = linkage.point(Link::FRAME, Point::new(0.0, 0.0))?;
/// let d = linkage.point(Link::FRAME, Point::new(105.0, 0.0))?;
/// let (_, b) = linkage.crank(a, 77.0, 0.0)?;
/// let bars = linkage.rrr(b, d, (147.0, 127.0), Branch::Upper)?;
/// let pose = linkage.at(1.0)?;
/// assert!(pose.joint(bars.joint).point.y > 0.0);
/// # Ok::<(), centrode_mechanism::linkage::LinkageError>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Linkage {
    steps: Vec<Step>,
    /// The link each joint belongs to.
    owners: Vec<usize>,
    links: usize,
    crank: Option<Link>,
    connections: Vec<Connection>,
}

/// Where all joints and links are, and how they move.
#[derive(Clone, Debug, PartialEq)]
pub struct Pose {
    joints: Vec<Jet>,
    bodies: Vec<Body>,
}

/// A link's motion: a point of it and its angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// Origin of the link's axes.
    pub origin: Jet,
    /// Direction of its first axis, principal value, rad.
    pub angle: MotionJet,
}

impl Body {
    /// A point of the link given in its own axes, mm.
    #[must_use]
    pub fn point(&self, local: Point) -> Jet {
        let angle = Taylor::<4>([
            self.angle.position,
            self.angle.velocity,
            0.5 * self.angle.acceleration,
            self.angle.jerk / 6.0,
        ]);
        let way = PointSeries::unit(angle).turned(local.coords).jet();
        Jet {
            point: self.origin.point + way.point.coords,
            first: self.origin.first + way.first,
            second: self.origin.second + way.second,
            third: self.origin.third + way.third,
        }
    }
}

impl Pose {
    /// A joint's motion.
    ///
    /// # Panics
    /// Never for a joint of the linkage that made this pose.
    #[must_use]
    pub fn joint(&self, joint: Joint) -> Jet {
        self.joints[joint.0]
    }

    /// A link's motion.
    ///
    /// # Panics
    /// Never for a link of the linkage that made this pose.
    #[must_use]
    pub fn body(&self, link: Link) -> Body {
        self.bodies[link.0]
    }

    /// Every joint, in the order of building.
    #[must_use]
    pub fn joints(&self) -> &[Jet] {
        &self.joints
    }

    /// Every link, the frame first.
    #[must_use]
    pub fn bodies(&self) -> &[Body] {
        &self.bodies
    }
}

/// Joints and links while a pose is worked out.
pub(super) struct Series<const N: usize> {
    joints: Vec<PointSeries<N>>,
    /// Origin and first axis.
    frames: Vec<(PointSeries<N>, PointSeries<N>)>,
    /// What is left to every dyad before it no longer closes.
    pub(super) room: Vec<Taylor<N>>,
}

impl<const N: usize> Series<N> {
    fn line(&self, line: &Line) -> (PointSeries<N>, PointSeries<N>) {
        let (origin, axis) = self.frames[line.link.0];
        let (sin, cos) = line.angle.sin_cos();
        let through = origin.plus(axis.turned(line.through.coords));
        (through, axis.turned(Vector::new(cos, sin)))
    }

    pub(super) fn axis(&self, link: Link) -> PointSeries<N> {
        self.frames[link.0].1
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
    /// A frame alone.
    #[must_use]
    pub fn new() -> Self {
        Self {
            links: 1,
            ..Self::default()
        }
    }

    fn know_joint(&self, joint: Joint) -> Result<usize, LinkageError> {
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

    fn know_line(&self, line: &Line) -> Result<(), LinkageError> {
        finite("a line's angle", line.angle)?;
        finite("a line's point", line.through.x + line.through.y)?;
        self.know_link(line.link)
    }

    fn know_link(&self, link: Link) -> Result<(), LinkageError> {
        if link.0 < self.links {
            return Ok(());
        }
        Err(LinkageError::Unknown {
            what: "link",
            index: link.0,
            count: self.links,
        })
    }

    fn new_link(&mut self) -> Link {
        self.links += 1;
        Link(self.links - 1)
    }

    fn new_joint(&mut self, owner: Link) -> Joint {
        self.owners.push(owner.0);
        Joint(self.owners.len() - 1)
    }

    fn pin(&mut self, joint: Joint, other: Link) {
        let owner = Link(self.owners[joint.0]);
        self.connections.push(Connection::Turning {
            joint,
            links: (owner, other),
        });
    }

    /// Adds a point of a link, given in the link's axes, mm: a fixed pivot on the frame, a coupler
    /// point, the third joint of a ternary link.
    ///
    /// # Errors
    /// [`LinkageError::Unknown`], [`LinkageError::NotFinite`].
    pub fn point(&mut self, link: Link, local: Point) -> Result<Joint, LinkageError> {
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
        pivot: Joint,
        length: f64,
        phase: f64,
    ) -> Result<(Link, Joint), LinkageError> {
        let at = self.know_joint(pivot)?;
        self::length("the crank", length)?;
        finite("the crank's phase", phase)?;
        if self.crank.is_some() {
            return Err(LinkageError::SecondCrank);
        }
        let link = self.new_link();
        self.crank = Some(link);
        self.pin(pivot, link);
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
        p: Joint,
        q: Joint,
        lengths: (f64, f64),
        branch: Branch,
    ) -> Result<TwoBars, LinkageError> {
        let (at_p, at_q) = (self.know_joint(p)?, self.know_joint(q)?);
        length("the first bar", lengths.0)?;
        length("the second bar", lengths.1)?;
        let (first, second) = (self.new_link(), self.new_link());
        self.pin(p, first);
        self.pin(q, second);
        let joint = self.new_joint(first);
        self.pin(joint, second);
        self.steps.push(Step::Rrr {
            p: at_p,
            q: at_q,
            lengths,
            branch,
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
        p: Joint,
        length: f64,
        line: Line,
        branch: Branch,
    ) -> Result<SliderDyad, LinkageError> {
        let at = self.know_joint(p)?;
        self.know_line(&line)?;
        self::length("the bar", length)?;
        let (link, block) = (self.new_link(), self.new_link());
        self.pin(p, link);
        let joint = self.new_joint(link);
        self.pin(joint, block);
        self.slide(joint, block, line.link);
        self.steps.push(Step::Rrp {
            p: at,
            length,
            line,
            branch,
        });
        Ok(SliderDyad { block, link, joint })
    }

    fn slide(&mut self, joint: Joint, block: Link, guide: Link) {
        self.connections.push(Connection::Sliding {
            joint,
            block,
            guide,
        });
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
        p: Joint,
        q: Joint,
        offset: f64,
        branch: Branch,
    ) -> Result<SliderDyad, LinkageError> {
        let (at_p, at_q) = (self.know_joint(p)?, self.know_joint(q)?);
        finite("the offset", offset)?;
        let (block, link) = (self.new_link(), self.new_link());
        self.pin(p, block);
        self.pin(q, link);
        self.slide(p, block, link);
        self.steps.push(Step::Rpr {
            p: at_p,
            q: at_q,
            offset,
            branch,
        });
        Ok(SliderDyad {
            block,
            link,
            joint: p,
        })
    }

    /// Adds two blocks pinned to each other, each on a line of its own (dyad PRP). It closes one way only.
    ///
    /// # Errors
    /// [`LinkageError::Unknown`], [`LinkageError::NotFinite`].
    pub fn prp(&mut self, first: Line, second: Line) -> Result<SliderDyad, LinkageError> {
        self.know_line(&first)?;
        self.know_line(&second)?;
        let (block, link) = (self.new_link(), self.new_link());
        let joint = self.new_joint(block);
        self.pin(joint, link);
        self.slide(joint, block, first.link);
        self.slide(joint, link, second.link);
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
    pub fn rpp(&mut self, p: Joint, line: Line, slot: f64) -> Result<SliderDyad, LinkageError> {
        let at = self.know_joint(p)?;
        self.know_line(&line)?;
        finite("the slot's angle", slot)?;
        let (block, link) = (self.new_link(), self.new_link());
        self.pin(p, block);
        self.slide(p, block, link);
        let joint = self.new_joint(link);
        self.slide(joint, link, line.link);
        self.steps.push(Step::Rpp { p: at, line, slot });
        Ok(SliderDyad { block, link, joint })
    }

    /// What the linkage is made of.
    #[must_use]
    pub fn parts(&self) -> LinkageParts {
        LinkageParts {
            crank: self.crank,
            connections: self.connections.clone(),
            link_count: self.links,
        }
    }

    /// Positions, velocities, accelerations and jerks of everything at an input, per radian of input.
    ///
    /// # Errors
    /// [`LinkageError::DoesNotClose`]; [`LinkageError::Flat`] where velocities are not finite.
    pub fn at(&self, input: f64) -> Result<Pose, LinkageError> {
        let series = self.series::<4>(input);
        self.closes(&series, input)?;
        let bodies = series.frames.iter().map(|(origin, axis)| Body {
            origin: origin.jet(),
            angle: MotionJet::of(&axis.angle()),
        });
        Ok(Pose {
            bodies: bodies.collect(),
            joints: series.joints.iter().map(|j| j.jet()).collect(),
        })
    }

    fn closes(&self, series: &Series<4>, input: f64) -> Result<(), LinkageError> {
        for (dyad, room) in series.room.iter().enumerate() {
            if room.0[0] == 0.0 && !self.is_prp(dyad) {
                return Err(LinkageError::Flat { dyad, input });
            }
            if room.0[0] <= 0.0 || room.0[0].is_nan() {
                let missing = self.missing(dyad, input);
                return Err(LinkageError::DoesNotClose {
                    dyad,
                    input,
                    missing,
                });
            }
        }
        Ok(())
    }

    fn dyads(&self) -> impl Iterator<Item = &Step> {
        let dyads = self.steps.iter();
        dyads.filter(|s| !matches!(s, Step::Point { .. } | Step::Crank { .. }))
    }

    fn is_prp(&self, dyad: usize) -> bool {
        matches!(
            self.dyads().nth(dyad),
            Some(Step::Prp { .. } | Step::Rpp { .. })
        )
    }

    /// How far the ends of a dyad that does not close stay apart, mm.
    pub(super) fn missing(&self, dyad: usize, input: f64) -> f64 {
        let series = self.series::<1>(input);
        let between =
            |p: usize, q: usize| (series.joints[p].value() - series.joints[q].value()).norm();
        match self.dyads().nth(dyad) {
            Some(&Step::Rrr { p, q, lengths, .. }) => {
                let d = between(p, q);
                (d - lengths.0 - lengths.1).max((lengths.0 - lengths.1).abs() - d)
            }
            Some(Step::Rrp {
                p, length, line, ..
            }) => {
                let (u, e) = series.line(line);
                e.cross(series.joints[*p].minus(u)).0[0].abs() - length
            }
            Some(&Step::Rpr { p, q, offset, .. }) => offset.abs() - between(p, q),
            _ => f64::INFINITY,
        }
    }

    /// The pose as series of order N - 1; where a dyad does not close, what follows is not a number.
    pub(super) fn series<const N: usize>(&self, input: f64) -> Series<N> {
        let input = Taylor::<N>::variable(input);
        let still = PointSeries::fixed(Point::origin());
        let mut s = Series {
            joints: Vec::with_capacity(self.owners.len()),
            frames: Vec::with_capacity(self.links),
            room: Vec::new(),
        };
        s.frames
            .push((still, PointSeries::fixed(Point::new(1.0, 0.0))));
        for step in &self.steps {
            match step {
                Step::Point { link, local } => {
                    let (origin, axis) = s.frames[*link];
                    s.joints.push(origin.plus(axis.turned(*local)));
                }
                Step::Crank { pivot, phase } => {
                    let axis = PointSeries::unit(input + *phase);
                    s.frames.push((s.joints[*pivot], axis));
                }
                Step::Rrr {
                    p,
                    q,
                    lengths,
                    branch,
                } => {
                    let (p, q) = (s.joints[*p], s.joints[*q]);
                    let Closed { at, room } = rrr(p, q, *lengths, *branch);
                    s.frames.push((p, at.minus(p).times(1.0 / lengths.0)));
                    s.frames.push((q, at.minus(q).times(1.0 / lengths.1)));
                    s.joints.push(at);
                    s.room.push(room);
                }
                Step::Rrp {
                    p,
                    length,
                    line,
                    branch,
                } => {
                    let p = s.joints[*p];
                    let (u, e) = s.line(line);
                    let Closed { at, room } = rrp(p, *length, u, e, *branch);
                    s.frames.push((p, at.minus(p).times(1.0 / length)));
                    s.frames.push((at, e));
                    s.joints.push(at);
                    s.room.push(room);
                }
                Step::Rpr {
                    p,
                    q,
                    offset,
                    branch,
                } => {
                    let (p, q) = (s.joints[*p], s.joints[*q]);
                    let Closed { at, room } = rpr(p, q, *offset, *branch);
                    s.frames.push((p, at));
                    s.frames.push((q, at));
                    s.room.push(room);
                }
                Step::Prp { lines } => {
                    let ((u, e), (v, f)) = (s.line(&lines.0), s.line(&lines.1));
                    let Closed { at, room } = prp(u, e, v, f);
                    s.frames.push((at, e));
                    s.frames.push((at, f));
                    s.joints.push(at);
                    s.room.push(room);
                }
                Step::Rpp { p, line, slot } => {
                    let p = s.joints[*p];
                    let (u, e) = s.line(line);
                    let (sin, cos) = slot.sin_cos();
                    let f = e.turned(Vector::new(cos, sin));
                    let Closed { at, room } = prp(u, e, p, f);
                    s.frames.push((p, f));
                    s.frames.push((at, e));
                    s.joints.push(at);
                    s.room.push(room);
                }
            }
        }
        s
    }
}
