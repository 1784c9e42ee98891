use std::f64::consts::PI;

use crate::machine::body::points::{BodyPoint, Reference};
use crate::machine::goal::clearance_end::ClearanceEnd;
use crate::machine::{Machine, MachineBody, MachineError, Pin};
use centrode_kinematics::machine::JointKind;

/// Grammar of the figures of a composed machine: form, meaning, unit as shown.
pub const FIGURE_FORMS: [[&str; 3]; 15] = [
    [
        "point.x",
        "x of a point: body.point, or the name of the point alone if no other body has it",
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
        "angle of a body relative to the frame, without jumps",
        "deg",
    ],
    [
        "body.angular_speed",
        "speed at which a body turns, at the design's speed",
        "rad/s",
    ],
    [
        "body.swing",
        "angle of a body on a pin, relative to its carrier",
        "deg",
    ],
    [
        "body.travel",
        "position of a body on a slide, along its carrier",
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
        "minimum clearance over the cycle of two bodies, or of a body and an obstacle: their plates and gears that overlap in height",
        "mm",
    ],
    [
        "input.torque",
        "torque that the input needs at the design's speed, with inertia, weight and loads",
        "N mm",
    ],
    [
        "joint(body).force",
        "force in the joint that carries a body; joint(body-body) for the pin that joins the two bodies of a dyad",
        "N",
    ],
    [
        "mesh(body).force",
        "force along the tooth normal in the mesh that moves a body",
        "N",
    ],
    [
        "pair(pair).figure",
        "figure of the check of a gear pair by its key, such as pair(drive).contact_ratio_mean: the pair alone, over its own cycle",
        "as in the check",
    ],
];

/// A figure of a composed machine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MachineFigure {
    /// A component of a point's motion.
    Point(BodyPoint, PointPart),
    /// Angle of a body against the frame, rad.
    Angle(usize),
    /// Angular speed of a body at the design's speed, rad/s.
    AngularSpeed(usize),
    /// Coordinate of the pin that carries a body, rad.
    Swing(usize),
    /// Coordinate of the slide that carries a body, mm.
    Travel(usize),
    /// Angle between the lines of a dyad's two bodies, from 0 to a right angle, rad; index of the dyad in the order of closing.
    Transmission(usize),
    /// Distance of two points, mm.
    Distance([BodyPoint; 2]),
    /// Minimum clearance of two bodies, or of a body and an obstacle, over the cycle, mm.
    Clearance([ClearanceEnd; 2]),
    /// Torque of the input, N mm.
    InputTorque,
    /// Force in a joint, N; index of the joint in the machine.
    JointForce(usize),
    /// Force in the pin that closes a loop, N; index of the closure in the machine.
    PinForce(usize),
    /// Force along the normal of a mesh, N, positive on the flanks that drive with a counter-clockwise torque on the driven gear;
    /// index of the mesh in the machine.
    MeshForce(usize),
    /// A figure of the check of a gear pair, which does not change with the input.
    OfPair {
        /// Index of the pair in [`Machine::pairs`].
        pair: usize,
        /// Key of the figure.
        figure: &'static str,
    },
}

impl MachineFigure {
    /// Whether it is a figure of forces, which do not follow from the motion alone.
    #[must_use]
    pub fn is_of_forces(&self) -> bool {
        matches!(
            self,
            Self::InputTorque | Self::JointForce(_) | Self::PinForce(_) | Self::MeshForce(_)
        )
    }
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

impl Machine {
    /// Figure named by `words` in one of the forms of [`FIGURE_FORMS`]; `key` is the key of the design that contains the words.
    ///
    /// # Errors
    /// [`MachineError`] if there is no such figure.
    pub fn figure(&self, key: &str, words: &str) -> Result<MachineFigure, MachineError> {
        let none = || {
            let forms = FIGURE_FORMS.map(|[form, ..]| form).join(", ");
            let why = format!("there is no figure {words:?}; its forms are {forms}");
            MachineError::refused(key, why)
        };
        if let Some(found) = self.figure_of_forces(key, words) {
            return found?.ok_or_else(none);
        }
        if let Some(found) = self.figure_of_pair(key, words) {
            return found;
        }
        if let Some((function, inside)) = words.split_once('(') {
            let inside = inside.strip_suffix(')').ok_or_else(none)?;
            let names: Vec<&str> = inside.split(',').map(str::trim).collect();
            return match (function.trim(), &names[..]) {
                ("transmission", [dyad]) => {
                    let names = || self.dyads.iter().map(|own| own.name.clone());
                    let found = names().position(|name| name == *dyad);
                    let unknown = || MachineError::unknown(key, "dyad", *dyad, names());
                    found.map(MachineFigure::Transmission).ok_or_else(unknown)
                }
                ("distance", [one, other]) => Ok(MachineFigure::Distance([
                    self.point_of(key, one)?,
                    self.point_of(key, other)?,
                ])),
                ("clearance", [one, other]) => self
                    .clearance_ends(key, [one, other])
                    .map(MachineFigure::Clearance),
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
            return Ok(MachineFigure::Point(self.point_of(key, of)?, part));
        }
        let kind = |body: usize| self.bodies[body].mount.as_ref().map(|mount| mount.kind);
        match part {
            "angle" => Ok(MachineFigure::Angle(self.body_of(key, of)?)),
            "angular_speed" => Ok(MachineFigure::AngularSpeed(self.body_of(key, of)?)),
            "swing" | "travel" => {
                let body = self.body_of(key, of)?;
                match (part, kind(body)) {
                    ("swing", Some(JointKind::Turning)) => Ok(MachineFigure::Swing(body)),
                    ("travel", Some(JointKind::Sliding(_))) => Ok(MachineFigure::Travel(body)),
                    _ => Err(none()),
                }
            }
            _ => Err(none()),
        }
    }

    /// A figure of forces. The outer option is `None` if the words have another form, the inner one if there is no such joint
    /// or mesh.
    fn figure_of_forces(
        &self,
        key: &str,
        words: &str,
    ) -> Option<Result<Option<MachineFigure>, MachineError>> {
        if words == "input.torque" {
            return Some(Ok(Some(MachineFigure::InputTorque)));
        }
        let (function, name) = words.strip_suffix(").force")?.split_once('(')?;
        let name = name.trim();
        let body = || self.body_of(key, name);
        Some(match function.trim() {
            "joint" => match self.pins.iter().position(|pin| self.pair_name(pin) == name) {
                Some(pin) => Ok(Some(MachineFigure::PinForce(pin))),
                // Joint `body - 1` carries a body; the frame has none.
                None => body().map(|body| body.checked_sub(1).map(MachineFigure::JointForce)),
            },
            "mesh" => body().map(|body| {
                let mesh = self.meshes.iter().position(|mesh| mesh.moved == body);
                mesh.map(MachineFigure::MeshForce)
            }),
            _ => Ok(None),
        })
    }

    /// Name of a pin that closes a loop: the names of its two bodies.
    fn pair_name(&self, pin: &Pin) -> String {
        pin.bodies
            .map(|body| self.bodies[body].name.as_str())
            .join("-")
    }

    /// Words of all figures of single points, bodies, dyads and meshes, of the input torque and of the forces in joints, as goals
    /// name them.
    #[must_use]
    pub fn figure_words(&self) -> Vec<String> {
        let all = |of: &str, parts: &[&str]| -> Vec<String> {
            parts.iter().map(|part| format!("{of}.{part}")).collect()
        };
        let moving = self.points().filter(|(_, point)| point.body > 0);
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
        let motions = of_points.chain(of_bodies).chain(of_dyads);
        let moves = |body: &&MachineBody| {
            let mount = body.mount.as_ref();
            mount.is_some_and(|mount| mount.kind != JointKind::Fixed)
        };
        let carried = self.bodies.iter().filter(moves);
        let carried = carried.map(|body| body.name.clone());
        let pins = self.pins.iter().map(|pin| self.pair_name(pin));
        let of_joints = carried
            .chain(pins)
            .map(|name| format!("joint({name}).force"));
        let meshes = self.meshes.iter();
        let of_meshes = meshes.map(|mesh| format!("mesh({}).force", self.bodies[mesh.moved].name));
        motions
            .chain(["input.torque".to_owned()])
            .chain(of_joints)
            .chain(of_meshes)
            .collect()
    }

    /// Index of a body that a key names.
    pub(in crate::machine) fn body_of(&self, key: &str, name: &str) -> Result<usize, MachineError> {
        self.body_named(name).ok_or_else(|| {
            MachineError::unknown(
                key,
                "body",
                name,
                self.bodies.iter().map(|body| body.name.clone()),
            )
        })
    }

    /// Body and position of a point that a key names.
    fn point_of(&self, key: &str, word: &str) -> Result<BodyPoint, MachineError> {
        if let Some(found) = self.point_named(word) {
            return Ok(found);
        }
        let reference = Reference::to_point(key, word)?;
        reference.find(key, &self.points)?;
        Err(MachineError::NoReference {
            key: key.into(),
            word: word.into(),
        })
    }

    /// Value of a figure at an input, in mm, rad, mm/s, m/s² or rad/s; `None` for a clearance, which is of the whole cycle, for a
    /// force, and for a figure of a pair.
    #[must_use]
    pub fn value(&self, figure: &MachineFigure, input: f64) -> Option<f64> {
        let speed = self.speed();
        let coordinate = |body: usize| {
            let mount = self.bodies.get(body)?.mount.as_ref()?;
            Some(mount.law.at(input).position)
        };
        Some(match *figure {
            MachineFigure::Point(BodyPoint { body, at }, part) => match part {
                PointPart::X => self.place(body, at, input).x,
                PointPart::Y => self.place(body, at, input).y,
                PointPart::Speed => self.point(body, at, input).first.norm() * speed,
                PointPart::Acceleration => {
                    1e-3 * self.point(body, at, input).second.norm() * speed * speed
                }
            },
            MachineFigure::Angle(body) => self.angle(body, input).position,
            MachineFigure::AngularSpeed(body) => self.angle(body, input).velocity * speed,
            MachineFigure::Swing(body) | MachineFigure::Travel(body) => coordinate(body)?,
            MachineFigure::Transmission(dyad) => {
                let angle = *self.transmission_angles(input).get(dyad)?;
                angle.min(PI - angle)
            }
            MachineFigure::Distance(ends) => {
                let [p, q] = ends.map(|BodyPoint { body, at }| self.place(body, at, input));
                (p - q).norm()
            }
            MachineFigure::Clearance(_)
            | MachineFigure::InputTorque
            | MachineFigure::JointForce(_)
            | MachineFigure::PinForce(_)
            | MachineFigure::MeshForce(_)
            | MachineFigure::OfPair { .. } => return None,
        })
    }
}
