//! Check of the gears of a three-arm mechanism: every mesh, and the clearance of gears that do not mesh.

use std::f64::consts::TAU;
use std::sync::Arc;

use centrode_gear::design::GearPairDesign;
use centrode_gear::{GearPair, GearPairError, Member};
use centrode_geometry::{Recent, Tolerance, Vector, checkpoint};
use centrode_machines::three_arm::{ThreeArm, ThreeArmLink};

use crate::interference::{Clearance, Motion, Moving, PhaseShifts, PoseJet};
use crate::progress::filling;
use crate::{ArmClearanceError, Contact, Finding, Place, Report, Severity, Unit, check_contact};

/// Number of angles of the carrier per turn at which each mesh is checked. Fewer can miss the maximum error, more take
/// longer.
const SAMPLES: u32 = 360;
/// Maximum phase error of a mesh that counts as rounding, rad. Teeth that are mounted wrongly are off by far more.
const PHASE: f64 = 1e-9;
/// Tolerance of the gears' clearances, modules. A coarser one makes the clearance less exact, a finer one takes longer.
const TOLERANCE: f64 = 1e-3;

/// Teeth of a train, with their contact over a whole cycle.
///
/// Sun and intermediate gear of the first chain represent every mesh.
#[derive(Clone, Debug)]
pub struct TrainTeeth {
    /// Sun and intermediate gear.
    pub pair: GearPair,
    /// Contact of their flanks as a function of the sun's polar angle.
    pub contact: Contact,
    /// Report of the pair alone.
    checked: Report,
}

impl TrainTeeth {
    /// Cuts the teeth and analyses their contact; `None` if the design has no tooth count.
    ///
    /// This takes long: the result is cached for designs in which only other things change.
    ///
    /// # Errors
    /// [`GearPairError`] if no teeth can be laid out or cut.
    pub fn analyse(mechanism: &ThreeArm) -> Result<Option<Self>, GearPairError> {
        if mechanism.design().gear_tooth_count().is_none() {
            return Ok(None);
        }
        static RUN: Recent<GearPairDesign, Arc<TrainTeeth>> = Recent::new();
        let pair = mechanism.pair()?;
        let design = pair.design().clone();
        let run = RUN.get(&design, || Arc::new(Self::run(pair)));
        Ok(Some(Self::clone(&run)))
    }

    /// Analyses the contact of cut teeth.
    fn run(pair: GearPair) -> Self {
        let contact = filling([0.0, 0.6], || Contact::analyse(&pair));
        let checked = filling([0.6, 1.0], || check_contact(&pair, &contact));
        Self {
            pair,
            contact,
            checked,
        }
    }
}

/// Turn of the carrier at which the first intermediate gear meets the sun at a polar angle of the sun, in
/// `[0, 2 pi)`.
#[must_use]
pub fn carrier_turn(mechanism: &ThreeArm, sun: f64) -> f64 {
    (mechanism.train().direction().sign() * sun).rem_euclid(TAU)
}

/// Checks the teeth of every mesh and the clearance of gears that are not in mesh.
///
/// All meshes of all chains are poses of the one pair of sun and intermediate gear. This is checked here, from the poses of
/// the links alone. The contact analysis of that pair over a whole cycle is then valid for every mesh.
pub(crate) fn check_gear_train(mechanism: &ThreeArm, teeth: &TrainTeeth, report: &mut Report) {
    let TrainTeeth { pair, checked, .. } = teeth;
    let (off, input) = phase_error(mechanism, pair);
    report.values.insert("mesh_phase_error_max", off);
    if off > PHASE {
        Finding::new(
            "tooth-phase",
            Severity::Error,
            "the teeth of a gear do not meet the tooth spaces of its mating gear",
        )
        .measured(off, PHASE, Unit::Angle)
        .at(input)
        .add_to(report);
    }
    for name in [
        "transmission_error_max",
        "penetration_max",
        "pairs_in_contact_min",
        "pairs_in_contact_max",
        "contact_ratio_mean",
        "backlash_min",
        "backlash_max",
    ] {
        if let Some(figure) = checked.values.get(name) {
            report.values.insert(name, *figure);
        }
    }
    let of_mesh = [
        "noisy-law",
        "scaled-mean",
        "pitch-curve-corner",
        "interference",
        "tip-interference",
        "negative-backlash",
        "disengaged",
        "contact-lost",
        "seat-jump",
    ];
    let found = checked.findings.iter().cloned();
    report
        .findings
        .extend(
            found
                .filter(|finding| of_mesh.contains(&finding.rule))
                .map(|finding| Finding {
                    message: format!("every mesh: {}", finding.message),
                    place: Place {
                        part: Some("gears".into()),
                        input: finding
                            .place
                            .input
                            .map(|driver| carrier_turn(mechanism, driver)),
                        ..finding.place
                    },
                    ..finding
                }),
        );
    apart(mechanism, pair, report);
}

/// Maximum deviation of a mesh from the law of the pair at the samples, rad, and the carrier turn at which it occurs, rad.
fn phase_error(mechanism: &ThreeArm, pair: &GearPair) -> (f64, f64) {
    let mut worst = (0.0, 0.0);
    for mesh in mechanism.meshes() {
        for i in 0..SAMPLES {
            checkpoint();
            let input = TAU * f64::from(i) / f64::from(SAMPLES);
            let pose = mechanism.mesh_pose(mesh, input);
            let off = pose.driven - pair.driven_angle(pose.driver);
            let off = (off - TAU * (off / TAU).round()).abs();
            if off > worst.0 {
                worst = (off, input);
            }
        }
    }
    worst
}

/// Checks the clearance of gears that are not in mesh.
fn apart(mechanism: &ThreeArm, pair: &GearPair, report: &mut Report) {
    let minimum = match gear_clearance(mechanism, pair) {
        Ok(Some(minimum)) => minimum,
        Ok(None) | Err(_) => return,
    };
    report.values.insert("gear_clearance", minimum.bound);
    let Some(found) = minimum.found.filter(|found| found.minimum <= 0.0) else {
        return;
    };
    Finding::new(
        "gears-collide",
        Severity::of_overlap(-found.minimum),
        format!("{} and {} collide", minimum.pair[0], minimum.pair[1]),
    )
    .measured(found.minimum, 0.0, Unit::Millimetre)
    .remedy("a smaller bend, fewer arms, or a pitch curve with a smaller maximum radius")
    .on("gears")
    .at(found.input)
    .add_to(report);
}

/// Two gears that are not in mesh and are nearest to each other.
pub(crate) struct GearClearance {
    /// Names of the two gears.
    pair: [String; 2],
    /// Lower bound of their distance, mm: the distance of the tip circles, or a larger proven bound.
    bound: f64,
    /// Clearance proven over a cycle, if the tip circles overlap.
    found: Option<Clearance>,
}

/// Minimum clearance of gears that are not in mesh, over a whole cycle.
///
/// In the carrier's frame gears only turn. If the tip circles of two gears do not overlap, their distance is enough.
fn gear_clearance(
    mechanism: &ThreeArm,
    pair: &GearPair,
) -> Result<Option<GearClearance>, ArmClearanceError> {
    let arms = mechanism.arms();
    let mut all = vec![ThreeArmLink::Sun];
    all.extend((0..arms).flat_map(|k| [ThreeArmLink::Intermediate(k), ThreeArmLink::Planet(k)]));
    let in_mesh = |a: ThreeArmLink, b: ThreeArmLink| match (a, b) {
        (ThreeArmLink::Sun, ThreeArmLink::Intermediate(_)) => true,
        (ThreeArmLink::Intermediate(j), ThreeArmLink::Planet(k))
        | (ThreeArmLink::Planet(j), ThreeArmLink::Intermediate(k)) => j == k,
        _ => false,
    };
    let mut nearest: Option<GearClearance> = None;
    for (i, &a) in all.iter().enumerate() {
        for &b in &all[i + 1..] {
            // All chains repeat the first chain: one of the two gears is the sun or belongs to the first chain.
            let first = matches!(
                (a, b),
                (
                    ThreeArmLink::Sun | ThreeArmLink::Intermediate(0) | ThreeArmLink::Planet(0),
                    _
                )
            );
            if in_mesh(a, b) || !first {
                continue;
            }
            let here = between(mechanism, pair, [a, b])?;
            if nearest.as_ref().is_none_or(|n| here.bound < n.bound) {
                nearest = Some(here);
            }
        }
    }
    Ok(nearest)
}

fn between(
    mechanism: &ThreeArm,
    pair: &GearPair,
    links: [ThreeArmLink; 2],
) -> Result<GearClearance, ArmClearanceError> {
    let gear = |link: ThreeArmLink| match link {
        ThreeArmLink::Intermediate(_) => pair.gear(Member::Driven),
        _ => pair.gear(Member::Driver),
    };
    let axes = links.map(|link| mechanism.on_carrier(link));
    let tips = links.map(|link| gear(link).radii().1);
    let name = |link: ThreeArmLink| match link {
        ThreeArmLink::Sun => "the sun".to_owned(),
        ThreeArmLink::Intermediate(k) => format!("intermediate gear {}", k + 1),
        ThreeArmLink::Planet(k) => format!("planet {}", k + 1),
        ThreeArmLink::Carrier | ThreeArmLink::Arm(_) => "the carrier".to_owned(),
    };
    let mut clearance = GearClearance {
        pair: links.map(name),
        bound: (axes[1] - axes[0]).norm() - tips[0] - tips[1],
        found: None,
    };
    let tolerance = TOLERANCE * pair.module();
    let Ok(tolerance) = Tolerance::new(tolerance) else {
        return Ok(clearance);
    };
    if clearance.bound > 0.0 {
        return Ok(clearance);
    }
    let shares = PhaseShifts::new(tolerance);
    let body = |link: ThreeArmLink| shares.body(std::slice::from_ref(gear(link).outline()));
    let bodies = [body(links[0])?, body(links[1])?];
    let motion = |k: usize| {
        let link = links[k];
        shares.motion(&bodies[k], [0.0, TAU], |input| {
            let (gear, carrier) = (
                mechanism.link(link, input).angle,
                mechanism.link(ThreeArmLink::Carrier, input).angle,
            );
            PoseJet {
                position: axes[k],
                angle: gear.position - carrier.position,
                velocity: Vector::zeros(),
                turning: gear.velocity - carrier.velocity,
            }
        })
    };
    let motions = [motion(0)?, motion(1)?];
    let moving = [0, 1].map(|i| Moving {
        body: &bodies[i],
        motion: &motions[i] as &dyn Motion,
    });
    clearance.found = shares.minimum(&moving, &[[0, 1]], [0.0, TAU])?;
    if let Some(found) = clearance.found {
        clearance.bound = clearance.bound.max(found.lower_bound);
    }
    Ok(clearance)
}

#[cfg(test)]
mod tests;
