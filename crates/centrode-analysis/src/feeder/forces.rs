use std::cell::Cell;

use centrode_geometry::{Extreme, SolidError, Vector, maximum_of_each};
use centrode_kinematics::machine::Key;
use centrode_machines::feeder::{Feeder, FeederError, FeederPart};

use crate::forces::{Balance, Forces, ForcesError};
use crate::key_pressure::LoadedKey;
use crate::{Report, Table, Unit};

/// Number of figures of a state: the torques of crank and input, and the force in every joint.
const FIGURES: usize = 2 + FeederForces::CONNECTIONS.len();

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
    /// The balance of forces has no solution.
    #[error(transparent)]
    Balance(#[from] ForcesError),
}

/// Forces of a feeder: the torque that its crank needs, and the forces in its joints. Plates, shafts and pins have mass, and
/// so have gears that can be cut.
///
/// The y axis points up. The inertia of the links is included in motion and omitted at rest. Friction and jumps of speed,
/// which have no finite force, are omitted.
#[derive(Clone, Debug)]
pub struct FeederForces {
    balance: Balance,
}

impl FeederForces {
    /// Joints of the linkage in the order of [`FeederForces::joints`]: shaft A of the crank, pin B, shaft D of the rocker, pin
    /// C on the rocker and on the slider, pivot F, and the slot on the slider.
    pub const CONNECTIONS: [&'static str; 7] =
        ["A", "B", "D", "C, rocker", "C, slider", "F", "slot"];

    /// Analyses a feeder that carries the mass given in its design.
    ///
    /// # Errors
    /// [`FeederForcesError`].
    pub fn analyse(feeder: &Feeder) -> Result<Self, FeederForcesError> {
        Self::new(feeder, feeder.design().drive.carried_mass)
    }

    /// Analyses a feeder that carries a mass (kg) at the tip of its effector.
    ///
    /// # Errors
    /// [`FeederForcesError`].
    pub fn new(feeder: &Feeder, carried: f64) -> Result<Self, FeederForcesError> {
        let mut machine = feeder.links(carried);
        let mut plates = Vec::new();
        for part in FeederPart::ALL
            .into_iter()
            .filter(|part| part.carrier().is_some())
        {
            let plate = feeder.plate(part)?;
            let bodies = feeder.bodies(&plate);
            plates.push(plate);
            let (_, mass) = bodies.map_err(|source| FeederForcesError::Solid {
                part: part.name(),
                source,
            })?;
            machine.links[part.link()].mass = Some(mass);
        }
        let mounted = feeder.mount_gears(&mut machine);
        mounted.map_err(|source| FeederForcesError::Solid {
            part: "gears",
            source,
        })?;
        // The frame's plate loads no link: no mass is set for it.
        plates.extend(feeder.plate(FeederPart::Frame));
        for pieces in feeder.turned(&plates) {
            machine.add_turned(&pieces, String::new());
        }
        let balance = Balance::new(machine)?;
        Ok(Self { balance })
    }

    /// Forces at an input angle, rad, with the feeder moving at the design's speed or at rest.
    ///
    /// # Errors
    /// [`FeederForcesError::Balance`].
    pub fn at(&self, input: f64, moving: bool) -> Result<Forces, FeederForcesError> {
        let speed = self.balance.machine().input.speed;
        Ok(self.balance.at(input, if moving { speed } else { 0.0 })?)
    }

    /// Torque that the crank needs, N mm, positive counter-clockwise.
    #[must_use]
    pub fn torque(forces: &Forces) -> f64 {
        forces.joints[FeederPart::Crank.joint()].drive
    }

    /// Forces in the joints, N, in the order of [`FeederForces::CONNECTIONS`]: on crank, coupler and rocker from the links
    /// that carry them, on rocker and slider from pin C, on the effector from its pivot, and on the slider from the slot.
    #[must_use]
    pub fn joints(forces: &Forces) -> [Vector; 7] {
        let on = |part: FeederPart| {
            let reaction = forces.joints[part.joint()].reaction;
            reaction.map_or_else(Vector::zeros, |reaction| reaction.force.xy())
        };
        let [coupler, slider] = [0, 1].map(|closure| forces.closures[closure].xy());
        [
            on(FeederPart::Crank),
            on(FeederPart::Coupler),
            on(FeederPart::Rocker),
            coupler + slider,
            -slider,
            on(FeederPart::Effector),
            on(FeederPart::Slider),
        ]
    }
}

/// Maximum torque and joint forces, at rest and moving.
pub(super) fn forces(feeder: &Feeder, report: &mut Report) {
    // A link that cannot be cut has its own finding.
    let Ok(system) = FeederForces::analyse(feeder) else {
        return;
    };
    let balanced = Cell::new(true);
    let sizes = |input: f64, moving: bool| -> [f64; FIGURES] {
        let Ok(forces) = system.at(input, moving) else {
            balanced.set(false);
            return [f64::NAN; FIGURES];
        };
        let joints = FeederForces::joints(&forces);
        std::array::from_fn(|k| match k.checked_sub(2) {
            None if k == 0 => FeederForces::torque(&forces).abs(),
            None => forces.input_torque.abs(),
            Some(joint) => joints[joint].norm(),
        })
    };
    let ends = feeder.pieces();
    let [still, moving] =
        [false, true].map(|moving| maximum_of_each(|input| sizes(input, moving), &ends));
    if !balanced.get() {
        return;
    }
    let values = &mut report.values;
    values.insert("crank_torque_still_max", still[0].value);
    values.insert("crank_torque_moving_max", moving[0].value);
    keys(feeder, [&still, &moving], report);
    let of = |Extreme { value, .. }: &Extreme| *value;
    let maximum = still.iter().zip(&moving).map(|(a, b)| vec![of(a), of(b)]);
    let rows = FeederForces::CONNECTIONS.iter().zip(maximum.skip(2));
    report.tables.push(Table {
        name: "joint_forces",
        title: "Maximum force in a joint",
        unit: Unit::Newton,
        columns: vec!["held still".into(), "moving".into()],
        rows: rows.map(|(name, row)| ((*name).into(), row)).collect(),
    });
}

/// Reports the pressure on the keys of both shafts at the maximum torques, at rest and moving, and the keys that are
/// overloaded. The crank's shaft transmits the torque of the crank, the other shaft that of the input.
fn keys(feeder: &Feeder, [still, moving]: [&[Extreme]; 2], report: &mut Report) {
    let (body, plates) = (feeder.design().gears.body(), &feeder.design().plates);
    let Some(hub) = body.keyway else {
        return;
    };
    let (gear, plate) = (&*body.material, &*plates.material);
    let [thin, wide] = [plates.thickness, body.width];
    // The key of the thin plate has square ends.
    let [square, fitting] = [Key::square(hub, thin), Key::fitting(hub, wide)];
    let [at_rest, in_motion] = ["crank_key_pressure_still_max", "crank_key_pressure_max"];
    let of_crank = [Some(at_rest), Some(in_motion), None];
    let of_gear = |figure| [None, None, Some(figure)];
    for (part, figures, (key, face), torque, material) in [
        ("crank", of_crank, (square, thin), 0, plate),
        (
            "gear-driven",
            of_gear("gear_driven_key_pressure_max"),
            (fitting, wide),
            0,
            gear,
        ),
        (
            "gear-driver",
            of_gear("gear_driver_key_pressure_max"),
            (fitting, wide),
            1,
            gear,
        ),
    ] {
        let Some(key) = key else {
            continue;
        };
        let [still, moving] = [still[torque], moving[torque]];
        let maximum = if still.value > moving.value {
            still
        } else {
            moving
        };
        let materials = [gear, material];
        let loaded = |torque| LoadedKey {
            key,
            hub,
            face,
            diameter: body.bore,
            materials: &materials,
            torque,
            part,
        };
        let all = figures.into_iter().zip([still, moving, maximum]);
        let all = all.filter_map(|(figure, torque)| Some((figure?, loaded(torque).pressure())));
        report.values.extend(all);
        loaded(maximum).check(report);
    }
}
