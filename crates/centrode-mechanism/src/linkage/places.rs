use centrode_geometry::{Point, Vector};

use super::assembly::{Linkage, Step};
use super::parts::{Line, Link};
use super::series::Series;
use super::six_bar_motion::chunks;
use crate::formula::{LANES, Lanes};

/// Joints and links that a step needs, by their numbers.
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

impl Linkage {
    /// Places of points of links, given in their axes in mm, at each of many inputs, mm: all points at the first input, then
    /// at the second and so on; equal to [`place`](Self::place) but for a few units in the last place, computed side by side,
    /// and of the links on which these depend alone.
    ///
    /// Not finite where the linkage does not close.
    ///
    /// # Panics
    /// Never for links of the linkage.
    #[must_use]
    pub fn places_each(&self, points: &[(Link, Point)], inputs: &[f64]) -> Vec<[f64; 2]> {
        let needed = self.needed(points.iter().map(|(link, _)| link.0));
        let mut series = Series::<1, Lanes>::default();
        let count = points.len();
        let mut places = vec![[0.0; 2]; count * inputs.len()];
        for (first, input) in chunks(inputs) {
            self.find(input, |step| needed[step], &mut series);
            let lanes = LANES.min(inputs.len() - first);
            for (number, (link, local)) in points.iter().enumerate() {
                let (origin, axis) = series.frame(*link);
                let place = origin.plus(axis.turned(local.coords));
                for lane in 0..lanes {
                    places[(first + lane) * count + number] = place.value_of(lane).into();
                }
            }
        }
        places
    }

    /// Place (mm) and velocity (mm per radian of the input) of each of several points of links, given in their axes in mm, at
    /// an input; of the links on which these depend alone.
    ///
    /// Not finite where the linkage does not close.
    ///
    /// # Panics
    /// Never for links of the linkage.
    #[must_use]
    pub fn moving(&self, points: &[(Link, Point)], input: f64) -> Vec<(Point, Vector)> {
        let needed = self.needed(points.iter().map(|(link, _)| link.0));
        let mut series = Series::<2>::default();
        self.find(input, |step| needed[step], &mut series);
        let moving = |(link, local): &(Link, Point)| {
            let (origin, axis) = series.frame(*link);
            let place = origin.plus(axis.turned(local.coords));
            let velocity = Vector::new(place.x.0[1], place.y.0[1]);
            (place.value(), velocity)
        };
        points.iter().map(moving).collect()
    }

    /// The steps on which links depend.
    pub(super) fn needed(&self, links: impl Iterator<Item = usize>) -> Vec<bool> {
        let mut link_is = vec![false; self.links];
        let mut joint_is = vec![false; self.owners.len()];
        links.for_each(|link| link_is[link] = true);
        let (mut first_link, mut first_joint) = (self.links, self.owners.len());
        let mut needed = vec![false; self.steps.len()];
        for (number, step) in self.steps.iter().enumerate().rev() {
            let [links, joints] = step.makes();
            first_link -= links;
            first_joint -= joints;
            needed[number] = link_is[first_link..first_link + links].contains(&true)
                || joint_is[first_joint..first_joint + joints].contains(&true);
            if needed[number] {
                let takes = step.takes(&self.owners);
                takes
                    .links
                    .into_iter()
                    .for_each(|link| link_is[link] = true);
                takes
                    .joints
                    .into_iter()
                    .for_each(|joint| joint_is[joint] = true);
            }
        }
        needed
    }
}
