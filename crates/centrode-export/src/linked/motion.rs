use super::MODEL;
use super::motion_file::{
    ClosureWords, ColumnWords, InputWords, Interpolation, JointWords, LinearWords, MeshWords,
    MotionFile, PointWords,
};
use centrode_formats::csv::Column;
use centrode_geometry::{Tolerance, extremes, maximum, piece_ends};
use centrode_kinematics::machine::{Form, Joint, JointKind, LinkedMachine, Quantity};
use centrode_kinematics::transmission::Transmission;
use std::f64::consts::TAU;

/// Name of the table.
pub(super) const TABLE: &str = "motion.csv";
/// Minimum number of rows per turn of the input: one per half degree.
const FEWEST: f64 = 720.0;
/// Maximum number of rows of a cycle, unless [`FEWEST`] per turn gives more.
const MOST: f64 = 2e4;
/// Metres per millimetre.
const METRE: f64 = 1e-3;
/// Distance, rad or mm, below which a law counts as a straight line: rounding over a whole cycle.
const LINEAR: f64 = 1e-9;

/// Number of equal steps of the input in a cycle, and the maximum error of straight lines between them, mm: within the tolerance
/// if [`MOST`] steps suffice.
pub(super) fn steps(machine: &LinkedMachine, tolerance: Tolerance) -> (u32, f64) {
    let (period, bend) = (machine.input.period, bend(machine));
    let minimum = FEWEST * period / TAU;
    let steps = period * (bend / (8.0 * tolerance.mm())).sqrt();
    let steps = steps.max(minimum).min(MOST.max(minimum)).ceil();
    (steps as u32, bend * (period / steps).powi(2) / 8.0)
}

/// Maximum second derivative by the input of any position on a link, from its own joint alone, mm/rad^2: the error of a chord
/// over a step h is at most h^2/8 times this.
fn bend(machine: &LinkedMachine) -> f64 {
    let of = machine.joints.iter().map(|joint| {
        let size = match joint.kind {
            JointKind::Fixed => return 0.0,
            JointKind::Turning => reach(machine, joint.child),
            JointKind::Sliding(_) => 1.0,
        };
        let law = &joint.law;
        let ends = piece_ends(0.0, machine.input.period, 1, &within(law.as_ref(), machine));
        size * maximum(|input| law.at(input).acceleration.abs(), &ends).value
    });
    of.fold(0.0, f64::max)
}

/// Breaks of a law in a period of the machine.
pub(super) fn within(law: &dyn Transmission, machine: &LinkedMachine) -> Vec<f64> {
    let (own, period) = (law.period(), machine.input.period);
    let turns = (period / own).round().max(1.0) as u32;
    let breaks = law.breaks();
    (0..turns)
        .flat_map(|turn| breaks.iter().map(move |b| b + own * f64::from(turn)))
        .collect()
}

/// Maximum distance of a link's outlines, points and carried links from its origin, mm.
fn reach(machine: &LinkedMachine, link: usize) -> f64 {
    let norm = |at: &[f64; 3]| at.iter().map(|x| x * x).sum::<f64>().sqrt();
    let far = |outline: &centrode_geometry::Outline| {
        let bounds = outline.bounds();
        let corner = |x: f64, y: f64| x.hypot(y);
        corner(bounds.min.x, bounds.min.y).max(corner(bounds.max.x, bounds.max.y))
    };
    let own = &machine.links[link];
    let mut most: f64 = 0.0;
    for &surface in &own.surfaces {
        most = most.max(far(&machine.surfaces[surface].outline));
    }
    match own.shape.map(|shape| &machine.shapes[shape].form) {
        Some(Form::Solids(solids)) => {
            most = solids.iter().map(|s| far(s.outline())).fold(most, f64::max);
        }
        // Shafts and surroundings are not measured: gears and arms reach farther.
        Some(Form::Mesh(..) | Form::Turned(_) | Form::Body(_)) | None => {}
    }
    let points = machine.points.iter().filter(|point| point.link == link);
    most = points.map(|point| norm(&point.at)).fold(most, f64::max);
    let carried = machine.joints.iter().filter(|joint| joint.parent == link);
    carried
        .map(|joint| norm(&joint.origin) + reach(machine, joint.child))
        .fold(most, f64::max)
}

/// The straight line nearest to a joint's law over a period.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line {
    pub(super) slope: f64,
    offset: f64,
    /// Maximum distance of the law from it.
    off: f64,
}

impl Line {
    /// Whether the law equals the line within rounding.
    pub(super) fn is_law(&self) -> bool {
        self.off <= LINEAR
    }
}

/// The line of every joint.
pub(crate) fn lines(machine: &LinkedMachine) -> Vec<Line> {
    let line = |joint: &Joint| {
        let law = joint.law.as_ref();
        let slope = law.advance() / law.period();
        let ends = piece_ends(0.0, machine.input.period, 4, &within(law, machine));
        let [low, high] = extremes(|input| law.at(input).position - slope * input, &ends);
        Line {
            slope,
            offset: 0.5 * (low.value + high.value),
            off: 0.5 * (high.value - low.value),
        }
    };
    machine.joints.iter().map(line).collect()
}

/// The machine with a column for the rate of every joint that does not move evenly.
pub(super) fn with_rates(mut machine: LinkedMachine, lines: &[Line]) -> LinkedMachine {
    for (joint, line) in lines.iter().enumerate() {
        if line.is_law() || rate(&machine, joint).is_some() {
            continue;
        }
        if let Some((column, factor)) = position(&machine, joint) {
            let about = &machine.columns[column];
            let (name, unit) = (
                format!("{}_per_rad", about.name),
                format!("{}/rad", about.unit),
            );
            let meaning = format!("rate of {} by the input", about.name);
            let quantity = Quantity::rate(joint, 1, factor);
            machine.column(&name, &unit, &meaning, quantity);
        }
    }
    machine
}

/// The column that holds a derivative of a joint, and the factor in it.
fn derivative(machine: &LinkedMachine, of: usize, required: u8) -> Option<(usize, f64)> {
    let columns = machine.columns.iter().enumerate();
    columns
        .filter_map(|(column, about)| match about.quantity {
            Quantity::Joint {
                joint,
                order,
                factor,
            } if joint == of && order == required => Some((column, factor)),
            _ => None,
        })
        .next()
}

fn position(machine: &LinkedMachine, joint: usize) -> Option<(usize, f64)> {
    derivative(machine, joint, 0)
}

fn rate(machine: &LinkedMachine, joint: usize) -> Option<(usize, f64)> {
    derivative(machine, joint, 1)
}

/// The joint that drives all others: the first that turns at the input's speed, otherwise the first turning joint.
pub(super) fn driving(machine: &LinkedMachine, lines: &[Line]) -> Option<usize> {
    let turns = |&joint: &usize| {
        let line = &lines[joint];
        machine.joints[joint].kind == JointKind::Turning
            && (line.slope.abs() - 1.0).abs() <= LINEAR
            && line.is_law()
    };
    let all = 0..machine.joints.len();
    let first = || {
        all.clone()
            .find(|&j| machine.joints[j].kind == JointKind::Turning)
    };
    all.clone().find(turns).or_else(first)
}

/// The table of motion at equal steps of the input over one period.
pub(super) fn columns(machine: &LinkedMachine, steps: u32) -> Vec<Column> {
    let at = |i: u32| machine.input.period * f64::from(i) / f64::from(steps);
    let inputs: Vec<f64> = (0..=steps).map(at).collect();
    let column = |about: &centrode_kinematics::machine::Column| {
        let values = inputs
            .iter()
            .map(|&input| machine.value(&about.quantity, input));
        Column::numbers(&about.name, values)
    };
    machine.columns.iter().map(column).collect()
}

/// The description of the table and of the models for programs.
pub(super) fn description(
    machine: &LinkedMachine,
    lines: &[Line],
    steps: u32,
    linear_error_max_mm: f64,
) -> MotionFile {
    let link = |index: usize| machine.links[index].name.clone();
    let column = |index: usize| machine.columns[index].name.clone();
    let joint = |index: usize| {
        let about = &machine.joints[index];
        let (place, factor) = position(machine, index)?;
        let unit = match about.kind {
            JointKind::Fixed => return None,
            JointKind::Turning => 1.0,
            JointKind::Sliding(_) => METRE,
        };
        let rate = rate(machine, index);
        let line = &lines[index];
        let start = about.law.at(0.0).position;
        Some(JointWords {
            name: machine.joint_name(index),
            column: column(place),
            factor: unit / factor,
            offset: -unit * start + 0.0,
            rate: rate.map(|(index, _)| column(index)),
            rate_factor: rate.map_or(0.0, |(_, factor)| unit / factor),
            linear: LinearWords {
                multiplier: unit * line.slope,
                offset: unit * (line.offset - start),
                error_max: unit * line.off,
            },
            leader: about.leader.map(|leader| machine.joint_name(leader)),
            load: about.load.map(column),
        })
    };
    let place_of = |of: usize| {
        let named = machine.columns.iter().filter(
            move |column| matches!(column.quantity, Quantity::Point { point, .. } if point == of),
        );
        named.map(|column| column.name.clone()).collect()
    };
    MotionFile {
        format: "centrode-motion",
        version: 1,
        table: TABLE,
        models: ["urdf", "xml"].map(|end| format!("{MODEL}.{end}")),
        input: InputWords {
            name: machine.input.name.clone(),
            column: machine
                .columns
                .first()
                .map_or(String::new(), |c| c.name.clone()),
            period_rad: machine.input.period,
            speed_rad_per_s: machine.input.speed,
            joint: driving(machine, lines).map(|joint| machine.joint_name(joint)),
        },
        columns: machine
            .columns
            .iter()
            .map(|column| ColumnWords {
                name: column.name.clone(),
                unit: column.unit.clone(),
                meaning: column.meaning.clone(),
                advance: machine.advance(&column.quantity),
            })
            .collect(),
        rows: steps as usize + 1,
        interpolation: Interpolation {
            kind: "cubic Hermite",
            linear_error_max_mm,
        },
        joints: (0..machine.joints.len()).filter_map(joint).collect(),
        points: machine
            .points
            .iter()
            .enumerate()
            .map(|(index, point)| PointWords {
                name: point.name.clone(),
                link: link(point.link),
                at_mm: point.at,
                columns: place_of(index),
            })
            .collect(),
        meshes: machine
            .meshes
            .iter()
            .map(|mesh| MeshWords {
                links: mesh.links.map(link),
                joint: machine.joint_name(mesh.joint),
                copy: mesh.copy,
            })
            .collect(),
        closures: machine
            .closures
            .iter()
            .map(|closure| ClosureWords {
                links: closure.links.map(link),
                at_mm: closure.at,
                joints: closure.joints.map(|joint| machine.joint_name(joint)).into(),
            })
            .collect(),
    }
}
