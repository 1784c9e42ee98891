use centrode_kinematics::machine::{JointKind, LinkedMachine, PitchCurves};
use nalgebra::Vector3;

use super::ForcesError;
use super::motion::LinkMotion;

/// A closure, mesh or contact: it holds two links by an unknown force, apart from the tree of joints.
#[derive(Clone, Debug)]
pub(super) struct Tie {
    pub(super) kind: TieKind,
    /// The two links: the force acts on the second link, and its reaction on the first.
    pub(super) links: [usize; 2],
    /// Joints that the tie moves, one per component of its force.
    pub(super) held: Vec<usize>,
    /// Joints that carry only the second link (1) or only the first link (-1).
    pub(super) between: Vec<(usize, f64)>,
    /// Joint that carries the plane of the force; `None` for the frame.
    normal: Option<usize>,
}

/// Kind of a tie, by its index in the machine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum TieKind {
    Closure(usize),
    Mesh(usize),
    Contact(usize),
}

/// Point at which a tie's force acts, and unit vectors along its components.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lines {
    pub(super) at: Vector3<f64>,
    pub(super) along: [Vector3<f64>; 2],
}

impl Tie {
    /// Every closure, mesh and contact of a machine.
    ///
    /// # Errors
    /// [`ForcesError`] if a tie moves a joint that it does not reach, or a joint that another tie moves too.
    pub(super) fn all(machine: &LinkedMachine) -> Result<Vec<Self>, ForcesError> {
        let closures = machine.closures.iter().enumerate();
        let closures = closures.map(|(i, c)| (TieKind::Closure(i), c.links, c.joints.to_vec()));
        let meshes = machine.meshes.iter().enumerate();
        let meshes = meshes.map(|(i, m)| (TieKind::Mesh(i), m.links, vec![m.joint]));
        let contacts = machine.contacts.iter().enumerate();
        let contacts = contacts.map(|(i, c)| (TieKind::Contact(i), c.links, vec![c.joint]));
        let mut ties: Vec<Self> = Vec::new();
        for (kind, links, held) in closures.chain(meshes).chain(contacts) {
            let between = between(machine, links);
            let turns = |joint: &&usize| machine.joints[**joint].kind == JointKind::Turning;
            let reached = between.iter().map(|(joint, _)| joint);
            let normal = held.iter().chain(reached).find(turns).copied();
            let tie = Self {
                kind,
                links,
                held,
                between,
                normal,
            };
            tie.is_sound(machine, &ties)?;
            ties.push(tie);
        }
        Ok(ties)
    }

    fn is_sound(&self, machine: &LinkedMachine, others: &[Self]) -> Result<(), ForcesError> {
        let name = |joint: usize| machine.links[machine.joints[joint].child].name.clone();
        for (i, &joint) in self.held.iter().enumerate() {
            let free = machine.joints[joint].kind != JointKind::Fixed;
            if !free || self.sign(joint) == 0.0 {
                return Err(ForcesError::Apart {
                    holder: self.words(machine),
                    link: name(joint),
                });
            }
            let other = others.iter().find(|tie| tie.held.contains(&joint));
            let twice = self.held[..i].contains(&joint).then_some(self);
            if let Some(other) = other.or(twice) {
                return Err(ForcesError::Undetermined {
                    link: name(joint),
                    holders: format!("{} and {}", other.words(machine), self.words(machine)),
                });
            }
        }
        Ok(())
    }

    /// Text that names the tie, for messages.
    pub(super) fn words(&self, machine: &LinkedMachine) -> String {
        let kind = match self.kind {
            TieKind::Closure(_) => "pin",
            TieKind::Mesh(_) => "mesh",
            TieKind::Contact(_) => "contact",
        };
        let [one, other] = self.links.map(|link| machine.links[link].name.as_str());
        format!("the {kind} of {one} and {other}")
    }

    /// Sign of the tie's force on the links that a joint carries; zero if the joint carries both links of the tie or neither.
    pub(super) fn sign(&self, joint: usize) -> f64 {
        let own = self.between.iter().find(|(of, _)| *of == joint);
        own.map_or(0.0, |(_, sign)| *sign)
    }

    /// Whether only the moment of the tie's force is known, not its direction.
    pub(super) fn is_vague(&self, machine: &LinkedMachine) -> bool {
        matches!(self.kind, TieKind::Mesh(i) if machine.meshes[i].pressure_angle.is_none())
    }

    /// Point and directions of the force: for teeth, along the tangent of the pitch curves. `None` if two meshing links do not
    /// move relative to each other and their pitch curves are not given.
    pub(super) fn lines(
        &self,
        machine: &LinkedMachine,
        motions: &[LinkMotion],
        axes: &[Vector3<f64>],
        input: f64,
    ) -> Option<Lines> {
        let axis = self.normal.map_or(Vector3::z(), |joint| axes[joint]);
        let [one, other] = self.links.map(|link| &motions[link]);
        match self.kind {
            TieKind::Closure(i) => {
                let at = one.place + one.turn * Vector3::from(machine.closures[i].at);
                // Along the projection of a world axis on the plane of the force.
                let side = if axis.x.abs() < 0.9 {
                    Vector3::x()
                } else {
                    Vector3::y()
                };
                let along = (side - axis * axis.dot(&side)).normalize();
                let along = [along, axis.cross(&along)];
                Some(Lines { at, along })
            }
            TieKind::Mesh(i) => {
                let mesh = &machine.meshes[i];
                let centers = [(one, mesh.axes[0]), (other, mesh.axes[1])];
                let centers = centers.map(|(link, at)| link.place + link.turn * Vector3::from(at));
                match &mesh.pitch {
                    Some(pitch) => known_pitch_point(pitch, one, centers, axis),
                    None => pitch_point([one, other], centers[1], axis),
                }
            }
            TieKind::Contact(i) => {
                let contact = &machine.contacts[i];
                if let Some(line) = &contact.line {
                    let [at, along] = line.at(input).map(|v| other.turn * Vector3::from(v));
                    let at = other.place + at;
                    let finite = at.iter().chain(along.iter()).all(|x| x.is_finite());
                    return finite.then_some(Lines {
                        at,
                        along: [along; 2],
                    });
                }
                let at = other.place + other.turn * Vector3::from(contact.at);
                let normal = match contact.normal {
                    Some(normal) => one.turn * Vector3::from(normal),
                    None => axis.cross(&(other.point(at)[0] - one.point(at)[0])),
                };
                let along = normal.try_normalize(0.0)?;
                let along = [along; 2];
                Some(Lines { at, along })
            }
        }
    }

    /// The lines of a mesh, once the size of its force along the tangent is known. The flanks' normal is inclined to the
    /// tangent by the pressure angle, so that the force pushes the gears apart.
    pub(super) fn flank(
        &self,
        machine: &LinkedMachine,
        lines: &Lines,
        driver: &LinkMotion,
        size: f64,
    ) -> Lines {
        let TieKind::Mesh(i) = self.kind else {
            return *lines;
        };
        let angle = machine.meshes[i].pressure_angle.unwrap_or(0.0);
        let [tangent, across] = lines.along;
        let [center, _] = machine.meshes[i].axes;
        let center = driver.place + driver.turn * Vector3::from(center);
        let apart = across * across.dot(&(lines.at - center)).signum();
        let normal = tangent * angle.cos() + apart * angle.sin().copysign(angle * size);
        Lines {
            along: [normal, across],
            ..*lines
        }
    }
}

/// Pitch point of two links (the pole of their relative motion), with unit vectors along and across the pitch curves. A force
/// along the tangent turns the driven gear counter-clockwise about its centre.
///
/// The pitch curves roll on each other, so their relative acceleration at the pole is normal to them.
fn pitch_point(
    [driver, driven]: [&LinkMotion; 2],
    center: Vector3<f64>,
    axis: Vector3<f64>,
) -> Option<Lines> {
    let turning = axis.dot(&(driven.spin[0] - driver.spin[0]));
    let slip = driven.way[0] - driver.point(driven.place)[0];
    let at = driven.place + axis.cross(&slip) / turning;
    let rolled = driven.point(at)[1] - driver.point(at)[1];
    along_pitch(at, axis.cross(&rolled), center, axis)
}

/// Pitch point of two links and unit vectors there, like [`pitch_point`], from their pitch curves: valid at rest too.
fn known_pitch_point(
    pitch: &PitchCurves,
    driver: &LinkMotion,
    [from, to]: [Vector3<f64>; 2],
    axis: Vector3<f64>,
) -> Option<Lines> {
    let apart = to - from;
    let along = apart - axis * axis.dot(&apart);
    let own = driver.turn.tr_mul(&along);
    let [radius, slope] = pitch.radius(own.y.atan2(own.x), along.norm());
    let out = along.try_normalize(0.0)?;
    let round = axis.cross(&out);
    let at = to - along + out * radius;
    along_pitch(at, out * slope + round * radius, to, axis)
}

/// Lines of a mesh at its pitch point, from a tangent of the pitch curves in either direction.
fn along_pitch(
    at: Vector3<f64>,
    tangent: Vector3<f64>,
    center: Vector3<f64>,
    axis: Vector3<f64>,
) -> Option<Lines> {
    let tangent = tangent.try_normalize(0.0)?;
    let moment = axis.dot(&(at - center).cross(&tangent));
    let tangent = tangent * moment.signum();
    let finite = tangent.iter().chain(at.iter()).all(|x| x.is_finite());
    finite.then(|| Lines {
        at,
        along: [tangent, axis.cross(&tangent)],
    })
}

/// Joints that carry the second of two links but not the first (1), and the first but not the second (-1).
pub(super) fn between(machine: &LinkedMachine, links: [usize; 2]) -> Vec<(usize, f64)> {
    let [one, other] = links.map(|link| {
        let mut chain = Vec::new();
        let mut at = link;
        while let Some(joint) = machine.joints.iter().position(|joint| joint.child == at) {
            if chain.len() > machine.joints.len() {
                break;
            }
            chain.push(joint);
            at = machine.joints[joint].parent;
        }
        chain
    });
    let ours = one.iter().filter(|joint| !other.contains(joint));
    let theirs = other.iter().filter(|joint| !one.contains(joint));
    let theirs = theirs.map(|&joint| (joint, 1.0));
    theirs.chain(ours.map(|&joint| (joint, -1.0))).collect()
}
