use centrode_geometry::{Point, Vector};

use super::assembly::{Linkage, Step};
use super::dyad::{Closed, prp, rpr, rrp, rrr};
use super::error::LinkageError;
use super::parts::{Line, LinkId};
use super::point_series::PointSeries;
use super::pose::{BodyMotion, Pose};
use super::refilled::Refilled;
use crate::formula::{LANES, Number, Taylor};
use crate::transmission::{MotionJet, Transmission};

/// Joints and links while a pose is computed.
pub(super) struct Series<const N: usize, T = f64> {
    joints: Refilled<PointSeries<N, T>>,
    /// Origin and first axis.
    frames: Refilled<(PointSeries<N, T>, PointSeries<N, T>)>,
    /// Discriminant of every dyad: above zero while the dyad closes.
    pub(super) room: Refilled<T>,
}

/// Part of a linkage on which other parts depend.
#[derive(Clone, Copy)]
pub(super) enum SeriesItem {
    /// A step, by its number.
    Step(usize),
    /// A link's origin and axis, by its number.
    Frame(usize),
    /// Base link, by its number: all positions are stated in its axes.
    Base(usize),
}

impl<const N: usize, T> Default for Series<N, T> {
    fn default() -> Self {
        Self {
            joints: Refilled::default(),
            frames: Refilled::default(),
            room: Refilled::default(),
        }
    }
}

impl<const N: usize, T: Number> Series<N, T> {
    pub(super) fn line(&self, line: &Line) -> (PointSeries<N, T>, PointSeries<N, T>) {
        let (origin, axis) = self.frames[line.link.0];
        let (sin, cos) = line.angle.sin_cos();
        let through = origin.plus(axis.turned(line.through.coords));
        (through, axis.turned(Vector::new(cos, sin)))
    }

    /// Origin and first axis of a link.
    pub(super) fn frame(&self, link: LinkId) -> (PointSeries<N, T>, PointSeries<N, T>) {
        self.frames[link.0]
    }

    /// Position of a joint.
    pub(super) fn joint(&self, joint: usize) -> PointSeries<N, T> {
        self.joints[joint]
    }

    /// A law's series at one input or at several side by side.
    fn law(law: &dyn Transmission, input: T) -> Taylor<N, T> {
        let mut jets = [Taylor([0.0; N]); LANES];
        for (lane, jet) in jets.iter_mut().enumerate().take(T::COUNT) {
            *jet = law.at(input.lane(lane)).coefficients();
        }
        Taylor(std::array::from_fn(|k| T::of_lanes(|lane| jets[lane].0[k])))
    }
}

impl<const N: usize> Series<N> {
    /// Transmission angle of a dyad, rad: 0 or pi where it is stretched or folded, a right angle at best; `None` for another
    /// step.
    pub(super) fn holding_angle(&self, step: &Step) -> Option<f64> {
        let parts = |a: PointSeries<N>, b: PointSeries<N>| (a.cross(b).0[0].abs(), a.dot(b).0[0]);
        let between = |a, b| {
            let (across, along) = parts(a, b);
            across.atan2(along)
        };
        // Lines have no direction: their angle is from 0 to a right angle.
        let of_lines = |a, b| {
            let (across, along) = parts(a, b);
            across.atan2(along.abs())
        };
        let from_normal = |a, b| {
            let (across, along) = parts(a, b);
            along.abs().atan2(across)
        };
        Some(match step {
            Step::Rrr { p, q, joint, .. } => {
                let at = self.joints[*joint];
                between(at.minus(self.joints[*p]), at.minus(self.joints[*q]))
            }
            Step::Rrp { p, line, joint, .. } => from_normal(
                self.joints[*joint].minus(self.joints[*p]),
                self.line(line).1,
            ),
            Step::Rpr { p, q, link, .. } => {
                let (_, axis) = self.frames[*link];
                from_normal(self.joints[*p].minus(self.joints[*q]), axis)
            }
            Step::Prp { lines } => of_lines(self.line(&lines.0).1, self.line(&lines.1).1),
            Step::Rpp { slot, .. } => slot.sin().abs().atan2(slot.cos().abs()),
            _ => return None,
        })
    }
}

impl Linkage {
    /// Positions, velocities, accelerations and jerks of everything at an input, per radian of input.
    ///
    /// # Errors
    /// [`LinkageError::DoesNotClose`]; [`LinkageError::Flat`] where velocities are not finite.
    pub fn at(&self, input: f64) -> Result<Pose, LinkageError> {
        let series = self.series::<4>(input);
        self.closes(&series, input)?;
        let bodies = series.frames.iter().map(|(origin, axis)| BodyMotion {
            origin: origin.jet(),
            angle: MotionJet::from_series(&axis.angle()),
        });
        Ok(Pose {
            bodies: bodies.collect(),
            joints: series.joints.iter().map(|j| j.jet()).collect(),
        })
    }

    fn closes(&self, series: &Series<4>, input: f64) -> Result<(), LinkageError> {
        for (dyad, &room) in series.room.iter().enumerate() {
            if room == 0.0 && !self.is_prp(dyad) {
                return Err(LinkageError::Flat { dyad, input });
            }
            if room <= 0.0 || room.is_nan() {
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

    pub(super) fn dyads(&self) -> impl Iterator<Item = &Step> {
        self.steps.iter().filter(|step| step.is_dyad())
    }

    fn is_prp(&self, dyad: usize) -> bool {
        matches!(
            self.dyads().nth(dyad),
            Some(Step::Prp { .. } | Step::Rpp { .. })
        )
    }

    /// Distance that is missing for a dyad to close, mm; infinite for parallel guides.
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

    /// Pose as series of order N - 1; where a dyad does not close, the joints that depend on it are NaN.
    pub(super) fn series<const N: usize>(&self, input: f64) -> Series<N> {
        let mut series = Series::default();
        self.find(input, |_| true, &mut series);
        series
    }

    /// Computes the series of all needed parts, at one input or at several side by side.
    pub(super) fn find<const N: usize, T: Number>(
        &self,
        input: T,
        needed: impl Fn(SeriesItem) -> bool,
        s: &mut Series<N, T>,
    ) {
        let still = PointSeries::fixed(Point::origin());
        s.joints.restart();
        s.frames.restart();
        s.room.restart();
        let along = PointSeries::fixed(Point::new(1.0, 0.0));
        s.frames.push((still, along));
        for (number, step) in self.steps.iter().enumerate() {
            if !needed(SeriesItem::Step(number)) {
                let [links, joints] = step.makes();
                for _ in 0..links {
                    if needed(SeriesItem::Base(s.frames.next())) {
                        s.frames.push((still, along));
                    } else {
                        s.frames.leave((still, still));
                    }
                }
                (0..joints).for_each(|_| s.joints.leave(still));
                continue;
            }
            match step {
                Step::Point { link, local } => {
                    let (origin, axis) = s.frames[*link];
                    s.joints.push(origin.plus(axis.turned(*local)));
                }
                Step::Crank { pivot, phase } => {
                    let axis = PointSeries::turning(input + T::from(*phase));
                    s.frames.push((s.joints[*pivot], axis));
                }
                Step::Turning { pivot, law } => {
                    let (_, axis) = s.frames[self.owners[*pivot]];
                    let turn = PointSeries::unit(Series::<N, T>::law(law.as_ref(), input));
                    s.frames.push((s.joints[*pivot], axis.times_unit(turn)));
                }
                Step::Sliding { line, law } => {
                    let (u, e) = s.line(line);
                    let along = Series::<N, T>::law(law.as_ref(), input);
                    s.frames.push((u.plus(e.times(along)), e));
                }
                Step::Fixed { line } => {
                    let frame = s.line(line);
                    s.frames.push(frame);
                }
                Step::Rrr {
                    p,
                    q,
                    lengths,
                    branch,
                    ..
                } => {
                    let (p, q) = (s.joints[*p], s.joints[*q]);
                    let Closed { at, room } = rrr(p, q, *lengths, *branch);
                    for (end, length) in [(p, lengths.0), (q, lengths.1)] {
                        if needed(SeriesItem::Frame(s.frames.next())) {
                            s.frames.push((end, at.minus(end).times(1.0 / length)));
                        } else {
                            s.frames.leave((still, still));
                        }
                    }
                    s.joints.push(at);
                    s.room.push(room);
                }
                Step::Rrp {
                    p,
                    length,
                    line,
                    branch,
                    ..
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
                    ..
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
    }
}
