use std::sync::{Mutex, PoisonError};

use centrode_geometry::{Antiderivative, Extreme, maxima, rounding};
use centrode_kinematics::machine::{JointKind, LinkedMachine, Load};
use centrode_machines::machine::{Machine, MachineFigure};

use super::{ends, keys};
use crate::forces::{Balance, Forces, ForcesError};
use crate::{Finding, Report, Severity, Table, Unit};

/// Rounding of the torque, in units of the rounding of one product of a force and an arm. Ten times less follows
/// rounding, ten times more misses small peaks.
const ROUNDING: f64 = 1e3;

/// Rounding of a force, in units of the rounding of its value: it grows with the distance from the origin and the number of
/// links. A tenth of this would follow the rounding of constant forces; ten times as much would miss a peak 4e-11 of its size
/// above the samples.
const LOST: f64 = 4096.0;

/// A composed machine with its masses and loads, at the design's speed.
pub(super) struct Loaded {
    balance: Balance,
    period: f64,
    /// Ends of the parts of a cycle between which all forces are smooth.
    ends: Vec<f64>,
    /// First reason why a state has no forces.
    failed: Mutex<Option<ForcesError>>,
}

impl Loaded {
    pub(super) fn new(composed: &Machine, machine: &LinkedMachine) -> Result<Self, ForcesError> {
        Ok(Self {
            balance: Balance::new(machine.clone())?,
            period: composed.period(),
            ends: ends(composed),
            failed: Mutex::new(None),
        })
    }

    /// Forces at an input; `None` if they are not determined.
    pub(super) fn at(&self, input: f64) -> Option<Forces> {
        let speed = self.balance.machine().input.speed;
        match self.balance.at(input, speed) {
            Ok(forces) => Some(forces),
            Err(error) => {
                let failed = self.failed.lock();
                let mut failed = failed.unwrap_or_else(PoisonError::into_inner);
                failed.get_or_insert(error);
                None
            }
        }
    }

    /// A figure of the forces at an input, N or N mm; NaN if it is not a figure of forces or not determined.
    pub(super) fn value(&self, figure: &MachineFigure, input: f64) -> f64 {
        let found = self.at(input);
        found
            .and_then(|forces| part(&forces, figure))
            .unwrap_or(f64::NAN)
    }

    /// Maximum over the cycle of each of several values of the forces; minus infinity for a value that is not determined.
    /// Differences within the rounding of `size` are not followed.
    fn maximum(
        &self,
        count: usize,
        size: f64,
        of: impl Fn(&Forces, f64) -> Vec<f64> + Sync,
    ) -> Vec<Extreme> {
        let found = |input: f64| match self.at(input) {
            Some(forces) => of(&forces, input),
            None => vec![f64::NAN; count],
        };
        maxima(
            count,
            |input: f64, values: &mut Vec<f64>| values.extend(found(input)),
            |k: usize, input: f64| found(input)[k],
            |_, value| rounding(size.max(LOST * value.abs())),
            &self.ends,
        )
    }
}

/// A figure of the forces of a state, N or N mm; `None` if it is not a figure of forces or not determined. Forces in joints
/// and pins are magnitudes; the force of a mesh has the sign of [`crate::forces::ToothForce`].
pub(super) fn part(forces: &Forces, figure: &MachineFigure) -> Option<f64> {
    match *figure {
        MachineFigure::InputTorque => Some(forces.input_torque),
        MachineFigure::JointForce(joint) => {
            let reaction = forces.joints.get(joint)?.reaction?;
            Some(reaction.force.xy().norm())
        }
        MachineFigure::PinForce(pin) => Some(forces.closures.get(pin)?.xy().norm()),
        MachineFigure::MeshForce(mesh) => forces.meshes.get(mesh)?.normal,
        _ => None,
    }
}

/// Whether a cycle of a machine returns all the work that it takes: without loads and friction only weight and inertia act.
fn returns_all_work(machine: &LinkedMachine) -> bool {
    let masses = |load: &Load| matches!(load, Load::Mass { .. });
    machine.loads.iter().all(masses) && machine.guides.is_empty()
}

/// Reports the torque of the input, the maximum force of every joint and pin, the minimum and maximum force of every mesh, and
/// the pressure on the keys of shafts.
pub(super) fn forces(
    loaded: &Result<Loaded, ForcesError>,
    composed: &Machine,
    machine: &LinkedMachine,
    report: &mut Report,
) {
    let loaded = match loaded {
        Ok(loaded) => loaded,
        Err(error) => return undetermined(error, report),
    };
    let joints = machine.joints.iter().enumerate();
    let moving = joints.filter(|(_, joint)| joint.kind != JointKind::Fixed);
    let mut rows: Vec<(String, MachineFigure)> = moving
        .map(|(index, joint)| {
            let name = machine.links[joint.child].name.clone();
            (name, MachineFigure::JointForce(index))
        })
        .collect();
    let pair = |links: [usize; 2]| {
        links
            .map(|link| machine.links[link].name.as_str())
            .join("-")
    };
    let pins = machine.closures.iter().enumerate();
    rows.extend(pins.map(|(index, pin)| (pair(pin.links), MachineFigure::PinForce(index))));
    let joints = rows.len();
    let meshes = machine.meshes.iter().enumerate();
    rows.extend(meshes.map(|(index, mesh)| (pair(mesh.links), MachineFigure::MeshForce(index))));
    let keys = keys::under_load(composed);
    let arms = arms(composed, machine);
    let signed = rows.len() - joints;
    let found = loaded.maximum(rows.len() + signed + 1, 0.0, |forces, _| {
        let figures = rows.iter().map(|(_, figure)| part(forces, figure));
        let figures: Vec<Option<f64>> = figures.collect();
        let minima = figures[joints..]
            .iter()
            .map(|value| value.map(|value| -value));
        let of_links = forces.loads.iter().zip(&arms);
        let load = of_links.fold(0.0, |most: f64, (load, arm)| {
            most.max(load.force).max(load.torque / arm)
        });
        let all = figures.iter().copied().chain(minima).chain([Some(load)]);
        all.map(|value| value.unwrap_or(f64::NAN)).collect()
    });
    let (found, load) = found.split_at(rows.len() + signed);
    let (found_rows, minima) = found.split_at(rows.len());
    // Differences of a torque within the rounding of the moments of all forces need not be followed.
    let force = found.iter().map(|found| found.value).fold(0.0, f64::max);
    let origins = machine.joints.iter().map(|joint| joint.origin);
    let arm = origins.map(|[x, y, _]| x.hypot(y)).fold(0.0, f64::max);
    let torques = loaded.maximum(2 + keys.len(), ROUNDING * force * arm, |forces, input| {
        let keys = keys.iter().map(|key| key.torque(composed, forces, input));
        let torque = forces.input_torque;
        [torque, -torque].into_iter().chain(keys).collect()
    });
    let (low, high) = (-torques[1].value, torques[0].value);
    let mean = if returns_all_work(machine) {
        0.0
    } else {
        let torque = |input: f64| loaded.value(&MachineFigure::InputTorque, input);
        let size = ROUNDING * high.abs().max(low.abs()).max(force * arm);
        Antiderivative::with_scale(torque, &loaded.ends, size).total() / loaded.period
    };
    let failed = loaded.failed.lock();
    if let Some(error) = failed.unwrap_or_else(PoisonError::into_inner).as_ref() {
        return undetermined(error, report);
    }
    let values = &mut report.values;
    values.insert("input_torque_min", low);
    values.insert("input_torque_max", high);
    values.insert("input_torque_mean", mean);
    let largest = rows[joints..].iter().zip(minima).zip(&found_rows[joints..]);
    let of_meshes = largest.map(|(((name, _), low), high)| {
        let largest = if low.value > high.value { low } else { high };
        (name, "mesh", *largest)
    });
    let of_joints = rows[..joints].iter().zip(found_rows);
    let of_joints = of_joints.map(|((name, figure), found)| match figure {
        MachineFigure::PinForce(_) => (name, "pin", *found),
        _ => (name, "joint", *found),
    });
    excessive(of_joints.chain(of_meshes), load[0].value, report);
    keys::check(composed, &keys, &torques[2..], report);
    // Figures that are not determined are minus infinity.
    let of_joints = rows[..joints].iter().zip(found_rows);
    let of_joints = of_joints.map(|((name, _), found)| (name.clone(), vec![found.value]));
    let of_meshes = rows[joints..].iter().zip(minima).zip(&found_rows[joints..]);
    let of_meshes =
        of_meshes.map(|(((name, _), low), high)| (name.clone(), vec![-low.value, high.value]));
    let known = |(_, values): &(String, Vec<f64>)| values.iter().all(|value| value.is_finite());
    report.table(
        Table::new("joint-forces", "Maximum force of joint", Unit::Newton)
            .columns(["force"])
            .rows(of_joints.filter(known).collect()),
    );
    report.table(
        Table::new("mesh-forces", "Force of mesh, signed", Unit::Newton)
            .columns(["minimum", "maximum"])
            .rows(of_meshes.filter(known).collect()),
    );
}

/// Arm of a torque on each link, mm: the minimum pitch radius of its gears or, without gears, the length of the machine's
/// shortest bar.
fn arms(composed: &Machine, machine: &LinkedMachine) -> Vec<f64> {
    let pins = machine.closures.iter().map(|pin| pin.at);
    let ends = machine.joints.iter().map(|joint| joint.origin).chain(pins);
    let bars = ends.map(|[x, y, _]| x.hypot(y));
    let shortest = bars.filter(|bar| *bar > 0.0).fold(f64::INFINITY, f64::min);
    let mut arms = vec![f64::INFINITY; machine.links.len()];
    for gear in composed.gears() {
        if let Some(body) = composed.body_named(gear.body_name()) {
            let radius = gear.pair.rolling().radii(gear.member).0;
            arms[body] = arms[body].min(radius);
        }
    }
    for arm in arms.iter_mut().filter(|arm| arm.is_infinite()) {
        *arm = shortest;
    }
    arms
}

/// Ratio of the force of a joint, pin or mesh to the largest load above which the machine cannot be driven: a friction
/// coefficient or a relative error of a length of 0.001 then takes the whole load. A tenth of this would refuse toggle
/// presses.
const EXCESSIVE: f64 = 1e3;

/// Reports the largest of the forces if it exceeds [`EXCESSIVE`] times the largest load, N. Each force has the name and kind
/// of its joint, pin or mesh.
fn excessive<'a>(
    forces: impl Iterator<Item = (&'a String, &'static str, Extreme)>,
    load: f64,
    report: &mut Report,
) {
    let largest = forces.max_by(|a, b| a.2.value.total_cmp(&b.2.value));
    let Some((name, kind, force)) = largest.filter(|(.., force)| force.value > EXCESSIVE * load)
    else {
        return;
    };
    if load > 0.0 {
        let message = format!(
            "the force of {kind} {name} reaches {:.3e} N, {:.0} times the largest load of {load:.4} N: the machine nearly locks there",
            force.value,
            force.value / load
        );
        let remedy = "other lengths, another pressure angle or a gentler ratio, so that the driving force acts along the motion";
        Finding::new("excessive-force", Severity::Error, message)
            .measured(force.value, EXCESSIVE * load, Unit::Newton)
            .remedy(remedy)
            .on(name.clone())
            .at(force.input)
            .add_to(report);
    }
}

/// Reports why the forces are not known. A dead position, in which they grow beyond bounds, is an error.
fn undetermined(error: &ForcesError, report: &mut Report) {
    Finding::new(
        "forces-undetermined",
        match error {
            ForcesError::Dead { .. } => Severity::Error,
            _ => Severity::Note,
        },
        format!("the forces cannot be computed: {error}"),
    )
    .measured(None, None, Unit::Newton)
    .add_to(report);
}
