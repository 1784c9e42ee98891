use std::f64::consts::{PI, TAU};

use centrode_geometry::{Outline, Tolerance, Vector};
use centrode_machines::arm::ArmBody;
use centrode_machines::three_arm::{LinkMotion, ThreeArm, ThreeArmLink};
use nalgebra::{Isometry2, Rotation2};

use crate::interference::{
    BodyError, Clearance, DelayedMotion, InterferenceError, Motion, Moving, PhaseShifts, PoseJet,
    Rest, Uniform,
};
use crate::side_by_side::both;

/// Clearances of the arms of a planetary transplanting mechanism, proven over a whole cycle.
///
/// The arms move in a plane next to that of the gearbox: an arm turns once round its planet, and the intermediate gear lies
/// next to the planet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArmClearance {
    /// Clearance of one arm from another, with their numbers; `None` for a single arm.
    pub arms: Option<Clearance>,
    /// Clearance of the first arm's housing from the tray, a plate behind the surface in which the tip picks; the
    /// clamp goes into it and does not count.
    pub tray: Option<Clearance>,
    /// Clearance of the first arm from the stems of the rows still in the tray; `None` if there is no such row.
    pub unpicked: Option<Clearance>,
    /// Clearance of the first arm from the stems planted before its own; the second number of the pair counts them backwards.
    /// Its own stem, which its open clamp leaves behind, does not count.
    pub seedlings: Option<Clearance>,
}

/// Reason why a mechanism's clearance cannot be determined.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ArmClearanceError {
    /// The arm's contour makes no body.
    #[error(transparent)]
    Body(#[from] BodyError),
    /// A pose is not finite.
    #[error(transparent)]
    Interference(#[from] InterferenceError),
}

impl From<crate::interference::MotionError> for ArmClearanceError {
    fn from(error: crate::interference::MotionError) -> Self {
        Self::Interference(error.into())
    }
}

impl ArmClearance {
    /// Computes all clearances of a mechanism with the arm body `arm`, to within the tolerance.
    ///
    /// # Errors
    /// [`ArmClearanceError`] if a pose or the contour is not finite.
    pub fn analyse(
        mechanism: &ThreeArm,
        arm: &ArmBody,
        tolerance: Tolerance,
    ) -> Result<Self, ArmClearanceError> {
        let (arms, [tray, unpicked, seedlings]) = both(
            || between_arms(mechanism, arm, tolerance),
            || {
                [
                    from_tray(mechanism, arm, tolerance),
                    from_unpicked(mechanism, arm, tolerance),
                    from_seedlings(mechanism, arm, tolerance),
                ]
            },
        );
        Ok(Self {
            arms: arms?,
            tray: tray?,
            unpicked: unpicked?,
            seedlings: seedlings?,
        })
    }
}

impl ArmClearance {
    /// Clearances that were found, with the keys in a report of their minimum clearance, lower bound (mm) and input (rad).
    pub(crate) fn named(&self) -> impl Iterator<Item = (Clearance, [&'static str; 3])> + use<> {
        let arms = [
            "arm_clearance",
            "arm_clearance_bound",
            "arm_clearance_input",
        ];
        let tray = [
            "arm_tray_clearance",
            "arm_tray_clearance_bound",
            "arm_tray_clearance_input",
        ];
        let unpicked = [
            "arm_unpicked_clearance",
            "arm_unpicked_clearance_bound",
            "arm_unpicked_clearance_input",
        ];
        let seedlings = [
            "arm_seedling_clearance",
            "arm_seedling_clearance_bound",
            "arm_seedling_clearance_input",
        ];
        [
            (self.arms, arms),
            (self.tray, tray),
            (self.unpicked, unpicked),
            (self.seedlings, seedlings),
        ]
        .into_iter()
        .filter_map(|(found, names)| Some((found?, names)))
    }
}

/// Minimum clearance of two arms over a cycle, to within the tolerance; `None` for a single arm.
///
/// Each arm repeats the motion of the arm before it, delayed by its share of a turn: pairs of the first arm with the arms up
/// to the opposite one are enough. In the carrier's frame the arms only turn.
///
/// # Errors
/// [`ArmClearanceError`] if a pose or the contour is not finite.
pub fn between_arms(
    mechanism: &ThreeArm,
    arm: &ArmBody,
    tolerance: Tolerance,
) -> Result<Option<Clearance>, ArmClearanceError> {
    let shares = PhaseShifts::new(tolerance);
    let found = among_arms(mechanism, arm, shares, |moving, pairs| {
        shares.minimum(moving, pairs, [0.0, TAU])
    })?;
    Ok(found.flatten())
}

/// Clearances of the arms over a turn of the carrier.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ArmClearanceCourse {
    /// Middles of the parts of a carrier turn, rad, from zero on.
    pub input: Vec<f64>,
    /// Minimum distance of the first arm from another within each part, mm; empty for a single arm.
    pub arms: Vec<f64>,
    /// Minimum distance of the first arm's housing from the tray within each part, mm; empty for an arm without a housing.
    pub tray: Vec<f64>,
}

impl ArmClearanceCourse {
    /// Computes the clearances in `parts` equal parts of a carrier turn, to within the tolerance; without parts the lists are
    /// empty.
    ///
    /// # Errors
    /// [`ArmClearanceError`] if a pose or the contour is not finite.
    pub fn analyse(
        mechanism: &ThreeArm,
        arm: &ArmBody,
        tolerance: Tolerance,
        parts: u32,
    ) -> Result<Self, ArmClearanceError> {
        let shares = PhaseShifts::new(tolerance);
        let place = |i: u32, share: f64| TAU * (f64::from(i) + share) / f64::from(parts);
        let along = |moving: &[Moving<'_>], pairs: &[[usize; 2]]| {
            let minimum = (0..parts).map(|i| {
                let inputs = [place(i, 0.0), place(i, 1.0)];
                let found = shares.minimum(moving, pairs, inputs)?;
                Ok(found.map_or(f64::INFINITY, |found| found.minimum))
            });
            minimum.collect::<Result<Vec<f64>, InterferenceError>>()
        };
        Ok(Self {
            input: (0..parts).map(|i| place(i, 0.5)).collect(),
            arms: among_arms(mechanism, arm, shares, along)?.unwrap_or_default(),
            tray: at_tray(mechanism, arm, shares, along)?.unwrap_or_default(),
        })
    }
}

/// Applies `look` to the first arm and the arms that it could meet, with their motion in the carrier's frame; `None` for a
/// single arm.
fn among_arms<R>(
    mechanism: &ThreeArm,
    arm: &ArmBody,
    shares: PhaseShifts,
    look: impl FnOnce(&[Moving<'_>], &[[usize; 2]]) -> Result<R, InterferenceError>,
) -> Result<Option<R>, ArmClearanceError> {
    if mechanism.arms() < 2 {
        return Ok(None);
    }
    let body = shares.body(std::slice::from_ref(arm.outline()))?;
    let train = mechanism.train();
    let (axis, carrier) = (
        mechanism.link(ThreeArmLink::Arm(0), 0.0).origin.position,
        train.at(0.0).carrier.position,
    );
    let axis = Rotation2::new(-carrier) * axis;
    // In the carrier's frame an arm turns about its planet's axis, and does not move otherwise.
    let first = shares.motion(&body, [0.0, TAU], |input| {
        let jet = train.at(input);
        PoseJet {
            position: axis,
            angle: jet.arm.position + mechanism.clamp_mounting() - jet.carrier.position,
            velocity: Vector::zeros(),
            turning: jet.arm.velocity - jet.carrier.velocity,
        }
    })?;
    let phase = TAU / f64::from(mechanism.arms());
    let others: Vec<_> = (1..=mechanism.arms() / 2)
        .map(|k| DelayedMotion {
            first: &first,
            delay: phase * f64::from(k),
            turned: -train.direction().sign() * phase * f64::from(k),
        })
        .collect();
    let mut moving = vec![Moving {
        body: &body,
        motion: &first as &dyn Motion,
    }];
    moving.extend(others.iter().map(|motion| Moving {
        body: &body,
        motion: motion as &dyn Motion,
    }));
    let pairs: Vec<_> = (1..moving.len()).map(|k| [0, k]).collect();
    Ok(Some(look(&moving, &pairs)?))
}

fn on_frame(link: &LinkMotion) -> PoseJet {
    PoseJet {
        position: link.origin.position,
        angle: link.angle.position,
        velocity: link.origin.velocity,
        turning: link.angle.velocity,
    }
}

fn from_tray(
    mechanism: &ThreeArm,
    arm: &ArmBody,
    tolerance: Tolerance,
) -> Result<Option<Clearance>, ArmClearanceError> {
    let shares = PhaseShifts::new(tolerance);
    let found = at_tray(mechanism, arm, shares, |moving, pairs| {
        shares.minimum(moving, pairs, [0.0, TAU])
    })?;
    Ok(found.flatten())
}

/// Applies `look` to the first arm's housing and the tray; `None` for an arm without a housing.
fn at_tray<R>(
    mechanism: &ThreeArm,
    arm: &ArmBody,
    shares: PhaseShifts,
    look: impl FnOnce(&[Moving<'_>], &[[usize; 2]]) -> Result<R, InterferenceError>,
) -> Result<Option<R>, ArmClearanceError> {
    let Some(housing) = arm.parts().iter().find(|part| part.name == "housing") else {
        return Ok(None);
    };
    let tray = mechanism.tray_body();
    let housing = std::slice::from_ref(&housing.outline);
    at_rest(mechanism, housing, &[tray.plate], tray.place, shares, look).map(Some)
}

fn from_unpicked(
    mechanism: &ThreeArm,
    arm: &ArmBody,
    tolerance: Tolerance,
) -> Result<Option<Clearance>, ArmClearanceError> {
    let tray = mechanism.tray_body();
    if tray.stems.is_empty() {
        return Ok(None);
    }
    let arm = std::slice::from_ref(arm.outline());
    let (stems, place) = (&tray.stems, tray.place);
    let shares = PhaseShifts::new(tolerance);
    at_rest(mechanism, arm, stems, place, shares, |moving, pairs| {
        shares.minimum(moving, pairs, [0.0, TAU])
    })
}

/// Applies `look` to an outline carried by the first arm and a fixed outline.
fn at_rest<R>(
    mechanism: &ThreeArm,
    carried: &[Outline],
    still: &[Outline],
    place: Isometry2<f64>,
    shares: PhaseShifts,
    look: impl FnOnce(&[Moving<'_>], &[[usize; 2]]) -> Result<R, InterferenceError>,
) -> Result<R, ArmClearanceError> {
    let carried = shares.body(carried)?;
    let still = shares.body(still)?;
    let motion = shares.motion(&carried, [0.0, TAU], |input| {
        on_frame(&mechanism.link(ThreeArmLink::Arm(0), input))
    })?;
    let moving = [
        Moving {
            body: &carried,
            motion: &motion,
        },
        Moving {
            body: &still,
            motion: &Rest(place),
        },
    ];
    Ok(look(&moving, &[[0, 1]])?)
}

fn from_seedlings(
    mechanism: &ThreeArm,
    arm: &ArmBody,
    tolerance: Tolerance,
) -> Result<Option<Clearance>, ArmClearanceError> {
    let Some(stem) = mechanism.stem() else {
        return Ok(None);
    };
    let release = mechanism.planting(0);
    let inputs = [release - PI, release + PI];
    let shares = PhaseShifts::new(tolerance);
    let stem = shares.body(&[stem])?;
    let arm = shares.body(std::slice::from_ref(arm.outline()))?;
    let motion = shares.motion(&arm, inputs, |input| {
        on_frame(&mechanism.link(ThreeArmLink::Arm(0), input))
    })?;
    // In the machine's frame planted seedlings move back at constant speed.
    let still = mechanism.tip(release, 0);
    let back = still.velocity - mechanism.over_ground(&still, release).velocity;
    let apart = TAU / f64::from(mechanism.arms());
    let stems: Vec<_> = (0..=mechanism.arms())
        .map(|before| Uniform {
            start: Isometry2::new(
                Vector::new(still.position.x, mechanism.ground())
                    - back * (release - apart * f64::from(before)),
                0.0,
            ),
            velocity: back,
            turning: 0.0,
        })
        .collect();
    let mut moving = vec![Moving {
        body: &arm,
        motion: &motion as &dyn Motion,
    }];
    moving.extend(stems.iter().map(|motion| Moving {
        body: &stem,
        motion: motion as &dyn Motion,
    }));
    let pairs: Vec<_> = (2..moving.len()).map(|k| [0, k]).collect();
    let found = shares.minimum(&moving, &pairs, inputs)?;
    Ok(found.map(|clearance| Clearance {
        input: clearance.input.rem_euclid(TAU),
        pair: [0, clearance.pair[1] - 1],
        ..clearance
    }))
}

#[cfg(test)]
mod tests;
