use std::f64::consts::TAU;
use std::fmt::Write as _;

use centrode_geometry::Tolerance;
use centrode_mechanism::gear::Member;
use centrode_mechanism::three_arm::{Link, ThreeArm};

use super::machine::Machine;
use crate::csv::Column;

/// Fewest steps of a carrier turn: half degrees.
const FEWEST: f64 = 720.0;
/// Most steps.
const MOST: f64 = 1e5;
/// Places at which the greatest acceleration is looked for.
const LOOKS: u32 = 2880;

/// A joint of the simulator model: its name, the column of its law, and the factor from the column to what
/// simulators count in, rad or m.
#[derive(Clone, Debug)]
pub(super) struct Law {
    pub(super) joint: String,
    pub(super) column: String,
    pub(super) factor: f64,
    pub(super) meaning: String,
    kind: Kind,
}

#[derive(Clone, Copy, Debug)]
enum Kind {
    Carrier,
    Intermediate(u32),
    Planet(u32),
    Fork(u32),
    Rod(u32),
    Ground,
}

/// Every joint that moves.
pub(super) fn laws(machine: &Machine<'_>) -> Vec<Law> {
    let law = |joint: String, unit: &str, meaning: String, kind: Kind| Law {
        column: format!("{joint}_{unit}"),
        joint: format!("{joint}_joint"),
        factor: if unit == "mm" { 1e-3 } else { 1.0 },
        meaning,
        kind,
    };
    let mut all = vec![law(
        "carrier".into(),
        "rad",
        "direction of the first intermediate gear's axis from the x axis".into(),
        Kind::Carrier,
    )];
    for k in 0..machine.mechanism.arms() {
        all.extend([
            law(
                format!("intermediate_{k}"),
                "rad",
                "intermediate gear against the carrier".into(),
                Kind::Intermediate(k),
            ),
            law(
                format!("planet_{k}"),
                "rad",
                "planet, and the arm with it, against the carrier".into(),
                Kind::Planet(k),
            ),
            law(
                format!("fork_{k}"),
                "rad",
                "fork against its arm".into(),
                Kind::Fork(k),
            ),
            law(
                format!("push_rod_{k}"),
                "mm",
                "push rod along its arm's x axis, zero thrown out".into(),
                Kind::Rod(k),
            ),
        ]);
    }
    all.push(law(
        "ground".into(),
        "mm",
        "ground along the x axis, as the machine travels over it".into(),
        Kind::Ground,
    ));
    all
}

impl Law {
    /// Position of the joint at a carrier turn, in the column's unit.
    pub(super) fn at(&self, machine: &Machine<'_>, input: f64) -> f64 {
        let mechanism = machine.mechanism;
        let angle = |link: Link| mechanism.link(link, input).angle.position;
        let back = |k: u32| machine.pusher.retraction(mechanism.own_input(input, k));
        match self.kind {
            Kind::Carrier => angle(Link::Carrier),
            Kind::Intermediate(k) => angle(Link::Intermediate(k)) - angle(Link::Carrier),
            Kind::Planet(k) => angle(Link::Planet(k)) - angle(Link::Carrier),
            Kind::Fork(k) => machine.pusher.fork_angle(&back(k)).position,
            Kind::Rod(k) => -back(k).position,
            Kind::Ground => {
                let sign = mechanism.train().direction().sign();
                sign * mechanism.advance() * input
            }
        }
    }

    /// How far the joint has got after a carrier turn.
    fn advance(&self, machine: &Machine<'_>) -> f64 {
        let got = self.at(machine, TAU) - self.at(machine, 0.0);
        match self.kind {
            // Whole turns, to the last digit.
            Kind::Carrier | Kind::Intermediate(_) | Kind::Planet(_) => TAU * (got / TAU).round(),
            Kind::Fork(_) | Kind::Rod(_) => 0.0,
            Kind::Ground => got,
        }
    }
}

/// Carrier turns at equal steps over one turn: straight lines between them are within the tolerance of
/// where every point of an arm, a gear's rim and a rod is.
fn inputs(machine: &Machine<'_>, tolerance: Tolerance) -> Vec<f64> {
    let mechanism = machine.mechanism;
    let (_, rim) = mechanism.rolling().radii(Member::Driven);
    let reach = mechanism.design().arm.tip_distance.max(rim);
    let greatest = (0..LOOKS)
        .map(|i| {
            let input = TAU * f64::from(i) / f64::from(LOOKS);
            let jet = mechanism.train().at(input);
            let rod = machine.pusher.retraction(input).acceleration.abs();
            let gear = rim * jet.intermediate.acceleration.abs();
            rod.max(gear).max(reach * jet.planet.acceleration.abs())
        })
        .fold(0.0, f64::max);
    // A chord over a step h is off by at most h^2/8 times the greatest acceleration.
    let steps = TAU * (greatest / (8.0 * tolerance.mm())).sqrt();
    let steps = steps.clamp(FEWEST, MOST).ceil() as u32;
    (0..=steps)
        .map(|i| TAU * f64::from(i) / f64::from(steps))
        .collect()
}

/// Every joint over one carrier turn, and where the tips are in the machine's frame.
pub(super) fn columns(machine: &Machine<'_>, tolerance: Tolerance) -> Vec<Column> {
    let inputs = inputs(machine, tolerance);
    let mut columns = vec![Column::numbers("carrier_turn_rad", inputs.iter().copied())];
    for law in laws(machine) {
        let values = inputs.iter().map(|&input| law.at(machine, input));
        columns.push(Column::numbers(&law.column, values));
    }
    for k in 0..machine.mechanism.arms() {
        let tip = |input: &f64| machine.mechanism.tip(*input, k).position;
        let (x, y) = (format!("tip_{k}_x_mm"), format!("tip_{k}_y_mm"));
        columns.push(Column::numbers(&x, inputs.iter().map(|i| tip(i).x)));
        columns.push(Column::numbers(&y, inputs.iter().map(|i| tip(i).y)));
    }
    columns
}

/// What `motion.csv` means, as JSON for programs.
pub(super) fn sidecar(machine: &Machine<'_>, tolerance: Tolerance) -> Vec<u8> {
    let rows = inputs(machine, tolerance).len();
    let laws = laws(machine);
    let mechanism: &ThreeArm = machine.mechanism;
    let tip = machine.arm.tip();
    let mut columns = String::from(
        "    {\"name\": \"carrier_turn_rad\", \"unit\": \"rad\", \"meaning\": \"turn of the carrier from its start, positive whichever way it turns\"}",
    );
    let (mut joints, mut cycle) = (String::new(), String::new());
    // Writing to a string cannot fail.
    for (i, law) in laws.iter().enumerate() {
        let Law {
            joint,
            column,
            factor,
            meaning,
            ..
        } = law;
        let unit = if column.ends_with("_mm") { "mm" } else { "rad" };
        let _ = write!(
            columns,
            ",\n    {{\"name\": \"{column}\", \"unit\": \"{unit}\", \"meaning\": \"{meaning}\"}}"
        );
        let comma = if i == 0 { "" } else { ",\n" };
        let _ = write!(
            joints,
            "{comma}    {{\"name\": \"{joint}\", \"column\": \"{column}\", \"factor\": {factor:?}, \"offset\": {:?}}}",
            -factor * law.at(machine, 0.0) + 0.0
        );
        let _ = write!(cycle, ", \"{column}\": {:?}", law.advance(machine));
    }
    for k in 0..mechanism.arms() {
        for axis in ["x", "y"] {
            let _ = write!(
                columns,
                ",\n    {{\"name\": \"tip_{k}_{axis}_mm\", \"unit\": \"mm\", \"meaning\": \"tip of arm {k} in the machine's frame\"}}"
            );
        }
    }
    format!(
        r#"{{
  "table": "motion.csv",
  "input": "carrier_turn_rad",
  "columns": [
{columns}
  ],
  "rows": {rows},
  "joints": [
{joints}
  ],
  "interpolation": {{"kind": "linear", "steps": "equal", "error_max_mm": {error:?}}},
  "continuation": {{"kind": "cyclic", "carrier_turn_rad": {TAU:?}{cycle}}},
  "arms": {arms},
  "tip_in_arm_mm": [{x:?}, {y:?}],
  "carrier_speed_rad_per_s": {speed:?}
}}
"#,
        error = tolerance.mm(),
        arms = mechanism.arms(),
        x = tip.x,
        y = tip.y,
        speed = mechanism.carrier_speed(),
    )
    .into_bytes()
}
