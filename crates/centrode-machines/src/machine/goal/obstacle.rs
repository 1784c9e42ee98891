//! Obstacles of a composed machine: scenery that its bodies must clear.

use centrode_geometry::{Outline, Point};
use nalgebra::Isometry2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::machine::body::contour::Drawn;
use crate::machine::body::points::Reference;
use crate::machine::{Machine, MachineCircleSpec, MachineCornerSpec, MachineError, Mount};
use centrode_kinematics::machine::{JointKind, Line, LineRole, LinkedMachine, Surface};
use centrode_spec::SpecError;
use centrode_spec::rule::{Rule, broken, finite};

/// Size of the box that represents a half plane, relative to the reach of the machine.
const WIDE: f64 = 4.0;
/// Inputs per turn at which the width of the ground in the picture is sampled.
const SAMPLES: u32 = 90;

/// Scenery that is fixed to the frame or moves with a body: ground, a tray, a wall.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct MachineObstacleSpec {
    /// Body it moves with, or a point of one, `tray.corner`, from which its shape is measured; default: the frame.
    pub on: Option<String>,
    /// Corners of its shape in order, in the body's axes, mm.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub outline: Vec<MachineCornerSpec>,
    /// Radius to which its corners are rounded, mm.
    pub corner_radius: Option<f64>,
    /// Circle that it is.
    pub circle: Option<MachineCircleSpec>,
    /// Height of the ground, which fills all below it: y in the body's axes, mm.
    pub below: Option<f64>,
    /// Lower and upper end along the shafts, mm, the plate next to the frame from 0 on; default: all heights.
    pub heights: Option<[f64; 2]>,
}

/// Scenery of a composed machine.
#[derive(Clone, Debug)]
pub struct MachineObstacle {
    /// Name.
    pub name: String,
    /// Index of the body it moves with.
    pub body: usize,
    /// Shape of the obstacle in the body's axes; a half plane ends beyond the reach of the machine.
    pub outline: Outline,
    /// Lower and upper end along the shafts, mm.
    pub span: [f64; 2],
    /// Height of the upper side of a half plane, mm; `None` for any other shape.
    below: Option<f64>,
}

impl MachineObstacleSpec {
    pub(in crate::machine) fn validate(&self) -> Result<(), SpecError> {
        let drawn = self.drawn();
        drawn.validate()?;
        match self.below {
            Some(_) if drawn.is_given() => return broken("below", Rule::Excludes("a shape")),
            None if !drawn.is_given() => {
                return broken("outline", Rule::NeedsOneOf("outline, circle and below"));
            }
            _ => finite("below", self.below.unwrap_or(0.0))?,
        }
        let Some([low, high]) = self.heights else {
            return Ok(());
        };
        finite("heights", low)?;
        finite("heights", high)?;
        if low >= high {
            return broken("heights", Rule::NotInOrder(low, high));
        }
        Ok(())
    }

    fn drawn(&self) -> Drawn<'_> {
        Drawn {
            outline: &self.outline,
            corner_radius: self.corner_radius,
            circle: self.circle.as_ref(),
        }
    }
}

impl MachineObstacle {
    /// Surface of the obstacle, for clearances.
    #[must_use]
    pub fn surface(&self) -> Surface {
        Surface::new(self.name.clone(), self.outline.clone(), self.span)
    }
}

impl Machine {
    /// Obstacles in the order of their names.
    #[must_use]
    pub fn obstacles(&self) -> &[MachineObstacle] {
        &self.obstacles
    }

    /// The obstacles of the design.
    pub(in crate::machine) fn obstacles_of_design(
        &self,
    ) -> Result<Vec<MachineObstacle>, MachineError> {
        let obstacle = |(name, spec): (&String, &MachineObstacleSpec)| {
            let key = format!("obstacles.{name}");
            if self.body_named(name).is_some() {
                return Err(MachineError::refused(
                    key,
                    format!("there is also a body named {name}: a clearance could refer to either"),
                ));
            }
            let on = format!("{key}.on");
            let word = spec.on.as_deref().unwrap_or(crate::machine::design::FRAME);
            let reference = Reference::to_body(word);
            let at = reference.find(&on, &self.points)?;
            let body = self.body_named(&reference.body).unwrap_or(0);
            let below = spec.below.map(|below| below + at.y);
            let outline = match (below, spec.drawn().contour(&key)?) {
                (None, Some(outline)) => outline.transformed(&Isometry2::translation(at.x, at.y)),
                (below, _) => self.half_plane(below.unwrap_or(0.0)),
            };
            Ok(MachineObstacle {
                name: name.clone(),
                body,
                outline,
                span: spec.heights.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]),
                below,
            })
        };
        self.design.obstacles.iter().map(obstacle).collect()
    }

    /// The half plane below a height, mm, as a box that extends beyond the reach of the machine.
    fn half_plane(&self, below: f64) -> Outline {
        let size = WIDE * (self.reach() + below.abs());
        let corner = |x: f64, y: f64| Point::new(x, y);
        Outline::polygon(&[
            corner(-size, below - size),
            corner(size, below - size),
            corner(size, below),
            corner(-size, below),
        ])
    }

    /// Upper bound of the distance between a point of the machine and the origin of any of its bodies, mm.
    fn reach(&self) -> f64 {
        let mounts = self.bodies.iter().filter_map(|body| body.mount.as_ref());
        let way = |mount: &Mount| {
            let slide = match mount.kind {
                JointKind::Sliding([low, high]) => low.abs().max(high.abs()),
                _ => 0.0,
            };
            mount.at.coords.norm() + slide
        };
        let ways: f64 = mounts.map(way).sum();
        let far = |outline: &Outline| {
            let bounds = outline.bounds();
            bounds.min.coords.norm().max(bounds.max.coords.norm()) * std::f64::consts::SQRT_2
        };
        let plates = (0..self.bodies.len()).filter_map(|body| self.contours(body));
        let gears = self.gears.iter();
        let gears = gears.map(|gear| gear.at.coords.norm() + far(gear.gear().outline()));
        let widest = plates.map(|(outline, _)| far(&outline)).chain(gears);
        // From one body to the frame, and from the frame to the other body.
        2.0 * (ways + widest.fold(1.0, f64::max))
    }

    /// Draws the obstacles, which are not parts of the machine.
    pub(in crate::machine) fn draw_obstacles(&self, machine: &mut LinkedMachine) {
        for obstacle in &self.obstacles {
            let line = match obstacle.below {
                Some(below) => {
                    let [low, high] = self.width_seen(obstacle.body);
                    let ends = [Point::new(low, below), Point::new(high, below)];
                    Line::chain(LineRole::Adjacent, &ends)
                }
                None => Line::contour(LineRole::Adjacent, &obstacle.outline),
            };
            let sketch = machine.sketch(&obstacle.name, vec![line]);
            machine.draw(&obstacle.name, obstacle.body, sketch);
        }
    }

    /// Ends of the ground line of a body in the picture, mm: one plate width beyond all points of the machine.
    fn width_seen(&self, body: usize) -> [f64; 2] {
        let width = self.design.plates.width;
        let (mut low, mut high) = (-width, width);
        for i in 0..SAMPLES * self.design.input.turns {
            let input = self.period() * f64::from(i) / f64::from(SAMPLES * self.design.input.turns);
            let origin = self.place(body, Point::origin(), input);
            let turned = Isometry2::new(origin.coords, self.angle(body, input).position);
            for (_, point) in self.points() {
                let place = self.place(point.body, point.at, input);
                let seen = turned.inverse_transform_point(&place);
                low = low.min(seen.x - width);
                high = high.max(seen.x + width);
            }
        }
        [low, high]
    }
}
