use std::cell::Cell;

use centrode_geometry::{Extreme, Point, SolidError, Vector, greatest_each};
use centrode_mechanism::feeder::{Feeder, FeederError, Part};
use centrode_mechanism::linkage::{Branch, Link, Linkage, LinkageError};

use crate::{CrankMotion, ForceError, Forces, Kinetostatics, LinkMass, Report, Table, Unit};

/// Standard acceleration of free fall, down the y axis, mm/s².
const GRAVITY: Vector = Vector::new(0.0, -9806.65);
/// Figures of a state: the torque and the force in every joint.
const FIGURES: usize = 1 + FeederForces::CONNECTIONS.len();

/// Reason why there are no forces.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FeederForcesError {
    /// A link cannot be cut from plate, so it has no mass.
    #[error(transparent)]
    Plate(#[from] FeederError),
    /// A plate encloses no volume.
    #[error("the {part} has no volume: {source}")]
    Solid {
        /// Name of the part.
        part: &'static str,
        /// Cause.
        source: SolidError,
    },
    /// The linkage's balance has no answer.
    #[error(transparent)]
    Balance(#[from] ForceError),
}

impl From<LinkageError> for FeederForcesError {
    fn from(error: LinkageError) -> Self {
        Self::Balance(error.into())
    }
}

/// A feeder with the masses of its plates: the torque its crank needs and the forces in its joints.
///
/// The y axis points up. The links' inertia at the design's speed is counted or left out; a jump of speed, which has no
/// finite force, and friction are not.
#[derive(Clone, Debug)]
pub struct FeederForces<'a> {
    feeder: &'a Feeder,
    linkage: Linkage,
    masses: Vec<LinkMass>,
}

impl<'a> FeederForces<'a> {
    /// Connections of the linkage in the order of [`Forces::reactions`]: the shafts A and D of crank and rocker and the
    /// pin B, the coupler's pin C on the rocker and on the slider, the pivot F, the slot on the slider.
    pub const CONNECTIONS: [&'static str; 7] =
        ["A", "B", "D", "C, rocker", "C, slider", "F", "slot"];

    /// Makes a feeder that carries the mass of its design.
    ///
    /// # Errors
    /// [`FeederForcesError`].
    pub fn of(feeder: &'a Feeder) -> Result<Self, FeederForcesError> {
        Self::new(feeder, feeder.design().drive.carried_mass)
    }

    /// Makes a feeder that carries a mass (kg) at the tip of its effector.
    ///
    /// # Errors
    /// [`FeederForcesError`].
    pub fn new(feeder: &'a Feeder, carried: f64) -> Result<Self, FeederForcesError> {
        let six_bar = feeder.six_bar();
        let [crank, coupler, rocker, frame] = six_bar.four_bar().lengths();
        let mut linkage = Linkage::new();
        let a = linkage.point(Link::FRAME, Point::origin())?;
        let d = linkage.point(Link::FRAME, Point::new(frame, 0.0))?;
        let f = linkage.point(Link::FRAME, six_bar.pivot())?;
        let (crank, b) = linkage.crank(a, crank, 0.0)?;
        let bars = linkage.rrr(b, d, (coupler, rocker), six_bar.four_bar().branch())?;
        let effector = linkage.rpr(bars.joint, f, 0.0, Branch::Upper)?;
        let density = feeder.design().plates.density;
        let mut masses = Vec::new();
        for (part, link) in [
            (Part::Crank, crank),
            (Part::Coupler, bars.first),
            (Part::Rocker, bars.second),
            (Part::Slider, effector.block),
            (Part::Effector, effector.link),
        ] {
            let solid = feeder.plate(part)?.solid();
            let solid = solid.map_err(|source| FeederForcesError::Solid {
                part: part.name(),
                source,
            })?;
            let whole = solid.mass_properties(density);
            masses.push(LinkMass {
                link,
                mass: whole.mass,
                center: whole.center.xy(),
                inertia: whole.inertia[(2, 2)],
            });
        }
        masses.push(LinkMass {
            link: effector.link,
            mass: carried,
            center: Point::new(six_bar.effector_length(), 0.0),
            inertia: 0.0,
        });
        // Refuses a carried mass that is none.
        Kinetostatics::new(&linkage, masses.clone(), Vec::new(), GRAVITY)?;
        Ok(Self {
            feeder,
            linkage,
            masses,
        })
    }

    /// Torque and forces at an input, moving at the design's speed or at rest there.
    ///
    /// # Errors
    /// [`FeederForcesError::Balance`].
    pub fn at(&self, input: f64, moving: bool) -> Result<Forces, FeederForcesError> {
        let crank = self.feeder.crank(input);
        let speed = self.feeder.speed();
        let motion = if moving {
            CrankMotion {
                speed: crank.velocity * speed,
                acceleration: crank.acceleration * speed * speed,
            }
        } else {
            CrankMotion::default()
        };
        let system = Kinetostatics::new(&self.linkage, self.masses.clone(), Vec::new(), GRAVITY)?;
        Ok(system.at(crank.position, motion)?)
    }
}

/// Greatest torque and joint forces, at rest and moving.
pub(super) fn forces(feeder: &Feeder, report: &mut Report) {
    // A link that cannot be cut is a finding of its own.
    let Ok(system) = FeederForces::of(feeder) else {
        return;
    };
    let balanced = Cell::new(true);
    let sizes = |input: f64, moving: bool| -> [f64; FIGURES] {
        let Ok(forces) = system.at(input, moving) else {
            balanced.set(false);
            return [f64::NAN; FIGURES];
        };
        std::array::from_fn(|k| match k.checked_sub(1) {
            None => forces.torque.abs(),
            Some(joint) => forces.reactions[joint].force.norm(),
        })
    };
    let ends = feeder.pieces();
    let [still, moving] =
        [false, true].map(|moving| greatest_each(|input| sizes(input, moving), &ends));
    if !balanced.get() {
        return;
    }
    let values = &mut report.values;
    values.insert("crank_torque_still_max", still[0].value);
    values.insert("crank_torque_moving_max", moving[0].value);
    let of = |Extreme { value, .. }: &Extreme| *value;
    let greatest = still.iter().zip(&moving).map(|(a, b)| vec![of(a), of(b)]);
    let rows = FeederForces::CONNECTIONS.iter().zip(greatest.skip(1));
    report.tables.push(Table {
        name: "joint_forces",
        title: "Greatest force in a joint",
        unit: Unit::Newton,
        columns: vec!["held still".into(), "moving".into()],
        rows: rows.map(|(name, row)| ((*name).into(), row)).collect(),
    });
}
