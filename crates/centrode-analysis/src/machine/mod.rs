//! Check of a composed machine.

mod cams;
mod clearance;
mod collisions;
mod figures;
mod forces;
mod goals;
mod held;
mod joints;
mod keys;
mod layers;
mod motion;
mod pairs;
mod sound_teeth;
#[cfg(test)]
mod tests;
mod through;

use std::f64::consts::PI;
use std::sync::{Arc, OnceLock};

use centrode_geometry::{Extreme, piece_ends};
use centrode_kinematics::machine::{LinkedMachine, Supply};
use centrode_machines::machine::{Hardware, Machine};

pub use self::clearance::machine_clearance;
pub use self::collisions::machine_collisions;
use self::figures::FIGURES;
use self::forces::Loaded;
pub use self::goals::machine_figures;
pub use self::layers::machine_layers;
use self::motion::Motion;
pub use self::sound_teeth::{NoSoundTeeth, SoundTeeth, with_sound_teeth};
use crate::forces::ForcesError;
use crate::progress::filling;
use crate::report::Missed;
use crate::rounding::exceeds;
use crate::side_by_side::both;
use crate::{Finding, Goal, Report, Severity, Table, Unit};

/// Number of parts of a turn of the input. In each part a motion has few extremes. Fewer parts can miss extremes, more
/// take longer.
const PARTS: u32 = 16;
/// Minimum transmission angle of a dyad, degrees: below it friction may lock the dyad.
const HOLDS_BADLY: f64 = 30.0;
/// Distance, rad, from the start or the end of the cycle within which an extreme counts as at the start. Extremes are accurate
/// to the square root of rounding.
const NEAR: f64 = 1e-7;

/// Checks a composed machine: transmission angles, dead centres, paths and speeds of points, teeth, cams, forces and
/// collisions.
///
/// Lengths are mm, angles rad, speeds mm/s. Every extreme is over the whole cycle.
#[must_use]
pub fn check_machine(composed: &Machine) -> Report {
    // The check of teeth takes about as long as the motion and does not depend on it.
    let (pairs, motion) = both(
        || filling([0.0, 0.7], || pairs::checked(composed)),
        || Motion::new(composed, &ends(composed)),
    );
    let made = Made {
        pairs: OnceLock::from(pairs),
        ..Made::new(composed)
    };
    checked(&made, motion, Depth::Whole)
}

/// Checks only the motion of a composed machine: [`check_machine`] without teeth, cams, forces and collisions, except for
/// goals that need them.
#[must_use]
pub fn check_machine_motion(composed: &Machine) -> Report {
    let motion = Motion::new(composed, &ends(composed));
    checked(&Made::new(composed), motion, Depth::Motion)
}

/// Checks only the goals of a composed machine: those of [`check_machine_motion`], without its figures.
#[must_use]
pub fn check_machine_goals(composed: &Machine) -> Report {
    let mut report = Report::default();
    add_goals(&Made::new(composed), &mut report);
    report
}

/// Extent of a check.
#[derive(Clone, Copy, Eq, PartialEq)]
enum Depth {
    Motion,
    Whole,
}

fn checked(made: &Made<'_>, motion: Motion, depth: Depth) -> Report {
    let composed = made.composed;
    let mut report = Report {
        groups: FIGURES.to_vec(),
        ..Report::default()
    };
    let values = &mut report.values;
    values.insert("period", composed.period());
    values.insert("input_rpm", composed.design().input.speed_rpm);
    values.insert("body_count", composed.bodies().len() as f64 - 1.0);
    values.insert("dyad_count", composed.dyads().len() as f64);
    let [x, y] = composed.design().gravity.unwrap_or_default();
    values.insert("gravity", x.hypot(y));
    let is_whole = depth == Depth::Whole;
    dyads(composed, &motion, &mut report);
    joints::tables(composed, &mut report);
    joints::joints(composed, &motion, &mut report);
    joints::four_bars(composed, &mut report);
    if is_whole {
        cams::cams(composed, &mut report);
    }
    points(composed, motion, &mut report);
    if is_whole {
        if let (Some(machine), Some(loaded)) = (made.machine(), made.loaded()) {
            forces::forces(loaded, composed, machine, &mut report);
        }
        held::held(composed, &mut report);
        pairs::pairs(made, &mut report);
        let ends = ends(composed);
        collisions::collisions(made, &ends, &mut report);
        layers::layers(composed, &ends, &mut report);
        not_designed(made, &mut report);
    }
    add_goals(made, &mut report);
    in_file_order(composed, &mut report);
    report.worst_first();
    report
}

/// Puts tables with a row for each part, and findings of one rule, in the order of the design file.
fn in_file_order(composed: &Machine, report: &mut Report) {
    // A dyad may have the name of a body.
    let dyad = |name: &str| {
        let dyads = &composed.design().dyads;
        dyads.get_index_of(composed.original(name))
    };
    for table in &mut report.tables {
        let rows = &mut table.rows;
        if rows.iter().all(|(name, _)| dyad(name).is_some()) {
            rows.sort_by_key(|(name, _)| dyad(name));
        } else {
            rows.sort_by_key(|(name, _)| composed.place_in_file(name));
        }
    }
    let rules: Vec<&str> = report.findings.iter().map(|found| found.rule).collect();
    report.findings.sort_by_cached_key(|found| {
        let rule = rules.iter().position(|rule| *rule == found.rule);
        let part = found.place.part.as_deref().unwrap_or_default();
        (rule, composed.place_in_file(part))
    });
}

/// Adds a note on the parts that the design leaves to the customer.
fn not_designed(made: &Made<'_>, report: &mut Report) {
    let hardware = made.composed.design().hardware();
    let given = made
        .machine()
        .into_iter()
        .flat_map(|machine| &machine.parts);
    let given = given.filter(|part| part.supply == Supply::Given);
    let mut given: Vec<String> = given
        .map(|part| match part.quantity() {
            0 | 1 => part.name.clone(),
            n => format!("{n} of {}", part.name),
        })
        .collect();
    // The frame is last in the list, but it is the most important part.
    given.reverse();
    let (message, remedy) = match hardware {
        Hardware::None => (
            "bodies, frame, pins, shafts, bearings and springs are not designed: only gears and cams have drawings and solids, and a body has no mass unless the design gives it".to_owned(),
            Some("hardware = \"list\" for plates and a table per axis"),
        ),
        _ if given.is_empty() => return,
        Hardware::List => (
            format!("left to the customer: {}", given.join(", ")),
            Some("hardware = \"full\" for a frame, pins and shafts"),
        ),
        Hardware::Full => (format!("left to the customer: {}", given.join(", ")), None),
    };
    report
        .findings
        .push(Finding::new("not-designed", Severity::Note, message).remedy(remedy));
}

/// Adds the goals to a report, and a finding for each missed goal.
fn add_goals(made: &Made<'_>, report: &mut Report) {
    let found = goals::goals(made);
    clearance::apart(made.composed, &found, report);
    report.goals = found.iter().map(|found| found.goal.clone()).collect();
    report.blame_goals(|goal| Missed {
        input: found
            .iter()
            .find(|f| f.goal.name == goal.name)
            .and_then(|f| f.input),
        ..Missed::default()
    });
}

/// The goals of a composed machine with their figures.
#[must_use]
pub fn machine_goals(composed: &Machine) -> Vec<Goal> {
    let found = goals::goals(&Made::new(composed)).into_iter();
    found.map(|found| found.goal).collect()
}

/// A composed machine with the results that its checks share, each computed at its first use.
struct Made<'a> {
    composed: &'a Machine,
    outlined: OnceLock<Option<LinkedMachine>>,
    machine: OnceLock<Option<LinkedMachine>>,
    loaded: OnceLock<Option<Result<Loaded, ForcesError>>>,
    pairs: OnceLock<Vec<Arc<Report>>>,
}

impl<'a> Made<'a> {
    fn new(composed: &'a Machine) -> Self {
        Self {
            composed,
            outlined: OnceLock::new(),
            machine: OnceLock::new(),
            loaded: OnceLock::new(),
            pairs: OnceLock::new(),
        }
    }

    /// The bodies as links; `None` if a plate is not a solid.
    fn machine(&self) -> Option<&LinkedMachine> {
        let made = || self.composed.machine().ok();
        self.machine.get_or_init(made).as_ref()
    }

    /// The links with their contours, and with all other data if these are known already; `None` if a plate is not a solid.
    fn outlined(&self) -> Option<&LinkedMachine> {
        match self.machine.get() {
            Some(made) => made.as_ref(),
            None => {
                let made = || self.composed.outlined().ok();
                self.outlined.get_or_init(made).as_ref()
            }
        }
    }

    /// Reports of the gear pairs.
    fn pairs(&self) -> &[Arc<Report>] {
        self.pairs.get_or_init(|| pairs::checked(self.composed))
    }

    /// The forces; `None` if there is no `machine`, because a plate is not a solid.
    fn loaded(&self) -> Option<&Result<Loaded, ForcesError>> {
        let made = || {
            self.machine()
                .map(|machine| Loaded::new(self.composed, machine))
        };
        self.loaded.get_or_init(made).as_ref()
    }
}

/// Ends of the parts of a cycle between which all motion and load is smooth.
fn ends(composed: &Machine) -> Vec<f64> {
    within(composed, 0.0, composed.period())
}

/// Ends of the parts of an interval of inputs between which all motion and load is smooth.
fn within(composed: &Machine, from: f64, to: f64) -> Vec<f64> {
    let (period, jumps) = (composed.period(), composed.breaks());
    let cycles = (from / period).floor() as i64..=(to / period).floor() as i64;
    let breaks: Vec<f64> = cycles
        .flat_map(|cycle| {
            let breaks = jumps.iter();
            breaks.map(move |b| b + cycle as f64 * period)
        })
        .collect();
    let parts = (f64::from(PARTS) * (to - from) / std::f64::consts::TAU).ceil();
    piece_ends(from, to, parts as u32, &breaks)
}

/// Reports the transmission angles of the dyads.
fn dyads(composed: &Machine, motion: &Motion, report: &mut Report) {
    let mut rows = Vec::new();
    for (dyad, &[low, high]) in composed.dyads().iter().zip(&motion.angles) {
        let [low, high] = [low, high].map(|end| Extreme {
            input: match end.input.min(composed.period() - end.input) < NEAR {
                true => 0.0,
                false => end.input,
            },
            ..end
        });
        let row = vec![low.value, low.input, high.value, high.input];
        rows.push((dyad.name.clone(), row));
        // A transmission angle of 150 degrees is as bad as one of 30.
        let obtuse = PI - high.value < low.value;
        let (end, held) = match obtuse {
            true => (high, PI - high.value),
            false => (low, low.value),
        };
        let worst = report.values.get("transmission_angle_min").copied();
        let worst = worst.unwrap_or(f64::INFINITY).min(held);
        report.values.insert("transmission_angle_min", worst);
        if exceeds(HOLDS_BADLY, held.to_degrees()) {
            let (reaches, limit) = match obtuse {
                true => ("rises", format!("above {:.0}", 180.0 - HOLDS_BADLY)),
                false => ("falls", format!("below {HOLDS_BADLY}")),
            };
            let degrees = end.value.to_degrees();
            let message = format!(
                "the transmission angle of dyad {} {reaches} to {degrees:.2} deg: {limit} deg friction may lock it",
                dyad.name
            );
            Finding::new("transmission-angle", Severity::Warning, message)
                .measured(held, HOLDS_BADLY.to_radians(), Unit::Angle)
                .remedy("bars that are longer relative to the motion that drives them, or other positions of the pins")
                .on(dyad.name.clone())
                .at(end.input)
                .add_to(report);
        }
    }
    report.table(
        Table::new(
            "transmission-angles",
            "Transmission angle of dyad",
            Unit::Angle,
        )
        .columns(["minimum", "at", "maximum", "at"])
        .rows(rows),
    );
}

/// Reports the reach and speed of every point that moves.
fn points(composed: &Machine, motion: Motion, report: &mut Report) {
    let (mut reach, mut speed) = (Vec::new(), Vec::new());
    for point in motion.points {
        reach.push((point.name.clone(), point.sides.to_vec()));
        speed.push((point.name, vec![point.fastest * composed.speed()]));
    }
    report.table(
        Table::new("reach", "Reach of point", Unit::Millimetre)
            .columns(["minimum x", "maximum x", "minimum y", "maximum y"])
            .rows(reach),
    );
    report.table(
        Table::new("speed", "Maximum speed of point", Unit::MillimetrePerSecond)
            .columns(["speed"])
            .rows(speed),
    );
}
