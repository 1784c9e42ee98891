use std::f64::consts::{PI, TAU};
use std::ops::ControlFlow;

use crate::reverse::{Harmonics, KeyPose, KeyPoses, NotPosed};
use centrode_gear::{CurvatureRange, Limits, Member, Rolling};
use centrode_machines::three_arm::ThreeArm;
use centrode_machines::three_arm::design::ThreeArmDesign;

use super::evaluation;
use centrode_analysis::{Goal, three_arm_goals};
use centrode_optimise::{Evaluation, Method, Problem, Settings, minimise};

/// Bends tried with the gentlest law, in steps; the step, degrees; maximum distance of the search from the best of them, steps.
const BENDS: std::ops::RangeInclusive<i32> = -8..=8;
const STEP: f64 = 12.0;
const ROOM: f64 = 2.0;
/// Decimals of the bend, degrees.
const DECIMALS: f64 = 1e3;
/// Number of orders of the law that the search may bias; maximum bias of the first, rad; that of order k is 1/k^2 of it.
const ORDERS: usize = 5;
const MAXIMUM: f64 = 0.2;
/// Evaluations after which a search gives up.
const EVALUATIONS: u64 = 500;
/// Violation of a point that gives no mechanism.
const NONE: f64 = 1e3;

/// Search for a three-arm mechanism whose clamps take key poses and that reaches its goals: over the bend, and over the
/// amplitudes near which the law of its pair stays.
///
/// At every point of the search the clamps take the poses, so the poses are no constraint. The objective is how far the law is
/// from the gentlest one.
#[derive(Clone, Copy, Debug)]
pub struct PosedProblem<'a> {
    poses: &'a KeyPoses,
    arms: u32,
    /// Bend around which the search goes, rad.
    bend: f64,
}

/// Mechanism of key poses that was found.
#[derive(Clone, Debug)]
pub struct Posed {
    /// Poses and the chain through them.
    pub poses: KeyPoses,
    /// The design.
    pub design: ThreeArmDesign,
    /// Its goals, as far as they were evaluated, and its other limits; all are met if `is_reached`.
    pub goals: Vec<Goal>,
    /// Distance of the tip from each pose, mm, and turn of the clamp from its direction there, rad.
    pub misses: Vec<[f64; 2]>,
    /// Whether every goal is reached, with sound full teeth whose flanks transmit the motion.
    pub is_reached: bool,
    /// Evaluations of the search.
    pub evaluations: u64,
}

impl<'a> PosedProblem<'a> {
    /// Maximum number of chains through the same poses to choose from: five poses have at most four, each in either sense.
    pub const CHAINS: usize = 8;

    /// The design of a point: the bend, and amplitudes of the law.
    fn at(&self, point: &[f64]) -> Result<ThreeArmDesign, NotPosed> {
        let bend = (point[0].to_degrees() * DECIMALS).round() / DECIMALS;
        let mut design = self.poses.three_arm(bend.to_radians(), &point[1..])?;
        design.arms = self.arms;
        Ok(design)
    }

    /// Searches for a mechanism that reaches every goal: first the gentlest law of every chain at bends all over their range,
    /// then from the best of them. The best is returned if none reaches all. `observe` receives the number of evaluations and the
    /// minimum violation found.
    ///
    /// # Errors
    /// [`NotPosed`] if no chain has a law at any bend.
    pub fn search(
        chains: &'a [KeyPoses],
        arms: u32,
        observe: &mut dyn FnMut(u64, f64) -> ControlFlow<()>,
    ) -> Result<Posed, NotPosed> {
        let mut evaluations = 0;
        let mut best: Option<(f64, Self)> = None;
        let mut fault = None;
        // Small bends first: they need the smaller gearbox.
        let mut bends: Vec<f64> = BENDS.map(|step| STEP * f64::from(step)).collect();
        bends.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
        let bends = || bends.iter().map(|bend| bend.to_radians());
        for (poses, bend) in chains
            .iter()
            .flat_map(|poses| bends().map(move |bend| (poses, bend)))
        {
            let problem = Self { poses, arms, bend };
            if let Err(error) = problem.at(&problem.mildest()) {
                fault = Some(error);
                continue;
            }
            evaluations += 1;
            let violation = problem.evaluate(&problem.mildest()).violation();
            if best
                .as_ref()
                .is_none_or(|(minimum, _)| violation < *minimum)
            {
                best = Some((violation, problem));
            }
            let minimum = best.as_ref().map_or(violation, |(minimum, _)| *minimum);
            if minimum <= 0.0 || observe(evaluations, minimum).is_break() {
                break;
            }
        }
        let Some((violation, problem)) = best else {
            return Err(fault.unwrap_or(NotPosed::Law { bend: 0.0 }));
        };
        let mut point = problem.mildest();
        if violation > 0.0 {
            let settings = Settings {
                method: Method::CmaEs,
                evaluations: EVALUATIONS,
                target: Some(f64::INFINITY),
                ..Settings::default()
            };
            let found = minimise(&problem, settings, &mut |progress| {
                observe(evaluations + progress.evaluations, progress.violation)
            });
            if let Ok((search, _)) = found {
                evaluations += search.evaluations();
                point = search.best().point;
            }
        }
        problem.found(&point, evaluations)
    }

    fn mildest(&self) -> Vec<f64> {
        let mut point = vec![0.0; 1 + 2 * ORDERS];
        point[0] = self.bend;
        point
    }

    fn found(&self, point: &[f64], evaluations: u64) -> Result<Posed, NotPosed> {
        let mut design = self.at(point)?;
        let Some((quick, overload)) = quick(&mut design) else {
            return Err(NotPosed::Law {
                bend: design.bend.to_degrees(),
            });
        };
        let evaluated = evaluation::judge(&quick, overload, || ThreeArm::resolve(&design).ok());
        let reached = evaluated.filter(|evaluated| evaluated.constraints.iter().all(|c| *c <= 0.0));
        let exact = || evaluation::exact(&ThreeArm::resolve(&design).ok()?);
        let (goals, is_reached) = match reached.and_then(|evaluated| evaluated.reached) {
            Some((_, goals)) => (goals, true),
            None => (exact().unwrap_or(quick), false),
        };
        let misses = ThreeArm::resolve(&design).ok();
        let misses = misses.map_or_else(Vec::new, |mechanism| self.misses(&mechanism));
        Ok(Posed {
            poses: self.poses.clone(),
            design,
            goals,
            misses,
            is_reached,
            evaluations,
        })
    }
}

impl PosedProblem<'_> {
    fn misses(&self, mechanism: &ThreeArm) -> Vec<[f64; 2]> {
        let axis = self.poses.chain.axis().coords;
        let miss = |(pose, turns): (&KeyPose, &[f64; 2])| {
            let tip = mechanism.tip(turns[0], 0).position + axis;
            let turned = mechanism.clamp(turns[0], 0).position - pose.direction;
            let turned = turned - TAU * (turned / TAU).round();
            [(tip - pose.point).norm(), turned.abs()]
        };
        self.poses
            .poses
            .iter()
            .zip(&self.poses.turns)
            .map(miss)
            .collect()
    }
}

/// Quick goals of a design, whose tooth count is set here, and the share by which its module exceeds what the pitch curves allow.
fn quick(design: &mut ThreeArmDesign) -> Option<(Vec<Goal>, f64)> {
    let mechanism = ThreeArm::resolve(design).ok()?;
    let rolling = mechanism.train().rolling();
    let length = rolling.pitch_length(Member::Driver);
    evaluation::follow(design, length);
    let module = design
        .tooth_count
        .map_or(design.goals.module, |z| length / (PI * f64::from(z)));
    let mut figures = mechanism.figures();
    figures.module = Some(module);
    let largest = Limits::largest_module_of(&design.pair(), curvatures(rolling));
    let mut goals = three_arm_goals(&figures, &design.goals);
    goals.push(evaluation::picking_depth(design, mechanism.picking_depth()));
    goals.push(evaluation::gearbox_tray(&mechanism));
    Some((goals, module / largest - 1.0))
}

/// Maximum convex and concave curvature of both pitch curves, 1/mm.
fn curvatures(rolling: &Rolling) -> [f64; 2] {
    let ranges = rolling.curvature_ranges();
    let maximum = |of: fn(&CurvatureRange) -> f64| ranges.iter().map(of).fold(0.0, f64::max);
    [
        maximum(|range| range.maximum.1),
        maximum(|range| -range.minimum.1),
    ]
}

impl Problem for PosedProblem<'_> {
    fn bounds(&self) -> Vec<(f64, f64)> {
        let room = (ROOM * STEP).to_radians();
        let mut bounds = vec![(self.bend - room, self.bend + room)];
        for order in 1..=ORDERS {
            let maximum = MAXIMUM / (order * order) as f64;
            bounds.extend([(-maximum, maximum); 2]);
        }
        bounds
    }

    fn start(&self) -> Option<Vec<f64>> {
        Some(self.mildest())
    }

    fn evaluate(&self, point: &[f64]) -> Evaluation {
        let objective = point[1..].iter().map(|a| a * a).sum::<f64>();
        let evaluated = self.at(point).ok().and_then(|mut design| {
            let (quick, overload) = quick(&mut design)?;
            evaluation::judge(&quick, overload, || ThreeArm::resolve(&design).ok())
        });
        Evaluation {
            objective,
            constraints: evaluated.map_or(vec![NONE], |evaluated| evaluated.constraints),
        }
    }
}

// The law has terms for every order that the search may bias.
const _: () = assert!(2 * ORDERS <= Harmonics::TERMS);
