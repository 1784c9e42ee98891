use centrode_geometry::{Jet, Point, Vector};
use centrode_mechanism::linkage::{Connection, Link, Linkage, LinkageError, Pose};
use nalgebra::{DMatrix, DVector};

/// Millimetres in a metre: kg mm/s² are thousandths of a newton.
const MM: f64 = 1000.0;

/// Mass of a link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkMass {
    /// Link.
    pub link: Link,
    /// Mass, kg.
    pub mass: f64,
    /// Centre of mass in the link's axes, mm.
    pub center: Point,
    /// Moment of inertia about the centre of mass, kg mm².
    pub inertia: f64,
}

/// Load on a link, fixed in the world: a force at a point of it, and a torque.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Load {
    /// Link.
    pub link: Link,
    /// Point of action of the force, in the link's axes, mm.
    pub at: Point,
    /// Force, N.
    pub force: Vector,
    /// Torque, N mm, counter-clockwise.
    pub torque: f64,
}

/// Motion of the crank.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CrankMotion {
    /// Speed, rad/s; zero for the quasi-static torque.
    pub speed: f64,
    /// Acceleration, rad/s².
    pub acceleration: f64,
}

/// Reaction in the connection of two links.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reaction {
    /// Pin or guide.
    pub connection: Connection,
    /// Force on the second link of a pin, or on the block, N.
    pub force: Vector,
    /// Moment on the block about its middle, N mm; zero for a pin.
    pub moment: f64,
}

/// Torque and forces at one input.
#[derive(Clone, Debug, PartialEq)]
pub struct Forces {
    /// Torque the crank needs, N mm, counter-clockwise.
    pub torque: f64,
    /// Every pin and guide, in the order of building.
    pub reactions: Vec<Reaction>,
    /// Kinetic energy, N mm.
    pub kinetic_energy: f64,
    /// Potential energy in the field of gravity, N mm.
    pub potential_energy: f64,
}

/// Reason why there are no forces.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ForceError {
    /// The linkage cannot be posed.
    #[error(transparent)]
    Linkage(#[from] LinkageError),
    /// There is no crank to hold it.
    #[error("the linkage has no crank")]
    NoCrank,
    /// The links' balance has no single answer: the linkage is in a dead position, or two of its guides
    /// hold the same thing.
    #[error("the forces at the input {input} rad have no single answer")]
    Undetermined {
        /// The input, rad.
        input: f64,
    },
    /// A mass below zero or not finite.
    #[error(
        "the mass of link {link} is {mass} kg with {inertia} kg mm²; both must be finite and not below zero"
    )]
    Mass {
        /// The link's number.
        link: usize,
        /// Mass as given, kg.
        mass: f64,
        /// Moment of inertia as given, kg mm².
        inertia: f64,
    },
}

/// A linkage with masses and loads: the torque its crank needs and the forces in its joints.
///
/// Each link's forces and moments balance its inertia (Newton and Euler); all links together are one
/// linear system. Accelerations are those of the closed forms. No friction.
#[derive(Clone, Debug)]
pub struct Kinetostatics<'a> {
    linkage: &'a Linkage,
    masses: Vec<LinkMass>,
    loads: Vec<Load>,
    /// Acceleration of free fall, mm/s².
    gravity: Vector,
}

impl<'a> Kinetostatics<'a> {
    /// Makes a linkage with masses and loads in a field of gravity (mm/s²).
    ///
    /// # Errors
    /// [`ForceError::Mass`].
    pub fn new(
        linkage: &'a Linkage,
        masses: Vec<LinkMass>,
        loads: Vec<Load>,
        gravity: Vector,
    ) -> Result<Self, ForceError> {
        for m in &masses {
            let good = |v: f64| v.is_finite() && v >= 0.0;
            if !(good(m.mass) && good(m.inertia)) {
                return Err(ForceError::Mass {
                    link: m.link.index(),
                    mass: m.mass,
                    inertia: m.inertia,
                });
            }
        }
        Ok(Self {
            linkage,
            masses,
            loads,
            gravity,
        })
    }

    /// Torque and joint forces at an input.
    ///
    /// # Errors
    /// [`ForceError`].
    pub fn at(&self, input: f64, motion: CrankMotion) -> Result<Forces, ForceError> {
        let pose = self.linkage.at(input)?;
        let parts = self.linkage.parts();
        let crank = parts.crank.ok_or(ForceError::NoCrank)?;
        // Three rows a moving link: forces along x and y, moment about the world's origin. Two unknowns
        // a connection; the last unknown is the torque.
        let rows = 3 * (parts.link_count - 1);
        let unknowns = 2 * parts.connections.len() + 1;
        if rows != unknowns {
            return Err(ForceError::Undetermined { input });
        }
        let mut balance = Balance {
            matrix: DMatrix::zeros(rows, unknowns),
            right: DVector::zeros(rows),
        };
        for (k, connection) in parts.connections.iter().enumerate() {
            match *connection {
                Connection::Turning { joint, links } => {
                    let at = pose.joint(joint).point;
                    for (axis, unit) in [Vector::x(), Vector::y()].into_iter().enumerate() {
                        balance.pair(links.1, links.0, 2 * k + axis, unit, at);
                    }
                }
                Connection::Sliding {
                    joint,
                    block,
                    guide,
                } => {
                    let at = pose.joint(joint).point;
                    let normal = left(&pose, block);
                    balance.pair(block, guide, 2 * k, normal, at);
                    balance.moment(block, 2 * k + 1, 1.0);
                    balance.moment(guide, 2 * k + 1, -1.0);
                }
            }
        }
        balance.moment(crank, unknowns - 1, 1.0);
        let (mut kinetic_energy, mut potential_energy) = (0.0, 0.0);
        for mass in &self.masses {
            let body = pose.body(mass.link);
            let center = body.point(mass.center);
            let (velocity, acceleration) = by_time(&center, motion);
            let spin = body.angle.velocity * motion.speed;
            let spin_up = body.angle.acceleration * motion.speed.powi(2)
                + body.angle.velocity * motion.acceleration;
            let needed = (acceleration - self.gravity) * (mass.mass / MM);
            balance.needs(mass.link, needed, center.point, mass.inertia * spin_up / MM);
            kinetic_energy +=
                (mass.mass * velocity.norm_squared() + mass.inertia * spin * spin) / (2.0 * MM);
            potential_energy -= mass.mass * self.gravity.dot(&center.point.coords) / MM;
        }
        for load in &self.loads {
            let at = pose.body(load.link).point(load.at).point;
            balance.needs(load.link, -load.force, at, -load.torque);
        }
        let lu = balance.matrix.lu();
        let solved = lu.solve(&balance.right);
        let solved = solved.filter(|s| s.iter().all(|v| v.is_finite()));
        let forces = solved.ok_or(ForceError::Undetermined { input })?;
        let reaction = |(k, connection): (usize, &Connection)| {
            let (a, b) = (forces[2 * k], forces[2 * k + 1]);
            let (force, moment) = match *connection {
                Connection::Turning { .. } => (Vector::new(a, b), 0.0),
                Connection::Sliding { block, .. } => (left(&pose, block) * a, b),
            };
            Reaction {
                connection: *connection,
                force,
                moment,
            }
        };
        Ok(Forces {
            torque: forces[unknowns - 1],
            reactions: parts.connections.iter().enumerate().map(reaction).collect(),
            kinetic_energy,
            potential_energy,
        })
    }
}

/// The unit vector square to a block's guide, to the left of it.
fn left(pose: &Pose, block: Link) -> Vector {
    let angle = pose.body(block).angle.position;
    Vector::new(-angle.sin(), angle.cos())
}

/// Velocity and acceleration by time, mm/s and mm/s².
fn by_time(jet: &Jet, motion: CrankMotion) -> (Vector, Vector) {
    let (speed, gain) = (motion.speed, motion.acceleration);
    (
        jet.first * speed,
        jet.second * speed.powi(2) + jet.first * gain,
    )
}

struct Balance {
    matrix: DMatrix<f64>,
    right: DVector<f64>,
}

impl Balance {
    fn row(link: Link) -> Option<usize> {
        link.index().checked_sub(1).map(|k| 3 * k)
    }

    /// A unit force at a point on one link and its counterpart on the other.
    fn pair(&mut self, on: Link, from: Link, unknown: usize, unit: Vector, at: Point) {
        for (link, sign) in [(on, 1.0), (from, -1.0)] {
            if let Some(row) = Self::row(link) {
                self.matrix[(row, unknown)] += sign * unit.x;
                self.matrix[(row + 1, unknown)] += sign * unit.y;
                self.matrix[(row + 2, unknown)] += sign * at.coords.perp(&unit);
            }
        }
    }

    fn moment(&mut self, on: Link, unknown: usize, sign: f64) {
        if let Some(row) = Self::row(on) {
            self.matrix[(row + 2, unknown)] += sign;
        }
    }

    /// Adds the force and moment that the joints must supply on a link.
    fn needs(&mut self, link: Link, force: Vector, at: Point, moment: f64) {
        if let Some(row) = Self::row(link) {
            self.right[row] += force.x;
            self.right[row + 1] += force.y;
            self.right[row + 2] += at.coords.perp(&force) + moment;
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{PI, TAU};

    use centrode_mechanism::linkage::{Branch, Line};

    use super::*;

    const GRAVITY: Vector = Vector::new(0.0, -9810.0);

    /// The picking six-bar with masses in odd places, and a slider on its rocker.
    fn picker() -> (Linkage, Vec<LinkMass>) {
        let build = || {
            let mut linkage = Linkage::new();
            let a = linkage.point(Link::FRAME, Point::origin())?;
            let d = linkage.point(Link::FRAME, Point::new(105.0, 0.0))?;
            let f = linkage.point(Link::FRAME, Point::new(100.0, 67.0))?;
            let (crank, b) = linkage.crank(a, 77.0, 0.3)?;
            let bars = linkage.rrr(b, d, (147.0, 127.0), Branch::Upper)?;
            let effector = linkage.rpr(bars.joint, f, 3.0, Branch::Upper)?;
            let point = linkage.point(bars.second, Point::new(60.0, 10.0))?;
            let line = Line {
                link: Link::FRAME,
                through: Point::new(0.0, -60.0),
                angle: 0.2,
            };
            let slider = linkage.rrp(point, 260.0, line, Branch::Upper)?;
            let links = [
                crank,
                bars.first,
                bars.second,
                effector.block,
                effector.link,
                slider.link,
                slider.block,
            ];
            Ok::<_, LinkageError>((linkage, links))
        };
        let (linkage, links) = build().expect("a linkage");
        let masses = links.into_iter().enumerate().map(|(k, link)| LinkMass {
            link,
            mass: 0.2 + 0.1 * k as f64,
            center: Point::new(20.0 + 5.0 * k as f64, 3.0 - k as f64),
            inertia: 400.0 + 50.0 * k as f64,
        });
        (linkage.clone(), masses.collect())
    }

    /// Guards that torque times speed is the rate at which kinetic and potential energy grow.
    #[test]
    fn the_torque_feeds_the_energy() {
        let (linkage, masses) = picker();
        let system = Kinetostatics::new(&linkage, masses, Vec::new(), GRAVITY).expect("masses");
        let motion = CrankMotion {
            speed: 9.0,
            acceleration: 0.0,
        };
        let energy = |phi: f64| {
            let f = system.at(phi, motion).expect("it turns");
            f.kinetic_energy + f.potential_energy
        };
        let count = 720;
        let mut work = 0.0;
        for i in 0..count {
            let phi = TAU * f64::from(i) / f64::from(count);
            let torque = system.at(phi, motion).expect("it turns").torque;
            let h = 1e-3;
            let slope = (8.0 * (energy(phi + h) - energy(phi - h))
                - (energy(phi + 2.0 * h) - energy(phi - 2.0 * h)))
                / (12.0 * h);
            assert!(
                (torque - slope).abs() < 1e-6 * (1.0 + torque.abs()),
                "{torque} {slope}"
            );
            work += torque;
        }
        // Over a turn nothing is gained; a periodic mean converges as its Fourier series.
        assert!(work.abs() / f64::from(count) < 1e-9, "{work}");
    }

    /// An accelerated crank needs the torque of its own inertia and the links'.
    #[test]
    fn a_lone_crank_needs_inertia_times_acceleration() {
        let mut linkage = Linkage::new();
        let a = linkage
            .point(Link::FRAME, Point::new(7.0, 5.0))
            .expect("a point");
        let (crank, _) = linkage.crank(a, 50.0, 0.0).expect("a length");
        let mass = LinkMass {
            link: crank,
            mass: 2.0,
            center: Point::new(30.0, 0.0),
            inertia: 1000.0,
        };
        let system = Kinetostatics::new(&linkage, vec![mass], Vec::new(), GRAVITY).expect("masses");
        let motion = CrankMotion {
            speed: 3.0,
            acceleration: 11.0,
        };
        let forces = system.at(0.8, motion).expect("it turns");
        let inertia = 1000.0 + 2.0 * 900.0;
        let weight = 2.0 * 9.81 * 30.0 * 0.8_f64.cos();
        assert!((forces.torque - (inertia * 11.0 / 1000.0 + weight)).abs() < 1e-10);
        // The pin carries weight and centripetal force.
        let towards = -Vector::new(0.8_f64.cos(), 0.8_f64.sin()) * 30.0 * 9.0;
        let along = Vector::new(-0.8_f64.sin(), 0.8_f64.cos()) * 30.0 * 11.0;
        let force = (towards + along - GRAVITY) * 2.0 / 1000.0;
        assert!((forces.reactions[0].force - force).norm() < 1e-12);
    }

    /// Virtual work: without masses the torque is the load's force times the slope of its path.
    #[test]
    fn a_still_linkage_passes_a_load_by_its_ratio() {
        let (linkage, _) = picker();
        let effector = Link::FRAME;
        let link = linkage
            .parts()
            .connections
            .iter()
            .find_map(|c| match c {
                Connection::Sliding { guide, .. } if *guide != effector => Some(*guide),
                _ => None,
            })
            .expect("the effector is a guide");
        let load = Load {
            link,
            at: Point::new(200.0, -20.0),
            force: Vector::new(3.0, -7.0),
            torque: 45.0,
        };
        let system = Kinetostatics::new(&linkage, Vec::new(), vec![load], GRAVITY).expect("masses");
        for phi in [0.1, 1.0, PI, 4.0, 5.5] {
            let body = linkage.at(phi).expect("it turns").body(link);
            let way = body.point(load.at).first;
            let work = load.force.dot(&way) + load.torque * body.angle.velocity;
            let forces = system.at(phi, CrankMotion::default()).expect("it turns");
            assert!((forces.torque + work).abs() < 1e-9 * (1.0 + work.abs()));
            assert_eq!(forces.kinetic_energy, 0.0);
        }
    }

    #[test]
    fn bad_masses_and_no_crank_are_refused() {
        let mut linkage = Linkage::new();
        let mass = LinkMass {
            link: Link::FRAME,
            mass: -1.0,
            center: Point::origin(),
            inertia: 0.0,
        };
        assert!(Kinetostatics::new(&linkage, vec![mass], Vec::new(), GRAVITY).is_err());
        linkage
            .point(Link::FRAME, Point::origin())
            .expect("a point");
        let system = Kinetostatics::new(&linkage, Vec::new(), Vec::new(), GRAVITY).expect("none");
        assert_eq!(
            system.at(0.0, CrankMotion::default()),
            Err(ForceError::NoCrank)
        );
    }
}
