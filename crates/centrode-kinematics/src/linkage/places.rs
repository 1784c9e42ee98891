use centrode_geometry::{Point, Vector};

use super::assembly::{Linkage, Step};
use super::parts::{Line, LinkId};
use super::series::{Series, SeriesItem};
use crate::formula::{LANES, Lanes, groups};

/// Joints and links on which a step depends, by their numbers.
#[derive(Default)]
struct Takes {
    joints: Vec<usize>,
    links: Vec<usize>,
}

impl Step {
    /// Numbers of the links and joints that it makes.
    pub(super) fn makes(&self) -> [usize; 2] {
        match self {
            Self::Point { .. } => [0, 1],
            Self::Crank { .. }
            | Self::Turning { .. }
            | Self::Sliding { .. }
            | Self::Fixed { .. } => [1, 0],
            Self::Rpr { .. } => [2, 0],
            Self::Rrr { .. } | Self::Rrp { .. } | Self::Prp { .. } | Self::Rpp { .. } => [2, 1],
        }
    }

    fn takes(&self, owners: &[usize]) -> Takes {
        let of = |joints: &[usize], lines: &[&Line]| Takes {
            joints: joints.to_vec(),
            links: lines.iter().map(|line| line.link.0).collect(),
        };
        match self {
            Self::Point { link, .. } => Takes {
                links: vec![*link],
                ..Takes::default()
            },
            Self::Crank { pivot, .. } => of(&[*pivot], &[]),
            Self::Turning { pivot, .. } => Takes {
                joints: vec![*pivot],
                links: vec![owners[*pivot]],
            },
            Self::Sliding { line, .. } | Self::Fixed { line } => of(&[], &[line]),
            Self::Rrr { p, q, .. } | Self::Rpr { p, q, .. } => of(&[*p, *q], &[]),
            Self::Rrp { p, line, .. } | Self::Rpp { p, line, .. } => of(&[*p], &[line]),
            Self::Prp { lines } => of(&[], &[&lines.0, &lines.1]),
        }
    }
}

/// Position of a point: a joint, or a point of a link.
enum Source {
    Joint(usize),
    Of(LinkId, Point),
}

/// Steps and frames of links that a computation needs.
#[derive(Clone, Debug)]
pub(super) struct Needed {
    steps: Vec<bool>,
    frames: Vec<bool>,
    /// Link that carries all needed parts and in whose axes positions are stated; the frame if no nearer link carries them all.
    /// link.
    base: usize,
}

impl Needed {
    /// Whether a part is needed.
    #[inline(always)]
    pub(super) fn has(&self, part: SeriesItem) -> bool {
        match part {
            SeriesItem::Step(number) => self.steps[number],
            SeriesItem::Frame(link) => self.frames[link],
            SeriesItem::Base(link) => self.base == link,
        }
    }
}

impl Linkage {
    /// Positions at each of many inputs, mm, of points given in the axes of their links, mm: all points at the first input, then
    /// at the second and so on. They equal [`place`](Self::place) but for a few units in the last digit. They are computed side
    /// by side, and only the links on which they depend.
    ///
    /// Not finite where the linkage does not close.
    ///
    /// # Panics
    /// Never for links of the linkage.
    #[must_use]
    pub fn places_each(&self, points: &[(LinkId, Point)], inputs: &[f64]) -> Vec<[f64; 2]> {
        let mut places = vec![[0.0; 2]; points.len() * inputs.len()];
        self.write_places(points, inputs, &mut places);
        places
    }

    /// Writes [`places_each`](Self::places_each) into an array of the caller, up to the end of that array.
    ///
    /// # Panics
    /// Never for links of the linkage.
    pub fn write_places(
        &self,
        points: &[(LinkId, Point)],
        inputs: &[f64],
        places: &mut [[f64; 2]],
    ) {
        let source = |(link, local): &(LinkId, Point)| match self.joint_at(*link, *local) {
            Some(joint) => Source::Joint(joint),
            None => Source::Of(*link, *local),
        };
        let sources: Vec<Source> = points.iter().map(source).collect();
        let joints = sources.iter().filter_map(|source| match source {
            Source::Joint(joint) => Some(*joint),
            Source::Of(..) => None,
        });
        let links = sources.iter().filter_map(|source| match source {
            Source::Of(link, _) => Some(link.0),
            Source::Joint(_) => None,
        });
        let needed = self.needed(joints, links);
        let mut series = Series::<1, Lanes>::default();
        for (input, group) in groups(inputs).zip(places.chunks_mut(LANES * points.len().max(1))) {
            self.find(input, |part| needed.has(part), &mut series);
            for (number, source) in sources.iter().enumerate() {
                let place = match source {
                    Source::Joint(joint) => series.joint(*joint),
                    Source::Of(link, local) => {
                        let (origin, axis) = series.frame(*link);
                        origin.plus(axis.turned(local.coords))
                    }
                };
                let of_lanes = group.iter_mut().skip(number).step_by(points.len());
                for (lane, written) in of_lanes.enumerate() {
                    *written = place.value_of(lane).into();
                }
            }
        }
    }

    /// Position (mm) and velocity (mm per radian of the input) at an input of each of several points, given in the axes of their
    /// links in mm. Only the links on which the points depend are computed.
    ///
    /// Not finite where the linkage does not close.
    ///
    /// # Panics
    /// Never for links of the linkage.
    #[must_use]
    pub fn moving(&self, points: &[(LinkId, Point)], input: f64) -> Vec<(Point, Vector)> {
        let needed = self.needed(std::iter::empty(), points.iter().map(|(link, _)| link.0));
        let mut series = Series::<2>::default();
        self.find(input, |part| needed.has(part), &mut series);
        let moving = |(link, local): &(LinkId, Point)| {
            let (origin, axis) = series.frame(*link);
            let place = origin.plus(axis.turned(local.coords));
            let velocity = Vector::new(place.x.0[1], place.y.0[1]);
            (place.value(), velocity)
        };
        points.iter().map(moving).collect()
    }

    /// The joint at a point of a link, given in the link's axes; `None` if there is no joint.
    fn joint_at(&self, link: LinkId, local: Point) -> Option<usize> {
        let (mut links, mut joints) = (1, 0);
        for step in &self.steps {
            let own = link.0.checked_sub(links);
            let along = |length: f64| local == Point::new(length, 0.0);
            let found = match step {
                Step::Point {
                    link: of,
                    local: at,
                } => (*of == link.0 && *at == local.coords).then_some(joints),
                Step::Rrr { lengths, .. } => match own {
                    Some(0) if along(lengths.0) => Some(joints),
                    Some(1) if along(lengths.1) => Some(joints),
                    _ => None,
                },
                _ => None,
            };
            if found.is_some() {
                return found;
            }
            let makes = step.makes();
            (links, joints) = (links + makes[0], joints + makes[1]);
        }
        None
    }

    /// The steps on which joints and links depend, by their numbers, and the links whose frames are needed.
    pub(super) fn needed(
        &self,
        joints: impl Iterator<Item = usize>,
        links: impl Iterator<Item = usize>,
    ) -> Needed {
        self.needed_above(0, joints, links)
    }

    /// Steps on which the relative position of links depends, stated in the axes of the last link that carries all of them: the
    /// motion of that link is not computed.
    pub(super) fn needed_among(&self, links: &[usize]) -> Needed {
        let of = |base: usize| self.needed_above(base, std::iter::empty(), links.iter().copied());
        let bases = 1..links.iter().copied().max().unwrap_or(0);
        let bases = bases.rev().map(of);
        let mut alone = bases.filter(|needed| self.is_alone(needed));
        alone.next().unwrap_or_else(|| of(0))
    }

    /// Whether no needed part depends on the position of the base.
    fn is_alone(&self, needed: &Needed) -> bool {
        let mut first = 1;
        let makes_base = |first: usize, step: &Step| {
            let links = first..first + step.makes()[0];
            links.contains(&needed.base)
        };
        let free = self.steps.iter().zip(&needed.steps).all(|(step, taken)| {
            let is_free =
                !taken || !(matches!(step, Step::Crank { .. }) || makes_base(first, step));
            first += step.makes()[0];
            is_free
        });
        free && !needed.frames[0]
    }

    fn needed_above(
        &self,
        base: usize,
        joints: impl Iterator<Item = usize>,
        links: impl Iterator<Item = usize>,
    ) -> Needed {
        let mut frames = vec![false; self.links];
        let mut joint_is = vec![false; self.owners.len()];
        links.for_each(|link| frames[link] = true);
        joints.for_each(|joint| joint_is[joint] = true);
        let (mut first_link, mut first_joint) = (self.links, self.owners.len());
        let mut steps = vec![false; self.steps.len()];
        for (number, step) in self.steps.iter().enumerate().rev() {
            let [links, joints] = step.makes();
            first_link -= links;
            first_joint -= joints;
            let mut made = first_link..first_link + links;
            steps[number] = made.any(|link| frames[link] && link != base)
                || joint_is[first_joint..first_joint + joints].contains(&true);
            if steps[number] {
                let takes = step.takes(&self.owners);
                takes.links.into_iter().for_each(|link| frames[link] = true);
                takes
                    .joints
                    .into_iter()
                    .for_each(|joint| joint_is[joint] = true);
            }
        }
        Needed {
            steps,
            frames,
            base,
        }
    }
}
