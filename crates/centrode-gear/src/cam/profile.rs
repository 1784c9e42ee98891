//! Contour of a cam: the envelope of its follower, cut as by a tool of the follower's size.

use std::f64::consts::{PI, TAU};

use centrode_geometry::{
    Arc, LoopError, Outline, Point, PolySegment, Segment, Tolerance, minimum, without_loops,
};

use super::disc::{CamError, DiscCam};

/// Maximum number of segments of a contour between two breaks of its motion; a usable cam has some tens.
const MOST: usize = 1024;

/// The contour of a cam, counter-clockwise.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    outline: Outline,
    inputs: Vec<(f64, f64)>,
    undercut: Vec<(f64, f64)>,
}

impl Profile {
    /// The contour.
    #[must_use]
    pub fn outline(&self) -> &Outline {
        &self.outline
    }

    /// Cam angles, rad, at which each segment of the contour starts and ends its contact.
    #[must_use]
    pub fn inputs(&self) -> &[(f64, f64)] {
        &self.inputs
    }

    /// Ranges of the cam angle, rad, whose contact is cut off: there the follower leaves its motion. Empty for a cam without
    /// undercut.
    #[must_use]
    pub fn undercut(&self) -> &[(f64, f64)] {
        &self.undercut
    }

    /// Whether the contact at a cam angle is cut off.
    #[must_use]
    pub fn is_undercut(&self, input: f64) -> bool {
        let within = |&(from, to): &(f64, f64)| (input - from).rem_euclid(TAU) <= to - from;
        self.undercut.iter().any(within)
    }

    /// Minimum and maximum distance from the axis, mm, at nine samples per segment.
    pub(super) fn radii(&self) -> (f64, f64) {
        let points = self.outline.segments().iter().flat_map(|segment| {
            (0..=8).map(|i| segment.at(-1.0 + 0.25 * f64::from(i)).point.coords.norm())
        });
        points.fold((f64::INFINITY, 0.0), |(minimum, maximum), r| {
            (r.min(minimum), r.max(maximum))
        })
    }
}

/// A part of the contour and the inputs of its ends.
#[derive(Clone, Copy, Debug)]
struct ContourSpan {
    segment: Segment,
    from: f64,
    to: f64,
}

impl ContourSpan {
    /// The part between two parameters of the segment.
    fn between(&self, from: f64, to: f64) -> Self {
        let input = |u: f64| self.from + 0.5 * (1.0 + u) * (self.to - self.from);
        Self {
            segment: self.segment.part(from, to),
            from: if from == -1.0 { self.from } else { input(from) },
            to: if to == 1.0 { self.to } else { input(to) },
        }
    }

    fn reversed(&self) -> Self {
        Self {
            segment: self.segment.reversed(),
            from: self.to,
            to: self.from,
        }
    }
}

impl DiscCam {
    /// The contour within a tolerance of the exact envelope: arcs over the dwells, polynomials of degree
    /// thirteen elsewhere.
    ///
    /// Where the envelope is singular it crosses itself. There the material is removed that a tool of the follower's size would
    /// remove, and [`Profile::undercut`] lists the cam angles at which the follower loses contact.
    ///
    /// # Errors
    /// [`CamError::Looped`] where no part of the contour remains, [`CamError::Unresolved`] where the crossings of the contour
    /// with itself cannot be determined, [`CamError::AxisOutside`] where it does not enclose the axis, [`CamError::Wild`] where
    /// it takes too many segments.
    pub fn profile(&self, tolerance: Tolerance) -> Result<Profile, CamError> {
        let whole = self.envelope(&|input| self.contact(input).point, &self.turns(), tolerance)?;
        let kept = sound(&whole, self.sense() > 0.0, tolerance)?;
        let ends = self.ends();
        let (first, last) = (ends[0], ends[ends.len() - 1]);
        let mut undercut: Vec<(f64, f64)> = Vec::new();
        for (index, part) in kept.iter().enumerate() {
            let next = kept.get(index + 1);
            let resumed = next.map_or(kept[0].from + (last - first), |next| next.from);
            if resumed > part.to {
                undercut.push((part.to, resumed));
            }
        }
        let (outline, inputs) = self.closed(kept)?;
        if !outline.contains(Point::origin()) {
            return Err(CamError::AxisOutside);
        }
        Ok(Profile {
            outline,
            inputs,
            undercut,
        })
    }

    /// The path of the roller's centre within a tolerance, counter-clockwise; `None` for a flat face.
    ///
    /// # Errors
    /// [`CamError::Open`] where a point of it is not a number, [`CamError::Wild`] where it takes too many segments.
    pub fn pitch_curve(&self, tolerance: Tolerance) -> Result<Option<Outline>, CamError> {
        if self.follower().roller_radius().is_none() {
            return Ok(None);
        }
        let center = |input: f64| {
            let nowhere = Point::new(f64::NAN, f64::NAN);
            self.roller_center(input).map_or(nowhere, |jet| jet.point)
        };
        let parts = self.envelope(&center, &self.ends(), tolerance)?;
        self.closed(parts).map(|(outline, _)| Some(outline))
    }

    /// Ends of the analytic parts, and in each undercut part the input of minimum regularity. The two halves of the loop there
    /// then belong to different parts, so that their crossing is found, however small the loop.
    fn turns(&self) -> Vec<f64> {
        let ends = self.ends();
        let mut turns = vec![ends[0]];
        for pair in ends.windows(2) {
            let middle = minimum(|input| self.contact(input).regularity, pair);
            let inside = middle.input > pair[0] && middle.input < pair[1].next_down();
            if middle.value <= 0.0 && inside {
                turns.push(middle.input);
            }
            turns.push(pair[1]);
        }
        turns
    }

    /// Chain of parts along one turn, in the order of the input.
    fn envelope(
        &self,
        curve: &dyn Fn(f64) -> Point,
        ends: &[f64],
        tolerance: Tolerance,
    ) -> Result<Vec<ContourSpan>, CamError> {
        let mut parts: Vec<ContourSpan> = Vec::new();
        for pair in ends.windows(2) {
            let (from, to) = (pair[0], pair[1]);
            if self.rests(from, to) {
                parts.extend(self.dwell(curve, from, to));
            } else {
                let fitted = PolySegment::fit_spans_at_most(MOST, curve, [from, to], tolerance);
                let fitted = fitted.ok_or(CamError::Wild {
                    degrees: from.to_degrees(),
                    most: MOST,
                })?;
                parts.extend(fitted.into_iter().map(|span| ContourSpan {
                    segment: Segment::Poly(span.poly),
                    from: span.from,
                    to: span.to,
                }));
            }
        }
        Ok(parts)
    }

    /// Whether the follower rests all the way between two breaks: between them the motion is analytic, so a few
    /// samples without any derivative prove it.
    fn rests(&self, from: f64, to: f64) -> bool {
        [0.1, 0.3, 0.6, 0.8].into_iter().all(|share| {
            let motion = self.motion().at(from + share * (to - from));
            (motion.velocity, motion.acceleration, motion.jerk) == (0.0, 0.0, 0.0)
        })
    }

    /// Arcs about the axis, of less than a third of a turn each.
    fn dwell(
        &self,
        curve: &dyn Fn(f64) -> Point,
        from: f64,
        to: f64,
    ) -> impl Iterator<Item = ContourSpan> {
        let count = ((to - from) / (0.6 * PI)).ceil().max(1.0);
        let step = (to - from) / count;
        // The limit from the right: the break at the end already belongs to the next part.
        let start = curve(from);
        let sense = self.sense();
        (0..count as u32).map(move |i| {
            let turned = |i: u32| {
                let (sin, cos) = (sense * step * f64::from(i)).sin_cos();
                Point::new(start.x * cos - start.y * sin, start.x * sin + start.y * cos)
            };
            let arc = Arc {
                start: turned(i),
                end: turned(i + 1),
                bulge: (0.25 * sense * step).tan(),
            };
            ContourSpan {
                segment: Segment::Arc(arc),
                from: from + step * f64::from(i),
                to: from + step * f64::from(i + 1),
            }
        })
    }

    /// Joins the parts exactly, end to start, into a counter-clockwise outline.
    fn closed(&self, mut parts: Vec<ContourSpan>) -> Result<(Outline, Vec<(f64, f64)>), CamError> {
        let count = parts.len();
        for i in 0..count {
            let end = parts[i].segment.end();
            let next = &mut parts[(i + 1) % count].segment;
            if next.start() != end {
                *next = moved_start(next, end);
            }
        }
        if self.sense() < 0.0 {
            parts = parts.iter().rev().map(ContourSpan::reversed).collect();
        }
        let outline = Outline::new(parts.iter().map(|part| part.segment).collect())?;
        let inputs = parts.iter().map(|part| (part.from, part.to)).collect();
        Ok((outline, inputs))
    }
}

/// The segment with another start: a correction of rounding.
fn moved_start(segment: &Segment, start: Point) -> Segment {
    match segment {
        Segment::Line(_, end) => Segment::Line(start, *end),
        Segment::Arc(arc) => Segment::Arc(Arc { start, ..*arc }),
        Segment::Poly(poly) => Segment::Poly(poly.pinned(start, poly.end())),
    }
}

/// Parts without their loops.
fn sound(
    parts: &[ContourSpan],
    counter_clockwise: bool,
    tolerance: Tolerance,
) -> Result<Vec<ContourSpan>, CamError> {
    let segments: Vec<Segment> = parts.iter().map(|part| part.segment).collect();
    let kept =
        without_loops(&segments, counter_clockwise, tolerance).map_err(|cause| match cause {
            LoopError::Everywhere => CamError::Looped,
            cause => CamError::Unresolved(cause),
        })?;
    let parts = kept.iter().map(|k| parts[k.index].between(k.from, k.to));
    Ok(parts.collect())
}
