use centrode_geometry::{Point, Tolerance, Vector};
use nalgebra::{Isometry2, Rotation2};

/// Pose of a body at an input, and its derivative by the input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoseJet {
    /// Position of the body frame's origin, mm.
    pub position: Point,
    /// Turned angle, rad, continuous over the cycle.
    pub angle: f64,
    /// Derivative of the position, mm/rad.
    pub velocity: Vector,
    /// Derivative of the angle, rad/rad.
    pub turning: f64,
}

impl PoseJet {
    /// Rigid motion from the body's frame to the common frame.
    #[must_use]
    pub fn isometry(&self) -> Isometry2<f64> {
        Isometry2::new(self.position.coords, self.angle)
    }

    /// Whether lengths computed from the pose are finite.
    pub(super) fn is_finite(&self) -> bool {
        let values = [
            self.position.coords,
            self.velocity,
            Vector::new(self.angle, self.turning),
        ];
        values.iter().all(|v| v.norm_squared().is_finite())
    }
}

/// Upper bounds of the derivatives of a body's pose within an interval of the input.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bend {
    /// Maximum length of the second derivative of the position, mm/rad^2.
    pub acceleration: f64,
    /// Maximum size of the first derivative of the angle.
    pub turning: f64,
    /// Maximum size of the second derivative of the angle, 1/rad.
    pub turning_change: f64,
}

impl Bend {
    /// Maximum second derivative of the position of a point at a distance from the frame's origin.
    pub(super) fn of_point(&self, distance: f64) -> f64 {
        // Second derivative of a point at r: p'' + angle'' x r - angle'^2 r.
        self.acceleration + distance * self.turning_change.hypot(self.turning * self.turning)
    }

    pub(super) fn greater(self, other: Self) -> Self {
        Self {
            acceleration: self.acceleration.max(other.acceleration),
            turning: self.turning.max(other.turning),
            turning_change: self.turning_change.max(other.turning_change),
        }
    }
}

/// The pose of a rigid body as a function of the machine's input.
pub trait Motion: std::fmt::Debug {
    /// Pose and its exact derivative.
    fn at(&self, input: f64) -> PoseJet;

    /// Bounds of the derivatives between two inputs.
    ///
    /// The lower bound of a clearance is proven if these bounds are.
    fn bend(&self, from: f64, to: f64) -> Bend;

    /// Maximum deviation from the exact motion: of the origin, mm, and of the angle, rad.
    fn deviation(&self) -> (f64, f64) {
        (0.0, 0.0)
    }
}

/// A body at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rest(pub Isometry2<f64>);

impl Motion for Rest {
    fn at(&self, _: f64) -> PoseJet {
        PoseJet {
            position: self.0.translation.vector.into(),
            angle: self.0.rotation.angle(),
            velocity: Vector::zeros(),
            turning: 0.0,
        }
    }

    fn bend(&self, _: f64, _: f64) -> Bend {
        Bend::default()
    }
}

/// A body that turns about its origin while the origin moves along a straight line, both at constant speed.
///
/// Examples are a planted seedling in the frame of a moving machine, and a bar on a shaft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uniform {
    /// Pose at the input 0.
    pub start: Isometry2<f64>,
    /// Velocity of the origin, mm/rad.
    pub velocity: Vector,
    /// Turn per radian of the input.
    pub turning: f64,
}

impl Motion for Uniform {
    fn at(&self, input: f64) -> PoseJet {
        PoseJet {
            position: Point::from(self.start.translation.vector + self.velocity * input),
            angle: self.start.rotation.angle() + self.turning * input,
            velocity: self.velocity,
            turning: self.turning,
        }
    }

    fn bend(&self, _: f64, _: f64) -> Bend {
        Bend {
            turning: self.turning.abs(),
            ..Bend::default()
        }
    }
}

/// Motion sampled at equal steps of the input and interpolated by cubics with the same velocities (Hermite).
///
/// Bounds of the cubics are exact, so a clearance is proven for them. Their deviation from the motion is measured in the
/// middle of every cell, doubled, and subtracted from the bound. For a smooth motion it falls with the fourth power of the
/// cell length.
#[derive(Clone, Debug)]
pub struct Tabulated {
    pub(super) start: f64,
    cell: f64,
    jets: Vec<PoseJet>,
    /// `bends[k][i]` bounds the cells `i .. i + 2^k`.
    bends: Vec<Vec<Bend>>,
    deviation: (f64, f64),
}

/// Initial number of cells of a table within a tolerance. Fewer can miss a short motion, more take longer.
const FEWEST: usize = 360;
/// Maximum number of cells of a table: limits its memory and time. Then the table can deviate by more than the
/// tolerance.
const MOST: usize = 360 << 8;

/// Reason why a motion cannot be tabulated.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MotionError {
    /// Inputs that are not finite or do not ascend.
    #[error("inputs must be finite and ascending, not {from} to {to} rad")]
    Inputs {
        /// First input, rad.
        from: f64,
        /// Last input, rad.
        to: f64,
    },
    /// No cells, or more than 1,000,000.
    #[error("a motion needs 1 to 1000000 cells, not {0}")]
    Cells(usize),
    /// A pose that is not finite.
    #[error("the pose at the input {input} rad is not a finite number")]
    NotFinite {
        /// Input, rad.
        input: f64,
    },
}

impl Tabulated {
    /// Samples `motion` at the ends of `cells` equal parts of the interval `inputs`.
    ///
    /// # Errors
    /// [`MotionError`] for an empty interval, an invalid number of cells, or a pose that is not finite.
    pub fn new(
        inputs: [f64; 2],
        cells: usize,
        mut motion: impl FnMut(f64) -> PoseJet,
    ) -> Result<Self, MotionError> {
        ascending(inputs)?;
        if !(1..=1_000_000).contains(&cells) {
            return Err(MotionError::Cells(cells));
        }
        let mut read = reader(&mut motion);
        let (start, cell, jets) = ends(inputs, cells, &mut read)?;
        Ok(Self::through(start, cell, jets, &mut read)?.0)
    }

    /// The table of poses at the ends of cells, and the poses in the middle of every cell, from which its deviation is
    /// measured.
    fn through(
        start: f64,
        cell: f64,
        jets: Vec<PoseJet>,
        read: &mut impl FnMut(f64) -> Result<PoseJet, MotionError>,
    ) -> Result<(Self, Vec<PoseJet>), MotionError> {
        let bends = windows(jets.windows(2).map(|pair| bend(pair, cell)).collect());
        let mut table = Self {
            start,
            cell,
            jets,
            bends,
            deviation: (0.0, 0.0),
        };
        let mut middles = Vec::with_capacity(table.jets.len());
        for i in 0..table.jets.len() - 1 {
            let input = start + cell * (i as f64 + 0.5);
            let (ours, theirs) = (table.at(input), read(input)?);
            let (far, turned) = &mut table.deviation;
            *far = far.max(2.0 * (ours.position - theirs.position).norm());
            *turned = turned.max(2.0 * (ours.angle - theirs.angle).abs());
            middles.push(theirs);
        }
        Ok((table, middles))
    }

    /// Samples `motion` at steps so small that every point within `reach` (mm) of the frame's origin deviates by at most the
    /// tolerance, or at the maximum number of steps.
    ///
    /// # Errors
    /// [`MotionError`] for an empty interval or a pose that is not finite.
    pub fn within(
        inputs: [f64; 2],
        reach: f64,
        mut motion: impl FnMut(f64) -> PoseJet,
        tolerance: Tolerance,
    ) -> Result<Self, MotionError> {
        ascending(inputs)?;
        let mut read = reader(&mut motion);
        let (start, mut cell, jets) = ends(inputs, FEWEST, &mut read)?;
        let (mut table, mut middles) = Self::through(start, cell, jets, &mut read)?;
        loop {
            let (far, turned) = table.deviation;
            if far + turned * reach <= tolerance.mm() || middles.len() >= MOST {
                return Ok(table);
            }
            // The middles become ends of cells of half the length.
            let between = middles.into_iter().map(Some).chain([None]);
            let jets = table.jets.into_iter().zip(between);
            let jets = jets.flat_map(|(end, middle)| [Some(end), middle]).flatten();
            cell *= 0.5;
            (table, middles) = Self::through(start, cell, jets.collect(), &mut read)?;
        }
    }

    /// Length from the first input to the last.
    pub(super) fn length(&self) -> f64 {
        self.cell * (self.jets.len() - 1) as f64
    }

    fn cell_of(&self, input: f64) -> usize {
        // Saturates below the first cell.
        (((input - self.start) / self.cell) as usize).min(self.jets.len() - 2)
    }
}

/// The motion, with an error for a pose that is not finite.
fn reader(
    motion: &mut impl FnMut(f64) -> PoseJet,
) -> impl FnMut(f64) -> Result<PoseJet, MotionError> {
    |input| {
        let jet = motion(input);
        if jet.is_finite() {
            Ok(jet)
        } else {
            Err(MotionError::NotFinite { input })
        }
    }
}

/// First input and length of equal cells, and the poses at their ends.
fn ends(
    inputs: [f64; 2],
    cells: usize,
    mut read: impl FnMut(f64) -> Result<PoseJet, MotionError>,
) -> Result<(f64, f64, Vec<PoseJet>), MotionError> {
    let start = inputs[0];
    let cell = (inputs[1] - start) / cells as f64;
    let jets = (0..=cells).map(|i| read(start + cell * i as f64));
    Ok((start, cell, jets.collect::<Result<_, _>>()?))
}

pub(super) fn ascending([from, to]: [f64; 2]) -> Result<(), MotionError> {
    if from < to && from.is_finite() && to.is_finite() {
        Ok(())
    } else {
        Err(MotionError::Inputs { from, to })
    }
}

impl Motion for Tabulated {
    fn at(&self, input: f64) -> PoseJet {
        let i = self.cell_of(input);
        let (a, b, h) = (&self.jets[i], &self.jets[i + 1], self.cell);
        let t = (input - self.start) / h - i as f64;
        let s = 1.0 - t;
        // Cubic Hermite polynomials and their derivatives by t.
        let [end, rise, fall] = [t * t * (3.0 - 2.0 * t), t * s * s, -t * t * s];
        let [slope, up, down] = [6.0 * t * s, s * (1.0 - 3.0 * t), t * (3.0 * t - 2.0)];
        let (way, turn) = (b.position - a.position, b.angle - a.angle);
        PoseJet {
            position: a.position + way * end + (a.velocity * rise + b.velocity * fall) * h,
            angle: a.angle + turn * end + (a.turning * rise + b.turning * fall) * h,
            velocity: way * (slope / h) + a.velocity * up + b.velocity * down,
            turning: turn * (slope / h) + a.turning * up + b.turning * down,
        }
    }

    fn bend(&self, from: f64, to: f64) -> Bend {
        let (first, last) = (self.cell_of(from), self.cell_of(to));
        let level = (last - first + 1).ilog2() as usize;
        let row = &self.bends[level];
        row[first].greater(row[last + 1 - (1 << level)])
    }

    fn deviation(&self) -> (f64, f64) {
        self.deviation
    }
}

/// Bounds of one cubic: its second derivative is linear, its first lies between its Bezier points.
fn bend(pair: &[PoseJet], h: f64) -> Bend {
    let (a, b) = (&pair[0], &pair[1]);
    let mean = (b.position - a.position) / h;
    let ends = [
        (mean * 3.0 - a.velocity * 2.0 - b.velocity) * (2.0 / h),
        (b.velocity * 2.0 + a.velocity - mean * 3.0) * (2.0 / h),
    ];
    let rate = (b.angle - a.angle) / h;
    let turned = [
        (3.0 * rate - 2.0 * a.turning - b.turning) * (2.0 / h),
        (2.0 * b.turning + a.turning - 3.0 * rate) * (2.0 / h),
    ];
    let middle = 3.0 * rate - a.turning - b.turning;
    Bend {
        acceleration: ends[0].norm().max(ends[1].norm()),
        turning: a.turning.abs().max(b.turning.abs()).max(middle.abs()),
        turning_change: turned[0].abs().max(turned[1].abs()),
    }
}

/// Bounds of every run of 1, 2, 4, ... cells.
fn windows(cells: Vec<Bend>) -> Vec<Vec<Bend>> {
    let count = cells.len();
    let mut levels = vec![cells];
    let mut width = 1;
    while 2 * width <= count {
        let below = &levels[levels.len() - 1];
        let row = (0..=count - 2 * width).map(|i| below[i].greater(below[i + width]));
        let row = row.collect();
        levels.push(row);
        width *= 2;
    }
    levels
}

/// Pose at one input, with its rotation for moving points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    pub(super) rotation: Rotation2<f64>,
    pub(super) jet: PoseJet,
}

impl Frame {
    pub(super) fn new(jet: PoseJet) -> Self {
        Self {
            rotation: Rotation2::new(jet.angle),
            jet,
        }
    }

    /// Position and velocity of a point of the body.
    pub(super) fn moved(&self, p: &Point) -> (Point, Vector) {
        let arm = self.rotation * p.coords;
        (self.jet.position + arm, self.velocity_at(arm))
    }

    /// Velocity of the body's point at `arm` from its origin, in the common frame.
    pub(super) fn velocity_at(&self, arm: Vector) -> Vector {
        self.jet.velocity + Vector::new(-arm.y, arm.x) * self.jet.turning
    }

    /// Map of a point of the common frame into the body's frame.
    pub(super) fn inside(&self, p: &Point) -> Point {
        Point::from(self.rotation.inverse() * (p - self.jet.position))
    }
}
