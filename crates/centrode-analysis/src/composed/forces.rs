use std::sync::{Mutex, PoisonError};

use centrode_geometry::{Antiderivative, Extreme, greatest_of, rounding};
use centrode_mechanism::composed::{Composed, ComposedFigure};
use centrode_mechanism::machine::{JointKind, Load, Machine};

use super::{ends, keys};
use crate::forces::{Balance, Forces, ForcesError};
use crate::{Finding, Place, Report, Severity, Table, Unit};

/// Rounding of the torque, in that of a single product of a force and an arm.
const ROUNDING: f64 = 1e3;

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
    pub(super) fn new(composed: &Composed, machine: &Machine) -> Result<Self, ForcesError> {
        Ok(Self {
            balance: Balance::new(machine.clone())?,
            period: composed.period(),
            ends: ends(composed),
            failed: Mutex::new(None),
        })
    }

    /// Forces at an input; none where they are not determined.
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

    /// A figure of the forces at an input, N or N mm; not a number where it is none of theirs or not determined.
    pub(super) fn value(&self, figure: &ComposedFigure, input: f64) -> f64 {
        let found = self.at(input);
        found
            .and_then(|forces| part(&forces, figure))
            .unwrap_or(f64::NAN)
    }

    /// The greatest of each of several values of the forces at an input; minus infinity for one that is not determined.
    fn greatest(&self, count: usize, of: impl Fn(&Forces, f64) -> Vec<f64> + Sync) -> Vec<Extreme> {
        let found = |input: f64| match self.at(input) {
            Some(forces) => of(&forces, input),
            None => vec![f64::NAN; count],
        };
        greatest_of(
            count,
            |input: f64, values: &mut Vec<f64>| values.extend(found(input)),
            |k: usize, input: f64| found(input)[k],
            |_, value| rounding(value),
            &self.ends,
        )
    }
}

/// A figure of the forces of a state, N or N mm; none where it is none of theirs or not determined.
pub(super) fn part(forces: &Forces, figure: &ComposedFigure) -> Option<f64> {
    match *figure {
        ComposedFigure::InputTorque => Some(forces.input_torque),
        ComposedFigure::JointForce(joint) => {
            let reaction = forces.joints.get(joint)?.reaction?;
            Some(reaction.force.xy().norm())
        }
        ComposedFigure::PinForce(pin) => Some(forces.closures.get(pin)?.xy().norm()),
        ComposedFigure::MeshForce(mesh) => Some(forces.meshes.get(mesh)?.normal?.abs()),
        _ => None,
    }
}

/// Whether a cycle of a composed machine gives back all the work that it takes: without loads and friction, weight and inertia alone.
fn returns_all_work(machine: &Machine) -> bool {
    let masses = |load: &Load| matches!(load, Load::Mass { .. });
    machine.loads.iter().all(masses) && machine.guides.is_empty()
}

/// Torque of the input, the greatest force of every joint, pin and mesh, and the pressure on the keys of shafts.
pub(super) fn forces(
    loaded: &Result<Loaded, ForcesError>,
    composed: &Composed,
    machine: &Machine,
    report: &mut Report,
) {
    let loaded = match loaded {
        Ok(loaded) => loaded,
        Err(error) => return undetermined(error, report),
    };
    let joints = machine.joints.iter().enumerate();
    let moving = joints.filter(|(_, joint)| joint.kind != JointKind::Fixed);
    let mut rows: Vec<(String, ComposedFigure)> = moving
        .map(|(index, joint)| {
            let name = machine.links[joint.child].name.clone();
            (name, ComposedFigure::JointForce(index))
        })
        .collect();
    let pair = |links: [usize; 2]| {
        links
            .map(|link| machine.links[link].name.as_str())
            .join("-")
    };
    let pins = machine.closures.iter().enumerate();
    rows.extend(pins.map(|(index, pin)| (pair(pin.links), ComposedFigure::PinForce(index))));
    let joints = rows.len();
    let meshes = machine.meshes.iter().enumerate();
    rows.extend(meshes.map(|(index, mesh)| (pair(mesh.links), ComposedFigure::MeshForce(index))));
    let keys = keys::under_load(composed);
    let arms = arms(composed, machine);
    let found = loaded.greatest(rows.len() + 3 + keys.len(), |forces, input| {
        let figures = rows.iter().map(|(_, figure)| part(forces, figure));
        let torque = forces.input_torque;
        let keys = keys
            .iter()
            .map(|key| Some(key.torque(composed, forces, input)));
        let of_links = forces.loads.iter().zip(&arms);
        let load = of_links.fold(0.0, |most: f64, (load, arm)| {
            most.max(load.force).max(load.torque / arm)
        });
        let all = figures.chain([-torque, torque, load].map(Some)).chain(keys);
        all.map(|value| value.unwrap_or(f64::NAN)).collect()
    });
    let (low, high) = (-found[rows.len()].value, found[rows.len() + 1].value);
    let mean = if returns_all_work(machine) {
        0.0
    } else {
        let torque = |input: f64| loaded.value(&ComposedFigure::InputTorque, input);
        // The rounding of the torque, that of the moments of all forces, need not be followed.
        let force = found[..rows.len()].iter().map(|found| found.value);
        let force = force.fold(0.0, f64::max);
        let arms = machine.joints.iter().map(|joint| joint.origin);
        let arm = arms.map(|[x, y, _]| x.hypot(y)).fold(0.0, f64::max);
        let size = ROUNDING * high.abs().max(low.abs()).max(force * arm);
        Antiderivative::of_size(torque, &loaded.ends, size).total() / loaded.period
    };
    let failed = loaded.failed.lock();
    if let Some(error) = failed.unwrap_or_else(PoisonError::into_inner).as_ref() {
        return undetermined(error, report);
    }
    let values = &mut report.values;
    values.insert("input_torque_min", low);
    values.insert("input_torque_max", high);
    values.insert("input_torque_mean", mean);
    excessive(&rows, &found, report);
    keys::check(composed, &keys, &found[rows.len() + 3..], report);
    let row = |((name, _), extreme): (&(String, ComposedFigure), &Extreme)| {
        (extreme.value >= 0.0).then(|| (name.clone(), vec![extreme.value]))
    };
    let mut all = rows.iter().zip(&found);
    let of_joints = all.by_ref().take(joints).filter_map(row).collect();
    let of_meshes = all.filter_map(row).collect();
    for (name, title, rows) in [
        ("joint-forces", "Greatest force of joint", of_joints),
        ("mesh-forces", "Greatest force of mesh", of_meshes),
    ] {
        let rows: Vec<(String, Vec<f64>)> = rows;
        if !rows.is_empty() {
            report.tables.push(Table {
                name,
                title,
                unit: Unit::Newton,
                columns: vec!["force".into()],
                rows,
            });
        }
    }
}

/// Arm of a torque on each link, mm: the minimum pitch radius of its gears, or else the length of the shortest bar.
fn arms(composed: &Composed, machine: &Machine) -> Vec<f64> {
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

/// Force of a joint, pin or mesh, by the largest load, above which the machine cannot be driven: a thousandth of friction or
/// of an error in a length takes the whole load there. Ten times less would refuse toggle presses.
const EXCESSIVE: f64 = 1e3;

/// Reports the largest force where it is out of all proportion to the loads, which follow the forces in `found`.
fn excessive(rows: &[(String, ComposedFigure)], found: &[Extreme], report: &mut Report) {
    let load = found[rows.len() + 2].value;
    let largest = rows.iter().zip(found);
    let largest = largest.max_by(|a, b| a.1.value.total_cmp(&b.1.value));
    let Some(((name, figure), force)) = largest.filter(|(_, force)| force.value > EXCESSIVE * load)
    else {
        return;
    };
    if load > 0.0 {
        let kind = match figure {
            ComposedFigure::MeshForce(_) => "mesh",
            ComposedFigure::PinForce(_) => "pin",
            _ => "joint",
        };
        report.findings.push(Finding {
            rule: "excessive-force",
            severity: Severity::Error,
            message: format!(
                "the force of {kind} {name} reaches {:.3e} N, {:.0} times the largest load of {load:.4} N: the machine nearly locks there",
                force.value,
                force.value / load
            ),
            measured: Some(force.value),
            required: Some(EXCESSIVE * load),
            unit: Unit::Newton,
            remedy: Some(
                "other lengths, another pressure angle or a gentler ratio, so that the driving force acts along the motion",
            ),
            place: Place {
                part: Some(name.clone()),
                input: Some(force.input),
                ..Place::default()
            },
        });
    }
}

/// Reports why the forces are not known: a dead position, where they grow beyond bounds, is an error.
fn undetermined(error: &ForcesError, report: &mut Report) {
    report.findings.push(Finding {
        rule: "forces-undetermined",
        severity: match error {
            ForcesError::Dead { .. } => Severity::Error,
            _ => Severity::Note,
        },
        message: format!("there are no forces: {error}"),
        measured: None,
        required: None,
        unit: Unit::Newton,
        remedy: None,
        place: Place::default(),
    });
}
