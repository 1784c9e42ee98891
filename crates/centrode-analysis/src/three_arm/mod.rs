//! Check of a three-arm mechanism.

mod arm_clearance;
mod bearings;
mod figures;
mod gear_train;
mod goals;
mod pusher;
mod screws;
mod variants;

use std::f64::consts::TAU;

use centrode_gear::{FlankCount, GearPairError, Member};
use centrode_geometry::Tolerance;
use centrode_machines::three_arm::{PickingRule, PlantingRule, ThreeArm};

use self::bearings::check_bearings;
use self::gear_train::check_gear_train;
use self::goals::all_goals;
use self::pusher::check_pusher;
use self::screws::check_screws;
use crate::progress::filling;
use crate::report::Missed;
use crate::side_by_side::both;
use crate::{Finding, Goal, Report, Severity, Table, Unit, gear_pair};
pub use figures::FIGURES;

pub use arm_clearance::{ArmClearance, ArmClearanceCourse, ArmClearanceError, between_arms};
pub use gear_train::{TrainTeeth, carrier_turn};
pub use goals::three_arm_goals;
pub use variants::{Variants, VariantsError};

/// Tolerance of the arms' clearances, as a share of the tip's distance from the planet's axis. A coarser one makes the
/// clearance less exact, a finer one takes longer.
const ARM_TOLERANCE: f64 = 1e-4;

/// Checks a three-arm mechanism: its goals, working points, arms, teeth, cam, bearings and screws.
#[must_use]
pub fn check_three_arm(mechanism: &ThreeArm) -> Report {
    let teeth = filling([0.0, 0.7], || TrainTeeth::analyse(mechanism));
    filling([0.7, 1.0], || check_three_arm_teeth(mechanism, &teeth))
}

/// Checks a three-arm mechanism like [`check_three_arm`], with teeth whose contact is known already.
#[must_use]
pub fn check_three_arm_teeth(
    mechanism: &ThreeArm,
    teeth: &Result<Option<TrainTeeth>, GearPairError>,
) -> Report {
    let mut report = check_arms(mechanism);
    check_teeth(mechanism, teeth, &mut report);
    let pusher = mechanism.pusher();
    check_pusher(&pusher, &mut report);
    check_bearings(mechanism, &mut report);
    if let Ok(pusher) = &pusher {
        check_screws(mechanism, pusher, &mut report);
    }
    report.worst_first();
    report
}

/// Checks only goals, working points and arms: the part of [`check_three_arm`] without teeth and cam, about ten times faster.
#[must_use]
pub fn check_arms(mechanism: &ThreeArm) -> Report {
    let mut report = Report {
        groups: [gear_pair::FIGURES, FIGURES].concat(),
        ..Report::default()
    };
    let (found, teeth) = both(
        || arm_clearance(mechanism),
        || mechanism.flank_counts().ok(),
    );
    let arms = match found {
        Ok(arms) => arms,
        Err(finding) => {
            report.findings.push(*finding);
            None
        }
    };
    report.goals = all_goals(mechanism, arms.as_ref(), teeth.as_ref());
    figures(mechanism, &mut report);
    for (found, names) in arms.iter().flat_map(ArmClearance::named) {
        let figures = [found.minimum, found.lower_bound, found.input];
        report.values.extend(names.into_iter().zip(figures));
    }
    crowded(arms.as_ref(), &mut report);
    gearbox_in_tray(mechanism, &mut report);
    report.tables.push(working_points(mechanism));
    unmet(mechanism, arms.as_ref(), &mut report);
    unchecked(mechanism, &mut report);
    if let Some(teeth) = teeth {
        tooth_findings(&teeth, &mut report);
    }
    report.worst_first();
    report
}

/// Goals of a mechanism and the clearances of its arms, as [`check_three_arm`] reports them.
#[must_use]
pub fn three_arm_reached(mechanism: &ThreeArm) -> (Vec<Goal>, Option<ArmClearance>) {
    let arms = arm_clearance(mechanism).ok().flatten();
    (
        all_goals(
            mechanism,
            arms.as_ref(),
            mechanism.flank_counts().ok().as_ref(),
        ),
        arms,
    )
}

/// Checks the teeth of every mesh, if the design has any.
fn check_teeth(
    mechanism: &ThreeArm,
    teeth: &Result<Option<TrainTeeth>, GearPairError>,
    report: &mut Report,
) {
    match teeth {
        Ok(None) => {}
        Ok(Some(teeth)) => check_gear_train(mechanism, teeth, report),
        Err(error) => Finding::new(
            "teeth",
            Severity::Error,
            format!("no teeth can be cut: {}: {error}", error.key()),
        )
        .add_to(report),
    }
}

/// Clearances of the arms; `None` if they cannot be determined.
fn arm_clearance(mechanism: &ThreeArm) -> Result<Option<ArmClearance>, Box<Finding>> {
    let body = mechanism.arm_body().map_err(|error| {
        let message = format!("the arm cannot be built: {error}");
        let remedy =
            "a shorter arm.clamp_length, a longer arm.tip_distance, or other sizes in arm.body";
        Finding::new("arm-body", Severity::Error, message)
            .remedy(remedy)
            .on("arm.body")
    })?;
    Ok(arm_tolerance(mechanism).and_then(|t| ArmClearance::analyse(mechanism, &body, t).ok()))
}

/// Tolerance of the arms' clearances, mm.
fn arm_tolerance(mechanism: &ThreeArm) -> Option<Tolerance> {
    Tolerance::new(ARM_TOLERANCE * mechanism.design().arm.tip_distance).ok()
}

/// Clearances of the arms in `parts` parts of a carrier turn, to the tolerance of [`check_three_arm`]; `None` if they cannot
/// be determined.
#[must_use]
pub fn arm_clearance_course(mechanism: &ThreeArm, parts: u32) -> Option<ArmClearanceCourse> {
    let (body, tolerance) = (mechanism.arm_body().ok()?, arm_tolerance(mechanism)?);
    ArmClearanceCourse::analyse(mechanism, &body, tolerance, parts).ok()
}

fn figures(mechanism: &ThreeArm, report: &mut Report) {
    let values = &mut report.values;
    let rolling = mechanism.rolling();
    let path = mechanism.trajectory();
    let speed = mechanism.carrier_speed();
    let tip = |input: f64| mechanism.tip(input, 0).velocity.norm() * speed;
    let picking_speed = tip(mechanism.picking(0));
    values.insert("center_distance", mechanism.center_distance());
    values.insert("pitch_length", rolling.pitch_length(Member::Driver));
    if let Some(module) = mechanism.module() {
        values.insert("module", module);
    }
    values.insert("planet_reference", mechanism.train().planet_reference());
    values.insert("closure_error", rolling.closure_error());
    for (member, names) in [
        (Member::Driver, ["sun_radius_min", "sun_radius_max"]),
        (
            Member::Driven,
            ["intermediate_radius_min", "intermediate_radius_max"],
        ),
    ] {
        let (minimum, maximum) = rolling.radii(member);
        values.insert(names[0], minimum);
        values.insert(names[1], maximum);
    }
    values.insert("tip_lowest", path.lowest.reach);
    values.insert("tip_highest", path.highest.reach);
    values.insert("tip_farthest", path.farthest.reach);
    values.insert("gearbox_radius", mechanism.gearbox_radius());
    values.insert("carrier_speed", speed);
    values.insert("picking_speed", picking_speed);
    // For the same rate a carrier with two arms turns faster, by the number of arms divided by two.
    values.insert(
        "picking_speed_of_two_arms",
        picking_speed * f64::from(mechanism.arms()) / 2.0,
    );
    values.insert("planting_speed", tip(mechanism.planting(0)));
}

/// Reports an arm that bends the seedlings next to the one it picks.
fn crowded(arms: Option<&ArmClearance>, report: &mut Report) {
    let Some(found) = arms.and_then(|found| found.unpicked) else {
        return;
    };
    if found.minimum >= 0.0 {
        return;
    }
    // Stems in a tray are held by their plugs and spring back.
    let severity = Severity::of_deviation(-found.minimum);
    let message = "an arm bends stems of seedlings that are still in the tray";
    Finding::new("unpicked-seedlings", severity, message)
        .measured(found.minimum, 0.0, Unit::Millimetre)
        .on("tray")
        .at(found.input)
        .add_to(report);
}

/// Reports a gearbox that reaches into the tray.
fn gearbox_in_tray(mechanism: &ThreeArm, report: &mut Report) {
    let clearance = mechanism.gearbox_tray_clearance();
    if clearance >= 0.0 {
        return;
    }
    Finding::new(
        "gearbox-tray",
        Severity::Warning,
        "the gearbox reaches behind the tray's surface",
    )
    .measured(clearance, 0.0, Unit::Millimetre)
    .remedy("a bend_deg nearer to 0, or a tray farther away")
    .on("tray")
    .add_to(report);
}

/// Table 1 of the paper: carrier turns at which each arm picks and plants.
fn working_points(mechanism: &ThreeArm) -> Table {
    let arms: Vec<u32> = (0..mechanism.arms()).collect();
    let row = |name: &str, f: &dyn Fn(u32) -> f64| {
        (name.to_owned(), arms.iter().map(|&arm| f(arm)).collect())
    };
    Table::new("working-points", "Carrier turn", Unit::Angle)
        .columns(arms.iter().map(|&arm| format!("arm {}", numeral(arm))))
        .rows(vec![
            row("picking", &|arm| mechanism.picking(arm)),
            row("planting", &|arm| mechanism.planting(arm)),
        ])
}

fn numeral(arm: u32) -> &'static str {
    const NUMERALS: [&str; 6] = ["I", "II", "III", "IV", "V", "VI"];
    NUMERALS.get(arm as usize).copied().unwrap_or("?")
}

/// Reports every goal that is not reached, and working points that the design does not fix.
fn unmet(mechanism: &ThreeArm, arms: Option<&ArmClearance>, report: &mut Report) {
    let path = mechanism.trajectory();
    let input = |goal: &Goal| match &*goal.name {
        "arm-clearance" => arms.and_then(|found| Some(found.arms?.input)),
        "pick-angle" => Some(path.picking),
        "push-angle" => Some(path.planting),
        "seedling-clearance" => Some(mechanism.seedling_clearance().input),
        "gearbox-clearance" => Some(path.lowest.input),
        _ => None,
    };
    report.blame_goals(|goal| Missed {
        input: input(goal),
        remedy: (goal.name == "sound-teeth")
            .then_some("a pitch curve of gentler curvature, or more teeth of a smaller module"),
        ..Missed::default()
    });
    let mut note = |rule, message: &str, input: f64| {
        Finding::new(rule, Severity::Note, message)
            .measured(input.rem_euclid(TAU), None, Unit::Angle)
            .at(input)
            .add_to(report);
    };
    match path.picking_rule {
        PickingRule::Given => {}
        PickingRule::EntersTray => note(
            "picking",
            "picking angle not given: the arms pick where the tip enters the tray",
            path.picking,
        ),
        PickingRule::Farthest => note(
            "picking",
            "picking angle not given: the arms pick where the tip is farthest towards the tray. Set work.picking_deg or tray.distance to change it",
            path.picking,
        ),
    }
    if path.planting_rule == PlantingRule::Lowest {
        note(
            "planting",
            "planting angle not given: the arms plant where the tip is lowest. Set work.planting_deg to change it",
            path.planting,
        );
    }
}

/// Reports every goal that could not be checked: an unchecked goal never passes.
fn unchecked(mechanism: &ThreeArm, report: &mut Report) {
    let reason = |goal: &Goal| match &*goal.name {
        "arm-clearance" if mechanism.arms() == 1 => (Severity::Note, "there is no other arm"),
        "arm-clearance" => (
            Severity::Error,
            "the clearance of the arms cannot be determined",
        ),
        _ if mechanism.design().gear_tooth_count().is_none() => {
            (Severity::Warning, "the design has no tooth_count")
        }
        _ => (Severity::Error, "no teeth can be laid out"),
    };
    let open = report.goals.iter().filter(|goal| goal.met().is_none());
    let findings: Vec<Finding> = open
        .map(|goal| {
            let (severity, why) = reason(goal);
            Finding::new(
                "goal-not-checked",
                severity,
                format!("goal {} is not checked, {}: {why}", goal.number, goal.title),
            )
            .measured(None, goal.required[0].or(goal.required[1]), goal.unit)
        })
        .collect();
    report.findings.extend(findings);
}

fn tooth_findings(teeth: &[FlankCount; 2], report: &mut Report) {
    let parts = ["sun and planets", "intermediate gears"];
    for (part, sound) in parts.into_iter().zip(teeth) {
        if sound.unsound == 0 {
            continue;
        }
        let message = format!(
            "of {} flanks per gear ({part}), {} are undercut and {} do not reach the full addendum at this module",
            sound.flanks, sound.undercut, sound.short
        );
        Finding::new("full-teeth", Severity::Warning, message)
            .measured(f64::from(sound.unsound), 0.0, Unit::Count)
            .on(part)
            .add_to(report);
    }
}
