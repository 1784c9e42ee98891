//! Synthesis from key poses: positions and directions that the arm must take in order. The path between them is free.

mod harmonics;
mod law;
mod read;
#[cfg(test)]
mod tests;

use std::f64::consts::TAU;

use centrode_geometry::{Bounds, Point, Vector, checkpoint};
use nalgebra::{Matrix2, SMatrix, SVector};
use thiserror::Error;

pub use self::harmonics::Harmonics;
use self::law::{MildLaw, PoseLaw};
use super::{AxisFault, PathError, RequiredPath, TwoBar};
use centrode_machines::three_arm::design::Direction;
use centrode_spec::digits::stated;

/// Minimum and maximum number of key poses: three give a circle, and only special sets of more than seven can be met.
const FEWEST: usize = 3;
const MOST: usize = 7;
/// Distance of the tip from a pose, with the arm in the pose's direction, at which the pose is met, mm.
const TOLERANCE: f64 = 0.1;
/// Positions of the arm's axis along each side of a square round the tip, from which circles are searched.
const GRID: usize = 48;
/// Half side of the square, and maximum length of a bar, as a multiple of the size of the poses.
const REACH: f64 = 2.0;
const LONGEST: f64 = 4.0;
/// Minimum length of a bar, and minimum difference of both, as a share of the size of the poses.
const SHORTEST: f64 = 0.02;
const MIN_DIFFERENCE: f64 = 0.002;
/// Minimum distance of the arm's axes in the clamp's frame at which two chains count as different, as a share of the size of the
/// poses.
const APART: f64 = 0.02;
/// Gauss-Newton steps to a circle.
const STEPS: usize = 40;
/// Number of positions of the carrier in a turn through which the path is laid.
const PLACES: usize = 720;

/// Position of the tip and direction of the arm's clamp there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KeyPose {
    /// Position of the tip, mm.
    pub point: Point,
    /// Direction of the clamp, rad.
    pub direction: f64,
}

/// Reason why key poses give no machine.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum PoseError {
    /// A file or a point that cannot be read.
    #[error(transparent)]
    Path(#[from] PathError),
    /// Fewer or more poses than a machine can be found for.
    #[error("{count} key poses are given; there must be {FEWEST} to {MOST}")]
    Count {
        /// Number of poses.
        count: usize,
    },
    /// Poses at one position.
    #[error("all key poses are at one position: two of them must differ")]
    OnePlace,
    /// No point of the arm whose positions lie on a circle.
    #[error("no point of the arm has its positions in all {count} key poses on one circle: the nearest point misses a pose by {} mm, and {TOLERANCE} mm is allowed; move the poses, or give fewer poses", stated(*miss))]
    NoCircle {
        /// Number of poses.
        count: usize,
        /// Minimum distance found of a tip from its pose, mm.
        miss: f64,
    },
    /// Circles with each of which the carrier or the arm would turn back.
    #[error(
        "{circles} positions of the arm's axis were tried; with each of them, the carrier or the arm would turn back between key poses, or turn more than once: the best passes {passed} of {count} poses in order"
    )]
    Order {
        /// Number of poses.
        count: usize,
        /// Positions of the arm's axis on a circle.
        circles: usize,
        /// Most poses passed in order.
        passed: usize,
    },
    /// The carrier and arm found cannot follow their own path.
    #[error(transparent)]
    Chain(#[from] AxisFault),
}

/// Carrier and arm that meet key poses, with the gentlest path found between them.
///
/// In the arm's frame its axis is a fixed point. The positions of this point in the poses must lie on one circle, whose centre is
/// the carrier's axis. Such points are Burmester's circle points: any point for three poses, a curve for four, at most four
/// points for five. The angles of carrier and arm at the poses then follow. Between the poses the law has the minimum mean square
/// of the logarithm of the ratio and of its second derivative.
#[derive(Clone, Debug)]
pub struct KeyPoses {
    /// Carrier and arm, with the path of the tip.
    pub chain: TwoBar,
    /// Direction of the clamp minus that of the arm, rad.
    pub clamp: f64,
    /// Poses as given.
    pub poses: Vec<KeyPose>,
    /// Directions of carrier and arm in the first pose, rad.
    pub start: [f64; 2],
    /// Turns of the carrier and of the planet against it from the first pose to each, in the carrier's sense, rad.
    pub turns: Vec<[f64; 2]>,
    /// Distance of the path from each pose, mm, and error of the clamp's direction at the foot of this distance, rad.
    pub misses: Vec<[f64; 2]>,
    /// Number of starts of the search, for either sense of turning, that led to a chain; many lead to the same chain.
    pub possible: usize,
}

/// Circle on which the arm's axis passes the poses.
#[derive(Clone, Copy, Debug)]
struct Circle {
    /// Vector from the tip to the arm's axis, in the clamp's frame.
    arm: Vector,
    axis: Point,
    carrier: f64,
}

impl KeyPoses {
    /// Finds the chain of smallest maximum |ln| of the ratio.
    ///
    /// # Errors
    /// [`PoseError`] for too few or too many poses, for poses that are not finite, and if there is no machine: then with the
    /// error of the nearest one.
    pub fn new(poses: &[KeyPose]) -> Result<Self, PoseError> {
        let mut mildest = Self::mildest(poses, 1)?;
        Ok(mildest.remove(0))
    }

    /// Finds at most `most` different chains, at least one, in the order of the maximum |ln| of the ratio, the smallest first.
    ///
    /// # Errors
    /// As for [`Self::new`].
    pub fn mildest(poses: &[KeyPose], most: usize) -> Result<Vec<Self>, PoseError> {
        let count = poses.len();
        if !(FEWEST..=MOST).contains(&count) {
            return Err(PoseError::Count { count });
        }
        for (i, pose) in poses.iter().enumerate() {
            let (number, x, y) = (i + 1, pose.point.x, pose.point.y);
            if !(x.is_finite() && y.is_finite() && pose.direction.is_finite()) {
                return Err(PathError::NotFinite { number, x, y }.into());
            }
            if x.abs().max(y.abs()) > super::path::FARTHEST {
                let limit = super::path::FARTHEST;
                return Err(PathError::TooFar {
                    number,
                    x,
                    y,
                    limit,
                }
                .into());
            }
        }
        let bounds: Bounds = poses.iter().map(|pose| pose.point).collect();
        let size = bounds.diagonal();
        if size == 0.0 {
            return Err(PoseError::OnePlace);
        }
        let mut nearest = f64::INFINITY;
        let (mut circles, mut passed, mut possible) = (0, 0, 0);
        let mut found: Vec<(f64, Circle, MildLaw)> = Vec::new();
        for place in 0..GRID * GRID {
            checkpoint();
            let at = |i: usize| size * REACH * ((2 * i + 1) as f64 / GRID as f64 - 1.0);
            let start = Vector::new(at(place % GRID), at(place / GRID));
            let Some(circle) = Circle::near(poses, start, size) else {
                continue;
            };
            let miss = circle.miss(poses);
            nearest = nearest.min(miss);
            if miss > TOLERANCE {
                continue;
            }
            circles += 1;
            for sense in [1.0, -1.0] {
                let law = PoseLaw::through(poses, &circle, sense);
                passed = passed.max(law.passed());
                let Some(mild) = law.is_in_order().then(|| law.mildest()).flatten() else {
                    continue;
                };
                possible += 1;
                found.push((mild.unevenness(), circle, mild));
            }
        }
        if circles == 0 {
            return Err(PoseError::NoCircle {
                count,
                miss: nearest,
            });
        }
        if found.is_empty() {
            return Err(PoseError::Order {
                count,
                circles,
                passed,
            });
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut apart: Vec<(Circle, MildLaw)> = Vec::new();
        for (_, circle, law) in found {
            let is_other = |(other, of): &(Circle, MildLaw)| {
                (other.arm - circle.arm).norm() > APART * size || of.sense() != law.sense()
            };
            if apart.iter().all(is_other) {
                apart.push((circle, law));
            }
            if apart.len() == most.max(1) {
                break;
            }
        }
        let chains = apart.iter();
        let chains = chains.map(|(circle, law)| Self::from_law(poses, *circle, law, possible));
        chains.collect()
    }

    fn from_law(
        poses: &[KeyPose],
        circle: Circle,
        law: &MildLaw,
        possible: usize,
    ) -> Result<Self, PoseError> {
        let arm = circle.arm.norm();
        let bar = |length: f64, angle: f64| Vector::new(angle.cos(), angle.sin()) * length;
        let places = law.places(PLACES);
        let points: Vec<Point> = places
            .iter()
            .map(|[carrier, alpha]| circle.axis + bar(circle.carrier, *carrier) + bar(arm, *alpha))
            .collect();
        let path = RequiredPath::through(&points)?;
        let sense = if law.sense() > 0.0 {
            Direction::CounterClockwise
        } else {
            Direction::Clockwise
        };
        let chain = TwoBar::new(&path, circle.axis, Some(sense))?;
        let clamp = -circle.clamp();
        let step = law.sense() * TAU / PLACES as f64;
        let misses = poses.iter().map(|pose| {
            let carrier = circle.direction(pose);
            let t = ((carrier - places[0][0]) / step).rem_euclid(PLACES as f64);
            let off = path.distance_near(pose.point, t);
            let jet = chain.at(t);
            let turned = jet.carrier[0] + jet.elbow[0] + clamp - pose.direction;
            [off, (turned - TAU * (turned / TAU).round()).abs()]
        });
        Ok(Self {
            misses: misses.collect(),
            chain,
            clamp,
            poses: poses.to_vec(),
            start: law.start(),
            turns: law.turns(),
            possible,
        })
    }

    /// The law of one pair twice, at a bend (rad), that brings the arm through the poses; see [`Harmonics`].
    #[must_use]
    pub fn one_pair(&self, bend: f64, bias: &[f64]) -> Option<Harmonics> {
        let signed = |turns: &[f64; 2]| turns.map(|turn| self.chain.sense() * turn);
        let turns: Vec<[f64; 2]> = self.turns.iter().map(signed).collect();
        Harmonics::through(&turns, bend, bias)
    }
}

impl Circle {
    /// The circle reached by Gauss-Newton steps of minimum length from a position of the arm's axis.
    fn near(poses: &[KeyPose], start: Vector, size: f64) -> Option<Self> {
        let places = poses.iter().map(|pose| place(pose, start));
        let mut circle = Self::fitted(&places.collect::<Vec<_>>(), start)?;
        for _ in 0..STEPS {
            if poses.len() == FEWEST {
                break;
            }
            let mut normal = SMatrix::<f64, MOST, 5>::zeros();
            let mut off = SVector::<f64, MOST>::zeros();
            for (i, pose) in poses.iter().enumerate() {
                let from = place(pose, circle.arm) - circle.axis;
                let far = from.norm();
                let way = from / far;
                let turned = turned(way, -pose.direction);
                off[i] = far - circle.carrier;
                let row = [turned.x, turned.y, -way.x, -way.y, -1.0];
                for (j, slope) in row.into_iter().enumerate() {
                    normal[(i, j)] = slope;
                }
            }
            let step = normal.svd(true, true).solve(&off, 1e-9).ok()?;
            let length = step.norm();
            let step = step * (0.3 * size / length).min(1.0);
            circle.arm -= Vector::new(step[0], step[1]);
            circle.axis -= Vector::new(step[2], step[3]);
            circle.carrier -= step[4];
            if length < 1e-13 * size {
                break;
            }
        }
        let arm = circle.arm.norm();
        let minimum = SHORTEST * size;
        let is_good = |bar: f64| bar >= minimum && bar <= LONGEST * size;
        let differ = (circle.carrier - arm).abs() >= MIN_DIFFERENCE * size;
        (is_good(circle.carrier) && is_good(arm) && differ).then_some(circle)
    }

    /// The circle through the first three positions.
    fn fitted(places: &[Point], arm: Vector) -> Option<Self> {
        let [a, b, c] = [places[0], places[1], places[2]];
        let (one, other) = (b - a, c - a);
        let sides = Matrix2::new(one.x, one.y, other.x, other.y);
        let right = Vector::new(one.norm_squared(), other.norm_squared()) * 0.5;
        let middle = sides.try_inverse()? * right;
        let carrier = middle.norm();
        carrier.is_finite().then_some(Self {
            arm,
            axis: a + middle,
            carrier,
        })
    }

    /// Maximum distance of a tip from its pose, with the arm in the pose's direction, mm.
    fn miss(&self, poses: &[KeyPose]) -> f64 {
        let miss = |pose| ((place(pose, self.arm) - self.axis).norm() - self.carrier).abs();
        poses.iter().map(miss).fold(0.0, f64::max)
    }

    /// Direction of the carrier in a pose, rad.
    fn direction(&self, pose: &KeyPose) -> f64 {
        let from = place(pose, self.arm) - self.axis;
        from.y.atan2(from.x)
    }

    /// Direction of the arm, from its axis to the tip, in the clamp's frame, rad.
    fn clamp(&self) -> f64 {
        (-self.arm.y).atan2(-self.arm.x)
    }
}

/// Position of the arm's axis in a pose.
fn place(pose: &KeyPose, arm: Vector) -> Point {
    pose.point + turned(arm, pose.direction)
}

fn turned(v: Vector, angle: f64) -> Vector {
    let (sin, cos) = angle.sin_cos();
    Vector::new(v.x * cos - v.y * sin, v.x * sin + v.y * cos)
}
