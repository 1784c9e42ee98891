use centrode_geometry::{Extreme, Point, Vector, maximum};

use super::{ShaftError, Traverse};
use centrode_kinematics::transmission::Transmission;
use centrode_spec::rule::positive;

/// Wall of the groove, by its side.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum Wall {
    /// Left of the direction of the slider, seen on the development.
    Left,
    /// Right of it.
    Right,
}

impl Wall {
    /// Both walls.
    pub const BOTH: [Self; 2] = [Self::Left, Self::Right];

    pub(crate) fn sign(self) -> f64 {
        match self {
            Self::Left => 1.0,
            Self::Right => -1.0,
        }
    }
}

/// The closed groove on the shaft, out and back.
///
/// The development of the shaft's surface has the arc `R theta` along x and the shaft's axis along y: the
/// centre line is `(R theta, s(theta))`. On the shaft itself the groove point of `theta` is at the
/// angle `theta` about z; the shaft turns by `-theta` and brings it before the slider, which keeps the
/// angle 0.
#[derive(Clone, Debug)]
pub struct Groove {
    traverse: Traverse,
    radius: f64,
    width: f64,
    depth: f64,
    tightest: Extreme,
}

impl Groove {
    /// Makes a groove of a width and depth (mm) in a shaft of the radius `radius` (mm).
    ///
    /// # Errors
    /// [`ShaftError`] where neighbouring turns run into one another, the groove reaches the axis, or a bend
    /// is tighter than half the width.
    pub fn new(
        traverse: Traverse,
        radius: f64,
        width: f64,
        depth: f64,
    ) -> Result<Self, ShaftError> {
        positive("radius", radius)?;
        positive("groove.width", width)?;
        positive("groove.depth", depth)?;
        if depth >= radius {
            return Err(ShaftError::GrooveDepth {
                depth,
                radius,
                limit: "the axis",
            });
        }
        let steepest = (traverse.law().fastest().value / radius).atan();
        let room = traverse.law().lead() * steepest.cos();
        if width >= room {
            return Err(ShaftError::GrooveWidth { width, room });
        }
        let mut groove = Self {
            traverse,
            radius,
            width,
            depth,
            tightest: Extreme {
                input: 0.0,
                value: 0.0,
            },
        };
        let bend = |theta: f64| groove.curvature(theta).abs();
        let tightest = maximum(bend, &groove.ends());
        if tightest.value * 0.5 * width >= 1.0 {
            return Err(ShaftError::Bend {
                radius: 1.0 / tightest.value,
                angle_deg: tightest.input.to_degrees(),
                width,
            });
        }
        groove.tightest = tightest;
        Ok(groove)
    }

    /// The slider's motion.
    #[must_use]
    pub fn traverse(&self) -> &Traverse {
        &self.traverse
    }

    /// Radius of the shaft, mm.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Width along the normal on the development, mm.
    #[must_use]
    pub fn width(&self) -> f64 {
        self.width
    }

    /// Depth below the shaft's surface, mm.
    #[must_use]
    pub fn depth(&self) -> f64 {
        self.depth
    }

    /// Shaft angles between which the motion is smooth and short: its breaks, tips and quarter turns.
    #[must_use]
    pub(crate) fn ends(&self) -> Vec<f64> {
        let period = self.traverse.period();
        let mut ends = self.traverse.breaks();
        ends.extend(self.traverse.tips().map(|tip| tip.rem_euclid(period)));
        let quarters = 4 * self.traverse.turns();
        ends.extend((0..=quarters).map(|i| period * f64::from(i) / f64::from(quarters)));
        ends.sort_by(f64::total_cmp);
        ends.dedup_by(|b, a| *b - *a <= 1e-12 * period);
        ends
    }

    /// Ends of the smooth and short parts between two shaft angles counted from the start of the forward stroke, both
    /// of them included, as shaft angles from [`Traverse::start`] on.
    pub(super) fn ends_between(&self, low: f64, high: f64) -> Vec<f64> {
        let slack = 1e-12 * self.traverse.period();
        let inside = self
            .ends()
            .into_iter()
            .map(|theta| self.traverse.since_start(theta));
        let mut ends: Vec<f64> = inside
            .filter(|gone| *gone > low + slack && *gone < high - slack)
            .chain([low, high])
            .map(|gone| self.traverse.start() + gone)
            .collect();
        ends.sort_by(f64::total_cmp);
        ends
    }

    /// Centre line on the development, mm, not wrapped round.
    #[must_use]
    pub fn center(&self, theta: f64) -> Point {
        Point::new(self.radius * theta, self.traverse.at(theta).position)
    }

    /// Lead angle, rad: `atan(s' / R)`, negative on the return stroke.
    #[must_use]
    pub fn lead_angle(&self, theta: f64) -> f64 {
        (self.traverse.at(theta).velocity / self.radius).atan()
    }

    /// Angle between the wall's normal and the slider's path along the shaft, rad: the lead angle without
    /// its sign.
    #[must_use]
    pub fn pressure_angle(&self, theta: f64) -> f64 {
        self.lead_angle(theta).abs()
    }

    /// Maximum pressure angle, rad, and the shaft angle of it.
    #[must_use]
    pub fn steepest(&self) -> Extreme {
        maximum(|theta| self.pressure_angle(theta), &self.ends())
    }

    /// A point next to the centre line at a normal distance on the development, mm: left for a positive one.
    #[must_use]
    pub fn beside(&self, theta: f64, distance: f64) -> Point {
        let slope = self.traverse.at(theta).velocity;
        let along = Vector::new(self.radius, slope).normalize();
        self.center(theta) + Vector::new(-along.y, along.x) * distance
    }

    /// A point of a wall on the development, mm: the exact offset by half the width.
    #[must_use]
    pub fn wall(&self, theta: f64, wall: Wall) -> Point {
        self.beside(theta, 0.5 * self.width * wall.sign())
    }

    /// Curvature of the centre line on the development, 1/mm: `R s'' / (R^2 + s'^2)^(3/2)`.
    #[must_use]
    pub fn curvature(&self, theta: f64) -> f64 {
        let motion = self.traverse.at(theta);
        let r = self.radius;
        r * motion.acceleration / r.hypot(motion.velocity).powi(3)
    }

    /// Maximum curvature of the development, 1/mm, without sign, and the shaft angle of it.
    #[must_use]
    pub fn tightest(&self) -> Extreme {
        self.tightest
    }

    /// Maximum curvature of the strokes without the reversals, 1/mm, without sign, and the shaft angle of it.
    #[must_use]
    pub fn tightest_of_stroke(&self) -> Extreme {
        let ends = self.ends_between(0.0, self.traverse.stroke());
        maximum(|theta| self.curvature(theta).abs(), &ends)
    }

    /// A point of the development on the shaft, mm.
    #[must_use]
    pub fn wrapped(&self, point: Point, radius: f64) -> [f64; 3] {
        let (sin, cos) = (point.x / self.radius).sin_cos();
        [radius * cos, radius * sin, point.y]
    }

    /// Point of the development for a point of the shaft, on the turn around `near` (mm along x).
    #[must_use]
    pub fn unwrapped(&self, [x, y, z]: [f64; 3], near: f64) -> Point {
        let turn = std::f64::consts::TAU;
        let angle = y.atan2(x);
        let turns = ((near / self.radius - angle) / turn).round();
        Point::new(self.radius * (angle + turns * turn), z)
    }

    /// A point of the wall that a cylindrical cutter of the groove's width cuts with its axis square to
    /// the shaft's, at the height `height` (mm from the shaft's axis along the cutter); exact envelope.
    ///
    /// The cutter touches where its normal is square to its velocity there, `(height, s')`. At the foot of the groove this wall
    /// is farther round the shaft than a radial wall below the same upper edge.
    #[must_use]
    pub fn cut_wall(&self, theta: f64, wall: Wall, height: f64) -> [f64; 3] {
        let motion = self.traverse.at(theta);
        let along = Vector::new(height, motion.velocity).normalize();
        let half = 0.5 * self.width * wall.sign();
        let (sin, cos) = theta.sin_cos();
        let round = -along.y * half;
        [
            height * cos - round * sin,
            height * sin + round * cos,
            motion.position + along.x * half,
        ]
    }

    /// Maximum distance, mm, between a radial wall and the wall that an end mill of the groove's width cuts. Both have the same
    /// edge on the surface; at the foot the mill makes the groove wider by this distance on each side.
    #[must_use]
    pub fn wall_deviation(&self) -> f64 {
        let apart = |theta: f64| {
            let slope = self.traverse.at(theta).velocity;
            let foot = self.radius - self.depth;
            // Both points on the foot's own development, along the normal of its curve.
            let half = 0.5 * self.width;
            let top = half / self.radius.hypot(slope);
            let radial = Vector::new(-slope * top / self.radius * foot, self.radius * top);
            let normal = Vector::new(-slope, foot).normalize();
            (half - radial.dot(&normal)).abs()
        };
        maximum(apart, &self.ends()).value
    }
}
