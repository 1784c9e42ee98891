use centrode_geometry::Point;

use super::points::Reference;
use super::{Composed, ComposedError};

/// Grammar of the figures of a composed machine: form, meaning, unit as shown.
pub const FIGURE_FORMS: [[&str; 3]; 11] = [
    [
        "point.x",
        "x of a point: of body.point, or of a point whose name no other body has",
        "mm",
    ],
    ["point.y", "y of a point", "mm"],
    [
        "point.speed",
        "speed of a point at the design's speed",
        "mm/s",
    ],
    [
        "point.acceleration",
        "acceleration of a point at the design's speed",
        "m/s²",
    ],
    [
        "body.angle",
        "angle of a body against the frame, without jumps",
        "deg",
    ],
    [
        "body.angular_speed",
        "speed at which a body turns, at the design's speed",
        "rad/s",
    ],
    [
        "body.swing",
        "angle of a body against the one that carries it, on a pin",
        "deg",
    ],
    [
        "body.travel",
        "place of a body along the one that carries it, on a slide",
        "mm",
    ],
    ["transmission(dyad)", "transmission angle of a dyad", "deg"],
    [
        "distance(body.point, body.point)",
        "distance of two points",
        "mm",
    ],
    [
        "clearance(body, body)",
        "least clearance of the plates of two bodies that overlap in height, over the cycle",
        "mm",
    ],
];

/// A figure of a composed machine, found by its words.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ComposedFigure {
    /// A component of a point's motion.
    Point {
        /// Index of its body.
        body: usize,
        /// Place in the body's axes, mm.
        at: Point,
        /// The component.
        part: PointPart,
    },
    /// Angle of a body against the frame, rad.
    Angle(usize),
    /// Angular speed of a body at the design's speed, rad/s.
    AngularSpeed(usize),
    /// Coordinate of the pin that carries a body, rad.
    Swing(usize),
    /// Coordinate of the slide that carries a body, mm.
    Travel(usize),
    /// Transmission angle of a dyad, rad; its number in the order of closing.
    Transmission(usize),
    /// Distance of two points, mm: of each the index of its body and the place in its axes.
    Distance([(usize, Point); 2]),
    /// Least clearance of two bodies over the cycle, mm; their indices.
    Clearance([usize; 2]),
}

/// Component of a point's motion.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum PointPart {
    /// x, mm.
    X,
    /// y, mm.
    Y,
    /// Speed at the design's speed, mm/s.
    Speed,
    /// Acceleration at the design's speed, m/s².
    Acceleration,
}

impl Composed {
    /// Finds a figure by its words, as [`FIGURE_FORMS`] tells; `key` is that of the design which names it.
    ///
    /// # Errors
    /// [`ComposedError`] where there is no such figure.
    pub fn figure(&self, key: &str, words: &str) -> Result<ComposedFigure, ComposedError> {
        let none = || ComposedError::NoFigure {
            key: key.into(),
            words: words.into(),
            known: FIGURE_FORMS
                .iter()
                .map(|[form, ..]| (*form).into())
                .collect(),
        };
        if let Some((function, inside)) = words.split_once('(') {
            let inside = inside.strip_suffix(')').ok_or_else(none)?;
            let names: Vec<&str> = inside.split(',').map(str::trim).collect();
            return match (function.trim(), &names[..]) {
                ("transmission", [dyad]) => {
                    let found = self.dyads.iter().position(|d| d.name == *dyad);
                    found
                        .map(ComposedFigure::Transmission)
                        .ok_or_else(|| ComposedError::NoDyad {
                            key: key.into(),
                            dyad: (*dyad).into(),
                            known: self.dyads.iter().map(|d| d.name.clone()).collect(),
                        })
                }
                ("distance", [one, other]) => Ok(ComposedFigure::Distance([
                    self.point_of(key, one)?,
                    self.point_of(key, other)?,
                ])),
                ("clearance", [one, other]) => {
                    let bodies = [self.body_of(key, one)?, self.body_of(key, other)?];
                    if bodies[0] == bodies[1] {
                        return Err(none());
                    }
                    Ok(ComposedFigure::Clearance(bodies))
                }
                _ => Err(none()),
            };
        }
        let (of, part) = words.rsplit_once('.').ok_or_else(none)?;
        let parts = [
            ("x", PointPart::X),
            ("y", PointPart::Y),
            ("speed", PointPart::Speed),
            ("acceleration", PointPart::Acceleration),
        ];
        if let Some((_, part)) = parts.into_iter().find(|(word, _)| *word == part) {
            let (body, at) = self.point_of(key, of)?;
            return Ok(ComposedFigure::Point { body, at, part });
        }
        let kind = |body: usize| self.bodies[body].mount.as_ref().map(|mount| mount.kind);
        match part {
            "angle" => Ok(ComposedFigure::Angle(self.body_of(key, of)?)),
            "angular_speed" => Ok(ComposedFigure::AngularSpeed(self.body_of(key, of)?)),
            "swing" | "travel" => {
                let body = self.body_of(key, of)?;
                match (part, kind(body)) {
                    ("swing", Some(crate::machine::JointKind::Turning)) => {
                        Ok(ComposedFigure::Swing(body))
                    }
                    ("travel", Some(crate::machine::JointKind::Sliding(_))) => {
                        Ok(ComposedFigure::Travel(body))
                    }
                    _ => Err(none()),
                }
            }
            _ => Err(none()),
        }
    }

    /// Words of the figures of single points, bodies and dyads, for goals to name.
    #[must_use]
    pub fn figure_words(&self) -> Vec<String> {
        use crate::machine::JointKind;
        let all = |of: &str, parts: &[&str]| -> Vec<String> {
            parts.iter().map(|part| format!("{of}.{part}")).collect()
        };
        let moving = self.points().filter(|(_, body, _)| *body > 0);
        let of_points =
            moving.flat_map(|(name, ..)| all(&name, &["x", "y", "speed", "acceleration"]));
        let of_bodies = self.bodies.iter().skip(1).flat_map(|body| {
            let joint = match body.mount.as_ref().map(|mount| mount.kind) {
                Some(JointKind::Turning) => &["angle", "angular_speed", "swing"][..],
                Some(JointKind::Sliding(_)) => &["angle", "angular_speed", "travel"],
                _ => &["angle", "angular_speed"],
            };
            all(&body.name, joint)
        });
        let of_dyads = self.dyads.iter();
        let of_dyads = of_dyads.map(|dyad| format!("transmission({})", dyad.name));
        of_points.chain(of_bodies).chain(of_dyads).collect()
    }

    /// Index of a body that a key names.
    fn body_of(&self, key: &str, name: &str) -> Result<usize, ComposedError> {
        self.body_named(name).ok_or_else(|| ComposedError::NoBody {
            key: key.into(),
            body: name.into(),
            known: self.bodies.iter().map(|body| body.name.clone()).collect(),
        })
    }

    /// Body and place of a point that a key names.
    fn point_of(&self, key: &str, word: &str) -> Result<(usize, Point), ComposedError> {
        if let Some(found) = self.point_named(word) {
            return Ok(found);
        }
        let reference = Reference::to_point(key, word)?;
        reference.find(key, &self.points)?;
        Err(ComposedError::NoReference {
            key: key.into(),
            word: word.into(),
        })
    }

    /// Value of a figure at an input, in mm, rad, mm/s, m/s² or rad/s; none for a clearance, which is of the whole cycle.
    #[must_use]
    pub fn value(&self, figure: &ComposedFigure, input: f64) -> Option<f64> {
        let speed = self.speed();
        let coordinate = |body: usize| {
            let mount = self.bodies.get(body)?.mount.as_ref()?;
            Some(mount.law.at(input).position)
        };
        Some(match *figure {
            ComposedFigure::Point { body, at, part } => match part {
                PointPart::X => self.place(body, at, input).x,
                PointPart::Y => self.place(body, at, input).y,
                PointPart::Speed => self.point(body, at, input).first.norm() * speed,
                PointPart::Acceleration => {
                    1e-3 * self.point(body, at, input).second.norm() * speed * speed
                }
            },
            ComposedFigure::Angle(body) => self.angle(body, input).position,
            ComposedFigure::AngularSpeed(body) => self.angle(body, input).velocity * speed,
            ComposedFigure::Swing(body) | ComposedFigure::Travel(body) => coordinate(body)?,
            ComposedFigure::Transmission(dyad) => *self.transmission_angles(input).get(dyad)?,
            ComposedFigure::Distance(ends) => {
                let [p, q] = ends.map(|(body, at)| self.place(body, at, input));
                (p - q).norm()
            }
            ComposedFigure::Clearance(_) => return None,
        })
    }
}
