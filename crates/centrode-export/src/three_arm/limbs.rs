use centrode_geometry::Vector;
use centrode_kinematics::machine::Surface;
use nalgebra::Isometry2;

use super::ThreeArmPart;
use super::links::{Builder, Seen};
use super::machine::{Parts, no_fork};
use crate::ExportError;
use crate::plate::Pieces;

/// Maximum excess of the bodies of an arm, in tolerances: arms need less exact bodies than teeth.
const COARSE: f64 = 20.0;

/// The bodies that every chain has.
pub(super) struct Limbs {
    pub(super) arm: Pieces,
    pub(super) touching: Vec<usize>,
    pub(super) cam: Seen,
    pub(super) fork: Seen,
    pub(super) rod: Seen,
}

impl Limbs {
    pub(super) fn new(parts: &Parts<'_>, builder: &mut Builder<'_>) -> Result<Self, ExportError> {
        let plate = |part: ThreeArmPart| parts.plate_of(part).ok_or_else(no_fork);
        let span = |name: &str| parts.of_arm(name).map_or([0.0, 1.0], |p| p.span);
        let arm = [
            (ThreeArmPart::Housing, vec!["housing"]),
            (ThreeArmPart::CoverRear, vec!["cover-rear"]),
            (ThreeArmPart::CoverFront, vec!["cover-front"]),
            (ThreeArmPart::Clamp, vec!["flake-left", "flake-right"]),
        ];
        // Each part is a body of its own material.
        let arm = arm.map(|(part, names)| {
            let levels = names.into_iter().map(|name| [0.0, 0.0, span(name)[0]]);
            builder.pieces(&plate(part)?, &levels.collect::<Vec<_>>())
        });
        let arm = arm
            .into_iter()
            .collect::<Result<Vec<Pieces>, ExportError>>()?;
        let pusher = &parts.pusher;
        let place = Vector::new(pusher.fork_spec().arm_length, 0.0);
        let place = Isometry2::new(place, 0.0);
        let mut roller = plate(ThreeArmPart::Roller)?;
        let holes = roller.holes.iter_mut().map(|hole| &mut hole.outline);
        for outline in holes.chain([&mut roller.outline]) {
            *outline = outline.transformed(&place);
        }
        let fork = [
            (plate(ThreeArmPart::Fork)?, pusher.fork_span()),
            (roller, pusher.cam_span()),
        ];
        Ok(Self {
            arm: arm.concat(),
            touching: touching(parts, builder),
            cam: builder.body(
                "cam-body",
                &[(plate(ThreeArmPart::Cam)?, pusher.cam_span())],
            )?,
            fork: builder.body("fork-body", &fork)?,
            rod: builder.body(
                "push-rod-body",
                &[(plate(ThreeArmPart::PushRod)?, span("push-rod"))],
            )?,
        })
    }
}

/// Surfaces of an arm: its housing with the covers, and both flakes.
fn touching(parts: &Parts<'_>, builder: &mut Builder<'_>) -> Vec<usize> {
    let covers = ["cover-rear", "cover-front"].map(|name| parts.of_arm(name));
    let surfaces = ["housing", "flake-left", "flake-right"].map(|name| {
        let part = parts.of_arm(name)?;
        let [mut bottom, mut top] = part.span;
        if name == "housing" {
            for [rear, front] in covers.iter().flatten().map(|cover| cover.span) {
                (bottom, top) = (bottom.min(rear), top.max(front));
            }
        }
        Some(Surface {
            coarseness: COARSE,
            ..Surface::new(
                format!("arm_{}", name.replace('-', "_")),
                part.outline.clone(),
                [bottom, top],
            )
        })
    });
    let surfaces = surfaces.into_iter().flatten();
    surfaces
        .map(|surface| builder.machine.surface(surface))
        .collect()
}
