use centrode_machines::three_arm::ThreeArm;
use centrode_machines::three_arm::design::ThreeArmDesign;

use super::mesh;
use centrode_analysis::{ArmClearance, Goal, Unit, three_arm_reached};

/// Violation charged for each undercut or short flank.
const FLANK: f64 = 1e-3;
/// Violation charged for each goal skipped because a cheaper one already failed.
const UNSEEN: f64 = 1.0;

/// Constraints of a mechanism as far as they were evaluated.
pub(super) struct Judged {
    /// Miss of each, as a share of its scale; one that was not evaluated counts as missed.
    pub(super) constraints: Vec<f64>,
    /// The mechanism and its goals, where all are met.
    pub(super) reached: Option<(ThreeArm, Vec<Goal>)>,
}

/// Evaluates the constraints of a mechanism in steps: quick figures; flanks; clearances; the contact of full teeth. A step
/// follows only if all constraints before it are met. `None` if there is no mechanism.
pub(super) fn judge(
    quick: &[Goal],
    overload: f64,
    resolve: impl FnOnce() -> Option<ThreeArm>,
) -> Option<Judged> {
    let unseen = |mut constraints: Vec<f64>, goals: f64| {
        constraints.push(UNSEEN * goals);
        Some(Judged {
            constraints,
            reached: None,
        })
    };
    let mut constraints: Vec<f64> = quick.iter().filter_map(miss).collect();
    let seen = constraints.len();
    constraints.push(overload.max(0.0));
    if constraints.iter().sum::<f64>() > 0.0 {
        return unseen(constraints, 8.0);
    }
    let mechanism = resolve()?;
    let teeth = mechanism.flank_counts().ok()?;
    let unsound: u32 = teeth.iter().map(|gear| gear.unsound).sum();
    if unsound > 0 {
        constraints[seen] = bounded(FLANK * f64::from(unsound));
        return unseen(constraints, 7.0);
    }
    let goals = exact(&mechanism)?;
    constraints = goals.iter().filter_map(miss).map(bounded).collect();
    if constraints.iter().any(|&c| c > 0.0) {
        return unseen(constraints, 2.0);
    }
    let meshing = mesh::mesh(mechanism.design())?;
    let meshing = meshing.iter().filter_map(miss).map(bounded);
    constraints.extend(meshing);
    Some(Judged {
        constraints,
        reached: Some((mechanism, goals)),
    })
}

/// Goals of a mechanism, and its other constraints; `None` if its arms have no possible bodies.
pub(super) fn exact(mechanism: &ThreeArm) -> Option<Vec<Goal>> {
    let (mut goals, arms) = three_arm_reached(mechanism);
    // Arms without possible bodies reach no goal.
    arms.as_ref()?;
    goals.extend(kept(mechanism, arms.as_ref()));
    Some(goals)
}

/// A constraint apart from the goals of the design: its number is zero.
pub(super) fn constraint(name: &'static str, title: &'static str, unit: Unit) -> Goal {
    Goal::new(0, name, title, unit)
}

/// A clearance as a constraint.
fn clear(name: &'static str, title: &'static str, minimum: f64) -> Goal {
    constraint(name, title, Unit::Millimetre).minimum(minimum, 20.0)
}

/// Depth of the picking loop as a constraint.
pub(super) fn picking_depth(design: &ThreeArmDesign, depth: f64) -> Goal {
    let minimum = design.optimise.picking_depth;
    clear("picking-depth", "depth of the picking loop", minimum).with(depth)
}

/// Clearance of the gearbox from the tray as a constraint.
pub(super) fn gearbox_tray(mechanism: &ThreeArm) -> Goal {
    clear("gearbox-tray", "gearbox to tray clearance", 0.0).with(mechanism.gearbox_tray_clearance())
}

/// Constraints apart from the goals of the design.
fn kept(mechanism: &ThreeArm, arms: Option<&ArmClearance>) -> Vec<Goal> {
    let design = mechanism.design();
    let tray = design.optimise.tray_clearance;
    let clearance =
        |found: Option<centrode_analysis::interference::Clearance>| found.map(|f| f.minimum);
    vec![
        picking_depth(design, mechanism.picking_depth()),
        gearbox_tray(mechanism),
        clear("tray-clearance", "arm housing to tray clearance", tray)
            .with(arms.and_then(|a| clearance(a.tray))),
        clear("stem-clearance", "arm to planted stems clearance", 0.0)
            .with(arms.and_then(|a| clearance(a.seedlings))),
    ]
}

/// Gives the gears the largest tooth count that leaves the required module, unless the count is fixed.
pub(super) fn follow(design: &mut ThreeArmDesign, length: f64) {
    if design.optimise.hold_tooth_count || design.goals.module <= 0.0 {
        return;
    }
    let most = length / (std::f64::consts::PI * design.goals.module);
    if design.pitch.tooth_count().is_none() && (3.0..10_000.0).contains(&most) {
        design.tooth_count = Some(most as u32);
    }
}

/// Miss of a goal as a share of its scale; zero if it is reached.
fn miss(goal: &Goal) -> Option<f64> {
    goal.margin.map(|margin| (-margin / goal.scale).max(0.0))
}

/// Miss bounded below one, however great it is.
fn bounded(miss: f64) -> f64 {
    miss / (1.0 + miss)
}
