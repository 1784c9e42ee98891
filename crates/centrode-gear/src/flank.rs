use centrode_geometry::{Point, Vector, bracketed_root, checkpoint};

use super::{
    rolling::{Frame, Member, Rolling},
    tool::{Corner, Tool, ToolKind},
};

/// Side of a tooth, by the order in which flanks mesh.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum Side {
    /// The flank reached first, in the order the teeth mesh.
    Leading,
    /// The flank reached last.
    Trailing,
}

impl Side {
    /// Sign of the arc length from the tooth's middle to this flank.
    pub(crate) fn sign(self) -> f64 {
        match self {
            Self::Leading => -1.0,
            Self::Trailing => 1.0,
        }
    }

    /// The other side, which meshes with this one.
    pub(crate) fn other(self) -> Self {
        match self {
            Self::Leading => Self::Trailing,
            Self::Trailing => Self::Leading,
        }
    }
}

/// Maximum length rolled up to a height, relative to that of a rack. A smaller one misses the height on strongly curved
/// pitch curves, a larger one can reach another tooth.
const FARTHEST: f64 = 4.0;

/// The exact flank, fillet, tip and root curves about one crossing of a pitch curve.
///
/// While the pitch curve rolls on the tool's pitch line, the contact point of the straight flank that
/// crosses at arc length `s_j` is the foot of the perpendicular from the pitch point P:
/// Q(s) = P + (`s_j` - s) cos alpha (cos alpha T + sigma sin alpha N), with speed
/// sin alpha + sigma kappa (`s_j` - s) cos alpha along e = sin alpha T - sigma cos alpha N. The flank is
/// regular while that speed is positive; it is undercut where the speed ends below the pitch curve.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Flank<'a> {
    pub(crate) rolling: &'a Rolling,
    pub(crate) member: Member,
    pub(crate) tool: &'a Tool,
    pub(crate) side: Side,
    /// Arc length where the flank crosses the pitch curve.
    pub(crate) crossing: f64,
}

impl Flank<'_> {
    pub(crate) fn frame(&self, t: f64) -> Frame {
        self.rolling.frame(self.member, t)
    }

    /// Point of the flank generated at a parameter.
    pub(crate) fn point(&self, t: f64) -> Point {
        self.point_in(&self.frame(t))
    }

    pub(crate) fn point_in(&self, frame: &Frame) -> Point {
        let (sin, cos) = self.tool.pressure_angle.sin_cos();
        let line = frame.tangent * cos + frame.normal * (self.side.sign() * sin);
        frame.point + line * ((self.crossing - frame.arc) * cos)
    }

    /// Length of flank made per arc length rolled, along [`Self::direction`].
    pub(crate) fn speed_in(&self, frame: &Frame) -> f64 {
        let (sin, cos) = self.tool.pressure_angle.sin_cos();
        sin + self.side.sign() * frame.curvature * (self.crossing - frame.arc) * cos
    }

    fn direction(&self, frame: &Frame) -> Vector {
        let (sin, cos) = self.tool.pressure_angle.sin_cos();
        frame.tangent * sin - frame.normal * (self.side.sign() * cos)
    }

    /// First parameter between `from` and `to` at which the flank's generation speed is below `minimum` times that of a straight
    /// rack.
    pub(crate) fn slower(&self, minimum: f64, from: f64, to: f64) -> Option<f64> {
        let mut ends = vec![from];
        ends.extend(self.rolling.breaks_between(from, to));
        ends.push(to);
        ends.windows(2)
            .find_map(|pair| self.slower_between(minimum, pair[0], pair[1]))
    }

    /// [`slower`](Self::slower) between breaks of the pitch curve. Samples the speed at steps that are short compared with the
    /// length that a tooth rolls, and near a step that is slower than its neighbours also at the minimum speed.
    fn slower_between(&self, minimum: f64, a: f64, b: f64) -> Option<f64> {
        /// Steps per length that a rack rolls from the pitch line to its tip; also the minimum number of steps. Fewer
        /// can step over a short slow part, more take longer.
        const STEPS: f64 = 12.0;
        let (sin, cos) = self.tool.pressure_angle.sin_cos();
        let floor = minimum * sin;
        let speed = |t: f64| self.speed_in(&self.frame(t)) - floor;
        let inward = if b > a { b.next_down() } else { b };
        let start = if b > a { a } else { a.next_down() };
        let [first, last] = [start, inward].map(|t| self.frame(t));
        let whole = self.speed_in(&first) - floor;
        if whole <= 0.0 {
            return Some(a);
        }
        let rolled = (last.arc - first.arc).abs() * sin * cos / self.tool.addendum;
        let steps = (STEPS * rolled.clamp(1.0, 16.0)).ceil() as u32;
        let root =
            |from: (f64, f64), to: (f64, f64)| bracketed_root(speed, from.0, to.0, from.1, to.1);
        let mut before = [(start, whole); 2];
        for i in 1..=steps {
            checkpoint();
            let t = if i == steps {
                inward
            } else {
                a + (b - a) * f64::from(i) / f64::from(steps)
            };
            let now = (t, speed(t));
            let [(_, earlier), (middle, slow)] = before;
            // Between these three steps the speed may fall below the floor and rise again.
            let bend = earlier - 2.0 * slow + now.1;
            let lowest = middle + 0.5 * (t - middle) * (earlier - now.1) / bend;
            if i > 1 && slow <= earlier && slow <= now.1 && lowest.is_finite() {
                let minimum = (lowest, speed(lowest));
                if minimum.1 <= 0.0 {
                    let is_beyond = (lowest - middle) * (b - a) > 0.0;
                    return Some(root(before[usize::from(is_beyond)], minimum));
                }
            }
            if now.1 <= 0.0 {
                return Some(root(before[1], now));
            }
            before = [before[1], now];
        }
        None
    }

    /// Height of the point generated at an arc length, above the pitch point at which it was generated.
    pub(crate) fn height(&self, arc: f64) -> f64 {
        let (sin, cos) = self.tool.pressure_angle.sin_cos();
        self.side.sign() * (self.crossing - arc) * sin * cos
    }

    /// Point of the fillet, the envelope of the tool's rounded corner.
    pub(crate) fn fillet(&self, corner: &Corner, t: f64) -> Point {
        let frame = self.frame(t);
        let offset = self.corner_center(corner, &frame);
        frame.point + offset * (1.0 + corner.radius / offset.norm())
    }

    /// Centre of the tool's rounding from the pitch point.
    fn corner_center(&self, corner: &Corner, frame: &Frame) -> Vector {
        let [ahead, above] = self.center_offset(corner, frame.arc).0;
        frame.tangent * ahead + frame.normal * above
    }

    /// Distances by which the centre of the tool's rounding is ahead of and above the pitch point at an arc length, and the angle
    /// by which the tool is turned there.
    fn center_offset(&self, corner: &Corner, arc: f64) -> ([f64; 2], f64) {
        let ahead = self.crossing + self.side.sign() * corner.center - arc;
        let straight = corner.depth - corner.radius;
        match self.tool.kind {
            ToolKind::Rack => ([ahead, -straight], 0.0),
            ToolKind::Shaper { radius } => {
                let turn = ahead / radius;
                let (sin, cos) = turn.sin_cos();
                let center = radius + straight;
                ([center * sin, radius - center * cos], turn)
            }
        }
    }

    /// Distance by which a point is outside the rounding of the tool's corner, between the flank and the tip of the tool;
    /// negative elsewhere. The point is given by its distances ahead of and above the pitch point.
    pub(crate) fn beyond_corner(&self, corner: &Corner, arc: f64, point: [f64; 2]) -> f64 {
        let (center, turn) = self.center_offset(corner, arc);
        let offset = Vector::new(point[0] - center[0], point[1] - center[1]);
        // In the axes of the tool, with its flank on the left and its tip below.
        let (sin, cos) = turn.sin_cos();
        let across = self.side.sign() * (cos * offset.x + sin * offset.y);
        let below = sin * offset.x - cos * offset.y;
        let (sin, cos) = self.tool.corner_angle(corner).sin_cos();
        match across <= 0.0 && below >= 0.0 && across * sin + below * cos >= 0.0 {
            true => offset.norm() - corner.radius,
            false => -corner.radius,
        }
    }

    /// Estimate by the circle that osculates the pitch curve at the crossing, whose flank is an involute: arc lengths at which
    /// the flank reaches a height, and of the foot of the normal there. With d rolled,
    /// (1 + k d cos sin)^2 + (k d cos^2)^2 = (1 + k h)^2.
    fn about_height(&self, height: f64) -> (f64, f64) {
        let (sin, cos) = self.tool.pressure_angle.sin_cos();
        let curvature = self.frame(self.rolling.parameter(self.crossing)).curvature;
        let rise = height * (2.0 + curvature * height);
        let root = (sin * sin + curvature * rise).sqrt();
        // The flank of a concave circle may end below the height: then a straight pitch line is used.
        let (curvature, rolled) = if root.is_nan() {
            (0.0, height / (sin * cos))
        } else {
            (curvature, rise / (cos * (sin + root)))
        };
        let (along, up) = (rolled * cos * cos, rolled * cos * sin);
        let turn = (curvature * along).atan2(1.0 + curvature * up);
        let back = if turn == 0.0 { along } else { turn / curvature };
        let sign = self.side.sign();
        let arc = self.crossing - sign * rolled;
        (arc, arc + sign * back)
    }

    /// Parameters at which the flank reaches a normal distance `height` from the pitch curve: of the flank and of the foot of
    /// that normal. `None` if the flank turns back before or does not reach this height.
    pub(crate) fn at_height(&self, height: f64) -> Option<(f64, f64)> {
        let start = self.rolling.parameter(self.crossing);
        let is_ahead = |t: f64| {
            let rolled = self.side.sign() * (self.crossing - self.rolling.arc_length(t));
            rolled * height >= 0.0 && self.slower(0.0, start, t).is_none()
        };
        let found = self.near_height(height);
        found
            .filter(|(t, _)| is_ahead(*t))
            .or_else(|| self.first_at_height(height, start))
    }

    /// Parameter up to which the flank is followed to a height: [`FARTHEST`] times the length that a rack rolls.
    pub(crate) fn farthest(&self, height: f64) -> f64 {
        let (sin, cos) = self.tool.pressure_angle.sin_cos();
        let rolled = FARTHEST * height / (sin * cos);
        self.rolling
            .parameter(self.crossing - self.side.sign() * rolled)
    }

    /// [`at_height`](Self::at_height) by samples of the height along the flank, if Newton's method finds no suitable point.
    fn first_at_height(&self, height: f64, start: f64) -> Option<(f64, f64)> {
        /// Number of samples of the height along the flank. Fewer can miss the first point at the height, more take
        /// longer.
        const SAMPLES: u32 = 48;
        let far = self.farthest(height);
        let end = self.slower(0.0, start, far).unwrap_or(far);
        // By the shortest of all normals: its length has no jumps.
        let short = |t: f64| {
            let above = self.nearest_foot(t).map_or(f64::NAN, |(_, above)| above);
            (height - above) * height.signum()
        };
        let mut before = (start, height.abs());
        for i in 1..=SAMPLES {
            checkpoint();
            let t = start + (end - start) * f64::from(i) / f64::from(SAMPLES);
            // The shortest normal is at most as long as the one that `foot` finds faster, unless that foot is out of reach.
            let (foot, above) = self.foot(t);
            let [at, under] = [t, foot].map(|t| self.rolling.arc_length(t));
            let room = height.abs() - above.abs();
            let now = if room > 0.0 && (under - at).abs() <= self.reach(at) {
                room
            } else {
                short(t)
            };
            // A point without a normal has no height.
            if now.is_nan() {
                continue;
            }
            if now <= 0.0 {
                let t = bracketed_root(short, before.0, t, before.1, now);
                return self.nearest_foot(t).map(|(foot, _)| (t, foot));
            }
            before = (t, now);
        }
        None
    }

    /// [`at_height`](Self::at_height) by Newton's method; `None` where it leaves the neighbourhood.
    fn near_height(&self, height: f64) -> Option<(f64, f64)> {
        let (sin, cos) = self.tool.pressure_angle.sin_cos();
        let (arc, foot) = self.about_height(height);
        let (mut t, mut tau) = (self.rolling.parameter(arc), self.rolling.parameter(foot));
        // Half a turn away the point would belong to another tooth, or again to this one.
        let turn = self.rolling.pitch_length(self.member);
        let reach = (FARTHEST * height.abs() / (sin * cos)).min(0.5 * turn);
        let mut miss = f64::INFINITY;
        for _ in 0..40 {
            let (at, under) = (self.frame(t), self.frame(tau));
            if (at.arc - self.crossing).abs() > reach || (under.arc - self.crossing).abs() > reach {
                return None;
            }
            let gap = self.point_in(&at) - (under.point + under.normal * height);
            let along = self.direction(&at) * (self.speed_in(&at) * at.speed);
            let across = under.tangent * (-(1.0 + under.curvature * height) * under.speed);
            let area = along.perp(&across);
            let dt = -gap.perp(&across) / area;
            let dtau = -along.perp(&gap) / area;
            if !(dt.is_finite() && dtau.is_finite()) {
                return None;
            }
            t += dt;
            tau += dtau;
            // A further step would be below the rounding of a double.
            miss = gap.norm() / at.point.coords.norm();
            if miss < 1e-14 {
                break;
            }
        }
        (miss < 1e-12).then_some((t, tau))
    }

    /// Foot of the normal from the flank's point at `t` to the pitch curve: its parameter and the
    /// signed distance.
    pub(crate) fn foot(&self, t: f64) -> (f64, f64) {
        let (_, cos) = self.tool.pressure_angle.sin_cos();
        let at = self.frame(t);
        let point = self.point_in(&at);
        let limit = self.tool.addendum + self.tool.dedendum;
        let mut tau = self
            .rolling
            .parameter(at.arc + (self.crossing - at.arc) * cos * cos);
        let mut last = f64::INFINITY;
        for _ in 0..40 {
            let under = self.frame(tau);
            let offset = point - under.point;
            let height = offset.dot(&under.normal);
            let step = offset.dot(&under.tangent) / (1.0 + under.curvature * height);
            if !step.is_finite() {
                break;
            }
            tau += step.clamp(-limit, limit) / under.speed;
            last = step.abs();
            if last <= 1e-15 * limit {
                break;
            }
        }
        let found = (tau, self.height_over(tau, &point));
        // Far from the axis rounding keeps the steps above the first limit, but the foot is the same.
        if last <= 1e-9 * limit {
            return found;
        }
        self.nearest_foot(t).unwrap_or(found)
    }

    /// Foot of the shortest normal from the flank's point at `t` to the pitch curve near it, and the signed distance.
    pub(crate) fn nearest_foot(&self, t: f64) -> Option<(f64, f64)> {
        let at = self.frame(t);
        let point = self.point_in(&at);
        let tau = self.nearest(&point, at.arc, self.reach(at.arc))?;
        Some((tau, self.height_over(tau, &point)))
    }

    /// Maximum arc length from the pitch point at which a flank point is generated to the foot of its shortest normal. The
    /// distance to that pitch point is at most the length rolled, so that a nearer foot is close to it.
    fn reach(&self, arc: f64) -> f64 {
        let limit = self.tool.addendum + self.tool.dedendum;
        let reach = 2.0 * (limit + (self.crossing - arc).abs());
        reach.min(0.5 * self.rolling.pitch_length(self.member))
    }

    /// Height of a point over the tangent at a parameter of the pitch curve.
    fn height_over(&self, tau: f64, point: &Point) -> f64 {
        let under = self.frame(tau);
        (point - under.point).dot(&under.normal)
    }

    /// Foot of the shortest normal from a point to the pitch curve, at most `reach` from an arc length.
    fn nearest(&self, point: &Point, arc: f64, reach: f64) -> Option<f64> {
        /// Number of samples along the pitch curve. Fewer can miss a short normal, more take longer.
        const SAMPLES: u32 = 96;
        let ahead = |tau: f64| {
            let under = self.frame(tau);
            (point - under.point).dot(&under.tangent)
        };
        let [first, last] = [arc - reach, arc + reach].map(|arc| self.rolling.parameter(arc));
        let at = |i: u32| first + (last - first) * f64::from(i) / f64::from(SAMPLES);
        let places: Vec<(f64, f64)> = (0..=SAMPLES).map(|i| (at(i), ahead(at(i)))).collect();
        let feet = places.windows(2).filter_map(|pair| {
            let [(a, before), (b, after)] = [pair[0], pair[1]];
            checkpoint();
            (before >= 0.0 && after < 0.0).then(|| bracketed_root(ahead, a, b, before, after))
        });
        feet.min_by(|a, b| {
            let [a, b] = [a, b].map(|tau| self.height_over(*tau, point).abs());
            a.total_cmp(&b)
        })
    }
}
